// Straps over a shoulder and round the neck.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "design/standing.h"
#include "design/workroom.h"
#include "karinui/design/sewing.h"

namespace karinui {
namespace {

// A top without shoulders, drawn on the figure.
const std::string kTop =
    "body size=eu38\n"
    "draw name=front symmetric=yes ease=6mm edges=\"top ~ ~ armhole side ~ hem\" line=\"torso:bust+0.6@0; "
    "torso:bust+0.8@0.06; torso:armpit+0.15@0.11; torso:armpit@0.17; torso:armpit-0.2@0.25; torso:waist@0.25; "
    "torso:hip+0.3@0.25; torso:hip+0.3@0\"\n"
    "draw name=back symmetric=yes ease=6mm edges=\"top ~ side ~ hem\" line=\"torso:armpit-0.2@0.5; "
    "torso:armpit-0.2@0.4; torso:armpit-0.2@0.25; torso:waist@0.25; torso:hip+0.3@0.25; torso:hip+0.3@0.5\"\n"
    "sew a=front.side_left b=back.side_left mirror=yes\n";

class Strap : public ::testing::Test {
 protected:
  static Workroom& room() {
    static Workroom shared;  // the figures are built once
    return shared;
  }
  Document played(const std::string& script) {
    auto file = DocumentFile::inMemory();
    const Done done = room().play(file, script);
    EXPECT_TRUE(done) << (done ? "" : text(done.error().what));
    last_ = file.steps().empty() ? Operation() : file.steps().back().operation;
    return file.document();
  }
  BodyPtr figure(const Document& document) { return bodyOf(document, room().context).value(); }
  double deepest(const Document& document, const std::string& piece) {
    double least = 1;
    for (const Vec3 p : document.pieceNamed(piece)->form->space)
      least = std::fmin(least, figure(document)->bvh().signedDistance(p));
    return least;
  }
  // How far apart what a seam joins stands, at its ends and its middle.
  static double gap(const Document& document, const Seam& seam) {
    double most = 0;
    for (const double t : {0.0, 0.5, 1.0}) {
      const EdgeSpan &a = seam.a.front(), &b = seam.b.front();
      const auto place = [&](const EdgeSpan& span, double share) {
        const Piece& piece = *document.find(span.piece);
        return Stand(piece)(findCurve(piece, span.edge)->atFraction(span.from + (span.to - span.from) * share));
      };
      most = std::fmax(most, distance(place(a, t), place(b, seam.reversed ? 1 - t : t)));
    }
    return most;
  }
  Operation last_;
};

// Over the top of an ellipsoid, from a corner of its polygon to the one behind: the tape lies along the polygon.
TEST_F(Strap, IsAsLongAsTheTapeOverTheBody) {
  Workroom room;
  const std::string mesh = *room.blobs.put(packBody(egg()));
  const double a = std::numbers::pi * 18 / 24, high = 0.8 - 0.8 * std::cos(a), deep = 0.12 * std::sin(a);
  const auto sheet = [&](const std::string& name, double z, const std::string& turn) {
    return "piece name=" + name +
           " outline=\"M -50 0; low L 50 0; right L 50 200; top L -50 200; left L -50 0\" pose=\"0," +
           std::to_string(high - 0.2) + "," + std::to_string(z) + turn + "\"\n";
  };
  auto file = DocumentFile::inMemory();
  const Done done =
      room.play(file, "body mesh=" + mesh + "\n" + sheet("front", deep, "") + sheet("back", -deep, " y 180deg") +
                          "strap name=strap from=front.top@0.4:0.6 to=back.top width=30mm over=\"face:1@1,0\"\n");
  ASSERT_TRUE(done) << text(done.error().what);
  double expected = 0;
  for (int i = 18; i < 24; ++i) {
    const auto corner = [](int k) {
      const double angle = std::numbers::pi * k / 24;
      return Flat{0.12 * std::sin(angle), -0.8 * std::cos(angle)};
    };
    expected += 2 * distance(corner(i), corner(i + 1));
  }
  const Piece& strap = *file.document().pieceNamed("strap");
  EXPECT_NEAR(findEdge(strap, "side_left")->curve.length(), expected, 1e-3);
  EXPECT_NEAR(findEdge(strap, "low")->curve.length(), 0.03, 1e-5);
}

TEST_F(Strap, GoesOverTheShoulderOfItsSide) {
  const Document document =
      played(kTop + "strap name=strap from=front.top_left@0.95:1 to=back.top_left@0.45:0.55 width=15mm\n");
  const auto* made = std::get_if<DrawStrap>(&last_);
  ASSERT_TRUE(made && made->over);
  EXPECT_EQ(made->over->landmark, "shoulder_left");
  ASSERT_EQ(document.pattern.seams.size(), 4u);
  const Piece& strap = *document.pieceNamed("strap");
  for (const auto& [id, seam] : document.pattern.seams) {
    if (seam.a.front().piece == strap.id) {
      EXPECT_LT(gap(document, seam), 0.004);
    }
  }
  EXPECT_GT(deepest(document, "strap"), 0.002);
  EXPECT_LT(strained(strap), 0.25) << "a drape brings it to the skin";
  const double length = findEdge(strap, "side_left")->curve.length();
  EXPECT_GT(length, 0.25);
  EXPECT_LT(length, 0.50);
}

// The same step on a larger person gives a longer strap.
TEST_F(Strap, IsMeasuredAnewOnAnotherFigure) {
  const std::string step = "strap name=strap from=front.top_left@0.95:1 to=back.top_left@0.45:0.55 width=15mm\n";
  const auto length = [&](const std::string& script) {
    const Document document = played(script);
    return findEdge(*document.pieceNamed("strap"), "side_left")->curve.length();
  };
  std::string large = kTop;
  large.replace(large.find("size=eu38"), 9, "size=eu50");
  EXPECT_GT(length(large + step), length(kTop + step) + 0.01);
}

TEST_F(Strap, GoesRoundTheNeckFromFrontToFront) {
  const Document document =
      played(kTop + "strap name=halter from=front.top_left@0.9:1 to=front.top_right@0:0.1 width=2cm ease=-5mm\n");
  const auto* made = std::get_if<DrawStrap>(&last_);
  ASSERT_TRUE(made && made->over);
  EXPECT_EQ(made->over->landmark, "neck_back");
  EXPECT_GT(deepest(document, "halter"), 0.002);
  for (const auto& [id, seam] : document.pattern.seams) {
    if (seam.a.front().piece == document.pieceNamed("halter")->id) {
      EXPECT_LT(gap(document, seam), 0.004);
    }
  }
}

// Over other cloth it lies outside of that, and is longer.
TEST_F(Strap, LiesOnTheClothBelowIt) {
  const std::string strap =
      "strap name=strap from=front.top_left@0.95:1 to=back.top_left@0.45:0.55 width=3cm over=line:shoulder_left@0.5\n";
  const Document bare = played(kTop + strap);
  const Document over = played(kTop +
                               "draw name=yoke ease=15mm line=\"line:shoulder_left@0.25; line:shoulder_left@0.75; "
                               "torso:armpit+0.6@0.12; torso:armpit+0.6@0.07\"\n" +
                               strap);
  const auto length = [](const Document& document) {
    return findEdge(*document.pieceNamed("strap"), "side_left")->curve.length();
  };
  EXPECT_GT(length(over), length(bare));
  TriangleMesh yoke;
  const Piece& below = *over.pieceNamed("yoke");
  for (const Vec3 p : below.form->space) yoke.points.push_back(below.pose(p));
  yoke.faces = below.form->faces;
  const Bvh cloth(yoke);
  const BodyPtr body = figure(over);
  int beneath = 0;
  for (const Vec3 p : over.pieceNamed("strap")->form->space) {
    const auto near = cloth.nearest(p, 0.01);
    if (!near) continue;
    EXPECT_GT(body->bvh().signedDistance(p), body->bvh().signedDistance(near->point) - 0.004) << "at its border";
    if (body->bvh().signedDistance(p) > body->bvh().signedDistance(near->point) + 0.002) ++beneath;
  }
  EXPECT_GT(beneath, 5);
}

// A strap that was drawn already is led there by both its ends, and is not sewn.
TEST_F(Strap, ThatIsThereIsLedOverTheBody) {
  const Document document =
      played(kTop +
             "rectangle name=strap width=2cm height=38cm edges=\"low right top left\"\nattach edge=strap.low "
             "to=front.top_left@0.9:1 end=strap.top end_to=back.top_left@0.4:0.6\n");
  EXPECT_GT(deepest(document, "strap"), 0.002);
  EXPECT_EQ(document.pattern.seams.size(), 2u);
  const Piece& strap = *document.pieceNamed("strap");
  const auto middle = [](const Piece& piece, const std::string& edge, double share) {
    return Stand(piece)(findEdge(piece, edge)->curve.atFraction(share));
  };
  EXPECT_LT(distance(middle(strap, "low", 0.5), middle(*document.pieceNamed("front"), "top_left", 0.95)), 0.005);
  EXPECT_LT(distance(middle(strap, "top", 0.5), middle(*document.pieceNamed("back"), "top_left", 0.5)), 0.005);
}

TEST_F(Strap, ASymmetricCopyIsSewnToTheOtherHalf) {
  const Document document =
      played(kTop +
             "strap name=strap_left from=front.top_left@0.95:1 to=back.top_left@0.45:0.55 width=15mm\n"
             "mirror piece=strap_left sewn=yes\n");
  ASSERT_NE(document.pieceNamed("strap_right"), nullptr);
  EXPECT_EQ(document.pattern.seams.size(), 6u);
  for (const auto& [id, seam] : document.pattern.seams) {
    if (seam.a.front().piece == document.pieceNamed("strap_right")->id) {
      EXPECT_LT(gap(document, seam), 0.004);
    }
  }
}

}  // namespace
}  // namespace karinui

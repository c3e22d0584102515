// Stripes and checks in the seams: by how much they miss, and how a piece is placed so that they meet.
#include "karinui/design/print_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "design/workroom.h"
#include "karinui/base/number.h"
#include "karinui/design/lay_plan.h"
#include "karinui/design/print_image.h"
#include "karinui/geometry/axes.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {
namespace {

struct SewnPrints {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  void play(const std::string& lines) {
    const Done done = room.play(file, lines);
    ASSERT_TRUE(done) << text(done.error().what) << "\n" << lines;
  }
  const Document& document() const { return file.document(); }
  const Seam& seam(const char* name) const {
    for (const auto& [id, one] : document().pattern.seams)
      if (one.name == name) return one;
    static const Seam none;
    ADD_FAILURE() << name;
    return none;
  }
  std::optional<PrintMeeting> meets(const char* name) {
    return printMeeting(document(), seam(name), photosIn(room.blobs));
  }
};

// Two panels whose sides run in by 3 cm, as at a hip; the back's paper begins elsewhere.
std::string panels(double u, double v) {
  const auto mm = [](double a) { return " " + fixed(a * 1000, 3); };
  const auto panel = [&](const char* name, Flat from) {
    const auto at = [&](double x, double y) { return mm(from.u + x) + mm(from.v + y); };
    return std::string("piece name=") + name + " outline=\"M" + at(0, 0) + "; hem L" + at(0.3, 0) + "; left L" +
           at(0.27, 0.4) + "; top L" + at(0.03, 0.4) + "; right L" + at(0, 0) + "\"\n";
  };
  return panel("front", {0, 0}) + panel("back", {u, v}) + "sew name=side a=front.left b=back.right\n";
}

TEST(PrintMatch, PlacedPiecesMeetAlongTheWholeOfASeamWhoseSidesAreAlike) {
  std::mt19937 lot(11);
  std::uniform_real_distribution<double> place(-0.2, 0.2), repeat(0.01, 0.09), turn(0, 90);
  for (const char* print : {"stripe", "check", "dot"})
    for (int k = 0; k < 12; ++k) {
      SewnPrints s;
      // Turned, the mirrored side does not run as this one does; then they meet at one place only.
      const bool turned = k % 3 == 2;
      s.play(panels(place(lot), place(lot)) + "look fabric=cotton print=" + print + " repeat=" + fixed(repeat(lot), 4) +
             (k % 3 == 1 ? " turn=90deg"
              : turned   ? " turn=" + fixed(turn(lot), 1) + "deg"
                         : "") +
             "\n");
      const auto before = s.meets("side");
      ASSERT_TRUE(before);
      s.play("match seam=side\n");
      const auto after = s.meets("side");
      ASSERT_TRUE(after);
      if (!turned) {
        EXPECT_LT(after->most, 1e-6) << print << " " << k << " before " << before->most;
      }
      // At the start it always meets: no other placing is nearer there.
      const SeamSides sides(s.document().pattern, s.seam("side"));
      const auto at = [&](const SeamSide& side) {
        const SeamPlace where = side.at(0);
        const Piece& piece = *s.document().find(where.piece);
        const auto [across, along] = axes(piece.grain, lookOf(s.document(), piece).turn);
        const Flat from =
            findEdge(piece, where.edge)->curve.atFraction(where.fraction) - printOrigin(s.document(), piece);
        return Flat{dot(from, across), dot(from, along)};
      };
      const Flat a = at(sides.a), b = at(sides.b);
      const double r = lookOf(s.document(), *s.document().pieceNamed("front")).repeat;
      const auto off = [&](double x, double y) {
        const double same = x - y, mirrored = x + y;
        return std::min(std::fabs(same - r * std::round(same / r)), std::fabs(mirrored - r * std::round(mirrored / r)));
      };
      EXPECT_LT(off(a.u, b.u), 1e-9);
      if (std::string(print) != "stripe") {
        EXPECT_LT(off(a.v, b.v), 1e-9);
      }
    }
}

// What was done is told, and that nothing was to be done.
TEST(PrintMatch, TellsThatThePrintsMeetNow) {
  SewnPrints s;
  std::vector<std::string> told;
  s.room.context.advise = [&](const Advice& advice) { told.push_back(text(advice.what)); };
  s.play(panels(0.013, 0.021) + "look fabric=cotton print=check repeat=3cm\n");
  told.clear();
  s.play("match seam=side\n");
  EXPECT_EQ(told, std::vector<std::string>{
                      "The print of back meets that of front there now: back is cut from another place of the cloth."});
  told.clear();
  s.play("match seam=side\n");
  EXPECT_EQ(told, std::vector<std::string>{"The print of back meets that of front there already."});
}

TEST(PrintMatch, AMissIsToldWithItsMeasureAndItsPlace) {
  SewnPrints s;
  s.play(panels(0, 0) + "look fabric=cotton print=stripe turn=90deg repeat=4cm\nmatch seam=side\n");
  EXPECT_TRUE(unmatchedSaid(s.document(), photosIn(s.room.blobs)).empty());
  s.play("look piece=back shift=\"0,7mm\"\n");
  const auto meets = s.meets("side");
  ASSERT_TRUE(meets);
  EXPECT_NEAR(meets->most, 0.007, 1e-9);
  const auto said = unmatchedSaid(s.document(), photosIn(s.room.blobs));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(text(said[0]), "side: the print misses by up to 7.0 mm, 19 % along the seam");
  const auto ofIt = unmatchedSaid(s.document(), photosIn(s.room.blobs), s.document().pattern.seams.begin()->first);
  ASSERT_EQ(ofIt.size(), 1u);
  EXPECT_EQ(text(ofIt[0]), "the print misses by up to 7.0 mm, 19 % along the seam") << "of one it is known which";
  // Another cloth, or none printed: nothing to match.
  s.play("fabric name=denim piece=back\n");
  EXPECT_FALSE(s.meets("side"));
  // A photograph is not the same in a mirror.
  SewnPrints p;
  const std::string photo = *p.room.blobs.put(packPrint({2, 1, {255, 0, 0, 0, 0, 255}}));
  p.play(panels(0.013, 0.021) + "look fabric=cotton print=photo repeat=8cm photo=" + photo +
         "\nmatch seam=side at=0.5\n");
  EXPECT_GT(p.meets("side")->most, 0.01);
}

// What a pleat's stitching joins lies behind its fold: nobody sees whether the print goes on there.
TEST(PrintMatch, AStitchedPleatIsNoSeamOfThePrint) {
  for (const char* hold : {"", " hold=0"}) {
    SewnPrints s;
    s.play(std::string("rectangle name=skirt width=60cm height=40cm\nrectangle name=back width=40cm height=40cm\n") +
           "pleat edge=skirt.top kind=box count=2 depth=23mm stitch=5cm" + hold +
           "\nsew name=side a=skirt.side_left b=back.side_right\nlook fabric=cotton print=check repeat=60mm\n");
    std::size_t own = 0;
    for (const auto& [id, seam] : s.document().pattern.seams) {
      if (seam.name == "side") continue;
      own += seam.tie != Seam::Tie::Pleat;
      EXPECT_FALSE(printMeeting(s.document(), seam, photosIn(s.room.blobs))) << text(id);
    }
    EXPECT_EQ(own, 4u);
    EXPECT_TRUE(s.meets("side"));
  }
}

// The stripes of a gathered skirt lie in its folds: they are not told to miss those of the band.
TEST(PrintMatch, AGatheredSeamIsNoneOfThePrint) {
  SewnPrints s;
  s.play(
      "rectangle name=skirt width=90cm height=40cm\nrectangle name=band width=60cm height=5cm\n"
      "rectangle name=eased width=62cm height=40cm\nrectangle name=second width=60cm height=5cm\n"
      "sew name=gathers a=skirt.top b=band.bottom\nsew name=eases a=eased.top b=second.bottom\n"
      "look fabric=cotton print=check repeat=4cm\n");
  EXPECT_FALSE(s.meets("gathers"));
  EXPECT_TRUE(s.meets("eases"));
}

// Bars stand where a repeat begins on the one side, and where that place is sewn to on the other.
TEST(PrintMatch, MarksStandAtRepeatsOnBothSides) {
  SewnPrints s;
  s.play(panels(0.013, 0.021) + "look fabric=cotton print=check repeat=3cm\nmatch seam=side\n");
  const auto marks = matchMarks(s.document(), photosIn(s.room.blobs));
  ASSERT_EQ(marks.size() % 2, 0u);
  EXPECT_EQ(marks.size() / 2, 6u) << "40 cm in steps of two repeats";
  const Curve &front = *findCurve(*s.document().pieceNamed("front"), "left"),
              &back = *findCurve(*s.document().pieceNamed("back"), "right");
  for (std::size_t k = 0; k + 1 < marks.size(); k += 2) {
    const MatchMark &one = marks[k], &other = marks[k + 1];
    EXPECT_EQ(one.number, static_cast<int>(k / 2) + 1);
    EXPECT_EQ(one.number, other.number);
    const Piece &a = *s.document().find(one.piece), &b = *s.document().find(other.piece);
    EXPECT_EQ(a.name, "front");
    EXPECT_EQ(b.name, "back");
    EXPECT_NEAR(std::remainder(one.from.v - printOrigin(s.document(), a).v, 0.06), 0, 1e-4);
    EXPECT_NEAR(std::remainder(other.from.v - printOrigin(s.document(), b).v, 0.03), 0, 1e-4) << "it matches";
    EXPECT_NEAR(distance(one.from, front.start), distance(other.from, back.end), 1e-4) << "sewn to each other";
    EXPECT_NEAR(one.to.v, one.from.v, 1e-12) << "along the line of the print";
    EXPECT_TRUE(contains(a.outline.flattened(), one.to));
    EXPECT_TRUE(contains(b.outline.flattened(), other.to));
  }
  // Without a print there is nothing to match.
  s.play("look fabric=cotton print=none\n");
  EXPECT_TRUE(matchMarks(s.document(), photosIn(s.room.blobs)).empty());
}

TEST(PrintMatch, AMirroredPieceIsPlacedAsItsOriginal) {
  SewnPrints s;
  s.play(
      "rectangle name=front width=30cm height=40cm\nmirror piece=front\nlook fabric=cotton print=check repeat=5cm\n"
      "look piece=front shift=\"12mm,-7mm\"\n");
  const Document& d = s.document();
  for (const auto& [id, piece] : d.pattern.pieces)
    EXPECT_LT(distance(printOrigin(d, *piece), piece->mirrorOf ? Flat{-0.012, -0.007} : Flat{0.012, -0.007}), 1e-12);
}

TEST(PrintMatch, TheLayKeepsThePlacing) {
  SewnPrints s;
  s.play(panels(0.031, 0.017) + "look fabric=cotton print=check repeat=4cm\nmatch seam=side\n");
  LaySettings settings;
  settings.tries = 20;
  Context own{s.room.workers, s.room.token, s.file.blobs(), s.room.bodies, {}, {}};
  const auto plan = layPlan(s.document(), settings, own);
  ASSERT_TRUE(plan) << text(plan.error().what);
  EXPECT_EQ(plan->settings.stripes, 0.04);
  EXPECT_EQ(plan->settings.rows, 0.04);
  // On the cloth all prints begin a whole number of repeats apart: it is one cloth.
  const auto& laid = plan->fabrics.at(0).pieces;
  ASSERT_EQ(laid.size(), 2u);
  std::vector<Flat> begins;
  for (const LaidPiece& one : laid) begins.push_back(one(printOrigin(plan->document, *plan->document.find(one.piece))));
  const Flat apart = begins[1] - begins[0];
  EXPECT_NEAR(std::remainder(apart.u, 0.04), 0, 1e-6);
  EXPECT_NEAR(std::remainder(apart.v, 0.04), 0, 1e-6);
}

}  // namespace
}  // namespace karinui

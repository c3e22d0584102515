// Drawing on our own mannequin, as a dressmaker would.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "design/workroom.h"
#include "karinui/design/apply.h"
#include "karinui/design/drawing.h"
#include "karinui/design/script.h"

namespace karinui {
namespace {

class OnTheMannequin : public ::testing::Test {
 protected:
  static Workroom& room() {
    static Workroom shared;  // the figure is built once
    return shared;
  }
  DocumentFile file_ = DocumentFile::inMemory();
  void SetUp() override { ASSERT_TRUE(room().play(file_, "body size=jis9ar")); }
  const Piece& draw(const std::string& line, const char* name) {
    const Done done = room().play(file_, line);
    EXPECT_TRUE(done) << text(done.error().what);
    const Piece* piece = file_.document().pieceNamed(name);
    EXPECT_TRUE(piece);
    return *piece;
  }
};

const std::string kFront =
    "draw name=front symmetric=yes line=\"torso:shoulder+0.5@0; torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; "
    "landmark:shoulder_left; torso:armpit+0.5@0.16; torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; "
    "torso:hip@0.25; torso:hip@0\" edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\"\n";
const std::string kBack =
    "draw name=back symmetric=yes line=\"torso:neck_base@0.5; torso:neck_base+0.05@0.42; torso:neck_base+0.2@0.25; "
    "landmark:shoulder_left; torso:armpit+0.5@0.34; torso:armpit@0.31; torso:armpit-0.3@0.25; torso:waist@0.25; "
    "torso:hip@0.25; torso:hip@0.5\" edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\"\n";

double lengthOf(const Piece& piece, std::string_view edge) {
  const auto found = piece.outline.find(edge);
  EXPECT_TRUE(found) << edge;
  return found ? piece.outline.edges[*found].curve.length() : 0;
}

TEST_F(OnTheMannequin, FrontAndBackBodiceFitTogether) {
  const Piece front = draw(kFront, "front"), back = draw(kBack, "back");
  for (const char* edge : {"shoulder_left", "shoulder_right", "side_left", "side_right"})
    EXPECT_NEAR(lengthOf(front, edge) / lengthOf(back, edge), 1, 0.015)
        << edge;  // front and back bow differently along the side
  const auto body = bodyOf(file_.document(), room().context);
  ASSERT_TRUE(body);
  for (const Piece* piece : {&front, &back}) {
    ASSERT_TRUE(piece->form);
    EXPECT_EQ(piece->pose, Rigid{});
    double nearest = 1;
    for (Vec3 p : piece->form->space) nearest = std::fmin(nearest, (*body)->bvh().signedDistance(p));
    EXPECT_GT(nearest, 0.004) << piece->name;
  }
  EXPECT_GT(front.outline.area(), 0.08);
  EXPECT_LT(front.outline.area(), 0.4);
}

// Radians by which an edge that meets the centre is off the square, within a reach of it at most.
double offSquare(const Piece& piece, std::string_view edge, double reach) {
  const Curve& curve = piece.outline.edges[*piece.outline.find(edge)].curve;
  const bool begins = std::fabs(curve.start.u) < std::fabs(curve.end.u);
  EXPECT_EQ(begins ? curve.start.u : curve.end.u, 0) << piece.name << " " << edge;
  double most = 0;
  for (double walked = 0; walked < reach; walked += 0.001) {
    const Flat way = curve.tangent(curve.parameterAt(begins ? walked : curve.length() - walked));
    most = std::fmax(most, std::fabs(std::atan2(way.v, std::fabs(way.u))));
  }
  return most;
}

// Between the buttocks the skin dips at the centre.
TEST_F(OnTheMannequin, HemsCrossTheCentreSquare) {
  const Piece back = draw(kBack, "back"), front = draw(kFront, "front");
  EXPECT_THAT(file_.log(), ::testing::HasSubstr("square=yes"));
  for (const Piece* piece : {&back, &front})
    for (const char* edge : {"hem_left", "hem_right"}) EXPECT_LT(offSquare(*piece, edge, 0.025), 0.1) << piece->name;
  EXPECT_GT(offSquare(front, "neck_left", 0.01), 0.6) << "a V stays one";
}

// The front's V comes to the centre at some 45 degrees.
TEST_F(OnTheMannequin, HowSteepALineIsLedSquareIsSettled) {
  Operation said = *parseOperation(kFront.substr(0, kFront.size() - 1));
  EXPECT_THAT(text(*resolved(file_.document(), said, room().context)), ::testing::HasSubstr("level=0.75"));
  const auto offAt = [&](std::optional<double> degrees, bool recorded) {
    Operation op = said;
    auto& draw = std::get<DrawPiece>(op);
    draw.square = Choice::Yes, draw.ease = Length{0.01};
    if (degrees) draw.level = Angle{*degrees * std::numbers::pi / 180};
    Context own = room().context;
    own.recorded = recorded;
    const auto after = apply(file_.document(), op, own);
    EXPECT_TRUE(after);
    return after ? offSquare(*after->pieceNamed("front"), "neck_left", 0.002) : -1;
  };
  EXPECT_LT(offAt(70, false), 0.1);
  EXPECT_GT(offAt(std::nullopt, false), 0.6);
  EXPECT_EQ(offAt(std::nullopt, true), offAt(0.6 * 180 / std::numbers::pi, true)) << "as before it was settled";
}

TEST_F(OnTheMannequin, LinesAreLeftAsDrawnWhereNothingElseWasSettled) {
  Operation recorded = *parseOperation(kBack.substr(0, kBack.size() - 1)), said = recorded;
  std::get<DrawPiece>(recorded).ease = std::get<DrawPiece>(said).ease = Length{0.01};
  std::get<DrawPiece>(said).square = Choice::No;
  const auto before = file_.document();
  Context again = room().context;
  again.recorded = true;
  const auto old = apply(before, recorded, again), now = apply(before, said, room().context);
  ASSERT_TRUE(old && now);
  const Piece &was = *old->pieceNamed("back"), &is = *now->pieceNamed("back");
  EXPECT_EQ(was.outline, is.outline);
  EXPECT_GT(offSquare(is, "hem_left", 0.025), 0.15);
}

TEST_F(OnTheMannequin, AHandDrawnLineClosesItselfWithinFifteenMillimetres) {
  const std::string places = "torso:hip@0.05; torso:hip@0.2; torso:waist@0.2; torso:waist@0.05; ";
  const Piece panel = draw("draw name=panel closed=no line=\"" + places + "torso:hip+0.03@0.052\"\n", "panel");
  EXPECT_EQ(panel.outline.edges.size(), 4u);
  const auto op = parseOperation("draw name=other closed=no line=\"" + places + "torso:hip+0.8@0.05\"");
  ASSERT_TRUE(op);
  const auto refused = file_.perform(*op, room().context);
  ASSERT_FALSE(refused);
  EXPECT_NE(text(refused.error().what).find("The line is open"), std::string::npos);
}

TEST_F(OnTheMannequin, TheAdviceNamesAnEdgeOfThePiece) {
  const auto op = parseOperation(kFront.substr(0, kFront.size() - 1));
  ASSERT_TRUE(op);
  const auto made = drawn(file_.document(), std::get<DrawPiece>(*op), room().context);
  ASSERT_TRUE(made) << text(made.error().what);
  if (made->distortion.gate == Distortion::Gate::Red) {
    ASSERT_FALSE(made->advice.empty());
    EXPECT_TRUE(made->piece.outline.find(text(made->advice.front().what.values[3]) + "_left"));
  } else {
    EXPECT_TRUE(made->advice.empty());
  }
}

// Near a corner both edges are about as near; the dart that is offered is in the one that the sentence names.
TEST_F(OnTheMannequin, TheDartThatIsOfferedIsInTheEdgeThatIsNamed) {
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room().play(file, "body size=eu38"));
  const auto op = parseOperation(
      "draw name=back symmetric=yes ease=5mm fabric=viscose edges=\"top side ~ hem\" line=\"torso:bust@0.5; "
      "torso:bust@0.25; torso:waist@0.25; torso:high_hip@0.25; torso:high_hip@0.5\"");
  ASSERT_TRUE(op);
  const auto made = drawn(file.document(), std::get<DrawPiece>(*op), room().context);
  ASSERT_TRUE(made) << text(made.error().what);
  ASSERT_FALSE(made->advice.empty());
  const Advice& advice = made->advice.front();
  ASSERT_TRUE(advice.mend);
  const auto* dart = std::get_if<AddDart>(&*advice.mend);
  ASSERT_TRUE(dart) << text(*advice.mend);
  EXPECT_THAT(dart->edge.edge, testing::StartsWith(text(advice.what.values[3]))) << text(advice.what);
}

// Where edges meet at an acute corner, the curve of one may curl across the other by a tenth of a millimetre: the back
// of trousers, at the hem of this figure.
TEST(DrawnOnAnyone, TheBackOfTrousersOnATallSlimFigure) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(
      room.play(file,
                "body sex=female set=\"height=174cm; bust_girth=82cm; waist_girth=63cm; hip_girth=89cm\"\n"
                "draw name=back_left mirror=yes ease=15mm edges=\"cb ~ ~ inseam ~ hem ~ outseam ~ ~ ~ waist\" "
                "line=\"torso:waist@0.5; torso:high_hip@0.5; torso:hip@0.5; landmark:crotch; left_leg:knee@0.75; "
                "left_leg:ankle@0.75; left_leg:ankle@0.5; left_leg:ankle@0.25; left_leg:knee@0.25; torso:hip@0.25; "
                "torso:high_hip@0.25; torso:waist@0.25\"\n"));
  EXPECT_TRUE(file.document().pieceNamed("back_left"));
  EXPECT_TRUE(file.document().pieceNamed("back_right"));
}

// A man's chest is widest right under the armpit: the corner under his arm is on the trunk, and the armhole does not
// run over the arm to it.
TEST(DrawnOnAnyone, ABodiceOnMen) {
  Workroom room;
  for (const char* man : {"height=178cm; bust_girth=88cm; waist_girth=75cm; hip_girth=92cm",
                          "height=180cm; bust_girth=101cm; waist_girth=89cm; hip_girth=102cm"}) {
    DocumentFile file = DocumentFile::inMemory();
    const Done done = room.play(file, "body sex=male set=\"" + std::string(man) + "\"\n" + kFront + kBack);
    ASSERT_TRUE(done) << man << ": " << text(done.error().what);
    const Piece &front = *file.document().pieceNamed("front"), &back = *file.document().pieceNamed("back");
    EXPECT_NEAR(lengthOf(front, "side_left"), lengthOf(back, "side_left"), 0.03) << man;
    for (const Piece* piece : {&front, &back}) {
      EXPECT_LT(lengthOf(*piece, "armhole_left"), 0.34) << man << ", " << piece->name;
      double wide = 0;
      for (const Flat p : piece->outline.flattened(1e-3)) wide = std::max(wide, std::abs(p.u));
      EXPECT_LT(wide, 0.29) << man << ", " << piece->name;
    }
  }
}

}  // namespace
}  // namespace karinui

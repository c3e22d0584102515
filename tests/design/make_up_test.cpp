#include "karinui/design/make_up.h"

#include <gtest/gtest.h>

#include <set>

#include "workroom.h"

namespace karinui {
namespace {

Flat turned(Flat p, double angle) {
  return {std::cos(angle) * p.u - std::sin(angle) * p.v, std::sin(angle) * p.u + std::cos(angle) * p.v};
}

// Millimetres; between corners a straight line, or a curve by the two controls that follow its start.
struct Drawn {
  std::string name;
  std::vector<std::vector<Flat>> edges;
};
Piece pieceOf(const Drawn& drawn, std::uint64_t id, double turn) {
  Piece piece;
  piece.id = {id};
  piece.name = drawn.name;
  const auto at = [&](Flat p) { return turned(p * 0.001, turn); };
  for (std::size_t k = 0; k < drawn.edges.size(); ++k) {
    const auto& own = drawn.edges[k];
    const Flat end = drawn.edges[(k + 1) % drawn.edges.size()][0];
    piece.outline.edges.push_back(
        {"e" + std::to_string(k + 1), own.size() == 1 ? Curve::line(at(own[0]), at(end))
                                                      : Curve::cubic(at(own[0]), at(own[1]), at(own[2]), at(end))});
  }
  auto whole = checked(piece.outline);
  EXPECT_TRUE(whole) << drawn.name << (whole ? "" : text(whole.error().what));
  piece.outline = *std::move(whole);
  piece.grain = turned({0, 1}, turn);
  return piece;
}

Drawn trunk(const std::string& name, double neck) {
  return {name,
          {{{-250, 0}},
           {{250, 0}},
           {{240, 350}, {190, 370}, {175, 440}},
           {{180, 570}},
           {{80, 600}, {60, 600 - neck * 1.3}, {-60, 600 - neck * 1.3}},
           {{-80, 600}},
           {{-180, 570}, {-175, 440}, {-190, 370}},
           {{-240, 350}}}};
}
Drawn sleeve(const std::string& name) {
  return {name,
          {{{-140, -80}},
           {{140, -80}},
           {{165, 0}, {110, 10}, {100, 150}},
           {{0, 150}, {-100, 150}, {-110, 5}},
           {{-165, 0}}}};
}
Drawn leg(const std::string& name, double crotch) {
  return {name, {{{-110, 0}}, {{110, 0}}, {{140, 1000}}, {{-60, 1000}, {-60, 860}, {-62, 775}}, {{-60 - crotch, 760}}}};
}

Document documentOf(const std::vector<Drawn>& drawn, double turn = 0) {
  Document document;
  for (std::size_t k = 0; k < drawn.size(); ++k)
    document.pattern.pieces[{k + 1}] = std::make_shared<const Piece>(pieceOf(drawn[k], k + 1, turn));
  document.operations = static_cast<std::uint32_t>(drawn.size());
  return document;
}

Document withCopies(Document document) {
  Workroom room;
  for (const Operation& copy : copiesFor(document, readPieces(document.pattern)))
    document = *apply(document, copy, room.context);
  return document;
}
std::set<std::string> sureSeams(const Document& document) {
  std::set<std::string> names;
  for (const SeamProposal& one : proposeSeams(document, readPieces(document.pattern)))
    if (one.sure >= kSureSeam) names.insert(one.sew.name);
  return names;
}

TEST(MakeUp, NamesInManyLanguages) {
  for (const auto& [name, role] : {std::pair<const char*, PieceRole>{"FRONT", PieceRole::Front},
                                   {"Vorderteil", PieceRole::Front},
                                   {"devant", PieceRole::Front},
                                   {"DELANTERO", PieceRole::Front},
                                   {"前身頃", PieceRole::Front},
                                   {"Rückenteil", PieceRole::Back},
                                   {"RÜCKEN", PieceRole::Back},
                                   {"BK", PieceRole::Back},
                                   {"dos", PieceRole::Back},
                                   {"СПИНКА", PieceRole::Back},
                                   {"Ärmel links", PieceRole::Sleeve},
                                   {"SL1", PieceRole::Sleeve},
                                   {"manga", PieceRole::Sleeve},
                                   {"袖", PieceRole::Sleeve},
                                   {"collarStand", PieceRole::CollarStand},
                                   {"Kragen", PieceRole::Collar},
                                   {"WB", PieceRole::Waistband},
                                   {"Hosenbund", PieceRole::Waistband},
                                   {"back waistband", PieceRole::Waistband},
                                   {"sleevePlacketOverlap", PieceRole::Aside},
                                   {"front pocket", PieceRole::Aside},
                                   {"Pattern2D_768516", PieceRole::Unknown},
                                   {"", PieceRole::Unknown}})
    EXPECT_EQ(roleNamed(name), role) << name;
}

// A T-shirt, whichever way it is drawn and whatever its pieces are called.
TEST(MakeUp, ATShirtIsSewnByShapeAlone) {
  const std::set<std::string> all{"shoulder_left", "shoulder_right", "side_left",     "side_right",
                                  "armhole_left",  "armhole_right",  "underarm_left", "underarm_right"};
  for (const double turn : {0.0, std::numbers::pi / 2, 2.0, -2.5})
    for (const bool named : {true, false}) {
      const Document document = withCopies(documentOf(
          {trunk(named ? "front" : "7", 90), trunk(named ? "back" : "11", 25), sleeve(named ? "sleeve" : "36")}, turn));
      EXPECT_EQ(document.pattern.pieces.size(), 4u);
      EXPECT_EQ(sureSeams(document), all) << turn << " " << named;
      const PieceReadings readings = readPieces(document.pattern);
      EXPECT_EQ(readings.at({1}).role, PieceRole::Front);
      EXPECT_EQ(readings.at({2}).role, PieceRole::Back);
      EXPECT_EQ(readings.at({3}).role, PieceRole::Sleeve);
      EXPECT_EQ(proposeSeams(document, readings).size(), all.size()) << "hems are not sewn to each other";
    }
}

// Left is sewn to left: of every seam of the sides both edges lie on the same side of the wearer.
TEST(MakeUp, LeftMeetsLeft) {
  Workroom room;
  Document document = documentOf({trunk("front", 90), trunk("back", 25), sleeve("sleeve")});
  const auto making = makeUp(document, room.context);
  ASSERT_TRUE(making);
  EXPECT_TRUE(making->unknown.empty());
  for (const Operation& step : making->steps) {
    auto next = apply(document, step, room.context);
    ASSERT_TRUE(next) << text(next.error().what);
    document = *std::move(next);
  }
  EXPECT_EQ(document.pattern.seams.size(), 8u);
  for (const auto& [id, seam] : document.pattern.seams) {
    EXPECT_TRUE(seam.reversed);
    EXPECT_LT(easeRatio(document.pattern, seam), 1.15) << seam.name;
    if (!seam.name.starts_with("side") && !seam.name.starts_with("shoulder")) continue;
    // Seen from outside the wearer's left is to the right on the front and to the left on the back.
    const bool left = seam.name.ends_with("left");
    EXPECT_EQ(findEdge(*document.find(seam.a[0].piece), seam.a[0].edge)->curve.at(0.5).u > 0, left) << seam.name;
    EXPECT_EQ(findEdge(*document.find(seam.b[0].piece), seam.b[0].edge)->curve.at(0.5).u < 0, left) << seam.name;
  }
}

// On a figure every piece stands clear of it; what was not recognised stands beside it, frozen.
TEST(MakeUp, PiecesStandClearOfTheFigure) {
  Workroom room;
  Document document =
      documentOf({trunk("front", 90), trunk("back", 25), sleeve("sleeve"), {"x", {{{0, 0}}, {{90, 0}}, {{40, 70}}}}});
  auto body = parseOperation("body size=eu38");
  ASSERT_TRUE(body);
  document = *apply(document, *body, room.context);
  const auto making = makeUp(document, room.context);
  ASSERT_TRUE(making);
  ASSERT_EQ(making->unknown, (std::vector<PieceId>{{4}}));
  for (const Operation& step : making->steps) {
    auto next = apply(document, step, room.context);
    ASSERT_TRUE(next) << text(next.error().what);
    document = *std::move(next);
  }
  const auto figure = bodyOf(document, room.context);
  ASSERT_TRUE(figure);
  for (const auto& [id, piece] : document.pattern.pieces) {
    EXPECT_EQ(piece->frozen, id == PieceId{4}) << piece->name;
    const Stand stand(*piece);
    for (const Flat place : piece->outline.flattened(0.002))
      EXPECT_GT((*figure)->bvh().signedDistance(stand(place)), 0) << piece->name;
  }
  EXPECT_EQ(document.pattern.seams.size(), 8u);
}

TEST(MakeUp, TrousersCutInPairs) {
  const Document document = withCopies(documentOf(
      {leg("front", 60), leg("back", 110), {"waistband", {{{-400, 0}}, {{400, 0}}, {{400, 40}}, {{-400, 40}}}}}));
  EXPECT_EQ(document.pattern.pieces.size(), 5u);
  const auto seams = sureSeams(document);
  for (const char* name :
       {"outseam_left", "outseam_right", "inseam_left", "inseam_right", "crotch_front", "crotch_back", "waistband"})
    EXPECT_TRUE(seams.contains(name)) << name;
}

TEST(MakeUp, NothingIsSewnThatDoesNotFit) {
  // Two squares and a disc of no garment, and edges that are sewn already.
  const Drawn square{"a", {{{0, 0}}, {{300, 0}}, {{300, 300}}, {{0, 300}}}};
  Document document = documentOf({square, {"b", square.edges}});
  EXPECT_TRUE(sureSeams(document).empty());
  Document shirt = withCopies(documentOf({trunk("front", 90), trunk("back", 25), sleeve("sleeve")}));
  for (const SeamProposal& one : proposeSeams(shirt, readPieces(shirt.pattern))) {
    std::set<std::pair<PieceId, std::string>> edges;
    for (const auto* side : {&one.sew.a, &one.sew.b})
      for (const EdgeRef& edge : *side) EXPECT_TRUE(edges.insert({edge.piece.id, edge.edge}).second) << one.sew.name;
    EXPECT_GE(one.sure, 0);
    EXPECT_LE(one.sure, 1);
  }
  // A front half as long again as the back: the side seams are asked about.
  Drawn longer = trunk("front", 90);
  longer.edges[0][0].v = longer.edges[1][0].v = -150;
  shirt = withCopies(documentOf({longer, trunk("back", 25), sleeve("sleeve")}));
  const auto seams = sureSeams(shirt);
  EXPECT_FALSE(seams.contains("side_left"));
  EXPECT_TRUE(seams.contains("shoulder_left"));
}

}  // namespace
}  // namespace karinui

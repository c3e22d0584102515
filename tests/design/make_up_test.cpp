#include "karinui/design/make_up.h"

#include <gtest/gtest.h>

#include <set>

#include "karinui/design/sewing.h"
#include "workroom.h"

namespace karinui {
namespace {

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

// Left front of a shirt: its edge lies 30 mm beyond the centre front, which a line and a notch tell.
Piece shirtFront(std::uint64_t id, bool right) {
  std::vector<std::vector<Flat>> edges = {{{0, 0}},
                                          {{250, 0}},
                                          {{240, 350}, {190, 370}, {175, 440}},
                                          {{180, 570}},
                                          {{80, 600}, {75, 540}, {40, 510}},
                                          {{0, 510}},
                                          {{-30, 510}},
                                          {{-30, 0}}};
  if (right) {  // the mirror image, the other way round
    std::vector<std::vector<Flat>> other;
    for (std::size_t k = edges.size(); k-- > 0;) {
      other.push_back({edges[(k + 1) % edges.size()][0]});
      if (edges[k].size() > 1) other.back().push_back(edges[k][2]), other.back().push_back(edges[k][1]);
    }
    for (auto& edge : other)
      for (Flat& p : edge) p.u *= -1;
    edges = other;
  }
  Piece piece = pieceOf({right ? "frontRight" : "frontLeft", edges}, id, 0);
  piece.lines = {{"centre", {Curve::line({0, 0}, {0, 0.51})}, {}}};
  for (const Edge& edge : piece.outline.edges)
    if (distance(edge.curve.start, Flat{right ? 0.03 : 0, 0.51}) < 1e-9)
      piece.marks = {{"cf", edge.name, right ? 1.0 : 0.0, {}}};
  return piece;
}
TEST(MakeUp, AShirtHasItsStandAndStaysOpen) {
  Document document = documentOf({trunk("back", 25)});
  for (const bool right : {false, true})
    document.pattern.pieces[{right ? 3u : 2u}] = std::make_shared<const Piece>(shirtFront(right ? 3 : 2, right));
  const auto neckOf = [&](PieceId id) { return readPieces(document.pattern).at(id).parts.at(PiecePart::Neck).length; };
  ASSERT_NEAR(neckOf({2}), neckOf({3}), 1e-6);
  // The stand reaches 12 mm beyond the centre front on the left, 16 on the right; the collar from centre to centre.
  const double collar = 1000 * (neckOf({1}) + 2 * neckOf({2}) - 0.06), left = 12, right = 16;
  const double end = collar + left + right;
  Piece stand = pieceOf({"collar stand",
                         {{{0, 0}},
                          {{end, 0}, {end + 3, 20}, {end - right + 8, 35}},
                          {{end - right, 35}},
                          {{left, 35}, {left - 8, 35}, {-3, 20}}}},
                        4, 0);
  stand.marks = {{"left", "e1", left / end, {}}, {"right", "e1", 1 - right / end, {}}};
  document.pattern.pieces[{4}] = std::make_shared<const Piece>(stand);
  document.pattern.pieces[{5}] = std::make_shared<const Piece>(
      pieceOf({"collar", {{{0, 0}}, {{collar, 0}}, {{collar + 20, 70}}, {{-20, 70}}}}, 5, 0));
  document.operations = 5;
  const PieceReadings readings = readPieces(document.pattern);
  EXPECT_EQ(readings.at({4}).role, PieceRole::CollarStand);
  std::map<std::string, SeamProposal> seams;
  for (const SeamProposal& one : proposeSeams(document, readings)) seams.emplace(one.sew.name, one);
  EXPECT_LT(seams.at("centre_front").sure, kSureSeam) << "buttoned over each other, not sewn";
  const SeamProposal &neck = seams.at("neck"), &upper = seams.at("collar");
  EXPECT_GE(neck.sure, kSureSeam);
  ASSERT_EQ(neck.sew.a.front().piece.id, PieceId{4});
  // What the notches say is left of the fronts: 18 mm beside the left end, 14 beside the right one.
  EXPECT_NEAR(lengthOf(document, neck.sew.a), lengthOf(document, neck.sew.b), 1e-6);
  EXPECT_NEAR(lengthOf(document, neck.sew.b), end / 1000, 1e-6);
  const auto& first = neck.sew.b.front();
  ASSERT_EQ(first.piece.id, PieceId{3});
  const Flat from = findEdge(*document.find(PieceId{3}), first.edge)->curve.at(first.from);
  EXPECT_NEAR(from.u, 0.030 - 0.014, 2e-4);
  EXPECT_GE(upper.sure, kSureSeam);
  EXPECT_NEAR(lengthOf(document, upper.sew.b), collar / 1000, 1e-3);
}

TEST(MakeUp, ADoubleNotchTellsTheBackOfASleeve) {
  for (const bool leftSleeve : {true, false}) {
    Document document = documentOf({trunk("front", 90), trunk("back", 25), sleeve("sleeve")});
    const auto alone = readPieces(document.pattern).at({3});
    Piece notched = *document.find(PieceId{3});
    // The cap runs from plus to minus; the left sleeve's back is at plus.
    const double back = leftSleeve ? 0.3 : 0.7;
    const std::string cap = alone.parts.at(PiecePart::Top).edges.at(back < 0.5 ? 0 : 1);
    notched.marks = {{"a", cap, 0.50, {}}, {"b", cap, 0.54, {}}};
    document.pattern.pieces[{3}] = std::make_shared<const Piece>(notched);
    EXPECT_EQ(readPieces(document.pattern).at({3}).side,
              leftSleeve ? PieceReading::Side::Left : PieceReading::Side::Right);
  }
}

// Four edges of one length: only where notches sit at the same distances they are partners.
TEST(MakeUp, NotchesTellPartners) {
  const Drawn strip{"a", {{{0, 0}}, {{300, 0}}, {{310, 90}}, {{150, 200}}, {{-20, 90}}}};
  Document document = documentOf({strip, {"b", strip.edges}});
  const auto partners = [&](double own, double other) {
    for (const auto& [id, at] : {std::pair{1u, own}, {2u, other}}) {
      Piece piece = *document.find(PieceId{id});
      piece.marks = {{"n", "e1", at, {}}};
      document.pattern.pieces[{id}] = std::make_shared<const Piece>(piece);
    }
    double sure = 0;
    const ToldRoles none{{PieceId{1}, PieceRole::Unknown}, {PieceId{2}, PieceRole::Unknown}};
    for (const SeamProposal& one : proposeSeams(document, readPieces(document.pattern, none)))
      if (one.sew.a.front().edge == "e1") sure = one.sure;
    return sure;
  };
  const double met = partners(0.3, 0.7), missed = partners(0.3, 0.3);
  EXPECT_GT(met, missed);
  EXPECT_LT(met, kSureSeam) << "never sewn by themselves";
}

TEST(MakeUp, WhatIsCutInPairsIsCopiedAndThenCutOnce) {
  Workroom room;
  Document document = documentOf(
      {trunk("front", 90), trunk("back", 25), sleeve("sleeve"), {"godet", {{{0, 0}}, {{90, 0}}, {{40, 70}}}}});
  document.cutting[{3}] = {2, true}, document.cutting[{4}] = {4, true};
  const auto making = makeUp(document, room.context);
  ASSERT_TRUE(making);
  EXPECT_EQ(making->document.pattern.pieces.size(), 6u);
  std::map<std::string, int> often;
  for (const auto& [id, piece] : making->document.pattern.pieces) {
    const auto told = making->document.cutting.find(id);
    often[piece->name] = told == making->document.cutting.end() ? 1 : told->second.count;
    EXPECT_FALSE(told != making->document.cutting.end() && told->second.pairs) << piece->name;
  }
  EXPECT_EQ(often.at("sleeve"), 1);
  EXPECT_EQ(often.at("godet"), 2);
  EXPECT_EQ(often.at("godet_mirrored"), 2);
}

// Without a figure the pieces lie flat beside each other; nobody is told that their seams cross.
TEST(MakeUp, OnTheTableNothingIsTwisted) {
  Workroom room;
  Document document = documentOf({trunk("front", 90), trunk("back", 25), sleeve("sleeve")});
  const auto making = makeUp(document, room.context);
  ASSERT_TRUE(making);
  std::size_t sewn = 0;
  for (const Operation& step : making->steps) {
    if (const auto* sew = std::get_if<SewEdges>(&step)) {
      ++sewn;
      for (const SeamDoubt& doubt : seamDoubts(document, *sew, nullptr))
        EXPECT_NE(doubt.kind, SeamDoubt::Kind::Twisted) << sew->name;
      SewEdges wrong = *sew;
      wrong.reversed = Choice::No;
      const auto doubts = seamDoubts(document, wrong, nullptr);
      EXPECT_TRUE(!sew->name.starts_with("underarm") ||
                  std::any_of(doubts.begin(), doubts.end(),
                              [](const SeamDoubt& doubt) { return doubt.kind == SeamDoubt::Kind::Twisted; }));
    }
    document = *apply(document, step, room.context);
  }
  EXPECT_EQ(sewn, 8u);
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

// Panels before and behind, as files say, for a body of another height; flat ones beside each other are left alone.
TEST(MakeUp, PiecesThatStandTooLowAreCarriedUpToTheShoulders) {
  Workroom room;
  const Document document = *apply({}, *parseOperation("body size=eu38"), room.context);
  const BodyPtr body = *bodyOf(document, room.context);
  const double neck = body->landmarks().at("neck_left").y, top = 0.6;
  const auto standing = [&](double height, double before, double behind) {
    Pattern pattern = documentOf({trunk("front", 90), trunk("back", 25)}).pattern;
    for (auto& [id, piece] : pattern.pieces) {
      Piece placed = *piece;
      placed.pose.carry = {0, height - top, id == PieceId{1} ? before : behind};
      piece = std::make_shared<const Piece>(std::move(placed));
    }
    return pattern;
  };
  for (const double off : {-0.3, -0.1, 0.2}) {
    const RaisedPattern raised = raisedTo(*body, standing(neck + off, 0.2, -0.2));
    EXPECT_NEAR(raised.by, -off, 0.001);
    for (const auto& [id, piece] : raised.pattern.pieces) EXPECT_NEAR(piece->pose.carry.y + top, neck, 0.001);
  }
  EXPECT_EQ(raisedTo(*body, standing(neck - 0.03, 0.2, -0.2)).by, 0);
  EXPECT_EQ(raisedTo(*body, standing(neck - 0.3, 0, 0)).by, 0);
}

}  // namespace
}  // namespace karinui

// How wide the legs of trousers are drafted, a skirt that is sewn to a bodice, and blocks over one another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/design/block_numbers.h"
#include "karinui/pattern/seam_walk.h"
#include "karinui/pattern/truing.h"

namespace karinui {
namespace {

Workroom& draftingRoom() {
  static Workroom room;  // the figure is built once
  return room;
}

Document drafted(const std::string& script, bool recorded = false) {
  Document document;
  const auto lines = parseScript("body size=eu38\n" + script);
  EXPECT_TRUE(lines);
  Context& context = draftingRoom().context;
  context.recorded = recorded;
  for (const ScriptLine& line : *lines) {
    auto next = apply(document, line.operation, context);
    EXPECT_TRUE(next) << text(next.error().what);
    if (next) document = *std::move(next);
  }
  context.recorded = false;
  return document;
}
std::string refusedFor(const std::string& line) {
  Context& context = draftingRoom().context;
  const auto body = apply({}, op("body size=eu38"), context);
  const auto made = apply(*body, op(line), context);
  return made ? "" : text(made.error().what);
}

// How wide a leg is all round, so far below the waist.
double legRound(const Document& document, double down) {
  double sum = 0;
  for (const char* name : {"leg_front_left", "leg_back_left"}) {
    const Piece& piece = *document.pieceNamed(name);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Flat p : piece.outline.flattened(1e-4))
      if (std::fabs(p.v + down) < 0.004) low = std::min(low, p.u), high = std::max(high, p.u);
    sum += high - low;
  }
  return sum;
}
double hemRound(const Document& document) {
  return findEdge(*document.pieceNamed("leg_front_left"), "hem")->curve.length() +
         findEdge(*document.pieceNamed("leg_back_left"), "hem")->curve.length();
}

// Wide trousers are wide down to their hem, as the hip is; tight ones stay passable for knee and heel. A record of
// before keeps its knee and hem.
TEST(TrousersBlock, IsAsWideBelowAsItsEase) {
  const Document usual = drafted("block kind=trousers trued=no"),
                 wide = drafted("block kind=trousers ease=20cm trued=no"),
                 old = drafted("block kind=trousers ease=20cm trued=no", true),
                 own = drafted("block kind=trousers ease=20cm legs=no trued=no"),
                 tight = drafted("block kind=trousers ease=-20cm trued=no");
  const auto body = *bodyOf(usual, draftingRoom().context);
  const auto& measures = body->measured().value;
  const double hip = measures.at("hip_girth"), share = (hip + 0.20) / (hip + 0.06);
  EXPECT_NEAR(hemRound(usual), measures.at("ankle_girth") + 0.14, 1e-6);
  EXPECT_NEAR(hemRound(wide), share * hemRound(usual), 1e-6);
  EXPECT_EQ(hemRound(old), hemRound(usual));
  EXPECT_EQ(hemRound(own), hemRound(usual));
  EXPECT_NEAR(hemRound(tight), measures.at("ankle_girth") + 0.10, 1e-6);
  const double knee = measures.at("waist_height") - measures.at("knee_height");
  EXPECT_NEAR(legRound(wide, knee), share * legRound(usual, knee), 0.004);
}

TEST(TrousersBlock, HasTheWidthsThatAreAskedFor) {
  const Document legs = drafted("block kind=trousers knee=56cm hem=60cm trued=no"),
                 shorts = drafted("block kind=trousers length=45cm hem=70cm trued=no");
  EXPECT_NEAR(hemRound(legs), 0.60, 1e-6);
  const auto body = *bodyOf(legs, draftingRoom().context);
  const double knee = body->measured().value.at("waist_height") - body->measured().value.at("knee_height");
  EXPECT_NEAR(legRound(legs, knee), 0.56, 0.002);
  EXPECT_NEAR(hemRound(shorts), 0.70, 1e-6);
  const Document wide = drafted("block kind=trousers length=70cm knee=70cm hem=80cm");
  for (const char* name : {"leg_front_left", "leg_back_left"}) {
    const Stand stand(*wide.pieceNamed(name));
    for (const Flat p : wide.pieceNamed(name)->outline.flattened(1e-3)) EXPECT_GT(stand(p).x, 0.01) << name;
  }
  EXPECT_THAT(refusedFor("block kind=trousers knee=20cm"), testing::HasSubstr("no narrower there"));
  EXPECT_THAT(refusedFor("block kind=skirt hem=60cm"), testing::HasSubstr("Only trousers"));
  EXPECT_THAT(refusedFor("block kind=trousers hem=5cm"), testing::HasSubstr("10 cm to 3 m"));
}

// A dress in one line: the skirt is as long at the waist as the bodice, front and back, and its darts go on in the
// bodice's. A skirt alone, one that is told not to, and one of a record of before have their own waist.
TEST(SkirtBlock, MeetsTheBodiceAtTheWaist) {
  const std::string sewn = "sew a=\"front.hem* back.hem*\" b=\"skirt_front.waist* skirt_back.waist*\" name=waist";
  const Document dress = drafted("block kind=bodice\nblock kind=skirt\n" + sewn);
  for (const SeamTruing& seam : truing(dress.pattern, dress.eases).seams) EXPECT_TRUE(seam.fits()) << text(seam.seam);
  // The rings are not turned against each other, whichever edge each is begun with.
  const Seam& ring = std::find_if(dress.pattern.seams.begin(), dress.pattern.seams.end(), [](const auto& seam) {
                       return seam.second.name == "waist";
                     })->second;
  const SeamSides sides(dress.pattern, ring);
  for (const double share : {0.1, 0.3, 0.6, 0.9}) {
    const auto stands = [&](const SeamPlace& at) {
      const Piece& piece = *dress.find(at.piece);
      return Stand(piece)(findEdge(piece, at.edge)->curve.atFraction(at.fraction));
    };
    EXPECT_LT(distance(stands(sides.a.at(share)), stands(sides.b.at(share))), 0.06);
  }
  const auto middleToDart = [](const Piece& piece, const std::string& edge) {
    for (const Edge& one : piece.outline.edges)
      if (one.name.starts_with(edge) && std::fmin(std::fabs(one.curve.start.u), std::fabs(one.curve.end.u)) < 1e-6)
        return one.curve.length();
    return 0.0;
  };
  for (const std::string part : {"front", "back"})
    EXPECT_NEAR(middleToDart(*dress.pieceNamed("skirt_" + part), "waist"), middleToDart(*dress.pieceNamed(part), "hem"),
                1e-3);
  const auto waist = [](const Document& document) {
    double sum = 0;
    for (const char* name : {"skirt_front", "skirt_back"})
      for (const Edge& edge : document.pieceNamed(name)->outline.edges)
        if (edge.name.starts_with("waist")) sum += edge.curve.length();
    return sum;
  };
  const double alone = waist(drafted("block kind=skirt"));
  EXPECT_EQ(waist(drafted("block kind=bodice\nblock kind=skirt meets=no")), alone);
  EXPECT_EQ(waist(drafted("block kind=bodice trued=yes\nblock kind=skirt trued=yes worn=holds belly=yes", true)),
            alone);
  EXPECT_GT(waist(dress), alone + 0.01);
  // Longer than the waist, or too loose to be worn at it, there is nothing to meet.
  EXPECT_EQ(waist(drafted("block kind=bodice length=20cm\nblock kind=skirt")), alone);
  EXPECT_EQ(waist(drafted("block kind=bodice ease=40cm\nblock kind=skirt")), alone);
  EXPECT_THAT(refusedFor("block kind=skirt meets=yes"), testing::HasSubstr("no open waist"));
  EXPECT_THAT(refusedFor("block kind=sleeve meets=yes"), testing::HasSubstr("Only a skirt"));
}

// So is a jumpsuit: bodice and trousers are sewn in one line, each dart on its own. A record of before keeps the
// trousers' own waist; leggings, of cloth that stretches, meet it where that is asked for.
TEST(TrousersBlock, MeetTheBodiceAtTheWaist) {
  const std::string sewn =
      "sew a=\"front.hem* back.hem*\" b=\"leg_front_right.waist* leg_front_left.waist* leg_back_left.waist* "
      "leg_back_right.waist*\" name=waist";
  const auto waist = [](const Document& document, const std::string& name) {
    double sum = 0;
    for (const Edge& edge : document.pieceNamed(name)->outline.edges)
      if (edge.name.starts_with("waist") || edge.name.starts_with("hem_") || edge.name == "hem")
        if (edge.name.starts_with("waist") == name.starts_with("leg")) sum += edge.curve.length();
    return sum;
  };
  for (const char* kind : {"trousers", "trousers length=40cm", "leggings meets=yes"}) {
    const Document suit = drafted("block kind=bodice\nblock kind=" + std::string(kind) + "\n" + sewn);
    for (const std::string part : {"front", "back"})
      EXPECT_NEAR(2 * waist(suit, "leg_" + part + "_left"), waist(suit, part), 1e-3) << kind << part;
    if (kind[0] != 't') continue;
    for (const SeamTruing& seam : truing(suit.pattern, suit.eases).seams) EXPECT_TRUE(seam.fits()) << text(seam.seam);
    // From the middle to the dart each is as long as the other.
    for (const std::string part : {"front", "back"}) {
      const auto& leg = suit.pieceNamed("leg_" + part + "_left")->outline.edges;
      const auto crotch = std::find_if(leg.begin(), leg.end(), [](const Edge& edge) { return edge.name == "crotch"; });
      const Edge& beside = part == "front" ? *(crotch - 1) : *(crotch + 1);
      const auto& edges = suit.pieceNamed(part)->outline.edges;
      const auto hem = std::find_if(edges.begin(), edges.end(), [](const Edge& edge) {
        return edge.name.starts_with("hem") &&
               std::fmin(std::fabs(edge.curve.start.u), std::fabs(edge.curve.end.u)) < 1e-6;
      });
      ASSERT_NE(hem, edges.end()) << part;
      EXPECT_TRUE(beside.name.starts_with("waist")) << beside.name;
      EXPECT_NEAR(beside.curve.length(), hem->curve.length(), 1e-3) << kind << part;
    }
  }
  const double alone = waist(drafted("block kind=trousers"), "leg_front_left");
  EXPECT_EQ(waist(drafted("block kind=bodice\nblock kind=trousers meets=no"), "leg_front_left"), alone);
  EXPECT_EQ(
      waist(drafted("block kind=bodice trued=yes\nblock kind=trousers trued=yes worn=holds belly=yes legs=yes", true),
            "leg_front_left"),
      alone);
  const double stretched = waist(drafted("block kind=leggings"), "leg_front_left");
  EXPECT_EQ(waist(drafted("block kind=bodice\nblock kind=leggings"), "leg_front_left"), stretched);
}

// What is drafted once more is worn over what is there: by other names, a layer higher, off cloth that was draped.
TEST(Blocks, OneThatIsThereAlreadyIsWornOverIt) {
  using Kind = DraftBlock::Kind;
  const std::pair<Kind, const char*> kinds[] = {{Kind::Shirt, "shirt"},       {Kind::Bodice, "bodice"},
                                                {Kind::Sleeve, "sleeve"},     {Kind::Skirt, "skirt"},
                                                {Kind::Trousers, "trousers"}, {Kind::Leggings, "leggings"}};
  Context& context = draftingRoom().context;
  for (const auto& [kind, name] : kinds) {
    SCOPED_TRACE(name);
    Document document = drafted(std::string("block kind=") + name + "\n");
    for (const auto& [id, piece] : document.pattern.pieces) {  // each is known
      Document alone = document;
      std::erase_if(alone.pattern.pieces, [own = id](const auto& held) { return held.first != own; });
      DraftBlock again;
      again.kind = kind;
      EXPECT_EQ(takenBy(alone, again), piece->name);
    }
    const std::size_t pieces = document.pattern.pieces.size();
    for (int layer = 1; layer <= 2; ++layer) {
      DraftBlock over;
      over.kind = kind;
      over = wornOver(document, over);
      EXPECT_EQ(over.layer, layer);
      EXPECT_EQ(takenBy(document, over), "");
      auto next = apply(document, over, context);
      ASSERT_TRUE(next) << text(next.error().what);
      document = *std::move(next);
      EXPECT_EQ(document.pattern.pieces.size(), (layer + 1) * pieces);
    }
  }
  DraftBlock skirt;
  skirt.kind = Kind::Skirt;
  EXPECT_EQ(wornOver(drafted("block kind=trousers\n"), skirt), skirt) << "it is not there";
  skirt.prefix = "my";
  EXPECT_EQ(wornOver(drafted("block kind=skirt\n"), skirt), skirt) << "it says how it is called";
}

}  // namespace
}  // namespace karinui

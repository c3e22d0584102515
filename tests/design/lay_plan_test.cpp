#include "karinui/design/lay_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "design/workroom.h"
#include "geometry/ring_distance.h"
#include "karinui/base/number.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

struct LayRoom {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  explicit LayRoom(const std::string& script) {
    const Done done = room.play(file, script);
    EXPECT_TRUE(done) << text(done.error().what);
  }
  Result<LayPlan> lay(LaySettings settings) {
    settings.tries = std::min(settings.tries, 160);
    return layPlan(file.document(), settings, room.context);
  }
};

// A skirt: the front half on the fold, two backs, four pockets.
const char* const kPaperSkirt =
    "piece name=front outline=\"M 0 0; hem L 300 0; side L 280 600; waist L 0 600; fold L 0 0\"\n"
    "piece name=back outline=\"M 0 0; hem L 300 0; side L 280 600; waist L 0 600; cb L 0 0\" pose=\"0,0,-0.3\"\n"
    "piece name=pocket outline=\"M 0 0; low L 150 0; side L 140 180; top L 0 180; in L 0 0\" pose=\"1,0,-0.3\"\n"
    "quantity piece=back count=2 pairs=yes\nquantity piece=pocket count=4 pairs=yes\n"
    "sew a=front.side b=back.side\n";

std::string anyPieces(unsigned seed) {
  std::mt19937 engine(seed);
  std::string script;
  for (int n = 0; n < 4; ++n) {
    const int corners = 4 + static_cast<int>(engine() % 5);
    script += "piece name=p" + std::string(1, static_cast<char>('a' + n)) + "x outline=\"";
    std::vector<std::string> points;
    for (int k = 0; k < corners; ++k) {
      const double a = 2 * M_PI * k / corners, r = 100 + static_cast<double>(engine() % 150);
      points.push_back(fixed(r * std::cos(a), 3) + " " + fixed(r * std::sin(a), 3));
    }
    script += "M " + points[0];
    for (int k = 1; k <= corners; ++k)
      script += "; e" + std::to_string(k) + " L " + points[static_cast<std::size_t>(k % corners)];
    const double turn = static_cast<double>(engine() % 628) / 100;
    script += "\" grain=\"" + fixed(std::cos(turn), 6) + "," + fixed(std::sin(turn), 6) + "\" pose=\"" +
              std::to_string(n) + ",0,0\"\n";
    const bool pairs = engine() % 2 == 1;
    const std::size_t count = (1 + engine() % 3) * (pairs ? 2 : 1);
    script += "quantity piece=p" + std::string(1, static_cast<char>('a' + n)) + "x count=" + std::to_string(count) +
              (pairs ? " pairs=yes" : "") + "\n";
  }
  return script;
}

// How many of each piece are cut, and how many of them turned over.
struct Cut {
  int count = 0, over = 0;
};
std::map<std::string, Cut> cutOf(const LayPlan& plan) {
  std::map<std::string, Cut> all;
  for (const FabricLay& lay : plan.fabrics)
    for (const LaidPiece& laid : lay.pieces) {
      Cut& cut = all[plan.document.find(laid.piece)->name];
      cut.count += laid.under ? 1 : laid.layers;
      if (laid.under) ++all[plan.document.find(laid.under)->name].count;
      cut.over += laid.layers == 2 && !laid.under ? 1 : laid.over;
    }
  return all;
}

void examine(const LayPlan& plan, unsigned seed) {
  for (const FabricLay& lay : plan.fabrics) {
    ASSERT_EQ(lay.cut.size(), lay.pieces.size());
    EXPECT_FALSE(clash(lay)) << seed;
    for (std::size_t i = 0; i < lay.cut.size(); ++i) {
      const LaidPiece& laid = lay.pieces[i];
      for (const Flat p : lay.cut[i]) {
        EXPECT_TRUE(p.u > -1e-9 && p.u < lay.length + 1e-9 && p.v > -1e-9 && p.v < lay.width + 1e-9) << seed;
      }
      // The grain runs along the cloth, and all the same way where the cloth has a nap.
      const Flat grain = laid.step(plan.document.find(laid.piece)->grain);
      EXPECT_NEAR(std::abs(grain.u), 1, 1e-9);
      EXPECT_NEAR(grain.v, 0, 1e-9);
      EXPECT_TRUE(!plan.settings.nap || grain.u < 0) << seed;
      // The piece lies where its cut line lies.
      for (const Edge& edge : plan.document.find(laid.piece)->outline.edges)
        EXPECT_TRUE(laid.half || contains(lay.cut[i], laid(edge.curve.at(0.5))) ||
                    distanceToRing(lay.cut[i], laid(edge.curve.at(0.5))) < 2e-4)
            << seed;
      for (std::size_t j = 0; j < i; ++j) EXPECT_GE(apart(lay.cut[i], lay.cut[j]), plan.settings.gap) << seed;
    }
  }
}

TEST(LayPlan, AnyPiecesLieRight) {
  for (unsigned seed = 1; seed <= 24; ++seed) {
    LayRoom cloth(anyPieces(seed));
    LaySettings settings;
    settings.width = 1.1 + 0.1 * (seed % 5);
    settings.folded = seed % 2 == 1;
    settings.nap = seed % 3 == 1;
    settings.gap = 0.004 * (seed % 3);
    settings.rows = seed % 4 == 2 ? 0.03 : 0;
    settings.stripes = seed % 5 == 2 ? 0.02 : 0;
    const auto plan = cloth.lay(settings);
    ASSERT_TRUE(plan) << seed << text(plan.error().what);
    examine(*plan, seed);
    for (const auto& [name, cut] : cutOf(*plan)) {
      const Document& document = cloth.file.document();
      const auto told = document.cutting.find(document.pieceNamed(name)->id);
      const Cutting wanted = told == document.cutting.end() ? Cutting() : told->second;
      EXPECT_EQ(cut.count, wanted.count) << seed << name;
      // Half of a pair is turned over; of what is alike on both sides of its grain nobody can tell.
      EXPECT_NEAR(cut.over, wanted.pairs ? wanted.count / 2.0 : 0.0, wanted.pairs ? 0.5 : 0.0) << seed << name;
    }
  }
}

// A pocket and a strap are sewn to lines inside another piece, which are no edges.
TEST(LayPlan, WhatIsSewnToAnInnerLineIsLaid) {
  LayRoom cloth(
      "polygon name=a symmetric=yes points=\"0,0; 20cm,0; 20cm,60cm; 0,60cm\"\n"
      "rectangle name=p width=18cm height=16cm\n"
      "patch piece=p on=a at=0,30cm open=top\n");
  LaySettings settings;
  settings.stripes = 0.02;
  const auto plan = cloth.lay(settings);
  ASSERT_TRUE(plan) << text(plan.error().what);
  EXPECT_EQ(cutOf(*plan).at("p").count, 1);
}

TEST(LayPlan, AHalfLiesOnTheFoldOrWhole) {
  LayRoom cloth(kPaperSkirt);
  LaySettings settings;
  const auto open = cloth.lay(settings);
  ASSERT_TRUE(open);
  examine(*open, 0);
  // The front was unfolded: as wide as both halves with both allowances.
  const auto wide = [&](const LayPlan& plan, const std::string& name) {
    for (std::size_t i = 0; i < plan.fabrics[0].pieces.size(); ++i)
      if (plan.document.find(plan.fabrics[0].pieces[i].piece)->name == name) {
        double low = 1e9, high = -1e9;
        for (const Flat p : plan.fabrics[0].cut[i]) low = std::min(low, p.v), high = std::max(high, p.v);
        return high - low;
      }
    return 0.0;
  };
  settings.folded = true;
  const auto folded = cloth.lay(settings);
  ASSERT_TRUE(folded);
  examine(*folded, 1);
  EXPECT_NEAR(wide(*open, "front"), 2 * wide(*folded, "front"), 1e-6);
  EXPECT_EQ(folded->fabrics[0].pieces.size(), 1u + 1 + 2);  // half a front, a back and two pockets on two layers
  EXPECT_EQ(open->fabrics[0].pieces.size(), 1u + 2 + 4);
  EXPECT_NEAR(open->fabrics[0].area, folded->fabrics[0].area, 1e-6);
  EXPECT_NEAR(open->fabrics[0].use, open->fabrics[0].area / (1.5 * open->fabrics[0].length), 1e-9);
  EXPECT_NEAR(folded->fabrics[0].use, folded->fabrics[0].area / (1.5 * folded->fabrics[0].length), 1e-9);
  for (std::size_t i = 0; i < folded->fabrics[0].pieces.size(); ++i)
    if (folded->fabrics[0].pieces[i].onFold) {
      double low = 1e9;
      for (const Flat p : folded->fabrics[0].cut[i]) low = std::min(low, p.v);
      EXPECT_NEAR(low, 0, 1e-9);
    }
}

TEST(LayPlan, SymmetricPiecesAndMirrorImagesAreCutOnTheFoldedCloth) {
  LayRoom cloth(
      "piece name=whole outline=\"M -200 0; hem L 200 0; right L 180 400; top L -180 400; left L -200 0\"\n"
      "piece name=sleeve_left outline=\"M 0 0; low L 200 0; out L 150 300; in L 0 0\" pose=\"1,0,0\"\n"
      "mirror piece=sleeve_left\n");
  LaySettings settings;
  settings.folded = true;
  const auto plan = cloth.lay(settings);
  ASSERT_TRUE(plan);
  examine(*plan, 0);
  ASSERT_EQ(plan->fabrics[0].pieces.size(), 2u);
  EXPECT_TRUE(plan->fabrics[0].pieces[0].half && plan->fabrics[0].pieces[0].onFold);
  EXPECT_TRUE(plan->fabrics[0].pieces[1].under);
  EXPECT_TRUE(plan->notes.empty());
  const auto cut = cutOf(*plan);
  for (const char* name : {"whole", "sleeve_left", "sleeve_right"}) EXPECT_EQ(cut.at(name).count, 1) << name;
}

TEST(LayPlan, RowsMeetInSeams) {
  LayRoom cloth(std::string(kPaperSkirt) + "");
  LaySettings settings;
  settings.rows = 0.05;
  const auto plan = cloth.lay(settings);
  ASSERT_TRUE(plan);
  examine(*plan, 0);
  // The hem's end of the side seam lies at one place of the repeat on the front and on both backs.
  std::vector<double> phases;
  const Document& document = plan->document;
  for (const LaidPiece& laid : plan->fabrics[0].pieces) {
    const Piece& piece = *document.find(laid.piece);
    if (piece.name == "pocket") continue;
    for (const Edge& edge : piece.outline.edges)
      if (edge.name.starts_with("side")) {
        const Flat low = edge.curve.start.v < edge.curve.end.v ? edge.curve.start : edge.curve.end;
        const double steps = laid(low).u / settings.rows;
        phases.push_back(steps - std::floor(steps + 1e-6));
      }
  }
  ASSERT_GE(phases.size(), 4u);
  for (const double phase : phases) EXPECT_NEAR(phase, phases[0], 1e-6);
}

TEST(LayPlan, SameBitsOnAnyThreads) {
  LayRoom cloth(kPaperSkirt);
  const auto first = cloth.lay({});
  Workers three(3);
  Context context{three, cloth.room.token, cloth.room.blobs, cloth.room.bodies, {}, {}};
  LaySettings settings;
  settings.tries = 160;
  const auto second = layPlan(cloth.file.document(), settings, context);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->fabrics[0].cut, second->fabrics[0].cut);
}

TEST(LayPlan, WhatIsMovedByHandIsSeenToOverlap) {
  LayRoom cloth(kPaperSkirt);
  auto plan = cloth.lay({});
  ASSERT_TRUE(plan);
  FabricLay& lay = plan->fabrics[0];
  for (Flat& p : lay.cut[1]) p += lay.cut[0][0] - lay.cut[1][0];
  const auto found = clash(lay);
  ASSERT_TRUE(found);
  for (Flat& p : lay.cut[1]) p += Flat{0, 5};
  const auto outside = clash(lay);
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->first, 1u);
  EXPECT_FALSE(outside->second);
}

// Rectangles of one height share whole sides, and copies of one piece all of them: no side crosses another.
TEST(LayPlan, OverlapsAlongSharedSidesAreSeen) {
  const auto box = [](double left, double low, double right, double high) {
    return Ring{{left, low}, {right, low}, {right, high}, {left, high}};
  };
  FabricLay lay;
  lay.pieces.resize(2);
  const auto clashes = [&](const Ring& other) {
    lay.cut = {box(1, 0, 2, 0.5), other};
    const bool found = clash(lay).has_value();
    EXPECT_EQ(clash(lay, 0).has_value(), found);
    EXPECT_EQ(clash(lay, 1).has_value(), found);
    return found;
  };
  EXPECT_TRUE(clashes(box(1, 0, 2, 0.5)));
  EXPECT_TRUE(clashes(box(1.9, 0, 2.9, 0.5)));
  EXPECT_TRUE(clashes(box(1.9999, 0, 2.9, 0.5)));
  EXPECT_TRUE(clashes(box(1.2, 0, 1.4, 0.5)));
  EXPECT_TRUE(clashes(box(1.2, 0.1, 1.4, 0.3)));
  EXPECT_TRUE(clashes(box(1, 0.49, 2, 1)));
  EXPECT_FALSE(clashes(box(2, 0, 3, 0.5)));
  EXPECT_FALSE(clashes(box(1, 0.5, 2, 1)));
  EXPECT_FALSE(clashes(box(1.999995, 0, 3, 0.5)));
  // In a bay that it fills.
  lay.cut = {{{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 0.5}, {1, 0.5}, {1, 1}, {0, 1}}, box(1, 0.5, 2, 1)};
  EXPECT_FALSE(clash(lay));
}

TEST(LayPlan, APieceMovedOrTurnedByHandLiesWhereItsCutLineLies) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    LayRoom cloth(seed % 3 == 0 ? std::string(kPaperSkirt) : anyPieces(seed));
    LaySettings settings;
    settings.width = 2;
    settings.folded = seed % 2 == 0;
    settings.allowance = 0;
    settings.rows = seed % 4 >= 2 ? 0.03 : 0;
    settings.stripes = seed % 5 >= 3 ? 0.02 : 0;
    settings.tries = 0;
    auto plan = cloth.lay(settings);
    ASSERT_TRUE(plan) << seed << text(plan.error().what);
    FabricLay& lay = plan->fabrics[0];
    const FabricLay before = lay;
    for (std::size_t i = 0; i < lay.pieces.size(); ++i) {
      const auto phases = [&](const char* doing) {
        const Flat was = before.pieces[i](before.pieces[i].reference), now = lay.pieces[i](lay.pieces[i].reference);
        const auto whole = [](double by, double repeat) {
          return repeat == 0 ? 0 : std::abs(by / repeat - std::round(by / repeat));
        };
        EXPECT_NEAR(whole(now.u - was.u, settings.rows), 0, 1e-6) << seed << doing;
        EXPECT_NEAR(whole(now.v - was.v, settings.stripes), 0, 1e-6) << seed << doing;
        for (const Edge& edge : plan->document.find(lay.pieces[i].piece)->outline.edges)
          if (const Flat p = lay.pieces[i](edge.curve.at(0.4)); !lay.pieces[i].half || p.v > 1e-3) {
            EXPECT_LT(distanceToRing(lay.cut[i], p), 2e-4) << seed << doing;
          }
        EXPECT_GT(signedArea(lay.cut[i]), 0);
      };
      moveLaid(lay, i, {0.117, 0.043}, settings);
      EXPECT_EQ(lay.pieces[i].at.v == before.pieces[i].at.v, lay.pieces[i].onFold) << seed;
      phases("moved");
      ASSERT_TRUE(turnLaid(lay, i, settings));
      EXPECT_NE(lay.pieces[i].turned, before.pieces[i].turned);
      phases("turned");
      ASSERT_TRUE(turnLaid(lay, i, settings));
      EXPECT_EQ(lay.pieces[i].over, before.pieces[i].over);
      phases("turned twice");
    }
    settings.nap = true;
    const Ring kept = lay.cut[0];
    EXPECT_FALSE(turnLaid(lay, 0, settings));
    EXPECT_EQ(lay.cut[0], kept);
  }
}

TEST(LayPlan, TellsHowFarItIs) {
  LayRoom cloth(kPaperSkirt);
  std::vector<double> told;
  const Token token([&](double share, const Message&) { told.push_back(share); });
  Context context{cloth.room.workers, token, cloth.room.blobs, cloth.room.bodies, {}, {}};
  LaySettings settings;
  settings.tries = 2000;
  ASSERT_TRUE(layPlan(cloth.file.document(), settings, context));
  ASSERT_GT(told.size(), 10u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_LT(told.front(), 0.1);
  EXPECT_GT(told.back(), 0.2);
  EXPECT_LE(told.back(), 1);
}

TEST(LayPlan, RefusesWithAReason) {
  LayRoom cloth(kPaperSkirt);
  const auto why = [&](LaySettings settings) {
    const auto plan = cloth.lay(settings);
    return plan ? std::string() : text(plan.error().what);
  };
  LaySettings settings;
  settings.width = 0.5;
  EXPECT_THAT(why(settings), HasSubstr("“front” is 62.0 cm wide across its grain, the cloth 50.0 cm"));
  settings.folded = true;
  EXPECT_THAT(why(settings), HasSubstr("the folded cloth 25.0 cm"));
  settings.width = 11;
  EXPECT_THAT(why(settings), HasSubstr("between 10 cm and 10 m"));
  settings.width = std::nan("");
  EXPECT_FALSE(why(settings).empty());
  settings = {};
  settings.fabric = "tweed";
  EXPECT_THAT(why(settings), HasSubstr("tweed"));
  settings = {};
  settings.gap = -1;
  EXPECT_FALSE(why(settings).empty());
  settings = {};
  settings.stripes = 3;
  EXPECT_FALSE(why(settings).empty());
  LayRoom none("");
  EXPECT_FALSE(none.lay({}));
  LayRoom many(
      "piece name=front outline=\"M 0 0; hem L 300 0; side L 280 600; waist L 0 600; cb L 0 0\"\n"
      "quantity piece=front count=500\n");
  EXPECT_FALSE(many.lay({}));
}

}  // namespace
}  // namespace karinui

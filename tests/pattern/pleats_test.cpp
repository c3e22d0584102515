// Pleats on paper against their closed forms, and the lattice along lines that something is sewn to.
#include "karinui/pattern/pleats.h"

#include <gtest/gtest.h>

#include <random>

#include "karinui/pattern/darts.h"
#include "karinui/pattern/markings.h"
#include "lattice_promises.h"

namespace karinui {
namespace {

using namespace test;

// A skirt panel: waist at the top, as wide as said, its top edge curved or not.
Piece panel(double width, double height, double bow = 0) {
  Piece piece = pieceOf(1, rectangle(width, height), "skirt");
  Outline& outline = piece.outline;
  outline.edges[0].name = "hem", outline.edges[2].name = "waist";
  Curve& waist = outline.edges[2].curve;
  if (bow != 0)
    waist =
        Curve::cubic(waist.start, waist.start + Flat{-width / 3, -bow}, waist.end + Flat{width / 3, -bow}, waist.end);
  return piece;
}

PleatPlan planOf(PleatKind kind, double depth, std::vector<double> at) {
  PleatPlan plan;
  plan.edge = "waist", plan.kind = kind, plan.depth = depth, plan.along = {0, -1};
  plan.at = std::move(at);
  return plan;
}

double visible(const PleatedPiece& made, const std::string& edge) {
  double sum = 0;
  for (const EdgePart& part : made.edited.edges.at({PieceId{1}, edge}))
    sum += findEdge(made.edited.piece, part.now.edge)->curve.length() * (part.now.to - part.now.from);
  return sum;
}

// A knife pleat takes twice its depth of the paper, a box or inverted pleat four times; the pleated edge is as long as
// before.
TEST(Pleats, TakeTwiceOrFourTimesTheirDepth) {
  for (const auto& [kind, times] :
       {std::pair{PleatKind::Knife, 2.0}, {PleatKind::Box, 4.0}, {PleatKind::Inverted, 4.0}})
    for (const double bow : {0.0, 0.03}) {
      const Piece before = panel(0.4, 0.5, bow);
      PleatPlan plan = planOf(kind, 0.015, {0.2, 0.5, 0.8});
      plan.toStart = {false, true, false};
      const auto made = addPleats(before, plan);
      ASSERT_TRUE(made) << text(made.error().what);
      const Outline& now = made->edited.piece.outline;
      EXPECT_NEAR(findEdge(made->edited.piece, "hem")->curve.length(), 0.4 + 3 * times * 0.015, 1e-9);
      EXPECT_NEAR(visible(*made, "waist"), before.outline.edges[2].curve.length(), 1e-9);
      EXPECT_EQ(made->folds.size(), times == 2 ? 3u : 6u);
      EXPECT_EQ(made->layers.size(), 2 * made->folds.size());
      if (bow == 0) {
        EXPECT_NEAR(now.area(), before.outline.area() + 3 * times * 0.015 * 0.5, 1e-9);
      }
      // What is sewn to each other is equally long.
      for (const auto& layer : made->layers) {
        const auto length = [&](const EdgeSpan& span) {
          return findEdge(made->edited.piece, span.edge)->curve.length() * (span.to - span.from);
        };
        EXPECT_NEAR(length(layer.a), length(layer.b), 1e-8);
      }
    }
}

// Folded, what is under the edge lies edge to edge with it, also where the edge is curved or the pleats run askew; so
// it does at the hem.
TEST(Pleats, LieEdgeToEdgeWhenFolded) {
  for (const double turn : {0.0, 0.2})
    for (const PleatKind kind : {PleatKind::Knife, PleatKind::Box, PleatKind::Inverted}) {
      const Piece before = panel(0.4, 0.5, 0.03);
      PleatPlan plan = planOf(kind, 0.012, {0.35, 0.65});
      plan.toStart = {true, false};
      plan.along = {std::sin(turn), -std::cos(turn)};
      const auto made = addPleats(before, plan);
      ASSERT_TRUE(made) << text(made.error().what);
      const Ring ring = before.outline.flattened(1e-7);
      for (const Edge& edge : made->edited.piece.outline.edges)
        for (const Flat p : edge.curve.evenly(0, 1, 20))
          EXPECT_LT(distanceToRing(ring, made->folded(p).place), 2e-6) << edge.name << " at " << p.u << ", " << p.v;
      // Every place of the old paper is where spread() says, and folds back there.
      for (double u = 0.01; u < 0.4; u += 0.013)
        for (double v = 0.05; v < 0.45; v += 0.05) {
          const Flat place{u, v};
          EXPECT_LT(distance(made->folded(made->spread(place)).place, place), 1e-9);
          EXPECT_TRUE(contains(made->edited.piece.outline.flattened(1e-5), made->spread(place)));
        }
      // The lines: a fold and where it comes to lie are one line of the flat paper.
      for (const PleatFold& fold : made->folds) {
        const Curve *first = findCurve(made->edited.piece, fold.fold),
                    *second = findCurve(made->edited.piece, fold.place);
        ASSERT_TRUE(first && second);
        for (const double f : {0.1, 0.5, 0.9})
          EXPECT_LT(distance(made->folded(first->atFraction(f) + made->across * (fold.toStart ? 1e-7 : -1e-7)).place,
                             made->folded(second->atFraction(f) + made->across * (fold.toStart ? -1e-7 : 1e-7)).place),
                    1e-6);
      }
    }
}

TEST(Pleats, OneOverTheOtherAreLiftedInOrder) {
  const Piece before = panel(0.4, 0.5);
  const auto made = addPleats(before, planOf(PleatKind::Knife, 0.02, {0.5}));
  ASSERT_TRUE(made);
  // The waist runs from right to left: the fold lies at u = 0.2, the cloth under it towards larger u.
  const auto lifted = [&](Flat place) { return made->folded(place).lifted; };
  const double across = made->across.u;
  const auto at = [&](double in) { return Flat{(0.2 * across + in) * across, 0.3}; };
  EXPECT_NEAR(made->folded(at(-0.01)).place.u, 0.21, 1e-9);
  EXPECT_NEAR(made->folded(at(0.01)).place.u, 0.21, 1e-9);
  EXPECT_NEAR(made->folded(at(0.03)).place.u, 0.21, 1e-9);
  EXPECT_GT(lifted(at(-0.01)), lifted(at(0.01)) + 0.4);
  EXPECT_GT(lifted(at(0.01)), lifted(at(0.03)) + 0.4);
}

// A kilt: pleats of depth d every s, d > s. Each takes 2 d of the paper and covers d - s of the next; the edge stays as
// long as it was, and at every place lie the layers of all pleats that cover it.
TEST(Pleats, OverlapAsAKiltsDo) {
  const Piece before = panel(0.6, 0.5);
  for (const bool toStart : {false, true})
    for (const double depth : {0.03, 0.045}) {
      constexpr double s = 0.02;
      constexpr std::size_t n = 10;
      PleatPlan plan = planOf(PleatKind::Knife, depth, {});
      for (std::size_t k = 0; k < n; ++k) plan.at.push_back((0.2 + s * static_cast<double>(k)) / 0.6);
      plan.toStart.assign(n, toStart);
      const auto made = addPleats(before, plan);
      ASSERT_TRUE(made) << text(made.error().what);
      EXPECT_TRUE(made->overlapping);
      EXPECT_NEAR(visible(*made, "waist"), 0.6, 1e-9);
      const Piece& now = made->edited.piece;
      EXPECT_NEAR(findEdge(now, "hem")->curve.length(), 0.6 + 2 * depth * n, 1e-9);
      EXPECT_EQ(pleatsOf(patternOf({now})).size(), 0u) << "nothing is sewn yet";
      // All layers of both sides are equally long, and together as long as what is folded in.
      double under = 0;
      for (const auto& layer : made->layers) {
        const auto length = [&](const EdgeSpan& span) {
          return findEdge(now, span.edge)->curve.length() * (span.to - span.from);
        };
        EXPECT_NEAR(length(layer.a), length(layer.b), 1e-7);
        under += length(layer.b);
      }
      EXPECT_NEAR(under, 2 * depth * n, 1e-6);
      // Over a place in the middle lie 1 + 2 k layers, k of the pleats that cover it; none nearer than half a layer.
      const double place = -0.6 + 0.2 + s * 4 + 0.007;  // across: the waist runs from u = 0.6 to 0
      std::vector<double> heights;
      for (double at = 0; at < 0.6 + 2 * depth * n; at += 2e-4) {
        const FoldedPlace in = made->folded(made->across * (at - 0.6) + Flat{0, 0.3});
        if (std::fabs(dot(in.place, made->across) - place) < 1.01e-4) heights.push_back(in.lifted);
      }
      std::sort(heights.begin(), heights.end());
      std::vector<double> layers;
      for (const double h : heights)
        if (layers.empty() || h - layers.back() > 0.1) layers.push_back(h);
      const auto covering =
          static_cast<std::size_t>(std::count_if(made->folds.begin(), made->folds.end(), [&](const PleatFold& fold) {
            return place > fold.low && place < fold.low + depth;
          }));
      EXPECT_GE(covering, depth > 0.04 ? 2u : 1u);
      EXPECT_EQ(layers.size(), 1 + 2 * covering);
      for (std::size_t k = 1; k < layers.size(); ++k) EXPECT_GT(layers[k] - layers[k - 1], 0.3);
    }
}

// Pleats that taper: the edge is as long as it was, and folded the cloth is wider by e (2 x - x^2) for each fold. At
// all heights a fold and where it comes to lie are one line of the folded paper, and the two folds of an inverted
// pleat.
TEST(Pleats, TaperFromTheHipToTheEdge) {
  for (const auto& [kind, times] : {std::pair{PleatKind::Knife, 1}, {PleatKind::Box, 2}, {PleatKind::Inverted, 2}})
    for (const double length : {0.0, 0.2})
      for (const double bow : {0.0, 0.03}) {
        constexpr double e = 0.012, d = 0.02;
        const Piece before = panel(0.4, 0.5, bow);
        PleatPlan plan = planOf(kind, d, {0.3, 0.7});
        plan.toStart = {false, true};
        plan.taper = e, plan.taperLength = length;
        const auto made = addPleats(before, plan);
        ASSERT_TRUE(made) << text(made.error().what);
        const Piece& now = made->edited.piece;
        EXPECT_NEAR(visible(*made, "waist"), before.outline.edges[2].curve.length(), 1e-9);
        EXPECT_NEAR(visible(*made, "hem"), 0.4 + 2 * times * e, 1e-6) << "the hem of the folded skirt";
        PleatPlan plain = plan;
        plain.taper = 0;
        EXPECT_NEAR(now.outline.area(), addPleats(before, plain)->edited.piece.outline.area(), 1e-9);
        const double top = -made->taperFrom, low = -made->taperTo;  // the lines run downwards
        EXPECT_NEAR(low, length > 0 ? top - length : 0, 1e-9);
        const double whole = 0.4 + 2 * times * 2 * d;
        const std::size_t n = made->folds.size();
        for (double v = 0.01; v < top; v += 0.0373) {
          const double x = std::min(1.0, (top - v) / (top - low)), opened = e * (2 * x - x * x);
          EXPECT_NEAR(made->opened({0.1, v}), opened, 1e-12);
          EXPECT_NEAR(distance(made->folded({0.4, v}).place, made->folded({0.4 - whole, v}).place),
                      0.4 + static_cast<double>(n) * opened, 1e-9);
          std::vector<double> fold, place;
          for (const PleatFold& f : made->folds)
            for (const bool first : {true, false}) {
              const Curve& line = *findCurve(now, first ? f.fold : f.place);
              double a = 0, b = 1;
              for (int round = 0; round < 60; ++round) (line.at((a + b) / 2).v > v ? a : b) = (a + b) / 2;
              const double beside = first == f.toStart ? 1e-8 : -1e-8;  // of the layer that is seen
              (first ? fold : place).push_back(made->folded(line.at(a) + made->across * beside).place.u);
            }
          for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(fold[k], place[k], 1e-6) << v;
          for (std::size_t k = 0; kind == PleatKind::Inverted && k < n; k += 2) EXPECT_NEAR(fold[k], fold[k + 1], 1e-6);
        }
      }
}

TEST(Pleats, RefuseATaperThatLeavesNoFold) {
  const auto why = [](double taper, bool sewnBeyond, double length = 0) {
    PleatPlan plan = planOf(PleatKind::Knife, 0.02, {0.5});
    plan.taper = taper, plan.taperLength = length, plan.sewnBeyond = sewnBeyond;
    const auto made = addPleats(panel(0.4, 0.5), plan);
    return made ? std::string() : text(made.error().what);
  };
  EXPECT_EQ(why(0.038, false), "");
  EXPECT_NE(why(0.0381, false).find("tapers by 38"), std::string::npos);
  EXPECT_NE(why(-0.01, false).find("at most"), std::string::npos);
  EXPECT_NE(why(0.01, true).find("is sewn"), std::string::npos);
  EXPECT_NE(why(0.01, false, 0.003).find("it would be 3.0 mm"), std::string::npos);
}

// Three lines on a paper that has the cloth for the pleat fold it there: the edges are what they were before the cloth
// was put in, and the paper is the one that addPleats() makes.
TEST(Pleats, AreFoldedByThreeDrawnLines) {
  for (const double bow : {0.0, 0.03})
    for (const bool toStart : {false, true}) {
      PleatPlan plan = planOf(PleatKind::Knife, 0.02, {0.4});
      plan.toStart = {toStart};
      const auto wanted = addPleats(panel(0.4, 0.5, bow), plan);
      ASSERT_TRUE(wanted);
      // The paper of someone who drew it so: one edge each, the lines inside, called otherwise.
      Piece drawn = wanted->edited.piece;
      for (InternalLine& line : drawn.lines)
        line.name = line.name == "pleat_fold" ? "f" : line.name == "pleat_inner" ? "i" : "p", line.crease.reset();
      const auto made = foldDrawn(drawn, {"f", "i", "p", {0, -1}, "pleat", false});
      ASSERT_TRUE(made) << text(made.error().what);
      EXPECT_NEAR(made->depth, 0.02, 1e-9);
      EXPECT_EQ(made->folds.size(), 1u);
      EXPECT_EQ(made->folds[0].toStart, toStart);
      EXPECT_EQ(made->layers.size(), 2u);
      EXPECT_NEAR(made->edited.piece.outline.area(), drawn.outline.area(), 1e-7);
      EXPECT_EQ(made->edited.piece.lines.size(), 3u);
      for (const Flat place : {Flat{0.05, 0.3}, Flat{0.2, 0.2}, Flat{0.25, 0.4}, Flat{0.43, 0.1}}) {
        EXPECT_LT(distance(made->folded(place).place, wanted->folded(place).place), 1e-7);
        EXPECT_NEAR(made->folded(place).lifted, wanted->folded(place).lifted, 1e-6);
        EXPECT_EQ(made->spread(place), place);
      }
    }
}

// A paper with a wedge drawn in it, from the waist to where its lines meet: `meet` above the hem (0 or less).
Piece wedged(double meet, double angle, bool toStart, bool curved) {
  const double half = angle / 2, top = 0.6 - meet;
  const Flat apex{0, meet};
  const auto at = [&](double radians, double away) {
    return apex + Flat{away * std::sin(radians), away * std::cos(radians)};
  };
  Piece piece = pieceOf(1, rectangle(0.5, 0.6, {-0.25, 0}), "skirt");
  auto& edges = piece.outline.edges;
  edges[0].name = "hem", edges[2].name = "waist";
  if (curved) {  // about the point where the lines meet
    const double wide = 0.4;
    const Flat left = at(-wide, top), right = at(wide, top);
    edges[2].curve = Curve::arc(right, left, std::tan(wide / 2));
    edges[1].curve.end = right, edges[3].curve.start = left;
  }
  const auto end = [&](double radians) { return meet == 0 ? apex : at(radians, -meet / std::cos(radians)); };
  const auto start = [&](double radians) { return at(radians, curved ? top : top / std::cos(radians)); };
  const auto line = [&](const char* name, double radians) {
    piece.lines.push_back({name, {Curve::line(start(radians), end(radians))}, {}});
  };
  line("f", toStart ? half : -half), line("i", 0), line("p", toStart ? -half : half);
  return piece;
}

// Where the three lines meet, at the hem or below it, a wedge is folded in: the waist is whole, its layers lie edge to
// edge, the fold comes to lie on its place, and what is folded keeps its lengths.
TEST(Pleats, AreFoldedByThreeLinesThatMeet) {
  for (const double meet : {0.0, -0.2, -3.0})
    for (const bool toStart : {false, true})
      for (const bool curved : {false, true})
        for (const bool sewn : {false, true}) {
          SCOPED_TRACE(testing::Message() << meet << ' ' << toStart << ' ' << curved << ' ' << sewn);
          const double angle = 0.06 / (0.6 - meet);
          const Piece before = wedged(meet, angle, toStart, curved);
          const auto made = foldDrawn(before, {"f", "i", "p", {0, -1}, "pleat", sewn});
          ASSERT_TRUE(made) << text(made.error().what);
          const Piece& now = made->edited.piece;
          ASSERT_TRUE(made->wedge);
          EXPECT_EQ(made->beyondOf, "hem");
          ASSERT_EQ(made->layers.size(), sewn && meet < 0 ? 4u : 2u);
          EXPECT_EQ(made->beyond.size(), !sewn && meet < 0 ? 2u : 0u);
          EXPECT_EQ(now.lines.size(), 3u);
          const double folded = curved ? angle * (0.6 - meet) : 2 * (0.6 - meet) * std::tan(angle / 2);
          EXPECT_NEAR(visible(*made, "waist"), before.outline.edges[2].curve.length() - folded, 1e-9);
          for (const auto& layer : made->layers) {
            const Curve &over = findEdge(now, layer.a.edge)->curve, &under = findEdge(now, layer.b.edge)->curve;
            for (int k = 0; k <= 8; ++k) {
              const double share = k / 8.0,
                           along = std::lerp(layer.a.from, layer.a.to, layer.reversed ? 1 - share : share);
              EXPECT_LT(
                  distance(made->folded(over.atFraction(along)).place, made->folded(under.atFraction(share)).place),
                  1e-6);
            }
          }
          const auto line = [&](const std::string& name) -> const Curve& { return *findCurve(now, name); };
          const auto &fold = line(made->folds[0].fold), &place = line(made->folds[0].place);
          for (int k = 0; k <= 8; ++k)
            EXPECT_LT(distance(made->folded(fold.at(k / 8.0)).place, made->folded(place.at(k / 8.0)).place), 1e-9);
          // No line is torn: places beside each other stay so, on either side of a line as well.
          std::mt19937_64 random(7);
          std::uniform_real_distribution<double> wide(-0.25, 0.25), high(0, 0.6), way(0, 6.28);
          for (int k = 0; k < 500; ++k) {
            const Flat a{wide(random), high(random)};
            const double turn = way(random);
            const Flat b = a + Flat{1e-4 * std::cos(turn), 1e-4 * std::sin(turn)};
            EXPECT_LT(distance(made->folded(a).place, made->folded(b).place), 1e-4 + 1e-9);
          }
          // Spread out again it goes as far round as before.
          const auto reopened = made->wedge->reopened(before.outline);
          const auto& edges = before.outline.edges;
          const bool atWaist = curved && meet < -1;  // of the corners those farthest round
          for (const Flat corner : {edges[atWaist ? 2 : 0].curve.start, edges[atWaist ? 2 : 0].curve.end})
            EXPECT_LT(distance(reopened(made->folded(corner).place), corner), 1e-6);
        }
}

// A pleat that runs out at the hem: folded, the paper lies as before it was slashed, whichever part stayed; the waist
// is as long as before, and the hem, which is trued where the paper was bent, nearly so.
TEST(Pleats, RunOutAtAnotherEdge) {
  for (const double at : {0.3, 0.5, 0.7})
    for (const double toAt : {0.35, 0.6, 1.0})
      for (const bool toStart : {false, true})
        for (const double bow : {0.0, 0.03})
          for (const auto stays : {Slash::Stays::Larger, Slash::Stays::Ahead, Slash::Stays::Behind}) {
            SCOPED_TRACE(testing::Message() << at << ' ' << toAt << ' ' << toStart << ' ' << bow);
            const Piece before = panel(0.4, 0.5, bow);
            Slash slash{"waist", "hem", at, toAt, 0.05};
            slash.stays = stays;
            const auto made = addPleatTo(before, slash, toStart, "pleat");
            ASSERT_TRUE(made) << text(made.error().what);
            EXPECT_NEAR(visible(*made, "waist"), findEdge(before, "waist")->curve.length(), 1e-6);
            EXPECT_NEAR(findEdge(made->edited.piece, "hem")->curve.length(), 0.4, 2e-4);
            EXPECT_EQ(made->layers.size(), 2u);
            EXPECT_EQ(made->folds.at(0).toStart, toStart);
            std::mt19937_64 random(3);
            std::uniform_real_distribution<double> wide(0, 0.4), high(0, 0.45);
            for (int k = 0; k < 200; ++k) {
              const Flat place{wide(random), high(random)};
              EXPECT_LT(distance(made->folded(made->spread(place)).place, place), 2e-4) << place.u << ' ' << place.v;
            }
            const double more = made->edited.piece.outline.area() - before.outline.area();
            EXPECT_NEAR(more, 0.05 * 0.25, 0.2 * 0.05 * 0.25 + bow * 0.05);
          }
}

TEST(Pleats, RefuseLinesThatMeetInsideOrApart) {
  const auto why = [](const Piece& piece, Flat along = {0, -1}) {
    const auto made = foldDrawn(piece, {"f", "i", "p", along, "pleat", false});
    return made ? std::string() : text(made.error().what);
  };
  const auto with = [](double meet, double inner, double narrow) {
    Piece piece = wedged(0, 0.1, false, false);
    for (InternalLine& line : piece.lines) line.curves.front().end = {0, meet};
    piece.lines[1].curves.front() = Curve::line({inner, 0.6}, {0, meet});
    piece.lines[2].curves.front().end.u += narrow;
    return piece;
  };
  EXPECT_EQ(why(with(0, 0, 0)), "");
  EXPECT_NE(why(with(0.2, 0, 0)).find("a dart"), std::string::npos);
  EXPECT_NE(why(with(0, 0.004, 0)).find("halfway"), std::string::npos);
  EXPECT_NE(why(with(0, 0, 0), {0, 1}).find("no depth"), std::string::npos);
  Piece drawn = with(0, 0, 0);
  drawn.lines.push_back({"pocket", {Curve::line({-0.1, 0.2}, {0.1, 0.2})}, {}});
  EXPECT_NE(why(drawn).find("line “pocket”"), std::string::npos);
  Piece holed = with(0, 0, 0);
  holed.holes.push_back(rectangle(0.05, 0.05, {-0.02, 0.4}));
  EXPECT_NE(why(holed).find("hole"), std::string::npos);
  Piece slanted = with(0, 0, 0);
  slanted.outline.edges[1].curve.end.v = 0.7, slanted.outline.edges[2].curve.start.v = 0.7;
  EXPECT_NE(why(slanted).find("has a step"), std::string::npos);
  Piece narrow = with(0, 0, 0);
  narrow.outline.edges[3].curve.start.u = narrow.outline.edges[2].curve.end.u = -0.04;
  EXPECT_NE(why(narrow).find("does not fit"), std::string::npos);
}

TEST(Pleats, RefuseLinesThatMakeNoPleat) {
  Piece piece = panel(0.4, 0.5);
  const auto line = [&](const char* name, double top, double low) {
    piece.lines.push_back({name, {Curve::line({top, 0.5}, {low, 0})}, {}});
  };
  line("f", 0.1, 0.1), line("i", 0.12, 0.12), line("p", 0.14, 0.14), line("askew", 0.14, 0.144),
      line("far", 0.144, 0.144);
  const auto why = [&](const char* f, const char* i, const char* p) {
    const auto made = foldDrawn(piece, {f, i, p, {0, -1}, "pleat", false});
    return made ? std::string() : text(made.error().what);
  };
  EXPECT_EQ(why("f", "i", "p"), "");
  EXPECT_NE(why("f", "i", "askew").find("halfway"), std::string::npos);
  EXPECT_NE(why("f", "i", "far").find("halfway"), std::string::npos);
  EXPECT_NE(why("f", "i", "gone").find("has no line"), std::string::npos);
  // A slanted edge would have a step when it is folded.
  piece.outline.edges[2].curve.start.v = 0.55, piece.outline.edges[1].curve.end.v = 0.55;
  EXPECT_NE(why("f", "i", "p").find("has a step"), std::string::npos);
}

TEST(Pleats, RefuseWhatMakesNoSense) {
  const Piece piece = panel(0.4, 0.5);
  const auto why = [&](const PleatPlan& plan, const Piece& on) {
    const auto made = addPleats(on, plan);
    return made ? std::string("it was not refused") : text(made.error().what);
  };
  EXPECT_NE(why(planOf(PleatKind::Box, 0.03, {0.5, 0.6}), piece).find("lie over each other"), std::string::npos);
  EXPECT_NE(why(planOf(PleatKind::Knife, 0.05, {0.05}), piece).find("does not fit"), std::string::npos);
  EXPECT_NE(why(planOf(PleatKind::Knife, 1, {0.5}), piece).find("50 cm"), std::string::npos);
  PleatPlan flat = planOf(PleatKind::Knife, 0.02, {0.5});
  flat.along = normalized(Flat{1, -0.01});
  EXPECT_FALSE(addPleats(piece, flat));
  Piece drawn = piece;
  drawn.lines.push_back({"pocket", {Curve::line({0.1, 0.2}, {0.3, 0.2})}, {}});
  EXPECT_NE(why(planOf(PleatKind::Knife, 0.02, {0.5}), drawn).find("line “pocket”"), std::string::npos);
  Piece holed = piece;
  holed.holes.push_back(rectangle(0.05, 0.05, {0.18, 0.2}));
  EXPECT_NE(why(planOf(PleatKind::Knife, 0.02, {0.5}), holed).find("hole"), std::string::npos);
}

Pattern pleatedPattern(const Piece& piece, const PleatedPiece& made) {
  Pattern pattern = patternOf({made.edited.piece});
  std::uint64_t id = 10;
  for (const auto& layer : made.layers)
    pattern.seams[{id}] = {{id}, "", {layer.a}, {layer.b}, layer.reversed, Seam::Tie::Pleat}, ++id;
  return piece.id ? pattern : Pattern();
}

// Marked on paper: notches at the fold and at its place, an arrow from one to the other, its depth in words; no dart.
TEST(Pleats, AreMarkedOnPaper) {
  const Piece before = panel(0.4, 0.5);
  const auto made = addPleats(before, planOf(PleatKind::Knife, 0.02, {0.3, 0.7}));
  ASSERT_TRUE(made);
  const Pattern pattern = pleatedPattern(before, *made);
  EXPECT_TRUE(dartsOf(pattern).empty());
  const auto pleats = pleatsOf(pattern);
  ASSERT_EQ(pleats.size(), 2u);
  for (const PaperPleat& pleat : pleats) {
    EXPECT_NEAR(distance(pleat.fold, pleat.place), 0.04, 1e-9);
    EXPECT_NEAR(distance(pleat.fold, pleat.inner), 0.02, 1e-9);
    EXPECT_LT(distance(pleat.along, {0, -1}), 1e-9);
  }
  EXPECT_EQ(notchPlaces(pattern).size(), 4u);
  for (const PaperArrow& arrow : pleatArrows(pattern))
    EXPECT_NEAR(distance(arrow.shaft.from, arrow.shaft.to), 0.04, 1e-9);
  EXPECT_EQ(notesOf(pattern, {}).size(), 2u);
  EXPECT_TRUE(seamTags(pattern).empty());
}

// Three layers are one point each at the edge.
TEST(Lay, tiesTheThreeLayersOfAPleat) {
  const Piece before = panel(0.4, 0.3);
  const auto made = addPleats(before, planOf(PleatKind::Knife, 0.03, {0.5}));
  ASSERT_TRUE(made);
  const auto laid = lay(pleatedPattern(before, *made), 0.01);
  ASSERT_TRUE(laid) << text(laid.error().what);
  const Lattice& lattice = *laid->lattices.at({1});
  EXPECT_EQ(laid->ties.size(), 7u);  // of four places the one at the fold is one node already, the one inside likewise
  for (const SeamTie& tie : laid->ties)
    EXPECT_LT(distance(made->folded(lattice.nodes[tie.a]).place, made->folded(lattice.nodes[tie.b]).place), 1e-7);
}

// A line that something is sewn to has nodes of its own along it, which the cloth on both sides shares.
TEST(Lay, followsALineThatIsSewnTo) {
  Piece skirt = panel(0.3, 0.3), pocket = pieceOf(2, rectangle(0.1, 0.12), "pocket");
  const auto at = [](Flat p) { return p + Flat{0.093, 0.081}; };
  Seam seam{{5}, "", {}, {}, false, Seam::Tie::OneToOne};
  for (const std::size_t k : {3u, 0u, 1u}) {
    const Edge& edge = pocket.outline.edges[k];
    skirt.lines.push_back({"line" + std::to_string(k), {Curve::line(at(edge.curve.start), at(edge.curve.end))}, {}});
    seam.a.push_back({{2}, edge.name, 0, 1});
    seam.b.push_back({{1}, skirt.lines.back().name, 0, 1});
  }
  Pattern pattern = patternOf({skirt, pocket});
  const auto plain = lay(pattern, 0.01);
  pattern.seams[seam.id] = seam;
  for (const double spacing : {0.04, 0.02, 0.01, 0.005}) {
    const auto laid = lay(pattern, spacing);
    ASSERT_TRUE(laid) << text(laid.error().what);
    const Lattice &base = *laid->lattices.at({1}), &patch = *laid->lattices.at({2});
    expectSound(base, "skirt");
    double area = 0;
    for (const Triangle& f : base.faces)
      area += 0.5 * cross(base.nodes[f[1]] - base.nodes[f[0]], base.nodes[f[2]] - base.nodes[f[0]]);
    EXPECT_NEAR(area, 0.09, 1e-9);
    EXPECT_EQ(laid->ties.size(),
              patch.edges.at("left").count + patch.edges.at("bottom").count + patch.edges.at("right").count + 1);
    for (const SeamTie& tie : laid->ties) {
      ASSERT_EQ(tie.pieceA, PieceId{2});
      EXPECT_LT(distance(at(patch.nodes[tie.a]), base.nodes[tie.b]), 1e-6);
      // Cloth on all sides of it: the angles of the faces there make a full turn.
      double turn = 0;
      for (const Triangle& f : base.faces)
        for (int c = 0; c < 3; ++c)
          if (f[c] == tie.b) {
            const Flat u = base.nodes[f[(c + 1) % 3]] - base.nodes[tie.b],
                       v = base.nodes[f[(c + 2) % 3]] - base.nodes[tie.b];
            turn += std::atan2(cross(u, v), dot(u, v));
          }
      EXPECT_NEAR(turn, 2 * std::numbers::pi, 1e-6);
    }
  }
  // Nothing sewn to them, lines change nothing.
  pattern.seams.clear();
  EXPECT_EQ(lay(pattern, 0.01)->lattices.at({1})->nodes, plain->lattices.at({1})->nodes);
  Pattern without = patternOf({panel(0.3, 0.3)});
  EXPECT_EQ(lay(without, 0.01)->lattices.at({1})->nodes, plain->lattices.at({1})->nodes);
}

// A closed line too small for a cell within it has cloth inside all the same.
TEST(Lay, fillsASmallRoundOfLines) {
  Piece skirt = panel(0.3, 0.3);
  const Piece badge = pieceOf(2, circle(0.012));
  for (const Edge& edge : circle(0.012, {0.13, 0.17}).edges)
    skirt.lines.push_back({"on_" + edge.name, {edge.curve.reversed()}, {}});
  Pattern pattern = patternOf({skirt, badge});
  std::uint64_t id = 4;
  for (const Edge& edge : badge.outline.edges)
    pattern.seams[{++id}] = {
        {id}, "", {{{2}, edge.name, 0, 1}}, {{{1}, "on_" + edge.name, 0, 1}}, true, Seam::Tie::OneToOne};
  for (const double spacing : {0.04, 0.02, 0.01}) {
    const auto laid = lay(pattern, spacing);
    ASSERT_TRUE(laid) << text(laid.error().what);
    const Lattice& base = *laid->lattices.at({1});
    double area = 0;
    for (const Triangle& f : base.faces)
      area += 0.5 * cross(base.nodes[f[1]] - base.nodes[f[0]], base.nodes[f[2]] - base.nodes[f[0]]);
    EXPECT_NEAR(area, 0.09, 1e-9) << spacing;
  }
}

// A line from edge to edge ends in nodes of the outline.
TEST(Lay, followsALineFromEdgeToEdge) {
  const Piece before = panel(0.4, 0.3);
  const auto made = addPleats(before, planOf(PleatKind::Knife, 0.03, {0.5}));
  ASSERT_TRUE(made);
  Pattern pattern = pleatedPattern(before, *made);
  const PleatFold& fold = made->folds.front();
  pattern.seams[{3}] = {{3}, "", {{{1}, fold.fold, 0, 0.4}}, {{{1}, fold.place, 0, 0.4}}, false, Seam::Tie::OneToOne};
  for (const double spacing : {0.04, 0.02, 0.01}) {
    const auto laid = lay(pattern, spacing);
    ASSERT_TRUE(laid) << text(laid.error().what);
    const Lattice& lattice = *laid->lattices.at({1});
    expectSound(lattice, "skirt");
    const auto& line = lattice.edges.at(fold.fold);
    for (const std::uint32_t end : {line.nodes.front(), line.nodes.back()})
      EXPECT_NE(std::find(lattice.border.begin(), lattice.border.end(), end), lattice.border.end());
    for (const SeamTie& tie : laid->ties) EXPECT_NEAR(lattice.nodes[tie.a].v, lattice.nodes[tie.b].v, 1e-6);
  }
}

// Cut through, a line that is sewn to is divided, and each part goes with its cloth.
TEST(Cut, dividesALineThatIsSewnTo) {
  Piece skirt = panel(0.3, 0.3);
  skirt.lines.push_back({"strap", {Curve::line({0.05, 0.05}, {0.05, 0.25})}, {}});
  skirt.lines.push_back({"drawn", {Curve::line({0.1, 0.05}, {0.1, 0.25})}, {}});
  const auto cut = cutPiece(skirt, {{-0.01, 0.1}, {0.31, 0.1}}, {2}, "lower", {"strap"});
  ASSERT_TRUE(cut) << text(cut.error().what);
  const auto& parts = cut->edges.at({PieceId{1}, "strap"});
  ASSERT_EQ(parts.size(), 2u);
  double whole = 0;
  for (const EdgePart& part : parts) {
    const Piece& piece = part.now.piece == PieceId{1} ? cut->pieces[0] : cut->pieces[1];
    const Curve* curve = findCurve(piece, "strap");
    ASSERT_TRUE(curve);
    EXPECT_NEAR(curve->length(), 0.2 * (part.to - part.from), 1e-9);
    EXPECT_TRUE(contains(piece.outline.flattened(), curve->at(0.5)));
    whole += curve->length();
  }
  EXPECT_NEAR(whole, 0.2, 1e-9);
  EXPECT_NEAR(parts[0].to, 0.25, 1e-9);
  EXPECT_TRUE(findCurve(cut->pieces[0], "drawn"));  // others stay as they were, on the side of their middle
  EXPECT_FALSE(findCurve(cut->pieces[1], "drawn"));
}

}  // namespace
}  // namespace karinui

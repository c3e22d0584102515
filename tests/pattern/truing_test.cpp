#include "karinui/pattern/truing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "karinui/pattern/edit.h"
#include "support.h"

namespace karinui {
namespace {

// Two panels sewn at the right of the one and the left of the other; the tops rise to the seam by so many degrees each.
Pattern panels(double height, double rise, double fall) {
  const auto degrees = [](double angle) { return std::tan(angle * std::numbers::pi / 180); };
  const Piece left =
      test::pieceOf(1, test::polygon({{0, 0}, {0.2, 0}, {0.2, 0.3}, {0, 0.3 - 0.2 * degrees(rise)}}), "left");
  const Piece right =
      test::pieceOf(2, test::polygon({{0, 0}, {0.2, 0}, {0.2, height - 0.2 * degrees(fall)}, {0, height}}), "right");
  Pattern pattern = test::patternOf({left, right});
  pattern.seams[{9}] = {{9}, "side", {{{1}, "e1", 0, 1}}, {{{2}, "e3", 0, 1}}, true, Seam::Tie::OneToOne};
  return pattern;
}

TEST(Truing, WalksTheSidesAgainstEachOther) {
  EXPECT_EQ(truing(panels(0.3, 0, 0)).faults(), 0u);
  EXPECT_EQ(truing(panels(0.3014, 0, 0)).faults(), 0u) << "a millimetre and a half is nothing";
  for (const double height : {0.31, 0.29}) {
    const TruingReport report = truing(panels(height, 0, 0));
    ASSERT_EQ(report.seams.size(), 1u);
    EXPECT_NEAR(report.seams[0].a, 0.3, 1e-12);
    EXPECT_NEAR(report.seams[0].b, height, 1e-12);
    EXPECT_NEAR(report.seams[0].off(), 0.01, 1e-12);
    EXPECT_EQ(report.faults(), 1u);
    EXPECT_EQ(truing(panels(height, 0, 0), {{{9}, 0.01}}).faults(), 0u) << "declared";
    EXPECT_NEAR(truing(panels(height, 0, 0), {{{9}, 0.02}}).seams[0].off(), -0.01, 1e-12) << "less than declared";
  }
  Pattern gathered = panels(0.6, 0, 0);
  gathered.seams[{9}].tie = Seam::Tie::TwoToOne;
  EXPECT_EQ(truing(gathered).faults(), 0u);
  EXPECT_NEAR(truing(gathered, {{{9}, 0.2}}).seams[0].off(), 0.1, 1e-12);
}

TEST(Truing, LinesGoOnSmoothlyAcrossASeam) {
  // At the hem both corners are square. At the top they are 90 - rise and 90 - fall.
  for (const auto& [rise, fall] : {std::pair{0.0, 0.0}, {12.0, -12.0}, {2.0, 0.5}}) {
    const TruingReport report = truing(panels(0.3, rise, fall));
    ASSERT_EQ(report.corners.size(), 2u);
    EXPECT_NEAR(report.corners[0].off(), 0, 1e-9);
    EXPECT_NEAR(report.corners[1].off(), -rise - fall, 1e-9);
    EXPECT_EQ(report.faults(), 0u) << rise;
  }
  const TruingReport notch = truing(panels(0.3, -8, -3)), point = truing(panels(0.3, 10, 5));
  EXPECT_NEAR(notch.corners[1].off(), 11, 1e-9);
  EXPECT_NEAR(point.corners[1].off(), -15, 1e-9);
  EXPECT_EQ(point.corners[1].a.edge, "e2");
  EXPECT_EQ(point.corners[1].b.edge, "e2");
  EXPECT_LT(distance(point.corners[1].a.place, {0.2, 0.3}), 1e-12);
  EXPECT_LT(distance(point.corners[1].b.place, {0, 0.3}), 1e-12);
  EXPECT_EQ(notch.faults(), 1u);
  EXPECT_EQ(truing(panels(0.3, 30, 30)).corners.size(), 1u) << "a corner that is meant";
}

TEST(Truing, ADartIsTruedAtItsMouth) {
  const Piece piece = test::pieceOf(1, test::rectangle(0.3, 0.2));
  for (const double width : {0.02, 0.04}) {
    const auto dart = addDart(piece, "top", 0.5, width, {0.15, 0.1}, "dart");
    ASSERT_TRUE(dart);
    Pattern pattern = test::patternOf({dart->edited.piece});
    pattern.seams[{9}] = {{9}, "", {{{1}, dart->to, 0, 1}}, {{{1}, dart->back, 0, 1}}, true, Seam::Tie::OneToOne};
    const TruingReport report = truing(pattern);
    // At the mouth alone: the point is one corner. The top is straight, so that closing the dart bends it by its angle.
    ASSERT_EQ(report.corners.size(), 1u);
    const double leg = std::atan2(0.1, width / 2) * 180 / std::numbers::pi;
    EXPECT_NEAR(report.corners[0].off(), 180 - 2 * leg, 1e-6) << width;
    EXPECT_TRUE(report.seams[0].fits());
  }
}

// The edges beside the seam bend near it, and only there.
TEST(Truing, TruedEdgesGoOnSmoothly) {
  for (const double rise : {12.0, -12.0}) {
    Pattern pattern = panels(0.3, rise, rise / 2);
    const TruingReport report = truing(pattern);
    ASSERT_EQ(report.corners.size(), 2u);
    const CornerTruing corner = std::abs(report.corners[0].off()) > 1 ? report.corners[0] : report.corners[1];
    EXPECT_NEAR(std::abs(corner.off()), 18, 1e-6);
    for (const CornerTruing::Side* side : {&corner.a, &corner.b}) {
      Piece piece = *pattern.pieces.at(side->piece);
      Edge& edge = piece.outline.edges[*piece.outline.find(side->edge)];
      const Curve was = edge.curve;
      edge.curve = truedEdge(piece.outline, *side, corner.off(), 0.08);
      EXPECT_EQ(edge.curve.start, was.start);
      EXPECT_EQ(edge.curve.end, was.end);
      EXPECT_NEAR(edge.curve.length(), was.length(), kFits / 2);
      const bool atEnd = side->place == was.end;
      const double far = atEnd ? 0.3 : 0.7;  // of 20 cm
      EXPECT_NEAR(cross(normalized(was.end - was.start), edge.curve.atFraction(far) - was.start), 0, 1e-9)
          << "beyond 8 cm it stays";
      pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
    }
    EXPECT_EQ(truing(pattern).faults(), 0u);
    for (const CornerTruing& now : truing(pattern).corners) EXPECT_NEAR(now.off(), 0, 1e-6);
  }
}

TEST(Truing, ASeamThatGoesOnHasNoCorner) {
  Pattern pattern = panels(0.3, 20, 0);
  pattern.seams[{10}] = {{10}, "top", {{{1}, "e2", 0, 1}}, {{{2}, "e2", 0, 1}}, true, Seam::Tie::OneToOne};
  const TruingReport report = truing(pattern);
  for (const CornerTruing& corner : report.corners) EXPECT_FALSE(corner.seam == SeamId{9} && corner.a.edge == "e2");
}

}  // namespace
}  // namespace karinui

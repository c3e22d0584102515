#include "karinui/session/tape.h"

#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

// Two panels 40 cm wide hang 30 cm apart round an egg.
class Tapes : public testing::Test {
 protected:
  void SetUp() override {
    const auto lines = parseScript(kTwoPieces);
    Document document;
    for (const ScriptLine& line : *lines) {
      auto next = apply(document, line.operation, room.context);
      ASSERT_TRUE(next) << text(next.error().what);
      document = *next;
    }
    auto body = Body::make(egg());
    ASSERT_TRUE(body);
    fitting = snapshotOf(document, *body);
  }
  Tape along(Ray ray) {
    PointerSample sample;
    sample.ray = ray;
    return tapeAt(*fitting, pick(*fitting, TableLayout(), sample));
  }
  Workroom room;
  SnapshotPtr fitting;
};

TEST_F(Tapes, OnClothGoesRoundTheGarment) {
  const Tape tape = along({{0.2, 0.2, 2}, {0, 0, -1}});
  // Round both panels: a box 80 cm by 30 cm, for the back hangs from 0 to -40 cm.
  EXPECT_NEAR(tape.length, 2 * std::hypot(0.4, 0.3) + 2 * 0.4, 0.02);
  ASSERT_FALSE(tape.line.empty());
  EXPECT_EQ(tape.line.front(), tape.line.back());
}

TEST_F(Tapes, OnSkinGoesRoundTheBody) {
  const Tape tape = along({{0, 0.8, 2}, {0, 0, -1}});
  // Ramanujan's ellipse with half axes 15 cm and 12 cm.
  const double h = std::pow(0.03 / 0.27, 2);
  EXPECT_NEAR(tape.length, std::numbers::pi * 0.27 * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h))), 0.005);
}

TEST_F(Tapes, BesideEverythingMeasuresNothing) { EXPECT_TRUE(along({{2, 0.8, 2}, {0, 0, -1}}).line.empty()); }

}  // namespace
}  // namespace karinui

// Fronts that are sewn to each other are opened, lap and are buttoned, in one step.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"
#include "karinui/pattern/seam_walk.h"
#include "karinui/pattern/truing.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

struct ShirtToButton {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::string said;
  ShirtToButton() {
    room.context.advise = [this](const Advice& one) { said += text(one.what) + "\n"; };
    EXPECT_EQ(play("body size=eu38\nblock kind=shirt\n"), "");
    said.clear();
  }
  std::string play(const std::string& script) {
    const Done done = room.play(file, script);
    return done ? "" : text(done.error().what);
  }
  const Document& document() const { return file.document(); }
  double length(const char* piece, const char* edge) const {
    return findEdge(*document().pieceNamed(piece), edge)->curve.length();
  }
  const Seam* seam(const char* name) const {
    for (const auto& [id, one] : document().pattern.seams)
      if (one.name == name) return &one;
    return nullptr;
  }
};

constexpr const char* kButtoned = "fasten a=front_right.centre b=front_left.centre count=7 last=8cm stand=15mm\n";

TEST(ButtonStand, TheFrontsOpenLapAndAreButtonedInOneStep) {
  ShirtToButton shirt;
  const double neck = shirt.length("front_left", "neck"), hem = shirt.length("front_left", "hem");
  const double low = shirt.length("collar", "low"), top = shirt.length("collar", "top");
  const Flat was = findEdge(*shirt.document().pieceNamed("front_right"), "centre")->curve.atFraction(0.5);
  const std::size_t seams = shirt.document().pattern.seams.size();
  const std::uint64_t steps = shirt.document().operations;
  ASSERT_EQ(shirt.play(kButtoned), "");
  EXPECT_EQ(shirt.document().operations, steps + 1);
  EXPECT_EQ(shirt.seam("opening"), nullptr);
  EXPECT_EQ(shirt.document().pattern.seams.size(), seams - 2) << "the opening, and the ends of the collar";
  EXPECT_NEAR(shirt.length("front_left", "hem"), hem + 0.015, 1e-3);
  EXPECT_NEAR(shirt.length("front_right", "hem"), shirt.length("front_left", "hem"), 1e-6);
  const double gained = shirt.length("front_left", "neck") - neck;
  EXPECT_GT(gained, 0.01);
  EXPECT_NEAR(shirt.length("collar", "low"), low + 2 * gained, 1e-4) << "the collar laps as the fronts do";
  EXPECT_NEAR(shirt.length("collar", "top"), top + 2 * gained, 1e-3);
  const TruingReport report = truing(shirt.document().pattern, shirt.document().eases);
  for (const SeamTruing& one : report.seams) EXPECT_TRUE(one.fits());
  ASSERT_EQ(shirt.document().allowances.fastenings.size(), 1u);
  const Fastening& buttons = shirt.document().allowances.fastenings.begin()->second;
  EXPECT_EQ(buttons.at.size(), 7u);
  EXPECT_EQ(buttons.closed, 7);
  for (const FastenedPlaces& at : placesOf(shirt.document().pattern, buttons))
    EXPECT_NEAR(at.a.place.u, was.u, 1e-6) << "where the fronts met";
  EXPECT_GT(shirt.document().pieceNamed("front_right")->layer, shirt.document().pieceNamed("front_left")->layer);
  EXPECT_THAT(shirt.said, HasSubstr("Let out by 15.0 mm, to lap"));
}

TEST(ButtonStand, AFreeEdgeLapsToo) {
  ShirtToButton shirt;
  ASSERT_EQ(shirt.play("unsew seam=opening\nremove piece=collar\n"), "");
  const double hem = shirt.length("front_left", "hem");
  ASSERT_EQ(shirt.play(kButtoned), "");
  EXPECT_NEAR(shirt.length("front_left", "hem"), hem + 0.015, 1e-3);
}

TEST(ButtonStand, WhatHasNoneIsRefused) {
  ShirtToButton shirt;
  EXPECT_THAT(shirt.play("fasten kind=zip a=front_right.centre b=front_left.centre stand=15mm\n"),
              HasSubstr("Only buttons and snaps have a stand"));
  EXPECT_THAT(shirt.play("fasten a=front_right.centre b=front_left.centre stand=15cm\n"), HasSubstr("4 to 100 mm"));
  EXPECT_THAT(shirt.play("fasten a=front_right.centre@0:0.5 b=front_left.centre@0.5:1 stand=15mm\n"),
              HasSubstr("along whole edges"));
  EXPECT_THAT(shirt.play("fasten a=front_right.centre b=front_left.centre\n"), HasSubstr("sewn to another edge"));
}

}  // namespace
}  // namespace karinui

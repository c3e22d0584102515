// A garment at rest in one pose beside another: what is measured, and that nothing else happens.
#include "karinui/session/fit_in_motion.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "design/workroom.h"

namespace karinui {
namespace {

// The tunic of examples/first_tunic.ops; a drape leaves it where it is, but for `lift` of each.
struct Fitting {
  Workers workers{1};
  Token token;
  MemoryBlobs blobs;
  std::vector<double> lift;  // metres, of the drapes in turn; then none
  std::size_t drapes = 0;
  static Bodies& bodies() {
    static Bodies all;
    return all;
  }
  Context context{workers,
                  token,
                  blobs,
                  bodies(),
                  [this](const Document& document, const DrapePieces&, Context&) { return draped(document); },
                  {}};

  Result<DrapeOutcome> draped(const Document& document) {
    std::vector<PieceRef> live;
    for (const auto& [id, piece] : document.pattern.pieces) live.push_back(PieceRef(id));
    DrapeOutcome outcome = *fallABit(document, live);
    for (auto& [id, form] : outcome.forms) {
      auto moved = std::make_shared<Form>(*form);
      for (Vec3& p : moved->space) p.y += 0.01 + (drapes < lift.size() ? lift[drapes] : 0);
      form = moved;
    }
    ++drapes;
    return outcome;
  }
  const Document& tunic() {
    static const Document made = [this] {
      std::ifstream file(std::string(KARINUI_SOURCE_DIR) + "/examples/first_tunic.ops");
      std::stringstream all;
      all << "set spacing=40mm\n" << file.rdbuf();
      Document document;
      const auto lines = parseScript(all.str());
      for (const ScriptLine& line : *lines) {
        auto next = apply(document, line.operation, context);
        EXPECT_TRUE(next) << text(next.error().what);
        if (next) document = *std::move(next);
      }
      return document;
    }();
    drapes = 0;
    return made;
  }
};

double slid(const FitInPose& fit, OpenEdge edge) { return fit.slid[static_cast<std::size_t>(edge)].value(); }

TEST(FitInMotion, TellsHowFarOpenEdgesSlideOverTheSkin) {
  Fitting fitting;
  const Document& tunic = fitting.tunic();
  fitting.lift = {0, 0.03};
  const std::string before = hash(tunic) + drapeHash(tunic);
  const auto fits = fitInMotion(tunic, {"A", "arms_down", "arms_down"}, fitting.context);
  ASSERT_TRUE(fits) << text(fits.error().what);
  ASSERT_EQ(fits->size(), 4u);
  EXPECT_EQ(hash(tunic) + drapeHash(tunic), before) << "the garment is left as it is";
  EXPECT_EQ(fitting.drapes, 2u) << "it rests in its own pose already";
  for (const OpenEdge edge : {OpenEdge::Neck, OpenEdge::Hem}) {
    EXPECT_EQ(slid(fits->at(0), edge), 0);
    EXPECT_EQ(slid(fits->at(1), edge), 0) << "the pose in which it stands";
    EXPECT_LT(std::abs(slid(fits->at(2), edge)), 0.02) << "it was carried along";
  }
  EXPECT_NEAR(slid(fits->at(3), OpenEdge::Hem) - slid(fits->at(2), OpenEdge::Hem), 0.03, 0.004);
  for (const OpenEdge edge : {OpenEdge::Waist, OpenEdge::Cuff})
    EXPECT_FALSE(fits->at(2).slid[static_cast<std::size_t>(edge)]) << "a tunic has no such edge";
  EXPECT_TRUE(fits->at(1).body->pose().empty());
  EXPECT_FALSE(fits->at(2).body->pose().empty());
  for (const FitInPose& fit : *fits) {
    EXPECT_TRUE(fit.settled);
    EXPECT_EQ(fit.body->pose(), fit.document.body.pose);
    EXPECT_EQ(fit.strain.max, examined(fit.document, fitting.context)->strain.max);
    EXPECT_TRUE(fit.pressure);
  }
}

TEST(FitInMotion, RefusesBeforeTheLongWork) {
  Fitting fitting;
  const auto unknown = fitInMotion(fitting.tunic(), {"T", "cartwheel"}, fitting.context);
  ASSERT_FALSE(unknown);
  EXPECT_NE(text(unknown.error().what).find("cartwheel"), std::string::npos);
  EXPECT_EQ(fitting.drapes, 0u);
  for (const std::vector<std::string>& poses : {std::vector<std::string>{"T"}, {}}) {
    const auto bodiless = fitInMotion(Document(), poses, fitting.context);
    ASSERT_FALSE(bodiless);
    EXPECT_NE(text(bodiless.error().what).find("no body yet"), std::string::npos) << text(bodiless.error().what);
  }
}

}  // namespace
}  // namespace karinui

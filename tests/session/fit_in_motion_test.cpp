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

// A pose that one figure cannot take says so in its place; what was worked out for the others is not lost.
TEST(FitInMotion, APoseThatCannotBeTakenIsToldBesideTheOthers) {
  Fitting fitting;
  const auto figure =
      parseOperation("body sex=female set=\"height=160cm; bust_girth=130cm; belly_girth=150cm; hip_girth=130cm\"");
  ASSERT_TRUE(figure);
  const auto tunic = apply(fitting.tunic(), *figure, fitting.context);
  ASSERT_TRUE(tunic) << text(tunic.error().what);
  std::vector<std::string> told;
  const auto fits =
      fitInMotion(*tunic, {"seated", "T"}, fitting.context, [&](const FitInPose& fit) { told.push_back(fit.name); });
  ASSERT_TRUE(fits) << text(fits.error().what);
  ASSERT_EQ(fits->size(), 3u);
  ASSERT_TRUE(fits->at(1).refused);
  EXPECT_NE(text(*fits->at(1).refused).find("Seated"), std::string::npos);
  EXPECT_FALSE(fits->at(2).refused);
  EXPECT_TRUE(fits->at(2).garment);
  EXPECT_EQ(told, (std::vector<std::string>{"", "seated", "T"}));
  const std::string csv = csvOf(*fits);
  EXPECT_NE(csv.find("seated,no,,,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("flesh"), std::string::npos) << csv;
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

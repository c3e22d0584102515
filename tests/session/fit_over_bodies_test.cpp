// A garment made to one figure after another: the steps are done on each, and whom it does not fit is told.
#include "karinui/session/fit_over_bodies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

// A band that is as wide as the figure's hips ask for, and a pocket drawn on its paper.
const char* const kBand =
    "body size=jis9ar\n"
    "piece name=band outline=\"M 0 0; low L (hip_girth/2) 0; right L (hip_girth/2) 200; top L 0 200; left L 0 0\" "
    "pose=\"-0.2,0.8,0.3\"\n"
    "drape\n";

struct Tried {
  static Bodies& bodies() {  // figures are built once for all
    static Bodies shared;
    return shared;
  }
  Workroom own;
  struct {
    Workers& workers;
    Context context;
  } room{own.workers, {own.workers, own.token, own.blobs, bodies(), own.context.drape, own.context.pull}};
  DocumentFile file = DocumentFile::inMemory();
  RecipePtr recipe;
  Tried() {
    const auto lines = parseScript(kBand);
    for (const ScriptLine& line : *lines) {
      const auto done = file.perform(line.operation, room.context);
      EXPECT_TRUE(done) << text(done.error().what);
    }
    auto found = recipeOf(file, room.context);
    EXPECT_TRUE(found);
    recipe = *found;
  }
};

TEST(FitOverBodies, EachIsMadeToItsOwnMeasures) {
  Tried tried;
  const Measurements own = tried.file.document().body.measurements;
  SetBody nobody;
  nobody.set = {{"bust_girth", {5}}};
  std::vector<std::string> told;
  const std::string before = tried.file.log() + hash(tried.file.document());
  const auto fits = fitOverBodies(
      *tried.recipe, {{"as she is", figureOf(own)}, {"wider", figureOf(widened(own, 0.06))}, {"giant", nobody}},
      tried.room.context, [&](const FitOnBody& fit) { told.push_back(fit.name); });
  ASSERT_TRUE(fits) << text(fits.error().what);
  EXPECT_EQ(told, (std::vector<std::string>{"as she is", "wider", "giant"}));
  EXPECT_EQ(tried.file.log() + hash(tried.file.document()), before) << "the garment is left as it is";
  const auto low = [](const FitOnBody& fit) {
    return fit.document.pieceNamed("band")->outline.edges[0].curve.length();
  };
  EXPECT_NEAR(low(fits->at(1)) - low(fits->at(0)), 0.03, 1e-6);
  EXPECT_EQ(hash(fits->at(0).document), hash(tried.file.document()));
  ASSERT_TRUE(fits->at(1).body && fits->at(1).garment);
  EXPECT_EQ(fits->at(2).fault, FitFault::Refused);
  EXPECT_THAT(text(faultSaid(fits->at(2))), HasSubstr("refused: "));
  const std::string csv = csvOf(*fits);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_THAT(csv, HasSubstr("body,fits,fault,by,where"));
  EXPECT_THAT(csv, HasSubstr("\r\ngiant,no,refused,"));
}

TEST(FitOverBodies, TellsWhereAndByHowMuchItIsTooSmall) {
  Tried tried;
  tried.room.context.drape = [](const Document& document, const DrapePieces& op, Context&) {
    auto outcome = fallABit(document, op.live);
    outcome->report.why =
        say("Too small by {0} {1}: it is {2} round and can be stretched to {3}, the body is {4}. Add "
            "width there, choose a cloth that stretches more, or leave a seam open.",
            say("{0} cm", "3"), say("at the waist"), say("{0} cm", "60"), say("{0} cm", "62"), say("{0} cm", "65"));
    outcome->report.settled = false;
    return outcome;
  };
  const auto fits =
      fitOverBodies(*tried.recipe, {{"she", figureOf(tried.file.document().body.measurements)}}, tried.room.context);
  ASSERT_TRUE(fits) << text(fits.error().what);
  EXPECT_EQ(fits->at(0).fault, FitFault::TooSmall);
  EXPECT_NEAR(fits->at(0).by, 0.03, 1e-12);
  EXPECT_EQ(text(faultSaid(fits->at(0))), "too small: 3 cm, at the waist");
}

TEST(FitOverBodies, IsStopped) {
  Tried tried;
  Token token;
  Context own{tried.room.workers, token, tried.own.blobs, Tried::bodies(), tried.room.context.drape, {}};
  token.cancel();
  const auto fits = fitOverBodies(*tried.recipe, {{"she", figureOf(tried.file.document().body.measurements)}}, own);
  ASSERT_FALSE(fits);
  EXPECT_EQ(fits.error().kind, Error::Kind::Cancelled);
  DocumentFile empty = DocumentFile::inMemory();
  EXPECT_FALSE(recipeOf(empty, tried.room.context));
}

}  // namespace
}  // namespace karinui

// The solver alone, on made-up bodies whose measurements are known functions of the alteration.
#include "body/figure_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/shapes.h"

namespace karinui {
namespace {

using test::Numbers;

const std::vector<std::string> kKeys{"bust_girth",   "waist_girth",   "hip_girth",   "neck_girth",
                                     "waist_height", "crotch_height", "wrist_girth", "calf_girth"};

// A body whose every measurement answers to its own parameter and, a little and not linearly, to all others.
struct MadeUpBody {
  std::map<std::string, double> drawn;
  std::map<std::string, std::map<std::string, double>> coupling;

  explicit MadeUpBody(Numbers& numbers) {
    for (const std::string& key : kKeys) {
      drawn[key] = numbers.between(0.3, 1.1);
      for (const std::string& other : kKeys)
        if (other != key) coupling[key][other] = numbers.between(-0.12, 0.12);
    }
  }
  Anthropometry at(const Alteration& by) const {
    Anthropometry found;
    const auto amount = [&](const std::string& key) {
      const auto it = by.find(parameterOf(key));
      return it == by.end() ? 0 : it->second;
    };
    for (const std::string& key : kKeys) {
      double off = amount(key);
      for (const auto& [other, share] : coupling.at(key)) off += share * std::sin(amount(other));
      found.value[key] = key.ends_with("_girth") ? drawn.at(key) * std::exp(off) : drawn.at(key) + off;
    }
    return found;
  }
};

// What measures one figure, for each of several.
template <class One>
FigureSolver::Evaluate each(One one) {
  return [one](std::span<const Alteration> ways) {
    std::vector<std::optional<Anthropometry>> measured;
    for (const Alteration& by : ways) measured.push_back(one(by));
    return measured;
  };
}

TEST(FigureSolver, MeetsWhatABodyCanHave) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Numbers numbers(seed);
    const MadeUpBody body(numbers);
    Alteration secret;
    for (const std::string& key : kKeys)
      secret[parameterOf(key)] = numbers.between(-1, 1) * (key.ends_with("_girth") ? 0.15 : 0.05);
    std::vector<Target> targets;
    for (const auto& [key, value] : body.at(secret).value) targets.push_back({key, value, true});
    FigureSolver solver(targets);
    int tries = 0;
    const double said =
        solver.solve(each([&](const Alteration& by) { return ++tries, std::optional(body.at(by)); }), 30, 0.2, 2);
    EXPECT_LT(said, 0.2);
    EXPECT_DOUBLE_EQ(worstResidual(targets, body.at(solver.alteration()), true), said);
    EXPECT_LT(tries, 40);
  }
}

TEST(FigureSolver, LeavesAloneWhatIsMet) {
  Numbers numbers(5);
  const MadeUpBody body(numbers);
  std::vector<Target> targets;
  for (const auto& [key, value] : body.drawn) targets.push_back({key, value, true});
  FigureSolver solver(targets);
  int tries = 0;
  EXPECT_EQ(solver.solve(each([&](const Alteration& by) { return ++tries, std::optional(body.at(by)); }), 30, 0.2, 2),
            0);
  EXPECT_EQ(tries, 1);
  for (const auto& [parameter, amount] : solver.alteration()) EXPECT_EQ(amount, 0) << parameter;
}

// Bust and waist answer to one and the same parameter: no figure has both.
TEST(FigureSolver, NamesTheOneInTheWay) {
  const auto evaluate = each([](const Alteration& by) {
    Anthropometry found;
    const double common = by.at("bust_girth") + by.at("waist_girth");
    found.value["bust_girth"] = 0.9 * std::exp(common), found.value["waist_girth"] = 0.7 * std::exp(common);
    found.value["hip_girth"] = 1.0 * std::exp(by.at("hip_girth"));
    return std::optional(found);
  });
  FigureSolver solver({{"bust_girth", 0.99, true}, {"hip_girth", 1.05, true}, {"waist_girth", 0.7, true}});
  EXPECT_GT(solver.solve(evaluate, 30, 0.2, 2), 5);
  EXPECT_EQ(solver.conflictsWith("bust_girth"), "waist_girth");
  EXPECT_EQ(solver.conflictsWith("waist_girth"), "bust_girth");
}

TEST(FigureSolver, GivesUpWhereNothingCanBeMeasured) {
  FigureSolver none({{"bust_girth", 0.9, true}});
  EXPECT_EQ(none.solve(each([](const Alteration&) { return std::optional<Anthropometry>(); }), 30, 0.2, 2), 1e9);
  EXPECT_EQ(none.solve(each([](const Alteration&) { return std::optional(Anthropometry{}); }), 30, 0.2, 2), 1e9);
}

}  // namespace
}  // namespace karinui

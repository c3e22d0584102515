#pragma once
// Solves for the alteration of a drawn figure with which the tape on the finished mesh says what was asked for.
//
// Every measurement has a parameter that moves it about one to one, but all pull at each other (a wider thigh closes
// the gap between the legs and lowers the crotch). So this is damped least squares over all parameters at once
// (Levenberg and Marquardt). The Jacobian is first taken as one to one, and updated by rank one from every try (C. G.
// Broyden, A class of methods for solving nonlinear simultaneous equations, 1965); when that leads nowhere it is
// measured by differences, in every parameter; the figures of that are made at once.
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "body/alteration.h"
#include "body/anthropometry/anthropometry.h"

namespace karinui {

struct Target {
  std::string key;
  double value = 0;
  bool stated = false;  // else it follows from what was stated, and weighs a third
};
double tolerance(std::string_view key);  // how far a measurement may be off: girths 3 mm, the rest 5 mm, angles 0.02

struct Residual {
  std::string key;
  double wanted = 0, got = 0;
  double relative = 0;  // |got - wanted| / tolerance
};
std::vector<Residual> residuals(const std::vector<Target>& targets, const Anthropometry& measured);
// The largest weighted |got - wanted| / tolerance.
double worstResidual(const std::vector<Target>& targets, const Anthropometry& measured, bool statedOnly);

// Where a measurement depends on another's parameter, too, or not one to one: tolerances per unit.
struct Derivative {
  std::string_view parameter, key;
  double value;
};

inline constexpr double kNotMeasured = 1e9;  // for a residual: the tape could not be taken

class FigureSolver {
 public:
  // Makes the figure altered in each of these ways and measures it; nothing where no body can be measured. Each by
  // itself: in which order, or on how many threads, is all one.
  using Evaluate = std::function<std::vector<std::optional<Anthropometry>>(std::span<const Alteration>)>;
  // `free`: parameters of measurements that are no targets.
  explicit FigureSolver(std::vector<Target> targets, std::span<const Derivative> free = {});

  const std::vector<Target>& targets() const { return targets_; }
  // At most `rounds` steps; stops as soon as the worst residual is below `enough`. `differences`: how often the
  // Jacobian may be measured when no step helps. Says the worst residual reached, or kNotMeasured, and
  // keeps the best alteration. May be called again, to go on from there.
  double solve(const Evaluate& evaluate, int rounds, double enough, int differences);
  const Alteration& alteration() const { return best_; }
  // Goes on from there. What has no parameter is left out.
  void startAt(const Alteration& alteration);

  // Of the stated measurements the one that stands most in the way of `missed`, by the Jacobian; empty if none.
  std::string conflictsWith(const std::string& missed) const;

 private:
  std::vector<double> residualVector(const Anthropometry& measured) const;
  Alteration alterationAt(const std::vector<double>& units) const;
  std::vector<double> dampedStep(const std::vector<double>& at, const std::vector<double>& residual,
                                 double damping) const;
  void broydenUpdate(const std::vector<double>& step, const std::vector<double>& change);
  bool differenceJacobian(const Evaluate& evaluate, const std::vector<double>& at, const std::vector<double>& residual);

  std::vector<Target> targets_;
  std::vector<std::string> parameter_;
  std::vector<double> unit_;                   // of each parameter: about what changes a body visibly
  std::vector<std::vector<double>> jacobian_;  // [target][parameter]: tolerances per unit, weighted
  std::vector<double> at_;
  Alteration best_;
};

}  // namespace karinui

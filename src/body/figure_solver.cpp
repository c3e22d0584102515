#include "body/figure_solver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kGirthUnit = 0.02, kLengthUnit = 0.01;  // two hundredths of a girth (or of a turn), a centimetre
constexpr double kLongestStep = 6;                       // units a parameter may change in one step
constexpr double kRidge =
    0.01;  // on the parameters: of two figures that meet the targets the less altered one is taken
constexpr double kImpliedWeight = 0.33;  // of a target that was not stated
constexpr double kDifference = 0.6;      // units, by which the Jacobian is measured
constexpr double kNoise = 0.05;          // units: a shorter step is within the noise of measuring on another grid

// As measured on a woman of size 38 and a man of size 50. A start; Broyden's updates bring it to what holds for this
// body.
constexpr Derivative kInitialJacobian[] = {
    {"armpit_height", "armpit_height", 0.7},    {"bust_height", "under_bust_girth", 3.3},
    {"bust_height", "armpit_height", 0.5},      {"bust_girth", "arm_joint_length", -0.6},
    {"hip_girth", "crotch_height", 2.1},        {"hip_girth", "thigh_girth", 2.2},
    {"thigh_girth", "crotch_height", -2.6},     {"thigh_girth", "hip_girth", 2.0},
    {"thigh_girth", "thigh_girth", 0.8},        {"thigh_depth", "crotch_height", 2.2},
    {"thigh_depth", "hip_girth", 1.8},          {"thigh_depth", "thigh_girth", 2.2},
    {"under_bust_girth", "waist_height", -0.8}, {"waist_girth", "waist_height", 0.8},
    {"waist_height", "under_bust_girth", -0.7}, {"shoulder_width", "arm_joint_length", 1.1},
    {"shoulder_width", "armpit_height", 0.4},   {"wrist_girth", "wrist_girth", 1.3},
};

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool isGirth(std::string_view key) { return key.ends_with("_girth"); }

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

double weightOf(const Target& target) { return target.stated ? 1 : kImpliedWeight; }

}  // namespace

double tolerance(std::string_view key) { return isAngle(key) ? 0.02 : isGirth(key) ? 0.003 : 0.005; }

std::vector<Residual> residuals(const std::vector<Target>& targets, const Anthropometry& measured) {
  std::vector<Residual> out;
  for (const Target& target : targets) {
    const auto it = measured.value.find(target.key);
    Residual residual{target.key, target.value, it == measured.value.end() ? 0 : it->second, 0};
    residual.relative = std::abs(residual.got - residual.wanted) / tolerance(target.key);
    out.push_back(residual);
  }
  return out;
}

double worstResidual(const std::vector<Target>& targets, const Anthropometry& measured, bool statedOnly) {
  const auto all = residuals(targets, measured);
  double worst = 0;
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (!statedOnly || targets[i].stated) worst = std::max(worst, all[i].relative * weightOf(targets[i]));
  return worst;
}

FigureSolver::FigureSolver(std::vector<Target> targets, std::span<const Derivative> free)
    : targets_(std::move(targets)) {
  for (const Derivative& its : free) parameter_.emplace_back(its.parameter);
  for (const Target& target : targets_)
    if (const std::string parameter = parameterOf(target.key);
        !parameter.empty() && std::find(parameter_.begin(), parameter_.end(), parameter) == parameter_.end())
      parameter_.push_back(parameter);
  for (const char* parameter : {kThighDepth, "shoulder_width"})
    if (std::find(parameter_.begin(), parameter_.end(), parameter) == parameter_.end()) parameter_.push_back(parameter);
  jacobian_.assign(targets_.size(), std::vector<double>(parameter_.size(), 0));
  for (const std::string& parameter : parameter_)
    unit_.push_back(isGirth(parameter) || parameter == kThighDepth ? kGirthUnit : kLengthUnit);
  for (std::size_t i = 0; i < targets_.size(); ++i)
    for (std::size_t k = 0; k < parameter_.size(); ++k) {
      if (parameter_[k] == parameterOf(targets_[i].key))
        jacobian_[i][k] = unit_[k] * (isGirth(targets_[i].key) ? targets_[i].value : 1) / tolerance(targets_[i].key);
      for (const Derivative& its : free)
        if (its.parameter == parameter_[k] && its.key == targets_[i].key) jacobian_[i][k] = its.value;
      for (const Derivative& known : kInitialJacobian)
        if (known.parameter == parameter_[k] && known.key == targets_[i].key) jacobian_[i][k] = known.value;
      jacobian_[i][k] *= weightOf(targets_[i]);
    }
  at_.assign(parameter_.size(), 0);
}

std::vector<double> FigureSolver::residualVector(const Anthropometry& measured) const {
  std::vector<double> residual;
  for (const Target& target : targets_) {
    const auto it = measured.value.find(target.key);
    if (it == measured.value.end()) return {};
    residual.push_back(weightOf(target) * (it->second - target.value) / tolerance(target.key));
  }
  return residual;
}

Alteration FigureSolver::alterationAt(const std::vector<double>& units) const {
  Alteration out;
  for (std::size_t k = 0; k < parameter_.size(); ++k) out[parameter_[k]] = units[k] * unit_[k];
  return out;
}

std::vector<double> FigureSolver::dampedStep(const std::vector<double>& at, const std::vector<double>& residual,
                                             double damping) const {
  const auto n = static_cast<Eigen::Index>(parameter_.size()), m = static_cast<Eigen::Index>(targets_.size());
  MatrixXd a(m, n);
  VectorXd r(m), x(n);
  for (Eigen::Index i = 0; i < m; ++i) {
    r[i] = residual[i];
    for (Eigen::Index k = 0; k < n; ++k) a(i, k) = jacobian_[i][k];
  }
  for (Eigen::Index k = 0; k < n; ++k) x[k] = at[k];
  MatrixXd normal = a.transpose() * a;
  normal.diagonal().array() += damping + kRidge;
  const VectorXd found = normal.ldlt().solve(-(a.transpose() * r) - kRidge * x);
  std::vector<double> out(found.data(), found.data() + n);
  for (double& s : out) s = std::clamp(s, -kLongestStep, kLongestStep);
  return out;
}

void FigureSolver::broydenUpdate(const std::vector<double>& step, const std::vector<double>& change) {
  const double size = norm(step);
  if (size < kNoise) return;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    double expected = 0;
    for (std::size_t k = 0; k < parameter_.size(); ++k) expected += jacobian_[i][k] * step[k];
    for (std::size_t k = 0; k < parameter_.size(); ++k)
      jacobian_[i][k] += (change[i] - expected) * step[k] / (size * size);
  }
}

bool FigureSolver::differenceJacobian(const Evaluate& evaluate, const std::vector<double>& at,
                                      const std::vector<double>& residual) {
  std::vector<Alteration> beside;
  for (std::size_t k = 0; k < parameter_.size(); ++k) {
    std::vector<double> moved = at;
    moved[k] += kDifference;
    beside.push_back(alterationAt(moved));
  }
  const auto measured = evaluate(beside);
  for (std::size_t k = 0; k < parameter_.size(); ++k) {
    if (!measured[k]) return false;
    const std::vector<double> now = residualVector(*measured[k]);
    if (now.empty()) continue;
    for (std::size_t i = 0; i < targets_.size(); ++i) jacobian_[i][k] = (now[i] - residual[i]) / kDifference;
  }
  return true;
}

void FigureSolver::startAt(const Alteration& alteration) {
  for (std::size_t k = 0; k < parameter_.size(); ++k) {
    const auto it = alteration.find(parameter_[k]);
    at_[k] = it == alteration.end() ? 0 : it->second / unit_[k];
  }
  best_ = alterationAt(at_);
}

double FigureSolver::solve(const Evaluate& evaluate, int rounds, double enough, int differences) {
  const auto worst = [&](const std::vector<double>& residual) {
    double most = 0;
    for (std::size_t i = 0; i < residual.size(); ++i)
      most = std::max(most, std::abs(residual[i]) * (targets_[i].stated ? 1 : kImpliedWeight));
    return most;
  };
  const auto evaluateOne = [&](const std::vector<double>& units) {
    const Alteration by = alterationAt(units);
    return std::move(evaluate({&by, 1}).front());
  };
  auto measured = evaluateOne(at_);
  std::vector<double> residual = measured ? residualVector(*measured) : std::vector<double>();
  if (residual.empty()) return kNotMeasured;
  std::vector<double> best = at_;
  double least = worst(residual), damping = 0.1;
  int idle = 0;
  std::optional<int> differencesHere;  // the round in which they were measured at at_
  for (int round = 1; round < rounds && least > enough; ++round) {
    if (differences > 0 && idle >= 2 && differencesHere)  // the same steps would follow, once for each that is left
      if (const int later = round + differences * (round - *differencesHere); later < rounds)
        round = later, differences = 0;
    if (differences > 0 && idle >= 2) {
      if (!differenceJacobian(evaluate, at_, residual)) break;
      --differences, idle = 0, damping = 0.1;
      differencesHere = round;
    }
    const std::vector<double> way = dampedStep(at_, residual, damping);
    if (norm(way) < kNoise) {  // no shorter step helps
      if (differences == 0) break;
      idle = 2;
      continue;
    }
    std::vector<double> next = at_;
    for (std::size_t k = 0; k < next.size(); ++k) next[k] += way[k];
    measured = evaluateOne(next);
    if (!measured) break;
    const std::vector<double> now = residualVector(*measured);
    if (now.empty()) {  // gone so far that the body cannot be measured
      damping = 10 * damping + 1, ++idle;
      continue;
    }
    std::vector<double> change(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) change[i] = now[i] - residual[i];
    broydenUpdate(way, change);
    idle = norm(now) < 0.8 * norm(residual) ? 0 : idle + 1;
    if (norm(now) < 1.02 * norm(residual)) {
      at_ = next, residual = now, damping *= 0.4;
      differencesHere.reset();
    } else {
      damping = 4 * damping + 0.2;
    }
    if (worst(now) < least) least = worst(now), best = next;
  }
  at_ = best;
  best_ = alterationAt(at_);
  return least;
}

std::string FigureSolver::conflictsWith(const std::string& missed) const {
  const auto n = static_cast<Eigen::Index>(parameter_.size());
  const auto it =
      std::find_if(targets_.begin(), targets_.end(), [&](const Target& target) { return target.key == missed; });
  if (it == targets_.end()) return {};
  // How far `missed` could be moved if all others are to stay, and if all others but one are.
  const auto freedom = [&](std::size_t without) {
    MatrixXd normal = MatrixXd::Identity(n, n) * kRidge;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (i == without || targets_[i].key == missed) continue;
      const VectorXd row = Eigen::Map<const VectorXd>(jacobian_[i].data(), n);
      normal += row * row.transpose();
    }
    const VectorXd gradient = Eigen::Map<const VectorXd>(jacobian_[it - targets_.begin()].data(), n);
    return gradient.dot(normal.ldlt().solve(gradient));
  };
  double most = 1.3 * freedom(targets_.size());
  std::string other;
  for (std::size_t i = 0; i < targets_.size(); ++i)
    if (targets_[i].stated && targets_[i].key != missed)
      if (const double now = freedom(i); now > most) most = now, other = targets_[i].key;
  return other;
}

}  // namespace karinui

#include "body/fitting.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kGirthUnit = 0.02, kLengthUnit = 0.01;  // two hundredths of a girth (or of a turn), a centimetre
constexpr double kLongestStep = 6;                       // units a knob may turn in one round
constexpr double kHabit = 0.01;  // how dearly an alteration is paid for: of two ways the smaller one is taken
constexpr double kFollows = 0.33;

// Where a measurement answers to another's alteration, too, or less than one to one: shares of what is allowed per
// unit, as measured on a woman of size 38 and a man of size 50. A start; the search learns what holds for this body.
struct Experience {
  std::string_view knob, key;
  double answer;
};
constexpr Experience kExperience[] = {
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

double weightOf(const Aim& aim) { return aim.stated ? 1 : kFollows; }

}  // namespace

double allowed(std::string_view key) { return isAngle(key) ? 0.02 : isGirth(key) ? 0.003 : 0.005; }

std::vector<Miss> misses(const std::vector<Aim>& aims, const Reading& reading) {
  std::vector<Miss> out;
  for (const Aim& aim : aims) {
    const auto it = reading.value.find(aim.key);
    Miss miss{aim.key, aim.value, it == reading.value.end() ? 0 : it->second, 0};
    miss.share = std::abs(miss.got - miss.wanted) / allowed(aim.key);
    out.push_back(miss);
  }
  return out;
}

double worstShare(const std::vector<Aim>& aims, const Reading& reading, bool statedOnly) {
  const auto all = misses(aims, reading);
  double worst = 0;
  for (std::size_t i = 0; i < aims.size(); ++i)
    if (!statedOnly || aims[i].stated) worst = std::max(worst, all[i].share * weightOf(aims[i]));
  return worst;
}

FigureFitting::FigureFitting(std::vector<Aim> aims) : aims_(std::move(aims)) {
  for (const Aim& aim : aims_)
    if (const std::string knob = knobOf(aim.key);
        !knob.empty() && std::find(knob_.begin(), knob_.end(), knob) == knob_.end())
      knob_.push_back(knob);
  for (const char* knob : {kThighDepth, "shoulder_width"})
    if (std::find(knob_.begin(), knob_.end(), knob) == knob_.end()) knob_.push_back(knob);
  answer_.assign(aims_.size(), std::vector<double>(knob_.size(), 0));
  for (const std::string& knob : knob_)
    unit_.push_back(isGirth(knob) || knob == kThighDepth ? kGirthUnit : kLengthUnit);
  for (std::size_t i = 0; i < aims_.size(); ++i)
    for (std::size_t k = 0; k < knob_.size(); ++k) {
      if (knob_[k] == knobOf(aims_[i].key))
        answer_[i][k] = unit_[k] * (isGirth(aims_[i].key) ? aims_[i].value : 1) / allowed(aims_[i].key);
      for (const Experience& known : kExperience)
        if (known.knob == knob_[k] && known.key == aims_[i].key) answer_[i][k] = known.answer;
      answer_[i][k] *= weightOf(aims_[i]);
    }
  at_.assign(knob_.size(), 0);
}

std::vector<double> FigureFitting::gapsOf(const Reading& reading) const {
  std::vector<double> gaps;
  for (const Aim& aim : aims_) {
    const auto it = reading.value.find(aim.key);
    if (it == reading.value.end()) return {};
    gaps.push_back(weightOf(aim) * (it->second - aim.value) / allowed(aim.key));
  }
  return gaps;
}

Alteration FigureFitting::amounts(const std::vector<double>& units) const {
  Alteration out;
  for (std::size_t k = 0; k < knob_.size(); ++k) out[knob_[k]] = units[k] * unit_[k];
  return out;
}

// The step that brings the gaps nearest to zero if the answers are true, damped.
std::vector<double> FigureFitting::step(const std::vector<double>& at, const std::vector<double>& gaps,
                                        double damping) const {
  const auto n = static_cast<Eigen::Index>(knob_.size()), m = static_cast<Eigen::Index>(aims_.size());
  MatrixXd a(m, n);
  VectorXd r(m), x(n);
  for (Eigen::Index i = 0; i < m; ++i) {
    r[i] = gaps[i];
    for (Eigen::Index k = 0; k < n; ++k) a(i, k) = answer_[i][k];
  }
  for (Eigen::Index k = 0; k < n; ++k) x[k] = at[k];
  MatrixXd normal = a.transpose() * a;
  normal.diagonal().array() += damping + kHabit;
  const VectorXd found = normal.ldlt().solve(-(a.transpose() * r) - kHabit * x);
  std::vector<double> out(found.data(), found.data() + n);
  for (double& s : out) s = std::clamp(s, -kLongestStep, kLongestStep);
  return out;
}

void FigureFitting::learn(const std::vector<double>& step, const std::vector<double>& change) {
  const double size = norm(step);
  if (size < 0.05) return;  // less than the tape's own trembling
  for (std::size_t i = 0; i < aims_.size(); ++i) {
    double expected = 0;
    for (std::size_t k = 0; k < knob_.size(); ++k) expected += answer_[i][k] * step[k];
    for (std::size_t k = 0; k < knob_.size(); ++k) answer_[i][k] += (change[i] - expected) * step[k] / (size * size);
  }
}

bool FigureFitting::measureAnswers(const Wear& wear, const std::vector<double>& at, const std::vector<double>& gaps) {
  for (std::size_t k = 0; k < knob_.size(); ++k) {
    std::vector<double> turned = at;
    turned[k] += 0.6;
    const auto reading = wear(amounts(turned));
    if (!reading) return false;
    const std::vector<double> now = gapsOf(*reading);
    if (now.empty()) continue;
    for (std::size_t i = 0; i < aims_.size(); ++i) answer_[i][k] = (now[i] - gaps[i]) / 0.6;
  }
  return true;
}

double FigureFitting::search(const Wear& wear, int rounds, double enough, int measures) {
  const auto worst = [&](const std::vector<double>& gaps) {
    double most = 0;
    for (std::size_t i = 0; i < gaps.size(); ++i)
      most = std::max(most, std::abs(gaps[i]) * (aims_[i].stated ? 1 : kFollows));
    return most;
  };
  auto reading = wear(amounts(at_));
  std::vector<double> gaps = reading ? gapsOf(*reading) : std::vector<double>();
  if (gaps.empty()) return 1e9;
  std::vector<double> best = at_;
  double least = worst(gaps), damping = 0.1;
  int idle = 0;
  for (int round = 1; round < rounds && least > enough; ++round) {
    if (measures > 0 && idle >= 2) {
      if (!measureAnswers(wear, at_, gaps)) break;
      --measures, idle = 0, damping = 0.1;
    }
    const std::vector<double> way = step(at_, gaps, damping);
    std::vector<double> next = at_;
    for (std::size_t k = 0; k < next.size(); ++k) next[k] += way[k];
    reading = wear(amounts(next));
    if (!reading) break;
    const std::vector<double> now = gapsOf(*reading);
    if (now.empty()) {  // gone so far that the body cannot be read
      damping = 10 * damping + 1, ++idle;
      continue;
    }
    std::vector<double> change(now.size());
    for (std::size_t i = 0; i < now.size(); ++i) change[i] = now[i] - gaps[i];
    learn(way, change);
    idle = norm(now) < 0.8 * norm(gaps) ? 0 : idle + 1;
    if (norm(now) < 1.02 * norm(gaps)) {
      at_ = next, gaps = now, damping *= 0.4;
    } else {
      damping = 4 * damping + 0.2;
    }
    if (worst(now) < least) least = worst(now), best = next;
  }
  at_ = best;
  best_ = amounts(at_);
  return least;
}

std::string FigureFitting::quarrelsWith(const std::string& missed) const {
  const auto n = static_cast<Eigen::Index>(knob_.size());
  const auto it = std::find_if(aims_.begin(), aims_.end(), [&](const Aim& aim) { return aim.key == missed; });
  if (it == aims_.end()) return {};
  // How far `missed` could be moved if all others are to stay, and if all others but one are.
  const auto freedom = [&](std::size_t without) {
    MatrixXd normal = MatrixXd::Identity(n, n) * kHabit;
    for (std::size_t i = 0; i < aims_.size(); ++i) {
      if (i == without || aims_[i].key == missed) continue;
      const VectorXd row = Eigen::Map<const VectorXd>(answer_[i].data(), n);
      normal += row * row.transpose();
    }
    const VectorXd wish = Eigen::Map<const VectorXd>(answer_[it - aims_.begin()].data(), n);
    return wish.dot(normal.ldlt().solve(wish));
  };
  double most = 1.3 * freedom(aims_.size());
  std::string other;
  for (std::size_t i = 0; i < aims_.size(); ++i)
    if (aims_[i].stated && aims_[i].key != missed)
      if (const double now = freedom(i); now > most) most = now, other = aims_[i].key;
  return other;
}

}  // namespace karinui

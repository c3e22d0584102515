#pragma once
// Finds how a drawn figure must be altered so that the tape on the finished mesh says what was asked for.
//
// Every measurement has an alteration that moves it about one to one, but all pull at each other (a wider thigh closes
// the gap between the legs and lowers the crotch). So this is damped least squares (Levenberg and Marquardt) over all
// amounts at once. How each answers to each is first taken as one to one and learned from every try (C. G. Broyden, A
// class of methods for solving nonlinear simultaneous equations, 1965); when that leads nowhere it is measured, one
// small alteration after the other.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "body/alteration.h"
#include "body/reading.h"

namespace karinui {

struct Aim {
  std::string key;
  double value = 0;
  bool stated = false;  // what merely follows is aimed at with a third of the force
};
double allowed(std::string_view key);  // how far a measurement may be off: girths 3 mm, the rest 5 mm, angles 0.02

struct Miss {
  std::string key;
  double wanted = 0, got = 0;
  double share = 0;  // |got - wanted| as a share of what is allowed
};
std::vector<Miss> misses(const std::vector<Aim>& aims, const Reading& reading);
double worstShare(const std::vector<Aim>& aims, const Reading& reading, bool statedOnly);

class FigureFitting {
 public:
  // Makes and reads the figure altered so; nothing where there is no body to read.
  using Wear = std::function<std::optional<Reading>(const Alteration&)>;
  explicit FigureFitting(std::vector<Aim> aims);

  const std::vector<Aim>& aims() const { return aims_; }
  // At most `rounds` tries; stops as soon as every miss is below `enough`. `measures`: how often the answers may be
  // measured when it is stuck.
  // Says the worst share reached (1e9: nothing could be read). The best alteration is kept.
  double search(const Wear& wear, int rounds, double enough, int measures);
  const Alteration& alteration() const { return best_; }

  // Of the stated measurements the one that stands most in the way of `missed`, by what was learned; empty if none.
  std::string quarrelsWith(const std::string& missed) const;

 private:
  std::vector<double> gapsOf(const Reading& reading) const;
  Alteration amounts(const std::vector<double>& units) const;
  std::vector<double> step(const std::vector<double>& at, const std::vector<double>& gaps, double damping) const;
  void learn(const std::vector<double>& step, const std::vector<double>& change);
  bool measureAnswers(const Wear& wear, const std::vector<double>& at, const std::vector<double>& gaps);

  std::vector<Aim> aims_;
  std::vector<std::string> knob_;
  std::vector<double> unit_;                 // of a knob: about what changes a body visibly
  std::vector<std::vector<double>> answer_;  // [aim][knob], shares of what is allowed per unit
  std::vector<double> at_;
  Alteration best_;
};

}  // namespace karinui

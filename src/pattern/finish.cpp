#include "karinui/pattern/finish.h"

#include <numbers>
#include <tuple>

namespace karinui {

namespace {

constexpr double kCaughtIn = 0.010;  // metres of a piping's strip on each side of the cord

bool within(double value, double least, double most) { return value >= least && value <= most; }

}  // namespace

double Piping::stripWidth() const { return std::numbers::pi * thickness + 2 * kCaughtIn; }

bool sound(const Elastic& elastic) {
  return within(elastic.ratio, kTightestElastic, kLoosestElastic) &&
         within(elastic.strength, kWeakestElastic, kStrongestElastic);
}

bool sound(const Hem& hem) {
  return hem.width >= kNarrowestHem && within(hem.under, 0, hem.width) && hem.allowance() <= kWidestAllowance;
}

bool sound(const Topstitch& own) {
  return within(own.offset, 0.0005, 0.1) && own.rows >= 1 && own.rows <= kMostRows && within(own.apart, 0.001, 0.05) &&
         within(own.length, 0.001, 0.02) && own.colour.value_or(0) <= 0xffffff;
}

bool sound(const Piping& piping) { return within(piping.thickness, kThinnestCord, kThickestCord); }

bool sound(const Binding& binding) { return within(binding.width, kNarrowestBinding, kWidestBinding); }

bool prevails(const Elastic& a, const Elastic& b) { return a.ratio < b.ratio; }
bool prevails(const Hem& a, const Hem& b) { return a.allowance() > b.allowance(); }
bool prevails(const Topstitch& a, const Topstitch& b) {
  return std::tuple(a.rows, a.offset) > std::tuple(b.rows, b.offset);
}
bool prevails(const Piping& a, const Piping& b) { return a.thickness > b.thickness; }
bool prevails(const Binding& a, const Binding& b) { return a.width > b.width; }

}  // namespace karinui

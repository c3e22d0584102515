#pragma once
// The chart of a body: named levels along torso, arms and legs, each a plane with a middle, so that "how far along, how
// far around" names a place. Exact joints for a mannequin of ours, estimated from plane sections for any other body.
#include <array>
#include <memory>
#include <vector>

#include "body/anthropometry/anthropometry.h"
#include "body/figure.h"
#include "karinui/body/body.h"

namespace karinui {

struct Level {
  Vec3 centre, normal;  // the normal points the way `along` grows
};

// A plane of the chart with its directions: around = 0 is front, 0.25 the body's left.
struct ChartRay {
  Vec3 from, normal, front, side;
  Vec3 towards(double around) const;
};

struct Body::Parts::Template {
  std::array<std::vector<Level>, 5> level;  // torso, left arm, right arm, left leg, right leg
  double height = 1.7;
  double reach(BodyPoint::Part part) const;  // further out than this a ray has left the part
  ChartRay at(BodyPoint::Part part, double along) const;
  // Every `along` at which the part's plane passes through the place.
  std::vector<double> alongOf(BodyPoint::Part part, Vec3 place) const;
};

std::shared_ptr<const Body::Parts::Template> chartOf(const Figure& figure, const Anthropometry& measured);
std::shared_ptr<const Body::Parts::Template> chartOf(const Anthropometry& measured);  // null: not enough was found

// Height, then each part's levels as centre and normal; and back, null where the numbers cannot be those of a chart.
std::vector<double> numbersOf(const Body::Parts::Template& chart);
std::shared_ptr<const Body::Parts::Template> templateFrom(std::span<const double> numbers);

}  // namespace karinui

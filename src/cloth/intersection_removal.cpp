#include "cloth/intersection_removal.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kForce = 20;      // N per metre of cloth that intersects, at first,
constexpr double kGrowth = 1.1;    // this factor more with each step without fewer intersections,
constexpr double kMostForce = 50;  // to so many times at most: cloth that is pressed together needs more
constexpr double kFreeMove = 0.1;  // spacings a node goes in a step when nothing holds it: sets the stiffness
constexpr int kPatience = 60;      // steps without fewer intersections before they are left as they are

}  // namespace

void IntersectionRemoval::find(std::span<const Vec3> x, Workers& workers) {
  if (!contour_) contour_ = std::make_unique<IntersectionContour>(cloth_);
  contour_->find(x, workers);
}

bool IntersectionRemoval::start(std::span<const Vec3> x, Workers& workers) {
  if (!self_.enabled()) return false;
  active_ = true;
  noBetter_ = 0;
  least_ = static_cast<std::size_t>(-1);
  afterStep(x, false, workers);
  return active_;
}

std::size_t IntersectionRemoval::count(std::span<const Vec3> x, Workers& workers) {
  if (!self_.enabled()) return 0;
  find(x, workers);
  return contour_->crossings();
}

void IntersectionRemoval::afterStep(std::span<const Vec3> x, bool, Workers& workers) {
  if (!active_) return;
  find(x, workers);
  if (contour_->crossings() < least_) {
    least_ = contour_->crossings();
    noBetter_ = 0;
  } else {
    ++noBetter_;
  }
  self_.leaveOut(contour_->crossings() > 0 ? contour_->near() : std::vector<std::uint8_t>{});
  if (contour_->crossings() == 0 || noBetter_ > kPatience) active_ = false;  // what is left stays left out
}

double IntersectionRemoval::nodeForce() const {
  return kForce * std::fmin(kMostForce, std::pow(kGrowth, noBetter_)) * cloth_.spacing;
}

void IntersectionRemoval::addGradient(std::span<Vec3> gradient) const {
  if (!active_) return;
  const double force = nodeForce();
  for (NodeIndex k : moving_)
    if (const Vec3 way = contour_->direction()[k]; squaredLength(way) > 0) gradient[k] -= way * force;
}

void IntersectionRemoval::addHessian(ContactHessian& hessian) const {
  if (!active_) return;
  const double stiffness = nodeForce() / (kFreeMove * cloth_.spacing);
  for (NodeIndex k : moving_)
    if (squaredLength(contour_->direction()[k]) > 0) hessian.addIsotropic(k, stiffness);
}

}  // namespace karinui

#pragma once
// Separates cloth that intersects itself: nodes at an intersection do not meet each other, and a force shortens the
// contour of the intersection until it is gone, or until that has brought nothing for some steps.
#include <memory>

#include "cloth/intersection_contour.h"
#include "cloth/self_contact.h"

namespace karinui {

class IntersectionRemoval : public Contact {
 public:
  // `moving`: the nodes that may be moved. All must outlive this.
  IntersectionRemoval(const Cloth& cloth, const std::vector<NodeIndex>& moving, SelfContact& self)
      : cloth_(cloth), moving_(moving), self_(self) {}

  // Looks whether the cloth intersects itself and if so separates it in the steps that follow; whether there is
  // something to separate.
  bool start(std::span<const Vec3> x, Workers& workers);
  std::size_t count(std::span<const Vec3> x, Workers& workers);  // intersections of an edge with a face

  bool active() const { return active_; }  // whether something is being separated

  const char* name() const override { return "intersections"; }
  void detect(const ContactQuery&, Workers&) override {}  // found after each step
  void addGradient(std::span<Vec3> gradient) const override;
  void addHessian(ContactHessian& hessian) const override;
  void afterStep(std::span<const Vec3> x, bool friction, Workers& workers) override;

 private:
  void find(std::span<const Vec3> x, Workers& workers);
  double nodeForce() const;  // newtons, along a direction of length one

  const Cloth& cloth_;
  const std::vector<NodeIndex>& moving_;
  SelfContact& self_;
  std::unique_ptr<IntersectionContour> contour_;  // once it was asked about
  bool active_ = false;
  std::size_t least_ = 0;  // intersections so far
  int noBetter_ = 0;       // steps without fewer
};

}  // namespace karinui

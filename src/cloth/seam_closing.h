#pragma once
// Draws the two sides of open seams together: a spring of limited force between partners. Where its way leads into a
// collider the force is turned along the surface.
#include "cloth/collider_contact.h"

namespace karinui {

class SeamClosing : public Contact {
 public:
  // `tied`: per tie of the cloth; the force acts on those that are not. `colliders`: detected before this. All must
  // outlive this.
  SeamClosing(const Cloth& cloth, const std::vector<std::uint8_t>& tied,
              const std::vector<const ColliderContact*>& colliders)
      : cloth_(cloth), tied_(tied), colliders_(colliders) {}

  const char* name() const override { return "open seams"; }
  void detect(const ContactQuery& query, Workers& workers) override;
  void addGradient(std::span<Vec3> gradient) const override;
  void addHessian(ContactHessian& hessian) const override;

  // 1 to begin with; more where something holds a seam open.
  void setStrength(double strength) { strength_ = strength; }

 private:
  struct Pull {
    Tie tie;
    Vec3 onA, onB;         // newtons; onB is shared by b and c
    double stiffness = 0;  // N/m
  };
  Vec3 normalAt(NodeIndex node) const;  // of the first collider that the node touches; zero: it touches none

  const Cloth& cloth_;
  const std::vector<std::uint8_t>& tied_;
  const std::vector<const ColliderContact*>& colliders_;
  double strength_ = 1;
  std::vector<Pull> pulls_;
};

}  // namespace karinui

#pragma once
// Faces of cloth against a collider, between their nodes: sample points spread over each face are pushed out from near
// the surface on, so that a coarse face does not let a limb through that its corners stand beside. Without friction;
// that is the nodes' (ColliderContact).
#include <array>
#include <vector>

#include "cloth/collider_contact.h"

namespace karinui {

class ColliderFaceContact : public Contact {
 public:
  // `offset`: the nodes' own, metres; faces are pushed nearer to the surface. Of the live pieces.
  ColliderFaceContact(const Cloth& cloth, const Collider& collider, double offset);

  const char* name() const override { return "collider faces"; }
  void detect(const ContactQuery& query, Workers& workers) override;
  void addGradient(std::span<Vec3> gradient) const override;
  void addHessian(ContactHessian& hessian) const override;
  void reset() override { cache_.forget(); }

 private:
  struct Touch {
    std::uint32_t face = 0;
    std::array<double, 3> weight{};
    Vec3 normal;
    Penalty penalty;
  };
  std::vector<Triangle> faces_;
  std::vector<double> area_;                   // of each of a face's sample points
  std::vector<std::array<double, 3>> points_;  // barycentric
  ClearanceCache cache_;
  std::vector<Touch> touching_;
  const Collider& collider_;
  double offset_, begin_;
};

}  // namespace karinui

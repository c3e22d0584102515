#pragma once
// Cloth between its nodes against the body: a face does not let a limb through that its corners stand beside. Places
// spread over each face push from near the surface on, without friction; that is the nodes' (see BodyContact).
#include <array>
#include <span>
#include <vector>

#include "cloth/body_contact.h"

namespace karinui {

class FaceContact {
 public:
  // `offset`: the nodes' own skin, metres; faces begin to push nearer to the surface.
  FaceContact(const Cloth& cloth, const Collider& body, double offset);

  void find(std::span<const Vec3> x, Workers& workers);
  void addGradient(std::span<Vec3> gradient) const;
  void addBlocks(const TieMap& ties, BlockSystem& system) const;

 private:
  struct Touch {
    std::uint32_t face = 0;
    std::array<double, 3> weight{};
    Vec3 normal;
    Push push;
  };
  std::vector<Triangle> faces_;  // of the live pieces
  std::vector<double> area_;     // of each of a face's places
  std::vector<std::array<double, 3>> places_;
  FarOff farOff_;
  std::vector<Touch> touching_;
  const Collider& body_;
  double offset_, begin_;
};

}  // namespace karinui

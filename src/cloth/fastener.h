#pragma once
// Closed buttons, snaps, hooks and ties: springs of limited force between a place on one piece and one on another,
// slack while the two lie as near as they should. The piece with the buttonholes lies over the other: what draws it
// there leads to a place off the other's right side, so that it comes over it and not against its edge.
//   force: min(k (l - s), most), l the way to that place, s the slack
#include "cloth/contact.h"
#include "karinui/cloth/pulls.h"

namespace karinui {

class FastenerContact : public Contact {
 public:
  // `clothRadius`: how near cloth comes to cloth, metres. The cloth must outlive it.
  FastenerContact(const Cloth& cloth, double clothRadius) : cloth_(cloth), clothRadius_(clothRadius) {}

  const char* name() const override { return "fastenings"; }
  void detect(const ContactQuery& query, Workers& workers) override;
  void addGradient(std::span<Vec3> gradient) const override;
  void addHessian(ContactHessian& hessian) const override;

  struct Pull {
    Vec3 way;                      // unit: along it the force draws the two together
    double force = 0;              // N
    double along = 0, across = 0;  // stiffness, N/m
  };
  static Pull pullOf(const ClothFastener& fastener, std::span<const Vec3> x, double clothRadius);

 private:
  const Cloth& cloth_;
  double clothRadius_;
  std::vector<Pull> pulls_;  // one per fastener
};

}  // namespace karinui

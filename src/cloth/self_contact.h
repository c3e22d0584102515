#pragma once
// Cloth against cloth: node-face and edge-edge pairs nearer than a radius are pushed apart along their normal, with
// Coulomb friction, and a continuous collision filter keeps moves from passing cloth through cloth. Pieces that do not
// move stand in the way like any cloth.
#include "cloth/collision_filter.h"
#include "cloth/contact.h"
#include "cloth/pair_friction.h"

namespace karinui {

// How near cloth comes to cloth before it is pushed, of the fabric of a cloth that has the most, metres.
double thickestRadius(const Cloth& cloth);

class SelfContact : public Contact {
 public:
  // `radius`: how near cloth comes to cloth before it is pushed, metres; 0: cloth does not meet cloth. Where it is
  // thickestRadius(), each two fabrics have a radius of their own; where it is wider it is one for all.
  SelfContact(const Cloth& cloth, double radius);
  SelfContact(const SelfContact&) = delete;  // its parts refer to each other
  SelfContact& operator=(const SelfContact&) = delete;

  const char* name() const override { return "cloth on cloth"; }
  void setTies(const TieMap& ties) override;
  // Friction of cloth on cloth is not switched off by the query.
  void detect(const ContactQuery& query, Workers& workers) override;
  void addGradient(std::span<Vec3> gradient) const override;
  void addHessian(ContactHessian& hessian) const override;
  void addSlipForce(std::span<Vec3> force) const override;
  void limitMove(std::span<const Vec3> x, std::vector<Vec3>& move, Workers& workers) override;
  void afterStep(std::span<const Vec3> x, bool friction, Workers& workers) override;
  void reset() override { friction_.reset(); }

  // Nodes marked here do not meet each other: they intersect. Empty: none.
  void leaveOut(std::vector<std::uint8_t> marked) { pairs_.leaveOut(std::move(marked)); }
  void enable(bool on) { on_ = on; }  // it is at first
  void onlyLayers(bool only) { pairs_.onlyLayers(only); }
  bool enabled() const { return on_ && radius_ > 0; }

 private:
  double radiusOf(const ContactPair& pair) const { return half_[pair.node[0]] + half_[pair.node[3]]; }

  double radius_, stiffness_;
  std::vector<double> half_;  // of the radius, per node, metres
  bool on_ = true;
  ClothTopology topology_;
  SewnGroups sewn_;
  ContactPairs pairs_;
  PairFriction friction_;
  CollisionFilter filter_;
  std::vector<ContactPair> touching_;
};

}  // namespace karinui

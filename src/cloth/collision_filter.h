#pragma once
// The continuous collision filter: changes the moves of nodes so that on straight ways to where they lead no cloth
// passes through cloth. For each pair that might meet it keeps the two sides apart along the pair's normal, by moving
// both to the plane between them, and where that does not converge by shortening moves.
//
// It keeps apart what is apart; what intersects at the start is left to IntersectionRemoval.
#include <span>
#include <vector>

#include "cloth/contact_pairs.h"

namespace karinui {

class CollisionFilter {
 public:
  // Both must outlive this. `radius`: of contact, metres.
  CollisionFilter(ContactPairs& pairs, const SewnGroups& sewn, double radius)
      : pairs_(pairs), sewn_(sewn), radius_(radius) {}

  bool apply(std::span<const Vec3> x, std::vector<Vec3>& move, Workers& workers);  // true: some move was changed

 private:
  // Over the pairs found; whether some move was changed.
  bool pass(const std::vector<ContactPair>& pairs, std::span<const Vec3> x, std::vector<Vec3>& move);
  void set(NodeIndex node, Vec3 own, std::vector<Vec3>& move);
  bool separate(const ContactPair& pair, int round, std::span<const Vec3> x, std::vector<Vec3>& move);

  ContactPairs& pairs_;
  const SewnGroups& sewn_;
  double radius_;
};

}  // namespace karinui

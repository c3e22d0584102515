#pragma once
// Nodes of cloth against a collider: a penalty force in the offset around the surface, and Coulomb friction by a spring
// from each node to its anchor, the place where it stuck (return mapping: where the spring's force would exceed
// friction's limit the anchor is drawn after the node). Tight cloth presses harder than the penalty bears at the
// surface itself, and stands there because limitMove holds it: a multiplier takes up the rest (augmented Lagrangian;
// Wriggers, Computational Contact Mechanics), so that the forces are in balance.
#include <cstdint>
#include <vector>

#include "cloth/clearance_cache.h"
#include "cloth/contact.h"

namespace karinui {

// The penalty on `area` of cloth (m2) at `depth` within an `offset` from the surface: newtons, and its derivative, N/m.
struct Penalty {
  double force = 0, stiffness = 0;
};
Penalty colliderPenalty(double area, double depth, double offset);

// Metres in a step: a contact that slipped less is taken to stick.
inline constexpr double kLeastSlip = 4e-6;

class ColliderContact : public Contact {
 public:
  struct Node {
    NodeIndex node = 0;
    double area = 0, friction = 0;  // m2; coefficient
  };
  // `nodes`: those that move. `offset`: how far from the surface the penalty begins, metres. The collider must outlive
  // this.
  ColliderContact(const Collider& collider, std::vector<Node> nodes, std::size_t nodeCount, double offset);

  const char* name() const override { return "collider"; }
  void detect(const ContactQuery& query, Workers& workers) override;
  void addGradient(std::span<Vec3> gradient) const override;
  void addHessian(ContactHessian& hessian) const override;
  void addSlipForce(std::span<Vec3> force) const override;
  void limitMove(std::span<const Vec3> x, std::vector<Vec3>& move, Workers& workers) override;
  void afterStep(std::span<const Vec3> x, bool friction, Workers& workers) override;
  void reset() override;

  std::size_t touching() const { return touching_; }  // nodes
  // The surface's normal where the node touches it; zero where it does not.
  Vec3 normalAt(NodeIndex node) const { return slot_[node] == kNoNode ? Vec3{} : at_[slot_[node]].normal; }

 private:
  struct At {
    bool touches = false, stuck = false;
    Vec3 normal, anchor, force, slipForce;
    double along = 0, across = 0;  // N/m, of the normal and of the tangent
    double slip = 0;               // metres, in the last step
    double cut = 0;                // metres that limitMove took off the last move into the surface
    int pressed = 0;               // steps in a row in which it did
    double multiplier = 0;         // N, along the normal: what presses harder than the penalty bears
  };
  Vec3 limited(Vec3 from, Vec3 move) const;

  const Collider& collider_;
  std::vector<Node> nodes_;
  std::vector<At> at_;
  ClearanceCache cache_;
  std::vector<std::uint32_t> slot_;  // per cloth node: its place in nodes_
  double offset_;
  std::size_t touching_ = 0;
};

}  // namespace karinui

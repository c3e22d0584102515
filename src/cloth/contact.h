#pragma once
// What acts on cloth beside its own fabric and weight, as one interface: colliders, cloth on cloth, seams being closed,
// crossed cloth being separated, a hand. The solver keeps a list of contacts and asks them in its order, once for a
// whole level, never node by node.
//
// Where a step calls them:
//   detect, addGradient, addHessian   when forces and the linear system are assembled
//   addSlipForce                      when the right-hand side is made
//   limitMove                         before the move is applied
//   afterStep                         after it was applied
#include <span>
#include <vector>

#include "cloth/block_system.h"
#include "karinui/base/workers.h"

namespace karinui {

// N/m per m2 of cloth that is in contact: 30 N/m for each cm2. Of penalties and of friction's springs.
inline constexpr double kContactStiffness = 3e5;

// Collects the stiffness of contacts for the step's system. A sum in float depends on its order, so each kind of entry
// is summed by itself, in the order of the list: isotropic entries, then those at nodes, then couplings.
class ContactHessian {
 public:
  ContactHessian(const TieMap& ties, BlockSystem& system) : ties_(ties), system_(system) {}

  // `stiffness` (N/m) in every direction, at a node.
  void addIsotropic(NodeIndex node, double stiffness);
  // weight * (along n n^T + across (I - n n^T)) at a node; N/m.
  void addAtNode(NodeIndex node, double weight, Vec3 normal, double along, double across);
  // The same on a weighted sum of nodes.
  void addBetween(std::span<const NodeIndex> nodes, std::span<const double> weights, Vec3 normal, double along,
                  double across);
  void finish();  // hands everything to the system; call once, last

 private:
  struct AtNode {
    NodeIndex node = 0;
    double weight = 1, along = 0, across = 0;
    Vec3 normal;
  };
  const TieMap& ties_;
  BlockSystem& system_;
  std::vector<AtNode> atNodes_;
  std::vector<Coupling> couplings_;
};

struct ContactQuery {
  std::span<const Vec3> x;  // where the nodes stand; valid during the call
  bool friction = true;     // with colliders
  // Contacts that slipped in the last step keep friction's force but none of its stiffness: the move that is then found
  // tells whether they would slip on.
  bool sliding = false;
};

class Contact {
 public:
  virtual ~Contact() = default;
  virtual const char* name() const = 0;  // for the profile; contacts of one kind share it
  virtual void setTies(const TieMap&) {}
  // Finds what is in contact. The functions below are about what was found last.
  virtual void detect(const ContactQuery& query, Workers& workers) = 0;
  virtual void addGradient(std::span<Vec3> gradient) const = 0;  // newtons, per node
  virtual void addHessian(ContactHessian& hessian) const = 0;
  // A contact that slipped is expected to slip as far again, which does not load its friction. This part of the force
  // goes to the right-hand side; without it sliding cloth would creep, and would turn back when it stops.
  virtual void addSlipForce(std::span<Vec3>) const {}
  // Shortens or turns moves of nodes that would pass through something.
  virtual void limitMove(std::span<const Vec3>, std::vector<Vec3>&, Workers&) {}
  virtual void afterStep(std::span<const Vec3>, [[maybe_unused]] bool friction, Workers&) {}
  virtual void reset() {}  // the cloth or a collider was placed elsewhere: forgets friction and what was near
};

}  // namespace karinui

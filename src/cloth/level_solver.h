#pragma once
// One level of a garment on its way to rest: strongly damped implicit steps (backward Euler with long time steps,
// velocity kept), each one linear solve. See docs/develop/drape.md.
#include <memory>
#include <optional>
#include <vector>

#include "cloth/block_system.h"
#include "cloth/collider_contact.h"
#include "cloth/hand_contact.h"
#include "cloth/intersection_removal.h"
#include "cloth/membrane.h"
#include "cloth/panel_stretch.h"
#include "cloth/seam_closing.h"
#include "cloth/self_contact.h"
#include "cloth/springs.h"
#include "karinui/cloth/settle.h"

namespace karinui {

class LevelSolver {
 public:
  // The cloth and the colliders must outlive this. `x`: where the cloth stands.
  // `clothRadius`: how near cloth comes to cloth, metres.
  LevelSolver(const Cloth& cloth, std::vector<Vec3> x, const ColliderList& colliders, const SettleSettings& settings,
              double clothRadius, Workers& workers);
  LevelSolver(const LevelSolver&) = delete;  // its contacts refer to it
  LevelSolver& operator=(const LevelSolver&) = delete;

  struct Stride {
    double seconds = 1.0 / 60, keep = 1;  // of the velocity
    double mostMove = 0;                  // metres; the whole step is shortened to it
    Vec3 gravity;
    bool friction = true;
    double closing = 1;  // how much firmer than usual open seams are drawn together
    bool calm = false;   // nodes that turn back at every step are slowed, one by one
    BlockSystem::Stop stop;
  };
  struct Outcome {
    double move = 0;      // largest, metres
    double residual = 0;  // rms unbalanced force in node weights, before the step
    double along = 0;     // cosine between this step's moves and the last one's: 1 is creep, below 0 swinging
    bool shortened = false, finite = true;
    int iterations = 0;
  };
  Outcome step(const Stride& stride, const Token& token);
  // The largest move of one long, well converged step; nothing moves. `moves`: of each node.
  Outcome predict(const Stride& stride, const Token& token, std::vector<Vec3>* moves = nullptr);
  // What the cloth's own threads pull each node with, newtons, also those that stand still.
  std::vector<Vec3> pulls();
  // How each node would go in one well converged step if nothing but `force` (newtons, per node) were out of balance.
  std::vector<Vec3> answerTo(const std::vector<Vec3>& force, const Stride& stride, const Token& token);

  const Cloth& cloth() const { return cloth_; }
  const std::vector<Vec3>& places() const { return x_; }
  void place(std::vector<Vec3> x);  // stand elsewhere, at rest
  // Stands as moved, as far as nothing passes through other cloth; at rest.
  void moveGuarded(std::vector<Vec3> moves);
  bool allTied() const { return open_ == 0; }
  void tieWithin(double gap);  // ties every open pair nearer than this
  // Whether cloth meets cloth; it does at first.
  void meetCloth(bool on) { self_->enable(on); }
  // Looks whether the cloth stands crossed, and if so takes it apart in the steps that follow, as long as that helps;
  // whether there is something to take apart.
  bool untangle();
  std::size_t crossings();       // of an edge with a face, as it stands
  void stop();                   // forget velocity and anchors
  std::size_t touching() const;  // nodes in contact with a collider
  const std::vector<NodeIndex>& moving() const { return moving_; }

  void setHand(std::optional<Hand> hand) { hand_->set(std::move(hand)); }
  Vec3 handForce() const;  // newtons the hand feels: what threads stretched beyond their length pull with
  std::vector<ContactTime> contactTimes() const;  // so far; contacts of one name together

 private:
  bool sound() const;                                         // whether every place is a number
  void assemble(const Stride& stride, bool sliding = false);  // forces and system at x_
  template <class Use>
  void eachContact(const Use& use);     // in order, with its time taken
  double residual() const;              // rms of force_, in node weights
  void calmDown(const Stride& stride);  // after a step, before velocities change
  void rebuild();                       // after ties changed

  const Cloth& cloth_;
  Workers& workers_;
  std::vector<Vec3> x_, velocity_, gradient_;
  std::vector<double> mass_;
  std::vector<std::uint8_t> held_, tied_;
  std::size_t open_ = 0;
  std::vector<NodeIndex> moving_;
  PanelPlan plan_;
  PanelStretch stretch_;
  std::vector<std::unique_ptr<Energy>> energies_;  // beside the panels' stretch
  std::vector<const BlockEnergy*> blockEnergies_;  // of energies_
  const Membrane* membrane_ = nullptr;             // of energies_
  std::vector<const Springs*> springs_;            // of energies_
  Springs* simcloth_ = nullptr;                    // of springs_; null: none of the pieces is
  std::vector<Block3> blocks_;
  std::unique_ptr<TieMap> ties_;
  std::unique_ptr<BlockSystem> system_;
  std::vector<std::unique_ptr<Contact>> contacts_;  // in the order they are asked; those below are of them
  std::vector<double> contactSeconds_;              // of each
  std::vector<const ColliderContact*> colliders_;
  SelfContact* self_ = nullptr;
  SeamClosing* seams_ = nullptr;
  IntersectionRemoval* intersections_ = nullptr;
  HandContact* hand_ = nullptr;
  double nodeWeight_ = 0;
  std::vector<double> slowing_;  // N/m per node: a step's way costs so much, wherever it leads
  std::vector<Vec3> force_, move_, nodeMove_;
};

// On coarse levels cloth keeps further away, so that finer cloth finds room.
double skinOffset(const SettleSettings& settings, double spacing, double finest);
double clothRadius(double spacing, double finest);

}  // namespace karinui

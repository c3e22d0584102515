#pragma once
// Brings one level of a garment towards static equilibrium by implicit time steps: backward Euler (Baraff and Witkin
// 1998) with long steps, each one linear solve. See docs/develop/drape.md.
#include <memory>
#include <optional>
#include <vector>

#include "cloth/block_system.h"
#include "cloth/creep_momentum.h"
#include "cloth/grid_membrane.h"
#include "cloth/level_terms.h"

namespace karinui {

inline constexpr double kFrame = 1.0 / 60;  // seconds of a usual step

class LevelSolver {
 public:
  // The cloth and the colliders must outlive this. `x`: where the cloth stands.
  // `clothRadius`: how near cloth comes to cloth, metres. `added`: energies and contacts beside those of every level.
  LevelSolver(const Cloth& cloth, std::vector<Vec3> x, const ColliderList& colliders, const SettleSettings& settings,
              double clothRadius, Workers& workers, AddedTerms added = {});
  LevelSolver(const LevelSolver&) = delete;  // its contacts refer to it
  LevelSolver& operator=(const LevelSolver&) = delete;

  struct StepOptions {
    double seconds = kFrame;
    double velocityKept = 1;  // share
    double mostMove = 0;      // metres; the whole step is scaled to it
    Vec3 gravity;
    bool friction = true;  // with colliders
    double seamPull = 1;   // factor on the force that closes open seams
    bool damped = false;   // nodes that reverse at every step are damped, one by one
    int newton = 1;        // iterations of Newton's method: linear solves, each with forces and system anew
    BlockSystem::StoppingRule stopping;
  };
  struct StepResult {
    double move = 0;      // largest, metres
    double residual = 0;  // rms unbalanced force in node weights, before the step
    double along = 0;     // cosine between this step's moves and the last one's: 1 is creep, below 0 oscillation
    double work = 0;      // of the unbalanced force along the move, joules: what the energy fell by, to first order
    bool shortened = false, finite = true;
    int iterations = 0;
  };
  StepResult step(const StepOptions& options, const Token& token);
  // The largest move of a step that is computed but not taken. `moves`: of each node.
  StepResult predict(const StepOptions& options, const Token& token, std::vector<Vec3>* moves = nullptr);
  // The force of stretch, shear and bending on each node, newtons, also on those that do not move.
  std::vector<Vec3> internalForces();
  // Joules of stretch, shear, bending and height at x; what contacts store is not in it.
  double potentialEnergy(Vec3 gravity);
  // The move of each node in a step by `force` (newtons, per node) in place of the unbalanced force; not taken.
  std::vector<Vec3> responseTo(const std::vector<Vec3>& force, const StepOptions& options, const Token& token);

  // The weight of all that moves, newtons.
  double weight() const { return nodeWeight_ * static_cast<double>(moving_.size()); }
  const Cloth& cloth() const { return cloth_; }
  const std::vector<Vec3>& positions() const { return x_; }
  void setPositions(std::vector<Vec3> x);  // at rest there
  // Moves the nodes as far as the collision filter allows; at rest there.
  void moveFiltered(std::vector<Vec3> moves);
  bool allTied() const { return open_ == 0; }
  // Ties every open pair nearer than this, or only those of one piece.
  void tieWithin(double gap, bool withinAPiece = false);
  // Whether cloth meets cloth; it does at first.
  void enableSelfContact(bool on) { contacts_->self->enable(on); }
  void meetOnlyLayers(bool only) { contacts_->self->onlyLayers(only); }
  // Looks whether the cloth intersects itself and if so separates it in the steps that follow; whether there is
  // something to separate.
  bool separateIntersections();
  std::size_t intersections();   // of an edge with a face, as it stands
  void resetMotion();            // forgets velocity, damping and friction
  std::size_t touching() const;  // nodes in contact with a collider
  const std::vector<NodeIndex>& moving() const { return moving_; }

  void setHand(std::optional<Hand> hand) { contacts_->hand->set(std::move(hand)); }
  Vec3 handForce() const;                         // newtons: of threads stretched beyond their length
  std::vector<ContactTime> contactTimes() const;  // so far; contacts of one name together

 private:
  bool allFinite() const;                                           // positions
  void assemble(const StepOptions& options, bool sliding = false);  // forces and system at x_
  template <class Use>
  void eachContact(const Use& use);                // in order, with its time taken
  double residual() const;                         // rms of force_, in node weights
  void updateDamping(const StepOptions& options);  // after a step, before velocities change
  // While the cloth creeps, moves it ahead by a share of the last move, which it returns; 0: not moved. `ahead`: by how
  // far each node was moved.
  double moveAhead(const StepOptions& options, std::vector<Vec3>& ahead);
  // Improves nodeMove_, which a step's first iteration from `from` found, by the others; how many iterations of their
  // linear solves. `coasting`: the force of the velocity so far, newtons per node; `ahead`: the part of the move that
  // inertia does not resist, or empty.
  int refineMove(const StepOptions& options, const std::vector<Vec3>& from, const std::vector<Vec3>& coasting,
                 const std::vector<Vec3>& ahead, const Token& token);
  std::optional<double> longestMove() const;  // of nodeMove_, metres; none where it is not finite
  struct Moved {                              // sums of squares, but for the work
    double work = 0;                          // joules, of the gradient along the move
    double now = 0, before = 0, both = 0;     // of the moves, the velocities before, and their products
    double most = 0;                          // the greatest of the moves'
  };
  Moved advance(double seconds);  // by nodeMove_, which took so long
  void rebuild();                 // after ties changed

  const Cloth& cloth_;
  Workers& workers_;
  std::vector<Vec3> x_, velocity_, gradient_;
  std::vector<double> mass_;
  std::vector<std::uint8_t> held_, tied_;
  std::size_t open_ = 0;
  std::vector<NodeIndex> moving_;
  GridLayout layout_;
  GridMembrane membraneOnGrid_;
  LevelEnergies energies_;                   // beside the grid blocks' membrane
  std::unique_ptr<Energy> bending_;          // after those
  std::unique_ptr<Membrane> wholeMembrane_;  // with what lies in grid blocks, for the energy's value; made when asked
  std::vector<Block3> blocks_;
  std::unique_ptr<TieMap> ties_;
  std::unique_ptr<BlockSystem> system_;
  std::unique_ptr<LevelContacts> contacts_;
  std::vector<double> contactSeconds_;  // of each
  double nodeWeight_ = 0;               // newtons, mean
  std::vector<double> damping_;         // N/m per node, on the move of a step in any direction
  CreepMomentum momentum_;
  std::vector<Vec3> force_, move_, nodeMove_;
};

// Offsets of contact, metres. On coarse levels they are wider, so that the finer cloth finds room.
double skinOffset(const SettleSettings& settings, double spacing, double finest);
double clothRadius(const Cloth& cloth, double finest);  // of the thickest fabric

}  // namespace karinui

#include "cloth/level_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <set>

#include "cloth/bending.h"
#include "cloth/edge_bending.h"
#include "cloth/lattice_areas.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

constexpr double kCoarser = 1.25;     // times the finest spacing: a coarse level
constexpr double kRadiusShare = 0.3;  // of a coarse spacing: how near cloth comes to cloth
// More layers are together as thick as these: six that were each as thick as cells ask rode up from the waist to where
// the body is wider, and stayed there.
constexpr double kFullLayers = 3;

constexpr double kSlackShare =
    0.3;  // of a step's largest move: the slack below which springs enter the matrix as taut,
constexpr double kLeastSlack = 1e-7, kMostSlack = 0.05;  // and its bounds: metres, spacings
constexpr double kReversal = 5e-6;                       // metres: a longer move against the last one is a reversal,
constexpr double kDampingGrowth = 3;                     // factor on the damping each time,
constexpr double kDampingDecay = 0.7;                    // and each time there is none;
constexpr double kMostDamping = 1e5;                     // times inertia, at most
constexpr double kCreepSeconds = 1.0001 / 30;            // of a step: only cloth that creeps takes longer ones
// Of the solve of a step that went ahead. Its first iterations take out what that strained, and say nothing about the
// waves that are left.
constexpr int kLeastAhead = 64, kUncountedAhead = 12;
constexpr double kToleranceAhead = 2;  // times that of other steps

struct Moving {
  std::vector<NodeIndex> nodes;
  std::vector<std::uint8_t> held;  // per cloth node
  std::vector<double> mass, area;
  std::vector<ColliderContact::Node> contact;  // with the fabrics' own friction
};

Moving movingOf(const Cloth& cloth) {
  Moving moving;
  moving.held.assign(cloth.nodeCount, 1);
  moving.mass.assign(cloth.nodeCount, 0);
  moving.area.assign(cloth.nodeCount, 0);
  std::vector<double> friction(cloth.nodeCount, 0);
  for (const ClothPiece& piece : cloth.pieces) {
    if (!piece.live) continue;
    const LatticeAreas shares = latticeAreas(*piece.lattice);
    const double least = 0.01 * piece.lattice->spacing * piece.lattice->spacing;
    for (std::size_t k = 0; k < shares.cell.size(); ++k) {
      const std::size_t node = piece.firstNode + k;
      moving.held[node] = 0;
      moving.area[node] = std::max(least, shares.cell[k] + shares.ring[k]);
      moving.mass[node] = moving.area[node] * piece.fabric.weight;
      friction[node] = piece.fabric.frictionBody;
    }
  }
  for (const auto& [node, more] : edgeMasses(cloth)) moving.mass[node] += more;
  for (std::uint32_t node : cloth.pinned) moving.held[node] = 1;
  for (NodeIndex node = 0; node < cloth.nodeCount; ++node)
    if (!moving.held[node]) {
      moving.nodes.push_back(node);
      moving.contact.push_back({node, moving.area[node], friction[node]});
    }
  return moving;
}

}  // namespace

double skinOffset(const SettleSettings& settings, double spacing, double finest) {
  return spacing > kCoarser * finest ? std::max(settings.skin, 0.12 * spacing) : settings.skin;
}

double clothRadius(const Cloth& cloth, double finest) {
  if (!(cloth.spacing > kCoarser * finest)) return thickestRadius(cloth);
  std::set<int> layers;
  for (const ClothPiece& piece : cloth.pieces) layers.insert(piece.layer);
  return kRadiusShare * cloth.spacing * std::fmin(1, kFullLayers / static_cast<double>(layers.size()));
}

LevelSolver::LevelSolver(const Cloth& cloth, std::vector<Vec3> x, const ColliderList& colliders,
                         const SettleSettings& settings, double clothRadius, Workers& workers, AddedTerms added)
    : cloth_(cloth),
      workers_(workers),
      x_(std::move(x)),
      velocity_(cloth.nodeCount),
      gradient_(cloth.nodeCount),
      tied_(cloth.ties.size(), 0),
      layout_(cloth),
      membraneOnGrid_(cloth, layout_),
      energies_(cloth, layout_) {
  Moving moving = movingOf(cloth);
  mass_ = std::move(moving.mass);
  held_ = std::move(moving.held);
  moving_ = std::move(moving.nodes);
  damping_.assign(cloth.nodeCount, 0);
  double total = 0;
  for (NodeIndex k : moving_) total += mass_[k];
  const double g = length(settings.gravity);
  nodeWeight_ = std::max(1e-12, total / std::max<std::size_t>(1, moving_.size()) * (g > 0 ? g : 9.81));

  std::move(added.energies.begin(), added.energies.end(), std::back_inserter(energies_.list));
  std::vector<NodePair> pairs;
  for (const auto& energy : energies_.list) energy->appendPairs(pairs);
  auto bending = std::make_unique<Bending>(cloth, held_, layout_, workers);
  system_ = std::make_unique<BlockSystem>(cloth, layout_, bending->grid(), pairs, bending->remainder());
  bending_ = std::move(bending);
  blocks_.resize(pairs.size());
  // Ties between nodes that do not move cannot be closed here.
  for (std::size_t t = 0; t < cloth.ties.size(); ++t) {
    const Tie& tie = cloth.ties[t];
    if (held_[tie.a] && held_[tie.b] && (tie.c == kNoNode || held_[tie.c])) tied_[t] = 1;
  }
  contacts_ = std::make_unique<LevelContacts>(cloth, colliders, moving.contact, moving_, tied_, settings, clothRadius);
  std::move(added.contacts.begin(), added.contacts.end(), std::back_inserter(contacts_->list));
  contactSeconds_.assign(contacts_->list.size(), 0);
  rebuild();
}

template <class Use>
void LevelSolver::eachContact(const Use& use) {
  for (std::size_t k = 0; k < contacts_->list.size(); ++k) {
    const auto start = std::chrono::steady_clock::now();
    use(*contacts_->list[k]);
    contactSeconds_[k] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
}

std::vector<ContactTime> LevelSolver::contactTimes() const {
  std::vector<ContactTime> times;
  for (std::size_t k = 0; k < contacts_->list.size(); ++k) {
    const auto at = std::find_if(times.begin(), times.end(),
                                 [&](const ContactTime& time) { return time.name == contacts_->list[k]->name(); });
    if (at == times.end())
      times.push_back({contacts_->list[k]->name(), contactSeconds_[k]});
    else
      at->seconds += contactSeconds_[k];
  }
  return times;
}

std::size_t LevelSolver::touching() const {
  std::size_t nodes = 0;
  for (const ColliderContact* contact : contacts_->colliders) nodes += contact->touching();
  return nodes;
}

void LevelSolver::rebuild() {
  ties_ = std::make_unique<TieMap>(cloth_, held_, tied_);
  ties_->enforce(x_);
  system_->setTies(*ties_);
  for (const auto& contact : contacts_->list) contact->setTies(*ties_);
  open_ = static_cast<std::size_t>(std::count(tied_.begin(), tied_.end(), 0));
}

void LevelSolver::setPositions(std::vector<Vec3> x) {
  x_ = std::move(x);
  ties_->enforce(x_);
  resetMotion();
}

void LevelSolver::moveFiltered(std::vector<Vec3> moves) {
  ties_->makeAdmissible(moves);
  contacts_->self->limitMove(x_, moves, workers_);
  for (NodeIndex k = 0; k < cloth_.nodeCount; ++k) x_[k] += moves[k];
  ties_->enforce(x_);
  resetMotion();
}

// Between two sides of a crease, or where a wrinkle snaps, a node may oscillate for ever while all else rests. Damping
// that grows with each reversal ends that. It changes no equilibrium, and rest is judged by a step without it.
void LevelSolver::updateDamping(const StepOptions& options) {
  if (!options.damped) return;
  for (NodeIndex k : moving_) {
    const double inertia = mass_[k] / (options.seconds * options.seconds);
    const bool reverses = dot(nodeMove_[k], velocity_[k]) < 0 && squaredLength(nodeMove_[k]) > kReversal * kReversal;
    damping_[k] = reverses ? std::fmin(kMostDamping * inertia, kDampingGrowth * (damping_[k] + inertia))
                           : kDampingDecay * damping_[k];
    if (damping_[k] < 0.1 * inertia) damping_[k] = 0;
  }
}

void LevelSolver::resetMotion() {
  std::fill(velocity_.begin(), velocity_.end(), Vec3{});
  std::fill(damping_.begin(), damping_.end(), 0.0);
  momentum_.reset();
  for (const auto& contact : contacts_->list) contact->reset();
}

void LevelSolver::tieWithin(double gap, bool withinAPiece) {
  bool changed = false;
  for (std::size_t t = 0; t < tied_.size(); ++t) {
    const Tie& tie = cloth_.ties[t];
    if (tied_[t] || !(length(gapOf(tie, x_)) < gap)) continue;
    if (withinAPiece && &pieceOf(cloth_, tie.a) != &pieceOf(cloth_, tie.b)) continue;
    tied_[t] = 1;
    changed = true;
  }
  if (!changed) return;
  momentum_.reset();
  rebuild();
  // What is tied moves as one from now on, with its common momentum.
  std::vector<Vec3> impulse(cloth_.nodeCount), mass(cloth_.nodeCount), p, m;
  for (NodeIndex k : moving_) {
    impulse[k] = velocity_[k] * mass_[k];
    mass[k] = Vec3{mass_[k], 0, 0};
  }
  ties_->reduce(impulse, p);
  ties_->reduce(mass, m);
  for (std::size_t u = 0; u < p.size(); ++u) p[u] = m[u].x > 0 ? p[u] * (1 / m[u].x) : Vec3{};
  ties_->expand(p, velocity_);
}

bool LevelSolver::separateIntersections() { return contacts_->intersections->start(x_, workers_); }

std::size_t LevelSolver::intersections() { return contacts_->intersections->count(x_, workers_); }

void LevelSolver::assemble(const StepOptions& options, bool sliding) {
  std::fill(gradient_.begin(), gradient_.end(), Vec3{});
  membraneOnGrid_.evaluate(x_, gradient_, system_->gridStiffness(), workers_);
  for (const auto& energy : energies_.list) energy->addGradient(x_, gradient_, workers_);
  bending_->addGradient(x_, gradient_, workers_);
  for (NodeIndex k : moving_) gradient_[k] -= options.gravity * mass_[k];
  contacts_->seams->setStrength(options.seamPull);
  eachContact([&](Contact& contact) { contact.detect({x_, options.friction, sliding}, workers_); });
  eachContact([&](Contact& contact) { contact.addGradient(gradient_); });

  std::size_t at = 0;
  for (const auto& energy : energies_.list) {
    energy->blocks(x_, std::span(blocks_).subspan(at, energy->pairCount()), workers_);
    at += energy->pairCount();
  }
  system_->assemble(blocks_, workers_);
  const double inertia = 1 / (options.seconds * options.seconds);
  ContactHessian hessian(*ties_, *system_);
  for (NodeIndex k : moving_) hessian.addIsotropic(k, mass_[k] * inertia + (options.damped ? damping_[k] : 0));
  eachContact([&](Contact& contact) { contact.addHessian(hessian); });
  hessian.finish();
}

bool LevelSolver::allFinite() const {
  return std::all_of(x_.begin(), x_.end(), [](Vec3 p) { return finite(p); });
}

double LevelSolver::residual() const {
  double squares = 0;
  for (Vec3 f : force_) squares += squaredLength(f);
  return std::sqrt(squares / static_cast<double>(force_.size())) / nodeWeight_;
}

double LevelSolver::moveAhead(const StepOptions& options, std::vector<Vec3>& ahead) {
  const bool creeps = options.seconds > kCreepSeconds && options.friction && open_ == 0 && !contacts_->hand->hand() &&
                      !contacts_->intersections->active();
  const double share = momentum_.share(creeps, cloth_.spacing);
  if (!(share > 0)) return 0;
  ahead.assign(cloth_.nodeCount, {});
  for (NodeIndex k : moving_) ahead[k] = momentum_.lastMove()[k] * share;
  eachContact([&](Contact& contact) { contact.limitMove(x_, ahead, workers_); });
  const std::vector<Vec3> from = x_;
  for (NodeIndex k : moving_) x_[k] += ahead[k];
  if (!cloth_.ties.empty()) ties_->enforce(x_);
  for (NodeIndex k : moving_) ahead[k] = x_[k] - from[k];
  return share;
}

// One linear solve strains threads to second order in the move. Left in, that strain is what the next step takes out in
// place of moving on, and long steps do not hold. Friction's force is known where the first solve led to, so nothing is
// guessed of how far contacts slip.
int LevelSolver::refineMove(const StepOptions& options, const std::vector<Vec3>& from,
                            const std::vector<Vec3>& coasting, const std::vector<Vec3>& ahead, const Token& token) {
  int iterations = 0;
  if (options.newton < 2) return iterations;
  const std::vector<Vec3> gradient = gradient_;
  const double inertia = 1 / (options.seconds * options.seconds);
  std::vector<Vec3> force(cloth_.nodeCount), more;
  for (int k = 1; k < options.newton && !token.cancelled(); ++k) {
    for (NodeIndex n : moving_) x_[n] = from[n] + nodeMove_[n];
    if (!cloth_.ties.empty()) ties_->enforce(x_);
    assemble(options);
    for (NodeIndex n : moving_) {
      const Vec3 resisted = ahead.empty() ? nodeMove_[n] : nodeMove_[n] - ahead[n];
      force[n] = coasting[n] - gradient_[n] - resisted * (mass_[n] * inertia);
    }
    ties_->reduce(force, force_);
    iterations += system_->solve(force_, options.stopping, token, workers_, move_);
    ties_->expand(move_, more);
    if (!std::all_of(more.begin(), more.end(), [](Vec3 m) { return finite(m); })) break;
    eachContact([&](Contact& contact) { contact.limitMove(x_, more, workers_); });
    for (NodeIndex n : moving_) nodeMove_[n] = x_[n] - from[n] + more[n];
  }
  x_ = from;
  gradient_ = gradient;
  return iterations;
}

std::optional<double> LevelSolver::longestMove() const {
  double most = 0;
  for (NodeIndex k : moving_) {
    const double own = squaredLength(nodeMove_[k]);
    if (!std::isfinite(own)) return std::nullopt;
    most = std::max(most, own);
  }
  return std::sqrt(most);
}

LevelSolver::Moved LevelSolver::advance(double seconds) {
  const std::vector<Moved> blocks = workers_.each(moving_.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    Moved moved;
    for (std::size_t n = begin; n < end; ++n) {
      const NodeIndex k = moving_[n];
      const double own = squaredLength(nodeMove_[k]);
      x_[k] += nodeMove_[k];
      moved.work -= dot(gradient_[k], nodeMove_[k]);
      moved.now += own;
      moved.before += squaredLength(velocity_[k]);
      moved.both += dot(nodeMove_[k], velocity_[k]);
      moved.most = std::max(moved.most, own);
      velocity_[k] = nodeMove_[k] * (1 / seconds);
    }
    return moved;
  });
  Moved whole;
  for (const Moved& moved : blocks) {
    whole.work += moved.work;
    whole.now += moved.now;
    whole.before += moved.before;
    whole.both += moved.both;
    whole.most = std::max(whole.most, moved.most);
  }
  return whole;
}

LevelSolver::StepResult LevelSolver::step(const StepOptions& options, const Token& token) {
  StepResult result;
  if (ties_->unknowns() == 0) return result;
  result.finite = allFinite();
  if (!result.finite) return result;
  const std::vector<Vec3> from = x_;
  std::vector<Vec3> ahead;
  const double share = moveAhead(options, ahead);
  StepOptions use = options;
  if (share > 0) {
    use.damped = true;
    use.stopping.least = std::max(kLeastAhead, options.stopping.least);
    use.stopping.uncounted = kUncountedAhead;
    use.stopping.tolerance = kToleranceAhead * options.stopping.tolerance;
  }
  assemble(use);
  std::vector<Vec3> nodeForce(cloth_.nodeCount), slip(cloth_.nodeCount), coasting(cloth_.nodeCount);
  for (NodeIndex k : moving_) nodeForce[k] = -gradient_[k];
  ties_->reduce(nodeForce, force_);
  result.residual = residual();
  // A step that went ahead has coasted and slipped by its share already.
  eachContact([&](Contact& contact) { contact.addSlipForce(slip); });
  const double coast = share > 0 ? 0 : options.velocityKept / options.seconds;
  for (NodeIndex k : moving_) {
    coasting[k] = velocity_[k] * (mass_[k] * coast);
    nodeForce[k] += coasting[k] + slip[k] * (1 - share);
  }
  ties_->reduce(nodeForce, force_);
  result.iterations = system_->solve(force_, use.stopping, token, workers_, move_);
  ties_->expand(move_, nodeMove_);
  if (share > 0) {
    x_ = from;
    for (NodeIndex k : moving_) nodeMove_[k] += ahead[k];
  }
  const auto most = longestMove();
  result.finite = most && std::isfinite(result.residual);
  if (!result.finite || token.cancelled()) return result;
  const double scale = *most > options.mostMove ? options.mostMove / *most : 1;
  result.shortened = scale < 1;
  if (result.shortened)
    for (NodeIndex k : moving_) nodeMove_[k] = nodeMove_[k] * scale;
  eachContact([&](Contact& contact) { contact.limitMove(x_, nodeMove_, workers_); });
  if (!result.shortened) {
    use.stopping = options.stopping;
    result.iterations += refineMove(use, from, coasting, ahead, token);
    if (token.cancelled()) return result;
  }
  updateDamping(use);
  const Moved whole = advance(options.seconds);
  result.move = std::sqrt(whole.most);
  result.work = whole.work;
  result.finite = std::isfinite(whole.now);
  if (!result.finite) return result;
  if (energies_.simcloth)
    energies_.simcloth->setSlackTolerance(
        std::clamp(kSlackShare * result.move, kLeastSlack, kMostSlack * cloth_.spacing));
  result.along = whole.now > 0 && whole.before > 0 ? whole.both / std::sqrt(whole.now * whole.before) : 0;
  momentum_.afterStep(nodeMove_, result.move, result.shortened, result.along);
  if (!cloth_.ties.empty()) ties_->enforce(x_);
  eachContact([&](Contact& contact) { contact.afterStep(x_, options.friction, workers_); });
  return result;
}

LevelSolver::StepResult LevelSolver::predict(const StepOptions& options, const Token& token, std::vector<Vec3>* moves) {
  StepResult result;
  if (ties_->unknowns() == 0) return result;
  result.finite = allFinite();
  if (!result.finite) return result;
  assemble(options, true);
  std::vector<Vec3> nodeForce(cloth_.nodeCount);
  for (NodeIndex k : moving_) nodeForce[k] = -gradient_[k];
  ties_->reduce(nodeForce, force_);
  result.residual = residual();
  result.iterations = system_->solve(force_, options.stopping, token, workers_, move_);
  result.finite = std::isfinite(result.residual);
  for (Vec3 m : move_) {
    result.finite = result.finite && finite(m);
    result.move = std::fmax(result.move, length(m));
  }
  if (moves) ties_->expand(move_, *moves);
  return result;
}

std::vector<Vec3> LevelSolver::internalForces() {
  std::vector<Vec3> pull(cloth_.nodeCount);
  membraneOnGrid_.evaluate(x_, pull, system_->gridStiffness(), workers_);
  for (const auto& energy : energies_.list) energy->addGradient(x_, pull, workers_);
  bending_->addGradient(x_, pull, workers_);
  for (Vec3& p : pull) p = -p;
  return pull;
}

double LevelSolver::potentialEnergy(Vec3 gravity) {
  if (!wholeMembrane_) wholeMembrane_ = std::make_unique<Membrane>(cloth_);
  double joules = wholeMembrane_->value(x_, workers_) + bending_->value(x_, workers_);
  for (const auto& energy : energies_.list)
    if (energy.get() != energies_.membrane) joules += energy->value(x_, workers_);
  for (NodeIndex k : moving_) joules -= mass_[k] * dot(gravity, x_[k]);
  return joules;
}

std::vector<Vec3> LevelSolver::responseTo(const std::vector<Vec3>& force, const StepOptions& options,
                                          const Token& token) {
  std::vector<Vec3> moves(cloth_.nodeCount);
  if (ties_->unknowns() == 0 || !allFinite()) return moves;
  assemble(options);
  ties_->reduce(force, force_);
  system_->solve(force_, options.stopping, token, workers_, move_);
  ties_->expand(move_, moves);
  return moves;
}

Vec3 LevelSolver::handForce() const {
  const std::optional<Hand>& hand = contacts_->hand->hand();
  if (!hand) return {};
  std::vector<std::uint8_t> patch(cloth_.nodeCount, 0);
  for (NodeIndex node : hand->nodes) patch[node] = 1;
  Vec3 force = energies_.membrane->tensionAt(x_, patch);
  for (const Springs* springs : energies_.springs) force += springs->tensionAt(x_, patch);
  return force;
}

}  // namespace karinui

#include "cloth/level_solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cloth/bending.h"
#include "cloth/collider_face_contact.h"
#include "cloth/lattice_shares.h"

namespace karinui {
namespace {

constexpr std::size_t kBlock = 256;  // nodes a worker takes at once
constexpr double kSlackReach = 0.3;  // of a step's largest move: what two ends of a spring move apart
constexpr double kLeastReach = 1e-7, kMostReach = 0.05;  // metres, spacings
constexpr double kTurnsBack = 5e-6;                      // metres a node moves that is said to turn back,
constexpr double kSlower = 3;                            // so many times slower each time it does,
constexpr double kQuicker = 0.7;                         // quicker again each time it does not,
constexpr double kSlowest = 1e5;                         // and at most so many times heavier than it is

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
    const LatticeShares shares = sharesOf(*piece.lattice);
    const double least = 0.01 * piece.lattice->spacing * piece.lattice->spacing;
    for (std::size_t k = 0; k < shares.cell.size(); ++k) {
      const std::size_t node = piece.firstNode + k;
      moving.held[node] = 0;
      moving.area[node] = std::max(least, shares.cell[k] + shares.ring[k]);
      moving.mass[node] = moving.area[node] * piece.fabric.weight;
      friction[node] = piece.fabric.frictionBody;
    }
  }
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
  return spacing > 1.25 * finest ? std::max(settings.skin, 0.12 * spacing) : settings.skin;
}

double clothRadius(double spacing, double finest) { return spacing > 1.25 * finest ? 0.2 * spacing : 0.002; }

LevelSolver::LevelSolver(const Cloth& cloth, std::vector<Vec3> x, const ColliderList& colliders,
                         const SettleSettings& settings, double clothRadius, Workers& workers)
    : cloth_(cloth),
      workers_(workers),
      x_(std::move(x)),
      velocity_(cloth.nodeCount),
      gradient_(cloth.nodeCount),
      tied_(cloth.ties.size(), 0),
      plan_(cloth),
      stretch_(cloth, plan_) {
  Moving moving = movingOf(cloth);
  mass_ = std::move(moving.mass);
  held_ = std::move(moving.held);
  moving_ = std::move(moving.nodes);
  slowing_.assign(cloth.nodeCount, 0);
  double total = 0;
  for (NodeIndex k : moving_) total += mass_[k];
  const double g = length(settings.gravity);
  nodeWeight_ = std::max(1e-12, total / std::max<std::size_t>(1, moving_.size()) * (g > 0 ? g : 9.81));

  std::vector<NodePair> pairs;
  const auto add = [&](auto energy) {
    auto* raw = energy.get();
    energy->appendPairs(pairs);
    blockEnergies_.push_back(raw);
    energies_.push_back(std::move(energy));
    return raw;
  };
  membrane_ = add(std::make_unique<Membrane>(cloth, &plan_));
  Springs* simcloth = add(std::make_unique<Springs>(simclothSprings(cloth), cloth.nodeCount));
  if (simcloth->count() > 0) simcloth_ = simcloth;
  springs_ = {simcloth, add(std::make_unique<Springs>(edgeSprings(cloth), cloth.nodeCount))};
  auto bending = std::make_unique<Bending>(cloth, held_, plan_, workers);
  system_ = std::make_unique<BlockSystem>(cloth, plan_, bending->panels(), pairs, bending->rest());
  energies_.push_back(std::move(bending));
  blocks_.resize(pairs.size());
  // Ties between nodes that do not move are not ours to close.
  for (std::size_t t = 0; t < cloth.ties.size(); ++t) {
    const Tie& tie = cloth.ties[t];
    if (held_[tie.a] && held_[tie.b] && (tie.c == kNoNode || held_[tie.c])) tied_[t] = 1;
  }
  const auto addContact = [&](auto contact) {
    auto* raw = contact.get();
    contacts_.push_back(std::move(contact));
    return raw;
  };
  // The last one to limit a move is obeyed: that is the first of the list.
  for (std::size_t k = colliders.entries().size(); k-- > 0;) {
    const ColliderList::Entry& entry = colliders.entries()[k];
    std::vector<ColliderContact::Node> nodes = moving.contact;
    if (entry.friction)
      for (ColliderContact::Node& node : nodes) node.friction = *entry.friction;
    colliders_.push_back(addContact(
        std::make_unique<ColliderContact>(*entry.collider, std::move(nodes), cloth.nodeCount, settings.skin)));
    addContact(std::make_unique<ColliderFaceContact>(cloth, *entry.collider, settings.skin));
  }
  self_ = addContact(std::make_unique<SelfContact>(cloth, clothRadius));
  seams_ = addContact(std::make_unique<SeamClosing>(cloth, tied_, colliders_));
  intersections_ = addContact(std::make_unique<IntersectionRemoval>(cloth, moving_, *self_));
  hand_ = addContact(std::make_unique<HandContact>());
  contactSeconds_.assign(contacts_.size(), 0);
  rebuild();
}

template <class Use>
void LevelSolver::eachContact(const Use& use) {
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const auto start = std::chrono::steady_clock::now();
    use(*contacts_[k]);
    contactSeconds_[k] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
}

std::vector<ContactTime> LevelSolver::contactTimes() const {
  std::vector<ContactTime> times;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const auto at = std::find_if(times.begin(), times.end(),
                                 [&](const ContactTime& time) { return time.name == contacts_[k]->name(); });
    if (at == times.end())
      times.push_back({contacts_[k]->name(), contactSeconds_[k]});
    else
      at->seconds += contactSeconds_[k];
  }
  return times;
}

std::size_t LevelSolver::touching() const {
  std::size_t nodes = 0;
  for (const ColliderContact* contact : colliders_) nodes += contact->touching();
  return nodes;
}

void LevelSolver::rebuild() {
  ties_ = std::make_unique<TieMap>(cloth_, held_, tied_);
  ties_->gather(x_);
  system_->setTies(*ties_);
  for (const auto& contact : contacts_) contact->setTies(*ties_);
  open_ = static_cast<std::size_t>(std::count(tied_.begin(), tied_.end(), 0));
}

void LevelSolver::place(std::vector<Vec3> x) {
  x_ = std::move(x);
  ties_->gather(x_);
  stop();
}

void LevelSolver::moveGuarded(std::vector<Vec3> moves) {
  ties_->share(moves);
  self_->limitMove(x_, moves, workers_);
  for (NodeIndex k = 0; k < cloth_.nodeCount; ++k) x_[k] += moves[k];
  ties_->gather(x_);
  stop();
}

// Between two sides of a crease, or where a wrinkle snaps, a node may go to and fro for ever while all else rests. A
// cost on its way makes each turn shorter; it moves no rest, and what is judged for rest is predicted without it.
void LevelSolver::calmDown(const Stride& stride) {
  if (!stride.calm) return;
  for (NodeIndex k : moving_) {
    const double heavy = mass_[k] / (stride.seconds * stride.seconds);
    const bool back = dot(nodeMove_[k], velocity_[k]) < 0 && squaredLength(nodeMove_[k]) > kTurnsBack * kTurnsBack;
    slowing_[k] = back ? std::fmin(kSlowest * heavy, kSlower * (slowing_[k] + heavy)) : kQuicker * slowing_[k];
    if (slowing_[k] < 0.1 * heavy) slowing_[k] = 0;
  }
}

void LevelSolver::stop() {
  std::fill(velocity_.begin(), velocity_.end(), Vec3{});
  std::fill(slowing_.begin(), slowing_.end(), 0.0);
  for (const auto& contact : contacts_) contact->reset();
}

void LevelSolver::tieWithin(double gap) {
  bool changed = false;
  for (std::size_t t = 0; t < tied_.size(); ++t)
    if (!tied_[t] && length(gapOf(cloth_.ties[t], x_)) < gap) {
      tied_[t] = 1;
      changed = true;
    }
  if (!changed) return;
  rebuild();
  // What is tied moves as one from now on.
  std::vector<Vec3> impulse(cloth_.nodeCount), mass(cloth_.nodeCount), p, m;
  for (NodeIndex k : moving_) {
    impulse[k] = velocity_[k] * mass_[k];
    mass[k] = Vec3{mass_[k], 0, 0};
  }
  ties_->reduce(impulse, p);
  ties_->reduce(mass, m);
  for (std::size_t u = 0; u < p.size(); ++u) p[u] = m[u].x > 0 ? p[u] * (1 / m[u].x) : Vec3{};
  ties_->spread(p, velocity_);
}

bool LevelSolver::untangle() { return intersections_->start(x_, workers_); }

std::size_t LevelSolver::crossings() { return intersections_->count(x_, workers_); }

void LevelSolver::assemble(const Stride& stride, bool sliding) {
  std::fill(gradient_.begin(), gradient_.end(), Vec3{});
  stretch_.evaluate(x_, gradient_, system_->panels(), workers_);
  for (const auto& energy : energies_) energy->addGradient(x_, gradient_, workers_);
  for (NodeIndex k : moving_) gradient_[k] -= stride.gravity * mass_[k];
  seams_->setStrength(stride.closing);
  eachContact([&](Contact& contact) { contact.detect({x_, stride.friction, sliding}, workers_); });
  eachContact([&](Contact& contact) { contact.addGradient(gradient_); });

  std::size_t at = 0;
  for (const BlockEnergy* energy : blockEnergies_) {
    energy->blocks(x_, std::span(blocks_).subspan(at, energy->pairCount()), workers_);
    at += energy->pairCount();
  }
  system_->gather(blocks_, workers_);
  const double inertia = 1 / (stride.seconds * stride.seconds);
  ContactHessian hessian(*ties_, *system_);
  for (NodeIndex k : moving_) hessian.addIsotropic(k, mass_[k] * inertia + (stride.calm ? slowing_[k] : 0));
  eachContact([&](Contact& contact) { contact.addHessian(hessian); });
  hessian.finish();
}

bool LevelSolver::sound() const {
  return std::all_of(x_.begin(), x_.end(), [](Vec3 p) { return finite(p); });
}

double LevelSolver::residual() const {
  double squares = 0;
  for (Vec3 f : force_) squares += squaredLength(f);
  return std::sqrt(squares / static_cast<double>(force_.size())) / nodeWeight_;
}

LevelSolver::Outcome LevelSolver::step(const Stride& stride, const Token& token) {
  Outcome outcome;
  if (ties_->unknowns() == 0) return outcome;
  outcome.finite = sound();
  if (!outcome.finite) return outcome;
  assemble(stride);
  std::vector<Vec3> nodeForce(cloth_.nodeCount);
  for (NodeIndex k : moving_) nodeForce[k] = -gradient_[k];
  ties_->reduce(nodeForce, force_);
  outcome.residual = residual();
  for (NodeIndex k : moving_) nodeForce[k] += velocity_[k] * (mass_[k] * stride.keep / stride.seconds);
  eachContact([&](Contact& contact) { contact.addSlipForce(nodeForce); });
  ties_->reduce(nodeForce, force_);
  outcome.iterations = system_->solve(force_, stride.stop, token, workers_, move_);
  ties_->spread(move_, nodeMove_);
  double most = 0;
  for (NodeIndex k : moving_) {
    const double own = squaredLength(nodeMove_[k]);
    if (!std::isfinite(own)) outcome.finite = false;
    most = std::max(most, own);
  }
  most = std::sqrt(most);
  outcome.finite = outcome.finite && std::isfinite(outcome.residual);
  if (!outcome.finite || token.cancelled()) return outcome;
  const double scale = most > stride.mostMove ? stride.mostMove / most : 1;
  outcome.shortened = scale < 1;
  if (outcome.shortened)
    for (NodeIndex k : moving_) nodeMove_[k] = nodeMove_[k] * scale;
  eachContact([&](Contact& contact) { contact.limitMove(x_, nodeMove_, workers_); });
  calmDown(stride);
  struct Way {
    double now = 0, before = 0, both = 0, most = 0;
  };
  const std::vector<Way> ways = workers_.each(moving_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    Way way;
    for (std::size_t n = begin; n < end; ++n) {
      const NodeIndex k = moving_[n];
      const double own = squaredLength(nodeMove_[k]);
      x_[k] += nodeMove_[k];
      way.now += own;
      way.before += squaredLength(velocity_[k]);
      way.both += dot(nodeMove_[k], velocity_[k]);
      way.most = std::max(way.most, own);
      velocity_[k] = nodeMove_[k] * (1 / stride.seconds);
    }
    return way;
  });
  Way whole;
  for (const Way& way : ways) {
    whole.now += way.now;
    whole.before += way.before;
    whole.both += way.both;
    whole.most = std::max(whole.most, way.most);
  }
  outcome.move = std::sqrt(whole.most);
  outcome.finite = std::isfinite(whole.now);
  if (!outcome.finite) return outcome;
  if (simcloth_) simcloth_->setReach(std::clamp(kSlackReach * outcome.move, kLeastReach, kMostReach * cloth_.spacing));
  outcome.along = whole.now > 0 && whole.before > 0 ? whole.both / std::sqrt(whole.now * whole.before) : 0;
  if (!cloth_.ties.empty()) ties_->gather(x_);
  eachContact([&](Contact& contact) { contact.afterStep(x_, stride.friction, workers_); });
  return outcome;
}

LevelSolver::Outcome LevelSolver::predict(const Stride& stride, const Token& token, std::vector<Vec3>* moves) {
  Outcome outcome;
  if (ties_->unknowns() == 0) return outcome;
  outcome.finite = sound();
  if (!outcome.finite) return outcome;
  assemble(stride, true);
  std::vector<Vec3> nodeForce(cloth_.nodeCount);
  for (NodeIndex k : moving_) nodeForce[k] = -gradient_[k];
  ties_->reduce(nodeForce, force_);
  outcome.residual = residual();
  outcome.iterations = system_->solve(force_, stride.stop, token, workers_, move_);
  outcome.finite = std::isfinite(outcome.residual);
  for (Vec3 m : move_) {
    outcome.finite = outcome.finite && finite(m);
    outcome.move = std::fmax(outcome.move, length(m));
  }
  if (moves) ties_->spread(move_, *moves);
  return outcome;
}

std::vector<Vec3> LevelSolver::pulls() {
  std::vector<Vec3> pull(cloth_.nodeCount);
  stretch_.evaluate(x_, pull, system_->panels(), workers_);
  for (const auto& energy : energies_) energy->addGradient(x_, pull, workers_);
  for (Vec3& p : pull) p = -p;
  return pull;
}

std::vector<Vec3> LevelSolver::answerTo(const std::vector<Vec3>& force, const Stride& stride, const Token& token) {
  std::vector<Vec3> moves(cloth_.nodeCount);
  if (ties_->unknowns() == 0 || !sound()) return moves;
  assemble(stride);
  ties_->reduce(force, force_);
  system_->solve(force_, stride.stop, token, workers_, move_);
  ties_->spread(move_, moves);
  return moves;
}

Vec3 LevelSolver::handForce() const {
  const std::optional<Hand>& hand = hand_->hand();
  if (!hand) return {};
  std::vector<std::uint8_t> patch(cloth_.nodeCount, 0);
  for (NodeIndex node : hand->nodes) patch[node] = 1;
  Vec3 force = membrane_->tensionAt(x_, patch);
  for (const Springs* springs : springs_) force += springs->tensionAt(x_, patch);
  return force;
}

}  // namespace karinui

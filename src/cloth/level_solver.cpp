#include "cloth/level_solver.h"

#include <algorithm>
#include <cmath>

#include "cloth/bending.h"
#include "cloth/lattice_shares.h"

namespace karinui {
namespace {

constexpr std::size_t kBlock = 256;  // nodes a worker takes at once
constexpr double kApart = 20;        // N per metre of cloth that stands crossed
constexpr double kApartMove = 0.1;   // spacings it goes apart in a step when nothing holds it
constexpr double kSlackReach = 0.3;  // of a step's largest move: what two ends of a spring move apart
constexpr double kLeastReach = 1e-7, kMostReach = 0.05;  // metres, spacings
constexpr int kPatience = 60;                            // steps without fewer crossings before it is left as it is
constexpr double kTurnsBack = 5e-6;                      // metres a node moves that is said to turn back,
constexpr double kSlower = 3;                            // so many times slower each time it does,
constexpr double kQuicker = 0.7;                         // quicker again each time it does not,
constexpr double kSlowest = 1e5;                         // and at most so many times heavier than it is

struct Moving {
  std::vector<NodeIndex> nodes;
  std::vector<std::uint8_t> held;  // per cloth node
  std::vector<double> mass, area;
  std::vector<BodyContact::Node> contact;
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

LevelSolver::LevelSolver(const Cloth& cloth, std::vector<Vec3> x, const Collider& body, const SettleSettings& settings,
                         double clothRadius, Workers& workers)
    : cloth_(cloth),
      workers_(workers),
      x_(std::move(x)),
      velocity_(cloth.nodeCount),
      gradient_(cloth.nodeCount),
      tied_(cloth.ties.size(), 0),
      plan_(cloth),
      stretch_(cloth, plan_),
      contact_(body, movingOf(cloth).contact, settings.skin),
      faces_(cloth, body, settings.skin),
      self_(cloth, clothRadius) {
  Moving moving = movingOf(cloth);
  mass_ = std::move(moving.mass);
  held_ = std::move(moving.held);
  moving_ = std::move(moving.nodes);
  contact_.cover(cloth.nodeCount);
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
  rebuild();
}

void LevelSolver::rebuild() {
  ties_ = std::make_unique<TieMap>(cloth_, held_, tied_);
  ties_->gather(x_);
  system_->setTies(*ties_);
  self_.setTies(*ties_);
  open_ = static_cast<std::size_t>(std::count(tied_.begin(), tied_.end(), 0));
}

void LevelSolver::place(std::vector<Vec3> x) {
  x_ = std::move(x);
  ties_->gather(x_);
  stop();
}

void LevelSolver::moveGuarded(std::vector<Vec3> moves) {
  ties_->share(moves);
  self_.guard(x_, moves, workers_);
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
  contact_.forgetAnchors();
  self_.forgetAnchors();
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

bool LevelSolver::untangle() {
  if (!self_.meets()) return false;
  takingApart_ = true;
  noBetter_ = 0;
  leastCrossings_ = static_cast<std::size_t>(-1);
  followTangle();
  return takingApart_;
}

std::size_t LevelSolver::crossings() {
  if (!self_.meets()) return 0;
  lookForCrossings();
  return tangle_->crossings();
}

void LevelSolver::lookForCrossings() {
  if (!tangle_) tangle_ = std::make_unique<Tangle>(cloth_);
  tangle_->find(x_, workers_);
}

void LevelSolver::followTangle() {
  if (!takingApart_) return;
  lookForCrossings();
  if (tangle_->crossings() < leastCrossings_) {
    leastCrossings_ = tangle_->crossings();
    noBetter_ = 0;
  } else {
    ++noBetter_;
  }
  self_.leaveOut(tangle_->crossings() > 0 ? tangle_->near() : std::vector<std::uint8_t>{});
  if (tangle_->crossings() == 0 || noBetter_ > kPatience) takingApart_ = false;  // what is left stays left out
}

void LevelSolver::pushApart(std::vector<std::pair<NodeIndex, double>>& stiff) {
  if (!takingApart_) return;
  const double force = kApart * cloth_.spacing;
  for (NodeIndex k : moving_)
    if (const Vec3 way = tangle_->way()[k]; squaredLength(way) > 0) {
      gradient_[k] -= way * force;
      stiff.emplace_back(k, force / (kApartMove * cloth_.spacing));
    }
}

void LevelSolver::assemble(const Stride& stride, bool sliding) {
  std::fill(gradient_.begin(), gradient_.end(), Vec3{});
  stretch_.evaluate(x_, gradient_, system_->panels(), workers_);
  for (const auto& energy : energies_) energy->addGradient(x_, gradient_, workers_);
  for (NodeIndex k : moving_) gradient_[k] -= stride.gravity * mass_[k];
  contact_.find(x_, stride.friction, workers_, sliding);
  contact_.addGradient(gradient_);
  faces_.find(x_, workers_);
  faces_.addGradient(gradient_);
  std::vector<Coupling> couplings;
  self_.find(x_, workers_, sliding);
  self_.addGradient(gradient_);
  self_.addCouplings(*ties_, couplings);
  if (open_ > 0) {
    const auto pulls = closingPulls(cloth_, tied_, x_, contact_, stride.closing);
    karinui::addGradient(pulls, gradient_);
    karinui::addCouplings(pulls, *ties_, couplings);
  }
  std::vector<std::pair<NodeIndex, double>> stiff;
  pushApart(stiff);
  if (hand_)
    for (std::size_t k = 0; k < hand_->nodes.size(); ++k) {
      const NodeIndex node = hand_->nodes[k];
      gradient_[node] += (x_[node] - hand_->middle - hand_->offset[k]) * hand_->stiffness;
    }

  std::size_t at = 0;
  for (const BlockEnergy* energy : blockEnergies_) {
    energy->blocks(x_, std::span(blocks_).subspan(at, energy->pairCount()), workers_);
    at += energy->pairCount();
  }
  system_->gather(blocks_, workers_);
  const double inertia = 1 / (stride.seconds * stride.seconds);
  const auto addIsotropic = [&](NodeIndex node, double value) {
    double whole = 0;
    for (const TieMap::Part& part : ties_->parts(node)) whole += std::fabs(part.weight);
    for (const TieMap::Part& part : ties_->parts(node)) {
      Block3 block{};
      block[0] = block[4] = block[8] = static_cast<float>(value * whole * std::fabs(part.weight));
      system_->addDiagonal(part.unknown, block);
    }
  };
  for (NodeIndex k : moving_) addIsotropic(k, mass_[k] * inertia + (stride.calm ? slowing_[k] : 0));
  for (const auto& [node, value] : stiff) addIsotropic(node, value);
  if (hand_)
    for (NodeIndex node : hand_->nodes) addIsotropic(node, hand_->stiffness);
  contact_.addBlocks(*ties_, *system_);
  faces_.addBlocks(*ties_, *system_);
  system_->setCouplings(std::move(couplings));
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
  contact_.addExpectedSlip(nodeForce);
  self_.addExpectedSlip(nodeForce);
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
  workers_.forBlocks(moving_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const NodeIndex k = moving_[n];
      nodeMove_[k] = contact_.limited(x_[k], nodeMove_[k] * scale);
    }
  });
  self_.guard(x_, nodeMove_, workers_);
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
  if (stride.friction) {
    contact_.moveAnchors(x_, workers_);
    self_.moveAnchors(x_);
  }
  followTangle();
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
  if (!hand_) return {};
  std::vector<std::uint8_t> patch(cloth_.nodeCount, 0);
  for (NodeIndex node : hand_->nodes) patch[node] = 1;
  Vec3 force = membrane_->tensionAt(x_, patch);
  for (const Springs* springs : springs_) force += springs->tensionAt(x_, patch);
  return force;
}

}  // namespace karinui

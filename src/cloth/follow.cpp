#include "karinui/cloth/follow.h"

#include <algorithm>
#include <cmath>

#include "cloth/finish.h"
#include "cloth/input_check.h"
#include "cloth/penetration.h"
#include "cloth/skin_collider.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

constexpr double kPart = 0.01;         // metres the skin goes in a part of the way, at most: half of a hand's thickness
constexpr int kSamples = 12;           // places of the way at which its length is looked at
constexpr double kWith = 0.02;         // metres from the skin: cloth goes with it wholly,
constexpr double kWithout = 0.10;      // and beyond this only as the cloth around it does
constexpr int kSpread = 40;            // times the carrying is spread over the cloth
constexpr double kClear = 0.95;        // of the skin offset: where carried cloth is put
constexpr int kOutRounds = 4;          // times what stands too deep is put there
constexpr double kNearest = 0.3;       // metres: what is farther from the skin is not carried
constexpr double kSeconds = 1.0 / 30;  // of a step

// The way of the body, both ends being whole poses.
class Way {
 public:
  Way(const Skeleton& skeleton, const BodyPose& from, const BodyPose& to)
      : skeleton_(skeleton), from_(skeleton.whole(from)), to_(skeleton.whole(to)) {}
  BodyPose pose(double t) const { return skeleton_.between(from_, to_, t); }
  std::vector<Rigid> at(double t) const { return skeleton_.placements(pose(t)); }
  // Where the parts end, the last at 1.
  std::vector<double> parts() const {
    std::vector<double> ends;
    std::vector<Vec3> before = skeleton_.points(at(0));
    for (int k = 1; k <= kSamples; ++k) {
      const std::vector<Vec3> now = skeleton_.points(at(static_cast<double>(k) / kSamples));
      double most = 0;
      for (std::size_t i = 0; i < now.size(); ++i) most = std::fmax(most, squaredLength(now[i] - before[i]));
      const int count = static_cast<int>(std::ceil(std::sqrt(most) / kPart));
      for (int j = 1; j <= count; ++j) ends.push_back((k - 1 + static_cast<double>(j) / count) / kSamples);
      before = now;
    }
    return ends;
  }

 private:
  const Skeleton& skeleton_;
  BodyPose from_, to_;
};

Rigid inverse(const Rigid& r) {
  Rigid out{r.w, -r.x, -r.y, -r.z, {}};
  out.carry = -out.turned(r.carry);
  return out;
}

// What a place of the cloth lies on: a point of the skin, and how wholly it goes with it.
struct Hold {
  std::uint32_t point = kNoNode;
  double share = 0;
};

std::vector<Hold> holdsOf(const std::vector<Vec3>& places, const Body& own, const std::vector<Vec3>& skin) {
  const TriangleMesh mesh{skin, own.mesh().faces};
  const Bvh bvh(mesh);
  std::vector<Hold> holds(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto near = bvh.nearest(places[k], kNearest);
    if (!near) continue;
    const auto& w = near->place.weight;
    const int corner = w[0] >= w[1] && w[0] >= w[2] ? 0 : w[1] >= w[2] ? 1 : 2;
    const double off = std::clamp((near->distance - kWith) / (kWithout - kWith), 0.0, 1.0);
    holds[k] = {mesh.faces[near->place.face][corner], (1 - off) * (1 - off)};
  }
  return holds;
}

// Neighbours in the cloth, over its seams too.
std::vector<std::vector<std::uint32_t>> neighboursOf(const Cloth& cloth) {
  std::vector<std::vector<std::uint32_t>> near(cloth.nodeCount);
  const auto join = [&](std::uint32_t a, std::uint32_t b) { near[a].push_back(b), near[b].push_back(a); };
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& f : piece.lattice->faces)
      for (int k = 0; k < 3; ++k) join(piece.firstNode + f[k], piece.firstNode + f[(k + 1) % 3]);
  for (const Tie& tie : cloth.ties) {
    join(tie.a, tie.b);
    if (tie.c != kNoNode) join(tie.a, tie.c);
  }
  for (auto& own : near) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  return near;
}

// Moves of the cloth with the skin. Cloth off the skin goes as the cloth around it does.
class Carrying {
 public:
  Carrying(const Cloth& cloth, std::vector<Hold> holds)
      : holds_(std::move(holds)), near_(neighboursOf(cloth)), move_(cloth.nodeCount) {}
  const std::vector<Vec3>& moves(const std::vector<Vec3>& x, const std::vector<Rigid>& before,
                                 const std::vector<Rigid>& after, Workers& workers) {
    std::vector<Vec3> asked(x.size()), next(x.size());
    workers.forBlocks(x.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        if (const Hold& hold = holds_[k]; hold.point != kNoNode)
          asked[k] = after[hold.point](inverse(before[hold.point])(x[k])) - x[k];
    });
    for (int round = 0; round < kSpread; ++round) {  // from the moves of the part before, which were much the same
      workers.forBlocks(x.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          Vec3 mean;
          for (const std::uint32_t j : near_[k]) mean += move_[j];
          if (!near_[k].empty()) mean *= 1 / static_cast<double>(near_[k].size());
          next[k] = lerp(mean, asked[k], holds_[k].share);
        }
      });
      std::swap(move_, next);
    }
    return move_;
  }

 private:
  std::vector<Hold> holds_;
  std::vector<std::vector<std::uint32_t>> near_;
  std::vector<Vec3> move_;
};

}  // namespace

Result<FollowReport> follow(ClothLevel& level, const Skeleton& skeleton, const BodyPose& from, const BodyPose& to,
                            const Token& token, Workers& workers, const FollowWatcher& watcher) {
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  const SettleSettings settings;
  const Way way(skeleton, from, to);
  std::vector<Rigid> before = way.at(0);
  SkinCollider skin(skeleton.body()->mesh().faces, before.size());
  skin.moveTo(skeleton.points(before));
  Carrying carrying(level.cloth, holdsOf(level.state.position, *skeleton.body(), skin.points()));
  LevelSolver solver(level.cloth, level.state.position, skin, settings,
                     clothRadius(level.cloth.spacing, level.cloth.spacing), workers);
  solver.tieWithin(level.cloth.spacing);

  LevelSolver::StepOptions options;
  options.seconds = kSeconds;
  options.velocityKept = 0;
  options.mostMove = 0.5 * level.cloth.spacing;
  options.gravity = settings.gravity;
  options.stopping = {40, 100, 0.1};
  FollowReport report;
  const std::vector<double> parts = way.parts();
  for (const double t : parts) {
    const std::vector<Rigid> after = way.at(t);
    std::vector<Vec3> moves = carrying.moves(solver.positions(), before, after, workers);
    skin.moveTo(skeleton.points(after));
    // Out of the skin where it has come to.
    workers.forBlocks(moves.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        for (int round = 0; round < kOutRounds; ++round) {
          const Collider::Sample sample = skin.sample(solver.positions()[k] + moves[k]);
          if (!(sample.distance < kClear * settings.skin)) break;
          moves[k] += sample.normal * (kClear * settings.skin - sample.distance);
        }
    });
    solver.moveFiltered(std::move(moves));
    const auto step = solver.step(options, token);
    if (token.cancelled()) return cancelled();
    if (!step.finite) return tornApart();
    for (const Vec3& p : solver.positions()) report.deepest = std::fmax(report.deepest, -skin.sample(p).distance);
    before = after;
    ++report.parts;
    token.progress(static_cast<double>(report.parts) / static_cast<double>(parts.size()), say("Moving the figure"));
    if (watcher) watcher({t, way.pose(t), skin.points(), level.cloth, solver.positions()});
  }
  solver.separateIntersections();
  liftOffColliders(solver, skin, std::min(0.0003, 0.3 * settings.skin), workers);
  level.state.position = solver.positions();
  return report;
}

std::vector<Rigid> carriedBySkin(const std::vector<Vec3>& places, const Skeleton& skeleton, const BodyPose& from,
                                 const BodyPose& to) {
  const std::vector<Rigid> before = skeleton.placements(from), now = skeleton.placements(to);
  const std::vector<Hold> holds = holdsOf(places, *skeleton.body(), skeleton.points(before));
  std::vector<Rigid> out(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    if (holds[k].point != kNoNode) out[k] = karinui::after(now[holds[k].point], inverse(before[holds[k].point]));
  return out;
}

}  // namespace karinui

#include "karinui/cloth/follow.h"

#include <algorithm>
#include <cmath>

#include "cloth/finish.h"
#include "cloth/input_check.h"
#include "cloth/penetration.h"
#include "cloth/skin_collider.h"
#include "cloth/work_blocks.h"
#include "karinui/base/sort_once.h"

namespace karinui {
namespace {

constexpr double kPart = 0.01;       // metres that skin near cloth goes in a part of the way: half a hand's thickness;
constexpr double kFarPart = 0.04;    // other skin, which
constexpr double kFar = 0.06;        // is so far from any cloth
constexpr double kFirstPart = 0.01;  // of the way: the part that is tried first
constexpr double kAim = 0.9;         // of what a part may be: what the next one is aimed at
constexpr int kTries = 20;           // to find where a part ends
constexpr double kWith = 0.02;       // metres from the skin: cloth goes with it wholly,
constexpr double kWithout = 0.10;    // and beyond this only as the cloth around it does
constexpr int kRoundAbout = 60;      // times ways of the skin are spread over the cloth: some eight cells far
constexpr double kOtherWay = 0.05;   // metres that skin goes otherwise than most around: cloth does not go with it
constexpr double kFew = 0.4;         // if no more than this share of the skin around goes so
constexpr int kSpread = 40;          // times the carrying is spread over the cloth
constexpr double kDeep = 0.0003;     // metres under the skin: cloth that is carried or stepped deeper
constexpr double kClear = 0.95;      // is put so far out of it, in skin offsets,
constexpr int kOutRounds = 4;        // in so many tries at most
constexpr double kNearest = 0.3;     // metres: what is farther from the skin is not carried
// A step: long, so that inertia does not hold back what has to slide after the body, and of two iterations, so that
// threads do not strain to second order. With 1/30 s and one, the sleeves of a buttoned shirt ran ahead of it: arms
// overhead it was stretched by 55 % (99 % of it by less) and its cuffs went through the forearms.
constexpr double kSeconds = 0.1;
constexpr int kNewton = 2;

// Whether there is cloth near a place of the skin, by cells of kFar and an edge of the cloth.
class ClothNear {
 public:
  ClothNear(const std::vector<Vec3>& cloth, double spacing, const Box& skin) : side_(kFar + spacing) {
    low_ = skin.low - Vec3{1, 1, 1} * (2.5 * side_);  // cloth beside the skin's outermost cells has all cells around it
    const Vec3 high = (skin.high - low_) * (1 / side_);
    count_ = {static_cast<std::size_t>(high.x) + 3, static_cast<std::size_t>(high.y) + 3,
              static_cast<std::size_t>(high.z) + 3};
    near_.assign(count_[0] * count_[1] * count_[2], 0);
    std::vector<std::uint8_t> own = near_;
    for (const Vec3& p : cloth) {
      const Vec3 in = (p - low_) * (1 / side_);
      const auto inside = [](double at, std::size_t count) { return at >= 1 && at < static_cast<double>(count - 1); };
      if (!inside(in.x, count_[0]) || !inside(in.y, count_[1]) || !inside(in.z, count_[2])) continue;
      const auto [cx, cy, cz] = cellAt(in);
      if (std::uint8_t& here = own[number(cx, cy, cz)]; here == 0) {
        here = 1;
        for (std::size_t x = cx - 1; x <= cx + 1; ++x)
          for (std::size_t y = cy - 1; y <= cy + 1; ++y)
            for (std::size_t z = cz - 1; z <= cz + 1; ++z) near_[number(x, y, z)] = 1;
      }
    }
  }
  bool operator()(Vec3 skin) const {
    const auto [x, y, z] = cellAt((skin - low_) * (1 / side_));
    return near_[number(x, y, z)] != 0;
  }

 private:
  static std::array<std::size_t, 3> cellAt(Vec3 in) {
    return {static_cast<std::size_t>(in.x), static_cast<std::size_t>(in.y), static_cast<std::size_t>(in.z)};
  }
  std::size_t number(std::size_t x, std::size_t y, std::size_t z) const { return (x * count_[1] + y) * count_[2] + z; }
  double side_;
  Vec3 low_;
  std::array<std::size_t, 3> count_{};
  std::vector<std::uint8_t> near_;
};

// The way of the body, both ends being whole poses. It is gone part by part.
class Way {
 public:
  Way(const Skeleton& skeleton, const BodyPose& from, const BodyPose& to)
      : skeleton_(skeleton), from_(skeleton.whole(from)), to_(skeleton.whole(to)) {
    placements_ = skeleton_.placements(pose());
    points_ = skeleton_.points(placements_);
  }
  double share() const { return share_; }
  BodyPose pose() const { return skeleton_.between(from_, to_, share_); }
  const std::vector<Rigid>& placements() const { return placements_; }
  const std::vector<Vec3>& points() const { return points_; }

  // On to the end of the next part, the cloth standing at `cloth`. The skin moves about evenly along the way, so the
  // part before tells how long the next may be.
  void goOn(const std::vector<Vec3>& cloth, double spacing) {
    const ClothNear near(cloth, spacing, boxOf(points_));
    std::vector<double> most(points_.size());
    std::transform(points_.begin(), points_.end(), most.begin(),
                   [&](Vec3 p) { return near(p) ? kPart * kPart : kFarPart * kFarPart; });
    const double from = share_;
    const std::vector<Vec3> before = std::move(points_);
    for (int k = 1;; ++k) {
      share_ = from + next_ < 1 ? from + next_ : 1;
      placements_ = skeleton_.placements(pose());
      points_ = skeleton_.points(placements_);
      double used = 0;  // of what it may be
      for (std::size_t i = 0; i < before.size(); ++i)
        used = std::fmax(used, squaredLength(points_[i] - before[i]) / most[i]);
      used = std::sqrt(used);
      next_ = (share_ - from) * kAim / std::fmax(used, 0.1);
      if (used <= 1 || k == kTries) return;
    }
  }

 private:
  const Skeleton& skeleton_;
  BodyPose from_, to_;
  double share_ = 0, next_ = kFirstPart;
  std::vector<Rigid> placements_;
  std::vector<Vec3> points_;
};

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
    sortOnce(own);
  }
  return near;
}

// Lets go of skin that goes another way than most of the skin beneath the cloth around, as where a cuff hangs against
// the hip. `ways`: how far the skin of each hold goes. Of two crowds of holds whose ways are D apart, one with a share
// p of all around, the ways of this one differ from the mean by (1 - p) D, and from it all by sqrt(p (1 - p)) D (rms).
void letGoOfOthers(std::vector<Hold>& holds, const std::vector<Vec3>& ways,
                   const std::vector<std::vector<std::uint32_t>>& near) {
  struct Around {
    double weight = 0, squares = 0;
    Vec3 sum;
  };
  std::vector<Around> around(holds.size()), next(holds.size());
  for (std::size_t k = 0; k < holds.size(); ++k)
    if (holds[k].point != kNoNode) around[k] = {1, squaredLength(ways[k]), ways[k]};
  for (int round = 0; round < kRoundAbout; ++round) {
    for (std::size_t k = 0; k < holds.size(); ++k) {
      Around all = around[k];
      for (const std::uint32_t j : near[k])
        all.weight += around[j].weight, all.squares += around[j].squares, all.sum += around[j].sum;
      const double share = 1 / static_cast<double>(near[k].size() + 1);
      next[k] = {all.weight * share, all.squares * share, all.sum * share};
    }
    std::swap(around, next);
  }
  for (std::size_t k = 0; k < holds.size(); ++k) {
    if (holds[k].point == kNoNode) continue;
    const Vec3 mean = around[k].sum * (1 / around[k].weight);
    const double spread = around[k].squares / around[k].weight - squaredLength(mean);
    const double off = squaredLength(ways[k] - mean);
    if (off > kOtherWay * kOtherWay && off * kFew > spread * (1 - kFew)) holds[k] = {};
  }
}

// Moves of the cloth with the skin. Cloth off the skin goes as the cloth around it does.
class Carrying {
 public:
  // `from` and `to`: where the skin is at both ends of the way.
  Carrying(const Cloth& cloth, const std::vector<Vec3>& x, std::vector<Hold> holds, const std::vector<Rigid>& from,
           const std::vector<Rigid>& to)
      : holds_(std::move(holds)), near_(neighboursOf(cloth)), move_(cloth.nodeCount) {
    std::vector<Vec3> ways(x.size());
    for (std::size_t k = 0; k < x.size(); ++k)
      if (const Hold& hold = holds_[k]; hold.point != kNoNode)
        ways[k] = to[hold.point](inverseOf(from[hold.point])(x[k])) - x[k];
    letGoOfOthers(holds_, ways, near_);
  }
  const std::vector<Vec3>& moves(const std::vector<Vec3>& x, const std::vector<Rigid>& before,
                                 const std::vector<Rigid>& after, Workers& workers) {
    std::vector<Vec3> asked(x.size()), next(x.size());
    workers.forBlocks(x.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        if (const Hold& hold = holds_[k]; hold.point != kNoNode)
          asked[k] = after[hold.point](inverseOf(before[hold.point])(x[k])) - x[k];
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

// Lengthens the moves of what would stand deep in the skin, to be clear of it; whether any did. Cloth that presses on
// the skin stays as it lies: put clear of it in each part, a tight cuff was held by nothing and slid up the forearm.
bool outOfMovedSkin(const std::vector<Vec3>& x, std::vector<Vec3>& moves, const SkinCollider& skin, double clear,
                    Workers& workers) {
  bool any = false;
  for (const bool here : workers.each(moves.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
         bool some = false;
         for (std::size_t k = begin; k < end; ++k)
           for (int round = 0; round < kOutRounds; ++round) {
             const Collider::Sample sample = skin.sample(x[k] + moves[k]);
             if (!(sample.distance < (round == 0 ? -kDeep : clear))) break;
             moves[k] += sample.normal * (clear - sample.distance);
             some = true;
           }
         return some;
       }))
    any = any || here;
  return any;
}

}  // namespace

Result<FollowReport> follow(ClothLevel& level, const Skeleton& skeleton, const BodyPose& from, const BodyPose& to,
                            const Token& token, Workers& workers, const FollowWatcher& watcher) {
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  const SettleSettings settings;
  Way way(skeleton, from, to);
  SkinCollider skin(skeleton.body()->mesh().faces, way.points().size());
  skin.moveTo(way.points(), workers);
  Carrying carrying(level.cloth, level.state.position, holdsOf(level.state.position, *skeleton.body(), skin.points()),
                    way.placements(), skeleton.placements(skeleton.whole(to)));
  LevelSolver solver(level.cloth, level.state.position, skin, settings, clothRadius(level.cloth, level.cloth.spacing),
                     workers);
  solver.tieWithin(level.cloth.spacing);

  LevelSolver::StepOptions options;
  options.seconds = kSeconds;
  options.newton = kNewton;
  options.velocityKept = 0;
  options.mostMove = 0.5 * level.cloth.spacing;
  options.gravity = settings.gravity;
  options.stopping = {40, 100, 0.1};
  const double clear = kClear * settings.skin;
  FollowReport report;
  while (way.share() < 1) {
    const std::vector<Rigid> before = way.placements();
    way.goOn(solver.positions(), level.cloth.spacing);
    std::vector<Vec3> moves = carrying.moves(solver.positions(), before, way.placements(), workers);
    skin.moveTo(way.points(), workers);
    outOfMovedSkin(solver.positions(), moves, skin, clear, workers);
    solver.moveFiltered(std::move(moves));
    const auto step = solver.step(options, token);
    if (token.cancelled()) return cancelled();
    if (!step.finite) return tornApart();
    // A fold that closes presses cloth into the skin on either side.
    moves.assign(level.cloth.nodeCount, {});
    if (outOfMovedSkin(solver.positions(), moves, skin, clear, workers)) solver.moveFiltered(std::move(moves));
    ++report.parts;
    token.progress(way.share(), say("Moving the figure"));
    if (watcher) watcher({way.share(), way.pose(), skin.points(), level.cloth, solver.positions()});
  }
  solver.separateIntersections();
  skin.buildTree();
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
    if (holds[k].point != kNoNode) out[k] = karinui::after(now[holds[k].point], inverseOf(before[holds[k].point]));
  return out;
}

}  // namespace karinui

#include "cloth/skin_carrying.h"

#include <algorithm>
#include <cmath>

#include "cloth/cloth_topology.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

constexpr double kWith = 0.02;      // metres from the skin: cloth goes with it wholly,
constexpr double kWithout = 0.10;   // and beyond this only as the cloth around it does
constexpr double kNearest = 0.3;    // metres: what is farther from the skin is not carried
constexpr int kRoundAbout = 60;     // times ways of the skin are spread over the cloth: some eight cells far
constexpr double kOtherWay = 0.05;  // metres that skin goes otherwise than most around: cloth does not go with it
constexpr double kFewAround = 0.4;  // if no more than this share of the skin around goes so
constexpr int kSpread = 40;         // times the carrying is spread over the cloth

// Lets go of skin that goes another way than most of the skin beneath the cloth around, as where a cuff hangs against
// the hip. `ways`: how far the skin of each hold goes. Of two crowds of holds whose ways are D apart, one with a share
// p of all around, the ways of this one differ from the mean by (1 - p) D, and from it all by sqrt(p (1 - p)) D (rms).
void letGoOfOthers(std::vector<SkinHold>& holds, const std::vector<Vec3>& ways,
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
    if (off > kOtherWay * kOtherWay && off * kFewAround > spread * (1 - kFew)) holds[k] = {};
  }
}

}  // namespace

std::vector<SkinHold> holdsOf(const std::vector<Vec3>& places, const Body& own, const std::vector<Vec3>& skin) {
  const TriangleMesh mesh{skin, own.mesh().faces};
  const Bvh bvh(mesh);
  std::vector<SkinHold> holds(places.size());
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

SkinCarrying::SkinCarrying(const Cloth& cloth, const std::vector<Vec3>& x, std::vector<SkinHold> holds,
                           const std::vector<Rigid>& from, const std::vector<Rigid>& to)
    : holds_(std::move(holds)), near_(neighboursOf(cloth)), move_(cloth.nodeCount) {
  std::vector<Vec3> ways(x.size());
  for (std::size_t k = 0; k < x.size(); ++k)
    if (const SkinHold& hold = holds_[k]; hold.point != kNoNode)
      ways[k] = to[hold.point](inverseOf(from[hold.point])(x[k])) - x[k];
  letGoOfOthers(holds_, ways, near_);
}

const std::vector<Vec3>& SkinCarrying::moves(const std::vector<Vec3>& x, const std::vector<Rigid>& before,
                                             const std::vector<Rigid>& after, Workers& workers) {
  std::vector<Vec3> asked(x.size()), next(x.size());
  workers.forBlocks(x.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (const SkinHold& hold = holds_[k]; hold.point != kNoNode)
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

}  // namespace karinui

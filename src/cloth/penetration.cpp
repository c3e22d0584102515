#include "cloth/penetration.h"
#include "cloth/work_blocks.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr int kRounds = 80;
constexpr double kEnough = 0.9;        // of the clearance
constexpr double kFirstNudge = 5e-5;   // metres: the first lift of a face that a surface intersects,
constexpr double kNudgeGrowth = 1.25;  // which grows by this factor while it does,
constexpr double kMostNudge = 1e-3;    // to this at most

// Sample points of a face beside its corners: a grid of quarters, since a body has finer features than cloth has faces.
constexpr double kSamples[12][3] = {{.75, .25, 0}, {.5, .5, 0},    {.25, .75, 0},  {0, .75, .25},
                                    {0, .5, .5},   {0, .25, .75},  {.25, 0, .75},  {.5, 0, .5},
                                    {.75, 0, .25}, {.5, .25, .25}, {.25, .5, .25}, {.25, .25, .5}};

// In the order of the pieces.
std::vector<Triangle> liveFaces(const Cloth& cloth) {
  std::vector<Triangle> faces;
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live)
      for (const Triangle& face : piece.lattice->faces)
        faces.push_back({piece.firstNode + face[0], piece.firstNode + face[1], piece.firstNode + face[2]});
  return faces;
}

using Corners = std::array<Vec3, 3>;

// The lift of a face's corners. `nudge`: of a face that a surface intersects between the sample points.
Corners liftOf(const Corners& x, const ColliderList& colliders, double clearance, double nudge) {
  Corners lift{};
  bool any = false;
  const auto sample = [&](Vec3 place, const double(&weight)[3]) {
    for (const ColliderList::Entry& entry : colliders) {
      if (!entry.collider->mayBeWithin(place, clearance)) continue;
      const Collider::Sample found = entry.collider->exactSample(place);
      if (found.distance >= kEnough * clearance) continue;
      any = true;
      const Vec3 asked = found.normal * (clearance - found.distance);
      for (int c = 0; c < 3; ++c)
        if (weight[c] > 0 && squaredLength(asked) > squaredLength(lift[c])) lift[c] = asked;
    }
  };
  sample(x[0], {1, 0, 0});
  sample(x[1], {0, 1, 0});
  sample(x[2], {0, 0, 1});
  for (const auto& w : kSamples) sample(x[0] * w[0] + x[1] * w[1] + x[2] * w[2], w);
  if (any) return lift;
  for (const ColliderList::Entry& entry : colliders)
    if (const Vec3 out = entry.collider->intersectionNormal(x); squaredLength(out) > 0) {
      lift.fill(out * nudge);
      break;
    }
  return lift;
}

bool intersected(const Corners& x, const ColliderList& colliders) {
  return std::any_of(colliders.begin(), colliders.end(), [&](const ColliderList::Entry& entry) {
    return squaredLength(entry.collider->intersectionNormal(x)) > 0;
  });
}

}  // namespace

Penetration deepestPenetration(const Cloth& cloth, const ColliderList& colliders, std::span<const Vec3> x,
                               Workers& workers) {
  const std::vector<Triangle> faces = liveFaces(cloth);
  struct Deepest {
    double depth = 0;
    std::size_t face = 0;
    Vec3 place;
  };
  std::vector<Deepest> worst((faces.size() + kNodeBlock - 1) / kNodeBlock);
  workers.forBlocks(faces.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    Deepest most;
    const auto sample = [&](std::size_t f, Vec3 place) {
      for (const ColliderList::Entry& entry : colliders) {
        if (!entry.collider->mayBeWithin(place, 0.001)) continue;
        if (const double depth = -entry.collider->exactSample(place).distance; depth > most.depth)
          most = {depth, f, place};
      }
    };
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 a = x[faces[f][0]], b = x[faces[f][1]], c = x[faces[f][2]];
      sample(f, a);
      sample(f, b);
      sample(f, c);
      for (const auto& w : kSamples) sample(f, a * w[0] + b * w[1] + c * w[2]);
    }
    worst[begin / kNodeBlock] = most;
  });
  Deepest most;
  for (const Deepest& w : worst)
    if (w.depth > most.depth) most = w;
  if (!(most.depth > 0)) return {};
  return {most.depth, &pieceOf(cloth, faces[most.face][0]), most.place};
}

std::size_t liftOffColliders(LevelSolver& solver, const ColliderList& colliders, double clearance, Workers& workers) {
  const Cloth& cloth = solver.cloth();
  const std::vector<Triangle> faces = liveFaces(cloth);
  std::vector<std::uint32_t> asked(faces.size());  // the faces to be tested
  for (std::uint32_t f = 0; f < asked.size(); ++f) asked[f] = f;
  std::vector<double> nudge(faces.size(), kFirstNudge);
  std::vector<Corners> lift;
  for (int round = 0; round < kRounds && !asked.empty(); ++round) {
    const std::vector<Vec3> before = solver.positions();
    lift.assign(asked.size(), {});
    workers.forBlocks(asked.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const Triangle& face = faces[asked[k]];
        lift[k] = liftOf({before[face[0]], before[face[1]], before[face[2]]}, colliders, clearance, nudge[asked[k]]);
      }
    });
    // A node moves by the largest lift of its faces: the sum of many would overshoot.
    std::vector<Vec3> moves(cloth.nodeCount);
    std::vector<std::uint8_t> again(faces.size(), 0);
    bool any = false;
    for (std::size_t k = 0; k < asked.size(); ++k)
      for (int c = 0; c < 3; ++c) {
        if (squaredLength(lift[k][c]) == 0) continue;
        any = true;
        if (!again[asked[k]]) nudge[asked[k]] = std::fmin(kMostNudge, kNudgeGrowth * nudge[asked[k]]);
        again[asked[k]] = 1;
        Vec3& most = moves[faces[asked[k]][c]];
        if (squaredLength(lift[k][c]) > squaredLength(most)) most = lift[k][c];
      }
    if (!any) return 0;
    solver.moveFiltered(std::move(moves));
    std::vector<std::uint8_t> moved(cloth.nodeCount, 0);
    for (NodeIndex k = 0; k < cloth.nodeCount; ++k)
      moved[k] = squaredLength(solver.positions()[k] - before[k]) > 0 ? 1 : 0;
    asked.clear();
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      if (again[f] || moved[faces[f][0]] || moved[faces[f][1]] || moved[faces[f][2]]) asked.push_back(f);
  }
  const std::vector<Vec3> x = solver.positions();
  return static_cast<std::size_t>(std::count_if(asked.begin(), asked.end(), [&](std::uint32_t f) {
    return intersected({x[faces[f][0]], x[faces[f][1]], x[faces[f][2]]}, colliders);
  }));
}

}  // namespace karinui

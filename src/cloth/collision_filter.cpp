#include "cloth/collision_filter.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kReach = 0.15;      // radii: a pair is looked at if it may come so near
constexpr double kKeptGap = 0.25;    // of a pair's gap that a step must leave,
constexpr double kMostGap = 0.05;    // but no more than so many radii
constexpr double kTolerance = 1e-3;  // of that
constexpr int kPasses = 3;           // searches for pairs: a changed move may meet something new
constexpr int kRounds = 40;          // over the pairs of a search,
constexpr int kPlaneRounds = 12;     // of which the first move both sides to the plane between them,
constexpr int kHalvingRounds = 30;   // then moves are halved; after so many rounds they are taken off

}  // namespace

bool CollisionFilter::apply(std::span<const Vec3> x, std::vector<Vec3>& move, Workers& workers) {
  bool changed = false;
  for (int k = 0; k < kPasses; ++k) {
    if (!pass(pairs_.find({x, move, kReach * radius_}, workers), x, move)) break;
    changed = true;
  }
  return changed;
}

bool CollisionFilter::pass(const std::vector<ContactPair>& pairs, std::span<const Vec3> x, std::vector<Vec3>& move) {
  bool any = false;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (const ContactPair& pair : pairs) changed = separate(pair, round, x, move) || changed;
    if (!changed) break;
    any = true;
  }
  return any;
}

// Nodes that are sewn together move as one.
void CollisionFilter::set(NodeIndex node, Vec3 own, std::vector<Vec3>& move) {
  if (sewn_.held[node]) return;
  if (sewn_.groupOf[node] == kNoNode)
    move[node] = own;
  else
    for (NodeIndex other : sewn_.groups[sewn_.groupOf[node]]) move[other] = own;
}

bool CollisionFilter::separate(const ContactPair& pair, int round, std::span<const Vec3> x, std::vector<Vec3>& move) {
  // Along the normal: the lowest node of the first side and the highest of the second, before and after the move.
  double low = 1e300, high = -1e300, lowNow = 1e300, highNow = -1e300;
  for (int k = 0; k < 4; ++k) {
    const double now = dot(x[pair.node[k]], pair.normal), s = now + dot(move[pair.node[k]], pair.normal);
    if (k < pair.first) {
      low = std::fmin(low, s);
      lowNow = std::fmin(lowNow, now);
    } else {
      high = std::fmax(high, s);
      highNow = std::fmax(highNow, now);
    }
  }
  // Where the closest points lie on borders no plane may separate the two sides as they stand. They must then not
  // overlap more than they do; asked for more they could never move again.
  const double least = std::fmin(std::fmin(kKeptGap * pair.gap, kMostGap * radius_), lowNow - highNow);
  if (low - high >= least - kTolerance * std::fabs(least)) return false;
  if (round < kPlaneRounds) {
    const double middle = 0.5 * (low + high);
    for (int k = 0; k < 4; ++k) {
      const NodeIndex node = pair.node[k];
      const double s = dot(x[node] + move[node], pair.normal);
      if (k < pair.first && s < middle + 0.5 * least)
        set(node, move[node] + pair.normal * (middle + 0.5 * least - s), move);
      else if (k >= pair.first && s > middle - 0.5 * least)
        set(node, move[node] - pair.normal * (s - middle + 0.5 * least), move);
    }
  } else {
    for (NodeIndex node : pair.node) set(node, move[node] * (round < kHalvingRounds ? 0.5 : 0.0), move);
  }
  return true;
}

}  // namespace karinui

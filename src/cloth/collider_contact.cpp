#include "cloth/collider_contact.h"
#include "cloth/work_blocks.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

// The derivation or the experiment behind each constant is told in docs/develop/drape.md, "Constants of contact".
constexpr double kCubic = 4;          // the penalty is k offset (r + kCubic r^3), r = depth / offset,
constexpr double kLinearFrom = 2;     // and linear beyond this r
constexpr double kSlipLength = 2e-5;  // metres: a slipping node's friction is no stiffer than over this
constexpr double kLimitSteps = 0.5;   // offsets: how finely a move is followed along the surface
constexpr int kMostLimitSteps = 64;   // of them in one move
constexpr double kCut = 0.2;          // offsets: a node whose move into the surface is shortened by more is pressed;
constexpr int kPressed = 20;          // after so many steps in a row the multiplier takes that up,
constexpr double kLifted = 0.1;  // and falls by kLetGo a step where the node is farther off than these offsets: cloth
constexpr double kLetGo = 0.5;   // that is let go is not thrown off the body

}  // namespace

Penalty colliderPenalty(double area, double depth, double offset) {
  const double k = kContactStiffness * area, r = depth / offset;
  if (r <= kLinearFrom) return {k * offset * (r + kCubic * r * r * r), k * (1 + 3 * kCubic * r * r)};
  const double slope = k * (1 + 3 * kCubic * kLinearFrom * kLinearFrom);
  return {k * offset * (kLinearFrom + kCubic * kLinearFrom * kLinearFrom * kLinearFrom) +
              slope * (depth - kLinearFrom * offset),
          slope};
}

ColliderContact::ColliderContact(const Collider& collider, std::vector<Node> nodes, std::size_t nodeCount,
                                 double offset)
    : collider_(collider),
      nodes_(std::move(nodes)),
      at_(nodes_.size()),
      cache_(nodes_.size()),
      slot_(nodeCount, kNoNode),
      offset_(offset) {
  for (std::uint32_t k = 0; k < nodes_.size(); ++k) slot_[nodes_[k].node] = k;
}

void ColliderContact::detect(const ContactQuery& query, Workers& workers) {
  workers.forBlocks(nodes_.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Node& node = nodes_[k];
      At& at = at_[k];
      const Vec3 place = query.x[node.node];
      at.touches = false;
      const auto sample = cache_.sampleWithin(collider_, k, place, offset_);
      at.touches = sample && sample->distance < offset_;
      if (!at.touches) {
        at = {};
        continue;
      }
      Penalty penalty = colliderPenalty(node.area, offset_ - sample->distance, offset_);
      penalty.force += at.multiplier;
      at.normal = sample->normal;
      at.along = penalty.stiffness;
      at.across = 0;
      at.slipForce = {};
      at.force = sample->normal * -penalty.force;
      if (!query.friction || node.friction <= 0) continue;
      if (!at.stuck) {
        at.stuck = true;
        at.anchor = place;
      }
      Vec3 pull = place - at.anchor;
      pull = pull - at.normal * dot(pull, at.normal);
      const double length = karinui::length(pull), most = node.friction * penalty.force;
      const double hold = kContactStiffness * node.area;
      const double spring = length > 0 ? std::fmin(hold, most / length) : hold;
      at.force += pull * spring;
      // A slipping node with the full stiffness of its anchor's spring would move as in syrup.
      at.across = at.slip > 0 ? std::fmin(spring, most / std::fmax(kSlipLength, length + at.slip)) : spring;
      if (query.sliding && at.slip > kLeastSlip) at.across = 0;
      if (at.slip > 0 && length > 0) at.slipForce = pull * (at.across * at.slip / length);
    }
  });
  touching_ = 0;
  for (const At& at : at_) touching_ += at.touches ? 1 : 0;
}

void ColliderContact::addGradient(std::span<Vec3> gradient) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (at_[k].touches) gradient[nodes_[k].node] += at_[k].force;
}

void ColliderContact::addSlipForce(std::span<Vec3> force) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (at_[k].touches) force[nodes_[k].node] += at_[k].slipForce;
}

void ColliderContact::addHessian(ContactHessian& hessian) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (const At& at = at_[k]; at.touches) hessian.addAtNode(nodes_[k].node, 1, at.normal, at.along, at.across);
}

void ColliderContact::afterStep(std::span<const Vec3> x, bool friction, Workers& workers) {
  if (!friction) return;
  workers.forBlocks(nodes_.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      At& at = at_[k];
      if (!at.stuck) continue;
      const Vec3 place = x[nodes_[k].node];
      const Collider::Sample sample = collider_.sample(place);
      if (sample.distance >= offset_) {
        at = {};
        continue;
      }
      at.pressed = at.cut > kCut * offset_ ? at.pressed + 1 : 0;
      if (at.multiplier > 0 || at.pressed >= kPressed) {
        if (sample.distance > kLifted * offset_) at.multiplier *= kLetGo;
        at.multiplier = std::fmax(0.0, at.multiplier + at.along * (at.cut - sample.distance));
      }
      const double push = colliderPenalty(nodes_[k].area, offset_ - sample.distance, offset_).force + at.multiplier;
      Vec3 pull = place - at.anchor;
      pull = pull - sample.normal * dot(pull, sample.normal);
      const double length = karinui::length(pull);
      const double most = nodes_[k].friction * push / (kContactStiffness * nodes_[k].area);
      at.slip = std::fmax(0.0, length - most);
      at.anchor = place - pull * (length > most ? most / length : 1.0);
    }
  });
}

void ColliderContact::reset() {
  for (At& at : at_) at = {};
  cache_.forget();
}

void ColliderContact::limitMove(std::span<const Vec3> x, std::vector<Vec3>& move, Workers& workers) {
  workers.forBlocks(nodes_.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Vec3& own = move[nodes_[k].node];
      const Vec3 wanted = own;
      own = limited(x[nodes_[k].node], own);
      if (at_[k].touches) at_[k].cut = dot(own - wanted, at_[k].normal);
    }
  });
}

// The part of a move that does not enter the collider: it follows the surface from where it meets it.
Vec3 ColliderContact::limited(Vec3 from, Vec3 move) const {
  const double reach = length(move);
  const double fine = kLimitSteps * offset_;
  if (reach <= fine) return move;
  double clear = 0;
  const auto start = collider_.sampleWithin(from, reach, clear);
  if (!start || start->distance > reach) return move;
  const double floor = std::fmin(0.0, start->distance);  // never deeper than the surface, or than it already is
  Vec3 place = from, left = move;
  clear = start->distance;
  for (int k = 0; k < kMostLimitSteps; ++k) {
    const double go = length(left);
    if (go <= 1e-9) break;
    const double part = std::fmin(go, std::fmax(fine, clear));
    const Vec3 next = place + left * (part / go);
    left = left * ((go - part) / go);
    const Collider::Sample sample = collider_.sample(next);
    place = next;
    clear = sample.distance;
    if (clear < floor) {
      place = next + sample.normal * (floor - clear);
      clear = floor;
      left = left - sample.normal * std::fmin(0.0, dot(left, sample.normal));
    }
  }
  return place - from;
}

}  // namespace karinui

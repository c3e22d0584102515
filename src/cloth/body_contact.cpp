#include "cloth/body_contact.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kFirmness = 3e5;  // N/m per m2 of cloth: 30 N/m for each cm2
constexpr double kHarder = 4;      // how the push grows with depth: r + 4 r^3, r = depth / offset
constexpr double kStraight = 2;    // beyond this r it grows straight on
constexpr double kGlide = 2e-5;    // metres: friction of a node that slips is no stiffer than over this
constexpr std::size_t kBlock = 256;

}  // namespace

Push bodyPush(double area, double depth, double offset) {
  const double k = kFirmness * area, r = depth / offset;
  if (r <= kStraight) return {k * offset * (r + kHarder * r * r * r), k * (1 + 3 * kHarder * r * r)};
  const double slope = k * (1 + 3 * kHarder * kStraight * kStraight);
  return {k * offset * (kStraight + kHarder * kStraight * kStraight * kStraight) + slope * (depth - kStraight * offset),
          slope};
}

BodyContact::BodyContact(const Collider& body, std::vector<Node> nodes, double offset)
    : body_(body), nodes_(std::move(nodes)), at_(nodes_.size()), farOff_(nodes_.size()), offset_(offset) {
  NodeIndex last = 0;
  for (const Node& n : nodes_) last = std::max(last, n.node + 1);
  cover(last);
}

void BodyContact::cover(std::size_t nodeCount) {
  slot_.assign(nodeCount, kNoNode);
  for (std::uint32_t k = 0; k < nodes_.size(); ++k) slot_[nodes_[k].node] = k;
}

void BodyContact::find(std::span<const Vec3> x, bool withFriction, Workers& workers, bool sliding) {
  workers.forBlocks(nodes_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Node& node = nodes_[k];
      At& at = at_[k];
      const Vec3 place = x[node.node];
      at.touches = false;
      Collider::Sample contact;
      if (farOff_.mayBeWithin(body_, k, place, offset_)) {
        contact = body_.sample(place);
        at.touches = contact.distance < offset_;
      }
      if (!at.touches) {
        at = {};
        continue;
      }
      const Push push = bodyPush(node.area, offset_ - contact.distance, offset_);
      at.normal = contact.normal;
      at.push = push.force;
      at.along = push.slope;
      at.across = 0;
      at.ahead = {};
      at.force = contact.normal * -push.force;
      if (!withFriction || node.friction <= 0) continue;
      if (!at.stuck) {
        at.stuck = true;
        at.anchor = place;
      }
      Vec3 pull = place - at.anchor;
      pull = pull - at.normal * dot(pull, at.normal);
      const double length = karinui::length(pull), most = node.friction * push.force;
      const double hold = kFirmness * node.area;
      const double spring = length > 0 ? std::fmin(hold, most / length) : hold;
      at.force += pull * spring;
      // A node that slipped goes on slipping: seen as stiff as its anchor's spring it would creep as in syrup.
      at.across = at.slip > 0 ? std::fmin(spring, most / std::fmax(kGlide, length + at.slip)) : spring;
      if (sliding && at.slip > kSlides) at.across = 0;
      if (at.slip > 0 && length > 0) at.ahead = pull * (at.across * at.slip / length);
    }
  });
  touching_ = 0;
  for (const At& at : at_) touching_ += at.touches ? 1 : 0;
}

void BodyContact::addGradient(std::span<Vec3> gradient) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (at_[k].touches) gradient[nodes_[k].node] += at_[k].force;
}

void BodyContact::addExpectedSlip(std::span<Vec3> force) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (at_[k].touches) force[nodes_[k].node] += at_[k].ahead;
}

void BodyContact::addBlocks(const TieMap& ties, BlockSystem& system) const {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const At& at = at_[k];
    if (!at.touches) continue;
    double whole = 0;
    for (const TieMap::Part& part : ties.parts(nodes_[k].node)) whole += std::fabs(part.weight);
    for (const TieMap::Part& part : ties.parts(nodes_[k].node)) {
      const double share = whole * std::fabs(part.weight);
      Block3 block{};
      addStretch(block, share * at.across, share * (at.along - at.across), at.normal);
      system.addDiagonal(part.unknown, block);
    }
  }
}

void BodyContact::moveAnchors(std::span<const Vec3> x, Workers& workers) {
  workers.forBlocks(nodes_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      At& at = at_[k];
      if (!at.stuck) continue;
      const Vec3 place = x[nodes_[k].node];
      const Collider::Sample contact = body_.sample(place);
      if (contact.distance >= offset_) {
        at = {};
        continue;
      }
      const double push = bodyPush(nodes_[k].area, offset_ - contact.distance, offset_).force;
      Vec3 pull = place - at.anchor;
      pull = pull - contact.normal * dot(pull, contact.normal);
      const double length = karinui::length(pull);
      const double most = nodes_[k].friction * push / (kFirmness * nodes_[k].area);
      at.slip = std::fmax(0.0, length - most);
      at.anchor = place - pull * (length > most ? most / length : 1.0);
    }
  });
  anchorMove_ = 0;
  for (const At& at : at_) anchorMove_ = std::fmax(anchorMove_, at.slip);
}

void BodyContact::forgetAnchors() {
  for (At& at : at_) at = {};
}

Vec3 BodyContact::limited(Vec3 from, Vec3 move) const {
  const double reach = length(move);
  const double fine = 0.5 * offset_;
  if (reach <= fine || !body_.mayBeWithin(from, reach)) return move;
  const Collider::Sample start = body_.sample(from);
  if (start.distance > reach) return move;
  const double floor = std::fmin(0.0, start.distance);  // never deeper than the surface, or than it already is
  Vec3 place = from, left = move;
  double clear = start.distance;
  for (int k = 0; k < 64; ++k) {
    const double go = length(left);
    if (go <= 1e-9) break;
    const double stride = std::fmin(go, std::fmax(fine, clear));
    const Vec3 next = place + left * (stride / go);
    left = left * ((go - stride) / go);
    const Collider::Sample contact = body_.sample(next);
    place = next;
    clear = contact.distance;
    if (clear < floor) {
      place = next + contact.normal * (floor - clear);
      clear = floor;
      left = left - contact.normal * std::fmin(0.0, dot(left, contact.normal));
    }
  }
  return place - from;
}

}  // namespace karinui

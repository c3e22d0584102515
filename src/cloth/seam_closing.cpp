#include "cloth/seam_closing.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr double kStiffness = 2e5;  // N/m per m2: 20 N/m for each cm2 of a node's cloth
constexpr double kMostForce = 20;   // N per metre of seam at most

// A force that leads into the surface is turned along it and keeps its magnitude; the straighter it leads in, the more
// it is turned towards `slide`.
Vec3 alongSurface(Vec3 force, Vec3 normal, Vec3 slide) {
  const double in = -dot(force, normal);
  const double magnitude = length(force);
  if (in <= 0 || magnitude <= 0) return force;
  const Vec3 tangent = slide - normal * dot(slide, normal);
  const Vec3 along = force + normal * in + (squaredLength(tangent) > 0 ? normalized(tangent) * in : Vec3{});
  return squaredLength(along) > 0 ? normalized(along) * magnitude : Vec3{};
}

// Which way an open pair slides along a surface between its sides: to the nearest pair of its seam that is tied
// already, as a zip closes; while there is none, away from the middle of its piece, as cloth is wrapped round a limb.
class SlideDirection {
 public:
  SlideDirection(const Cloth& cloth, const std::vector<std::uint8_t>& tied, std::span<const Vec3> x)
      : cloth_(cloth), x_(x), nearestTied_(cloth.ties.size(), kNoNode), middle_(cloth.nodeCount) {
    const auto count = static_cast<std::uint32_t>(cloth.ties.size());
    std::vector<std::uint32_t> before(count, kNoNode);
    const auto pass = [&](std::uint32_t t, std::uint32_t from, std::vector<std::uint32_t>& nearest) {
      const bool same = from < count && cloth.ties[from].seam == cloth.ties[t].seam;
      nearest[t] = tied[t] ? t : same ? nearest[from] : kNoNode;
    };
    for (std::uint32_t t = 0; t < count; ++t) pass(t, t - 1, before);
    for (std::uint32_t t = count; t-- > 0;) pass(t, t + 1, nearestTied_);
    for (std::uint32_t t = 0; t < count; ++t)
      if (before[t] != kNoNode && (nearestTied_[t] == kNoNode || t - before[t] <= nearestTied_[t] - t))
        nearestTied_[t] = before[t];
    for (const ClothPiece& piece : cloth.pieces) {
      Vec3 sum;
      const auto own = x.subspan(piece.firstNode, piece.lattice->nodes.size());
      for (Vec3 p : own) sum += p;
      std::fill_n(middle_.begin() + piece.firstNode, own.size(), sum * (1.0 / static_cast<double>(own.size())));
    }
  }
  Vec3 of(std::size_t tie, NodeIndex node) const {
    return nearestTied_[tie] != kNoNode ? x_[cloth_.ties[nearestTied_[tie]].a] - x_[node] : x_[node] - middle_[node];
  }

 private:
  const Cloth& cloth_;
  std::span<const Vec3> x_;
  std::vector<std::uint32_t> nearestTied_;  // per tie, along its seam
  std::vector<Vec3> middle_;                // per node: of its piece
};

}  // namespace

Vec3 SeamClosing::normalAt(NodeIndex node) const {
  for (const ColliderContact* contact : colliders_)
    if (const Vec3 normal = contact->normalAt(node); squaredLength(normal) > 0) return normal;
  return {};
}

void SeamClosing::detect(const ContactQuery& query, Workers&) {
  pulls_.clear();
  if (std::find(tied_.begin(), tied_.end(), 0) == tied_.end()) return;
  const double h = cloth_.spacing;
  const SlideDirection slide(cloth_, tied_, query.x);
  for (std::size_t t = 0; t < cloth_.ties.size(); ++t) {
    if (tied_[t]) continue;
    const Tie& tie = cloth_.ties[t];
    const Vec3 gap = gapOf(tie, query.x);
    const double open = length(gap);
    if (!(open > 0)) continue;
    Pull pull{tie, {}, {}, strength_ * std::fmin(kStiffness * h * h, kMostForce * h / open)};
    const Vec3 force = gap * pull.stiffness;
    pull.onA = alongSurface(force, normalAt(tie.a), slide.of(t, tie.a));
    Vec3 normalB = normalAt(tie.b);
    if (tie.c != kNoNode) normalB = normalized(normalB + normalAt(tie.c));
    pull.onB = alongSurface(-force, normalB, slide.of(t, tie.b));
    pulls_.push_back(pull);
  }
}

void SeamClosing::addGradient(std::span<Vec3> gradient) const {
  for (const Pull& pull : pulls_) {
    gradient[pull.tie.a] -= pull.onA;
    const double half = pull.tie.c == kNoNode ? 1.0 : 0.5;
    gradient[pull.tie.b] -= pull.onB * half;
    if (pull.tie.c != kNoNode) gradient[pull.tie.c] -= pull.onB * half;
  }
}

void SeamClosing::addHessian(ContactHessian& hessian) const {
  for (const Pull& pull : pulls_) {
    const bool folded = pull.tie.c != kNoNode;
    const NodeIndex nodes[] = {pull.tie.a, pull.tie.b, pull.tie.c};
    const double weights[] = {1, folded ? -0.5 : -1, -0.5};
    const std::size_t count = folded ? 3 : 2;
    hessian.addBetween({nodes, count}, {weights, count}, {}, pull.stiffness, pull.stiffness);
  }
}

}  // namespace karinui

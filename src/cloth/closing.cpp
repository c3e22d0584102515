#include "cloth/closing.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr double kFirmness = 2e5;  // N/m per m2: 20 N/m for each cm2 of a node's cloth
constexpr double kStrength = 20;   // N per metre of seam at most

// Where the pull leads into the body it is turned along the surface and keeps its strength, the more so towards
// `onwards` the straighter it leads in.
Vec3 aroundBody(Vec3 pull, Vec3 normal, Vec3 onwards) {
  const double in = -dot(pull, normal);
  const double strength = length(pull);
  if (in <= 0 || strength <= 0) return pull;
  const Vec3 slide = onwards - normal * dot(onwards, normal);
  const Vec3 along = pull + normal * in + (squaredLength(slide) > 0 ? normalized(slide) * in : Vec3{});
  return squaredLength(along) > 0 ? normalized(along) * strength : Vec3{};
}

// Which way an open pair goes when the body is between: to the nearest pair of its seam that is sewn already, as a
// zip closes; while there is none, onwards from the middle of its piece, as cloth is wrapped round a limb.
class Onwards {
 public:
  Onwards(const Cloth& cloth, const std::vector<std::uint8_t>& tied, std::span<const Vec3> x)
      : cloth_(cloth), x_(x), zip_(cloth.ties.size(), kNoNode), middle_(cloth.nodeCount) {
    const auto count = static_cast<std::uint32_t>(cloth.ties.size());
    std::vector<std::uint32_t> before(count, kNoNode);
    const auto pass = [&](std::uint32_t t, std::uint32_t from, std::vector<std::uint32_t>& nearest) {
      const bool same = from < count && cloth.ties[from].seam == cloth.ties[t].seam;
      nearest[t] = tied[t] ? t : same ? nearest[from] : kNoNode;
    };
    for (std::uint32_t t = 0; t < count; ++t) pass(t, t - 1, before);
    for (std::uint32_t t = count; t-- > 0;) pass(t, t + 1, zip_);
    for (std::uint32_t t = 0; t < count; ++t)
      if (before[t] != kNoNode && (zip_[t] == kNoNode || t - before[t] <= zip_[t] - t)) zip_[t] = before[t];
    for (const ClothPiece& piece : cloth.pieces) {
      Vec3 sum;
      const auto own = x.subspan(piece.firstNode, piece.lattice->nodes.size());
      for (Vec3 p : own) sum += p;
      std::fill_n(middle_.begin() + piece.firstNode, own.size(), sum * (1.0 / static_cast<double>(own.size())));
    }
  }
  Vec3 of(std::size_t tie, NodeIndex node) const {
    return zip_[tie] != kNoNode ? x_[cloth_.ties[zip_[tie]].a] - x_[node] : x_[node] - middle_[node];
  }

 private:
  const Cloth& cloth_;
  std::span<const Vec3> x_;
  std::vector<std::uint32_t> zip_;  // per tie: the nearest one along its seam that is sewn
  std::vector<Vec3> middle_;        // per node: of its piece
};

}  // namespace

std::vector<ClosingPull> closingPulls(const Cloth& cloth, const std::vector<std::uint8_t>& tied,
                                      std::span<const Vec3> x, const BodyContact& contact, double firmness) {
  std::vector<ClosingPull> pulls;
  const double h = cloth.spacing;
  const Onwards onwards(cloth, tied, x);
  for (std::size_t t = 0; t < cloth.ties.size(); ++t) {
    if (tied[t]) continue;
    const Tie& tie = cloth.ties[t];
    const Vec3 gap = gapOf(tie, x);
    const double open = length(gap);
    if (!(open > 0)) continue;
    ClosingPull pull{tie, {}, {}, firmness * std::fmin(kFirmness * h * h, kStrength * h / open)};
    const Vec3 force = gap * pull.stiffness;
    pull.onA = aroundBody(force, contact.normalAt(tie.a), onwards.of(t, tie.a));
    Vec3 normalB = contact.normalAt(tie.b);
    if (tie.c != kNoNode) normalB = normalized(normalB + contact.normalAt(tie.c));
    pull.onB = aroundBody(-force, normalB, onwards.of(t, tie.b));
    pulls.push_back(pull);
  }
  return pulls;
}

void addGradient(const std::vector<ClosingPull>& pulls, std::span<Vec3> gradient) {
  for (const ClosingPull& pull : pulls) {
    gradient[pull.tie.a] -= pull.onA;
    const double half = pull.tie.c == kNoNode ? 1.0 : 0.5;
    gradient[pull.tie.b] -= pull.onB * half;
    if (pull.tie.c != kNoNode) gradient[pull.tie.c] -= pull.onB * half;
  }
}

void addCouplings(const std::vector<ClosingPull>& pulls, const TieMap& ties, std::vector<Coupling>& couplings) {
  for (const ClosingPull& pull : pulls) {
    const bool folded = pull.tie.c != kNoNode;
    const std::uint32_t nodes[] = {pull.tie.a, pull.tie.b, pull.tie.c};
    const double weights[] = {1, folded ? -0.5 : -1, -0.5};
    couplings.push_back(
        {partsOf(ties, {nodes, folded ? 3u : 2u}, {weights, folded ? 3u : 2u}), {}, pull.stiffness, pull.stiffness});
  }
}

}  // namespace karinui

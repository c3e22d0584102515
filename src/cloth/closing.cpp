#include "cloth/closing.h"

#include <cmath>

namespace karinui {
namespace {

constexpr double kFirmness = 2e5;  // N/m per m2: 20 N/m for each cm2 of a node's cloth
constexpr double kStrength = 20;   // N per metre of seam at most

// Where the pull leads into the body it is turned along the surface and keeps its strength. Straight against the body
// it has no side to prefer: both partners then go round the same one, the body's left.
Vec3 aroundBody(Vec3 pull, Vec3 normal) {
  const double in = -dot(pull, normal);
  const double strength = length(pull);
  if (in <= 0 || strength <= 0) return pull;
  Vec3 along = pull + normal * in;
  if (length(along) < 0.1 * strength) {
    const Vec3 left{1, 0, 0}, up{0, 1, 0};
    along = left - normal * dot(left, normal);
    if (length(along) < 0.3) along = up - normal * dot(up, normal);
  }
  return normalized(along) * strength;
}

}  // namespace

std::vector<ClosingPull> closingPulls(const Cloth& cloth, const std::vector<std::uint8_t>& tied,
                                      std::span<const Vec3> x, const BodyContact& contact, double firmness) {
  std::vector<ClosingPull> pulls;
  const double h = cloth.spacing;
  for (std::size_t t = 0; t < cloth.ties.size(); ++t) {
    if (tied[t]) continue;
    const Tie& tie = cloth.ties[t];
    const Vec3 gap = gapOf(tie, x);
    const double open = length(gap);
    if (!(open > 0)) continue;
    ClosingPull pull{tie, {}, {}, firmness * std::fmin(kFirmness * h * h, kStrength * h / open)};
    const Vec3 force = gap * pull.stiffness;
    pull.onA = aroundBody(force, contact.normalAt(tie.a));
    Vec3 normalB = contact.normalAt(tie.b);
    if (tie.c != kNoNode) normalB = normalized(normalB + contact.normalAt(tie.c));
    pull.onB = aroundBody(-force, normalB);
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

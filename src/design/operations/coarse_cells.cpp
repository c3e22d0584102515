#include "design/operations/coarse_cells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "karinui/base/number.h"
#include "karinui/cloth/support.h"
#include "karinui/design/drape.h"
#include "karinui/geometry/bvh.h"

namespace karinui {

namespace {

constexpr double kUsual = 0.012;  // metres: cells that are no wider are not looked at
// Shirts on children of 110 and 128 cm and on EU 38: cells round the cuff, and what 99 % of all press less than.
//   9.9  71 kPa     10.4  65     11.8  9.4     12.3  22     13  21     14.7  3.5     15.2  3.7     16  6.5     18  2.3
constexpr double kFewCells = 13.5, kEnoughCells = 15.5;
constexpr double kHard = 15e3;      // Pa: hose for legs that are ill press by 6
constexpr double kNearSkin = 0.05;  // metres from the skin
constexpr double kAllRound = 0.35;  // of the skin's normals' mean: a slit's all look one way, a cuff's all ways

struct Opening {
  std::uint32_t node = 0;  // one of its nodes
  double length = 0;       // metres
  std::vector<Vec3> places;
};

// The closed borders of the cloth as it is sewn.
std::vector<Opening> openingsOf(const Cloth& cloth, const std::vector<Vec3>& x) {
  std::vector<std::uint32_t> one(cloth.nodeCount);  // of the nodes sewn together
  std::iota(one.begin(), one.end(), 0u);
  const auto root = [&](std::uint32_t k) {
    while (one[k] != k) k = one[k] = one[one[k]];
    return k;
  };
  for (const Tie& tie : cloth.ties) {
    one[root(tie.b)] = root(tie.a);
    if (tie.c != kNoNode) one[root(tie.c)] = root(tie.a);
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> faces;  // of each edge
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& f : piece.lattice->faces)
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(root(piece.firstNode + f[k]), root(piece.firstNode + f[(k + 1) % 3]));
        if (low != high) ++faces[{low, high}];
      }
  std::map<std::uint32_t, std::vector<std::uint32_t>> beside;  // along the borders
  for (const auto& [edge, count] : faces)
    if (count == 1) beside[edge.first].push_back(edge.second), beside[edge.second].push_back(edge.first);
  std::vector<Opening> openings;
  while (!beside.empty()) {
    Opening opening{beside.begin()->first, 0, {}};
    bool ring = true;
    for (std::uint32_t at = opening.node; beside.contains(at);) {
      const std::vector<std::uint32_t> both = beside.extract(at).mapped();
      ring = ring && both.size() == 2;
      opening.places.push_back(x[at]);
      at = both.size() > 1 && !beside.contains(both[0]) ? both[1] : both[0];
      opening.length += distance(x[at], opening.places.back());
    }
    if (ring) openings.push_back(std::move(opening));
  }
  return openings;
}

bool goesRoundLimb(const Opening& opening, const Body& body) {
  Vec3 sum;
  for (const Vec3 place : opening.places) {
    const auto near = body.bvh().nearest(place, kNearSkin);
    if (!near) return false;
    sum += faceNormal(body.mesh(), near->place.face);
  }
  return length(sum) < kAllRound * static_cast<double>(opening.places.size());
}

// That 99 % of its nodes press less than, Pa.
double pressureOf(const ClothPiece& piece, const std::vector<Vec3>& support) {
  std::vector<double> own;
  for (std::size_t k = 0; k < piece.lattice->nodes.size(); ++k) own.push_back(length(support[piece.firstNode + k]));
  const auto at = own.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(own.size()));
  std::nth_element(own.begin(), at, own.end());
  return *at;
}

}  // namespace

void tellCoarseCells(const Document& draped, Context& context) {
  const double cell = draped.settings.spacing;
  if (cell <= kUsual) return;
  const auto standing = standingCloth(draped, livePieces(draped, {}));
  const auto body = bodyOf(draped, context);
  if (!standing || !body) return;
  const Cloth& cloth = standing->cloth;
  const Opening* least = nullptr;
  const std::vector<Opening> openings = openingsOf(cloth, standing->state.position);
  for (const Opening& opening : openings)
    if (opening.length < kFewCells * cell && (!least || opening.length < least->length) &&
        goesRoundLimb(opening, **body))
      least = &opening;
  if (!least) return;
  const ClothPiece* piece = &cloth.pieces.front();
  for (const ClothPiece& other : cloth.pieces)
    if (other.firstNode <= least->node) piece = &other;
  const double pressure = pressureOf(*piece, supportOf(cloth, standing->state, {0, -9.81, 0}, context.workers));
  if (pressure < kHard) return;
  context.advise(
      {say("“{0}” presses by {1} kPa, as no cloth does: its opening of {2} cm is {3} cells of {4} mm. Drape "
           "in finer ones: set spacing={5}mm.",
           piece->name, std::round(pressure / 1000), std::round(least->length * 100), std::floor(least->length / cell),
           fixed(cell * 1000, 0), std::floor(least->length / kEnoughCells * 1000)),
       piece->id});
}

}  // namespace karinui

#include "karinui/cloth/gather_waves.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "cloth/flat_piece.h"

namespace karinui {
namespace {

constexpr double kLeastRatio = 2.4;  // less is drawn in from flat cloth
constexpr double kStraight = 0.02;   // of its length: how far a straight edge may leave the line between its ends

struct PaperPlace {
  std::size_t piece = 0;
  Flat at;
};
PaperPlace paperPlace(const Cloth& cloth, std::uint32_t node) {
  const auto after = std::upper_bound(cloth.pieces.begin(), cloth.pieces.end(), node,
                                      [](std::uint32_t n, const ClothPiece& piece) { return n < piece.firstNode; });
  const ClothPiece& piece = *std::prev(after);
  return {static_cast<std::size_t>(&piece - cloth.pieces.data()), piece.lattice->nodes[node - piece.firstNode]};
}

// A straight edge drawn in by pairs sewn 2:1.
struct Gather {
  Flat from, along;  // one of its ends, and unit, on paper
  double length = 0, ratio = 1;
  double first = 0, apart = 0;  // metres: from there to the first pair; between the nodes of a pair
};

std::optional<Gather> gatherOf(const Cloth& cloth, std::vector<const Tie*> ties) {
  std::vector<Flat> places;
  for (const Tie* tie : ties)
    places.push_back(paperPlace(cloth, tie->b).at), places.push_back(paperPlace(cloth, tie->c).at);
  const auto farthest = [&](Flat from) {
    return *std::max_element(places.begin(), places.end(),
                             [&](Flat a, Flat b) { return distance(a, from) < distance(b, from); });
  };
  Gather gather;
  const Flat end = farthest(places.front());
  gather.from = farthest(end);
  gather.length = distance(gather.from, end);
  if (!(gather.length > 0)) return std::nullopt;
  gather.along = (end - gather.from) * (1 / gather.length);
  if (std::any_of(places.begin(), places.end(), [&](Flat place) {
        return std::fabs(cross(place - gather.from, gather.along)) > kStraight * gather.length;
      }))
    return std::nullopt;
  std::sort(ties.begin(), ties.end(), [&](const Tie* one, const Tie* other) {
    return dot(paperPlace(cloth, one->b).at, gather.along) < dot(paperPlace(cloth, other->b).at, gather.along);
  });
  double drawnTo = 0;
  for (std::size_t k = 0; k + 1 < ties.size(); ++k) {
    const PaperPlace here = paperPlace(cloth, ties[k]->a), next = paperPlace(cloth, ties[k + 1]->a);
    if (here.piece == next.piece) drawnTo += distance(here.at, next.at);
  }
  if (drawnTo > 0) gather.ratio = gather.length / drawnTo;
  const auto alongOf = [&](std::uint32_t node) { return dot(paperPlace(cloth, node).at - gather.from, gather.along); };
  gather.first = std::min(alongOf(ties.front()->b), alongOf(ties.front()->c));
  std::vector<double> apart;
  for (const Tie* tie : ties) apart.push_back(std::fabs(alongOf(tie->b) - alongOf(tie->c)));
  std::nth_element(apart.begin(), apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2), apart.end());
  gather.apart = apart[apart.size() / 2];
  return gather;
}

// Of the edges of a piece the one that is gathered most.
std::optional<Gather> mostGathered(const Cloth& cloth, std::size_t piece) {
  std::map<std::uint32_t, std::vector<const Tie*>> seams;
  for (const Tie& tie : cloth.ties)
    if (tie.c != kNoNode && tie.c != tie.b && paperPlace(cloth, tie.b).piece == piece) seams[tie.seam].push_back(&tie);
  std::optional<Gather> most;
  for (const auto& [seam, ties] : seams)
    if (const auto gather = gatherOf(cloth, ties); gather && (!most || gather->ratio > most->ratio)) most = gather;
  return most;
}

// The way in space along `along`, unit on paper, of a piece that stands flat.
Vec3 inSpace(const ClothPiece& piece, std::span<const Vec3> x, Flat along) {
  const auto own = x.subspan(piece.firstNode, piece.lattice->nodes.size());
  Flat middle;
  for (const Flat place : piece.lattice->nodes) middle += place * (1 / static_cast<double>(own.size()));
  Vec3 way;
  for (std::size_t k = 0; k < own.size(); ++k) way += (own[k] - own[0]) * dot(piece.lattice->nodes[k] - middle, along);
  return normalized(way);
}

bool anyPinned(const Cloth& cloth, const ClothPiece& piece) {
  const std::size_t end = piece.firstNode + piece.lattice->nodes.size();
  return std::any_of(cloth.pinned.begin(), cloth.pinned.end(),
                     [&](std::uint32_t node) { return node >= piece.firstNode && node < end; });
}

}  // namespace

bool layGathersInWaves(const Cloth& cloth, std::vector<Vec3>& x) {
  bool any = false;
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p) {
    const ClothPiece& piece = cloth.pieces[p];
    const auto normal = piece.live && !anyPinned(cloth, piece) ? normalWhereFlat(piece, x) : std::nullopt;
    const auto gather = normal ? mostGathered(cloth, p) : std::nullopt;
    if (!gather || gather->ratio < kLeastRatio) continue;
    const Vec3 along = inSpace(piece, x, gather->along);
    // The two nodes of a pair stand on the two sides of the edge they are sewn to, so that their middle lies on it.
    const double drawn = 1 / gather->ratio, deep = 0.5 * gather->apart * std::sqrt(1 - drawn * drawn);
    for (std::size_t k = 0; k < piece.lattice->nodes.size(); ++k) {
      const double u = dot(piece.lattice->nodes[k] - gather->from, gather->along);
      const double in =
          std::fabs(std::remainder((u - gather->first) / gather->apart, 2.0));  // 0 on a crest, 1 in a trough
      x[piece.firstNode + k] += along * ((drawn - 1) * (u - 0.5 * gather->length)) + *normal * (deep * (1 - 2 * in));
    }
    any = true;
  }
  return any;
}

}  // namespace karinui

#include "karinui/check/check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>

#include "karinui/base/sort_once.h"
#include "karinui/geometry/triangle_intersection.h"

namespace karinui {
namespace {

constexpr double kFarthest = 1000;  // metres; a place beyond is a mistake

struct Sheet {  // the whole cloth as one mesh
  TriangleMesh mesh;
  std::vector<NanoPoint> nano;
  std::vector<std::uint32_t> group;  // nodes sewn together carry the same number
  std::vector<PieceId> piece;        // of each face
  std::array<NanoPoint, 3> corners(std::uint32_t face) const {
    const Triangle& f = mesh.faces[face];
    return {nano[f[0]], nano[f[1]], nano[f[2]]};
  }
};

Sheet sheetOf(const Cloth& cloth, const ClothState& state) {
  Sheet sheet;
  sheet.mesh.points = state.position;
  for (Vec3 p : state.position) sheet.nano.push_back(karinui::toNano(p));
  for (const ClothPiece& piece : cloth.pieces)
    for (const Triangle& f : piece.lattice->faces) {
      sheet.mesh.faces.push_back({piece.firstNode + f[0], piece.firstNode + f[1], piece.firstNode + f[2]});
      sheet.piece.push_back(piece.id);
    }
  sheet.group.resize(state.position.size());
  std::iota(sheet.group.begin(), sheet.group.end(), 0);
  const auto root = [&](std::uint32_t k) {
    while (sheet.group[k] != k) k = sheet.group[k] = sheet.group[sheet.group[k]];
    return k;
  };
  for (const Tie& tie : cloth.ties) {
    sheet.group[root(tie.b)] = root(tie.a);
    if (tie.c != kNoNode) sheet.group[root(tie.c)] = root(tie.a);
  }
  for (std::uint32_t k = 0; k < sheet.group.size(); ++k) sheet.group[k] = root(k);
  return sheet;
}

Box boxOfFace(const TriangleMesh& mesh, const Triangle& face) {
  Box box;
  for (std::uint32_t k : face) box.include(mesh.points[k]);
  return box;
}

double penetrationOf(const Sheet& sheet, const Bvh& body) {
  double deepest = 0;
  const auto ask = [&](Vec3 place) { deepest = std::fmax(deepest, -body.signedDistance(place)); };
  for (Vec3 p : sheet.mesh.points) ask(p);
  for (const Triangle& f : sheet.mesh.faces) {
    const Vec3 a = sheet.mesh.points[f[0]], b = sheet.mesh.points[f[1]], c = sheet.mesh.points[f[2]];
    ask((a + b) * 0.5);
    ask((b + c) * 0.5);
    ask((c + a) * 0.5);
    ask((a + b + c) * (1.0 / 3));
  }
  return deepest;
}

std::size_t crossingsWith(const Sheet& sheet, const Body& body) {
  const TriangleMesh& mesh = body.mesh();
  std::vector<NanoPoint> nano;
  for (Vec3 p : mesh.points) nano.push_back(karinui::toNano(p));
  std::size_t crossings = 0;
  for (std::uint32_t f = 0; f < sheet.mesh.faces.size(); ++f)
    body.bvh().touching(boxOfFace(sheet.mesh, sheet.mesh.faces[f]), [&](std::uint32_t g) {
      const Triangle& other = mesh.faces[g];
      if (trianglesIntersect(sheet.corners(f), {nano[other[0]], nano[other[1]], nano[other[2]]})) ++crossings;
    });
  return crossings;
}

struct WithinCloth {
  std::size_t apart = 0, folds = 0;  // pairs that share nothing, pairs that share a node or a tie
  std::vector<ClothCrossing> byPieces;
};

constexpr double kShared = 1e-5;  // metres: nearer than this to what two faces share they only touch

// Whether an edge of one face passes through the other away from the places they share. `shared`: those places.
bool crossAway(const Sheet& sheet, std::uint32_t f, std::uint32_t g, std::span<const Vec3> shared) {
  const Triangle &from = sheet.mesh.faces[f], &to = sheet.mesh.faces[g];
  const auto& x = sheet.mesh.points;
  const Vec3 normal = cross(x[to[1]] - x[to[0]], x[to[2]] - x[to[0]]);
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t p = from[c], q = from[(c + 1) % 3];
    if (!segmentCrossesTriangle(sheet.nano[p], sheet.nano[q], sheet.corners(g))) continue;
    const double before = dot(x[p] - x[to[0]], normal), after = dot(x[q] - x[to[0]], normal);
    const Vec3 at = lerp(x[p], x[q], before == after ? 0.5 : before / (before - after));
    if (std::all_of(shared.begin(), shared.end(), [&](Vec3 place) { return distance(place, at) > kShared; }))
      return true;
  }
  return false;
}

Vec3 middleOf(const Sheet& sheet, std::uint32_t face) {
  const Triangle& f = sheet.mesh.faces[face];
  return (sheet.mesh.points[f[0]] + sheet.mesh.points[f[1]] + sheet.mesh.points[f[2]]) * (1.0 / 3);
}

WithinCloth crossingsWithin(const Sheet& sheet) {
  const Bvh tree(sheet.mesh);
  WithinCloth found;
  std::map<std::pair<PieceId, PieceId>, ClothCrossing> byPieces;
  std::vector<Vec3> shared;
  for (std::uint32_t f = 0; f < sheet.mesh.faces.size(); ++f)
    tree.touching(boxOfFace(sheet.mesh, sheet.mesh.faces[f]), [&](std::uint32_t g) {
      if (g <= f) return;
      shared.clear();
      for (std::uint32_t a : sheet.mesh.faces[f])
        for (std::uint32_t b : sheet.mesh.faces[g])
          if (sheet.group[a] == sheet.group[b]) {
            shared.push_back(sheet.mesh.points[a]);
            shared.push_back(sheet.mesh.points[b]);
          }
      const bool crossed = shared.empty() ? trianglesIntersect(sheet.corners(f), sheet.corners(g))
                                          : crossAway(sheet, f, g, shared) || crossAway(sheet, g, f, shared);
      if (!crossed) return;
      ++(shared.empty() ? found.apart : found.folds);
      const auto [a, b] = std::minmax(sheet.piece[f], sheet.piece[g]);
      ClothCrossing& crossing = byPieces[{a, b}];
      crossing.a = a, crossing.b = b;
      crossing.middle = lerp(crossing.middle, middleOf(sheet, f), 1.0 / static_cast<double>(++crossing.pairs));
    });
  for (const auto& [pieces, crossing] : byPieces) found.byPieces.push_back(crossing);
  std::stable_sort(found.byPieces.begin(), found.byPieces.end(),
                   [](const ClothCrossing& a, const ClothCrossing& b) { return a.pairs > b.pairs; });
  return found;
}

// Over warp and weft edges of whole cells, found without the solver's code: two grid neighbours of a covered cell.
StrainReport strainOf(const Cloth& cloth, const ClothState& state) {
  std::vector<double> strain;
  for (const ClothPiece& piece : cloth.pieces) {
    const Lattice& lattice = *piece.lattice;
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::size_t j = 0; j + 1 < lattice.rows; ++j)
      for (std::size_t i = 0; i + 1 < lattice.columns; ++i) {
        if (!lattice.cell[j * (lattice.columns - 1) + i]) continue;
        const auto at = [&](std::size_t di, std::size_t dj) {
          return lattice.grid[(j + dj) * lattice.columns + i + di];
        };
        edges.push_back({at(0, 0), at(1, 0)});
        edges.push_back({at(0, 1), at(1, 1)});
        edges.push_back({at(0, 0), at(0, 1)});
        edges.push_back({at(1, 0), at(1, 1)});
      }
    sortOnce(edges);
    for (const auto& [a, b] : edges)
      strain.push_back(std::fabs(distance(state.position[piece.firstNode + a], state.position[piece.firstNode + b]) /
                                     distance(lattice.nodes[a], lattice.nodes[b]) -
                                 1));
  }
  StrainReport report;
  if (strain.empty()) return report;
  std::sort(strain.begin(), strain.end());
  report.mean = std::accumulate(strain.begin(), strain.end(), 0.0) / static_cast<double>(strain.size());
  report.p99 = strain[static_cast<std::size_t>(0.99 * static_cast<double>(strain.size() - 1))];
  report.max = strain.back();
  return report;
}

}  // namespace

ClothCheck check(const Cloth& cloth, const ClothState& state, const Body* body) {
  ClothCheck found;
  found.vertices = state.position.size();
  found.finite = state.position.size() == cloth.nodeCount &&
                 std::all_of(state.position.begin(), state.position.end(),
                             [](Vec3 p) { return finite(p) && length(p) < kFarthest; });
  if (!found.finite) return found;
  const Sheet sheet = sheetOf(cloth, state);
  if (sheet.mesh.faces.empty()) return found;
  if (body) {
    found.penetration = penetrationOf(sheet, body->bvh());
    found.clothBodyCrossings = crossingsWith(sheet, *body);
  }
  const WithinCloth within = crossingsWithin(sheet);
  found.clothClothCrossings = within.apart;
  found.foldCrossings = within.folds;
  found.crossings = within.byPieces;
  for (const Tie& tie : cloth.ties) {
    const Vec3 b = state.position[tie.b];
    const Vec3 other = tie.c == kNoNode ? b : (b + state.position[tie.c]) * 0.5;
    found.seamGap = std::fmax(found.seamGap, distance(state.position[tie.a], other));
  }
  found.strain = strainOf(cloth, state);
  return found;
}

}  // namespace karinui

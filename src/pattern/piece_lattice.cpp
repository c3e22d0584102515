#include "piece_lattice.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/sort_once.h"

namespace karinui {
namespace {

constexpr double kClear = 0.6;       // spacings a grid node keeps from the outline
constexpr double kCellClear = 0.75;  // spacings the middle of a whole cell keeps from it
constexpr double kSliver = 20 * 3.14159265358979323846 / 180;

enum class Spot : std::uint8_t { Free, Node, Taken };  // outside or too near, a node, dropped for a sliver's sake

struct Segment {
  Flat a, b;
};

// The grid under a piece, in steps from its centre: columns along weft, rows along warp. Its lower corner is an even
// number of steps from the centre, so that diagonals alternate alike in a piece and in its mirror image.
struct Grid {
  Flat centre, weft, warp;
  double spacing = 0;
  int left = 0, low = 0, columns = 0, rows = 0;
  std::vector<Spot> spot;
  std::vector<std::uint8_t> blocked;  // cells (columns - 1) x (rows - 1) that something runs through

  Flat place(int i, int j) const { return centre + weft * ((left + i) * spacing) + warp * ((low + j) * spacing); }
  Flat steps(Flat p) const { return {dot(p - centre, weft) / spacing - left, dot(p - centre, warp) / spacing - low}; }
  std::size_t at(int i, int j) const { return static_cast<std::size_t>(j) * columns + i; }
  std::size_t cellAt(int i, int j) const { return static_cast<std::size_t>(j) * (columns - 1) + i; }
  bool node(int i, int j) const { return spot[at(i, j)] == Spot::Node; }
  bool whole(int i, int j) const {
    return i >= 0 && j >= 0 && i + 1 < columns && j + 1 < rows && !blocked[cellAt(i, j)] && node(i, j) &&
           node(i + 1, j) && node(i, j + 1) && node(i + 1, j + 1);
  }
};

int evenBelow(double steps) {
  const int whole = static_cast<int>(std::floor(steps));
  return whole - (whole & 1);
}

// `lines`: segments inside, which the grid keeps clear of as well.
Grid gridUnder(const std::vector<Segment>& segments, const std::vector<Segment>& lines, Flat centre, Flat warp,
               double spacing) {
  Grid grid;
  grid.centre = centre;
  grid.weft = {warp.v, -warp.u};
  grid.warp = warp;
  grid.spacing = spacing;
  FlatBox box;
  for (const Segment& s : segments) box.include(grid.steps(s.a));
  grid.left = evenBelow(box.low.u);
  grid.low = evenBelow(box.low.v);
  grid.columns = static_cast<int>(std::ceil(box.high.u)) - grid.left + 1;
  grid.rows = static_cast<int>(std::ceil(box.high.v)) - grid.low + 1;
  grid.spot.assign(static_cast<std::size_t>(grid.columns) * grid.rows, Spot::Free);
  grid.blocked.assign(static_cast<std::size_t>(std::max(grid.columns - 1, 0)) * std::max(grid.rows - 1, 0), 0);

  // Row by row, what lies between an odd and an even crossing with the outline is inside.
  std::vector<std::vector<double>> crossings(grid.rows);
  for (const Segment& s : segments) {
    Flat p = grid.steps(s.a), q = grid.steps(s.b);
    if (p.v > q.v) std::swap(p, q);
    for (int j = std::max(0, static_cast<int>(std::ceil(p.v))); j < q.v && j < grid.rows; ++j)
      crossings[j].push_back(p.u + (j - p.v) / (q.v - p.v) * (q.u - p.u));
  }
  for (int j = 0; j < grid.rows; ++j) {
    auto& row = crossings[j];
    std::sort(row.begin(), row.end());
    for (std::size_t k = 0; k + 1 < row.size(); k += 2)
      for (int i = std::max(0, static_cast<int>(std::ceil(row[k]))); i <= row[k + 1] && i < grid.columns; ++i)
        grid.spot[grid.at(i, j)] = Spot::Node;
  }
  // Then what is too near the outline goes. The hair's breadth keeps a tie the same in a mirrored piece.
  const auto clear = [&](const Segment& s) {
    const Flat p = grid.steps(s.a), q = grid.steps(s.b);
    const int i0 = std::max(0, static_cast<int>(std::floor(std::min(p.u, q.u) - 1.3)));
    const int i1 = std::min(grid.columns - 1, static_cast<int>(std::ceil(std::max(p.u, q.u) + 1.3)));
    const int j0 = std::max(0, static_cast<int>(std::floor(std::min(p.v, q.v) - 1.3)));
    const int j1 = std::min(grid.rows - 1, static_cast<int>(std::ceil(std::max(p.v, q.v) + 1.3)));
    for (int j = j0; j <= j1; ++j)
      for (int i = i0; i <= i1; ++i) {
        if (distanceToSegment(p, q, {double(i), double(j)}) < kClear - 1e-7) grid.spot[grid.at(i, j)] = Spot::Free;
        if (i + 1 < grid.columns && j + 1 < grid.rows && distanceToSegment(p, q, {i + 0.5, j + 0.5}) < kCellClear)
          grid.blocked[grid.cellAt(i, j)] = 1;
      }
  };
  std::for_each(segments.begin(), segments.end(), clear);
  std::for_each(lines.begin(), lines.end(), clear);
  return grid;
}

double smallestAngle(Flat a, Flat b, Flat c) {
  const auto angle = [](Flat p, Flat q, Flat r) {
    return std::atan2(std::abs(cross(q - p, r - p)), dot(q - p, r - p));
  };
  return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
}

// The ring between grid and outline, as a region to triangulate.
struct Band {
  std::vector<Flat> points;  // outline and holes first, then those grid nodes that touch the ring
  std::vector<RegionSide> sides;
  std::vector<std::size_t> spotOf;  // of the grid nodes
  std::size_t borderCount = 0;
};

Band bandOf(const Grid& grid, const BorderNodes& border) {
  Band band;
  const auto addRing = [&](const std::vector<Flat>& ring, bool forward) {
    const auto first = static_cast<std::uint32_t>(band.points.size()), count = static_cast<std::uint32_t>(ring.size());
    band.points.insert(band.points.end(), ring.begin(), ring.end());
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t a = first + k, b = first + (k + 1) % count;
      band.sides.push_back(forward ? RegionSide{a, b} : RegionSide{b, a});
    }
  };
  addRing(border.outline, true);
  for (const auto& hole : border.holes) addRing(hole, false);
  band.points.insert(band.points.end(), border.inner.begin(), border.inner.end());
  for (const auto& line : border.lines)  // the ring lies on both sides of it
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      band.sides.push_back({line[k], line[k + 1]});
      band.sides.push_back({line[k + 1], line[k]});
    }
  band.borderCount = band.points.size();
  std::vector<std::uint32_t> index(grid.spot.size(), kNoNode);
  for (int j = 0; j < grid.rows; ++j)
    for (int i = 0; i < grid.columns; ++i) {
      if (!grid.node(i, j)) continue;
      if (grid.whole(i, j) && grid.whole(i - 1, j) && grid.whole(i, j - 1) && grid.whole(i - 1, j - 1)) continue;
      index[grid.at(i, j)] = static_cast<std::uint32_t>(band.points.size());
      band.points.push_back(grid.place(i, j));
      band.spotOf.push_back(grid.at(i, j));
    }
  for (int j = 0; j + 1 < grid.rows; ++j)
    for (int i = 0; i + 1 < grid.columns; ++i) {
      if (!grid.whole(i, j)) continue;
      const std::uint32_t a = index[grid.at(i, j)], b = index[grid.at(i + 1, j)];
      const std::uint32_t c = index[grid.at(i + 1, j + 1)], d = index[grid.at(i, j + 1)];
      // The ring lies to the left when the cell's own side is walked the other way.
      if (!grid.whole(i, j - 1)) band.sides.push_back({b, a});
      if (!grid.whole(i + 1, j)) band.sides.push_back({c, b});
      if (!grid.whole(i, j + 1)) band.sides.push_back({d, c});
      if (!grid.whole(i - 1, j)) band.sides.push_back({a, d});
    }
  return band;
}

// How bad the ring's triangles are: the sum of what their smallest angles lack, and the grid nodes that have a part in
// it.
double badness(const Band& band, const std::vector<Triangle>& faces, std::vector<std::size_t>* culprits) {
  double sum = 0;
  for (const Triangle& f : faces) {
    const double angle = smallestAngle(band.points[f[0]], band.points[f[1]], band.points[f[2]]);
    if (angle >= kSliver) continue;
    sum += kSliver - angle;
    for (std::uint32_t p : f)
      if (culprits && p >= band.borderCount) culprits->push_back(band.spotOf[p - band.borderCount]);
  }
  return sum;
}

}  // namespace

Flat centreOf(const Ring& outline, Flat warp) {
  const Flat weft{warp.v, -warp.u};
  FlatBox box;
  for (Flat p : outline) box.include({dot(p, weft), dot(p, warp)});
  return weft * ((box.low.u + box.high.u) / 2) + warp * ((box.low.v + box.high.v) / 2);
}

Result<Lattice> latticeOf(const BorderNodes& border, Flat centre, Flat warp, double spacing,
                          std::optional<std::array<std::size_t, 2>>* clash) {
  std::vector<Segment> segments;
  const auto addSegments = [&](const std::vector<Flat>& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) segments.push_back({ring[k], ring[(k + 1) % ring.size()]});
  };
  addSegments(border.outline);
  for (const auto& hole : border.holes) addSegments(hole);
  std::vector<Flat> places = border.outline;
  for (const auto& hole : border.holes) places.insert(places.end(), hole.begin(), hole.end());
  places.insert(places.end(), border.inner.begin(), border.inner.end());
  std::vector<Segment> lines;
  for (const auto& line : border.lines)
    for (std::size_t k = 0; k + 1 < line.size(); ++k) lines.push_back({places[line[k]], places[line[k + 1]]});
  Grid grid = gridUnder(segments, lines, centre, warp, spacing);

  Band band = bandOf(grid, border);
  std::optional<SideClash> sideClash;
  auto ring = triangulateRegion(band.points, band.sides, &sideClash);
  if (!ring) {
    // Sides of the outline are numbered like the nodes they start (or, on a hole, end) at.
    if (sideClash && clash) *clash = {sideClash->first, sideClash->second};
    return ring.error();
  }
  // Slivers: let go of a grid node that has a part in one, wherever that makes the ring better.
  std::vector<std::size_t> culprits;
  double bad = badness(band, *ring, &culprits);
  sortOnce(culprits);
  constexpr std::size_t kTries = 64;
  for (std::size_t k = 0; k < std::min(culprits.size(), kTries); ++k) {
    grid.spot[culprits[k]] = Spot::Taken;
    Band tryBand = bandOf(grid, border);
    auto tryRing = triangulateRegion(tryBand.points, tryBand.sides);
    const double now = tryRing ? badness(tryBand, *tryRing, nullptr) : bad;
    if (tryRing && now < bad - 1e-6) {
      bad = now;
      band = std::move(tryBand);
      ring = std::move(tryRing);
    } else {
      grid.spot[culprits[k]] = Spot::Node;
    }
  }

  Lattice lattice;
  lattice.spacing = spacing;
  lattice.warp = warp;
  lattice.weft = grid.weft;
  lattice.columns = static_cast<std::uint32_t>(grid.columns);
  lattice.rows = static_cast<std::uint32_t>(grid.rows);
  lattice.grid.assign(grid.spot.size(), kNoNode);
  for (int j = 0; j < grid.rows; ++j)
    for (int i = 0; i < grid.columns; ++i)
      if (grid.node(i, j)) {
        lattice.grid[grid.at(i, j)] = static_cast<std::uint32_t>(lattice.nodes.size());
        lattice.nodes.push_back(grid.place(i, j));
      }
  const auto firstBorder = static_cast<std::uint32_t>(lattice.nodes.size());
  lattice.cell.assign(grid.blocked.size(), 0);
  for (int j = 0; j + 1 < grid.rows; ++j)
    for (int i = 0; i + 1 < grid.columns; ++i) {
      if (!grid.whole(i, j)) continue;
      lattice.cell[grid.cellAt(i, j)] = 1;
      const std::uint32_t a = lattice.grid[grid.at(i, j)], b = lattice.grid[grid.at(i + 1, j)];
      const std::uint32_t c = lattice.grid[grid.at(i + 1, j + 1)], d = lattice.grid[grid.at(i, j + 1)];
      if ((i + j) % 2 == 1) {
        lattice.faces.push_back({a, b, c});
        lattice.faces.push_back({a, c, d});
      } else {
        lattice.faces.push_back({a, b, d});
        lattice.faces.push_back({b, c, d});
      }
    }
  for (std::size_t k = 0; k < band.borderCount; ++k) lattice.nodes.push_back(band.points[k]);
  const auto nodeOf = [&](std::uint32_t p) {
    return p < band.borderCount ? firstBorder + p : lattice.grid[band.spotOf[p - band.borderCount]];
  };
  for (const Triangle& f : *ring) lattice.faces.push_back({nodeOf(f[0]), nodeOf(f[1]), nodeOf(f[2])});
  for (std::size_t k = 0; k < border.outline.size(); ++k)
    lattice.border.push_back(firstBorder + static_cast<std::uint32_t>(k));
  return lattice;
}

}  // namespace karinui

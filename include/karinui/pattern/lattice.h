#pragma once
// A piece as cloth: a square warp/weft lattice inside, a thin ring of triangles that conforms to the outline. Seam
// sides get matching numbers of points. Rest lengths are the paper's; nothing here moves. Metres on paper. Pure; any
// thread.
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "karinui/pattern/piece.h"

namespace karinui {

inline constexpr std::uint32_t kNoNode = 0xffffffffu;

struct Lattice {
  double spacing = 0;           // of the warp/weft grid, metres
  Flat warp{0, 1}, weft{1, 0};  // unit, at right angles
  std::vector<Flat> nodes;      // paper places; on the grid first, then the outline's, the holes', the lines'
  std::vector<Triangle> faces;  // all triangles, counter-clockwise on paper; grid squares alternate their diagonals
  // The grid: node (column i along weft, row j along warp) = grid[j * columns + i], or kNoNode. A square cell is whole
  // when its four corners are nodes and `cell[j * (columns-1) + i]` is 1 (it is covered by two faces, not by the ring).
  std::uint32_t columns = 0, rows = 0;
  std::vector<std::uint32_t> grid;
  std::vector<std::uint8_t> cell;
  // The outline's nodes in order (counter-clockwise), and where each named edge begins: the edge `name` owns
  // border[first .. first + count], end included (shared with the next edge's first; the last edge's end is border[0]).
  // Hole edges are here too, with hole = 1, 2 …; their `first` counts along the hole as drawn. Behind the holes follow
  // the internal lines that something is sewn to; both sides of such a line share its nodes.
  std::vector<std::uint32_t> border;
  struct EdgeNodes {
    std::size_t first = 0, count = 0;  // count = number of segments
    std::vector<double> fraction;      // count + 1 length fractions, 0 … 1
    std::vector<std::uint32_t> nodes;  // count + 1 nodes in the edge's own direction
    std::size_t hole = 0;              // 0: on the outline
  };
  std::map<std::string, EdgeNodes> edges;
  std::vector<std::vector<std::uint32_t>> holes;  // rings of nodes, clockwise
};

// One place where cloth is tied to cloth: node a of one piece to node b of another (or the same), or, for 2:1, to the
// midpoint of the folded pair b, c (both on pieceB, the longer side; the node between or beside them is the fold).
struct SeamTie {
  SeamId seam;
  PieceId pieceA, pieceB;
  std::uint32_t a = 0, b = 0, c = kNoNode;
};

struct LaidPattern {
  double spacing = 0;
  std::map<PieceId, std::shared_ptr<const Lattice>> lattices;
  std::vector<SeamTie> ties;
};

// Lays all pieces of a pattern at one spacing. The same pattern gives the same bits. The grid is centred on the piece,
// so that a mirrored piece gets the mirrored grid. A piece narrower than the spacing has nodes on its outline only.
// Notches get a node unless one is already within a quarter of the spacing. Where chords of this length would cross
// something, or a curve turns more than 60 degrees within one, the outline (and what is sewn to it) is divided more
// finely. Refuses seams that cannot be divided alike and pieces whose outline crosses itself, saying which.
Result<LaidPattern> lay(const Pattern& pattern, double spacing);

// The triangle of a lattice under a paper place and its weights (the nearest triangle for a place just outside).
struct LatticePlace {
  Triangle face{};
  std::array<double, 3> weight{};
};
// For each node the middle of the triangles it belongs to: which bank of a slit it is on.
std::vector<Flat> inwardsOf(const std::vector<Flat>& nodes, const std::vector<Triangle>& faces);

class LatticeFinder {  // built once per lattice, then read by any thread
 public:
  LatticeFinder(const std::vector<Flat>& nodes, const std::vector<Triangle>& faces);
  LatticePlace find(Flat place) const;
  // The same for a place on the bank of a slit, where two triangles on different banks lie under one place: the one on
  // the side of `inwards`, a place of the same bank.
  LatticePlace find(Flat place, Flat inwards) const;

 private:
  std::vector<Flat> nodes_;
  std::vector<Triangle> faces_;
  Flat low_;
  double cell_ = 1;
  std::uint32_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> start_, item_;
};

}  // namespace karinui

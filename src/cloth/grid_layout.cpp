#include "cloth/grid_layout.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/wide.h"

namespace karinui {
namespace {

constexpr double kExact = 1e-7;  // of a step: how well threads keep to the grid
// A range: small enough that what is computed on the way stays in a processor's cache.
constexpr std::uint32_t kRows = 8;  // about
constexpr std::size_t kUnstructured = 256;

struct Corner {  // a right angle: its node, and which ways its weft and warp go
  std::uint32_t i = 0, j = 0;
  int along = 0, up = 0;
  double area = 0;
};

class LatticeGrid {
 public:
  explicit LatticeGrid(const Lattice& lattice) : lattice_(lattice), at_(lattice.nodes.size(), {-1, -1}) {
    for (std::uint32_t j = 0; j < lattice.rows; ++j)
      for (std::uint32_t i = 0; i < lattice.columns; ++i)
        if (const std::uint32_t k = lattice.grid[std::size_t{j} * lattice.columns + i]; k != kNoNode) at_[k] = {i, j};
  }
  // The spacings of the first whole cell; false: there is none.
  bool measure(double& weftStep, double& warpStep) const {
    for (std::uint32_t j = 0; j + 1 < lattice_.rows; ++j)
      for (std::uint32_t i = 0; i + 1 < lattice_.columns; ++i)
        if (lattice_.cell[std::size_t{j} * (lattice_.columns - 1) + i]) {
          const auto at = [&](std::uint32_t a, std::uint32_t b) {
            return lattice_.nodes[lattice_.grid[std::size_t{b} * lattice_.columns + a]];
          };
          weftStep = dot(at(i + 1, j) - at(i, j), lattice_.weft);
          warpStep = dot(at(i, j + 1) - at(i, j), lattice_.warp);
          return weftStep > 0 && warpStep > 0;
        }
    return false;
  }
  // Whether a face is half a grid cell, and where its right angle is.
  bool corner(const Triangle& face, double weftStep, double warpStep, Corner& out) const {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t k = face[c];
      if (at_[k][0] < 0) return false;
      for (const std::size_t turn : {1u, 2u}) {
        const std::uint32_t a = face[(c + turn) % 3], b = face[(c + 3 - turn) % 3];
        if (at_[a][0] < 0 || at_[b][0] < 0) return false;
        const std::int64_t along = at_[a][0] - at_[k][0], up = at_[b][1] - at_[k][1];
        if (at_[a][1] != at_[k][1] || at_[b][0] != at_[k][0] || std::abs(along) != 1 || std::abs(up) != 1) continue;
        const Flat weft = (lattice_.nodes[a] - lattice_.nodes[k]) * static_cast<double>(along);
        const Flat warp = (lattice_.nodes[b] - lattice_.nodes[k]) * static_cast<double>(up);
        if (length(weft - lattice_.weft * weftStep) > kExact * weftStep ||
            length(warp - lattice_.warp * warpStep) > kExact * warpStep)
          return false;
        out = {static_cast<std::uint32_t>(at_[k][0]), static_cast<std::uint32_t>(at_[k][1]), static_cast<int>(along),
               static_cast<int>(up), 0.5 * weftStep * warpStep};
        return true;
      }
    }
    return false;
  }

 private:
  const Lattice& lattice_;
  std::vector<std::array<std::int64_t, 2>> at_;
};

}  // namespace

GridLayout::GridLayout(const Cloth& cloth) : slotOf(cloth.nodeCount, kNoNode), remainder(cloth.pieces.size()) {
  std::uint32_t next = kLanes;
  for (std::size_t p = 0; p < cloth.pieces.size(); ++p) {
    const ClothPiece& piece = cloth.pieces[p];
    const Lattice& lattice = *piece.lattice;
    remainder[p].assign(lattice.faces.size(), Remainder::All);
    if (!piece.live || piece.fabric.law != Fabric::Law::Woven) continue;
    GridBlock block;
    block.piece = p;
    block.columns = lattice.columns;
    block.rows = lattice.rows;
    block.stride = static_cast<std::uint32_t>((lattice.columns + 2 + kLanes - 1) / kLanes * kLanes);
    if (!LatticeGrid(lattice).measure(block.weftStep, block.warpStep)) continue;
    block.first = next + 2 * block.stride;
    next = block.first + (block.rows + 2) * block.stride;
    for (std::uint32_t j = 0; j < lattice.rows; ++j)
      for (std::uint32_t i = 0; i < lattice.columns; ++i)
        if (const std::uint32_t k = lattice.grid[std::size_t{j} * lattice.columns + i]; k != kNoNode)
          slotOf[piece.firstNode + k] = block.first + j * block.stride + i;
    blocks.push_back(block);
  }
  weftArea.assign(next, 0);
  warpArea.assign(next, 0);
  cornerArea.assign(next, 0);
  std::vector<std::uint8_t> around(next, 0);
  for (const GridBlock& block : blocks) {
    const Lattice& lattice = *cloth.pieces[block.piece].lattice;
    const LatticeGrid grid(lattice);
    const auto bit = [](const Corner& c) { return 1u << ((c.along > 0 ? 1 : 0) + (c.up > 0 ? 2 : 0)); };
    std::vector<std::pair<std::size_t, Corner>> corners;
    for (std::size_t f = 0; f < lattice.faces.size(); ++f) {
      Corner c;
      if (!grid.corner(lattice.faces[f], block.weftStep, block.warpStep, c)) continue;
      const std::uint32_t slot = block.first + c.j * block.stride + c.i;
      weftArea[c.along > 0 ? slot : slot - 1] += c.area;
      warpArea[c.up > 0 ? slot : slot - block.stride] += c.area;
      around[slot] = static_cast<std::uint8_t>(around[slot] | bit(c));
      corners.emplace_back(f, c);
    }
    for (const auto& [f, c] : corners) {
      const std::uint32_t slot = block.first + c.j * block.stride + c.i;
      remainder[block.piece][f] = around[slot] == 15 ? Remainder::Nothing : Remainder::Shear;
      if (around[slot] == 15) cornerArea[slot] = c.area;
    }
  }
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live)
      for (std::uint32_t k = 0; k < piece.lattice->nodes.size(); ++k)
        if (slotOf[piece.firstNode + k] == kNoNode) slotOf[piece.firstNode + k] = next++;
  slots = (next + 3 * kLanes - 1) / kLanes * kLanes;
  std::size_t unstructured = 0;
  for (std::uint32_t p = 0; p < blocks.size(); ++p) {
    const GridBlock& block = blocks[p];
    const std::uint32_t count = 2 * std::max(1u, (block.rows + kRows) / (2 * kRows));  // for two and four workers
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t row = k * block.rows / count, rows = (k + 1) * block.rows / count - row;
      if (rows == 0) continue;
      const std::size_t begin = block.first + std::size_t{row} * block.stride;
      ranges.push_back({p, row, rows, begin, begin + std::size_t{rows} * block.stride});
    }
    unstructured = ranges.back().end;
  }
  for (std::size_t s = unstructured; s < slots - kLanes; s += kUnstructured)
    ranges.push_back({SlotRange::kNoBlock, 0, 0, s, std::min(s + kUnstructured, slots - kLanes)});
  for (auto* area : {&weftArea, &warpArea, &cornerArea}) area->resize(slots, 0);
}

}  // namespace karinui

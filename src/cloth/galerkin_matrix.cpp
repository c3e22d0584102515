#include "cloth/galerkin_matrix.h"

namespace karinui {
namespace {

constexpr std::size_t kLists = 16;       // of a part: rows of A_c that one thread adds at a time
constexpr std::size_t kCouplings = 512;  // of a part

struct Part {
  const CoarseGrid* grid = nullptr;
  std::uint32_t row = 0, rows = 0;  // fine ones, of a coarse cell of the grid
  const SlotRange* range = nullptr;
  std::size_t begin = 0, end = 0;  // couplings, of a part with neither

  void addTo(GalerkinPart& sum) const {
    if (grid)
      sum.addCell(*grid, row, rows);
    else if (range)
      sum.addRest(*range);
    else
      sum.addCouplings(begin, end);
  }
};

std::vector<Part> partsOf(const GridLayout& layout, std::span<const CoarseGrid> grids, std::size_t couplings) {
  std::vector<Part> parts;
  for (const CoarseGrid& grid : grids) {
    if (!grid.block) continue;
    for (std::uint32_t row = 0, next = 0; row < grid.block->rows; row = next) {
      for (next = row + 1; next < grid.block->rows && grid.row.cell[next] == grid.row.cell[row];) ++next;
      parts.push_back({&grid, row, next - row, nullptr, 0, 0});
    }
  }
  for (const SlotRange& range : layout.ranges) parts.push_back({nullptr, 0, 0, &range, 0, 0});
  for (std::size_t k = 0; k < couplings; k += kCouplings)
    parts.push_back({nullptr, 0, 0, nullptr, k, std::min(k + kCouplings, couplings)});
  return parts;
}

}  // namespace

void GalerkinMatrix::assemble(const GalerkinSource& of, std::span<const CoarseGrid> grids, std::size_t numbers,
                              EnvelopeCholesky& out, Workers& workers) {
  const std::vector<Part> parts = partsOf(of.layout, grids, of.coupled ? of.step.couplings.size() : 0);
  const bool alone = workers.threads() == 1;
  if (!alone && lists_.size() < parts.size() * kLists) lists_.resize(parts.size() * kLists);
  workers.forBlocks(parts.size(), 1, [&](std::size_t k, std::size_t) {
    const std::span lists =
        alone ? std::span<std::vector<GalerkinEntry>>() : std::span(lists_).subspan(k * kLists, kLists);
    for (auto& list : lists) list.clear();
    GalerkinPart part(of, {out, lists, numbers});
    parts[k].addTo(part);
  });
  if (alone) return;
  workers.forBlocks(kLists, 1, [&](std::size_t list, std::size_t) {
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (const GalerkinEntry& entry : lists_[k * kLists + list])
        addTo(out, entry.row, entry.column, entry.weight, entry.block);
  });
}

}  // namespace karinui

#include "karinui/scene/table_frame.h"

#include <algorithm>
#include <cmath>

namespace karinui {

Ring ringOf(const std::vector<TableEdge>& edges) {
  Ring ring;
  for (const TableEdge& edge : edges)
    if (!edge.points.empty()) ring.insert(ring.end(), edge.points.begin(), edge.points.end() - 1);
  return ring;
}

std::vector<Flat> TableTrim::line(double least) const {
  std::vector<Flat> points = inside;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const double deep = distance(edgewise[k], inside[k]); deep > 0 && deep < least)
      points[k] = lerp(edgewise[k], inside[k], least / deep);
  return points;
}

std::array<Flat, 4> TableScan::corners() const {
  const Flat across = Flat{std::cos(turn), std::sin(turn)} * (0.5 * width), up = leftOf(across) * (height() / width);
  return {at - across - up, at + across - up, at + across + up, at - across + up};
}

FlatBox extent(const TableFrame& frame) {
  FlatBox box;
  const auto hold = [&](std::span<const Flat> places) {
    for (const Flat p : places) box.include(p);
  };
  for (const TableScan& scan : frame.scans) hold(scan.corners());
  for (const TablePiece& piece : frame.pieces) {
    box.include(piece.low), box.include(piece.high);
    for (const Ring& ring : piece.cut) hold(ring);
    for (const TableSize& size : piece.nest) hold(size.outline);
  }
  return box;
}

}  // namespace karinui

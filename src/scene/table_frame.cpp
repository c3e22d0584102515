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

std::optional<TableBox> extent(const TableFrame& frame) {
  std::optional<TableBox> box;
  for (const TableScan& scan : frame.scans)
    for (const Flat p : scan.corners()) {
      if (!box) box = {p, p};
      box->low = {std::min(box->low.u, p.u), std::min(box->low.v, p.v)};
      box->high = {std::max(box->high.u, p.u), std::max(box->high.v, p.v)};
    }
  for (const TablePiece& piece : frame.pieces) {
    if (!box) box = {piece.low, piece.high};
    box->low = {std::min(box->low.u, piece.low.u), std::min(box->low.v, piece.low.v)};
    box->high = {std::max(box->high.u, piece.high.u), std::max(box->high.v, piece.high.v)};
    const auto hold = [&](const Ring& ring) {
      for (const Flat p : ring) {
        box->low = {std::min(box->low.u, p.u), std::min(box->low.v, p.v)};
        box->high = {std::max(box->high.u, p.u), std::max(box->high.v, p.v)};
      }
    };
    for (const Ring& ring : piece.cut) hold(ring);
    for (const TableSize& size : piece.nest) hold(size.outline);
  }
  return box;
}

}  // namespace karinui

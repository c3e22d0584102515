#include "geometry/face_sides.h"

#include <algorithm>

namespace karinui {

std::vector<FaceSide> sidesByEdge(const TriangleMesh& mesh) {
  std::vector<std::size_t> begin(mesh.points.size() + 1);
  const auto each = [&](auto&& visit) {
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
        visit(FaceSide{std::min(a, b), std::max(a, b), f, k, a < b});
      }
  };
  each([&](const FaceSide& side) { ++begin[side.low + 1]; });
  for (std::size_t p = 1; p < begin.size(); ++p) begin[p] += begin[p - 1];
  std::vector<FaceSide> sides(3 * mesh.faces.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  each([&](const FaceSide& side) { sides[next[side.low]++] = side; });
  const auto at = [&](std::size_t index) { return sides.begin() + static_cast<std::ptrdiff_t>(index); };
  for (std::size_t p = 0; p + 1 < begin.size(); ++p)
    std::sort(at(begin[p]), at(begin[p + 1]), [](const FaceSide& s, const FaceSide& t) {
      return s.high != t.high ? s.high < t.high : s.face != t.face ? s.face < t.face : s.from < t.from;
    });
  return sides;
}

}  // namespace karinui

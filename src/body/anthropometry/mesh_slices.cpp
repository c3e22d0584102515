#include "body/anthropometry/mesh_slices.h"

#include <algorithm>

namespace karinui {

TriangleMesh compacted(const TriangleMesh& mesh, std::span<const std::uint32_t> faces,
                       std::vector<std::uint32_t>& renumbered) {
  constexpr std::uint32_t kNone = ~0u;
  renumbered.resize(mesh.points.size(), kNone);
  TriangleMesh out;
  std::vector<std::uint32_t> used;
  for (const std::uint32_t f : faces) {
    Triangle face = mesh.faces[f];
    for (std::uint32_t& p : face) {
      if (renumbered[p] == kNone) {
        renumbered[p] = static_cast<std::uint32_t>(out.points.size());
        out.points.push_back(mesh.points[p]);
        used.push_back(p);
      }
      p = renumbered[p];
    }
    out.faces.push_back(face);
  }
  for (const std::uint32_t p : used) renumbered[p] = kNone;
  return out;
}

MeshSlices::MeshSlices(const TriangleMesh& mesh, double low, double high)
    : low_(low), thick_(std::max(high - low, 1e-9) / kCount) {
  std::vector<std::vector<std::uint32_t>> faces(kCount);  // of each slice
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f];
    const auto [least, most] = std::minmax({mesh.points[t[0]].y, mesh.points[t[1]].y, mesh.points[t[2]].y});
    for (std::size_t s = number(least); s <= number(most); ++s) faces[s].push_back(f);
  }
  std::vector<std::uint32_t> renumbered;
  for (const auto& of : faces) slice_.push_back(compacted(mesh, of, renumbered));
}

std::vector<SectionLoop> MeshSlices::section(double y) const {
  return karinui::section(slice_[number(y)], {{0, y, 0}, {0, 1, 0}});
}

std::size_t MeshSlices::number(double y) const {
  return static_cast<std::size_t>(std::clamp((y - low_) / thick_, 0.0, kCount - 1.0));
}

}  // namespace karinui

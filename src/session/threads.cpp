// Threads between edges that are to be sewn but hang apart.
#include <algorithm>

#include "karinui/geometry/section.h"
#include "karinui/session/fitting.h"

namespace karinui {

std::vector<SceneLine> threadsOf(const Fitting& fitting) {
  constexpr Colour kThread{0.75f, 0.40f, 0.12f};
  constexpr double kApart = 0.012, kStitch = 0.025;  // metres
  std::vector<SceneLine> lines;
  const auto run = [&](const std::vector<EdgeSpan>& side) {
    std::vector<Vec3> points;
    for (const EdgeSpan& s : side) {
      const auto part = edgeInSpace(fitting, {PieceRef(s.piece), s.edge, s.from, s.to});
      points.insert(points.end(), part.begin(), part.end());
    }
    return points;
  };
  for (const auto& [id, seam] : fitting.document.pattern.seams) {
    const auto a = run(seam.a);
    auto b = run(seam.b);
    if (a.size() < 2 || b.size() < 2) continue;
    if (seam.reversed) std::reverse(b.begin(), b.end());
    const int count = std::clamp(static_cast<int>(lineLength(a, false) / kStitch), 4, 40);
    for (int i = 0; i <= count; ++i) {
      const auto at = [&](const std::vector<Vec3>& line) {
        return line[static_cast<std::size_t>(i) * (line.size() - 1) / static_cast<std::size_t>(count)];
      };
      if (distance(at(a), at(b)) > kApart) lines.push_back({{at(a), at(b)}, kThread, 0.8f, false});
    }
  }
  return lines;
}

}  // namespace karinui

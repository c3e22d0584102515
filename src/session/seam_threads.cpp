// Threads between edges that are to be sewn but hang apart.
#include <algorithm>

#include "karinui/geometry/section.h"
#include "karinui/session/garment_snapshot.h"

namespace karinui {

namespace {

std::vector<Vec3> sideInSpace(const GarmentSnapshot& snapshot, const std::vector<EdgeSpan>& side) {
  std::vector<Vec3> points;
  for (const EdgeSpan& s : side) {
    const auto part = edgeInSpace(snapshot, {PieceRef(s.piece), s.edge, s.from, s.to});
    points.insert(points.end(), part.begin(), part.end());
  }
  return points;
}

// Both sides of a seam, from where it begins to where it ends.
std::pair<std::vector<Vec3>, std::vector<Vec3>> sidesOf(const GarmentSnapshot& snapshot, const Seam& seam) {
  auto a = sideInSpace(snapshot, seam.a), b = sideInSpace(snapshot, seam.b);
  if (seam.reversed) std::reverse(b.begin(), b.end());
  return {std::move(a), std::move(b)};
}

bool nearlyClosed(const std::vector<Vec3>& line) {
  constexpr double kShare = 0.3;  // of its length
  return distance(line.front(), line.back()) < kShare * lineLength(line, false);
}

}  // namespace

std::vector<SceneLine> threadsOf(const GarmentSnapshot& snapshot) {
  constexpr Colour kThread{0.75f, 0.40f, 0.12f};
  constexpr double kApart = 0.012, kStitch = 0.025;  // metres
  std::vector<SceneLine> lines;
  for (const auto& [id, seam] : snapshot.document.pattern.seams) {
    const auto [a, b] = sidesOf(snapshot, seam);
    if (a.size() < 2 || b.size() < 2) continue;
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

std::vector<CrossedSeam> crossedSeams(const GarmentSnapshot& snapshot) {
  constexpr double kApart = 0.02;  // metres: a closed seam crosses nothing
  std::vector<CrossedSeam> crossed;
  for (const auto& [id, seam] : snapshot.document.pattern.seams) {
    const auto [a, b] = sidesOf(snapshot, seam);
    if (a.size() < 2 || b.size() < 2) continue;
    // Of a run that nearly closes, as round an armhole, both ends lie together and tell nothing.
    const bool ring = nearlyClosed(a) || nearlyClosed(b);
    const auto at = [&](const std::vector<Vec3>& line, bool last) {
      const std::size_t in = ring ? (line.size() - 1) / 4 : 0;
      return line[last ? line.size() - 1 - in : in];
    };
    const double straight = distance(at(a, false), at(b, false)) + distance(at(a, true), at(b, true));
    const double turned = distance(at(a, false), at(b, true)) + distance(at(a, true), at(b, false));
    if (straight < 2 * kApart || turned > 0.98 * straight) continue;
    CrossedSeam one{id, (a[a.size() / 2] + b[b.size() / 2]) * 0.5, {}};
    for (const auto* side : {&seam.a, &seam.b}) {
      const EdgeSpan& span = (*side)[side->size() / 2];
      const Piece* piece = snapshot.document.find(span.piece);
      if (const Curve* curve = piece ? findCurve(*piece, span.edge) : nullptr)
        one.paper.emplace_back(piece->id, curve->atFraction((span.from + span.to) / 2));
    }
    crossed.push_back(std::move(one));
  }
  return crossed;
}

std::optional<SeamId> crossedAt(const std::vector<CrossedSeam>& crossed, const TableLayout& table,
                                const PointerSample& sample) {
  for (const CrossedSeam& one : crossed) {
    if (sample.where == PointerSample::Where::Table) {
      for (const auto& [piece, place] : one.paper)
        if (distance(place + table.at(piece), sample.place) < sample.reach) return one.seam;
    } else if (sample.tip) {
      if (distance(one.place, sample.tip->carry) < sample.reach) return one.seam;
    } else if (const Vec3 way = one.place - sample.ray.origin;
               length(cross(way, sample.ray.direction)) < sample.reach * dot(way, sample.ray.direction)) {
      return one.seam;
    }
  }
  return std::nullopt;
}

}  // namespace karinui

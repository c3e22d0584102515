#include "view/ribbons.h"

#include <algorithm>
#include <cmath>

#include "view/vertex.h"

namespace karinui {
namespace {

struct Span {
  Vec3 from, to;
  double halfFrom, halfTo, alongFrom, alongTo;
};

void addSpan(Ribbons& ribbons, const Span& span, Vec3 origin, const RibbonLook& look) {
  const auto base = static_cast<std::uint32_t>(ribbons.vertices.size());
  for (int i = 0; i < 4; ++i) {
    RibbonVertex v{};
    put(v.from, span.from - origin);
    put(v.to, span.to - origin);
    v.place[0] = static_cast<float>(i / 2);
    v.place[1] = i % 2 ? 1.0f : -1.0f;
    v.halfWidth[0] = static_cast<float>(span.halfFrom), v.halfWidth[1] = static_cast<float>(span.halfTo);
    v.along[0] = static_cast<float>(span.alongFrom), v.along[1] = static_cast<float>(span.alongTo);
    std::copy(look.colour.begin(), look.colour.end(), v.colour);
    v.lift = static_cast<float>(look.liftMm / 1000);
    v.stitch[0] = static_cast<float>(look.stitchMm / 1000), v.stitch[1] = static_cast<float>(look.gapMm / 1000);
    ribbons.vertices.push_back(v);
  }
  for (const std::uint32_t i : {0u, 1u, 2u, 2u, 1u, 3u}) ribbons.corners.push_back(base + i);
}

Colour darker(const Colour& c, float share) { return {c[0] * share, c[1] * share, c[2] * share}; }

// The run of points by their numbers; a number that is no point becomes a place that cannot be drawn.
std::vector<Vec3> run(const TriangleMesh& mesh, const std::vector<std::uint32_t>& numbers) {
  std::vector<Vec3> line;
  line.reserve(numbers.size());
  for (const std::uint32_t i : numbers) line.push_back(i < mesh.points.size() ? mesh.points[i] : Vec3{NAN, NAN, NAN});
  return line;
}

}  // namespace

void addRibbon(Ribbons& ribbons, const std::vector<Vec3>& line, Vec3 origin, const RibbonLook& look) {
  const double half = std::clamp(std::isfinite(look.widthMm) ? look.widthMm : 1.0, 0.1, 1000.0) / 2000;
  double along = 0, whole = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    if (drawable(line[i]) && drawable(line[i + 1])) whole += distance(line[i], line[i + 1]);
  const double head = look.arrow ? std::min(8 * half, whole * 0.5) : 0;  // length of the arrow's head
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 a = line[i], b = line[i + 1];
    if (!drawable(a) || !drawable(b)) {
      ++ribbons.leftOut;
      continue;
    }
    const double piece = distance(a, b), end = along + piece, shaftEnd = whole - head;
    if (piece > 0) {
      const auto at = [&](double s) { return lerp(a, b, (s - along) / piece); };
      const auto wide = [&](double s) { return head > 0 ? half * 3.2 * std::max(0.0, whole - s) / head : half; };
      if (along < shaftEnd || head == 0) {
        const double stop = head == 0 ? end : std::min(end, shaftEnd);
        addSpan(ribbons, {a, at(stop), half, half, along, stop}, origin, look);
      }
      if (head > 0 && end > shaftEnd) {
        const double start = std::max(along, shaftEnd);
        addSpan(ribbons, {at(start), b, wide(start), wide(end), start, end}, origin, look);
      }
    }
    along = end;
  }
}

Ribbons ribbonsOf(const SceneFrame& frame, Vec3 origin) {
  Ribbons ribbons;
  for (const SceneCloth& cloth : frame.cloths) {
    const RibbonLook edge{darker(cloth.colour, 0.22f), 1.4, 1.0};
    for (const auto& numbers : cloth.outlines) addRibbon(ribbons, run(cloth.mesh, numbers), origin, edge);
    // Tacking as a tailor does it: long white stitches over the dark line where the pieces meet.
    const RibbonLook ditch{darker(cloth.colour, 0.45f), 1.2, 1.0};
    const RibbonLook thread{{0.92f, 0.90f, 0.84f}, 1.8, 1.3, 9, 5};
    for (const auto& numbers : cloth.seams) {
      addRibbon(ribbons, run(cloth.mesh, numbers), origin, ditch);
      addRibbon(ribbons, run(cloth.mesh, numbers), origin, thread);
    }
  }
  for (const SceneCloth& cloth : frame.cloths)
    for (const SceneStitches& row : cloth.stitches) {
      std::vector<Vec3> line;
      for (const ClothPlace& place : row.line) line.push_back(place.on(cloth.mesh.points));
      addRibbon(ribbons, line, origin, {row.colour, row.widthMm, 2.0, row.stitchMm, row.gapMm});
    }
  for (const SceneLine& line : frame.lines)
    addRibbon(ribbons, line.points, origin, {line.colour, line.widthMm, 5.0, 0, 0, line.arrow});
  return ribbons;
}

}  // namespace karinui

#include <algorithm>
#include <cmath>

#include "design/operations/drawn_sheet.h"

namespace karinui {
namespace {

constexpr double kStep = 0.012;  // metres between the places a curve is followed by

Vec3 normalAt(const TriangleMesh& mesh, const SurfacePoint& place) { return faceNormal(mesh, place.face); }

// The centripetal Catmull-Rom curve between b and c with neighbours a and d (Barry & Goldman 1988), t in [0, 1].
Vec3 catmullRom(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double t) {
  const auto knot = [](Vec3 p, Vec3 q) { return std::fmax(std::sqrt(distance(p, q)), 1e-6); };
  const double t0 = 0, t1 = t0 + knot(a, b), t2 = t1 + knot(b, c), t3 = t2 + knot(c, d), x = t1 + t * (t2 - t1);
  const auto mix = [x](Vec3 p, Vec3 q, double from, double to) { return lerp(p, q, (x - from) / (to - from)); };
  const Vec3 p = mix(a, b, t0, t1), q = mix(b, c, t1, t2), r = mix(c, d, t2, t3);
  return mix(mix(p, q, t0, t2), mix(q, r, t1, t3), t1, t2);
}

void append(SurfacePath& path, const SurfacePath& more) {
  for (std::size_t i = path.empty() ? 0 : 1; i < more.places.size(); ++i) {
    path.places.push_back(more.places[i]);
    path.points.push_back(more.points[i]);
  }
  path.length += more.length;
}

}  // namespace

// Each stretch follows the taut line between its places, shifted sideways by what a smooth curve through the places in
// space departs from its own chord; so it stays on the surface even where the figure's parts lie close together.
Result<SurfacePath> drawnSide(const DrawingGround& ground, std::span<const SurfacePoint> run) {
  if (run.size() == 2) return ground.guide.straight(run[0], run[1]);
  const std::size_t n = run.size();
  std::vector<Vec3> at(n);
  for (std::size_t i = 0; i < n; ++i) at[i] = karinui::at(ground.mesh, run[i]);
  const bool ring = distance(at.front(), at.back()) < 1e-9;
  // Beyond an end the curve goes on as a parabola would, but no further than its last step.
  const auto beyond = [](Vec3 end, Vec3 next, Vec3 third) {
    const Vec3 step = end * 3 - next * 3 + third - end;
    const double most = distance(end, next), l = length(step);
    return l > most ? end + step * (most / l) : end + step;
  };
  SurfacePath side;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const auto taut = ground.guide.straight(run[i], run[i + 1]);
    if (!taut) return taut;
    const Vec3 b = at[i], c = at[i + 1];
    const Vec3 a = i > 0 ? at[i - 1] : ring ? at[n - 2] : beyond(at[0], at[1], at[2]);
    const Vec3 d = i + 2 < n ? at[i + 2] : ring ? at[1] : beyond(at[n - 1], at[n - 2], at[n - 3]);
    const int parts = std::max(2, static_cast<int>(std::ceil(taut->length / kStep)));
    SurfacePoint last = run[i];
    for (int k = 1; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      SurfacePoint next = run[i + 1];
      if (k < parts) {
        const SurfacePoint under = along(ground.mesh, *taut, t);
        const Vec3 normal = normalAt(ground.mesh, under);
        Vec3 shift = catmullRom(a, b, c, d, t) - lerp(b, c, t);
        shift = shift - normal * dot(shift, normal);
        const auto near = ground.bvh.nearest(karinui::at(ground.mesh, under) + shift);
        next = near ? near->place : under;
      }
      const auto step = ground.guide.straight(last, next);
      if (!step) return step;
      append(side, *step);
      last = next;
    }
  }
  return side;
}

}  // namespace karinui

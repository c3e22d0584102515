#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "karinui/base/sort_once.h"

#include "karinui/geometry/patch.h"

namespace karinui {
namespace {

constexpr double kOnePlace = 1e-6;  // metres

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighboursOf(const TriangleMesh& mesh) {
  Neighbours near(mesh.points.size());
  for (const Triangle& t : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      near[t[k]].push_back(t[(k + 1) % 3]);
      near[t[k]].push_back(t[(k + 2) % 3]);
    }
  for (auto& n : near) {
    sortOnce(n);
  }
  return near;
}

// Border points look along the border only, inner ones all round.
void borderLooksAlong(std::span<const std::uint32_t> border, Neighbours& near) {
  for (std::size_t i = 0; i < border.size(); ++i)
    near[border[i]] = {border[(i + border.size() - 1) % border.size()], border[(i + 1) % border.size()]};
}

Vec3 meanOf(const std::vector<std::uint32_t>& near, std::span<const Vec3> of) {
  Vec3 sum;
  for (std::uint32_t q : near) sum += of[q];
  return sum * (1.0 / static_cast<double>(near.size()));
}

std::vector<Vec3> smoothed(std::vector<Vec3> normals, const Neighbours& near, int rounds) {
  std::vector<Vec3> next(normals.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < normals.size(); ++i)
      next[i] = near[i].empty() ? normals[i] : normalized(normals[i] + meanOf(near[i], normals));
    normals.swap(next);
  }
  return normals;
}

// Points of faces that turn sharply against a neighbour.
std::vector<std::uint8_t> folded(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> bad(mesh.points.size(), 0);
  struct Side {
    std::uint32_t low, high, face;
  };
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), f});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[i + 1];
    if (a.low != b.low || a.high != b.high || dot(faceNormal(mesh, a.face), faceNormal(mesh, b.face)) > 0.2) continue;
    for (std::uint32_t f : {a.face, b.face})
      for (std::uint32_t v : mesh.faces[f]) bad[v] = 1;
  }
  return bad;
}

// Evens out what belongs to the points of a border, along each side: what changes within a few points goes, what
// changes over more stays (Taubin 1995). Corners stay, but where a side begins or ends on the fold it runs on into its
// image.
template <class Afterwards>
void evenOut(std::span<const std::uint32_t> border, const std::vector<std::uint8_t>& corner,
             const std::vector<std::uint8_t>& onFold, std::vector<Vec3>& values, std::span<const double> wanted,
             int rounds, const Afterwards& keepTogether) {
  const std::size_t n = border.size();
  std::vector<Vec3> next = values;
  for (int round = 0; round < rounds; ++round)
    for (const double share : {0.5, -0.53}) {
      for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t before = border[(i + n - 1) % n], here = border[i], behind = border[(i + 1) % n];
        Vec3 middle = (values[before] + values[behind]) * 0.5;
        if (corner[here]) {
          const bool ends = onFold[here] && onFold[before] != onFold[behind];
          middle = ends ? values[onFold[before] ? behind : before] : values[here];
        }
        next[here] = values[here] + (middle - values[here]) * (share * wanted[i]);
      }
      values.swap(next);
      keepTogether(values);
    }
}

// Where a border leaps about from point to point, 0 to 1: how far points lie from the cubic through two on either side.
std::vector<double> raggedness(std::span<const std::uint32_t> border, const std::vector<std::uint8_t>& corner,
                               const std::vector<Vec3>& points) {
  constexpr double kSmooth = 0.0006, kRagged = 0.0012;  // metres
  const std::size_t n = border.size();
  const auto at = [&](std::size_t i) { return points[border[i % n]]; };
  std::vector<double> leap(n), widened(n);
  for (std::size_t i = 0; i < n; ++i) {
    bool smooth = true;  // a corner is no raggedness
    for (std::size_t k = n - 1; k <= n + 1; ++k) smooth = smooth && !corner[border[(i + k) % n]];
    if (!smooth) continue;
    const Vec3 through = (at(i + n - 1) + at(i + 1)) * (4.0 / 6) - (at(i + n - 2) + at(i + 2)) * (1.0 / 6);
    leap[i] = std::clamp((distance(at(i), through) - kSmooth) / (kRagged - kSmooth), 0.0, 1.0);
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = n - 2; k <= n + 2; ++k) widened[i] = std::max(widened[i], leap[(i + k) % n]);
  return widened;
}

}  // namespace

void liftOff(Patch& patch, const TriangleMesh& body, const Bvh& bvh, const LiftSettings& settings) {
  std::vector<Vec3>& points = patch.mesh.points;
  const std::vector<Vec3> drawn = points;
  const Neighbours all = neighboursOf(patch.mesh);
  Neighbours near = all;
  borderLooksAlong(patch.border, near);
  std::vector<std::uint8_t> onBorder(points.size(), 0), corner(points.size(), 0), onFold(points.size(), 0);
  for (std::uint32_t p : patch.border) onBorder[p] = 1;
  for (std::uint32_t i : patch.first) corner[patch.border[i]] = 1;
  for (std::uint32_t p : settings.fold) {
    onFold[p] = 1;
    near[p] = all[p];
  }
  // Border points that are one place on the body (the two sides of a slit) stay one.
  std::vector<std::uint32_t> sorted(patch.border);
  const auto lower = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = patch.mesh.points[a], q = patch.mesh.points[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  };
  std::sort(sorted.begin(), sorted.end(), lower);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> twins;
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size() && points[sorted[j]].x - points[sorted[i]].x < kOnePlace; ++j)
      if (distance(points[sorted[i]], points[sorted[j]]) < kOnePlace) twins.emplace_back(sorted[i], sorted[j]);
  const auto keepTogether = [&](std::vector<Vec3>& places) {
    for (std::uint32_t p : settings.fold) places[p].x = 0;
    for (const auto& [a, b] : twins) places[a] = places[b] = (places[a] + places[b]) * 0.5;
  };

  const std::vector<Vec3> bodyNormals = pointNormals(body);
  const auto skinNormal = [&](const SurfacePoint& place, const std::vector<Vec3>& of) {
    const Triangle& t = body.faces[place.face];
    Vec3 n;
    for (std::size_t k = 0; k < 3; ++k) n += of[t[k]] * place.weight[k];
    return normalized(n);
  };
  // Out of the body at the nearest place: along the way from there, or the skin's smoothed normal when on or under it.
  const auto clear = [&](Vec3 p, double least) {
    const auto hit = bvh.nearest(p);
    if (!hit) return p;
    const Vec3 n = skinNormal(hit->place, bodyNormals);
    const double above = dot(p - hit->point, n) < 0 ? -hit->distance : hit->distance;
    if (above >= least) return p;
    return p + n * (least - above);
  };

  // The skin's normals, smoothed over the whole body, say where "off the body" is. (Smoothed over the sheet alone they
  // would lean inwards along its border and draw it together.)
  const std::vector<Vec3> smooth = smoothed(bodyNormals, neighboursOf(body), 8);
  std::vector<Vec3> normals(points.size()), next(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto hit = bvh.nearest(points[i]);
    KARINUI_ASSERT(hit);
    normals[i] = skinNormal(hit->place, smooth);
  }
  keepTogether(normals);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = clear(points[i] + normals[i] * settings.ease, settings.ease);
  keepTogether(points);

  // Spanning: each point goes towards the middle of its neighbours, but only outwards or level, never into the ease.
  for (int round = 0; round < settings.spanRounds; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (corner[i]) {
        next[i] = points[i];
        continue;
      }
      const Vec3 step = meanOf(near[i], points) - points[i];
      // Along the sheet only a little, so that the drawn line and the triangles stay where they are.
      const double out = dot(step, normals[i]);
      const Vec3 level = step - normals[i] * out;
      next[i] = points[i] + normals[i] * (0.5 * out) + level * (onBorder[i] && !onFold[i] ? 0.0 : 0.2);
    }
    points.swap(next);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = clear(points[i], settings.ease);
    keepTogether(points);
  }

  // Deep in an armpit or crotch the sheet may have been pushed against itself: there it is drawn smooth, whatever the
  // ease.
  for (int round = 0; round < 60; ++round) {
    const std::vector<std::uint8_t> bad = folded(patch.mesh);
    if (std::none_of(bad.begin(), bad.end(), [](std::uint8_t b) { return b != 0; })) break;
    next = points;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (bad[i] && !corner[i]) next[i] = (points[i] + meanOf(near[i], points)) * 0.5;
    points.swap(next);
    keepTogether(points);
  }

  // The way off the body is a little different at every point, which leaves a line that was drawn smoothly ragged by a
  // millimetre or two; and the skin's own facets a little more.
  std::vector<Vec3> off = points;
  for (std::size_t i = 0; i < points.size(); ++i) off[i] = points[i] - drawn[i];
  const std::vector<double> everywhere(patch.border.size(), 1.0);
  evenOut(patch.border, corner, onFold, off, everywhere, 10, keepTogether);
  for (const std::uint32_t p : patch.border) points[p] = drawn[p] + off[p];
  evenOut(patch.border, corner, onFold, points, raggedness(patch.border, corner, points), 2, keepTogether);
}

}  // namespace karinui

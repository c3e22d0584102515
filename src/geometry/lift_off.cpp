#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

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
    std::sort(n.begin(), n.end());
    n.erase(std::unique(n.begin(), n.end()), n.end());
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

}  // namespace

void liftOff(Patch& patch, const TriangleMesh& body, const Bvh& bvh, const LiftSettings& settings) {
  std::vector<Vec3>& points = patch.mesh.points;
  const Neighbours all = neighboursOf(patch.mesh);
  Neighbours near = all;
  borderLooksAlong(patch.border, near);
  std::vector<std::uint8_t> onBorder(points.size(), 0), corner(points.size(), 0), folded(points.size(), 0);
  for (std::uint32_t p : patch.border) onBorder[p] = 1;
  for (std::uint32_t i : patch.first) corner[patch.border[i]] = 1;
  for (std::uint32_t p : settings.fold) {
    folded[p] = 1;
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
  // Out of the body at the nearest place: along the way from there, or the skin's smoothed normal when on or under it.
  const auto clear = [&](Vec3 p, double least) {
    const auto hit = bvh.nearest(p);
    if (!hit) return p;
    const Triangle& t = body.faces[hit->place.face];
    Vec3 n;
    for (std::size_t k = 0; k < 3; ++k) n += bodyNormals[t[k]] * hit->place.weight[k];
    n = normalized(n);
    const double above = dot(p - hit->point, n) < 0 ? -hit->distance : hit->distance;
    if (above >= least) return p;
    return p + n * (least - above);
  };

  // The sheet's own normals, smoothed, say where "off the body" is.
  std::vector<Vec3> normals = pointNormals(patch.mesh), next(points.size());
  for (int round = 0; round < 8; ++round) {
    keepTogether(normals);
    for (std::size_t i = 0; i < points.size(); ++i) next[i] = normalized(normals[i] + meanOf(all[i], normals));
    normals.swap(next);
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
      next[i] = points[i] + normals[i] * (0.5 * out) + level * (onBorder[i] && !folded[i] ? 0.0 : 0.2);
    }
    points.swap(next);
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = clear(points[i], settings.ease);
    keepTogether(points);
  }
}

}  // namespace karinui

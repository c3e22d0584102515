#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "geometry/face_sides.h"
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
  const std::vector<FaceSide> sides = sidesByEdge(mesh);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const FaceSide &a = sides[i], &b = sides[i + 1];
    if (!a.sameEdge(b) || dot(faceNormal(mesh, a.face), faceNormal(mesh, b.face)) > 0.2) continue;
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

// Border points that are one place on the body, as the two sides of a slit.
std::vector<std::pair<std::uint32_t, std::uint32_t>> twinsOf(const Patch& patch) {
  const std::vector<Vec3>& points = patch.mesh.points;
  std::vector<std::uint32_t> sorted(patch.border);
  std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = points[a], q = points[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  std::vector<std::pair<std::uint32_t, std::uint32_t>> twins;
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i)
    for (std::size_t j = i + 1; j < sorted.size() && points[sorted[j]].x - points[sorted[i]].x < kOnePlace; ++j)
      if (distance(points[sorted[i]], points[sorted[j]]) < kOnePlace) twins.emplace_back(sorted[i], sorted[j]);
  return twins;
}

// The body's skin and its normals.
class SkinBeneath {
 public:
  SkinBeneath(const TriangleMesh& body, const Bvh& bvh) : body_(body), bvh_(bvh), normals_(pointNormals(body)) {}

  // Out of the body at the nearest place: along the way from there, or the skin's normal when on or under it.
  Vec3 clear(Vec3 p, double least) const {
    const auto hit = bvh_.nearest(p);
    if (!hit) return p;
    const Vec3 n = normalAt(hit->place, normals_);
    const double above = dot(p - hit->point, n) < 0 ? -hit->distance : hit->distance;
    return above >= least ? p : p + n * (least - above);
  }
  // Smoothed over the whole body, they say where "off the body" is. (Smoothed over the sheet alone they would lean
  // inwards along its border and draw it together.)
  std::vector<Vec3> smoothNormalsBy(std::span<const Vec3> points) const {
    const std::vector<Vec3> smooth = smoothed(normals_, neighboursOf(body_), 8);
    std::vector<Vec3> normals;
    for (const Vec3 p : points) {
      const auto hit = bvh_.nearest(p);
      KARINUI_ASSERT(hit);
      normals.push_back(normalAt(hit->place, smooth));
    }
    return normals;
  }

 private:
  Vec3 normalAt(const SurfacePoint& place, const std::vector<Vec3>& of) const {
    const Triangle& t = body_.faces[place.face];
    Vec3 n;
    for (std::size_t k = 0; k < 3; ++k) n += of[t[k]] * place.weight[k];
    return normalized(n);
  }

  const TriangleMesh& body_;
  const Bvh& bvh_;
  std::vector<Vec3> normals_;
};

// A sheet on its way off the body.
class LiftedSheet {
 public:
  LiftedSheet(Patch& patch, const SkinBeneath& skin, const LiftSettings& settings)
      : patch_(patch),
        points_(patch.mesh.points),
        drawn_(points_),
        skin_(skin),
        settings_(settings),
        near_(neighboursOf(patch.mesh)),
        twins_(twinsOf(patch)),
        onBorder_(points_.size(), 0),
        corner_(points_.size(), 0),
        onFold_(points_.size(), 0),
        next_(points_.size()) {
    const Neighbours all = near_;
    borderLooksAlong(patch.border, near_);
    for (std::uint32_t p : patch.border) onBorder_[p] = 1;
    for (std::uint32_t i : patch.first) corner_[patch.border[i]] = 1;
    for (std::uint32_t p : settings.fold) {
      onFold_[p] = 1;
      near_[p] = all[p];
    }
  }

  void lift() {
    normals_ = skin_.smoothNormalsBy(points_);
    keepTogether(normals_);
    for (std::size_t i = 0; i < points_.size(); ++i)
      points_[i] = skin_.clear(points_[i] + normals_[i] * settings_.ease, settings_.ease);
    keepTogether(points_);
  }

  // Each point goes towards the middle of its neighbours, but only outwards or level, never into the ease.
  void span() {
    for (int round = 0; round < settings_.spanRounds; ++round) {
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (corner_[i]) {
          next_[i] = points_[i];
          continue;
        }
        const Vec3 step = meanOf(near_[i], points_) - points_[i];
        // Along the sheet only a little, so that the drawn line and the triangles stay where they are.
        const double out = dot(step, normals_[i]);
        const Vec3 level = step - normals_[i] * out;
        next_[i] = points_[i] + normals_[i] * (0.5 * out) + level * (onBorder_[i] && !onFold_[i] ? 0.0 : 0.2);
      }
      points_.swap(next_);
      for (Vec3& p : points_) p = skin_.clear(p, settings_.ease);
      keepTogether(points_);
    }
  }

  // Deep in an armpit or crotch the sheet may have been pushed against itself: there it is drawn smooth, whatever the
  // ease.
  void unfold() {
    for (int round = 0; round < 60; ++round) {
      const std::vector<std::uint8_t> bad = folded(patch_.mesh);
      if (std::none_of(bad.begin(), bad.end(), [](std::uint8_t b) { return b != 0; })) break;
      next_ = points_;
      for (std::size_t i = 0; i < points_.size(); ++i)
        if (bad[i] && !corner_[i]) next_[i] = (points_[i] + meanOf(near_[i], points_)) * 0.5;
      points_.swap(next_);
      keepTogether(points_);
    }
  }

  // The way off the body is a little different at every point, which leaves a line that was drawn smoothly ragged by a
  // millimetre or two; and the skin's own facets a little more.
  void evenOutBorder() {
    std::vector<Vec3> off = points_;
    for (std::size_t i = 0; i < points_.size(); ++i) off[i] = points_[i] - drawn_[i];
    const std::vector<double> everywhere(patch_.border.size(), 1.0);
    const auto together = [this](std::vector<Vec3>& values) { keepTogether(values); };
    evenOut(patch_.border, corner_, onFold_, off, everywhere, 10, together);
    for (const std::uint32_t p : patch_.border) points_[p] = drawn_[p] + off[p];
    evenOut(patch_.border, corner_, onFold_, points_, raggedness(patch_.border, corner_, points_), 2, together);
  }

 private:
  // On the fold what lies on it; twins at one place.
  void keepTogether(std::vector<Vec3>& places) const {
    for (std::uint32_t p : settings_.fold) places[p].x = 0;
    for (const auto& [a, b] : twins_) places[a] = places[b] = (places[a] + places[b]) * 0.5;
  }

  Patch& patch_;
  std::vector<Vec3>& points_;
  const std::vector<Vec3> drawn_;
  const SkinBeneath& skin_;
  const LiftSettings& settings_;
  Neighbours near_;
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> twins_;
  std::vector<std::uint8_t> onBorder_, corner_, onFold_;
  std::vector<Vec3> normals_, next_;
};

}  // namespace

void liftOff(Patch& patch, const TriangleMesh& body, const Bvh& bvh, const LiftSettings& settings) {
  const SkinBeneath skin(body, bvh);
  LiftedSheet sheet(patch, skin, settings);
  sheet.lift();
  sheet.span();
  sheet.unfold();
  sheet.evenOutBorder();
}

}  // namespace karinui

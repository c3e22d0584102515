#include "karinui/cloth/merged_planes.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace karinui {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

using Side = std::pair<std::uint32_t, std::uint32_t>;  // of the mesh, low corner first

// The faces on the other side of each face's three sides; kNone where there is none or more than one.
std::vector<std::array<std::uint32_t, 3>> facesBeside(const TriangleMesh& mesh) {
  std::map<Side, std::vector<std::uint32_t>> bySide;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (int c = 0; c < 3; ++c) bySide[std::minmax(mesh.faces[f][c], mesh.faces[f][(c + 1) % 3])].push_back(f);
  std::vector<std::array<std::uint32_t, 3>> beside(mesh.faces.size(), {kNone, kNone, kNone});
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (int c = 0; c < 3; ++c) {
      const auto& list = bySide[std::minmax(mesh.faces[f][c], mesh.faces[f][(c + 1) % 3])];
      if (list.size() == 2) beside[f][c] = list[0] == f ? list[1] : list[0];
    }
  return beside;
}

// Whether a place on the polygon's plane lies within its outline: how often a ray from it crosses the outline.
bool within(const MergedPlanes::Polygon& polygon, Vec3 place) {
  const Vec3 n = polygon.normal;
  const Vec3 u = normalized(std::fabs(n.x) < 0.7 ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0})), v = cross(n, u);
  const double pu = dot(place, u), pv = dot(place, v);
  bool inside = false;
  for (const auto& side : polygon.outline) {
    const double av = dot(side[0], v), bv = dot(side[1], v);
    if ((av > pv) == (bv > pv)) continue;
    const double au = dot(side[0], u), bu = dot(side[1], u);
    if (pu < au + (bu - au) * (pv - av) / (bv - av)) inside = !inside;
  }
  return inside;
}

}  // namespace

MergedPlanes::MergedPlanes(BodyPtr body, const Settings& settings)
    : body_(std::move(body)), settings_(settings), polygonOf_(body_->mesh().faces.size(), kNone) {
  const TriangleMesh& mesh = body_->mesh();
  const auto beside = facesBeside(mesh);
  std::vector<Vec3> normals(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) normals[f] = faceNormal(mesh, f);
  const double closest = std::cos(settings.angle);
  for (std::uint32_t seed = 0; seed < mesh.faces.size(); ++seed) {
    if (polygonOf_[seed] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(polygons_.size());
    Polygon polygon;
    polygon.normal = normals[seed];
    polygon.centre = mesh.points[mesh.faces[seed][0]];
    polygon.faces = {seed};
    polygonOf_[seed] = number;
    for (std::size_t k = 0; k < polygon.faces.size(); ++k)  // grows while it runs
      for (std::uint32_t next : beside[polygon.faces[k]]) {
        if (next == kNone || polygonOf_[next] != kNone || dot(normals[next], normals[seed]) < closest) continue;
        const bool flat = std::all_of(mesh.faces[next].begin(), mesh.faces[next].end(), [&](std::uint32_t p) {
          return std::fabs(dot(mesh.points[p] - polygon.centre, normals[seed])) <= settings.flatness;
        });
        if (!flat) continue;
        polygonOf_[next] = number;
        polygon.faces.push_back(next);
      }
    // The plane: mean of the faces by area, lifted to its highest corner so that nothing of the body stands out of it.
    Vec3 normal;
    for (std::uint32_t f : polygon.faces) {
      const Triangle& t = mesh.faces[f];
      normal += cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
    }
    polygon.normal = length(normal) > 0 ? normalized(normal) : Vec3{0, 1, 0};
    double highest = -1e300;
    for (std::uint32_t f : polygon.faces)
      for (std::uint32_t p : mesh.faces[f]) highest = std::fmax(highest, dot(mesh.points[p], polygon.normal));
    polygon.centre += polygon.normal * (highest - dot(polygon.centre, polygon.normal));
    const auto onPlane = [&](Vec3 p) { return p + polygon.normal * dot(polygon.centre - p, polygon.normal); };
    for (std::uint32_t f : polygon.faces)
      for (int c = 0; c < 3; ++c)
        if (beside[f][c] == kNone || polygonOf_[beside[f][c]] != number)
          polygon.outline.push_back(
              {onPlane(mesh.points[mesh.faces[f][c]]), onPlane(mesh.points[mesh.faces[f][(c + 1) % 3]])});
    polygons_.push_back(std::move(polygon));
  }
}

bool MergedPlanes::mayTouch(Vec3 place, double within) const {
  // The planes stand at most the flatness above the mesh.
  return body_->field().distance(place) < within + settings_.flatness + body_->field().cell();
}

Collider::Contact MergedPlanes::contact(Vec3 place) const {
  Box box;
  box.include(place - Vec3{1, 1, 1} * settings_.reach);
  box.include(place + Vec3{1, 1, 1} * settings_.reach);
  std::vector<std::uint32_t> near;
  std::size_t faces = 0;
  body_->bvh().touching(box, [&](std::uint32_t f) {
    ++faces;
    near.push_back(polygonOf_[f]);
  });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  Contact best{settings_.reach, {0, 1, 0}};
  bool hit = false;
  for (std::uint32_t k : near) {
    const Polygon& polygon = polygons_[k];
    // The segment through the place along the polygon's normal, `reach` to both sides.
    const double height = dot(place - polygon.centre, polygon.normal);
    if (std::fabs(height) > settings_.reach || (hit && std::fabs(height) >= std::fabs(best.distance))) continue;
    if (!within(polygon, place - polygon.normal * height)) continue;
    best = {height, polygon.normal};
    hit = true;
  }
  done_.fetch_add(near.size(), std::memory_order_relaxed);
  saved_.fetch_add(faces - std::min(faces, near.size()), std::memory_order_relaxed);
  if (hit) return best;
  // Above an edge or a corner no polygon is met straight on: the nearest place of the mesh speaks, with its polygon's
  // normal.
  const auto nearest = body_->bvh().nearest(place, settings_.reach);
  if (!nearest) {
    const DistanceField::Sample far = body_->field().sample(place);
    return {far.distance, length(far.gradient) > 1e-9 ? normalized(far.gradient) : Vec3{0, 1, 0}};
  }
  const Polygon& polygon = polygons_[polygonOf_[nearest->place.face]];
  const double side = dot(place - nearest->point, polygon.normal) < 0 ? -1 : 1;
  return {side * nearest->distance, polygon.normal};
}

MergeReport MergedPlanes::report() const {
  return {body_->mesh().faces.size(), polygons_.size(), done_.load(std::memory_order_relaxed),
          saved_.load(std::memory_order_relaxed)};
}

}  // namespace karinui

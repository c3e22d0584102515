#include "karinui/cloth/merged_planes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cloth/mesh_distance.h"
#include "karinui/base/sort_once.h"

namespace karinui {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr double kBlend = 0.003;  // metres: polygons further away than the nearest by less have a share in the normal

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

struct Frame {  // of a plane
  Vec3 u, v;
  explicit Frame(Vec3 n)
      : u(normalized(std::fabs(n.x) < 0.7 ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0}))), v(cross(n, u)) {}
  Flat flat(Vec3 place) const { return {dot(place, u), dot(place, v)}; }
};

// The polygon's place nearest to one on its plane: itself where it lies within (a ray from it crosses the outline an
// odd number of times), else the nearest of the outline.
Flat nearestWithin(const std::vector<std::array<Flat, 2>>& outline, Flat place) {
  bool inside = false;
  Flat best = place;
  double least = 1e300;
  for (const auto& [a, b] : outline) {
    if ((a.v > place.v) != (b.v > place.v) && place.u < a.u + (b.u - a.u) * (place.v - a.v) / (b.v - a.v))
      inside = !inside;
    const Flat side = b - a;
    const double whole = dot(side, side);
    const Flat near = a + side * (whole > 0 ? std::clamp(dot(place - a, side) / whole, 0.0, 1.0) : 0.0);
    const double squared = dot(place - near, place - near);
    if (squared < least) {
      least = squared;
      best = near;
    }
  }
  return inside ? place : best;
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
    const Frame frame(polygon.normal);
    flat_.emplace_back();
    for (const auto& side : polygon.outline) flat_.back().push_back({frame.flat(side[0]), frame.flat(side[1])});
    polygons_.push_back(std::move(polygon));
  }
}

double MergedPlanes::clearance(Vec3 place) const {
  // The planes stand at most the flatness above the mesh.
  return body_->field().distance(place) - (settings_.flatness + body_->field().cell());
}

Collider::Sample MergedPlanes::sample(Vec3 place) const {
  const DistanceField::Sample rough = body_->field().sample(place);
  const Sample far{rough.distance, length(rough.gradient) > 1e-9 ? normalized(rough.gradient) : Vec3{0, 1, 0}};
  // A polygon further away than the surface itself belongs to another part of the body, as the other side of a wrist.
  const double reach =
      std::fmin(settings_.reach, std::fabs(rough.distance) + 2 * settings_.flatness + body_->field().cell());
  Box box;
  box.include(place - Vec3{1, 1, 1} * reach);
  box.include(place + Vec3{1, 1, 1} * reach);
  std::vector<std::uint32_t> near;
  std::size_t faces = 0;
  body_->bvh().touching(box, [&](std::uint32_t f) {
    ++faces;
    near.push_back(polygonOf_[f]);
  });
  if (faces == 0) return far;
  sortOnce(near);
  done_.fetch_add(near.size(), std::memory_order_relaxed);
  saved_.fetch_add(faces - near.size(), std::memory_order_relaxed);
  // The distance is that to the nearest polygon, within its outline or beside it, so that it is continuous where one
  // polygon takes over from the next. So is the normal, in which polygons hardly further away have a share.
  double least = 1e300;
  bool below = false;
  std::vector<std::pair<double, Vec3>> normals;  // how far each polygon is, and its normal
  for (std::uint32_t k : near) {
    const Polygon& polygon = polygons_[k];
    const double height = dot(place - polygon.centre, polygon.normal);
    if (std::fabs(height) >= least + kBlend) continue;
    const Frame frame(polygon.normal);
    const Flat at = frame.flat(place), beside = at - nearestWithin(flat_[k], at);
    const double away = std::hypot(height, length(beside));
    if (away >= least + kBlend) continue;
    // Far enough from the skin its field knows better on which side a place beside a polygon is.
    const bool inside =
        length(beside) > 0 && std::fabs(rough.distance) > 0.5 * body_->field().cell() ? rough.distance < 0 : height < 0;
    const Vec3 out = polygon.normal * height + frame.u * beside.u + frame.v * beside.v;
    normals.emplace_back(away, away > 1e-6 ? out * ((inside ? -1 : 1) / away) : polygon.normal);
    if (away >= least) continue;
    least = away;
    below = inside;
  }
  Vec3 normal;
  for (const auto& [away, out] : normals) {
    const double share = std::fmax(0.0, 1 - (away - least) / kBlend);
    normal += out * (share * share);
  }
  return {below ? -least : least, squaredLength(normal) > 1e-12 ? normalized(normal) : far.normal};
}

Collider::Sample MergedPlanes::exactSample(Vec3 place) const { return meshSample(*body_, place); }

Vec3 MergedPlanes::intersectionNormal(const std::array<Vec3, 3>& face) const {
  return meshIntersectionNormal(*body_, face);
}

MergeReport MergedPlanes::report() const {
  return {body_->mesh().faces.size(), polygons_.size(), done_.load(std::memory_order_relaxed),
          saved_.load(std::memory_order_relaxed)};
}

}  // namespace karinui

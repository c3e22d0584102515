#include "karinui/geometry/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "karinui/geometry/polygon.h"

namespace karinui {

namespace {

std::vector<double> heights(const TriangleMesh& mesh, const Plane& plane) {
  std::vector<double> all;
  all.reserve(mesh.points.size());
  for (const Vec3 p : mesh.points) all.push_back(dot(p - plane.through, plane.normal));
  return all;
}

// Fills the loops that the kept side's new edges make; each edge is walked the other way round by the lid.
void closeLoops(CutMesh& cut, const std::map<std::uint32_t, std::uint32_t>& next, Vec3 normal) {
  const Vec3 right = normalized(cross(std::fabs(normal.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{0, 0, 1}, normal));
  const Vec3 up = cross(normal, right);
  std::map<std::uint32_t, bool> done;
  for (const auto& [start, unused] : next) {
    if (done[start]) continue;
    std::vector<std::uint32_t> loop;
    for (std::uint32_t at = start; !done[at];) {
      done[at] = true;
      loop.push_back(at);
      const auto on = next.find(at);
      if (on == next.end()) {
        loop.clear();
        break;
      }
      at = on->second;
    }
    // A corner that lies on the plane is met by several edges at one place.
    constexpr double kSame = 1e-9;  // metres
    std::vector<std::uint32_t> apart;
    for (const std::uint32_t p : loop)
      if (apart.empty() || distance(cut.mesh.points[p], cut.mesh.points[apart.back()]) > kSame) apart.push_back(p);
    while (apart.size() > 1 && distance(cut.mesh.points[apart.front()], cut.mesh.points[apart.back()]) <= kSame)
      apart.pop_back();
    loop = std::move(apart);
    if (loop.size() < 3) continue;
    Ring ring;
    for (const std::uint32_t p : loop) ring.push_back({dot(cut.mesh.points[p], right), dot(cut.mesh.points[p], up)});
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) twice += cross(ring[i], ring[(i + 1) % ring.size()]);
    if (twice < 0) std::reverse(ring.begin(), ring.end()), std::reverse(loop.begin(), loop.end());
    const auto faces = triangulate(ring, {}, {});
    if (!faces) continue;
    const auto first = static_cast<std::uint32_t>(cut.mesh.points.size());
    for (const std::uint32_t p : loop) {
      const Vec3 place = cut.mesh.points[p];
      const CutPoint from = cut.points[p];
      cut.mesh.points.push_back(place), cut.points.push_back(from);
    }
    for (const Triangle& face : *faces) {
      cut.mesh.faces.push_back({first + face[0], first + face[1], first + face[2]});
      ++cut.closing;
    }
  }
}

}  // namespace

CutMesh cutOff(const TriangleMesh& mesh, const Plane& plane, bool close, const std::vector<bool>* only) {
  const std::vector<double> high = heights(mesh, plane);
  CutMesh cut;
  cut.mesh.points = mesh.points;
  cut.points.reserve(mesh.points.size());
  for (std::uint32_t i = 0; i < mesh.points.size(); ++i) cut.points.push_back({i, i, 0});
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> onEdge;
  const auto between = [&](std::uint32_t below, std::uint32_t above) {
    const auto [at, fresh] =
        onEdge.emplace(std::minmax(below, above), static_cast<std::uint32_t>(cut.mesh.points.size()));
    if (fresh) {
      const double share = high[below] / (high[below] - high[above]);
      cut.mesh.points.push_back(lerp(mesh.points[below], mesh.points[above], share));
      cut.points.push_back({below, above, share});
    }
    return at->second;
  };
  std::map<std::uint32_t, std::uint32_t> lid;  // from the end of each new edge to its start
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& face = mesh.faces[f];
    int above = 0;
    for (const std::uint32_t p : face) above += high[p] >= 0;
    if (above == 0 || (only && !(*only)[f])) {
      cut.mesh.faces.push_back(face);
      continue;
    }
    if (above == 3) continue;
    // Turned so that the odd one out comes first.
    std::size_t odd = 0;
    while ((high[face[odd]] >= 0) != (above == 1)) ++odd;
    const std::uint32_t a = face[odd], b = face[(odd + 1) % 3], c = face[(odd + 2) % 3];
    if (above == 1) {
      const std::uint32_t ab = between(b, a), ca = between(c, a);
      cut.mesh.faces.push_back({ab, b, c});
      cut.mesh.faces.push_back({ab, c, ca});
      lid[ab] = ca;  // the kept side has ca -> ab
    } else {
      const std::uint32_t ab = between(a, b), ca = between(a, c);
      cut.mesh.faces.push_back({a, ab, ca});
      lid[ca] = ab;
    }
  }
  if (close) closeLoops(cut, lid, plane.normal);
  return cut;
}

std::vector<bool> partAbove(const TriangleMesh& mesh, const Plane& plane, double reach) {
  const std::vector<double> high = heights(mesh, plane);
  std::vector<std::vector<std::uint32_t>> facesOf(mesh.points.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t p : mesh.faces[f]) facesOf[p].push_back(f);
  std::vector<bool> part(mesh.faces.size(), false), seen(mesh.points.size(), false);
  std::vector<std::uint32_t> open;
  const auto take = [&](std::uint32_t f) {
    part[f] = true;
    for (const std::uint32_t p : mesh.faces[f])
      if (high[p] >= 0 && !seen[p]) seen[p] = true, open.push_back(p);
  };
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    int above = 0;
    bool near = false;
    for (const std::uint32_t p : mesh.faces[f]) {
      above += high[p] >= 0;
      near = near || distance(mesh.points[p], plane.through) < reach;
    }
    if (near && above > 0 && above < 3) take(f);
  }
  while (!open.empty()) {
    const std::uint32_t p = open.back();
    open.pop_back();
    for (const std::uint32_t f : facesOf[p])
      if (!part[f]) take(f);
  }
  return part;
}

}  // namespace karinui

#include "body/extremity.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "body/polygonise.h"
#include "body/rounded_solids.h"
#include "karinui/geometry/cut_mesh.h"

namespace karinui {

namespace {

constexpr int kStripRounds = 8;
constexpr double kFar = 0.08, kSlope = 1.5;  // metres; the steepest a joined field is
constexpr double kBehind = 0.012;            // metres of limb before the cut that are made with the solid, and cut away
constexpr double kLeast = 0.25;              // of an edge, that points keep from the cut: else it leaves slivers

// The field of the whole figure between its grid points.
double sampled(const FieldGrid& g, Vec3 p) {
  const auto split = [](double v, std::size_t n, std::size_t& whole) {
    v = std::clamp(v, 0.0, static_cast<double>(n) - 1.001);
    whole = static_cast<std::size_t>(v);
    return v - static_cast<double>(whole);
  };
  std::size_t x, y, z;
  // Between the two middle corners, mirror images of each other, the field is even.
  const double fx = split(std::abs(p.x) / g.cell - 0.5, g.nx, x), fy = split((p.y - g.lowY) / g.cell, g.ny, y),
               fz = split((p.z - g.lowZ) / g.cell, g.nz, z);
  const auto row = [&](std::size_t i, std::size_t j) {
    const float* at = &g.value[g.index(i, j, z)];
    return std::lerp(double{at[0]}, double{at[1]}, fz);
  };
  return std::lerp(std::lerp(row(x, y), row(x, y + 1), fy), std::lerp(row(x + 1, y), row(x + 1, y + 1), fy), fx);
}

double along(const Plane& plane, Vec3 p) { return dot(p - plane.through, plane.normal); }

// The solid with the limb it continues. `before`: the plane where it will be cut.
TriangleMesh modelled(const Extremity& end, const FieldGrid& figure, Workers& workers) {
  FieldGrid g;
  g.cell = end.cell;
  const double lowX = end.paired ? end.low.x - 2 * g.cell : 0;
  g.lowY = end.low.y - 2 * g.cell, g.lowZ = end.low.z - 2 * g.cell;
  const auto count = [&](double low, double high) {
    return static_cast<std::size_t>(std::ceil((high - low) / g.cell)) + 3;
  };
  g.nx = count(lowX, end.high.x), g.ny = count(g.lowY, end.high.y), g.nz = count(g.lowZ, end.high.z);
  g.value.resize(g.nx * g.ny * g.nz);
  workers.forBlocks(g.nx, 1, [&](std::size_t begin, std::size_t to) {
    for (std::size_t x = begin; x < to; ++x)
      for (std::size_t y = 0; y < g.ny; ++y)
        for (std::size_t z = 0; z < g.nz; ++z) {
          const Vec3 p = g.place(x, y, z) + Vec3{lowX, 0, 0};
          const double far = along(end.cut, p);
          // Beyond the cut the limb goes on as it was there, ever thinner.
          const double beyond = std::max(0.0, far);
          const double limb = sampled(figure, p - end.cut.normal * beyond) + beyond * beyond / end.taper;
          const double solid = std::max(end.solid(p), end.gap - far);
          const double fillet = end.blend * std::clamp((far - end.gap) / (2 * end.blend), 0.0, 1.0);
          const double whole = std::max(smoothUnion(limb, solid, fillet), -far - kBehind);
          g.value[g.index(x, y, z)] = static_cast<float>(std::clamp(whole, -kFar, kFar));
          // No surface is nearer than about the value: the places passed over are not asked for.
          for (double left = std::abs(whole) - kSlope * g.cell; left > 3 * g.cell && z + 1 < g.nz;
               left -= kSlope * g.cell)
            g.value[g.index(x, y, ++z)] = static_cast<float>(std::copysign(std::min(left, kFar), whole));
        }
  });
  TriangleMesh mesh = polygonise(g, 4, workers);
  if (!end.paired) return mesh;
  // What was made to the right of the box's side is the mirror image.
  std::erase_if(mesh.faces, [&](const Triangle& f) { return mesh.points[f[0]].x < 0; });
  for (Vec3& p : mesh.points) p.x += lowX;
  return mesh;
}

TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vec3& p : mesh.points) p.x = -p.x;
  for (Triangle& f : mesh.faces) std::swap(f[1], f[2]);
  return mesh;
}

void keepOffCut(TriangleMesh& mesh, const Plane& cut, const std::vector<bool>& part, double least) {
  for (std::size_t f = 0; f < part.size(); ++f)
    if (part[f])
      for (const std::uint32_t i : mesh.faces[f])
        if (const double far = along(cut, mesh.points[i]); std::abs(far) < least)
          mesh.points[i] += cut.normal * ((far < 0 ? -least : least) - far);
}

// The line in the plane where a mesh was cut, its faces to the left; empty where there is none, or more than one.
std::vector<std::uint32_t> openLine(const TriangleMesh& mesh, const Plane& cut) {
  constexpr double kOn = 1e-9;  // metres
  std::map<std::uint32_t, std::uint32_t> next;
  const auto on = [&](std::uint32_t i) { return std::abs(along(cut, mesh.points[i])) < kOn; };
  for (const Triangle& f : mesh.faces)
    for (int i = 0; i < 3; ++i)
      if (const std::uint32_t a = f[i], b = f[(i + 1) % 3]; on(a) && on(b)) next[a] = b;
  std::vector<std::uint32_t> line;
  if (next.empty()) return line;
  const std::uint32_t first = next.begin()->first;
  std::uint32_t here = first;
  do {
    line.push_back(here);
    const auto at = next.find(here);
    if (at == next.end() || line.size() > next.size()) return {};
    here = at->second;
  } while (here != first);
  return line.size() == next.size() ? line : std::vector<std::uint32_t>();
}

// Joins two open ends that face each other by a strip: both lines are gone along together, by their angle about the
// axis, so that the strip does not twist.
bool joinEnds(TriangleMesh& mesh, const Plane& cut, const TriangleMesh& end, const Plane& start) {
  std::vector<std::uint32_t> a = openLine(mesh, cut), b = openLine(end, start);
  if (a.size() < 3 || b.size() < 3) return false;
  std::reverse(b.begin(), b.end());
  const auto offset = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), end.points.begin(), end.points.end());
  for (const Triangle& f : end.faces) mesh.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  for (std::uint32_t& i : b) i += offset;
  Vec3 middle;
  for (const std::uint32_t i : b) middle += mesh.points[i] * (1.0 / static_cast<double>(b.size()));
  const Vec3 side = normalized(cross(cut.normal, std::abs(cut.normal.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 0, 1})),
             front = cross(side, cut.normal);
  const auto angle = [&](std::uint32_t i) {
    const Vec3 p = mesh.points[i] - middle;
    return std::atan2(dot(p, side), dot(p, front));
  };
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto turned = [&](std::uint32_t from, std::uint32_t to) {
    return std::remainder(angle(to) - angle(from), kTurn);
  };
  const auto nearest = std::min_element(b.begin(), b.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::abs(turned(a[0], i)) < std::abs(turned(a[0], j));
  });
  std::rotate(b.begin(), nearest, b.end());
  double way = 0;
  for (std::size_t i = 0; i < a.size(); ++i) way += turned(a[i], a[(i + 1) % a.size()]);
  const double sign = way < 0 ? -1 : 1;
  if (std::abs(std::abs(way) - kTurn) > 0.1) return false;  // no ring about the axis
  double onA = 0, onB = sign * turned(a[0], b[0]);
  for (std::size_t i = 0, j = 0; i < a.size() || j < b.size();) {
    const std::uint32_t a0 = a[i % a.size()], a1 = a[(i + 1) % a.size()], b0 = b[j % b.size()],
                        b1 = b[(j + 1) % b.size()];
    const double nextA = onA + sign * turned(a0, a1), nextB = onB + sign * turned(b0, b1);
    if (j == b.size() || (i < a.size() && nextA + onA <= nextB + onB)) {
      mesh.faces.push_back({a1, a0, b0});
      onA = nextA, ++i;
    } else {
      mesh.faces.push_back({a0, b0, b1});
      onB = nextB, ++j;
    }
  }
  return true;
}

// Evens the points around the strip, whose triangles would show as a line.
void smoothStrip(TriangleMesh& mesh, const Plane& cut, double reach, double wide) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> beside;
  const auto near = [&](std::uint32_t i) {
    return std::abs(along(cut, mesh.points[i])) < wide && distance(mesh.points[i], cut.through) < reach;
  };
  for (const Triangle& f : mesh.faces)
    for (int i = 0; i < 3; ++i)
      if (near(f[i])) beside[f[i]].push_back(f[(i + 1) % 3]);  // closed: every neighbour follows in one face
  for (int round = 0; round < kStripRounds; ++round) {
    const std::vector<Vec3> before = mesh.points;
    for (const auto& [i, others] : beside) {
      Vec3 mean;
      for (const std::uint32_t j : others) mean += before[j] * (1.0 / static_cast<double>(others.size()));
      const double share = 1 - std::abs(along(cut, before[i])) / wide;
      mesh.points[i] = lerp(before[i], mean, std::clamp(2 * share, 0.0, 1.0) * 0.6);
    }
  }
}

// `mesh` with what lies beyond the cut replaced by `model`, which begins a little before it.
bool replaceEnd(TriangleMesh& mesh, TriangleMesh model, const Extremity& end, Plane cut, double edge) {
  double reach = 0;
  for (const Vec3& p : model.points)
    if (std::abs(along(cut, p)) < kBehind) reach = std::max(reach, distance(p, cut.through));
  const auto part = partAbove(mesh, cut, 1.3 * reach);
  keepOffCut(mesh, cut, part, kLeast * edge);
  mesh = cutOff(mesh, cut, false, &part).mesh;
  const Plane start{cut.through + cut.normal * end.gap, cut.normal * -1.0};
  keepOffCut(model, start, std::vector<bool>(model.faces.size(), true), kLeast * end.cell);
  if (!joinEnds(mesh, cut, cutOff(model, start, false).mesh, start)) return false;
  smoothStrip(mesh, cut, 1.3 * reach, 1.2 * edge);
  return true;
}

TriangleMesh compact(const TriangleMesh& mesh) {
  TriangleMesh out;
  std::vector<std::uint32_t> now(mesh.points.size(), ~0u);
  for (Triangle f : mesh.faces) {
    for (std::uint32_t& i : f) {
      if (now[i] == ~0u) now[i] = static_cast<std::uint32_t>(out.points.size()), out.points.push_back(mesh.points[i]);
      i = now[i];
    }
    out.faces.push_back(f);
  }
  return out;
}

}  // namespace

TriangleMesh withExtremities(const TriangleMesh& mesh, const FieldGrid& field, const std::vector<Extremity>& ends,
                             Workers& workers) {
  TriangleMesh out = mesh;
  for (const Extremity& end : ends) {
    TriangleMesh model = modelled(end, field, workers);
    if (model.faces.empty() || !replaceEnd(out, model, end, end.cut, field.cell)) return {};
    if (!end.paired) continue;
    const auto across = [](Vec3 v) { return Vec3{-v.x, v.y, v.z}; };
    const Plane cut{across(end.cut.through), across(end.cut.normal)};
    if (!replaceEnd(out, mirrored(std::move(model)), end, cut, field.cell)) return {};
  }
  return compact(out);
}

}  // namespace karinui

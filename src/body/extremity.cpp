#include "body/extremity.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "body/polygonise.h"
#include "body/shortened.h"
#include "karinui/geometry/cut_mesh.h"

namespace karinui {

namespace {

constexpr std::uint32_t kNone = ~0u;
constexpr int kRelaxRounds = 4, kStripRounds = 24;
constexpr double kFieldFar = 0.08, kSlope = 1.5;  // metres; the steepest a joined field is
constexpr double kBehind = 0.012;  // metres of limb before the cut that are made with the solid, and cut away
constexpr double kLeast = 0.25;    // of a cell, that the solid's points keep from where it begins
constexpr double kEven = 0.022;    // metres beyond the cut whose points are evened

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

// The solid with the limb it continues, and a little of the limb before the cut.
TriangleMesh modelled(const Extremity& end, const FieldGrid& figure, Workers& workers) {
  FieldGrid g;  // counted in cells
  g.cell = 1, g.mirrored = !end.paired;
  const Vec3 &cell = end.cell, low{end.paired ? end.low.x : 0, end.low.y, end.low.z};
  const auto count = [](double from, double to, double step) {
    return static_cast<std::size_t>(std::ceil((to - from) / step)) + 1;
  };
  g.nx = count(low.x, end.high.x, cell.x), g.ny = count(low.y, end.high.y, cell.y);
  g.nz = count(low.z, end.high.z, cell.z);
  g.value.resize(g.nx * g.ny * g.nz);
  const auto inSpace = [&](Vec3 p) {
    return end.origin + end.axis[0] * (low.x + p.x * cell.x) + end.axis[1] * (low.y + p.y * cell.y) +
           end.axis[2] * (low.z + p.z * cell.z);
  };
  workers.forBlocks(g.nx, 1, [&](std::size_t begin, std::size_t to) {
    for (std::size_t x = begin; x < to; ++x)
      for (std::size_t y = 0; y < g.ny; ++y)
        for (std::size_t z = 0; z < g.nz; ++z) {
          const Vec3 p = inSpace(g.place(x, y, z));
          const double far = along(end.cut, p);
          // From the drawn figure the shape goes over into the solid, without an edge where it begins.
          const double t = std::clamp(far / end.blend, 0.0, 1.0), share = t * t * (3 - 2 * t);
          double whole = share > 0 ? end.solid(p) : 0;
          if (share < 1) whole = std::lerp(sampled(figure, p), whole, share);
          whole = std::max(whole, -far - kBehind);
          g.value[g.index(x, y, z)] = static_cast<float>(std::clamp(whole, -kFieldFar, kFieldFar));
          // No surface is nearer than about the value: the places passed over are not asked for.
          for (double left = std::abs(whole) - kSlope * cell.z; left > 3 * cell.z && z + 1 < g.nz;
               left -= kSlope * cell.z)
            g.value[g.index(x, y, ++z)] = static_cast<float>(std::copysign(std::min(left, kFieldFar), whole));
        }
  });
  TriangleMesh mesh = polygonise(g, kRelaxRounds, workers);
  for (Vec3& p : mesh.points) p = inSpace(p);
  return mesh;
}

TriangleMesh mirrored(TriangleMesh mesh) {
  for (Vec3& p : mesh.points) p.x = -p.x;
  for (Triangle& f : mesh.faces) std::swap(f[1], f[2]);
  return mesh;
}

Extremity mirrored(Extremity end) {
  for (Vec3* v : {&end.cut.through, &end.cut.normal, &end.tip}) v->x = -v->x;
  return end;
}

// The solid from where it begins on, and the line there, its faces to the left.
struct Begun {
  TriangleMesh mesh;
  Line line;
};

Begun begun(TriangleMesh model, const Plane& start, double least) {
  for (Vec3& p : model.points)
    if (const double far = along(start, p); std::abs(far) < least)
      p += start.normal * ((far < 0 ? -least : least) - far);
  CutMesh cut = cutOff(model, start, false);
  std::map<std::uint32_t, std::uint32_t> next;
  const auto fresh = [&](std::uint32_t i) { return i >= model.points.size(); };
  for (const Triangle& f : cut.mesh.faces)
    for (int i = 0; i < 3; ++i)
      if (const std::uint32_t a = f[i], b = f[(i + 1) % 3]; fresh(a) && fresh(b)) next[a] = b;
  Begun out{{}, oneLine(next)};
  std::vector<std::uint32_t> now(cut.mesh.points.size(), kNone);
  for (Triangle f : cut.mesh.faces) {
    for (std::uint32_t& i : f) {
      if (now[i] == kNone)
        now[i] = static_cast<std::uint32_t>(out.mesh.points.size()), out.mesh.points.push_back(cut.mesh.points[i]);
      i = now[i];
    }
    out.mesh.faces.push_back(f);
  }
  for (std::uint32_t& i : out.line) i = now[i];
  return out;
}

// Evens the points beside the strip, whose triangles would show as a line: those that came with the solid.
void smoothStrip(TriangleMesh& mesh, const Plane& cut, std::size_t firstPoint, std::size_t firstFace) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> beside;
  for (std::size_t f = firstFace; f < mesh.faces.size(); ++f)
    for (int i = 0; i < 3; ++i)
      if (const std::uint32_t p = mesh.faces[f][i]; p >= firstPoint && along(cut, mesh.points[p]) < kEven)
        beside[p].push_back(mesh.faces[f][(i + 1) % 3]);  // closed: every neighbour follows in one face
  std::vector<Vec3> moved;
  for (int round = 0; round < kStripRounds; ++round) {
    moved.clear();
    for (const auto& [i, others] : beside) {
      Vec3 mean;
      for (const std::uint32_t j : others) mean += mesh.points[j] * (1.0 / static_cast<double>(others.size()));
      const double share = 1 - along(cut, mesh.points[i]) / kEven;
      moved.push_back(lerp(mesh.points[i], mean, std::clamp(2 * share, 0.0, 1.0) * 0.6));
    }
    std::size_t n = 0;
    for (const auto& [i, others] : beside) mesh.points[i] = moved[n++];
  }
}

// Whether what is new crosses itself or what is near it; the rest is known not to.
bool crosses(const TriangleMesh& mesh, std::size_t firstNew) {
  constexpr double kNear = 0.02, kBlock = 0.16;  // metres; blocks of space in which anything is new
  using Block = std::array<int, 3>;
  const auto blockOf = [&](Vec3 p) {
    return Block{static_cast<int>(std::floor(p.x / kBlock)), static_cast<int>(std::floor(p.y / kBlock)),
                 static_cast<int>(std::floor(p.z / kBlock))};
  };
  std::set<Block> blocks;
  for (std::size_t f = firstNew; f < mesh.faces.size(); ++f)
    for (const double x : {-kNear, kNear})
      for (const double y : {-kNear, kNear})
        for (const double z : {-kNear, kNear}) blocks.insert(blockOf(mesh.points[mesh.faces[f][0]] + Vec3{x, y, z}));
  TriangleMesh near{mesh.points, {mesh.faces.begin() + static_cast<std::ptrdiff_t>(firstNew), mesh.faces.end()}};
  for (std::size_t f = 0; f < firstNew; ++f)
    if (blocks.contains(blockOf(mesh.points[mesh.faces[f][0]]))) near.faces.push_back(mesh.faces[f]);
  return !selfCrossings(near).empty();
}

}  // namespace

TriangleMesh withExtremities(const TriangleMesh& mesh, const FieldGrid& field, const std::vector<Extremity>& ends,
                             Workers& workers) {
  Shortened rest(mesh);
  struct Part {
    Extremity end;
    TriangleMesh model;
    Line line;
  };
  std::vector<Part> parts;
  for (const Extremity& end : ends) {
    parts.push_back({end, modelled(end, field, workers), rest.takeOff(end.cut, end.tip)});
    if (!end.paired) continue;
    const Extremity other = mirrored(end);
    parts.push_back({other, mirrored(parts.back().model), rest.takeOff(other.cut, other.tip)});
  }
  TriangleMesh out = rest.taken();
  const std::size_t firstNew = out.faces.size();
  for (Part& part : parts) {
    const Plane start{part.end.cut.through + part.end.cut.normal * part.end.gap, part.end.cut.normal * -1.0};
    const Vec3& cell = part.end.cell;
    Begun model = begun(std::move(part.model), start, kLeast * std::min({cell.x, cell.y, cell.z}));
    const std::size_t firstPoint = out.points.size(), firstFace = out.faces.size();
    const auto offset = static_cast<std::uint32_t>(firstPoint);
    out.points.insert(out.points.end(), model.mesh.points.begin(), model.mesh.points.end());
    for (const Triangle& f : model.mesh.faces) out.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
    for (std::uint32_t& i : model.line) i += offset;
    if (!joinLines(out, part.line, std::move(model.line), part.end.cut.normal)) return {};
    smoothStrip(out, part.end.cut, firstPoint, firstFace);
  }
  out = compact(out);
  return crosses(out, firstNew) ? TriangleMesh() : out;
}

}  // namespace karinui

#include "view/surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/vertex.h"

namespace karinui {
namespace {

bool drawableFace(const TriangleMesh& mesh, const Triangle& face) {
  return std::all_of(face.begin(), face.end(),
                     [&](std::uint32_t i) { return i < mesh.points.size() && drawable(mesh.points[i]); });
}

// At each point the mean over the corners of the faces around it: the binomial filter, which takes out what turns back
// from one point to the next and leaves waves of several cells.
template <class Value>
std::vector<Value> meanAround(const std::vector<Value>& values, const std::vector<Triangle>& faces) {
  std::vector<Value> sum(values.size());
  std::vector<double> count(values.size(), 0.0);
  for (const Triangle& f : faces)
    for (const std::uint32_t i : f) sum[i] = sum[i] + values[f[0]] + values[f[1]] + values[f[2]], count[i] += 3;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 0) sum[i] = sum[i] * (1 / count[i]);
  return sum;
}

// How far each point lies under (> 0) or over the mean of its neighbours, measured by their distance: a fold's hollow,
// whatever the mesh's fineness. Averaged over the neighbours, so that single triangles do not show.
std::vector<double> hollows(const TriangleMesh& mesh, const std::vector<Triangle>& faces,
                            const std::vector<Vec3>& normals) {
  const std::size_t n = mesh.points.size();
  std::vector<Vec3> sum(n);
  std::vector<double> reach(n, 0.0), count(n, 0.0), raw(n, 0.0);
  for (const Triangle& f : faces)
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::uint32_t j : {f[(k + 1) % 3], f[(k + 2) % 3]}) {
        const Vec3 to = mesh.points[j] - mesh.points[f[k]];
        sum[f[k]] += to, reach[f[k]] += length(to), count[f[k]] += 1;
      }
  for (std::size_t i = 0; i < n; ++i)
    // sum / count is half the mean curvature times the squared edge; over the edge's square it is 1/metres, and a
    // radius of 2 cm is a deep fold.
    if (reach[i] > 0) raw[i] = 0.02 * 4 * dot(sum[i], normals[i]) * count[i] / (reach[i] * reach[i]);
  for (double& r : raw) r = std::clamp(r, -1.5, 1.5);
  // Twice: in a lattice points with eight neighbours alternate with points that have four.
  return meanAround(meanAround(raw, faces), faces);
}

}  // namespace

void addMesh(Surface& surface, const TriangleMesh& mesh, Vec3 origin, const Colour& colour,
             const std::vector<Flat>& flat, const std::vector<float>& strain) {
  std::vector<Triangle> faces;
  faces.reserve(mesh.faces.size());
  for (const Triangle& face : mesh.faces)
    if (drawableFace(mesh, face)) faces.push_back(face);
  surface.leftOut += mesh.faces.size() - faces.size();

  std::vector<Vec3> normals(mesh.points.size());
  for (const Triangle& f : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.points[f[(k + 1) % 3]] - mesh.points[f[k]],
                 b = mesh.points[f[(k + 2) % 3]] - mesh.points[f[k]];
      const Vec3 across = cross(a, b);
      normals[f[k]] += normalized(across) * std::atan2(length(across), dot(a, b));
    }
  for (Vec3& normal : normals) normal = normalized(normal);
  const std::vector<double> hollow = hollows(mesh, faces, normals);
  if (flat.size() == mesh.points.size()) {  // a fold that runs across a lattice would show its cells as teeth
    normals = meanAround(normals, faces);
    for (Vec3& normal : normals) normal = normalized(normal);
  }

  const auto base = static_cast<std::uint32_t>(surface.vertices.size());
  const bool hasFlat = flat.size() == mesh.points.size(), hasStrain = strain.size() == mesh.points.size();
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    SurfaceVertex v{};
    if (drawable(mesh.points[i])) put(v.place, mesh.points[i] - origin);
    put(v.normal, normals[i]);
    for (std::size_t c = 0; c < 3; ++c)
      v.colour[c] = std::isfinite(colour[c]) ? std::clamp(colour[c], 0.0f, 1.0f) : 0.5f;
    if (hasFlat && finite(flat[i]))
      v.flat[0] = static_cast<float>(flat[i].u), v.flat[1] = static_cast<float>(flat[i].v);
    v.cavity = static_cast<float>(hollow[i]);
    v.strain = hasStrain && std::isfinite(strain[i]) ? std::max(strain[i], 0.0f) : -1.0f;
    surface.vertices.push_back(v);
  }
  for (const Triangle& f : faces)
    for (const std::uint32_t i : f) surface.corners.push_back(base + i);
}

void addEdges(Surface& surface, const SceneCloth& cloth, Vec3 origin) {
  constexpr float kShade = 0.8f;  // cut threads swallow light
  const auto& points = cloth.mesh.points;
  if (!(cloth.look.thickness > 0) || cloth.outlines.empty()) return;
  const std::vector<Vec3> normals = pointNormals(cloth.mesh);
  for (const auto& run : cloth.outlines)
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      if (run[i] >= points.size() || run[i + 1] >= points.size()) continue;
      const Vec3 from = points[run[i]], to = points[run[i + 1]];
      if (!drawable(from) || !drawable(to)) continue;
      const Vec3 out = normalized(cross(to - from, normals[run[i]]));  // outlines run counter-clockwise
      const auto base = static_cast<std::uint32_t>(surface.vertices.size());
      for (const std::uint32_t end : {run[i], run[i + 1]})
        for (const double deep : {0.0, cloth.look.thickness}) {
          SurfaceVertex v{};
          put(v.place, points[end] - normals[end] * deep - origin);
          put(v.normal, out);
          for (std::size_t c = 0; c < 3; ++c) v.colour[c] = kShade * std::clamp(cloth.colour[c], 0.0f, 1.0f);
          if (end < cloth.flat.size() && finite(cloth.flat[end]))
            v.flat[0] = static_cast<float>(cloth.flat[end].u), v.flat[1] = static_cast<float>(cloth.flat[end].v);
          v.strain = -1;
          surface.vertices.push_back(v);
        }
      for (const std::uint32_t k : {0u, 1u, 2u, 2u, 1u, 3u}) surface.corners.push_back(base + k);
    }
}

void KeptMesh::add(Surface& surface, const TriangleMesh& mesh, Vec3 origin, const Colour& colour, bool roughly) {
  const bool moved = mesh.points != mesh_.points;
  const bool alike = mesh.faces == mesh_.faces && mesh.points.size() == mesh_.points.size() && colour == colour_;
  if (alike && roughly) {
    if (moved) {
      mesh_.points = mesh.points;
      std::vector<Vec3> normals(mesh.points.size());
      for (std::size_t k = 0; k + 2 < own_.corners.size(); k += 3) {
        const std::uint32_t a = own_.corners[k], b = own_.corners[k + 1], c = own_.corners[k + 2];
        const Vec3 across = cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
        normals[a] += across, normals[b] += across, normals[c] += across;
      }
      for (std::size_t i = 0; i < normals.size(); ++i) put(own_.vertices[i].normal, normalized(normals[i]));
      rough_ = true;
    }
  } else if (moved || !alike || rough_) {
    mesh_ = mesh;
    colour_ = colour;
    rough_ = false;
    own_ = {};
    addMesh(own_, mesh, {}, colour);
  }
  const auto base = static_cast<std::uint32_t>(surface.vertices.size());
  surface.vertices.insert(surface.vertices.end(), own_.vertices.begin(), own_.vertices.end());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (drawable(mesh.points[i])) put(surface.vertices[base + i].place, mesh.points[i] - origin);
  for (const std::uint32_t i : own_.corners) surface.corners.push_back(base + i);
  surface.leftOut += own_.leftOut;
}

void addFloor(Surface& surface, Vec3 centre, double radius) {
  constexpr std::uint32_t kRings = 48, kRays = 72;
  const auto base = static_cast<std::uint32_t>(surface.vertices.size());
  for (std::uint32_t ring = 0; ring <= kRings; ++ring)
    for (std::uint32_t ray = 0; ray < kRays; ++ray) {
      const double r = radius * std::pow(static_cast<double>(ring) / kRings, 1.5),
                   turn = 2 * std::numbers::pi * ray / kRays;
      SurfaceVertex v{};
      put(v.place, centre + Vec3{r * std::sin(turn), 0, r * std::cos(turn)});
      v.normal[1] = 1;
      v.flat[0] = static_cast<float>(r / radius);
      v.strain = -1;
      surface.vertices.push_back(v);
    }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t ray = 0; ray < kRays; ++ray) {
      const std::uint32_t a = base + ring * kRays + ray, b = base + ring * kRays + (ray + 1) % kRays;
      for (const std::uint32_t i : {a, a + kRays, b, b, a + kRays, b + kRays}) surface.corners.push_back(i);
    }
}

}  // namespace karinui

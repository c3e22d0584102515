// Wavefront OBJ. Nine significant decimals below the metre are kept (a nanometre), always with a point.
#include "karinui/base/number.h"
#include "names.h"
#include "spatial.h"

namespace karinui {
namespace {

constexpr int kDecimals = 9;

void line(std::string& out, const char* key, Vec3 p) {
  out.append(key).append(fixed(p.x, kDecimals)).append(" ").append(fixed(p.y, kDecimals));
  out.append(" ").append(fixed(p.z, kDecimals)).append("\n");
}

void faces(std::string& out, const TriangleMesh& mesh, std::size_t firstPoint, std::size_t firstFlat, bool normals) {
  for (const Triangle& face : mesh.faces) {
    out += "f";
    for (const std::uint32_t corner : face) {
      const std::string point = std::to_string(firstPoint + corner);
      out.append(" ").append(point);
      if (!normals) continue;
      out.append("/");
      if (firstFlat != 0) out.append(std::to_string(firstFlat + corner));
      out.append("/").append(point);
    }
    out += "\n";
  }
}

}  // namespace

Result<std::string> writeObj(const SpatialGarment& garment) {
  const auto meshes = namedMeshes(garment);
  if (!meshes) return meshes.error();
  std::string out = "# Karinui: metres, y up; vt is the flat pattern in metres\n";
  std::size_t point = 1, flat = 1;
  for (const NamedMesh& named : *meshes) {
    out.append("o ").append(named.name).append("\n");
    for (const Vec3 p : named.mesh->points) line(out, "v ", p);
    if (named.flat)
      for (const Flat p : *named.flat)
        out.append("vt ").append(fixed(p.u, kDecimals)).append(" ").append(fixed(p.v, kDecimals)).append("\n");
    for (const Vec3 n : pointNormals(*named.mesh)) line(out, "vn ", n);
    out.append("s 1\n");
    faces(out, *named.mesh, point, named.flat ? flat : 0, true);
    point += named.mesh->points.size();
    if (named.flat) flat += named.flat->size();
  }
  return out;
}

Result<std::string> writeObj(const TriangleMesh& mesh, std::string_view name) {
  if (auto good = checkMesh(mesh, name); !good) return good.error();
  std::string out = "# Karinui: metres, y up\no " + oneWord(name, "mesh") + "\n";
  for (const Vec3 p : mesh.points) line(out, "v ", p);
  faces(out, mesh, 1, 0, false);
  return out;
}

}  // namespace karinui

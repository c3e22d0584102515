// Wavefront OBJ. Nine significant decimals below the metre are kept (a nanometre), always with a point.
#include <algorithm>
#include <cmath>

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

// Readers take a colour for what a screen shows (sRGB); ours are linear.
std::string shade(float linear) {
  const double v = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  return fixed(v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055, 4);
}

// The materials of an OBJ, in the order in which they are first worn.
class Materials {
 public:
  explicit Materials(std::string_view stem) : stem_(oneWord(stem, "garment")) {}
  std::string file() const { return stem_ + ".mtl"; }

  Result<std::string> of(const NamedMesh& object) {
    for (const auto& [known, name] : made_)
      if (lookAlike(*known, object)) return name;
    const std::string name = taken_.give(oneWord(materialName(object), "material"));
    made_.emplace_back(&object, name);
    text_ += "\nnewmtl " + name + "\nKd";
    const SpatialLook::Tile* tile = object.look && object.look->tile ? &*object.look->tile : nullptr;
    // A map's coordinates are stretched and moved, but not turned: of a print that lies turned only the colour is told.
    const bool mapped = tile && tile->across == Flat{1, 0} && tile->along == Flat{0, 1};
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (std::size_t i = c; tile && i < tile->rgb.size(); i += 3) sum += tile->rgb[i];
      text_ += " " + (mapped ? "1.0000"
                      : tile ? fixed(3 * sum / (255 * static_cast<double>(tile->rgb.size())), 4)
                             : shade(object.colour[c]));
    }
    text_ += "\n";
    if (object.look && object.look->cover < 1) text_ += "d " + fixed(object.look->cover, 4) + "\n";
    text_ += "illum 1\n";
    if (!mapped) return name;
    auto png = pngOf(*tile);
    if (!png) return png.error();
    const std::string picture = stem_ + "_print" + std::to_string(pictures_.size() + 1) + ".png";
    pictures_.push_back({picture, *std::move(png)});
    text_ += "map_Kd -s " + fixed(1 / tile->wide, 6) + " " + fixed(1 / tile->high, 6) + " 1 -o " +
             fixed(-tile->origin.u / tile->wide, 6) + " " + fixed(-tile->origin.v / tile->high, 6) + " 0 " + picture +
             "\n";
    return name;
  }
  void giveTo(std::vector<SideFile>& beside) {
    beside.push_back({file(), "# Karinui\n" + text_});
    for (SideFile& picture : pictures_) beside.push_back(std::move(picture));
  }

 private:
  std::string stem_, text_;
  std::vector<std::pair<const NamedMesh*, std::string>> made_;
  std::vector<SideFile> pictures_;
  DistinctNames taken_;
};

// `materials`: null: none.
Result<std::string> objOf(Materials* materials, const std::vector<NamedMesh>& meshes) {
  std::string out = "# Karinui: metres, y up; vt is the flat pattern in metres\n";
  if (materials) out += "mtllib " + materials->file() + "\n";
  std::size_t point = 1, flat = 1;
  for (const NamedMesh& named : meshes) {
    out.append("o ").append(named.name).append("\n");
    for (const Vec3 p : named.mesh->points) line(out, "v ", p);
    if (named.flat)
      for (const Flat p : *named.flat)
        out.append("vt ").append(fixed(p.u, kDecimals)).append(" ").append(fixed(p.v, kDecimals)).append("\n");
    for (const Vec3 n : pointNormals(*named.mesh)) line(out, "vn ", n);
    if (materials) {
      const auto material = materials->of(named);
      if (!material) return material.error();
      out.append("usemtl ").append(*material).append("\n");
    }
    out.append("s 1\n");
    faces(out, *named.mesh, point, named.flat ? flat : 0, true);
    point += named.mesh->points.size();
    if (named.flat) flat += named.flat->size();
  }
  return out;
}

}  // namespace

Result<std::string> writeObj(const SpatialGarment& garment) {
  const auto meshes = namedMeshes(garment);
  return meshes ? objOf(nullptr, *meshes) : meshes.error();
}

Result<std::string> writeObj(const SpatialGarment& garment, std::string_view stem, std::vector<SideFile>& beside) {
  const auto meshes = namedMeshes(garment);
  if (!meshes) return meshes.error();
  Materials materials(stem);
  auto obj = objOf(&materials, *meshes);
  if (obj) materials.giveTo(beside);
  return obj;
}

Result<std::string> writeObj(const TriangleMesh& mesh, std::string_view name) {
  if (auto good = checkMesh(mesh, name); !good) return good.error();
  std::string out = "# Karinui: metres, y up\no " + oneWord(name, "mesh") + "\n";
  for (const Vec3 p : mesh.points) line(out, "v ", p);
  faces(out, mesh, 1, 0, false);
  return out;
}

}  // namespace karinui

// glTF 2.0, binary container (Khronos specification 2.0, sections 3 and 4.4): one JSON chunk, one chunk of numbers,
// every view of it aligned to four bytes.
#include <cairo.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>

#include "spatial.h"
#include "strict_json.h"

namespace karinui {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF stores little-endian numbers");

constexpr int kFloat = 5126, kUnsigned = 5125, kArrayBuffer = 34962, kElementBuffer = 34963;

class Buffer {
 public:
  // Adds numbers as a view and an accessor; returns the accessor's index.
  template <class Number>
  std::size_t add(const std::vector<Number>& numbers, int width, bool withRange) {
    const bool index = std::is_same_v<Number, std::uint32_t>;
    const std::size_t offset = bytes_.size();
    bytes_.resize(offset + numbers.size() * sizeof(Number));
    if (!numbers.empty()) std::memcpy(bytes_.data() + offset, numbers.data(), numbers.size() * sizeof(Number));
    views.push_back({{"buffer", 0},
                     {"byteOffset", offset},
                     {"byteLength", numbers.size() * sizeof(Number)},
                     {"target", index ? kElementBuffer : kArrayBuffer}});
    Json accessor{{"bufferView", views.size() - 1},
                  {"componentType", index ? kUnsigned : kFloat},
                  {"count", numbers.size() / static_cast<std::size_t>(width)},
                  {"type", width == 1   ? "SCALAR"
                           : width == 2 ? "VEC2"
                                        : "VEC3"}};
    if (withRange) {
      std::vector<Number> low(static_cast<std::size_t>(width), std::numeric_limits<Number>::max());
      std::vector<Number> high(static_cast<std::size_t>(width), std::numeric_limits<Number>::lowest());
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t k = i % static_cast<std::size_t>(width);
        low[k] = std::min(low[k], numbers[i]);
        high[k] = std::max(high[k], numbers[i]);
      }
      accessor["min"] = low;
      accessor["max"] = high;
    }
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }
  // Adds a file as it is; returns the view's index.
  std::size_t addFile(const std::string& file) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    views.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", file.size()}});
    bytes_ += file;
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    return views.size() - 1;
  }
  const std::string& bytes() const { return bytes_; }
  Json views = Json::array(), accessors = Json::array();

 private:
  std::string bytes_;
};

std::vector<float> floats(const std::vector<Vec3>& points) {
  std::vector<float> out;
  for (const Vec3 p : points)
    out.insert(out.end(), {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  return out;
}

// glTF counts v downwards from the picture's top; its paper place stays (u, 1 - v) in metres, as other writers turn it.
std::vector<float> textureCoordinates(const std::vector<Flat>& flat) {
  std::vector<float> out;
  for (const Flat p : flat) out.insert(out.end(), {static_cast<float>(p.u), static_cast<float>(1 - p.v)});
  return out;
}

// Paper as the print lies on it: texture coordinates stay metres, and KHR_texture_transform says how large a repeat is.
std::vector<Flat> onTile(const SpatialLook::Tile& tile, const std::vector<Flat>& flat) {
  std::vector<Flat> all;
  all.reserve(flat.size());
  for (const Flat p : flat) all.push_back({dot(p - tile.origin, tile.across), dot(p - tile.origin, tile.along)});
  return all;
}

// The thickness of cloth where it was cut: a strip along every border of the mesh, as deep as the cloth is thick, away
// from the side that is seen. Points, normals and paper places are added behind those of the mesh.
void addRim(TriangleMesh& mesh, std::vector<Vec3>& normals, std::vector<Flat>& flat, double thickness) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& face : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(face[k], face[(k + 1) % 3])];
  const std::vector<Triangle> faces = mesh.faces;
  for (const Triangle& face : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = face[k], to = face[(k + 1) % 3];
      const Vec3 way = mesh.points[to] - mesh.points[from];
      if (sides[std::minmax(from, to)] != 1 || !(squaredLength(way) > 0)) continue;
      const Vec3 out = normalized(cross(way, normals[from]));  // the cloth lies at the left of its border
      const auto base = static_cast<std::uint32_t>(mesh.points.size());
      for (const std::uint32_t end : {from, to})
        for (const double deep : {0.0, thickness}) {
          mesh.points.push_back(mesh.points[end] - normals[end] * deep);
          normals.push_back(out);
          flat.push_back(flat[end]);
        }
      mesh.faces.push_back({base, base + 1, base + 2});
      mesh.faces.push_back({base + 2, base + 1, base + 3});
    }
}

void append32(std::string& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  out.append(reinterpret_cast<const char*>(&word), sizeof word);
}

}  // namespace

Result<std::string> pngOf(const SpatialLook::Tile& tile) {
  const int stride = 4 * tile.width;
  std::vector<unsigned char> rows(static_cast<std::size_t>(stride) * static_cast<std::size_t>(tile.height), 0);
  for (std::size_t i = 0; i < rows.size() / 4; ++i)  // cairo's pixels: blue, green, red, nothing
    for (std::size_t c = 0; c < 3; ++c) rows[4 * i + c] = tile.rgb[3 * i + 2 - c];
  cairo_surface_t* surface =
      cairo_image_surface_create_for_data(rows.data(), CAIRO_FORMAT_RGB24, tile.width, tile.height, stride);
  std::string png;
  const auto append = [](void* to, const unsigned char* data, unsigned int size) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), size);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t done = cairo_surface_write_to_png_stream(surface, append, &png);
  cairo_surface_destroy(surface);
  if (done != CAIRO_STATUS_SUCCESS) return storageError(say("The picture of a print could not be written."));
  return png;
}

Result<std::string> writeGlb(const SpatialGarment& garment) {
  const auto named = namedMeshes(garment);
  if (!named) return named.error();
  Buffer buffer;
  Json nodes = Json::array(), meshes = Json::array(), materials = Json::array(), roots = Json::array();
  Json textures = Json::array(), images = Json::array();
  bool sheen = false, transform = false;
  // One material for each side of what looks alike. `tile`: the side's print.
  const auto addMaterial = [&](const std::string& name, const std::array<float, 3>& colour, const SpatialLook* look,
                               const std::optional<SpatialLook::Tile>& tile, bool bothSides) -> Done {
    const double cover = look ? look->cover : 1;
    Json surface{{"baseColorFactor", {colour[0], colour[1], colour[2], cover}},
                 {"metallicFactor", 0.0},
                 {"roughnessFactor", look ? look->roughness : 0.6}};
    if (tile) {
      auto png = pngOf(*tile);
      if (!png) return png.error();
      images.push_back({{"bufferView", buffer.addFile(*png)}, {"mimeType", "image/png"}});
      textures.push_back({{"source", images.size() - 1}, {"sampler", 0}});
      // Coordinates are (u, 1 - v) in metres. A tile's v runs downwards from its top: (1 - v) / high + 1 - 1 / high
      // is a whole number where v is a whole number of repeats.
      surface["baseColorFactor"] = {1.0, 1.0, 1.0, cover};
      surface["baseColorTexture"] = {
          {"index", textures.size() - 1},
          {"extensions",
           {{"KHR_texture_transform",
             {{"scale", {1 / tile->wide, 1 / tile->high}}, {"offset", {0.0, 1 - 1 / tile->high}}}}}}};
      transform = true;
    }
    Json made{{"name", name}, {"doubleSided", bothSides}, {"pbrMetallicRoughness", std::move(surface)}};
    if (cover < 1) made["alphaMode"] = "BLEND";
    if (look && look->sheen > 0) {
      const double s = look->sheen;
      made["extensions"]["KHR_materials_sheen"] = {{"sheenColorFactor", {s * colour[0], s * colour[1], s * colour[2]}},
                                                   {"sheenRoughnessFactor", 0.5}};
      sheen = true;
    }
    materials.push_back(std::move(made));
    return {};
  };
  std::vector<std::pair<const NamedMesh*, std::size_t>> materialOf;  // of pieces that look alike one
  for (const NamedMesh& object : *named) {
    if (object.mesh->points.empty() || object.mesh->faces.empty()) continue;  // glTF has no empty accessor
    const bool cloth = object.flat != nullptr;
    const auto alike = std::find_if(materialOf.begin(), materialOf.end(),
                                    [&](const auto& known) { return lookAlike(*known.first, object); });
    const std::size_t material = alike != materialOf.end() ? alike->second : materials.size();
    if (alike == materialOf.end()) {
      materialOf.emplace_back(&object, material);
      const bool wrong = cloth && object.look->wrong;
      const std::string name = materialName(object);
      if (const Done done =
              addMaterial(name, object.colour, object.look, cloth ? object.look->tile : std::nullopt, cloth && !wrong);
          !done)
        return done.error();
      if (wrong)  // behind that of its right side
        if (const Done done = addMaterial(name + " wrong side", object.look->wrong->colour, object.look,
                                          object.look->wrong->tile, false);
            !done)
          return done.error();
    }
    TriangleMesh mesh = *object.mesh;
    std::vector<Flat> flat = cloth ? *object.flat : std::vector<Flat>();
    std::vector<Vec3> normals = pointNormals(mesh);
    for (Vec3& n : normals)
      if (squaredLength(n) < 0.5) n = {0, 0, 1};  // a point of no face; a glTF normal must have unit length
    const TriangleMesh sides = mesh;
    const std::vector<Vec3> outwards = normals;
    if (cloth && object.look->thickness > 0) addRim(mesh, normals, flat, object.look->thickness);
    Json primitives = Json::array();
    const auto addSide = [&](const TriangleMesh& shape, const std::vector<Vec3>& up, const std::vector<Flat>& paper,
                             const std::optional<SpatialLook::Tile>& tile, std::size_t of) {
      Json attributes;
      attributes["POSITION"] = buffer.add(floats(shape.points), 3, true);
      attributes["NORMAL"] = buffer.add(floats(up), 3, false);
      if (cloth)
        attributes["TEXCOORD_0"] = buffer.add(textureCoordinates(tile ? onTile(*tile, paper) : paper), 2, false);
      std::vector<std::uint32_t> indices;
      for (const Triangle& face : shape.faces) indices.insert(indices.end(), face.begin(), face.end());
      primitives.push_back(
          {{"attributes", attributes}, {"indices", buffer.add(indices, 1, true)}, {"material", of}, {"mode", 4}});
    };
    addSide(mesh, normals, flat, cloth ? object.look->tile : std::nullopt, material);
    if (cloth && object.look->wrong) {  // the same cloth seen from its other side
      TriangleMesh turned = sides;
      for (Triangle& face : turned.faces) std::swap(face[1], face[2]);
      std::vector<Vec3> inwards = outwards;
      for (Vec3& n : inwards) n = -n;
      addSide(turned, inwards, *object.flat, object.look->wrong->tile, material + 1);
    }
    roots.push_back(nodes.size());
    nodes.push_back({{"name", object.name}, {"mesh", meshes.size()}});
    meshes.push_back({{"name", object.name}, {"primitives", primitives}});
  }
  if (nodes.empty()) return refused(say("There is nothing to write: no body and no piece."));
  Json root{{"asset", {{"version", "2.0"}, {"generator", "Karinui"}}}, {"scene", 0}};
  root["scenes"] = Json::array({{{"name", "fitting"}, {"nodes", roots}}});
  root["nodes"] = nodes;
  root["meshes"] = meshes;
  root["materials"] = materials;
  if (transform) {
    root["images"] = images, root["textures"] = textures;
    root["samplers"] = Json::array({{{"wrapS", 10497}, {"wrapT", 10497}, {"magFilter", 9729}, {"minFilter", 9987}}});
  }
  if (sheen) root["extensionsUsed"].push_back("KHR_materials_sheen");
  if (transform) root["extensionsUsed"].push_back("KHR_texture_transform");
  root["accessors"] = buffer.accessors;
  root["bufferViews"] = buffer.views;
  root["buffers"] = Json::array({{{"byteLength", buffer.bytes().size()}}});

  std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string numbers = buffer.bytes();
  numbers.resize((numbers.size() + 3) / 4 * 4, '\0');
  const std::size_t total = 12 + 8 + json.size() + 8 + numbers.size();
  if (total > std::numeric_limits<std::uint32_t>::max())
    return refused(say("The garment is too large for one GLB file (4 GB)."));
  std::string out;
  out.reserve(total);
  append32(out, 0x46546C67), append32(out, 2), append32(out, total);
  append32(out, json.size()), append32(out, 0x4E4F534A), out += json;
  append32(out, numbers.size()), append32(out, 0x004E4942), out += numbers;
  return out;
}

}  // namespace karinui

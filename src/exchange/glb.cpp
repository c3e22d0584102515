// glTF 2.0, binary container (Khronos specification 2.0, sections 3 and 4.4): one JSON chunk, one chunk of numbers,
// every view of it aligned to four bytes.
#include <cairo.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>

#include "karinui/base/number.h"
#include "names.h"
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
    views.push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", numbers.size() * sizeof(Number)}});
    if (index || width > 1)
      views.back()["target"] = index ? kElementBuffer : kArrayBuffer;  // single numbers: an animation
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

// One side of a mesh as it is drawn: every point with its normal and, of cloth, its place on paper.
struct Surface {
  std::vector<Vec3> points, normals;
  std::vector<Flat> flat;
  std::vector<Triangle> faces;
};

Surface surfaceOf(const std::vector<Vec3>& points, const std::vector<Triangle>& faces, const std::vector<Flat>* flat) {
  Surface surface{points, pointNormals({points, faces}), flat ? *flat : std::vector<Flat>(), faces};
  for (Vec3& n : surface.normals)
    if (squaredLength(n) < 0.5) n = {0, 0, 1};  // a point of no face; a glTF normal must have unit length
  return surface;
}

using Side = std::array<std::uint32_t, 2>;
// The sides of faces that only one face has, in its direction.
std::vector<Side> borderOf(const std::vector<Triangle>& faces) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& face : faces)
    for (std::size_t k = 0; k < 3; ++k) ++sides[std::minmax(face[k], face[(k + 1) % 3])];
  std::vector<Side> border;
  for (const Triangle& face : faces)
    for (std::size_t k = 0; k < 3; ++k)
      if (const Side side{face[k], face[(k + 1) % 3]}; sides[std::minmax(side[0], side[1])] == 1)
        border.push_back(side);
  return border;
}

// The thickness of cloth where it was cut: a strip along its border, as deep as the cloth is thick, away from the side
// that is seen. Its points come behind those of the cloth.
void addRim(Surface& surface, const std::vector<Side>& border, double thickness) {
  for (const auto& [from, to] : border) {
    const Vec3 aside = cross(surface.points[to] - surface.points[from], surface.normals[from]);
    const Vec3 out = squaredLength(aside) > 0 ? normalized(aside) : surface.normals[from];  // cloth lies at its left
    const auto base = static_cast<std::uint32_t>(surface.points.size());
    for (const std::uint32_t end : {from, to})
      for (const double deep : {0.0, thickness}) {
        surface.points.push_back(surface.points[end] - surface.normals[end] * deep);
        surface.normals.push_back(out);
        surface.flat.push_back(surface.flat[end]);
      }
    surface.faces.push_back({base, base + 1, base + 2});
    surface.faces.push_back({base + 2, base + 1, base + 3});
  }
}

// The same cloth seen from its other side.
Surface turned(Surface surface) {
  for (Triangle& face : surface.faces) std::swap(face[1], face[2]);
  for (Vec3& n : surface.normals) n = -n;
  return surface;
}

std::vector<float> differences(const std::vector<Vec3>& to, const std::vector<Vec3>& from) {
  std::vector<Vec3> all(to.size());
  for (std::size_t k = 0; k < to.size(); ++k) all[k] = to[k] - from[k];
  return floats(all);
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

namespace {

// The objects, materials and prints of a file as they come.
class GlbWriter {
 public:
  explicit GlbWriter(const std::vector<SpatialKeyframe>& motion) : motion_(motion) {
    DistinctNames taken;
    for (const SpatialKeyframe& key : motion)
      targetNames_.push_back(taken.give(key.name.empty() ? fixed(key.seconds, 2) + " s" : key.name));
  }

  Done add(const NamedMesh& object) {
    const auto material = materialOf(object);
    if (!material) return material.error();
    const bool thick = object.look && object.look->thickness > 0;
    const std::vector<Side> border = thick ? borderOf(object.mesh->faces) : std::vector<Side>();
    const SpatialLook::Wrong* wrong = object.look && object.look->wrong ? &*object.look->wrong : nullptr;
    // The right side with the rim, and the wrong side if that looks otherwise.
    const auto sidesAt = [&](const std::vector<Vec3>& points) {
      std::vector<Surface> sides{surfaceOf(points, object.mesh->faces, object.flat)};
      if (wrong) sides.push_back(turned(sides.front()));
      addRim(sides.front(), border, thick ? object.look->thickness : 0);
      return sides;
    };
    const std::vector<Surface> sides = sidesAt(object.mesh->points);
    Json primitives = Json::array();
    for (std::size_t side = 0; side < sides.size(); ++side)
      primitives.push_back(primitive(sides[side], object, side == 0 ? tileOf(object) : wrong->tile, *material + side));
    for (const std::vector<Vec3>* points : object.motion) {
      const std::vector<Surface> moved = sidesAt(*points);
      for (std::size_t side = 0; side < sides.size(); ++side)
        primitives[side]["targets"].push_back(
            {{"POSITION", buffer_.add(differences(moved[side].points, sides[side].points), 3, true)},
             {"NORMAL", buffer_.add(differences(moved[side].normals, sides[side].normals), 3, false)}});
    }
    Json mesh{{"name", object.name}, {"primitives", std::move(primitives)}};
    if (!motion_.empty()) {
      mesh["weights"] = std::vector<double>(motion_.size(), 0.0);
      mesh["extras"]["targetNames"] = targetNames_;  // Blender reads no morph target without one
    }
    nodes_.push_back({{"name", object.name}, {"mesh", meshes_.size()}});
    meshes_.push_back(std::move(mesh));
    return {};
  }

  bool empty() const { return nodes_.empty(); }
  Result<std::string> written() {
    Json root{{"asset", {{"version", "2.0"}, {"generator", "Karinui"}}}, {"scene", 0}};
    Json roots = Json::array();
    for (std::size_t k = 0; k < nodes_.size(); ++k) roots.push_back(k);
    root["scenes"] = Json::array({{{"name", "fitting"}, {"nodes", std::move(roots)}}});
    if (!motion_.empty()) root["animations"] = Json::array({animation()});
    root["nodes"] = nodes_;
    root["meshes"] = meshes_;
    root["materials"] = materials_;
    if (!textures_.empty()) {
      root["images"] = images_, root["textures"] = textures_;
      root["samplers"] = Json::array({{{"wrapS", 10497}, {"wrapT", 10497}, {"magFilter", 9729}, {"minFilter", 9987}}});
    }
    if (sheen_) root["extensionsUsed"].push_back("KHR_materials_sheen");
    if (!textures_.empty()) root["extensionsUsed"].push_back("KHR_texture_transform");
    root["accessors"] = buffer_.accessors;
    root["bufferViews"] = buffer_.views;
    root["buffers"] = Json::array({{{"byteLength", buffer_.bytes().size()}}});

    std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string numbers = buffer_.bytes();
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

 private:
  static std::optional<SpatialLook::Tile> tileOf(const NamedMesh& object) {
    return object.look ? object.look->tile : std::nullopt;
  }

  // One for each side of what looks alike, that of the wrong side behind that of the right one.
  Result<std::size_t> materialOf(const NamedMesh& object) {
    const auto alike = std::find_if(materialOf_.begin(), materialOf_.end(),
                                    [&](const auto& known) { return lookAlike(*known.first, object); });
    if (alike != materialOf_.end()) return alike->second;
    const std::size_t first = materials_.size();
    materialOf_.emplace_back(&object, first);
    const bool wrong = object.look && object.look->wrong;
    const std::string name = materialNames_.give(materialName(object));
    if (const Done done = addMaterial(name, object.colour, object.look, tileOf(object), object.look && !wrong); !done)
      return done.error();
    if (wrong)
      if (const Done done = addMaterial(materialNames_.give(name + "_wrong_side"), object.look->wrong->colour,
                                        object.look, object.look->wrong->tile, false);
          !done)
        return done.error();
    return first;
  }

  // `tile`: the side's print.
  Done addMaterial(const std::string& name, const std::array<float, 3>& colour, const SpatialLook* look,
                   const std::optional<SpatialLook::Tile>& tile, bool bothSides) {
    const double cover = look ? look->cover : 1;
    Json surface{{"baseColorFactor", {colour[0], colour[1], colour[2], cover}},
                 {"metallicFactor", 0.0},
                 {"roughnessFactor", look ? look->roughness : 0.6}};
    if (tile) {
      auto png = pngOf(*tile);
      if (!png) return png.error();
      images_.push_back({{"bufferView", buffer_.addFile(*png)}, {"mimeType", "image/png"}});
      textures_.push_back({{"source", images_.size() - 1}, {"sampler", 0}});
      // Coordinates are (u, 1 - v) in metres. A tile's v runs downwards from its top: (1 - v) / high + 1 - 1 / high
      // is a whole number where v is a whole number of repeats.
      surface["baseColorFactor"] = {1.0, 1.0, 1.0, cover};
      surface["baseColorTexture"] = {
          {"index", textures_.size() - 1},
          {"extensions",
           {{"KHR_texture_transform",
             {{"scale", {1 / tile->wide, 1 / tile->high}}, {"offset", {0.0, 1 - 1 / tile->high}}}}}}};
    }
    Json made{{"name", name}, {"doubleSided", bothSides}, {"pbrMetallicRoughness", std::move(surface)}};
    if (cover < 1) made["alphaMode"] = "BLEND";
    if (look && look->sheen > 0) {
      const double s = look->sheen;
      made["extensions"]["KHR_materials_sheen"] = {{"sheenColorFactor", {s * colour[0], s * colour[1], s * colour[2]}},
                                                   {"sheenRoughnessFactor", 0.5}};
      sheen_ = true;
    }
    materials_.push_back(std::move(made));
    return {};
  }

  Json primitive(const Surface& side, const NamedMesh& object, const std::optional<SpatialLook::Tile>& tile,
                 std::size_t material) {
    Json attributes;
    attributes["POSITION"] = buffer_.add(floats(side.points), 3, true);
    attributes["NORMAL"] = buffer_.add(floats(side.normals), 3, false);
    if (object.flat) {
      attributes["TEXCOORD_0"] = buffer_.add(textureCoordinates(tile ? onTile(*tile, side.flat) : side.flat), 2, false);
      if (tile) attributes["TEXCOORD_1"] = buffer_.add(textureCoordinates(side.flat), 2, false);  // the plain paper
    }
    std::vector<std::uint32_t> indices;
    for (const Triangle& face : side.faces) indices.insert(indices.end(), face.begin(), face.end());
    return {
        {"attributes", attributes}, {"indices", buffer_.add(indices, 1, true)}, {"material", material}, {"mode", 4}};
  }

  // Keyframe k has morph target k alone, the beginning none.
  Json animation() {
    const std::size_t count = motion_.size();
    std::vector<float> seconds{0}, weights(count, 0);
    const auto at = [&](double time, std::size_t target) {
      seconds.push_back(static_cast<float>(time));
      weights.resize(weights.size() + count, 0);
      weights[weights.size() - count + target] = 1;
    };
    for (std::size_t k = 0; k < count; ++k) {
      at(motion_[k].seconds, k);
      if (motion_[k].held > 0) at(motion_[k].seconds + motion_[k].held, k);
    }
    const std::size_t input = buffer_.add(seconds, 1, true), output = buffer_.add(weights, 1, false);
    Json channels = Json::array();
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      channels.push_back({{"sampler", 0}, {"target", {{"node", k}, {"path", "weights"}}}});
    return {{"name", "motion"},
            {"samplers", Json::array({{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}})},
            {"channels", std::move(channels)}};
  }

  const std::vector<SpatialKeyframe>& motion_;
  std::vector<std::string> targetNames_;
  Buffer buffer_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array();
  Json textures_ = Json::array(), images_ = Json::array();
  std::vector<std::pair<const NamedMesh*, std::size_t>> materialOf_;
  DistinctNames materialNames_;
  bool sheen_ = false;
};

}  // namespace

Result<std::string> writeGlb(const SpatialGarment& garment) {
  const auto named = namedMeshes(garment);
  if (!named) return named.error();
  GlbWriter writer(garment.motion);
  for (const NamedMesh& object : *named) {
    if (object.mesh->points.empty() || object.mesh->faces.empty()) continue;  // glTF has no empty accessor
    if (const Done done = writer.add(object); !done) return done.error();
  }
  if (writer.empty()) return refused(say("There is nothing to write: no body and no piece."));
  return writer.written();
}

}  // namespace karinui

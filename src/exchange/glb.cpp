// glTF 2.0, binary container (Khronos specification 2.0, sections 3 and 4.4): one JSON chunk, one chunk of numbers,
// every view of it aligned to four bytes.
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

void append32(std::string& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  out.append(reinterpret_cast<const char*>(&word), sizeof word);
}

}  // namespace

Result<std::string> writeGlb(const SpatialGarment& garment) {
  const auto named = namedMeshes(garment);
  if (!named) return named.error();
  Buffer buffer;
  Json nodes = Json::array(), meshes = Json::array(), materials = Json::array(), roots = Json::array();
  std::map<std::string, std::size_t> materialOf;
  for (const NamedMesh& object : *named) {
    if (object.mesh->points.empty() || object.mesh->faces.empty()) continue;  // glTF has no empty accessor
    const bool cloth = object.flat != nullptr;
    const std::string material = cloth ? "fabric " + object.fabric : "skin";
    if (materialOf.emplace(material, materials.size()).second)
      materials.push_back({{"name", material},
                           {"doubleSided", cloth},
                           {"pbrMetallicRoughness",
                            {{"baseColorFactor", {object.colour[0], object.colour[1], object.colour[2], 1.0}},
                             {"metallicFactor", 0.0},
                             {"roughnessFactor", cloth ? 0.9 : 0.6}}}});
    Json attributes;
    attributes["POSITION"] = buffer.add(floats(object.mesh->points), 3, true);
    std::vector<Vec3> normals = pointNormals(*object.mesh);
    for (Vec3& n : normals)
      if (squaredLength(n) < 0.5) n = {0, 0, 1};  // a point of no face; a glTF normal must have unit length
    attributes["NORMAL"] = buffer.add(floats(normals), 3, false);
    if (cloth) attributes["TEXCOORD_0"] = buffer.add(textureCoordinates(*object.flat), 2, false);
    std::vector<std::uint32_t> indices;
    for (const Triangle& face : object.mesh->faces) indices.insert(indices.end(), face.begin(), face.end());
    const std::size_t corners = buffer.add(indices, 1, true);
    roots.push_back(nodes.size());
    nodes.push_back({{"name", object.name}, {"mesh", meshes.size()}});
    meshes.push_back(
        {{"name", object.name},
         {"primitives",
          Json::array(
              {{{"attributes", attributes}, {"indices", corners}, {"material", materialOf[material]}, {"mode", 4}}})}});
  }
  if (nodes.empty()) return refused(say("There is nothing to write: no body and no piece."));
  Json root{{"asset", {{"version", "2.0"}, {"generator", "Karinui"}}}, {"scene", 0}};
  root["scenes"] = Json::array({{{"name", "fitting"}, {"nodes", roots}}});
  root["nodes"] = nodes;
  root["meshes"] = meshes;
  root["materials"] = materials;
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

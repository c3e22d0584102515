#include <tiny_gltf.h>

#include <array>
#include <cstring>
#include <optional>
#include <span>

#include "reader.h"

namespace karinui::import {
namespace {

constexpr int kDeepest = 64;
constexpr std::size_t kMostVisits = 100'000;  // of nodes: a node may be used by many parents, and those by many more

using Matrix = std::array<double, 16>;  // columns first, as in glTF
constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      for (int k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return c;
}

Matrix placementOf(const tinygltf::Node& node) {
  Matrix m = kIdentity;
  if (node.matrix.size() == 16) {
    std::copy(node.matrix.begin(), node.matrix.end(), m.begin());
    return m;
  }
  if (node.rotation.size() == 4) {
    const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    m = {1 - 2 * (y * y + z * z),
         2 * (x * y + w * z),
         2 * (x * z - w * y),
         0,
         2 * (x * y - w * z),
         1 - 2 * (x * x + z * z),
         2 * (y * z + w * x),
         0,
         2 * (x * z + w * y),
         2 * (y * z - w * x),
         1 - 2 * (x * x + y * y),
         0,
         0,
         0,
         0,
         1};
  }
  if (node.scale.size() == 3)
    for (int i = 0; i < 12; ++i) m[i] *= node.scale[i / 4];
  if (node.translation.size() == 3) std::copy(node.translation.begin(), node.translation.end(), m.begin() + 12);
  return m;
}

// The files beside the body that were handed over. What is asked for and not there is noted and refused.
struct SideFiles {
  const std::map<std::string, std::string>& have;
  std::set<std::string> missing;
};

tinygltf::FsCallbacks onlyHandedOver(SideFiles& files) {
  tinygltf::FsCallbacks callbacks{};
  callbacks.user_data = &files;
  callbacks.FileExists = [](const std::string&, void*) { return true; };
  callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
    SideFiles& side = *static_cast<SideFiles*>(user);
    const auto it = side.have.find(name);
    if (it == side.have.end()) {
      if (side.missing.size() < wire::kMostSideFiles) side.missing.insert(name);
      return false;
    }
    out->assign(it->second.begin(), it->second.end());
    return true;
  };
  return callbacks;
}

// The bytes of an accessor's elements, each of `elementBytes`, with the step between them; nothing if any lies outside.
struct Elements {
  const unsigned char* first = nullptr;
  std::size_t count = 0, step = 0;
};
std::optional<Elements> elementsOf(const tinygltf::Model& model, int index, std::size_t elementBytes) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) return std::nullopt;
  const tinygltf::Accessor& accessor = model.accessors[index];
  if (accessor.sparse.isSparse || accessor.bufferView < 0 ||
      static_cast<std::size_t>(accessor.bufferView) >= model.bufferViews.size())
    return std::nullopt;
  const tinygltf::BufferView& view = model.bufferViews[accessor.bufferView];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) return std::nullopt;
  const std::vector<unsigned char>& bytes = model.buffers[view.buffer].data;
  const std::size_t step = view.byteStride ? view.byteStride : elementBytes;
  // Each comparison leaves a difference that cannot wrap.
  if (view.byteOffset > bytes.size() || view.byteLength > bytes.size() - view.byteOffset ||
      accessor.byteOffset > view.byteLength || step < elementBytes)
    return std::nullopt;
  const std::size_t room = view.byteLength - accessor.byteOffset;
  if (accessor.count > 0 && (room < elementBytes || (accessor.count - 1) > (room - elementBytes) / step))
    return std::nullopt;
  return Elements{bytes.data() + view.byteOffset + accessor.byteOffset, accessor.count, step};
}

class Gatherer {
 public:
  Gatherer(const tinygltf::Model& model, const Limits& limits) : model_(model), limits_(limits) {}

  Reading gather() {
    struct Visit {
      int node, depth;
      Matrix from;
    };
    std::vector<Visit> pending;
    for (int root : roots()) pending.push_back({root, 1, kIdentity});
    for (std::size_t visits = 0; !pending.empty(); ++visits) {
      const Visit visit = pending.back();
      pending.pop_back();
      if (visit.depth > kDeepest || visits > kMostVisits || pending.size() > kMostVisits)
        return {wire::Reason::TooDeep, {}, {}};
      if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= model_.nodes.size())
        return {wire::Reason::Unreadable, {}, {}};
      const tinygltf::Node& node = model_.nodes[visit.node];
      const Matrix placed = product(visit.from, placementOf(node));
      if (node.mesh >= 0 && static_cast<std::size_t>(node.mesh) < model_.meshes.size())
        for (const tinygltf::Primitive& part : model_.meshes[node.mesh].primitives)
          if (const wire::Reason refused = add(part, placed); refused != wire::Reason::None) return {refused, {}, {}};
      for (int child : node.children) pending.push_back({child, visit.depth + 1, placed});
    }
    if (reading_.mesh.faces.empty()) reading_.refused = wire::Reason::NoSurface;
    return std::move(reading_);
  }

 private:
  std::vector<int> roots() const {
    if (!model_.scenes.empty()) {
      const bool chosen =
          model_.defaultScene >= 0 && static_cast<std::size_t>(model_.defaultScene) < model_.scenes.size();
      return model_.scenes[chosen ? model_.defaultScene : 0].nodes;
    }
    std::vector<bool> child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes)
      for (int c : node.children)
        if (c >= 0 && static_cast<std::size_t>(c) < child.size()) child[c] = true;
    std::vector<int> found;
    for (std::size_t i = 0; i < child.size(); ++i)
      if (!child[i]) found.push_back(static_cast<int>(i));
    return found;
  }

  wire::Reason add(const tinygltf::Primitive& part, const Matrix& placed) {
    if (part.mode != -1 && part.mode != TINYGLTF_MODE_TRIANGLES) return wire::Reason::None;  // lines, points, strips
    const auto position = part.attributes.find("POSITION");
    if (position == part.attributes.end()) return wire::Reason::None;
    const auto points = elementsOf(model_, position->second, 12);
    if (!points) return wire::Reason::Unreadable;
    const tinygltf::Accessor& kind = model_.accessors[position->second];
    if (kind.type != TINYGLTF_TYPE_VEC3 || kind.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
      return wire::Reason::Unsupported;
    TriangleMesh& mesh = reading_.mesh;
    const std::size_t base = mesh.points.size();
    if (points->count > limits_.points || base + points->count > limits_.points) return wire::Reason::TooLarge;
    for (std::size_t i = 0; i < points->count; ++i) {
      float p[3];
      std::memcpy(p, points->first + i * points->step, sizeof p);
      const auto row = [&](int r) {
        return placed[r] * p[0] + placed[4 + r] * p[1] + placed[8 + r] * p[2] + placed[12 + r];
      };
      mesh.points.push_back({row(0), row(1), row(2)});
    }
    return addFaces(part, base, points->count);
  }

  wire::Reason addFaces(const tinygltf::Primitive& part, std::size_t base, std::size_t count) {
    std::size_t bytes = 0, corners = count;
    std::optional<Elements> indices;
    if (part.indices >= 0) {
      if (static_cast<std::size_t>(part.indices) >= model_.accessors.size()) return wire::Reason::Unreadable;
      switch (model_.accessors[part.indices].componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
          bytes = 1;
          break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
          bytes = 2;
          break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
          bytes = 4;
          break;
        default:
          return wire::Reason::Unreadable;
      }
      indices = elementsOf(model_, part.indices, bytes);
      if (!indices) return wire::Reason::Unreadable;
      corners = indices->count;
    }
    TriangleMesh& mesh = reading_.mesh;
    if (corners / 3 > limits_.triangles || mesh.faces.size() + corners / 3 > limits_.triangles)
      return wire::Reason::TooLarge;
    for (std::size_t i = 0; i + 2 < corners; i += 3) {
      Triangle t;
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t index = static_cast<std::uint32_t>(i + k);
        if (indices) {
          index = 0;
          std::memcpy(&index, indices->first + (i + k) * indices->step, bytes);  // both little-endian
        }
        if (index >= count) return wire::Reason::Unreadable;
        t[k] = static_cast<std::uint32_t>(base + index);
      }
      mesh.faces.push_back(t);
    }
    return wire::Reason::None;
  }

  const tinygltf::Model& model_;
  const Limits& limits_;
  Reading reading_;
};

}  // namespace

Reading readGltf(const std::string& bytes, bool binary, const std::map<std::string, std::string>& sideFiles,
                 const Limits& limits) {
  if (bytes.size() > std::numeric_limits<unsigned>::max()) return {wire::Reason::TooLarge, {}, {}};
  SideFiles files{sideFiles, {}};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(onlyHandedOver(files));
  // Pictures are of no use here, and their decoders are the softest part of such a library.
  loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int,
                           void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned>(bytes.size());
  const bool read =
      binary
          ? loader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                        size, "", tinygltf::NO_REQUIRE)
          : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, "", tinygltf::NO_REQUIRE);
  if (!read && !files.missing.empty()) return {wire::Reason::None, files.missing, {}};
  if (!read) return {wire::Reason::Unreadable, {}, {}};
  return Gatherer(model, limits).gather();
}

}  // namespace karinui::import

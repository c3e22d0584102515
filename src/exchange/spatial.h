#pragma once
// What OBJ and GLB share: checked meshes, object names.
#include "karinui/exchange/spatial.h"

namespace karinui {

struct NamedMesh {
  std::string name;
  std::string fabric;  // or what else it is made of; empty: the body
  const TriangleMesh* mesh = nullptr;
  const std::vector<Flat>* flat = nullptr;  // null: no texture coordinates
  std::array<float, 3> colour{};
  const SpatialLook* look = nullptr;                  // null: the body, a button
  std::vector<const std::vector<Vec3>*> motion = {};  // its points in each keyframe
};

// The body first, then the pieces and the notions in their order, each under a name of its own.
Result<std::vector<NamedMesh>> namedMeshes(const SpatialGarment& garment);

// Of objects that look alike one is made.
bool lookAlike(const NamedMesh& a, const NamedMesh& b);
std::string materialName(const NamedMesh& object);
Result<std::string> pngOf(const SpatialLook::Tile& tile);

Done checkMesh(const TriangleMesh& mesh, std::string_view name);

}  // namespace karinui

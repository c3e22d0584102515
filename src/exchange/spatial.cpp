#include "spatial.h"

#include "names.h"
#include "strict_json.h"

namespace karinui {

namespace {

bool whole(const SpatialLook::Tile& tile) {
  return tile.width >= 1 && tile.height >= 1 && tile.width <= 4096 && tile.height <= 4096 && tile.wide > 0 &&
         tile.high > 0 &&
         tile.rgb.size() ==
             std::size_t{3} * static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height);
}

}  // namespace

bool lookAlike(const NamedMesh& a, const NamedMesh& b) {
  return a.fabric == b.fabric && a.colour == b.colour && !a.look == !b.look && (!b.look || *a.look == *b.look);
}

std::string materialName(const NamedMesh& object) {
  return object.flat ? "fabric " + object.fabric : object.fabric.empty() ? "skin" : object.fabric;
}

Done checkMesh(const TriangleMesh& mesh, std::string_view name) {
  for (const Vec3 p : mesh.points)
    if (!finite(p)) return badInput(say("\"{0}\" has a point that is nowhere (not a finite number).", shown(name)));
  for (const Triangle& face : mesh.faces)
    for (const std::uint32_t corner : face)
      if (corner >= mesh.points.size())
        return badInput(say("\"{0}\" has a triangle with a corner that is not there.", shown(name)));
  return {};
}

Result<std::vector<NamedMesh>> namedMeshes(const SpatialGarment& garment) {
  constexpr std::array<float, 3> kSkin{0.78f, 0.66f, 0.58f};
  std::vector<NamedMesh> out;
  DistinctNames taken{"body"};
  if (garment.body) {
    if (auto good = checkMesh(*garment.body, "body"); !good) return good.error();
    out.push_back({"body", "", &*garment.body, nullptr, kSkin, nullptr});
  }
  for (const SpatialPiece& piece : garment.pieces) {
    if (auto good = checkMesh(piece.mesh, piece.name); !good) return good.error();
    if (piece.flat.size() != piece.mesh.points.size())
      return badInput(say("\"{0}\" does not know where all its points are on paper.", shown(piece.name)));
    for (const auto& tile : {piece.look.tile, piece.look.wrong ? piece.look.wrong->tile : std::nullopt})
      if (tile && !whole(*tile))
        return badInput(say("The picture of the print on \"{0}\" is not whole.", shown(piece.name)));
    for (const Flat p : piece.flat)
      if (!finite(p))
        return badInput(say("\"{0}\" has a point that is nowhere (not a finite number).", shown(piece.name)));
    out.push_back({taken.give(oneWord(piece.name, "piece")), oneWord(piece.fabric, "fabric"), &piece.mesh, &piece.flat,
                   piece.colour, &piece.look});
  }
  for (const SpatialNotion& notion : garment.notions) {
    if (auto good = checkMesh(notion.mesh, notion.name); !good) return good.error();
    out.push_back({taken.give(oneWord(notion.name, "buttons")), oneWord(notion.material, "notion"), &notion.mesh,
                   nullptr, notion.colour, nullptr});
  }
  return out;
}

}  // namespace karinui

#include "spatial.h"

#include <algorithm>

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
  return object.flat ? "fabric_" + object.fabric : object.fabric.empty() ? "skin" : object.fabric;
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
    for (const SpatialKeyframe& key : garment.motion) out.back().motion.push_back(&key.body);
  }
  for (const SpatialKeyframe& key : garment.motion)
    if (key.pieces.size() != garment.pieces.size() || key.notions.size() != garment.notions.size())
      return badInput(say("A keyframe does not hold all of the garment."));
  for (std::size_t k = 0; k < garment.pieces.size(); ++k) {
    const SpatialPiece& piece = garment.pieces[k];
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
    for (const SpatialKeyframe& key : garment.motion) out.back().motion.push_back(&key.pieces[k]);
  }
  for (std::size_t k = 0; k < garment.notions.size(); ++k) {
    const SpatialNotion& notion = garment.notions[k];
    if (auto good = checkMesh(notion.mesh, notion.name); !good) return good.error();
    out.push_back({taken.give(oneWord(notion.name, "buttons")), oneWord(notion.material, "notion"), &notion.mesh,
                   nullptr, notion.colour, nullptr});
    for (const SpatialKeyframe& key : garment.motion) out.back().motion.push_back(&key.notions[k]);
  }
  for (const NamedMesh& object : out)
    for (const std::vector<Vec3>* points : object.motion)
      if (points->size() != object.mesh->points.size() ||
          !std::all_of(points->begin(), points->end(), [](Vec3 p) { return finite(p); }))
        return badInput(say("A keyframe does not hold all points of \"{0}\".", object.name));
  return out;
}

}  // namespace karinui

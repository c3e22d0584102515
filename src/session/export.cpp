#include "karinui/session/export.h"

#include <cmath>

#include "karinui/design/script.h"
#include "session/print_tile.h"

namespace karinui {

namespace {

Error nothingToWrite() { return refused(say("There is no piece yet; draw one on the body.")); }

// What a material of glTF says of the surface.
SpatialLook lookOf(const SceneCloth& cloth) {
  SpatialLook look;
  look.roughness = 0.92 - 0.62 * static_cast<double>(cloth.look.gloss);
  look.sheen = cloth.look.fuzz > 0.2f ? std::fmin(1.0, static_cast<double>(cloth.look.fuzz)) : 0;
  look.thickness = cloth.look.thickness;
  look.cover = static_cast<double>(cloth.look.cover);
  look.tile = printTile(cloth.look, cloth.colour);
  return look;
}

SheetSettings sheetOf(const GarmentSnapshot& snapshot, const ExportWish& wish) {
  SheetSettings sheet = wish.sheet;
  tellGarment(snapshot.document, sheet);
  return sheet;
}

}  // namespace

SpatialGarment spatialOf(const Document& document, const SceneFrame& frame) {
  SpatialGarment garment;
  if (!frame.bodies.empty()) garment.body = frame.bodies.front().mesh;
  for (const SceneCloth& cloth : frame.cloths)
    garment.pieces.push_back(
        {cloth.name, document.pieceNamed(cloth.name)->fabric, cloth.mesh, cloth.flat, cloth.colour, lookOf(cloth)});
  return garment;
}

Result<std::string> exported(const GarmentSnapshot& snapshot, const std::vector<Step>& steps, const ExportWish& wish) {
  const Pattern& pattern = snapshot.document.pattern;
  if (wish.format->out != FileContent::Script && pattern.pieces.empty()) return nothingToWrite();
  const auto script = [&] {
    std::string all;
    for (const Step& step : steps) all += text(step.operation) + "\n";
    return all;
  };
  const auto garment = [&]() -> Result<SpatialGarment> { return spatialOf(snapshot.document, snapshot.frame); };
  return wish.format->write({pattern, script, garment, sheetOf(snapshot, wish)});
}

Result<PaperPages> paperOf(const GarmentSnapshot& snapshot, const ExportWish& wish) {
  if (snapshot.document.pattern.pieces.empty()) return nothingToWrite();
  return PaperPages::of(snapshot.document.pattern, wish.format->paper, sheetOf(snapshot, wish));
}

}  // namespace karinui

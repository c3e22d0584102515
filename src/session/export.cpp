#include "karinui/session/export.h"

#include "karinui/design/script.h"

namespace karinui {

namespace {

SpatialGarment spatialOf(const GarmentSnapshot& snapshot) {
  SpatialGarment garment;
  if (snapshot.body) garment.body = snapshot.body->mesh();
  for (const SceneCloth& cloth : snapshot.frame.cloths)
    garment.pieces.push_back(
        {cloth.name, snapshot.document.pieceNamed(cloth.name)->fabric, cloth.mesh, cloth.flat, cloth.colour});
  return garment;
}

Error nothingToWrite() { return refused(say("There is no piece yet; draw one on the body.")); }

}  // namespace

Result<std::string> exported(const GarmentSnapshot& snapshot, const std::vector<Step>& steps, const ExportWish& wish) {
  const Pattern& pattern = snapshot.document.pattern;
  if (wish.format->out != FileContent::Script && pattern.pieces.empty()) return nothingToWrite();
  const auto script = [&] {
    std::string all;
    for (const Step& step : steps) all += text(step.operation) + "\n";
    return all;
  };
  const auto garment = [&]() -> Result<SpatialGarment> { return spatialOf(snapshot); };
  return wish.format->write({pattern, script, garment, wish.sheet});
}

Result<PaperPages> paperOf(const GarmentSnapshot& snapshot, const ExportWish& wish) {
  if (snapshot.document.pattern.pieces.empty()) return nothingToWrite();
  return PaperPages::of(snapshot.document.pattern, wish.format->paper, wish.sheet);
}

}  // namespace karinui

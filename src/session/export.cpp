#include "karinui/session/export.h"

#include <cmath>
#include <numbers>

#include "karinui/design/script.h"
#include "session/print_tile.h"
#include "session/standing_buttons.h"

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
  if (const auto& wrong = cloth.look.wrong) {
    ClothLook other = cloth.look;
    other.print = wrong->print, other.ink = wrong->ink;
    look.wrong = {wrong->colour, printTile(other, wrong->colour)};
  }
  return look;
}

// A button on the cloth: a round plate, its rim and its two sides with points of their own.
void addPlate(TriangleMesh& mesh, const StandingButton& button) {
  constexpr int kRound = 24;
  constexpr double kThick = 0.002;  // metres
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  constexpr auto kAll = static_cast<std::uint32_t>(kRound);
  for (const double high : {kThick, kThick, 0.0, 0.0})  // upper side, rim above, rim below, lower side
    for (int k = 0; k < kRound; ++k) {
      const double turn = 2 * std::numbers::pi * k / kRound;
      mesh.points.push_back(button.place + button.up() * high +
                            (button.out * std::cos(turn) + button.along * std::sin(turn)) * (button.size / 2));
    }
  for (std::uint32_t k = 0; k < kAll; ++k) {
    const std::uint32_t next = (k + 1) % kAll, above = base + kAll, below = base + 2 * kAll, low = base + 3 * kAll;
    if (k > 0 && next > 0) {
      mesh.faces.push_back({base, base + k, base + next});
      mesh.faces.push_back({low, low + next, low + k});
    }
    mesh.faces.push_back({below + k, below + next, above + k});
    mesh.faces.push_back({above + k, below + next, above + next});
  }
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
  constexpr std::array<float, 3> kShell{0.71f, 0.67f, 0.57f}, kMetal{0.10f, 0.11f, 0.12f};  // linear
  for (const StandingButton& button : standingButtons(document)) {
    const bool snap = button.kind == FasteningKind::Snap;
    if (garment.notions.empty() || garment.notions.back().name != button.fastening)
      garment.notions.push_back({button.fastening, snap ? "snaps" : "buttons", {}, snap ? kMetal : kShell});
    addPlate(garment.notions.back().mesh, button);
  }
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

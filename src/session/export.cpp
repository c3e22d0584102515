#include "karinui/session/export.h"

#include <algorithm>
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

// A row of topstitching: each stitch a spindle of six sides along the cloth, on both sides of which it is seen.
void addStitches(TriangleMesh& mesh, const SceneStitches& row, const TriangleMesh& cloth) {
  constexpr double kThick = 0.0008;  // metres: of the thread, and of the cloth it goes through
  const double stitch = row.stitchMm / 1000, step = stitch + row.gapMm / 1000;
  std::vector<Vec3> line;
  std::vector<double> at;
  for (const ClothPlace& place : row.line) {
    line.push_back(place.on(cloth.points));
    at.push_back(line.size() > 1 ? at.back() + distance(line[line.size() - 2], line.back()) : 0);
  }
  if (line.size() < 2) return;
  const auto on = [&](double s) {
    const auto k = std::clamp<std::size_t>(
        static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), s) - at.begin()), 1, line.size() - 1);
    const double part = at[k] - at[k - 1];
    return lerp(line[k - 1], line[k], part > 0 ? (s - at[k - 1]) / part : 0);
  };
  std::size_t near = 0;
  for (double s = 0; s + stitch <= at.back(); s += step) {
    const Vec3 from = on(s), to = on(s + stitch), middle = on(s + stitch / 2);
    while (near + 1 < at.size() && at[near + 1] < s) ++near;
    const Triangle& face = row.line[near].corners;
    const Vec3 up =
        normalized(cross(cloth.points[face[1]] - cloth.points[face[0]], cloth.points[face[2]] - cloth.points[face[0]]));
    const Vec3 aside = normalized(cross(up, to - from));
    const auto base = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(from), mesh.points.push_back(to);
    constexpr std::uint32_t kSides = 6;
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const double turn = 2 * std::numbers::pi * k / kSides;
      mesh.points.push_back(middle + (aside * std::cos(turn) + up * std::sin(turn)) * (kThick / 2));
    }
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const std::uint32_t here = base + 2 + k, next = base + 2 + (k + 1) % kSides;
      mesh.faces.push_back({base, next, here}), mesh.faces.push_back({base + 1, here, next});
    }
  }
}

SheetSettings sheetOf(const GarmentSnapshot& snapshot, const ExportWish& wish) {
  SheetSettings sheet = wish.sheet;
  tellGarment(snapshot.document, photosOf(snapshot), sheet);
  return sheet;
}

}  // namespace

SpatialGarment spatialOf(const Document& document, const SceneFrame& frame) {
  SpatialGarment garment;
  if (!frame.bodies.empty()) garment.body = frame.bodies.front().mesh;
  for (const SceneCloth& cloth : frame.cloths)
    garment.pieces.push_back(
        {cloth.name, document.pieceNamed(cloth.name)->fabric, cloth.mesh, cloth.flat, cloth.colour, lookOf(cloth)});
  for (const SceneCloth& cloth : frame.cloths) {
    if (!cloth.stitches.empty()) {
      SpatialNotion thread{cloth.name + "_topstitch", "thread", {}, cloth.stitches.front().colour};
      for (const SceneStitches& row : cloth.stitches) addStitches(thread.mesh, row, cloth.mesh);
      garment.notions.push_back(std::move(thread));
    }
    for (const SceneTrim& trim : cloth.trims)
      garment.notions.push_back({cloth.name + (trim.kind == SceneTrim::Kind::Cord ? "_piping" : "_binding"),
                                 trim.fabric, meshOf(trim, cloth.mesh), trim.colour});
  }
  constexpr std::array<float, 3> kShell{0.71f, 0.67f, 0.57f}, kMetal{0.10f, 0.11f, 0.12f};  // linear
  for (const StandingButton& button : standingButtons(document)) {
    const bool snap = button.kind == FasteningKind::Snap;
    if (garment.notions.empty() || garment.notions.back().name != button.fastening)
      garment.notions.push_back({button.fastening, snap ? "snaps" : "buttons", {}, snap ? kMetal : kShell});
    addPlate(garment.notions.back().mesh, button);
  }
  return garment;
}

namespace {

Result<std::string> writtenOut(const GarmentSnapshot& snapshot, const std::vector<Step>& steps, const ExportWish& wish,
                               const std::string& stem, std::vector<SideFile>* beside) {
  const Pattern& pattern = snapshot.document.pattern;
  if (wish.format->out != FileContent::Script && pattern.pieces.empty()) return nothingToWrite();
  const auto script = [&] {
    std::string all;
    for (const Step& step : steps) all += withShortLengths(text(step.operation)) + "\n";
    return all;
  };
  const auto garment = [&]() -> Result<SpatialGarment> { return spatialOf(snapshot.document, snapshot.frame); };
  return wish.format->write({pattern, script, garment, sheetOf(snapshot, wish), stem, beside});
}

}  // namespace

Result<std::string> exported(const GarmentSnapshot& snapshot, const std::vector<Step>& steps, const ExportWish& wish) {
  return writtenOut(snapshot, steps, wish, {}, nullptr);
}

Result<std::size_t> exportedTo(const std::filesystem::path& file, const GarmentSnapshot& snapshot,
                               const std::vector<Step>& steps, const ExportWish& wish) {
  std::vector<SideFile> beside;
  const Result<std::string> bytes = writtenOut(snapshot, steps, wish, file.stem().string(), &beside);
  if (!bytes) return bytes.error();
  if (const Done done = writeExport(file, *bytes, beside); !done) return done.error();
  return bytes->size();
}

Result<PaperPages> paperOf(const GarmentSnapshot& snapshot, const ExportWish& wish) {
  if (snapshot.document.pattern.pieces.empty()) return nothingToWrite();
  return PaperPages::of(snapshot.document.pattern, wish.format->paper, sheetOf(snapshot, wish));
}

}  // namespace karinui

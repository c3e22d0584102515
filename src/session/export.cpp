#include "karinui/session/export.h"

#include "karinui/design/script.h"
#include "karinui/exchange/garment_code.h"
#include "karinui/exchange/pattern_json.h"
#include "karinui/exchange/spatial.h"

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

PaperKind paperKindOf(ExportKind kind) { return kind == ExportKind::PdfA4 ? PaperKind::A4 : PaperKind::OneSheet; }

}  // namespace

std::span<const ExportInfo> exportKinds() {
  using Shows = ExportInfo::Shows;
  static const std::vector<ExportInfo> all{
      {ExportKind::PdfA4, "pdf", say("Paper pattern on A4 sheets (PDF)"),
       say("True size, for the printer at home: an overview, then sheets to be glued."), Shows::Paper},
      {ExportKind::PdfSheet, "pdf", say("Paper pattern on one sheet (PDF)"),
       say("True size, for a plotter or a print shop."), Shows::Paper},
      {ExportKind::Svg, "svg", say("Paper pattern as a drawing (SVG)"),
       say("True size, every piece and edge by its name, for drawing programs and cutters; Karinui reads it back."),
       Shows::Paper},
      {ExportKind::Glb, "glb", say("Garment in 3D (GLB)"),
       say("The garment on the body in one file with its colours, for viewers and the web."), Shows::Space},
      {ExportKind::Obj, "obj", say("Garment in 3D (OBJ)"),
       say("Body and pieces as plain meshes, for every 3D program; the flat pattern is their texture."), Shows::Space},
      {ExportKind::Json, "json", say("Pattern, exact (JSON)"),
       say("Every curve, seam and mark to the last digit, in Karinui's own open form."), Shows::Text},
      {ExportKind::GarmentCode, "json", say("Pattern for GarmentCode (JSON)"),
       say("Panels and stitches as GarmentCode writes them; inner lines and marks are left out."), Shows::Text},
      {ExportKind::Steps, "ops", say("The steps as text"),
       say("One operation a line: to be read, changed and played again."), Shows::Text},
  };
  return all;
}

const ExportInfo& info(ExportKind kind) {
  for (const ExportInfo& one : exportKinds())
    if (one.kind == kind) return one;
  KARINUI_ASSERT(false);
}

Result<std::string> exported(const GarmentSnapshot& snapshot, const std::vector<Step>& steps, const ExportWish& wish) {
  const Pattern& pattern = snapshot.document.pattern;
  if (wish.kind != ExportKind::Steps && pattern.pieces.empty())
    return refused(say("There is no piece yet; draw one on the body."));
  switch (wish.kind) {
    case ExportKind::PdfSheet:
    case ExportKind::PdfA4:
      return writePdf(pattern, paperKindOf(wish.kind), wish.sheet);
    case ExportKind::Svg:
      return writeSvg(pattern, wish.sheet);
    case ExportKind::Glb:
      return writeGlb(spatialOf(snapshot));
    case ExportKind::Obj:
      return writeObj(spatialOf(snapshot));
    case ExportKind::Json:
      return writePatternJson(pattern);
    case ExportKind::GarmentCode:
      return writeGarmentCode(pattern);
    case ExportKind::Steps:
      break;
  }
  std::string all;
  for (const Step& step : steps) all += text(step.operation) + "\n";
  return all;
}

Result<PaperPages> paperOf(const GarmentSnapshot& snapshot, const ExportWish& wish) {
  if (snapshot.document.pattern.pieces.empty()) return refused(say("There is no piece yet; draw one on the body."));
  return PaperPages::of(snapshot.document.pattern, paperKindOf(wish.kind), wish.sheet);
}

}  // namespace karinui

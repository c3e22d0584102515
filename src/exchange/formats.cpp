#include "karinui/exchange/formats.h"

#include <algorithm>
#include <cctype>

#include "karinui/base/file.h"
#include "karinui/exchange/drawing.h"
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/garment_code.h"
#include "karinui/exchange/hpgl.h"
#include "karinui/exchange/pattern_json.h"
#include "sheet.h"

namespace karinui {

namespace {

bool isPatternJson(std::string_view bytes) { return bytes.find("\"karinui-pattern-1\"") != std::string_view::npos; }

Result<std::string> writeGlbOf(const ExportSource& source) {
  const Result<SpatialGarment> garment = source.garment();
  return garment ? writeGlb(*garment) : garment.error();
}

Result<std::string> writeObjOf(const ExportSource& source) {
  const Result<SpatialGarment> garment = source.garment();
  if (!garment) return garment.error();
  return source.beside ? writeObj(*garment, source.stem, *source.beside) : writeObj(*garment);
}

Result<std::string> writeExact(const ExportSource& source) {
  const auto allowances = allowancesOn(source.pattern, source.sheet);
  if (!allowances) return allowances.error();
  return writePatternJson(source.pattern, *allowances ? &**allowances : nullptr, source.sheet.fabrics);
}

Result<CadPattern> readExact(std::string_view bytes, std::string_view size, double unit) {
  if (unit > 0) return badInput(unitIsTold());
  if (!size.empty()) return badInput(say("Such a file holds one size only."));
  CadPattern read;
  auto pattern = readPatternJson(bytes, &read.cutting.allowances, &read.fabrics);
  if (!pattern) return pattern.error();
  read.pattern = *std::move(pattern);
  leaveOutHoles(read);
  return read;
}

std::vector<FileFormat> allFormats() {
  using Content = FileContent;
  using Source = const ExportSource&;
  return {
      {.id = "document", .endings = {"karinui"}, .in = Content::Document, .out = Content::Document},
      {.id = "pdf-a4",
       .endings = {"pdf"},
       .out = Content::Sheet,
       .label = say("Paper pattern on A4 sheets (PDF)"),
       .about = say("True size, for the printer at home: a cover, then sheets to be glued."),
       .paper = PaperKind::A4,
       .write = [](Source from) { return writePdf(from.pattern, PaperKind::A4, from.sheet); }},
      {.id = "pdf",
       .endings = {"pdf"},
       .out = Content::Sheet,
       .label = say("Paper pattern on one sheet (PDF)"),
       .about = say("True size, for a plotter or a print shop."),
       .write = [](Source from) { return writePdf(from.pattern, PaperKind::OneSheet, from.sheet); }},
      {.id = "pdf-letter",
       .endings = {"pdf"},
       .out = Content::Sheet,
       .label = say("Paper pattern on Letter sheets (PDF)"),
       .about = say("True size, for the printer at home: a cover, then sheets of 8.5 × 11 inches to be glued."),
       .paper = PaperKind::Letter,
       .write = [](Source from) { return writePdf(from.pattern, PaperKind::Letter, from.sheet); }},
      {.id = "pdf-a3",
       .endings = {"pdf"},
       .out = Content::Sheet,
       .label = say("Paper pattern on A3 sheets (PDF)"),
       .about = say("True size, for a printer at the office: a cover, then sheets to be glued."),
       .paper = PaperKind::A3,
       .write = [](Source from) { return writePdf(from.pattern, PaperKind::A3, from.sheet); }},
      {.id = "pdf-a0",
       .endings = {"pdf"},
       .out = Content::Sheet,
       .label = say("Paper pattern on A0 sheets (PDF)"),
       .about = say("True size, for a copy shop, laid out in the width of A0."),
       .paper = PaperKind::A0,
       .write = [](Source from) { return writePdf(from.pattern, PaperKind::A0, from.sheet); }},
      {.id = "pdf-36in",
       .endings = {"pdf"},
       .out = Content::Sheet,
       .label = say("Paper pattern on 36-inch sheets (PDF)"),
       .about = say("True size, for a copy shop with paper of 36 × 48 inches, laid out in its width."),
       .paper = PaperKind::Inches36,
       .write = [](Source from) { return writePdf(from.pattern, PaperKind::Inches36, from.sheet); }},
      {.id = "svg",
       .endings = {"svg"},
       .in = Content::Pattern,
       .out = Content::Sheet,
       .label = say("Paper pattern as a drawing (SVG)"),
       .about = say("True size, every piece and edge by its name, for drawing programs and cutters; Karinui reads it "
                    "back."),
       .readSize = readDrawing,
       .write = [](Source from) { return writeSvg(from.pattern, from.sheet); }},
      {.id = "hpgl",
       .endings = {"plt"},
       .out = Content::Sheet,
       .label = say("Paper pattern for a plotter (HPGL)"),
       .about = say("True size, for pen plotters and cutters: plain lines, lettering in ASCII."),
       .write = [](Source from) { return writeHpgl(from.pattern, from.sheet); }},
      {.id = "glb",
       .endings = {"glb"},
       .in = Content::Body,
       .out = Content::Garment,
       .label = say("Garment in 3D (GLB)"),
       .about = say("The garment on the body in one file with its colours, for viewers and the web. With poses: View, "
                    "Fit in motion…"),
       .write = writeGlbOf},
      {.id = "obj",
       .endings = {"obj"},
       .in = Content::Body,
       .out = Content::Garment,
       .label = say("Garment in 3D (OBJ)"),
       .about =
           say("Body and pieces as plain meshes, for every 3D program; the flat pattern is their texture. Colours and "
               "prints are written in files beside it."),
       .write = writeObjOf},
      {.id = "gltf", .endings = {"gltf"}, .in = Content::Body},
      {.id = "ply", .endings = {"ply"}, .in = Content::Body},
      {.id = "karinui",
       .endings = {"json"},
       .in = Content::Pattern,
       .out = Content::Pattern,
       .label = say("Pattern, exact (JSON)"),
       .about = say("Every curve, seam and mark to the last digit, in Karinui's own open form."),
       .recognises = isPatternJson,
       .readSize = readExact,
       .write = writeExact},
      {.id = "garmentcode",
       .endings = {"json"},
       .in = Content::Pattern,
       .out = Content::Pattern,
       .label = say("Pattern for GarmentCode (JSON)"),
       .about = say(
           "Panels and stitches as GarmentCode writes them; inner lines, marks and holes, as those of darts with two "
           "points, are left out."),
       .readPattern = readGarmentCode,
       .write = [](Source from) { return writeGarmentCode(from.pattern); }},
      {.id = "dxf-aama",
       .endings = {"dxf"},
       .in = Content::Pattern,
       .out = Content::Pattern,
       .label = say("Pattern for the cutting room (DXF AAMA)"),
       .about = say("Cut lines, seam lines, notches and grain on numbered layers, as industrial CAD, CLO and plotters "
                    "read them."),
       .readSize = readCadPattern,
       .write = [](Source from) { return writeDxf(from.pattern, DxfDialect::Aama, from.sheet); }},
      {.id = "dxf-astm",
       .endings = {"dxf"},
       .out = Content::Pattern,
       .label = say("Pattern for the cutting room (DXF ASTM)"),
       .about = say("The same in the younger dialect, with a second drawing of every curve."),
       .write = [](Source from) { return writeDxf(from.pattern, DxfDialect::Astm, from.sheet); }},
      {.id = "rul",
       .endings = {"rul"},
       .out = Content::Pattern,
       .label = say("Grade rules (RUL, beta)"),
       .about = say("How far each numbered point of the DXF goes in each size, for the CAD of the cutting room."),
       .write = [](Source from) { return writeGradeRules(from.pattern, from.sheet); }},
      {.id = "ops",
       .endings = {"ops"},
       .in = Content::Script,
       .out = Content::Script,
       .label = say("The steps as text"),
       .about = say("One operation a line: to be read, changed and played again."),
       .write = [](Source from) -> Result<std::string> { return from.script(); }},
      {.id = "measures",
       .endings = {"measures"},
       .in = Content::Measures,
       .out = Content::Measures,
       .readMeasures = readMeasuresText,
       .writeMeasures = writeMeasuresText},
      {.id = "valentina",
       .endings = {"vit"},
       .in = Content::Measures,
       .out = Content::Measures,
       .readMeasures = readValentina,
       .writeMeasures = writeVit},
      {.id = "seamly",
       .endings = {"smis"},
       .in = Content::Measures,
       .out = Content::Measures,
       .readMeasures = readValentina,
       .writeMeasures = writeSmis},
      {.id = "valentina-sizes", .endings = {"vst", "smms"}, .in = Content::Measures, .readMeasures = readValentina},
      {.id = "freesewing",
       .endings = {"yaml", "yml"},
       .in = Content::Measures,
       .out = Content::Measures,
       .readMeasures = readMeasuresYaml,
       .writeMeasures = writeFreeSewing},
      {.id = "png", .endings = {"png"}, .out = Content::Picture},
  };
}

template <class Wanted>
std::vector<const FileFormat*> rowsWhere(FormatTable table, const Wanted& wanted) {
  std::vector<const FileFormat*> rows;
  for (const FileFormat& row : table)
    if (wanted(row)) rows.push_back(&row);
  return rows;
}

std::vector<std::string> endingsOf(const std::vector<const FileFormat*>& rows) {
  std::vector<std::string> all;
  for (const FileFormat* row : rows)
    for (const std::string_view ending : row->endings)
      if (std::find(all.begin(), all.end(), ending) == all.end()) all.emplace_back(ending);
  return all;
}

Message named(FileContent content, const std::string& endings) {
  switch (content) {
    case FileContent::Document:
      return say("documents ({0})", endings);
    case FileContent::Body:
      return say("bodies ({0})", endings);
    case FileContent::Pattern:
      return say("patterns ({0})", endings);
    case FileContent::Script:
      return say("scripts of operations ({0})", endings);
    case FileContent::Measures:
      return say("measures ({0})", endings);
    default:
      KARINUI_ASSERT(false);  // the others are only written
  }
}

}  // namespace

std::string endingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending.empty() ? ending : ending.substr(1);
}

FormatTable fileFormats() {
  static const std::vector<FileFormat> all = allFormats();
  return all;
}

const FileFormat& fileFormat(std::string_view id) {
  for (const FileFormat& row : fileFormats())
    if (row.id == id) return row;
  KARINUI_ASSERT(false);
}

std::vector<const FileFormat*> exportFormats(FormatTable table) {
  return rowsWhere(table, [](const FileFormat& row) { return row.write != nullptr; });
}

bool isPaper(const FileFormat& format) { return format.out == FileContent::Sheet && format.id != "svg"; }

bool hasEnding(const std::filesystem::path& file, const FileFormat& format) {
  const std::string ending = endingOf(file);
  return std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end();
}

std::filesystem::path withEnding(const std::filesystem::path& file, const FileFormat& format) {
  if (hasEnding(file, format)) return file;
  std::filesystem::path named = file;
  return named += "." + std::string(format.endings.front());
}

std::vector<const FileFormat*> formatsReading(const std::filesystem::path& file, FormatTable table) {
  return rowsWhere(table, [&](const FileFormat& row) { return row.in != FileContent::None && hasEnding(file, row); });
}

std::vector<const FileFormat*> formatsWriting(const std::filesystem::path& file, FormatTable table) {
  return rowsWhere(table, [&](const FileFormat& row) { return row.write && hasEnding(file, row); });
}

FileContent contentOf(const std::filesystem::path& file, FormatTable table) {
  const auto rows = formatsReading(file, table);
  return rows.empty() ? FileContent::None : rows.front()->in;
}

std::vector<std::string> endingsRead(FileContents contents, FormatTable table) {
  return endingsOf(rowsWhere(table, [&](const FileFormat& row) {
    return std::find(contents.begin(), contents.end(), row.in) != contents.end();
  }));
}

std::vector<std::string> endingsWritten(FormatTable table) { return endingsOf(exportFormats(table)); }

std::vector<std::string> measureEndingsWritten(FormatTable table) {
  return endingsOf(rowsWhere(table, [](const FileFormat& row) { return row.writeMeasures != nullptr; }));
}

std::string listed(const std::vector<std::string>& endings) {
  std::string all;
  for (const std::string& ending : endings) all += (all.empty() ? "." : ", .") + ending;
  return all;
}

Message listRead(FileContents contents, FormatTable table) {
  Message all;
  for (const FileContent content : contents) {
    const Message one = named(content, listed(endingsRead({content}, table)));
    all = all.empty() ? one : say("{0}, {1}", all, one);
  }
  return all;
}

Done writeExport(const std::filesystem::path& file, std::string_view bytes, const std::vector<SideFile>& beside) {
  for (const SideFile& one : beside)
    if (const Done done = writeFile(file.parent_path() / one.name, one.bytes); !done) return done;
  return writeFile(file, bytes);
}

Error unreadable(const std::filesystem::path& file, FileContents contents, FormatTable table) {
  return badInput(say("“{0}” has none of the endings that are read here: {1}.", file.filename().string(),
                      listRead(contents, table)));
}

Error unwritable(const std::filesystem::path& file, FormatTable table) {
  return badInput(say("“{0}” has none of the endings that are written: {1}.", file.filename().string(),
                      listed(endingsWritten(table))));
}

}  // namespace karinui

#pragma once
// Every kind of file there is, one row each. The command, the studio's dialogs and dropped files, the session and the
// help ask this table; no other place decides by a file's ending. A new format is one row of src/exchange/formats.cpp
// (docs/develop/howto.md). Endings are compared in any letter case. Lookups take the table, so that a test can try a
// row of its own. Pure, but for what opens a file; any thread.
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/exchange/measurement_files.h"
#include "karinui/exchange/sheet.h"
#include "karinui/exchange/spatial.h"

namespace karinui {

enum class FileContent {
  None,
  Document,  // the operations with everything kept: DocumentFile (design/history.h)
  Body,      // a surface to make clothes on: readBody() reads all of them, in a process of its own
  Pattern,   // outlines, seams, marks
  Measures,  // of a person: readMeasures() (measurement_files.h)
  Script,    // operations as text: parseScript() (design/script.h)
  Sheet,     // the pattern laid out on paper at true size
  Garment,   // body and cloth as shapes in space
  Picture,   // writePng() (view/image.h)
};

// What there is of a garment when it is written. A writer takes what its format holds.
struct ExportSource {
  const Pattern& pattern;
  std::function<std::string()> script;              // the operations, one a line
  std::function<Result<SpatialGarment>()> garment;  // called by formats of shapes in space only
  SheetSettings sheet;
  // Of the file, without its ending, and what is to be written beside it; null: nothing is, and the file names none.
  std::string stem = {};
  std::vector<SideFile>* beside = nullptr;
};
// Writes an export with what stands beside it. The file itself comes last.
Done writeExport(const std::filesystem::path& file, std::string_view bytes, const std::vector<SideFile>& beside);

struct FileFormat;
bool isPaper(const FileFormat& format);  // to be cut by: PDF and plotter; a drawing (SVG) is read back piece by piece

struct CadPattern;     // exchange/dxf.h
Message unitIsTold();  // the refusal of a unit for a file that always tells its own

struct FileFormat {
  std::string_view id;                    // of one row only: "garmentcode"
  std::vector<std::string_view> endings;  // lower case, without the dot; the first is given to files that are written
  FileContent in = FileContent::None;     // read as; None: not read
  FileContent out = FileContent::None;    // written as; None: not written
  Message label = {}, about = {};         // of what is written: a few words; whom it is for
  PaperKind paper = PaperKind::OneSheet;  // of a sheet that has pages
  // Of patterns, from the file's bytes. Several formats may share an ending: the first row whose `recognises` says yes
  // (or that has none) reads the file, or else the last row, which then tells what is wrong.
  Result<Pattern> (*readPattern)(std::string_view bytes) = nullptr;
  bool (*recognises)(std::string_view bytes) = nullptr;
  // In place of readPattern, of files that hold more than a pattern: sizes, of which one is read, or the sample size
  // (empty); how often pieces are cut; seam allowances. `unit`: metres of a unit of the file where somebody said it, 0:
  // as the file tells.
  Result<CadPattern> (*readSize)(std::string_view bytes, std::string_view size, double unit) = nullptr;
  // The bytes of the file. Null where another module writes it: documents and pictures.
  Result<std::string> (*write)(const ExportSource& source) = nullptr;
  // Of measures. JSON of measures is no row of its own: readMeasures() takes it where measures are asked for.
  Result<MeasuresRead> (*readMeasures)(std::string_view bytes) = nullptr;
  std::string (*writeMeasures)(const Measurements& measures) = nullptr;
};
using FormatTable = std::span<const FileFormat>;

FormatTable fileFormats();
const FileFormat& fileFormat(std::string_view id);  // of fileFormats(); it must be there
// The rows that are written from an ExportSource, in the order in which they are offered.
std::vector<const FileFormat*> exportFormats(FormatTable table = fileFormats());

std::string endingOf(const std::filesystem::path& file);  // as the table writes it: lower case, without the dot
bool hasEnding(const std::filesystem::path& file, const FileFormat& format);
// The file with the format's ending put behind its name where it has none of the format's.
std::filesystem::path withEnding(const std::filesystem::path& file, const FileFormat& format);

// The rows a file of this name may be read by, or written as; in the table's order.
std::vector<const FileFormat*> formatsReading(const std::filesystem::path& file, FormatTable table = fileFormats());
std::vector<const FileFormat*> formatsWriting(const std::filesystem::path& file, FormatTable table = fileFormats());
// What a file of this name is read as; None: it is not read.
FileContent contentOf(const std::filesystem::path& file, FormatTable table = fileFormats());

// Each ending once, without the dot, in the table's order.
using FileContents = std::initializer_list<FileContent>;
inline constexpr FileContents kAllRead{FileContent::Document, FileContent::Body, FileContent::Pattern,
                                       FileContent::Script};
std::vector<std::string> endingsRead(FileContents contents = kAllRead, FormatTable table = fileFormats());
std::vector<std::string> endingsWritten(FormatTable table = fileFormats());
std::vector<std::string> measureEndingsWritten(FormatTable table = fileFormats());
// ".obj, .ply, .gltf, .glb"
std::string listed(const std::vector<std::string>& endings);
// "bodies (.obj, .ply), scripts (.ops)"
Message listRead(FileContents contents = kAllRead, FormatTable table = fileFormats());
// The refusal of a file whose ending is not that of any of the contents; lists what can be read instead.
Error unreadable(const std::filesystem::path& file, FileContents contents = kAllRead,
                 FormatTable table = fileFormats());
Error unwritable(const std::filesystem::path& file, FormatTable table = fileFormats());

}  // namespace karinui

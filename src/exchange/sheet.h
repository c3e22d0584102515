#pragma once
// A sheet of pieces, ready to be drawn: everything in millimetres, x to the right, y down, from the sheet's top left.
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "karinui/exchange/sheet.h"
#include "karinui/pattern/markings.h"

namespace karinui {

struct Mm {
  double x = 0, y = 0;
};
inline Mm operator+(Mm a, Mm b) { return {a.x + b.x, a.y + b.y}; }
inline Mm operator-(Mm a, Mm b) { return {a.x - b.x, a.y - b.y}; }
inline Mm operator*(Mm a, double s) { return {a.x * s, a.y * s}; }

struct SheetStroke {
  Mm from, to;
};
struct SheetText {  // centred on its place
  Mm place;
  double size = 4;      // mm, of the font
  bool upright = true;  // else turned to read from below upwards
  std::string words;    // UTF-8
};
struct SheetNotch {
  SheetStroke stroke;
  std::string seam;     // its name; none for a notch of the person's own
  bool corner = false;  // of the outline, which marks the place by itself
};

struct SheetSize {  // the piece in another size, over the one that stands
  std::size_t size = 0;
  std::vector<Mm> line;  // it is cut along
  SheetText name;        // where it lies farthest from the others
};
// Strokes and gaps in mm, as long as there are eight sizes of their own each.
std::vector<double> dashesOf(std::size_t size);

struct SheetStitches {  // a row of topstitching
  std::vector<Mm> line;
  double length = 3;  // mm, of a stitch and the gap behind it
  std::vector<double> dashes() const { return {length * (1 - kStitchGap), length * kStitchGap}; }
};

inline constexpr double kTrimDashes[] = {6, 1.5, 0.5, 1.5};  // mm, along pipings and bindings

inline constexpr int kTopstitchLayer = 16;  // of DXF: beyond those of AAMA and ASTM D6673

struct SheetPiece {
  const Piece* piece = nullptr;
  Mm origin;                                 // where the paper's (0, 0) lies
  std::vector<std::vector<Mm>> cutLines;     // round the outline, then in the holes
  std::map<std::string, double> allowances;  // mm, of each edge; empty: seam lines only
  std::vector<SheetSize> nest;
  std::set<std::size_t> foldedHoles;  // darts with two points: marked, not cut
  bool strip = false;                 // of Sheet::strips, not of the pattern
  std::vector<SheetNotch> notches;
  std::vector<SheetStitches> stitches;
  std::vector<std::vector<Mm>> trims;  // the inner sides of pipings and bindings
  std::vector<SheetText> texts;        // `labels` of them: name, what to cut, size and date; then the seams' numbers
  std::size_t labels = 0;
  std::optional<SheetStroke> grain;
  std::vector<Mm> drills;
  std::vector<std::vector<Mm>> folds;  // brackets along edges laid on the fold; both ends bear an arrow head
  Mm low, high;                        // of all that is drawn of it

  Mm at(Flat paper) const { return {origin.x + paper.u * 1000, origin.y - paper.v * 1000}; }
};

std::vector<std::string> orderLines(const SheetSettings& settings);  // with its heading; empty: nothing is sewn

void moveBy(SheetPiece& piece, Mm by);  // with all that is drawn of it

// Layers as in the DXF of the trade (interop of AAMA); topstitching, which has no number there, on the next one.
enum class SheetLayer {
  Boundary = 1,
  Notch = 4,
  Grain = 7,
  Inner = 8,
  CutOut = 11,
  Drill = 13,
  Seam = 14,
  Words = 15,
  Topstitch = kTopstitchLayer
};
using SheetLine = std::function<void(SheetLayer layer, const std::vector<Mm>& points, bool closed)>;
void eachLine(const SheetPiece& piece, const SheetLine& line);  // of one size

struct Sheet {
  double width = 0, height = 0;
  std::string title;
  std::vector<SheetPiece> pieces;
  std::vector<std::shared_ptr<const Piece>> strips;  // to be cut for bindings and piping, among the pieces
  Mm square;                                         // top left of the 100 mm square
  std::vector<SheetText> headings;                   // beside it; these begin at their place
  std::vector<std::vector<Mm>> borders;              // of the cloth that the pieces lie on
  std::vector<std::string> sizes;                    // of the nests; empty: there are none
};
inline constexpr double kSquare = 100;  // mm

// Refused: an empty pattern, an absurd allowance.
Result<Sheet> layOut(const Pattern& pattern, const SheetSettings& settings);

// Of what is printed; nothing: seam lines only. Refused: an absurd width.
Result<std::optional<AllowancePlan>> allowancesOn(const Pattern& pattern, const SheetSettings& settings);

// Of the widths that a file tells of every edge those that are not as usual.
Allowances ownWidths(const Pattern& pattern, Allowances told);
struct CadPattern;
// No step says how wide the allowance of a hole is; a note says that it is left out.
void leaveOutHoles(CadPattern& read);

// A sheet drawn as a file. Sheets begin a page each; one that is longer than a page of PDF may be goes on on the next.
Result<std::string> pdfOf(const std::vector<const Sheet*>& sheets, PaperKind paper, const SheetSettings& settings);
std::string svgOf(const Sheet& sheet, const Pattern* sewing);  // null: not to be read back
std::string dxfOf(const Sheet& sheet);   // plain lines on the numbered layers of the trade, in place
std::string hpglOf(const Sheet& sheet);  // for plotters and cutters; x along the roll

}  // namespace karinui

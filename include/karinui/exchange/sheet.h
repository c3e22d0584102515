#pragma once
// The flat pieces as a person cuts them: laid side by side at true size on one sheet, with seam lines, seam allowance,
// notches, grain arrows and names. SVG and PDF are two ways of drawing one sheet. Pure; any thread.
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/base/result.h"
#include "karinui/design/document.h"
#include "karinui/design/print_match.h"

namespace karinui {

struct SheetSettings {
  std::string title = "Karinui";
  Allowances allowances;                  // of the garment, like the next: tellGarment()
  std::map<PieceId, Cutting> cutting;     // of pieces that are cut more than once
  Grading grading;                        // its sizes
  std::map<std::string, Fabric> fabrics;  // that it is cut from
  std::vector<MatchMark> matches;         // where the lines of its print cross seams
  std::vector<Message> order;             // in which it is sewn, a sentence each
  bool nest = false;                      // all sizes over one another, not only the one that stands
  bool pairsOnce = false;                 // of pieces that are each other's mirror image one, to be cut in pairs
  Message size;                           // that stands, or of the figure; empty: not told
  std::string date;                       // of the print, as it is to be read; empty: not told
  std::optional<double> allowance;        // metres, of seams, in place of the garment's own; 0: seam lines only
  double rollWidth = 0.900;               // metres; the sheet is wider only if a piece is
  double overlap = 0.010;                 // metres of the strip by which pages are glued
  Language language = Language::English;  // of the words around the names
};

// What the document says of its sheet. `tall`: of the photographs its fabrics are printed with.
void tellGarment(const Document& document, const PhotoTall& tall, SheetSettings& settings);

// One SVG drawing, its width and height in mm and its viewBox the same numbers. Every piece is a group with its name,
// every edge a path of its own with its name, so that the drawing can be read back.
Result<std::string> writeSvg(const Pattern& pattern, const SheetSettings& settings = {});

// Reads a drawing written by writeSvg: outlines, holes, internal lines, marks, grain, fabric, seams. Where pieces stand
// in space is not in a drawing: they come back flat, at the origin. Other drawings are refused. `allowances`: widths of
// edges that are not as usual. `fabrics`: those whose values are told.
Result<Pattern> readSvg(std::string_view svg, Allowances* allowances = nullptr,
                        std::map<std::string, Fabric>* fabrics = nullptr);

enum class PaperKind {
  OneSheet,  // one page as large as the sheet, for a plotter or a print shop
  // A cover, then pages to be glued, named by row letter and column number; empty ones are left out.
  A4,
  Letter,
  A3,
  A0,        // of a copy shop: no cover,
  Inches36,  // nor of 36 by 48 inches; the pieces are laid out in their width
};
// A PDF at true size that asks viewers not to scale it; no author and no date. Text is embedded in a font that has its
// characters, if the machine has one. The kinds of lines are layers.
Result<std::string> writePdf(const Pattern& pattern, PaperKind paper = PaperKind::OneSheet,
                             const SheetSettings& settings = {});

// The pages of writePdf(), to be looked at or sent to a printer: the same drawing, at any fineness.
class PaperPages {
 public:
  static Result<PaperPages> of(const Pattern& pattern, PaperKind paper, const SheetSettings& settings = {});
  std::size_t count() const;
  Flat size(std::size_t page) const;  // metres
  // A window of a page at this many pixels a metre, from its top left: rows of 0xffRRGGBB, white where nothing is
  // drawn.
  std::vector<std::uint32_t> draw(std::size_t page, double pixelsPerMetre, int left, int top, int width,
                                  int height) const;

 private:
  struct Inside;
  std::shared_ptr<const Inside> inside_;
};

}  // namespace karinui

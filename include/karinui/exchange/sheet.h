#pragma once
// The flat pieces as a person cuts them: laid side by side at true size on one sheet, with seam lines, seam allowance,
// notches, grain arrows and names. SVG and PDF are two ways of drawing one sheet. Pure; any thread.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/base/result.h"
#include "karinui/pattern/allowance.h"

namespace karinui {

struct SheetSettings {
  std::string title = "Karinui";
  Allowances allowances;                  // of the garment
  std::optional<double> allowance;        // metres, of seams, in place of the garment's own; 0: seam lines only
  double rollWidth = 0.900;               // metres; the sheet is wider only if a piece is
  Language language = Language::English;  // of the words around the names
};

// One SVG drawing, its width and height in mm and its viewBox the same numbers. Every piece is a group with its name,
// every edge a path of its own with its name, so that the drawing can be read back.
Result<std::string> writeSvg(const Pattern& pattern, const SheetSettings& settings = {});

// Reads a drawing written by writeSvg: outlines, holes, internal lines, marks, grain, fabric, seams. Where pieces stand
// in space is not in a drawing: they come back flat, at the origin. Other drawings are refused.
Result<Pattern> readSvg(std::string_view svg);

enum class PaperKind {
  OneSheet,  // one page as large as the sheet, for a plotter or a print shop
  A4,        // an overview, then pages to be glued, named by row letter and column number; empty ones are left out
};
// A PDF at true size that asks viewers not to scale it; no author and no date. Text is embedded in a font that has its
// characters, if the machine has one.
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

#pragma once
// A PDF being drawn, in millimetres, y down. Thin wrapping of cairo: true-size pages, strokes, text in a font that has
// its characters. One thread at a time.
#include <cairo.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "sheet.h"

namespace karinui {

class PdfCanvas {
 public:
  struct Drop {
    void operator()(cairo_t* c) const { cairo_destroy(c); }
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  };
  using Surface = std::unique_ptr<cairo_surface_t, Drop>;
  struct Page {  // what was drawn on it, in millimetres
    Surface drawn;
    double width = 0, height = 0;
  };

  PdfCanvas(double widthMm, double heightMm, const std::string& title);
  PdfCanvas() = default;  // writes nothing: takePages()

  void begin(double widthMm, double heightMm);  // a new page, empty
  void end();
  void push(Mm low, Mm high,
            Mm shift);  // until pop: only what lies within is drawn, and everything is moved by `shift`
  void pop();

  void colour(double grey);
  void stroke(double width, bool dashed);  // what was drawn since the last stroke
  void fill();
  void moveTo(Mm p);
  void lineTo(Mm p);
  void curve(const SheetPiece& piece, const Curve& curve);  // from where the pen is
  void close();
  void circle(Mm centre, double radius);
  void words(const SheetText& text, bool centred);

  Result<std::string> finish();  // the bytes; the canvas is used up
  std::vector<Page> takePages() { return std::move(pages_); }

 private:
  std::string bytes_;
  std::vector<Page> pages_;
  Surface surface_;  // null: pages are kept instead
  std::unique_ptr<cairo_t, Drop> cairo_;
};

// Asks viewers to print at true size: a new catalogue at the end of the file (PDF 1.7, 7.5.6 and 12.2).
std::string withoutPrintScaling(std::string pdf);

}  // namespace karinui

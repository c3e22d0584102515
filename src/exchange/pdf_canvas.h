#pragma once
// A PDF being drawn, in millimetres, y down. Thin wrapping of cairo: true-size pages, strokes, text in a font that has
// its characters. One thread at a time.
#include <cairo.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "sheet.h"

namespace karinui {

// What a viewer shows or hides; Page is always shown.
enum class PdfLayer { Page, Cut, Seam, Inner, Topstitch, Notch, Grain, Words, FirstSize };
inline constexpr PdfLayer kPdfLayers[] = {PdfLayer::Page,      PdfLayer::Cut,   PdfLayer::Seam,  PdfLayer::Inner,
                                          PdfLayer::Topstitch, PdfLayer::Notch, PdfLayer::Grain, PdfLayer::Words};
inline PdfLayer layerOfSize(std::size_t size) {
  return static_cast<PdfLayer>(static_cast<std::size_t>(PdfLayer::FirstSize) + size);
}

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

  void layer(PdfLayer layer) { layer_ = layer; }  // of what is drawn next
  void only(PdfLayer layer) { only_ = layer; }    // what is of another layer is left out
  void colour(double grey);
  void stroke(double width, bool dashed);  // what was drawn since the last stroke
  void stroke(double width, const std::vector<double>& dashes);
  void fill();
  void moveTo(Mm p);
  void lineTo(Mm p);
  void line(std::span<const Mm> points);                    // from the first on
  void curve(const SheetPiece& piece, const Curve& curve);  // from where the pen is
  void close();
  void circle(Mm centre, double radius);
  void words(const SheetText& text, bool centred);
  double wide(const std::string& words, double size) const;  // of the lettering, mm
  // Of rows of four bytes a pixel (red, green, blue, opacity), `wide` mm across.
  void picture(Mm low, double wide, int width, int height, std::span<const std::uint8_t> rgba);

  // The bytes, the canvas is used up. Each page was drawn once for each of kPdfLayers, then of the sizes.
  Result<std::string> finish(Language language, const std::vector<std::string>& sizes = {});
  Result<std::string> finishPlain();  // of pages that were drawn once, without layers
  std::vector<Page> takePages() { return std::move(pages_); }

 private:
  bool shown() const { return !only_ || *only_ == layer_; }
  PdfLayer layer_ = PdfLayer::Page;
  std::optional<PdfLayer> only_;
  std::string bytes_;
  std::vector<Page> pages_;
  Surface surface_;  // null: pages are kept instead
  std::unique_ptr<cairo_t, Drop> cairo_;
};

}  // namespace karinui

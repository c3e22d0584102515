// The sheet on paper: one page of its own size, or pages to be glued.
#include <algorithm>
#include <cmath>
#include <functional>

#include "page_nest.h"
#include "pdf_canvas.h"
#include "pdf_tiles.h"
#include "sheet.h"

namespace karinui {
namespace {

constexpr double kLargestPage = 5000;  // mm; PDF ends at 14400 points

void drawOutline(PdfCanvas& canvas, const SheetPiece& piece, const Outline& outline) {
  canvas.moveTo(piece.at(outline.edges[0].curve.start));
  for (const Edge& edge : outline.edges) canvas.curve(piece, edge.curve);
  canvas.close();
}

void drawArrowHead(PdfCanvas& canvas, Mm tip, Mm from) {
  const Mm along = tip - from;
  const double size = std::hypot(along.x, along.y);
  if (size < 1) return;
  const Mm unit = along * (1 / size), across{-unit.y, unit.x};
  canvas.moveTo(tip);
  canvas.lineTo(tip - unit * 7 + across * 2.5);
  canvas.lineTo(tip - unit * 7 - across * 2.5);
  canvas.close();
  canvas.fill();
}

void drawPiece(PdfCanvas& canvas, const SheetPiece& piece) {
  canvas.colour(0);
  for (const SheetSize& size : piece.nest) {
    canvas.layer(layerOfSize(size.size));
    canvas.line(size.line);
    canvas.close();
    canvas.stroke(0.35, dashesOf(size.size));
    canvas.words(size.name, true);
  }
  canvas.layer(PdfLayer::Cut);
  for (const auto& line : piece.cutLines) {
    canvas.line(line);
    canvas.close();
    canvas.stroke(0.6, false);
  }
  canvas.layer(piece.cutLines.empty() ? PdfLayer::Cut : PdfLayer::Seam);
  drawOutline(canvas, piece, piece.piece->outline);
  canvas.stroke(piece.cutLines.empty() ? 0.6 : 0.35, !piece.cutLines.empty());
  for (const Outline& hole : piece.piece->holes) {
    drawOutline(canvas, piece, hole);
    canvas.stroke(0.35, true);
  }
  canvas.layer(PdfLayer::Inner);
  for (const InternalLine& line : piece.piece->lines)
    for (const Curve& curve : line.curves) {
      canvas.moveTo(piece.at(curve.start));
      canvas.curve(piece, curve);
      canvas.stroke(0.25, true);
    }
  canvas.layer(PdfLayer::Topstitch);
  for (const SheetStitches& row : piece.stitches) {
    canvas.line(row.line);
    canvas.stroke(0.25, row.dashes());
  }
  for (const std::vector<Mm>& trim : piece.trims) {
    canvas.line(trim);
    canvas.stroke(0.25, {std::begin(kTrimDashes), std::end(kTrimDashes)});
  }
  canvas.layer(PdfLayer::Notch);
  for (const SheetNotch& notch : piece.notches) {
    canvas.moveTo(notch.stroke.from);
    canvas.lineTo(notch.stroke.to);
    canvas.stroke(0.7, false);
  }
  for (const Mm place : piece.drills) {
    canvas.circle(place, kDrillRadius * 1000);
    for (const Mm arm : {Mm{kDrillArm * 1000, 0}, Mm{0, kDrillArm * 1000}})
      canvas.moveTo(place - arm), canvas.lineTo(place + arm);
    canvas.stroke(0.35, false);
  }
  canvas.layer(PdfLayer::Grain);
  if (piece.grain) {
    canvas.moveTo(piece.grain->from);
    canvas.lineTo(piece.grain->to);
    canvas.stroke(0.5, false);
    drawArrowHead(canvas, piece.grain->to, piece.grain->from);
    drawArrowHead(canvas, piece.grain->from, piece.grain->to);
  }
  for (const std::vector<Mm>& fold : piece.folds) {
    canvas.line(fold);
    canvas.stroke(0.5, false);
    drawArrowHead(canvas, fold.front(), fold[1]);
    drawArrowHead(canvas, fold.back(), fold[fold.size() - 2]);
  }
  canvas.layer(PdfLayer::Words);
  for (std::size_t i = 0; i < piece.texts.size(); ++i) {
    canvas.colour(i < piece.labels ? 0 : 0.2);
    canvas.words(piece.texts[i], true);
  }
}

void drawSheet(PdfCanvas& canvas, const Sheet& sheet) {
  canvas.colour(0);
  drawSquares(canvas, sheet.square);
  for (const SheetText& heading : sheet.headings) canvas.words(heading, false);
  for (const std::vector<Mm>& border : sheet.borders) {
    canvas.line(border);
    canvas.stroke(0.35, false);
  }
  for (const SheetPiece& piece : sheet.pieces) drawPiece(canvas, piece);
}

// The sheet, laid out so that it fits the paper.
Result<Sheet> sheetFor(const Pattern& pattern, PaperKind paper, const SheetSettings& settings) {
  if (!(settings.overlap >= 0.005 && settings.overlap <= 0.03)) return refused(say("Pages overlap by 5 to 30 mm."));
  SheetSettings own = settings;
  if (const auto grid = gridFor(paper, settings)) {
    if (grid->cover)
      own.order.clear();  // it has pages of its own
    else
      own.rollWidth = (grid->width - 2 * kEdge) / 1000;
  }
  Result<Sheet> sheet = layOut(pattern, own);
  if (const auto grid = gridFor(paper, settings); sheet && grid) nestOnPages(*sheet, *grid);
  // A page that would be too long becomes wider instead.
  for (; sheet && sheet->height > kLargestPage && paper == PaperKind::OneSheet && own.rollWidth < 4;) {
    own.rollWidth *= 1.5;
    sheet = layOut(pattern, own);
  }
  if (sheet && paper == PaperKind::OneSheet && (sheet->height > kLargestPage || sheet->width > kLargestPage))
    return refused(say("The pieces need a page larger than 5 m, which PDF does not have. Print them on A4 sheets."));
  return sheet;
}

struct PageDrawing {
  Mm size;
  std::function<void(PdfCanvas&)> draw;
};

// They refer to the sheet and the settings.
std::vector<PageDrawing> pagesOf(const Sheet& sheet, PaperKind paper, const SheetSettings& settings) {
  const auto grid = gridFor(paper, settings);
  if (!grid) {
    if (sheet.height <= kLargestPage)
      return {{{sheet.width, sheet.height}, [&](PdfCanvas& canvas) { drawSheet(canvas, sheet); }}};
    std::vector<PageDrawing> pages;
    for (double from = 0; from < sheet.height; from += kLargestPage) {
      const Mm size{sheet.width, std::min(kLargestPage, sheet.height - from)};
      pages.push_back({size, [&, from, size](PdfCanvas& canvas) {
                         canvas.push({0, 0}, size, {0, -from});
                         drawSheet(canvas, sheet);
                         canvas.pop();
                       }});
    }
    return pages;
  }
  const std::vector<Tile> tiles = tilesOf(sheet, *grid);
  const Mm size{grid->width, grid->height};
  std::vector<PageDrawing> pages;
  if (grid->cover)
    pages.push_back({size, [&sheet, &settings, grid = *grid, tiles](PdfCanvas& canvas) {
                       drawCover(canvas, grid, sheet, tiles, settings);
                     }});
  if (grid->cover)
    for (const std::vector<std::string>& lines : orderPages(*grid, settings))
      pages.push_back({size, [lines](PdfCanvas& canvas) { drawOrder(canvas, lines); }});
  const std::size_t before = pages.size(), count = before + tiles.size();
  for (std::size_t i = 0; i < tiles.size(); ++i)
    pages.push_back(
        {size, [&sheet, &settings, grid = *grid, tile = tiles[i], page = before + i + 1, count](PdfCanvas& canvas) {
           canvas.push({kEdge, kEdge}, {grid.width - kEdge, grid.height - kEdge}, Mm{kEdge, kEdge} - tile.low);
           drawSheet(canvas, sheet);
           canvas.pop();
           drawJoins(canvas, grid, tile, page, count, settings);
         }});
  return pages;
}

}  // namespace

Result<std::string> pdfOf(const std::vector<const Sheet*>& sheets, PaperKind paper, const SheetSettings& settings) {
  std::vector<PageDrawing> pages;
  for (const Sheet* sheet : sheets)
    for (PageDrawing& page : pagesOf(*sheet, paper, settings)) pages.push_back(std::move(page));
  PdfCanvas canvas(pages.front().size.x, pages.front().size.y, sheets.front()->title);
  std::vector<PdfLayer> layers(std::begin(kPdfLayers), std::end(kPdfLayers));
  for (std::size_t size = 0; size < sheets.front()->sizes.size(); ++size) layers.push_back(layerOfSize(size));
  for (const PageDrawing& page : pages)
    for (const PdfLayer layer : layers) {
      canvas.only(layer);
      canvas.begin(page.size.x, page.size.y);
      page.draw(canvas);
      canvas.end();
    }
  return canvas.finish(settings.language, sheets.front()->sizes);
}

Result<std::string> writePdf(const Pattern& pattern, PaperKind paper, const SheetSettings& settings) {
  const Result<Sheet> sheet = sheetFor(pattern, paper, settings);
  if (!sheet) return sheet.error();
  return pdfOf({&*sheet}, paper, settings);
}

struct PaperPages::Inside {
  std::vector<PdfCanvas::Page> pages;
};

Result<PaperPages> PaperPages::of(const Pattern& pattern, PaperKind paper, const SheetSettings& settings) {
  const Result<Sheet> sheet = sheetFor(pattern, paper, settings);
  if (!sheet) return sheet.error();
  PdfCanvas canvas;
  for (const PageDrawing& page : pagesOf(*sheet, paper, settings)) {
    canvas.begin(page.size.x, page.size.y);
    page.draw(canvas);
    canvas.end();
  }
  PaperPages pages;
  pages.inside_ = std::make_shared<const Inside>(Inside{canvas.takePages()});
  return pages;
}

std::size_t PaperPages::count() const { return inside_->pages.size(); }
Flat PaperPages::size(std::size_t page) const {
  return {inside_->pages.at(page).width / 1000, inside_->pages.at(page).height / 1000};
}

std::vector<std::uint32_t> PaperPages::draw(std::size_t page, double pixelsPerMetre, int left, int top, int width,
                                            int height) const {
  std::vector<std::uint32_t> rows(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0xffffffff);
  const PdfCanvas::Surface target(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(rows.data()),
                                                                      CAIRO_FORMAT_RGB24, width, height, 4 * width));
  {
    const std::unique_ptr<cairo_t, PdfCanvas::Drop> cairo(cairo_create(target.get()));
    cairo_translate(cairo.get(), -left, -top);
    cairo_scale(cairo.get(), pixelsPerMetre / 1000, pixelsPerMetre / 1000);
    cairo_set_source_surface(cairo.get(), inside_->pages.at(page).drawn.get(), 0, 0);
    cairo_paint(cairo.get());
  }
  cairo_surface_flush(target.get());
  for (std::uint32_t& pixel : rows) pixel |= 0xff000000;
  return rows;
}

}  // namespace karinui

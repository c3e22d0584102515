#include "karinui/view/table_picture.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include "karinui/base/number.h"
#include "karinui/scene/table_print.h"
#include "karinui/view/lettering.h"
#include "karinui/view/picture.h"

namespace karinui {
namespace {

constexpr Pixel kPaper{255, 253, 249, 255}, kInkOnPaper{59, 54, 48, 255}, kFaint{109, 102, 92, 255},
    kChosen{173, 72, 34, 255}, kPin{179, 38, 30, 255};
constexpr double kFilled = 0.24;      // opacity of a fabric's colour on the paper
constexpr double kReadable = 6;       // pixels: lettering that is smaller is left out,
constexpr double kNameLeast = 10;     // but a piece's name is written at least as large as this
constexpr double kDash[] = {4.5, 3};  // in widths of a line of one
constexpr double kRulers[] = {0.5, 0.25, 0.1, 0.05, 0.02, 0.01, 0.005};  // metres

class Paper {
 public:
  Paper(const TablePictureOptions& options, const FlatBox& all)
      : image_(options.width, options.height, kPaper), language_(options.language) {
    const double least = std::min(options.width, options.height);
    pixel_ = std::max(0.5, least / 800.0);
    ruler_ = std::max(20.0, least / 20);
    const Flat size = all.size();
    const double wide = options.width * 0.92, high = options.height * 0.96 - 2 * ruler_;
    scale_ = std::min(wide / std::max(size.u, 0.01), std::max(high, 4.0) / std::max(size.v, 0.01));
    middle_ = lerp(all.low, all.high, 0.5);
    surface_.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, options.width, options.height));
    cairo_.reset(cairo_create(surface_.get()));
    ink(kPaper);
    cairo_paint(cairo_.get());
    cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
    cairo_set_fill_rule(cairo_.get(), CAIRO_FILL_RULE_EVEN_ODD);
  }

  double scale() const { return scale_; }
  Language language() const { return language_; }
  double pixels(double thin) const { return thin * pixel_; }  // of a thin line in a picture of this size
  Flat at(Flat p) const {
    return {image_.width / 2.0 + (p.u - middle_.u) * scale_,
            (image_.height - ruler_) / 2.0 - (p.v - middle_.v) * scale_};
  }

  void ink(const Pixel& colour, double opacity = 1) {
    cairo_set_source_rgba(cairo_.get(), colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0, opacity);
  }
  void path(const std::vector<Flat>& points, bool closed) {
    if (points.empty()) return;
    const Flat first = at(points.front());
    cairo_move_to(cairo_.get(), first.u, first.v);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Flat p = at(points[i]);
      cairo_line_to(cairo_.get(), p.u, p.v);
    }
    if (closed) cairo_close_path(cairo_.get());
  }
  void circle(Flat middle, double pixelRadius) {
    const Flat m = at(middle);
    cairo_new_sub_path(cairo_.get());
    cairo_arc(cairo_.get(), m.u, m.v, pixelRadius, 0, 2 * std::numbers::pi);
  }
  void fill() { cairo_fill(cairo_.get()); }
  // What is drawn within the path, and no farther.
  template <class Draw>
  void within(Draw&& draw) {
    cairo_save(cairo_.get());
    cairo_clip(cairo_.get());
    draw();
    cairo_restore(cairo_.get());
  }
  void band(Flat from, Flat to, double wide) {  // metres
    cairo_save(cairo_.get());
    path({from, to}, false);
    cairo_set_dash(cairo_.get(), nullptr, 0, 0);
    cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(cairo_.get(), wide * scale_);
    cairo_stroke(cairo_.get());
    cairo_restore(cairo_.get());
  }
  void stroke(double thin, bool dashed = false) {
    const double dash[] = {kDash[0] * pixel_, kDash[1] * pixel_};
    cairo_set_dash(cairo_.get(), dash, dashed ? 2 : 0, 0);
    cairo_set_line_width(cairo_.get(), pixels(thin));
    cairo_stroke(cairo_.get());
  }
  void line(Flat from, Flat to, double thin) {
    path({from, to}, false);
    stroke(thin);
  }
  // The head of an arrow, as large on every picture as the lines are thick.
  void head(Flat tip, Flat from) {
    const Flat b = at(tip), way = normalized(b - at(from)), side{-way.v, way.u};
    const double size = pixels(8);
    for (const double s : {-0.5, 0.5}) {
      const Flat end = b - way * size + side * (s * size);
      cairo_move_to(cairo_.get(), b.u, b.v);
      cairo_line_to(cairo_.get(), end.u, end.v);
    }
  }

  // A picture whose upper left, upper right and lower left corners lie there.
  void picture(const PrintImage& image, const std::array<Flat, 3>& corners, double opacity) {
    const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, image.width);
    std::vector<unsigned char> rows(static_cast<std::size_t>(stride) * static_cast<std::size_t>(image.height));
    const std::uint8_t* rgb = image.rgb.data();
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x, rgb += 3) {
        const std::uint32_t value = std::uint32_t{rgb[0]} << 16 | std::uint32_t{rgb[1]} << 8 | rgb[2];
        std::memcpy(
            &rows[static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) + 4 * static_cast<std::size_t>(x)],
            &value, 4);
      }
    const std::unique_ptr<cairo_surface_t, Drop> source(
        cairo_image_surface_create_for_data(rows.data(), CAIRO_FORMAT_RGB24, image.width, image.height, stride));
    const Flat corner = at(corners[0]), across = at(corners[1]) - corner, down = at(corners[2]) - corner;
    cairo_matrix_t lies;
    cairo_matrix_init(&lies, across.u / image.width, across.v / image.width, down.u / image.height,
                      down.v / image.height, corner.u, corner.v);
    cairo_save(cairo_.get());
    cairo_transform(cairo_.get(), &lies);
    cairo_set_source_surface(cairo_.get(), source.get(), 0, 0);
    cairo_paint_with_alpha(cairo_.get(), opacity);
    cairo_restore(cairo_.get());
    cairo_surface_finish(source.get());
  }

  // What is drawn so far goes into the image; then only words may follow.
  void develop() {
    cairo_.reset();
    cairo_surface_flush(surface_.get());
    const unsigned char* rows = cairo_image_surface_get_data(surface_.get());
    const int stride = cairo_image_surface_get_stride(surface_.get());
    for (int y = 0; y < image_.height; ++y)
      for (int x = 0; x < image_.width; ++x) {
        std::uint32_t value = 0;
        std::memcpy(&value, rows + static_cast<std::ptrdiff_t>(y) * stride + 4 * x, 4);
        image_.set(x, y,
                   {static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8),
                    static_cast<std::uint8_t>(value), 255});
      }
  }
  double width(const Message& message, double size) { return lettering_.width(text(message, language_), size); }
  void words(const Message& message, Flat middle, double size, bool upright, const Pixel& colour) {
    const std::string said = text(message, language_);
    const Flat m = at(middle);
    const double wide = lettering_.width(said, size);
    if (upright) return lettering_.write(image_, said, m.u - wide / 2, m.v + 0.35 * size, size, colour);
    // Written level over what lies there, turned to the right, and turned back.
    const int w = static_cast<int>(std::ceil(wide)) + 4, h = static_cast<int>(std::ceil(1.5 * size));
    const int left = static_cast<int>(std::lround(m.u)) - h / 2, top = static_cast<int>(std::lround(m.v)) - w / 2;
    const auto each = [&](auto&& visit) {
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
          const int px = left + y, py = top + w - 1 - x;
          if (px >= 0 && py >= 0 && px < image_.width && py < image_.height) visit(x, y, px, py);
        }
    };
    Image strip(w, h, kPaper);
    each([&](int x, int y, int px, int py) { strip.set(x, y, image_.at(px, py)); });
    lettering_.write(strip, said, (w - wide) / 2, h / 2.0 + 0.35 * size, size, colour);
    each([&](int x, int y, int px, int py) { image_.set(px, py, strip.at(x, y)); });
  }

  void ruler() {
    const auto fits = [&](double metres) { return metres * scale_ < image_.width / 3.0; };
    const auto* longest = std::find_if(std::begin(kRulers), std::end(kRulers), fits);
    if (longest == std::end(kRulers)) return;
    rulerMetres_ = *longest;
    const double left = ruler_, y = image_.height - 0.6 * ruler_, right = left + rulerMetres_ * scale_;
    const double tick = pixels(4);
    ink(kFaint);
    cairo_move_to(cairo_.get(), left, y);
    cairo_line_to(cairo_.get(), right, y);
    for (const double x : {left, right}) {
      cairo_move_to(cairo_.get(), x, y - tick);
      cairo_line_to(cairo_.get(), x, y + tick);
    }
    stroke(1.4);
  }
  void rulerWords() {
    if (rulerMetres_ > 0)
      lettering_.write(image_, lengthSaid(rulerMetres_, false), ruler_ + pixels(3),
                       image_.height - 0.6 * ruler_ - pixels(5), pixels(10), kFaint);
  }

  Image take(std::vector<Message>* notes) {
    if (notes)
      for (Message& note : lettering_.takeNotes()) notes->push_back(std::move(note));
    return std::move(image_);
  }

 private:
  struct Drop {
    void operator()(cairo_t* c) const { cairo_destroy(c); }
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  };
  Image image_;
  Language language_;
  double pixel_ = 1, ruler_ = 20, scale_ = 1, rulerMetres_ = 0;
  Flat middle_;
  std::unique_ptr<cairo_surface_t, Drop> surface_;
  std::unique_ptr<cairo_t, Drop> cairo_;
  Lettering lettering_;
};

void drawScan(Paper& paper, const TableScan& scan) {
  const auto corners = scan.corners();
  paper.picture(*scan.image, {corners[3], corners[2], corners[0]}, scan.strength);
}

// What is printed on the cloth, as far as the outline, which is the path, holds it.
void drawPrint(Paper& paper, const TablePiece& piece) {
  const TablePrint print = printOn(piece);
  paper.within([&] {
    paper.ink(pixelOf(piece.look.ink), print.strength);
    for (const TableStroke& stripe : print.stripes) paper.band(stripe.from, stripe.to, print.stripe);
    for (const Flat dot : print.dots) {
      paper.circle(dot, print.dot * paper.scale());
      paper.fill();
    }
    for (const auto& corners : print.photos) paper.picture(*piece.look.photo, corners, print.strength);
  });
}

void drawPiece(Paper& paper, const TablePiece& piece) {
  const auto outlines = [&] {
    paper.path(ringOf(piece.edges), true);
    for (const auto& hole : piece.holes) paper.path(ringOf(hole), true);
  };
  paper.ink(pixelOf(piece.colour), kFilled);
  outlines();
  paper.fill();
  outlines();
  drawPrint(paper, piece);
  if (!piece.cut.empty()) {
    paper.ink(kFaint);
    for (const Ring& cut : piece.cut) paper.path(cut, true);
    paper.stroke(1);
  }
  if (piece.before) {
    paper.ink(kFaint);
    paper.path(*piece.before, true);
    paper.stroke(1, true);
  }
  for (const TableSize& size : piece.nest) {
    paper.ink(pixelOf(size.colour));
    paper.path(size.outline, true);
    paper.stroke(1);
  }
  paper.ink(piece.chosen ? kChosen : kInkOnPaper);
  outlines();
  paper.stroke(piece.chosen ? 2.2 : 1.4);
  paper.ink(kInkOnPaper);
  for (const auto& line : piece.lines) {
    paper.path(line, false);
    paper.stroke(1, true);
  }
  for (const auto& row : piece.stitches) {
    paper.path(row, false);
    paper.stroke(0.8, true);
  }
  for (const TableTrim& trim : piece.trims) {
    paper.path(trim.line(paper.pixels(kTrimPixels) / paper.scale()), false);
    paper.stroke(1, true);
  }
  for (const TableNotch& notch : piece.notches) paper.line(notch.stroke.from, notch.stroke.to, notch.own ? 1.6 : 1);
  for (const Flat hole : piece.drills) {
    paper.circle(hole, std::max(paper.pixels(3), piece.drillRadius * paper.scale()));
    paper.stroke(1.2);
  }
  for (const Flat corner : piece.corners) {
    paper.circle(corner, paper.pixels(3));
    paper.stroke(1.2);
  }
  if (piece.grain) {
    paper.ink(kFaint);
    paper.path({piece.grain->from, piece.grain->to}, false);
    paper.head(piece.grain->from, piece.grain->to);
    paper.head(piece.grain->to, piece.grain->from);
    paper.stroke(1.2);
  }
  paper.ink(kPin);
  for (const Flat pin : piece.pins) {
    paper.circle(pin, paper.pixels(3.4));
    paper.fill();
  }
}

void drawSeam(Paper& paper, const TableSeam& seam) {
  const double thin = seam.chosen ? 4 : 2.2;
  const double inset = paper.pixels(3) / paper.scale(), tick = paper.pixels(9) / paper.scale();
  paper.ink(pixelOf(seam.colour));
  for (const TableSeam::Side& side : seam.sides) {
    for (const TableSeam::Run& run : side.runs) {
      std::vector<Flat> points;
      for (std::size_t i = 0; i < run.points.size(); ++i) points.push_back(run.points[i] + run.inward[i] * inset);
      paper.path(points, false);
      paper.stroke(thin);
    }
    for (const TableSeam::Tick& one : side.ticks) paper.line(one.place, one.place + one.inward * tick, thin);
  }
}

void markChosen(Paper& paper, const std::vector<TableEdge>& edges) {
  paper.ink(kChosen);
  for (const TableEdge& edge : edges)
    if (edge.chosen) {
      paper.path(edge.points, false);
      paper.stroke(3);
    }
}

// Whether words lie within the outline.
bool fits(Paper& paper, const TablePiece& piece, const TableLabel& label, Flat place, double size) {
  const Flat along = Flat{paper.width(label.words, size), size} * (0.5 / paper.scale());
  const Flat half = label.upright ? along : Flat{along.v, along.u};
  const Ring ring = ringOf(piece.edges);
  constexpr int kLooks = 8;
  for (int k = -kLooks; k <= kLooks; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double share = static_cast<double>(k) / kLooks;
      if (!contains(ring, place + Flat{half.u * share, half.v * side}) ||
          !contains(ring, place + Flat{half.u * side, half.v * share}))
        return false;
    }
  return true;
}

// Lays the lettering of all pieces, what matters more first: what would lie over other words goes a little aside, is
// written smaller or, of a name, shortened; what finds no room even so is left out, for two words in one place are read
// by nobody.
class Letterer {
 public:
  explicit Letterer(Paper& paper) : paper_(paper) {}

  void write(const TablePiece& piece, const TableLabel& label) {
    const bool name = label.says == TableLabel::Says::Name;
    const double printed = label.size * paper_.scale();
    double size = std::max(printed, name ? kNameLeast : 0.0);
    if (size < kReadable) return;
    Flat place = label.place;
    const auto wide = [&] { return paper_.width(label.words, size) / 2 / paper_.scale(); };
    // Written larger than it is printed it might run into a grain line that is upright, as most are: then beside it.
    if (const auto& grain = piece.grain; grain && label.upright && std::fabs(grain->to.u - grain->from.u) < 1e-6) {
      const double apart = wide() + paper_.pixels(6) / paper_.scale(), away = place.u - grain->from.u;
      if (std::fabs(away) < apart) place.u = grain->from.u + std::copysign(apart, away);
    }
    // On a small piece no larger than there is room for, and where it is printed.
    if (size > printed && !fits(paper_, piece, label, place, size)) {
      place = label.place;
      while (size > std::max(printed, kReadable) && !fits(paper_, piece, label, place, size)) size *= 0.95;
    }
    const Pixel& colour = name && piece.chosen ? kChosen : kInkOnPaper;
    const Ring ring = ringOf(piece.edges);
    for (double smaller = size; smaller >= std::min(size, kReadable); smaller *= 0.85)
      if (wrote(label, label.words, ring, place, smaller, colour)) return;
    if (!name) return;
    const std::string all = text(label.words, paper_.language());
    for (std::size_t kept = all.size(); kept-- > 1;)
      if ((all[kept] & 0xC0) != 0x80 &&
          wrote(label, say("{0}", all.substr(0, kept) + "…"), ring, place, std::min(size, kNameLeast), colour))
        return;
  }

 private:
  // Here, or so many lines aside on the same piece. What tells of a place stays beside it.
  bool wrote(const TableLabel& label, const Message& words, const Ring& ring, Flat place, double size,
             const Pixel& colour) {
    const int most = label.says == TableLabel::Says::SeamNumber ? 1 : label.says == TableLabel::Says::Note ? 3 : 12;
    const Flat line = (label.upright ? Flat{0, 1} : Flat{1, 0}) * (1.05 * size / paper_.scale());
    const Flat half{paper_.width(words, size) / 2 + 1, 0.45 * size};
    for (int k = 0; k <= 2 * most; ++k) {
      const Flat at = place + line * ((k + 1) / 2 * (k % 2 ? 1.0 : -1.0)), middle = paper_.at(at);
      if (k > 0 && !contains(ring, at)) continue;
      const Flat reach = label.upright ? half : Flat{half.v, half.u};
      const FlatBox box{middle - reach, middle + reach};
      if (std::any_of(taken_.begin(), taken_.end(), [&](const FlatBox& other) {
            return box.low.u < other.high.u && other.low.u < box.high.u && box.low.v < other.high.v &&
                   other.low.v < box.high.v;
          }))
        continue;
      taken_.push_back(box);
      paper_.words(words, at, size, label.upright, colour);
      return true;
    }
    return false;
  }

  Paper& paper_;
  std::vector<FlatBox> taken_;  // pixels
};

void writeAll(Paper& paper, const TableFrame& frame) {
  Letterer letterer(paper);
  for (const TableLabel::Says says :
       {TableLabel::Says::Name, TableLabel::Says::SeamNumber, TableLabel::Says::Cut, TableLabel::Says::Note})
    for (const TablePiece& piece : frame.pieces)
      for (const TableLabel& label : piece.labels)
        if (label.says == says) letterer.write(piece, label);
}

}  // namespace

Result<Image> drawTable(const TableFrame& frame, const TablePictureOptions& options, std::vector<Message>* notes) {
  if (const auto size = sizeNamed(written(options.width) + "x" + written(options.height)); !size) return size.error();
  if (frame.pieces.empty() && frame.scans.empty()) return refused(say("There is no piece to draw."));
  Paper paper(options, extent(frame));
  for (const TableScan& scan : frame.scans) drawScan(paper, scan);
  for (const TablePiece& piece : frame.pieces) drawPiece(paper, piece);
  for (const TableSeam& seam : frame.seams) drawSeam(paper, seam);
  for (const TablePiece& piece : frame.pieces) {
    markChosen(paper, piece.edges);
    for (const auto& hole : piece.holes) markChosen(paper, hole);
  }
  paper.ruler();
  paper.develop();
  writeAll(paper, frame);
  paper.rulerWords();
  return paper.take(notes);
}

}  // namespace karinui

#include "pdf_canvas.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pdf_layers.h"

namespace karinui {
namespace {

constexpr double kPoint = 72 / 25.4;  // points in a millimetre

cairo_status_t append(void* bytes, const unsigned char* data, unsigned count) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), count);
  return CAIRO_STATUS_SUCCESS;
}

// A sans-serif font that has (most of) the characters of a text.
cairo_font_face_t* fontFor(const std::string& words) {
  FcCharSet* characters = FcCharSetCreate();
  const auto* at = reinterpret_cast<const FcChar8*>(words.data());
  for (int left = static_cast<int>(words.size()); left > 0;) {
    FcChar32 character = 0;
    const int used = FcUtf8ToUcs4(at, &character, left);
    if (used <= 0) break;
    FcCharSetAddChar(characters, character);
    at += used, left -= used;
  }
  FcPattern* wanted = FcPatternCreate();
  FcPatternAddString(wanted, FC_FAMILY, reinterpret_cast<const FcChar8*>("sans-serif"));
  FcPatternAddCharSet(wanted, FC_CHARSET, characters);
  FcPatternAddBool(wanted, FC_SCALABLE, FcTrue);
  FcConfigSubstitute(nullptr, wanted, FcMatchPattern);
  FcDefaultSubstitute(wanted);
  FcResult result = FcResultMatch;
  FcPattern* found = FcFontMatch(nullptr, wanted, &result);
  cairo_font_face_t* face = found ? cairo_ft_font_face_create_for_pattern(found) : nullptr;
  if (found) FcPatternDestroy(found);
  FcPatternDestroy(wanted);
  FcCharSetDestroy(characters);
  return face;
}

Message nameOf(PdfLayer layer) {
  switch (layer) {
    case PdfLayer::Cut:
      return say("Cut lines");
    case PdfLayer::Seam:
      return say("Seam lines");
    case PdfLayer::Inner:
      return say("Inner lines");
    case PdfLayer::Topstitch:
      return say("Topstitching");
    case PdfLayer::Notch:
      return say("Notches and drill holes");
    case PdfLayer::Grain:
      return say("Grain lines");
    case PdfLayer::Words:
      return say("Lettering");
    default:
      return {};
  }
}

}  // namespace

PdfCanvas::PdfCanvas(double widthMm, double heightMm, const std::string& title)
    : surface_(cairo_pdf_surface_create_for_stream(append, &bytes_, widthMm * kPoint, heightMm * kPoint)) {
  // 1.4 keeps objects readable by the oldest plotters, and the file open to layered().
  cairo_pdf_surface_restrict_to_version(surface_.get(), CAIRO_PDF_VERSION_1_4);
  cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
  cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATOR, "Karinui");
  // No date: the same pattern gives the same bytes, and a pattern passed on does not say when it was made.
  cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  cairo_.reset(cairo_create(surface_.get()));
}

void PdfCanvas::begin(double widthMm, double heightMm) {
  if (surface_) {
    cairo_pdf_surface_set_size(surface_.get(), widthMm * kPoint, heightMm * kPoint);
    cairo_identity_matrix(cairo_.get());
    cairo_scale(cairo_.get(), kPoint, kPoint);
  } else {
    const cairo_rectangle_t all{0, 0, widthMm, heightMm};
    pages_.push_back({Surface(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &all)), widthMm, heightMm});
    cairo_.reset(cairo_create(pages_.back().drawn.get()));
    // Letters stand where the PDF has them, not on the pixels of some screen.
    cairo_font_options_t* options = cairo_font_options_create();
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_set_font_options(cairo_.get(), options);
    cairo_font_options_destroy(options);
  }
  cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
}
void PdfCanvas::end() {
  if (surface_)
    cairo_show_page(cairo_.get());
  else
    cairo_.reset();
}

void PdfCanvas::push(Mm low, Mm high, Mm shift) {
  cairo_save(cairo_.get());
  cairo_rectangle(cairo_.get(), low.x, low.y, high.x - low.x, high.y - low.y);
  cairo_clip(cairo_.get());
  cairo_translate(cairo_.get(), shift.x, shift.y);
}
void PdfCanvas::pop() { cairo_restore(cairo_.get()); }

void PdfCanvas::colour(double grey) { cairo_set_source_rgb(cairo_.get(), grey, grey, grey); }

void PdfCanvas::stroke(double width, bool dashed) {
  stroke(width, dashed ? std::vector<double>{5, 2} : std::vector<double>{});
}
void PdfCanvas::stroke(double width, const std::vector<double>& dashes) {
  cairo_set_dash(cairo_.get(), dashes.data(), static_cast<int>(dashes.size()), 0);
  cairo_set_line_width(cairo_.get(), width);
  shown() ? cairo_stroke(cairo_.get()) : cairo_new_path(cairo_.get());
}
void PdfCanvas::fill() { shown() ? cairo_fill(cairo_.get()) : cairo_new_path(cairo_.get()); }
void PdfCanvas::moveTo(Mm p) { cairo_move_to(cairo_.get(), p.x, p.y); }
void PdfCanvas::lineTo(Mm p) { cairo_line_to(cairo_.get(), p.x, p.y); }
void PdfCanvas::line(std::span<const Mm> points) {
  for (std::size_t i = 0; i < points.size(); ++i) i == 0 ? moveTo(points[i]) : lineTo(points[i]);
}
void PdfCanvas::close() { cairo_close_path(cairo_.get()); }

void PdfCanvas::curve(const SheetPiece& piece, const Curve& curve) {
  if (curve.kind == Curve::Kind::Line) return lineTo(piece.at(curve.end));
  for (const Curve& cubic : curve.cubics()) {
    const Mm a = piece.at(cubic.control1), b = piece.at(cubic.control2), p = piece.at(cubic.end);
    cairo_curve_to(cairo_.get(), a.x, a.y, b.x, b.y, p.x, p.y);
  }
}

void PdfCanvas::circle(Mm centre, double radius) {
  cairo_new_sub_path(cairo_.get());
  cairo_arc(cairo_.get(), centre.x, centre.y, radius, 0, 2 * std::numbers::pi);
}

void PdfCanvas::words(const SheetText& text, bool centred) {
  if (!shown()) return;
  cairo_save(cairo_.get());
  if (cairo_font_face_t* face = fontFor(text.words)) {
    cairo_set_font_face(cairo_.get(), face);
    cairo_font_face_destroy(face);
  }
  cairo_set_font_size(cairo_.get(), text.size);
  cairo_text_extents_t extents{};
  cairo_text_extents(cairo_.get(), text.words.c_str(), &extents);
  cairo_translate(cairo_.get(), text.place.x, text.place.y);
  if (!text.upright) cairo_rotate(cairo_.get(), -std::numbers::pi / 2);
  cairo_move_to(cairo_.get(), centred ? -extents.x_advance / 2 : 0, text.size * 0.35);
  cairo_show_text(cairo_.get(), text.words.c_str());
  cairo_restore(cairo_.get());
}

double PdfCanvas::wide(const std::string& words, double size) const {
  cairo_save(cairo_.get());
  if (cairo_font_face_t* face = fontFor(words)) {
    cairo_set_font_face(cairo_.get(), face);
    cairo_font_face_destroy(face);
  }
  cairo_set_font_size(cairo_.get(), size);
  cairo_text_extents_t extents{};
  cairo_text_extents(cairo_.get(), words.c_str(), &extents);
  cairo_restore(cairo_.get());
  return extents.x_advance;
}

void PdfCanvas::picture(Mm low, double wide, int width, int height, std::span<const std::uint8_t> rgba) {
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (width < 1 || height < 1 || rgba.size() < 4 * pixels || !shown()) return;
  std::vector<std::uint32_t> rows(pixels);
  for (std::size_t i = 0; i < pixels; ++i)
    rows[i] = 0xff000000u | std::uint32_t{rgba[4 * i]} << 16 | std::uint32_t{rgba[4 * i + 1]} << 8 | rgba[4 * i + 2];
  const Surface image(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(rows.data()),
                                                          CAIRO_FORMAT_RGB24, width, height, 4 * width));
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), low.x, low.y);
  cairo_scale(cairo_.get(), wide / width, wide / width);
  cairo_set_source_surface(cairo_.get(), image.get(), 0, 0);
  cairo_paint(cairo_.get());
  cairo_restore(cairo_.get());
  cairo_surface_finish(image.get());
}

Result<std::string> PdfCanvas::finishPlain() {
  const cairo_status_t drawn = cairo_status(cairo_.get());
  cairo_.reset();
  cairo_surface_finish(surface_.get());
  const cairo_status_t written = cairo_surface_status(surface_.get());
  if (drawn != CAIRO_STATUS_SUCCESS || written != CAIRO_STATUS_SUCCESS)
    return refused(
        say("The PDF cannot be drawn: {0}.", cairo_status_to_string(drawn != CAIRO_STATUS_SUCCESS ? drawn : written)));
  return std::move(bytes_);
}

Result<std::string> PdfCanvas::finish(Language language, const std::vector<std::string>& sizes) {
  Result<std::string> plain = finishPlain();
  if (!plain) return plain;
  std::vector<std::string> names;
  for (const PdfLayer layer : kPdfLayers) names.push_back(text(nameOf(layer), language));
  for (const std::string& size : sizes) names.push_back(text(say("Size {0}", size), language));
  return layered(*std::move(plain), names);
}

}  // namespace karinui

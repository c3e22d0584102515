#include "karinui/exchange/lay_sheet.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "karinui/base/number.h"
#include "karinui/pattern/label_room.h"
#include "names.h"
#include "sheet.h"

namespace karinui {
namespace {

constexpr double kLayMargin = 20;         // mm round the cloth
constexpr double kHeader = kSquare + 60;  // above it
constexpr double kNearFold = 1e-6;

// Metres to buy: never less than what it takes.
std::string lengthOf(const FabricLay& lay) { return fixed(std::ceil(lay.length * 1000 - 1e-6) / 1000, 3); }

// A place of the cloth as one of the page's paper: the cloth's length runs down the page.
Flat onPage(Flat cloth) { return {cloth.v, -cloth.u}; }

Curve carried(const Curve& curve, const LaidPiece& laid) {
  const auto at = [&](Flat p) { return onPage(laid(p)); };
  Curve out = curve;
  out.start = at(curve.start), out.end = at(curve.end);
  out.control1 = at(curve.control1), out.control2 = at(curve.control2);
  for (Flat& p : out.between) p = at(p);
  if (laid.over) out.bulge = -out.bulge;
  return out;
}

// The parts of a line that lie on the cloth, which begins at u = 0 of the page's paper where it is folded.
std::vector<std::vector<Flat>> onCloth(const std::vector<Flat>& line) {
  std::vector<std::vector<Flat>> parts;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    Flat a = line[i], b = line[i + 1];
    if (a.u < 0 && b.u < 0) continue;
    const bool cutStart = a.u < 0, cutEnd = b.u < 0;
    const Flat met = cutStart || cutEnd ? lerp(a, b, a.u / (a.u - b.u)) : a;
    if (cutStart) a = met;
    if (cutEnd) b = met;
    if (parts.empty() || cutStart || !(parts.back().back() == a)) parts.push_back({a});
    parts.back().push_back(b);
  }
  return parts;
}

// The drawing of laid pieces; owns the pieces that it draws.
class LayDrawing {
 public:
  LayDrawing(const LayPlan& plan, const LayPaper& paper) : plan_(plan), paper_(paper) {}

  Result<Sheet> draw(const std::vector<const FabricLay*>& lays) {
    SheetSettings settings;
    settings.title = paper_.title;
    tellGarment(plan_.document, {}, settings);  // laid on the cloth, the pieces match already
    settings.allowance = plan_.settings.allowance;
    settings.language = paper_.language;
    const Result<Sheet> flat = layOut(plan_.document.pattern, settings);
    if (!flat) return flat.error();
    Sheet out;
    out.title = cleanText(paper_.title);
    out.square = {kLayMargin, kLayMargin};
    heading(out, out.title, 7, kLayMargin + kSquare + 10);
    heading(out, said(say("Print at 100 %. The square must measure 100 mm.")), 4, kLayMargin + kSquare + 22);
    double down = kLayMargin + kHeader;
    for (const FabricLay* lay : lays) {
      heading(out, said(laid(*lay)), 5, down - 8);
      const Mm low{kLayMargin, down}, high{kLayMargin + lay->width * 1000, down + lay->length * 1000};
      out.borders.push_back({low, {high.x, low.y}, high, {low.x, high.y}, low});
      if (plan_.settings.folded) out.borders.push_back({low - Mm{1.5, 0}, {low.x - 1.5, high.y}});
      for (std::size_t i = 0; i < lay->pieces.size(); ++i) out.pieces.push_back(piece(*flat, *lay, i, low));
      out.width = std::max(out.width, high.x + kLayMargin);
      down = high.y + kLayMargin + 25;
    }
    out.height = std::ceil(down - 25);
    out.width = std::ceil(std::max(out.width, kLayMargin + 1.7 * kSquare));
    for (const SheetText& words : out.headings)
      out.width = std::max(out.width, std::ceil(words.place.x + wordsWidth(words.words, words.size) + kLayMargin));
    return out;
  }

 private:
  std::string said(const Message& message) const { return text(message, paper_.language); }
  static void heading(Sheet& sheet, std::string words, double size, double down) {
    sheet.headings.push_back({{kLayMargin, down}, size, true, std::move(words)});
  }
  Message laid(const FabricLay& lay) const {
    const std::string length = lengthOf(lay), wide = fixed(plan_.settings.width * 100, 0),
                      use = fixed(lay.use * 100, 1);
    return plan_.settings.folded ? say("{0}: {1} m of {2} cm, folded lengthwise (fold at the left), {3} % used",
                                       lay.fabric, length, wide, use)
                                 : say("{0}: {1} m of {2} cm, {3} % used", lay.fabric, length, wide, use);
  }

  SheetPiece piece(const Sheet& flat, const FabricLay& lay, std::size_t nth, Mm low) {
    const LaidPiece& laid = lay.pieces[nth];
    const Piece& own = *plan_.document.find(laid.piece);
    const SheetPiece& drawn =
        *std::find_if(flat.pieces.begin(), flat.pieces.end(), [&](const SheetPiece& one) { return one.piece == &own; });
    const auto carriedPlace = [&](Mm p) {
      return onPage(laid(Flat{(p.x - drawn.origin.x) / 1000, -(p.y - drawn.origin.y) / 1000}));
    };
    Piece there = own;
    there.grain = normalized(onPage(laid.step(own.grain)));
    there.outline = outline(own.outline, laid);
    for (Outline& hole : there.holes) hole = outline(hole, laid);
    for (InternalLine& line : there.lines) {
      std::vector<Curve> curves;
      for (const Curve& curve : line.curves) {
        const Curve moved = carried(curve, laid);
        if (!laid.half) {
          curves.push_back(moved);
          continue;
        }
        for (const auto& part : onCloth(moved.flattened(1e-4)))
          for (std::size_t i = 0; i + 1 < part.size(); ++i) curves.push_back(Curve::line(part[i], part[i + 1]));
      }
      line.curves = std::move(curves);
    }
    there.marks.clear();
    pieces_.push_back(std::move(there));
    SheetPiece out;
    out.piece = &pieces_.back();
    out.origin = low;
    const auto lies = [&](Flat p) { return !laid.half || p.u >= -kNearFold; };
    for (std::size_t line = 0; line < drawn.cutLines.size(); ++line) {
      std::vector<Mm> moved;
      if (line == 0) {
        for (const Flat p : lay.cut[nth]) moved.push_back(out.at(onPage(p)));
      } else {
        bool all = true;
        for (const Mm p : drawn.cutLines[line]) {
          const Flat q = carriedPlace(p);
          all &= lies(q);
          moved.push_back(out.at(q));
        }
        if (!all) continue;
      }
      out.cutLines.push_back(std::move(moved));
    }
    for (const SheetNotch& notch : drawn.notches) {
      const Flat from = carriedPlace(notch.stroke.from), to = carriedPlace(notch.stroke.to);
      if (lies(from) && lies(to)) out.notches.push_back({{out.at(from), out.at(to)}, notch.seam});
    }
    for (const Mm drill : drawn.drills)
      if (const Flat p = carriedPlace(drill); lies(p)) out.drills.push_back(out.at(p));
    for (std::size_t i = drawn.labels; i < drawn.texts.size(); ++i) {
      SheetText words = drawn.texts[i];
      const Flat p = carriedPlace(words.place);
      if (!lies(p)) continue;
      words.place = out.at(p);
      out.texts.push_back(std::move(words));
    }
    letter(out, laid, own);
    out.low = out.high = out.at(onPage(lay.cut[nth][0]));
    for (const Flat p : lay.cut[nth]) {
      const Mm at = out.at(onPage(p));
      out.low = {std::min(out.low.x, at.x), std::min(out.low.y, at.y)};
      out.high = {std::max(out.high.x, at.x), std::max(out.high.y, at.y)};
    }
    return out;
  }

  static Outline outline(const Outline& own, const LaidPiece& laid) {
    Outline out;
    for (const Edge& edge : own.edges) {
      const Curve moved = carried(edge.curve, laid);
      if (!laid.half) {
        out.edges.push_back({edge.name, moved});
        continue;
      }
      for (const auto& part : onCloth(moved.flattened(1e-4)))
        for (std::size_t i = 0; i + 1 < part.size(); ++i)
          out.edges.push_back({edge.name, Curve::line(part[i], part[i + 1])});
    }
    if (!laid.half) return out;
    // The half is closed along the fold.
    std::vector<Edge> closed;
    for (std::size_t i = 0; i < out.edges.size(); ++i) {
      closed.push_back(out.edges[i]);
      const Flat next = out.edges[(i + 1) % out.edges.size()].curve.start;
      if (distance(out.edges[i].curve.end, next) > kNearFold)
        closed.push_back({"fold", Curve::line(out.edges[i].curve.end, next)});
    }
    out.edges = std::move(closed);
    return out;
  }

  // Its name and what this copy is, where there is room in the piece as it lies.
  void letter(SheetPiece& out, const LaidPiece& laid, const Piece& own) const {
    std::vector<std::string> lines{cleanText(own.name)};
    if (laid.under) lines[0] += " + " + cleanText(plan_.document.find(laid.under)->name);
    if (laid.onFold)
      lines.push_back(said(say("on the fold")));
    else if (laid.layers == 2)
      lines.push_back(said(laid.under ? say("two layers") : say("two layers: cut 2")));
    else if (laid.over)
      lines.push_back(said(say("turned over")));
    Piece shown = *out.piece;
    if (signedArea(shown.outline.flattened(1e-3)) < 0) {
      std::reverse(shown.outline.edges.begin(), shown.outline.edges.end());
      for (Edge& edge : shown.outline.edges) edge.curve = edge.curve.reversed();
    }
    const LetteredPiece room = roomFor(shown, lines);
    std::vector<SheetText> texts;
    for (std::size_t i = 0; i < lines.size(); ++i)
      texts.push_back({out.at(room.lines[i].place), room.lines[i].size * 1000, room.lines[i].upright, lines[i]});
    out.labels = texts.size();
    out.texts.insert(out.texts.begin(), texts.begin(), texts.end());
    if (room.grain) out.grain = {out.at(room.grain->from), out.at(room.grain->to)};
  }

  const LayPlan& plan_;
  const LayPaper& paper_;
  std::deque<Piece> pieces_;  // that sheets point to
};

}  // namespace

Result<std::string> writeLay(const LayPlan& plan, std::string_view ending, const LayPaper& paper) {
  if (plan.fabrics.empty()) return refused(say("There is no piece to lay."));
  LayDrawing drawing(plan, paper);
  std::vector<const FabricLay*> all;
  for (const FabricLay& lay : plan.fabrics) all.push_back(&lay);
  SheetSettings settings;
  settings.overlap = paper.overlap;
  settings.language = paper.language;
  if (ending == "pdf" && paper.paper == PaperKind::OneSheet) {
    std::deque<Sheet> sheets;
    std::vector<const Sheet*> each;
    for (const FabricLay* lay : all) {
      auto sheet = drawing.draw({lay});
      if (!sheet) return sheet.error();
      sheets.push_back(*std::move(sheet));
      each.push_back(&sheets.back());
    }
    return pdfOf(each, paper.paper, settings);
  }
  const auto sheet = drawing.draw(all);
  if (!sheet) return sheet.error();
  if (ending == "pdf") return pdfOf({&*sheet}, paper.paper, settings);
  if (ending == "svg") return svgOf(*sheet, nullptr);
  if (ending == "dxf") return dxfOf(*sheet);
  if (ending == "plt") return hpglOf(*sheet);
  return badInput(say("A lay plan is written as .pdf, .svg, .dxf or .plt."));
}

std::vector<Message> laySaid(const LayPlan& plan) {
  std::vector<Message> all;
  for (const FabricLay& lay : plan.fabrics) {
    const std::string length = lengthOf(lay), wide = fixed(plan.settings.width * 100, 0), use = fixed(lay.use * 100, 1);
    all.push_back(plan.settings.folded
                      ? say("{0}: {1} m of {2} cm, folded lengthwise, {3} % used", lay.fabric, length, wide, use)
                      : say("{0}: {1} m of {2} cm, {3} % used", lay.fabric, length, wide, use));
  }
  return all;
}

}  // namespace karinui

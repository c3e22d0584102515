#include "sheet.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "dxf/grade_rules.h"
#include "karinui/design/glossary.h"
#include "karinui/design/notions.h"
#include "karinui/design/piece_label.h"
#include "karinui/design/sewing_order.h"
#include "karinui/exchange/dxf.h"
#include "karinui/pattern/cut_line.h"
#include "karinui/pattern/darts.h"
#include "karinui/pattern/label_room.h"
#include "karinui/pattern/trims.h"
#include "names.h"
#include "sheet_pairs.h"

namespace karinui {
namespace {

constexpr double kMargin = 20, kGap = 15, kHeader = kSquare + 60;  // mm

// Paper in mm with y down, before the piece has its place on the sheet.
Mm turned(Flat p) { return {p.u * 1000, -p.v * 1000}; }

void grow(SheetPiece& piece, Mm p) {
  piece.low = {std::min(piece.low.x, p.x), std::min(piece.low.y, p.y)};
  piece.high = {std::max(piece.high.x, p.x), std::max(piece.high.y, p.y)};
}

SheetPiece draw(const Pattern& pattern, const Piece& piece, const AllowancePlan* plan) {
  SheetPiece out;
  out.piece = &piece;
  out.foldedHoles = foldedHoles(pattern, piece.id);
  const Ring ring = piece.outline.flattened(1e-5);
  out.low = out.high = turned(ring[0]);
  for (const Flat p : ring) grow(out, turned(p));
  const auto add = [&](const Ring& cut) {
    out.cutLines.emplace_back();
    for (const Flat p : cut) {
      out.cutLines.back().push_back(turned(p));
      grow(out, turned(p));
    }
  };
  if (const auto cut = plan ? cutLines(piece, *plan) : std::nullopt) {
    add(cut->outer);
    for (const Ring& hole : cut->holes) add(hole);
    const auto widths = [&](const Outline& outline) {
      for (const Edge& edge : outline.edges) out.allowances[edge.name] = plan->width(piece.id, edge.name) * 1000;
    };
    widths(piece.outline);
    for (const Outline& hole : piece.holes) widths(hole);
  }
  for (const Flat hole : drillHoles(pattern, piece)) out.drills.push_back(turned(hole));
  return out;
}

// Graded pieces in their other sizes too.
Done addNest(Sheet& sheet, const Pattern& pattern, const SheetSettings& settings) {
  const Grading& grading = settings.grading;
  if (!settings.nest || grading.pieces.empty()) return {};
  sheet.sizes = grading.sizes;
  for (std::size_t size = 0; size < grading.sizes.size(); ++size) {
    if (size == grading.standing) continue;
    const auto in = patternInSize(pattern, grading, size);
    if (!in) return in.error();
    const auto plan = allowancesOn(*in, settings);
    if (!plan) return plan.error();
    for (SheetPiece& piece : sheet.pieces) {
      if (!grading.pieces.contains(piece.piece->id)) continue;
      const Piece& other = *in->pieces.at(piece.piece->id);
      const auto cut = *plan ? cutLines(other, **plan) : std::nullopt;
      SheetSize drawn{size, {}, {}};
      for (const Flat p : cut ? cut->outer : other.outline.flattened(1e-5)) {
        drawn.line.push_back(turned(p));
        grow(piece, turned(p));
      }
      const std::string& name = grading.sizes[size];
      double farthest = -1;
      for (std::size_t k = 0; k < other.outline.edges.size(); ++k) {
        const Flat corner = other.outline.edges[k].curve.start;
        const double away = distance(corner, piece.piece->outline.edges[k].curve.start);
        if (away > farthest + 1e-6) farthest = away, drawn.name = {turned(corner), 3, true, name};
      }
      piece.nest.push_back(std::move(drawn));
    }
  }
  return {};
}

// The strips that are cut for bindings and piping. They are cut as they are drawn, the allowances are in them.
void addStrips(Sheet& sheet, const Pattern& pattern, const SheetSettings& settings) {
  for (const BiasStrip& strip :
       biasStrips(pattern, settings.allowances, timesCut(pattern, settings.allowances, settings.cutting))) {
    sheet.strips.push_back(stripPiece(strip, sheet.strips.size()));
    SheetPiece drawn = draw(pattern, *sheet.strips.back(), nullptr);
    drawn.strip = true;
    const double l = strip.cutLength, w = strip.width;
    const double size = std::min(4.0, w * 1000 / 4);
    const Message words = say("bias strip · cut {0} · {1} · {2} mm × {3} cm", strip.count, nameSaid(strip.fabric),
                              std::round(w * 1e4) / 10, std::round(l * 1e3) / 10);
    drawn.texts.push_back({turned({(l + w) / 2, w / 2}), size, true, cleanText(text(words, settings.language))});
    drawn.grain = {turned({1.1 * w, 0.1 * w}), turned({1.9 * w, 0.9 * w})};
    sheet.pieces.push_back(std::move(drawn));
  }
}

// Shelves: the tallest first, from left to right, a new shelf below when the roll's width is used up.
void shelve(Sheet& sheet, double rollWidth, double header) {
  std::vector<std::size_t> order(sheet.pieces.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto tall = [&](std::size_t i) { return sheet.pieces[i].high.y - sheet.pieces[i].low.y; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tall(a) > tall(b); });
  double widest = rollWidth - 2 * kMargin;
  for (const SheetPiece& piece : sheet.pieces) widest = std::max(widest, piece.high.x - piece.low.x);
  Mm at{kMargin, kMargin + header};
  double shelf = 0, used = 1.7 * kSquare + kMargin;
  for (const std::size_t i : order) {
    SheetPiece& piece = sheet.pieces[i];
    const double wide = piece.high.x - piece.low.x;
    if (at.x > kMargin && at.x + wide > kMargin + widest + 1e-9) at = {kMargin, at.y + shelf + kGap}, shelf = 0;
    moveBy(piece, at - piece.low);
    at.x += wide + kGap;
    shelf = std::max(shelf, tall(i));
    used = std::max(used, piece.high.x);
  }
  sheet.width = std::ceil(used + kMargin);
  sheet.height = std::ceil(at.y + shelf + kMargin);
}

struct SheetLettering {
  std::vector<std::string> words;
  LetteredPiece room;
};

// `twin`: what is cut by the same drawing, turned over; null: nothing.
SheetLettering addLabels(SheetPiece& out, const SheetSettings& settings, bool onFold, bool faceDown,
                         const Piece* twin) {
  std::vector<std::string> lines;
  const auto own = settings.cutting.find(out.piece->id);
  CutFacts facts{
      own == settings.cutting.end() ? Cutting() : own->second, onFold, faceDown, settings.size, settings.date, {}};
  if (twin) facts.twin = twin->name, facts.cutting = {2 * facts.cutting.count, true};
  for (const Message& line : labelOf(*out.piece, facts)) lines.push_back(cleanText(text(line, settings.language)));
  out.labels = lines.size();
  const LetteredPiece room = roomFor(*out.piece, lines);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const LetteredPiece::Line& line = room.lines[i];
    out.texts.push_back({out.at(line.place), line.size * 1000, line.upright, lines[i]});
  }
  if (room.grain) out.grain = {out.at(room.grain->from), out.at(room.grain->to)};
  return {lines, room};
}

// A bracket whose arrows point at the fold, and the word beside it.
void addFolds(SheetPiece& out, const AllowancePlan& plan, Language language) {
  constexpr double kDepth = 0.010, kShare = 0.15, kLeast = 0.04;  // metres, of the edge's length, metres
  for (const Edge& edge : out.piece->outline.edges) {
    const Flat along = edge.curve.end - edge.curve.start;
    if (plan.kind(out.piece->id, edge.name) != EdgeKind::Fold || edge.curve.kind != Curve::Kind::Line ||
        length(along) < kLeast)
      continue;
    const Flat in = leftOf(normalized(along)) * kDepth, from = edge.curve.start + along * kShare,
               to = edge.curve.end - along * kShare;
    out.folds.push_back({out.at(from), out.at(from + in), out.at(to + in), out.at(to)});
    SheetText words{out.at(lerp(from, to, 0.5) + in * 1.5), 4, std::abs(along.v) < std::abs(along.u),
                    text(say("place on the fold"), language)};
    if (wordsWidth(words.words, words.size) < 700 * length(along)) out.texts.push_back(std::move(words));
  }
}

constexpr double kMatchSize = 0.003;  // metres: the number beside a bar at which the print matches
constexpr double kLineSaid = 7.2;     // mm of the header: a line more in it

std::map<PieceId, SheetPiece*> byId(Sheet& sheet) {
  std::map<PieceId, SheetPiece*> of;
  for (SheetPiece& piece : sheet.pieces) of[piece.piece->id] = &piece;
  return of;
}

void addNotches(Sheet& sheet, const Pattern& pattern, const AllowancePlan* plan, const SheetSettings& settings) {
  const std::map<PieceId, SheetPiece*> of = byId(sheet);
  std::vector<NotchPlace> notches = notchPlaces(pattern);
  for (const NotchPlace& notch : finishNotches(pattern, settings.allowances)) notches.push_back(notch);
  for (const NotchPlace& notch : notches) {
    SheetPiece& piece = *of.at(notch.piece);
    const PaperStroke stroke = strokeOf(notch, plan ? plan->width(notch.piece, notch.edge) : 0);
    piece.notches.push_back({{piece.at(stroke.from), piece.at(stroke.to)}, notch.seam, notch.corner});
  }
  for (const PaperArrow& arrow : pleatArrows(pattern))
    for (const PaperStroke& stroke : {arrow.shaft, arrow.head, arrow.otherHead}) {
      SheetPiece& piece = *of.at(arrow.piece);
      piece.notches.push_back({{piece.at(stroke.from), piece.at(stroke.to)}, {}, false});
    }
  for (const PaperFastener& fastener : fastenersOf(pattern, settings.allowances.fastenings))
    for (const PaperStroke& stroke : fastener.strokes) {
      SheetPiece& piece = *of.at(fastener.piece);
      piece.notches.push_back({{piece.at(stroke.from), piece.at(stroke.to)}, {}, false});
    }
  for (const MatchMark& mark : settings.matches) {
    const auto found = of.find(mark.piece);
    if (found == of.end()) continue;
    SheetPiece& piece = *found->second;
    piece.notches.push_back({{piece.at(mark.from), piece.at(mark.to)}, {}, false});
  }
  for (const StitchRow& row : stitchRows(pattern, settings.allowances)) {
    SheetPiece& piece = *of.at(row.piece);
    SheetStitches& drawn = piece.stitches.emplace_back();
    drawn.length = row.topstitch.length * 1000;
    for (const Flat place : row.points) drawn.line.push_back(piece.at(place));
  }
  for (const TrimRun& run : trimRuns(pattern, settings.allowances)) {
    SheetPiece& piece = *of.at(run.piece);
    std::vector<Mm>& drawn = piece.trims.emplace_back();
    for (const Flat place : run.inside) drawn.push_back(piece.at(place));
  }
}

// The seams' numbers. Where one drawing does for two pieces, those of the second stand behind the first's: "12/15".
std::vector<SheetText> numbersOn(const SheetPiece& piece, const std::vector<SeamTag>& tags, const SheetPiece* second) {
  constexpr double kNear = 15;  // mm
  std::vector<SheetText> numbers;
  for (const SeamTag& tag : tags)
    if (tag.piece == piece.piece->id)
      numbers.push_back({piece.at(tag.place), kSeamTagSize * 1000, true, std::to_string(tag.number)});
  if (!second) return numbers;
  const std::size_t own = numbers.size();
  for (const SeamTag& tag : tags) {
    if (tag.piece != second->piece->id) continue;
    const Mm place = turnedOver(*second, piece, second->at(tag.place));
    const auto away = [&](const SheetText& number) {
      return std::hypot(number.place.x - place.x, number.place.y - place.y);
    };
    const auto nearest = std::min_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(own),
                                          [&](const auto& a, const auto& b) { return away(a) < away(b); });
    const std::string number = std::to_string(tag.number);
    if (own == 0 || away(*nearest) > kNear)
      numbers.push_back({place, kSeamTagSize * 1000, true, "/" + number});
    else if (nearest->words != number)
      nearest->words += "/" + number;
  }
  return numbers;
}

// After the labels: the numbers of matching bars and of seams, and what is said along edges.
void addWords(Sheet& sheet, const Pattern& pattern, const SheetSettings& settings,
              const std::map<PieceId, SheetLettering>& lettering, const std::map<PieceId, const SheetPiece*>& twins) {
  const std::map<PieceId, SheetPiece*> of = byId(sheet);
  for (const MatchMark& mark : settings.matches)
    if (const auto found = of.find(mark.piece); found != of.end())
      found->second->texts.push_back({found->second->at(mark.to + normalized(mark.to - mark.from) * (1.2 * kMatchSize)),
                                      kMatchSize * 1000, true, "#" + std::to_string(mark.number)});
  const std::vector<SeamTag> all = seamTags(pattern);
  std::map<PieceId, std::vector<Flat>> tags;
  for (const SeamTag& tag : all) tags[tag.piece].push_back(tag.place);
  for (SheetPiece& piece : sheet.pieces) {
    if (piece.strip) continue;
    const auto twin = twins.find(piece.piece->id);
    for (SheetText& number : numbersOn(piece, all, twin == twins.end() ? nullptr : twin->second))
      piece.texts.push_back(std::move(number));
  }
  std::map<PieceId, std::vector<WishedNote>> notes;
  for (const PaperNote& note : notesOf(pattern, settings.allowances))
    notes[note.piece].push_back({text(note.words, settings.language), {note.place, kNoteSize, note.upright}});
  for (const auto& [id, wished] : notes) {
    SheetPiece& piece = *of.at(id);
    const auto& [words, lettered] = lettering.at(id);
    const auto places = roomForNotes(*piece.piece, wished, words, lettered, tags[id]);
    for (std::size_t k = 0; k < wished.size(); ++k)
      piece.texts.push_back({piece.at(places[k].place), places[k].size * 1000, places[k].upright, wished[k].words});
  }
}

}  // namespace

void moveBy(SheetPiece& piece, Mm by) {
  const auto move = [&](Mm& p) { p = p + by; };
  const auto moveAll = [&](std::vector<std::vector<Mm>>& lines) {
    for (auto& line : lines) std::for_each(line.begin(), line.end(), move);
  };
  move(piece.origin), move(piece.low), move(piece.high);
  moveAll(piece.cutLines), moveAll(piece.folds), moveAll(piece.trims);
  std::for_each(piece.drills.begin(), piece.drills.end(), move);
  for (SheetStitches& row : piece.stitches) std::for_each(row.line.begin(), row.line.end(), move);
  for (SheetSize& size : piece.nest) {
    move(size.name.place);
    std::for_each(size.line.begin(), size.line.end(), move);
  }
  for (SheetNotch& notch : piece.notches) move(notch.stroke.from), move(notch.stroke.to);
  for (SheetText& words : piece.texts) move(words.place);
  if (piece.grain) move(piece.grain->from), move(piece.grain->to);
}

std::vector<double> dashesOf(std::size_t size) {
  static const std::vector<double> kDashes[] = {{6, 2}, {3, 2}, {1, 2}, {8, 2, 1, 2}, {8, 2, 3, 2}, {8, 2, 1, 2, 1, 2},
                                                {4, 1}, {12, 3}};
  return kDashes[size % std::size(kDashes)];
}

void tellGarment(const Document& document, const PhotoTall& tall, SheetSettings& settings) {
  settings.allowances = document.allowances;
  settings.cutting = document.cutting;
  settings.grading = document.grading;
  if (auto fabrics = fabricsInUse(document)) settings.fabrics = *std::move(fabrics);
  if (tall) settings.matches = matchMarks(document, tall);
  settings.order.clear();
  for (const SewingStep& step : sewingOrder(document)) settings.order.push_back(step.words);
  settings.size = sizeSaid(document);
}

Allowances ownWidths(const Pattern& pattern, Allowances told) {
  constexpr double kSameWidth = 1e-9;  // metres
  const AllowancePlan usual(pattern, {});
  std::erase_if(told.edges, [&](const auto& one) {
    return std::abs(usual.width(one.first.first, one.first.second) - one.second) < kSameWidth;
  });
  return told;
}

void leaveOutHoles(CadPattern& read) {
  const auto ofHoles = std::erase_if(read.cutting.allowances.edges, [&](const auto& one) {
    return !read.pattern.pieces.at(one.first.first)->outline.find(one.first.second);
  });
  if (ofHoles > 0) read.notes.push_back(say("Seam allowances of holes were left out; they are as usual."));
}

Result<std::optional<AllowancePlan>> allowancesOn(const Pattern& pattern, const SheetSettings& settings) {
  Allowances all = settings.allowances;
  if (settings.allowance) {
    if (!(*settings.allowance >= 0 && *settings.allowance <= kWidestAllowance))
      return refused(say("A seam allowance lies between 0 and 100 mm; usual are 7 to 15 mm."));
    if (*settings.allowance == 0) return std::optional<AllowancePlan>();
    all.kinds[EdgeKind::Seam] = *settings.allowance;
  }
  return std::optional(AllowancePlan(pattern, std::move(all)));
}

namespace {

// "10 mm, hems 30 mm": of the kinds that there are, then whether single edges have their own.
Message widthsSaid(const Pattern& pattern, const AllowancePlan& plan) {
  std::set<EdgeKind> there;
  for (const auto& [id, piece] : pattern.pieces)
    for (const Edge& edge : piece->outline.edges) there.insert(plan.kind(id, edge.name));
  const auto mm = [&](EdgeKind kind) { return std::round(plan.width(kind) * 1e4) / 10; };
  Message all = say("Seam allowance {0} mm", mm(EdgeKind::Seam));
  if (there.contains(EdgeKind::Hem)) all = say("{0}, hems {1} mm", all, mm(EdgeKind::Hem));
  if (there.contains(EdgeKind::Neckline)) all = say("{0}, necklines {1} mm", all, mm(EdgeKind::Neckline));
  if (!plan.allowances().edges.empty()) all = say("{0}; some edges as drawn", all);
  return all;
}

// In columns at the right of the square, no deeper than it.
void addOrder(Sheet& sheet, const SheetSettings& settings) {
  constexpr double kSize = 3.2, kDown = 1.8 * kSize, kBetween = 8, kWidest = 120;  // mm
  std::vector<std::string> lines;
  for (const std::string& whole : orderLines(settings))
    for (std::string& line : brokenInto(whole, kWidest, [](std::string_view part) { return wordsWidth(part, kSize); }))
      lines.push_back(std::move(line));
  Mm at = sheet.square + Mm{kSquare + 15, kSize};
  const double top = at.y, bottom = sheet.square.y + kSquare;
  double wide = 0;
  for (const std::string& line : lines) {
    if (at.y > bottom) at = {at.x + wide + kBetween, top}, wide = 0;
    sheet.headings.push_back({at, kSize, true, line});
    wide = std::max(wide, wordsWidth(line, kSize));
    at.y += kDown;
  }
}

}  // namespace

std::vector<std::string> orderLines(const SheetSettings& settings) {
  std::vector<std::string> lines;
  if (settings.order.empty()) return lines;
  lines.push_back(text(say("Order of sewing"), settings.language));
  for (std::size_t k = 0; k < settings.order.size(); ++k)
    lines.push_back(std::to_string(k + 1) + ". " + text(settings.order[k], settings.language));
  return lines;
}

Result<Sheet> layOut(const Pattern& pattern, const SheetSettings& settings) {
  if (pattern.pieces.empty()) return refused(say("There is no piece to print."));
  const auto allowances = allowancesOn(pattern, settings);
  if (!allowances) return allowances.error();
  const AllowancePlan* plan = *allowances ? &**allowances : nullptr;
  if (!std::isfinite(settings.rollWidth) || settings.rollWidth < 0.1 || settings.rollWidth > 10)
    return refused(say("A roll of paper is between 0.1 and 10 m wide."));
  Sheet sheet;
  sheet.title = cleanText(settings.title);
  for (const auto& [id, piece] : pattern.pieces) {
    sheet.pieces.push_back(draw(pattern, *piece, plan));
  }
  addStrips(sheet, pattern, settings);
  if (const Done done = addNest(sheet, pattern, settings); !done) return done.error();
  addNotches(sheet, pattern, plan, settings);
  const std::map<PieceId, PieceId> seconds =
      settings.pairsOnce ? secondsOfPairs(sheet.pieces, settings) : std::map<PieceId, PieceId>();
  std::map<PieceId, const SheetPiece*> twins;  // of the first of each pair the second
  for (const SheetPiece& piece : sheet.pieces)
    if (const auto second = seconds.find(piece.piece->id); second != seconds.end()) twins[second->second] = &piece;
  const AllowancePlan kinds(pattern, settings.allowances);
  std::map<PieceId, SheetLettering> lettering;
  const std::set<PieceId> faceDown = cutFaceDown(pattern, kinds, settings.cutting);
  for (SheetPiece& piece : sheet.pieces) {
    if (piece.strip) continue;
    const PieceId id = piece.piece->id;
    const Piece* twin = twins.contains(id) ? twins.at(id)->piece : nullptr;
    lettering[id] = addLabels(piece, settings, kinds.onFold(*piece.piece), !twin && faceDown.contains(id), twin);
    addFolds(piece, kinds, settings.language);
  }
  addWords(sheet, pattern, settings, lettering, twins);
  std::erase_if(sheet.pieces, [&](const SheetPiece& piece) { return seconds.contains(piece.piece->id); });
  shelve(sheet, settings.rollWidth * 1000,
         kHeader + (settings.matches.empty() ? 0 : kLineSaid) + (seconds.empty() ? 0 : kLineSaid));

  sheet.square = {kMargin, kMargin};
  const auto said = [&](const Message& message) { return text(message, settings.language); };
  // Below the square and no wider than an A4 page shows, so that the first sheet can be read as it is.
  Mm at{kMargin, kMargin + kSquare + 10};
  const auto heading = [&](std::string words, double size) {
    sheet.headings.push_back({at, size, true, std::move(words)});
    at.y += size * 1.8;
  };
  heading(sheet.title, 7);
  heading(said(say("Print at 100 %. The square must measure 100 mm.")), 4);
  if (plan) {
    heading(said(say("Solid line: cut. Dashed line: sew.")), 4.5);
    heading(said(say("{0}.", widthsSaid(pattern, *plan))), 4);
  } else
    heading(said(say("The lines are seam lines: add the seam allowance yourself.")), 4);
  heading(said(say("Arrow: grain. Short strokes: notches. Equal numbers are sewn together.")), 4);
  if (!settings.matches.empty())
    heading(said(say("Bars with equal numbers (#): lay them on the same line of the print.")), 4);
  if (!seconds.empty())
    heading(said(say("What is cut in pairs is drawn once: cut one as it lies and one turned over.")), 4);
  Message notions;
  for (const Message& one : notionsSaid(pattern, settings.allowances, settings.cutting))
    notions = notions.empty() ? one : say("{0}, {1}", notions, one);
  if (!notions.empty()) heading(said(say("Notions: {0}", notions)), 4);
  addOrder(sheet, settings);
  for (const SheetText& words : sheet.headings)
    sheet.width = std::max(sheet.width, std::ceil(words.place.x + wordsWidth(words.words, words.size) + kMargin));
  return sheet;
}

}  // namespace karinui

#include "karinui/pattern/markings.h"

#include "karinui/pattern/darts.h"
#include "karinui/pattern/pleats.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui {
namespace {

constexpr double kLongSeam = 0.150;      // metres: an eased seam longer than this gets a balance notch in its middle
constexpr double kVeryLongSeam = 0.400;  // an even one too
constexpr double kEased = 1.003;
constexpr double kCornerCosine = 0.85;  // outlines that turn by more than about 32 degrees have a corner of their own

constexpr double kTagDepth = 0.006;  // metres from the edge to the middle of a seam's number

Flat unitTangent(const Curve& curve, double t) {
  const Flat there = curve.tangent(t);
  if (length(there) > 1e-9) return normalized(there);
  return normalized(t < 0.5 ? curve.at(t + 1e-3) - curve.at(t)
                            : curve.at(t) - curve.at(t - 1e-3));  // a handle of no length
}

// Whether a name says so: "back", "back_left", "left back"; 後身頃.
bool says(std::string_view name, std::string_view word) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  for (std::size_t at = name.find(word); at != std::string_view::npos; at = name.find(word, at + 1))
    if (static_cast<unsigned char>(word[0]) >= 0x80 ||
        ((at == 0 || !letter(name[at - 1])) && (at + word.size() == name.size() || !letter(name[at + word.size()]))))
      return true;
  return false;
}
bool isBack(const Piece& piece) { return says(piece.name, "back") || says(piece.name, "後"); }
bool isFront(const Piece& piece) { return says(piece.name, "front") || says(piece.name, "前"); }

constexpr double kTagRoom = 0.0045;  // metres that all lines keep from the middle of a seam's number

std::vector<std::vector<Flat>> linesOf(const Piece& piece) {
  std::vector<std::vector<Flat>> lines;
  const auto add = [&](const Curve& curve) { lines.push_back(curve.flattened(2e-4)); };
  for (const Edge& edge : piece.outline.edges) add(edge.curve);
  for (const Outline& hole : piece.holes)
    for (const Edge& edge : hole.edges) add(edge.curve);
  for (const InternalLine& line : piece.lines)
    for (const Curve& curve : line.curves) add(curve);
  return lines;
}
double roomAt(const std::vector<std::vector<Flat>>& lines, Flat place) {
  double room = 1e9;
  for (const auto& line : lines)
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      room = std::min(room, distanceToSegment(line[i], line[i + 1], place));
  return room;
}

constexpr double kTwin = 0.003;  // metres to either side of the place: two notches for one

// The fractions along a seam at which notches stand for a place: one, or two where there is room beside it.
std::vector<double> notchesFor(const Pattern& pattern, const SeamSides& sides, double fraction) {
  const auto pieceAt = [&](const SeamSide& side) { return pattern.pieces.find(side.at(fraction).piece); };
  const auto a = pieceAt(sides.a), b = pieceAt(sides.b);
  if (a == pattern.pieces.end() || b == pattern.pieces.end()) return {fraction};
  const Piece &one = *a->second, &other = *b->second;
  const bool back = (isBack(one) && !isFront(other)) || (isBack(other) && !isFront(one));
  const double apart = kTwin / std::max(1e-9, std::min(sides.a.length(), sides.b.length()));
  if (!back || fraction < 2 * apart || fraction > 1 - 2 * apart) return {fraction};
  for (const SeamSide* side : {&sides.a, &sides.b})  // where another piece begins one notch says it all
    if (side->at(fraction - apart).piece != side->at(fraction + apart).piece) return {fraction};
  return {fraction - apart, fraction + apart};
}

}  // namespace

std::optional<BorderPlace> borderPlace(const Pattern& pattern, const SeamPlace& at) {
  const auto found = pattern.pieces.find(at.piece);
  if (found == pattern.pieces.end()) return std::nullopt;
  const Piece& piece = *found->second;
  const auto on = [&](const Outline& outline, double side) -> std::optional<BorderPlace> {
    const auto index = outline.find(at.edge);
    if (!index) return std::nullopt;
    const Curve& curve = outline.edges[*index].curve;
    const double t = curve.parameterAt(std::clamp(at.fraction, 0.0, 1.0) * curve.length());
    const Flat along = unitTangent(curve, t);
    BorderPlace out{curve.at(t), leftOf(along) * -side, false};
    const std::size_t count = outline.edges.size();
    const double tiny = 1e-4 / curve.length();
    if (at.fraction < tiny)
      out.corner = dot(unitTangent(outline.edges[(*index + count - 1) % count].curve, 1), along) < kCornerCosine;
    if (at.fraction > 1 - tiny)
      out.corner = dot(unitTangent(outline.edges[(*index + 1) % count].curve, 0), along) < kCornerCosine;
    return out;
  };
  if (const auto outside = on(piece.outline, 1)) return outside;
  for (const Outline& hole : piece.holes)
    if (const auto within = on(hole, -1)) return within;
  return std::nullopt;
}

std::optional<BorderPlace> sewnPlace(const Pattern& pattern, const SeamPlace& at) {
  if (auto on = borderPlace(pattern, at)) return on;
  const Curve* curve = curveOf(pattern, at.piece, at.edge);
  if (!curve) return std::nullopt;
  const double t = curve->parameterAt(std::clamp(at.fraction, 0.0, 1.0) * curve->length());
  return BorderPlace{curve->at(t), -leftOf(unitTangent(*curve, t)), false};
}

std::vector<NotchPlace> notchPlaces(const Pattern& pattern) {
  std::vector<NotchPlace> out;
  std::set<SeamId> drilled;  // darts that holes mark
  for (const DoubleDart& dart : doubleDartsOf(pattern))
    if (dart.folded()) drilled.insert(dart.seam);
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.tie == Seam::Tie::Pleat || drilled.contains(id)) continue;
    const SeamSides sides(pattern, seam);
    std::vector<double> fractions = sides.breaks();
    if (fractions.empty()) continue;
    const double shorter = std::min(sides.a.length(), sides.b.length()),
                 longer = std::max(sides.a.length(), sides.b.length());
    const bool balance = (longer > kLongSeam && longer > kEased * shorter) || longer > kVeryLongSeam;
    const bool free =
        std::none_of(fractions.begin(), fractions.end(), [](double f) { return std::abs(f - 0.5) < 0.1; });
    if (balance && free) fractions.insert(std::upper_bound(fractions.begin(), fractions.end(), 0.5), 0.5);
    if (balance && !free) {  // an armhole over its shoulder: one in front, two behind tell a sleeve's sides apart
      std::vector<double> ends = fractions;
      ends.insert(ends.begin(), 0), ends.push_back(1);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        if ((ends[k + 1] - ends[k]) * longer > kLongSeam) fractions.push_back((ends[k] + ends[k + 1]) / 2);
      std::sort(fractions.begin(), fractions.end());
    }
    for (const double fraction : fractions) {
      const SeamPlace atA = sides.a.at(fraction), atB = sides.b.at(fraction);
      const auto a = borderPlace(pattern, atA), b = borderPlace(pattern, atB);
      if (!a || !b) continue;
      if (a->corner && b->corner) continue;  // two corners find each other
      for (const double at : notchesFor(pattern, sides, fraction)) {
        const SeamPlace onA = sides.a.at(at), onB = sides.b.at(at);
        const auto one = borderPlace(pattern, onA), other = borderPlace(pattern, onB);
        if (!one || !other) continue;
        out.push_back({onA.piece, one->place, one->outward, seam.name, false, onA.edge, one->corner});
        out.push_back({onB.piece, other->place, other->outward, seam.name, false, onB.edge, other->corner});
      }
    }
  }
  for (const PaperDart& dart : dartsOf(pattern)) {
    if (!dart.folded()) continue;
    const auto& edges = pattern.pieces.at(dart.piece)->outline.edges;
    const std::size_t n = edges.size();
    const SeamPlace ends[] = {{dart.piece, edges[(dart.to + n - 1) % n].name, 1},
                              {dart.piece, edges[(dart.back + 1) % n].name, 0}};
    for (const SeamPlace& end : ends)
      if (const auto on = borderPlace(pattern, end))
        out.push_back({dart.piece, on->place, on->outward, pattern.seams.at(dart.seam).name, false, end.edge});
  }
  for (const PaperPleat& pleat : pleatsOf(pattern))
    for (const Flat end : {pleat.fold, pleat.place}) {
      const bool drawn = std::any_of(out.begin(), out.end(), [&](const NotchPlace& notch) {
        return notch.piece == pleat.piece && distance(notch.place, end) < 1e-6;
      });
      if (!drawn) out.push_back({pleat.piece, end, -pleat.along, "", false, pleat.edge});
    }
  for (const auto& [id, piece] : pattern.pieces)
    for (const Mark& mark : piece->marks)
      if (!mark.edge.empty())
        if (const auto on = borderPlace(pattern, {id, mark.edge, mark.fraction}))
          out.push_back({id, on->place, on->outward, "", true, mark.edge});
  return out;
}

PaperStroke strokeOf(const NotchPlace& notch, double allowance) {
  return {notch.place, notch.place + notch.outward * (allowance > 0 ? allowance : -kNotchLength)};
}

std::vector<Flat> drillHoles(const Piece& piece) {
  std::vector<Flat> out;
  for (const Mark& mark : piece.marks)
    if (mark.edge.empty()) out.push_back(mark.place);
  return out;
}

std::vector<Flat> drillHoles(const Pattern& pattern, const Piece& piece) {
  std::vector<Flat> out = drillHoles(piece);
  for (const PaperDart& dart : dartsOf(pattern)) {
    const Flat middle = lerp(dart.from, dart.until, 0.5);
    if (dart.piece == piece.id && dart.folded() && distance(middle, dart.point) > 2 * kDrillShort)
      out.push_back(dart.point + normalized(middle - dart.point) * kDrillShort);
  }
  for (const DoubleDart& dart : doubleDartsOf(pattern)) {
    if (dart.piece != piece.id || !dart.folded()) continue;
    const Flat middle = lerp(dart.left, dart.right, 0.5);
    for (const Flat point : {dart.from, dart.to})
      if (distance(middle, point) > 2 * kDrillShort) out.push_back(point + normalized(middle - point) * kDrillShort);
    for (const Flat leg : {dart.left, dart.right})
      if (distance(middle, leg) > 2 * kDrillInside) out.push_back(leg + normalized(middle - leg) * kDrillInside);
  }
  return out;
}

std::vector<PaperNote> notesOf(const Pattern& pattern, const Allowances& finish) {
  constexpr double kDepth = 0.014;       // metres from the edge, within the seams' numbers
  constexpr double kBelowArrow = 0.055;  // metres from the edge to the middle of a pleat's words
  constexpr double kGathered = 1.1;      // times as long as the other side; less is eased in
  constexpr double kBesideMiddle = 0.3;  // of the edge: in its middle an elastic's words may stand
  constexpr double kWordsFit = 0.05;     // metres of edge
  std::vector<PaperNote> notes;
  const auto flat = [](Flat along) { return std::abs(along.u) >= std::abs(along.v); };
  for (const auto& [at, elastic] : finish.elastics)
    if (const auto on = sewnPlace(pattern, {at.first, at.second, 0.5})) {
      const double cut = elastic.ratio * curveOf(pattern, at.first, at.second)->length();
      notes.push_back({at.first, say("elastic {0} cm", std::round(cut * 1000) / 10), on->place - on->outward * kDepth,
                       flat(leftOf(on->outward))});
    }
  for (const auto& [at, hem] : finish.hems)
    if (const auto on = borderPlace(pattern, {at.first, at.second, 0.5})) {
      const double width = std::round(hem.width * 1e4) / 10, under = std::round(hem.under * 1e4) / 10;
      notes.push_back({at.first,
                       under > 0 ? say("hem {0} mm, {1} mm turned in", width, under) : say("hem {0} mm", width),
                       on->place - on->outward * kDepth, flat(leftOf(on->outward))});
    }
  const auto beside = [&](const Allowances::At& at, Message words) {
    if (const auto on = sewnPlace(pattern, {at.first, at.second, 0.5}))
      notes.push_back({at.first, std::move(words), on->place - on->outward * kDepth, flat(leftOf(on->outward))});
  };
  const auto mm = [](double metres) { return std::round(metres * 1e4) / 10; };
  for (const auto& [at, own] : finish.pipings) beside(at, say("piping {0} mm", mm(own.thickness)));
  for (const auto& [at, own] : finish.bindings) beside(at, say("bound {0} mm", mm(own.width)));
  for (const auto& [name, own] : finish.fastenings)
    for (const bool over : {true, false}) {
      const SeamSide side(pattern, over ? own.a : own.b, !over && own.reversed);
      if (side.length() <= 0 || own.at.size() < 2) continue;
      const SeamPlace at = side.at(0.5 * (own.at.front() + own.at.back()));
      if (const auto on = sewnPlace(pattern, at))
        notes.push_back({at.piece, fastenedSaid(pattern, own, over),
                         on->place - on->outward * (own.inset + own.size / 2 + kDepth), flat(leftOf(on->outward))});
    }
  for (const auto& [id, seam] : pattern.seams) {
    if (seam.tie == Seam::Tie::Pleat) continue;
    const SeamSides sides(pattern, seam);
    const bool first = sides.a.length() > sides.b.length();
    const SeamSide &longer = first ? sides.a : sides.b, &shorter = first ? sides.b : sides.a;
    if (!(shorter.length() > 0 && longer.length() >= kGathered * shorter.length())) continue;
    for (const EdgeSpan& span : longer.spans()) {
      const auto on = sewnPlace(pattern, {span.piece, span.edge, std::lerp(span.from, span.to, kBesideMiddle)});
      if (!on) continue;
      const double own = (span.to - span.from) * curveOf(pattern, span.piece, span.edge)->length();
      if (own < kWordsFit) continue;
      const double to = own * shorter.length() / longer.length();
      notes.push_back({span.piece, say("gather to {0} cm", std::round(to * 1000) / 10),
                       on->place - on->outward * kDepth, flat(leftOf(on->outward))});
    }
  }
  const std::vector<PaperPleat> pleats = pleatsOf(pattern);
  for (const PaperPleat& pleat : pleats) {  // between the fold and the one inside it, below the arrow
    const double depth = distance(pleat.fold, pleat.inner);
    notes.push_back({pleat.piece, say("pleat {0} mm", std::round(depth * 1e4) / 10),
                     lerp(pleat.fold, pleat.inner, 0.5) + pleat.along * kBelowArrow, flat(pleat.along)});
  }
  const auto ofPleat = [&](PieceId id, const InternalLine& line) {
    return std::any_of(pleats.begin(), pleats.end(), [&](const PaperPleat& pleat) {
      const auto at = [&](Flat end) { return distance(end, pleat.fold) < 1e-6 || distance(end, pleat.inner) < 1e-6; };
      return pleat.piece == id && (at(line.curves.front().start) || at(line.curves.back().end));
    });
  };
  for (const auto& [id, piece] : pattern.pieces)
    for (const InternalLine& line : piece->lines) {
      if (!line.crease || line.curves.empty() || ofPleat(id, line)) continue;
      const Curve& curve = line.curves[line.curves.size() / 2];
      const double turn = std::round(line.crease->angle * 1800 / std::numbers::pi) / 10;
      const Flat along = curve.tangent(0.5);
      notes.push_back({id, turn > 0 ? say("fold {0}°, right sides together", turn) : say("fold {0}°", -turn),
                       curve.at(0.5) + leftOf(normalized(along)) * kNoteSize, flat(along)});
    }
  return notes;
}

std::vector<PaperArrow> pleatArrows(const Pattern& pattern) {
  constexpr double kDepth = 0.030, kHead = 0.004;  // metres from the edge; of the head
  std::vector<PaperArrow> arrows;
  for (const PaperPleat& pleat : pleatsOf(pattern)) {
    const Flat in = pleat.along * kDepth, from = pleat.fold + in, to = pleat.place + in;
    const Flat back = normalized(from - to) * kHead, aside = leftOf(back) * 0.4;
    arrows.push_back({pleat.piece, {from, to}, {to, to + back + aside}, {to, to + back - aside}});
  }
  return arrows;
}

std::vector<PaperFastener> fastenersOf(const Pattern& pattern, const Fastenings& fastenings) {
  constexpr double kArm = 0.004, kBeyond = 0.003, kBar = 0.0015;  // metres: of a cross; of a hole beyond the button
  std::vector<PaperFastener> out;
  const auto cross = [&](const FasteningPlace& at) {
    const Flat along = leftOf(at.outward) * kArm, across = at.outward * kArm;
    out.push_back({at.piece, {{at.place - along, at.place + along}, {at.place - across, at.place + across}}});
  };
  for (const auto& [name, own] : fastenings) {
    if (own.kind == FasteningKind::Zip) continue;
    for (const FastenedPlaces& pair : placesOf(pattern, own)) {
      cross(pair.b);
      if (own.kind != FasteningKind::Button) {
        cross(pair.a);
        continue;
      }
      // The button rests at the hole's end next to the edge, or the upper one.
      const FasteningPlace& at = pair.a;
      Flat way = own.holesAlong ? leftOf(at.outward) : at.outward;
      if (own.holesAlong && way.v < 0) way = way * -1;
      const Flat from = at.place + way * kBeyond, to = from - way * (own.size + kHoleLonger), bar = leftOf(way) * kBar;
      out.push_back({at.piece, {{from, to}, {from - bar, from + bar}, {to - bar, to + bar}}});
    }
  }
  return out;
}

std::vector<NotchPlace> finishNotches(const Pattern& pattern, const Allowances& finish) {
  std::vector<NotchPlace> notches;
  for (const auto& [at, elastic] : finish.elastics)
    for (const double fraction : {0.25, 0.5, 0.75})
      if (const auto on = borderPlace(pattern, {at.first, at.second, fraction}))
        notches.push_back({at.first, on->place, on->outward, "", false, at.second});
  for (const auto& [name, own] : finish.fastenings) {
    if (own.kind != FasteningKind::Zip) continue;
    const SeamSide a(pattern, own.a, false), b(pattern, own.b, own.reversed);
    for (const double share : own.at)
      for (const SeamSide* side : {&a, &b}) {
        const SeamPlace at = side->at(share);
        if (const auto on = borderPlace(pattern, at); on && !on->corner)
          notches.push_back({at.piece, on->place, on->outward, name, false, at.edge});
      }
  }
  return notches;
}

namespace {

// The parts of a seam's side that lie on one piece each, in fractions of the side.
std::vector<std::pair<double, double>> partsByPiece(const SeamSide& side) {
  std::vector<std::pair<double, double>> parts;
  const std::vector<double> breaks = side.breaks();
  PieceId before;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const PieceId piece = side.at((breaks[k] + breaks[k + 1]) / 2).piece;
    if (!parts.empty() && piece == before)
      parts.back().second = breaks[k + 1];
    else
      parts.emplace_back(breaks[k], breaks[k + 1]);
    before = piece;
  }
  return parts;
}

}  // namespace

std::vector<SeamTag> seamTags(const Pattern& pattern) {
  std::vector<SeamTag> out;
  std::map<PieceId, std::vector<std::vector<Flat>>> drawn;
  // The place on a part of a side that keeps clearest of all lines.
  const auto clearest = [&](const SeamSide& side, double from, double to, std::size_t number) {
    std::optional<SeamTag> best;
    double most = -1;
    for (const double share : {0.5, 0.42, 0.58, 0.34, 0.66, 0.25, 0.75, 0.15, 0.85}) {
      const SeamPlace at = side.at(std::lerp(from, to, share));
      const auto on = sewnPlace(pattern, at);
      if (!on) continue;
      auto& lines = drawn[at.piece];
      if (lines.empty()) lines = linesOf(*pattern.pieces.at(at.piece));
      for (const double depth : {kTagDepth, 0.8 * kTagDepth}) {
        const Flat place = on->place - on->outward * depth;
        const double room = std::min(roomAt(lines, place), kTagRoom);
        if (room > most) most = room, best = SeamTag{at.piece, place, number};
      }
      if (most >= kTagRoom) break;
    }
    return best;
  };
  std::size_t number = 0;
  for (const auto& [id, seam] : pattern.seams) {
    ++number;
    if (seam.tie == Seam::Tie::Pleat) continue;
    const SeamSides sides(pattern, seam);
    for (const SeamSide* side : {&sides.a, &sides.b})
      for (const auto& [from, to] : partsByPiece(*side))
        if (const auto tag = clearest(*side, from, to, number)) out.push_back(*tag);
  }
  return out;
}

}  // namespace karinui

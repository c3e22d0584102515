#include "karinui/design/print_match.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "karinui/base/number.h"
#include "karinui/design/print_image.h"
#include "karinui/design/step_words.h"
#include "karinui/geometry/axes.h"
#include "karinui/pattern/markings.h"
#include "karinui/pattern/pleats.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

namespace {

constexpr int kLooks = 64;  // along a seam

// What is left of a step once whole repeats are taken off: between plus and minus half of one.
double offRepeat(double step, double repeat) { return step - repeat * std::round(step / repeat); }

// A print on the two pieces that meet at a place of a seam.
struct Met {
  const Piece *a, *b;
  Flat printA, printB;  // places of the print, metres
};

class Meeting {
 public:
  Meeting(const Document& document, const Seam& seam, const PhotoTall& tall)
      : document_(document), tall_(tall), sides_(document.pattern, seam) {}

  std::optional<Met> at(double share) const {
    const auto a = sides_.a.at(share), b = sides_.b.at(share);
    const Curve *ca = curveOf(document_.pattern, a.piece, a.edge), *cb = curveOf(document_.pattern, b.piece, b.edge);
    if (!ca || !cb) return std::nullopt;
    const Piece *pa = document_.find(a.piece), *pb = document_.find(b.piece);
    return Met{pa, pb, onPrint(*pa, ca->atFraction(a.fraction)), onPrint(*pb, cb->atFraction(b.fraction))};
  }
  // The repeat where both have the same print; nothing: they have not.
  std::optional<Flat> repeat(const Met& met) const {
    const Look a = lookOf(document_, *met.a), b = lookOf(document_, *met.b);
    if (a.print == PrintKind::None || a.print != b.print || a.repeat != b.repeat || a.photo != b.photo)
      return std::nullopt;
    return printRepeat(a, tall_);
  }
  Flat onPrint(const Piece& piece, Flat paper) const {
    const auto [across, along] = axes(piece.grain, lookOf(document_, piece).turn);
    const Flat from = paper - printOrigin(document_, piece);
    return {dot(from, across), dot(from, along)};
  }

  // Along the whole seam, in order; empty where the print is not the same somewhere.
  std::vector<Met> along() const {
    std::vector<Met> all;
    for (int k = 0; k <= kLooks; ++k) {
      const auto met = at(static_cast<double>(k) / kLooks);
      if (!met || !repeat(*met)) return {};
      all.push_back(*met);
    }
    return all;
  }

 private:
  const Document& document_;
  const PhotoTall& tall_;
  SeamSides sides_;
};

double part(Flat p, int which) { return which == 0 ? p.u : p.v; }

// A dart's two legs meet at its tip.
bool closesDart(const Document& document, const Seam& seam) {
  if (seam.a.size() != 1 || seam.b.size() != 1 || !seam.reversed || seam.a[0].piece != seam.b[0].piece) return false;
  const Outline& outline = document.find(seam.a[0].piece)->outline;
  const auto i = outline.find(seam.a[0].edge), k = outline.find(seam.b[0].edge);
  const std::size_t n = outline.edges.size();
  return i && k && ((*i + 1) % n == *k || (*k + 1) % n == *i);
}

// A pleat's fold, stitched to the line where it lies: the print behind it is covered.
bool sewsPleatDown(const Document& document, const Seam& seam) {
  if (seam.a.size() != 1 || seam.b.size() != 1 || seam.a[0].piece != seam.b[0].piece) return false;
  const Piece& piece = *document.find(seam.a[0].piece);
  const auto line = [&](const EdgeSpan& span) {
    return findEdge(piece, span.edge) ? nullptr : findCurve(piece, span.edge);
  };
  const Curve *a = line(seam.a[0]), *b = line(seam.b[0]);
  if (!a || !b) return false;
  constexpr double kSameLineEnd = 1e-6;  // metres
  const auto endsAt = [](const Curve& curve, Flat place) {
    return distance(curve.start, place) < kSameLineEnd || distance(curve.end, place) < kSameLineEnd;
  };
  const std::vector<PaperPleat> pleats = pleatsOf(document.pattern);
  return std::any_of(pleats.begin(), pleats.end(), [&](const PaperPleat& pleat) {
    return pleat.piece == piece.id &&
           ((endsAt(*a, pleat.place) && endsAt(*b, pleat.fold)) || (endsAt(*a, pleat.fold) && endsAt(*b, pleat.place)));
  });
}

// What is gathered to a shorter side cannot go on over the seam, wherever the print begins.
bool isGathered(const Pattern& pattern, const Seam& seam) {
  constexpr double kGathered = 1.1;  // times as long as the other side; less is eased in
  const double a = length(pattern, seam.a), b = length(pattern, seam.b);
  return std::max(a, b) > kGathered * std::min(a, b);
}

bool mirrors(PrintKind print) { return print != PrintKind::Photo; }
int partsOf(PrintKind print) { return print == PrintKind::Stripe ? 1 : 2; }

// By how much the print misses at each place, of one part (across or along), as it goes on (1) or is mirrored (-1).
std::vector<double> misses(const std::vector<Met>& all, int which, double sign, double repeat) {
  std::vector<double> out;
  for (const Met& met : all) out.push_back(offRepeat(part(met.printB, which) - sign * part(met.printA, which), repeat));
  return out;
}

}  // namespace

Flat printOrigin(const Document& document, const Piece& piece) {
  const auto& shifts = document.looks.shifts;
  Flat shift;
  if (const auto own = shifts.find(piece.id); own != shifts.end()) {
    shift = own->second;
  } else if (const auto original = shifts.find(piece.mirrorOf); piece.mirrorOf && original != shifts.end()) {
    shift = {-original->second.u, original->second.v};
  }
  const auto [across, along] = axes(piece.grain);
  return across * shift.u + along * shift.v;
}

PhotoTall photosIn(const Blobs& blobs) {
  return [&blobs](const std::string& photo) {
    const auto bytes = blobs.get(photo);
    const auto size = bytes ? printSize(*bytes) : Result<std::array<int, 2>>(bytes.error());
    return size ? static_cast<double>(size->at(1)) / size->at(0) : 1;
  };
}

Flat printRepeat(const Look& look, const PhotoTall& tall) {
  return {look.repeat, look.print == PrintKind::Photo ? look.repeat * tall(look.photo) : look.repeat};
}

std::optional<PrintMeeting> printMeeting(const Document& document, const Seam& seam, const PhotoTall& tall) {
  if (seam.tie == Seam::Tie::Pleat || closesDart(document, seam) || sewsPleatDown(document, seam) ||
      isGathered(document.pattern, seam))
    return std::nullopt;
  const Meeting meeting(document, seam, tall);
  const std::vector<Met> all = meeting.along();
  if (all.empty()) return std::nullopt;
  const PrintKind print = lookOf(document, *all.front().a).print;
  const Flat repeat = *meeting.repeat(all.front());
  std::vector<double> worst(all.size(), 0.0);
  for (int which = 0; which < partsOf(print); ++which) {
    const auto most = [](const std::vector<double>& of) {
      double m = 0;
      for (const double miss : of) m = std::max(m, std::fabs(miss));
      return m;
    };
    std::vector<double> best = misses(all, which, 1, part(repeat, which));
    if (mirrors(print))
      if (auto mirrored = misses(all, which, -1, part(repeat, which)); most(mirrored) < most(best))
        best = std::move(mirrored);
    for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], std::fabs(best[i]));
  }
  const auto most = std::max_element(worst.begin(), worst.end());
  return PrintMeeting{*most, static_cast<double>(most - worst.begin()) / kLooks};
}

Result<Flat> matchingShift(const Document& document, const Seam& seam, double at, PieceId moved,
                           const PhotoTall& tall) {
  const Meeting meeting(document, seam, tall);
  const auto here = meeting.at(at);
  if (!here || (here->a->id != moved && here->b->id != moved))
    return refused(say("“{0}” does not lie at that place of the seam.", document.find(moved)->name));
  if (here->a->id == here->b->id)
    return refused(say("“{0}” is sewn to itself there; moving its print moves both sides of the seam.", here->a->name));
  if (!meeting.repeat(*here))
    return refused(say("“{0}” and “{1}” have no print in common that could match.", here->a->name, here->b->name));
  const Look look = lookOf(document, here->a->id == moved ? *here->a : *here->b);
  const Flat repeat = *meeting.repeat(*here);
  const bool isB = here->b->id == moved;
  Flat by;  // that the moved piece's places of the print are to change
  for (int which = 0; which < partsOf(look.print); ++which) {
    double least = 1e9;
    for (const double sign : {1.0, -1.0}) {
      if (sign < 0 && !mirrors(look.print)) continue;
      const auto miss = [&](const Met& met) {
        return isB ? part(met.printB, which) - sign * part(met.printA, which)
                   : part(met.printA, which) - sign * part(met.printB, which);
      };
      const double now = miss(*here);
      double sum = 0;
      for (int k = 0; k <= kLooks; ++k)
        if (const auto met = meeting.at(static_cast<double>(k) / kLooks); met && met->a == here->a && met->b == here->b)
          sum += std::fabs(offRepeat(miss(*met) - now, part(repeat, which)));
      if (sum < least - 1e-9) least = sum, (which == 0 ? by.u : by.v) = -now;
    }
  }
  const Piece& piece = *document.find(moved);
  const auto [across, along] = axes(piece.grain, look.turn);
  const Flat origin = printOrigin(document, piece);
  Flat begins{dot(origin, across) - by.u, dot(origin, along) - by.v};
  begins.u = offRepeat(begins.u, repeat.u);
  if (partsOf(look.print) > 1) begins.v = offRepeat(begins.v, repeat.v);
  const Flat paper = across * begins.u + along * begins.v;
  const auto [aside, up] = axes(piece.grain);
  return Flat{dot(paper, aside), dot(paper, up)};
}

std::vector<Message> unmatchedSaid(const Document& document, const PhotoTall& tall, SeamId of) {
  std::vector<Message> all;
  for (const auto& [id, seam] : document.pattern.seams) {
    if (of && id != of) continue;
    // By the name that a script says; faces with words put it in words.
    if (const auto meets = printMeeting(document, seam, tall); meets && meets->most >= kPrintMeets) {
      const Message miss = say("the print misses by up to {0} mm, {1} % along the seam", fixed(meets->most * 1000, 1),
                               fixed(meets->at * 100, 0));
      if (of)
        all.push_back(miss);  // it is known which
      else
        all.push_back(say("{0}: {1}", seam.name.empty() ? seamSaid(document, seam) : say("{0}", seam.name), miss));
    }
  }
  return all;
}

std::vector<MatchMark> matchMarks(const Document& document, const PhotoTall& tall) {
  constexpr int kMarkSteps = 256;       // along a seam
  constexpr double kMarksApart = 0.05;  // metres, at least
  constexpr double kMostMarks = 8;      // between the first and the last
  constexpr double kBarLength = 0.010, kBarAslant = 0.25,
                   kMarkFromEnd = 0.01;  // metres, sine to the seam, share of the seam
  std::vector<MatchMark> all;
  int number = 0;
  for (const auto& [id, seam] : document.pattern.seams) {
    if (const auto meets = printMeeting(document, seam, tall); !meets || meets->most >= kPrintMeets) continue;
    const SeamSides sides(document.pattern, seam);
    const Meeting meeting(document, seam, tall);
    const auto first = meeting.at(0);
    const Look look = lookOf(document, *first->a);
    const Flat repeat = *meeting.repeat(*first);
    const auto walked = [&](int which) {
      std::vector<double> way;
      for (int k = 0; k <= kMarkSteps; ++k)
        way.push_back(part(meeting.at(static_cast<double>(k) / kMarkSteps)->printA, which));
      return way;
    };
    const auto spans = [](const std::vector<double>& way) {
      const auto [low, high] = std::minmax_element(way.begin(), way.end());
      return *high - *low;
    };
    int which = 0;
    std::vector<double> way = walked(0);
    if (partsOf(look.print) > 1)
      if (auto along = walked(1); spans(along) > spans(way)) which = 1, way = std::move(along);
    const double line = part(repeat, which);
    const double step = line * std::ceil(std::max(kMarksApart, spans(way) / kMostMarks) / line - 1e-9);
    const auto barOn = [&](const SeamPlace& at) -> std::optional<MatchMark> {
      const auto border = borderPlace(document.pattern, at);
      if (!border) return std::nullopt;
      const Piece& piece = *document.find(at.piece);
      const auto [across, along] = axes(piece.grain, lookOf(document, piece).turn);
      Flat bar = which == 0 ? along : across;
      if (dot(bar, border->outward) > 0) bar = -bar;
      if (-dot(bar, border->outward) < kBarAslant) return std::nullopt;
      return MatchMark{at.piece, border->place, border->place + bar * kBarLength, 0};
    };
    for (int k = 0; k < kMarkSteps; ++k) {
      const double a = way[static_cast<std::size_t>(k)] / step, b = way[static_cast<std::size_t>(k) + 1] / step;
      if (a == b || std::floor(a) == std::floor(b)) continue;
      const double on = a < b ? std::floor(b) : std::floor(a);
      const double share = (k + (on - a) / (b - a)) / kMarkSteps;
      if (share < kMarkFromEnd || share > 1 - kMarkFromEnd) continue;  // the corners meet anyway
      auto one = barOn(sides.a.at(share)), other = barOn(sides.b.at(share));
      if (!one || !other) continue;
      one->number = other->number = ++number;
      all.push_back(*one), all.push_back(*other);
    }
  }
  return all;
}

}  // namespace karinui

#include <algorithm>
#include <cmath>

#include "design/operations/copied_joins.h"
#include "design/operations/operations.h"
#include "design/operations/said.h"
#include "design/operations/seam_parts.h"
#include "design/operations/sewn_runs.h"
#include "design/spoken.h"
#include "karinui/design/sewing.h"
#include "karinui/design/step_words.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {

namespace {

constexpr double kUsualInset = 0.015, kUsualSpacing = 0.08, kUsualEnds = 0.015;  // metres
constexpr double kWidestStand = 0.1;
constexpr double kTight = 0.0005;  // metres by which a run may be too short
constexpr double kUneven = 1.1;    // times that one side of a zip may be longer than the other

std::string names(const Fastenings& fastenings) {
  std::string all;
  for (const auto& [name, own] : fastenings) all += (all.empty() ? "" : ", ") + name;
  return all;
}

bool isNew(const Fasten& op) { return !op.a.empty() || !op.b.empty(); }
bool hasCloth(FasteningKind kind) { return traitsOf(kind).sized; }

Fasten::From topOf(const Document& document, const std::vector<EdgeRef>& run) {
  const EdgeRef &first = run.front(), &last = run.back();
  const Flat start = findCurve(*document.find(first.piece.id), first.edge)->atFraction(first.from),
             end = findCurve(*document.find(last.piece.id), last.edge)->atFraction(last.to);
  return end.v > start.v + 1e-6 ? Fasten::From::End : Fasten::From::Start;
}

// The fastening that a decided operation sets.
Fastening made(const Document& document, const Fasten& op) {
  Fastening own;
  own.kind = *op.kind;
  own.a = spansOf(op.a), own.b = spansOf(op.b);
  own.reversed = op.reversed == Choice::Yes;
  own.fromStart = op.from == Fasten::From::Start;
  own.inset = op.inset.value_or(Length{});
  if (op.size) own.size = *op.size;
  if (op.gap) own.gap = *op.gap;
  own.holesAlong = op.holes == Fasten::Holes::Along;
  const double whole = lengthOf(document, op.a), first = *op.first;
  const auto add = [&](double along) {
    const double share = std::clamp(along / whole, 0.0, 1.0);
    own.at.push_back(own.fromStart ? share : 1 - share);
  };
  if (own.kind == FasteningKind::Zip) {
    add(first), add(first + *op.length);
  } else {
    const int count = *op.count;
    const double apart = op.spacing ? op.spacing->metres : count > 1 ? (whole - first - *op.last) / (count - 1) : 0;
    for (int k = 0; k < count; ++k) add(first + k * apart);
  }
  std::sort(own.at.begin(), own.at.end());
  return own;
}

Done close(const Document& document, const Fasten& op, Fastening& own) {
  const bool zip = !traitsOf(own.kind).counted;
  if (op.closed && zip) return refused(say("A zip has no number that is closed; say closed_length=…."));
  if (op.closedLength && !zip) return refused(say("Only a zip is closed for a length; say closed=… for the others."));
  const int count = static_cast<int>(own.at.size());
  if (op.closed && !(*op.closed >= 0 && *op.closed <= count))
    return refused(say("Of these {0}, 0 to {0} can be closed.", count));
  if (op.closed) own.closed = *op.closed;
  if (!op.closedLength) return {};
  const double whole = lengthOf(document.pattern, own);
  if (!(*op.closedLength >= 0 && *op.closedLength <= whole + kTight))
    return refused(say("The zip is {0} cm long; it can be closed for 0 to {0} cm.", centimetres(whole)));
  own.zipped = std::fmin(1, *op.closedLength / whole);
  return {};
}

void decideReversed(const Document& before, Fasten& op) {
  if (op.reversed != Choice::Auto) return;
  SewEdges sew;
  sew.a = op.a, sew.b = op.b;
  op.reversed = facesReversed(before, sew, nullptr) ? Choice::Yes : Choice::No;
}

// How far an end of a band goes on beyond the seam that it is sewn on with, metres; 0: it ends there.
double beyondSeam(const Document& document, const EdgeRef& end) {
  constexpr double kStraightOn = 0.35;  // radians
  const Piece& piece = *document.find(end.piece.id);
  const auto at = piece.outline.find(end.edge);
  if (!at) return 0;
  const auto& edges = piece.outline.edges;
  double most = 0;  // of its two corners
  for (const std::size_t step : {std::size_t{1}, edges.size() - 1}) {
    double beyond = 0;
    for (std::size_t k = (*at + step) % edges.size(); k != *at; k = (k + step) % edges.size()) {
      std::optional<double> nearest;  // share of the edge from this side to where it is sewn
      for (const auto& [id, seam] : document.pattern.seams)
        for (const auto* side : {&seam.a, &seam.b})
          for (const EdgeSpan& span : *side)
            if (span.piece == piece.id && span.edge == edges[k].name)
              nearest = std::min(nearest.value_or(1), step == 1 ? span.from : 1 - span.to);
      const Curve& own = edges[k].curve;
      beyond += nearest.value_or(1) * own.length();
      if (nearest) {
        most = std::max(most, beyond);
        break;
      }
      const Curve& next = edges[(k + step) % edges.size()].curve;
      const Flat out = step == 1 ? own.tangent(1) : own.tangent(0), in = step == 1 ? next.tangent(0) : next.tangent(1);
      if (std::fabs(angleFrom(out, in)) > kStraightOn) break;
    }
  }
  return most;
}

// Half of what the two ends of a band lap, as those of a waistband: fastened there, they lie flat over each other.
std::optional<double> halfLap(const Document& document, const Fasten& op) {
  constexpr double kLeast = 0.005;  // metres
  if (op.a.size() != 1 || op.b.size() != 1 || op.a[0].piece.id != op.b[0].piece.id) return std::nullopt;
  const double half = (beyondSeam(document, op.a[0]) + beyondSeam(document, op.b[0])) / 2;
  return half < kLeast ? std::nullopt : std::optional(half);
}

Length usualInset(const Document& document, const Fasten& op) {
  if (op.stand) return *op.stand;
  if (const auto half = halfLap(document, op)) return {*half};
  const bool onLines = lineOf(document, op.a.front()) || lineOf(document, op.b.front());
  return {hasCloth(*op.kind) && !onLines ? kUsualInset : 0};
}

// What is not said of a new one is decided.
Done decide(const Document& before, Fasten& op) {
  const FasteningKind kind = op.kind.value_or(FasteningKind::Button);
  const bool zip = !traitsOf(kind).counted;
  op.kind = kind;
  if (zip && (op.count || op.spacing || op.last || op.inset))
    return refused(say("A zip has a length, and where it begins (first); no number, spacing, last or inset."));
  if (!zip && op.length) return refused(say("Only a zip has a length."));
  if (op.stand && !hasCloth(kind)) return refused(say("Only buttons and snaps have a stand."));
  if (!zip && op.unpick == Choice::Yes && !op.stand)
    return refused(say("A seam is opened for a zip, or for buttons and snaps with a stand."));
  if (op.size && !hasCloth(kind)) return refused(say("Only buttons and snaps have a size."));
  if (op.gap && !traitsOf(kind).gapped) return refused(say("Only a tie holds its places a gap apart."));
  if (op.size && !(*op.size >= 0.004 && *op.size <= 0.06)) return refused(say("A button is 4 to 60 mm wide."));
  if (op.gap && !(*op.gap >= 0 && *op.gap <= 1)) return refused(say("A tie holds its places 0 to 1 m apart."));
  decideReversed(before, op);
  if (op.from == Fasten::From::Auto || op.from == Fasten::From::Top) op.from = topOf(before, op.a);
  if (op.from == Fasten::From::Bottom)
    op.from = topOf(before, op.a) == Fasten::From::Start ? Fasten::From::End : Fasten::From::Start;
  if (!op.inset && !zip) op.inset = usualInset(before, op);
  if (op.inset && !(*op.inset >= 0 && *op.inset <= 0.5))
    return refused(say("The places lie 0 to 50 cm within the edge."));
  const double whole = lengthOf(before, op.a);
  if (!op.first) op.first = Length{zip ? 0 : std::fmin(kUsualEnds, whole / 2)};
  if (!(*op.first >= 0 && *op.first <= whole))
    return refused(say("The first comes 0 to {0} cm from the end of the edges.", centimetres(whole)));
  if (zip) {
    if (!op.length) op.length = Length{whole - *op.first};
    if (!(*op.length >= 0.01 && *op.length <= whole - *op.first + kTight))
      return refused(say("The zip would be {0} cm long, but the edges have {1} cm for it from there.",
                         centimetres(*op.length), centimetres(whole - *op.first)));
    return {};
  }
  if (op.spacing && !(*op.spacing > 0)) return refused(say("From one to the next it is more than 0 cm."));
  if (!op.last) op.last = Length{std::fmin(kUsualEnds, (whole - *op.first) / 2)};
  const double room = whole - *op.first - *op.last;
  if (!(*op.last >= 0 && room >= -kTight))
    return refused(say("The edges are {0} cm long; from the first to the last nothing is left.", centimetres(whole)));
  if (!op.count)
    op.count = 1 + static_cast<int>(op.spacing ? room / *op.spacing + 1e-9 : std::lround(room / kUsualSpacing));
  if (!(*op.count >= 1 && *op.count <= kMostFastened))
    return refused(say("There are 1 to {0} of them.", kMostFastened));
  if (op.spacing && (*op.count - 1) * *op.spacing > room + kTight)
    return refused(say("{0} of them, {1} cm apart, need {2} cm; the edges have {3} cm for them.", *op.count,
                       centimetres(*op.spacing), centimetres((*op.count - 1) * *op.spacing), centimetres(room)));
  return {};
}

Error tooNear(double apart) {
  return refused(
      say("Two of them would lie {0} mm apart, over each other; take fewer, or smaller ones.", fixed(1000 * apart, 1)));
}

Done onPiece(const Piece& piece, Flat place, double room) {
  const Ring ring = piece.outline.flattened(1e-4);
  bool fits = (contains(ring, place) && distanceToRing(ring, place) >= room - kTight) ||
              (room == 0 && distanceToRing(ring, place) < kTight);
  for (const Outline& hole : piece.holes) {
    const Ring around = hole.flattened(1e-4);
    fits = fits && !contains(around, place) && distanceToRing(around, place) >= room - kTight;
  }
  if (fits) return {};
  return refused(
      say("At {0}, {1} cm on the paper of “{2}” there is no cloth for it; change the inset, the first or the "
          "last, or take a smaller size.",
          centimetres(place.u), centimetres(place.v), piece.name));
}

// An edge opens there only if nothing holds it shut.
Done checkOpen(const Document& before, const Fastening& own) {
  constexpr double kEnd = 1e-6;  // of the edge's length
  for (const bool over : {true, false}) {
    const SeamSide side(before.pattern, over ? own.a : own.b, !over && own.reversed);
    for (const double share : own.at) {
      const SeamPlace at = side.at(share);
      for (const auto& [id, seam] : before.pattern.seams)
        for (const auto* taken : takenSides(seam))
          for (const EdgeSpan& span : *taken)
            if (span.piece == at.piece && span.edge == at.edge && at.fraction > span.from + kEnd &&
                at.fraction < span.to - kEnd && findEdge(*before.find(at.piece), at.edge))
              return refused(
                  say("{0}.{1} is sewn to another edge there, by seam {2}; unpick that seam, choose free edges, name "
                      "the part that is free ({1}@0:0.5), or draw an inner line for it.",
                      before.find(at.piece)->name, at.edge, spoken(seam)));
    }
  }
  return {};
}

Done checkPlaces(const Document& before, const Fastening& own) {
  struct Placed {
    PieceId piece;
    Flat place;
    double size;
  };
  std::vector<Placed> there;
  for (const auto& [name, other] : before.allowances.fastenings)
    if (other.kind != FasteningKind::Zip)
      for (const FastenedPlaces& pair : placesOf(before.pattern, other))
        for (const FasteningPlace* at : {&pair.a, &pair.b}) there.push_back({at->piece, at->place, other.size});
  const std::vector<FastenedPlaces> places = placesOf(before.pattern, own);
  const double hole = own.size + kHoleLonger;
  for (const FastenedPlaces& pair : places)
    for (const FasteningPlace* at : {&pair.a, &pair.b}) {
      const Piece& piece = *before.find(at->piece);
      if (Done done = onPiece(piece, at->place, hasCloth(own.kind) ? own.size / 2 : 0); !done) return done;
      const bool along = own.holesAlong && own.kind == FasteningKind::Button && at == &pair.a;
      for (const Placed& other : there) {
        const double apart = distance(other.place, at->place);
        if (other.piece == at->piece && apart < (along ? hole : (own.size + other.size) / 2)) return tooNear(apart);
      }
      there.push_back({at->piece, at->place, own.size});
    }
  return {};
}

// What to do where a zip is wished in the middle of the cloth: the cut that makes edges of the line.
Message toBeCut(const Piece& piece, const std::string& name) {
  std::string places;
  const auto add = [&](Flat p) {
    const auto cm = [](double metres) { return written(std::round(metres * 1e4) / 100) + "cm"; };
    places += (places.empty() ? "" : "; ") + cm(p.u) + "," + cm(p.v);
  };
  for (const InternalLine& line : piece.lines) {
    if (line.name != name) continue;
    for (const Curve& curve : line.curves)
      for (const Flat p : curve.flattened(1e-3))
        if (places.empty() || p != curve.start) add(p);
  }
  return say(
      "A zip is sewn between two edges, and “{1}” is a line within “{0}”. Cut along it first, from the edge of the "
      "piece on, and set the zip between the two edges of the cut: cut piece={0} line=\"{2}\".",
      piece.name, name, places);
}

// What is left of an edge beside a zip at one of its ends.
std::optional<std::string> besideZip(const Pattern& pattern, const std::vector<EdgeSpan>& zip) {
  constexpr double kEnd = 1e-6;  // of the edge
  if (zip.size() != 1 || (zip.front().from > kEnd && zip.front().to < 1 - kEnd)) return std::nullopt;
  const EdgeSpan& span = zip.front();
  const bool first = span.to >= 1 - kEnd;  // the rest is where the edge begins
  const double from = first ? 0 : span.to, to = first ? span.from : 1;
  const auto rounded = [](double share) { return written(std::round(share * 1e4) / 1e4); };
  if (to - from < kEnd) return std::nullopt;
  return pattern.pieces.at(span.piece)->name + "." + span.edge + "@" + rounded(from) + ":" + rounded(to);
}

// A seam that is in a zip's way, and how only what is below the zip is sewn.
Message heldBy(const Document& before, const std::string& seam, const Seam& zip) {
  const auto a = besideZip(before.pattern, zip.a), b = besideZip(before.pattern, zip.b);
  if (!a || !b) return say("Seam {0} holds these edges where the zip comes; take it out first.", seam);
  return say(
      "Seam {0} holds these edges where the zip comes. Take it out, and sew only what is below the zip: unsew "
      "seam={0}, then sew a={1} b={2}.",
      seam, *a, *b);
}

// The stretch of a seam that a zip takes, if the seam joins what the zip joins. Nothing where its two sides come at
// places of the seam that are far from each other.
std::optional<SeamStretch> takenBy(const Pattern& pattern, const Seam& seam, const Seam& zip) {
  constexpr double kApart = 0.01;  // metres
  const double whole = length(pattern, seam.a);
  for (const bool same : {true, false}) {
    const auto onA = coveredBy(pattern, seam, true, same ? zip.a : zip.b),
               onB = coveredBy(pattern, seam, false, same ? zip.b : zip.a);
    if (!onA || !onB) continue;
    if (std::fabs(onA->from - onB->from) * whole > kApart || std::fabs(onA->to - onB->to) * whole > kApart) continue;
    return SeamStretch{std::fmin(onA->from, onB->from), std::fmax(onA->to, onB->to)};
  }
  return std::nullopt;
}

// The document with the seams opened where a zip comes between their two sides. `opened`: how they are called.
Document unpickedFor(const Document& before, Fastening zip, std::vector<std::string>& opened, std::uint32_t& minted) {
  zip.zipped = 1;
  const auto along = zipSeam(before.pattern, zip);
  Document after = before;
  if (!along) return after;
  for (const auto& [id, seam] : before.pattern.seams) {
    const auto taken = takenBy(before.pattern, seam, *along);
    if (!taken) continue;
    opened.push_back(spoken(seam));
    replaceByParts(before, after, id, partsBeside(before.pattern, seam, *taken), minted);
  }
  return after;
}
Document unpickedFor(const Document& before, const Fastening& zip) {
  std::vector<std::string> opened;
  std::uint32_t minted = 0;
  return unpickedFor(before, zip, opened, minted);
}

// The edge that meets this one at one of its ends, there.
std::optional<SeamPlace> roundCorner(const Pattern& pattern, const SeamPlace& end) {
  const Outline& outline = pattern.pieces.at(end.piece)->outline;
  const auto k = outline.find(end.edge);
  if (!k) return std::nullopt;
  const std::size_t n = outline.edges.size();
  return end.fraction < 0.5 ? SeamPlace{end.piece, outline.edges[(*k + n - 1) % n].name, 1}
                            : SeamPlace{end.piece, outline.edges[(*k + 1) % n].name, 0};
}
// --- A stand: both edges are opened, and let out so that they lap.

// All of both sides, as a zip would have it.
Fastening wholeOf(const Fasten& op) {
  Fastening whole;
  whole.kind = FasteningKind::Zip;
  whole.a = spansOf(op.a), whole.b = spansOf(op.b);
  whole.reversed = op.reversed == Choice::Yes;
  whole.at = {0, 1};
  return whole;
}

// What is sewn on where the two sides end, as a collar: its ends there, and the edges it is sewn to.
struct SewnAbove {
  SeamPlace endA, endB;          // of what is sewn on, beside a and beside b
  SeamPlace onA, onB;            // the edges that go on round the corners
  std::optional<SeamId> closed;  // the seam that closes it
};
std::vector<SewnAbove> sewnAbove(const Pattern& pattern, const Fastening& whole) {
  std::vector<SewnAbove> all;
  const SeamSide a(pattern, whole.a, false), b(pattern, whole.b, whole.reversed);
  const auto on = [](const std::vector<EdgeSpan>& side, const SeamPlace& place) {
    return side.size() == 1 && side.front().piece == place.piece && side.front().edge == place.edge;
  };
  for (const double end : {0.0, 1.0}) {
    const auto onA = roundCorner(pattern, a.at(end)), onB = roundCorner(pattern, b.at(end));
    if (!onA || !onB) continue;
    for (const SeamPlace& one : sewnTo(pattern, *onA))
      for (const SeamPlace& other : sewnTo(pattern, *onB)) {
        const auto endA = roundCorner(pattern, one), endB = roundCorner(pattern, other);
        if (one.piece != other.piece || !endA || !endB || endA->edge == endB->edge) continue;
        SewnAbove above{*endA, *endB, *onA, *onB, std::nullopt};
        for (const auto& [id, seam] : pattern.seams)
          if ((on(seam.a, *endA) && on(seam.b, *endB)) || (on(seam.a, *endB) && on(seam.b, *endA))) above.closed = id;
        all.push_back(above);
      }
  }
  return all;
}

Result<Document> letOut(const Document& before, const std::vector<EdgeRef>& edges, double by, const Context& context) {
  TakeIn out;
  out.edges = edges;
  out.by = {-by};
  out.partners = out.symmetric = Choice::No;
  out.whole = out.together = Choice::Yes;
  Result<Document> after = before;
  for (const Choice follow : {Choice::Yes, Choice::No}) {
    out.follow = follow;
    Context quiet = context;
    quiet.advise = {};
    after = perform(before, out, quiet);
    if (after) break;
  }
  return after;
}

// The document with both sides free and let out. Its messages are told where somebody asks.
Result<Document> withStand(const Document& before, const Fasten& op, const Context& context) {
  if (!op.stand) return before;
  const Fastening whole = wholeOf(op);
  const std::vector<SewnAbove> above = sewnAbove(before.pattern, whole);
  Document after = before;
  std::vector<std::string> opened;
  std::uint32_t minted = 0;
  if (op.unpick == Choice::Yes) {
    after = unpickedFor(before, whole, opened, minted);
    for (const SewnAbove& one : above)
      if (one.closed && after.find(*one.closed)) {
        opened.push_back(spoken(*after.find(*one.closed)));
        after.pattern.seams.erase(*one.closed);
      }
  }
  std::vector<EdgeRef> sides = op.a;
  sides.insert(sides.end(), op.b.begin(), op.b.end());
  const auto lengthAt = [](const Document& document, const SeamPlace& place) {
    return findEdge(*document.find(place.piece), place.edge)->curve.length();
  };
  auto wide = letOut(after, sides, *op.stand, context);
  if (!wide) return wide;
  for (const SewnAbove& one : above)
    for (const auto& [end, on] : {std::pair(one.endA, one.onA), std::pair(one.endB, one.onB)}) {
      const double gained = lengthAt(*wide, on) - lengthAt(after, on);
      if (std::fabs(gained) < kTight) continue;
      wide = letOut(*wide, {{PieceRef(end.piece), end.edge}}, gained, context);
      if (!wide) return wide;
    }
  if (context.advise) {
    for (const std::string& seam : opened) context.advise({say("Seam {0} is opened for what fastens it.", seam)});
    context.advise({say("Let out by {0} mm, to lap: {1}, {2}.", fixed(1e3 * *op.stand, 1),
                        edgeSaid(before, op.a.front()), edgeSaid(before, op.b.front()))});
  }
  return wide;
}

// Auto becomes yes where a seam is to be opened. What was recorded before there was a choice has none.
void decideUnpick(const Document& before, const Fastening& own, Choice& unpick, const Context& context) {
  if (context.recorded || unpick == Choice::No) return;
  std::vector<std::string> opened;
  std::uint32_t minted = 0;
  if (own.kind == FasteningKind::Zip) unpickedFor(before, own, opened, minted);
  unpick = opened.empty() ? Choice::Auto : Choice::Yes;
}

// A zip is sewn between two edges that nothing else is sewn to.
Done checkZip(const Document& before, Fastening own, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b) {
  own.zipped = 1;
  for (const auto* side : {&a, &b})
    for (const EdgeRef& ref : *side)
      if (lineOf(before, ref)) return refused(toBeCut(*before.find(ref.piece.id), ref.edge));
  const auto seam = zipSeam(before.pattern, own);
  if (!seam) return refused(say("A zip is at least 1 cm long."));
  const double onA = length(before.pattern, seam->a), onB = length(before.pattern, seam->b);
  if (std::fmax(onA, onB) > kUneven * std::fmin(onA, onB))
    return refused(say("The zip is {0} cm long on one side and {1} cm on the other; make the edges alike.",
                       centimetres(onA), centimetres(onB)));
  for (const auto* side : {&seam->a, &seam->b}) {
    const std::vector<EdgeRef> refs = refsOf(*side);
    for (const SeamId id : seamsOn(before, refs)) return refused(heldBy(before, spoken(*before.find(id)), *seam));
    for (const auto& [name, other] : before.allowances.fastenings) {
      if (other.kind != FasteningKind::Zip) continue;
      Fastening whole = other;
      whole.zipped = 1;
      const auto its = zipSeam(before.pattern, whole);
      for (const auto* sewn : {&its->a, &its->b})
        if (its && overlap(refs, refsOf(*sewn)))
          return refused(say("There is a zip “{0}” in these edges already.", name));
    }
  }
  return {};
}

// Whether two places of a piece are one, or the ends of what is closed by a seam.
bool joined(const Pattern& pattern, const SeamPlace& one, const SeamPlace& other) {
  constexpr double kOnePlace = 0.003;  // metres
  if (one.piece != other.piece) return false;
  const auto at = [&](const SeamPlace& place) {
    return findEdge(*pattern.pieces.at(place.piece), place.edge)->curve.atFraction(place.fraction);
  };
  if (distance(at(one), at(other)) < kOnePlace) return true;
  const auto end = roundCorner(pattern, one), far = roundCorner(pattern, other);
  if (!end || !far) return false;
  const std::vector<SeamPlace> sewn = sewnTo(pattern, {end->piece, end->edge, 0.5});
  return std::any_of(sewn.begin(), sewn.end(),
                     [&](const SeamPlace& place) { return place.piece == far->piece && place.edge == far->edge; });
}
// A waistband that was sewn on before the zip goes on, closed, over the zip's upper end.
void tellShutAbove(const Document& after, const Fastening& zip, const Context& context) {
  constexpr double kAtTheEnd = 0.01;  // metres: a zip that begins further down is not to open the edge
  const Pattern& pattern = after.pattern;
  const SeamSide a(pattern, zip.a, false), b(pattern, zip.b, zip.reversed);
  const double end = zip.fromStart ? 0 : 1, begins = zip.fromStart ? zip.at.front() : 1 - zip.at.back();
  if (!context.advise || begins * a.length() > kAtTheEnd) return;
  const auto onA = roundCorner(pattern, a.at(end)), onB = roundCorner(pattern, b.at(end));
  if (!onA || !onB) return;
  for (const SeamPlace& one : sewnTo(pattern, *onA))
    for (const SeamPlace& other : sewnTo(pattern, *onB))
      if (findEdge(*after.find(one.piece), one.edge) && findEdge(*after.find(other.piece), other.edge) &&
          joined(pattern, one, other))
        return context.advise(
            {say("“{0}” goes on, closed, over the upper end of the zip: nobody gets in there. Undo both, set the zip "
                 "first and then “{0}”, with a lap: it begins at the zip.",
                 after.find(one.piece)->name)});
}

Done checkSet(const Document& before, const Fastening& own, const std::vector<EdgeRef>& a,
              const std::vector<EdgeRef>& b) {
  if (own.kind == FasteningKind::Zip) return checkZip(before, own, a, b);
  if (Done done = checkOpen(before, own); !done) return done;
  return checkPlaces(before, own);
}

// The one that holds the same places already: it came with that of the symmetric copies.
Fastenings::iterator sameThere(Fastenings& all, const Fastening& own) {
  return std::find_if(all.begin(), all.end(), [&](const auto& other) { return sameFastening(other.second, own); });
}

// Whether the symmetric copies are fastened likewise. Left open, they are where they can be.
Done resolveCopies(const Document& before, const Fastening& own, Fasten& op, const Context& context) {
  if (context.recorded) return {};
  const auto copy = fasteningOnCopies(before, own);
  if (!copy) {
    if (op.copies == Choice::No) op.copies = Choice::Auto;  // nothing is to be decided
    if (op.copies == Choice::Auto) return {};
    return refused(
        say("The symmetric copies of these pieces have nothing that is fastened likewise; leave copies= away."));
  }
  if (op.copies == Choice::No) return {};
  Document with = before;
  if (sameThere(with.allowances.fastenings, *copy) != with.allowances.fastenings.end()) {
    op.copies = Choice::No;
    return {};
  }
  with.allowances.fastenings[op.name] = own;
  if (op.unpick == Choice::Yes && op.copies == Choice::Yes && !op.stand) with = unpickedFor(with, *copy);
  const Done done = checkSet(with, *copy, refsOf(copy->a), refsOf(copy->b));
  if (!done && op.copies == Choice::Yes) return done;
  op.copies = done ? Choice::Yes : Choice::No;
  return {};
}

std::string nameOnCopies(const Fastenings& all, const std::string& name) {
  std::string other = otherSide(name);
  for (int n = 2; all.contains(other); ++n) other = otherSide(name) + "_" + std::to_string(n);
  return other;
}

// What has the buttonholes lies over what has the buttons, and the cloth is at rest no more.
Document laidOver(Document document, const Fastening& own, bool fresh) {
  int under = -1;
  std::set<PieceId> over, touched;
  for (const EdgeSpan& span : own.b)
    under = std::max(under, document.find(span.piece)->layer), touched.insert(span.piece);
  for (const EdgeSpan& span : own.a)
    if (!touched.contains(span.piece)) over.insert(span.piece);
  for (const PieceId id : over) {
    Piece piece = *document.find(id);
    if (fresh && hasCloth(own.kind)) piece.layer = std::max(piece.layer, std::min(under + 1, 20));
    document = withPiece(std::move(document), std::move(piece));
  }
  for (const PieceId id : touched) {
    Piece piece = *document.find(id);
    document = withPiece(std::move(document), std::move(piece));
  }
  return document;
}

}  // namespace

Done resolve(const Document& given, Fasten& op, Context& context) {
  const Fastenings& there = given.allowances.fastenings;
  if (!isNew(op)) {
    const auto own = there.find(op.name);
    if (own == there.end() && op.name.empty())
      return refused(say("Say the two sides, a=… b=…, or the name of a fastening that is there."));
    if (own == there.end())
      return there.empty() ? refused(say("There is no fastening “{0}”; say its two sides: a=… b=….", op.name))
                           : refused(say("There is no fastening “{0}”; there are: {1}.", op.name, names(there)));
    if (op.kind || op.count || op.spacing || op.first || op.last || op.inset || op.size || op.length || op.gap ||
        op.stand)
      return refused(
          say("“{0}” is there already and can be closed, opened or taken out (none=yes); to change what it "
              "is, take it out and set it anew.",
              op.name));
    if (op.copies == Choice::No) op.copies = Choice::Auto;
    op.unpick = Choice::Auto;  // nothing is to be decided
    if (op.copies == Choice::Yes)
      return refused(say("What is there already is opened and closed by itself; leave copies= away."));
    if (op.none && (op.closed || op.closedLength)) return refused(say("What is taken out is not closed."));
    Fastening now = own->second;
    return close(given, op, now);
  }
  if (op.none) return refused(say("Say the name of what is taken out, not its edges."));
  if (op.a.empty() || op.b.empty()) return refused(say("What is fastened has two sides; say both: a=… b=…."));
  for (auto* side : {&op.a, &op.b})
    for (EdgeRef& ref : *side)
      if (Done done = resolveSewn(given, ref); !done) return done;
  if (overlap(op.a, op.b)) return refused(say("An edge cannot be fastened to itself."));
  Document before = withOneCurve(given, op.a, op.b);
  for (auto* side : {&op.a, &op.b}) *side = inOutlineOrder(before, std::move(*side));
  if (op.stand) {
    for (const auto* side : {&op.a, &op.b})
      for (const EdgeRef& ref : *side)
        if (lineOf(before, ref) || ref.from > 0 || ref.to < 1)
          return refused(say("A stand is let out along whole edges; name them without a part, and no inner line."));
    decideReversed(before, op);
    if (op.unpick == Choice::Auto && !context.recorded) {
      std::vector<std::string> opened;
      std::uint32_t minted = 0;
      unpickedFor(before, wholeOf(op), opened, minted);
      if (!opened.empty()) op.unpick = Choice::Yes;
    }
    Context quiet = context;
    quiet.advise = {};
    if (!(*op.stand >= 0.004 && *op.stand <= kWidestStand)) return refused(say("A stand is 4 to 100 mm wide."));
    auto lapped = withStand(before, op, quiet);
    if (!lapped) return lapped.error();
    before = *std::move(lapped);
  }
  if (Done done = decide(before, op); !done) return done;
  Fastening own = made(before, op);
  if (!sound(own)) return refused(say("The places lie too near to each other to be told apart."));
  Fastenings& known = before.allowances.fastenings;
  if (const auto same = sameThere(known, own); same != known.end() && !context.recorded) {
    if (op.name.empty()) op.name = same->first;
    known.erase(same);
  }
  if (op.name.empty()) {
    const std::string plain(traitsOf(*op.kind).plural);
    op.name = plain;
    for (int n = 2; known.contains(op.name); ++n) op.name = plain + "_" + std::to_string(n);
  }
  if (Done done = checkName(op.name); !done) return done;
  if (known.contains(op.name)) return refused(say("There is already a fastening “{0}”; choose another name.", op.name));
  if (!op.stand) decideUnpick(before, own, op.unpick, context);
  if (op.unpick == Choice::Yes && !op.stand) before = unpickedFor(before, own);
  if (Done done = checkSet(before, own, op.a, op.b); !done) return done;
  if (Done done = close(before, op, own); !done) return done;
  return resolveCopies(before, own, op, context);
}

namespace {

// What would be drawn together through the body, as a tie of the left front and what stands at the right behind.
void tellDrawnThroughBody(const Document& document, const Fasten& op, const Fastening& own, const Context& context) {
  constexpr double kDeep = 0.02, kFar = 0.25;  // metres
  constexpr int kLooks = 16;
  const BodyPtr body = context.advise ? context.bodies.known(document.body.hash) : nullptr;
  if (!body) return;
  const auto placed = [&](PieceId id) { return document.find(id)->form || document.find(id)->pose != Rigid(); };
  std::size_t through = 0;
  const auto places = placesOf(document.pattern, own);
  for (const FastenedPlaces& at : places) {
    if (!placed(at.a.piece) || !placed(at.b.piece)) return;
    const Vec3 a = Stand(*document.find(at.a.piece))(at.a.place), b = Stand(*document.find(at.b.piece))(at.b.place);
    bool deep = false;
    if (distance(a, b) < kFar) continue;  // the ends of a collar close in front of the neck
    for (int k = 1; k < kLooks; ++k) deep = deep || body->field().distance(lerp(a, b, k / double{kLooks})) < -kDeep;
    through += deep;
  }
  if (2 * through <= places.size()) return;
  context.advise(
      {say("{0} and {1} lie on opposite sides of the body; what fastens them would run through it. "
           "A strap from one to the other goes round it.",
           spoken(document, op.a.front()), spoken(document, op.b.front()))});
}

}  // namespace

Result<Document> perform(const Document& before, const Fasten& op, Context& context) {
  Document after = withOneCurve(before, op.a, op.b);
  if (isNew(op) && op.stand) {
    auto lapped = withStand(after, op, context);
    if (!lapped) return lapped;
    after = *std::move(lapped);
  }
  std::uint32_t minted = 0;
  const auto unpick = [&](const Fastening& zip) {
    if (op.unpick != Choice::Yes || op.stand) return;
    std::vector<std::string> opened;
    after = unpickedFor(after, zip, opened, minted);
    for (const std::string& seam : opened)
      if (context.advise) context.advise({say("Seam {0} is opened where the zip comes.", seam)});
  };
  Fastenings& all = after.allowances.fastenings;
  if (isNew(op)) {
    Fastening own = made(after, op);
    unpick(own);
    own.closed = own.kind == FasteningKind::Zip ? 0 : static_cast<int>(own.at.size());
    tellDrawnThroughBody(after, op, own, context);
    if (const auto same = sameThere(all, own); same != all.end()) all.erase(same);
    if (own.kind == FasteningKind::Zip) tellShutAbove(after, own, context);
    all[op.name] = std::move(own);
  }
  const auto own = all.find(op.name);
  if (Done done = close(after, op, own->second); !done) return done.error();
  const Fastening is = own->second;
  if (op.none) all.erase(own);
  after = laidOver(std::move(after), is, isNew(op));
  if (op.copies == Choice::Yes)
    if (const auto copy = fasteningOnCopies(after, is)) {
      unpick(*copy);
      Fastenings& now = after.allowances.fastenings;
      now[nameOnCopies(now, op.name)] = *copy;
      after = laidOver(std::move(after), *copy, true);
    }
  return after;
}

}  // namespace karinui

#include "karinui/design/lay_plan.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "karinui/base/number.h"
#include "karinui/design/notions.h"
#include "karinui/design/piece_label.h"
#include "karinui/design/print_match.h"
#include "karinui/pattern/cut_line.h"
#include "karinui/pattern/seam_walk.h"

namespace karinui {
namespace {

constexpr std::size_t kMostLaid = 400;
constexpr double kMiss = 1e-4;            // of the chords of cut lines
constexpr double kStraightGrain = 0.004;  // sine of the angle by which a fold may miss the grain
constexpr double kUprightPrint = 0.01;    // sine of the angle by which a print may miss the grain, or its square
constexpr double kOverlap = 1e-5;
constexpr double kSame = 5e-4;  // metres two cut lines may differ by that are cut at once

Flat turnedHalf(Flat p, bool yes) { return yes ? -p : p; }

// The part of the ring with v >= 0 (Sutherland and Hodgman).
Ring upperHalf(const Ring& ring) {
  Ring out;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Flat a = ring[k], b = ring[(k + 1) % ring.size()];
    if (a.v >= 0) out.push_back(a);
    if ((a.v >= 0) != (b.v >= 0)) {
      const double t = a.v / (a.v - b.v);
      out.push_back({a.u + (b.u - a.u) * t, 0});
    }
  }
  return out;
}

Ring counterClockwise(Ring ring) {
  if (signedArea(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

// What is laid of a piece: how often, and on how many layers.
struct Share {
  std::size_t count = 0;
  bool half = false, onEdge = false, mirrorToo = false, over = false;
  int layers = 1;
  double middle = 0;  // on the fold: how far its fold lies across, from the paper's origin, in the paper's own way
};

class Laying {
 public:
  Laying(const Document& document, const LaySettings& settings, Context& context)
      : settings_(settings), context_(context), document_(document) {}

  Result<LayPlan> plan() {
    if (Done good = checkSettings(); !good) return good.error();
    if (document_.pattern.pieces.empty()) return refused(say("There is no piece to lay."));
    if (!settings_.folded)
      if (Done whole = unfoldHalves(); !whole) return whole.error();
    addStrips();
    Allowances allowances = document_.allowances;
    if (settings_.allowance) allowances.kinds[EdgeKind::Seam] = *settings_.allowance;
    allowances_.emplace(document_.pattern, std::move(allowances));
    faceDown_ = cutFaceDown(document_.pattern, *allowances_, document_.cutting);
    printedPlaces();
    references();
    std::map<std::string, std::vector<const Piece*>> byFabric;
    for (const auto& [id, piece] : document_.pattern.pieces)
      for (const std::string& fabric : {piece->fabric, piece->interfacing})
        if (!fabric.empty() && (settings_.fabric.empty() || fabric == settings_.fabric))
          byFabric[fabric].push_back(piece.get());
    if (byFabric.empty()) return notFound(say("No piece is cut from “{0}”.", settings_.fabric));
    LayPlan out;
    out.settings = settings_;
    for (const auto& [fabric, pieces] : byFabric) {
      const auto count = static_cast<double>(byFabric.size()), nth = static_cast<double>(out.fabrics.size());
      auto lay = layFabric(fabric, pieces, nth / count, (nth + 1) / count);
      if (!lay) return lay.error();
      out.fabrics.push_back(*std::move(lay));
    }
    out.document = std::move(document_);
    out.notes = std::move(notes_);
    return out;
  }

 private:
  static bool within(double value, double low, double high) { return value >= low && value <= high; }
  static bool repeats(double metres) { return within(metres, 0.002, 1); }
  Done checkSettings() const {
    if (!within(settings_.width, 0.1, 10)) return refused(say("Cloth is between 10 cm and 10 m wide."));
    if (!within(settings_.gap, 0, 0.1)) return refused(say("The gap between pieces lies between 0 and 100 mm."));
    for (const double repeat : {settings_.stripes, settings_.rows})
      if (repeat != 0 && !repeats(repeat)) return refused(say("Stripes repeat after 2 mm to 1 m; 0 is no stripes."));
    if (settings_.allowance && !within(*settings_.allowance, 0, kWidestAllowance))
      return refused(say("A seam allowance lies between 0 and 100 mm; usual are 7 to 15 mm."));
    if (settings_.tries < 0) return refused(say("The number of tries is 0 or more."));
    return {};
  }

  // The strips that are cut for bindings and piping.
  void addStrips() {
    std::size_t number = 0;
    const TimesCut times = timesCut(document_.pattern, document_.allowances, document_.cutting);
    for (const BiasStrip& strip : biasStrips(document_.pattern, document_.allowances, times)) {
      const auto piece = stripPiece(strip, number++);
      for (const Edge& edge : piece->outline.edges) document_.allowances.edges[{piece->id, edge.name}] = 0;
      document_.cutting[piece->id].count = strip.count;
      document_.pattern.pieces[piece->id] = piece;
    }
  }

  Done unfoldHalves() {
    for (int guard = 0; guard < 1000; ++guard) {
      const AllowancePlan kinds(document_.pattern, document_.allowances);
      std::optional<UnfoldPiece> next;
      for (const auto& [id, piece] : document_.pattern.pieces)
        for (const Edge& edge : piece->outline.edges)
          if (!next && kinds.kind(id, edge.name) == EdgeKind::Fold) next = UnfoldPiece{{PieceRef(id), edge.name, 0, 1}};
      if (!next) return {};
      auto after = apply(document_, Operation(*next), context_);
      if (!after)
        return Error{after.error().kind, say("“{0}” is half of what is cut, and cannot be laid whole: {1}",
                                             document_.find(next->edge.piece.id)->name, after.error().what)};
      document_ = *std::move(after);
    }
    return {};
  }

  // How far a place lies along the grain, and to its left.
  static double along(const Piece& piece, Flat p) { return dot(p, piece.grain); }
  static double aside(const Piece& piece, Flat p) { return cross(piece.grain, p); }

  // A print that was placed on pieces keeps its placing: they lie by where it begins on them, and in its repeats where
  // nobody said others.
  void printedPlaces() {
    for (const auto& [id, shift] : document_.looks.shifts) {
      const Piece& piece = *document_.find(id);
      const Look look = lookOf(document_, piece);
      if (look.print == PrintKind::None) continue;
      placed_.insert(piece.fabric);
      if (settings_.stripes > 0 || settings_.rows > 0) continue;
      const Flat repeat = printRepeat(look, photosIn(context_.blobs));
      if (!repeats(repeat.u) || !repeats(repeat.v)) continue;
      const double c = std::fabs(std::cos(look.turn)), s = std::fabs(std::sin(look.turn));
      const bool both = look.print != PrintKind::Stripe;
      if (s < kUprightPrint) {
        settings_.stripes = repeat.u;
        if (both) settings_.rows = repeat.v;
      } else if (c < kUprightPrint) {
        settings_.rows = repeat.u;
        if (both) settings_.stripes = repeat.v;
      } else {
        notes_.push_back(say("The print of “{0}” runs at an angle; its placing is not kept in the lay.", piece.name));
        placed_.erase(piece.fabric);
        continue;
      }
      notes_.push_back(
          say("The pieces of “{0}” lie in the repeats of its print, as it was placed on them.", piece.fabric));
    }
  }

  // Stripes across the cloth meet in the seams: of two sewn pieces the end of their seam that lies lower gets the same
  // place in the repeat. Stripes along the cloth are centred on each piece.
  void references() {
    const Pattern& pattern = document_.pattern;
    for (const auto& [id, piece] : pattern.pieces) {
      const Ring ring = piece->outline.flattened(kMiss);
      double low = 1e9, left = -1e9, right = 1e9;
      for (const Flat p : ring)
        low = std::min(low, along(*piece, p)), left = std::max(left, aside(*piece, p)),
        right = std::min(right, aside(*piece, p));
      aside_[id] = (left + right) / 2;
      lowest_[id] = low;
    }
    std::vector<PieceId> order;
    for (const auto& [id, piece] : pattern.pieces) {
      if (placed_.contains(piece->fabric)) {
        const Flat origin = printOrigin(document_, *piece);
        aside_[id] = aside(*piece, origin), along_[id] = along(*piece, origin);
      }
      order.push_back(id);
    }
    std::stable_sort(order.begin(), order.end(), [&](PieceId a, PieceId b) {
      return pattern.pieces.at(a)->outline.area() > pattern.pieces.at(b)->outline.area();
    });
    for (const PieceId root : order) {
      if (along_.contains(root)) continue;
      along_[root] = lowest_[root];
      std::vector<PieceId> open{root};
      while (!open.empty()) {
        const PieceId from = open.back();
        open.pop_back();
        for (const auto& [id, seam] : pattern.seams) {
          const SeamSides sides(pattern, seam);
          if (sides.a.length() <= 0 || sides.b.length() <= 0) continue;
          for (const bool swapped : {false, true})
            for (const double end : {0.0, 1.0}) {
              const SeamPlace here = (swapped ? sides.b : sides.a).at(end),
                              there = (swapped ? sides.a : sides.b).at(end);
              const SeamPlace other = (swapped ? sides.b : sides.a).at(1 - end);
              if (here.piece != from || along_.contains(there.piece) || other.piece != from) continue;
              const double h = alongAt(here), o = alongAt(other);
              if (h > o || (h == o && end > 0)) continue;
              along_[there.piece] = alongAt(there) - (h - along_[from]);
              open.push_back(there.piece);
            }
        }
      }
    }
  }
  double alongAt(const SeamPlace& place) const {
    const Piece& piece = *document_.find(place.piece);
    return along(piece, findCurve(piece, place.edge)->atFraction(place.fraction));
  }

  Ring cutRing(const Piece& piece) const {
    const bool bare = settings_.allowance && *settings_.allowance == 0;
    const auto cut = bare ? std::nullopt : cutLines(piece, *allowances_, kMiss);
    return cut ? cut->outer : piece.outline.flattened(kMiss);
  }

  // Where the piece has its fold or, folded by us, its middle: how far aside of the paper's origin.
  Result<std::optional<double>> foldOf(const Piece& piece) const {
    for (const Edge& edge : piece.outline.edges)
      if (allowances_->kind(piece.id, edge.name) == EdgeKind::Fold) {
        const Flat way = normalized(edge.curve.end - edge.curve.start);
        if (edge.curve.kind != Curve::Kind::Line || std::abs(cross(way, piece.grain)) > kStraightGrain)
          return refused(
              say("The fold “{0}” of “{1}” is not straight along the grain; it cannot lie on the cloth's fold.",
                  edge.name, piece.name));
        return std::optional(aside(piece, lerp(edge.curve.start, edge.curve.end, 0.5)));
      }
    return std::optional<double>();
  }
  // Its cut line with the grain upwards, from its lowest and middle place.
  struct Upright {
    Ring ring;
    double middle = 0;
  };
  Upright upright(const Piece& piece) const {
    Upright out;
    double low = 1e9, left = 1e9, right = -1e9;
    for (const Flat p : cutRing(piece)) {
      out.ring.push_back({aside(piece, p), along(piece, p)});
      low = std::min(low, out.ring.back().v);
      left = std::min(left, out.ring.back().u), right = std::max(right, out.ring.back().u);
    }
    out.middle = (left + right) / 2;
    for (Flat& p : out.ring) p = p - Flat{out.middle, low};
    return out;
  }
  static bool mirrorImages(const Ring& a, const Ring& b) {
    const auto lies = [](const Ring& all, const Ring& on) {
      return std::all_of(all.begin(), all.end(), [&](Flat p) { return distanceToRing(on, {-p.u, p.v}) < kSame; });
    };
    return lies(a, b) && lies(b, a);
  }
  std::optional<double> middleOf(const Piece& piece) const {
    const Upright own = upright(piece);
    return mirrorImages(own.ring, own.ring) ? std::optional(own.middle) : std::nullopt;
  }

  // Of pieces that are cut once, those whose mirror image is another piece: the folded cloth gives both at once.
  void findPartners(const std::vector<const Piece*>& pieces) {
    std::vector<std::pair<const Piece*, Upright>> single;
    for (const Piece* piece : pieces) {
      const auto told = document_.cutting.find(piece->id);
      if ((told == document_.cutting.end() || told->second.count == 1) && !allowances_->onFold(*piece))
        single.emplace_back(piece, upright(*piece));
    }
    for (std::size_t i = 0; i < single.size(); ++i)
      for (std::size_t j = i + 1; j < single.size(); ++j) {
        const PieceId a = single[i].first->id, b = single[j].first->id;
        if (partner_.contains(a) || below_.contains(a) || below_.contains(b)) continue;
        if (!mirrorImages(single[i].second.ring, single[j].second.ring)) continue;
        partner_[a] = b;
        below_.insert(b);
      }
  }

  Result<std::vector<Share>> sharesOf(const Piece& piece) {
    const auto told = document_.cutting.find(piece.id);
    const Cutting cutting = told == document_.cutting.end() ? Cutting() : told->second;
    const auto count = static_cast<std::size_t>(cutting.count);
    const bool down = faceDown_.contains(piece.id);
    if (!settings_.folded) {
      std::vector<Share> all;
      const std::size_t over = cutting.pairs ? count / 2 : 0;
      if (count > over) all.push_back({.count = count - over, .over = down});
      if (over > 0) all.push_back({.count = over, .over = true});
      return all;
    }
    const auto fold = foldOf(piece);
    if (!fold) return fold.error();
    if (*fold) return std::vector<Share>{{.count = count, .onEdge = true, .layers = 1, .middle = **fold}};
    if (partner_.contains(piece.id)) return std::vector<Share>{{.count = 1, .mirrorToo = true, .layers = 2}};
    const std::optional<double> middle = middleOf(piece);
    if (cutting.pairs || middle) {
      std::vector<Share> all;
      if (count / 2 > 0) all.push_back({.count = count / 2, .mirrorToo = true, .layers = 2});
      if (count % 2 && middle)
        all.push_back({.count = 1, .half = true, .onEdge = true, .layers = 1, .middle = *middle});
      else if (count % 2)
        all.push_back({.count = 1, .layers = 1});
      if (count % 2 == 0 || middle) return all;
    }
    notes_.push_back(
        say("“{0}” is cut from one layer of the folded cloth; what lies below it is left over.", piece.name));
    const std::size_t pairs = cutting.pairs ? count / 2 : 0;
    std::vector<Share> all;
    if (pairs > 0) all.push_back({.count = pairs, .mirrorToo = true, .layers = 2});
    all.push_back({.count = count - 2 * pairs, .over = down, .layers = 1});
    return all;
  }

  // A way a share may lie, as a shape.
  struct Way {
    bool over = false, turned = false;
    Flat shift;  // added to the paper's place after turning: on the fold, the fold lies at v = 0
  };

  Result<FabricLay> layFabric(const std::string& fabric, const std::vector<const Piece*>& pieces, double from,
                              double to) {
    FabricLay lay;
    lay.fabric = fabric;
    lay.width = settings_.folded ? settings_.width / 2 : settings_.width;
    std::vector<NestShape> shapes;
    std::vector<Way> ways;
    std::vector<NestItem> items;
    std::vector<LaidPiece> laid;
    if (settings_.folded) findPartners(pieces);
    for (const Piece* piece : pieces) {
      if (below_.contains(piece->id)) continue;
      const auto partner = partner_.find(piece->id);
      const PieceId under = partner == partner_.end() ? PieceId() : partner->second;
      const Ring cut = cutRing(*piece);
      const auto shares = sharesOf(*piece);
      if (!shares) return shares.error();
      std::size_t copy = 0;
      for (const Share& share : *shares) {
        NestItem item;
        item.onEdge = share.onEdge;
        for (const bool turned : {false, true}) {
          if (turned && settings_.nap) continue;
          for (const bool over : {false, true}) {
            LaidPiece lies{
                piece->id,        under, 0, over, turned, share.onEdge, share.half, share.layers, piece->grain, {},
                reference(*piece)};
            if (share.onEdge) {
              // The cloth lies on the side of v > 0 of its fold: one of the two images of a half does.
              Ring ring = shifted(lies, cut, share.middle, *piece);
              if (!share.half) {
                double most = 0;
                for (const Flat p : ring)
                  if (std::abs(p.v) > std::abs(most)) most = p.v;
                if (most < 0) continue;
              } else if (over) {
                continue;
              }
              ring = counterClockwise(upperHalf(ring));
              item.ways.push_back(add(shapes, ways, lies, ring, share.middle, *piece));
            } else if (share.mirrorToo || over == share.over) {
              item.ways.push_back(add(shapes, ways, lies, counterClockwise(shifted(lies, cut, 0, *piece)), 0, *piece));
            }
          }
        }
        for (std::size_t k = 0; k < share.count; ++k) {
          if (items.size() == kMostLaid)
            return refused(say("More than {0} pieces of one fabric cannot be laid.", kMostLaid));
          items.push_back(item);
          laid.push_back({piece->id,
                          under,
                          copy++,
                          false,
                          false,
                          share.onEdge,
                          share.half,
                          share.layers,
                          piece->grain,
                          {},
                          reference(*piece)});
        }
      }
    }
    NestSettings nesting;
    nesting.width = lay.width;
    nesting.gap = settings_.gap;
    nesting.across = settings_.stripes;
    nesting.along = settings_.rows;
    nesting.tries = settings_.tries;
    nesting.seed = settings_.seed;
    nesting.from = from, nesting.to = to;
    const auto nested = nest(shapes, items, nesting, context_.workers, context_.token);
    if (!nested) return nested.error();
    if (nested->homeless)
      return tooNarrow(*document_.find(laid[*nested->homeless].piece), shapes, items[*nested->homeless], lay);
    for (std::size_t i = 0; i < laid.size(); ++i) {
      const NestPlace& place = nested->places[i];
      laid[i].over = ways[place.way].over;
      laid[i].turned = ways[place.way].turned;
      laid[i].at = place.at + ways[place.way].shift;
      Ring ring = shapes[place.way].ring;
      for (Flat& p : ring) p += place.at;
      lay.cut.push_back(std::move(ring));
    }
    lay.pieces = std::move(laid);
    measureLay(lay, settings_.folded);
    return lay;
  }

  Ring shifted(const LaidPiece& lies, const Ring& cut, double middle, const Piece& piece) const {
    Ring ring;
    const Flat shift = shiftOf(lies, middle, piece);
    for (const Flat p : cut) ring.push_back(lies.step(p) + shift);
    return ring;
  }
  static Flat shiftOf(const LaidPiece& lies, double middle, const Piece& piece) {
    const Flat fold = lies.step(leftOf(piece.grain) * middle);
    return {0, -fold.v};
  }
  Flat reference(const Piece& piece) const {
    return piece.grain * along_.at(piece.id) + leftOf(piece.grain) * aside_.at(piece.id);
  }
  std::size_t add(std::vector<NestShape>& shapes, std::vector<Way>& ways, const LaidPiece& lies, Ring ring,
                  double middle, const Piece& piece) const {
    const Flat shift = shiftOf(lies, middle, piece);
    shapes.push_back({std::move(ring), lies.step(lies.reference) + shift});
    ways.push_back({lies.over, lies.turned, shift});
    return shapes.size() - 1;
  }

  Error tooNarrow(const Piece& piece, const std::vector<NestShape>& shapes, const NestItem& item,
                  const FabricLay& lay) const {
    double low = 1e9, high = -1e9;
    for (const Flat p : shapes[item.ways[0]].ring) low = std::min(low, p.v), high = std::max(high, p.v);
    const auto cm = [](double metres) { return fixed(metres * 100, 1); };
    if (high - low <= lay.width)
      return refused(say("“{0}” finds no place where its stripes lie right: it is {1} cm wide, the cloth {2} cm.",
                         piece.name, cm(high - low), cm(lay.width)));
    if (settings_.folded)
      return refused(say("“{0}” is {1} cm wide, the folded cloth {2} cm. Lay it open, or take wider cloth.", piece.name,
                         cm(high - low), cm(lay.width)));
    return refused(
        say("“{0}” is {1} cm wide across its grain, the cloth {2} cm. Take wider cloth, or divide the piece.",
            piece.name, cm(high - low), cm(lay.width)));
  }

  LaySettings settings_;
  Context& context_;
  Document document_;
  std::optional<AllowancePlan> allowances_;
  std::set<std::string> placed_;  // fabrics with a print that was placed on pieces
  std::map<PieceId, double> along_, aside_, lowest_;
  std::map<PieceId, PieceId> partner_;  // of an upper piece the lower one
  std::set<PieceId> below_;
  std::set<PieceId> faceDown_;  // whose paper lies turned over
  std::vector<Message> notes_;
};

// Where a line along the cloth runs within the ring: from, to, from, to.
std::vector<double> within(const Ring& ring, double v) {
  std::vector<double> met;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Flat p = ring[i], q = ring[(i + 1) % ring.size()];
    if ((p.v > v) != (q.v > v)) met.push_back(p.u + (q.u - p.u) * (v - p.v) / (q.v - p.v));
  }
  std::sort(met.begin(), met.end());
  return met;
}

// Of rings whose sides do not cross: whether they share any place. Between two neighbouring corners' heights their
// sides keep their order along every line, so one line in the middle tells of all.
bool holds(const Ring& a, const Ring& b) {
  std::vector<double> heights;
  for (const Ring* ring : {&a, &b})
    for (const Flat p : *ring) heights.push_back(p.v);
  std::sort(heights.begin(), heights.end());
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    if (heights[k + 1] - heights[k] < kOverlap) continue;
    const double v = (heights[k] + heights[k + 1]) / 2;
    const std::vector<double> inA = within(a, v), inB = within(b, v);
    for (std::size_t i = 0; i + 1 < inA.size(); i += 2)
      for (std::size_t j = 0; j + 1 < inB.size(); j += 2) {
        const double from = std::max(inA[i], inB[j]), to = std::min(inA[i + 1], inB[j + 1]);
        if (to - from <= kOverlap) continue;
        const Flat middle{(from + to) / 2, v};
        if (distanceToRing(a, middle) > kOverlap / 2 && distanceToRing(b, middle) > kOverlap / 2) return true;
      }
  }
  return false;
}

bool crossesOrHolds(const Ring& a, const Ring& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Flat p = a[i], q = a[(i + 1) % a.size()];
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Flat r = b[j], s = b[(j + 1) % b.size()];
      const double d1 = cross(q - p, r - p), d2 = cross(q - p, s - p), d3 = cross(s - r, p - r),
                   d4 = cross(s - r, q - r);
      if (((d1 > 0) != (d2 > 0)) && ((d3 > 0) != (d4 > 0))) {
        // How deep: the least distance by which one end lies beyond the other side.
        const double deep = std::min(std::min(std::abs(d1), std::abs(d2)) / std::max(1e-12, distance(p, q)),
                                     std::min(std::abs(d3), std::abs(d4)) / std::max(1e-12, distance(r, s)));
        if (deep > kOverlap) return true;
      }
    }
  }
  return holds(a, b);
}

struct Bounds : FlatBox {
  explicit Bounds(const Ring& ring) : FlatBox(boxOf(ring)) {}
  bool apartFrom(const Bounds& other) const {
    return low.u > other.high.u || other.low.u > high.u || low.v > other.high.v || other.low.v > high.v;
  }
};
bool leaves(const Bounds& bounds, double width) {
  return bounds.low.u < -kOverlap || bounds.low.v < -kOverlap || bounds.high.v > width + kOverlap;
}

// By whole repeats, the nearest; 0: any length.
double whole(double by, double repeat) { return repeat > 0 ? std::round(by / repeat) * repeat : by; }

}  // namespace

Result<LayPlan> layPlan(const Document& document, const LaySettings& settings, Context& context) {
  return Laying(document, settings, context).plan();
}

Flat LaidPiece::step(Flat paper) const {
  const double up = dot(paper, grain), left = cross(grain, paper);
  return turnedHalf({-up, over ? left : -left}, turned);
}
Flat LaidPiece::operator()(Flat paper) const { return step(paper) + at; }

std::optional<LayClash> clash(const FabricLay& lay) {
  const std::vector<Bounds> bounds(lay.cut.begin(), lay.cut.end());
  for (std::size_t i = 0; i < lay.cut.size(); ++i) {
    if (leaves(bounds[i], lay.width)) return LayClash{i, std::nullopt};
    for (std::size_t j = 0; j < i; ++j)
      if (!bounds[i].apartFrom(bounds[j]) && crossesOrHolds(lay.cut[i], lay.cut[j])) return LayClash{j, i};
  }
  return std::nullopt;
}

std::optional<LayClash> clash(const FabricLay& lay, std::size_t nth) {
  const Bounds own(lay.cut[nth]);
  if (leaves(own, lay.width)) return LayClash{nth, std::nullopt};
  for (std::size_t j = 0; j < lay.cut.size(); ++j)
    if (j != nth && !own.apartFrom(Bounds(lay.cut[j])) && crossesOrHolds(lay.cut[nth], lay.cut[j]))
      return LayClash{nth, j};
  return std::nullopt;
}

void moveLaid(FabricLay& lay, std::size_t nth, Flat by, const LaySettings& settings) {
  LaidPiece& piece = lay.pieces[nth];
  by = {whole(by.u, settings.rows), piece.onFold ? 0 : whole(by.v, settings.stripes)};
  piece.at += by;
  for (Flat& p : lay.cut[nth]) p += by;
}

Done turnLaid(FabricLay& lay, std::size_t nth, const LaySettings& settings) {
  if (settings.nap)
    return refused(say("The cloth has nap, or a print with a direction: all pieces lie the same way up."));
  LaidPiece& piece = lay.pieces[nth];
  const Bounds bounds(lay.cut[nth]);
  const Flat was = piece(piece.reference), sum = bounds.low + bounds.high;
  const bool fold = piece.onFold;
  piece.turned = !piece.turned;
  // What is cut whole on the fold lies on its other side when turned. Of a half both sides are alike.
  if (fold && !piece.half) piece.over = !piece.over;
  piece.at = {sum.u - piece.at.u, !fold ? sum.v - piece.at.v : piece.half ? -piece.at.v : piece.at.v};
  for (Flat& p : lay.cut[nth]) p = {sum.u - p.u, fold ? p.v : sum.v - p.v};
  if (fold) std::reverse(lay.cut[nth].begin(), lay.cut[nth].end());
  const Flat off = was - piece(piece.reference);
  const Flat back{settings.rows > 0 ? off.u - whole(off.u, settings.rows) : 0,
                  settings.stripes > 0 && !fold ? off.v - whole(off.v, settings.stripes) : 0};
  piece.at += back;
  for (Flat& p : lay.cut[nth]) p += back;
  return {};
}

void measureLay(FabricLay& lay, bool folded) {
  lay.length = lay.area = 0;
  for (std::size_t i = 0; i < lay.cut.size(); ++i) {
    for (const Flat p : lay.cut[i]) lay.length = std::max(lay.length, p.u);
    lay.area += std::abs(signedArea(lay.cut[i])) * (lay.pieces[i].onFold ? 2 : lay.pieces[i].layers);
  }
  const double cloth = lay.length * lay.width * (folded ? 2 : 1);
  lay.use = cloth > 0 ? lay.area / cloth : 0;
}

}  // namespace karinui

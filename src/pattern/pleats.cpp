#include "karinui/pattern/pleats.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "divide_edges.h"
#include "folded_paper.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kSameFold = 1e-6;    // metres
constexpr double kLeastTaper = 0.01;  // metres along the lines
constexpr int kMostOver = 3;          // how many times as deep as they are apart pleats may be that overlap

// Of what a fold gives way by, the share that its fold line moves into what is folded in; the line where it comes to
// lie moves by the rest. The two folds of an inverted pleat go on meeting in front.
double shareOfFold(PleatKind kind) { return kind == PleatKind::Inverted ? 1 : 0.5; }

// Where a curve reaches a place across the lines; `rising` says which way it runs. Nothing: it does not.
std::optional<double> parameterAcross(const Curve& curve, Flat across, double wanted, bool rising) {
  const auto away = [&](double t) { return (dot(curve.at(t), across) - wanted) * (rising ? 1 : -1); };
  if (std::abs(away(0)) < kSameFold) return 0;
  if (std::abs(away(1)) < kSameFold) return 1;
  if (away(0) > 0 || away(1) < 0) return std::nullopt;
  double low = 0, high = 1;
  for (int round = 0; round < 60; ++round) (away((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

bool monotonous(const Curve& curve, Flat across, double t0, double t1, bool rising) {
  constexpr int kLooks = 32;
  for (int k = 0; k <= kLooks; ++k) {
    const Flat way = curve.tangent(std::lerp(t0, t1, k / double{kLooks}));
    if (dot(way, across) * (rising ? 1 : -1) <= 0.05 * length(way)) return false;
  }
  return true;
}

Curve moved(const Curve& curve, Flat by) {
  Curve now = curve;
  now.start += by, now.end += by;
  if (curve.kind == Curve::Kind::Cubic) now.control1 += by, now.control2 += by;
  for (Flat& p : now.between) p += by;
  return now;
}

Outline moved(const Outline& outline, Flat by) {
  Outline now = outline;
  for (Edge& edge : now.edges) edge.curve = moved(edge.curve, by);
  return now;
}

class Spreading {
 public:
  Spreading(const Piece& piece, const PleatPlan& plan) : piece_(piece), plan_(plan) {}

  Result<PleatedPiece> spread() {
    made_.edited.piece = piece_, made_.depth = plan_.depth;
    made_.foldsShare = shareOfFold(plan_.kind);
    if (Done done = findFolds(); !done) return done.error();
    if (Done done = findBeyond(); !done) return done.error();
    if (Done done = clearTheWay(); !done) return done.error();
    if (Done done = findTaper(); !done) return done.error();
    cutEdges();
    auto good = checked(std::move(outline_));
    if (!good) return good.error();
    Piece& now = made_.edited.piece;
    now.outline = *std::move(good);
    drawLines(now);
    followMarks(now, made_.edited.edges);
    return std::move(made_);
  }

 private:
  double across(Flat p) const { return dot(p, made_.across); }
  Flat by(std::size_t folds) const { return made_.across * (2 * plan_.depth * static_cast<double>(folds)); }
  // What ends where a fold lies goes on from the layer under it.
  std::size_t foldsBefore(double at) const {
    return static_cast<std::size_t>(std::count_if(made_.folds.begin(), made_.folds.end(), [&](const PleatFold& f) {
      return f.at < at + (f.toStart ? -kSameFold : kSameFold);
    }));
  }
  double height(Flat p) const { return dot(p, plan_.along); }
  const Edge& near() const { return piece_.outline.edges[near_]; }
  const Curve& far() const { return piece_.outline.edges[far_].curve; }
  Flat placeOn(const Curve& curve, double at, bool rising) const {
    return curve.at(*parameterAcross(curve, made_.across, at, rising));
  }

  Done findFolds() {
    const auto k = piece_.outline.find(plan_.edge);
    if (!k) return notFound(say("Piece {0} has no edge {1}.", piece_.name, plan_.edge));
    near_ = *k;
    const double d = plan_.depth;
    if (!(d >= kLeastEdge && d <= 0.5)) return refused(say("A pleat is between 1 mm and 50 cm deep."));
    made_.across = -leftOf(plan_.along);
    const Curve& curve = near().curve;
    const auto add = [&](double at, bool toStart) {
      made_.folds.push_back({at, toStart ? at : at - d, 0, toStart, {}, {}, {}});
    };
    for (std::size_t n = 0; n < plan_.at.size(); ++n) {
      const double at = across(curve.atFraction(plan_.at[n]));
      if (plan_.kind == PleatKind::Knife) add(at, n < plan_.toStart.size() && plan_.toStart[n]);
      if (plan_.kind == PleatKind::Inverted) add(at, false), add(at, true);
      if (plan_.kind == PleatKind::Box) add(at - d, true), add(at + d, false);
    }
    auto& folds = made_.folds;
    for (std::size_t n = 0; n < folds.size(); ++n) {
      folds[n].strip = folds[n].at + 2 * d * static_cast<double>(n);
      if (n == 0 || folds[n].low >= folds[n - 1].low + d - kSameFold) continue;
      const double apart = folds[n].at - folds[n - 1].at;
      const bool oneWay = plan_.kind == PleatKind::Knife && folds[n].toStart == folds[n - 1].toStart;
      if (!oneWay || d > kMostOver * apart + kSameFold)
        return refused(
            say("The pleats lie over each other: each covers {0} mm, and they are {1} mm apart; choose fewer "
                "or a smaller depth. Only knife pleats turned one way may cover part of the next, up to {2} times as "
                "deep as they are apart.",
                inMm(plan_.kind == PleatKind::Knife ? d : 2 * d),
                inMm(plan_.at.size() > 1 ? (plan_.at[1] - plan_.at[0]) * curve.length() : 0), kMostOver));
      made_.overlapping = true;
    }
    for (const PleatFold& fold : folds) {
      const auto from = parameterAcross(curve, made_.across, fold.low, true),
                 to = parameterAcross(curve, made_.across, fold.low + d, true);
      if (!from || !to)
        return refused(
            say("A pleat {0} mm deep does not fit there on edge {1}, which is {2} mm long: it would reach "
                "beyond its end. Put it farther in, or join the edge to the next one first.",
                inMm(d), plan_.edge, inMm(curve.length())));
      if (!monotonous(curve, made_.across, *from, *to, true))
        return refused(
            say("The pleats run along edge {0}, not into the piece; give them another direction.", plan_.edge));
    }
    return {};
  }

  // What is said where the folds do not end in one edge: in which they do.
  Message noOneBeyond() const {
    std::string names;
    std::size_t count = 0;
    for (std::size_t k = 0; k < piece_.outline.edges.size(); ++k) {
      const Edge& edge = piece_.outline.edges[k];
      if (k == near_ || std::none_of(made_.folds.begin(), made_.folds.end(), [&](const PleatFold& fold) {
            return parameterAcross(edge.curve, made_.across, fold.low, false) ||
                   parameterAcross(edge.curve, made_.across, fold.low + plan_.depth, false);
          }))
        continue;
      names += (count++ > 0 ? ", " : "") + edge.name;
    }
    if (count > 1)
      return say(
          "The pleats from edge {0} have to end in one edge across the piece, and end in {1}. Join these edges first, "
          "or choose another place or direction.",
          plan_.edge, names);
    return say("The pleats from edge {0} have to end in one edge across the piece; choose another place or direction.",
               plan_.edge);
  }

  // The edge in which all folds end.
  Done findBeyond() {
    const auto& edges = piece_.outline.edges;
    const double d = plan_.depth;
    for (const PleatFold& fold : made_.folds) {
      std::optional<std::size_t> found;
      for (std::size_t k = 0; k < edges.size(); ++k) {
        if (k == near_) continue;
        const Curve& curve = edges[k].curve;
        const auto from = parameterAcross(curve, made_.across, fold.low + d, false),
                   to = parameterAcross(curve, made_.across, fold.low, false);
        if (!from || !to || *to - *from < 1e-9 || !monotonous(curve, made_.across, *from, *to, false)) continue;
        if (found) return refused(say("The pleats of {0} would run through edge {1}.", piece_.name, edges[k].name));
        found = k;
      }
      if (!found || (&fold != made_.folds.data() && *found != far_)) return refused(noOneBeyond());
      far_ = *found;
    }
    made_.beyondOf = edges[far_].name;
    const Curve& curve = edges[far_].curve;
    straight_ = curve.kind == Curve::Kind::Line &&
                std::abs(dot(normalized(curve.end - curve.start), plan_.along)) < 1e-9 && !plan_.sewnBeyond;
    return {};
  }

  // It begins where the edge has come to lie behind all folds, so that it is the same at a height for all of them.
  Done findTaper() {
    if (plan_.taper == 0) return {};
    const double most = 2 * (plan_.depth - kLeastEdge);
    if (!(plan_.taper > 0 && plan_.taper <= most))
      return refused(
          say("A fold {0} mm deep tapers by {1} mm at most, so that a fold is left.", inMm(plan_.depth), inMm(most)));
    if (plan_.sewnBeyond)
      return refused(
          say("Edge {0}, in which the pleats end, is sewn; pleats that taper widen it. Sew it afterwards, or "
              "leave the taper away.",
              made_.beyondOf));
    double from = -HUGE_VAL, to = HUGE_VAL;
    for (const PleatFold& fold : made_.folds) {
      from = std::max(from, height(placeOn(near().curve, fold.at, true)));
      to = std::min(to, height(placeOn(far(), fold.at, false)));
    }
    made_.taper = plan_.taper, made_.taperFrom = from, made_.taperTo = to;
    if (plan_.taperLength > 0) made_.taperTo = std::min(to, from + plan_.taperLength);
    if (!(made_.taperTo > from + kLeastTaper))
      return refused(say("A taper is at least {0} mm long; here it would be {1} mm.", inMm(kLeastTaper),
                         inMm(made_.taperTo - from)));
    return {};
  }

  // Nothing else may lie across the lines.
  Done clearTheWay() const {
    const auto crossed = [&](const std::vector<Flat>& line) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const Flat p : line) low = std::min(low, across(p)), high = std::max(high, across(p));
      return std::any_of(made_.folds.begin(), made_.folds.end(),
                         [&](const PleatFold& f) { return low < f.at - kSameFold && high > f.at + kSameFold; });
    };
    for (std::size_t k = 0; k < piece_.outline.edges.size(); ++k)
      if (k != near_ && k != far_ && crossed(piece_.outline.edges[k].curve.flattened(1e-4)))
        return refused(say("The pleats of {0} would run through edge {1}.", piece_.name, piece_.outline.edges[k].name));
    for (const Outline& hole : piece_.holes)
      if (crossed(hole.flattened(1e-4)))
        return refused(say("The pleats would run through a hole of {0}.", piece_.name));
    for (const InternalLine& line : piece_.lines)
      for (const Curve& curve : line.curves)
        if (crossed(curve.flattened(1e-4)))
          return refused(say("The pleats would run through the line “{0}” of {1}; pleat first, and draw it then.",
                             line.name, piece_.name));
    return {};
  }

  // The parts of a curve between the folds and what is folded in, in the order of the outline.
  struct Part {
    Curve curve;
    double from = 0, to = 1;  // of the curve's length; of what is folded in, of the part it lies under
    int fold = -1;            // -1: it was there before
    bool second = false;      // of the two of a fold, across
  };
  std::vector<Part> partsOf(const Curve& curve, bool rising) const {
    const double whole = curve.length();
    const auto reach = [&](double at) { return *parameterAcross(curve, made_.across, at, rising); };
    std::vector<Part> parts;
    double t = 0;
    const auto flat = [&](double to, std::size_t folds) {
      if (curve.lengthTo(to) - curve.lengthTo(t) > kSameFold)
        parts.push_back({moved(t == 0 && to == 1 ? curve : curve.part(t, to), by(folds)), curve.lengthTo(t) / whole,
                         curve.lengthTo(to) / whole, -1, false});
      t = to;
    };
    const std::size_t n = made_.folds.size();
    for (std::size_t step = 0; step < n; ++step) {
      const std::size_t k = rising ? step : n - 1 - step;
      const PleatFold& fold = made_.folds[k];
      flat(reach(fold.at), rising ? k : k + 1);
      double a = reach(fold.low), b = reach(fold.low + plan_.depth);
      if (a > b) std::swap(a, b);
      const Curve over = curve.part(a, b);
      const double from = curve.lengthTo(a) / whole, to = curve.lengthTo(b) / whole;
      // Of the two that are folded in, one lies as the part over it, one is its mirror image.
      const Flat axis = made_.across * (fold.toStart ? fold.at + plan_.depth : fold.at);
      const Part mirrored{moved(over.mirrored(axis, plan_.along).reversed(), by(k)), from, to, static_cast<int>(k),
                          fold.toStart};
      const Part alike{moved(over, by(fold.toStart ? k : k + 1)), from, to, static_cast<int>(k), !fold.toStart};
      const bool mirrorFirst = fold.toStart != rising;
      parts.push_back(mirrorFirst ? mirrored : alike);
      parts.push_back(mirrorFirst ? alike : mirrored);
    }
    flat(1, rising ? n : 0);
    return parts;
  }

  void cutEdges() {
    auto taken = edgeNames(piece_);
    const auto& edges = piece_.outline.edges;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (k != near_ && k != far_) {
        outline_.edges.push_back({edges[k].name, moved(edges[k].curve, by(foldsBefore(middleAcross(edges[k]))))});
        continue;
      }
      const std::vector<Part> parts = partsOf(edges[k].curve, k == near_);
      const std::size_t before = outline_.edges.size();
      if (k == far_ && straight_)
        addStraight(edges[k], parts);
      else
        addDivided(edges[k], parts, k == near_ || plan_.sewnBeyond, taken);
      if (k == far_) farEdges_ = {before, outline_.edges.size()};
    }
    // Corners are met to the last bit.
    for (std::size_t k = 0; k < outline_.edges.size(); ++k)
      outline_.edges[(k + 1) % outline_.edges.size()].curve.start = outline_.edges[k].curve.end;
  }

  double middleAcross(const Edge& edge) const { return (across(edge.curve.start) + across(edge.curve.end)) / 2; }

  void addDivided(const Edge& edge, const std::vector<Part>& parts, bool sewn, std::set<std::string>& taken) {
    auto& map = made_.edited.edges[{piece_.id, edge.name}];
    bool first = true;
    std::vector<std::pair<Part, std::string>> folded;
    for (const Part& part : parts) {
      const bool flat = part.fold < 0;
      const std::string name =
          flat && std::exchange(first, false) ? edge.name : freeName(flat || !sewn ? edge.name : plan_.name, taken);
      outline_.edges.push_back({name, part.curve});
      if (flat)
        map.push_back({part.from, part.to, {piece_.id, name, 0, 1}});
      else if (sewn)
        folded.emplace_back(part, name);
      else
        made_.beyond.push_back(name);
    }
    for (const auto& [part, name] : folded)
      for (const EdgePart& over : map) {  // the flat parts it lies under: one, where pleats do not overlap
        const double from = std::max(part.from, over.from), to = std::min(part.to, over.to);
        if ((to - from) * edge.curve.length() < kLeastEdge) continue;
        const auto share = [](double at, double low, double high) {
          const double s = (at - low) / (high - low);
          return s < 1e-6 ? 0.0 : s > 1 - 1e-6 ? 1.0 : s;
        };
        const bool reversed = part.second == made_.folds[static_cast<std::size_t>(part.fold)].toStart;
        const double begins = share(from, part.from, part.to), ends = share(to, part.from, part.to);
        made_.layers.push_back(
            {{piece_.id, over.now.edge, share(from, over.from, over.to), share(to, over.from, over.to)},
             {piece_.id, name, reversed ? 1 - ends : begins, reversed ? 1 - begins : ends},
             reversed});
      }
  }

  // An edge straight across the lines stays one edge.
  void addStraight(const Edge& edge, const std::vector<Part>& parts) {
    auto& map = made_.edited.edges[{piece_.id, edge.name}];
    const Curve now = Curve::line(parts.front().curve.start, parts.back().curve.end);
    const double whole = now.length();
    const double opened = made_.opened(now.start);
    double walked = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Part& part = parts[k];
      const double own = part.curve.length();
      // Beside a fold it goes on into what is folded in, as far as that gives way. The edge is walked from high to low.
      if (part.fold < 0) {
        const double before = k > 0 ? opened * shareOf(parts[k - 1].fold, false) : 0,
                     after = k + 1 < parts.size() ? opened * shareOf(parts[k + 1].fold, true) : 0;
        const double from = (walked - before) / whole, to = std::min(1.0, (walked + own + after) / whole);
        map.push_back({part.from, part.to, {piece_.id, edge.name, from, to}});
      }
      walked += own;
    }
    outline_.edges.push_back({edge.name, now});
  }

  // The share of what a fold gives way by that is taken at the upper or lower end of its strip.
  double shareOf(int fold, bool upper) const {
    return made_.folds[static_cast<std::size_t>(fold)].toStart == upper ? made_.foldsShare : 1 - made_.foldsShare;
  }

  // A line that begins at a place of the edge, and goes aside by `aside` of what a fold gives way by.
  Curve tapered(Flat from, Flat to, double aside, const Outline& now) const {
    if (!(made_.taper > 0) || aside == 0) return Curve::line(from, to);
    const double whole = made_.taper * aside, low = made_.taperFrom, high = made_.taperTo;
    const auto at = [&](double in, double h) { return made_.across * (across(from) + in) + plan_.along * h; };
    std::vector<Curve> parts;
    Flat place = from;
    if (height(from) < low - kLeastEdge) parts.push_back(Curve::line(from, place = at(0, low)));
    // e (2 x - x^2) is a parabola; the middle control of its quadratic is e aside, halfway down.
    const Flat middle = at(whole, (low + high) / 2), end = at(whole, high);
    const Flat beyond = endOf(across(end), to, now);
    const bool goesOn = height(beyond) > high + kLeastEdge;
    const Flat stop = goesOn ? end : beyond;
    parts.push_back(Curve::cubic(place, lerp(place, middle, 2.0 / 3), lerp(stop, middle, 2.0 / 3), stop));
    if (goesOn) parts.push_back(Curve::line(end, beyond));
    return Curve::joined(parts);
  }

  // Where a line ends at the other edge.
  Flat endOf(double wanted, Flat otherwise, const Outline& now) const {
    for (std::size_t k = farEdges_.first; k < farEdges_.second; ++k)
      if (const auto t = parameterAcross(now.edges[k].curve, made_.across, wanted, false))
        return now.edges[k].curve.at(*t);
    return otherwise;
  }

  // The lines, and what is drawn inside, which goes along with its cloth.
  void drawLines(Piece& now) {
    for (Outline& hole : now.holes) hole = moved(hole, by(foldsBefore(middleAcross(hole.edges.front()))));
    for (InternalLine& line : now.lines)
      for (Curve& curve : line.curves) curve = moved(curve, by(foldsBefore(across(curve.at(0.5)))));
    for (Mark& mark : now.marks)
      if (mark.edge.empty()) mark.place += by(foldsBefore(across(mark.place)));
    std::set<std::string> taken;
    for (const InternalLine& line : now.lines) taken.insert(line.name);
    const std::size_t before = now.lines.size();
    const Curve &in = near().curve, &out = far();
    const double d = plan_.depth;
    for (std::size_t k = 0; k < made_.folds.size(); ++k) {
      PleatFold& fold = made_.folds[k];
      // As high as the cloth over or under it ends, at a place of the strip.
      const double lower = shareOf(static_cast<int>(k), false), upper = shareOf(static_cast<int>(k), true);
      const auto line = [&](std::string_view what, double flat, double strip) {
        const Flat step = made_.across * (fold.strip + strip - flat);
        const double aside = strip == 0 ? lower : strip == d ? (lower - upper) / 2 : -upper;
        InternalLine drawn;
        drawn.name = freeName(plan_.name + "_" + std::string(what), taken);
        drawn.curves = {tapered(placeOn(in, flat, true) + step, placeOn(out, flat, false) + step, aside, now.outline)};
        now.lines.push_back(std::move(drawn));
        return now.lines.back().name;
      };
      const double turn = fold.toStart ? fold.low + d : fold.low;
      const auto place = [&] {  // the two folds of an inverted pleat come to lie at one line
        if (k > 0 && std::abs(made_.folds[k - 1].at - fold.at) < kSameFold && fold.toStart)
          return made_.folds[k - 1].place;
        return line("place", fold.at, fold.toStart ? 0 : 2 * d);
      };
      if (fold.toStart) {
        fold.place = place();
        fold.inner = line("inner", turn, d);
        fold.fold = line("fold", fold.at, 2 * d);
      } else {
        fold.fold = line("fold", fold.at, 0);
        fold.inner = line("inner", turn, d);
        fold.place = place();
      }
    }
    made_.linesAdded = now.lines.size() - before;
  }

  const Piece& piece_;
  const PleatPlan& plan_;
  PleatedPiece made_;
  Outline outline_;
  std::size_t near_ = 0, far_ = 0;
  std::pair<std::size_t, std::size_t> farEdges_;  // of the new outline
  bool straight_ = false;                         // the far edge, and it stays one
};

}  // namespace

FoldedPlace PleatedPiece::folded(Flat place) const {
  if (wedge) return wedge->folded(place);
  const double open = opened(place);
  FoldedPaper paper{across, depth - open / 2, overlapping, {}};
  double given = 0;  // by the folds before
  for (const PleatFold& fold : folds) {
    const double into = open * (fold.toStart ? 1 - foldsShare : foldsShare), at = fold.at + given + into;
    paper.folds.push_back({at, fold.toStart ? at : at - paper.depth, fold.strip + into, fold.toStart});
    given += open;
  }
  FoldedPlace in = paper.folded(place);
  in.place = in.place - across * (given / 2);
  return in;
}

double PleatedPiece::opened(Flat place) const {
  if (!(taper > 0)) return 0;
  const double x = std::clamp((dot(place, leftOf(across)) - taperFrom) / (taperTo - taperFrom), 0.0, 1.0);
  return taper * x * (2 - x);
}

Flat PleatedPiece::spread(Flat place) const {
  if (wedge) return wedge->opened ? wedge->opened(place) : place;
  if (drawn) return place;
  double by = 0;
  for (const PleatFold& fold : folds)
    if (fold.at < dot(place, across)) by += 2 * depth;
  return place + across * by;
}

std::vector<PaperPleat> pleatsOf(const Pattern& pattern) {
  std::vector<PaperPleat> pleats;
  const auto folded = [](const Seam& seam) {
    return seam.tie == Seam::Tie::Pleat && seam.a.size() == 1 && seam.b.size() == 1;
  };
  for (const auto& [id, mirrored] : pattern.seams) {
    if (!folded(mirrored) || !mirrored.reversed) continue;
    for (const auto& [other, alike] : pattern.seams) {
      if (!folded(alike) || alike.reversed || alike.a != mirrored.a) continue;
      const auto at = pattern.pieces.find(mirrored.b.front().piece);
      if (at == pattern.pieces.end() || alike.b.front().piece != at->first) continue;
      const bool told =
          std::any_of(pleats.begin(), pleats.end(), [&, &edge = mirrored.b.front().edge](const PaperPleat& pleat) {
            return pleat.piece == at->first && pleat.edge == edge;
          });
      if (told) continue;  // where pleats overlap it lies under several parts of the edge
      const Piece& piece = *at->second;
      const auto m = piece.outline.find(mirrored.b.front().edge), l = piece.outline.find(alike.b.front().edge);
      const std::size_t n = piece.outline.edges.size();
      if (!m || !l || ((*m + 1) % n != *l && (*l + 1) % n != *m)) continue;
      const Curve &first = piece.outline.edges[*m].curve, &second = piece.outline.edges[*l].curve;
      const bool before = (*m + 1) % n == *l;
      PaperPleat pleat{piece.id,
                       piece.outline.edges[*m].name,
                       before ? first.start : first.end,
                       before ? first.end : first.start,
                       before ? second.end : second.start,
                       {}};
      pleat.along = leftOf(normalized(before ? pleat.place - pleat.fold : pleat.fold - pleat.place));
      for (const InternalLine& line : piece.lines) {  // where it is drawn, the fold says which way it runs
        if (line.curves.empty()) continue;
        const Curve &out = line.curves.front(), &in = line.curves.back();
        if (distance(out.start, pleat.fold) < kSameFold) pleat.along = normalized(out.tangent(0));
        if (distance(in.end, pleat.fold) < kSameFold) pleat.along = -normalized(in.tangent(1));
      }
      pleats.push_back(std::move(pleat));
    }
  }
  return pleats;
}

std::set<std::string> linesOfLattice(const Pattern& pattern, const Piece& piece) {
  std::set<std::string> names;
  const auto lineNamed = [&](const std::string& name) -> const Curve* {
    return findEdge(piece, name) ? nullptr : findCurve(piece, name);
  };
  for (const auto& [id, seam] : pattern.seams)
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side)
        if (span.piece == piece.id && lineNamed(span.edge)) names.insert(span.edge);
  for (const InternalLine& line : piece.lines)
    if (line.crease && std::abs(line.crease->angle) >= Crease::kSharpest && lineNamed(line.name))
      names.insert(line.name);
  for (const PaperPleat& pleat : pleatsOf(pattern))
    for (const InternalLine& line : piece.lines) {
      const Curve* curve = pleat.piece == piece.id ? lineNamed(line.name) : nullptr;
      const auto at = [&](Flat end) {
        return distance(end, pleat.fold) < kSameFold || distance(end, pleat.inner) < kSameFold;
      };
      if (curve && (at(curve->start) || at(curve->end))) names.insert(line.name);
    }
  return names;
}

Result<PleatedPiece> addPleats(const Piece& piece, const PleatPlan& plan) { return Spreading(piece, plan).spread(); }

}  // namespace karinui

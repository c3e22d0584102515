#include "wedge_pleat.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "divide_edges.h"
#include "folded_paper.h"
#include "outline_passages.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kAtEdge = 5e-3;        // metres from the outline at which a line still ends there
constexpr double kHalfway = 1e-3;       // metres by which the inner fold may be off
constexpr double kClosedWithin = 2e-3;  // metres by which an edge may be off where it is closed
constexpr double kSameShare = 1e-6;     // of an edge
constexpr double kWidest = 1.2;         // radians from the fold to where it comes to lie

Flat directionOf(const PleatLine& line) { return normalized(line.far - line.near); }
FoldAxis axisOf(const PleatLine& line) { return {line.near, directionOf(line)}; }

class Wedge {
 public:
  Wedge(const Piece& piece, const DrawnPleat& drawn, const std::array<PleatLine, 3>& lines)
      : piece_(piece), drawn_(drawn), fold_(lines[0]), inner_(lines[1]), place_(lines[2]) {}

  Result<PleatedPiece> folded() {
    made_.edited.piece = piece_;
    made_.drawn = true;
    if (Done done = findPassages(); !done) return done.error();
    if (Done done = findFolds(); !done) return done.error();
    if (Done done = clearTheWay(); !done) return done.error();
    if (Done done = cutOutline(); !done) return done.error();
    drawLines();
    if (Done done = staysInside(); !done) return done.error();
    followMarks(made_.edited.piece, made_.edited.edges);
    return std::move(made_);
  }

 private:
  const Outline& outline() const { return piece_.outline; }
  // Which of the two lines an outline meets first, walked along the pleated edge.
  const PleatLine& low() const { return toStart_ ? place_ : fold_; }
  const PleatLine& high() const { return toStart_ ? fold_ : place_; }

  std::optional<Passage> passageOf(const PleatLine& line, Flat near) const {
    const Flat normal = -leftOf(directionOf(line));
    return passageNear(outline(), normal, dot(line.near, normal), near);
  }

  Done findPassages() {
    const auto missing = [&] {
      return refused(say("The lines of a pleat run across “{0}”, from one edge to another.", piece_.name));
    };
    const FoldAxis axis = axisOf(fold_);
    const double nearer = axis.beside(place_.near), farther = axis.beside(place_.far);
    toStart_ = nearer + farther < 0;
    if (std::fmin(nearer, farther) < -kLeastEdge && std::fmax(nearer, farther) > kLeastEdge)
      return refused(say("The lines “{0}” and “{1}” of the pleat cross each other.", drawn_.fold, drawn_.place));
    if (distance(fold_.near, place_.near) / 2 < kLeastEdge)
      return refused(
          say("The pleat has no depth where it begins; name the edge it is sewn into: edge={0}.EDGE.", piece_.name));
    runsOut_ = distance(fold_.far, place_.far) / 2 < kLeastEdge;
    const auto foldFar = runsOut_ ? passageOf(inner_, inner_.far) : passageOf(fold_, fold_.far);
    if (!foldFar) return missing();
    if (distance(foldFar->place, fold_.far) > kAtEdge && runsOut_)
      return refused(say(
          "The lines of the pleat meet inside “{0}”, where a fold cannot end; take a dart, or let them run to an edge.",
          piece_.name));
    if (runsOut_) fold_.far = place_.far = foldFar->place;  // all three meet there
    const auto foldNear = passageOf(fold_, fold_.near), placeNear = passageOf(place_, place_.near);
    const auto placeFar = runsOut_ ? foldFar : passageOf(place_, place_.far);
    if (!foldNear || !placeNear || !placeFar || foldNear->edge == foldFar->edge || placeNear->edge == placeFar->edge)
      return missing();
    fold_ = {foldNear->place, foldFar->place}, place_ = {placeNear->place, placeFar->place};
    near_ = {*foldNear, *placeNear}, far_ = {*foldFar, *placeFar};
    return {};
  }

  // The inner fold halves the angle of the other two.
  Done findFolds() {
    const Flat f = directionOf(fold_), p = directionOf(place_);
    const double fromFold = std::abs(cross(f, place_.near - fold_.near)),
                 fromPlace = std::abs(cross(p, fold_.near - place_.near));
    if (dot(f, p) < std::cos(kWidest))
      return refused(say("The fold and the line where it comes to lie are at an angle of {0} degrees at most.",
                         static_cast<int>(std::lround(kWidest * 180 / std::numbers::pi))));
    PleatWedge& wedge = made_.wedge.emplace();
    wedge.fold = axisOf(fold_), wedge.place = axisOf(place_), wedge.toStart = toStart_;
    wedge.inner = {lerp(fold_.near, place_.near, fromPlace / (fromFold + fromPlace)), normalized(f + p)};
    const FoldAxis& inner = wedge.inner;
    const double off = std::fmax(std::abs(inner.beside(inner_.near)), std::abs(inner.beside(inner_.far)));
    if (off > kHalfway)
      return refused(
          say("The inner fold lies halfway between the fold and the line where it comes to lie; here it is {0} mm "
              "off.",
              inMm(off)));
    made_.across = -leftOf(inner.along);
    made_.depth = distance(fold_.near, place_.near) / 2;
    if (made_.depth > 0.5) return refused(say("A pleat is between 1 mm and 50 cm deep."));
    for (const bool near : {true, false}) {
      const double step = distance(inner.mirrored(near ? fold_.near : fold_.far), near ? place_.near : place_.far);
      if (step > kClosedWithin)
        return refused(
            say("Folded, edge {0} has a step of {1} mm: the fold and the line where it comes to lie end there "
                "at unlike heights.",
                outline().edges[(near ? near_ : far_).fold.edge].name, inMm(step)));
    }
    made_.beyondOf = outline().edges[far_.fold.edge].name;
    return {};
  }

  // Whether something reaches into the wedge, or lies on both sides of it.
  bool within(const std::vector<Flat>& line) const {
    double most = -HUGE_VAL, least = HUGE_VAL;
    for (const Flat p : line) {
      most = std::max(most, axisOf(low()).beside(p));
      least = std::min(least, axisOf(high()).beside(p));
    }
    return most > kHalfway && least < -kHalfway;
  }

  Done clearTheWay() {
    for (const Outline& hole : piece_.holes)
      if (within(hole.flattened(1e-4))) return refused(say("The pleats would run through a hole of {0}.", piece_.name));
    for (const InternalLine& line : piece_.lines)
      for (const Curve& curve : line.curves)
        if (within(curve.flattened(1e-4)))
          return refused(say("The pleats would run through the line “{0}” of {1}; pleat first, and draw it then.",
                             line.name, piece_.name));
    std::erase_if(made_.edited.piece.marks,
                  [&](const Mark& mark) { return mark.edge.empty() && within({mark.place}); });
    return {};
  }

  // What the cloth that is folded in lies under, at one end of the pleat: of the flat edge beside the fold.
  struct Over {
    Curve curve;
    std::size_t edge = 0;
    double from = 0, to = 1;  // the curve's parameters
  };
  Result<Over> overAt(const Passage& fold, bool near) const {
    const FoldAxis& axis = made_.wedge->fold;
    const FoldAxis& inner = made_.wedge->inner;
    const Flat along = axis.mirroredWay(inner.along), normal = -leftOf(along), through = axis.mirrored(inner.at);
    const Flat wanted = axis.mirrored(near ? inner_.near : inner_.far);
    const auto end = passageNear(outline(), normal, dot(through, normal), wanted);
    // Walked along the outline it comes before the fold, or after it.
    const bool before = near != toStart_;
    const auto& edges = outline().edges;
    std::size_t k = fold.edge;
    double at = fold.t;
    if (before && at <= kSameShare) k = (k + edges.size() - 1) % edges.size(), at = 1;
    if (!before && at >= 1 - kSameShare) k = (k + 1) % edges.size(), at = 0;
    if (!end || end->edge != k || (before ? end->t >= at : end->t <= at)) {
      const Curve& curve = edges[k].curve;
      const double room = before ? curve.lengthTo(at) : curve.length() - curve.lengthTo(at);
      return refused(say(
          "A pleat {0} mm deep does not fit there on edge {1}, which has {2} mm beside its fold. Put it farther in, "
          "or join the edge to the next one first.",
          inMm(near ? made_.depth : distance(fold_.far, place_.far) / 2), edges[k].name, inMm(room)));
    }
    const double from = before ? end->t : at, to = before ? at : end->t;
    return Over{edges[k].curve.part(from, to), k, from, to};
  }

  struct Strip {
    Curve curve;
    bool mirrored = false;  // it runs the other way than what it lies under
  };
  // What is folded in, in the order of the outline: the strip beside the fold is the mirror image of what lies over it,
  // the other is turned from there to beside the place.
  std::array<Strip, 2> stripsOf(const Curve& over, bool near) const {
    const PleatWedge& wedge = *made_.wedge;
    const Curve image = over.mirrored(wedge.fold.at, wedge.fold.along);
    const Strip beside{image.reversed(), true}, beyond{image.mirrored(wedge.inner.at, wedge.inner.along), false};
    if (toStart_ != near) return {beside, beyond};
    return {beyond, beside};
  }

  Done cutOutline() {
    const Passage &nearLow = toStart_ ? near_.place : near_.fold, &nearHigh = toStart_ ? near_.fold : near_.place;
    const Passage &farLow = toStart_ ? far_.place : far_.fold, &farHigh = toStart_ ? far_.fold : far_.place;
    const auto& edges = outline().edges;
    // Where the lines meet at the other edge that is left whole.
    auto stays = stretchesBetween(outline(), nearHigh, runsOut_ ? nearLow : farHigh);
    const std::size_t highSide = stays.size();
    if (!runsOut_) {
      const auto lowSide = stretchesBetween(outline(), farLow, nearLow);
      stays.insert(stays.end(), lowSide.begin(), lowSide.end());
    }
    if (highSide == 0 || (!runsOut_ && stays.size() == highSide))
      return refused(say("The lines of a pleat run across “{0}”, from one edge to another.", piece_.name));

    // The first part of an edge, as it ran, keeps its name.
    auto taken = edgeNames(piece_);
    std::vector<std::string> names(stays.size());
    std::vector<std::size_t> inOrder(stays.size());
    for (std::size_t k = 0; k < inOrder.size(); ++k) inOrder[k] = k;
    std::sort(inOrder.begin(), inOrder.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(stays[a].edge, stays[a].t0) < std::pair(stays[b].edge, stays[b].t0);
    });
    for (const Edge& edge : edges) made_.edited.edges[{piece_.id, edge.name}] = {};
    for (const std::size_t k : inOrder) {
      const auto& [edge, t0, t1] = stays[k];
      const Curve& curve = edges[edge].curve;
      auto& map = made_.edited.edges[{piece_.id, edges[edge].name}];
      names[k] = map.empty() ? edges[edge].name : freeName(edges[edge].name, taken);
      map.push_back(
          {curve.lengthTo(t0) / curve.length(), curve.lengthTo(t1) / curve.length(), {piece_.id, names[k], 0, 1}});
    }

    std::vector<Edge> now;
    const auto addStays = [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) {
        const auto& [edge, t0, t1] = stays[k];
        const Curve& curve = edges[edge].curve;
        now.push_back({names[k], t0 <= 0 && t1 >= 1 ? curve : curve.part(t0, t1)});
      }
    };
    const auto addStrips = [&](bool near) -> Done {
      const auto over = overAt((near ? near_ : far_).fold, near);
      if (!over) return over.error();
      const bool sewn = near || drawn_.sewnBeyond;
      (near ? nearCorners_ : farCorners_) = now.size();
      for (const Strip& strip : stripsOf(over->curve, near)) {
        const std::string name = freeName(sewn ? drawn_.name : edges[over->edge].name, taken);
        now.push_back({name, strip.curve});
        if (sewn)
          addLayer(*over, stays, names, name, strip.mirrored);
        else
          made_.beyond.push_back(name);
      }
      return {};
    };
    addStays(0, highSide);
    if (!runsOut_)
      if (Done done = addStrips(false); !done) return done;
    addStays(highSide, stays.size());
    if (Done done = addStrips(true); !done) return done;
    for (std::size_t k = 0; k < now.size(); ++k) now[(k + 1) % now.size()].curve.start = now[k].curve.end;
    corners_.clear();
    for (const Edge& edge : now) corners_.push_back(edge.curve.start);
    Outline cut;
    cut.edges = std::move(now);
    auto good = checked(std::move(cut));
    if (!good) return good.error();
    made_.edited.piece.outline = *std::move(good);
    return {};
  }

  void addLayer(const Over& over, const std::vector<EdgeStretch>& stays, const std::vector<std::string>& names,
                const std::string& strip, bool mirrored) {
    const Curve& curve = outline().edges[over.edge].curve;
    for (std::size_t k = 0; k < stays.size(); ++k) {
      const auto& [edge, t0, t1] = stays[k];
      if (edge != over.edge || over.from < t0 - kSameShare || over.to > t1 + kSameShare) continue;
      const double begins = curve.lengthTo(t0), ends = curve.lengthTo(t1);
      const auto share = [&](double t) {
        const double s = (curve.lengthTo(t) - begins) / (ends - begins);
        return s < kSameShare ? 0.0 : s > 1 - kSameShare ? 1.0 : s;
      };
      made_.layers.push_back(
          {{piece_.id, names[k], share(over.from), share(over.to)}, {piece_.id, strip, 0, 1}, mirrored});
      return;
    }
  }

  void drawLines() {
    Piece& now = made_.edited.piece;
    std::set<std::string> taken;
    for (const InternalLine& line : now.lines) taken.insert(line.name);
    const auto corner = [&](std::size_t k) { return corners_[k % corners_.size()]; };
    const auto nearEnd = [&](std::size_t k) { return corner(nearCorners_ + k); };
    const auto farEnd = [&](std::size_t k) { return runsOut_ ? fold_.far : corner(farCorners_ + 2 - k); };
    PleatFold fold;
    fold.toStart = toStart_;
    const auto line = [&](std::string_view what, std::size_t k) {
      InternalLine drawn;
      drawn.name = freeName(drawn_.name + "_" + std::string(what), taken);
      drawn.curves = {Curve::line(nearEnd(k), farEnd(k))};
      now.lines.push_back(std::move(drawn));
      return now.lines.back().name;
    };
    if (toStart_)
      fold.place = line("place", 0), fold.inner = line("inner", 1), fold.fold = line("fold", 2);
    else
      fold.fold = line("fold", 0), fold.inner = line("inner", 1), fold.place = line("place", 2);
    made_.folds = {fold};
    made_.linesAdded = 3;
  }

  // Between its ends no line leaves the cloth.
  Done staysInside() const {
    constexpr int kLooks = 64;
    const Piece& now = made_.edited.piece;
    const auto ring = now.outline.flattened(1e-4);
    for (std::size_t k = now.lines.size() - 3; k < now.lines.size(); ++k) {
      const Curve& line = now.lines[k].curves.front();
      for (int i = 1; i < kLooks; ++i)
        if (const Flat p = line.at(i / double{kLooks}); !contains(ring, p) && distanceToRing(ring, p) > kHalfway)
          return refused(
              say("The line “{0}” leaves the piece between its ends, at {1} mm.", now.lines[k].name, inMm(p)));
    }
    return {};
  }

  struct Ends {
    Passage fold, place;
  };
  const Piece& piece_;
  const DrawnPleat& drawn_;
  PleatLine fold_, inner_, place_;
  PleatedPiece made_;
  Ends near_, far_;
  bool toStart_ = false, runsOut_ = false;  // its lines meet where they end
  std::vector<Flat> corners_;               // of the new outline
  std::size_t nearCorners_ = 0, farCorners_ = 0;
};

}  // namespace

// The layers rise as those of parallel folds do.
FoldedPlace PleatWedge::folded(Flat at) const {
  constexpr double kWhole =
      0.02;  // metres deep: where a pleat is less deep, as where it runs out, its layers are nearer
  FoldedPlace in = closed(at);
  const Flat beside = fold.at + fold.along * dot(at - fold.at, fold.along);
  in.lifted *= std::min(1.0, std::abs(inner.beside(beside)) / kWhole);
  in.place = back(in.place);
  if (back.radians != 0) in.clear = back(in.clear) - back(Flat{});
  return in;
}

FoldedPlace PleatWedge::closed(Flat at) const {
  const double low = toStart ? place.beside(at) : fold.beside(at), middle = inner.beside(at),
               high = toStart ? fold.beside(at) : place.beside(at);
  const auto turned = [&](Flat p) {
    return toStart ? inner.mirrored(fold.mirrored(p)) : fold.mirrored(inner.mirrored(p));
  };
  const auto once = [&](Flat p) { return toStart ? inner.mirrored(p) : fold.mirrored(p); };
  // What lies over the pleat comes down past the fold inside it.
  const auto over = [&](Flat p) {
    const double beyond = (toStart ? -1 : 1) * inner.beside(fold.mirrored(p));
    return 2 - 2 * std::clamp((beyond - FoldedPaper::kPasses) / FoldedPaper::kPasses, 0.0, 1.0);
  };
  const double onFold = toStart ? high : low, onPlace = toStart ? low : high;
  if (std::abs(onFold) < FoldedPaper::kOnFold) {
    const Flat apart = -leftOf(fold.along) * (toStart ? -FoldedPaper::kShort : FoldedPaper::kShort);
    return {toStart ? once(at) : at, 1.5, toStart ? inner.mirroredWay(apart) : -apart};
  }
  if (std::abs(middle) < FoldedPaper::kOnFold) {
    const Flat apart = -leftOf(inner.along) * -FoldedPaper::kShort;
    return {toStart ? at : once(at), 0.5, toStart ? apart : fold.mirroredWay(apart)};
  }
  if (std::abs(onPlace) < FoldedPaper::kOnFold) return {toStart ? at : turned(at), 0};
  if (low < 0) return {at, toStart ? 0 : over(at)};
  if (high > 0) return {turned(at), toStart ? over(at) : 0};
  if ((middle < 0) == toStart) return {toStart ? at : turned(at), 0};
  return {once(at), 1};
}

std::function<Flat(Flat)> PleatWedge::reopened(const Outline& paper) const {
  const Flat apex = fold.at + fold.along * (cross(inner.at - fold.at, inner.along) / cross(fold.along, inner.along));
  // From there into the piece, and to the right along its edge.
  const Flat in = inner.along * (dot(fold.at - apex, inner.along) < 0 ? -1 : 1), right = -leftOf(inner.along);
  const auto angle = [=](Flat p) { return std::atan2(dot(p - apex, right), dot(p - apex, in)); };
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Flat p : paper.flattened(1e-3))
    if (distance(p, apex) > kHalfway) low = std::min(low, angle(p)), high = std::max(high, angle(p));
  const double whole = high - low, left = whole - std::acos(std::min(1.0, dot(fold.along, place.along)));
  if (!(left > 0.1 * whole)) return [](Flat p) { return p; };
  return [=](Flat p) {
    const double now = low + (angle(p) - low) * whole / left, away = distance(p, apex);
    return apex + in * (away * std::cos(now)) + right * (away * std::sin(now));
  };
}

Result<PleatedPiece> foldWedge(const Piece& bare, const DrawnPleat& drawn, const std::array<PleatLine, 3>& lines) {
  return Wedge(bare, drawn, lines).folded();
}

Result<PleatedPiece> addPleatTo(const Piece& piece, const Slash& slash, bool toStart, const std::string& name) {
  Slash opening = slash;
  opening.toBy = 0, opening.smooth = opening.folded = true, opening.shared = false;
  auto opened = spreadPiece(piece, opening);
  if (!opened) return opened.error();
  const Curve &from = findEdge(piece, slash.from)->curve, &to = findEdge(piece, slash.to)->curve;
  const Flat a = from.atFraction(slash.at), hinge = to.atFraction(slash.toAt), b = opened->place(hinge);
  // The banks of the slash: what lies behind it and ahead of it, along the outline.
  const bool aheadStays = opened->stays == Slash::Stays::Ahead;
  const double angle = 2 * std::asin(slash.by / (2 * distance(a, hinge)));
  const auto turnedBy = [&](double radians) { return PaperMove{hinge, b, radians}(a); };
  const PleatLine behind{turnedBy(aheadStays ? -angle : 0), b}, ahead{turnedBy(aheadStays ? 0 : angle), b};
  const PleatLine middle{lerp(behind.near, ahead.near, 0.5), b};
  const std::array<PleatLine, 3> lines{toStart ? ahead : behind, middle, toStart ? behind : ahead};
  DrawnPleat drawn;
  drawn.along = directionOf(middle), drawn.name = name;
  auto made = foldWedge(opened->edited.piece, drawn, lines);
  if (!made) return made;
  made->drawn = false;
  made->edited.edges = composed(opened->edited.edges, made->edited.edges);
  made->wedge->opened = std::move(opened->place);
  if (aheadStays) made->wedge->back = {b, hinge, angle};
  return made;
}

}  // namespace karinui

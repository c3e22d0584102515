// The shapes of clothes, fitted to an outline by its corners. A kind of piece is a row: its corners in the outline's
// order, each with where it may lie, and a score of 0 to 1 of a whole fit. One search serves all kinds. Sharp corners
// that a fit leaves unexplained speak against it.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "piece_shape.h"

namespace karinui {

namespace {

constexpr double kFork = 1.0;       // radians a trouser leg turns at least at its fork
constexpr double kSquare = 0.9;     // radians, as the ends of a stand's neck edge turn at least
constexpr double kLeftOver = 0.35;  // a right angle that the fit does not explain costs this much

double share(double x, double low, double high) { return std::clamp((x - low) / (high - low), 0.0, 1.0); }

// The corners that a kind has taken so far, by their numbers in its row. u and v are of 0 to 1 in the shape's box.
class Taken {
 public:
  explicit Taken(const Shape& shape) : s_(shape), w(shape.high.u - shape.low.u), h(shape.high.v - shape.low.v) {
    for (const auto& corner : s_.corners) turns_ += std::abs(corner.turn);
  }
  std::vector<std::size_t> corners;

  Flat at(std::size_t k) const { return s_.place(corners[k]); }
  double u(std::size_t k) const { return (at(k).u - s_.low.u) / w; }
  double v(std::size_t k) const { return (at(k).v - s_.low.v) / h; }
  double turn(std::size_t k) const { return s_.corners[corners[k]].turn; }
  double length(std::size_t from, std::size_t to) const { return s_.length(corners[from], corners[to]); }
  double bow(std::size_t from, std::size_t to) const { return s_.bow(corners[from], corners[to]); }
  double bent(std::size_t from, std::size_t to) const { return std::abs(bow(from, to)); }
  double rise(std::size_t from, std::size_t to) const { return at(to).v - at(from).v; }  // metres
  double uneven(std::size_t a, std::size_t b) const { return std::abs(rise(a, b)); }
  double top() const { return s_.high.v; }
  // How far the way from one corner to another leans from the upright.
  double slant(std::size_t from, std::size_t to) const {
    const Flat way = at(to) - at(from);
    return std::max(0.0, std::abs(way.u) / (std::abs(way.v) + 1e-9) - 0.2);
  }
  double leftOver() const {
    double left = turns_;
    for (const std::size_t k : corners) left -= std::abs(s_.corners[k].turn);
    return kLeftOver * std::max(0.0, left) / (std::numbers::pi / 2);
  }

 private:
  const Shape& s_;

 public:
  const double w, h;  // metres

 private:
  double turns_ = 0;
};

struct Corner {
  PiecePart part;                // that begins there
  bool (*lies)(const Taken& t);  // the last taken corner is this one
};
struct Kind {
  PieceRole role;
  bool half;  // of a piece that is alike on both sides: its mirror image is tried too
  std::vector<Corner> corners;
  double (*score)(const Taken& t);
  double leftOver = 1;  // how much corners that are left over count
};

// Side, armhole and shoulder of a trunk, walked up at plus or down at minus: corners b, c, d, e from the hem to the
// neck. `axis`: where the centre lies, a share of the width.
struct Flank {
  const Taken& t;
  std::size_t b, c, d, e;
  double axis;

  bool minus() const { return e < b; }
  double out(std::size_t k) const { return minus() ? 1 - t.u(k) : t.u(k); }
  double bow(std::size_t from, std::size_t to) const { return minus() ? t.bow(to, from) : t.bow(from, to); }
  double length(std::size_t from, std::size_t to) const { return minus() ? t.length(to, from) : t.length(from, to); }

  bool armpit() const { return out(c) >= axis + 0.6 * (1 - axis) && t.v(c) <= 0.92; }
  bool tip() const { return out(d) >= axis + 0.05; }
  bool neckEnd() const { return out(e) >= axis - 0.02 && t.v(e) >= 0.75; }
  bool side() const { return t.rise(b, c) >= 0.05; }
  bool armhole() const { return t.rise(c, d) >= 0.06 && bow(c, d) <= -0.01; }
  bool shoulder() const { return inwards() >= 0.008 && length(d, e) <= 0.28 && t.rise(d, e) >= -0.02; }
  double score() const {
    const double steep = share(t.uneven(d, e) / inwards(), 0.5, 1.5);
    return 1 - t.slant(b, c) - 0.5 * std::abs(bow(b, c)) - 0.4 * steep - std::abs(bow(d, e)) -
           0.2 * (1 - share(-bow(c, d), 0.01, 0.06));
  }
  bool good() const { return score() > 0.2; }

 private:
  double inwards() const { return (t.at(d).u - t.at(e).u) * (minus() ? -1 : 1); }
};
Flank half(const Taken& t) { return {t, 0, 1, 2, 3, 0}; }
Flank plus(const Taken& t) { return {t, 0, 1, 2, 3, 0.5}; }
Flank minus(const Taken& t) { return {t, 7, 6, 5, 4, 0.5}; }

using T = const Taken&;
using enum PiecePart;

const Kind kKinds[] = {
    // Both halves of a front or back: up one side, over the neck, down the other.
    {PieceRole::Front,
     false,
     {{SidePlus, [](T t) { return t.u(0) >= 0.6 && t.v(0) <= 0.4; }},
      {ArmholePlus, [](T t) { return plus(t).armpit() && plus(t).side(); }},
      {ShoulderPlus, [](T t) { return plus(t).tip() && plus(t).armhole(); }},
      {Neck, [](T t) { return t.u(3) > 0.5 && plus(t).neckEnd() && plus(t).shoulder() && plus(t).good(); }},
      {ShoulderMinus, [](T t) { return t.u(4) < 0.5 && minus(t).neckEnd(); }},
      {ArmholeMinus, [](T t) { return minus(t).tip() && minus(t).shoulder(); }},
      {SideMinus, [](T t) { return minus(t).armpit() && minus(t).armhole(); }},
      {Hem, [](T t) { return t.u(7) <= 0.4 && t.v(7) <= 0.4 && minus(t).side() && minus(t).good(); }}},
     [](T t) {
       const double uneven = t.uneven(0, 7) + t.uneven(1, 6) + t.uneven(2, 5) + t.uneven(3, 4);
       // The neck is hollow between the two shoulders.
       return 0.5 * (plus(t).score() + minus(t).score()) - 2 * uneven / t.h - share(t.bow(3, 4), -0.02, 0.15);
     }},
    // The lower part of a back that a yoke is sewn to, or of a strapless top: armholes without shoulders.
    {PieceRole::Back,
     false,
     {{SidePlus, [](T t) { return t.u(0) >= 0.6 && t.v(0) <= 0.4; }},
      {ArmholePlus, [](T t) { return t.u(1) >= 0.7 && t.v(1) >= t.v(0) + 0.2; }},
      {Top, [](T t) { return t.u(2) >= 0.55 && t.rise(1, 2) >= 0.04 && t.v(2) >= 0.8 && t.bow(1, 2) <= -0.01; }},
      {ArmholeMinus, [](T t) { return t.u(3) <= 0.45 && t.v(3) >= 0.8 && t.uneven(2, 3) <= 0.05 * t.h; }},
      {SideMinus, [](T t) { return t.u(4) <= 0.3 && t.bow(3, 4) <= -0.01 && t.uneven(1, 4) <= 0.05 * t.h; }},
      {Hem, [](T t) { return t.u(5) <= 0.4 && t.uneven(0, 5) <= 0.05 * t.h; }}},
     [](T t) {
       return 0.9 - t.bent(2, 3) - t.slant(0, 1) - t.slant(4, 5) -
              std::abs(t.length(1, 2) - t.length(3, 4)) / t.length(1, 2);
     }},
    // A yoke: below it the back, on either side armhole and shoulder, the neck on top.
    {PieceRole::Yoke,
     false,
     {{Hem, [](T t) { return t.w > 0.2 && t.h < 0.25 && t.h < 0.6 * t.w && t.u(0) <= 0.2 && t.v(0) <= 0.35; }},
      {ArmholePlus, [](T t) { return t.u(1) >= 0.8 && t.v(1) <= 0.35; }},
      {ShoulderPlus, [](T t) { return t.u(2) >= 0.75 && t.rise(1, 2) >= 0.02; }},
      {Neck, [](T t) { return t.u(3) <= t.u(2) - 0.1 && t.u(3) >= 0.5; }},
      {ShoulderMinus, [](T t) { return t.u(4) <= 0.5 && t.bow(3, 4) <= -0.03 && t.uneven(3, 4) <= 0.1 * t.h; }},
      {ArmholeMinus, [](T t) { return t.u(5) <= 0.25 && t.uneven(2, 5) <= 0.1 * t.h; }}},
     [](T t) {
       return 0.95 - 0.5 * t.bent(0, 1) - 0.5 * t.bent(2, 3) -
              std::abs(t.length(1, 2) - t.length(5, 0)) / t.length(1, 2);
     }},
    // A sleeve: hem, two sides of one length, a cap that bulges upwards and bends back at its foot.
    {PieceRole::Sleeve,
     false,
     {{Hem, [](T t) { return t.u(0) <= 0.45 && t.v(0) <= 0.5; }},
      {SidePlus, [](T t) { return t.u(1) >= 0.55 && t.v(1) <= 0.5; }},
      {Top, [](T t) { return t.u(2) >= 0.5 && t.rise(1, 2) >= 0.015; }},
      {SideMinus,
       [](T t) {
         const double under = t.length(1, 2), other = t.length(3, 0), bow = t.bow(2, 3);
         const double chord = distance(t.at(2), t.at(3));
         return t.u(3) < 0.5 && t.rise(0, 3) >= 0.015 && chord >= 0.75 * t.w && t.length(2, 3) <= 2.5 * chord &&
                std::abs(under - other) <= 0.06 * std::max(under, other) + 0.004 && bow >= 0.07 && bow <= 0.9 &&
                t.top() - 0.5 * (t.at(2).v + t.at(3).v) >= 0.04;
       }}},
     [](T t) {
       const double chord = distance(t.at(2), t.at(3)), rise = t.top() - 0.5 * (t.at(2).v + t.at(3).v);
       return 1 - t.bent(0, 1) - 0.5 * t.bent(1, 2) - 0.5 * t.bent(3, 0) -
              2 * (t.uneven(2, 3) + t.uneven(0, 1)) / t.w -
              share(distance(t.at(0), t.at(1)), chord, 1.4 * chord) - 0.3 * (1 - share(rise / chord, 0.08, 0.2));
     }},
    // Front and back of a leg in one: two crotches, two inseams of one length.
    {PieceRole::Leg,
     false,
     {{Hem, [](T t) { return t.h >= 0.2 && t.u(0) <= 0.45 && t.v(0) <= 0.5; }},
      {SidePlus, [](T t) { return t.u(1) >= 0.55 && t.v(1) <= 0.5; }},
      {CrotchPlus, [](T t) { return t.u(2) >= 0.85 && t.turn(2) >= kFork && t.length(1, 2) >= 0.02; }},
      {Top, [](T t) { return t.u(3) >= 0.5 && t.v(3) >= 0.6 && t.at(3).u <= t.at(2).u - 0.015 && t.bow(2, 3) <= -0.01; }},
      {CrotchMinus, [](T t) { return t.u(4) < 0.5 && t.v(4) >= 0.6; }},
      {SideMinus,
       [](T t) {
         const double in = t.length(1, 2), other = t.length(5, 0);
         return t.u(5) <= 0.15 && t.at(4).u >= t.at(5).u + 0.015 && t.bow(4, 5) <= -0.01 && t.turn(5) >= kFork &&
                std::abs(in - other) <= 0.05 * std::max(in, other) + 0.004;
       }}},
     [](T t) {
       return 1 - 0.5 * t.bent(3, 4) - 0.5 * t.bent(0, 1) - 2 * t.uneven(0, 1) / t.h -
              share(t.uneven(2, 5), 0.03 * t.h, 0.2 * t.h);
     }},
    // Hem, side, top, side: a part of a skirt.
    {PieceRole::SkirtFront,
     false,
     {{Hem, [](T t) { return t.h >= 0.25 && t.u(0) <= 0.45 && t.v(0) <= 0.25; }},
      {SidePlus, [](T t) { return t.u(1) >= 0.55 && t.v(1) <= 0.25; }},
      {Top, [](T t) { return t.u(2) >= 0.5 && t.v(2) >= 0.75; }},
      {SideMinus,
       [](T t) {
         const double side = t.length(1, 2), other = t.length(3, 0);
         return t.u(3) < 0.5 && t.v(3) >= 0.75 && std::abs(side - other) <= 0.2 * std::max(side, other);
       }}},
     [](T t) {
       const double side = t.length(1, 2), other = t.length(3, 0), hem = t.length(0, 1);
       return 0.85 - 0.4 * (t.bent(1, 2) + t.bent(3, 0)) - share(t.length(2, 3), 1.05 * hem, 1.6 * hem) -
              0.5 * std::abs(side - other) / std::max(side, other);
     }},
    // Long and low, straight or curved: two long edges between two ends.
    {PieceRole::Waistband,
     false,
     {{Hem, [](T) { return true; }},
      {SidePlus, [](T t) { return t.at(1).u - t.at(0).u >= 0.5 * t.w; }},
      {Top, [](T t) { return t.length(1, 2) <= 0.16; }},
      {SideMinus,
       [](T t) {
         const double deep = std::max(t.length(1, 2), t.length(3, 0));
         return t.at(2).u - t.at(3).u >= 0.5 * t.w && deep <= 0.16 &&
                std::min(t.length(0, 1), t.length(2, 3)) >= 1.8 * deep;
       }}},
     [](T t) {
       const double end = t.length(1, 2), other = t.length(3, 0), low = t.length(0, 1), top = t.length(2, 3);
       return 0.9 - 0.5 * std::abs(end - other) / std::max(end, other) - 0.3 * std::abs(low - top) / std::max(low, top);
     },
     0.7},
    // A collar stand or collar whose ends are rounded into its upper edge: only the edge to the neck has two corners.
    {PieceRole::CollarStand,
     false,
     {{Hem, [](T t) { return t.w > 0.25 && t.h < 0.13 && t.u(0) <= 0.1; }},
      {Top,
       [](T t) { return t.u(1) >= 0.9 && t.length(0, 1) >= 0.9 * t.w && t.turn(0) >= kSquare && t.turn(1) >= kSquare; }}},
     [](T t) {
       return 0.85 - 0.5 * t.bent(0, 1) - 0.5 * share(std::abs(t.turn(0) - t.turn(1)), 0.2, 1);
     },
     0.4},
    // Half of a front or back, its centre at minus.
    {PieceRole::Front,
     true,
     {{SidePlus, [](T t) { return t.u(0) >= 0.5 && t.v(0) <= 0.4; }},
      {ArmholePlus, [](T t) { return half(t).armpit() && half(t).side(); }},
      {ShoulderPlus, [](T t) { return half(t).tip() && half(t).armhole(); }},
      {Neck, [](T t) { return half(t).neckEnd() && half(t).shoulder() && half(t).good(); }},
      {Centre, [](T t) { return t.u(4) <= 0.35 && t.rise(3, 4) <= 0.005 && t.v(4) >= 0.3; }},
      {Hem, [](T t) { return t.u(5) <= 0.35 && t.v(5) <= 0.3; }}},
     [](T t) {
       return half(t).score() - 0.8 * t.bent(4, 5) - t.slant(4, 5) - 0.5 * std::max(0.0, t.bow(3, 4)) - 0.5 * t.u(5);
     }},
    // Half of a pair of trousers' front or back, its crotch at minus.
    {PieceRole::LegFront,
     true,
     {{Hem, [](T t) { return t.h >= 0.2 && t.u(0) <= 0.45 && t.v(0) <= 0.5; }},
      {SidePlus, [](T t) { return t.u(1) >= 0.55 && t.v(1) <= 0.5; }},
      {Top, [](T t) { return t.u(2) >= 0.5 && t.v(2) >= 0.7; }},
      {CrotchMinus, [](T t) { return t.u(3) < 0.5 && t.v(3) >= 0.7; }},
      {SideMinus,
       [](T t) {
         return t.u(4) <= 0.12 && t.at(3).u >= t.at(4).u + 0.025 && t.rise(4, 3) >= 0.08 && t.rise(0, 4) >= 0.01 &&
                t.bow(3, 4) <= -0.015 && t.turn(4) >= kFork;
       }}},
     [](T t) {
       return 0.85 + 0.15 * share(-t.bow(3, 4), 0.015, 0.12) - 0.5 * t.bent(2, 3) - 0.3 * t.bent(4, 0) -
              0.3 * t.bent(1, 2) - 0.5 * t.bent(0, 1) - 2 * t.uneven(0, 1) / t.h -
              share(t.uneven(2, 3), 0.1 * t.h, 0.4 * t.h);
     }},
};

// Takes corner after corner in the outline's order, going back wherever one cannot lie there. Of fits that are as good
// the first.
class Search {
 public:
  Search(const Shape& shape, const Kind& kind) : kind_(kind), n_(shape.size()), taken_(shape) {}
  std::optional<ShapeFit> best() {
    for (std::size_t first = 0; first < n_; ++first) take(first);
    return std::move(best_);
  }

 private:
  void take(std::size_t corner) {
    auto& corners = taken_.corners;
    const std::size_t nth = corners.size();
    corners.push_back(corner);
    if (kind_.corners[nth].lies(taken_)) {
      if (nth + 1 == kind_.corners.size())
        keep();
      else
        for (std::size_t k = (corner + 1) % n_; k != corners.front(); k = (k + 1) % n_) take(k);
    }
    corners.pop_back();
  }
  void keep() {
    const double score = kind_.score(taken_) - kind_.leftOver * taken_.leftOver();
    if (score <= 0 || (best_ && best_->score >= score)) return;
    best_ = ShapeFit{kind_.role, score, !kind_.half, false, {}};
    const auto& corners = taken_.corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
      best_->parts[kind_.corners[k].part] = {corners[k], corners[(k + 1) % corners.size()]};
  }

  const Kind& kind_;
  std::size_t n_;
  Taken taken_;
  std::optional<ShapeFit> best_;
};

PiecePart opposite(PiecePart part) {
  constexpr PiecePart kPairs[][2] = {
      {SidePlus, SideMinus}, {ArmholePlus, ArmholeMinus}, {ShoulderPlus, ShoulderMinus}, {CrotchPlus, CrotchMinus}};
  for (const auto& [a, b] : kPairs)
    if (part == a || part == b) return part == a ? b : a;
  return part;
}

}  // namespace

std::vector<ShapeFit> fitsOf(const Shape& upright) {
  std::vector<ShapeFit> all;
  const Shape turned = upright.mirrored();
  const std::size_t n = upright.size();
  for (const Kind& kind : kKinds) {
    if (kind.corners.size() > n) continue;
    auto fit = Search(upright, kind).best();
    const auto back = kind.half ? Search(turned, kind).best() : std::nullopt;
    if (back && (!fit || back->score > fit->score)) {
      fit = ShapeFit{back->role, back->score, back->whole, true, {}};
      for (const auto& [part, ends] : back->parts) fit->parts[opposite(part)] = {n - 1 - ends[1], n - 1 - ends[0]};
    }
    if (fit) all.push_back(*std::move(fit));
  }
  return all;
}

}  // namespace karinui

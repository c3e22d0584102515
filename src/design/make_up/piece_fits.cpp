// The shapes of clothes, fitted to an outline by its corners. Each fit is a score of 0 to 1: conditions that must hold,
// less what is unlike the shape. Sharp corners that a fit leaves unexplained speak against it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "piece_shape.h"

namespace karinui {

namespace {

constexpr double kFork = 1.0;       // radians a trouser leg turns at least at its fork
constexpr double kLeftOver = 0.35;  // a right angle that the fit does not explain costs this much

double share(double x, double low, double high) { return std::clamp((x - low) / (high - low), 0.0, 1.0); }

class Fitting {
 public:
  explicit Fitting(const Shape& shape)
      : s_(shape), n_(shape.size()), w_(shape.high.u - shape.low.u), h_(shape.high.v - shape.low.v) {
    for (const auto& corner : s_.corners) turns_ += std::abs(corner.turn);
  }

  // Half of a front or back, its centre at minus: hem from the centre to the side, side, armhole, shoulder, neck.
  std::optional<ShapeFit> trunkHalf() const {
    std::optional<ShapeFit> best;
    for (std::size_t b = 0; b < n_; ++b) {
      if (u(b) < 0.5 || v(b) > 0.4) continue;
      for (const auto& [c, d, e, flank] : flanks(b, 0))
        for (std::size_t f = next(e); f != b; f = next(f)) {
          if (u(f) > 0.35 || at(f).v > at(e).v + 0.005 || v(f) < 0.3) continue;
          for (std::size_t a = next(f); a != b; a = next(a)) {
            if (u(a) > 0.35 || v(a) > 0.3) continue;
            const double centre = std::abs(s_.bow(f, a));
            double score = flank - 0.8 * centre - slant(f, a) - 0.5 * std::max(0.0, s_.bow(e, f)) - 0.5 * u(a);
            score -= leftOver({a, b, c, d, e, f});
            keep(best, PieceRole::Front, false, score,
                 {{PiecePart::Hem, {a, b}},
                  {PiecePart::SidePlus, {b, c}},
                  {PiecePart::ArmholePlus, {c, d}},
                  {PiecePart::ShoulderPlus, {d, e}},
                  {PiecePart::Neck, {e, f}},
                  {PiecePart::Centre, {f, a}}});
          }
        }
    }
    return best;
  }

  // Both halves.
  std::optional<ShapeFit> trunkWhole() const {
    std::optional<ShapeFit> best;
    const Shape other = s_.mirrored();
    const Fitting back(other);
    struct Half {
      std::size_t b, c, d, e;
      double score;
    };
    const auto halves = [](const Fitting& of) {
      std::vector<Half> all;
      for (std::size_t b = 0; b < of.n_; ++b) {
        if (of.u(b) < 0.6 || of.v(b) > 0.4) continue;
        for (const auto& [c, d, e, flank] : of.flanks(b, 0.5))
          if (of.u(e) > 0.5) all.push_back({b, c, d, e, flank});
      }
      std::stable_sort(all.begin(), all.end(), [](const Half& x, const Half& y) { return x.score > y.score; });
      if (all.size() > 40) all.resize(40);
      return all;
    };
    const auto right = halves(*this);
    for (const Half& r : right)
      for (Half l : halves(back)) {
        for (std::size_t* k : {&l.b, &l.c, &l.d, &l.e}) *k = n_ - 1 - *k;
        const double even = std::abs(at(r.b).v - at(l.b).v) + std::abs(at(r.c).v - at(l.c).v) +
                            std::abs(at(r.d).v - at(l.d).v) + std::abs(at(r.e).v - at(l.e).v);
        double score = 0.5 * (r.score + l.score) - 2 * even / h_;
        // The neck is hollow between the two shoulders.
        score -= share(s_.bow(r.e, l.e), -0.02, 0.15);
        score -= leftOver({r.b, r.c, r.d, r.e, l.b, l.c, l.d, l.e});
        keep(best, PieceRole::Front, true, score,
             {{PiecePart::Hem, {l.b, r.b}},
              {PiecePart::SidePlus, {r.b, r.c}},
              {PiecePart::ArmholePlus, {r.c, r.d}},
              {PiecePart::ShoulderPlus, {r.d, r.e}},
              {PiecePart::Neck, {r.e, l.e}},
              {PiecePart::ShoulderMinus, {l.e, l.d}},
              {PiecePart::ArmholeMinus, {l.d, l.c}},
              {PiecePart::SideMinus, {l.c, l.b}}});
      }
    return best;
  }

  // The lower part of a back that a yoke is sewn to, or of a strapless top: armholes without shoulders.
  std::optional<ShapeFit> trunkBelowYoke() const {
    std::optional<ShapeFit> best;
    for (std::size_t b = 0; b < n_; ++b) {
      if (u(b) < 0.6 || v(b) > 0.4) continue;
      for (std::size_t c = next(b); c != b; c = next(c)) {
        if (u(c) < 0.7 || v(c) < v(b) + 0.2) continue;
        for (std::size_t d = next(c); d != b; d = next(d)) {
          if (u(d) < 0.55 || at(d).v < at(c).v + 0.04 || v(d) < 0.8 || s_.bow(c, d) > -0.01) continue;
          for (std::size_t e = next(d); e != b; e = next(e)) {
            if (u(e) > 0.45 || v(e) < 0.8 || std::abs(at(e).v - at(d).v) > 0.05 * h_) continue;
            for (std::size_t f = next(e); f != b; f = next(f)) {
              if (u(f) > 0.3 || s_.bow(e, f) > -0.01 || std::abs(at(f).v - at(c).v) > 0.05 * h_) continue;
              for (std::size_t g = next(f); g != b; g = next(g)) {
                if (u(g) > 0.4 || std::abs(at(g).v - at(b).v) > 0.05 * h_) continue;
                double score = 0.9 - std::abs(s_.bow(d, e)) - slant(b, c) - slant(f, g) -
                               std::abs(s_.length(c, d) - s_.length(e, f)) / s_.length(c, d);
                score -= leftOver({b, c, d, e, f, g});
                keep(best, PieceRole::Back, true, score,
                     {{PiecePart::Hem, {g, b}},
                      {PiecePart::SidePlus, {b, c}},
                      {PiecePart::ArmholePlus, {c, d}},
                      {PiecePart::Top, {d, e}},
                      {PiecePart::ArmholeMinus, {e, f}},
                      {PiecePart::SideMinus, {f, g}}});
              }
            }
          }
        }
      }
    }
    return best;
  }

  // A yoke: below it the back, on either side armhole and shoulder, the neck on top.
  std::optional<ShapeFit> yoke() const {
    std::optional<ShapeFit> best;
    if (!(w_ > 0.2 && h_ < 0.25 && h_ < 0.6 * w_)) return best;
    for (std::size_t a = 0; a < n_; ++a) {
      if (u(a) > 0.2 || v(a) > 0.35) continue;
      for (std::size_t b = next(a); b != a; b = next(b)) {
        if (u(b) < 0.8 || v(b) > 0.35) continue;
        for (std::size_t c = next(b); c != a; c = next(c)) {
          if (u(c) < 0.75 || at(c).v < at(b).v + 0.02) continue;
          for (std::size_t d = next(c); d != a; d = next(d)) {
            if (u(d) > u(c) - 0.1 || u(d) < 0.5) continue;
            for (std::size_t e = next(d); e != a; e = next(e)) {
              if (u(e) > 0.5 || s_.bow(d, e) > -0.03 || std::abs(at(e).v - at(d).v) > 0.1 * h_) continue;
              for (std::size_t f = next(e); f != a; f = next(f)) {
                if (u(f) > 0.25 || std::abs(at(f).v - at(c).v) > 0.1 * h_) continue;
                double score = 0.95 - 0.5 * std::abs(s_.bow(a, b)) - 0.5 * std::abs(s_.bow(c, d));
                score -= std::abs(s_.length(b, c) - s_.length(f, a)) / s_.length(b, c);
                score -= leftOver({a, b, c, d, e, f});
                keep(best, PieceRole::Yoke, true, score,
                     {{PiecePart::Hem, {a, b}},
                      {PiecePart::ArmholePlus, {b, c}},
                      {PiecePart::ShoulderPlus, {c, d}},
                      {PiecePart::Neck, {d, e}},
                      {PiecePart::ShoulderMinus, {e, f}},
                      {PiecePart::ArmholeMinus, {f, a}}});
              }
            }
          }
        }
      }
    }
    return best;
  }

  // A sleeve: hem, two sides of one length, a cap that bulges upwards and bends back at its foot.
  std::optional<ShapeFit> sleeve() const {
    std::optional<ShapeFit> best;
    four([&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      const double under = s_.length(b, c), other = s_.length(d, a), cap = s_.length(c, d);
      const double chord = distance(at(c), at(d)), bow = s_.bow(c, d);
      if (chord < 0.75 * w_ || std::abs(under - other) > 0.06 * std::max(under, other) + 0.004) return;
      if (bow < 0.07 || bow > 0.9 || cap > 2.5 * chord) return;
      const double rise = s_.high.v - 0.5 * (at(c).v + at(d).v);
      if (rise < 0.04 || at(c).v < at(b).v + 0.015 || at(d).v < at(a).v + 0.015) return;
      double score = 1 - std::abs(s_.bow(a, b)) - 0.5 * std::abs(s_.bow(b, c)) - 0.5 * std::abs(s_.bow(d, a));
      score -= 2 * std::abs(at(c).v - at(d).v) / w_ + 2 * std::abs(at(a).v - at(b).v) / w_;
      score -= share(distance(at(a), at(b)), chord, 1.4 * chord) + 0.3 * (1 - share(rise / chord, 0.08, 0.2));
      score -= leftOver({a, b, c, d});
      keep(best, PieceRole::Sleeve, true, score,
           {{PiecePart::Hem, {a, b}},
            {PiecePart::SidePlus, {b, c}},
            {PiecePart::Top, {c, d}},
            {PiecePart::SideMinus, {d, a}}});
    });
    return best;
  }

  // Half of a pair of trousers' front or back, its crotch at minus.
  std::optional<ShapeFit> legHalf() const {
    std::optional<ShapeFit> best;
    four([&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      if (v(c) < 0.7 || v(d) < 0.7 || h_ < 0.2) return;
      for (std::size_t e = next(d); e != a; e = next(e)) {
        if (u(e) > 0.12 || at(d).u < at(e).u + 0.025 || at(e).v > at(d).v - 0.08) continue;
        if (at(e).v < at(a).v + 0.01) continue;
        const double hollow = s_.bow(d, e);
        if (hollow > -0.015 || s_.corners[e].turn < kFork) continue;
        double score = 0.85 + 0.15 * share(-hollow, 0.015, 0.12);
        score -= 0.5 * std::abs(s_.bow(c, d)) + 0.3 * std::abs(s_.bow(e, a)) + 0.3 * std::abs(s_.bow(b, c)) +
                 0.5 * std::abs(s_.bow(a, b));
        score -= 2 * std::abs(at(a).v - at(b).v) / h_ + share(std::abs(at(c).v - at(d).v), 0.1 * h_, 0.4 * h_);
        score -= leftOver({a, b, c, d, e});
        keep(best, PieceRole::LegFront, false, score,
             {{PiecePart::Hem, {a, b}},
              {PiecePart::SidePlus, {b, c}},
              {PiecePart::Top, {c, d}},
              {PiecePart::CrotchMinus, {d, e}},
              {PiecePart::SideMinus, {e, a}}});
      }
    });
    return best;
  }

  // Front and back of a leg in one: two crotches, two inseams of one length.
  std::optional<ShapeFit> legWhole() const {
    std::optional<ShapeFit> best;
    four([&](std::size_t a, std::size_t b, std::size_t d, std::size_t e) {
      if (v(d) < 0.6 || v(e) < 0.6 || h_ < 0.2) return;
      for (std::size_t c = next(b); c != d; c = next(c)) {
        if (u(c) < 0.85 || at(d).u > at(c).u - 0.015 || s_.bow(c, d) > -0.01 || s_.corners[c].turn < kFork) continue;
        for (std::size_t f = next(e); f != a; f = next(f)) {
          if (u(f) > 0.15 || at(e).u < at(f).u + 0.015 || s_.bow(e, f) > -0.01 || s_.corners[f].turn < kFork) continue;
          const double in = s_.length(b, c), other = s_.length(f, a);
          if (in < 0.02 || std::abs(in - other) > 0.05 * std::max(in, other) + 0.004) continue;
          double score = 1 - 0.5 * std::abs(s_.bow(d, e)) - 0.5 * std::abs(s_.bow(a, b));
          score -= 2 * std::abs(at(a).v - at(b).v) / h_ + share(std::abs(at(c).v - at(f).v), 0.03 * h_, 0.2 * h_);
          score -= leftOver({a, b, c, d, e, f});
          keep(best, PieceRole::Leg, false, score,
               {{PiecePart::Hem, {a, b}},
                {PiecePart::SidePlus, {b, c}},
                {PiecePart::CrotchPlus, {c, d}},
                {PiecePart::Top, {d, e}},
                {PiecePart::CrotchMinus, {e, f}},
                {PiecePart::SideMinus, {f, a}}});
        }
      }
    });
    return best;
  }

  // Hem, side, top, side: a part of a skirt.
  std::optional<ShapeFit> skirt() const {
    std::optional<ShapeFit> best;
    if (h_ < 0.25) return best;
    four([&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      const double side = s_.length(b, c), other = s_.length(d, a), deep = std::max(side, other);
      if (v(c) < 0.75 || v(d) < 0.75 || v(a) > 0.25 || v(b) > 0.25 || std::abs(side - other) > 0.2 * deep) return;
      double score = 0.85 - 0.4 * (std::abs(s_.bow(b, c)) + std::abs(s_.bow(d, a)));
      score -= share(s_.length(c, d), 1.05 * s_.length(a, b), 1.6 * s_.length(a, b));
      score -= 0.5 * std::abs(side - other) / deep + leftOver({a, b, c, d});
      keep(best, PieceRole::SkirtFront, true, score,
           {{PiecePart::Hem, {a, b}},
            {PiecePart::SidePlus, {b, c}},
            {PiecePart::Top, {c, d}},
            {PiecePart::SideMinus, {d, a}}});
    });
    return best;
  }

  // Long and low, straight or curved: two long edges between two ends.
  std::optional<ShapeFit> band() const {
    std::optional<ShapeFit> best;
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = next(a); b != a; b = next(b)) {
        if (at(b).u - at(a).u < 0.5 * w_) continue;
        for (std::size_t c = next(b); c != a; c = next(c))
          for (std::size_t d = next(c); d != a; d = next(d)) {
            if (at(c).u - at(d).u < 0.5 * w_) continue;
            const double end = s_.length(b, c), other = s_.length(d, a), deep = std::max(end, other);
            const double low = s_.length(a, b), top = s_.length(c, d);
            if (deep > 0.16 || std::min(low, top) < 1.8 * deep) continue;
            double score = 0.9 - 0.5 * std::abs(end - other) / deep - 0.3 * std::abs(low - top) / std::max(low, top);
            score -= 0.7 * leftOver({a, b, c, d});
            keep(best, PieceRole::Waistband, true, score,
                 {{PiecePart::Hem, {a, b}},
                  {PiecePart::SidePlus, {b, c}},
                  {PiecePart::Top, {c, d}},
                  {PiecePart::SideMinus, {d, a}}});
          }
      }
    return best;
  }

 private:
  Flat at(std::size_t k) const { return s_.place(k); }
  double u(std::size_t k) const { return (at(k).u - s_.low.u) / w_; }
  double v(std::size_t k) const { return (at(k).v - s_.low.v) / h_; }
  std::size_t next(std::size_t k) const { return (k + 1) % n_; }

  // How far the way from one corner to another leans from the upright.
  double slant(std::size_t from, std::size_t to) const {
    const Flat way = at(to) - at(from);
    return std::max(0.0, std::abs(way.u) / (std::abs(way.v) + 1e-9) - 0.2);
  }
  double leftOver(std::initializer_list<std::size_t> used) const {
    double left = turns_;
    for (const std::size_t k : used) left -= std::abs(s_.corners[k].turn);
    return kLeftOver * std::max(0.0, left) / (std::numbers::pi / 2);
  }

  // Side, armhole and shoulder from the lower corner of the side; `axis`: of the centre, a share of the width.
  struct Flank {
    std::size_t c, d, e;
    double score;
  };
  std::vector<Flank> flanks(std::size_t b, double axis) const {
    std::vector<Flank> all;
    for (std::size_t c = next(b); c != b; c = next(c)) {
      if (u(c) < axis + 0.6 * (1 - axis) || at(c).v < at(b).v + 0.05 || v(c) > 0.92) continue;
      const double side = slant(b, c) + 0.5 * std::abs(s_.bow(b, c));
      for (std::size_t d = next(c); d != b; d = next(d)) {
        if (u(d) < axis + 0.05 || at(d).v < at(c).v + 0.06) continue;
        const double hollow = s_.bow(c, d);
        if (hollow > -0.01) continue;
        for (std::size_t e = next(d); e != b; e = next(e)) {
          const Flat way = at(e) - at(d);
          if (way.u > -0.008 || s_.length(d, e) > 0.28 || u(e) < axis - 0.02 || way.v < -0.02 || v(e) < 0.75) continue;
          const double steep = share(std::abs(way.v) / -way.u, 0.5, 1.5);
          const double score = 1 - side - 0.4 * steep - std::abs(s_.bow(d, e)) - 0.2 * (1 - share(-hollow, 0.01, 0.06));
          if (score > 0.2) all.push_back({c, d, e, score});
        }
      }
    }
    return all;
  }

  template <class Visit>
  void four(const Visit& visit) const {
    for (std::size_t a = 0; a < n_; ++a) {
      if (u(a) > 0.45 || v(a) > 0.5) continue;
      for (std::size_t b = next(a); b != a; b = next(b)) {
        if (u(b) < 0.55 || v(b) > 0.5) continue;
        for (std::size_t c = next(b); c != a; c = next(c)) {
          if (u(c) < 0.5) continue;
          for (std::size_t d = next(c); d != a; d = next(d))
            if (u(d) < 0.5) visit(a, b, c, d);
        }
      }
    }
  }

  static void keep(std::optional<ShapeFit>& best, PieceRole role, bool whole, double score,
                   std::map<PiecePart, std::array<std::size_t, 2>> parts) {
    if (score <= 0 || (best && best->score >= score)) return;
    best = ShapeFit{role, score, whole, false, std::move(parts)};
  }

  const Shape& s_;
  std::size_t n_;
  double w_, h_, turns_ = 0;
};

PiecePart opposite(PiecePart part) {
  switch (part) {
    case PiecePart::SidePlus:
      return PiecePart::SideMinus;
    case PiecePart::SideMinus:
      return PiecePart::SidePlus;
    case PiecePart::ArmholePlus:
      return PiecePart::ArmholeMinus;
    case PiecePart::ArmholeMinus:
      return PiecePart::ArmholePlus;
    case PiecePart::ShoulderPlus:
      return PiecePart::ShoulderMinus;
    case PiecePart::ShoulderMinus:
      return PiecePart::ShoulderPlus;
    case PiecePart::CrotchPlus:
      return PiecePart::CrotchMinus;
    case PiecePart::CrotchMinus:
      return PiecePart::CrotchPlus;
    default:
      return part;
  }
}

}  // namespace

std::vector<ShapeFit> fitsOf(const Shape& upright) {
  std::vector<ShapeFit> all;
  if (upright.size() < 4) return all;
  const Fitting as(upright);
  for (auto&& fit :
       {as.trunkWhole(), as.trunkBelowYoke(), as.yoke(), as.sleeve(), as.legWhole(), as.skirt(), as.band()})
    if (fit) all.push_back(*fit);
  const Shape turned = upright.mirrored();
  const Fitting other(turned);
  const std::size_t n = upright.size();
  for (const auto& [fit, back] : {std::pair{as.trunkHalf(), other.trunkHalf()}, {as.legHalf(), other.legHalf()}}) {
    if (!fit && !back) continue;
    if (fit && (!back || fit->score >= back->score)) {
      all.push_back(*fit);
      continue;
    }
    ShapeFit one = *back;
    one.mirrored = true;
    one.parts.clear();
    for (const auto& [part, ends] : back->parts) one.parts[opposite(part)] = {n - 1 - ends[1], n - 1 - ends[0]};
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace karinui

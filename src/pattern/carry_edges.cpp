// Several edges carried into their piece at once, as a whole or running out to nothing.
#include <algorithm>
#include <cmath>

#include "karinui/pattern/edit.h"
#include "parallel_edge.h"
#include "words.h"

namespace karinui {

double Taper::share(double at) const {
  if (at < from || at > to) return 0;
  const double wide = at < most ? most - from : to - most, away = std::fabs(at - most);
  if (wide <= 0) return 1;
  const double x = 1 - away / wide;
  return x * x * (3 - 2 * x);
}

double Taper::slope(double at) const {
  if (at <= from || at >= to) return 0;
  const double wide = at < most ? most - from : to - most, away = std::fabs(at - most);
  if (wide <= 0) return 0;
  const double x = 1 - away / wide;
  return (at < most ? 6 : -6) * x * (1 - x) / wide;
}

namespace {

constexpr double kAlike = 0.35;   // sine of the angle below which two edges go on in one line
constexpr double kFarCorner = 4;  // times the measure: a corner goes no farther
constexpr double kLeastPart = 1e-4;

Flat onTenths(Flat p) { return {std::round(p.u * 1e4) / 1e4, std::round(p.v * 1e4) / 1e4}; }

void endsAt(Curve& curve, Flat start, Flat end) {
  if (curve.kind == Curve::Kind::Cubic) curve.control1 += start - curve.start, curve.control2 += end - curve.end;
  curve.start = start, curve.end = end;
}

// Each place of the curve by its share of a step.
Curve tapered(const Curve& curve, Flat step, const Taper& taper) {
  const double whole = curve.length();
  std::vector<double> cuts{0};
  for (const double f : {taper.from, taper.most, taper.to})
    if (f * whole > kLeastPart && (1 - f) * whole > kLeastPart)
      if (const double t = curve.parameterAt(f * whole); t > cuts.back()) cuts.push_back(t);
  cuts.push_back(1);
  std::vector<Curve> parts;
  double before = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    for (Curve cubic : curve.part(cuts[k], cuts[k + 1]).cubics()) {
      const double after = before + cubic.length();
      const Flat leaves = cubic.control1 - cubic.start, arrives = cubic.end - cubic.control2;
      const double a = taper.share(before / whole), b = taper.share(std::fmin(after / whole, 1));
      // A handle is a third of the way that the curve goes per unit of its parameter.
      const double up = taper.slope(before / whole) * length(leaves) / whole,
                   down = taper.slope(after / whole) * length(arrives) / whole;
      cubic.start += step * a, cubic.control1 += step * (a + up);
      cubic.control2 += step * (b - down), cubic.end += step * b;
      if (!parts.empty()) cubic.start = parts.back().end;
      parts.push_back(cubic);
      before = after;
    }
  return Curve::joined(parts);
}

// The edges of one outline, and where they go.
class CarriedOutline {
 public:
  CarriedOutline(const Outline& outline, std::vector<const EdgeCarry*> plan, const PaperSymmetry* symmetry)
      : edges_(outline.edges), n_(edges_.size()), plan_(std::move(plan)), symmetry_(symmetry) {
    for (std::size_t c = 0; c < n_; ++c) corner_.push_back(newCorner(c));
    onBeside_.resize(n_);
    for (std::size_t k = 0; k < n_; ++k)
      if (follows(k)) goAlongBeside(k);
    if (symmetry_) matchCorners();
    for (std::size_t c = 0; c < n_; ++c)  // the mouth of a slit
      for (std::size_t m = 0; m < c; ++m)
        if (onBeside_[c] && onBeside_[m] && edges_[m].curve.start == edges_[c].curve.start) corner_[c] = corner_[m];
  }

  Outline carried() const {
    Outline now{edges_};
    for (std::size_t k = 0; k < n_; ++k) {
      const Flat start = at(k), end = at((k + 1) % n_);
      Curve curve = edges_[k].curve;
      if (follows(k)) {
        curve = ParallelLine(curve, plan_[k]->by).between(start, end);
      } else if (!plan_[k] && (onBeside_[k] || onBeside_[(k + 1) % n_])) {
        if (onBeside_[k]) curve = endedAt(curve, false, start);
        if (onBeside_[(k + 1) % n_]) curve = endedAt(curve, true, end);
      } else if (plan_[k]) {
        const Flat step = inwards(k) * plan_[k]->by;
        if (plan_[k]->taper) {
          curve = tapered(curve, step, *plan_[k]->taper);
        } else {
          for (Flat& p : curve.between) p += step;
          if (curve.kind == Curve::Kind::Cubic) curve.control1 += step, curve.control2 += step;
          curve.start += step, curve.end += step;
        }
      }
      endsAt(curve, start, end);
      now.edges[k].curve = std::move(curve);
    }
    for (std::size_t k = 0; symmetry_ && k < n_; ++k) {
      if (!(plan_[k] || onBeside_[k] || onBeside_[(k + 1) % n_]) || !symmetry_->partner[k]) continue;
      const std::size_t other = *symmetry_->partner[k];
      if (other == k) now.edges[k].curve = evenAcross(now.edges[k].curve, *symmetry_);
      if (other <= k) continue;
      Curve image = symmetry_->image(now.edges[k].curve).reversed();
      image.start = now.edges[other].curve.start, image.end = now.edges[other].curve.end;  // to the bit
      now.edges[other].curve = std::move(image);
    }
    for (std::size_t k = 0; k < n_; ++k)  // the banks of a slit are one line walked both ways
      for (std::size_t m = 0; m < k; ++m)
        if (!plan_[k] && edges_[k].curve == edges_[m].curve.reversed())
          now.edges[k].curve = now.edges[m].curve.reversed();
    return now;
  }

 private:
  Flat inwardsAt(std::size_t k, bool atEnd) const {  // at an end of it
    return follows(k) ? leftOf(normalized(endTangent(edges_[k].curve, atEnd))) : inwards(k);
  }
  Flat inwards(std::size_t k) const { return leftOf(normalized(edges_[k].curve.end - edges_[k].curve.start)); }
  Flat at(std::size_t c) const { return corner_[c].value_or(edges_[c].curve.start); }
  bool follows(std::size_t k) const { return plan_[k] && plan_[k]->follow; }
  // The ends of an edge that stays parallel, where the edges beside it do not go themselves.
  void goAlongBeside(std::size_t k) {
    const ParallelLine line(edges_[k].curve, plan_[k]->by);
    const std::size_t before = (k + n_ - 1) % n_, after = (k + 1) % n_;
    const auto go = [&](std::size_t corner, std::size_t beside, bool besideEnds) {
      const auto place = plan_[beside] ? std::nullopt : line.met(edges_[beside].curve, besideEnds);
      if (place) corner_[corner] = place, onBeside_[corner] = true;
    };
    go(k, before, true), go(after, after, false);
  }
  std::optional<double> howFar(std::size_t k, bool atEnd) const {
    if (!plan_[k]) return std::nullopt;
    return plan_[k]->taper ? plan_[k]->by * plan_[k]->taper->share(atEnd ? 1 : 0) : plan_[k]->by;
  }
  // Where the corner goes at which edge c starts; nothing: it stays.
  std::optional<Flat> newCorner(std::size_t c) const {
    const std::size_t before = (c + n_ - 1) % n_;
    const auto one = howFar(before, true), other = howFar(c, false);
    const Flat place = edges_[c].curve.start;
    Flat by;
    if (one && other) {
      const Flat a = inwardsAt(before, true), b = inwardsAt(c, false);
      const double turn = cross(a, b);
      by = dot(a, b) > 0 ? normalized(a + b) * ((*one + *other) / 2) : a * *one;
      if (std::fabs(turn) > kAlike) {
        const Flat both{(*one * b.v - *other * a.v) / turn, (a.u * *other - b.u * *one) / turn};
        if (length(both) <= kFarCorner * std::fmax(std::fabs(*one), std::fabs(*other))) by = both;
      }
    } else if (one) {
      by = inwards(before) * *one;
    } else if (other) {
      by = inwards(c) * *other;
    }
    if (by.u == 0 && by.v == 0) return std::nullopt;
    return follows(before) && follows(c) ? place + by : onTenths(place + by);
  }
  // Corners of the one half where those of the other are, mirrored; both sides of a slit's mouth together.
  void matchCorners() {
    for (std::size_t c = 0; c < n_; ++c) {
      if (!corner_[c] || !symmetry_->corner[c]) continue;
      const std::size_t other = *symmetry_->corner[c];
      if (other == c) corner_[c] = (*corner_[c] + symmetry_->image(*corner_[c])) * 0.5;
      if (other > c) corner_[other] = symmetry_->image(*corner_[c]);
    }
    for (std::size_t c = 0; c < n_; ++c)
      for (std::size_t m = 0; m < n_ && !symmetry_->corner[c] && !corner_[c]; ++m)
        if (corner_[m] && edges_[m].curve.start == edges_[c].curve.start) corner_[c] = corner_[m];
  }

  const std::vector<Edge>& edges_;
  std::size_t n_;
  std::vector<const EdgeCarry*> plan_;
  const PaperSymmetry* symmetry_;
  std::vector<std::optional<Flat>> corner_;
  std::vector<bool> onBeside_;  // it went along the edge beside the one that is carried
};

}  // namespace

Result<Piece> carryEdges(const Piece& piece, const std::vector<EdgeCarry>& carries, const PaperSymmetry* symmetry) {
  std::vector<const EdgeCarry*> plan(piece.outline.edges.size());
  for (const EdgeCarry& carry : carries) {
    const auto k = piece.outline.find(carry.edge);
    if (!k) return noEdge(piece, carry.edge);
    plan[*k] = &carry;
  }
  auto good = checked(CarriedOutline(piece.outline, std::move(plan), symmetry).carried());
  if (!good) return good.error();
  Piece carried = piece;
  carried.outline = *std::move(good);
  return carried;
}

}  // namespace karinui

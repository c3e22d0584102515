#include "session/sew_stroke.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

using Where = PointerSample::Where;

constexpr double kPart = 0.03;   // metres along the border that make a run
constexpr double kSnaps = 0.02;  // metres: a run's end this near to a corner, a notch or the middle is there
constexpr double kAgain = 0.05;  // metres: how far from where it left the border a drag may come back to it
constexpr double kLeft = 4;      // reaches beside the border, after which a drag has left it

// In reaches of the pointer.
double apart(const PointerSample& a, const PointerSample& b) {
  if (b.where == Where::Table) return distance(a.place, b.place) / b.reach;
  return (length(cross(a.ray.direction, b.ray.direction)) + distance(a.ray.origin, b.ray.origin)) / b.reach;
}

double reachInMetres(const GestureContext& context, const PointerSample& sample, const EdgeNear& near) {
  if (sample.where == Where::Table || sample.tip) return sample.reach;
  const auto line = edgeInSpace(*context.snapshot, {PieceRef(near.piece), near.edge, 0, 1});
  return line.empty() ? sample.reach : sample.reach * distance(line[line.size() / 2], sample.ray.origin);
}

// A zip holds its edges as a seam does, also while it stands open.
Pattern withWholeZips(const Document& document) {
  Fastenings whole = document.allowances.fastenings;
  for (auto& [name, own] : whole) own.zipped = 1;
  return withZips(document.pattern, whole);
}

// A stroke that begins a finger's breadth inside a zip was meant to begin where the zip ends.
EdgeNear besideZip(const Pattern& zipped, const Pattern& pattern, EdgeNear from) {
  constexpr double kBeside = 1e-5;  // of an edge
  const auto piece = pattern.pieces.find(from.piece);
  const Edge* edge = piece == pattern.pieces.end() ? nullptr : findEdge(*piece->second, from.edge);
  if (!edge) return from;
  const double near = kSnaps / edge->curve.length();
  for (const auto& [id, seam] : zipped.seams) {
    if (pattern.seams.contains(id)) continue;
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& zip : *side) {
        if (zip.piece != from.piece || zip.edge != from.edge) continue;
        if (from.fraction < zip.from || from.fraction > zip.to) continue;
        if (zip.from > kBeside && from.fraction - zip.from < near)
          from.fraction = zip.from - kBeside;
        else if (zip.to < 1 - kBeside && zip.to - from.fraction < near)
          from.fraction = zip.to + kBeside;
      }
  }
  return from;
}

bool sameEdge(const EdgeNear& a, const EdgeNear& b) { return a.piece == b.piece && a.edge == b.edge; }

}  // namespace

SewStroke::SewStroke(const GestureContext& context, EdgeNear from, PointerSample sample)
    : from_(besideZip(withWholeZips(context.snapshot->document), context.snapshot->document.pattern, std::move(from))),
      border_(withWholeZips(context.snapshot->document), from_),
      last_(sample),
      began_(border_.find(from_).value_or(0)) {}

bool SewStroke::isRun() const { return std::fabs(total_) >= kPart; }

// In steps no longer than the pointer's reach.
void SewStroke::to(const GestureContext& context, const PointerSample& sample, const WantedEdge& other) {
  const PointerSample before = last_;
  const int steps = std::clamp(static_cast<int>(std::ceil(apart(before, sample))), 1, 400);
  for (int k = 1; k <= steps; ++k) {
    PointerSample now = sample;
    const double share = static_cast<double>(k) / steps;
    now.place = lerp(before.place, sample.place, share);
    now.ray.origin = lerp(before.ray.origin, sample.ray.origin, share);
    now.ray.direction = normalized(lerp(before.ray.direction, sample.ray.direction, share));
    if (now.tip && before.tip) now.tip->carry = lerp(before.tip->carry, sample.tip->carry, share);
    step(context, now, other);
  }
  last_ = sample;
}

Run SewStroke::run() const {
  if (!isRun()) return edge();
  const double a = snapped(began_ + std::fmin(0, total_)), b = snapped(began_ + std::fmax(0, total_));
  Run run = b - a < 1e-3 ? Run() : border_.between(a, b);
  return run.empty() ? edge() : run;
}

Run SewStroke::edge() const {
  for (const EdgeRef& part : border_.between(0, border_.length()))
    if (part.piece.id == from_.piece && part.edge == from_.edge && part.from <= from_.fraction + 1e-6 &&
        from_.fraction <= part.to + 1e-6)
      return {part};
  return {{PieceRef(from_.piece), from_.edge, 0, 1}};
}

Run SewStroke::sideBeforeLeaving() const {
  Run run = this->run();
  const Run whole = edge();
  if (std::find(run.begin(), run.end(), whole.front()) == run.end()) return whole;
  // The beginning of an edge beyond the last corner is where the drag turned away.
  const EdgeRef last = total_ > 0 ? run.back() : run.front();
  if (run.size() > 1 && last.to - last.from < 0.5) run.erase(total_ > 0 ? run.end() - 1 : run.begin());
  return run;
}

double SewStroke::forth(double along) const {
  const double whole = border_.length(), by = border_.wrapped(along - began_ - total_);
  return by > whole / 2 ? by - whole : by;
}

void SewStroke::step(const GestureContext& context, const PointerSample& sample, const WantedEdge& other) {
  PointerSample wide = sample;
  wide.reach *= 1.5;
  const auto own = pickEdge(*context.snapshot, *context.table, wide,
                            [&](const EdgeNear& near) { return border_.find(near).has_value(); });
  auto any = pickEdge(*context.snapshot, *context.table, sample, other);
  if (any && sameEdge(*any, from_)) any.reset();
  const bool elsewhere = any && (!own || (own->away > 0.5 * sample.reach && any->away < 0.5 * own->away));
  if (own && !elsewhere) {
    const double by = forth(*border_.find(*own));
    const double most = left_ ? kAgain : 4 * reachInMetres(context, sample, from_) + 0.02;
    if (std::fabs(by) < most || sameEdge(*own, onto_) || sameEdge(*own, from_)) {
      total_ = std::clamp(total_ + by, -border_.length(), border_.length());
      onto_ = *own, left_ = false, beside_ = 0;
      target_.reset();
      return;
    }
  }
  if (++beside_ > kLeft) left_ = true;
  target_ = left_ || elsewhere ? any : std::nullopt;
}

double SewStroke::snapped(double along) const {
  const double turn = along - border_.wrapped(along);
  double best = along, nearest = kSnaps;
  for (const double stop : border_.keyStops())
    for (const double round : {-border_.length(), 0.0, border_.length()})
      if (const double away = std::fabs(stop + turn + round - along); away < nearest)
        nearest = away, best = stop + turn + round;
  return best;
}

}  // namespace karinui

#include "session/sewn_border.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kSame = 1e-6;  // of an edge's length

struct Spot {
  const Piece* piece;
  std::size_t edge;
  double at;
  const Edge& on() const { return piece->outline.edges[edge]; }
  bool operator==(const Spot& o) const {
    return piece == o.piece && edge == o.edge && std::fabs(at - o.at) < 2 * kSame;
  }
};

struct Held {  // a part of an edge that a seam holds
  const Seam* seam;
  bool onA;
  std::size_t span;
};

// The seam that holds the edge from a spot on.
std::optional<Held> heldFrom(const Pattern& pattern, const Spot& spot) {
  for (const auto& [id, seam] : pattern.seams)
    for (const bool onA : {true, false}) {
      if (onA && seam.tie == Seam::Tie::Pleat) continue;  // what lies over a pleat is free
      const auto& side = onA ? seam.a : seam.b;
      for (std::size_t k = 0; k < side.size(); ++k)
        if (side[k].piece == spot.piece->id && side[k].edge == spot.on().name && side[k].from < spot.at + kSame &&
            spot.at + kSame < side[k].to)
          return Held{&seam, onA, k};
    }
  return std::nullopt;
}

double nextHeld(const Pattern& pattern, const Spot& spot) {
  double next = 1;
  for (const auto& [id, seam] : pattern.seams)
    for (const auto* side : takenSides(seam))
      for (const EdgeSpan& span : *side)
        if (span.piece == spot.piece->id && span.edge == spot.on().name && span.from > spot.at + kSame)
          next = std::min(next, span.from);
  return next;
}

// The same place of the seam on its other side, from where the border goes on. A seam that joins two edges in the same
// direction has no border to go on along.
std::optional<Spot> across(const Pattern& pattern, const Spot& spot, const Held& held) {
  if (!held.seam->reversed) return std::nullopt;
  const auto &mine = held.onA ? held.seam->a : held.seam->b, &its = held.onA ? held.seam->b : held.seam->a;
  const std::vector<EdgeSpan> before(mine.begin(), mine.begin() + static_cast<std::ptrdiff_t>(held.span));
  const double done = length(pattern, before) + (spot.at - mine[held.span].from) * spot.on().curve.length();
  double left = length(pattern, its) * (1 - done / length(pattern, mine));
  for (const EdgeSpan& span : its) {
    const double whole = length(pattern, {span});
    if (left > whole + 1e-9 && &span != &its.back()) {
      left -= whole;
      continue;
    }
    const auto piece = pattern.pieces.find(span.piece);
    const auto edge = piece == pattern.pieces.end() ? std::nullopt : piece->second->outline.find(span.edge);
    if (!edge) return std::nullopt;
    return Spot{piece->second.get(), *edge, span.from + (span.to - span.from) * std::clamp(left / whole, 0.0, 1.0)};
  }
  return std::nullopt;
}

}  // namespace

void SewnBorder::add(const Piece& piece, const Edge& edge, double from, double to) {
  const double whole = edge.curve.length();
  parts_.push_back({{PieceRef(piece.id), edge.name, from, to}, length_, (to - from) * whole});
  const auto stop = [&](double fraction) {
    if (fraction >= from - kSame && fraction <= to + kSame) stops_.push_back(length_ + (fraction - from) * whole);
  };
  stop(from), stop(to), stop(0.5);
  for (const Mark& mark : piece.marks)
    if (mark.edge == edge.name) stop(mark.fraction);
  length_ += (to - from) * whole;
}

bool SewnBorder::walk(const Pattern& pattern, const EdgeNear& place) {
  const Piece& piece = *pattern.pieces.at(place.piece);
  Spot begin{&piece, *piece.outline.find(place.edge), std::min(place.fraction, 1 - 2 * kSame)};
  if (heldFrom(pattern, begin)) return false;
  double from = 0;
  for (const auto& [id, seam] : pattern.seams)
    for (const auto* side : takenSides(seam))
      for (const EdgeSpan& span : *side)
        if (span.piece == piece.id && span.edge == place.edge && span.to <= begin.at + kSame)
          from = std::max(from, span.to);
  begin.at = from;
  Spot spot = begin;
  constexpr int kMost = 4000;  // steps: more than any garment has edges
  for (int step = 0; step < kMost; ++step) {
    if (spot.at > 1 - kSame) spot = {spot.piece, (spot.edge + 1) % spot.piece->outline.edges.size(), 0};
    if (const auto held = heldFrom(pattern, spot)) {
      if (held->seam->tie == Seam::Tie::Pleat) {  // folded in: the border goes on behind it
        spot.at = held->seam->b[held->span].to;
        continue;
      }
      const auto there = across(pattern, spot, *held);
      if (!there) return false;
      spot = *there;
      continue;
    }
    if (!parts_.empty() && spot == begin) return true;
    const double to = nextHeld(pattern, spot);
    add(*spot.piece, spot.on(), spot.at, to);
    spot.at = to;
  }
  return false;
}

SewnBorder::SewnBorder(const Pattern& pattern, const EdgeNear& place) {
  if (walk(pattern, place)) return;
  parts_.clear(), stops_.clear(), length_ = 0;
  const Piece& piece = *pattern.pieces.at(place.piece);
  const auto& edges = piece.outline.edges;
  const std::size_t first = *piece.outline.find(place.edge);
  for (std::size_t k = 0; k < edges.size(); ++k) add(piece, edges[(first + k) % edges.size()], 0, 1);
}

std::optional<double> SewnBorder::find(PieceId piece, const std::string& edge, double fraction) const {
  for (const Part& part : parts_)
    if (part.ref.piece.id == piece && part.ref.edge == edge && fraction > part.ref.from - kSame &&
        fraction < part.ref.to + kSame)
      return part.start + part.length * (fraction - part.ref.from) / (part.ref.to - part.ref.from);
  return std::nullopt;
}

double SewnBorder::wrapped(double along) const { return along - length_ * std::floor(along / length_); }

std::vector<EdgeRef> SewnBorder::between(double from, double to) const {
  std::vector<EdgeRef> run;
  const double turn = from - wrapped(from);
  const double first = from - turn, last = std::min(to, from + length_) - turn;
  for (const double round : {0.0, length_})
    for (const Part& part : parts_) {
      const double a = std::max(first, part.start + round), b = std::min(last, part.start + part.length + round);
      if (b - a < 1e-5) continue;
      const auto fraction = [&](double along) {
        const double share = (along - part.start - round) / part.length;
        return part.ref.from + (part.ref.to - part.ref.from) * (share < kSame ? 0 : share > 1 - kSame ? 1 : share);
      };
      EdgeRef ref = part.ref;
      const auto written = [](double f) { return std::round(f * 1000) / 1000; };  // a hand is no finer
      ref.from = a > part.start + round + 1e-9 ? written(fraction(a)) : part.ref.from;
      ref.to = b < part.start + part.length + round - 1e-9 ? written(fraction(b)) : part.ref.to;
      if (ref.to - ref.from > 1e-4) run.push_back(std::move(ref));
    }
  return run;
}

}  // namespace karinui

#include <algorithm>
#include <cmath>

#include "design/operations/operations.h"

namespace karinui {

namespace {

constexpr double kPinSpacing = 0.01;  // along an edge
constexpr double kNear = 0.01;        // a pin this far outside the outline still catches its edge

}  // namespace

Done resolve(const Document& before, PinCloth& op, Context&) {
  if (op.at.empty() && op.edges.empty()) return refused(say("Say where to pin: places on the paper, or edges."));
  for (EdgeRef& edge : op.edges)
    if (Done done = resolve(before, edge); !done) return done;
  if (op.at.empty() && !op.piece) return {};
  if (Done done = resolve(before, op.piece); !done) return done;
  const Piece& piece = *before.find(op.piece.id);
  const Ring ring = piece.outline.flattened(1e-4);
  for (const Flat place : op.at) {
    if (contains(ring, place) || distanceToRing(ring, place) <= kNear) continue;
    return refused(say("The pin at {0} mm, {1} mm is not on “{2}”.", std::round(place.u * 1000),
                       std::round(place.v * 1000), piece.name));
  }
  return {};
}

Result<Document> perform(const Document& before, const PinCloth& op, Context&) {
  Document after = before;
  const auto pin = [&](PieceId piece, Flat place) {
    auto& pins = after.pins[piece];
    if (std::find(pins.begin(), pins.end(), place) == pins.end()) pins.push_back(place);
    after.drape.dirty.insert(piece);
  };
  for (const Flat place : op.at) pin(op.piece.id, place);
  for (const EdgeRef& edge : op.edges) {
    const Outline& outline = before.find(edge.piece.id)->outline;
    const Curve& curve = outline.edges[*outline.find(edge.edge)].curve;
    const int steps = std::max(1, static_cast<int>(std::ceil((edge.to - edge.from) * curve.length() / kPinSpacing)));
    for (int i = 0; i <= steps; ++i)
      pin(edge.piece.id, curve.atFraction(edge.from + (edge.to - edge.from) * i / steps));
  }
  return after;
}

Done resolve(const Document& before, UnpinCloth& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (!before.pins.contains(op.piece.id)) return refused(say("“{0}” has no pins.", before.find(op.piece.id)->name));
  if (!(op.within >= 0 && op.within <= 1)) return refused(say("A pin is looked for within a metre at most."));
  return {};
}

Result<Document> perform(const Document& before, const UnpinCloth& op, Context&) {
  Document after = before;
  auto& pins = after.pins[op.piece.id];
  const std::size_t had = pins.size();
  std::erase_if(pins, [&](Flat pin) {
    return op.at.empty() ||
           std::any_of(op.at.begin(), op.at.end(), [&](Flat place) { return distance(place, pin) <= op.within; });
  });
  if (pins.size() == had) return refused(say("There is no pin within {0} mm of there.", std::round(op.within * 1000)));
  if (pins.empty()) after.pins.erase(op.piece.id);
  after.drape.dirty.insert(op.piece.id);
  return after;
}

}  // namespace karinui

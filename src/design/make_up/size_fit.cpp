#include "karinui/design/size_fit.h"

#include <algorithm>
#include <cmath>

#include "karinui/design/make_up.h"

namespace karinui {

namespace {

using Side = PieceReading::Side;

struct Span {
  double low = 1e9, high = -1e9;
  double width() const { return high - low; }
};

// Of the whole piece, or of one of its parts, across.
Span across(const Piece& piece, const PieceReading& reading, const PiecePart* part = nullptr) {
  Span span;
  const auto add = [&](const Curve& curve) {
    for (const Flat p : curve.flattened(1e-4)) {
      const double u = reading.upright(p).u;
      span.low = std::min(span.low, u), span.high = std::max(span.high, u);
    }
  };
  if (!part)
    for (const Edge& edge : piece.outline.edges) add(edge.curve);
  else if (const auto run = reading.parts.find(*part); run != reading.parts.end())
    for (const std::string& name : run->second.edges)
      if (const Edge* edge = findEdge(piece, name)) add(edge->curve);
  return span;
}

// Under the arms: between the upper ends of the sides, or from one to the centre.
double chest(const Piece& piece, const PieceReading& reading) {
  std::vector<double> ends;
  for (const auto& [side, last] : {std::pair{PiecePart::SidePlus, true}, {PiecePart::SideMinus, false}})
    if (const auto run = reading.parts.find(side); run != reading.parts.end()) {
      const Edge* edge = findEdge(piece, last ? run->second.edges.back() : run->second.edges.front());
      if (edge) ends.push_back(reading.upright(last ? edge->curve.end : edge->curve.start).u);
    }
  if (ends.size() == 2) return std::abs(ends[0] - ends[1]);
  constexpr PiecePart kCentre = PiecePart::Centre;
  const Span centre = across(piece, reading, &kCentre);
  return ends.size() == 1 && centre.width() >= 0 ? std::abs(ends[0] - 0.5 * (centre.low + centre.high)) : 0;
}

double lengthOf(const Piece& piece, const PieceReading& reading, PiecePart part) {
  double sum = 0;
  if (const auto run = reading.parts.find(part); run != reading.parts.end())
    for (const std::string& name : run->second.edges)
      if (const Edge* edge = findEdge(piece, name)) sum += edge->curve.length();
  return sum;
}

// What a piece adds to a girth; 0: it does not go round there.
double shareOf(const Piece& piece, const PieceReading& reading, std::string_view measure) {
  switch (reading.role) {
    case PieceRole::Front:
    case PieceRole::Back:
      return measure == "bust_girth" ? chest(piece, reading) : 0;
    case PieceRole::Leg:
    case PieceRole::LegFront:
    case PieceRole::LegBack:
      return measure == "waist_girth" ? lengthOf(piece, reading, PiecePart::Top) : 0;
    case PieceRole::SkirtFront:
    case PieceRole::SkirtBack:
      return measure == "waist_girth" ? lengthOf(piece, reading, PiecePart::Top)
             : measure == "hip_girth" ? across(piece, reading).width()
                                      : 0;
    default:
      return 0;
  }
}

// Cut in pairs, and its other one is not there.
bool alone(const PieceReadings& readings, PieceId id) {
  const PieceReading& own = readings.at(id);
  return own.side != Side::Both && std::none_of(readings.begin(), readings.end(), [&](const auto& other) {
           return other.first != id && other.second.role == own.role && other.second.side != own.side;
         });
}

}  // namespace

std::optional<SizeFit> sizeFit(const Document& garment, const Measurements* madeOn, const Measurements& figure) {
  const Grading& grading = garment.grading;
  if (grading.pieces.empty()) return std::nullopt;
  const PieceReadings readings = readPieces(garment.pattern);
  SizeFit fit;
  fit.easeKnown = madeOn != nullptr;
  for (const char* measure : {"bust_girth", "waist_girth", "hip_girth"}) {
    const auto body = figure.value.find(measure);
    if (body == figure.value.end()) continue;
    SizeFit::Girth girth{measure, std::vector<double>(grading.sizes.size()), body->second, 0};
    for (const auto& [id, piece] : garment.pattern.pieces) {
      const PieceReading& reading = readings.at(id);
      if (shareOf(*piece, reading, measure) == 0) continue;
      for (std::size_t size = 0; size < grading.sizes.size(); ++size) {
        const auto sized = inSize(*piece, grading, size);
        if (!sized) return std::nullopt;
        girth.ofSizes[size] += shareOf(*sized, reading, measure) * (alone(readings, id) ? 2 : 1);
      }
    }
    const double standing = girth.ofSizes[grading.standing];
    if (standing == 0) continue;
    if (madeOn) {
      const auto before = madeOn->value.find(measure);
      if (before == madeOn->value.end()) continue;
      girth.ease = standing - before->second;
    }
    fit.girths.push_back(std::move(girth));
  }
  if (fit.girths.empty()) return std::nullopt;
  const auto largest = [&](std::size_t size) {
    double most = 0;
    for (const SizeFit::Girth& girth : fit.girths) most = std::max(most, std::abs(girth.miss(size)));
    return most;
  };
  for (std::size_t size = 1; size < grading.sizes.size(); ++size)
    if (largest(size) < largest(fit.nearest)) fit.nearest = size;
  return fit;
}

}  // namespace karinui

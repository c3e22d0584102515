#include "session/zip_slider.h"

#include <algorithm>
#include <cmath>

#include "karinui/pattern/seam_walk.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kPlacesApart = 0.001;  // metres between the places that are looked at

// How far a place is from where the hand points: radians of a ray, else metres.
double awayFrom(const PointerSample& sample, const TableLayout& table, const ZipPlace::Side& side) {
  if (sample.where == PointerSample::Where::Table) return distance(sample.place, side.paper + table.at(side.piece));
  if (sample.tip) return distance(sample.tip->carry, side.space);
  const Vec3 way = side.space - sample.ray.origin;
  const double along = dot(way, sample.ray.direction);
  if (along <= 0) return HUGE_VAL;
  return length(way - sample.ray.direction * along) / along;
}

double awayFromEither(const PointerSample& sample, const TableLayout& table, const ZipPlace& place) {
  return std::fmin(awayFrom(sample, table, place.over), awayFrom(sample, table, place.under));
}

}  // namespace

std::optional<ZipWay> ZipWay::of(const Document& document, const std::string& name) {
  const auto own = document.allowances.fastenings.find(name);
  if (own == document.allowances.fastenings.end() || own->second.kind != FasteningKind::Zip) return std::nullopt;
  const Fastening& zip = own->second;
  ZipWay way;
  way.name_ = name;
  way.whole_ = lengthOf(document.pattern, zip);
  way.closed_ = way.whole_ * zip.zipped;
  if (!(way.whole_ > kPlacesApart)) return std::nullopt;
  std::map<PieceId, Stand> stands;
  const SeamSide over(document.pattern, zip.a, false), under(document.pattern, zip.b, zip.reversed);
  const int steps = static_cast<int>(std::ceil(way.whole_ / kPlacesApart));
  for (int k = 0; k <= steps; ++k) {
    const double closed = static_cast<double>(k) / steps;
    const double share = zip.fromStart ? 1 - closed : closed;
    ZipPlace place;
    for (const auto& [side, walk] : {std::pair(&place.over, &over), std::pair(&place.under, &under)}) {
      const SeamPlace at = walk->at(std::lerp(zip.at[0], zip.at[1], share));
      const Curve* curve = curveOf(document.pattern, at.piece, at.edge);
      if (!curve) return std::nullopt;
      auto stand = stands.find(at.piece);
      if (stand == stands.end()) stand = stands.emplace(at.piece, Stand(*document.find(at.piece))).first;
      *side = {at.piece, curve->atFraction(at.fraction), {}};
      side->space = stand->second(side->paper);
    }
    way.places_.push_back(place);
  }
  return way;
}

ZipPlace ZipWay::at(double closed) const {
  const double share = std::clamp(closed / whole_, 0.0, 1.0);
  return places_[static_cast<std::size_t>(std::lround(share * static_cast<double>(places_.size() - 1)))];
}

double ZipWay::drawnTo(const PointerSample& sample, const TableLayout& table) const {
  std::size_t best = 0;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (const double away = awayFromEither(sample, table, places_[k]); away < least) least = away, best = k;
  const double closed = whole_ * static_cast<double>(best) / static_cast<double>(places_.size() - 1);
  if (closed < kDragStep / 2) return 0;
  if (closed > whole_ - kDragStep / 2) return whole_;
  return std::round(closed / kDragStep) * kDragStep;
}

double ZipWay::away(const PointerSample& sample, const TableLayout& table) const {
  return awayFromEither(sample, table, at(closed_));
}

std::vector<ZipWay> zipsOf(const Document& document) {
  std::vector<ZipWay> all;
  for (const auto& [name, own] : document.allowances.fastenings)
    if (auto way = ZipWay::of(document, name)) all.push_back(*std::move(way));
  return all;
}

}  // namespace karinui

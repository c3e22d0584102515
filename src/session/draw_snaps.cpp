#include "session/draw_snaps.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kPlace = 0.012, kLine = 0.009;  // metres from which a place, a line draws
constexpr double kStride = 0.006;                // metres between places of an outline
constexpr double kSkin = 0.06;                   // metres from the skin at which cloth still lies on it

}  // namespace

void DrawSnaps::of(FittingPtr fitting) {
  if (fitting == fitting_) return;
  fitting_ = std::move(fitting);
  corners_.clear();
  outlines_.clear();
  if (!fitting_->body) return;
  const Body& body = *fitting_->body;
  const auto onSkin = [&](Vec3 p) { return body.bvh().nearest(p, kSkin); };
  for (const auto& [id, piece] : fitting_->document.pattern.pieces) {
    const Stand stand(*piece);
    for (const Edge& edge : piece->outline.edges) {
      if (const auto skin = onSkin(stand(edge.curve.start)))
        corners_.push_back(
            {skin->place, skin->point, say("At a corner of “{0}”; with Alt freely.", piece->name), true});
      Outline line{{}, say("Along the outline of “{0}”; with Alt freely.", piece->name)};
      const int steps = std::max(1, static_cast<int>(edge.curve.length() / kStride));
      for (const Flat p : edge.curve.evenly(0, 1, steps))
        if (const auto skin = onSkin(stand(p))) line.points.push_back(skin->point);
      if (line.points.size() > 1) outlines_.push_back(std::move(line));
    }
  }
  for (const auto& [name, place] : body.landmarks())
    if (const auto skin = onSkin(place))
      corners_.push_back({skin->place, skin->point, say("At the landmark {0}; with Alt freely.", name), true});
}

std::optional<DrawSnaps::Snap> DrawSnaps::on(const Outline& outline, Vec3 place, double within) const {
  double nearest = within;
  Vec3 best;
  for (std::size_t i = 0; i + 1 < outline.points.size(); ++i) {
    const Vec3 from = outline.points[i], side = outline.points[i + 1] - from;
    const double ss = squaredLength(side);
    const Vec3 p = from + side * (ss > 0 ? std::clamp(dot(place - from, side) / ss, 0.0, 1.0) : 0.0);
    if (const double away = distance(p, place); away < nearest) nearest = away, best = p;
  }
  if (nearest >= within) return std::nullopt;
  const auto skin = fitting_->body->bvh().nearest(best, kSkin);
  return skin ? std::optional(Snap{skin->place, skin->point, outline.what, false}) : std::nullopt;
}

std::optional<DrawSnaps::Snap> DrawSnaps::near(Vec3 place) const {
  const Snap* best = nullptr;
  for (const Snap& corner : corners_)
    if (distance(corner.point, place) < (best ? distance(best->point, place) : kPlace)) best = &corner;
  if (best) return *best;
  std::optional<Snap> found;
  for (const Outline& outline : outlines_)
    if (auto snap = on(outline, place, found ? distance(found->point, place) : kLine)) found = snap;
  if (found || !fitting_ || !fitting_->body || std::fabs(place.x) > kLine) return found;
  const auto skin = fitting_->body->bvh().nearest({0, place.y, place.z}, kSkin);
  if (!skin || fitting_->body->describe(skin->place).part != BodyPoint::Part::Torso) return std::nullopt;
  return Snap{skin->place, skin->point, say("On the figure's middle; with Alt freely."), false};
}

std::optional<std::vector<DrawSnaps::Snap>> DrawSnaps::along(const std::vector<Vec3>& places) const {
  for (const Outline& outline : outlines_) {
    std::vector<Snap> run;
    for (const Vec3 place : places) {
      const auto snap = on(outline, place, kLine);
      if (!snap) break;
      run.push_back(*snap);
    }
    if (!places.empty() && run.size() == places.size()) return run;
  }
  return std::nullopt;
}

}  // namespace karinui

#include "session/draw_snaps.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kPlace = 0.012, kLine = 0.009;     // metres from which a place, a line snaps, seen from near
constexpr double kPointed = 0.4, kAlongside = 0.8;  // of touching: a line that is pointed at, or followed
constexpr double kSame = 0.01;                      // metres: a crossing this near to a landmark is that landmark
constexpr double kOnLine = 0.016;                   // metres from a line at which a place lies on it
constexpr double kStride = 0.006;                   // metres between places of an outline
constexpr double kOffSkin = 0.15;                   // metres from the skin at which an edge can still be drawn to
constexpr double kDeep = 0.07;     // metres of depth at the silhouette between a ray and what it snaps to
constexpr double kHidden = 0.03;   // metres an edge may lie behind what the ray meets first
constexpr double kFollows = 0.06;  // metres: less is crossed, not followed
constexpr double kEven = 0.35;     // a followed line is run along at no less than this of the hand's pace

// Of touching: from afar a finger covers more.
double within(double metres, double share, const StrokeSample& sample) {
  return std::max(metres, share * sample.touching());
}

double deepOf(const StrokeSample& sample, Vec3 place) { return dot(place - sample.ray.origin, sample.ray.direction); }

// Whether the sample may mean a place of the skin, or of cloth that lies off it, and not one behind the body.
bool sees(const StrokeSample& sample, Vec3 place, bool cloth, double across) {
  const double behind = deepOf(sample, place) - sample.along;
  if (!sample.certain) return std::fabs(behind) < (cloth ? kOffSkin : kDeep);
  return cloth ? behind < kHidden && behind > -kOffSkin : distance(place, sample.point) < 1.5 * across;
}

}  // namespace

void DrawSnaps::of(SnapshotPtr snapshot) {
  if (snapshot == fitting_) return;
  fitting_ = std::move(snapshot);
  places_.clear();
  curves_.clear();
  if (!fitting_->body) return;
  const Body& body = *fitting_->body;
  const auto shown = [&](const SurfacePoint& skin, Vec3 there) {
    return !fitting_->visible || fitting_->visible->showsSkin(skin, there);
  };
  const auto place = [&](Vec3 seen, Message what, bool cloth) {
    const auto skin = body.bvh().nearest(seen, kOffSkin);
    if (skin && shown(skin->place, skin->point))
      places_.push_back({{skin->place, skin->point, seen, std::move(what), std::nullopt, true}, cloth});
  };
  for (const auto& [id, piece] : fitting_->document.pattern.pieces) {
    const Stand stand(*piece);
    for (const Edge& edge : piece->outline.edges) {
      place(stand(edge.curve.start), say("At a corner of “{0}”; with Alt freely.", piece->name), true);
      Curve curve;
      curve.what = say("Along the outline of “{0}”; with Alt freely.", piece->name);
      const int steps = std::max(1, static_cast<int>(edge.curve.length() / kStride));
      for (const Flat p : edge.curve.evenly(0, 1, steps)) {
        const Vec3 seen = stand(p);
        const auto skin = body.bvh().nearest(seen, kOffSkin);
        if (!skin || !shown(skin->place, skin->point)) continue;
        if (!curve.line.points.empty()) curve.line.length += distance(curve.line.points.back(), seen);
        curve.line.points.push_back(seen), curve.skin.push_back(skin->point);
      }
      if (curve.line.points.size() > 1) curves_.push_back(std::move(curve));
    }
  }
  for (const BodyLine& line : body.lines()) {
    Curve curve{line, {}, say("Along the {0}; with Alt freely.", bodyLineSaid(line.name)), {}};
    for (const Vec3 p : line.points) {
      const auto skin = fitting_->visible ? body.bvh().nearest(p) : std::nullopt;
      curve.hidden.push_back(skin && !shown(skin->place, skin->point));
    }
    curves_.push_back(std::move(curve));
  }
  for (const auto& [name, there] : body.landmarks())
    place(there, say("At the landmark {0}; with Alt freely.", name), false);
  if (crossedOf_ != fitting_->body) crossedOf_ = fitting_->body, crossings_ = lineCrossings(body);
  for (const LineCrossing& crossing : crossings_) {
    const BodyLine &a = body.lines()[crossing.a], &b = body.lines()[crossing.b];
    const bool known = std::any_of(places_.begin(), places_.end(), [&](const Place& p) {
      return !p.cloth && distance(p.snap.seen, crossing.place) < kSame;
    });
    if (known) continue;
    BodyPoint named;
    named.part = BodyPoint::Part::Line;
    named.landmark = a.name;
    named.along = std::round(crossing.onA * 1e4) / 1e4;
    const auto skin = body.find(named);
    if (!skin || !shown(*skin, crossing.place)) continue;
    const Vec3 point = karinui::at(body.mesh(), *skin);
    places_.push_back(
        {{*skin, point, point,
          say("Where {0} and {1} cross; with Alt freely.", bodyLineSaid(a.name), bodyLineSaid(b.name)), named, true},
         false,
         true});
  }
}

// The place of a curve nearest to the sample's ray, of those it may mean.
std::optional<DrawSnaps::Followed> DrawSnaps::onCurve(std::size_t which, const StrokeSample& sample, double share,
                                                      double& away) const {
  const Curve& curve = curves_[which];
  const bool cloth = !curve.skin.empty();
  const auto& points = curve.line.points;
  const std::size_t n = points.size();
  const double most = sample.certain && !cloth ? within(kLine, 0.3, sample) : within(kLine, share, sample);
  away = most;
  std::optional<Followed> best;
  double done = 0;
  for (std::size_t i = 0; i + (curve.line.closed ? 0 : 1) < n; ++i) {
    if (i < curve.hidden.size() && (curve.hidden[i] || curve.hidden[(i + 1) % n])) continue;
    const Vec3 a = points[i], side = points[(i + 1) % n] - a, d = sample.ray.direction;
    const Vec3 across = side - d * dot(side, d), from = (a - sample.ray.origin);
    const Vec3 off = from - d * dot(from, d);
    const double ss = squaredLength(across), step = karinui::length(side);
    const double t = ss > 1e-18 ? std::clamp(-dot(off, across) / ss, 0.0, 1.0) : 0.0;
    const double far = karinui::length(off + across * t);
    if (far < away && sees(sample, a + side * t, cloth, most)) {
      away = far;
      const Vec3 skin = cloth ? lerp(curve.skin[i], curve.skin[(i + 1) % n], t) : a + side * t;
      best = Followed{which, curve.line.length > 0 ? std::min(1.0, (done + t * step) / curve.line.length) : 0,
                      fitting_->body->bvh().nearest(skin)->point};
    }
    done += step;
  }
  return best;
}

DrawSnaps::Snap DrawSnaps::on(std::size_t which, double share) const {
  const Curve& curve = curves_[which];
  Snap snap;
  snap.seen = curve.line.at(share);
  const auto skin = fitting_->body->bvh().nearest(snap.seen);
  snap.skin = skin->place, snap.point = skin->point;
  snap.what = curve.what;
  if (!curve.line.name.empty()) {
    BodyPoint named;
    named.part = BodyPoint::Part::Line;
    named.landmark = curve.line.name;
    named.along = std::round(share * 1e4) / 1e4;
    snap.named = named;
    snap.skin = *fitting_->body->find(named);
    snap.point = snap.seen = karinui::at(fitting_->body->mesh(), snap.skin);
  }
  return snap;
}

std::optional<double> DrawSnaps::shareOf(std::size_t curve, Vec3 point) const {
  double away = 0;
  const double share = curves_[curve].line.nearest(point, away);
  return away < kOnLine ? std::optional(share) : std::nullopt;
}

std::optional<std::size_t> DrawSnaps::lineThrough(Vec3 from, Vec3 to) const {
  for (std::size_t k = 0; k < curves_.size(); ++k)
    if (curves_[k].skin.empty() && shareOf(k, from) && shareOf(k, to)) return k;
  return std::nullopt;
}

std::optional<DrawSnaps::Snap> DrawSnaps::near(const StrokeSample& sample, bool linesShown) const {
  if (!fitting_ || !fitting_->body) return std::nullopt;
  const Place* best = nullptr;
  double least = 1e9;
  for (const bool cloth : {true, false}) {  // what is sewn to comes before the figure's own places
    for (const Place& place : places_) {
      const double most = cloth ? within(kPlace, 0.8, sample) : within(kPlace, 0.4, sample);
      const double away = awayFromRay(sample.ray, place.snap.seen);
      if (place.crossing && !linesShown) continue;
      if (place.cloth == cloth && away < std::min(most, least) && sees(sample, place.snap.seen, cloth, most))
        best = &place, least = away;
    }
    if (best) return best->snap;
  }
  std::optional<Followed> found;
  bool outline = false;
  for (std::size_t k = 0; k < curves_.size(); ++k) {
    double away = 0;
    const bool ofTheBody = curves_[k].skin.empty();
    if (ofTheBody && (outline || (!linesShown && sample.certain))) break;  // outlines come first
    if (const auto there = onCurve(k, sample, kPointed, away); there && (!found || away < least)) {
      found = there, least = away;
      outline = !ofTheBody;
    }
  }
  if (found) return on(found->curve, found->share);
  if (std::fabs(sample.point.x) > kLine) return std::nullopt;
  const auto skin = fitting_->body->bvh().nearest({0, sample.point.y, sample.point.z}, kOffSkin);
  if (!skin || fitting_->body->describe(skin->place).part != BodyPoint::Part::Torso) return std::nullopt;
  return Snap{skin->place, skin->point, skin->point, say("On the figure's middle; with Alt freely."), {}, false};
}

std::vector<std::optional<DrawSnaps::Followed>> DrawSnaps::followed(std::span<const StrokeSample> run) const {
  std::vector<std::optional<Followed>> best(run.size());
  std::vector<double> longest(run.size(), 0);  // of the stretch a sample belongs to
  if (!fitting_ || !fitting_->body) return best;
  const std::vector<Vec3> picture = pictureOf(run);
  for (std::size_t k = 0; k < curves_.size(); ++k) {
    std::vector<std::optional<Followed>> here;
    for (const StrokeSample& sample : run) {
      double away = 0;
      here.push_back(onCurve(k, sample, kAlongside, away));
    }
    for (std::size_t from = 0, to = 0; from < run.size(); from = to) {
      to = from + 1;
      if (!here[from]) continue;
      double way = 0;
      std::size_t next = to;  // over a waver
      for (double gap = 0; next < run.size() && gap < run[next].touching(); ++next) {
        gap += distance(picture[next - 1], picture[next]);
        if (here[next]) way += gap, gap = 0, to = next + 1;
      }
      // Crossed lines are met by a few samples that stay at one place of them.
      double along = std::fabs(here[to - 1]->share - here[from]->share);
      if (curves_[k].line.closed) along = std::min(along, 1 - along);
      along *= curves_[k].line.length;
      if (distance(picture[from], picture[to - 1]) < kFollows ||
          along < kEven * distance(picture[from], picture[to - 1]))
        continue;
      const double weight = way * (curves_[k].skin.empty() ? 1 : 1.5);
      for (std::size_t i = from; i < to; ++i) {
        // An outline that was drawn along this very line is not held against it: then both pieces lie on the line.
        const bool same = best[i] && here[i] && curves_[k].skin.empty() && !curves_[best[i]->curve].skin.empty() &&
                          distance(best[i]->point, here[i]->point) < kLine;
        if (weight * (same ? 2 : 1) > longest[i]) longest[i] = weight, best[i] = here[i];
      }
    }
  }
  return best;
}

}  // namespace karinui

#include "karinui/body/body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "body/anthropometry/anthropometry.h"
#include "body/chart.h"
#include "karinui/base/hash.h"
#include "karinui/base/result.h"
#include "karinui/body/lines.h"

namespace karinui {

namespace {

using Part = BodyPoint::Part;
constexpr double kSamePlace = 1e-4;      // metres: a chart place that comes back this near is the same
constexpr double kOnSkin = 1e-9;         // metres: nearer than this a landmark lies on the skin and stays, bit for bit
constexpr double kArmpitLevel = 6;       // of the torso's chart
constexpr double kBelowArmpit = 0.0036;  // of the height: at the armpit itself arm and trunk are not yet apart
constexpr double kTrunkToArm = 0.03;     // metres between trunk and arm

std::string hashOf(const Body::Parts& parts) {
  Hasher hasher;
  hasher.add(std::span<const Vec3>(parts.mesh.points)).add(std::span<const Triangle>(parts.mesh.faces));
  for (const auto& [name, place] : parts.landmarks) hasher.add(name).add(place.x).add(place.y).add(place.z);
  return hasher.hex();
}

Done usable(const TriangleMesh& mesh) {
  if (mesh.faces.empty()) return badInput(say("The body has no surface."));
  for (const Vec3& p : mesh.points)
    if (!finite(p)) return badInput(say("The body has a point that is not a number."));
  for (const Triangle& f : mesh.faces)
    for (const std::uint32_t i : f)
      if (i >= mesh.points.size()) return badInput(say("The body has a face with a corner that does not exist."));
  return {};
}

using Chart = Body::Parts::Template;

// The skin of a part is where its ray first leaves the body.
std::optional<SurfacePoint> skinOn(const Bvh& bvh, const Chart& chart, Part part, const ChartRay& ray, double around) {
  for (const Bvh::Hit& hit : bvh.all(ray.from, normalized(ray.towards(around)))) {
    if (hit.along > chart.reach(part)) break;
    if (!hit.outside) return hit.place;
  }
  return std::nullopt;
}

// How a part's chart names a place, if find comes back to it.
std::optional<BodyPoint> namedOn(const Body& body, const Chart& chart, Part part, Vec3 place) {
  for (const double along : chart.alongOf(part, place)) {
    const ChartRay ray = chart.at(part, along);
    const Vec3 q = place - ray.from;
    const double turns = std::atan2(dot(q, ray.side), dot(q, ray.front)) / (2 * std::numbers::pi);
    BodyPoint point;
    point.part = part;
    point.along = along;
    point.around = turns < 0 ? turns + 1 : turns;
    if (point.around >= 1) point.around = 0;
    if (const auto back = body.find(point); back && distance(at(body.mesh(), *back), place) < kSamePlace) return point;
  }
  return std::nullopt;
}

// A chest that is widest right under the armpit, as of most men, pushes the chart's armpit, which lies a little above
// the bust, above that of the skin. A ray to the side then goes on through the arm. What is named by a level up to the
// armpit is the trunk's: where `place`, what the ray meets, is the arm's or nothing, it is taken right under the
// armpit.
std::optional<SurfacePoint> underArmpit(const Body& body, const Chart& chart, const BodyPoint& point, ChartRay ray,
                                        const std::optional<SurfacePoint>& place) {
  const auto armpit = body.measured().value.find("armpit_height");
  if (point.part != Part::Torso || point.along > kArmpitLevel || armpit == body.measured().value.end()) return place;
  const double floor = chart.level[0].back().centre.y + 0.001 * chart.height - chart.height;  // below the crown
  if (ray.from.y <= floor + armpit->second) return place;
  ray.from.y = floor + armpit->second - kBelowArmpit * chart.height;
  const auto under = skinOn(body.bvh(), chart, point.part, ray, point.around);
  if (!place || !under) return under ? under : place;
  const Vec3 here = at(body.mesh(), *place);
  const bool arm = distance(at(body.mesh(), *under), here) > kTrunkToArm &&
                   (namedOn(body, chart, Part::LeftArm, here) || namedOn(body, chart, Part::RightArm, here));
  return arm ? under : place;
}

}  // namespace

Body::Body(Parts parts, Bvh bvh, std::string hash)
    : parts_(std::move(parts)), bvh_(std::move(bvh)), hash_(std::move(hash)) {}
Body::~Body() = default;

Result<std::shared_ptr<const Body>> Body::make(Parts parts) {
  if (const Done ok = usable(parts.mesh); !ok) return ok.error();
  if (const Done closed = DistanceField::buildable(parts.mesh, {}); !closed) return closed.error();
  Bvh bvh(parts.mesh);
  if (!parts.own && (!parts.chart || parts.measured.value.empty() || parts.landmarks.empty())) {
    const Anthropometry measured = anthropometryOf(parts.mesh);
    if (!parts.chart) parts.chart = chartOf(measured);
    if (parts.measured.value.empty()) parts.measured = measure(parts.mesh, bvh);
    if (parts.landmarks.empty()) parts.landmarks = measured.landmark;
  }
  for (auto& [name, place] : parts.landmarks)  // landmarks lie on the skin
    if (const auto near = bvh.nearest(place); near && near->distance > kOnSkin) place = near->point;
  std::string hash = hashOf(parts);
  return std::make_shared<const Body>(std::move(parts), std::move(bvh), std::move(hash));
}

const DistanceField& Body::field() const {
  if (const DistanceField* ready = field_.load(std::memory_order_acquire)) return *ready;
  const std::lock_guard lock(making_);  // a second asker waits for the first
  if (!made_) {
    auto field = DistanceField::of(parts_.mesh, bvh_, {});
    KARINUI_ASSERT(field);  // make() has seen that it can be built
    made_ = std::make_unique<const DistanceField>(*std::move(field));
    field_.store(made_.get(), std::memory_order_release);
  }
  return *made_;
}

Done Body::prepareField(Workers& workers, const Token& token) const { return field().findAll(workers, token); }

std::vector<double> Body::chartNumbers() const {
  return parts_.chart ? numbersOf(*parts_.chart) : std::vector<double>();
}

std::shared_ptr<const Body::Parts::Template> Body::chartFrom(std::span<const double> numbers) {
  return templateFrom(numbers);
}

const std::vector<BodyLine>& Body::lines() const {
  std::call_once(drawing_, [this] {
    std::vector<BodyLine> found = parts_.own ? parts_.own->lines() : findBodyLines(*this);
    if (parts_.own)
      for (BodyLine& line : found) {
        line.length = 0;
        for (std::size_t k = 0; k < line.points.size(); ++k) {
          line.points[k] = at(parts_.mesh, parts_.own->bvh().nearest(line.points[k])->place);
          if (k > 0) line.length += distance(line.points[k - 1], line.points[k]);
        }
        if (line.closed) line.length += distance(line.points.back(), line.points.front());
      }
    lines_ = std::make_unique<const std::vector<BodyLine>>(std::move(found));
  });
  return *lines_;
}

namespace {

// Whether a body ends before this limb, as a dress form does.
bool lacks(const Body& body, BodyPoint::Part part) {
  using enum BodyPoint::Part;
  const char* end = part == LeftArm    ? "wrist_left"
                    : part == RightArm ? "wrist_right"
                    : part == LeftLeg  ? "ankle_left"
                    : part == RightLeg ? "ankle_right"
                                       : nullptr;
  return end && !body.landmarks().contains(end);
}

}  // namespace

Result<SurfacePoint> Body::find(const BodyPoint& point) const {
  if (parts_.own) return parts_.own->find(point);
  if (point.part == Part::Line) {
    const BodyLine* line = bodyLine(*this, point.landmark);
    if (!line) return notFound(say("This body has no line called \"{0}\".", point.landmark));
    if (!(point.along >= 0 && point.along <= 1))
      return badInput(say("The place {0} lies beyond its line, which runs from 0 to 1.", text(point)));
    return bvh_.nearest(line->at(point.along))->place;
  }
  if (point.part == Part::Landmark) {
    const auto it = parts_.landmarks.find(point.landmark);
    if (it == parts_.landmarks.end()) return notFound(say("This body has no landmark called \"{0}\".", point.landmark));
    return bvh_.nearest(it->second)->place;
  }
  if (point.part == Part::Face) {
    if (point.onFace.face >= parts_.mesh.faces.size())
      return notFound(say("This body has no face {0}.", static_cast<long long>(point.onFace.face)));
    return point.onFace;
  }
  if (!parts_.chart)
    return refused(say("On this body torso and limbs could not be found; only landmarks and faces name a place."));
  const double top = static_cast<double>(chartLevels(point.part).size() - 1);
  if (!(point.along >= 0 && point.along <= top) || !std::isfinite(point.around))
    return badInput(say("The place {0} lies beyond its part of the body.", text(point)));
  const ChartRay ray = parts_.chart->at(point.part, point.along);
  if (const auto place =
          underArmpit(*this, *parts_.chart, point, ray, skinOn(bvh_, *parts_.chart, point.part, ray, point.around)))
    return *place;
  if (lacks(*this, point.part))
    return refused(point.part == Part::LeftArm || point.part == Part::RightArm
                       ? say("This body has no arms, as a dress form has none, and so no place {0}; stand what comes "
                             "there on the whole figure (body form=no).",
                             text(point))
                       : say("This body has no legs, as a dress form has none, and so no place {0}; stand what comes "
                             "there on the whole figure (body form=no).",
                             text(point)));
  return refused(say("There is no skin at {0} on this body: there it runs into another part.", text(point)));
}

BodyPoint Body::describe(const SurfacePoint& place) const {
  if (parts_.own) return parts_.own->describe(place);
  if (parts_.chart) {
    static constexpr std::array kOrder{Part::LeftArm, Part::RightArm, Part::LeftLeg, Part::RightLeg, Part::Torso};
    for (const Part part : kOrder)
      if (const auto point = namedOn(*this, *parts_.chart, part, at(parts_.mesh, place))) return *point;
  }
  BodyPoint point;
  point.part = Part::Face;
  point.onFace = place;
  return point;
}

Result<BodyPoint> Body::mirrored(const BodyPoint& point) const {
  if (parts_.own) return parts_.own->mirrored(point);
  BodyPoint out = point;
  switch (point.part) {
    case Part::Line: {
      out.landmark = mirroredName(point.landmark);
      const BodyLine* line = bodyLine(*this, out.landmark);
      if (!line) return notFound(say("This body has no line called \"{0}\".", out.landmark));
      if (line->closed && line->name == point.landmark) out.along = point.along == 0 ? 0 : 1 - point.along;
      return out;
    }
    case Part::Landmark: {
      out.landmark = mirroredName(point.landmark);
      if (!parts_.landmarks.contains(out.landmark))
        return notFound(say("This body has no landmark called \"{0}\".", out.landmark));
      return out;
    }
    case Part::Face: {
      const auto here = find(point);
      if (!here) return here.error();
      Vec3 p = at(parts_.mesh, *here);
      p.x = -p.x;
      out.onFace = bvh_.nearest(p)->place;
      return out;
    }
    case Part::LeftArm:
      out.part = Part::RightArm;
      break;
    case Part::RightArm:
      out.part = Part::LeftArm;
      break;
    case Part::LeftLeg:
      out.part = Part::RightLeg;
      break;
    case Part::RightLeg:
      out.part = Part::LeftLeg;
      break;
    case Part::Torso:
      break;
  }
  out.around = point.around == 0 ? 0 : 1 - point.around;
  return out;
}

}  // namespace karinui

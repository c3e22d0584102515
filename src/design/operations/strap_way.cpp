#include "design/operations/strap_way.h"

#include <algorithm>
#include <cmath>

#include "design/operations/new_piece.h"
#include "karinui/body/lines.h"
#include "karinui/geometry/geodesic.h"
#include "karinui/geometry/section.h"
#include "karinui/pattern/edit.h"

namespace karinui {

namespace {

constexpr double kWayStep = 0.005;    // metres between places of the way
constexpr double kSkinAbout = 0.015;  // metres to either side whose skin gives a place its direction outwards
constexpr double kOffSkin = 0.004;    // metres a strap stands off the skin and the cloth below it
constexpr double kNearCloth = 0.04;   // metres from the skin within which cloth lies below the strap
constexpr double kBlend = 0.08;       // metres over which a strap goes from where its edge stands to the skin
constexpr double kNearestNeck = 0.2;  // shares of the shoulder's length between which a strap stays on it
constexpr double kNearestTip = 0.6;   // nearer to the tip it slips off
constexpr double kShoulderStep = 0.05;
constexpr double kOnCentre = 0.03;  // turns from the centre line within which an end is on neither side
constexpr double kOffBody = 0.03;   // metres from the skin beyond which an edge does not lie on what is nearest to it

// Places of a way, and the direction away from the body at each.
struct WayLine {
  std::vector<Vec3> place, out;
};

std::optional<SurfacePoint> skinNear(const Body& body, Vec3 place) {
  const auto near = body.bvh().nearest(place);
  return near ? std::optional(near->place) : std::nullopt;
}

// The shortest ways over the skin from place to place, one after another.
Result<SurfacePath> shortestOver(const SurfaceGuide& skin, const std::vector<SurfacePoint>& through) {
  SurfacePath all;
  for (std::size_t k = 0; k + 1 < through.size(); ++k) {
    const auto part = skin.straight(through[k], through[k + 1]);
    if (!part) return part.error();
    const auto from = part->places.begin() + (all.empty() ? 0 : 1);
    all.places.insert(all.places.end(), from, part->places.end());
    all.points.insert(all.points.end(), part->points.begin() + (from - part->places.begin()), part->points.end());
    all.length += part->length;
  }
  return all;
}

// Every few millimetres; the directions outwards are the mean of the skin about each place.
WayLine onSkin(const Body& body, const SurfacePath& path) {
  const int count = std::max(2, static_cast<int>(std::ceil(path.length / kWayStep)));
  const int about = static_cast<int>(std::ceil(kSkinAbout / kWayStep));
  WayLine line;
  std::vector<Vec3> normals;
  for (int k = 0; k <= count; ++k) {
    const SurfacePoint place = along(body.mesh(), path, static_cast<double>(k) / count);
    line.place.push_back(at(body.mesh(), place));
    normals.push_back(faceNormal(body.mesh(), place.face));
  }
  for (int k = 0; k <= count; ++k) {
    Vec3 sum;
    for (int j = std::max(0, k - about); j <= std::min(count, k + about); ++j)
      sum += normals[static_cast<std::size_t>(j)];
    line.out.push_back(normalized(sum));
  }
  return line;
}

// A string drawn taut over the places: what lies below the straight line between its neighbours falls away.
WayLine drawnTaut(const WayLine& line) {
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < line.place.size(); ++k) {
    while (kept.size() >= 2) {
      const std::size_t last = kept.back(), before = kept[kept.size() - 2];
      const Vec3 way = line.place[k] - line.place[before], off = line.place[last] - line.place[before];
      if (dot(off - way * (dot(off, way) / dot(way, way)), line.out[last]) > 0) break;
      kept.pop_back();
    }
    kept.push_back(k);
  }
  WayLine taut;
  for (const std::size_t k : kept) taut.place.push_back(line.place[k]), taut.out.push_back(line.out[k]);
  return taut;
}

WayLine evenlyAlong(const WayLine& line) {
  const double whole = lineLength(line.place, false);
  const int count = std::max(2, static_cast<int>(std::ceil(whole / kWayStep)));
  WayLine even;
  std::size_t k = 0;
  double done = 0;
  for (int i = 0; i <= count; ++i) {
    const double wished = whole * i / count;
    while (k + 2 < line.place.size() && done + distance(line.place[k], line.place[k + 1]) < wished)
      done += distance(line.place[k], line.place[k + 1]), ++k;
    const double part = distance(line.place[k], line.place[k + 1]),
                 t = part > 0 ? std::clamp((wished - done) / part, 0.0, 1.0) : 0.0;
    even.place.push_back(lerp(line.place[k], line.place[k + 1], t));
    even.out.push_back(normalized(lerp(line.out[k], line.out[k + 1], t)));
  }
  return even;
}

// Off the skin, and off the cloth that lies on it.
WayLine standingOff(WayLine line, const Bvh* cloth, double clear) {
  for (std::size_t k = 0; k < line.place.size(); ++k) {
    double off = 0;
    if (cloth)
      for (const Bvh::Hit& hit : cloth->all(line.place[k], line.out[k]))
        if (hit.along < kNearCloth) off = hit.along;
    line.place[k] += line.out[k] * (off + clear);
  }
  return line;
}

// Moved outwards until it is clear of the skin, and of the cloth on it.
Vec3 clearOf(const Body& body, const Bvh* cloth, Vec3 place, Vec3 out) {
  for (int i = 0; i < 4; ++i) {
    const double clear = body.bvh().signedDistance(place);
    if (clear >= kOffSkin - 1e-4) break;
    place += out * (kOffSkin - clear);
  }
  double off = 0;
  if (cloth)
    for (const Bvh::Hit& hit : cloth->all(place - out * kNearCloth, out))
      if (hit.along < 2 * kNearCloth) off = hit.along - kNearCloth + kOffSkin;
  return place + out * std::fmax(off, 0);
}

// As far as a strap goes from the skin towards an edge that stands elsewhere: farther it would be stretched.
Vec3 within(Vec3 way) {
  constexpr double kReach = 0.02;  // metres
  return way * std::fmin(1, kReach / std::fmax(length(way), 1e-9));
}

Vec3 wayAt(const std::vector<Vec3>& line, std::size_t k) {
  return normalized(line[std::min(k + 1, line.size() - 1)] - line[k > 0 ? k - 1 : 0]);
}

// Nothing: straight across.
std::optional<BodyPoint> usualWay(const Body& body, const StrapEnd& from, const StrapEnd& to) {
  const auto a = skinNear(body, from.middle), b = skinNear(body, to.middle);
  if (!a || !b) return std::nullopt;
  const BodyPoint one = body.describe(*a), other = body.describe(*b);
  if (one.part != BodyPoint::Part::Torso || other.part != BodyPoint::Part::Torso) return std::nullopt;
  const auto turns = [](double around) { return around > 0.5 ? around - 1 : around; };  // left of the front is > 0
  const double here = turns(one.around), there = turns(other.around);
  const bool front = std::fabs(here) < 0.25, otherFront = std::fabs(there) < 0.25;
  if (!front && !otherFront) return std::nullopt;
  if (front && otherFront) return parseBodyPoint("landmark:neck_back").value();
  // Over the shoulder on the side of the end that is in front; one on the centre line leaves it to the other.
  const double inFront = front ? here : there, behind = front ? there : here;
  const double side = std::fabs(inFront) > kOnCentre ? inFront : behind;
  BodyPoint best;
  best.part = BodyPoint::Part::Line;
  best.landmark = side >= 0 ? "shoulder_left" : "shoulder_right";
  if (!bodyLine(body, best.landmark)) return std::nullopt;
  const SurfaceGuide skin(body.mesh());
  double least = 1e9;
  for (int k = 0; kNearestNeck + k * kShoulderStep < kNearestTip + 1e-9; ++k) {
    BodyPoint over = best;
    over.along = std::round((kNearestNeck + k * kShoulderStep) * 100) / 100;  // to be read in a record
    const auto place = body.find(over);
    const auto path = place ? shortestOver(skin, {*a, *place, *b}) : Result<SurfacePath>(place.error());
    if (path && path->length < least) least = path->length, best.along = over.along;
  }
  return least < 1e9 ? std::optional(best) : std::nullopt;
}

// An end that stands off the body beside a limb, as the waist of trousers that were not sewn up yet beside an arm: the
// strap begins there, and goes no usual way.
void tellBesideLimb(const Body& body, const StrapEnd& from, const StrapEnd& to, const Context& context) {
  if (!context.advise) return;
  const auto onTrunk = [&](const StrapEnd& end) {
    const auto skin = skinNear(body, end.middle);
    return !skin || body.describe(*skin).part == BodyPoint::Part::Torso;
  };
  const bool first = onTrunk(from), second = onTrunk(to);
  if (first == second || body.bvh().signedDistance((first ? to : from).middle) < kOffBody) return;
  context.advise(
      {say("One end of the strap stands beside an arm or a leg, not at the trunk, and the strap is led from "
           "there. Bring the garment to rest first, or say over what the strap goes.")});
}

}  // namespace

StrapEnd strapEnd(const Document& document, const EdgeRef& part) {
  const Piece& piece = *document.find(part.piece.id);
  const Curve& curve = *findCurve(piece, part.edge);
  const Stand stand(piece);
  return {stand(curve.atFraction((part.from + part.to) / 2)),
          normalized(stand(curve.atFraction(part.to)) - stand(curve.atFraction(part.from))),
          {piece.id}};
}

StrapEnd strapEnd(const Document& document, const std::vector<EdgeRef>& run) {
  const SpaceRun line = runOf(document, run);
  std::set<PieceId> pieces;
  for (const EdgeRef& edge : run) pieces.insert(edge.piece.id);
  return {line.place[line.place.size() / 2], normalized(line.place.back() - line.place.front()), std::move(pieces)};
}

Result<StrapWay> strapWay(const Document& document, PieceId strap, const Body& body, const StrapEnd& from,
                          const StrapEnd& to, const std::optional<BodyPoint>& over) {
  std::vector<SurfacePoint> through;
  for (const StrapEnd* end : {&from, &to}) {
    const auto place = skinNear(body, end->middle);
    if (!place) return refused(say("A strap goes over the body; choose the figure first."));
    through.push_back(*place);
  }
  if (over) {
    const auto place = body.find(*over);
    if (!place) return place.error();
    through.insert(through.begin() + 1, *place);
  }
  const auto path = shortestOver(SurfaceGuide(body.mesh()), through);
  if (!path) return path.error();
  const WayLine skin = onSkin(body, *path);
  StrapWay way;
  std::set<PieceId> own = from.pieces;
  own.insert(to.pieces.begin(), to.pieces.end());
  own.insert(strap);
  way.cloth = standingSheets(document, own);
  way.length = lineLength(drawnTaut(standingOff(skin, way.cloth.get(), 0)).place, false);
  const WayLine line = evenlyAlong(drawnTaut(standingOff(skin, way.cloth.get(), kOffSkin)));
  const double whole = lineLength(line.place, false), blend = std::fmin(kBlend, whole / 3);
  const std::size_t last = line.place.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const double s = whole * static_cast<double>(k) / static_cast<double>(last), begins = std::fmax(0, 1 - s / blend),
                 ends = std::fmax(0, 1 - (whole - s) / blend);
    way.place.push_back(line.place[k] + within(from.middle - line.place.front()) * begins +
                        within(to.middle - line.place.back()) * ends);
    const Vec3 across = normalized(cross(wayAt(line.place, k), line.out[k]));
    const auto alike = [&](Vec3 edge) { return dot(edge, across) < 0 ? edge * -1 : edge; };
    way.across.push_back(
        normalized(across * (1 - begins - ends) + alike(from.along) * begins + alike(to.along) * ends));
    way.out.push_back(line.out[k]);
  }
  return way;
}

Done settleWay(const Document& before, const StrapEnd& from, const StrapEnd& to, std::optional<BodyPoint>& over,
               Context& context) {
  if (!before.body.chosen()) return refused(say("A strap goes over the body; choose the figure first."));
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  if (!over && !context.recorded) over = usualWay(**body, from, to);
  if (!over && !context.recorded) tellBesideLimb(**body, from, to, context);
  if (!over) return {};
  const auto place = (*body)->find(*over);
  return place ? Done() : Done(place.error());
}

Result<Piece> laidAlong(const Document& document, Piece piece, Flat low, Flat top, const StrapWay& way,
                        const Body& body) {
  const auto laid = layAlone(piece, document.settings.spacing);
  if (!laid) return laid.error();
  auto form = std::make_shared<Form>();
  form->flat = (*laid)->nodes;
  form->faces = (*laid)->faces;
  const Flat up = normalized(top - low), right{up.v, -up.u};
  const double whole = distance(low, top);
  const auto n = way.place.size();
  const double step = lineLength(way.place, false) / static_cast<double>(n - 1);
  for (const Flat p : form->flat) {
    const double share = dot(p - low, up) / whole, s = share * static_cast<double>(n - 1);
    const auto k = std::min(static_cast<std::size_t>(std::fmax(s, 0)), n - 2);
    const double t = s - static_cast<double>(k), part = std::clamp(t, 0.0, 1.0);
    // What reaches beyond an end goes on straight.
    Vec3 place = lerp(way.place[k], way.place[k + 1], part) + wayAt(way.place, t < 0 ? 0 : k + 1) * ((t - part) * step);
    place += normalized(lerp(way.across[k], way.across[k + 1], part)) * dot(p - low, right);
    const Vec3 out = normalized(lerp(way.out[k], way.out[k + 1], part));
    form->space.push_back(clearOf(body, way.cloth.get(), place, out));
  }
  piece.form = std::move(form);
  piece.pose = Rigid();
  return piece;
}

}  // namespace karinui

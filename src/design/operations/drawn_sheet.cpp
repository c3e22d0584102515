#include "design/operations/drawn_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "karinui/base/number.h"
#include "karinui/geometry/fit_curve.h"

namespace karinui {
namespace {

constexpr double kSmallest = 4e-4;    // m2: less is no piece of cloth
constexpr double kFirmEnd = 0.005;    // metres of points that say how an edge ends, where it may not end otherwise
constexpr double kLevel = 0.6;        // radians: a curve that meets the centre this nearly level is fitted level there
constexpr double kSquared = 0.10;     // metres from the centre: how far off it is led anew, but no farther than
constexpr double kSquaredHalf = 0.5;  // this share of the way to where it turns back;
constexpr double kDip = 0.3;          // of that: so near the centre the skin dips, and what was drawn says little

// How many edges a line between two corners becomes depends on how it was drawn, not on how it came out: on any figure
// the same edges have the same names, and seams find them. One for a line between two or through up to four places,
// then one for each two more. Each is a chain of as few cubics as its shape allows: an edge on paper is a fair line,
// and a hand on a body, or the skin under it, wavers by millimetres.
FitSettings fitFor(int curves, bool firmEnds) {
  FitSettings fit;
  fit.pieces = curves;
  if (firmEnds) fit.firmEnds = kFirmEnd;
  fit.tolerance = 0.0025;
  fit.shortest = 0.04;
  fit.farthest = 0.004;
  return fit;
}
int curvesFor(std::size_t places, bool ring) { return std::clamp(static_cast<int>(places - 1) / 2, ring ? 3 : 1, 8); }

struct Sides {
  std::vector<SurfacePath> paths;
  std::vector<std::string> names;  // the centre line of a half has none
  std::vector<int> curves;         // how many edges each becomes
};

Result<Sides> sidesOf(const DrawingGround& ground, DrawnLine line) {
  Sides sides;
  std::optional<SurfacePath> centre;
  if (line.symmetric) {
    auto path = ground.guide.section(line.places.back(), line.places.front(), {1, 0, 0}, 0);
    if (!path) return path.error();
    line.places.back() = path->places.front();
    line.places.front() = path->places.back();
    centre = std::move(*path);
  } else {
    line.places.push_back(line.places.front());
  }
  std::vector<SurfacePoint> run{line.places.front()};
  std::string name = line.edges.front();
  for (std::size_t i = 1; i < line.places.size(); ++i) {
    run.push_back(line.places[i]);
    const bool last = i + 1 == line.places.size();
    if (!last && line.edges[i].empty()) continue;
    auto side = drawnSide(ground, run);
    if (!side) return side.error();
    const bool ring = distance(side->points.front(), side->points.back()) < 1e-9;
    sides.curves.push_back(curvesFor(run.size(), ring));
    sides.paths.push_back(std::move(*side));
    sides.names.push_back(name);
    run = {line.places[i]};
    if (!last) name = line.edges[i];
  }
  if (centre) {
    sides.paths.push_back(std::move(*centre));
    sides.names.emplace_back();
    sides.curves.push_back(1);
  }
  return sides;
}

std::vector<Flat> pointsOfSide(const Patch& patch, std::span<const Flat> flat, std::uint32_t side) {
  std::vector<Flat> points;
  std::size_t i = patch.first[side];
  const std::size_t n = patch.border.size();
  for (std::size_t guard = 0; guard < n && patch.side[i % n] == side; ++guard, ++i)
    points.push_back(flat[patch.border[i % n]]);
  points.push_back(flat[patch.border[i % n]]);
  return points;
}

// The sides in the order the border runs.
std::vector<std::uint32_t> sideOrder(const Patch& patch) {
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < patch.border.size(); ++i)
    if (order.empty() || order.back() != patch.side[i]) order.push_back(patch.side[i]);
  while (order.size() > 1 && order.back() == order.front()) order.pop_back();
  return order;
}

void addEdges(Outline& outline, const std::string& name, const std::vector<Curve>& curves) {
  for (std::size_t i = 0; i < curves.size(); ++i)
    outline.edges.push_back({i == 0 ? name : name + "_" + written(i + 1), curves[i]});
}

Outline wholeOutline(const Patch& patch, const Sides& sides, std::span<const Flat> flat, bool firmEnds, double& miss) {
  Outline outline;
  for (std::uint32_t s : sideOrder(patch)) {
    const Fitted fit = fitEdge(pointsOfSide(patch, flat, s), fitFor(sides.curves[s], firmEnds));
    miss = std::fmax(miss, fit.miss);
    addEdges(outline, sides.names[s], fit.curves);
  }
  return outline;
}

double smoothstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Leads a line that begins at the centre nearly level across it as the even curve v = a + b u^2, by least squares over
// the points beside the dip of the skin there. Farther off it is the drawn line again. `level`, radians: a steeper line
// stays.
void squareToCentre(std::vector<Flat>& points, double level) {
  const double side = points.back().u < 0 ? -1 : 1;
  std::size_t rising = 1;  // of the points u grows over
  while (rising < points.size() && side * points[rising].u > side * points[rising - 1].u) ++rising;
  const double reach = std::fmin(kSquared, kSquaredHalf * side * points[rising - 1].u);
  if (!(reach > 0)) return;
  double weights = 0, squares = 0, fourths = 0, heights = 0, products = 0;
  Flat last = points.front();
  for (std::size_t k = 1; k < rising && side * points[k].u < reach; ++k) {
    const double u = points[k].u, v = points[k].v;
    const double w = smoothstep(side * u / (kDip * reach)) * std::fabs(u - last.u);
    weights += w, squares += w * u * u, fourths += w * u * u * u * u, heights += w * v, products += w * u * u * v;
    last = points[k];
  }
  if (std::fabs(std::atan2(last.v - points.front().v, std::fabs(last.u))) >= level) return;
  const double determinant = weights * fourths - squares * squares;
  if (!(determinant > 1e-12 * weights * fourths)) return;
  const double b = (weights * products - squares * heights) / determinant, a = (heights - b * squares) / weights;
  for (std::size_t k = 0; k < rising && side * points[k].u < reach; ++k) {
    const double u = points[k].u;
    points[k].v = std::lerp(a + b * u * u, points[k].v, smoothstep(2 * side * u / reach - 1));
  }
}

// A half's edges and their mirror images in u = 0.
Outline symmetricOutline(const Patch& patch, const Sides& sides, std::span<const Flat> flat, bool leftHalf,
                         const std::optional<double>& square, bool firmEnds, double& miss) {
  std::vector<std::uint32_t> order = sideOrder(patch);
  const auto centre = std::find_if(order.begin(), order.end(), [&](std::uint32_t s) { return sides.names[s].empty(); });
  std::rotate(order.begin(), centre + 1, order.end());
  order.pop_back();
  Outline here, there;
  for (std::size_t k = 0; k < order.size(); ++k) {
    std::vector<Flat> points = pointsOfSide(patch, flat, order[k]);
    if (k == 0) points.front().u = 0;
    if (k + 1 == order.size()) points.back().u = 0;
    if (square && k == 0) squareToCentre(points, *square);
    if (square && k + 1 == order.size()) {
      std::reverse(points.begin(), points.end());
      squareToCentre(points, *square);
      std::reverse(points.begin(), points.end());
    }
    std::optional<Flat> startWay, endWay;
    const auto level = [](Flat way) { return std::fabs(std::atan2(way.v, std::fabs(way.u))) < kLevel; };
    const std::size_t reach = std::min<std::size_t>(3, points.size() - 1);
    if (k == 0 && level(points[reach] - points[0])) startWay = Flat{points[reach].u > points[0].u ? 1.0 : -1.0, 0};
    if (k + 1 == order.size() && level(points.back() - points[points.size() - 1 - reach]))
      endWay = Flat{points.back().u > points[points.size() - 1 - reach].u ? 1.0 : -1.0, 0};
    const Fitted fit = fitEdge(points, fitFor(sides.curves[order[k]], firmEnds), startWay, endWay);
    miss = std::fmax(miss, fit.miss);
    const std::string& name = sides.names[order[k]];
    addEdges(here, name + (leftHalf ? "_left" : "_right"), fit.curves);
    Outline other;
    addEdges(other, name + (leftHalf ? "_right" : "_left"), fit.curves);
    there.edges.insert(there.edges.end(), other.edges.begin(), other.edges.end());
  }
  for (std::size_t k = there.edges.size(); k-- > 0;) {
    const Edge& edge = there.edges[k];
    here.edges.push_back({edge.name, edge.curve.mirrored({0, 0}, {0, 1}).reversed()});
  }
  return here;
}

std::shared_ptr<Form> formOfSheet(const Patch& patch, std::span<const Flat> flat) {
  auto form = std::make_shared<Form>();
  form->flat.assign(flat.begin(), flat.end());
  form->space = patch.mesh.points;
  form->faces = patch.mesh.faces;
  return form;
}

// Adds the mirror image: points of the fold are their own.
void addOtherHalf(Form& form, const std::vector<std::uint32_t>& fold) {
  const auto n = static_cast<std::uint32_t>(form.flat.size());
  std::vector<std::uint32_t> image(n, 0);
  for (std::uint32_t p : fold) image[p] = p + 1;
  for (std::uint32_t p = 0; p < n; ++p) {
    if (image[p]) continue;
    image[p] = static_cast<std::uint32_t>(form.flat.size()) + 1;
    form.flat.push_back({-form.flat[p].u, form.flat[p].v});
    form.space.push_back({-form.space[p].x, form.space[p].y, form.space[p].z});
  }
  const std::size_t faces = form.faces.size();
  for (std::size_t f = 0; f < faces; ++f) {
    const Triangle t = form.faces[f];
    form.faces.push_back({image[t[0]] - 1, image[t[2]] - 1, image[t[1]] - 1});
  }
}

// From which edge, and how far on paper, a cut or dart would reach the worst place.
void adviseCut(DrawnSheet& sheet, const Patch& patch, const Sides& sides, std::span<const Flat> flat) {
  const Triangle& t = patch.mesh.faces[sheet.distortion.worstFace];
  const Flat worst = (flat[t[0]] + flat[t[1]] + flat[t[2]]) * (1.0 / 3);
  sheet.worst = (patch.mesh.points[t[0]] + patch.mesh.points[t[1]] + patch.mesh.points[t[2]]) * (1.0 / 3);
  sheet.worstFlat = worst;
  const double space = length(cross(patch.mesh.points[t[1]] - patch.mesh.points[t[0]],
                                    patch.mesh.points[t[2]] - patch.mesh.points[t[0]])),
               paper = std::fabs(cross(flat[t[1]] - flat[t[0]], flat[t[2]] - flat[t[0]]));
  sheet.shrunk = space > 0 ? std::sqrt(paper / space) - 1 : 0;
  sheet.cutLength = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < patch.border.size(); ++i) {
    const double d = distance(flat[patch.border[i]], worst);
    if (d >= sheet.cutLength || sides.names[patch.side[i]].empty()) continue;
    sheet.cutLength = d;
    sheet.nearestEdge = sides.names[patch.side[i]];
  }
}

}  // namespace

Result<DrawnSheet> drawnSheet(const DrawingGround& ground, const DrawnLine& line, const DrawnSettings& settings,
                              const Token& token) {
  KARINUI_ASSERT(line.places.size() >= 3 && line.edges.size() == line.places.size() && !line.edges.front().empty());
  const auto sides = sidesOf(ground, line);
  if (!sides) return sides.error();
  token.progress(0.1, say("Cutting along the line"));
  auto raw = cutPatch(ground.guide, sides->paths, line.inside);
  if (!raw) return raw.error();
  if (raw->area() < kSmallest)
    return refused(say("The line holds only {0} cm2: too small to be a piece of cloth.", fixed(raw->area() * 1e4, 2)));
  const auto first = unfold(raw->mesh, raw->border, token);
  if (!first) return first.error();
  token.progress(0.3, say("Laying the cloth flat"));
  const double spacing = std::clamp(std::sqrt(raw->area()) / 12, 0.002, settings.spacing);
  auto fine = remeshed(*raw, *first, spacing);
  if (!fine) return fine.error();
  Patch& patch = fine->patch;

  LiftSettings lift;
  lift.ease = settings.ease;
  FlattenSettings flattening = settings.flatten;
  if (line.symmetric) {
    const auto centre = static_cast<std::uint32_t>(sides->paths.size() - 1);
    const std::size_t n = patch.border.size();
    std::size_t i = patch.first[centre];
    for (; patch.side[i % n] == centre; ++i) lift.fold.push_back(patch.border[i % n]);
    lift.fold.push_back(patch.border[i % n]);
    flattening.fold = lift.fold;
  }
  liftOff(patch, ground.mesh, ground.bvh, lift);
  auto laid = flattenFrom(fine->flat, patch.mesh, patch.border, flattening, token);
  if (!laid) return laid.error();

  const auto [low, high] = boxOf(laid->flat);
  const Flat carry{line.symmetric ? 0 : (low.u + high.u) / 2, low.v};
  for (Flat& p : laid->flat) p = p - carry;

  DrawnSheet sheet;
  sheet.distortion = laid->distortion;
  adviseCut(sheet, patch, *sides, laid->flat);
  auto form = formOfSheet(patch, laid->flat);
  double x = 0;
  for (Vec3 p : form->space) x += p.x;
  const auto fitted = [&](bool firmEnds) {
    sheet.fitMiss = 0;
    return line.symmetric ? symmetricOutline(patch, *sides, laid->flat, x > 0, line.square, firmEnds, sheet.fitMiss)
                          : wholeOutline(patch, *sides, laid->flat, firmEnds, sheet.fitMiss);
  };
  sheet.outline = fitted(false);
  // The nearest curves may curl by a tenth of a millimetre at a corner, and cross the next edge there.
  if (!checked(sheet.outline)) sheet.outline = fitted(true);
  if (line.symmetric) addOtherHalf(*form, lift.fold);
  sheet.form = std::move(form);
  return sheet;
}

}  // namespace karinui

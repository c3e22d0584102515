#include "karinui/geometry/flatten.h"

#include <algorithm>
#include <cmath>

#include "geometry/first_map.h"
#include "geometry/membrane.h"

namespace karinui {
namespace {

constexpr double kThinnest = 0.05;  // of a raw patch's slivers, see restTriangle

Done usable(const TriangleMesh& sheet, std::span<const std::uint32_t> border) {
  if (sheet.faces.empty() || border.size() < 3) return refused(say("There is no sheet to lay flat."));
  for (const Vec3& p : sheet.points)
    if (!finite(p)) return badInput(say("A sheet with a point that is not a number cannot be laid flat."));
  return {};
}

void turn(std::vector<Flat>& flat, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Flat& p : flat) p = {c * p.u - s * p.v, s * p.u + c * p.v};
}

// How far the whole must be turned so that the grain, as the sheet lies on average, runs along +v.
double turnToGrain(std::span<const RestTriangle> rest, const TriangleMesh& sheet, std::span<const Flat> flat,
                   Vec3 grain) {
  Flat sum;
  for (const RestTriangle& t : rest) {
    const Vec3 a = sheet.points[t.corner[0]];
    const Vec3 x = normalized(sheet.points[t.corner[1]] - a);
    const Vec3 other = sheet.points[t.corner[2]] - a;
    const Vec3 y = normalized(other - x * dot(other, x));
    const Flat here{dot(grain, x), dot(grain, y)};
    const Gradient f = gradientOf(t, flat);
    sum += Flat{f[0] * here.u + f[1] * here.v, f[2] * here.u + f[3] * here.v} * t.area;
  }
  return length(sum) > 0 ? std::atan2(sum.u, sum.v) : 0;  // turning by +angle carries sum onto +v
}

// For a half: the fold along v, at u = 0, the cloth on the side it already is.
void foldUpright(std::vector<Flat>& flat, const FlattenSettings& settings, const TriangleMesh& sheet) {
  if (settings.fold.size() < 2) return;
  Flat ahead = flat[settings.fold.back()] - flat[settings.fold.front()];
  const Vec3 inSpace = sheet.points[settings.fold.back()] - sheet.points[settings.fold.front()];
  if (dot(inSpace, settings.grain) < 0) ahead = -ahead;
  turn(flat, std::atan2(ahead.u, ahead.v));
  double middle = 0;
  for (std::uint32_t p : settings.fold) middle += flat[p].u;
  middle /= static_cast<double>(settings.fold.size());
  for (Flat& p : flat) p.u -= middle;
}

double meanEdge(const TriangleMesh& sheet) {
  double sum = 0;
  for (const Triangle& t : sheet.faces) sum += distance(sheet.points[t[0]], sheet.points[t[1]]);
  return sum / static_cast<double>(sheet.faces.size());
}

}  // namespace

Result<std::vector<Flat>> unfold(const TriangleMesh& sheet, std::span<const std::uint32_t> border, const Token& token) {
  if (auto fine = usable(sheet, border); !fine) return fine.error();
  const std::vector<RestTriangle> rest = restOf(sheet, kThinnest);
  std::vector<Flat> flat = conformalMap(rest, border, sheet.points.size(), sheet.points);
  if (flat.empty() || !foldFree(rest, flat)) flat = tutteMap(rest, border, sheet.points.size(), sheet.points);
  if (!foldFree(rest, flat)) return refused(say("What lies inside the line cannot be laid flat without a fold."));
  FlatProblem problem;
  problem.rest = rest;
  problem.law = symmetricDirichlet;
  problem.maxSteps = 40;
  problem.enough = 1e-4;
  minimise(problem, flat, token);
  if (token.cancelled()) return cancelled();
  return flat;
}

Result<Flattened> flattenFrom(std::span<const Flat> guess, const TriangleMesh& sheet,
                              std::span<const std::uint32_t> border, const FlattenSettings& settings,
                              const Token& token) {
  if (auto fine = usable(sheet, border); !fine) return fine.error();
  KARINUI_ASSERT(guess.size() == sheet.points.size());
  const std::vector<RestTriangle> rest = restOf(sheet, kThinnest / 5);
  std::vector<Flat> flat(guess.begin(), guess.end());
  if (!foldFree(rest, flat)) return refused(say("What lies inside the line cannot be laid flat without a fold."));

  FlatProblem problem;
  problem.rest = rest;
  problem.law = symmetricDirichlet;
  problem.maxSteps = settings.maxSteps;
  problem.enough = 1e-4;
  minimise(problem, flat, token);
  if (token.cancelled()) return cancelled();
  token.progress(0.5, say("Laying the cloth flat"));

  const double stiffest = std::fmax(settings.warp, settings.weft);
  FabricLaw law;
  law.warp = settings.warp / stiffest;
  law.weft = settings.weft / stiffest;
  law.shear = settings.shear / stiffest;
  problem.law = law;
  problem.enough = 1e-8;
  problem.holdTurn = settings.fold.empty();
  const double h = meanEdge(sheet);
  for (std::size_t i = 0; i < border.size(); ++i) {
    const std::uint32_t a = border[i], b = border[(i + 1) % border.size()];
    const double l = distance(sheet.points[a], sheet.points[b]);
    if (l > 0) problem.springs.push_back({a, b, l, settings.border * l * h});
  }
  if (settings.fold.empty()) {
    turn(flat, turnToGrain(rest, sheet, flat, settings.grain));
    minimise(problem, flat, token);
    turn(flat, turnToGrain(rest, sheet, flat, settings.grain));
  } else {
    foldUpright(flat, settings, sheet);
    for (const double weight : {10.0, 1e4, 1e8}) {
      problem.holds.clear();
      for (std::uint32_t p : settings.fold) problem.holds.push_back({p, weight});
      minimise(problem, flat, token);
    }
    std::vector<Flat> exact = flat;
    for (std::uint32_t p : settings.fold) exact[p].u = 0;
    if (!foldFree(rest, exact)) return refused(say("The centre line cannot be laid straight without a fold."));
    flat = std::move(exact);
  }
  if (token.cancelled()) return cancelled();
  KARINUI_ASSERT(foldFree(rest, flat));
  Flattened out;
  out.distortion = distortionOf(flat, sheet, border, settings.gates);
  out.flat = std::move(flat);
  return out;
}

Result<Flattened> flatten(const TriangleMesh& sheet, std::span<const std::uint32_t> border,
                          const FlattenSettings& settings, const Token& token) {
  auto first = unfold(sheet, border, token);
  if (!first) return first.error();
  return flattenFrom(*first, sheet, border, settings, token);
}

}  // namespace karinui

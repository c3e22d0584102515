#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/membrane.h"
#include "karinui/geometry/flatten.h"

namespace karinui {
namespace {

Distortion::Spread spreadOf(std::vector<std::pair<double, double>> valueAndArea) {
  Distortion::Spread spread;
  std::sort(valueAndArea.begin(), valueAndArea.end());
  double whole = 0;
  for (const auto& [value, area] : valueAndArea) {
    spread.mean += value * area;
    whole += area;
  }
  if (whole <= 0) return spread;
  spread.mean /= whole;
  spread.max = valueAndArea.back().first;
  double below = 0;
  for (const auto& [value, area] : valueAndArea) {
    spread.p99 = value;
    if ((below += area) >= 0.99 * whole) break;
  }
  return spread;
}

}  // namespace

Distortion distortionOf(std::span<const Flat> flat, const TriangleMesh& sheet, std::span<const std::uint32_t> border,
                        const Gates& gates) {
  Distortion report;
  std::vector<std::pair<double, double>> warp, weft, shear, area;
  double worst = -1;
  const std::vector<RestTriangle> rest = restOf(sheet, 0);
  for (std::uint32_t f = 0; f < rest.size(); ++f) {
    if (!(rest[f].area > 0)) continue;
    const Gradient g = gradientOf(rest[f], flat);
    const ClothStretch s = stretchOf(g);
    const double a = rest[f].area, angle = std::fabs(std::asin(std::clamp(s.cosine, -1.0, 1.0)));
    warp.emplace_back(std::fabs(s.warp - 1), a);
    weft.emplace_back(std::fabs(s.weft - 1), a);
    shear.emplace_back(angle, a);
    area.emplace_back(std::fabs(1 / determinant(g) - 1), a);
    const double trouble = std::max({std::fabs(s.warp - 1) / gates.stretchAmber,
                                     std::fabs(s.weft - 1) / gates.stretchAmber, angle / gates.shearAmber});
    if (trouble > worst) {
      worst = trouble;
      report.worstFace = f;
    }
  }
  report.warp = spreadOf(std::move(warp));
  report.weft = spreadOf(std::move(weft));
  report.shear = spreadOf(std::move(shear));
  report.area = spreadOf(std::move(area));
  double paper = 0, space = 0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const std::uint32_t a = border[i], b = border[(i + 1) % border.size()];
    paper += distance(flat[a], flat[b]);
    space += distance(sheet.points[a], sheet.points[b]);
  }
  report.border = space > 0 ? paper / space - 1 : 0;
  const double stretch = std::fmax(report.warp.p99, report.weft.p99);
  using Gate = Distortion::Gate;
  report.gate = stretch <= gates.stretchGreen && report.shear.p99 <= gates.shearGreen   ? Gate::Green
                : stretch <= gates.stretchAmber && report.shear.p99 <= gates.shearAmber ? Gate::Amber
                                                                                        : Gate::Red;
  return report;
}

}  // namespace karinui

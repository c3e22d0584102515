#include "design/blocks/draft.h"

#include <algorithm>
#include <cmath>

#include "karinui/geometry/section.h"

namespace karinui {

double Measured::operator()(std::string_view key) const {
  const auto& all = body_.measured().value;
  const auto found = all.find(std::string(key));
  if (found != all.end()) return found->second;
  if (missing_.empty()) missing_ = key;
  return 0;
}

Measured::Belly Measured::belly() const {
  const auto& all = body_.measured().value;
  const auto girth = all.find("belly_girth"), high = all.find("belly_height");
  if (girth == all.end() || high == all.end() || girth->second <= (*this)("hip_girth")) return {};
  return {girth->second, std::fmax(0, (*this)("waist_height") - high->second)};
}

Measured::Trunk Measured::underWaist() const {
  constexpr int kLevels = 16;
  const TriangleMesh& mesh = body_.own().mesh();
  const double low = (*this)("hip_height"), high = (*this)("waist_height");
  const double waist = (*this)("waist_girth");
  Trunk trunk{std::fmax((*this)("hip_girth"), waist), waist, high};
  for (int k = 1; k < kLevels; ++k) {
    const double height = std::lerp(low, high, double(k) / kLevels);
    for (const SectionLoop& loop : section(mesh, {{0, height, 0}, {0, 1, 0}})) {
      const auto side = [](Vec3 a, Vec3 b) { return a.x < b.x; };
      const auto [left, right] = std::minmax_element(loop.points.begin(), loop.points.end(), side);
      if (left->x >= 0 || right->x <= 0) continue;  // an arm
      const double girth = tightTapeLength(loop.points, {0, 1, 0});
      trunk.widest = std::fmax(trunk.widest, girth);
      if (4 * k <= 3 * kLevels && girth < trunk.narrowest) trunk.narrowest = girth, trunk.narrowHeight = height;
    }
  }
  return trunk;
}

std::optional<double> Measured::aside(const std::string& landmark) const {
  const auto found = body_.landmarks().find(landmark);
  return found == body_.landmarks().end() ? std::nullopt : std::optional(found->second.x);
}

Done Measured::enough() const {
  if (missing_.empty()) return {};
  return refused(
      say("This figure has no measure “{0}”, which the block needs; choose a mannequin or state it.", missing_));
}

std::vector<Edge> upperHalf(const UpperHalf& h) {
  const Flat foot{h.hemWidth, h.hem}, waist{h.waistWidth, 0}, under{h.chestWidth, h.underarm};
  const Flat shoulder = normalized(h.neck - h.tip), square = {shoulder.v, -shoulder.u};  // outwards and up
  const Flat narrow{h.across, h.underarm + 0.4 * (h.tip.v - h.underarm)};
  const double in = h.chestWidth - h.across, up = narrow.v - h.underarm, top = h.tip.v - narrow.v;

  std::vector<Curve> side;
  if (h.hem < -1e-3) side.push_back(Curve::line(foot, waist));
  side.push_back(Curve::line(waist, under));
  // One straight line where the side does not bend at the waist.
  if (side.size() == 2 && std::fabs(cross(normalized(waist - foot), normalized(under - waist))) < 1e-3)
    side = {Curve::line(foot, under)};
  const std::vector<Curve> armhole{
      Curve::cubic(under, under - Flat{0.6 * in, 0}, narrow - Flat{0, 0.55 * up}, narrow),
      Curve::cubic(narrow, narrow + Flat{0, 0.4 * top}, h.tip - square * (0.33 * top), h.tip)};
  const Flat middle{0, h.centre};
  const double drop = h.neck.v - h.centre;
  const Curve neck = Curve::cubic(h.neck, h.neck - square * (0.55 * drop), {0.55 * h.neck.u, h.centre}, middle);
  return {{"hem", Curve::line({0, h.hem}, h.hem < -1e-3 ? foot : waist)},
          {"side", Curve::joined(side)},
          {"armhole", Curve::joined(armhole)},
          {"shoulder", Curve::line(h.tip, h.neck)},
          {"neck", neck}};
}

Outline wholeOf(const std::vector<Edge>& half, const std::string& plus, const std::string& minus) {
  Outline whole;
  for (const Edge& edge : half) whole.edges.push_back({edge.name + plus, edge.curve});
  for (auto edge = half.rbegin(); edge != half.rend(); ++edge)
    whole.edges.push_back({edge->name + minus, edge->curve.mirrored({0, 0}, {0, 1}).reversed()});
  return whole;
}

Outline halfOf(const std::vector<Edge>& half) {
  Outline outline{half};
  outline.edges.push_back({"centre", Curve::line(half.back().curve.end, half.front().curve.start)});
  return outline;
}

double lengthOf(const std::vector<Edge>& half, std::string_view edge) {
  for (const Edge& one : half)
    if (one.name == edge) return one.curve.length();
  return 0;
}

}  // namespace karinui

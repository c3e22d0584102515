#include "body/dress_form.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "body/anthropometry/contour.h"
#include "body/shortened.h"

namespace karinui {

namespace {

constexpr double kCapTop = 0.022, kCapBottom = 0.006;  // of the height, beyond the armscye: the shoulder's end stays
constexpr double kAboveCrotch = 0.060;                 // where the skin ends
constexpr double kRunOut = 0.18;                       // over which groin, cleft and the gap between the thighs end
constexpr double kThigh = 0.14;                        // below the crotch: where the form ends
constexpr double kSteepest = 1;
constexpr int kRoundings = 8;
constexpr int kAround = 72;         // points of a ring below the skin
constexpr double kStep = 0.012;     // between the rings of the skin
constexpr double kLegReach = 0.13;  // of the height: a leg's middle from the plane of symmetry
constexpr double kPole = 0.016;     // radius
constexpr double kPoleStep = 0.05;

// What closes a form, in shares of the cut's way to its middle, and how far it stands out: rounded, then nearly flat.
struct CapRing {
  double share, out;
};
constexpr CapRing kCap[] = {{0.97, 0.003}, {0.88, 0.006}, {0.66, 0.008}, {0.36, 0.009}};

// The stand's foot, from the pole down: radius and height.
struct Turned {
  double radius, y;
};
constexpr Turned kStandFoot[] = {{kPole, 0.060}, {0.022, 0.046}, {0.050, 0.036}, {0.110, 0.029}, {0.165, 0.023},
                                 {0.180, 0.015}, {0.180, 0.006}, {0.174, 0.0},   {0.090, 0.0}};

// Goes on from the line of an open end through rings of as many points, and closes the last in its middle.
class Closing {
 public:
  Closing(TriangleMesh& mesh, const Line& line) : mesh_(mesh), last_(line) {}

  void ring(const std::vector<Vec3>& points) {
    Line next;
    for (const Vec3& p : points) next.push_back(add(p));
    for (std::size_t i = 0; i < next.size(); ++i) {
      const std::size_t j = (i + 1) % next.size();
      mesh_.faces.push_back({last_[j], last_[i], next[i]});
      mesh_.faces.push_back({last_[j], next[i], next[j]});
    }
    last_ = std::move(next);
  }
  void middle(Vec3 place) {
    const std::uint32_t centre = add(place);
    for (std::size_t i = 0; i < last_.size(); ++i)
      mesh_.faces.push_back({last_[(i + 1) % last_.size()], last_[i], centre});
  }

 private:
  std::uint32_t add(Vec3 p) {
    mesh_.points.push_back(p);
    return static_cast<std::uint32_t>(mesh_.points.size() - 1);
  }
  TriangleMesh& mesh_;
  Line last_;
};

Vec3 middleOf(const TriangleMesh& mesh, const Line& line) {
  Vec3 middle;
  for (const std::uint32_t i : line) middle += mesh.points[i] * (1.0 / static_cast<double>(line.size()));
  return middle;
}

// The rim is evened into the plane, too.
void cap(TriangleMesh& mesh, const Line& line, const Plane& plane) {
  const Vec3 normal = plane.normal;
  for (const std::uint32_t i : line) mesh.points[i] += normal * -along(plane, mesh.points[i]);
  const Vec3 middle = middleOf(mesh, line);
  std::vector<Vec3> rim;
  for (const std::uint32_t i : line) rim.push_back(mesh.points[i]);
  Closing closing(mesh, line);
  for (const CapRing& at : kCap) {
    std::vector<Vec3> points;
    for (const Vec3& p : rim) points.push_back(lerp(middle, p, at.share) + normal * at.out);
    closing.ring(points);
  }
  closing.middle(middle + normal * kCap[std::size(kCap) - 1].out);
}

// How far lines around a middle reach in a direction.
class Outline {
 public:
  explicit Outline(std::vector<Flat> line) : line_(std::move(line)) {}
  double reach(Flat towards) const {
    double far = 0;
    for (std::size_t i = 0; i < line_.size(); ++i) {
      const Flat a = line_[i], b = line_[(i + 1) % line_.size()];
      const double before = cross(towards, a), after = cross(towards, b);
      if ((before > 0) == (after > 0)) continue;
      far = std::max(far, dot(towards, lerp(a, b, before / (before - after))));
    }
    return far;
  }

 private:
  std::vector<Flat> line_;
};

// The tape around both thighs, or the hip, at a level of the skin.
Outline tapeAround(const TriangleMesh& mesh, double y, double reach, Vec3 middle) {
  std::vector<Flat> points;
  for (const SectionLoop& loop : section(mesh, {{0, y, 0}, {0, 1, 0}})) {
    double x = 0;
    for (const Vec3& p : loop.points) x += p.x / static_cast<double>(loop.points.size());
    if (std::abs(x) < reach)
      for (const Vec3& p : loop.points) points.push_back({p.x - middle.x, p.z - middle.z});
  }
  return Outline(convexHull(points));
}

// The skin itself, where it is one line.
Outline lineAround(const TriangleMesh& mesh, double y, Vec3 middle) {
  std::vector<Flat> points;
  for (const SectionLoop& loop : section(mesh, {{0, y, 0}, {0, 1, 0}})) {
    Interval x;
    for (const Vec3& p : loop.points) x.include(p.x);
    if (x.low < 0 && x.high > 0)
      for (const Vec3& p : loop.points) points.push_back({p.x - middle.x, p.z - middle.z});
  }
  return Outline(std::move(points));
}

// A tape runs straight from thigh to thigh; a form is round.
void rounded(std::vector<double>& radius) {
  const std::size_t n = radius.size();
  for (int round = 0; round < kRoundings; ++round) {
    const std::vector<double> before = radius;
    for (std::size_t i = 0; i < n; ++i)
      radius[i] = before[i] * 0.5 + (before[(i + n - 1) % n] + before[(i + 1) % n]) * 0.25;
  }
}

// From the hip on down: both thighs in one, closed below, the pole and the foot.
bool stand(TriangleMesh& out, const TriangleMesh& skin, const Line& line, double crotch, double height) {
  const Vec3 middle = middleOf(out, line);
  std::vector<Flat> rim, towards;
  double turns = 0;
  for (const std::uint32_t i : line) rim.push_back({out.points[i].x - middle.x, out.points[i].z - middle.z});
  for (std::size_t i = 0; i < rim.size(); ++i) turns += cross(rim[i], rim[(i + 1) % rim.size()]);
  for (int i = 0; i < kAround; ++i) {  // the way the line runs
    const double t = std::copysign(2 * std::numbers::pi * i / kAround, turns);
    towards.push_back({std::cos(t), std::sin(t)});
  }
  const auto ring = [&](double y, const auto& reach) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < towards.size(); ++i)
      points.push_back(Vec3{middle.x, y, middle.z} + Vec3{towards[i].u, 0, towards[i].v} * reach(i));
    return points;
  };
  const double top = middle.y, end = crotch - kThigh;
  const int steps = static_cast<int>(std::round((top - end) / kStep));
  std::vector<double> below(kAround), from,
      slope;  // how far the skin reaches where it ends, and by how much more below
  const Outline skinEnd(rim), above = lineAround(skin, top + kStep, middle);
  for (const Flat way : towards) {
    from.push_back(skinEnd.reach(way));
    slope.push_back(std::clamp((from.back() - above.reach(way)) / kStep, -kSteepest, kSteepest));
  }
  rounded(slope);
  Line first;
  std::optional<Closing> closing;
  for (int k = 1; k <= steps; ++k) {
    const double y = std::lerp(top, end, static_cast<double>(k) / steps);
    const Outline tape = tapeAround(skin, y, kLegReach * height, middle);
    std::vector<double> around;
    for (const Flat way : towards) around.push_back(tape.reach(way));
    rounded(around);
    // Hermite's cubic: it leaves the skin in its own slope, without a crease.
    const double t = std::min(1.0, (top - y) / kRunOut), share = t * t * (3 - 2 * t), on = t * (1 - t) * (1 - t);
    for (std::size_t i = 0; i < below.size(); ++i)
      below[i] = std::lerp(from[i], around[i], share) + on * kRunOut * slope[i];
    const auto points = ring(y, [&](std::size_t i) { return below[i]; });
    if (closing) {
      closing->ring(points);
      continue;
    }
    for (const Vec3& p : points)
      first.push_back(static_cast<std::uint32_t>(out.points.size())), out.points.push_back(p);
    if (!joinLines(out, line, Line(first.rbegin(), first.rend()), {0, -1, 0})) return false;
    closing.emplace(out, first);
  }
  for (const auto& [share, down] : {std::pair{0.985, 0.006}, {0.93, 0.011}, {0.78, 0.014}, {0.5, 0.016}, {0.25, 0.017}})
    closing->ring(ring(end - down, [&, part = share](std::size_t i) { return below[i] * part; }));
  const auto turned = [&](Turned at) { closing->ring(ring(at.y, [&](std::size_t) { return at.radius; })); };
  const double poleTop = end - 0.018;
  const int parts = std::max(2, static_cast<int>(std::round((poleTop - kStandFoot[0].y) / kPoleStep)));
  for (int k = 0; k < parts; ++k) turned({kPole, std::lerp(poleTop, kStandFoot[0].y, static_cast<double>(k) / parts)});
  for (const Turned& at : kStandFoot) turned(at);
  closing->middle({middle.x, 0, middle.z});
  return true;
}

}  // namespace

TriangleMesh dressForm(const TriangleMesh& mesh, const Joints& at, Vec3 armpit, const Plane& neck, double crotch) {
  Shortened rest(mesh);
  const Armscye armhole = armscye(at);
  const Line top = rest.takeOff(neck, {0, at.crown, neck.through.z});
  const Vec3 bottomOfCap = Vec3{armpit.x, armpit.y, 0} + armhole.outward * (kCapBottom * at.crown);
  const Vec3 topOfCap = Vec3{at.shoulder.x, at.shoulder.y + 0.05, 0} + armhole.outward * (kCapTop * at.crown);
  const Vec3 up = normalized(topOfCap - bottomOfCap);
  const Plane left{bottomOfCap, {up.y, -up.x, 0}};
  const auto across = [](Vec3 v) { return Vec3{-v.x, v.y, v.z}; };
  const Plane right{across(left.through), across(left.normal)};
  const Line arms[]{rest.takeOff(left, at.tip), rest.takeOff(right, across(at.tip))};
  const Line bottom = rest.takeOff({{0, crotch + kAboveCrotch, 0}, {0, -1, 0}}, at.ankle);
  for (const Line* line : {&top, &arms[0], &arms[1], &bottom})
    if (line->empty()) return {};
  TriangleMesh out = rest.taken();
  cap(out, top, neck);
  cap(out, arms[0], left);
  cap(out, arms[1], right);
  if (!stand(out, mesh, bottom, crotch, at.crown)) return {};
  return compact(out);
}

}  // namespace karinui

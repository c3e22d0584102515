#include "session/stroke.h"

#include <algorithm>
#include <cmath>

#include "karinui/body/body.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kJitter = 0.2;        // of touching: what a hand wavers
constexpr double kUnsure = 0.02;       // metres of depth in that waver: the sample is uncertain
constexpr double kFar = 0.04;          // metres a stroke jumps onto another part of the body
constexpr double kBeside = 1.5;        // times touching: how far beside the silhouette still means it
constexpr double kFairedApart = 0.01;  // metres between the nodes that are faired
constexpr double kShortest = 0.06;     // metres: shorter waves are taken out
constexpr double kRayMiss = 0.004;     // metres a faired line may pass from a certain ray
constexpr double kTipAbove = 0.3;      // metres above the skin at which a tip's ray begins
constexpr int kSweeps = 120, kRounds = 3;

Vec3 onRay(const Ray& ray, Vec3 place) { return ray.origin + ray.direction * dot(place - ray.origin, ray.direction); }

}  // namespace

double awayFromRay(const Ray& ray, Vec3 place) { return distance(onRay(ray, place), place); }

std::optional<StrokeSample> strokeSample(const GarmentSnapshot& snapshot, const PointerSample& sample,
                                         const std::optional<Vec3>& before) {
  if (!snapshot.body || sample.where != PointerSample::Where::Space) return std::nullopt;
  const Body& body = *snapshot.body;
  StrokeSample found;
  found.ray = sample.ray;
  found.facing = sample.facing;
  found.reach = sample.reach;
  const Hit hit = pickBody(snapshot, sample);
  found.met = hit.on == Hit::On::Body;
  if (sample.tip) {
    if (!found.met) return std::nullopt;
    const Vec3 normal = faceNormal(body.mesh(), hit.skin.face);
    found.ray = {hit.point + normal * kTipAbove, -normal};
    found.reach = sample.reach / kTipAbove;
    found.skin = hit.skin, found.point = hit.point, found.along = kTipAbove;
    found.touched = true;
    return found;
  }
  if (found.met) {
    found.skin = hit.skin, found.point = hit.point, found.along = hit.along;
    const double slope = std::fabs(dot(faceNormal(body.mesh(), hit.skin.face), sample.ray.direction));
    found.certain = kJitter * found.touching() < kUnsure * slope;
  }
  const bool jumped =
      found.met && before && distance(found.point, *before) > kFar &&
      distance(found.point, *before) > 4 * distance(onRay(sample.ray, *before), *before) + 2 * found.touching();
  if (found.met && !jumped) return found;
  // The skin nearest to the ray, from where the stroke was, or from the body's own depth.
  Vec3 near = before ? *before : Vec3{};
  if (!before) {
    const Box box = boxOf(body.mesh().points);
    near = onRay(sample.ray, box.centre());
  }
  for (int k = 0; k < 6; ++k) near = body.bvh().nearest(onRay(sample.ray, near))->point;
  StrokeSample beside = found;
  beside.point = near;
  beside.skin = body.bvh().nearest(near)->place;
  beside.along = dot(near - sample.ray.origin, sample.ray.direction);
  beside.met = beside.certain = false;
  const bool hidden = snapshot.visible && !snapshot.visible->showsSkin(beside.skin, near);
  if (!hidden && beside.along > 0 && awayFromRay(sample.ray, near) < kBeside * beside.touching()) return beside;
  return found.met ? std::optional(found) : std::nullopt;
}

std::vector<Vec3> pictureOf(std::span<const StrokeSample> stroke) {
  Vec3 middle;
  for (const StrokeSample& s : stroke) middle += s.point * (1.0 / static_cast<double>(stroke.size()));
  std::vector<Vec3> picture;
  for (const StrokeSample& s : stroke) {
    if (s.touched) {
      picture.push_back(s.point);
      continue;
    }
    PointerSample seen;
    seen.ray = s.ray, seen.facing = s.facing;
    picture.push_back(onFacing(seen, middle));
  }
  return picture;
}

namespace {

struct Node {
  Ray ray;
  Vec3 at;
  double weight = 1, miss = 0;
  bool fixed = false, certain = true;
};

// Nodes evenly along the stroke as it was seen; fixed samples pull the nodes nearest to them.
std::vector<Node> nodesOf(std::span<const StrokeSample> run, std::span<const std::optional<Vec3>> fixed) {
  const std::vector<Vec3> picture = pictureOf(run);
  std::vector<double> way{0};
  for (std::size_t i = 1; i < run.size(); ++i) way.push_back(way.back() + distance(picture[i - 1], picture[i]));
  const int parts = std::max(2, static_cast<int>(std::ceil(way.back() / kFairedApart)));
  std::vector<Node> nodes;
  std::size_t i = 0;
  for (int k = 0; k <= parts; ++k) {
    const double here = way.back() * k / parts;
    while (i + 2 < run.size() && way[i + 1] < here) ++i;
    const double step = way[i + 1] - way[i], t = step > 0 ? std::clamp((here - way[i]) / step, 0.0, 1.0) : 0;
    const StrokeSample &a = run[i], &b = run[i + 1];
    Node node;
    node.ray = {lerp(a.ray.origin, b.ray.origin, t), normalized(lerp(a.ray.direction, b.ray.direction, t))};
    node.at = lerp(fixed[i].value_or(a.point), fixed[i + 1].value_or(b.point), t);
    node.fixed = fixed[i] && fixed[i + 1];
    node.certain = a.certain && b.certain;
    node.miss = std::max(kRayMiss, 0.3 * a.touching());
    nodes.push_back(node);
  }
  nodes.front().at = fixed.front().value_or(run.front().point);
  nodes.back().at = fixed.back().value_or(run.back().point);
  nodes.front().fixed = nodes.back().fixed = true;
  return nodes;
}

}  // namespace

std::vector<Vec3> faired(const Body& body, std::span<const StrokeSample> run,
                         std::span<const std::optional<Vec3>> fixed) {
  KARINUI_ASSERT(run.size() >= 2 && run.size() == fixed.size());
  std::vector<Node> nodes = nodesOf(run, fixed);
  const std::size_t n = nodes.size();
  // A wave of length L keeps 1 / (1 + stiff (h / L)^4 …) of its height: half of it at `shortest`.
  double touching = 0;
  for (const StrokeSample& s : run) touching = std::max(touching, s.touching());
  const double shortest = std::max(kShortest, 2.5 * touching);
  const double stiff = std::pow(shortest / (2 * 3.14159265358979) / kFairedApart, 4);
  const auto onSkin = [&](Vec3 p) { return body.bvh().nearest(p)->point; };
  for (Node& node : nodes) node.at = onSkin(node.at);
  for (int round = 0; round < kRounds; ++round) {
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (std::size_t i = 1; i + 1 < n; ++i) {
        Node& node = nodes[i];
        if (node.fixed) continue;
        // Every second difference the node has a part in.
        double bend = 0;
        Vec3 pull;
        for (std::size_t k = std::max<std::size_t>(i - 1, 1); k <= std::min(i + 1, n - 2); ++k) {
          const double own = k == i ? -2 : 1;
          Vec3 rest;
          for (std::size_t j = k - 1; j <= k + 1; ++j)
            if (j != i) rest += nodes[j].at * (j == k ? -2.0 : 1.0);
          bend += own * own * stiff;
          pull = pull - rest * (own * stiff);
        }
        // Across the view the ray holds it, along the ray nothing does.
        const Vec3 d = node.ray.direction, free = pull - node.ray.origin * bend;
        const double deep = dot(free, d) / bend;
        const Vec3 across = (free - d * dot(free, d)) * (1 / (bend + node.weight));
        node.at = onSkin(node.ray.origin + d * deep + across);
      }
    bool missed = false;
    for (Node& node : nodes)
      if (!node.fixed && node.certain && awayFromRay(node.ray, node.at) > node.miss) node.weight *= 6, missed = true;
    if (!missed) break;
  }
  std::vector<Vec3> line;
  for (const Node& node : nodes) line.push_back(node.at);
  return line;
}

}  // namespace karinui

#include "pattern_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace karinui::room {

namespace {

constexpr double kHigh = 0.86;                      // metres of the board above the floor
constexpr double kThick = 0.03, kLeg = 0.05;        // metres
constexpr double kMargin = 0.08;                    // metres of board round the paper
constexpr double kWideMost = 1.5, kDeepMost = 1.1;  // metres of board
constexpr double kWideLeast = 1.0, kDeepLeast = 0.7;
constexpr double kFromBody = 0.58;     // metres from the body's middle to the nearest edge of the board
constexpr double kTowards = 0.30;      // metres from the body's middle towards who looks, to the board's middle
constexpr double kBoardTurned = 0.70;  // radians the board is turned towards who stands before the body
constexpr double kPaper = 0.004;       // metres the paper lies above the board, or the two would flicker
constexpr double kInk = 0.007;         // and what is drawn on it
constexpr Colour kWood{0.36f, 0.24f, 0.15f};

SceneBody boxOf(Vec3 middle, Vec3 right, Vec3 away, double wide, double high, double deep, const Colour& colour) {
  SceneBody body;
  body.colour = colour;
  const Vec3 x = right * (wide / 2), y{0, high / 2, 0}, z = away * (deep / 2);
  // Corners of each side of its own, or the shading would be round.
  const Vec3 sides[6][3] = {{x, y, -z}, {-x, y, z}, {y, z, -x}, {-y, z, x}, {-z, x, -y}, {z, x, y}};
  for (const auto& side : sides) {
    const auto first = static_cast<std::uint32_t>(body.mesh.points.size());
    const Vec3 n = side[0], a = side[1], b = side[2];
    for (const Vec3 corner : {n - a - b, n + a - b, n + a + b, n - a + b}) body.mesh.points.push_back(middle + corner);
    const bool outward = dot(cross(a, b), n) > 0;
    if (outward) {
      body.mesh.faces.push_back({first, first + 1, first + 2});
      body.mesh.faces.push_back({first, first + 2, first + 3});
    } else {
      body.mesh.faces.push_back({first, first + 2, first + 1});
      body.mesh.faces.push_back({first, first + 3, first + 2});
    }
  }
  return body;
}

}  // namespace

PatternTable::PatternTable(Flat low, Flat high, bool mirrored) {
  const Flat size = high - low;
  paperMiddle_ = lerp(low, high, 0.5);
  scale_ = std::min(
      {1.0, (kWideMost - 2 * kMargin) / std::max(size.u, 1e-6), (kDeepMost - 2 * kMargin) / std::max(size.v, 1e-6)});
  wide_ = std::clamp(size.u * scale_ + 2 * kMargin, kWideLeast, kWideMost);
  deep_ = std::clamp(size.v * scale_ + 2 * kMargin, kDeepLeast, kDeepMost);
  // Someone at +z looks to the left (to the right, where it is mirrored): away from there is up on the paper.
  const double side = mirrored ? 1 : -1;
  away_ = {side * std::sin(kBoardTurned), 0, -std::cos(kBoardTurned)};
  right_ = cross(away_, Vec3{0, 1, 0});
  const double reach = (std::fabs(right_.x) * wide_ + std::fabs(away_.x) * deep_) / 2;
  middle_ = {side * (kFromBody + reach), kHigh, kTowards};
}

Vec3 PatternTable::at(Flat place, double above) const {
  const Flat p = (place - paperMiddle_) * scale_;
  return middle_ + right_ * p.u + away_ * p.v + Vec3{0, above, 0};
}

PatternTable::Met PatternTable::below(Vec3 tip) const {
  const Vec3 from = tip - middle_;
  const double u = dot(from, right_), v = dot(from, away_);
  return {paperMiddle_ + Flat{u, v} * (1 / scale_), from.y, std::fabs(u) <= wide_ / 2 && std::fabs(v) <= deep_ / 2};
}

std::optional<PatternTable::Met> PatternTable::meet(const Ray& ray) const {
  if (ray.direction.y > -1e-6 || ray.origin.y <= middle_.y) return std::nullopt;
  const double along = (middle_.y - ray.origin.y) / ray.direction.y;
  Met met = below(ray.origin + ray.direction * along);
  met.along = along;
  return met;
}

std::vector<SceneBody> PatternTable::boards() const {
  std::vector<SceneBody> parts{boxOf(middle_ - Vec3{0, kThick / 2, 0}, right_, away_, wide_, kThick, deep_, kWood)};
  for (const double u : {-1.0, 1.0})
    for (const double v : {-1.0, 1.0}) {
      const Vec3 foot = middle_ + right_ * (u * (wide_ / 2 - kLeg)) + away_ * (v * (deep_ / 2 - kLeg));
      parts.push_back(boxOf({foot.x, (kHigh - kThick) / 2, foot.z}, right_, away_, kLeg, kHigh - kThick, kLeg, kWood));
    }
  return parts;
}

PatternTable patternTableFor(const Session& session, bool mirrored) {
  const auto shown = session.shownPtr();
  FlatBox box;
  for (const auto& worn : shown->worn)
    for (const Flat corner : worn.ring) box.include(corner + session.table().at(worn.id));
  if (box.empty()) box = {{0, -0.8}, {1.1, 0}};
  return PatternTable(box.low, box.high, mirrored);
}

bool DrawnTable::follow(const Session& session, const PatternTable& top) {
  SnapshotPtr now = session.snapshotPtr();
  std::vector<Flat> lies;
  for (const auto& [id, piece] : now->document.pattern.pieces) lies.push_back(session.table().at(id));
  if (now == of_ && lies == lies_ && top == top_) return false;
  of_ = std::move(now), lies_ = std::move(lies), top_ = top;
  return true;
}

TablePlacement PatternTable::placement() const { return {at({0, 0}), right_ * scale_, away_ * scale_}; }

TableScene tableSceneFor(const Session& session, const PatternTable& top, Language language, LetteringRooms& rooms) {
  TableFrameOptions options;
  options.language = language;
  TableScene scene =
      sceneOf(tableFrameOf(session.snapshot(), session.table(), {}, options, &rooms), top.placement(), kPaper);
  std::vector<SceneBody> boards = top.boards();
  std::move(boards.begin(), boards.end(), std::back_inserter(scene.frame.bodies));
  return scene;
}

std::vector<SceneLine> linesOnTable(const TableOverlay& over, const PatternTable& top) {
  std::vector<SceneLine> lines;
  for (const TableLine& line : over.lines) {
    SceneLine drawn{{}, line.colour, 2.5f, false};
    for (const Flat p : line.points) drawn.points.push_back(top.at(p, kInk));
    lines.push_back(std::move(drawn));
  }
  const auto mark = [&](Flat place, bool filled) {
    constexpr int kSides = 16;
    constexpr double kRadius = 0.006;
    SceneLine round{{}, {0.66f, 0.09f, 0.023f}, filled ? 5.0f : 1.6f, false};
    for (int i = 0; i <= kSides; ++i) {
      const double a = 2 * 3.14159265358979323846 * i / kSides;
      round.points.push_back(top.at(place + Flat{std::cos(a), std::sin(a)} * kRadius, kInk));
    }
    lines.push_back(std::move(round));
  };
  for (const Flat dot : over.dots) mark(dot, true);
  for (const Flat ring : over.rings) mark(ring, false);
  return lines;
}

}  // namespace karinui::room

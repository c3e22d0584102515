#include "karinui/body/lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "karinui/base/result.h"
#include "karinui/geometry/geodesic.h"

namespace karinui {

namespace {

constexpr double kPlaceStep = 0.006;  // metres between the places of a line
constexpr int kPasses = 10;           // of smoothing: corners round off over about 2 cm
constexpr int kDirections = 96;       // directions of a ring

// How a line is found. Places are body places, mirrored for the right side; "a..b/n" are n + 1 places from a to b.
struct Recipe {
  std::string_view name;
  enum class Kind { Taut, Smooth, Ring, Below } kind;  // Below: in the middle plane, under the trunk
  bool sided;
  std::vector<std::string_view> through;
};

const std::vector<Recipe>& recipes() {
  using K = Recipe::Kind;
  static const std::vector<Recipe> all{
      {"centre_front", K::Smooth, false, {"landmark:neck_front", "torso:7.2@0..torso:0@0/36"}},
      {"centre_back", K::Smooth, false, {"landmark:neck_back", "torso:7.8@0.5..torso:0@0.5/39"}},
      {"side", K::Smooth, true, {"torso:5.7@0.25..torso:1@0.25/24", "left_leg:0.3@0.25..left_leg:2@0.25/17"}},
      {"shoulder", K::Taut, true, {"landmark:neck_left", "landmark:shoulder_left"}},
      {"neck_base",
       K::Ring,
       false,
       {"landmark:neck_front", "landmark:neck_left", "landmark:neck_back", "landmark:neck_right"}},
      {"armhole",
       K::Ring,
       true,
       {"landmark:shoulder_left", "torso:armpit+0.9@0.185", "torso:armpit+0.4@0.178", "torso:armpit@0.195",
        "torso:5.7@0.25", "torso:armpit@0.308", "torso:armpit+0.3@0.317", "torso:armpit+0.9@0.311"}},
      {"bust", K::Ring, false, {"torso:bust@*"}},
      {"under_bust", K::Ring, false, {"torso:under_bust@*"}},
      {"waist", K::Ring, false, {"torso:waist@*"}},
      {"hip", K::Ring, false, {"torso:hip@*"}},
      {"princess_front",
       K::Smooth,
       true,
       {"line:shoulder_left@0.5", "torso:armpit+0.4@0.085", "landmark:bust_left", "torso:under_bust@0.09",
        "torso:waist@0.095", "torso:high_hip@0.1", "torso:hip@0.105"}},
      {"princess_back",
       K::Smooth,
       true,
       {"line:shoulder_left@0.5", "torso:armpit+0.5@0.43", "torso:bust@0.415", "torso:under_bust@0.41",
        "torso:waist@0.41", "torso:high_hip@0.405", "torso:hip@0.4"}},
      {"crotch", K::Below, false, {"torso:hip@0", "torso:hip@0.5"}},
      {"knee", K::Ring, true, {"left_leg:knee@*"}},
      {"ankle", K::Ring, true, {"left_leg:ankle@*"}},
      {"elbow", K::Ring, true, {"left_arm:elbow@*"}},
      {"wrist", K::Ring, true, {"left_arm:wrist@*"}},
  };
  return all;
}

double lengthOf(const std::vector<Vec3>& points, bool closed) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
  return sum + (closed ? distance(points.back(), points.front()) : 0);
}

class Finder {
 public:
  explicit Finder(const Body& body) : body_(body), guide_(body.mesh()) {}

  std::vector<BodyLine> all() {
    for (const Recipe& recipe : recipes())
      for (const bool right : {false, true}) {
        if (right && !recipe.sided) continue;
        BodyLine line;
        line.name = std::string(recipe.name) + (!recipe.sided ? "" : right ? "_right" : "_left");
        line.closed = recipe.kind == Recipe::Kind::Ring;
        if (!find(recipe, right, line) || line.points.size() < 3) continue;
        line.length = lengthOf(line.points, line.closed);
        found_.push_back(std::move(line));
      }
    return std::move(found_);
  }

 private:
  std::optional<SurfacePoint> placeOf(BodyPoint point, bool right) const {
    if (right) {
      if (point.part == BodyPoint::Part::Line) {
        point.landmark = mirroredName(point.landmark);
      } else {
        const auto there = body_.mirrored(point);
        if (!there) return std::nullopt;
        point = *there;
      }
    }
    if (point.part == BodyPoint::Part::Line) {  // of those found already
      for (const BodyLine& line : found_)
        if (line.name == point.landmark) return body_.bvh().nearest(line.at(point.along))->place;
      return std::nullopt;
    }
    const auto place = body_.find(point);
    return place ? std::optional(*place) : std::nullopt;
  }

  // The body places a recipe's word stands for.
  std::vector<BodyPoint> spread(std::string_view word) const {
    std::vector<BodyPoint> points;
    const std::size_t dots = word.find(".."), slash = word.find('/');
    if (word.ends_with("@*")) {
      BodyPoint point = *parseBodyPoint(std::string(word.substr(0, word.size() - 1)) + "0");
      for (int k = 0; k < kDirections; ++k)
        point.around = static_cast<double>(k) / kDirections, points.push_back(point);
    } else if (dots != std::string_view::npos) {
      const BodyPoint a = *parseBodyPoint(word.substr(0, dots)),
                      b = *parseBodyPoint(word.substr(dots + 2, slash - dots - 2));
      const int n = std::stoi(std::string(word.substr(slash + 1)));
      for (int k = 0; k <= n; ++k) {
        points.push_back(a);
        points.back().along = std::lerp(a.along, b.along, static_cast<double>(k) / n);
      }
    } else {
      points.push_back(*parseBodyPoint(word));
    }
    return points;
  }

  bool find(const Recipe& recipe, bool right, BodyLine& line) const {
    std::vector<SurfacePoint> through;
    std::size_t missed = 0;
    for (const std::string_view word : recipe.through) {
      double lowest = 1e9;  // of this word: levels run down, but right under the armpit some are one
      for (const BodyPoint& point : spread(word)) {
        const auto place = placeOf(point, right);
        if (!place) {
          ++missed;
          continue;
        }
        const double height = karinui::at(body_.mesh(), *place).y;
        if (word.find("..") != std::string_view::npos && height > lowest) continue;
        lowest = height;
        through.push_back(*place);
      }
    }
    if (through.size() < 2 || missed > through.size() / 4) return false;
    if (recipe.kind == Recipe::Kind::Taut || recipe.kind == Recipe::Kind::Below) {
      const double middle = karinui::at(body_.mesh(), through.front()).x;
      const auto way = recipe.kind == Recipe::Kind::Taut
                           ? guide_.straight(through.front(), through.back())
                           : guide_.section(through.front(), through.back(), {1, 0, 0}, middle);
      if (!way) return false;
      line.points = evenly(way->points, false);
      return true;
    }
    std::vector<Vec3> points;
    for (const SurfacePoint& place : through) {
      const Vec3 p = karinui::at(body_.mesh(), place);
      // The chart may name one place twice where a part begins.
      if (points.empty() || distance(points.back(), p) > kPlaceStep / 2) points.push_back(p);
    }
    if (points.size() < 3) return false;
    line.points = evenly(curved(points, line.closed), line.closed);
    smooth(line.points, line.closed);
    return true;
  }

  Vec3 onSkin(Vec3 place) const { return body_.bvh().nearest(place)->point; }

  // A centripetal Catmull-Rom curve (Barry and Goldman 1988) through the places, put onto the skin.
  std::vector<Vec3> curved(const std::vector<Vec3>& p, bool closed) const {
    const std::size_t n = p.size();
    std::vector<Vec3> line;
    for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
      const Vec3 b = p[i], c = p[(i + 1) % n];
      const Vec3 a = i > 0 ? p[i - 1] : closed ? p[n - 1] : b * 2 - c;
      const Vec3 d = i + 2 < n ? p[i + 2] : closed ? p[(i + 2) % n] : c * 2 - b;
      const auto knot = [](Vec3 from, Vec3 to) { return std::max(std::sqrt(distance(from, to)), 1e-6); };
      const double t1 = knot(a, b), t2 = t1 + knot(b, c), t3 = t2 + knot(c, d);
      const int parts = std::max(1, static_cast<int>(std::ceil(distance(b, c) / kPlaceStep)));
      for (int k = 0; k < parts; ++k) {
        const double x = std::lerp(t1, t2, static_cast<double>(k) / parts);
        const auto mix = [x](Vec3 from, Vec3 to, double low, double high) {
          return lerp(from, to, (x - low) / (high - low));
        };
        const Vec3 q = mix(a, b, 0, t1), r = mix(b, c, t1, t2), s = mix(c, d, t2, t3);
        line.push_back(onSkin(mix(mix(q, r, 0, t2), mix(r, s, t1, t3), t1, t2)));
      }
    }
    if (!closed) line.push_back(p.back());
    return line;
  }

  std::vector<Vec3> evenly(const std::vector<Vec3>& line, bool closed) const {
    BodyLine old;
    old.points = line;
    old.closed = closed;
    old.length = lengthOf(line, closed);
    const int parts = std::max(4, static_cast<int>(std::round(old.length / kPlaceStep)));
    std::vector<Vec3> points;
    for (int k = 0; k + (closed ? 1 : 0) <= parts; ++k)
      points.push_back(onSkin(old.at(static_cast<double>(k) / parts)));
    return points;
  }

  // Ends stay. The line stays on the skin.
  void smooth(std::vector<Vec3>& line, bool closed) const {
    const std::size_t n = line.size();
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::vector<Vec3> old = line;
      for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < n; ++i)
        line[i] = onSkin(old[i] * 0.5 + (old[(i + n - 1) % n] + old[(i + 1) % n]) * 0.25);
    }
  }

  const Body& body_;
  SurfaceGuide guide_;
  std::vector<BodyLine> found_;
};

}  // namespace

Vec3 BodyLine::at(double share) const {
  double left = std::clamp(share, 0.0, 1.0) * length;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const Vec3 a = points[i], b = points[(i + 1) % n];
    const double step = distance(a, b);
    if (left <= step) return step > 0 ? lerp(a, b, left / step) : a;
    left -= step;
  }
  return closed ? points.front() : points.back();
}

double BodyLine::nearest(Vec3 place, double& away) const {
  const std::size_t n = points.size();
  double done = 0, best = 0;
  away = 1e9;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const Vec3 a = points[i], side = points[(i + 1) % n] - a;
    const double ss = squaredLength(side), step = std::sqrt(ss);
    const double t = ss > 0 ? std::clamp(dot(place - a, side) / ss, 0.0, 1.0) : 0.0;
    if (const double d = distance(place, a + side * t); d < away) away = d, best = done + t * step;
    done += step;
  }
  return length > 0 ? std::min(1.0, best / length) : 0;
}

std::span<const std::string_view> bodyLineNames() {
  static const std::vector<std::string> kept = [] {
    std::vector<std::string> all;
    for (const Recipe& recipe : recipes())
      for (const char* side : {"_left", "_right"}) {
        if (recipe.sided)
          all.push_back(std::string(recipe.name) + side);
        else if (std::string_view(side) == "_left")
          all.emplace_back(recipe.name);
      }
    return all;
  }();
  static const std::vector<std::string_view> names(kept.begin(), kept.end());
  return names;
}

Message bodyLineSaid(std::string_view name) {
  const bool left = name.ends_with("_left"), right = name.ends_with("_right");
  const std::string_view kind = name.substr(0, name.size() - (left ? 5 : right ? 6 : 0));
  static const std::map<std::string_view, Message> words{{"centre_front", say("centre front line")},
                                                         {"centre_back", say("centre back line")},
                                                         {"side", say("side line")},
                                                         {"shoulder", say("shoulder line")},
                                                         {"neck_base", say("neck base line")},
                                                         {"armhole", say("armhole line")},
                                                         {"bust", say("bust line")},
                                                         {"under_bust", say("under-bust line")},
                                                         {"waist", say("waist line")},
                                                         {"hip", say("hip line")},
                                                         {"princess_front", say("front princess line")},
                                                         {"princess_back", say("back princess line")},
                                                         {"crotch", say("crotch line")},
                                                         {"knee", say("knee line")},
                                                         {"ankle", say("ankle line")},
                                                         {"elbow", say("elbow line")},
                                                         {"wrist", say("wrist line")}};
  const auto at = words.find(kind);
  KARINUI_ASSERT(at != words.end());
  if (left) return say("{0} (left)", at->second);
  if (right) return say("{0} (right)", at->second);
  return at->second;
}

const BodyLine* bodyLine(const Body& body, std::string_view name) {
  for (const BodyLine& line : body.lines())
    if (line.name == name) return &line;
  return nullptr;
}

std::vector<BodyLine> findBodyLines(const Body& body) { return Finder(body).all(); }

std::vector<LineCrossing> lineCrossings(const Body& body) {
  constexpr double kMeet = 0.004;  // metres: the lines are chords a few millimetres long on a round body
  constexpr double kEnds = 0.015;  // and where one ends at the other, which was smoothed there: the side at the armhole
  constexpr double kApart = 0.06;  // metres: a line may cross another shortly before it ends at it
  const auto& lines = body.lines();
  std::vector<Box> boxes(lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k)
    for (const Vec3 p : lines[k].points) boxes[k].include(p);
  std::vector<LineCrossing> found;
  for (std::size_t a = 0; a < lines.size(); ++a)
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      const auto apart = [&](double aLow, double aHigh, double bLow, double bHigh) {
        return aLow > bHigh + kEnds || bLow > aHigh + kEnds;
      };
      const Box &p = boxes[a], &q = boxes[b];
      if (apart(p.low.x, p.high.x, q.low.x, q.high.x) || apart(p.low.y, p.high.y, q.low.y, q.high.y) ||
          apart(p.low.z, p.high.z, q.low.z, q.high.z))
        continue;
      // Down the distance from every place of a that is near b: to b, and from there to a, until both are met.
      std::vector<std::pair<double, LineCrossing>> met;
      for (const Vec3 from : lines[a].points) {
        double away = 0, back = 0;
        LineCrossing here{a, b, 0, lines[b].nearest(from, away), from};
        if (away > kEnds) continue;
        for (int k = 0; k < 20; ++k) {
          here.onA = lines[a].nearest(lines[b].at(here.onB), back);
          here.place = lines[a].at(here.onA);
          here.onB = lines[b].nearest(here.place, away);
        }
        const auto ends = [](const BodyLine& line, double share) { return !line.closed && (share == 0 || share == 1); };
        const bool end = ends(lines[a], here.onA) || ends(lines[b], here.onB);
        if (away < (end ? kEnds : kMeet)) met.push_back({away, here});
      }
      std::stable_sort(met.begin(), met.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
      std::vector<LineCrossing> own;
      for (const auto& [away, one] : met)
        if (std::none_of(own.begin(), own.end(),
                         [&, place = one.place](const LineCrossing& o) { return distance(o.place, place) < kApart; }))
          own.push_back(one);
      found.insert(found.end(), own.begin(), own.end());
    }
  return found;
}

std::string mirroredName(std::string_view name) {
  for (const auto& [from, to] : {std::pair<std::string_view, std::string_view>{"_left", "_right"}, {"_right", "_left"}})
    if (name.ends_with(from)) return std::string(name.substr(0, name.size() - from.size())) + std::string(to);
  return std::string(name);
}

}  // namespace karinui

// Drawing on the body: strokes and clicks make one line over the skin. It ends by itself where it meets its own
// beginning, or, drawn from centre to centre, as one half of a symmetric piece. Its places are drawn to what lies there
// (DrawSnaps), and a run that was meant straight, or along an outline, becomes so; Alt leaves both out.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "karinui/geometry/geodesic.h"
#include "session/draw_snaps.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kMeets = 0.022;     // metres: an end this near to the beginning closes the line
constexpr double kAgain = 0.003;     // metres: a click this near to the last one ends the line
constexpr double kCentre = 0.020;    // metres from the body's middle plane that still mean the middle
constexpr double kStep = 0.004;      // metres a stroke goes before it is noted
constexpr double kMiss = 0.004;      // metres a kept line may pass from the drawn one
constexpr double kLongest = 0.11;    // metres between two kept places of a stroke
constexpr double kStraight = 0.006;  // metres a run may pass from the straight line over the skin and be meant so
constexpr double kLook = 0.022;      // metres before and after a place over which its turn is judged
constexpr double kCorner = 42 * std::numbers::pi / 180;

struct Noted {
  SurfacePoint place;
  Vec3 point;
  bool corner = true;
};

double turnAt(std::span<const Noted> line, std::size_t i) {
  std::size_t a = i, b = i;
  while (a > 0 && distance(line[a].point, line[i].point) < kLook) --a;
  while (b + 1 < line.size() && distance(line[b].point, line[i].point) < kLook) ++b;
  const Vec3 in = line[i].point - line[a].point, out = line[b].point - line[i].point;
  return std::atan2(length(cross(in, out)), dot(in, out));
}

// A stroke's places that matter: corners where the hand turned sharply, and enough between for a smooth curve.
std::vector<Noted> thinned(const std::vector<Noted>& stroke) {
  std::vector<Vec3> points;
  for (const Noted& n : stroke) points.push_back(n.point);
  std::vector<Noted> kept;
  std::size_t before = 0;
  for (const std::size_t i : mattering<Vec3>(points, kMiss)) {
    for (std::size_t k = before + 1; k < i; ++k)
      if (distance(kept.back().point, points[k]) > kLongest && distance(points[k], points[i]) > kLongest / 3)
        kept.push_back({stroke[k].place, points[k], false});
    const bool end = i == 0 || i + 1 == stroke.size();
    const double turn = end ? 10 : turnAt(stroke, i);
    Noted here{stroke[i].place, points[i], turn > kCorner};
    // Two corners a finger's breadth apart are one, the sharper.
    if (!kept.empty() && !end && here.corner && kept.back().corner && distance(kept.back().point, here.point) < 0.015)
      here.corner = false;
    if (!kept.empty() && !end && !here.corner && distance(kept.back().point, here.point) < 0.012) continue;
    kept.push_back(here);
    before = i;
  }
  return kept;
}

BodyPoint spoken(const Body& body, const SurfacePoint& place) {
  BodyPoint exact = body.describe(place);
  if (exact.part == BodyPoint::Part::Face || exact.part == BodyPoint::Part::Landmark) return exact;
  BodyPoint rounded = exact;
  rounded.along = std::round(exact.along * 1e4) / 1e4;
  rounded.around = std::fmod(std::round(exact.around * 1e4) / 1e4, 1.0);
  const auto there = body.find(rounded);
  if (!there || distance(at(body.mesh(), *there), at(body.mesh(), place)) > 0.002) return exact;
  return rounded;
}

// What a tailor would call a piece that lies there.
std::string calledBy(const std::vector<BodyPoint>& line, bool symmetric) {
  int arm = 0, leg = 0, left = 0;
  double front = 0;
  for (const BodyPoint& p : line) {
    arm += p.part == BodyPoint::Part::LeftArm || p.part == BodyPoint::Part::RightArm;
    leg += p.part == BodyPoint::Part::LeftLeg || p.part == BodyPoint::Part::RightLeg;
    left += p.part == BodyPoint::Part::LeftArm || p.part == BodyPoint::Part::LeftLeg ||
            (p.part == BodyPoint::Part::Torso && p.around > 0 && p.around < 0.5);
    if (p.part == BodyPoint::Part::Torso) front += std::cos(2 * std::numbers::pi * p.around);
  }
  const int half = static_cast<int>(line.size()) / 2;
  const std::string side = symmetric ? "" : left > half ? "_left" : "_right";
  if (arm > half) return "sleeve" + side;
  if (leg > half) return "leg" + side;
  return (front >= 0 ? "front" : "back") + (left > 0 && left < static_cast<int>(line.size()) ? std::string() : side);
}

class DrawGesture : public Gesture {
 public:
  Told feed(const PointerSample& sample, const Hit&, const Workbench& bench) override {
    if (sample.where != PointerSample::Where::Space) return {};
    const Fitting& fitting = *bench.fitting;
    Hit skin = pickBody(fitting, sample);
    const bool on = skin.on == Hit::On::Body;
    free_ = sample.alt;
    snap_.reset();
    if (on && !free_ && sample.phase != PointerSample::Phase::Drag) {
      snaps_.of(bench.fitting);
      if ((snap_ = snaps_.near(skin.point))) skin.skin = snap_->skin, skin.point = snap_->point;
    }
    hover_ = on ? std::optional(Noted{skin.skin, skin.point}) : std::nullopt;
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        return {};
      case PointerSample::Phase::Press:
        if (!fitting.body) return {.why = say("There is no body to draw on; choose one in the body panel.")};
        if (!on) return {.why = say("Begin the line on the body.")};
        smooth_ = sample.shift;
        stroke_ = {Noted{skin.skin, skin.point}};
        return {};
      case PointerSample::Phase::Drag:
        straight_ = sample.control;
        if (!stroke_.empty() && on && straight_) stroke_.resize(1);  // as a ruler lies: only its ends count
        if (!stroke_.empty() && on && distance(skin.point, stroke_.back().point) >= kStep)
          stroke_.push_back({skin.skin, skin.point, straight_});
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    if (stroke_.empty()) return {};
    if (snap_)  // no hook where the line is drawn to its end
      while (stroke_.size() > 1 && distance(stroke_.back().point, skin.point) < 2 * kStep) stroke_.pop_back();
    if (on && distance(skin.point, stroke_.back().point) > 1e-9 && (stroke_.size() > 1 || snap_))
      stroke_.push_back({skin.skin, skin.point, false});
    double way = 0;
    for (std::size_t i = 1; i < stroke_.size(); ++i) way += distance(stroke_[i - 1].point, stroke_[i].point);
    const bool click = way < 2 * kStep;
    if (click && !parts_.empty() && distance(parts_.back().back().point, stroke_.front().point) < kAgain) {
      stroke_.clear();
      return ended(bench, true);
    }
    std::vector<Noted> part = click ? std::vector{stroke_.front()} : meant(thinned(stroke_), bench);
    stroke_.clear();
    if (click) part.front().corner = !smooth_;
    if (!parts_.empty() && !click && distance(parts_.back().back().point, part.front().point) < kMeets)
      part.erase(part.begin());
    if (part.empty()) return {};
    parts_.push_back(std::move(part));
    return ended(bench, false);
  }

  Told confirm(const Workbench& bench) override { return parts_.empty() ? Told{} : ended(bench, true); }

  bool takeBack() override {
    if (!stroke_.empty()) return stroke_.clear(), true;
    if (parts_.empty()) return false;
    parts_.pop_back();
    return true;
  }

  Preview preview(const Workbench& bench) const override {
    Preview shown;
    std::vector<Vec3> line = path(bench);
    for (const auto& part : parts_)
      for (const Noted& n : part)
        if (n.corner) shown.space.dots.push_back(n.point);
    if (!stroke_.empty())
      for (const Noted& n : stroke_) line.push_back(n.point);
    else if (hover_ && !parts_.empty())
      line.push_back(hover_->point);
    if (hover_ && stroke_.empty()) shown.space.dots.push_back(hover_->point);
    if (line.size() > 1) shown.space.lines.push_back({std::move(line), kChalk, 3, false});
    return shown;
  }

  Message hint() const override {
    if (snap_) return snap_->what;
    if (parts_.empty() && stroke_.empty()) return info(Command::Draw).hint;
    return say(
        "End the line where it began, or on the body's centre; Enter closes it, undo takes back the last stroke.");
  }
  bool begun() const override { return !parts_.empty() || !stroke_.empty(); }
  Stops stops() const override { return Stops::Skin; }
  bool clicks() const override { return true; }

 private:
  std::vector<Noted> all() const {
    std::vector<Noted> line;
    for (const auto& part : parts_) line.insert(line.end(), part.begin(), part.end());
    return line;
  }

  // Each run between two corners as it was meant: straight over the skin, along an outline, or as it was drawn.
  std::vector<Noted> meant(const std::vector<Noted>& line, const Workbench& bench) const {
    if (free_ || line.size() < 3) return line;
    std::vector<Noted> better;
    for (std::size_t from = 0, to = 0; from + 1 < line.size(); from = to) {
      for (to = from + 1; to + 1 < line.size() && !line[to].corner; ++to) {
      }
      better.push_back(line[from]);
      const bool round = distance(line[from].point, line[to].point) < kMeets;
      const auto way = guide(bench).straight(line[from].place, line[to].place);
      if (!round && way && !strays(line[from].point, line[to].point, way->points)) continue;
      std::vector<Vec3> places;
      for (std::size_t i = from + 1; i < to; ++i) places.push_back(line[i].point);
      if (const auto run = snaps_.along(places))
        for (const DrawSnaps::Snap& s : *run) better.push_back({s.skin, s.point, false});
      else
        better.insert(better.end(), line.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                      line.begin() + static_cast<std::ptrdiff_t>(to));
    }
    better.push_back(line.back());
    return better;
  }
  // Whether the stroke between two of its places leaves the straight way.
  bool strays(Vec3 from, Vec3 to, const std::vector<Vec3>& way) const {
    const auto at = [&](Vec3 p) {
      return std::find_if(stroke_.begin(), stroke_.end(), [&](const Noted& n) { return n.point == p; });
    };
    for (auto n = at(from); n != stroke_.end() && n->point != to; ++n) {
      double nearest = 1e9;
      for (std::size_t i = 0; i + 1 < way.size(); ++i)
        nearest = std::min(nearest, awayFromSegment(way[i], way[i + 1], n->point));
      if (nearest > kStraight) return true;
    }
    return false;
  }

  const SurfaceGuide& guide(const Workbench& bench) const {
    if (guideOf_ != bench.fitting->body) {
      guideOf_ = bench.fitting->body;
      guide_ = std::make_unique<SurfaceGuide>(guideOf_->mesh());
      known_.clear();
    }
    return *guide_;
  }

  // The line as it runs over the skin.
  std::vector<Vec3> path(const Workbench& bench) const {
    const std::vector<Noted> line = all();
    std::vector<Vec3> points;
    if (!bench.fitting->body) return points;
    const SurfaceGuide& skin = guide(bench);
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (i > 0) {
        if (known_.size() < i) {
          auto way = skin.straight(line[i - 1].place, line[i].place);
          known_.push_back({line[i - 1].point, line[i].point, way ? way->points : std::vector<Vec3>{}});
        }
        Known& leg = known_[i - 1];
        if (leg.from != line[i - 1].point || leg.to != line[i].point) {
          auto way = skin.straight(line[i - 1].place, line[i].place);
          leg = {line[i - 1].point, line[i].point, way ? way->points : std::vector<Vec3>{}};
        }
        points.insert(points.end(), leg.points.begin(), leg.points.end());
      }
      points.push_back(line[i].point);
    }
    return points;
  }

  Told ended(const Workbench& bench, bool asked) {
    const std::vector<Noted> line = all();
    if (line.size() < 2)
      return asked ? Told{.why = say("A line needs at least three places to hold a piece of cloth.")} : Told{};
    const Vec3 a = line.front().point, b = line.back().point;
    const bool meets = line.size() > 3 && distance(a, b) < kMeets;
    const auto middle = [](Vec3 p) { return std::fabs(p.x) < kCentre; };
    const bool half = !meets && line.size() > 2 && middle(a) && middle(b) && distance(a, b) > 3 * kMeets;
    if (!meets && !half && !asked) return {};
    if (asked && line.size() < 3) return {.why = say("A line needs at least three places to hold a piece of cloth.")};

    const Body& body = *bench.fitting->body;
    DrawPiece draw;
    draw.symmetric = half;
    std::size_t count = line.size();
    if (meets) --count;
    int corners = 0;
    for (std::size_t i = 0; i < count; ++i) {
      BodyPoint point = spoken(body, line[i].place);
      const bool end = half && (i == 0 || i + 1 == count);
      if (end) {
        if (point.part != BodyPoint::Part::Torso)
          return refuse(say("A half line begins and ends on the middle of the trunk."));
        point.around = point.around > 0.25 && point.around < 0.75 ? 0.5 : 0;
      }
      draw.line.push_back(point);
      const bool last = half && i + 1 == count;
      if (!last) draw.edges.push_back(line[i].corner || i == 0 ? "e" + std::to_string(++corners) : "~");
    }
    draw.name = usableName(bench.fitting->document, calledBy(draw.line, draw.symmetric));
    parts_.clear();
    hover_.reset();
    return {.over = true, .operation = std::move(draw)};
  }

  Told refuse(Message why) {
    parts_.pop_back();
    return {.why = std::move(why)};
  }

  std::vector<std::vector<Noted>> parts_;
  std::vector<Noted> stroke_;
  std::optional<Noted> hover_;
  bool smooth_ = false, straight_ = false, free_ = false;
  DrawSnaps snaps_;
  std::optional<DrawSnaps::Snap> snap_;  // what the hand is drawn to now
  struct Known {
    Vec3 from, to;
    std::vector<Vec3> points;
  };
  mutable BodyPtr guideOf_;
  mutable std::unique_ptr<SurfaceGuide> guide_;
  mutable std::vector<Known> known_;
};

}  // namespace

std::unique_ptr<Gesture> drawGesture() { return std::make_unique<DrawGesture>(); }

}  // namespace karinui

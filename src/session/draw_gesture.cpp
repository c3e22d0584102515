// Drawing on the body: strokes and clicks make one line over the skin. It ends by itself where it meets its own
// beginning, or, drawn from centre to centre, as one half of a symmetric piece. Its places are drawn to what lies there
// (DrawSnaps), and a run that was meant straight, or along an outline, becomes so; Alt leaves both out.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "karinui/geometry/geodesic.h"
#include "karinui/session/touch_scene_of.h"
#include "session/draw_snaps.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kMeets = 0.022;      // metres: an end this near to the beginning closes the line
constexpr double kAgain = 0.003;      // metres: a click this near to the last one ends the line
constexpr double kCentre = 0.020;     // metres from the body's middle plane that still mean the middle
constexpr double kPointStep = 0.004;  // metres a stroke goes before it is noted
constexpr double kMiss = 0.004;       // metres a kept line may pass from the drawn one
constexpr double kLongest = 0.11;     // metres between two kept places of a stroke
constexpr double kAlong = 0.15;       // metres between two kept places along a line of the body,
constexpr double kBent = 0.7;         // and how far it may turn between them
constexpr double kMean = 0.6;         // of touching: over which a stroke is averaged to find its corners
constexpr double kFollowed = 0.15;    // metres along a line of the body that make an edge of their own
constexpr double kGap = 0.03;         // metres a run may leave the line it follows
constexpr double kApart = 0.015;      // metres between two corners
constexpr double kClose = 0.012;      // metres between two kept places, at the least
constexpr double kTremble = 1.5;      // of how near is touching: how far a hand in the air goes meanwhile as it clicks
constexpr double kFar = 0.03;         // metres over the skin that are noted even where nothing moved across the view
constexpr double kTurned = 0.9994;    // cosine of the turn of the view (2 degrees) that begins another stroke
constexpr double kStraight = 0.006;   // metres a run may pass from the straight line over the skin and be meant so
constexpr double kLook = 0.022;       // metres before and after a place over which its turn is judged
constexpr double kCorner = 42 * std::numbers::pi / 180;

struct Noted {
  SurfacePoint place;
  Vec3 point;
  bool corner = true;
  bool held = false;                    // snapped to a place: nothing moves it
  std::optional<BodyPoint> named = {};  // on a line of the body
  std::string run = {};                 // the body's line that is followed from here
};

double turnAt(std::span<const Vec3> line, std::size_t i, double look) {
  std::size_t a = i, b = i;
  while (a > 0 && distance(line[a], line[i]) < look) --a;
  while (b + 1 < line.size() && distance(line[b], line[i]) < look) ++b;
  const Vec3 in = line[i] - line[a], out = line[b] - line[i];
  return std::atan2(length(cross(in, out)), dot(in, out));
}

// Where the hand turned sharply, as it was seen: in depth a pixel at the silhouette is a corner. Ends included.
std::vector<std::size_t> cornersOf(std::span<const StrokeSample> stroke) {
  const std::vector<Vec3> seen = pictureOf(stroke);
  double touching = 0;
  for (const StrokeSample& s : stroke) touching = std::max(touching, s.touching());
  // The mean over a few pixels: a waver is no corner.
  std::vector<Vec3> picture;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    Vec3 sum = seen[i];
    double count = 1;
    for (std::size_t back = i; back-- > 0 && i + (i - back) < seen.size();) {
      const std::size_t on = i + (i - back);
      if (std::max(distance(seen[back], seen[i]), distance(seen[on], seen[i])) > kMean * touching) break;
      sum += seen[back] + seen[on], count += 2;
    }
    picture.push_back(sum * (1 / count));
  }
  const double look = std::max(kLook, 1.4 * touching), apart = std::max(kApart, touching);
  std::vector<std::size_t> corners{0};
  double last = 10;
  for (const std::size_t i : mattering<Vec3>(picture, std::max(kMiss, 0.3 * touching))) {
    if (i == 0 || i + 1 == stroke.size()) continue;
    const double turn = turnAt(picture, i, look);
    if (turn < kCorner) continue;
    // Two a finger's breadth apart are one, the sharper.
    const bool same = distance(picture[corners.back()], picture[i]) < apart;
    if (same && turn <= last) continue;
    if (same) corners.pop_back();
    corners.push_back(i), last = turn;
  }
  if (corners.size() > 1 && distance(picture[corners.back()], picture.back()) < apart) corners.pop_back();
  corners.push_back(stroke.size() - 1);
  return corners;
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

// What a tailor calls an edge along a line of the body: the neck base is the neckline, the lowest level line the hem.
std::string edgeCalled(const std::string& run, std::span<const Noted> line, double height) {
  constexpr double kLevel = 0.02;  // metres
  if (run == "neck_base") return "neck";
  const bool level = run == "bust" || run == "under_bust" || run == "waist" || run == "hip" ||
                     run.starts_with("knee") || run.starts_with("ankle");
  const auto lower = [&](const Noted& n) { return n.point.y < height - kLevel; };
  return level && std::none_of(line.begin(), line.end(), lower) ? "hem" : run;
}

// An edge along a line of the body is called after it: "side"; any other by its number. ~ where the line curves on.
std::vector<std::string> edgeNames(std::span<const Noted> line, bool half) {
  std::vector<std::string> names;
  int corners = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!line[i].corner && i > 0) {
      names.emplace_back("~");
      continue;
    }
    std::string name = line[i].run;
    for (std::size_t k = i + 1; k < line.size() && !line[k].corner; ++k)
      if (!line[k].named || line[k].named->landmark != line[i].run) name.clear();
    name = edgeCalled(name, line, line[i].point.y);
    if (half)  // its halves are told apart by _left and _right
      for (const std::string_view side : {"_left", "_right"})
        if (name.ends_with(side)) name.resize(name.size() - side.size());
    ++corners;
    if (name.empty() || std::find(names.begin(), names.end(), name) != names.end())
      name = "e" + std::to_string(corners);
    names.push_back(name);
  }
  return names;
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
  GestureResult feed(const PointerSample& sample, const Hit&, const GestureContext& context) override {
    if (sample.where != PointerSample::Where::Space) return {};
    const GarmentSnapshot& snapshot = *context.snapshot;
    const bool drawing = !stroke_.empty();
    auto here = strokeSample(snapshot, sample, drawing ? std::optional(stroke_.back().point) : std::nullopt);
    free_ = sample.alt;
    snap_.reset();
    if (here && !free_ && sample.phase != PointerSample::Phase::Drag) {
      snaps_.of(context.snapshot);
      snap_ = snaps_.near(*here, context.linesShown);
    }
    hover_ = here ? std::optional(snap_ ? snap_->seen : here->point) : std::nullopt;
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        return {};
      case PointerSample::Phase::Press:
        if (!snapshot.body) return {.why = say("There is no body to draw on; choose one in the body panel.")};
        if (!here)
          return {.why = parts_.empty() ? say("Begin the line on the body.")
                                        : say("That is beside the body; go on with the line on the body, or at an edge "
                                              "or a corner of a piece.")};
        smooth_ = sample.shift;
        continues_ = false;
        stroke_ = {*here};
        began_ = snap_;
        return {};
      case PointerSample::Phase::Drag:
        straight_ = sample.control;
        if (!drawing || !here) return {};
        if (dot(here->facing, stroke_.front().facing) < kTurned) {  // seen from elsewhere the line goes on
          part(context, std::nullopt, false);
          began_.reset();
          stroke_ = {*here};
          return {};
        }
        if (straight_) stroke_.resize(1);  // as a ruler lies: only its ends count
        if (awayFromRay(here->ray, stroke_.back().point) >= kPointStep ||
            distance(here->point, stroke_.back().point) >= kFar)
          stroke_.push_back(*here);
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    if (!drawing) return {};
    if (snap_)  // no hook where the line is drawn to its end
      while (stroke_.size() > 1 && awayFromRay(here->ray, stroke_.back().point) < 2 * kPointStep) stroke_.pop_back();
    if (here && (stroke_.size() > 1 || snap_) && distance(here->point, stroke_.back().point) > 1e-9)
      stroke_.push_back(*here);
    if (drawn(sample.device)) {
      part(context, snap_, true);
      return ended(context, false);
    }
    const Noted click =
        began_ ? noted(*began_, !smooth_) : Noted{stroke_.front().skin, stroke_.front().point, !smooth_};
    stroke_.clear();
    if (!parts_.empty() && distance(parts_.back().back().point, click.point) < kAgain) return ended(context, true);
    std::vector<Noted> leg;
    if (!parts_.empty() && !free_ && context.linesShown && !smooth_) leg = legOf(parts_.back().back(), click, *here);
    leg.push_back(click);
    parts_.push_back(std::move(leg));
    return ended(context, false);
  }

  GestureResult confirm(const GestureContext& context) override {
    return parts_.empty() ? GestureResult{} : ended(context, true);
  }

  bool takeBack() override {
    if (!stroke_.empty()) return stroke_.clear(), true;
    if (parts_.empty()) return false;
    parts_.pop_back();
    return true;
  }

  Preview preview(const GestureContext& context) const override {
    Preview shown;
    std::vector<Vec3> line = path(context);
    for (const auto& part : parts_)
      for (const Noted& n : part)
        if (n.corner) shown.space.dots.push_back(n.point);
    if (!stroke_.empty())
      for (const StrokeSample& s : stroke_) line.push_back(s.point);
    else if (hover_ && !parts_.empty())
      line.push_back(*hover_);
    if (hover_ && stroke_.empty()) shown.space.dots.push_back(*hover_);
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
  void addTo(Handling& handling) const override {
    if (snap_) handling.snap = snap_->corner ? 2 : 1;
  }
  KeyStops keyStops() const override { return KeyStops::Skin; }
  bool clicks() const override { return true; }

 private:
  std::vector<Noted> all() const {
    std::vector<Noted> line;
    for (const auto& part : parts_) line.insert(line.end(), part.begin(), part.end());
    return line;
  }

  static Noted noted(const DrawSnaps::Snap& snap, bool corner) {
    return {snap.skin, snap.point, corner, snap.corner, snap.named};
  }

  // The stroke in hand becomes a part of the line: its corners where they snap, each run between two of them as it was
  // meant. `corner`: the line turns at its end.
  void part(const GestureContext& context, const std::optional<DrawSnaps::Snap>& end, bool corner) {
    std::vector<StrokeSample> stroke = std::exchange(stroke_, {});
    if (stroke.size() < 2) {
      continues_ = !corner;
      if (parts_.empty() && !stroke.empty()) parts_.push_back({Noted{stroke[0].skin, stroke[0].point}});
      return;
    }
    if (!free_) snaps_.of(context.snapshot);
    std::vector<std::size_t> corners = atLines(cornersOf(stroke), stroke);
    std::vector<Noted> line;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const StrokeSample& s = stroke[corners[k]];
      std::optional<DrawSnaps::Snap> snap = k == 0 ? began_ : k + 1 == corners.size() ? end : std::nullopt;
      if (!free_ && !snap && k > 0 && k + 1 < corners.size())
        if (const auto near = snaps_.near(s, context.linesShown); near && near->corner) snap = near;
      line.push_back(snap ? noted(*snap, true) : Noted{s.skin, s.point});
    }
    // No corner where a line of the body that is followed from place to place turns away from the eye.
    for (std::size_t k = 0, next = 0; k + 1 < line.size(); k = next) {
      next = k + 1;
      while (next + 1 < line.size() && !line[next].held) ++next;
      const auto curve = next > k + 1 && line[k].held && line[next].held
                             ? snaps_.lineThrough(line[k].point, line[next].point)
                             : std::nullopt;
      const auto lies = [&](const Noted& n) {
        return distance(snaps_.at(*curve, snaps_.nearest(*curve, n.point)), n.point) < kGap;
      };
      const auto from = static_cast<std::ptrdiff_t>(k + 1), to = static_cast<std::ptrdiff_t>(next);
      if (!curve || !std::all_of(line.begin() + from, line.begin() + to, lies)) continue;
      line.erase(line.begin() + from, line.begin() + to);
      corners.erase(corners.begin() + from, corners.begin() + to);
      next = k + 1;
    }
    std::vector<Noted> better;
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
      const std::span<const StrokeSample> run(stroke.data() + corners[k], corners[k + 1] - corners[k] + 1);
      std::vector<Noted> between = meant(run, line[k], line[k + 1], context);
      better.push_back(line[k]);
      better.insert(better.end(), between.begin(), between.end());
    }
    better.push_back(line.back());
    better.back().corner = corner;
    if (std::exchange(continues_, !corner)) better.front().corner = false;
    if (!parts_.empty() && distance(parts_.back().back().point, better.front().point) < kMeets) {
      parts_.back().back().run = better.front().run;
      better.erase(better.begin());
    }
    if (!better.empty()) parts_.push_back(std::move(better));
  }

  // An edge begins and ends where a line of the body is come upon and left, if it is followed far: the side at the
  // armhole. A corner a finger's breadth beyond is that one.
  std::vector<std::size_t> atLines(std::vector<std::size_t> corners, std::span<const StrokeSample> stroke) const {
    if (free_) return corners;
    const std::vector<Vec3> picture = pictureOf(stroke);
    std::vector<std::size_t> with{corners.front()};
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
      const std::size_t from = corners[k], to = corners[k + 1];
      const auto followed = snaps_.followed(stroke.subspan(from, to - from + 1));
      std::size_t first = 0, last = 0;
      double longest = kFollowed;
      for (std::size_t i = 0, end = 0; i < followed.size(); i = end) {
        end = i + 1;
        if (!followed[i] || snaps_.bodyLineOf(followed[i]->curve).empty()) continue;
        std::size_t seen = i;
        for (; end < followed.size() && (!followed[end] || followed[end]->curve == followed[i]->curve) &&
               distance(picture[from + end], picture[from + seen]) < std::max(kGap, stroke[from + end].touching());
             ++end)
          if (followed[end]) seen = end;
        if (const double far = distance(picture[from + i], picture[from + seen]); far > longest)
          longest = far, first = from + i, last = from + seen;
      }
      const auto near = [&](std::size_t a, std::size_t b) {
        return distance(picture[a], picture[b]) < std::max(kGap, 1.2 * stroke[a].touching());
      };
      // Nor where the line is lost to sight before the corner that lies on it: the armhole under the arm.
      const auto meetsLine = [&](std::size_t corner) {
        const auto snap = snaps_.near(stroke[corner], true);
        return snap && snap->corner && snaps_.shareOf(followed[first - from]->curve, snap->point);
      };
      if (longest > kFollowed) {
        if (!near(first, from) && meetsLine(from)) first = from;
        if (!near(last, to) && meetsLine(to)) last = to;
        if (!near(first, from))
          with.push_back(first);
        else if (with.size() > 1 && with.back() == from)
          with.back() = first;
        if (!near(last, to))
          with.push_back(last);
        else if (k + 2 < corners.size())
          corners[k + 1] = last;
      }
      if (with.back() != corners[k + 1]) with.push_back(corners[k + 1]);
    }
    return with;
  }

  // The places between two corners: along one of the body's lines or an outline, straight over the skin, or the fair
  // line that was drawn. The corners come to lie on the line that is followed.
  std::vector<Noted> meant(std::span<const StrokeSample> run, Noted& from, Noted& to,
                           const GestureContext& context) const {
    const Body& body = *context.snapshot->body;
    if (run.size() < 3) return {};
    std::vector<std::optional<DrawSnaps::Followed>> followed(run.size());
    if (!free_) followed = snaps_.followed(run);
    auto course = wholly(run, followed);
    if (course.empty() && from.held && to.held) course = mostly(run, followed, from, to);
    if (!course.empty()) {
      const std::size_t curve = course.front().curve;
      const auto onto = [&](Noted& corner, DrawSnaps::Followed& place) {
        if (!corner.held && !corner.named)
          corner = noted(snaps_.on(curve, place.share), corner.corner);
        else if (const auto share = snaps_.shareOf(curve, corner.point))
          place.share = *share;  // from the corner itself, wherever the hand went past it
      };
      onto(from, course.front()), onto(to, course.back());
      from.run = snaps_.bodyLineOf(curve);
      return along(course);
    }
    const bool round = distance(from.point, to.point) < kMeets;
    if (!free_ && !round)
      if (const auto way = guide(context).straight(from.place, to.place); way && !strays(run, way->points)) return {};
    std::vector<std::optional<Vec3>> fixed(run.size());
    for (std::size_t i = 0; i < run.size(); ++i)
      if (followed[i] && !run[i].certain) fixed[i] = followed[i]->point;
    fixed.front() = from.point, fixed.back() = to.point;
    const std::vector<Vec3> fair = faired(body, run, fixed);
    std::vector<Noted> places;
    std::size_t before = 0;
    const auto keep = [&](std::size_t i) {
      const auto near = body.bvh().nearest(fair[i]);
      places.push_back({near->place, near->point, false});
      before = i;
    };
    for (const std::size_t i : mattering<Vec3>(fair, kMiss)) {
      if (i == 0) continue;
      for (std::size_t k = before + 1; k < i; ++k)
        if (distance(fair[before], fair[k]) > kLongest && distance(fair[k], fair[i]) > kLongest / 3) keep(k);
      if (i + 1 < fair.size() && distance(fair[before], fair[i]) > kClose && distance(fair[i], fair.back()) > kClose)
        keep(i);
    }
    return places;
  }

  // The samples of a run that follows one curve but for a little at its ends or here and there; empty: it does not.
  static std::vector<DrawSnaps::Followed> wholly(std::span<const StrokeSample> run,
                                                 std::span<const std::optional<DrawSnaps::Followed>> followed) {
    const std::vector<Vec3> picture = pictureOf(run);
    std::vector<DrawSnaps::Followed> course;
    double gap = 0;
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (i > 0) gap += distance(picture[i - 1], picture[i]);
      if (followed[i]) {
        if (!course.empty() && course.front().curve != followed[i]->curve) return {};
        if (gap > std::max(kGap, run[i].touching())) return {};
        course.push_back(*followed[i]);
        gap = 0;
      }
    }
    return gap > std::max(kGap, run.back().touching()) ? std::vector<DrawSnaps::Followed>() : course;
  }

  // Between two places of one line of the body that were met: along it, if a third of the way was.
  std::vector<DrawSnaps::Followed> mostly(std::span<const StrokeSample> run,
                                          std::span<const std::optional<DrawSnaps::Followed>> followed,
                                          const Noted& from, const Noted& to) const {
    const auto curve = snaps_.lineThrough(from.point, to.point);
    std::vector<DrawSnaps::Followed> course;
    for (std::size_t i = 0; curve && i < run.size(); ++i)
      if (followed[i] && followed[i]->curve == *curve) course.push_back(*followed[i]);
    if (3 * course.size() < run.size()) return {};
    course.insert(course.begin(), {*curve, *snaps_.shareOf(*curve, from.point), from.point});
    course.push_back({*curve, *snaps_.shareOf(*curve, to.point), to.point});
    return course;
  }

  // Places along a curve from the first followed place to the last, as the hand went.
  std::vector<Noted> along(const std::vector<DrawSnaps::Followed>& course) const {
    const std::size_t curve = course.front().curve;
    double went = 0;  // in shares; of a closed line past its beginning too
    for (std::size_t i = 1; i < course.size(); ++i) {
      const double step = course[i].share - course[i - 1].share;
      went += snaps_.closed(curve) ? step - std::round(step) : step;
    }
    return along(curve, course.front().share, went);
  }
  // A ring goes on past its beginning.
  double within(std::size_t curve, double share) const {
    return snaps_.closed(curve) ? share - std::floor(share) : std::clamp(share, 0.0, 1.0);
  }
  // `went`: share of the whole from there on, back where it is negative.
  std::vector<Noted> along(std::size_t curve, double from, double went) const {
    went = std::round(went * 1e9) / 1e9;  // the same line for every hand that means it
    const double length = std::fabs(went) * snaps_.length(curve);
    const int looks = std::max(2, static_cast<int>(length / kLook));
    double turned = 0;
    std::array<Vec3, 3> last;
    for (int k = 0; k <= looks; ++k) {
      const double share = from + went * k / looks;
      last = {last[1], last[2], snaps_.at(curve, within(curve, share))};
      if (k < 2) continue;
      const Vec3 in = last[1] - last[0], out = last[2] - last[1];
      turned += std::atan2(karinui::length(cross(in, out)), dot(in, out));
    }
    const int parts = std::max(1, static_cast<int>(std::ceil(std::max(length / kAlong, turned / kBent))));
    std::vector<Noted> places;
    for (int k = 1; k < parts; ++k) {
      const double share = from + went * k / parts;
      places.push_back(noted(snaps_.on(curve, within(curve, share)), false));
    }
    return places;
  }

  // Whether the stroke is one and not a click. A hand that holds a controller in the air trembles, and moves as it
  // presses: only what leaves the place it began at is drawn.
  bool drawn(PointerSample::Device device) const {
    const std::vector<Vec3> picture = pictureOf(stroke_);
    double way = 0, away = 0;
    for (std::size_t i = 1; i < picture.size(); ++i) {
      way += distance(picture[i - 1], picture[i]);
      away = std::max(away, distance(picture[i], picture[0]));
    }
    return way >= 2 * kPointStep &&
           (device != PointerSample::Device::Controller || away >= kTremble * stroke_[0].touching());
  }

  // Between two clicked places of one line of the body: along it, of a ring by the way that is turned to the eye.
  std::vector<Noted> legOf(Noted& from, const Noted& to, const StrokeSample& seen) const {
    from.run.clear();
    const auto curve = snaps_.lineThrough(from.point, to.point);
    if (!curve) return {};
    const double first = *snaps_.shareOf(*curve, from.point), last = *snaps_.shareOf(*curve, to.point);
    double went = last - first;
    if (snaps_.closed(*curve)) {
      const double other = went > 0 ? went - 1 : went + 1;
      const auto facing = [&](double way) {
        const double middle = first + way / 2;
        return dot(snaps_.at(*curve, middle - std::floor(middle)), seen.facing);
      };
      if (facing(other) > facing(went)) went = other;
    }
    from.run = snaps_.bodyLineOf(*curve);
    return along(*curve, first, went);
  }

  // Whether the stroke, as it was seen, leaves the straight way.
  static bool strays(std::span<const StrokeSample> run, const std::vector<Vec3>& way) {
    for (const StrokeSample& s : run) {
      double nearest = 1e9;
      for (std::size_t i = 0; i + 1 < way.size(); ++i) {
        const auto flat = [&](Vec3 p) {
          return p - s.ray.origin - s.ray.direction * dot(p - s.ray.origin, s.ray.direction);
        };
        nearest = std::min(nearest, awayFromSegment(flat(way[i]), flat(way[i + 1]), Vec3{}));
      }
      if (nearest > std::max(kStraight, 0.25 * s.touching())) return true;
    }
    return false;
  }

  const SurfaceGuide& guide(const GestureContext& context) const {
    if (guideOf_ != context.snapshot->body) {
      guideOf_ = context.snapshot->body;
      guide_ = std::make_unique<SurfaceGuide>(guideOf_->mesh());
      known_.clear();
    }
    return *guide_;
  }

  // The line as it runs over the skin.
  std::vector<Vec3> path(const GestureContext& context) const {
    const std::vector<Noted> line = all();
    std::vector<Vec3> points;
    if (!context.snapshot->body) return points;
    const SurfaceGuide& skin = guide(context);
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

  GestureResult ended(const GestureContext& context, bool asked) {
    const std::vector<Noted> line = all();
    if (line.size() < 2)
      return asked ? GestureResult{.why = say("A line needs at least three places to hold a piece of cloth.")}
                   : GestureResult{};
    const Vec3 a = line.front().point, b = line.back().point;
    const bool meets = line.size() > 3 && distance(a, b) < kMeets;
    const auto middle = [](Vec3 p) { return std::fabs(p.x) < kCentre; };
    const bool half = !meets && line.size() > 2 && middle(a) && middle(b) && distance(a, b) > 3 * kMeets;
    if (!meets && !half && !asked) return {};
    if (asked && line.size() < 3) return {.why = say("A line needs at least three places to hold a piece of cloth.")};

    const Body& body = *context.snapshot->body;
    DrawPiece draw;
    draw.symmetric = half;
    std::size_t count = line.size();
    if (meets) --count;
    std::vector<BodyPoint> lies;  // where a tailor would look for them
    for (std::size_t i = 0; i < count; ++i) {
      BodyPoint point = spoken(body, line[i].place);
      lies.push_back(point);
      if (line[i].named) point = *line[i].named;
      const bool end = half && (i == 0 || i + 1 == count);
      if (end) {
        point = lies.back();
        if (point.part != BodyPoint::Part::Torso)
          return refuse(say("A half line begins and ends on the middle of the trunk."));
        point.around = point.around > 0.25 && point.around < 0.75 ? 0.5 : 0;
      }
      draw.line.push_back(point);
    }
    draw.edges = edgeNames(std::span(line).first(half ? count - 1 : count), half);
    draw.name = usableName(context.snapshot->document, calledBy(lies, draw.symmetric));
    parts_.clear();
    hover_.reset();
    return {.over = true, .operation = std::move(draw)};
  }

  GestureResult refuse(Message why) {
    parts_.pop_back();
    return {.why = std::move(why)};
  }

  std::vector<std::vector<Noted>> parts_;
  std::vector<StrokeSample> stroke_;
  std::optional<DrawSnaps::Snap> began_;  // what the stroke began at
  std::optional<Vec3> hover_;
  bool smooth_ = false, straight_ = false, free_ = false;
  bool continues_ = false;  // the stroke in hand goes on from the part before, seen from another side
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

#include "body/reading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace karinui {

namespace {

constexpr Vec3 kUp{0, 1, 0};
constexpr double kUnderBust = 0.075;  // below the bust
constexpr double kRibs = 0.065;       // of the height below the bust: no waist is sought above, ribs may be slimmer

struct Extent {
  double low = 1e9, high = -1e9;
  void include(double v) { low = std::min(low, v), high = std::max(high, v); }
};

Extent extentX(const SectionLoop& loop) {
  Extent e;
  for (const Vec3& p : loop.points) e.include(p.x);
  return e;
}

// The parabola through three neighbouring samples gives the place of the extreme between them.
double refined(double at, double step, double before, double here, double after) {
  const double bend = before - 2 * here + after;
  return std::abs(bend) < 1e-12 ? at : at + step * std::clamp(0.5 * (before - after) / bend, -1.0, 1.0);
}

// Only the points that a face uses, in the order of their first use.
TriangleMesh compacted(const TriangleMesh& mesh, std::span<const std::uint32_t> faces,
                       std::vector<std::uint32_t>& name) {
  constexpr std::uint32_t kNone = ~0u;
  name.resize(mesh.points.size(), kNone);
  TriangleMesh out;
  std::vector<std::uint32_t> named;
  for (const std::uint32_t f : faces) {
    Triangle face = mesh.faces[f];
    for (std::uint32_t& p : face) {
      if (name[p] == kNone) {
        name[p] = static_cast<std::uint32_t>(out.points.size());
        out.points.push_back(mesh.points[p]);
        named.push_back(p);
      }
      p = name[p];
    }
    out.faces.push_back(face);
  }
  for (const std::uint32_t p : named) name[p] = kNone;  // for the next
  return out;
}

constexpr double kBesideNeck = 1.05;  // of the neck's own radius: where its side runs out into the shoulder

// A mesh in level slices: a level plane meets only the faces of one slice.
class Slices {
 public:
  Slices(const TriangleMesh& mesh, double low, double high) : low_(low), thick_(std::max(high - low, 1e-9) / kCount) {
    std::vector<std::vector<std::uint32_t>> of(kCount);  // faces
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
      const Triangle& t = mesh.faces[f];
      const auto [least, most] = std::minmax({mesh.points[t[0]].y, mesh.points[t[1]].y, mesh.points[t[2]].y});
      for (std::size_t s = number(least); s <= number(most); ++s) of[s].push_back(f);
    }
    std::vector<std::uint32_t> name;
    for (const auto& faces : of) slice_.push_back(compacted(mesh, faces, name));
  }
  const TriangleMesh& at(double y) const { return slice_[number(y)]; }

 private:
  static constexpr std::size_t kCount = 96;
  std::size_t number(double y) const {
    return static_cast<std::size_t>(std::clamp((y - low_) / thick_, 0.0, kCount - 1.0));
  }
  double low_, thick_;
  std::vector<TriangleMesh> slice_;
};

class Reader {
 public:
  explicit Reader(const TriangleMesh& mesh) : mesh_(mesh) {}

  Reading read() {
    if (mesh_.faces.empty()) return {};
    Extent tall, wide;
    for (const Vec3& p : mesh_.points) tall.include(p.y), wide.include(p.x);
    floor_ = tall.low;
    height_ = tall.high - tall.low;
    middle_ = (wide.low + wide.high) / 2;
    if (!(height_ > 0.3 && height_ < 3)) return {};
    set("height", height_);
    slices_.emplace(mesh_, tall.low, tall.high);
    if (!findCrotch() || !findArmpit()) return out_;
    torso();
    legs();
    for (const int side : {0, 1}) arm(side);
    neck();
    shoulders();
    lengths();
    return out_;
  }

 private:
  void set(const char* key, double value) { out_.value[key] = value; }
  double get(const char* key) const {
    const auto it = out_.value.find(key);
    return it == out_.value.end() ? 0 : it->second;
  }
  double level(double y) const { return y - floor_; }
  std::vector<SectionLoop> at(double y) const { return section(slices_->at(y), {{0, y, 0}, kUp}); }

  bool joined(double y) const {  // do the legs meet at this level?
    for (const SectionLoop& loop : at(y)) {
      const Extent e = extentX(loop);
      if (e.low < middle_ && e.high > middle_ && e.high - e.low > 0.05 * height_) return true;
    }
    return false;
  }

  bool findCrotch() {
    double high = floor_ + 0.58 * height_, low = high;
    if (!joined(high)) return false;
    while (joined(low)) {
      high = low;
      low -= 0.01 * height_;
      if (low < floor_ + 0.25 * height_) return false;
    }
    for (int i = 0; i < 12; ++i) {
      const double y = (low + high) / 2;
      (joined(y) ? high : low) = y;
    }
    crotch_ = high;
    set("crotch_height", level(crotch_));
    return true;
  }

  int parts(double y) const {
    int count = 0;
    for (const SectionLoop& loop : at(y)) count += lineLength(loop.points, true) > 0.07 * height_;
    return count;
  }

  bool findArmpit() {
    double low = floor_ + 0.70 * height_;
    while (parts(low) < 3 && low > floor_ + 0.60 * height_) low -= 0.01 * height_;
    if (parts(low) < 3) return false;
    double high = low;
    while (parts(high) >= 3) {
      low = high;
      high += 0.005 * height_;
      if (high > floor_ + 0.86 * height_) return false;
    }
    for (int i = 0; i < 10; ++i) {
      const double y = (low + high) / 2;
      (parts(y) >= 3 ? low : high) = y;
    }
    armpit_ = low;
    set("armpit_height", level(armpit_));
    return true;
  }

  std::optional<SectionLoop> torsoLoop(double y) const {
    std::optional<SectionLoop> best;
    double most = 0;
    for (SectionLoop& loop : at(y)) {
      const Extent e = extentX(loop);
      const double line = lineLength(loop.points, true);
      if (e.low < middle_ && e.high > middle_ && line > most) most = line, best = std::move(loop);
    }
    return best;
  }
  double torsoGirth(double y) const {
    const auto loop = torsoLoop(y);
    return loop ? tightTapeLength(loop->points, kUp) : 0;
  }

  // Both legs and the seat in one tape; hands hanging beside are left out.
  double hipGirth(double y) const {
    std::vector<Vec3> points;
    for (const SectionLoop& loop : at(y))
      if (std::abs(lineCentre(loop).x - middle_) < 0.12 * height_ && lineLength(loop.points, true) > 0.08 * height_)
        points.insert(points.end(), loop.points.begin(), loop.points.end());
    return points.size() < 3 ? 0 : tightTapeLength(points, kUp);
  }

  struct Extreme {
    double girth = 0, y = 0;
  };
  template <class Girth>
  static Extreme extreme(double low, double high, int count, bool largest, const Girth& girth) {
    const double step = (high - low) / (count - 1), sign = largest ? 1 : -1;
    std::vector<double> g(count);
    for (int i = 0; i < count; ++i) g[i] = girth(low + step * i);
    int best = 0;
    for (int i = 1; i < count; ++i)
      if (sign * g[i] > sign * g[best] && g[i] > 0) best = i;
    Extreme e{g[best], low + step * best};
    if (best > 0 && best + 1 < count) {
      const double y = refined(e.y, step, g[best - 1], g[best], g[best + 1]);
      const double fine = girth(y);
      if (sign * fine > sign * e.girth) e = {fine, y};
    }
    return e;
  }

  // The same where the girth hardly changes over a hand's breadth: the middle of the levels within half a millimetre
  // of the extreme, so that a hair's difference does not move the level by centimetres.
  template <class Girth>
  static Extreme broadExtreme(double low, double high, int count, bool largest, const Girth& girth) {
    constexpr double kHair = 0.0005;
    const Extreme sharp = extreme(low, high, count, largest, girth);
    double sum = 0, total = 0;
    for (int i = 0; i < count; ++i) {
      const double y = low + (high - low) * i / (count - 1), off = std::abs(girth(y) - sharp.girth) / kHair;
      const double weight = std::exp(-off);
      sum += weight * y, total += weight;
    }
    return {sharp.girth, total > 0 ? sum / total : sharp.y};
  }

  double foremostBust(double y) const {
    double most = -1;
    if (const auto loop = torsoLoop(y))
      for (const Vec3& p : loop->points)
        if (std::abs(p.x - middle_) > 0.028 * height_) most = std::max(most, p.z);
    return most;
  }

  void torso() {
    const auto girth = [&](double y) { return torsoGirth(y); };
    const Extreme hip = extreme(crotch_ + 0.01, crotch_ + 0.20, 20, true, [&](double y) { return hipGirth(y); });
    // A woman's bust is taken around the bust points, so that a full arm does not draw the tape up into the armpit; a
    // man's chest where it is widest, which may be right under the armpit. How much a bust stands out says which it is.
    const double highest = armpit_ - 0.003;
    const Extreme points =
        extreme(armpit_ - 0.055 * height_, highest, 14, true, [&](double y) { return 1 + foremostBust(y); });
    const double reach = 0.012 * height_;
    Extreme bust = broadExtreme(points.y - reach, std::min(highest, points.y + reach), 13, true, girth);
    bosom_ = std::clamp(((bust.girth - girth(bust.y - kUnderBust)) / height_ - 0.040) / 0.030, 0.0, 1.0);
    if (bosom_ < 0.5) bust = extreme(crotch_ + 0.72 * (armpit_ - crotch_), highest, 22, true, girth);
    const double under = bust.y - kUnderBust;
    const Extreme waist = broadExtreme(std::max(crotch_ + 0.10, hip.y + 0.05),
                                       std::max(bust.y - kRibs * height_, crotch_ + 0.16), 28, false, girth);
    hip_ = hip.y, bust_ = bust.y, waist_ = waist.y;
    set("hip_girth", hip.girth), set("hip_height", level(hip.y));
    set("bust_girth", bust.girth), set("bust_height", level(bust.y));
    set("under_bust_girth", girth(under)), set("under_bust_height", level(under));
    set("waist_girth", waist.girth), set("waist_height", level(waist.y));
    const double highHip = (crotch_ + waist.y) / 2;
    set("high_hip_girth", hipGirth(highHip)), set("high_hip_height", level(highHip));
    set("waist_to_hip_length", waist.y - hip.y);
    out_.landmark["crotch"] = onTorso(crotch_ + 0.002, 0);
    for (const auto& [name, y] : {std::pair{"waist", waist.y}, {"hip", hip.y}, {"under_bust", under}}) {
      const char* places[] = {"front", "left", "back", "right"};
      for (int i = 0; i < 4; ++i)
        out_.landmark[std::string(name) + "_" + places[i]] = onTorso(y, i * std::numbers::pi / 2);
    }
    if (const auto loop = torsoLoop(bust.y)) {
      // The bust points: the foremost on each side.
      for (const int side : {0, 1}) {
        Vec3 best{0, 0, -1e9};
        for (const Vec3& p : loop->points)
          if ((side ? middle_ - p.x : p.x - middle_) > 0.02 && p.z > best.z) best = p;
        out_.landmark[side ? "bust_right" : "bust_left"] = best;
      }
      set("bust_span", distance(out_.landmark["bust_left"], out_.landmark["bust_right"]));
    }
  }

  // Where a ray from the torso's middle leaves it, t from the front to the left.
  Vec3 onTorso(double y, double t) const {
    const auto loop = torsoLoop(y);
    if (!loop) return {middle_, y, 0};
    const Vec3 c = lineCentre(*loop), d{std::sin(t), 0, std::cos(t)}, n{d.z, 0, -d.x};
    Vec3 best = c;
    double far = 0;
    for (std::size_t i = 0; i < loop->points.size(); ++i) {
      const Vec3 a = loop->points[i] - Vec3{middle_, c.y, c.z};
      const Vec3 b = loop->points[(i + 1) % loop->points.size()] - Vec3{middle_, c.y, c.z};
      const double sa = dot(a, n), sb = dot(b, n);
      if ((sa > 0) == (sb > 0)) continue;
      const Vec3 p = lerp(a, b, sa / (sa - sb));
      if (dot(p, d) > far) far = dot(p, d), best = p + Vec3{middle_, c.y, c.z};
    }
    return best;
  }

  std::optional<SectionLoop> legLoop(double y, int side) const {
    std::optional<SectionLoop> best;
    double most = 0;
    for (SectionLoop& loop : at(y)) {
      const double x = (lineCentre(loop).x - middle_) * (side ? -1 : 1), line = lineLength(loop.points, true);
      if (x > 0 && x < 0.13 * height_ && line > most) most = line, best = std::move(loop);
    }
    return best;
  }

  void legs() {
    const auto girth = [&](double y) {
      const auto loop = legLoop(y, 0);
      return loop ? tightTapeLength(loop->points, kUp) : 0;
    };
    const double inside = level(crotch_), knee = floor_ + 0.603 * inside;
    set("thigh_girth", girth(crotch_ - 0.03));
    set("knee_girth", girth(knee)), set("knee_height", level(knee));
    const Extreme calf = extreme(floor_ + 0.32 * inside, floor_ + 0.52 * inside, 14, true, girth);
    set("calf_girth", calf.girth), set("calf_height", level(calf.y));
    const double ankle = floor_ + 0.0598 * height_;
    set("ankle_girth", girth(ankle)), set("ankle_height", level(ankle));
    for (const int side : {0, 1}) {
      const auto top = legLoop(crotch_ - 0.03, side), middle = legLoop(knee, side), end = legLoop(ankle, side);
      if (!top || !middle || !end) continue;
      LimbLine line;
      line.middle = lineCentre(*middle);
      line.end = lineCentre(*end);
      const Vec3 thigh = lineCentre(*top);
      line.top = thigh + (thigh - line.middle) * (0.05 * height_ / std::max(0.05, thigh.y - line.middle.y));
      line.tip = line.end;
      line.tip.y = floor_;
      out_.leg[side] = line;
      const std::string s = side ? "_right" : "_left";
      out_.landmark["knee" + s] = foremost(*middle);
      out_.landmark["ankle" + s] = outmost(*end, side);
    }
  }
  static Vec3 foremost(const SectionLoop& loop) {
    return *std::max_element(loop.points.begin(), loop.points.end(), [](Vec3 a, Vec3 b) { return a.z < b.z; });
  }
  static Vec3 outmost(const SectionLoop& loop, int side) {
    return *std::max_element(loop.points.begin(), loop.points.end(),
                             [&](Vec3 a, Vec3 b) { return side ? a.x > b.x : a.x < b.x; });
  }

  struct Ring {
    Vec3 centre, direction;
    double girth = 0;
  };

  // What an arm's sections need of the mesh: quicker to cut than the whole. The trunk's side is cut open, but an arm's
  // own loop is whole.
  TriangleMesh armSide(int side) const {
    const double sign = side ? -1 : 1;
    std::vector<std::uint32_t> faces, name;
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f)
      for (const std::uint32_t p : mesh_.faces[f])
        if (sign * (mesh_.points[p].x - middle_) > 0.045 * height_ && mesh_.points[p].y > floor_ + 0.3 * height_) {
          faces.push_back(f);
          break;
        }
    return compacted(mesh_, faces, name);
  }

  // Follows the arm from the armpit to the fingertips, each plane across the way the last ones went.
  std::vector<Ring> trace(const TriangleMesh& mesh, int side) const {
    std::vector<Ring> way;
    const double sign = side ? -1 : 1;
    Vec3 here;
    bool found = false;
    for (const SectionLoop& loop : at(armpit_ - 0.012 * height_)) {
      const Vec3 c = lineCentre(loop);
      if (sign * (c.x - middle_) > 0.08 * height_ && lineLength(loop.points, true) > 0.07 * height_)
        here = c, found = true;
    }
    if (!found) return way;
    Vec3 going = normalized(Vec3{0.67 * sign, -0.74, 0});
    const double step = 0.006 * height_;
    for (int i = 0; i < 90; ++i) {
      const auto loop = loopNear(mesh, here, going, here);
      if (!loop) break;
      const Vec3 c = lineCentre(*loop);
      const double girth = tightTapeLength(loop->points, going);
      if (distance(c, here) > 0.035 * height_ || (way.size() > 5 && girth > 1.6 * way.back().girth)) break;
      way.push_back({c, going, girth});
      const std::size_t n = way.size();
      if (n > 8) going = normalized(going * 0.6 + normalized(c - way[n - 7].centre) * 0.4);
      here = c + going * step;
      if (girth < 0.02 * height_) break;
    }
    return way;
  }

  struct Line {
    Vec3 through, along;
    double miss = 0;
  };
  static Line fitted(const std::vector<Ring>& way, std::size_t from, std::size_t to) {
    Vec3 mean;
    for (std::size_t i = from; i < to; ++i) mean += way[i].centre;
    mean *= 1.0 / static_cast<double>(to - from);
    Vec3 along = normalized(way[to - 1].centre - way[from].centre);
    for (int round = 0; round < 20; ++round) {  // power iteration on the scatter
      Vec3 next;
      for (std::size_t i = from; i < to; ++i) next += (way[i].centre - mean) * dot(way[i].centre - mean, along);
      along = normalized(next);
    }
    Line line{mean, along, 0};
    for (std::size_t i = from; i < to; ++i) {
      const Vec3 d = way[i].centre - mean;
      line.miss += squaredLength(d - along * dot(d, along));
    }
    return line;
  }

  void arm(int side) {
    const TriangleMesh mesh = armSide(side);
    const auto way = trace(mesh, side);
    if (way.size() < 30) return;
    const double sign = side ? -1 : 1;
    // The wrist: narrowest place between forearm and hand.
    std::size_t wrist = way.size() * 3 / 10;
    for (std::size_t i = wrist; i < way.size() * 9 / 10; ++i) {
      if (way[i].girth < way[wrist].girth) wrist = i;
      if (way[i].girth > 1.15 * way[wrist].girth) break;  // the hand begins; its tip is narrow again
    }
    const double between =
        wrist + 1 < way.size() ? refined(0, 1, way[wrist - 1].girth, way[wrist].girth, way[wrist + 1].girth) : 0;
    const Vec3 narrow = between < 0 ? lerp(way[wrist].centre, way[wrist - 1].centre, -between)
                                    : lerp(way[wrist].centre, way[std::min(wrist + 1, way.size() - 1)].centre, between);
    // The elbow: where two straight lines through the middles of the sections meet best.
    std::size_t split = 0;
    double least = 1e9;
    for (std::size_t s = 5; s + 10 < wrist; ++s) {
      const double below = distance(way[s].centre, way[wrist].centre) / height_;  // a forearm's share of the height
      if (below < 0.105 || below > 0.165) continue;
      const double miss = fitted(way, 1, s).miss + fitted(way, s, wrist).miss;
      if (miss < least) least = miss, split = s;
    }
    if (split == 0) return;
    const Line upper = fitted(way, split > 10 ? 2 : 1, std::max<std::size_t>(split - 4, 5)),
               fore = fitted(way, split + 4, wrist - 1);
    // Nearest points of the two lines.
    const Vec3 w = upper.through - fore.through;
    const double b = dot(upper.along, fore.along), d = dot(upper.along, w), e = dot(fore.along, w), den = 1 - b * b;
    if (den < 1e-4) return;
    const Vec3 onUpper = upper.through + upper.along * ((b * e - d) / den);
    const Vec3 onFore = fore.through + fore.along * ((e - b * d) / den);
    const auto across = [&](Vec3 p, Vec3 normal) {
      const auto loop = loopNear(mesh, p, normal, p);
      return loop ? tightTapeLength(loop->points, normal) : 0;
    };
    // The flesh does not lie evenly around the bones. How far the joints stand from the middle of the flesh was read
    // off bodies whose joints are known; these shifts are what makes a joint an estimate (about 5 mm).
    LimbLine line;
    line.middle = lerp(onUpper, onFore, 0.5) - Vec3{0, 0, 0.0062 * height_ * (1 - bosom_)} -
                  upper.along * (0.0065 * height_ * bosom_);
    const double thick = across(line.middle - upper.along * (0.0755 * height_), upper.along) / height_;
    const double narrowest = dot(narrow - fore.through, fore.along);
    line.end = fore.through +
               fore.along * (narrowest + height_ * (std::lerp(0.0048, 0.0013, bosom_) + 0.05 * (thick - 0.1667)));
    line.tip = way.back().centre;
    // The shoulder joint lies on the upper arm's line, above the armpit.
    const double joint = gapX(sign) + height_ * (std::lerp(0.0043, -0.0013, bosom_) - 0.130 * (thick - 0.1667));
    if (std::abs(upper.along.x) < 0.2) return;
    line.top = upper.through + upper.along * ((middle_ + sign * joint - upper.through.x) / upper.along.x) +
               Vec3{0, 0.0055 * height_, std::lerp(0.0142, 0.0065, bosom_) * height_};
    out_.arm[side] = line;
    const std::string s = side ? "_right" : "_left";
    const auto onSkin = [&](Vec3 p, Vec3 normal) {
      const auto loop = loopNear(mesh, p, normal, p);
      return loop ? outmost(*loop, side) : p;
    };
    out_.landmark["elbow" + s] = onSkin(line.middle, normalized(upper.along + fore.along));
    out_.landmark["wrist" + s] = onSkin(line.end, fore.along);
    if (side == 1 && out_.arm[0]) return;  // measured on the left, as a tailor does on one side
    set("upper_arm_girth", across(lerp(line.top, line.middle, 0.47), upper.along));
    set("elbow_girth", across(line.middle, normalized(upper.along + fore.along)));
    set("wrist_girth", across(fore.through + fore.along * (narrowest - 0.010), fore.along));
    set("upper_arm_length", distance(line.top, line.middle));
    set("forearm_length", distance(line.middle, line.end));
    set("arm_joint_length", distance(line.top, line.middle) + distance(line.middle, line.end));
    set("arm_angle", std::atan2(line.top.y - line.middle.y, sign * (line.middle.x - line.top.x)));
  }

  // How far from the middle the gap between arm and trunk opens, just under the armpit.
  double gapX(double sign) const {
    Extent gap{0, 1e9};
    for (const SectionLoop& loop : at(armpit_ - 0.006 * height_)) {
      if (lineLength(loop.points, true) < 0.07 * height_) continue;
      for (const Vec3& p : loop.points) {
        const double x = sign * (p.x - middle_);
        if (std::abs(lineCentre(loop).x - middle_) < 0.03 * height_)
          gap.low = std::max(gap.low, x);
        else if (sign * (lineCentre(loop).x - middle_) > 0)
          gap.high = std::min(gap.high, x);
      }
    }
    return (gap.low + gap.high) / 2;
  }

  // The outline of the body seen from the side: front-most and back-most point near the middle at a level.
  void profile(double y, Vec3& front, Vec3& back) const {
    front = {middle_, y, -1e9}, back = {middle_, y, 1e9};
    for (const SectionLoop& loop : at(y))
      for (std::size_t i = 0; i < loop.points.size(); ++i) {
        const Vec3 a = loop.points[i], b = loop.points[(i + 1) % loop.points.size()];
        if ((a.x > middle_) == (b.x > middle_)) continue;
        const double z = lerp(a, b, (middle_ - a.x) / (b.x - a.x)).z;
        front.z = std::max(front.z, z), back.z = std::min(back.z, z);
      }
  }

  void neck() {
    // The pit of the neck: the deepest place of the front between chest and chin.
    Vec3 front, back, pit{0, 0, 1e9};
    for (double y = armpit_ + 0.06 * height_; y < floor_ + 0.89 * height_; y += 0.003 * height_) {
      profile(y, front, back);
      if (front.z < -1e8) break;
      if (front.z < pit.z) pit = front;
      if (front.z > pit.z + 0.03 * height_) break;  // the chin
    }
    if (pit.z > 1e8) return;
    out_.landmark["neck_front"] = pit;
    profile(pit.y + 0.015 * height_, front, back);
    out_.landmark["neck_back"] = back;
    set("neck_back_height", level(back.y));
    set("neck_front_height", level(pit.y));
    const double z =
        out_.arm[0] ? out_.arm[0]->top.z - std::lerp(0.0120, 0.0118, bosom_) * height_ : (front.z + back.z) / 2;
    const Vec3 through{middle_, floor_ + height_ * (1 - std::lerp(0.1165, 0.1303, bosom_)), z};
    const Vec3 normal = normalized(Vec3{0, 0.935, 0.355});
    if (const auto loop = loopNear(mesh_, through, normal, through)) {
      set("neck_girth", tightTapeLength(loop->points, normal));
      set("neck_height", level(through.y));
    }
    // The base of the neck and its side points: in the plane through pit and nape.
    const Vec3 a = out_.landmark["neck_front"], b = out_.landmark["neck_back"];
    const Vec3 lie = normalized(cross(b - a, Vec3{1, 0, 0})) * -1.0;
    const Vec3 up = lie.y > 0 ? lie : -lie;
    if (const auto loop = loopNear(mesh_, lerp(a, b, 0.5), up, lerp(a, b, 0.5))) {
      std::vector<Vec3> ring;
      const double reach = 0.052 * height_;  // beyond, the plane runs into the shoulders
      for (const Vec3& p : loop->points)
        if (std::abs(p.x - middle_) < reach) ring.push_back(p);
      if (ring.size() > 3) set("neck_base_girth", tightTapeLength(ring, up));
    }
    // Above its side points is the head.
    const auto girth = out_.value.find("neck_girth");
    const double side =
        girth != out_.value.end() ? kBesideNeck * girth->second / (2 * std::numbers::pi) : 0.038 * height_;
    for (const int s : {0, 1})
      if (const auto p = topAt(middle_ + (s ? -side : side), through.y))
        out_.landmark[s ? "neck_right" : "neck_left"] = *p;
  }

  // The highest point of the body in the plane x = const, no higher than asked.
  std::optional<Vec3> topAt(double x, double below = 1e9) const {
    std::optional<Vec3> best;
    for (const SectionLoop& loop : section(mesh_, {{x, 0, 0}, {1, 0, 0}}))
      for (const Vec3& p : loop.points)
        if (p.y <= below && (!best || p.y > best->y)) best = p;
    return best;
  }

  void shoulders() {
    for (const int side : {0, 1}) {
      if (!out_.arm[side]) return;
      const Vec3 joint = out_.arm[side]->top;
      const double x = joint.x + (side ? -1 : 1) * 0.0145 * height_;
      const auto top = topAt(x);
      if (!top) return;
      const std::string s = side ? "_right" : "_left";
      out_.landmark["shoulder" + s] = *top;
      out_.landmark["armpit" + s] = {middle_ + (side ? -1 : 1) * gapX(side ? -1 : 1), armpit_, joint.z};
    }
    const auto& l = out_.landmark;
    set("shoulder_width", distance(l.at("shoulder_left"), l.at("shoulder_right")));
    set("shoulder_height", level(l.at("shoulder_left").y));
    set("shoulder_joint_width", distance(out_.arm[0]->top, out_.arm[1]->top));
    set("arm_length",
        distance(l.at("shoulder_left"), out_.arm[0]->middle) + distance(out_.arm[0]->middle, out_.arm[0]->end));
    if (l.contains("neck_left")) {
      const Vec3 along = l.at("shoulder_left") - l.at("neck_left");
      set("shoulder_length", length(along));
      set("shoulder_slope", std::atan2(-along.y, std::hypot(along.x, along.z)));
    }
  }

  // A taut tape down the middle of the back or the front, from a level to another.
  double downTheMiddle(Vec3 from, double to, bool behind) const {
    std::vector<Flat> points;
    const double sign = behind ? -1 : 1;
    const int count = 40;
    Extent lean;
    for (int i = 0; i <= count; ++i) {
      Vec3 front, back;
      profile(std::lerp(from.y, to, double(i) / count), front, back);
      const Vec3 p = behind ? back : front;
      if (std::abs(p.z) > 1e8) return 0;
      points.push_back({p.y, sign * p.z});
      lean.include(sign * p.z);
    }
    const Flat first = points.front(), last = points.back();
    points.push_back({first.u, lean.low - 1}), points.push_back({last.u, lean.low - 1});
    const auto hull = convexHull(points);
    double sum = 0;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Flat a = hull[i], b = hull[(i + 1) % hull.size()];
      if (a.v > lean.low - 0.5 && b.v > lean.low - 0.5) sum += distance(a, b);
    }
    return sum;
  }

  void lengths() {
    const auto& l = out_.landmark;
    if (const auto it = l.find("neck_back"); it != l.end())
      set("back_waist_length", downTheMiddle(it->second, waist_, true));
    if (const auto it = l.find("neck_front"); it != l.end())
      set("front_waist_length", downTheMiddle(it->second, waist_, false));
  }

  const TriangleMesh& mesh_;
  std::optional<Slices> slices_;
  Reading out_;
  double floor_ = 0, height_ = 0, middle_ = 0, crotch_ = 0, armpit_ = 0, hip_ = 0, waist_ = 0, bust_ = 0, bosom_ = 0;
};

}  // namespace

Vec3 lineCentre(const SectionLoop& loop) {
  Vec3 sum;
  double total = 0;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const Vec3 a = loop.points[i], b = loop.points[(i + 1) % loop.points.size()];
    const double l = distance(a, b);
    sum += (a + b) * (l / 2);
    total += l;
  }
  return total > 0 ? sum * (1 / total) : loop.points.empty() ? Vec3{} : loop.points[0];
}

std::optional<SectionLoop> loopNear(const TriangleMesh& mesh, Vec3 through, Vec3 normal, Vec3 near) {
  std::optional<SectionLoop> best;
  double least = 1e9;
  for (SectionLoop& loop : section(mesh, {through, normal})) {
    const double far = distance(lineCentre(loop), near);
    if (far < least) least = far, best = std::move(loop);
  }
  return best;
}

Reading readBody(const TriangleMesh& mesh) { return Reader(mesh).read(); }

}  // namespace karinui

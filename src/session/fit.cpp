#include "karinui/session/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "karinui/base/number.h"
#include "karinui/cloth/support.h"
#include "karinui/design/drape.h"
#include "karinui/design/glossary.h"
#include "karinui/geometry/section.h"
#include "session/parts_at.h"

namespace karinui {

namespace {

constexpr double kFinger = 0.012;  // metres: the patch's radius, in which two thirds of its weight lie
constexpr double kLies = 0.012;    // metres from the skin that may still press, through what lies between

// Places in boxes as large as the patch, so that neighbours are quickly found.
class Boxes {
 public:
  explicit Boxes(double side) : side_(side) {}
  void add(Vec3 place, std::uint32_t item) { boxes_[key(at(place.x), at(place.y), at(place.z))].push_back(item); }
  template <class Visit>
  void around(Vec3 place, Visit&& visit) const {
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (const auto box = boxes_.find(key(at(place.x) + i, at(place.y) + j, at(place.z) + k)); box != boxes_.end())
            for (const std::uint32_t item : box->second) visit(item);
  }

 private:
  long at(double x) const { return static_cast<long>(std::floor(x / side_)); }
  static std::uint64_t key(long i, long j, long k) {
    const auto part = [](long n) { return static_cast<std::uint64_t>(n + (1 << 20)) & 0x1fffff; };
    return part(i) << 42 | part(j) << 21 | part(k);
  }
  double side_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> boxes_;
};

constexpr double kOpen = std::numbers::pi / 2;  // an open front is still a garment round the body

// Metres from a level that a garment's edge still belongs to: the upper one of a skirt, which hangs a little lower
// where the cloth or the skin is rounded, and the lower one of a bodice.
constexpr double kEdgeBelow = 0.04, kEdgeAbove = 0.02, kEdgeStep = 0.0025;

// Metres. In the fold of an armpit the tape would be drawn out towards the arms, and above it goes round them.
constexpr double kUnderArmpit = 0.003;

std::vector<Vec3> taped(std::vector<Vec3> points, double& length) {
  length = 0;
  if (points.size() < 3) return {};
  points = tightTape(points, {0, 1, 0});
  if (points.empty()) return {};
  length = lineLength(points, true);
  points.push_back(points.front());
  return points;
}

}  // namespace

std::vector<ElasticPull> elasticsOf(const GarmentSnapshot& snapshot) {
  const Document& document = snapshot.document;
  if (document.allowances.elastics.empty()) return {};
  LaidPattern laid;
  laid.spacing = document.settings.spacing;
  for (const GarmentSnapshot::Worn& worn : snapshot.worn) {
    if (!worn.lattice) return {};
    laid.lattices[worn.id] = worn.lattice;
  }
  const auto fabrics = fabricsInUse(document);
  if (!fabrics) return {};
  ClothChoice choice;
  choice.finish = &document.allowances;
  const Result<Cloth> cloth = assemble(document.pattern, laid, *fabrics, choice);
  if (!cloth) return {};
  return elasticPulls(*cloth, standing(document.pattern, *cloth));
}

std::vector<FasteningPull> fasteningsOf(const GarmentSnapshot& snapshot) {
  if (snapshot.document.allowances.fastenings.empty()) return {};
  const Result<Standing> standing = standingCloth(snapshot.document, livePieces(snapshot.document, {}));
  return standing ? fasteningPulls(standing->cloth, standing->state) : std::vector<FasteningPull>();
}

Message fastenerSaid(const FasteningPull& pull) {
  return pull.number > 0 ? say("{0} {1}", fasteningSaid(pull.name), pull.number) : fasteningSaid(pull.name);
}

Message pulledSaid(const FasteningPull& pull) {
  return pulledSaid(pull, [](double metres) { return fixed(metres * 1000, 1) + " mm"; });
}

Message pulledSaid(const FasteningPull& pull, std::string (*length)(double metres)) {
  const Message pulled = pull.length > 0
                             ? say("drawn open with {0} N along {1}", fixed(pull.force, 1), length(pull.length))
                             : say("drawn open with {0} N", fixed(pull.force, 1));
  return pull.holds() ? pulled : say("{0}; does not close, {1} are missing", pulled, length(pull.gap));
}

std::vector<float> pressureOnBody(const GarmentSnapshot& snapshot, Workers& workers) {
  if (!snapshot.body || snapshot.document.pattern.pieces.empty()) return {};
  const Result<Standing> standing = standingCloth(snapshot.document, livePieces(snapshot.document, {}));
  if (!standing) return {};
  const std::vector<Vec3>& place = standing->state.position;
  const std::vector<Vec3> support = supportOf(standing->cloth, standing->state, DrapePieces().gravity, workers);
  const std::vector<double> area = areasOf(standing->cloth);
  const DistanceField& skin = snapshot.body->field();
  Boxes boxes(3 * kFinger);
  for (std::uint32_t k = 0; k < place.size(); ++k)
    if (skin.distance(place[k]) < kLies) boxes.add(place[k], k);
  const TriangleMesh& mesh = snapshot.body->mesh();
  std::vector<float> pressure(mesh.points.size(), -1);
  const std::vector<Vec3> out = pointNormals(mesh);
  workers.forBlocks(pressure.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      double pressed = 0, over = 0, nearest = 1;
      boxes.around(mesh.points[p], [&](std::uint32_t k) {
        const double away = distance(mesh.points[p], place[k]);
        const double weight = std::exp(-away * away / (2 * kFinger * kFinger)) * area[k];
        nearest = std::fmin(nearest, away);
        pressed += weight * dot(support[k], out[p]);
        over += weight;
      });
      if (over > 0 && nearest < std::fmax(kLies, standing->cloth.spacing))
        pressure[p] = static_cast<float>(std::fmax(0, pressed / over));
    }
  });
  return pressure;
}

std::optional<PressureReport> pressureReport(const std::vector<float>& values) {
  std::vector<float> pressed;
  std::copy_if(values.begin(), values.end(), std::back_inserter(pressed), [](float p) { return p >= 0; });
  if (pressed.empty()) return std::nullopt;
  const double sum = std::accumulate(pressed.begin(), pressed.end(), 0.0);
  const auto most =
      pressed.begin() + static_cast<std::ptrdiff_t>(std::min(pressed.size() - 1, pressed.size() * 99 / 100));
  std::nth_element(pressed.begin(), most, pressed.end());
  return PressureReport{sum / static_cast<double>(pressed.size()), *most};
}

std::optional<BodyPoint> mostPressed(const std::vector<float>& pressure, const Body& body) {
  const auto most = std::max_element(pressure.begin(), pressure.end());
  if (most == pressure.end() || *most <= 0) return std::nullopt;
  const auto there = body.bvh().nearest(body.mesh().points[static_cast<std::size_t>(most - pressure.begin())]);
  return there ? std::optional(body.describe(there->place)) : std::nullopt;
}

std::string mostStretched(const SceneFrame& frame) {
  std::string name;
  float most = 0;
  for (const SceneCloth& cloth : frame.cloths) {
    if (cloth.strain.empty()) continue;
    std::vector<float> strain = cloth.strain;
    const auto at = strain.begin() + static_cast<std::ptrdiff_t>((strain.size() - 1) * 99 / 100);
    std::nth_element(strain.begin(), at, strain.end());
    if (*at > most) most = *at, name = cloth.name;
  }
  return name;
}

std::vector<Girths> girthsAt(const GarmentSnapshot& snapshot, double height) {
  using Part = BodyPoint::Part;
  const Plane level{{0, height, 0}, {0, 1, 0}};
  const PartsAt parts = partsAt(snapshot, level);
  const auto tape = [&](Girths::Round what, std::vector<Vec3> under, std::vector<Vec3> round) {
    Girths girths;
    girths.what = what;
    girths.height = height;
    girths.under = taped(std::move(under), girths.body);
    girths.round = taped(std::move(round), girths.garment);
    return girths;
  };
  const bool left = parts.legIsClad(Part::LeftLeg), right = parts.legIsClad(Part::RightLeg);
  if (left || right) {
    const auto own = [&](bool worn, Part leg) { return worn ? parts.cloth.at(leg) : std::vector<Vec3>(); };
    return {tape(Girths::Round::LeftLeg, parts.figure.at(Part::LeftLeg), own(left, Part::LeftLeg)),
            tape(Girths::Round::RightLeg, parts.figure.at(Part::RightLeg), own(right, Part::RightLeg))};
  }
  std::vector<Vec3> under = parts.trunk(parts.figure), round = parts.trunk(parts.cloth);
  if (!allRound(round, under, kOpen)) round.clear();
  return {tape(Girths::Round::Trunk, std::move(under), std::move(round))};
}

SceneFrame pressureFrame(const GarmentSnapshot& snapshot, const std::vector<float>& values) {
  SceneFrame frame = snapshot.frame;
  SceneCloth skin;
  skin.name = "body";
  skin.mesh = snapshot.body->mesh();
  skin.strain = values.empty() ? std::vector<float>(skin.mesh.points.size(), -1) : values;
  for (float& s : skin.strain)
    if (s < 0) s = std::numeric_limits<float>::quiet_NaN();  // nothing is known where no cloth lies
  skin.colour = SceneBody().colour;
  for (SceneBody& one : frame.bodies) one.mesh = {};  // it still stands on the floor, but its skin is seen instead
  frame.cloths = {std::move(skin)};
  for (const SceneCloth& cloth : snapshot.frame.cloths)  // the garment is thread on the skin
    for (const auto& run : cloth.outlines) {
      SceneLine line{{}, {0.10f, 0.12f, 0.16f}, 1.2f, false};
      for (const std::uint32_t n : run) line.points.push_back(cloth.mesh.points[n]);
      frame.lines.push_back(std::move(line));
    }
  return frame;
}

Result<PressedFrame> pressedFrame(const GarmentSnapshot& snapshot, Workers& workers) {
  if (!snapshot.body) return refused(say("There is no figure to be pressed on; choose one: body size=eu38."));
  const std::vector<float> values = pressureOnBody(snapshot, workers);
  const double top = roundTop(values, kPressureLeast);
  if (!(top > 0)) return refused(say("There is no pressure to show yet: settle the drape first."));
  return PressedFrame{pressureFrame(snapshot, values), top};
}

namespace {

// Round the trunk, where the garment goes round it.
std::optional<Girths> trunkAt(const GarmentSnapshot& snapshot, double height) {
  for (Girths& girths : girthsAt(snapshot, height))
    if (girths.what == Girths::Round::Trunk && girths.garment > 0) return std::move(girths);
  return std::nullopt;
}

}  // namespace

std::vector<Girths> girthsOf(const GarmentSnapshot& snapshot) {
  std::vector<Girths> all;
  if (!snapshot.body) return all;
  const auto heightOn = [](const Body& body, const char* place) -> std::optional<double> {
    const auto point = parseBodyPoint(place);
    const auto there = point ? body.find(*point) : Result<SurfacePoint>(point.error());
    return there ? std::optional(at(body.mesh(), *there).y) : std::nullopt;
  };
  const auto heightOf = [&](const char* place) { return heightOn(*snapshot.body, place); };
  std::optional<double> armpit;
  const auto under = [&](double height) { armpit = std::fmin(armpit.value_or(height), height - kUnderArmpit); };
  for (const char* place : {"torso:armpit@0", "landmark:armpit_left", "landmark:armpit_right"})
    if (const auto height = heightOf(place)) under(*height);
  // A full upper arm lies against the trunk below the fold.
  if (const auto& measured = snapshot.body->measured().value; armpit && measured.contains("armpit_height"))
    under(measured.at("armpit_height"));
  // Where the tape measured the figure, so that both tables say the same; with a pose it goes as far as the line does.
  const auto levelOf = [&](const char* measure, const char* place) {
    const auto& measured = snapshot.body->measured().value;
    const auto own = measured.find(measure);
    const auto now = heightOf(place), before = heightOn(snapshot.body->own(), place);
    return own != measured.end() && now && before ? std::optional(own->second + *now - *before) : now;
  };
  struct Level {
    std::optional<double> height;
    Message name;
    bool edge = false;  // garments begin and end there
  };
  const Level levels[] = {{armpit, say("armpit")},
                          {levelOf("bust_height", "torso:bust@0"), say("bust")},
                          {levelOf("under_bust_height", "torso:under_bust@0"), say("under bust")},
                          {levelOf("waist_height", "torso:waist@0"), say("waist"), true},
                          {levelOf("high_hip_height", "torso:high_hip@0"), say("high hip"), true},
                          {levelOf("hip_height", "torso:hip@0"), say("hip")}};
  for (const Level& level : levels) {
    if (!level.height) continue;
    auto girths = trunkAt(snapshot, *level.height);
    for (double away = kEdgeStep; level.edge && !girths && away < kEdgeBelow + kEdgeStep / 2; away += kEdgeStep) {
      girths = trunkAt(snapshot, *level.height - away);
      if (!girths && away < kEdgeAbove + kEdgeStep / 2) girths = trunkAt(snapshot, *level.height + away);
    }
    if (!girths) continue;
    girths->name = level.name;
    girths->off = girths->height - *level.height;
    all.push_back(*std::move(girths));
  }
  struct LegLevel {
    const char* place;
    Message left, right;
  };
  const LegLevel legLevels[] = {{"left_leg:crotch+0.15@0", say("left thigh"), say("right thigh")},
                                {"left_leg:knee@0", say("left knee"), say("right knee")},
                                {"left_leg:ankle@0", say("left ankle"), say("right ankle")}};
  for (const LegLevel& level : legLevels)
    if (const auto height = heightOf(level.place))
      for (Girths& girths : girthsAt(snapshot, *height)) {
        if (girths.what == Girths::Round::Trunk || girths.garment <= 0) continue;
        girths.name = girths.what == Girths::Round::LeftLeg ? level.left : level.right;
        all.push_back(std::move(girths));
      }
  return all;
}

double roundTop(std::vector<float> values, double least) {
  std::erase_if(values, [](float v) { return !(v > 0); });
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  const double wanted = std::fmax(least, *at), ten = std::pow(10, std::floor(std::log10(wanted)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * ten >= wanted * (1 - 1e-9)) return step * ten;
  return 10 * ten;
}

}  // namespace karinui

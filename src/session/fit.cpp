#include "karinui/session/fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "karinui/cloth/support.h"
#include "karinui/design/drape.h"
#include "karinui/geometry/section.h"

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

bool isArm(BodyPoint::Part part) { return part == BodyPoint::Part::LeftArm || part == BodyPoint::Part::RightArm; }

// Whether a line of the figure's section runs round an arm: what most of its places say.
bool roundArm(const Body& body, const SectionLoop& loop) {
  std::size_t arm = 0, asked = 0;
  const std::size_t stride = std::max<std::size_t>(1, loop.faces.size() / 9);
  for (std::size_t i = 0; i < loop.faces.size(); i += stride, ++asked)
    arm += isArm(body.describe({loop.faces[i], {1.0 / 3, 1.0 / 3, 1.0 / 3}}).part);
  return 2 * arm > asked;
}

// Whether the places lie on all sides of the figure: a hem that hangs lower at the back than in front goes round
// nothing.
bool allRound(const std::vector<Vec3>& places, const std::vector<Vec3>& figure) {
  Vec3 middle;
  for (const Vec3 p : figure.empty() ? places : figure) middle += p;
  middle *= 1.0 / static_cast<double>(std::max<std::size_t>(1, (figure.empty() ? places : figure).size()));
  std::vector<double> way;
  for (const Vec3 p : places) way.push_back(std::atan2(p.x - middle.x, p.z - middle.z));
  std::sort(way.begin(), way.end());
  double widest = way.empty() ? 7 : way.front() + 2 * std::numbers::pi - way.back();
  for (std::size_t i = 1; i < way.size(); ++i) widest = std::fmax(widest, way[i] - way[i - 1]);
  return widest < std::numbers::pi / 2;  // an open front is still a garment round the body
}

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

std::vector<float> pressureOnBody(const Fitting& fitting, Workers& workers) {
  if (!fitting.body || fitting.document.pattern.pieces.empty()) return {};
  const Result<Standing> standing = standingCloth(fitting.document, livePieces(fitting.document, {}));
  if (!standing) return {};
  const std::vector<Vec3>& place = standing->state.position;
  const std::vector<Vec3> support = supportOf(standing->cloth, standing->state, DrapePieces().gravity, workers);
  const std::vector<double> area = areasOf(standing->cloth);
  const DistanceField& skin = fitting.body->field();
  Boxes boxes(3 * kFinger);
  for (std::uint32_t k = 0; k < place.size(); ++k)
    if (skin.distance(place[k]) < kLies) boxes.add(place[k], k);
  const TriangleMesh& mesh = fitting.body->mesh();
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

Girths girthsAt(const Fitting& fitting, double height) {
  Girths girths;
  girths.height = height;
  const Plane level{{0, height, 0}, {0, 1, 0}};
  std::vector<Vec3> trunk, arms;
  if (fitting.body)
    for (const SectionLoop& loop : section(fitting.body->mesh(), level)) {
      auto& mine = roundArm(*fitting.body, loop) ? arms : trunk;
      mine.insert(mine.end(), loop.points.begin(), loop.points.end());
    }
  std::vector<Vec3> cloth;
  const auto away = [](const std::vector<Vec3>& line, Vec3 p) {
    double least = 1e9;
    for (const Vec3 q : line) least = std::fmin(least, squaredLength(p - q));
    return least;
  };
  for (const SceneCloth& piece : fitting.frame.cloths)
    for (const SectionLoop& loop : section(piece.mesh, level))
      for (const Vec3 p : loop.points)
        if (arms.empty() || away(trunk, p) <= away(arms, p)) cloth.push_back(p);
  if (!allRound(cloth, trunk)) cloth.clear();
  girths.under = taped(std::move(trunk), girths.body);
  girths.round = taped(std::move(cloth), girths.garment);
  return girths;
}

std::vector<Girths> girthsOf(const Fitting& fitting) {
  std::vector<Girths> all;
  if (!fitting.body) return all;
  const std::pair<const char*, Message> levels[] = {{"torso:armpit@0", say("armpit")},
                                                    {"torso:bust@0", say("bust")},
                                                    {"torso:under_bust@0", say("under bust")},
                                                    {"torso:waist@0", say("waist")},
                                                    {"torso:hip@0", say("hip")}};
  for (const auto& [place, name] : levels) {
    const auto point = parseBodyPoint(place);
    const auto there = point ? fitting.body->find(*point) : Result<SurfacePoint>(point.error());
    if (!there) continue;
    Girths girths = girthsAt(fitting, at(fitting.body->mesh(), *there).y);
    girths.name = name;
    if (girths.garment > 0) all.push_back(std::move(girths));
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

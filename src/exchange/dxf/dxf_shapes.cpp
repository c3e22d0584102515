#include "dxf_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "exchange/names.h"
#include "karinui/base/number.h"

namespace karinui {

namespace {

constexpr double kStep = 3 * kDegree;           // of an arc between two points
constexpr int kPerSpan = 8;                     // points of a spline between two knots
constexpr std::size_t kDeepest = 8;             // blocks within blocks
constexpr std::size_t kMostShapes = 1'000'000;  // with what inserted blocks draw
constexpr std::size_t kMostPoints = 3'000'000;  // of all of them
constexpr std::size_t kHighestDegree = 12;      // of a spline

// Points along an arc about a centre, the ends included; `u` and `v` are its half axes.
void addArc(std::vector<Flat>& line, Flat centre, Flat u, Flat v, double from, double to) {
  const int steps = std::clamp(static_cast<int>(std::ceil(std::abs(to - from) / kStep)), 1, 720);
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    line.push_back(centre + std::cos(angle) * u + std::sin(angle) * v);
  }
}

// The way between two vertices, without its ends.
void addBulge(std::vector<Flat>& line, Flat a, Flat b, double bulge) {
  const double angle = 4 * std::atan(bulge), chord = distance(a, b);
  if (std::abs(angle) < 1e-4 || std::abs(angle) > 6.2 || chord == 0) return;
  // The centre lies left of the chord where the way turns left by less than half a circle.
  const Flat along = (1 / chord) * (b - a), left{-along.v, along.u};
  const Flat centre = 0.5 * (a + b) + (0.5 * chord / std::tan(angle / 2)) * left;
  const Flat u = a - centre, v{-u.v, u.u};
  std::vector<Flat> arc;
  addArc(arc, centre, u, v, 0, angle);
  line.insert(line.end(), arc.begin() + 1, arc.end() - 1);
}

// A B-spline by de Boor's recursion (The NURBS Book, A3.1 and A4.1), at its knots and between them. Empty: it is none.
std::vector<Flat> splinePoints(const DxfEntity& spline) {
  const std::vector<Flat> controls = spline.places(10);
  const std::vector<double> knots = spline.numbers(40);
  std::vector<double> weights = spline.numbers(41);
  const double told = spline.number(71).value_or(3);
  if (told < 1 || told > kHighestDegree || controls.size() < 2) return spline.places(11);  // points on the curve
  const auto degree = static_cast<std::size_t>(told);
  if (knots.size() != controls.size() + degree + 1 || !std::is_sorted(knots.begin(), knots.end()))
    return spline.places(11);
  weights.resize(controls.size(), 1);
  std::vector<Flat> line;
  std::vector<Vec3> d(degree + 1);
  for (std::size_t span = degree; span + 1 < knots.size() - degree; ++span) {
    if (!(knots[span + 1] > knots[span])) continue;
    for (int i = line.empty() ? 0 : 1; i <= kPerSpan; ++i) {
      const double t = knots[span] + (knots[span + 1] - knots[span]) * i / kPerSpan;
      for (std::size_t j = 0; j <= degree; ++j) {
        const std::size_t k = span - degree + j;
        d[j] = {controls[k].u * weights[k], controls[k].v * weights[k], weights[k]};
      }
      for (std::size_t r = 1; r <= degree; ++r)
        for (std::size_t j = degree; j >= r; --j) {
          const std::size_t k = span - degree + j;
          const double wide = knots[k + degree + 1 - r] - knots[k], share = wide > 0 ? (t - knots[k]) / wide : 0;
          d[j] = (1 - share) * d[j - 1] + share * d[j];
        }
      if (d[degree].z == 0) return {};
      line.push_back({d[degree].x / d[degree].z, d[degree].y / d[degree].z});
    }
  }
  return line;
}

std::vector<Flat> vertexPoints(const DxfEntity& polyline) {
  std::vector<Flat> line;
  const auto& vertices = polyline.vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    line.push_back(vertices[i].place);
    if (i + 1 < vertices.size() || polyline.closed())
      addBulge(line, vertices[i].place, vertices[(i + 1) % vertices.size()].place, vertices[i].bulge);
  }
  return line;
}

class Drawing {
 public:
  Drawing(const DxfFile& file, const std::set<std::string_view>& without) : file_(file), without_(without) {}
  std::vector<DxfShape> shapes;

  Done draw(const std::vector<DxfEntity>& entities, const DxfFrame& frame, int layer, std::size_t depth) {
    if (depth > kDeepest)
      return badInput(say("Blocks of the DXF file lie more than {0} deep in each other.", kDeepest));
    for (const DxfEntity& entity : entities) {
      if (++entities_ > kMostShapes || points_ > kMostPoints)
        return badInput(say("The DXF file draws more than {0} lines and points; that is no garment.", kMostShapes));
      if (const Done done = draw(entity, frame, layer, depth); !done) return done;
    }
    return {};
  }

 private:
  Done draw(const DxfEntity& entity, const DxfFrame& frame, int within, std::size_t depth) {
    DxfShape shape;
    shape.layerName = entity.text(8);
    shape.layer = layerNumber(shape.layerName);
    if (within >= 0 && shape.layer <= 0) shape.layer = within;  // layer 0 of a block is the layer it is inserted on
    if (const auto degrees = entity.number(50))
      shape.heading = Flat{std::cos(*degrees * kDegree), std::sin(*degrees * kDegree)};
    if (entity.is("INSERT")) {
      // A notch or a drill hole may be a symbol of its own, turned as it pleases.
      shape.heading.reset();
      if ((!isNotchLayer(shape.layer) && shape.layer != 13) || !entity.place()) {
        const DxfBlock* block = file_.block(entity.text(2));
        if (!block || without_.contains(block->name)) return {};
        const DxfFrame own = frameOf(entity, block->base);
        const DxfFrame whole{frame.turned(own.u), frame.turned(own.v), frame(own.at)};
        return draw(block->entities, whole, shape.layer, depth + 1);
      }
      shape.points = {*entity.place()};
    } else if (entity.is("POINT")) {
      if (const auto place = entity.place()) shape.points = {*place};
    } else if (entity.is("TEXT") || entity.is("MTEXT") || entity.is("ATTRIB") || entity.is("ATTDEF")) {
      shape.kind = DxfShape::Kind::Text, shape.words = entity.text(1);
      shape.points = {entity.place().value_or(Flat{})};
    } else {
      shape.kind = DxfShape::Kind::Line, shape.heading.reset();
      line(entity, shape);
      if (shape.points.size() < 2) return {};
    }
    if (shape.points.empty()) return {};
    points_ += shape.points.size();
    // Seen from below (extrusion 0, 0, -1) a flat entity is the mirror image.
    const bool below = entity.number(230).value_or(1) < 0 && !entity.is("LINE") && !entity.is("POINT");
    for (Flat& p : shape.points) p = frame(below ? Flat{-p.u, p.v} : p);
    if (shape.heading)
      if (const Flat way = frame.turned(*shape.heading); length(way) > 0) shape.heading = normalized(way);
    if (entity.is("MTEXT"))  // several lines in one
      for (auto end = shape.words.find("\\P"); end != std::string_view::npos; end = shape.words.find("\\P")) {
        DxfShape& above = shapes.emplace_back(shape);
        above.words = shape.words.substr(0, end);
        shape.words.remove_prefix(end + 2);
      }
    shapes.push_back(std::move(shape));
    return {};
  }

  static void line(const DxfEntity& entity, DxfShape& shape) {
    const auto centre = entity.place();
    const double radius = entity.number(40).value_or(0);
    if (entity.is("LINE")) {
      const auto to = entity.place(11);
      if (centre && to) shape.points = {*centre, *to};
    } else if (entity.is("POLYLINE") || entity.is("LWPOLYLINE")) {
      shape.points = vertexPoints(entity), shape.closed = entity.closed();
    } else if (entity.is("SPLINE")) {
      shape.points = splinePoints(entity), shape.closed = entity.closed();
    } else if (entity.is("CIRCLE") && centre && radius > 0) {
      addArc(shape.points, *centre, {radius, 0}, {0, radius}, 0, 2 * std::numbers::pi);
      shape.points.pop_back(), shape.closed = shape.round = true;
    } else if (entity.is("ARC") && centre && radius > 0) {
      const double from = entity.number(50).value_or(0) * kDegree, told = entity.number(51).value_or(0) * kDegree;
      const double turn = std::remainder(told - from, 2 * std::numbers::pi);
      addArc(shape.points, *centre, {radius, 0}, {0, radius}, from,
             from + (turn > 0 ? turn : turn + 2 * std::numbers::pi));
    } else if (const auto axis = entity.place(11); entity.is("ELLIPSE") && centre && axis) {
      const double ratio = entity.number(40).value_or(1), from = entity.number(41).value_or(0);
      const double to = entity.number(42).value_or(2 * std::numbers::pi);
      addArc(shape.points, *centre, *axis, {-ratio * axis->v, ratio * axis->u}, from,
             std::clamp(to, from - 7, from + 7));
    }
  }

  const DxfFile& file_;
  const std::set<std::string_view>& without_;
  std::size_t points_ = 0, entities_ = 0;
};

}  // namespace

DxfFrame frameOf(const DxfEntity& insert, Flat base) {
  const double angle = insert.number(50).value_or(0) * kDegree, c = std::cos(angle), s = std::sin(angle);
  const auto scale = [&](int code) {
    const double told = insert.number(code).value_or(1);
    return told == 0 ? 1.0 : told;
  };
  const double x = scale(41), y = scale(42);
  DxfFrame frame{{x * c, x * s}, {-y * s, y * c}, insert.place().value_or(Flat{})};
  if (insert.number(230).value_or(1) < 0) frame.u.u = -frame.u.u, frame.v.u = -frame.v.u, frame.at.u = -frame.at.u;
  frame.at = frame.at - frame.turned(base);
  return frame;
}

Result<std::vector<DxfShape>> shapesOf(const DxfFile& file, const std::vector<DxfEntity>& entities,
                                       const DxfFrame& frame, const std::set<std::string_view>& without) {
  Drawing drawing(file, without);
  if (const Done done = drawing.draw(entities, frame, -1, 0); !done) return done.error();
  return std::move(drawing.shapes);
}

}  // namespace karinui

#include "karinui/scene/table_scene.h"

#include <cmath>
#include <numbers>

namespace karinui {

namespace {

constexpr Colour kInk{0.045f, 0.038f, 0.030f}, kFaint{0.15f, 0.13f, 0.11f}, kChosen{0.42f, 0.065f, 0.016f},
    kPin{0.45f, 0.02f, 0.02f};
constexpr double kDash = 0.006, kGap = 0.004;  // metres of paper, of an internal line
constexpr double kSeamInset = 0.003;           // metres of paper from the edge to its seam's line
constexpr double kTickLength = 0.009;
constexpr double kThin = 3, kThick = 5;  // mm of paper, of a seam's line: to be seen from where one stands
constexpr double kCornerSide = 0.004;    // half of a corner's square
constexpr double kPinHead = 0.003;       // radius of a pin's head

class Drawing {
 public:
  Drawing(TableScene& out, const TablePlacement& placement, double above)
      : out_(out), placement_(placement), above_(above) {}

  void cloth(const TablePiece& piece) {
    SceneCloth cloth;
    cloth.name = piece.name;
    cloth.colour = piece.colour;
    cloth.live = piece.chosen;
    const Ring outer = ringOf(piece.edges);
    std::vector<Ring> holes;
    cloth.flat = outer;
    const auto addRun = [&](std::size_t first) {
      std::vector<std::uint32_t> run;
      for (std::size_t i = first; i < cloth.flat.size(); ++i) run.push_back(static_cast<std::uint32_t>(i));
      run.push_back(static_cast<std::uint32_t>(first));
      cloth.outlines.push_back(std::move(run));
    };
    addRun(0);
    for (const auto& edges : piece.holes) {
      holes.push_back(ringOf(edges));
      const std::size_t first = cloth.flat.size();
      cloth.flat.insert(cloth.flat.end(), holes.back().begin(), holes.back().end());
      addRun(first);
    }
    for (const Flat p : cloth.flat) cloth.mesh.points.push_back(placement_.at(p, above_));
    if (auto faces = triangulate(outer, holes, {})) cloth.mesh.faces = *std::move(faces);
    out_.frame.cloths.push_back(std::move(cloth));
  }

  // A sheet with a photograph on it, whose paper begins at the picture's upper left corner.
  void scan(const TableScan& scan) {
    SceneCloth cloth;
    cloth.colour = {0.9f, 0.9f, 0.88f};
    const double high = scan.height();
    cloth.flat = {{0, -high}, {scan.width, -high}, {scan.width, 0}, {0, 0}};
    for (const Flat corner : scan.corners()) cloth.mesh.points.push_back(placement_.at(corner, 0.5 * above_));
    cloth.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    cloth.look.weave = ClothLook::Weave::Uneven, cloth.look.relief = 0;
    cloth.look.print = ClothLook::Print::Photo;
    cloth.look.repeat = scan.width;
    cloth.look.photo = scan.image;
    out_.frame.cloths.push_back(std::move(cloth));
  }

  void line(const std::vector<Flat>& points, const Colour& colour, double widthMm, bool arrow = false) {
    SceneLine drawn{{}, colour, static_cast<float>(widthMm * placement_.scale()), arrow};
    for (const Flat p : points) drawn.points.push_back(placement_.at(p, 2 * above_));
    out_.frame.lines.push_back(std::move(drawn));
  }
  void closed(Ring ring, const Colour& colour, double widthMm) {
    ring.push_back(ring.front());
    line(ring, colour, widthMm);
  }
  void dashed(const std::vector<Flat>& points, const Colour& colour, double widthMm) {
    double left = kDash;
    bool down = true;
    std::vector<Flat> dash;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      Flat from = points[i];
      if (down && dash.empty()) dash.push_back(from);
      for (double rest = distance(from, points[i + 1]); rest > 0;) {
        const double step = std::fmin(rest, left);
        from = rest == step ? points[i + 1] : from + normalized(points[i + 1] - from) * step;
        rest -= step, left -= step;
        if (down) dash.push_back(from);
        if (left > 0) continue;
        if (down) line(std::exchange(dash, {}), colour, widthMm);
        down = !down;
        left = down ? kDash : kGap;
        if (down) dash.push_back(from);
      }
    }
    if (dash.size() > 1) line(dash, colour, widthMm);
  }
  void circle(Flat middle, double radius, const Colour& colour, double widthMm) {
    constexpr int kSides = 20;
    Ring ring;
    for (int i = 0; i < kSides; ++i) {
      const double turn = 2 * std::numbers::pi * i / kSides;
      ring.push_back(middle + Flat{std::cos(turn), std::sin(turn)} * radius);
    }
    closed(std::move(ring), colour, widthMm);
  }
  void label(const TableLabel& label) {
    const Vec3 right = normalized(placement_.across), up = normalized(placement_.upward);
    const double size = label.size * placement_.scale();
    out_.labels.push_back({placement_.at(label.place, 2 * above_), label.upright ? right : up,
                           (label.upright ? up : -right) * size, label.words});
  }

 private:
  TableScene& out_;
  const TablePlacement& placement_;
  double above_;
};

void draw(Drawing& drawing, const TablePiece& piece) {
  drawing.cloth(piece);
  const Colour ink = piece.chosen ? kChosen : kInk;
  for (const Ring& cut : piece.cut) drawing.closed(cut, kFaint, 1.2);
  for (const TableSize& size : piece.nest) drawing.closed(size.outline, size.colour, 1);
  if (piece.before) drawing.dashed(*piece.before, kFaint, 1);
  if (piece.chosen) drawing.closed(ringOf(piece.edges), kChosen, 2.5);
  for (const auto& line : piece.lines) drawing.dashed(line, kInk, 1.6);
  for (const auto& row : piece.stitches) drawing.dashed(row, kInk, 0.8);
  for (const TableTrim& trim : piece.trims) drawing.dashed(trim.line(2 * kSeamInset), kInk, 1);
  for (const TableNotch& notch : piece.notches)
    drawing.line({notch.stroke.from, notch.stroke.to}, kInk, notch.own ? 2.5 : 1.6);
  for (const Flat hole : piece.drills) drawing.circle(hole, piece.drillRadius, kInk, 1.2);
  if (piece.grain) {
    const Flat middle = lerp(piece.grain->from, piece.grain->to, 0.5);
    for (const Flat end : {piece.grain->from, piece.grain->to}) drawing.line({middle, end}, kFaint, 2.5, true);
  }
  for (const Flat corner : piece.corners) {
    const double s = kCornerSide;
    drawing.closed({corner + Flat{-s, -s}, corner + Flat{s, -s}, corner + Flat{s, s}, corner + Flat{-s, s}}, ink, 1);
  }
  for (const Flat pin : piece.pins) drawing.circle(pin, kPinHead, kPin, 2 * 1000 * kPinHead);
  for (const TableLabel& label : piece.labels) drawing.label(label);
}

void draw(Drawing& drawing, const TableSeam& seam) {
  for (const TableSeam::Side& side : seam.sides) {
    for (const TableSeam::Run& run : side.runs) {
      std::vector<Flat> points;
      for (std::size_t i = 0; i < run.points.size(); ++i) points.push_back(run.points[i] + run.inward[i] * kSeamInset);
      if (points.size() > 1) drawing.line(points, seam.colour, seam.chosen ? kThick : kThin);
    }
    for (const TableSeam::Tick& tick : side.ticks)
      drawing.line({tick.place, tick.place + tick.inward * kTickLength}, seam.colour, seam.chosen ? kThick : kThin);
  }
}

}  // namespace

Flat TablePlacement::below(Vec3 point) const {
  const double square = squaredLength(across);
  const Vec3 from = point - origin;
  return {dot(from, across) / square, dot(from, upward) / square};
}

std::optional<TableMet> meet(const TablePlacement& placement, const Ray& ray) {
  const Vec3 normal = placement.normal();
  const double towards = -dot(ray.direction, normal), height = dot(ray.origin - placement.origin, normal);
  if (towards < 1e-6 || height <= 0) return std::nullopt;
  const double along = height / towards;
  return TableMet{placement.below(ray.origin + ray.direction * along), along};
}

std::optional<PointerSample> onTable(const TablePlacement& placement, PointerSample sample) {
  if (sample.where == PointerSample::Where::Table) return sample;
  if (sample.tip) {
    sample.place = placement.below(sample.tip->carry);
    sample.reach /= placement.scale();
  } else {
    const auto met = meet(placement, sample.ray);
    if (!met) return std::nullopt;
    sample.place = met->place;
    sample.reach *= met->along / placement.scale();
  }
  sample.where = PointerSample::Where::Table;
  return sample;
}

TableScene sceneOf(const TableFrame& frame, const TablePlacement& placement, double above) {
  TableScene out;
  Drawing drawing(out, placement, above);
  for (const TablePiece& piece : frame.pieces) draw(drawing, piece);
  for (const TableScan& scan : frame.scans) drawing.scan(scan);
  for (const TableSeam& seam : frame.seams) draw(drawing, seam);
  for (const TablePiece& piece : frame.pieces) {
    const auto mark = [&](const std::vector<TableEdge>& edges) {
      for (const TableEdge& edge : edges)
        if (edge.chosen) drawing.line(edge.points, kChosen, 4);
    };
    mark(piece.edges);
    for (const auto& hole : piece.holes) mark(hole);
  }
  return out;
}

}  // namespace karinui

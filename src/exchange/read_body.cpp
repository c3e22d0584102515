#include "karinui/exchange/read_body.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "exchange/body_stance.h"
#include "exchange/reading_process.h"
#include "karinui/base/number.h"
#include "karinui/body/body.h"
#include "karinui/exchange/formats.h"
#include "karinui/geometry/bvh.h"
#include "karinui/geometry/wrap.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

struct UnitRange {
  LengthUnit unit;
  double metres;
  double leastHeight, mostHeight;  // in the unit: a person's heights for which it is guessed
};
// In the order of guessing. Inches come before centimetres: 55 to 80 of them are an adult, as centimetres a baby.
constexpr std::array<UnitRange, 6> kUnits{{{LengthUnit::Metre, 1, 0.4, 2.6},
                                           {LengthUnit::Foot, 0.3048, 3.5, 8},
                                           {LengthUnit::Decimetre, 0.1, 8, 26},
                                           {LengthUnit::Inch, 0.0254, 48, 82},
                                           {LengthUnit::Centimetre, 0.01, 40, 260},
                                           {LengthUnit::Millimetre, 0.001, 400, 2600}}};

// Of somebody less than a metre high the legs part at 0.42 of the height at most.
constexpr double kGrownLegs = 0.43, kSmallest = 1.0;

const UnitRange& rangeOf(LengthUnit unit) {
  return *std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitRange& w) { return w.unit == unit; });
}

Message nameOf(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::Metre:
      return say("metres");
    case LengthUnit::Foot:
      return say("feet");
    case LengthUnit::Decimetre:
      return say("decimetres");
    case LengthUnit::Inch:
      return say("inches");
    case LengthUnit::Centimetre:
      return say("centimetres");
    case LengthUnit::Millimetre:
      return say("millimetres");
  }
  return {};
}

// By the name that karinui-import knows it by.
Result<std::string> formatOf(const fs::path& path) {
  for (const FileFormat* format : formatsReading(path))
    if (format->in == FileContent::Body) return std::string(format->id);
  return unreadable(path, {FileContent::Body});
}

// One point for all that are equal; triangles that thereby lose a corner go away.
TriangleMesh joined(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.points.size()), name(mesh.points.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 p = mesh.points[a], q = mesh.points[b];
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z != q.z ? p.z < q.z : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    name[order[i]] = i > 0 && mesh.points[order[i]] == mesh.points[order[i - 1]] ? name[order[i - 1]] : order[i];
  constexpr std::uint32_t kUnused = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(mesh.points.size(), kUnused);
  TriangleMesh result;
  for (const Triangle& f : mesh.faces) {
    const Triangle t{name[f[0]], name[f[1]], name[f[2]]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    Triangle renamed;
    for (int k = 0; k < 3; ++k) {
      if (number[t[k]] == kUnused) {
        number[t[k]] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(mesh.points[t[k]]);
      }
      renamed[k] = number[t[k]];
    }
    result.faces.push_back(renamed);
  }
  return result;
}

// A person is less deep than tall, whichever way the arms are held.
UpAxis guessUp(const Vec3& size) { return size.z > size.y ? UpAxis::Z : UpAxis::Y; }

Vec3 stoodUp(Vec3 p, UpAxis up) {
  if (up == UpAxis::Z) return {p.x, p.z, -p.y};
  if (up == UpAxis::X) return {-p.y, p.x, p.z};
  return p;
}

// About the upright axis, by quarters from the front towards the body's right.
Vec3 turnedBy(Vec3 p, int quarters) {
  if (quarters == 1) return {-p.z, p.y, p.x};
  if (quarters == 2) return {-p.x, p.y, -p.z};
  if (quarters == 3) return {p.z, p.y, -p.x};
  return p;
}

// Turns a body that stands along y to face forwards. Says what it did, and what it could not tell.
void faceForwards(ImportedBody& body) {
  const auto facing = facingOf(body.mesh);
  if (!facing) {
    body.notes.push_back(
        say("Where its front is was not recognised; it is taken as facing along z. Look at it in a picture; if it "
            "faces another way, turn it where it was made, and import it again."));
    return;
  }
  body.legs = facing->legs;
  constexpr double kQuarter = std::numbers::pi / 2;
  constexpr double kAside = 15 * kDegree;
  constexpr double kAskew = 3 * kDegree;    // less is how people stand, and what telling it is good for
  constexpr double kInStep = 60 * kDegree;  // the line between the feet of somebody in a step, from the trunk's breadth
  double angle = std::atan2(facing->front.x, facing->front.z);
  std::optional<double> trunk = trunkAngle(body.mesh);
  if (trunk) {  // that way along its short axis which the feet point
    *trunk += 2 * kQuarter * std::round((angle - *trunk) / (2 * kQuarter));
    if (std::abs(angle - *trunk) < kInStep)
      angle = *trunk;
    else
      trunk.reset();
  }
  const double quarters = std::round(angle / kQuarter);
  if (const int turns = (static_cast<int>(quarters) + 4) % 4) {
    constexpr std::array kWays{"z", "x", "-z", "-x"};
    for (Vec3& p : body.mesh.points) p = turnedBy(p, turns);
    body.notes.push_back(say("Its feet point along {0}: it was turned to face along z.", kWays[turns]));
  }
  const double aside = angle - quarters * kQuarter;
  const auto degrees = [&] { return fixed(std::abs(aside) / kDegree, 0); };
  if (trunk && std::abs(aside) > kAskew) {
    const double sine = std::sin(aside), cosine = std::cos(aside);
    for (Vec3& p : body.mesh.points) p = {cosine * p.x - sine * p.z, p.y, sine * p.x + cosine * p.z};
    body.notes.push_back(say("It stood askew by {0}° and was turned to face straight forwards.", degrees()));
  } else if (std::abs(aside) > kAside) {
    body.notes.push_back(
        say("Its feet point {0}° aside. Turn it to face straight forwards where it was made, and import it again: "
            "else front and back of a garment lie askew.",
            degrees()));
  }
}

void turnAround(TriangleMesh& mesh) {
  for (Triangle& f : mesh.faces) std::swap(f[1], f[2]);
}

// Puts the mesh into metres, upright, on the ground. Says what was guessed.
Result<void> stand(ImportedBody& body, const BodyReadOptions& options, const std::string& format) {
  const char* axisNames[] = {"x", "y", "z"};
  const bool fixedUp = format == "gltf" || format == "glb";  // the format says y
  const auto seen = options.up ? std::nullopt : uprightnessOf(body.mesh);
  body.up = options.up ? *options.up
            : seen     ? static_cast<UpAxis>(seen->axis)
            : fixedUp  ? UpAxis::Y
                       : guessUp(boxOf(body.mesh.points).size());
  for (Vec3& p : body.mesh.points) p = stoodUp(p, body.up);
  if (seen && seen->down) {
    for (Vec3& p : body.mesh.points) p = {-p.x, -p.y, p.z};
    body.notes.push_back(
        say("It stood on its head along its {0} axis and was turned over.", axisNames[static_cast<int>(body.up)]));
  } else if (!options.up && (!fixedUp || body.up != UpAxis::Y)) {
    body.notes.push_back(say("Taken as standing along its {0} axis.", axisNames[static_cast<int>(body.up)]));
  }

  const double height = boxOf(body.mesh.points).size().y;
  if (options.unit) {
    body.unit = *options.unit;
  } else {
    const auto guess = std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitRange& w) {
      return height >= w.leastHeight && height <= w.mostHeight;
    });
    if (guess == kUnits.end())
      return badInput(
          say("A body {0} units high fits no unit of length; say which unit the file is in.", shortest(height)));
    body.unit = guess->unit;
    body.notes.push_back(
        say("Taken as {0}: the body is {1} cm high.", nameOf(guess->unit), fixed(height * guess->metres * 100, 1)));
  }
  faceForwards(body);
  const double metres = rangeOf(body.unit).metres;
  if (!(height * metres >= 0.03) || !(height * metres <= 60))
    return badInput(
        say("The body would be {0} m high in {1}; that is no body.", shortest(height * metres), nameOf(body.unit)));
  for (Vec3& p : body.mesh.points) p *= metres;
  if (body.legs > kGrownLegs && height * metres < kSmallest)
    body.notes.push_back(
        say("It is built like a grown-up or a school child, but only {0} cm high: its legs are {1}% of it. If it was "
            "made smaller on the way, import it again at its own size; else clothes come out as for a doll.",
            fixed(height * metres * 100, 1), fixed(body.legs * 100, 0)));

  const Box box = boxOf(body.mesh.points);
  const double aside = std::hypot(box.centre().x, box.centre().z);
  const bool carry = aside > 0.25 * box.size().y;
  const Vec3 by{carry ? -box.centre().x : 0, -box.low.y, carry ? -box.centre().z : 0};
  for (Vec3& p : body.mesh.points) p += by;
  if (length(by) > 1e-4)
    body.notes.push_back(say("Moved by {0} cm to stand on the ground in the middle.", fixed(length(by) * 100, 1)));
  return {};
}

// Of what was recognised as a person: does a tape read what a person can have, in what a mannequin is made to?
void tellImpossibleMeasures(ImportedBody& body) {
  const double height = boxOf(body.mesh.points).size().y;
  if (body.legs == 0 || height < kSmallest) return;  // a doll's are told of by its height
  const Bvh bvh(body.mesh);
  if (const Done possible = plausible(forMannequin(measure(body.mesh, bvh))); !possible)
    body.notes.push_back(
        say("A tape reads on it what no person has: {0} Look at its unit, whether it was stretched, and whether the "
            "arms stand off the trunk and the legs apart.",
            possible.error().what));
}

void sayWhatIsWrong(ImportedBody& body) {
  const MeshReport& r = body.report;
  if (r.shells > 1) body.notes.push_back(say("The surface is of {0} separate {0|part|parts}.", r.shells));
  if (r.selfCrossings > 0)
    body.notes.push_back(say(
        "{0} {0|pair of triangles crosses|pairs of triangles cross} each other; that is tolerated.", r.selfCrossings));
}

}  // namespace

Result<ImportedBody> readBody(const fs::path& path, const BodyReadOptions& options, Workers& workers,
                              const Token& token) {
  const auto format = formatOf(path);
  if (!format) return format.error();
  const auto helper = importHelper(options.helper);
  if (!helper) return helper.error();
  token.progress(0, say("Reading the body"));
  const auto read = readInOtherProcess(path, *format, *helper, options.limits, token);
  if (!read) return read.error();
  return importedBody(*read, *format, options, workers, token);
}

Result<ImportedBody> importedBody(const TriangleMesh& read, const std::string& format, const BodyReadOptions& options,
                                  Workers& workers, const Token& token) {
  ImportedBody body;
  body.mesh = joined(read);
  if (body.mesh.faces.empty()) return badInput(say("Every triangle of the file is without area."));
  if (const auto done = stand(body, options, format); !done) return done.error();
  body.found = body.report = inspectTopology(body.mesh);
  if (!body.report.closed()) {
    if (options.open) *options.open = !options.wrap;
    if (!options.wrap)
      return badInput(
          say("The body is not closed: {0} {0|edge is|edges are} open, {1} {1|is|are} shared by more than two "
              "triangles and {2} "
              "{2|joins|join} triangles that face opposite ways. It can be wrapped in a watertight skin on request.",
              body.report.openEdges, body.report.nonManifoldEdges, body.report.flippedEdges));
    // The skin asks which side is out, so most of the surface must agree on it.
    if (!body.report.outward) turnAround(body.mesh), body.turnedOutward = true;
    auto skin = wrapped(body.mesh, options.wrapCell, workers, token);
    if (!skin) return skin.error();
    body.mesh = std::move(*skin);
    body.wrapped = true;
    body.notes.push_back(say("Wrapped in a watertight skin with cells of {0} mm; it had {1} open {1|edge|edges}.",
                             fixed(options.wrapCell * 1e3, 1), body.found.openEdges));
  } else if (!body.report.outward) {
    turnAround(body.mesh);
    body.turnedOutward = true;
  }
  if (body.turnedOutward) body.notes.push_back(say("The surface faced inward and was turned."));
  if (token.cancelled()) return cancelled();
  body.report = inspect(body.mesh);
  if (!body.report.closed() || !body.report.outward || volume(body.mesh) < 1e-9)
    return badInput(say("The surface encloses no body."));
  sayWhatIsWrong(body);
  if (token.cancelled()) return cancelled();
  tellImpossibleMeasures(body);
  token.progress(1);
  return body;
}

}  // namespace karinui

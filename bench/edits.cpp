#include "bench/edits.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <numbers>

#include "bench/workload.h"
#include "karinui/design/drape.h"
#include "karinui/design/script.h"
#include "karinui/session/session.h"

namespace karinui::bench {
namespace {

using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

constexpr double kNear = 0.002;  // metres

// A capsule from a to b as a closed mesh; the arms' ends lie within the trunk.
void addCapsule(TriangleMesh& mesh, Vec3 a, Vec3 b, double radius) {
  constexpr std::uint32_t kAround = 32, kCap = 8, kAlong = 12;
  const Vec3 axis = normalized(b - a);
  const Vec3 side = normalized(cross(axis, std::fabs(axis.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}));
  const Vec3 other = cross(axis, side);
  struct Ring {
    Vec3 middle;
    double radius;
  };
  std::vector<Ring> rings;
  for (std::uint32_t k = 1; k <= kCap; ++k) {
    const double turn = 0.5 * std::numbers::pi * k / kCap;
    rings.push_back({a - axis * (radius * std::cos(turn)), radius * std::sin(turn)});
  }
  for (std::uint32_t k = 1; k < kAlong; ++k) rings.push_back({lerp(a, b, static_cast<double>(k) / kAlong), radius});
  for (std::uint32_t k = kCap; k >= 1; --k) {
    const double turn = 0.5 * std::numbers::pi * k / kCap;
    rings.push_back({b + axis * (radius * std::cos(turn)), radius * std::sin(turn)});
  }
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(a - axis * radius);
  for (const Ring& ring : rings)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double turn = 2 * std::numbers::pi * k / kAround;
      mesh.points.push_back(ring.middle + (side * std::cos(turn) + other * std::sin(turn)) * ring.radius);
    }
  const auto last = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.push_back(b + axis * radius);
  const auto at = [&](std::size_t ring, std::uint32_t k) {
    return first + 1 + static_cast<std::uint32_t>(ring) * kAround + k % kAround;
  };
  for (std::uint32_t k = 0; k < kAround; ++k) {
    mesh.faces.push_back({first, at(0, k + 1), at(0, k)});
    mesh.faces.push_back({last, at(rings.size() - 1, k), at(rings.size() - 1, k + 1)});
    for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
      mesh.faces.push_back({at(r, k), at(r, k + 1), at(r + 1, k + 1)});
      mesh.faces.push_back({at(r, k), at(r + 1, k + 1), at(r + 1, k)});
    }
  }
}

// The tunic of docs/performance.md as pieces of paper.
constexpr const char* kOutline =
    "M -300 -430; hem L 300 -430; side_left L 300 67.6; armhole_left L 300 270; shoulder_left L 122.5 270; neck L "
    "-122.5 270; shoulder_right L -300 270; armhole_right L -300 67.6; side_right L -300 -430";

Result<DocumentFile> tunicFile(double spacing, Context& context) {
  DocumentFile file = DocumentFile::inMemory();
  Body::Parts parts;
  parts.name = "capsules";
  addCapsule(parts.mesh, {0, -0.16, 0}, {0, 0.16, 0}, 0.14);
  addCapsule(parts.mesh, {0.10, 0.18, 0}, {0.50, 0.18, 0}, 0.05);
  addCapsule(parts.mesh, {-0.10, 0.18, 0}, {-0.50, 0.18, 0}, 0.05);
  const auto blob = file.blobs().put(packBody(parts));
  if (!blob) return blob.error();
  SetBody body;
  body.mesh = *blob;
  if (const auto step = file.perform(std::move(body), context); !step) return step.error();
  std::string script = "set spacing=" + std::to_string(spacing * 1000) + "mm\n";
  script +=
      "fabric name=bench like=cotton weight=0.15 stretch_warp=1000 stretch_weft=1000 toe=0.002 stiffen_warp=0 "
      "stiffen_weft=0 shear=40 shear_stiffen=0 bend_warp=0.00001 bend_weft=0.00001 compression=0.05 "
      "friction_body=0.3 friction_cloth=0.3\n";
  for (const bool front : {true, false})
    script += std::string("piece name=") + (front ? "front" : "back") + " fabric=bench outline=\"" + kOutline +
              "\" pose=\"0,0," + (front ? "0.26" : "-0.26") + "\"\n";
  for (const char* edge : {"side_left", "side_right", "shoulder_left", "shoulder_right"})
    script += std::string("sew a=front.") + edge + " b=back." + edge + " reversed=no name=" + edge + "\n";
  script += "drape\n";
  const auto lines = parseScript(script);
  if (!lines) return lines.error();
  for (const ScriptLine& line : *lines)
    if (const auto step = file.perform(line.operation, context); !step) return step.error();
  return file;
}

// The n-th time an edit is made it is another one of its kind, so that nothing is found by having been there.
std::string editOf(const std::string& name, int n) {
  const std::string side = n % 2 == 0 ? "front" : "back";
  const std::string mm = std::to_string(n % 10);
  if (name == "seam")  // the side of one panel, 2 cm in
    return "reshape piece=" + side + " at=\"30cm,-" + std::to_string(5 + n % 10) + "cm\" by=\"-2cm,0,0\" within=15cm";
  if (name == "sew") {
    const std::string edge = n % 4 < 2 ? "armhole_left" : "armhole_right";
    return "sew a=front." + edge + "@0:0." + std::to_string(2 + n % 3) + " b=back." + edge + "@0:0." +
           std::to_string(2 + n % 3) + " reversed=no";
  }
  if (name == "cut") return "cut piece=" + side + " line=\"" + mm + "cm,-45cm " + mm + "cm,-28cm\"";
  if (name == "move") return "move piece=" + side + " by=\"0,0." + mm + "cm," + (n % 2 == 0 ? "1cm\"" : "-1cm\"");
  return "pull piece=" + side + " at=\"" + mm + "cm,-40cm\" by=\"0,2cm," + (n % 2 == 0 ? "6cm\"" : "-6cm\"") +
         " seconds=0.5";
}

// A session as a window has it: woken when there is something to take in.
class Fitter {
 public:
  explicit Fitter(int threads, DocumentFile file)
      : session_(SessionOptions{threads, true, [this] { ring(); }, nullptr, {}, {}, {}, {}}) {
    session_.begin(std::move(file));
    session_.finish();
  }
  Session& session() { return session_; }

  // Performs and waits until all is still; what was shown when.
  struct Shown {
    double at;
    SnapshotPtr fitting;
  };
  std::vector<Shown> watch(Operation operation) {
    std::vector<Shown> shown;
    std::uint64_t seen = session_.changes().garment;
    const auto start = Clock::now();
    session_.perform(std::move(operation));
    while (true) {
      {
        std::unique_lock lock(mutex_);
        woken_.wait_for(lock, std::chrono::milliseconds(50), [&] { return rung_; });
        rung_ = false;
      }
      session_.update();
      if (session_.changes().garment != seen) {
        seen = session_.changes().garment;
        shown.push_back({secondsSince(start), session_.shownPtr()});
      }
      if (session_.idle()) return shown;
    }
  }

 private:
  void ring() {
    const std::lock_guard lock(mutex_);
    rung_ = true;
    woken_.notify_one();
  }
  std::mutex mutex_;
  std::condition_variable woken_;
  bool rung_ = false;
  Session session_;
};

double farthest(const GarmentSnapshot& a, const GarmentSnapshot& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.frame.cloths.size(); ++k) {
    const auto& x = a.frame.cloths[k].mesh.points;
    if (k >= b.frame.cloths.size() || b.frame.cloths[k].mesh.points.size() != x.size()) return 1e9;
    for (std::size_t n = 0; n < x.size(); ++n) most = std::fmax(most, distance(x[n], b.frame.cloths[k].mesh.points[n]));
  }
  return most;
}

Result<std::vector<double>> livePull(const Document& document, int runs, Context& context) {
  std::vector<double> steps;
  for (int n = 0; n < runs; ++n) {
    const auto operation = parseOperation(editOf("pull", n));
    if (!operation) return operation.error();
    PullCloth pull = std::get<PullCloth>(*operation);
    const auto known = resolved(document, pull, context);
    if (!known) return known.error();
    auto live = LivePull::take(document, std::get<PullCloth>(*known), context);
    if (!live) return live.error();
    for (int k = 1; k <= 30; ++k) {
      const auto start = Clock::now();
      if (const auto force = live->to(pull.by.back() * (k / 30.0), context); !force) return force.error();
      steps.push_back(secondsSince(start));
    }
  }
  return steps;
}

}  // namespace

double percentile(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(1, rank) - 1];
}

Result<EditFinding> edits(std::size_t vertices, int runs, int threads, const Token& token) {
  const double spacing = std::sqrt(2 * 0.6 * 0.7 / (vertices == 0 ? 12096.0 : static_cast<double>(vertices)));
  EditFinding finding;
  Workers workers(threads);
  MemoryBlobs blobs;
  Bodies bodies;
  Context context{workers, token, blobs, bodies, {}, {}};
  auto file = tunicFile(spacing, context);
  if (!file) return file.error();
  const Document rested = file->document();
  auto steps = livePull(rested, runs, context);
  if (!steps) return steps.error();
  finding.pullStep = *std::move(steps);
  Fitter fitter(threads, *std::move(file));
  Session& session = fitter.session();
  const std::size_t before = session.steps().size();
  for (const char* name : {"seam", "sew", "cut", "move", "pull"}) {
    EditTimes times;
    times.name = name;
    for (int n = 0; n < runs; ++n) {
      token.progress(0.2 * static_cast<double>(finding.edits.size()) + 0.2 * n / runs, say("Editing"));
      if (token.cancelled()) return cancelled();
      const auto operation = parseOperation(editOf(name, n));
      if (!operation) return operation.error();
      const auto shown = fitter.watch(*operation);
      for (const Notice& notice : session.takeNotices())
        if (notice.kind == Notice::Kind::Refused) return refused(notice.what);
      if (shown.empty()) return refused(say("The edit “{0}” changed nothing.", std::string(name)));
      times.first.push_back(shown.front().at);
      times.rest.push_back(shown.back().at);
      std::size_t near = shown.size() - 1;
      while (near > 0 && farthest(*shown[near - 1].fitting, *shown.back().fitting) < kNear) --near;
      times.within2mm.push_back(shown[near].at);
      const Document& after = session.snapshot().document;
      times.last = after.drape.last.value_or(SettleReport{});
      times.unsettled += times.last.settled || std::holds_alternative<PullCloth>(*operation) ? 0 : 1;
      times.undraped += after.drape.dirty.empty() ? 0 : 1;
      if (const auto standing = standingCloth(after, livePieces(after, {})))
        times.crossings = check(standing->cloth, standing->state, nullptr).clothClothCrossings;
      session.goTo(before);
      session.finish();
    }
    finding.edits.push_back(std::move(times));
  }
  const auto standing = standingCloth(rested, livePieces(rested, {}));
  finding.vertices = standing ? standing->cloth.nodeCount : 0;
  return finding;
}

}  // namespace karinui::bench

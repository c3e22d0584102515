#include "karinui/session/animation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "karinui/base/file.h"
#include "karinui/design/drape.h"
#include "karinui/geometry/bvh.h"
#include "karinui/session/export.h"
#include "karinui/session/garment_snapshot.h"
#include "session/clear_of_skin.h"
#include "session/pose_steps.h"

namespace karinui {

namespace {

constexpr double kKeyStep = 1.0 / 25;  // seconds from keyframe to keyframe
constexpr double kSpeed = 1;           // metres a second, of the fastest skin
constexpr double kShareSeen = 0.005;   // of a way: what is looked at of it
constexpr double kMoved = 0.002;       // metres rms of the cloth, from keyframe to keyframe while it comes to rest
constexpr double kPause = 0.5;         // seconds at rest in a pose
constexpr double kClearOnWay = 0.001;  // metres before the skin, of cloth on its way;
constexpr double kDeepOnWay = 0.02;    // none of it lies deeper

// A place that goes with a face of cloth.
struct OnCloth {
  std::size_t piece = 0;
  Triangle face{};
  std::array<double, 3> weight{};
  Vec3 off;  // along the face's first side, across it, and its normal
};

// Unit and at right angles: a face's first side, across it in the face, its normal.
std::array<Vec3, 3> axesOf(const std::vector<Vec3>& points, const Triangle& face) {
  const Vec3 side = points[face[1]] - points[face[0]];
  const Vec3 up = cross(side, points[face[2]] - points[face[0]]);
  if (!(squaredLength(up) > 0)) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const Vec3 x = normalized(side), z = normalized(up);
  return {x, cross(z, x), z};
}

using Places = std::vector<std::vector<Vec3>>;  // of the points of every piece

// What is sewn onto cloth and goes with it. Small parts, as a button or a stitch, go stiffly with the face next to
// their middle; of long ones, as a binding, every point goes with the face next to it.
class WithCloth {
 public:
  WithCloth(const TriangleMesh& mesh, const std::vector<SpatialPiece>& pieces, const std::vector<Bvh>& trees)
      : points_(mesh.points.size()) {
    constexpr double kSmall = 0.035;  // metres, corner to corner of its box
    for (const std::vector<std::uint32_t>& part : partsOf(mesh)) {
      Box box;
      for (const std::uint32_t k : part) box.include(mesh.points[k]);
      const bool stiff = length(box.size()) <= kSmall;
      const OnCloth middle = stiff ? at(box.centre(), box.centre(), pieces, trees) : OnCloth();
      for (const std::uint32_t k : part) {
        points_[k] = stiff ? at(mesh.points[k], middle, pieces) : at(mesh.points[k], mesh.points[k], pieces, trees);
      }
    }
  }
  std::vector<Vec3> on(const Places& cloth) const {
    std::vector<Vec3> all;
    all.reserve(points_.size());
    for (const OnCloth& p : points_) {
      const std::vector<Vec3>& points = cloth[p.piece];
      const auto axes = axesOf(points, p.face);
      Vec3 place = axes[0] * p.off.x + axes[1] * p.off.y + axes[2] * p.off.z;
      for (std::size_t c = 0; c < 3; ++c) place += points[p.face[c]] * p.weight[c];
      all.push_back(place);
    }
    return all;
  }

 private:
  // The points of each connected part.
  static std::vector<std::vector<std::uint32_t>> partsOf(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> root(mesh.points.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](std::uint32_t k) {
      while (root[k] != k) k = root[k] = root[root[k]];
      return k;
    };
    for (const Triangle& face : mesh.faces)
      for (const std::uint32_t corner : face) root[find(corner)] = find(face[0]);
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
    for (std::uint32_t k = 0; k < root.size(); ++k) parts[find(k)].push_back(k);
    std::vector<std::vector<std::uint32_t>> all;
    for (auto& [first, part] : parts) all.push_back(std::move(part));
    return all;
  }
  // `place` goes with the face next to `near`.
  static OnCloth at(Vec3 place, Vec3 near, const std::vector<SpatialPiece>& pieces, const std::vector<Bvh>& trees) {
    OnCloth found;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < trees.size(); ++k)
      if (const auto hit = trees[k].nearest(near, best); hit && hit->distance < best) {
        best = hit->distance;
        found.piece = k, found.face = pieces[k].mesh.faces[hit->place.face], found.weight = hit->place.weight;
      }
    return at(place, found, pieces);
  }
  // `place` goes with the face `with` goes with.
  static OnCloth at(Vec3 place, OnCloth with, const std::vector<SpatialPiece>& pieces) {
    const std::vector<Vec3>& points = pieces[with.piece].mesh.points;
    const auto axes = axesOf(points, with.face);
    for (std::size_t c = 0; c < 3; ++c) place = place - points[with.face[c]] * with.weight[c];
    with.off = {dot(place, axes[0]), dot(place, axes[1]), dot(place, axes[2])};
    return with;
  }

  std::vector<OnCloth> points_;
};

// Collects the keyframes of a garment.
class Recorder {
 public:
  explicit Recorder(SpatialGarment garment) : garment_(std::move(garment)) {
    std::vector<Bvh> trees;
    for (const SpatialPiece& piece : garment_.pieces) trees.emplace_back(piece.mesh);
    for (const SpatialNotion& notion : garment_.notions) notions_.emplace_back(notion.mesh, garment_.pieces, trees);
  }

  // Where everything is in a picture of the garment. Refused: it was laid otherwise.
  Result<SpatialKeyframe> seen(const SceneFrame& frame) const {
    const Error otherwise = refused(say("The cloth was laid otherwise on the way, and cannot be followed."));
    SpatialKeyframe key;
    if (frame.cloths.size() != garment_.pieces.size() || frame.bodies.empty() ||
        frame.bodies.front().mesh.points.size() != garment_.body->points.size())
      return otherwise;
    key.body = frame.bodies.front().mesh.points;
    for (std::size_t k = 0; k < frame.cloths.size(); ++k) {
      if (frame.cloths[k].mesh.points.size() != garment_.pieces[k].mesh.points.size()) return otherwise;
      key.pieces.push_back(frame.cloths[k].mesh.points);
    }
    return key;
  }
  // On the way edges of cells may cut off what is round of a limb.
  void addOnWay(SpatialKeyframe key, double seconds, Workers& workers) {
    const TriangleMesh skin{key.body, garment_.body->faces};
    const Bvh bvh(skin);
    for (std::size_t k = 0; k < key.pieces.size(); ++k)
      leadOut(key.pieces[k], garment_.pieces[k].mesh.faces, {skin, bvh, kDeepOnWay}, kClearOnWay, workers);
    add(std::move(key), seconds);
  }
  void add(SpatialKeyframe key, double seconds) {
    for (const WithCloth& notion : notions_) key.notions.push_back(notion.on(key.pieces));
    key.seconds = now_ += seconds;
    now_ += key.held;
    garment_.motion.push_back(std::move(key));
  }
  SpatialGarment taken() { return std::move(garment_); }

 private:
  SpatialGarment garment_;
  std::vector<WithCloth> notions_;
  double now_ = 0;
};

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double far = 0;
  for (std::size_t k = 0; k < a.size(); ++k) far = std::max(far, distance(a[k], b[k]));
  return far;
}

double rmsMove(const Places& a, const Places& b) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i, ++count) sum += squaredLength(a[k][i] - b[k][i]);
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0;
}

Result<SnapshotPtr> shown(const Document& document, Context& context, const Prints& prints) {
  const auto body = bodyOf(document, context);
  if (!body) return body.error();
  return snapshotOf(document, *body, prints);
}

}  // namespace

Result<SpatialGarment> animationOf(const Document& document, const std::vector<std::string>& poses, Context& context,
                                   const Prints& prints) {
  if (document.pattern.pieces.empty()) return refused(say("There is no piece yet; draw one on the body."));
  if (poses.empty()) return badInput(say("Say which poses the figure takes: T,step,A."));
  if (const Done known = posesKnown(document, poses, context); !known) return known.error();
  auto now = rested(document, context);
  if (!now) return now.error();
  auto garment = shown(*now, context, prints);
  if (!garment) return garment.error();
  Recorder recorder(spatialOf((*garment)->document, (*garment)->frame));
  SpatialKeyframe last = *recorder.seen((*garment)->frame);
  Context own = context;
  for (const std::string& name : poses) {
    // A rest that is remembered would be taken up at once, without a way.
    now->drape.rested.clear();
    std::vector<std::pair<double, SpatialKeyframe>> way;  // by the share of it
    own.onPose = [&](const PoseUnderWay& at) {
      if (at.share < (way.empty() ? 0 : way.back().first) + kShareSeen) return;
      if (auto key = recorder.seen(snapshotUnderWay(**garment, at)->frame)) way.emplace_back(at.share, *std::move(key));
    };
    auto posed = apply(*now, poseStep(name), own);
    if (!posed) return posed.error();
    garment = shown(*posed, context, prints);
    if (!garment) return garment.error();
    auto arrived = recorder.seen((*garment)->frame);
    if (!arrived) return arrived.error();
    way.emplace_back(1, *std::move(arrived));
    const double seconds = farthest(last.body, way.back().second.body) / kSpeed;
    double told = 0;  // of the way
    for (auto& [share, key] : way) {
      if (share < 1 && ((share - told) * seconds < kKeyStep || (1 - share) * seconds < kKeyStep)) continue;
      last = key;
      recorder.addOnWay(std::move(key), std::max((share - told) * seconds, kKeyStep), context.workers);
      told = share;
    }
    own.drape = [&](const Document& before, const DrapePieces& drape, Context& solver) -> Result<DrapeOutcome> {
      const auto onlooker = [&](const FormsNow& forms) {
        const Forms here = forms();
        if (!asFine(**garment, here)) return;
        auto key = recorder.seen(snapshotStanding(**garment, here)->frame);
        if (!key || rmsMove(key->pieces, last.pieces) < kMoved) return;
        last = *key;
        recorder.addOnWay(*std::move(key), kKeyStep, solver.workers);
      };
      return context.drape ? context.drape(before, drape, solver) : drapeOnBody(before, drape, solver, onlooker);
    };
    now = rested(*std::move(posed), own);
    if (!now) return now.error();
    garment = shown(*now, context, prints);
    if (!garment) return garment.error();
    auto rest = recorder.seen((*garment)->frame);
    if (!rest) return rest.error();
    rest->name = name, rest->held = kPause;
    last = *rest;
    recorder.add(*std::move(rest), kKeyStep);
  }
  return recorder.taken();
}

Result<std::size_t> writeAnimation(const std::filesystem::path& file, const Document& document,
                                   const std::vector<std::string>& poses, Context& context, const Prints& prints) {
  const auto garment = animationOf(document, poses, context, prints);
  const auto bytes = garment ? writeGlb(*garment) : Result<std::string>(garment.error());
  if (!bytes) return bytes.error();
  if (const Done done = writeFile(file, *bytes); !done) return done.error();
  return bytes->size();
}

}  // namespace karinui

#include "cloth/rest.h"

#include <algorithm>
#include <cmath>

namespace karinui {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr double kLongest = 1.0 / 30;   // seconds of a step
constexpr double kCreep = 0.95;         // cosine between steps
constexpr double kCreepLongest = 0.25;  // seconds of a step while cloth creeps
constexpr double kCalming = 0.002;      // share of the velocity taken off per step, growing,
constexpr int kCalmAfter = 100;         // after so many steps: the long waves have run by then
constexpr double kTieGap = 0.002;       // metres: nearer than this a pair is sewn,
constexpr double kTieShare = 0.1;       // or than this share of the spacing
constexpr int kSewSteps = 300, kSewIdle = 100;
constexpr int kFirmAfter = 10;    // steps without getting nearer, after which open seams are drawn together firmer,
constexpr double kFirmer = 1.08;  // each step so much,
constexpr double kFirmest = 30;   // up to so many times
constexpr int kFallSteps = 40;    // steps on nothing at all

RestOutcome& note(RestOutcome& so, const LevelSolver::Outcome& step, const Token& token) {
  ++so.steps;
  so.solves += static_cast<std::size_t>(step.iterations);
  so.residual = step.residual;
  so.left = step.move;
  so.finite = step.finite;
  so.cancelled = token.cancelled();
  return so;
}

}  // namespace

RestOutcome sew(LevelSolver& solver, const Token& token, const StepWatcher& watch) {
  RestOutcome so;
  LevelSolver::Stride stride;
  stride.seconds = kFrame;
  stride.keep = 0.9;
  stride.mostMove = 0.5 * solver.cloth().spacing;
  stride.friction = false;
  stride.stop = {40, 60, 0.1};
  const double tieGap = std::fmax(kTieGap, kTieShare * solver.cloth().spacing);
  double narrowest = widestGap(solver.cloth(), solver.places());
  int idle = 0;
  for (int k = 0; k < kSewSteps && !solver.allTied(); ++k) {
    const auto step = solver.step(stride, token);
    note(so, step, token);
    if (!so.finite || so.cancelled) return so;
    solver.tieWithin(tieGap);
    if (watch) watch(k, step);
    const double gap = widestGap(solver.cloth(), solver.places());
    idle = gap < 0.98 * narrowest ? 0 : idle + 1;
    narrowest = std::fmin(narrowest, gap);
    if (idle > kSewIdle) break;
    stride.closing = idle > kFirmAfter ? std::fmin(kFirmest, kFirmer * stride.closing) : stride.closing;
  }
  so.settled = solver.allTied();
  return so;
}

RestOutcome rest(LevelSolver& solver, Vec3 gravity, const RestRule& rule, double firstSeconds, const Token& token,
                 const StepWatcher& watch) {
  RestOutcome so;
  LevelSolver::Stride stride;
  stride.seconds = firstSeconds;
  stride.mostMove = solver.cloth().spacing;
  stride.gravity = gravity;
  const bool canFall = solver.cloth().pinned.empty() && length(gravity) > 0 &&
                       std::all_of(solver.cloth().pieces.begin(), solver.cloth().pieces.end(),
                                   [](const ClothPiece& p) { return p.live; });
  int calm = 0, alone = 0;
  bool touched = false;
  for (int k = 0; k < rule.mostSteps; ++k) {
    stride.keep = std::clamp(1 - kCalming * (k - kCalmAfter), 0.5, 1.0);
    const auto step = solver.step(stride, token);
    note(so, step, token);
    if (!so.finite || so.cancelled) return so;
    if (!solver.allTied()) solver.tieWithin(kTieGap);
    if (watch) watch(k, step);
    touched = touched || solver.touching() > 0;
    alone = solver.touching() > 0 ? 0 : alone + 1;
    if (canFall && touched && alone > kFallSteps) {
      so.falls = true;
      return so;
    }
    // A longer step may move more at the same speed; what a long step would still move is asked below.
    const double allowed = rule.move * std::fmax(1.0, stride.seconds / kLongest);
    // Cloth that creeps one way is given longer steps; cloth that swings or snaps is not.
    if (step.shortened)
      stride.seconds = std::fmax(0.25 * kFrame, 0.7 * stride.seconds);
    else if (step.along > kCreep)
      stride.seconds = std::fmin(kCreepLongest, 1.1 * stride.seconds);
    else
      stride.seconds = stride.seconds > kLongest ? std::fmax(kLongest, 0.5 * stride.seconds)
                                                 : std::fmin(kLongest, 1.1 * stride.seconds);
    calm = step.move < allowed && step.residual < rule.residual && solver.allTied() ? calm + 1 : 0;
    if (calm < rule.calmSteps) continue;
    if (rule.left > 0) {
      LevelSolver::Stride longer = stride;
      longer.seconds = 0.25;
      longer.stop = {40, 300, 0.02};
      const auto ahead = solver.predict(longer, token);
      so.solves += static_cast<std::size_t>(ahead.iterations);
      so.left = ahead.move;
      so.residual = ahead.residual;
      so.finite = ahead.finite;
      so.cancelled = token.cancelled();
      if (!so.finite || so.cancelled) return so;
      if (!(ahead.move < rule.left)) {
        calm = 0;
        continue;
      }
    }
    so.settled = true;
    return so;
  }
  so.falls = canFall && solver.touching() == 0;
  return so;
}

namespace {

// Places of a face that are asked about beside its corners: a grid of quarters, since a body has finer features than
// cloth has faces.
constexpr double kSamples[12][3] = {{.75, .25, 0}, {.5, .5, 0},    {.25, .75, 0},  {0, .75, .25},
                                    {0, .5, .5},   {0, .25, .75},  {.25, 0, .75},  {.5, 0, .5},
                                    {.75, 0, .25}, {.5, .25, .25}, {.25, .5, .25}, {.25, .25, .5}};
constexpr std::size_t kSampleCount = std::size(kSamples);

template <class Visit>
void liveFaces(const Cloth& cloth, Visit visit) {
  for (const ClothPiece& piece : cloth.pieces)
    if (piece.live)
      for (const Triangle& face : piece.lattice->faces)
        visit(Triangle{piece.firstNode + face[0], piece.firstNode + face[1], piece.firstNode + face[2]});
}

}  // namespace

double deepest(const Cloth& cloth, const Collider& body, std::span<const Vec3> x, Workers& workers) {
  std::vector<Triangle> faces;
  liveFaces(cloth, [&](const Triangle& face) { faces.push_back(face); });
  constexpr std::size_t kBlock = 256;
  std::vector<double> worst((faces.size() + kBlock - 1) / kBlock, 0);
  workers.forBlocks(faces.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    double most = 0;
    const auto ask = [&](Vec3 place) {
      if (body.mayTouch(place, 0.001)) most = std::fmax(most, -body.confirmed(place).distance);
    };
    for (std::size_t f = begin; f < end; ++f) {
      const Vec3 a = x[faces[f][0]], b = x[faces[f][1]], c = x[faces[f][2]];
      ask(a);
      ask(b);
      ask(c);
      for (const auto& w : kSamples) ask(a * w[0] + b * w[1] + c * w[2]);
    }
    worst[begin / kBlock] = most;
  });
  double most = 0;
  for (double w : worst) most = std::fmax(most, w);
  return most;
}

double liftOff(const Cloth& cloth, const std::vector<NodeIndex>& moving, const Collider& body, double clearance,
               std::vector<Vec3>& x, Workers& workers) {
  std::vector<Triangle> faces;
  liveFaces(cloth, [&](const Triangle& face) { faces.push_back(face); });
  std::vector<Vec3> best(cloth.nodeCount);
  std::vector<Vec3> lift(faces.size() * kSampleCount);
  constexpr std::size_t kBlock = 256;
  for (int round = 0; round < 30; ++round) {
    workers.forBlocks(moving.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        Vec3& place = x[moving[n]];
        if (!body.mayTouch(place, clearance)) continue;
        const auto contact = body.confirmed(place);
        if (contact.distance < clearance) place += contact.normal * (clearance - contact.distance);
      }
    });
    workers.forBlocks(faces.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f)
        for (std::size_t s = 0; s < kSampleCount; ++s) {
          const auto& w = kSamples[s];
          const Vec3 place = x[faces[f][0]] * w[0] + x[faces[f][1]] * w[1] + x[faces[f][2]] * w[2];
          lift[f * kSampleCount + s] = {};
          if (!body.mayTouch(place, clearance)) continue;
          const auto contact = body.confirmed(place);
          if (contact.distance < clearance)
            lift[f * kSampleCount + s] = contact.normal * (clearance - contact.distance);
        }
    });
    // A node goes by the largest lift asked of it: the sum of many would fling it.
    bool any = false;
    std::fill(best.begin(), best.end(), Vec3{});
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t s = 0; s < kSampleCount; ++s) {
        const Vec3 asked = lift[f * kSampleCount + s];
        if (squaredLength(asked) == 0) continue;
        any = true;
        for (int c = 0; c < 3; ++c) {
          Vec3& most = best[faces[f][c]];
          if (kSamples[s][c] > 0 && squaredLength(asked) > squaredLength(most)) most = asked;
        }
      }
    for (NodeIndex k : moving) x[k] += best[k];
    if (!any) break;
  }
  return deepest(cloth, body, x, workers);
}

}  // namespace karinui

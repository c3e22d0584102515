#pragma once
// Settle: from where the cloth stands straight to rest on the body. Deterministic: the same input gives the same bits
// for any number of threads. The report does not flatter.
// Metres, kilograms, seconds. The caller's thread and its workers do the work; it returns when all is done. Cloth that
// does not come to rest is no error but a report with settled = false; errors are input that makes no sense, and
// Cancelled.
#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/body/body.h"
#include "karinui/cloth/cloth.h"

namespace karinui {

// What cloth may not enter. Two kinds: the body's distance field (default) and the historical merged planes.
class Collider {
 public:
  virtual ~Collider() = default;
  struct Contact {
    double distance = 0;  // negative inside
    Vec3 normal;          // unit, out of the body
  };
  virtual Contact contact(Vec3 place) const = 0;  // thread-safe; asked at every step
  // Cheaply, no more than the distance; from place to place it changes by at most kSteepest times the way.
  virtual double clearance(Vec3 place) const = 0;
  static constexpr double kSteepest = 2;
  bool mayTouch(Vec3 place, double within) const { return clearance(place) < within; }
  // The true distance, dearer: asked once at rest, so that nothing rests below the surface itself.
  virtual Contact confirmed(Vec3 place) const { return contact(place); }
  // Which way out, unit, a face lies whose insides a point or side of the body passes through; zero: none does.
  virtual Vec3 passesThrough(const std::array<Vec3, 3>&) const { return {}; }
};
std::unique_ptr<Collider> fieldCollider(BodyPtr body);
struct MergeReport {
  std::size_t facesBefore = 0, planesAfter = 0;
  std::size_t testsDone = 0, testsSaved = 0;  // segment-against-polygon tests so far
};
class MergedPlanes;  // see merged_planes.h

struct StrainReport {
  double mean = 0, p99 = 0, max = 0;  // |l/L - 1| over warp and weft edges of the lattice
};

struct SettleReport {
  bool settled = false;
  Message why;             // why not, or what made it stop
  double residual = 0;     // rms unbalanced force / node weight
  double step = 0;         // largest predicted move left, metres
  double penetration = 0;  // deepest below the collider's surface, metres
  double seamGap = 0;      // widest, metres
  StrainReport strain;
  std::size_t stoppedAfter = 0;  // of the steps below, where it was stopped; 0: it was not. Not kept with a document.
  // Pieces that were not live and would give way now, were they: what they are sewn to pulls otherwise than it did.
  // Told once, not kept with a document.
  std::vector<PieceId> stirred;
  std::size_t steps = 0, solves = 0;
  std::optional<MergeReport> merged;  // where the merged planes were the collider; filled by who made it
  double cpuSeconds = 0, wallSeconds = 0, peakMegabytes = 0;
};

// Looks on while cloth comes to rest: which level, and where each of its nodes stands. Called by the caller's thread
// after every step; what it does is no part of the outcome.
using SettleWatcher = std::function<void(const Cloth&, const std::vector<Vec3>&)>;

// Asks a settle under way to stop where the cloth is. Any thread, also a signal handler; it must outlive the settle.
class StopRequest {
 public:
  // False: nothing was reached yet (the solver has made no step), or it was asked before; then cancel the token.
  bool ask() { return begun_.load() && !asked_.exchange(true); }
  bool asked() const { return asked_.load(); }
  bool askedAfterStep() { return begun_.store(true), asked(); }  // for the solver

 private:
  std::atomic<bool> begun_{false}, asked_{false};
};

struct SettleSettings {
  Vec3 gravity{0, -9.81, 0};
  double stopMove = 0.00015;  // metres a step; eight calm steps in a row
  double stopResidual = 0.4;  // node weights, rms
  int maxSteps = 1600;        // on the finest level; most need some hundred, limp cloth and simcloth many times that
  double skin = 0.0015;       // metres the cloth keeps from the body
  bool clothOnCloth = true;   // whether cloth keeps from passing through cloth
  // A settle that is stopped carries the cloth to the finest level as it is, and reports stoppedAfter. With the same
  // number in stopAfter it stops at the same place, bit for bit.
  std::size_t stopAfter = 0;    // steps, counted over all levels; 0: not before it rests
  StopRequest* stop = nullptr;  // asked after each step; null: nobody stops it
};

// `levels`: the same garment at 4h, 2h, h (coarse first; one level is allowed). The finest level's state is replaced on
// success; a cancelled or refused job leaves it as it was.
struct ClothLevel {
  Cloth cloth;
  ClothState state;  // where it stands at the start
};
Result<SettleReport> settle(std::vector<ClothLevel>& levels, const Collider& body, const SettleSettings& settings,
                            const Token& token, Workers& workers, const SettleWatcher& watcher = {});

// Takes places of the cloth along a path while it drapes; the hand is a patch, not a point.
struct Grip {
  std::vector<std::uint32_t> nodes;  // of the finest level
  std::vector<Vec3> path;            // where the grip's middle goes, first = where it is; straight between
  double seconds = 1.0;              // how long the path takes
  bool letGo = false;                // afterwards free, otherwise held at the end
};
struct PullReport {
  SettleReport end;
  std::vector<Vec3> force;  // newtons the hand feels, one per path point; only beyond natural length
  double maxForce = 0;
};
Result<PullReport> pull(ClothLevel& level, const Collider& body, const Grip& grip, const SettleSettings& settings,
                        const Token& token, Workers& workers);

}  // namespace karinui

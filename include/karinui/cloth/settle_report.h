#pragma once
// What a drape tells of its outcome. Plain values; any thread. Metres, newtons, seconds.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "karinui/base/id.h"
#include "karinui/base/message.h"

namespace karinui {

struct StrainReport {
  double mean = 0, p99 = 0, max = 0;  // |l/L - 1| over warp and weft edges of the lattice
};

struct MergeReport {  // of the merged planes
  std::size_t facesBefore = 0, planesAfter = 0;
  std::size_t testsDone = 0, testsSaved = 0;  // segment-against-polygon tests so far
};

struct ContactTime {
  std::string name;  // of a kind of contact
  double seconds = 0;
};

// How far the place called rest is from where the same solver stands after many more steps, with limits of rest fifty
// times smaller. Metres; the distances are over the nodes that move.
struct Continuation {
  bool settled = false;               // whether those limits were met
  std::size_t steps = 0, solves = 0;  // after rest was called
  double max = 0, p99 = 0, p95 = 0, rms = 0;
};
struct EnergySample {                 // after a step on the finest level, also of the continuation
  std::size_t steps = 0, solves = 0;  // on that level
  double cpuSeconds = 0;              // since the drape began
  double joules = 0;                  // of stretch, shear, bending and height
};

struct SettleReport {
  bool settled = false;
  Message why;             // why not, what made it stop, or where it is caught at rest
  double residual = 0;     // rms unbalanced force / node weight
  double step = 0;         // largest predicted move left, metres
  double penetration = 0;  // deepest below the collider's surface, metres
  double seamGap = 0;      // widest, metres
  StrainReport strain;
  bool finer = false;            // begun anew without the widest cells, by who settled. Not kept with a document.
  bool insideLast = false;       // facings and linings were laid in last. Not kept with a document.
  bool dressed = false;          // garments were put on one after another. Not kept with a document.
  bool throughBody = false;      // given up, as the cloth was sewn up with a limb through it. Not kept with a document.
  bool crossed = false;          // given up, as SettleSettings::giveUpCrossed asked for. Not kept with a document.
  std::size_t stoppedAfter = 0;  // of the steps below, where it was stopped; 0: it was not. Not kept with a document.
  // Pieces that were not live and should be: the force of what they are sewn to has changed by so much that they would
  // move. Told once, not kept with a document.
  std::vector<PieceId> toActivate;
  std::size_t steps = 0, solves = 0;          // `solves`: iterations of the linear solver
  std::size_t fineSteps = 0, fineSolves = 0;  // of these, those on the finest level
  // Where SettleSettings::continueAfterRest asked for them; not kept with a document. Nothing else here counts them.
  std::optional<Continuation> continuation;
  std::vector<EnergySample> energy;
  std::optional<MergeReport> merged;      // where the merged planes were the collider; filled by who made it
  std::vector<ContactTime> contactTimes;  // wall time by kind of contact; told once, not kept with a document
  double cpuSeconds = 0, wallSeconds = 0, peakMegabytes = 0;
};

// For the person: that it did not come to rest and why, or that it rests with threads drawn out to twice their length,
// which something must hold. Nothing where all is well.
std::optional<Message> adviceOn(const SettleReport& report);

}  // namespace karinui

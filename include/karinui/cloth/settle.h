#pragma once
// Settle: moves cloth from where it stands to static equilibrium on its colliders. Deterministic: the same input gives
// the same bits for any number of threads.
// Metres, kilograms, seconds. The caller's thread and its workers do the work; it returns when all is done. Cloth that
// does not come to rest is no error but a report with settled = false; errors are input that makes no sense, and
// Cancelled.
#include <functional>
#include <vector>

#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/cloth/cloth.h"
#include "karinui/cloth/collider.h"
#include "karinui/cloth/settle_report.h"
#include "karinui/cloth/stop_request.h"

namespace karinui {

// Observes cloth while it comes to rest: which level, and where each of its nodes stands. Called by the caller's thread
// after every step; it does not influence the outcome.
using SettleWatcher = std::function<void(const Cloth&, const std::vector<Vec3>&)>;

struct SettleSettings {
  Vec3 gravity{0, -9.81, 0};
  double stopMove = 0.00015;  // metres a step; eight calm steps in a row
  double stopResidual = 0.4;  // node weights, rms
  int maxSteps = 1000;        // on the finest level; most need a hundred, limp cloth and simcloth many times that
  double skin = 0.0015;       // metres the cloth keeps from colliders
  bool clothOnCloth = true;   // whether cloth keeps from passing through cloth
  // Tight cloth: the seams of what has yet to be sewn are closed on colliders thinner by so many metres, which then
  // come out under it; without friction, as other seams are closed, tight cloth would slip off. 0: on the whole ones.
  double sewnThinnerBy = 0;
  // Whether the cloth was at rest before it was changed here and there: it mostly rests again within a few short steps.
  bool rested = false;
  // For garments that are draped together and may be draped one after another instead. The first is given up, and
  // reports `crossed`, where a coarse level leaves cloth through cloth. The second begins on the coarsest level even if
  // most of the cloth stands formed and sewn: what is new is to be sewn up about the rest.
  bool giveUpCrossed = false, fromCoarsest = false;
  // For a drape that may be done once more without its coarsest level: given up, and reports `throughBody`, where a
  // coarse level leaves a limb through the cloth, even if it rests so.
  bool giveUpThroughBody = false;
  // A settle that is stopped carries the cloth to the finest level as it is, and reports stoppedAfter. With the same
  // number in stopAfter it stops at the same place, bit for bit.
  std::size_t stopAfter = 0;    // steps, counted over all levels; 0: not before it rests
  StopRequest* stop = nullptr;  // asked after each step; null: nobody stops it
  // Measures rest itself: goes on from it for five times as many steps, at least 500, and reports how far that leads.
  // The outcome is where rest was called, the same bits as without.
  bool continueAfterRest = false;
};

// `levels`: the same garment at 4h, 2h, h (coarse first; one level is allowed). The finest level's state is replaced on
// success; a cancelled or refused job leaves it as it was.
struct ClothLevel {
  Cloth cloth;
  ClothState state;  // where it stands at the start
};
Result<SettleReport> settle(std::vector<ClothLevel>& levels, const ColliderList& colliders,
                            const SettleSettings& settings, const Token& token, Workers& workers,
                            const SettleWatcher& watcher = {});

}  // namespace karinui

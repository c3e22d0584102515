#include "karinui/cloth/follow.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cloth/detail_transfer.h"
#include "cloth/finish.h"
#include "cloth/flat_folds.h"
#include "cloth/input_check.h"
#include "cloth/penetration.h"
#include "cloth/pose_way.h"
#include "cloth/skin_carrying.h"
#include "cloth/skin_collider.h"
#include "cloth/strain.h"
#include "cloth/work_blocks.h"

namespace karinui {
namespace {

constexpr double kDeep = 0.0003;  // metres under the skin: cloth that is carried or stepped deeper
constexpr double kClear = 0.95;   // is put so far out of it, in skin offsets,
constexpr int kOutRounds = 4;     // in so many tries at most
// A step: long, so that inertia does not hold back what has to slide after the body, and of two iterations, so that
// threads do not strain to second order. With 1/30 s and one, the sleeves of a buttoned shirt ran ahead of it: arms
// overhead it was stretched by 55 % (99 % of it by less) and its cuffs went through the forearms.
constexpr double kSeconds = 0.1;
constexpr int kNewton = 2;
// Wider cells do not go a way for a level where more than such a share of them cross each other to begin with, as the
// layers of a lined waistcoat do, each of whose folds is some cells wide: they would lie in another order.
constexpr double kFewCross = 0.05;
// Steps of the level afterwards: so many even out its detail, and up to so many part what crosses. What a few have not
// parted may be knots, which are smoothed; where that leaves more crossings they are of layers, as of a pocket and its
// front, which did not part in forty steps.
constexpr int kLeastSteps = 3, kMostSteps = 15, kStepsToKnots = 5;
constexpr std::size_t kCrossingsLeft = 30;
constexpr double kCaughtInFold = 2.5;  // times its length that a thread is drawn out: cloth that is caught in a fold

// Lengthens the moves of what would stand deep in the skin, to be clear of it; whether any did. Cloth that presses on
// the skin stays as it lies: put clear of it in each part, a tight cuff was held by nothing and slid up the forearm.
bool keepOutOfSkin(const std::vector<Vec3>& x, std::vector<Vec3>& moves, const SkinCollider& skin, Workers& workers) {
  const double clear = kClear * SettleSettings().skin;
  bool any = false;
  for (const bool here : workers.each(moves.size(), kNodeBlock, [&](std::size_t begin, std::size_t end) {
         bool some = false;
         for (std::size_t k = begin; k < end; ++k)
           for (int round = 0; round < kOutRounds; ++round) {
             const Collider::Sample sample = skin.sample(x[k] + moves[k]);
             if (!(sample.distance < (round == 0 ? -kDeep : clear))) break;
             moves[k] += sample.normal * (clear - sample.distance);
             some = true;
           }
         return some;
       }))
    any = any || here;
  return any;
}

// A level on its way on a skin that moves.
class LevelOnSkin {
 public:
  LevelOnSkin(const Cloth& cloth, std::vector<Vec3> x, const SkinCollider& skin, Workers& workers)
      : skin_(skin),
        workers_(workers),
        solver_(cloth, std::move(x), skin, settings_, clothRadius(cloth, cloth.spacing), workers) {
    solver_.tieWithin(cloth.spacing);
    options_.seconds = kSeconds;
    options_.newton = kNewton;
    options_.velocityKept = 0;
    options_.mostMove = 0.5 * cloth.spacing;
    options_.gravity = settings_.gravity;
    options_.stopping = {40, 100, 0.1};
  }
  const std::vector<Vec3>& places() const { return solver_.positions(); }

  // As far as the collision filter allows, and out of the skin.
  void move(std::vector<Vec3> moves) {
    keepOutOfSkin(places(), moves, skin_, workers_);
    solver_.moveFiltered(std::move(moves));
  }
  // A step, after which what it left in the skin is put out of it: a fold that closes presses cloth into either side.
  // False: the cloth is torn.
  bool step(const Token& token) {
    if (!solver_.step(options_, token).finite) return false;
    leaveSkin();
    return true;
  }
  void leaveSkin() {
    std::vector<Vec3> moves(places().size());
    if (keepOutOfSkin(places(), moves, skin_, workers_)) solver_.moveFiltered(std::move(moves));
  }
  std::size_t crossings() { return solver_.intersections(); }
  // Whether it crosses itself at fewer places with its knots smoothed; else it stays as it is, for layers that pass
  // through each other have none.
  bool smoothKnots() {
    const std::size_t before = crossings();
    std::vector<Vec3> knotted = places();
    solver_.setPositions(withKnotsSmoothed(solver_.cloth(), knotted, workers_));
    leaveSkin();
    if (crossings() < before) return true;
    solver_.setPositions(std::move(knotted));
    return false;
  }
  // Whether it crosses itself; it is separated in the steps that follow.
  bool crosses() { return solver_.separateIntersections(); }
  std::vector<Vec3> finished() {
    solver_.separateIntersections();
    liftOffColliders(solver_, skin_, std::min(kDeep, 0.3 * settings_.skin), workers_);
    return places();
  }

 private:
  const SettleSettings settings_;
  const SkinCollider& skin_;
  Workers& workers_;
  LevelSolver solver_;
  LevelSolver::StepOptions options_;
};

// A way of the body, with its skin.
struct BodyOnWay {
  BodyOnWay(const Skeleton& skeleton, const BodyPose& from, const BodyPose& to, Workers& workers)
      : body(*skeleton.body()), way(skeleton, from, to), skin(body.mesh().faces, way.points().size()) {
    skin.moveTo(way.points(), workers);
  }
  const Body& body;
  PoseWay way;
  SkinCollider skin;
};

// Told after each part of a way where the nodes are; false: the way is given up there.
using OnPart = std::function<bool(const std::vector<Vec3>& places)>;

// All of the way, or until it is given up.
Result<FollowReport> goAlong(BodyOnWay& going, LevelOnSkin& level, const Cloth& cloth, const Token& token,
                             Workers& workers, const OnPart& onPart) {
  PoseWay& way = going.way;
  SkinCarrying carrying(cloth, level.places(), holdsOf(level.places(), going.body, way.points()), way.placements(),
                        way.lastPlacements());
  FollowReport report;
  while (way.share() < 1) {
    const std::vector<Rigid> before = way.placements();
    way.goOn(level.places(), cloth.spacing);
    std::vector<Vec3> moves = carrying.moves(level.places(), before, way.placements(), workers);
    going.skin.moveTo(way.points(), workers);
    level.move(std::move(moves));
    const bool whole = level.step(token);
    if (token.cancelled()) return cancelled();
    if (!whole) return tornApart();
    ++report.parts;
    if (!onPart(level.places())) break;
  }
  return report;
}

// Tells of a way, and does not go back on it where it is gone anew.
class WayTold {
 public:
  WayTold(const FollowWatcher& watcher, const Token& token) : watcher_(watcher), token_(token) {}
  // Whether a picture of this part is asked for.
  bool reached(double share) {
    if (share <= share_) return false;
    token_.progress(share_ = share, say("Moving the figure"));
    return static_cast<bool>(watcher_);
  }
  void show(const BodyOnWay& going, const Cloth& cloth, const std::vector<Vec3>& places) const {
    watcher_({share_, going.way.pose(), going.skin.points(), cloth, places});
  }

 private:
  const FollowWatcher& watcher_;
  const Token& token_;
  double share_ = 0;
};

// The level goes where wider cells have gone; nothing, where they are caught or the level would cross itself there.
Result<std::optional<FollowReport>> followWider(ClothLevel& level, const Cloth& wider, BodyOnWay& going,
                                                const Token& token, Workers& workers, WayTold& told) {
  DetailTransfer detail(level.cloth, level.state.position, wider);
  LevelOnSkin wide(wider, detail.start(), going.skin, workers);
  if (static_cast<double>(wide.crossings()) > kFewCross * wider.nodeCount) return std::optional<FollowReport>();
  bool caught = false;
  const auto gone = goAlong(going, wide, wider, token, workers, [&](const std::vector<Vec3>& x) {
    caught = mostDrawnOut(wider, x).times > kCaughtInFold;
    if (caught) return false;
    std::vector<Vec3> places = detail.at(x, workers);
    if (told.reached(going.way.share())) {
      std::vector<Vec3> out(places.size());
      keepOutOfSkin(places, out, going.skin, workers);
      for (std::size_t k = 0; k < places.size(); ++k) places[k] += out[k];
      told.show(going, level.cloth, places);
    }
    return true;
  });
  if (!gone && token.cancelled()) return gone.error();
  if (!gone || caught) return std::optional<FollowReport>();

  going.skin.buildTree();
  LevelOnSkin fine(level.cloth, withFlatFolds(detail, level.cloth, wider, wide.places(), workers), going.skin, workers);
  fine.leaveSkin();
  bool crosses = fine.crosses();
  for (int k = 1; k <= kLeastSteps || (crosses && k <= kMostSteps); ++k) {
    const bool whole = fine.step(token);
    if (token.cancelled()) return cancelled();
    if (!whole) return std::optional<FollowReport>();
    if (crosses) crosses = fine.crossings() > 0;
    if (!crosses || k % kStepsToKnots != 0) continue;
    if (fine.smoothKnots()) crosses = fine.crosses();
    if (fine.crossings() > kCrossingsLeft) return std::optional<FollowReport>();
  }
  if (crosses || mostDrawnOut(level.cloth, fine.places()).times > kCaughtInFold) return std::optional<FollowReport>();
  level.state.position = fine.finished();
  return std::optional(*gone);
}

}  // namespace

Result<FollowReport> follow(ClothLevel& level, const Cloth* wider, const Skeleton& skeleton, const BodyPose& from,
                            const BodyPose& to, const Token& token, Workers& workers, const FollowWatcher& watcher) {
  if (const auto fine = checkLevel(level); !fine) return fine.error();
  WayTold told(watcher, token);
  if (wider) {
    BodyOnWay going(skeleton, from, to, workers);
    const auto report = followWider(level, *wider, going, token, workers, told);
    if (!report) return report.error();
    if (*report) return **report;
  }
  BodyOnWay going(skeleton, from, to, workers);
  LevelOnSkin whole(level.cloth, level.state.position, going.skin, workers);
  const auto report = goAlong(going, whole, level.cloth, token, workers, [&](const std::vector<Vec3>& places) {
    if (told.reached(going.way.share())) told.show(going, level.cloth, places);
    return true;
  });
  if (!report) return report.error();
  going.skin.buildTree();
  level.state.position = whole.finished();
  return *report;
}

std::vector<Rigid> carriedBySkin(const std::vector<Vec3>& places, const Skeleton& skeleton, const BodyPose& from,
                                 const BodyPose& to) {
  const std::vector<Rigid> before = skeleton.placements(from), now = skeleton.placements(to);
  const std::vector<SkinHold> holds = holdsOf(places, *skeleton.body(), skeleton.points(before));
  std::vector<Rigid> out(places.size());
  for (std::size_t k = 0; k < places.size(); ++k)
    if (holds[k].point != kNoNode) out[k] = karinui::after(now[holds[k].point], inverseOf(before[holds[k].point]));
  return out;
}

}  // namespace karinui

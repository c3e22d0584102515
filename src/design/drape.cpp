#include "karinui/design/drape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "karinui/base/number.h"
#include "karinui/check/check.h"
#include "karinui/cloth/floor.h"
#include "karinui/cloth/follow.h"
#include "karinui/cloth/gather_waves.h"
#include "karinui/cloth/girth_check.h"
#include "karinui/cloth/lay_between.h"
#include "karinui/cloth/live_hand.h"
#include "karinui/cloth/merged_planes.h"
#include "karinui/pattern/elastic_lines.h"
#include "karinui/pattern/pleats.h"

namespace karinui {

namespace {

struct Levels {
  std::vector<ClothLevel> coarseFirst;
  ClothLevel& finest() { return coarseFirst.back(); }
};

Result<ClothLevel> levelAt(const Document& document, const std::set<PieceId>& live, double spacing) {
  const Pattern pattern =
      withElasticLines(withZips(document.pattern, document.allowances.fastenings), document.allowances);
  const Result<LaidPattern> laid = lay(pattern, spacing);
  if (!laid) return laid.error();
  const auto fabrics = fabricsInUse(document);
  if (!fabrics) return fabrics.error();
  ClothChoice choice;
  for (const auto& [id, piece] : document.pattern.pieces) choice.live[id] = live.contains(id);
  choice.pins = document.pins;
  choice.finish = &document.allowances;
  Result<Cloth> cloth = assemble(pattern, *laid, *fabrics, choice);
  if (!cloth) return cloth.error();
  ClothState state = standing(document.pattern, *cloth);
  return ClothLevel{std::move(*cloth), std::move(state)};
}

constexpr double kWidest = 4;       // times the document's spacing: the cells of the first level
constexpr double kCoarsest = 0.09;  // metres: cloth of wider cells does not know an arm from a shoulder

// 4, 2 and 1 times the document's spacing; a level that some piece is too small for, or that is too coarse for a body,
// is left out, and with `finer` the widest. Wide cells do not know the layers of a pleat, nor the waves of a gather,
// from each other: cloth that stands folded has the finest level alone.
Result<Levels> levelsOf(const Document& document, const std::set<PieceId>& live, bool finer) {
  Levels levels;
  Result<ClothLevel> finest = levelAt(document, live, document.settings.spacing);
  if (!finest) return finest.error();
  if (layGathersInWaves(finest->cloth, finest->state.position)) finest->cloth.pleated = true;
  layBetween(finest->cloth, finest->state.position);
  const bool pleated = finest->cloth.pleated || !pleatsOf(document.pattern).empty();
  for (const double times : {kWidest, kWidest / 2}) {
    if (pleated || times * document.settings.spacing > kCoarsest) continue;
    if (Result<ClothLevel> level = levelAt(document, live, times * document.settings.spacing)) {
      levels.coarseFirst.push_back(std::move(*level));
    }
  }
  if (finer && !levels.coarseFirst.empty()) levels.coarseFirst.erase(levels.coarseFirst.begin());
  levels.coarseFirst.push_back(std::move(*finest));
  return levels;
}

// Without two coarse levels none would be left to notice a limb through the cloth.
bool hasWidestCells(const Document& document) { return kWidest * document.settings.spacing <= kCoarsest; }

// The floor a figure stands on, in its own pose; a mesh without feet, as of a trunk alone, stands on none.
std::optional<double> floorOf(const Body& body, const Document& document) {
  if (!document.body.mesh.empty() && !body.landmarks().contains("ankle_left")) return std::nullopt;
  double lowest = 0;
  for (const Vec3& p : body.own().mesh().points) lowest = std::min(lowest, p.y);
  return lowest;
}

// What stops the cloth: the figure, and the floor it stands on.
struct Surroundings {
  std::unique_ptr<Collider> body;
  std::optional<double> floorHeight;
  std::unique_ptr<Collider> floor = floorHeight ? floorCollider(*floorHeight) : nullptr;
  ColliderList list() const {
    ColliderList all(*body);
    if (floor) all.add(*floor);
    return all;
  }
};

Result<Surroundings> surroundingsOf(const Document& document, Context& context) {
  Result<BodyPtr> body = bodyOf(document, context);
  if (!body) return body.error();
  if (document.settings.collider == Settings::Collider::Planes)
    return Surroundings{std::make_unique<MergedPlanes>(*body), floorOf(**body, document)};
  return Surroundings{fieldCollider(*body), floorOf(**body, document)};
}

// What merging the body's faces saved, for the historical collider.
SettleReport told(SettleReport report, const Collider& collider) {
  if (const auto* planes = dynamic_cast<const MergedPlanes*>(&collider)) report.merged = planes->report();
  return report;
}

std::map<PieceId, std::shared_ptr<const Form>> formsLeft(const Cloth& cloth, const ClothState& state) {
  std::map<PieceId, std::shared_ptr<const Form>> forms;
  for (std::size_t i = 0; i < cloth.pieces.size(); ++i) {
    const ClothPiece& piece = cloth.pieces[i];
    if (piece.live) forms[piece.id] = formOf(cloth, state, i);
  }
  return forms;
}

Message centimetres(double metres) { return say("{0} cm", fixed(100 * metres, 0)); }

// The name of a level of the trunk, where one is near.
Message levelSaid(double height, const Body& body) {
  constexpr double kNear = 0.04;  // metres
  const std::array<std::pair<const char*, Message>, 4> levels{{{"hip_height", say("at the hip")},
                                                               {"waist_height", say("at the waist")},
                                                               {"under_bust_height", say("under the bust")},
                                                               {"bust_height", say("at the bust")}}};
  for (const auto& [key, name] : levels)
    if (const auto at = body.measured().value.find(key);
        at != body.measured().value.end() && std::fabs(at->second - height) < kNear)
      return name;
  return say("{0} above the floor", centimetres(height));
}
Message tooSmallSaid(const GirthLoop& loop, const Body& body) {
  return say(
      "Too small by {0} {1}: it is {2} round and can be stretched to {3}, the body is {4}. Add width there, choose a "
      "cloth that stretches more, or leave a seam open.",
      centimetres(loop.shortage()), levelSaid(loop.height, body), centimetres(loop.garment),
      centimetres(loop.stretched), centimetres(loop.body));
}

// How much thinner a body must be for tight cloth to be sewn up round it slack, and a centimetre more. Deep inside, the
// body's distance is not known exactly.
double sewnThinnerBy(const GirthLoop& loop) {
  constexpr double kSlack = 0.01, kMost = 0.05;  // metres
  return std::fmin(kMost, (loop.body - loop.garment) / (2 * std::numbers::pi) + kSlack);
}

// The cloth is left where it stands.
DrapeOutcome notDraped(const ClothLevel& level, Message why) {
  const ClothCheck stands = check(level.cloth, level.state, nullptr);
  SettleReport report;
  report.why = std::move(why);
  report.seamGap = stands.seamGap;
  report.strain = stands.strain;
  return {formsLeft(level.cloth, level.state), std::move(report), {}};
}

// The nodes of a piece within `radius` of a paper place; at least the nearest one.
std::vector<std::uint32_t> patchAround(const Cloth& cloth, PieceId id, Flat place, double radius) {
  std::vector<std::uint32_t> patch;
  const auto piece = std::find_if(cloth.pieces.begin(), cloth.pieces.end(), [&](const auto& p) { return p.id == id; });
  KARINUI_ASSERT(piece != cloth.pieces.end());
  const std::vector<Flat>& nodes = piece->lattice->nodes;
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (distance(nodes[i], place) < distance(nodes[nearest], place)) nearest = i;
    if (distance(nodes[i], place) <= radius) patch.push_back(piece->firstNode + i);
  }
  if (patch.empty()) patch.push_back(piece->firstNode + nearest);
  return patch;
}

// A hand about to pull: what stops the cloth, the cloth, what the fingers hold and where its middle is.
struct Hold {
  Surroundings around;
  ClothLevel level;
  Grip grip;
  Vec3 middle;
};
Result<Hold> holdOf(const Document& document, const PullCloth& pull, Context& context) {
  auto around = surroundingsOf(document, context);
  if (!around) return around.error();
  const std::set<PieceId> live =
      pull.live.empty() ? hangTogether(document, pull.piece.id) : livePieces(document, pull.live);
  Result<ClothLevel> level = levelAt(document, live, document.settings.spacing);
  if (!level) return level.error();
  Hold hold{*std::move(around), *std::move(level), {}, {}};
  hold.grip.nodes = patchAround(hold.level.cloth, pull.piece.id, pull.at, pull.patch);
  for (const std::uint32_t node : hold.grip.nodes) hold.middle += hold.level.state.position[node];
  hold.middle *= 1.0 / static_cast<double>(hold.grip.nodes.size());
  return hold;
}

}  // namespace

std::optional<Shortage> shortageTold(const Message& why) {
  if (!why.pattern.starts_with("Too small by {0} {1}") || why.values.size() < 2) return std::nullopt;  // tooSmallSaid
  const auto* by = std::get_if<Message>(&why.values[0]);
  const auto* where = std::get_if<Message>(&why.values[1]);
  const auto metres = by && !by->values.empty() ? parseNumber(text(by->values[0])) : std::nullopt;
  return metres && where ? std::optional(Shortage{*metres / 100, *where}) : std::nullopt;
}

std::set<PieceId> livePieces(const Document& document, const std::vector<PieceRef>& named) {
  std::set<PieceId> live;
  for (const auto& [id, piece] : document.pattern.pieces) {
    if (named.empty() && !piece->frozen) live.insert(id);
  }
  for (const PieceRef& piece : named) live.insert(piece.id);
  return live;
}

std::set<PieceId> hangTogether(const Document& document, PieceId piece) {
  std::set<PieceId> together{piece};
  const auto joins = [&](const auto& sewn) {
    std::set<PieceId> all;
    for (const auto* side : {&sewn.a, &sewn.b})
      for (const EdgeSpan& span : *side)
        if (const Piece* one = document.find(span.piece); one && !one->frozen) all.insert(span.piece);
    const bool meets = std::any_of(all.begin(), all.end(), [&](PieceId id) { return together.contains(id); });
    const std::size_t before = together.size();
    if (meets) together.insert(all.begin(), all.end());
    return together.size() > before;
  };
  for (bool grew = true; grew;) {
    grew = false;
    for (const auto& [id, seam] : document.pattern.seams) grew = joins(seam) || grew;
    for (const auto& [name, fastening] : document.allowances.fastenings) grew = joins(fastening) || grew;
  }
  return together;
}

Result<Standing> standingCloth(const Document& document, const std::set<PieceId>& live) {
  Result<ClothLevel> level = levelAt(document, live, document.settings.spacing);
  if (!level) return level.error();
  return Standing{std::move(level->cloth), std::move(level->state)};
}

namespace {

Result<DrapeOutcome> drapedOnce(const Document& document, const DrapePieces& drape, Context& context,
                                const DrapeOnlooker& onlooker, bool continueAfterRest) {
  const auto around = surroundingsOf(document, context);
  if (!around) return around.error();
  Result<Levels> levels = levelsOf(document, livePieces(document, drape.live), drape.finer);
  if (!levels) return levels.error();
  const Result<BodyPtr> body = bodyOf(document, context);
  if (!body) return body.error();
  ClothLevel& coarsest = levels->coarseFirst.front();
  if (around->floorHeight) layOnFloor(coarsest.cloth, coarsest.state, *around->floorHeight);
  // Its levels are those of a person who stands: in another pose what was closed on the body stays closed on it.
  const std::optional<GirthLoop> loop =
      (*body)->pose().empty() ? tightestLoop(coarsest.cloth, coarsest.state, **body) : std::nullopt;
  if (loop && loop->shortage() > 0) return notDraped(levels->finest(), tooSmallSaid(*loop, **body));
  SettleSettings settings;
  settings.gravity = drape.gravity;
  settings.stopAfter = static_cast<std::size_t>(drape.stop);
  settings.stop = context.stop;
  settings.rested = document.drape.last && document.drape.last->settled && document.drape.force.empty();  // not pulled
  if (loop && loop->tight()) settings.sewnThinnerBy = sewnThinnerBy(*loop);
  settings.continueAfterRest = continueAfterRest;
  settings.giveUpCrossed = context.giveUpCrossed;
  settings.giveUpThroughBody = context.giveUpThroughBody && hasWidestCells(document);
  settings.fromCoarsest = context.fromCoarsest;
  SettleWatcher watcher;
  if (onlooker)
    watcher = [&](const Cloth& cloth, const std::vector<Vec3>& places) {
      onlooker([&] { return formsLeft(cloth, {places}); });
    };
  const Result<SettleReport> report =
      settle(levels->coarseFirst, around->list(), settings, context.token, context.workers, watcher);
  if (!report) return report.error();
  return DrapeOutcome{formsLeft(levels->finest().cloth, levels->finest().state), told(*report, *around->body), {}};
}

}  // namespace

bool finerMayHelp(const Document& document, const SettleReport& report) {
  return !report.settled && report.throughBody && hasWidestCells(document);
}

Result<DrapeOutcome> drapeOnBody(const Document& document, const DrapePieces& drape, Context& context,
                                 const DrapeOnlooker& onlooker, bool continueAfterRest) {
  // A record says itself whether it began anew.
  const bool newly = !context.recorded && !drape.finer && drape.stop == 0;
  Context first = context;
  first.giveUpThroughBody = context.giveUpThroughBody || newly;
  auto outcome = drapedOnce(document, drape, first, onlooker, continueAfterRest);
  if (!outcome || !newly || !finerMayHelp(document, outcome->report)) return outcome;
  DrapePieces again = drape;
  again.finer = true;
  auto finer = drapedOnce(document, again, context, onlooker, continueAfterRest);
  if (!finer) return finer.error();
  if (!finer->report.settled) return drapedOnce(document, drape, context, onlooker, continueAfterRest);
  finer->report.finer = true;
  finer->report.cpuSeconds += outcome->report.cpuSeconds, finer->report.wallSeconds += outcome->report.wallSeconds;
  return finer;
}

Result<DrapeOutcome> pullOnBody(const Document& document, const PullCloth& pull, Context& context) {
  auto hold = holdOf(document, pull, context);
  if (!hold) return hold.error();
  auto& [around, level, grip, middle] = *hold;
  grip.path = {middle};
  for (const Vec3& step : pull.by) grip.path.push_back(middle + step);
  grip.seconds = pull.seconds;
  grip.letGo = pull.letGo;
  Result<PullReport> report = karinui::pull(level, around.list(), grip, {}, context.token, context.workers);
  if (!report) return report.error();
  return DrapeOutcome{formsLeft(level.cloth, level.state), told(report->end, *around.body), std::move(report->force)};
}

namespace {

// The whole garment as cloth where it stands, its cells so many times as wide. Pins go with the cloth, and frozen cloth
// with the body.
Result<ClothLevel> carriedCloth(const Document& document, double times = 1) {
  Document unpinned = document;
  unpinned.pins.clear();
  std::set<PieceId> all;
  for (const auto& [id, piece] : document.pattern.pieces) all.insert(id);
  return levelAt(unpinned, all, times * document.settings.spacing);
}

// Wider cells that can go a way in place of the garment's own, if there are any.
std::optional<ClothLevel> widerCells(const Document& document) {
  constexpr double kTimes = 2;
  if (!pleatsOf(document.pattern).empty() || kTimes * document.settings.spacing > kCoarsest) return std::nullopt;
  Result<ClothLevel> level = carriedCloth(document, kTimes);
  return level ? std::optional(*std::move(level)) : std::nullopt;
}

Vec3 middleOf(const ClothPiece& piece, const std::vector<Vec3>& places) {
  Vec3 middle;
  const std::size_t count = piece.lattice->nodes.size();
  for (std::size_t k = 0; k < count; ++k) middle += places[piece.firstNode + k] * (1 / static_cast<double>(count));
  return middle;
}

}  // namespace

Result<std::map<PieceId, std::shared_ptr<const Form>>> carriedByBody(const Document& document, const Skeleton& skeleton,
                                                                     const BodyPose& to, Context& context,
                                                                     const PoseOnlooker& onlooker) {
  std::map<PieceId, std::shared_ptr<const Form>> forms;
  if (document.pattern.pieces.empty()) return forms;
  Result<ClothLevel> level = carriedCloth(document);
  if (!level) return level.error();
  if (!document.drape.last) {
    std::vector<Vec3>& x = level->state.position;
    for (const ClothPiece& piece : level->cloth.pieces) {
      const auto first = x.begin() + piece.firstNode, last = first + piece.lattice->nodes.size();
      const Rigid way = carriedBySkin({middleOf(piece, x)}, skeleton, document.body.pose, to).front();
      std::transform(first, last, first, way);
    }
  } else {
    FollowWatcher watcher;
    if (onlooker)
      watcher = [&](const FollowedPart& part) {
        onlooker({part.share, part.pose, part.skin, [&] { return formsLeft(part.cloth, {part.places}); }});
      };
    const std::optional<ClothLevel> wider = widerCells(document);
    const auto report = follow(*level, wider ? &wider->cloth : nullptr, skeleton, document.body.pose, to, context.token,
                               context.workers, watcher);
    if (!report) return report.error();
  }
  return formsLeft(level->cloth, level->state);
}

Result<AlongWithSkin> AlongWithSkin::of(const Document& document, const Body& body) {
  constexpr double kNearest = 0.3;  // metres: what is farther from the skin is not carried
  AlongWithSkin along;
  if (document.pattern.pieces.empty()) return along;
  Result<ClothLevel> level = carriedCloth(document);
  if (!level) return level.error();
  along.cloth_ = std::move(level->cloth);
  along.places_ = std::move(level->state.position);
  along.point_.assign(along.places_.size(), kNoNode);
  const auto nearest = [&](Vec3 place) {
    const auto near = body.bvh().nearest(place, kNearest);
    if (!near) return kNoNode;
    const auto& w = near->place.weight;
    return body.mesh().faces[near->place.face][w[0] >= w[1] && w[0] >= w[2] ? 0 : w[1] >= w[2] ? 1 : 2];
  };
  for (const ClothPiece& piece : along.cloth_.pieces) {
    const bool whole = !document.drape.last;
    const std::uint32_t one = whole ? nearest(middleOf(piece, along.places_)) : kNoNode;
    for (std::size_t k = piece.firstNode; k < piece.firstNode + piece.lattice->nodes.size(); ++k)
      along.point_[k] = whole ? one : nearest(along.places_[k]);
  }
  return along;
}

std::map<PieceId, std::shared_ptr<const Form>> AlongWithSkin::at(const std::vector<Rigid>& moved) const {
  ClothState state{places_};
  for (std::size_t k = 0; k < places_.size(); ++k)
    if (point_[k] != kNoNode) state.position[k] = moved[point_[k]](places_[k]);
  return formsLeft(cloth_, state);
}

struct LivePull::Inside {
  Surroundings around;
  Vec3 middle;  // where it took hold
  LiveHand hand;
};
LivePull::LivePull() = default;
LivePull::LivePull(LivePull&&) noexcept = default;
LivePull::~LivePull() = default;

Result<LivePull> LivePull::take(const Document& document, const PullCloth& pull, Context& context) {
  auto hold = holdOf(document, pull, context);
  if (!hold) return hold.error();
  Grip& grip = hold->grip;
  grip.path = {hold->middle};
  auto hand = LiveHand::take(std::move(hold->level), hold->around.list(), grip, {}, context.workers);
  if (!hand) return hand.error();
  LivePull live;
  live.inside_ = std::make_unique<Inside>(Inside{std::move(hold->around), hold->middle, *std::move(hand)});
  return live;
}

Result<Vec3> LivePull::to(Vec3 by, Context& context) { return inside_->hand.to(inside_->middle + by, context.token); }

std::map<PieceId, std::shared_ptr<const Form>> LivePull::forms() const {
  return formsLeft(inside_->hand.cloth(), {inside_->hand.places()});
}

Result<Examination> examined(const Document& document, Context& context) {
  const auto standing = standingCloth(document, livePieces(document, {}));
  if (!standing) return standing.error();
  BodyPtr body;
  if (document.body.chosen()) {
    auto built = bodyOf(document, context);
    if (!built) return built.error();
    body = *std::move(built);
  }
  Examination found{check(standing->cloth, standing->state, body.get()), {}, {}};
  if (!found.finite) return found;
  found.elastics = elasticPulls(standing->cloth, standing->state);
  found.fastenings = fasteningPulls(standing->cloth, standing->state);
  return found;
}

}  // namespace karinui

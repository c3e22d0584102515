#include "design/operations/dressing.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <set>
#include <utility>

#include "design/operations/inside_last.h"
#include "design/operations/stood_off.h"
#include "karinui/pattern/facing.h"

namespace karinui {

namespace {

struct Stage {
  std::set<PieceId> pieces;  // those that are added
  bool inside = false;       // facings and linings, to be laid into what hangs
};

// What hangs together by seams and fastenings, the lowest layer first, then as it was made.
std::vector<std::set<PieceId>> garmentsOf(const Document& document, std::set<PieceId> live) {
  std::vector<std::pair<int, std::set<PieceId>>> garments;
  while (!live.empty()) {
    std::set<PieceId> own;
    int layer = document.find(*live.begin())->layer;
    for (const PieceId id : hangTogether(document, *live.begin()))
      if (live.erase(id) > 0) own.insert(id), layer = std::min(layer, document.find(id)->layer);
    garments.emplace_back(layer, std::move(own));
  }
  std::stable_sort(garments.begin(), garments.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::set<PieceId>> ordered;
  for (auto& [layer, own] : garments) ordered.push_back(std::move(own));
  return ordered;
}

std::vector<Stage> stagesOf(const Document& before, const DrapePieces& op) {
  const std::set<PieceId> live = livePieces(before, op.live);
  const std::set<PieceId> insideOut = op.insideLast ? laidWithin(before.pattern) : std::set<PieceId>();
  std::vector<Stage> stages;
  for (std::set<PieceId>& garment : op.dressed ? garmentsOf(before, live) : std::vector{live}) {
    Stage inside{{}, true};
    for (const PieceId id : garment)
      if (insideOut.contains(id)) inside.pieces.insert(id);
    if (inside.pieces.size() == garment.size()) inside.pieces.clear();
    for (const PieceId id : inside.pieces) garment.erase(id);
    stages.push_back({std::move(garment), false});
    if (!inside.pieces.empty()) stages.push_back(std::move(inside));
  }
  return stages;
}

// How far a drape in stages is by the number of points that are draped in each.
std::vector<double> sharesOf(const Document& document, const std::vector<Stage>& stages) {
  std::vector<double> until;
  double worn = 0, sum = 0;
  for (const Stage& stage : stages) {
    for (const PieceId id : stage.pieces) worn += document.find(id)->outline.area();
    until.push_back(sum += worn);
  }
  for (double& share : until) share /= sum;
  return until;
}

void add(SettleReport& sum, const SettleReport& stage) {
  sum.steps += stage.steps, sum.solves += stage.solves;
  sum.fineSteps += stage.fineSteps, sum.fineSolves += stage.fineSolves;
}

Result<DrapeOutcome> drapedNow(const Document& document, const DrapePieces& op, Context& context) {
  return context.drape ? context.drape(document, op, context) : drapeOnBody(document, op, context);
}

// Nothing where that does not go: a garment is too small, or what is to be laid in does not lie by the rest.
// `finerIfThrough`: once more without the widest cells, where these sew something up with a limb through it.
std::optional<Result<DrapeOutcome>> inStages(const Document& before, const DrapePieces& op,
                                             const std::vector<Stage>& stages, Context& context, bool finerIfThrough) {
  const auto body = bodyOf(before, context);
  if (!body) return body.error();
  const std::vector<double> until = sharesOf(before, stages);
  Document now = before;  // all of it, as far as it hangs
  std::set<PieceId> worn, waiting = livePieces(before, op.live);
  SettleReport sum;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const Stage& stage = stages[k];
    const bool last = k + 1 == stages.size(), beforeInside = !last && stages[k + 1].inside;
    if (!stage.inside) now = stoodOff(std::move(now), stage.pieces, worn, **body);
    for (const PieceId id : stage.pieces) worn.insert(id), waiting.erase(id);
    DrapePieces own = op;
    std::erase_if(own.live, [&](const PieceRef& ref) { return waiting.contains(ref.id); });
    own.finer = op.finer && !stage.inside;
    if (op.stop > 0) own.stop = std::max(1, op.stop - static_cast<int>(sum.steps));
    RemovePieces without;
    for (const PieceId id : waiting) without.pieces.emplace_back(id);
    without.seams = Choice::Yes;
    const Result<Document> part = perform(now, without, context);
    if (!part) return part.error();
    const Token token(context.token, k > 0 ? until[k - 1] : 0, until[k]);
    Context staged{context.workers, token,        context.blobs,  context.bodies,
                   context.drape,   context.pull, context.advise, context.stop};
    staged.recorded = true;  // whether cells are finer is decided for all stages together
    staged.giveUpCrossed = context.giveUpCrossed && k == 0;
    staged.giveUpThroughBody = finerIfThrough;
    staged.fromCoarsest = k > 0 && !stage.inside;
    auto outcome = drapedNow(*part, own, staged);
    if (!outcome) return outcome;
    SettleReport& report = outcome->report;
    const bool stopped = report.stoppedAfter > 0;
    if (report.crossed) return std::nullopt;
    if (finerIfThrough && !stopped && finerMayHelp(before, report)) {
      DrapePieces again = op;
      again.finer = true;
      auto finer = inStages(before, again, stages, context, false);
      return finer && *finer && (*finer)->report.settled ? finer : inStages(before, op, stages, context, false);
    }
    if (!report.settled && !stopped && !last && (beforeInside || report.steps == 0)) return std::nullopt;
    now = adopted(std::move(now), *outcome);
    if (stopped) report.stoppedAfter += sum.steps;
    add(sum, report);
    if (beforeInside) {
      auto laid = laidInto(now, before, stages[k + 1].pieces);
      if (!laid) return std::nullopt;
      now = *std::move(laid);
      if (stopped)
        for (const PieceId id : stages[k + 1].pieces) outcome->forms[id] = now.find(id)->form;
    }
    if (!last && !stopped) continue;
    report.steps = sum.steps, report.solves = sum.solves;
    report.fineSteps = sum.fineSteps, report.fineSolves = sum.fineSolves;
    const auto inside = [](const Stage& one) { return one.inside; };
    report.finer = op.finer;
    report.insideLast = std::any_of(stages.begin(), stages.end(), inside);
    report.dressed = std::count_if(stages.begin(), stages.end(), std::not_fn(inside)) > 1;
    return outcome;
  }
  return std::nullopt;
}

// As `way` says; nothing where that does not go.
std::optional<Result<DrapeOutcome>> attempted(const Document& before, const DrapePieces& way, Context& context,
                                              bool giveUpCrossed = false) {
  const std::vector<Stage> stages = stagesOf(before, way);
  Context own = context;
  own.giveUpCrossed = giveUpCrossed;
  if (stages.size() > 1) return inStages(before, way, stages, own, !context.recorded && !way.finer && way.stop == 0);
  if (way.dressed || way.insideLast) return std::nullopt;
  auto outcome = drapedNow(before, way, own);
  if (outcome && outcome->report.crossed) return std::nullopt;
  return outcome;
}

// What is given up takes its time, too.
class TimeSpent {
 public:
  void tell(SettleReport& report) const {
    report.cpuSeconds = static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
    report.wallSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }

 private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

// The ways in which a drape is tried of what never came to rest, until one goes: all garments at once, which is soonest
// done; one after another; facings and linings with the rest.
std::optional<Result<DrapeOutcome>> drapedAnew(const Document& before, const DrapePieces& op, Context& context) {
  const bool several = garmentsOf(before, livePieces(before, op.live)).size() > 1;
  DrapePieces way = op;
  const bool never = !before.drape.last || before.drape.last->steps == 0;  // it was too small to be draped
  way.insideLast = never && !laidWithin(before.pattern).empty();
  way.dressed = false;
  if (auto outcome = attempted(before, way, context, several)) return outcome;
  if (!several) return std::nullopt;
  way.dressed = true;
  if (auto outcome = attempted(before, way, context)) return outcome;
  return std::exchange(way.insideLast, false) ? attempted(before, way, context) : std::nullopt;
}

}  // namespace

Result<DrapeOutcome> draped(const Document& before, const DrapePieces& op, Context& context) {
  // What was stopped, or did not come to rest, may have garments that are not put on yet.
  const bool rests = before.drape.last && before.drape.last->settled;
  const bool anew = !context.recorded && !op.dressed && !op.insideLast && op.stop == 0 && !rests &&
                    livePieces(before, op.live) == livePieces(before, {});
  const TimeSpent spent;
  if (auto outcome = anew ? drapedAnew(before, op, context) : attempted(before, op, context)) {
    if (*outcome && ((*outcome)->report.dressed || (*outcome)->report.insideLast)) spent.tell((*outcome)->report);
    return *std::move(outcome);
  }
  DrapePieces atOnce = op;
  atOnce.dressed = atOnce.insideLast = false;
  return drapedNow(before, atOnce, context);
}

}  // namespace karinui

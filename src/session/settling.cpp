// Bringing cloth to rest: asked for, interrupted by a step, taken up again.
#include "session/inside.h"

namespace karinui {

void Session::Inside::settle(std::set<PieceId> live, bool byItselfNow, DrapePieces drape) {
  line.cancel(TaskLine::Kind::Settle);
  if (live.empty()) live = livePieces(state.fitting->document, {});
  if (live.empty()) return tell(Notice::Kind::Refused, say("There is no cloth to drape."));
  settling = live;
  settlingByItself = byItselfNow;
  drape.live.clear();
  for (const PieceId id : live) drape.live.push_back(PieceRef(id));
  ++news.overlay;
  stop = std::make_shared<StopRequest>();
  line.add(TaskLine::Kind::Settle, [this, live, drape, byItselfNow, asked = stop](const Token& token) {
    Result<Step> step = room->perform(drape, token, asked.get());
    const auto fresh = step ? std::make_shared<RoomState>(room->state(token)) : nullptr;
    return [this, live, step = std::move(step), fresh, byItselfNow, asked] {
      ++news.overlay;
      if (stop == asked) stop.reset();
      if (!step) {
        tellError(step.error());
        if (preview && !gesture->begun()) preview.reset(), ++news.garment;
        if (step.error().kind != Error::Kind::Cancelled) settling.clear();
        return;
      }
      settling.clear();
      const SettleReport report = *fresh->fitting->document.drape.last;
      const bool stopped = report.stoppedAfter > 0;
      if (byItselfNow && !stopped) byItself.insert(step->seq);  // to stop one is an act of its own
      take(*fresh);
      ++news.settled;
      if (stopped)
        return tell(Notice::Kind::Said, say("Stopped where it is, not at rest: Settle goes on, Undo takes it back."));
      if (!report.settled) tell(Notice::Kind::Advice, say("The cloth did not come to rest: {0}", report.why));
      if (byItselfNow) settleStirred(live, report);
    };
  });
}

// What stood still beside cloth that came to rest, and is pulled otherwise now, joins it.
void Session::Inside::settleStirred(const std::set<PieceId>& live, const SettleReport& report) {
  std::set<PieceId> more = live;
  for (const PieceId id : report.toActivate) {
    const Piece* piece = state.fitting->document.find(id);
    if (piece && !piece->frozen && !state.fitting->document.drape.dirty.contains(id)) more.insert(id);
  }
  if (more.size() > live.size()) settle(std::move(more), true);
}

void Session::Inside::interruptSettling() {
  if (settling.empty() || (stop && stop->asked())) return;  // one that was stopped is over in a moment
  interrupted.insert(settling.begin(), settling.end());
  settling.clear();
  line.cancel(TaskLine::Kind::Settle);
}

void Session::Inside::dropSettling() {
  line.cancel(TaskLine::Kind::Settle);
  settling.clear(), interrupted.clear();
  stop.reset();
}

void Session::Inside::stopSettling() {
  interrupted.clear();
  if (stop && (stop->asked() || stop->ask())) return;
  if (settlingNow()) tell(Notice::Kind::Said, say("Stopped; nothing was changed."));
  dropSettling();
}

void Session::Inside::settleInterrupted() {
  std::set<PieceId> live;
  for (const PieceId id : std::exchange(interrupted, {})) {
    const Piece* piece = state.fitting->document.find(id);
    if (piece && !piece->frozen && state.fitting->document.drape.dirty.contains(id)) live.insert(id);
  }
  if (!live.empty() && !line.busy(TaskLine::Kind::Step))
    settle(live, true);
  else
    interrupted = live;
}

}  // namespace karinui

// Bringing cloth to rest: asked for, interrupted by a step, taken up again.
#include "session/session_impl.h"

namespace karinui {

void Session::Impl::settle(std::set<PieceId> live, bool automatic, DrapePieces drape) {
  tasks.cancel(TaskQueue::Kind::Settle);
  if (live.empty()) live = livePieces(state.snapshot->document, {});
  if (live.empty()) return tell(Notice::Kind::Refused, say("There is no cloth to drape."));
  drape = drapeOf(live, std::move(drape));
  ++changes.overlay;
  tasks.add(TaskQueue::Kind::Settle, [this, live, drape, automatic,
                                      stop = schedule.begin(live, automatic)](const Token& token) {
    Result<Step> step = documentWorker->perform(drape, token, stop.get());
    const auto fresh = step ? std::make_shared<DocumentState>(documentWorker->state(token)) : nullptr;
    return [this, live, step = std::move(step), fresh, automatic, stop] {
      ++changes.overlay;
      schedule.end(stop);
      if (!step) {
        tellError(step.error());
        if (preview && !gesture->begun()) preview.reset(), ++changes.garment;
        return;
      }
      const SettleReport report = *fresh->snapshot->document.drape.last;
      const bool stopped = report.stoppedAfter > 0;
      if (automatic && !stopped) schedule.cameByItself(step->seq);  // to stop one is an act of its own
      take(*fresh);
      ++changes.settled;
      if (stopped)
        return tell(Notice::Kind::Said, say("Stopped where it is, not at rest: Settle goes on, Undo takes it back."));
      if (const auto trouble = adviceOn(report)) tell(Notice::Kind::Advice, *trouble);
      if (!automatic) return;
      if (std::set<PieceId> more = joinedBy(live, state.snapshot->document); more.size() > live.size())
        settle(std::move(more), true);
    };
  });
}

void Session::Impl::interruptSettling() {
  tasks.cancel(TaskQueue::Kind::SettlePreview);
  if (schedule.interrupt()) tasks.cancel(TaskQueue::Kind::Settle);
}

void Session::Impl::dropSettling() {
  tasks.cancel(TaskQueue::Kind::Settle);
  figureAsked.reset();
  schedule.drop();
  if (preview && !gesture->begun() && !trial.active()) preview.reset(), ++changes.garment;
}

void Session::Impl::stopPosing() {
  tasks.cancel(TaskQueue::Kind::Pose);
  if (poseStopped = posingNow(); poseStopped) return;  // it has begun, and ends in a moment
  tell(Notice::Kind::Said, say("Stopped; nothing was changed."));
  settleInterrupted();
}

void Session::Impl::stopSettling() {
  if (posingNow()) return stopPosing();
  if (schedule.stop() == SettleSchedule::Stopping::UnderWay) return;
  if (settlingNow()) tell(Notice::Kind::Said, say("Stopped; nothing was changed."));
  dropSettling();
}

std::set<PieceId> Session::Impl::unsettled(const std::set<PieceId>& of, const Document& document) {
  std::set<PieceId> live;
  for (const PieceId id : of) {
    const Piece* piece = document.find(id);
    if (piece && !piece->frozen && document.drape.dirty.contains(id)) live.insert(id);
  }
  return live;
}

void Session::Impl::settleInterrupted() {
  const std::set<PieceId> live = unsettled(schedule.interrupted(), state.snapshot->document);
  schedule.setInterrupted(live);
  if (!live.empty() && !stepping()) settle(live, true);
}

}  // namespace karinui

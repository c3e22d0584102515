// The gesture in hand: the preview it requests is made by the worker thread, its result becomes a step.
#include "karinui/session/fabric_numbers.h"
#include "session/session_impl.h"

namespace karinui {

void Session::Impl::request(PreviewRequest request) {
  if (std::holds_alternative<std::monostate>(request)) return;
  previews.put(std::move(request));
  requestNext();
}

void Session::Impl::requestNext() {
  auto request = previews.next();
  if (!request) return;
  interruptSettling();
  const Gesture* asker = gesture.get();
  tasks.add(TaskQueue::Kind::Preview, [this, asker, request = *std::move(request)](const Token& token) {
    PreviewReply reply;
    SnapshotPtr fresh;
    if (const auto* pull = std::get_if<PullPreview>(&request)) {
      if (const auto force = documentWorker->pullTo(*pull, token, fresh))
        reply.force = *force;
      else if (force.error().kind != Error::Kind::Cancelled)
        reply.why = force.error().what;
    } else {
      const auto after = documentWorker->after(std::get<OperationPreview>(request), token);
      if (after)
        fresh = reply.after = *after;
      else if (after.error().kind != Error::Kind::Cancelled)
        reply.why = after.error().what;
    }
    const auto* operation = std::get_if<OperationPreview>(&request);
    const bool settles = operation && operation->settle && reply.after;
    return [this, asker, reply, fresh, settles] {
      previews.answered();
      const bool wanted = gesture.get() == asker && gesture->begun();
      if (wanted) {
        gesture->previewed(reply);
        if (fresh) preview = fresh, ++changes.garment, ++changes.predicted;
        ++changes.overlay;
      }
      if (wanted && settles && previews.idle()) settlePreview();
      requestNext();
    };
  });
}

// The hand rests: the cloth comes to rest as it will after the step, whose drape then finds its outcome done.
void Session::Impl::settlePreview() {
  std::set<PieceId> disturbed = schedule.interrupted();
  disturbed.merge(disturbedBy(state.snapshot->document, preview->document));
  const std::set<PieceId> live = unsettled(disturbed, preview->document);
  if (live.empty() || !options.autoSettle) return;
  tasks.add(TaskQueue::Kind::SettlePreview, [this, asker = gesture.get(), live](const Token& token) {
    const Result<SnapshotPtr> settled = documentWorker->settleAfter(live, token);
    return [this, asker, settled] {
      if (!settled || gesture.get() != asker || !gesture->begun() || !previews.idle()) return;
      preview = *settled;
      ++changes.garment, ++changes.predicted, ++changes.overlay;
    };
  });
}

void Session::Impl::takeResult(GestureResult result, bool begunBefore) {
  if (result.options) toolOptions = *result.options, ++changes.overlay;
  if (result.why) tell(result.operation ? Notice::Kind::Advice : Notice::Kind::Refused, *result.why);
  drawnAt = result.drawnAt;
  for (std::optional<Operation>* drawn : {&result.operation, &result.asked})
    if (*drawn) cutFromItsCloth(**drawn, state.snapshot->document, selection.pieces);
  if (result.asked) asked = std::move(result.asked), ++changes.overlay;
  if (!result.over) return request(std::move(result.request));
  keyboard.letGo();
  tasks.cancel(TaskQueue::Kind::Preview);
  tasks.cancel(TaskQueue::Kind::SettlePreview);
  previews.clear();
  const bool performs = result.operation.has_value();
  if (performs) {
    dropMenuSaid.clear();
    if (const auto menu = gesture->dropMenu(context()))
      for (const Message& said : menu->title) dropMenuSaid.push_back(text(said));
    perform(std::move(*result.operation));
  } else {
    if (preview && !settlingNow()) preview.reset(), ++changes.garment;
    if (begunBefore) settleInterrupted();
  }
  gesture = gestureFor(tool);
  ++changes.overlay;
}

void Session::choose(std::size_t item) {
  auto& in = *impl_;
  ++in.changes.overlay;
  const bool begun = in.gesture->begun();
  in.takeResult(in.gesture->choose(item, in.context()), begun);
  if (in.options.wake) in.options.wake();
}

void Session::chooseNumber(double typed) {
  auto& in = *impl_;
  ++in.changes.overlay;
  const bool begun = in.gesture->begun();
  in.takeResult(in.gesture->chooseNumber(typed, in.context()), begun);
  if (in.options.wake) in.options.wake();
}

void Session::Impl::dropGesture() {
  keyboard.letGo();
  carryOnTable(gesture->putBack());
  tasks.cancel(TaskQueue::Kind::Preview);
  tasks.cancel(TaskQueue::Kind::SettlePreview);
  previews.clear();  // what was dropped unanswered must not keep the next gesture from asking
  tasks.add(TaskQueue::Kind::Preview, [this](const Token&) {
    documentWorker->letGo();
    return TaskQueue::Finish();
  });
  gesture = gestureFor(tool);
  if (preview && !settlingNow()) preview.reset(), ++changes.garment;
  ++changes.overlay;
}

}  // namespace karinui

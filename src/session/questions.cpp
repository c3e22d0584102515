// The gesture in hand: what it asks is worked out beside it, what it comes to becomes a step.
#include "session/inside.h"

namespace karinui {

void Session::Inside::ask(Ask question) {
  if (std::holds_alternative<std::monostate>(question)) return;
  next = std::move(question);
  askNext();
}

void Session::Inside::askNext() {
  if (asking || std::holds_alternative<std::monostate>(next)) return;
  interruptSettling();
  asking = true;
  const Gesture* asker = gesture.get();
  line.add(TaskLine::Kind::Preview, [this, asker, question = std::exchange(next, {})](const Token& token) {
    Answer answer;
    FittingPtr look;
    if (const auto* pull = std::get_if<AskPull>(&question)) {
      if (const auto force = room->pullTo(*pull, token, look))
        answer.force = *force;
      else if (force.error().kind != Error::Kind::Cancelled)
        answer.why = force.error().what;
    } else {
      const auto after = room->after(std::get<AskAfter>(question).operation, token);
      if (after)
        look = answer.after = *after;
      else if (after.error().kind != Error::Kind::Cancelled)
        answer.why = after.error().what;
    }
    return [this, asker, answer, look] {
      asking = false;
      if (gesture.get() == asker && gesture->begun()) {
        gesture->answered(answer);
        if (look) preview = look, ++news.garment, ++news.predicted;
        ++news.overlay;
      }
      askNext();
    };
  });
}

void Session::Inside::told(Told answer, bool begunBefore) {
  if (answer.mirrorSeams) mirrorSeams = *answer.mirrorSeams, ++news.overlay;
  if (answer.why) tell(answer.operation ? Notice::Kind::Advice : Notice::Kind::Refused, *answer.why);
  if (!answer.over) return ask(std::move(answer.ask));
  keyHand.letGo();
  line.cancel(TaskLine::Kind::Preview);
  asking = false;
  next = {};
  const bool performs = answer.operation.has_value();
  if (performs) {
    answered.clear();
    if (const auto menu = gesture->dropMenu(bench()))
      for (const Message& said : menu->title) answered.push_back(text(said));
    perform(std::move(*answer.operation));
  } else {
    if (preview && !settlingNow()) preview.reset(), ++news.garment;
    if (begunBefore) settleInterrupted();
  }
  gesture = gestureFor(tool);
  ++news.overlay;
}

void Session::choose(std::size_t item) {
  auto& in = *inside_;
  ++in.news.overlay;
  const bool begun = in.gesture->begun();
  in.told(in.gesture->choose(item, in.bench()), begun);
  if (in.options.wake) in.options.wake();
}

void Session::Inside::dropGesture() {
  keyHand.letGo();
  line.cancel(TaskLine::Kind::Preview);
  asking = false;  // what was dropped unanswered must not keep the next gesture from asking
  next = {};
  line.add(TaskLine::Kind::Preview, [this](const Token&) {
    room->letGo();
    return TaskLine::Finish();
  });
  gesture = gestureFor(tool);
  if (preview && !settlingNow()) preview.reset(), ++news.garment;
  ++news.overlay;
}

}  // namespace karinui

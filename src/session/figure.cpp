// The figure turned under the hand, and worn.
#include "session/session_impl.h"

namespace karinui {

namespace {

std::optional<std::size_t> lastFigure(const std::vector<Step>& steps) {
  for (std::size_t i = steps.size(); i > 0; --i)
    if (std::holds_alternative<SetBody>(steps[i - 1].operation)) return i - 1;
  return std::nullopt;
}

}  // namespace

const SetBody* Session::figure() const {
  if (impl_->figureAsked) return &*impl_->figureAsked;
  const auto last = lastFigure(steps());
  return last ? &std::get<SetBody>(steps()[*last].operation) : nullptr;
}

void Session::Impl::tryNextFigure() {
  const auto next = trial.next();
  if (!next) return;
  tasks.add(TaskQueue::Kind::Figure, [this, body = *next](const Token& token) {
    const Result<SnapshotPtr> worn = documentWorker->onFigure(body, token);
    return [this, worn] {
      if (trial.built() && worn) preview = *worn, ++changes.garment, ++changes.predicted;
      tryNextFigure();
    };
  });
}

void Session::Impl::dropFigure() {
  tasks.cancel(TaskQueue::Kind::Figure);
  if (trial.end() && preview) preview.reset(), ++changes.garment;
}

void Session::previewFigure(SetBody body) {
  auto& in = *impl_;
  if (!in.trial.active()) in.interruptSettling();
  in.trial.propose(std::move(body));
  in.tryNextFigure();
}

void Session::applyFigure(SetBody body) {
  auto& in = *impl_;
  // The figure last shown stays until the new one is there.
  in.tasks.cancel(TaskQueue::Kind::Figure);
  in.trial.end();
  const auto last = lastFigure(in.state.steps);
  if (in.state.readOnly || !last) return perform(std::move(body));
  if (std::get<SetBody>(in.state.steps[*last].operation) == body) return in.dropGesture(), in.settleInterrupted();
  const SnapshotPtr seen = in.preview;
  // Asked for before this one and not there yet: it goes on where this one is refused. One measure is typed after
  // another, faster than a garment is draped.
  const std::optional<SetBody> before = in.figureAsked;
  in.amend(*last + 1, body, [this, body, before](const Done& done) {
    auto& own = *impl_;
    if (own.figureAsked != body) return;  // another one is asked for
    own.figureAsked.reset();
    if (!done && done.error().kind != Error::Kind::Cancelled && before) applyFigure(*before);
  });
  in.figureAsked = std::move(body);
  in.preview = seen;
}

}  // namespace karinui

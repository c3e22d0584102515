// The figure turned under the hand, and worn.
#include "session/inside.h"

namespace karinui {

namespace {

std::optional<std::size_t> lastFigure(const std::vector<Step>& steps) {
  for (std::size_t i = steps.size(); i > 0; --i)
    if (std::holds_alternative<SetBody>(steps[i - 1].operation)) return i - 1;
  return std::nullopt;
}

}  // namespace

const SetBody* Session::figure() const {
  const auto last = lastFigure(steps());
  return last ? &std::get<SetBody>(steps()[*last].operation) : nullptr;
}

void Session::Inside::tryNextFigure() {
  if (trying || !tried) return;
  trying = true;
  line.add(TaskLine::Kind::Figure, [this, body = *std::exchange(tried, std::nullopt)](const Token& token) {
    const Result<FittingPtr> worn = room->tried(body, token);
    return [this, worn] {
      trying = false;
      if (worn && figureTurns) preview = *worn, ++news.garment, ++news.predicted;
      tryNextFigure();
    };
  });
}

void Session::Inside::dropFigure() {
  line.cancel(TaskLine::Kind::Figure);
  tried.reset();
  trying = false;
  if (std::exchange(figureTurns, false) && preview) preview.reset(), ++news.garment;
}

void Session::tryFigure(SetBody body) {
  auto& in = *inside_;
  if (!in.figureTurns) in.interruptSettling();
  in.figureTurns = true;
  in.tried = std::move(body);
  in.tryNextFigure();
}

void Session::wearFigure(SetBody body) {
  auto& in = *inside_;
  // The figure last shown stays until the new one is there.
  in.line.cancel(TaskLine::Kind::Figure);
  in.tried.reset();
  in.trying = in.figureTurns = false;
  const auto last = lastFigure(in.state.steps);
  if (in.state.readOnly || !last) return perform(std::move(body));
  if (std::get<SetBody>(in.state.steps[*last].operation) == body) return in.dropGesture(), in.settleInterrupted();
  const FittingPtr seen = in.preview;
  amend(*last + 1, std::move(body));
  in.preview = seen;
}

}  // namespace karinui

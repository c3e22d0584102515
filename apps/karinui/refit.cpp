#include "refit.h"

#include "karinui/design/step_words.h"
#include "karinui/pattern/alteration.h"

namespace karinui::app {

namespace {

// A step as it is done on the other body. An outline that was pulled from the cloth is found anew; one that was drawn
// on the paper is drawn as far from the piece as it is there now.
Operation refitted(const Step& step, OpenDocument& source, const Document& now, Context& context) {
  Operation operation = step.operation;
  auto* reshape = std::get_if<ReshapePiece>(&operation);
  if (!reshape || reshape->outline.edges.empty()) return operation;
  if (!reshape->at.empty()) {
    reshape->outline = {};
    return operation;
  }
  const auto then = source.file().documentAfter(step.parent, context);
  const Piece* before = then ? then->find(reshape->piece.id) : nullptr;
  const Piece* there = now.find(reshape->piece.id);
  if (!before || !there) return operation;
  if (auto outline = alteredAlike(before->outline, reshape->outline, there->outline))
    reshape->outline = *std::move(outline);
  return operation;
}

}  // namespace

Done refit(OpenDocument& source, OpenDocument& target, const SetBody& body) {
  const std::vector<Step> steps = source.file().steps();
  if (steps.empty()) return refused(say("The document is empty; there is nothing to fit."));
  // Prints and figures that the document brought along.
  Context context{
      target.context().workers, target.context().token, source.file().blobs(), target.context().bodies, {}, {}};
  const auto perform = [&](Operation operation, const Step* step) -> Done {
    const Message told = step ? stepSaid(target.document(), operation) : Message();
    const std::string name(nameOf(operation));
    const Result<Step> done = target.performWith(std::move(operation), context);
    if (done) return {};
    if (!step || done.error().kind == Error::Kind::Cancelled) return done.error();
    return Error{done.error().kind, say("Step {0}, {1} ({2}), cannot be done on this body: {3}",
                                        static_cast<std::size_t>(step->serial), name, told, done.error().what)};
  };
  bool chosen = false;
  for (const Step& step : steps) {
    // Every choice of a figure becomes this one, so that the steps keep their numbers.
    const bool figure = std::holds_alternative<SetBody>(step.operation);
    chosen |= figure;
    const Done done = perform(figure ? Operation(body) : refitted(step, source, target.document(), context), &step);
    if (!done) return done;
  }
  return chosen ? Done() : perform(body, nullptr);
}

}  // namespace karinui::app

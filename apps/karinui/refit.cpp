#include "refit.h"

#include "karinui/design/step_words.h"
#include "karinui/session/fit_over_bodies.h"

namespace karinui::app {

Done refit(OpenDocument& source, OpenDocument& target, const SetBody& body) {
  // Prints and figures that the document brought along.
  Context context{
      target.context().workers, target.context().token, source.file().blobs(), target.context().bodies, {}, {}};
  const auto recipe = recipeOf(source.file(), context);
  if (!recipe) return recipe.error();
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
  for (const Step& step : (*recipe)->steps) {
    // Every choice of a figure becomes this one, so that the steps keep their numbers.
    const bool figure = std::holds_alternative<SetBody>(step.operation);
    chosen |= figure;
    const Done done = perform(figure ? Operation(body) : madeToFit(**recipe, step, target.document()), &step);
    if (!done) return done;
  }
  return chosen ? Done() : perform(body, nullptr);
}

}  // namespace karinui::app

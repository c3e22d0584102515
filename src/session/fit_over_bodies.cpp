#include "karinui/session/fit_over_bodies.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/design/drape.h"
#include "karinui/design/glossary.h"
#include "karinui/design/step_words.h"
#include "karinui/pattern/alteration.h"
#include "session/csv.h"

namespace karinui {

namespace {

// What the steps ask the document's blobs for; a figure that is kept there is another's.
std::vector<std::string> blobsAsked(const Operation& operation) {
  std::vector<std::string> all;
  if (const auto* look = std::get_if<SetLook>(&operation)) all = {look->photo};
  if (const auto* scan = std::get_if<LayUnderlay>(&operation)) all = {scan->photo};
  if (const auto* piece = std::get_if<AddPiece>(&operation)) all = {piece->bent};
  std::erase(all, std::string());
  return all;
}

const ReshapePiece* drawnOnPaper(const Operation& operation) {
  const auto* reshape = std::get_if<ReshapePiece>(&operation);
  return reshape && reshape->at.empty() && !reshape->outline.edges.empty() ? reshape : nullptr;
}

// What of it does not fit: the first that holds counts.
void judge(FitOnBody& fit, const Examination& check) {
  const FitLimits limits;
  const SettleReport& last = *fit.document.drape.last;
  fit.why = last.settled ? Message() : last.why;
  const auto tell = [&](FitFault fault, double by, Message where = {}) {
    fit.fault = fault, fit.by = by, fit.where = std::move(where);
  };
  const auto open = std::count_if(check.fastenings.begin(), check.fastenings.end(),
                                  [](const FasteningPull& pull) { return !pull.holds(); });
  if (const auto shortage = shortageTold(last.why))
    tell(FitFault::TooSmall, shortage->by, shortage->where);
  else if (!last.settled)
    tell(FitFault::NotSettled, 0);
  else if (open > 0)
    tell(FitFault::NotClosed, static_cast<double>(open));
  else if (check.clothBodyCrossings > 0)
    tell(FitFault::CrossesBody, static_cast<double>(check.clothBodyCrossings));
  else if (check.strain.p99 > limits.strain)
    tell(FitFault::Stretched, check.strain.p99, nameSaid(mostStretched(fit.garment->frame)));
  else if (fit.pressure && fit.pressure->p99 > limits.pressure) {
    const auto place = mostPressed(fit.pressureAt, *fit.body);
    tell(FitFault::Presses, fit.pressure->p99, place ? placeSaid(*place) : Message());
  }
}

// Error: of the machine.
Result<FitOnBody> fitOn(const GarmentRecipe& recipe, const GarmentWearer& wearer, Context& context) {
  FitOnBody fit;
  fit.name = wearer.name;
  const auto refused = [&](const Error& why) -> Result<FitOnBody> {
    if (why.hindered()) return why;
    fit.fault = FitFault::Refused, fit.why = why.what;
    fit.garment = snapshotOf(fit.document, fit.body);
    return fit;
  };
  const auto made = madeFor(recipe, wearer.body, context, &fit.document);
  if (fit.document.body.chosen())
    if (auto body = bodyOf(fit.document, context)) fit.body = *std::move(body);
  if (!made) return refused(made.error());
  if (!fit.document.atRest()) {
    auto rested = apply(fit.document, DrapePieces{}, context);
    if (!rested) return refused(rested.error());
    fit.document = *std::move(rested);
  }
  const auto check = examined(fit.document, context);
  if (!check) return refused(check.error());
  fit.strain = check->strain;
  fit.garment = snapshotOf(fit.document, fit.body);
  fit.pressureAt = pressureOnBody(*fit.garment, context.workers);
  fit.pressure = pressureReport(fit.pressureAt);
  fit.girths = girthsOf(*fit.garment);
  judge(fit, *check);
  return fit;
}

std::string faultName(FitFault fault) {
  switch (fault) {
    case FitFault::None:
      break;
    case FitFault::TooSmall:
      return "too small";
    case FitFault::NotClosed:
      return "does not close";
    case FitFault::CrossesBody:
      return "crosses the body";
    case FitFault::Stretched:
      return "stretched";
    case FitFault::Presses:
      return "presses";
    case FitFault::NotSettled:
      return "did not settle";
    case FitFault::Refused:
      return "refused";
  }
  return {};
}

}  // namespace

Result<RecipePtr> recipeOf(DocumentFile& file, Context& context) {
  auto recipe = std::make_shared<GarmentRecipe>();
  recipe->steps = file.steps();
  if (recipe->steps.empty()) return refused(say("The document is empty; there is nothing to fit."));
  for (const Step& step : recipe->steps) {
    for (const std::string& blob : blobsAsked(step.operation))
      if (auto bytes = file.blobs().get(blob))
        if (auto kept = recipe->blobs.put(*std::move(bytes)); !kept) return kept.error();
    if (const auto* reshape = drawnOnPaper(step.operation)) {
      const auto then = file.documentAfter(step.parent, context);
      if (!then) return then.error();
      if (const Piece* before = then->find(reshape->piece.id)) recipe->drawnOn[step.seq] = before->outline;
    }
  }
  return RecipePtr(std::move(recipe));
}

Result<Document> madeFor(const GarmentRecipe& recipe, const SetBody& body, Context& context, Document* asFar) {
  MemoryBlobs blobs = recipe.blobs;
  Context own{context.workers, context.token, blobs, context.bodies, context.drape, context.pull};
  Document document;
  const auto perform = [&](const Operation& operation, const Step* step) -> Done {
    auto after = apply(document, operation, own);
    if (after) {
      document = *std::move(after);
      if (asFar) *asFar = document;
      return {};
    }
    if (!step || after.error().kind == Error::Kind::Cancelled) return after.error();
    return Error{after.error().kind,
                 say("Step {0}, {1} ({2}), cannot be done on this body: {3}", static_cast<std::size_t>(step->serial),
                     std::string(nameOf(operation)), stepSaid(document, operation), after.error().what)};
  };
  bool chosen = false;
  for (const Step& step : recipe.steps) {
    // Every choice of a figure becomes this one, so that the steps keep their numbers.
    const bool figure = std::holds_alternative<SetBody>(step.operation);
    chosen |= figure;
    if (Done done = perform(figure ? Operation(body) : madeToFit(recipe, step, document), &step); !done)
      return done.error();
  }
  if (!chosen)
    if (Done done = perform(body, nullptr); !done) return done.error();
  return document;
}

Operation madeToFit(const GarmentRecipe& recipe, const Step& step, const Document& now) {
  Operation operation = asRecorded(step.operation);
  auto* reshape = std::get_if<ReshapePiece>(&operation);
  if (!reshape || reshape->outline.edges.empty()) return operation;
  if (!reshape->at.empty()) {
    reshape->outline = {};
    return operation;
  }
  const auto before = recipe.drawnOn.find(step.seq);
  const Piece* there = now.find(reshape->piece.id);
  if (before == recipe.drawnOn.end() || !there) return operation;
  if (auto outline = alteredAlike(before->second, reshape->outline, there->outline))
    reshape->outline = *std::move(outline);
  return operation;
}

SetBody figureOf(const Measurements& measures) {
  SetBody body;
  body.sex = measures.sex;
  for (const auto& [key, value] : measures.value) body.set.push_back({key, {value}});
  return body;
}

std::vector<GarmentWearer> wearersOf(const MeasurementTable& table) {
  std::vector<GarmentWearer> all;
  for (const MeasuredPerson& person : table.people) all.push_back({person.name, figureOf(person.measures)});
  return all;
}

Measurements widened(Measurements measures, double by) {
  for (const char* girth : {"bust_girth", "under_bust_girth", "waist_girth", "belly_girth", "hip_girth"})
    if (const auto own = measures.value.find(girth); own != measures.value.end()) own->second += by;
  return measures;
}

Message faultSaid(const FitOnBody& fit) {
  const auto amount = [&](const Message& what, const Message& by) {
    std::vector<Message> all{by};
    if (!fit.where.empty()) all.push_back(fit.where);
    return say("{0}: {1}", what, listSaid(all));
  };
  const auto plain = [](const std::string& words) { return say("{0}", words); };
  const auto many = static_cast<std::size_t>(fit.by);
  switch (fit.fault) {
    case FitFault::None:
      return {};
    case FitFault::TooSmall:
      return amount(say("too small"), plain(fit.by < 0.01 ? "< 1 cm" : fixed(100 * fit.by, 0) + " cm"));
    case FitFault::NotClosed:
      return amount(say("does not close"), say("{0} {0|fastening|fastenings}", many));
    case FitFault::CrossesBody:
      return amount(say("crosses the body"), say("{0} {0|place|places}", many));
    case FitFault::Stretched:
      return amount(say("stretched"), plain(fixed(100 * fit.by, 1) + " %"));
    case FitFault::Presses:
      return amount(say("presses"), plain(fixed(fit.by / 1000, 1) + " kPa"));
    case FitFault::NotSettled:
      return say("{0}: {1}", say("did not settle"), fit.why);
    case FitFault::Refused:
      return say("{0}: {1}", say("refused"), fit.why);
  }
  return {};
}

Result<std::vector<FitOnBody>> fitOverBodies(const GarmentRecipe& recipe, const std::vector<GarmentWearer>& wearers,
                                             Context& context, const std::function<void(const FitOnBody&)>& each) {
  std::vector<FitOnBody> all;
  for (const GarmentWearer& wearer : wearers) {
    auto fit = fitOn(recipe, wearer, context);
    if (!fit) return fit.error();
    if (context.token.cancelled()) return cancelled();
    if (each) each(*fit);
    all.push_back(*std::move(fit));
  }
  return all;
}

std::vector<std::string> columnsOf(const std::vector<FitOnBody>& all) {
  std::vector<std::string> names;
  for (const FitOnBody& fit : all)
    for (const Girths& girths : fit.girths)
      if (std::find(names.begin(), names.end(), girths.name.pattern) == names.end())
        names.push_back(girths.name.pattern);
  return names;
}

std::string csvOf(const std::vector<FitOnBody>& all) {
  const std::vector<std::string> levels = columnsOf(all);
  std::vector<std::string> head{"body",           "fits",
                                "fault",          "by",
                                "where",          "why",
                                "strain_mean",    "strain_p99",
                                "strain_max",     "pressure_mean_pa",
                                "pressure_p99_pa"};
  for (const std::string& level : levels) {
    std::string name = level;
    std::replace(name.begin(), name.end(), ' ', '_');
    head.push_back("ease_" + name + "_m");
  }
  std::string csv = csvRow(head);
  for (const FitOnBody& fit : all) {
    const bool drapes = fit.fault != FitFault::Refused;
    std::vector<std::string> row{fit.name,
                                 fit.fits() ? "yes" : "no",
                                 faultName(fit.fault),
                                 fit.by > 0 ? shortest(fit.by) : "",
                                 text(fit.where),
                                 text(fit.why),
                                 drapes ? shortest(fit.strain.mean) : "",
                                 drapes ? shortest(fit.strain.p99) : "",
                                 drapes ? shortest(fit.strain.max) : "",
                                 fit.pressure ? shortest(fit.pressure->mean) : "",
                                 fit.pressure ? shortest(fit.pressure->p99) : ""};
    for (const std::string& level : levels) {
      const auto girths = std::find_if(fit.girths.begin(), fit.girths.end(),
                                       [&](const Girths& one) { return one.name.pattern == level; });
      row.push_back(girths == fit.girths.end() ? "" : shortest(girths->garment - girths->body));
    }
    csv += csvRow(row);
  }
  return csv;
}

}  // namespace karinui

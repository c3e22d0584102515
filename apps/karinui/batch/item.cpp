#include "item.h"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <new>

#include "../examination.h"
#include "../json_answers.h"
#include "../refit.h"
#include "karinui/base/file.h"
#include "karinui/design/history.h"
#include "karinui/design/script.h"
#include "karinui/design/variant.h"
#include "karinui/session/fit_over_bodies.h"

namespace karinui::app {

namespace {

namespace fs = std::filesystem;

// A copy of a design that another program changed would give other results under the same key.
Error notAsPlanned(const fs::path& path) {
  return storageError(
      say("“{0}” is not the design that was planned: it was changed or removed since. Put it back, or "
          "plan the batch anew into another folder.",
          path.string()));
}

Done playScript(OpenDocument& opened, const std::string& script, const SetBody& body) {
  const auto lines = parseScript(script);
  if (!lines) return lines.error();
  if (const auto step = opened.perform(body); !step) return step.error();
  for (const ScriptLine& line : *lines) {
    if (std::holds_alternative<SetBody>(line.operation)) continue;
    if (const auto step = opened.perform(line.operation); !step)
      return Error{step.error().kind, say("Line {0}: {1}", line.number, step.error().what)};
  }
  return {};
}

}  // namespace

Done makeGarment(OpenDocument& opened, const fs::path& folder, const BatchPlan& plan, const BatchItem& item) {
  const SetBody body = figureOf(plan.bodies[item.body].measures);
  const fs::path path = folder / plan.designs[item.design].file;
  const std::string planned = path.stem().string();
  if (path.extension() == kScriptCopy) {
    const auto script = readFile(path);
    if (!script && script.error().hindered()) return script.error();
    if (!script || designHash(*script) != planned) return notAsPlanned(path);
    if (const Done done = playScript(opened, *script, body); !done) return done;
  } else {
    Result<DocumentFile> file = DocumentFile::openForReading(path);
    if (!file && file.error().hindered()) return file.error();
    if (!file || designHash(*file) != planned) return notAsPlanned(path);
    OpenDocument source(opened.program(), *std::move(file));
    if (const Done done = refit(source, opened, body); !done) return done;
  }
  if (plan.spacing > 0) {
    ChangeSettings settings;
    settings.spacing = Length{plan.spacing};
    if (const auto step = opened.perform(settings); !step) return step.error();
  }
  if (!item.fabric.empty())
    if (const auto step = opened.perform(cutFrom(opened.document(), item.fabric)); !step) return step.error();
  return {};
}

int runItem(Program& program, const fs::path& folder) try {
  const std::string given{std::istreambuf_iterator<char>(std::cin), {}};
  const auto plan = parsePlan(given, folder);
  if (!plan) return program.console.refuse(plan.error());
  if (plan->items.size() != 1) return kWrongCall;
  const BatchItem& item = plan->items.front();
  program.console.keepNotes([](const Message&) {});
  OpenDocument opened(program, DocumentFile::inMemory());
  const auto keep = [&](Outcome outcome, const Message& said, Json numbers) -> int {
    const Done done = keepOutcome(folder, item, outcome, said, std::move(numbers));
    return done ? int{kDone} : program.console.refuse(done.error());
  };
  const auto hindered = [&](const Error& why) -> int {
    if (!why.hindered()) return keep(Outcome::Refused, why.what, Json::object());
    return why.kind == Error::Kind::Memory ? kItemOutOfMemory : program.console.refuse(why);
  };
  if (const Done done = makeGarment(opened, folder, *plan, item); !done) return hindered(done.error());
  StopRequest nobody;
  const Result<Settled> settled = settle(opened, nobody, false);
  if (!settled) return hindered(settled.error());
  const Document& document = opened.document();
  Json numbers = {{"operations", document.operations}, {"hash", hash(document)}, {"drape_hash", drapeHash(document)}};
  Json check = checkJson(settled->check);
  for (const char* list : {"finite", "elastics", "fastenings", "crossings"}) check.erase(list);
  numbers["fastenings_open"] = std::count_if(settled->check.fastenings.begin(), settled->check.fastenings.end(),
                                             [](const FasteningPull& f) { return !f.holds(); });
  numbers.update(check);
  if (const Result<Fit> fit = fitOf(opened)) {
    const Json object = fitJson(fit->girths, fit->pressure);
    for (const auto& [level, girths] : object.at("girths").items())
      numbers["ease_" + level + "_m"] = girths.at("ease_m");
    for (const char* name : {"pressure_mean_pa", "pressure_p99_pa"})
      if (object.contains(name)) numbers[name] = object.at(name);
    if (fit->pressedMost) numbers["pressure_at"] = text(*fit->pressedMost);
    if (!fit->stretchedMost.empty()) numbers["strain_at"] = fit->stretchedMost;
  }
  const SettleReport& report = *document.drape.last;
  if (const auto shortage = shortageTold(report.why))
    numbers["too_small_m"] = shortage->by, numbers["too_small_at"] = text(shortage->where);
  return keep(report.settled ? Outcome::Ok : Outcome::NotSettled, report.why, std::move(numbers));
} catch (const std::bad_alloc&) {
  return kItemOutOfMemory;
}

}  // namespace karinui::app

#include "bench_wardrobe.h"

#include <algorithm>

#include "bench/wardrobe.h"
#include "json_answers.h"
#include "karinui/base/number.h"
#include "word_table.h"

namespace karinui::app {
namespace {

// What became of it, in a sentence; nothing where it is at rest.
Message whyNot(const bench::WardrobeGarment& garment) {
  if (garment.refused) return *garment.refused;
  return garment.settled ? Message() : garment.report.why;
}

Json garmentJson(const bench::WardrobeGarment& garment, const Console& console) {
  Json object = {{"name", garment.name}, {"settled", garment.settled}, {"out_of_time", garment.outOfTime}};
  object["refused"] = garment.refused ? Json(console.said(*garment.refused)) : Json();
  object["draft_s"] = garment.draftSeconds;
  if (garment.refused) return object;
  object.update(settleJson(garment.report, garment.check, console));
  object["settled"] = garment.settled;
  object["drapes"] = garment.drapes;
  object["steps"] = garment.steps;
  object["cpu_s"] = garment.cpuSeconds;
  object["fine_steps"] = garment.report.fineSteps;
  object["fine_solves"] = garment.report.fineSolves;
  if (garment.report.continuation) object["continuation"] = continuationJson(garment.report);
  return object;
}

std::string tableOf(const std::vector<bench::WardrobeGarment>& garments, const Console& console) {
  const auto said = [&](const Message& message) { return console.said(message); };
  WordTable table;
  table.row({said(say("garment")), said(say("points")), said(say("CPU s")), said(say("steps")), said(say("crossings")),
             said(say("gap mm")), said(say("strain %")), said(say("outcome"))});
  for (const bench::WardrobeGarment& garment : garments) {
    if (garment.refused) {
      table.row({garment.name, "-", "-", "-", "-", "-", "-", said(*garment.refused)});
      continue;
    }
    const ClothCheck& check = garment.check;
    table.row(
        {garment.name, std::to_string(check.vertices), fixed(garment.cpuSeconds, 1), std::to_string(garment.steps),
         std::to_string(check.clothClothCrossings) + " / " + std::to_string(check.foldCrossings),
         fixed(check.seamGap * 1000, 1), fixed(check.strain.mean * 100, 2) + " / " + fixed(check.strain.max * 100, 1),
         garment.settled ? said(say("At rest.")) : said(whyNot(garment))});
  }
  return table.words(0);
}

Result<std::vector<std::filesystem::path>> chosen(const WardrobeOptions& options) {
  auto scripts = bench::scriptsIn(options.folder);
  if (!scripts || options.only.empty()) return scripts;
  std::vector<std::filesystem::path> found;
  for (const std::string& name : options.only) {
    const auto at =
        std::find_if(scripts->begin(), scripts->end(), [&](const auto& path) { return path.stem() == name; });
    if (at == scripts->end())
      return notFound(say("There is no garment “{0}” in “{1}”.", name, options.folder.string()));
    found.push_back(*at);
  }
  return found;
}

}  // namespace

int benchWardrobe(Program& program, const WardrobeOptions& options) {
  const auto scripts = chosen(options);
  if (!scripts) return program.console.refuse(scripts.error());
  Workers workers(options.threads);
  std::vector<bench::WardrobeGarment> garments;
  Json list = Json::array();
  std::size_t atRest = 0;
  for (const auto& script : *scripts) {
    const auto garment =
        bench::drapeScript(script, {options.seconds, options.continued}, workers, program.console.token());
    if (!garment) return program.console.refuse(garment.error());
    list.push_back(garmentJson(*garment, program.console));
    garments.push_back(*garment);
    atRest += garment->settled;
    program.console.note(say("{0}: {1}", garment->name, garment->settled ? say("At rest.") : whyNot(*garment)));
  }
  const Json object{{"scene", "wardrobe"},
                    {"threads", options.threads},
                    {"seconds", options.seconds},
                    {"at_rest", atRest},
                    {"garments", list}};
  program.console.answer(object, tableOf(garments, program.console) +
                                     program.console.said(say("{0} of {1} at rest.", atRest, garments.size())));
  return atRest == garments.size() ? kDone : kNotSettled;
}

}  // namespace karinui::app

#include "bench_words.h"

#include "answers_in_words.h"
#include "karinui/base/number.h"
#include "karinui/design/glossary.h"
#include "word_table.h"

namespace karinui::app {

namespace {

std::string benchMm(double metres) { return fixed(metres * 1000, 2) + " mm"; }
std::string benchSeconds(double s) { return fixed(s, 1) + " s"; }

// Of what stands in no document: pieces are told by their numbers.
std::string examinedWords(const bench::Examined& found, const Console& console) {
  return checkWords(Examination{found.check, {}, {}}, Document(), console);
}

void addNearest(WordTable& table, const bench::Examined& found, const Console& console) {
  if (found.check.finite && found.clearance < 1)  // none where there is no body
    table.row({console.said(say("Nearest to the body")), benchMm(found.clearance)});
}

}  // namespace

std::string findingWords(const bench::Workload& load, const bench::Finding& found, int threads, const std::string& hash,
                         const Console& console) {
  const auto said = [&](const Message& message) { return console.said(message); };
  const SettleReport& report = found.report;
  std::string words = said(say("Scene {0}, by {1} {1|processor|processors}: {2}", load.name, threads,
                               adviceOn(report).value_or(say("At rest.")))) +
                      "\n";
  WordTable table;
  table.row({said(say("Draping took")),
             said(say("{0} ({1} of processor time, {2} {2|step|steps})", benchSeconds(report.wallSeconds),
                      benchSeconds(report.cpuSeconds), report.steps))});
  table.row({said(say("Of these on the finest cloth")), said(say("{0} {0|step|steps}", report.fineSteps))});
  table.row({said(say("Memory")), fixed(report.peakMegabytes, 0) + " MB"});
  if (report.continuation)
    table.row({said(say("Gone on from rest")),
               said(say("{0} {0|step|steps} move it by {1} mm at most, 99 % of it by less than {2} mm",
                        report.continuation->steps, fixed(report.continuation->max * 1000, 3),
                        fixed(report.continuation->p99 * 1000, 3)))});
  addNearest(table, found.found, console);
  table.row({said(say("In five seconds of real time it drifts by")), benchMm(found.after.drift)});
  table.row({said(say("Fastest at first")), benchMm(found.after.firstTopSpeed) + "/s"});
  table.row({said(say("Fastest in all of them")), benchMm(found.after.topSpeed) + "/s"});
  table.row({said(say("Where it rests, as a number")), hash});
  return words + table.words(2) + examinedWords(found.found, console);
}

std::string judgedWords(const bench::Workload& load, const bench::Judged& judged, const Console& console) {
  WordTable table;
  addNearest(table, judged.found, console);
  table.row({console.said(say("Height of its middle")), fixed(judged.height * 100, 1) + " cm"});
  table.row({console.said(say("It drifts by")), benchMm(judged.drift)});
  table.row({console.said(say("Fastest in all of them")), benchMm(judged.topSpeed) + "/s"});
  return console.said(say("Scene {0}, made by another program:", load.name)) + "\n" + table.words(2) +
         examinedWords(judged.found, console);
}

std::string editWords(const bench::EditFinding& found, int threads, int runs, const Console& console) {
  const auto said = [&](const Message& message) { return console.said(message); };
  const auto ms = [](const std::vector<double>& seconds) {
    return fixed(1000 * bench::percentile(seconds, 0.5), 0) + " / " +
           fixed(1000 * bench::percentile(seconds, 0.95), 0) + " ms";
  };
  std::string words =
      said(say("Edits of a tunic of {0} {0|point|points}, {1} {1|time|times} each, by {2} {2|processor|processors}. "
               "Times: the middle one / 95 % are within.",
               found.vertices, runs, threads)) +
      "\n";
  WordTable table;
  table.row({said(say("Edit")), said(say("First picture")), said(say("Within 2 mm of rest")), said(say("At rest in")),
             said(say("Not at rest")), said(say("Widest gap in a seam"))});
  for (const bench::EditTimes& edit : found.edits)
    table.row({edit.name, ms(edit.first), ms(edit.within2mm), ms(edit.rest),
               std::to_string(edit.unsettled + edit.undraped), benchMm(edit.last.seamGap)});
  words += table.words(2);
  return words + said(say("A step of a pull that is felt: {0}", ms(found.pullStep))) + "\n";
}

std::string testerWords(const std::vector<TestedFabric>& fabrics, bool settled, int runs, const Console& console) {
  const auto said = [&](const Message& message) { return console.said(message); };
  constexpr double kPull = 490.3;  // N/m: the load at which fabric testers read the stretch (Kawabata)
  WordTable table;
  table.row({said(say("Fabric")), said(say("Drape coefficient")), said(say("Lowest to highest")),
             said(say("As listed")), said(say("Folds")), said(say("Stretch at 490 N/m, warp and weft")),
             said(say("Processor time"))});
  for (const TestedFabric& one : fabrics) {
    const auto listed = drapeFigure(one.fabric);
    const auto stretch = [&](const ThreadCurve& curve) { return fixed(100 * curve.strainAt(kPull), 1) + " %"; };
    table.row({said(nameSaid(one.fabric.name)), fixed(one.mean, 1) + " %",
               fixed(one.lowest, 1) + " – " + fixed(one.highest, 1), listed ? fixed(listed->coefficient, 1) : "–",
               std::to_string(one.folds), stretch(one.fabric.warpCurve()) + ", " + stretch(one.fabric.weftCurve()),
               benchSeconds(one.seconds)});
  }
  std::string words = said(say("On the drape tester, laid on {0} {0|time|times}:", runs)) + "\n" + table.words(2);
  if (!settled) words += said(say("Not all of them came to rest.")) + "\n";
  return words;
}

}  // namespace karinui::app

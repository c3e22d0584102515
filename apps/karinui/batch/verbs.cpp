// batch plan, run, merge, report, picture, throughput, submit: every design on every body.
#include <cmath>

#include "../commands.h"
#include "../json_answers.h"
#include "item.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/design/script.h"
#include "people_picture.h"
#include "plan.h"
#include "shard.h"
#include "slurm.h"
#include "table.h"
#include "throughput.h"

namespace karinui::app {

namespace {

struct PlanOptions {
  BatchWish wish;
  std::string spacing;
};
struct RunOptions {
  std::string folder, shard = "1/1";
  int threads = 0;
  ShardWish wish;
};
struct ItemOptions {
  std::string folder, key;  // the key only to be seen in a list of processes
  int threads = 1;
};
struct MergeOptions {
  std::string folder;
};
struct FitOptions {
  std::string folder, out, language;
};
struct PeopleOptions : PeopleWish {
  std::string out;
};
struct ThroughputOptions {
  ThroughputWish wish;
  std::string spacing;
  double garments = 1e6, cores = 1e4;
};
struct SubmitOptions {
  std::string folder;
  bool slurm = false;
  SlurmWish wish;
};

int runPlan(Program& program, const PlanOptions& options) {
  BatchWish wish = options.wish;
  if (!options.spacing.empty()) {
    if (const Done meant = unitMeant(options.spacing); !meant) return program.console.refuse(meant.error()), kWrongCall;
    const auto spacing = parseLength(options.spacing);
    if (!spacing) return program.console.refuse(spacing.error()), kWrongCall;
    wish.spacing = *spacing;
  }
  const auto plan = planBatch(wish, program.console);
  if (!plan) return program.console.refuse(plan.error());
  program.console.answer(
      {{"folder", wish.folder.string()},
       {"designs", plan->designs.size()},
       {"bodies", plan->bodies.size()},
       {"items", plan->items.size()}},
      program.console.said(say("{0}: {1} {1|design|designs}, {2} {2|body|bodies}, {3} {3|item|items}",
                               wish.folder.string(), plan->designs.size(), plan->bodies.size(), plan->items.size())));
  return kDone;
}

int runRun(Program& program, const RunOptions& options) {
  if (options.threads > 0) program.threads = options.threads;
  ShardWish wish = options.wish;
  const auto shard = parseShard(options.shard);
  if (!shard) return program.console.refuse(shard.error()), kWrongCall;
  std::tie(wish.shard, wish.shards) = *shard;
  const auto done = runShard(program, options.folder, wish);
  if (!done) return program.console.refuse(done.error());
  if (done->hindered > 0)
    program.console.note(
        say("{0} {0|item|items} crashed, or lacked memory or time; karinui batch run --retry does {0|it|them} again.",
            done->hindered));
  program.console.answer(
      {{"items", done->items}, {"done", done->done}, {"before", done->before}, {"hindered", done->hindered}},
      program.console.said(
          say("{0} {0|item|items}: {1} done now, {2} before.", done->items, done->done, done->before)));
  return kDone;
}

int runOneItem(Program& program, const ItemOptions& options) {
  program.threads = options.threads;
  return runItem(program, options.folder);
}

int runMerge(Program& program, const MergeOptions& options) {
  namespace fs = std::filesystem;
  const fs::path folder = options.folder;
  const auto plan = readPlan(folder);
  if (!plan) return program.console.refuse(plan.error());
  const BatchTable table = tableOf(*plan, folder);
  if (const Done done = writeFile(folder / "table.csv", asCsv(table), Readers::Owner); !done)
    return program.console.refuse(done.error());
  if (const Done done = writeDatabase(table, folder / "table.sqlite"); !done)
    return program.console.refuse(done.error());
  if (table.missing > 0)
    program.console.note(say("{0} of {1} {1|item|items} not done yet; karinui batch run goes on with them.",
                             table.missing, table.rows.size()));
  Json outcomes = Json::object();
  for (const auto& row : table.rows)
    if (const auto* outcome = std::get_if<std::string>(&row[5])) outcomes[*outcome] = outcomes.value(*outcome, 0) + 1;
  program.console.answer({{"csv", (folder / "table.csv").string()},
                          {"sqlite", (folder / "table.sqlite").string()},
                          {"items", table.rows.size()},
                          {"missing", table.missing},
                          {"outcomes", outcomes}},
                         (folder / "table.csv").string() + "\n" + (folder / "table.sqlite").string());
  return kDone;
}

int runFitReport(Program& program, const FitOptions& options) {
  const auto plan = readPlan(options.folder);
  if (!plan) return program.console.refuse(plan.error());
  const BatchTable table = tableOf(*plan, options.folder);
  if (table.missing == table.rows.size())
    return program.console.refuse(refused(say("Nothing of this batch is done yet; begin with karinui batch run.")));
  const Language language = options.language == "ja"   ? Language::Japanese
                            : options.language == "en" ? Language::English
                                                       : spokenHere();
  const std::string title = std::filesystem::weakly_canonical(options.folder).filename().string();
  const Result<std::string> bytes = writeReport(fitReport(*plan, table, title), language);
  if (!bytes) return program.console.refuse(bytes.error());
  if (const Done done = writeFile(options.out, *bytes); !done) return program.console.refuse(done.error());
  if (table.missing > 0)
    program.console.note(say("{0} of {1} {1|item|items} not done yet; karinui batch run goes on with them.",
                             table.missing, table.rows.size()));
  program.console.answer({{"file", options.out}, {"bytes", bytes->size()}, {"missing", table.missing}}, options.out);
  return kDone;
}

int runPeople(Program& program, const PeopleOptions& options) {
  if (const Done understood = checkPeople(options); !understood)
    return program.console.refuse(understood.error()), kWrongCall;
  const auto picture = peoplePicture(program, options);
  if (!picture) return program.console.refuse(picture.error());
  if (const Done done = writePng(options.out, picture->image); !done) return program.console.refuse(done.error());
  if (picture->missing > 0)
    program.console.note(say("{0} of {1} {1|item|items} not done yet; karinui batch run goes on with them.",
                             picture->missing, picture->missing + picture->garments));
  program.console.answer({{"file", options.out},
                          {"width", picture->image.width},
                          {"height", picture->image.height},
                          {"garments", picture->garments},
                          {"misfits", picture->misfits},
                          {"missing", picture->missing}},
                         options.out);
  return kDone;
}

int runThroughput(Program& program, const ThroughputOptions& options) {
  ThroughputWish wish = options.wish;
  if (!options.spacing.empty()) {
    if (const Done meant = unitMeant(options.spacing); !meant) return program.console.refuse(meant.error()), kWrongCall;
    const auto spacing = parseLength(options.spacing);
    if (!spacing) return program.console.refuse(spacing.error()), kWrongCall;
    wish.batch.spacing = *spacing;
  }
  const auto found = measureThroughput(program, wish);
  if (!found) return program.console.refuse(found.error());
  const double cores = std::fmin(options.cores, options.garments);  // more have nothing to do
  const BatchTime time = timeOf(*found, options.garments, cores), one = timeOf(*found, options.garments, 1);
  const double busy = cores / found->beside;  // garments a second
  const Json serial = {{"fixed_s", found->fixed},
                       {"plan_ms_per_garment", found->plan * 1e3},
                       {"read_ms_per_garment", found->read * 1e3},
                       {"merge_ms_per_garment", found->merge * 1e3}};
  const Json model = {{"garments", options.garments},
                      {"cores", cores},
                      {"plan_s", time.plan},
                      {"garments_s", time.garments},
                      {"merge_s", time.merge},
                      {"all_s", time.all()},
                      {"garments_per_hour", 3600 * options.garments / time.all()},
                      {"speedup", one.all() / time.all()},
                      {"files_per_s", busy},
                      {"in_mb_per_s", busy * found->in * 1e-6},
                      {"out_mb_per_s", busy * found->out * 1e-6}};
  const Json object = {{"sample", found->sample},
                       {"garment_cpu_s", found->alone},
                       {"garment_clock_s", found->clock},
                       {"garments_per_core_hour", 3600 / found->alone},
                       {"processors", found->processors},
                       {"garment_cpu_s_beside_others", found->beside},
                       {"garments_per_core_hour_beside_others", 3600 / found->beside},
                       {"largest_process_mb", found->megabytes},
                       {"serial", serial},
                       {"bytes_per_garment", {{"manifest", found->manifest}, {"in", found->in}, {"out", found->out}}},
                       {"model", model}};
  program.console.answer(object, throughputWords(*found, options.garments, cores, program.console));
  return kDone;
}

int runSubmit(Program& program, const SubmitOptions& options) {
  const auto plan = readPlan(options.folder);
  if (!plan) return program.console.refuse(plan.error());
  if (const Done same = madeByThisProgram(*plan); !same) return program.console.refuse(same.error());
  const auto job = submitToSlurm(options.folder, *plan, options.wish);
  if (!job) return program.console.refuse(job.error());
  program.console.answer({{"job", *job}}, program.console.said(say("Submitted as job {0}.", *job)));
  return kDone;
}

}  // namespace

void addBatchVerbs(Program& program) {
  CLI::App* batch = Program::word(program.cli, "batch", help("Makes garments for many people at once"));
  batch->require_subcommand(1);

  auto plan = std::make_shared<PlanOptions>();
  CLI::App* verb = program.verb(*batch, "plan", help("Plans every design on every body, into a folder"), plan, runPlan);
  verb->add_option("designs", plan->wish.designs, help("A document, a script, or a folder of them"))->required();
  verb->add_option("bodies", plan->wish.bodies, help("A table of measures (CSV): name,height_cm,bust_girth_cm,…"))
      ->required();
  program.outputFolder(*verb, "-o,--output", plan->wish.folder, help("The folder of the batch"))->required();
  verb->add_option("--fabric", plan->wish.fabrics, help("A fabric for all pieces; several: the batch has each"));
  verb->add_option("--spacing", plan->spacing,
                   help("Between the lattice's threads, in place of the designs' own: 20mm"));

  const Message attempts = say("At an item that crashes or lacks memory");
  const Message retry =
      say("Also those that crashed or lacked memory before, or ran out of less time than --seconds gives now");
  auto run = std::make_shared<RunOptions>();
  verb = program.verb(*batch, "run", help("Does what a batch has not done yet"), run, runRun);
  verb->add_option("folder", run->folder, help("The folder of the batch"))->required();
  verb->add_option("--shard", run->shard, help("Only a part of it: 2/5 is the second of five"));
  verb->add_option("--jobs", run->wish.jobs, help("How many items at a time, each in a process of its own"))
      ->check(CLI::Range(1, 256));
  verb->add_option("--threads", run->threads, help("How many threads work, 1 to 256; the result is the same"))
      ->check(CLI::Range(1, 256));
  verb->add_option("--seconds", run->wish.seconds, help("How long an item may take"))->check(CLI::Range(1, 86400));
  verb->add_option("--attempts", run->wish.attempts, help(attempts))->check(CLI::Range(1, 100));
  verb->add_flag("--retry", run->wish.retry, help(retry));

  auto merge = std::make_shared<MergeOptions>();
  verb = program.verb(*batch, "merge", help("Writes what came of it: one table (CSV, SQLite)"), merge, runMerge);
  verb->add_option("folder", merge->folder, help("The folder of the batch"))->required();

  auto fit = std::make_shared<FitOptions>();
  verb = program.verb(*batch, "report", help("Writes the fit over all people, and whom it does not fit (PDF)"), fit,
                      runFitReport);
  verb->add_option("folder", fit->folder, help("The folder of the batch"))->required();
  program.output(*verb, "-o,--output", fit->out, help("The PDF file"), {"pdf"})->required();
  verb->add_option("--language", fit->language, help("en or ja; else the language spoken here"))
      ->transform(oneOf({"en", "ja"}));

  auto people = std::make_shared<PeopleOptions>();
  verb = program.verb(*batch, "picture",
                      help("Draws everyone in the garment side by side, and marks whom it does not fit"), people,
                      runPeople);
  verb->add_option("folder", people->folder, help("The folder of the batch"))->required();
  program.output(*verb, "-o,--output", people->out, help("The PNG file"), {"png"})->required();
  verb->add_flag("--misfits", people->misfits, help("Only whom it does not fit, the worst first"));
  verb->add_option("--person", people->people, help("Only these people, by name"));
  verb->add_option("--design", people->designs, help("Only these designs, by name"));
  verb->add_option("--view", people->view, help("front, back, left, right, oblique"));
  verb->add_option("--map", people->map, help("none, strain, pressure"));
  verb->add_option("--size", people->size, help("WIDTHxHEIGHT in pixels, of each figure where there are several"));

  auto throughput = std::make_shared<ThroughputOptions>();
  verb =
      program.verb(*batch, "throughput",
                   help("Measures how many garments are made in an hour, and tells what many processors would bring"),
                   throughput, runThroughput);
  verb->add_option("designs", throughput->wish.batch.designs, help("A document, a script, or a folder of them"))
      ->required();
  verb->add_option("bodies", throughput->wish.batch.bodies,
                   help("A table of measures (CSV): name,height_cm,bust_girth_cm,…"))
      ->required();
  verb->add_option("--fabric", throughput->wish.batch.fabrics,
                   help("A fabric for all pieces; several: the batch has each"));
  verb->add_option("--spacing", throughput->spacing,
                   help("Between the lattice's threads, in place of the designs' own: 20mm"));
  verb->add_option("--sample", throughput->wish.sample, help("How many garments are made to measure"))
      ->check(CLI::Range(1, 10'000));
  verb->add_option("--seconds", throughput->wish.seconds, help("How long an item may take"))
      ->check(CLI::Range(1, 86400));
  verb->add_option("--garments", throughput->garments, help("Of the batch that is reckoned with"))
      ->check(CLI::Range(1, 1'000'000'000));
  verb->add_option("--cores", throughput->cores, help("Processors that are reckoned with"))
      ->check(CLI::Range(1, 10'000'000));

  auto submit = std::make_shared<SubmitOptions>();
  verb = program.verb(*batch, "submit", help("Hands a batch to a cluster"), submit, runSubmit);
  verb->add_option("folder", submit->folder, help("The folder of the batch"))->required();
  verb->add_flag("--slurm", submit->slurm, help("To Slurm, as an array of jobs"))->required();
  verb->add_option("--shards", submit->wish.shards, help("In how many jobs; otherwise one for 50 items"))
      ->check(CLI::Range(1, 100'000));
  verb->add_option("--threads", submit->wish.threads, help("Processors of one job"))->check(CLI::Range(1, 256));
  verb->add_option("--seconds", submit->wish.seconds, help("How long an item may take"))->check(CLI::Range(1, 86400));
  verb->add_option("--attempts", submit->wish.attempts, help(attempts))->check(CLI::Range(1, 100));
  verb->add_flag("--retry", submit->wish.retry, help(retry));
  verb->add_option("--partition", submit->wish.partition, help("Slurm's partition"));
  verb->add_option("--time", submit->wish.time, help("A job's limit of time, as Slurm takes it: 2:00:00"));

  // What the children of run are; nobody calls it by hand.
  auto item = std::make_shared<ItemOptions>();
  verb = program.verb(*batch, "item", "", item, runOneItem);
  verb->group("");
  verb->add_option("folder", item->folder)->required();
  verb->add_option("key", item->key)->required();
  verb->add_option("--threads", item->threads)->check(CLI::Range(1, 256));
}

}  // namespace karinui::app

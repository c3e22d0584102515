// bench: measures the drape engine on scenes that others were measured on too.
#include <algorithm>
#include <fstream>
#include <numeric>

#include "bench/cusick.h"
#include "bench/edits.h"
#include "bench/energy_plot.h"
#include "bench/foreign.h"
#include "bench/run.h"
#include "bench_wardrobe.h"
#include "bench_words.h"
#include "commands.h"
#include "drape_picture.h"
#include "json_answers.h"
#include "karinui/base/file.h"
#include "karinui/base/hash.h"
#include "karinui/exchange/spatial.h"

namespace karinui::app {

namespace {

struct BenchOptions {
  std::string scene, out, data = "../shared", fabric, pictures, start, plot;
  std::vector<std::string> judged;
  std::size_t vertices = 0;
  int threads = 1, runs = 0;
  double stretch = 0;  // N/m; 0: as the scene has it
  std::string scripts;
  std::vector<std::string> only;
  double seconds = 60;
  bool continued = false;
};

Result<bench::Workload> withStretch(bench::Workload load, double stretch) {
  if (stretch > 0)
    for (ClothLevel& level : load.levels)
      for (ClothPiece& piece : level.cloth.pieces) piece.fabric.stretchWarp = piece.fabric.stretchWeft = stretch;
  return load;
}

Result<bench::Workload> workloadOf(const BenchOptions& options, Workers& workers, const Token& token) {
  if (options.scene == "w1") return withStretch(bench::curtain(options.vertices), options.stretch);
  if (options.scene == "w2") return withStretch(bench::sphere(options.vertices), options.stretch);
  if (options.scene == "w3") return withStretch(bench::tunic(options.vertices), options.stretch);
  const std::filesystem::path data = options.data;
  const char* pattern = options.scene == "shirt" ? "shirt_mean_specification.json" : "dress_pencil_specification.json";
  return bench::garment(options.scene, {data / "patterns" / "garmentcode" / pattern, data / "bodies" / "f_eu38.obj"},
                        options.vertices, workers, token);
}

void addClearance(Json& object, const bench::Examined& found) {
  if (found.check.finite && found.clearance < 1)  // none where there is no body
    object["clearance_mm"] = found.clearance * 1000;
}

Json findingJson(const bench::Workload& load, const bench::Finding& found, int threads, const Console& console) {
  Json object = {{"scene", load.name}, {"threads", threads}};
  object.update(settleJson(found.report, Examination{found.found.check, {}, {}}, console));
  addClearance(object, found.found);
  object["fine_steps"] = found.report.fineSteps;
  object["fine_solves"] = found.report.fineSolves;
  if (found.report.continuation) object["continuation"] = continuationJson(found.report);
  object["hash"] = Hasher().add(std::span<const Vec3>(load.levels.back().state.position)).hex();  // of where it rests
  for (const ContactTime& time : found.report.contactTimes) object["contact_seconds"][time.name] = time.seconds;
  object["drift_mm"] = found.after.drift * 1000;
  object["first_top_speed_mm_s"] = found.after.firstTopSpeed * 1000;
  object["top_speed_mm_s"] = found.after.topSpeed * 1000;
  return object;
}

Done writeScene(const bench::Workload& load, const std::string& path) {
  SpatialGarment garment;
  if (load.body) garment.body = load.body->mesh();
  const ClothLevel& finest = load.levels.back();
  for (const ClothPiece& piece : finest.cloth.pieces) {
    const auto first = finest.state.position.begin() + piece.firstNode;
    TriangleMesh mesh{{first, first + static_cast<std::ptrdiff_t>(piece.lattice->nodes.size())}, piece.lattice->faces};
    garment.pieces.push_back({piece.name, piece.fabric.name, std::move(mesh), piece.lattice->nodes});
  }
  const auto bytes = writeObj(garment);
  if (!bytes) return bytes.error();
  return writeFile(path, *bytes);
}

// Each preset of woven law (or the one asked for) laid several times on the drape tester.
int runCusick(Program& program, const BenchOptions& options) {
  Workers workers(options.threads);
  std::vector<Fabric> fabrics;
  if (!options.fabric.empty()) {
    const auto one = preset(options.fabric);
    if (!one) return program.console.refuse(one.error());
    fabrics = {*one};
  } else {
    for (const Fabric& fabric : presets())
      if (fabric.law == Fabric::Law::Woven) fabrics.push_back(fabric);
  }
  std::unique_ptr<Picture> picture;
  if (!options.pictures.empty()) {
    auto opened = Picture::open();
    if (!opened) return program.console.refuse(opened.error());
    picture = *std::move(opened);
  }
  const int runs = options.runs > 0 ? options.runs : 6;
  Json list = Json::array();
  std::vector<TestedFabric> tested;
  bool settled = true;
  for (const Fabric& fabric : fabrics) {
    std::vector<double> found;
    std::vector<int> folds;
    double seconds = 0;
    for (int seed = 0; seed < runs; ++seed) {
      const auto draped =
          bench::cusick(fabric, options.vertices, static_cast<unsigned>(seed), workers, program.console.token());
      if (!draped) return program.console.refuse(draped.error());
      settled = settled && draped->report.settled;
      found.push_back(draped->coefficient);
      folds.push_back(draped->folds);
      seconds += draped->report.cpuSeconds;
      if (picture && seed == 0) {
        const auto image = drapePicture(*picture, *draped, 192);
        if (!image) return program.console.refuse(image.error());
        const auto file = std::filesystem::path(options.pictures) / (fabric.name + ".png");
        if (const Done kept = writePng(file.string(), *image); !kept) return program.console.refuse(kept.error());
      }
      if (!options.out.empty()) {
        const bench::Workload load{"cusick", {draped->disc}, nullptr, nullptr};
        if (const Done written = writeScene(load, options.out); !written)
          return program.console.refuse(written.error());
      }
    }
    const auto [low, high] = std::minmax_element(found.begin(), found.end());
    const double mean = std::accumulate(found.begin(), found.end(), 0.0) / runs;
    std::sort(folds.begin(), folds.end());
    const auto threads = [](const ThreadCurve& c) {
      return Json{{"strain_at_490_n_m", c.strainAt(490.3)}, {"linearity", c.linearity(490.3)}};
    };
    tested.push_back({fabric, mean, *low, *high, folds[folds.size() / 2], seconds});
    list.push_back({{"fabric", fabric.name},
                    {"drape_coefficient", mean},
                    {"listed", drapeFigure(fabric).value_or(DrapeFigure{}).coefficient},
                    {"lowest", *low},
                    {"highest", *high},
                    {"folds", folds[folds.size() / 2]},
                    {"warp", threads(fabric.warpCurve())},
                    {"weft", threads(fabric.weftCurve())},
                    {"cpu_s", seconds}});
  }
  const Json object{{"scene", "cusick"}, {"settled", settled}, {"runs", runs}, {"fabrics", list}};
  program.console.answer(object, testerWords(tested, settled, runs, program.console));
  return settled ? kDone : kNotSettled;
}

// What a person waits for after an edit of the tunic, by the clock.
int runEdits(Program& program, const BenchOptions& options) {
  const int runs = options.runs > 0 ? options.runs : 5;
  const auto found = bench::edits(options.vertices, runs, options.threads, program.console.token());
  if (!found) return program.console.refuse(found.error());
  const auto ms = [](const std::vector<double>& seconds) {
    return Json{{"median", 1000 * bench::percentile(seconds, 0.5)}, {"p95", 1000 * bench::percentile(seconds, 0.95)}};
  };
  Json list = Json::array();
  std::size_t unsettled = 0;
  for (const bench::EditTimes& edit : found->edits) {
    unsettled += edit.unsettled;
    list.push_back({{"edit", edit.name},
                    {"first_picture_ms", ms(edit.first)},
                    {"within_2_mm_ms", ms(edit.within2mm)},
                    {"settled_ms", ms(edit.rest)},
                    {"unsettled", edit.unsettled},
                    {"undraped", edit.undraped},
                    {"steps", edit.last.steps},
                    {"strain_mean", edit.last.strain.mean},
                    {"strain_max", edit.last.strain.max},
                    {"penetration_mm", edit.last.penetration * 1000},
                    {"seam_gap_mm", edit.last.seamGap * 1000},
                    {"cloth_cloth_crossings", edit.crossings}});
  }
  const Json object{
      {"scene", "edits"}, {"threads", options.threads},         {"vertices", found->vertices}, {"runs", runs},
      {"edits", list},    {"pull_step_ms", ms(found->pullStep)}};
  program.console.answer(object, editWords(*found, options.threads, runs, program.console));
  return unsettled == 0 ? kDone : kNotSettled;
}

// What another program made of the scene.
int runJudge(Program& program, const BenchOptions& options, bench::Workload& load) {
  const auto judged = bench::judge(load, {options.judged.begin(), options.judged.end()});
  if (!judged) return program.console.refuse(judged.error());
  Json object = {{"scene", load.name}};
  object.update(checkJson(Examination{judged->found.check, {}, {}}));
  addClearance(object, judged->found);
  object["height_m"] = judged->height;
  object["drift_mm"] = judged->drift * 1000;
  object["top_speed_mm_s"] = judged->topSpeed * 1000;
  program.console.answer(object, judgedWords(load, *judged, program.console));
  return kDone;
}

int writeStart(Program& program, const BenchOptions& options, const bench::Workload& load) {
  const auto scene = bench::startOf(load);
  if (!scene) return program.console.refuse(scene.error());
  if (const Done written = writeFile(options.start, *scene); !written) return program.console.refuse(written.error());
  return kDone;
}

// The garments of a folder, or those of them that are asked for.
int runWardrobe(Program& program, const BenchOptions& options) {
  const auto folder = options.scripts.empty() ? std::filesystem::path(options.data) / "wardrobe"
                                              : std::filesystem::path(options.scripts);
  return benchWardrobe(program, {folder, options.only, options.seconds, options.threads, options.continued});
}

int runBench(Program& program, const BenchOptions& options) {
  if (options.scene == "wardrobe") return runWardrobe(program, options);
  if (options.scene == "cusick") return runCusick(program, options);
  if (options.scene == "edits") return runEdits(program, options);
  Workers workers(options.threads);
  auto load = workloadOf(options, workers, program.console.token());
  if (!load) return program.console.refuse(load.error());
  if (!options.start.empty()) return writeStart(program, options, *load);
  if (!options.judged.empty()) return runJudge(program, options, *load);
  const bool continued = options.continued || !options.plot.empty();
  const auto found = bench::run(*load, program.console.token(), workers, continued);
  if (!found) return program.console.refuse(found.error());
  if (!options.plot.empty())
    if (const Done written = writeFile(options.plot, bench::energyPlot(load->name, found->report)); !written)
      return program.console.refuse(written.error());
  if (!options.out.empty())
    if (const Done written = writeScene(*load, options.out); !written) return program.console.refuse(written.error());
  const Json object = findingJson(*load, *found, options.threads, program.console);
  program.console.answer(
      object, findingWords(*load, *found, options.threads, object["hash"].get<std::string>(), program.console));
  return found->report.settled ? kDone : kNotSettled;
}

}  // namespace

void addBenchVerb(Program& program) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* verb = program.verb(program.cli, "bench", help("Measures how fast and how well a scene comes to rest"),
                                options, runBench);
  verb->add_option(
          "scene", options->scene,
          help("w1 a curtain, w2 a cloth on a ball, w3 a tunic on capsules, shirt or dress on a body, edits of the "
               "tunic by the clock, cusick the shop's fabrics on the drape tester, wardrobe every garment of a folder"))
      ->required()
      ->transform(oneOf({"w1", "w2", "w3", "shirt", "dress", "edits", "cusick", "wardrobe"}));
  verb->add_option("--vertices", options->vertices, help("About how many points the cloth has; otherwise as defined"))
      ->check(CLI::Range(100, 1'000'000));
  verb->add_option("--stretch", options->stretch, help("w1, w2, w3: how firm the threads are, N/m; otherwise 1000"))
      ->check(CLI::Range(10, 100'000));
  verb->add_option("--threads", options->threads, help("How many threads work, 1 to 256; the result is the same"))
      ->check(CLI::Range(1, 256));
  verb->add_option("--data", options->data,
                   help("The folder with bodies/ and patterns/ for shirt and dress, and wardrobe/"));
  verb->add_option("--scripts", options->scripts, help("wardrobe: the folder of its scripts, one garment each"));
  verb->add_option("--only", options->only, help("wardrobe: the garments to drape, by name; otherwise all"));
  verb->add_option("--seconds", options->seconds,
                   help("wardrobe: how much processor time a garment is given; otherwise 60"))
      ->check(CLI::Range(0.1, 3600.0));
  verb->add_option("--fabric", options->fabric, help("cusick: one fabric of the shop; otherwise all"));
  verb->add_option("--runs", options->runs,
                   help("How many times each fabric is laid on (cusick, otherwise 6) or each edit made (otherwise 5)"))
      ->check(CLI::Range(1, 1000));
  program
      .outputFolder(*verb, "--pictures", options->pictures,
                    help("cusick: a folder to keep a picture of each fabric on the tester in"))
      ->check(CLI::ExistingDirectory);
  program.output(*verb, "--start", options->start,
                 help("w1, w2, w3: write the scene as it starts as JSON for another program, and settle nothing"),
                 {"json"});
  verb->add_option("--judge", options->judged,
                   help("w1, w2, w3: examine what another program made of the scene, an OBJ file or several, 1/60 s "
                        "apart, and settle nothing"));
  verb->add_flag(
      "--continue", options->continued,
      help("w1, w2, w3, shirt, dress, wardrobe: go on from rest for five times as many steps, at least 500, and tell "
           "how far that leads"));
  program.output(*verb, "--plot", options->plot,
                 help("The same, and draw the energy against processor time as an SVG file"), {"svg"});
  program.output(*verb, "-o,--out", options->out, help("Write the cloth at rest as an OBJ file"), {"obj"});
}

}  // namespace karinui::app

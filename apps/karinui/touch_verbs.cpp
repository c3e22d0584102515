// touch check, touch replay: what this machine can do for a hand, and what a recorded hand would feel.
#include <algorithm>
#include <chrono>
#include <optional>
#include <sstream>
#include <thread>

#include "commands.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/body/sizes.h"
#include "karinui/devices/hd_stylus.h"
#include "karinui/devices/inverse3.h"
#include "karinui/devices/pose_source.h"
#include "karinui/devices/simulated_device.h"
#include "karinui/devices/simulated_inverse3.h"
#include "karinui/devices/space_mouse.h"
#include "karinui/haptics/stepped_driver.h"
#include "karinui/session/touch_scene_of.h"
#include "karinui/touch/servo.h"

namespace karinui::app {

namespace {

struct CheckOptions {
  double seconds = 60;
  bool ordinary = false;
};

struct ReplayOptions {
  std::string recording, document, tool, pull = "curve", csv;
  double every = 10, gain = 0.5, limit = 3;
};

std::string micro(double seconds) { return fixed(seconds * 1e6, 0) + " µs"; }

struct Found {
  std::string kind, name;  // name: empty where it is not there
  Message note;
};

std::vector<Found> devicesHere() {
  std::vector<Found> found;
  const auto haply = Inverse3::connect();
  found.push_back({"inverse3", haply ? (*haply)->record().name : "",
                   haply ? say("found; not yet tried on hardware by us") : haply.error().what});
  const auto stylus = HdStylus::open();
  found.push_back({"touch", stylus ? (*stylus)->record().name : "",
                   stylus ? say("found; not yet tried on hardware by us") : stylus.error().what});
  const auto cap = SpaceMouse::open();
  found.push_back({"space_mouse", cap ? (*cap)->record().name : "",
                   cap ? say("found; without a motor; in the studio it moves what you look at") : cap.error().what});
  found.push_back({"simulated", simulatedRecord().name, say("always there; the loop is measured with it")});
  return found;
}

// Up and down, and round, about the armpit of a mannequin: through free air and against the skin.
Vec3 aimAbout(Vec3 middle, double t) {
  return middle + Vec3{0.03 * std::cos(2 * t), 0.04 * std::sin(1.3 * t), 0.03 * std::sin(2 * t)};
}

// Seconds that something took: half of the time, and at most in 99 %.
struct Took {
  double p50 = 0, p99 = 0;
  Took() = default;
  Took(double half, double most) : p50(half), p99(most) {}
  explicit Took(const LatencyHistogram& seen) : p50(seen.quantile(0.5)), p99(seen.quantile(0.99)) {}
};

struct Measured {
  Servo::Report report;
  double p50 = 0, p99 = 0, p999 = 0, longest = 0;
  Took evaluation, sceneMade, sceneAge, roundTrip;
  std::size_t facets = 0;
  double newtons = 0;
};

// There and back through the service of an Inverse3, simulated on this computer: the loopback interface, WebSocket and
// JSON as the maker's service has them, but neither USB nor the device's own electronics.
Result<Took> measuredRoundTrip(const Token& token) {
  constexpr int kTrips = 2000;
  SimulatedInverse3 service([](double) { return Vec3{}; });
  const auto device = Inverse3::connect(service.port());
  if (!device) return device.error();
  LatencyHistogram seen;
  for (int k = 0; k < kTrips; ++k) {
    if (token.cancelled()) return cancelled();
    const double sent = Servo::clock();
    (*device)->apply({});
    const HandSample hand = (*device)->sample();
    if (hand.ready) seen.add(Servo::clock() - sent);
  }
  (*device)->stop();
  return Took(seen);
}

Result<Measured> measured(Program& program, const CheckOptions& options) {
  const auto size = builtInSize("jis9ar");
  if (!size) return size.error();
  Workers workers(program.threads);
  const Token& token = program.console.token();
  const Result<BodyPtr> body = makeMannequin(*size, workers, token);
  if (!body) return body.error();
  const SnapshotPtr fitting = snapshotOf({}, *body);
  const auto landmark = (*body)->landmarks().find("armpit_left");
  const Vec3 middle = landmark != (*body)->landmarks().end() ? landmark->second : Vec3{0.18, 1.25, 0};

  Measured result;
  const Result<Took> roundTrip = measuredRoundTrip(token);
  if (!roundTrip) return roundTrip.error();
  result.roundTrip = *roundTrip;
  LatencyHistogram made;
  SimulatedDevice device([middle](double t) { return aimAbout(middle, t); });
  Servo servo(device, {}, !options.ordinary);
  using Clock = std::chrono::steady_clock;
  const auto began = Clock::now(),
             ends = began + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
  for (auto next = began; Clock::now() < ends;) {
    if (token.cancelled()) return cancelled();
    const ServoTick tick = servo.last();
    const Vec3 tip = tick.hand.ready ? tick.hand.tip.carry : aimAbout(middle, 0);
    const double asked = Servo::clock();
    auto scene = std::make_unique<TouchScene>(touchSceneOf(*fitting, tip));
    made.add(Servo::clock() - asked);
    result.facets = std::max(result.facets, scene->facets.size());
    result.newtons = std::max(result.newtons, length(tick.out.force));
    servo.publish(std::move(scene));
    token.progress(std::chrono::duration<double>(Clock::now() - began).count() / options.seconds,
                   say("Measuring the force loop"));
    std::this_thread::sleep_until(next += std::chrono::milliseconds(16));
  }
  result.report = servo.report();
  result.p50 = servo.lateness().quantile(0.5);
  result.p99 = servo.lateness().quantile(0.99);
  result.p999 = servo.lateness().quantile(0.999);
  result.longest = servo.lateness().longest();
  result.evaluation = Took(servo.evaluation());
  result.sceneAge = Took(servo.sceneAge());
  result.sceneMade = Took(made);
  return result;
}

// From the hand to its force. A device is told the force of the tick before and answers meanwhile, so that a place is
// as old as the tick is long when it is felt, or as the round trip where that is longer.
Took handToForce(const Measured& m) {
  constexpr double kTick = 0.001;
  return {m.p50 + std::max(kTick, m.roundTrip.p50) + m.evaluation.p50,
          m.p99 + std::max(kTick, m.roundTrip.p99) + m.evaluation.p99};
}

// From what the session shows to its force.
Took sceneToForce(const Measured& m) {
  return {m.sceneMade.p50 + m.sceneAge.p50 + m.evaluation.p50, m.sceneMade.p99 + m.sceneAge.p99 + m.evaluation.p99};
}

Json inMicroseconds(const Took& took) { return {{"p50", took.p50 * 1e6}, {"p99", took.p99 * 1e6}}; }

Message promise(const Measured& m) {
  const bool seldomLate = m.report.late * 5000 < m.report.ticks;
  if (m.report.realTime && m.p999 <= 200e-6 && seldomLate)
    return say("Force at 1 kHz can be relied on here, as measured.");
  if (m.p99 <= 1e-3)
    return say("Force works here, but the loop is woken late at times, which may be felt as roughness.");
  return say("This machine is too busy for force: expect it to be rough, and to fade out at times.");
}

int runCheck(Program& program, const CheckOptions& options) {
  const Console& console = program.console;
  const std::vector<Found> devices = devicesHere();
  const Result<Measured> m = measured(program, options);
  if (!m) return console.refuse(m.error());
  Json object;
  std::string words = console.said(say("Devices")) + "\n";
  for (const Found& one : devices) {
    object["devices"].push_back(
        {{"kind", one.kind}, {"found", !one.name.empty()}, {"name", one.name}, {"note", console.said(one.note)}});
    words += "  " + (one.name.empty() ? one.kind : one.name) + ": " + console.said(one.note) + "\n";
  }
  object["seconds"] = options.seconds;
  object["real_time"] = m->report.realTime;
  object["ticks"] = m->report.ticks;
  object["late_ticks"] = m->report.late;
  object["page_faults"] = m->report.pageFaults;
  object["lateness_us"] = {
      {"p50", m->p50 * 1e6}, {"p99", m->p99 * 1e6}, {"p99.9", m->p999 * 1e6}, {"max", m->longest * 1e6}};
  object["evaluation_us"] = inMicroseconds(m->evaluation);
  object["latency_us"] = {
      {"servo_wake_up", inMicroseconds({m->p50, m->p99})}, {"device_round_trip", inMicroseconds(m->roundTrip)},
      {"scene_made", inMicroseconds(m->sceneMade)},        {"scene_age", inMicroseconds(m->sceneAge)},
      {"evaluation", inMicroseconds(m->evaluation)},       {"hand_to_force", inMicroseconds(handToForce(*m))},
      {"scene_to_force", inMicroseconds(sceneToForce(*m))}};
  object["facets"] = m->facets;
  object["most_force_n"] = m->newtons;
  object["promise"] = console.said(promise(*m));
  const auto line = [&](const Message& what) { words += "  " + console.said(what) + "\n"; };
  words += console.said(say("The force loop, measured for {0} s at 1 kHz", shortest(options.seconds))) + "\n";
  line(m->report.realTime ? say("Real-time scheduling: permitted")
       : options.ordinary ? say("Real-time scheduling: not asked for")
                          : say("Real-time scheduling: not permitted (see docs/user/touch.md)"));
  line(say("Late by: {0} half of the time, {1} at most in 99 %, {2} in 99.9 %, {3} at worst", micro(m->p50),
           micro(m->p99), micro(m->p999), micro(m->longest)));
  line(say("Ticks late by more than 1 ms: {0} of {1}", std::size_t(m->report.late), std::size_t(m->report.ticks)));
  line(say("Evaluating a scene of up to {0} {0|triangle|triangles}: {1} half of the time, {2} at most in 99 %",
           m->facets, micro(m->evaluation.p50), micro(m->evaluation.p99)));
  const auto budget = [&](const Message& what, const Took& took) {
    line(say("{0}: {1} half of the time, {2} at most in 99 %", what, micro(took.p50), micro(took.p99)));
  };
  budget(say("There and back through an Inverse3 service on this computer, simulated"), m->roundTrip);
  budget(say("Making a scene of the garment"), m->sceneMade);
  budget(say("Age of the scene that is felt"), m->sceneAge);
  budget(say("From the hand to its force, one tick and the above"), handToForce(*m));
  words += console.said(promise(*m)) + "\n";
  words += console.said(say("Whatever the machine does, the force stays within its limits and never steps.")) + "\n";
  console.answer(object, words);
  return kDone;
}

constexpr std::array kStates{"waiting", "ramping", "armed", "fading", "off"};
constexpr std::array kFaults{"",      "not finite", "jump",   "speed",    "late",
                             "stale", "not ready",  "clutch", "no focus", "off"};

// What the hand does while its button is down.
constexpr std::array kHandTools{std::pair("touch", Command::Select),   std::pair("draw", Command::Draw),
                                std::pair("move", Command::Move),      std::pair("sew", Command::Sew),
                                std::pair("cut", Command::Cut),        std::pair("pull", Command::Pull),
                                std::pair("reshape", Command::Reshape)};

struct HeldTool {
  double seconds = 0;  // of the recording
  Command tool = Command::Select;
};

// What the lines "tool pull" of a recording say, each from the next place of the hand on.
Result<std::vector<HeldTool>> toolsIn(const std::string& recorded) {
  std::vector<HeldTool> held;
  std::istringstream lines(recorded);
  std::optional<Command> now;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::string first, name;
    words >> first >> name;
    if (first == "tool") {
      const auto all = commands();
      const auto known = std::find_if(all.begin(), all.end(),
                                      [&](const CommandInfo& one) { return one.name == name && isTool(one.command); });
      if (known == all.end()) return badInput(say("Line {0}: there is no tool “{1}”.", number, name.substr(0, 40)));
      now = known->command;
    } else if (const auto sample = parsePointerSample(line); now && sample && sample->tip) {
      held.push_back({sample->seconds, *std::exchange(now, std::nullopt)});
    }
  }
  return held;
}

constexpr const char* kCsvHead =
    "time_s,tip_x_m,tip_y_m,tip_z_m,proxy_x_m,proxy_y_m,proxy_z_m,force_x_n,force_y_n,force_z_n\n";
std::string csvRow(double seconds, Vec3 tip, Vec3 proxy, Vec3 force) {
  std::string row = fixed(seconds, 3);
  for (const Vec3 v : {tip, proxy, force})
    for (const double number : {v.x, v.y, v.z}) row += "," + shortest(number);
  return row + "\n";
}

// What the forces are that were told, in the words of a person who is to compare them.
std::string forceSaid(const Program& program, const ReplayOptions& options, const ServoSettings& settings, bool pulls) {
  const double limit = std::min(settings.limit, settings.nominalShare * simulatedRecord().force);
  std::string words =
      program.console.said(say("The force is what the device gives: times the gain of {0}, at most {1} N.",
                               shortest(settings.gain), fixed(limit, 2))) +
      "\n";
  if (pulls && options.pull == "curve")
    words +=
        program.console.said(
            say("Pulled cloth is felt as a strip of its fabric, 2 cm wide and 10 cm long, that is stretched from where "
                "it was taken to the hand. The cloth does not follow meanwhile; the step pull of karinui do drapes it "
                "and tells the force of cloth that has (max_force_n).")) +
        "\n";
  return words;
}

int runReplay(Program& program, const ReplayOptions& options) {
  constexpr double kRest = 2, kScene = 0.016;  // seconds in which the force is armed; from scene to scene
  const Result<std::string> recorded = readFile(options.recording);
  if (!recorded) return program.console.refuse(recorded.error());
  Result<ScriptedDevice> hand =
      ScriptedDevice::read(*recorded, simulatedRecord(), SteppedDriver::kTick, kRest + SteppedDriver::kTick);
  if (!hand) return program.console.refuse(hand.error());
  auto tools = toolsIn(*recorded);
  if (!tools) return program.console.refuse(tools.error());
  MemoryBlobs none;
  Workers workers(program.threads);
  Bodies bodies;
  Context how{workers, program.console.token(), none, bodies, {}, {}};
  Result<DocumentFile> file = DocumentFile::openForReading(options.document, &how);
  if (!file) return program.console.refuse(file.error());
  // The hand works at a session of its own. No step of it is written, and none is draped: what the hand does is asked
  // about, not what comes of it.
  SessionOptions quiet;
  quiet.threads = program.threads;
  quiet.autoSettle = false;
  quiet.drape = [](const Document&, const DrapePieces&, Context&) { return Result<DrapeOutcome>(cancelled()); };
  quiet.pull = [](const Document&, const PullCloth&, Context&) { return Result<DrapeOutcome>(cancelled()); };
  Session session(quiet);
  session.begin(*std::move(file));
  session.finish();
  if (!options.tool.empty()) tools->clear();
  for (const auto& [name, tool] : kHandTools)
    if (options.tool == name) session.command(tool);
  const bool pulls = options.tool == "pull" || std::any_of(tools->begin(), tools->end(), [](const HeldTool& one) {
                       return one.tool == Command::Pull;
                     });
  auto next = tools->begin();
  ServoSettings settings;
  settings.gain = options.gain;
  settings.limit = options.limit;
  settings.laws.pull = options.pull == "springs" ? PullLaw::Springs : PullLaw::Curve;
  SteppedDriver driver(session, *hand, settings);
  Json ticks = Json::array();
  std::string words, rows = kCsvHead;
  double most = 0;
  const double begins = hand->begins();
  const auto ends = std::lround((hand->ends() - begins + kRest) / SteppedDriver::kTick) + 1;
  const auto every = static_cast<long>(std::max(1.0, options.every)),
             before = std::lround(kRest / SteppedDriver::kTick), scene = std::lround(kScene / SteppedDriver::kTick);
  for (long k = 0; k < ends; ++k) {
    if (program.console.token().cancelled()) return program.console.refuse(cancelled());
    const double seconds = begins + static_cast<double>(k - before) * SteppedDriver::kTick;
    for (; next != tools->end() && next->seconds <= seconds; ++next) session.command(next->tool);
    const ServoTick tick = driver.tick();
    if (k % scene == 0) driver.publish();
    if (k < before) continue;
    const Vec3 f = tick.out.force, p = tick.hand.tip.carry;
    const double newtons = length(f);
    most = std::max(most, newtons);
    if (k % every != 0) continue;
    const Vec3 proxy = tick.touching ? tick.proxy : p;
    rows += csvRow(seconds, p, proxy, f);
    const char *state = kStates[static_cast<std::size_t>(tick.state)],
               *fault = kFaults[static_cast<std::size_t>(tick.fault)];
    ticks.push_back({{"seconds", seconds},
                     {"tip", {p.x, p.y, p.z}},
                     {"proxy", {proxy.x, proxy.y, proxy.z}},
                     {"force", {f.x, f.y, f.z}},
                     {"newtons", newtons},
                     {"touching", tick.touching},
                     {"state", state},
                     {"fault", fault}});
    words += fixed(seconds, 3) + " s  " + fixed(newtons, 3) + " N  " + state + "\n";
  }
  words +=
      program.console.said(say("At most {0} N", fixed(most, 2))) + "\n" + forceSaid(program, options, settings, pulls);
  Json answer = {{"most_newtons", most}, {"ticks", std::move(ticks)}};
  if (!options.csv.empty()) {
    if (const Done done = writeFile(options.csv, rows); !done) return program.console.refuse(done.error());
    answer["file"] = options.csv;
    words = options.csv + "\n";
  }
  program.console.answer(answer, words);
  return kDone;
}

}  // namespace

void addTouchVerbs(Program& program) {
  CLI::App* touch = Program::word(program.cli, "touch", help("Force feedback: what this machine can do, what is felt"));
  touch->require_subcommand(1);
  auto check = std::make_shared<CheckOptions>();
  CLI::App* verb =
      program.verb(*touch, "check", help("Lists force-feedback devices and measures the force loop"), check, runCheck);
  verb->add_option("--seconds", check->seconds, help("How long it is measured, 0.1 to 3600"))
      ->check(CLI::Range(0.1, 3600.0));
  verb->add_flag("--ordinary", check->ordinary, help("Do not ask for real-time scheduling"));

  auto replay = std::make_shared<ReplayOptions>();
  verb = program.verb(*touch, "replay", help("Plays a recorded hand against a document and tells what it feels"),
                      replay, runReplay);
  verb->add_option("recording", replay->recording, help("The recorded hand: pointer lines that have a tip"))
      ->required();
  verb->add_option("document", replay->document, help("The .karinui document"))->required();
  verb->add_option("--tool", replay->tool,
                   help("What the hand does while its button is down: touch, draw, move, sew, cut, pull or reshape "
                        "(otherwise what the recording says, else touch)"))
      ->transform(oneOf([] {
        std::vector<std::string> names;
        for (const auto& [name, tool] : kHandTools) names.emplace_back(name);
        return names;
      }()));
  verb->add_option(
          "--pull", replay->pull,
          help("How pulled cloth is felt: curve (a strip of the fabric, from where it was taken to the hand) or "
               "springs (the historical law); the cloth itself does not follow"))
      ->transform(oneOf({"curve", "springs"}));
  verb->add_option("--every", replay->every, help("Milliseconds from line to line, and from row to row"))
      ->check(CLI::Range(1.0, 1000.0));
  program.output(
      *verb, "--csv", replay->csv,
      help("A table instead: time, tip, proxy (where the tip is stopped by what it touches), force on the hand"),
      {"csv"});
  verb->add_option("--gain", replay->gain, help("Share of the true force, 0 to 1"))->check(CLI::Range(0.0, 1.0));
  verb->add_option("--limit", replay->limit, help("The most force, in newtons"))->check(CLI::Range(0.0, 10.0));
}

}  // namespace karinui::app

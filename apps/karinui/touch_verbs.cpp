// touch check, touch replay: what this machine can do for a hand, and what a recorded hand would feel.
#include <chrono>
#include <thread>

#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/devices/hd_stylus.h"
#include "karinui/devices/inverse3.h"
#include "karinui/devices/pose_source.h"
#include "karinui/devices/simulated_device.h"
#include "karinui/devices/simulated_inverse3.h"
#include "karinui/session/touch_scene_of.h"
#include "karinui/touch/servo.h"
#include "open_document.h"

namespace karinui::app {

namespace {

struct CheckOptions {
  double seconds = 60;
  bool ordinary = false;
};

struct ReplayOptions {
  std::string recording, document, tool = "touch", pull = "curve";
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
  line(say("Evaluating a scene of up to {0} triangles: {1} half of the time, {2} at most in 99 %", m->facets,
           micro(m->evaluation.p50), micro(m->evaluation.p99)));
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

int runReplay(Program& program, const ReplayOptions& options) {
  const Result<std::string> recorded = readFile(options.recording);
  if (!recorded) return program.console.refuse(recorded.error());
  Result<ScriptedDevice> hand = ScriptedDevice::read(*recorded, simulatedRecord());
  if (!hand) return program.console.refuse(hand.error());
  return withDocument(program, options.document, true, [&](OpenDocument& opened) -> int {
    BodyPtr body;
    if (opened.document().body.chosen()) {
      const Result<BodyPtr> found = bodyOf(opened.document(), opened.context());
      if (!found) return program.console.refuse(found.error());
      body = *found;
    }
    const SnapshotPtr fitting = snapshotOf(opened.document(), body);
    ServoSettings settings;
    settings.gain = options.gain;
    settings.limit = options.limit;
    settings.laws.pull = options.pull == "springs" ? PullLaw::Springs : PullLaw::Curve;
    ServoStep step(hand->record(), settings);
    std::vector<std::unique_ptr<TouchScene>> kept;
    Handling handling;
    Json ticks = Json::array();
    std::string words;
    double most = 0;
    bool held = false;
    // Two seconds at the first place, in which the force is armed.
    constexpr double kTick = 0.001, kWait = 2, kScene = 0.016;
    const double begins = hand->begins();
    HandSample now = hand->sample();
    const HandSample first = now;
    double published = -1;
    const auto ends = static_cast<long>((hand->ends() - begins + kWait) / kTick) + 1;
    for (long k = 0; k < ends; ++k) {
      const double t = static_cast<double>(k) * kTick;
      if (t > kWait) now = hand->sample();
      const bool down = (now.buttons & 1) != 0 && t > kWait;
      if (down && !held) {  // takes hold of what is there
        PointerSample sample;
        sample.tip = now.tip;
        const Hit hit = pick(*fitting, TableLayout(), sample);
        if (hit.on == Hit::On::Cloth && options.tool == "move") handling.carried = {hit.piece};
        if (hit.on == Hit::On::Cloth && options.tool == "pull")
          handling.pull = Handling::Pull{hit.piece, hit.paper, now.tip.carry, now.tip.carry, {}};
        if (hit.on == Hit::On::Cloth && options.tool == "cut") handling.cut = hit.piece;
        published = -1;
      }
      if (!down && held) handling = {}, published = -1;
      held = down;
      if (published < 0 || t - published >= kScene) {
        kept.push_back(std::make_unique<TouchScene>(touchSceneOf(*fitting, now.tip.carry, handling)));
        kept.back()->published = published = t;
        step.adopt(kept.back().get(), t);
        if (kept.size() > 3) kept.erase(kept.begin());
      }
      HandSample felt = t > kWait ? now : first;
      if (t <= kWait) felt.velocity = {}, felt.buttons = 0;
      const ServoTick tick = step.tick(felt, t);
      hand->apply(tick.out);
      if (t < kWait) continue;
      const double newtons = length(tick.out.force);
      most = std::max(most, newtons);
      const auto every = static_cast<long>(std::max(1.0, options.every));
      if (k % every != 0) continue;
      const Vec3 f = tick.out.force, p = felt.tip.carry;
      ticks.push_back({{"seconds", begins + t - kWait},
                       {"tip", {p.x, p.y, p.z}},
                       {"force", {f.x, f.y, f.z}},
                       {"newtons", newtons},
                       {"touching", tick.touching},
                       {"state", kStates[static_cast<std::size_t>(tick.state)]},
                       {"fault", kFaults[static_cast<std::size_t>(tick.fault)]}});
      words += fixed(begins + t - kWait, 3) + " s  " + fixed(newtons, 3) + " N  " +
               kStates[static_cast<std::size_t>(tick.state)] + "\n";
    }
    words += program.console.said(say("At most {0} N", fixed(most, 2))) + "\n";
    program.console.answer({{"most_newtons", most}, {"ticks", std::move(ticks)}}, words);
    return kDone;
  });
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
                   help("What the hand does while its button is down: touch, move, pull or cut"))
      ->check(CLI::IsMember({"touch", "move", "pull", "cut"}));
  verb->add_option("--pull", replay->pull,
                   help("How cloth pulls: curve (the fabric's) or springs (the historical law)"))
      ->check(CLI::IsMember({"curve", "springs"}));
  verb->add_option("--every", replay->every, help("Milliseconds from line to line"))->check(CLI::Range(1.0, 1000.0));
  verb->add_option("--gain", replay->gain, help("Share of the true force, 0 to 1"))->check(CLI::Range(0.0, 1.0));
  verb->add_option("--limit", replay->limit, help("The most force, in newtons"))->check(CLI::Range(0.0, 10.0));
}

}  // namespace karinui::app

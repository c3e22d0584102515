// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include "room_program.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "karinui/base/file.h"

namespace karinui::room {

namespace {

constexpr double kRetry = 0.5;    // seconds between two looks for a headset
constexpr double kPatience = 10;  // seconds a run without a person waits for one
constexpr int kSamples = 4;       // a pixel, where a graphics card draws

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

bool bySoftware(const std::string& driver) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast"})
    if (driver.find(name) != std::string::npos) return true;
  return false;
}

std::string stateName(XrSessionState state) {
  switch (state) {
    case XR_SESSION_STATE_IDLE:
      return "idle";
    case XR_SESSION_STATE_READY:
      return "ready";
    case XR_SESSION_STATE_SYNCHRONIZED:
      return "synchronized";
    case XR_SESSION_STATE_VISIBLE:
      return "visible";
    case XR_SESSION_STATE_FOCUSED:
      return "focused";
    case XR_SESSION_STATE_STOPPING:
      return "stopping";
    case XR_SESSION_STATE_LOSS_PENDING:
      return "loss pending";
    case XR_SESSION_STATE_EXITING:
      return "exiting";
    default:
      return "unknown";
  }
}

}  // namespace

RoomProgram::RoomProgram(Session& session, ProgramOptions options)
    : session_(session), options_(std::move(options)), room_(session, options_.room), title_("Karinui") {}

RoomProgram::~RoomProgram() { closeGraphics(); }

void RoomProgram::tell(const Message& what) {
  const std::string said = text(what, options_.room.language);
  if (!report_.said.empty() && report_.said.back() == text(what)) return;
  report_.said.push_back(text(what));
  std::fprintf(stderr, "%s\n", said.c_str());
  title_ = "Karinui – " + said;
  if (graphics_) graphics_->mirror(nullptr, title_);
}

// A window is tried first where a person may look at it, a context without one where nobody does.
std::vector<ProgramOptions::Share> RoomProgram::waysToShare() const {
  using Share = ProgramOptions::Share;
  if (options_.share != Share::Auto) return {options_.share};
  if (!runtime_->offers(kSharesEgl)) return {Share::Window};
  if (options_.headless) return {Share::Windowless, Share::Window};
  return {Share::Window, Share::Windowless};
}

Done RoomProgram::openGraphics(ProgramOptions::Share way) {
  if (way == ProgramOptions::Share::Windowless && !runtime_->offers(kSharesEgl))
    return notFound(say("This runtime shares pictures with a window only."));
  auto made = way == ProgramOptions::Share::Window ? mirrorWindow("Karinui") : windowless();
  if (!made) return made.error();
  graphics_ = std::move(*made);
  report_.driver = graphics_->renderer();
  graphics_->makeCurrent();
  auto picture = RoomRenderer::make(bySoftware(graphics_->renderer()));
  if (!picture) return picture.error();
  picture_ = std::move(*picture);
  return {};
}

void RoomProgram::closeGraphics() {
  closeHeadset();
  if (graphics_) graphics_->makeCurrent();
  picture_.reset();
  graphics_.reset();
}

// Some runtimes offer to share a context and refuse the session on it: the other way is tried then. One that served
// once is asked again in the same way.
Done RoomProgram::openGraphicsAndHeadset() {
  if (graphics_) return openHeadset();
  Done last;
  for (const auto way : waysToShare()) {
    last = openGraphics(way);
    if (!last) {
      closeGraphics();
      continue;
    }
    last = openHeadset();
    if (last || last.error().kind == Error::Kind::NotFound) return last;  // no headset by any way
    tell(last.error().what);
    closeGraphics();
  }
  return last;
}

Done RoomProgram::openHeadset() {
  auto headset = Headset::open(*runtime_, *graphics_);
  if (!headset) return headset.error();
  headset_ = std::move(*headset);
  auto controllers = Controllers::make(*runtime_, *headset_);
  if (!controllers) {
    closeHeadset();
    return controllers.error();
  }
  controllers_ = std::move(*controllers);
  graphics_->makeCurrent();
  const int samples = bySoftware(graphics_->renderer()) ? 1 : kSamples;
  for (std::size_t eye = 0; eye < eyes_.size(); ++eye) {
    auto target = EyeTarget::make(headset_->width(eye), headset_->height(eye), samples);
    if (!target) {
      closeHeadset();
      return target.error();
    }
    eyes_[eye] = std::move(*target);
  }
  room_.setFloor(headset_->stage() ? std::optional(0.0) : std::nullopt);
  ++report_.sessions;
  report_.system = headset_->system();
  report_.space = headset_->stage() ? "stage" : "local";
  char format[32];
  std::snprintf(format, sizeof format, "0x%04llx", static_cast<unsigned long long>(headset_->format()));
  report_.format = format;
  return {};
}

void RoomProgram::closeHeadset() {
  if (headset_)
    for (const std::string& failure : headset_->failures()) report_.failures.push_back(failure);
  if (graphics_) graphics_->makeCurrent();
  controllers_.reset();
  headset_.reset();
  for (auto& eye : eyes_) eye.reset();
  focused_ = false;
}

void RoomProgram::idle(double seconds) {
  session_.update();
  if (graphics_) graphics_->mirror(nullptr, title_);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

int RoomProgram::run() {
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  int code = kEndedWell;
  bool everRan = false, asked = false;
  std::optional<double> waitingSince;
  const auto outOfPatience = [&] {
    if (!waitingSince) waitingSince = monotonicSeconds();
    return options_.headless && monotonicSeconds() - *waitingSince > kPatience;
  };
  for (;;) {
    const bool leaving = asked || interrupted || (graphics_ && graphics_->closed());
    if (leaving && (!headset_ || (!asked && !headset_->running()))) break;
    if (leaving && !asked) headset_->askToEnd(), asked = true;
    if (!runtime_) {
      auto runtime = Runtime::open();
      if (!runtime) {
        tell(runtime.error().what);
        if (!everRan || outOfPatience()) {
          code = kNoRuntime;
          break;
        }
        idle(kRetry);
        continue;
      }
      runtime_ = std::move(*runtime);
      report_.runtime = runtime_->name();
    }
    if (!headset_) {
      if (const Done done = openGraphicsAndHeadset(); !done) {
        tell(done.error().what);
        // A runtime that refuses at first will go on refusing; one that served before may be starting anew.
        const bool found = done.error().kind != Error::Kind::NotFound;
        if (!graphics_ || (found && !everRan) || outOfPatience()) {
          code = !graphics_ && !found ? kNoGraphics : found ? kFailed : kNoHeadset;
          break;
        }
        runtime_.reset();
        idle(kRetry);
        continue;
      }
      if (everRan) {
        tell(say("The headset is back; the garment is as it was."));
        room_.placeAnew();
      }
    }
    const Headset::News news = headset_->poll();
    if (news.recentred) room_.placeAnew();
    for (const XrSessionState state : headset_->takeStates()) {
      report_.states.push_back(stateName(state));
      if (state == XR_SESSION_STATE_VISIBLE && focused_ && !asked)
        tell(say("The headset's own menu is open; Karinui waits."));
      else if (state == XR_SESSION_STATE_FOCUSED)
        title_ = "Karinui";
    }
    if (news.profileChanged) {
      report_.profiles = {controllers_->profile(0), controllers_->profile(1)};
      if (report_.profiles[0].empty() && report_.profiles[1].empty())
        tell(say("No controller is held; switch one on."));
    }
    if (headset_->status() == HeadsetStatus::Ended) break;
    if (headset_->status() != HeadsetStatus::Good) {
      const bool instance = headset_->status() == HeadsetStatus::InstanceLost;
      room_.dropHands();
      tell(say("The headset was lost. Nothing is lost of the garment; every step is saved. Waiting for the headset."));
      closeHeadset();
      if (instance) runtime_.reset();
      waitingSince = monotonicSeconds();
      continue;
    }
    if (!headset_->running()) {
      if (outOfPatience()) {
        code = kNoHeadset;
        tell(say("The headset did not begin to show pictures."));
        break;
      }
      idle(0.02);
      continue;
    }
    waitingSince.reset();
    everRan = true;
    if (!makePicture()) idle(0.01);
    if (ending_ && !asked) headset_->askToEnd(), asked = true;
  }
  finish();
  return code;
}

void RoomProgram::finish() {
  if (session_.begun()) session_.command(Command::Cancel);
  session_.close();
  closeHeadset();
  const std::string report = json(report_, session_);
  if (options_.json) std::fputs(report.c_str(), stdout);
  if (options_.headless)
    if (const Done done = writeFile(*options_.headless / "report.json", report); !done) tell(done.error().what);
}

}  // namespace karinui::room

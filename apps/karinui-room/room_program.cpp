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

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

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

RoomProgram::~RoomProgram() {
  closeHeadset();
  if (graphics_) graphics_->makeCurrent();
  picture_.reset();
}

void RoomProgram::tell(const Message& what) {
  const std::string said = text(what, options_.room.language);
  if (!report_.said.empty() && report_.said.back() == text(what)) return;
  report_.said.push_back(text(what));
  std::fprintf(stderr, "%s\n", said.c_str());
  title_ = "Karinui – " + said;
  if (graphics_) graphics_->mirror(nullptr, title_);
}

Done RoomProgram::openGraphics() {
  const bool shared = runtime_->offers("XR_MNDX_egl_enable");
  using Share = ProgramOptions::Share;
  const bool windowFirst = options_.share == Share::Window || (options_.share == Share::Auto && !options_.headless);
  Result<std::unique_ptr<Graphics>> made = notFound(say("This runtime shares pictures with a window only."));
  if (windowFirst || !shared) {
    made = mirrorWindow("Karinui");
    if (!made && shared && options_.share == Share::Auto) made = windowless();
  } else {
    made = windowless();
    if (!made && options_.share == Share::Auto) made = mirrorWindow("Karinui");
  }
  if (!made) return made.error();
  graphics_ = std::move(*made);
  report_.driver = graphics_->renderer();
  graphics_->makeCurrent();
  auto picture = RoomRenderer::make(bySoftware(graphics_->renderer()));
  if (!picture) return picture.error();
  picture_ = std::move(*picture);
  return {};
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

// What recorded poses ask of the program up to this picture.
void RoomProgram::playEvents() {
  if (!options_.script) return;
  const auto& events = options_.script->events;
  for (; played_ < events.size() && events[played_].picture <= pictures_; ++played_) {
    const std::string& what = events[played_].what;
    if (what == "wait on" || what == "wait off") waits_ = what == "wait on";
    if (what.starts_with("picture ")) wanted_.push_back(what.substr(8));
  }
  if (pictures_ >= options_.script->end() && !ending_) {
    ending_ = true;
    wanted_.emplace_back("end");
  }
}

bool RoomProgram::leavePictures(const std::string& name) {
  if (!options_.headless) return true;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const auto path = *options_.headless / (name + (eye == 0 ? "_left.png" : "_right.png"));
    if (const Done done = writePng(path.string(), eyes_[eye]->image()); !done) {
      tell(done.error().what);
      return false;
    }
  }
  return true;
}

bool RoomProgram::makePicture() {
  const double asked = now();
  const auto frame = headset_->begin();
  if (!frame) return false;
  report_.waited.add(1000 * (now() - asked));
  if (!began_) began_ = frame->time;
  playEvents();
  // Recorded poses have a clock of their own, so that a slow machine plays the same.
  const double before = seconds_;
  seconds_ = options_.script ? static_cast<double>(pictures_) / kScriptRate
                             : static_cast<double>(frame->time - *began_) * 1e-9;
  seconds_ = std::max(seconds_, before);

  const double sampled = now();
  auto hands = controllers_->read(frame->time);
  auto views = headset_->views(frame->time);
  const auto tracked = headset_->head(frame->time);
  if (tracked) head_ = *tracked, seen_ = true;
  if (options_.script) {
    if (const auto head = options_.script->headAt(pictures_)) {
      head_ = *head, seen_ = true;
      if (views && tracked)  // the eyes go with the recorded head
        for (Headset::View& view : *views) view.eye = after(*head, after(inverseOf(*tracked), view.eye));
    }
    if (options_.script->hasHands())
      for (std::size_t side = 0; side < 2; ++side) hands[side] = options_.script->handAt(side, pictures_);
  }
  ++pictures_;
  const bool played = options_.script && options_.script->hasHands();
  if (waits_) session_.finish();
  if (!seen_) {
    session_.update();  // nobody is there yet
  } else if (headset_->focused() || played) {
    focused_ = true;
    room_.step(head_, hands, seconds_);
  } else {
    if (std::exchange(focused_, false)) room_.dropHands();
    session_.update();
  }
  if (waits_) session_.finish(), session_.update();
  const auto pulses = room_.takeHapticPulses();
  for (std::size_t side = 0; side < 2; ++side)
    for (const HapticPulse& pulse : pulses[side]) controllers_->vibrate(side, pulse), ++report_.pulses;
  report_.input.add(1000 * (now() - sampled));

  bool drawn = false;
  if (frame->draw && views && seen_) {
    graphics_->makeCurrent();
    picture_->take(room_, head_, seconds_);
    report_.taken.add(1000 * (now() - sampled));
    drawn = true;
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const auto texture = headset_->acquire(eye);
      if (!texture) {
        drawn = false;
        continue;
      }
      eyes_[eye]->bind();
      picture_->draw((*views)[eye].eye, (*views)[eye].fov,
                     {.x = 0, .y = 0, .width = eyes_[eye]->width(), .height = eyes_[eye]->height()});
      eyes_[eye]->copyTo(*texture, headset_->format());
      glFlush();
      headset_->release(eye);
    }
    report_.drawn.add(1000 * (now() - sampled));
  }
  headset_->end(*frame, drawn);
  report_.submitted.add(1000 * (now() - sampled));
  ++report_.pictures;
  if (!drawn) ++report_.undrawn;
  if (session_.busy().settling) ++report_.whileDraping;
  graphics_->makeCurrent();
  if (drawn)
    for (const std::string& name : std::exchange(wanted_, {})) leavePictures(name);
  graphics_->mirror(drawn ? eyes_[0].get() : nullptr, title_);
  return true;
}

int RoomProgram::run() {
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  int code = kEndedWell;
  bool everRan = false, asked = false;
  std::optional<double> waitingSince;
  const auto outOfPatience = [&] {
    if (!waitingSince) waitingSince = now();
    return options_.headless && now() - *waitingSince > kPatience;
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
    if (!graphics_) {
      if (const Done done = openGraphics(); !done) {
        tell(done.error().what);
        code = kNoGraphics;
        break;
      }
    }
    if (!headset_) {
      if (const Done done = openHeadset(); !done) {
        tell(done.error().what);
        if (done.error().kind != Error::Kind::NotFound || outOfPatience()) {
          // A runtime that refuses at first will go on refusing; one that served before may be starting anew.
          if (!everRan || outOfPatience()) {
            code = done.error().kind == Error::Kind::NotFound ? kNoHeadset : kFailed;
            break;
          }
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
      waitingSince = now();
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

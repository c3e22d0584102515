#include "karinui/devices/hd_stylus.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <thread>

#include "karinui/touch/seq_lock.h"

namespace karinui {

namespace {

using Handle = unsigned int;
using Scheduled = unsigned long;
struct HdError {
  unsigned int code = 0;
  int internal = 0;
  Handle device = 0;
};
using Callback = unsigned int (*)(void*);

constexpr Handle kNoDevice = 0xFFFFFFFF;
constexpr unsigned int kGoOn = 1;
constexpr unsigned short kPriority = 32767;
enum : unsigned int {
  kCurrentButtons = 0x2000,
  kCurrentVelocity = 0x2051,   // mm/s
  kCurrentTransform = 0x2052,  // 4x4, column by column, mm
  kModel = 0x2501,
  kWorkspace = 0x2551,     // low and high corner, mm
  kMaxStiffness = 0x2602,  // 0..1 of what follows is not told; N/mm
  kMaxForce = 0x2603,      // N
  kMaxDamping = 0x2609,    // N s/mm
  kCurrentForce = 0x2700,  // N
  kForceOutput = 0x4000,
};
constexpr int kStale = 20;  // ticks of its scheduler that a force lasts

}  // namespace

struct HdStylus::Inside {
  void* library = nullptr;
  Handle (*init)(const char*) = nullptr;
  void (*disable)(Handle) = nullptr;
  HdError (*error)() = nullptr;
  void (*enable)(unsigned int) = nullptr;
  void (*startScheduler)() = nullptr;
  void (*stopScheduler)() = nullptr;
  Scheduled (*schedule)(Callback, void*, unsigned short) = nullptr;
  void (*unschedule)(Scheduled) = nullptr;
  void (*beginFrame)(Handle) = nullptr;
  void (*endFrame)(Handle) = nullptr;
  void (*getDoubles)(unsigned int, double*) = nullptr;
  void (*getIntegers)(unsigned int, int*) = nullptr;
  void (*setDoubles)(unsigned int, const double*) = nullptr;
  const char* (*getString)(unsigned int) = nullptr;

  Handle device = kNoDevice;
  Scheduled scheduled = 0;
  bool running = false;
  DeviceRecord record;
  SeqLock<HandSample> hand;  // written by the scheduler
  HandSample newest;         // the servo's
  SeqLock<HandForce> force;  // written by the servo
  std::atomic<std::uint32_t> applied{0};
  std::atomic<bool> stopping{false}, quiet{false};
  // The scheduler's own.
  HandForce shown;
  std::uint32_t seen = 0;
  int age = kStale;

  template <class Function>
  bool find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    return function != nullptr;
  }
  bool findAll() {
    return find(init, "hdInitDevice") && find(disable, "hdDisableDevice") && find(error, "hdGetError") &&
           find(enable, "hdEnable") && find(startScheduler, "hdStartScheduler") &&
           find(stopScheduler, "hdStopScheduler") && find(schedule, "hdScheduleAsynchronous") &&
           find(unschedule, "hdUnschedule") && find(beginFrame, "hdBeginFrame") && find(endFrame, "hdEndFrame") &&
           find(getDoubles, "hdGetDoublev") && find(getIntegers, "hdGetIntegerv") && find(setDoubles, "hdSetDoublev") &&
           find(getString, "hdGetString");
  }

  void describe() {
    const char* model = getString(kModel);
    record.name = model && *model ? model : "3D Systems Touch";
    record.freedomIn = 6;
    record.freedomOut = 3;
    std::array<double, 6> box{};
    double newtons = 0, stiffness = 0, damping = 0;
    getDoubles(kMaxForce, &newtons);
    getDoubles(kMaxStiffness, &stiffness);
    getDoubles(kMaxDamping, &damping);
    getDoubles(kWorkspace, box.data());
    record.force = newtons > 0 && newtons < 50 ? newtons : 3.3;
    record.stiffness = stiffness > 0 ? std::clamp(stiffness * 1000, 100.0, 1000.0) : 400;
    record.damping = damping > 0 ? std::clamp(damping * 1000, 1.0, 8.0) : 4;
    record.workspace.include(Vec3{box[0], box[1], box[2]} * 1e-3);
    record.workspace.include(Vec3{box[3], box[4], box[5]} * 1e-3);
  }

  // One tick of the scheduler.
  unsigned int tick() {
    beginFrame(device);
    std::array<double, 16> m{};
    std::array<double, 3> v{};
    int buttons = 0;
    getDoubles(kCurrentTransform, m.data());
    getDoubles(kCurrentVelocity, v.data());
    getIntegers(kCurrentButtons, &buttons);
    if (const std::uint32_t now = applied.load(std::memory_order_acquire); now != seen) {
      if (force.tryRead(shown)) seen = now, age = 0;
    } else {
      age = std::min(age + 1, kStale);
    }
    const bool zero = age >= kStale || stopping.load(std::memory_order_relaxed);
    const std::array<double, 3> out =
        zero ? std::array<double, 3>{} : std::array{shown.force.x, shown.force.y, shown.force.z};
    setDoubles(kCurrentForce, out.data());
    endFrame(device);
    const bool bad = error().code != 0;
    HandSample sample;
    sample.tip = poseOf(m);
    sample.velocity = Vec3{v[0], v[1], v[2]} * 1e-3;
    sample.buttons = static_cast<std::uint32_t>(buttons);
    sample.ready = !bad;
    hand.write(sample);
    if (zero) quiet.store(true, std::memory_order_release);
    return kGoOn;
  }

  static Rigid poseOf(const std::array<double, 16>& m) {
    const double trace = m[0] + m[5] + m[10];
    Rigid r;
    if (trace > 0) {
      const double s = 2 * std::sqrt(trace + 1);
      r = {s / 4, (m[6] - m[9]) / s, (m[8] - m[2]) / s, (m[1] - m[4]) / s, {}};
    } else if (m[0] > m[5] && m[0] > m[10]) {
      const double s = 2 * std::sqrt(std::max(1e-12, 1 + m[0] - m[5] - m[10]));
      r = {(m[6] - m[9]) / s, s / 4, (m[4] + m[1]) / s, (m[8] + m[2]) / s, {}};
    } else if (m[5] > m[10]) {
      const double s = 2 * std::sqrt(std::max(1e-12, 1 + m[5] - m[0] - m[10]));
      r = {(m[8] - m[2]) / s, (m[4] + m[1]) / s, s / 4, (m[9] + m[6]) / s, {}};
    } else {
      const double s = 2 * std::sqrt(std::max(1e-12, 1 + m[10] - m[0] - m[5]));
      r = {(m[1] - m[4]) / s, (m[8] + m[2]) / s, (m[9] + m[6]) / s, s / 4, {}};
    }
    r.carry = Vec3{m[12], m[13], m[14]} * 1e-3;
    return r;
  }
};

HdStylus::HdStylus() : inside_(std::make_unique<Inside>()) {}
HdStylus::~HdStylus() {
  stop();
  if (inside_->library) dlclose(inside_->library);
}
const DeviceRecord& HdStylus::record() const { return inside_->record; }

bool HdStylus::libraryThere(const std::string& library) {
  void* found = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (found) dlclose(found);
  return found != nullptr;
}

Result<std::unique_ptr<HdStylus>> HdStylus::open(const std::string& library) {
  std::unique_ptr<HdStylus> stylus(new HdStylus);
  Inside& in = *stylus->inside_;
  in.library = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!in.library)
    return notFound(
        say("The library of the Touch, “{0}”, is not installed; it comes with the maker's driver.", library));
  if (!in.findAll()) return notFound(say("“{0}” is not the library of the Touch.", library));
  in.device = in.init(nullptr);
  if (in.device == kNoDevice || in.error().code != 0) {
    in.device = kNoDevice;
    return notFound(say("The driver of the Touch finds no device. Is it plugged in and powered?"));
  }
  in.describe();
  in.enable(kForceOutput);
  in.scheduled = in.schedule([](void* self) { return static_cast<Inside*>(self)->tick(); }, &in, kPriority);
  in.startScheduler();
  in.running = true;
  if (in.error().code != 0) return refused(say("The driver of the Touch does not start; look at its own diagnosis."));
  return stylus;
}

HandSample HdStylus::sample() {
  inside_->hand.tryRead(inside_->newest);
  return inside_->newest;
}

void HdStylus::apply(const HandForce& force) {
  inside_->force.write(force);
  inside_->applied.fetch_add(1, std::memory_order_release);
}

void HdStylus::stop() {
  Inside& in = *inside_;
  if (in.running) {
    in.quiet = false;
    in.stopping = true;
    // One tick of the scheduler more, which takes the force away.
    for (int k = 0; k < 20 && !in.quiet.load(std::memory_order_acquire); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    in.stopScheduler();
    in.unschedule(in.scheduled);
    in.running = false;
  }
  if (in.device != kNoDevice) in.disable(in.device);
  in.device = kNoDevice;
}

}  // namespace karinui

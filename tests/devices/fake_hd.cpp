// A library of ours with the face of libHD: a point mass that is held, a scheduler of its own, and a list of the calls.
#include <atomic>
#include <cstring>
#include <string>
#include <thread>

namespace {

struct Error {
  unsigned int code;
  int internal;
  unsigned int device;
};
using Callback = unsigned int (*)(void*);

std::string calls;  // of the opening and the closing; those of the frames are counted
std::atomic<int> frames{0};
std::atomic<bool> inFrame{false}, outOfFrame{false}, run{false};
std::atomic<unsigned int> fault{0};
bool absent = false;
Callback callback = nullptr;
void* data = nullptr;
std::thread scheduler;
double force[3];
double mostForce = 0;

void note(const char* name) { calls += std::string(name) + " "; }
void framed() {
  if (!inFrame) outOfFrame = true;
}

}  // namespace

extern "C" {
// For the test.
const char* fakeHdCalls() { return calls.c_str(); }
int fakeHdFrames() { return frames; }
bool fakeHdOutOfFrame() { return outOfFrame; }
void fakeHdFail(unsigned int code) { fault = code; }
void fakeHdAbsent(bool is) { absent = is; }
void fakeHdForce(double* out) { std::memcpy(out, force, sizeof force); }
double fakeHdMostForce() { return mostForce; }
void fakeHdReset() { calls.clear(), frames = 0, fault = 0, absent = false, outOfFrame = false, mostForce = 0; }

unsigned int hdInitDevice(const char*) {
  note("init");
  return absent ? 0xFFFFFFFFu : 7u;
}
void hdDisableDevice(unsigned int device) { note(device == 7 ? "disable" : "disable-what"); }
Error hdGetError() { return {fault.load(), 0, 7}; }
void hdEnable(unsigned int what) { note(what == 0x4000 ? "enable-force" : "enable-what"); }
unsigned long hdScheduleAsynchronous(Callback one, void* with, unsigned short) {
  note("schedule");
  callback = one, data = with;
  return 42;
}
void hdUnschedule(unsigned long handle) { note(handle == 42 ? "unschedule" : "unschedule-what"); }
void hdStartScheduler() {
  note("start");
  run = true;
  scheduler = std::thread([] {
    while (run) {
      if (callback(data) == 0) break;
      ++frames;
      frames.notify_all();
      std::this_thread::yield();
    }
  });
}
void hdStopScheduler() {
  note("stop");
  run = false;
  if (scheduler.joinable()) scheduler.join();
}
void hdBeginFrame(unsigned int) { inFrame = true; }
void hdEndFrame(unsigned int) { inFrame = false; }
void hdGetDoublev(unsigned int what, double* out) {
  switch (what) {
    case 0x2603:
      *out = 3.3;
      break;
    case 0x2602:
      *out = 0.5;
      break;  // N/mm
    case 0x2609:
      *out = 0.004;
      break;  // N s/mm
    case 0x2551: {
      const double box[6] = {-80, -60, -35, 80, 60, 35};
      std::memcpy(out, box, sizeof box);
      break;
    }
    case 0x2052: {  // a quarter turn about y, at (10, 20, 30) mm; column by column
      framed();
      const double m[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 10, 20, 30, 1};
      std::memcpy(out, m, sizeof m);
      break;
    }
    case 0x2051: {
      framed();
      const double v[3] = {100, 0, -50};
      std::memcpy(out, v, sizeof v);
      break;
    }
    default:
      outOfFrame = true;
  }
}
void hdGetIntegerv(unsigned int what, int* out) {
  framed();
  *out = what == 0x2000 ? 3 : -1;
}
void hdSetDoublev(unsigned int what, const double* in) {
  framed();
  if (what != 0x2700) return;
  std::memcpy(force, in, sizeof force);
  for (const double f : force) mostForce = f > mostForce ? f : mostForce;
}
const char* hdGetString(unsigned int) { return "Touch (fake)"; }
}

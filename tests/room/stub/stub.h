#pragma once
// An OpenXR runtime for tests, loaded by the real loader through XR_RUNTIME_JSON: no headset, but recorded heads and
// hands (pose_script.h), and a strict eye on the order of calls. It lives in the program's own process and uses its
// OpenGL context. What it sees is left in the folder KARINUI_STUB_LOG:
//   calls.log      every call but the ones each picture repeats, one a line
//   faults.log     what the specification forbids (OpenXR 1.0.20); empty where all is well
//   vibration.log  "picture side amplitude nanoseconds"
//   NAME_left.ppm, NAME_right.ppm   the submitted pictures, where the script says "picture NAME"
// KARINUI_STUB_SCRIPT: the script. KARINUI_STUB_WITH: words "local" (no STAGE), "linear" (no sRGB formats), "no_egl",
// "simple", "index" (the controllers; else oculus/touch), "large" (pictures; KARINUI_STUB_SIDE: pixels of one),
// "seldom" (one picture of twelve is wanted), "finish" (a frame is taken when it is drawn), "no_headset" (never one),
// "no_service" (no instance is made), "slow" (keeps a real pace).
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <epoxy/glx.h>
//
#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>
#undef None
#undef Success
#undef Status

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "pose_script.h"

namespace karinui::room::stub {

inline constexpr XrDuration kPeriod = 13'888'889;  // 72 pictures a second
inline constexpr XrTime kFirst = 1'000'000'000;
inline constexpr int kAbsent = 3;   // so often a headset that is gone is looked for in vain
inline constexpr int kSeldom = 12;  // one picture of so many is wanted
inline int kSide = 200;             // pixels of an eye's picture
inline constexpr std::size_t kImages = 3;
inline constexpr double kEyesApart = 0.063, kCant = 0.07;  // metres; radians each eye is turned outwards
inline constexpr XrFovf kFov[2] = {{-0.90f, 0.70f, 0.72f, -0.80f}, {-0.70f, 0.90f, 0.72f, -0.80f}};

struct Space {
  enum class Of { Room, Head, Aim, Palm } of = Of::Room;
  std::size_t side = 0;
};
struct Chain {
  std::int64_t format = 0;
  unsigned textures[kImages] = {};
  std::deque<std::uint32_t> acquired;
  bool waited = false, everReleased = false;
  std::uint32_t next = 0, last = 0;
};
struct Action {
  std::uint64_t set = 0;
  XrActionType type = XR_ACTION_TYPE_BOOLEAN_INPUT;
  std::string name;
  std::map<std::string, std::set<std::string>> bound;  // by profile: paths
};
struct ActionSet {
  std::string name;
  bool attached = false;
};

struct Stub {
  std::string folder, with;
  PoseScript script;
  std::size_t played = 0;
  std::ofstream calls, faults, vibration;
  std::uint64_t handles = 100;
  bool instance = false, instanceLost = false, asked = false;
  bool egl = false;
  int absent = 0;
  // session
  std::uint64_t session = 0;
  XrSessionState state = XR_SESSION_STATE_UNKNOWN;
  bool running = false, lost = false, exitAsked = false, attached = false, firstEnd = false;
  bool focusHeld = true, visibleHeld = true;
  std::deque<XrEventDataBuffer> events;
  // frames
  long waited = -1, begun = -1, ended = -1;  // numbers of pictures, over all sessions
  bool rendering = false;
  XrPosef eyes[2] = {};
  std::map<std::uint64_t, Space> spaces;
  std::map<std::uint64_t, Chain> chains;
  std::map<std::uint64_t, Action> actions;
  std::map<std::uint64_t, ActionSet> sets;
  std::vector<std::string> paths;
  std::vector<std::string> wanted;

  bool has(const char* word) const { return with.find(word) != std::string::npos; }
  void note(const std::string& line) { calls << line << "\n", calls.flush(); }
  XrResult fault(XrResult result, const std::string& what) {
    faults << what << " (" << result << ")\n";
    faults.flush();
    return result;
  }
  XrPath pathOf(const std::string& text) {
    auto found = std::find(paths.begin(), paths.end(), text);
    if (found == paths.end()) found = paths.insert(paths.end(), text);
    return static_cast<XrPath>(found - paths.begin()) + 1;
  }
  std::string profile() const {
    return has("simple")  ? "/interaction_profiles/khr/simple_controller"
           : has("index") ? "/interaction_profiles/valve/index_controller"
                          : "/interaction_profiles/oculus/touch_controller";
  }
};

Stub& stub();  // one in a process

template <class Handle>
std::uint64_t number(Handle handle) {
  return reinterpret_cast<std::uint64_t>(handle);
}
template <class Handle>
Handle handleOf(std::uint64_t n) {
  return reinterpret_cast<Handle>(n);
}

inline XrTime timeOf(long picture) { return kFirst + picture * kPeriod; }
inline long pictureAt(XrTime time) { return (time - kFirst + kPeriod / 2) / kPeriod; }

void become(XrSessionState state);
void strive();      // on the way to where the script wants it, over all states between
void playEvents();  // what the script asks for up to the newest picture
XrPosef poseOf(const Rigid& pose);
Rigid headAt(long picture);

#define KNOWN_INSTANCE()                                                                             \
  Stub& s = stub();                                                                                  \
  if (!s.instance) return s.fault(XR_ERROR_HANDLE_INVALID, std::string(__func__) + ": no instance"); \
  if (s.instanceLost) return XR_ERROR_INSTANCE_LOST
#define KNOWN_SESSION()                                                                    \
  KNOWN_INSTANCE();                                                                        \
  if (s.session == 0 || number(session) != s.session)                                      \
    return s.fault(XR_ERROR_HANDLE_INVALID, std::string(__func__) + ": not this session"); \
  if (s.lost) return XR_ERROR_SESSION_LOST

template <class Item>
XrResult fill(const std::vector<Item>& all, std::uint32_t room, std::uint32_t* count, Item* items) {
  *count = static_cast<std::uint32_t>(all.size());
  if (room == 0) return XR_SUCCESS;
  if (room < all.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  std::copy(all.begin(), all.end(), items);
  return XR_SUCCESS;
}

// The functions by name, as xrGetInstanceProcAddr knows them; each file adds its own.
using Calls = std::map<std::string, PFN_xrVoidFunction>;
template <class Function>
void add(Calls& calls, const char* name, Function function) {
  calls[name] = reinterpret_cast<PFN_xrVoidFunction>(function);
}
void addInstance(Calls& calls);    // instance, system, paths
void addSession(Calls& calls);     // session and spaces
void addSwapchains(Calls& calls);  // textures and frames
void addActions(Calls& calls);     // controllers

}  // namespace karinui::room::stub

// An OpenXR runtime for tests, loaded by the real loader through XR_RUNTIME_JSON: no headset, but recorded heads and
// hands (pose_script.h), and a strict eye on the order of calls. It lives in the program's own process and uses its
// OpenGL context. What it sees is left in the folder KARINUI_STUB_LOG:
//   calls.log      every call but the ones each picture repeats, one a line
//   faults.log     what the specification forbids (OpenXR 1.0.20); empty where all is well
//   vibration.log  "picture side amplitude nanoseconds"
//   NAME_left.ppm, NAME_right.ppm   the submitted pictures, where the script says "picture NAME"
// KARINUI_STUB_SCRIPT: the script. KARINUI_STUB_WITH: words "local" (no STAGE), "linear" (no sRGB formats), "no_egl",
// "simple", "index" (the controllers; else oculus/touch), "large" (pictures), "no_headset" (never one), "slow" (keeps a
// real pace).
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

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "pose_script.h"

// The loader's side of the handshake (OpenXR loader specification, "Runtime Negotiation"); Debian ships no header of
// it.
extern "C" {
struct XrNegotiateLoaderInfo {
  std::uint32_t structType, structVersion;
  std::size_t structSize;
  std::uint32_t minInterfaceVersion, maxInterfaceVersion;
  XrVersion minApiVersion, maxApiVersion;
};
struct XrNegotiateRuntimeRequest {
  std::uint32_t structType, structVersion;
  std::size_t structSize;
  std::uint32_t runtimeInterfaceVersion;
  XrVersion runtimeApiVersion;
  PFN_xrGetInstanceProcAddr getInstanceProcAddr;
};
}

namespace {

using karinui::Rigid;
using karinui::Vec3;
using karinui::room::ControllerState;
using karinui::room::PoseScript;

constexpr XrDuration kPeriod = 13'888'889;  // 72 pictures a second
constexpr XrTime kFirst = 1'000'000'000;
constexpr int kAbsent = 3;  // so often a headset that is gone is looked for in vain
int kSide = 200;            // pixels of an eye's picture
constexpr std::size_t kImages = 3;
constexpr double kEyesApart = 0.063, kCant = 0.07;  // metres; radians each eye is turned outwards
constexpr XrFovf kFov[2] = {{-0.90f, 0.70f, 0.72f, -0.80f}, {-0.70f, 0.90f, 0.72f, -0.80f}};

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
  std::string profile() const {
    return has("simple")  ? "/interaction_profiles/khr/simple_controller"
           : has("index") ? "/interaction_profiles/valve/index_controller"
                          : "/interaction_profiles/oculus/touch_controller";
  }
};

Stub& stub() {
  static Stub one = [] {
    Stub made;
    const auto from = [](const char* name) {
      const char* value = std::getenv(name);
      return std::string(value ? value : "");
    };
    made.folder = from("KARINUI_STUB_LOG");
    made.with = from("KARINUI_STUB_WITH");
    if (made.has("large")) kSide = 960;
    if (!made.folder.empty()) {
      made.calls.open(made.folder + "/calls.log", std::ios::app);
      made.faults.open(made.folder + "/faults.log", std::ios::app);
      made.vibration.open(made.folder + "/vibration.log", std::ios::app);
    }
    if (const std::string path = from("KARINUI_STUB_SCRIPT"); !path.empty()) {
      std::ifstream file(path);
      std::stringstream all;
      all << file.rdbuf();
      auto script = karinui::room::parsePoseScript(all.str());
      if (script)
        made.script = *script;
      else
        made.fault(XR_ERROR_VALIDATION_FAILURE, karinui::text(script.error().what));
    }
    return made;
  }();
  return one;
}

template <class Handle>
std::uint64_t number(Handle handle) {
  return reinterpret_cast<std::uint64_t>(handle);
}
template <class Handle>
Handle handleOf(std::uint64_t n) {
  return reinterpret_cast<Handle>(n);
}

XrTime timeOf(long picture) { return kFirst + picture * kPeriod; }
long pictureAt(XrTime time) { return (time - kFirst + kPeriod / 2) / kPeriod; }

void become(XrSessionState state) {
  Stub& s = stub();
  if (s.state == state) return;
  s.state = state;
  XrEventDataBuffer buffer{};
  auto& event = reinterpret_cast<XrEventDataSessionStateChanged&>(buffer);
  event.type = XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
  event.session = handleOf<XrSession>(s.session);
  event.state = state;
  event.time = timeOf(std::max(0L, s.waited));
  s.events.push_back(buffer);
  s.note("state " + std::to_string(state));
}

// The way up or down between two states goes over all that lie between.
void strive() {
  Stub& s = stub();
  if (!s.running || s.exitAsked || !s.firstEnd) return;
  const XrSessionState aim = !s.visibleHeld ? XR_SESSION_STATE_SYNCHRONIZED
                             : !s.focusHeld ? XR_SESSION_STATE_VISIBLE
                                            : XR_SESSION_STATE_FOCUSED;
  while (s.state < aim) become(static_cast<XrSessionState>(s.state + 1));
  while (s.state > aim) become(static_cast<XrSessionState>(s.state - 1));
}

void playEvents() {
  Stub& s = stub();
  const auto& events = s.script.events;
  for (; s.played < events.size() && events[s.played].picture <= s.waited; ++s.played) {
    const std::string& what = events[s.played].what;
    if (what == "focus off" || what == "focus on") s.focusHeld = what == "focus on";
    if (what == "visible off" || what == "visible on") s.visibleHeld = what == "visible on";
    if (what == "session lost" || what == "headset gone") {
      if (what == "headset gone") s.absent = kAbsent;
      s.lost = true, s.running = false;
      become(XR_SESSION_STATE_LOSS_PENDING);
    }
    if (what == "instance lost") {
      s.instanceLost = s.lost = true, s.running = false;
      XrEventDataBuffer buffer{};
      auto& event = reinterpret_cast<XrEventDataInstanceLossPending&>(buffer);
      event.type = XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING;
      s.events.push_back(buffer);
    }
    if (what == "recentre") {
      XrEventDataBuffer buffer{};
      auto& event = reinterpret_cast<XrEventDataReferenceSpaceChangePending&>(buffer);
      event.type = XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING;
      event.session = handleOf<XrSession>(s.session);
      event.referenceSpaceType = s.has("local") ? XR_REFERENCE_SPACE_TYPE_LOCAL : XR_REFERENCE_SPACE_TYPE_STAGE;
      event.poseValid = XR_FALSE;
      s.events.push_back(buffer);
    }
    if (what.starts_with("picture ")) s.wanted.push_back(what.substr(8));
  }
  strive();
}

XrPosef poseOf(const Rigid& p) {
  return {{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), static_cast<float>(p.w)},
          {static_cast<float>(p.carry.x), static_cast<float>(p.carry.y), static_cast<float>(p.carry.z)}};
}

Rigid headAt(long picture) { return stub().script.headAt(picture).value_or(Rigid{1, 0, 0, 0, {0, 1.6, 0}}); }

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

XrResult XRAPI_CALL enumerateExtensions(const char*, std::uint32_t room, std::uint32_t* count,
                                        XrExtensionProperties* items) {
  Stub& s = stub();
  std::vector<const char*> names{XR_KHR_OPENGL_ENABLE_EXTENSION_NAME};
  if (!s.has("no_egl")) names.push_back(XR_MNDX_EGL_ENABLE_EXTENSION_NAME);
  *count = static_cast<std::uint32_t>(names.size());
  if (room == 0) return XR_SUCCESS;
  if (room < names.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (items[i].type != XR_TYPE_EXTENSION_PROPERTIES) return s.fault(XR_ERROR_VALIDATION_FAILURE, "extension's type");
    std::strcpy(items[i].extensionName, names[i]);
    items[i].extensionVersion = 1;
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createInstance(const XrInstanceCreateInfo* info, XrInstance* instance) {
  Stub& s = stub();
  s.note("xrCreateInstance");
  if (s.instance) return s.fault(XR_ERROR_LIMIT_REACHED, "a second instance");
  bool opengl = false;
  for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
    opengl |= std::strcmp(info->enabledExtensionNames[i], XR_KHR_OPENGL_ENABLE_EXTENSION_NAME) == 0;
    s.egl |= std::strcmp(info->enabledExtensionNames[i], XR_MNDX_EGL_ENABLE_EXTENSION_NAME) == 0;
  }
  if (!opengl) return s.fault(XR_ERROR_EXTENSION_NOT_PRESENT, "XR_KHR_opengl_enable is not asked for");
  s.instance = true, s.instanceLost = false, s.asked = false;
  s.events.clear();
  *instance = handleOf<XrInstance>(++s.handles);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroyInstance(XrInstance) {
  Stub& s = stub();
  s.note("xrDestroyInstance");
  if (s.session) s.fault(XR_SUCCESS, "the instance ends before its session");
  if (!s.sets.empty()) s.fault(XR_SUCCESS, "the instance ends before its action sets");
  s.instance = false;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getInstanceProperties(XrInstance, XrInstanceProperties* about) {
  KNOWN_INSTANCE();
  about->runtimeVersion = XR_MAKE_VERSION(0, 1, 0);
  std::strcpy(about->runtimeName, "Karinui's stub");
  return XR_SUCCESS;
}

XrResult XRAPI_CALL pollEvent(XrInstance, XrEventDataBuffer* event) {
  Stub& s = stub();
  if (!s.instance) return s.fault(XR_ERROR_HANDLE_INVALID, "xrPollEvent without an instance");
  if (event->type != XR_TYPE_EVENT_DATA_BUFFER) return s.fault(XR_ERROR_VALIDATION_FAILURE, "event's type");
  if (s.events.empty()) return XR_EVENT_UNAVAILABLE;
  *event = s.events.front();
  s.events.pop_front();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL resultToString(XrInstance, XrResult value, char buffer[XR_MAX_RESULT_STRING_SIZE]) {
  std::snprintf(buffer, XR_MAX_RESULT_STRING_SIZE, "XrResult %d", value);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL structureTypeToString(XrInstance, XrStructureType value, char buffer[XR_MAX_STRUCTURE_NAME_SIZE]) {
  std::snprintf(buffer, XR_MAX_STRUCTURE_NAME_SIZE, "XrStructureType %d", value);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getSystem(XrInstance, const XrSystemGetInfo* info, XrSystemId* id) {
  KNOWN_INSTANCE();
  s.note("xrGetSystem");
  if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY) return XR_ERROR_FORM_FACTOR_UNSUPPORTED;
  if (s.has("no_headset")) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  if (s.absent > 0) return --s.absent, XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  *id = 1;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getSystemProperties(XrInstance, XrSystemId, XrSystemProperties* about) {
  KNOWN_INSTANCE();
  about->systemId = 1;
  std::strcpy(about->systemName, "Recorded head and hands");
  about->graphicsProperties = {4096, 4096, 16};
  about->trackingProperties = {XR_TRUE, XR_TRUE};
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateBlends(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t room,
                                    std::uint32_t* count, XrEnvironmentBlendMode* items) {
  KNOWN_INSTANCE();
  return fill(std::vector{XR_ENVIRONMENT_BLEND_MODE_OPAQUE}, room, count, items);
}
XrResult XRAPI_CALL enumerateConfigurations(XrInstance, XrSystemId, std::uint32_t room, std::uint32_t* count,
                                            XrViewConfigurationType* items) {
  KNOWN_INSTANCE();
  return fill(std::vector{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO}, room, count, items);
}
XrResult XRAPI_CALL configurationProperties(XrInstance, XrSystemId, XrViewConfigurationType type,
                                            XrViewConfigurationProperties* about) {
  KNOWN_INSTANCE();
  about->viewConfigurationType = type;
  about->fovMutable = XR_FALSE;
  return XR_SUCCESS;
}
XrResult XRAPI_CALL enumerateViews(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t room,
                                   std::uint32_t* count, XrViewConfigurationView* items) {
  KNOWN_INSTANCE();
  const XrViewConfigurationView one{XR_TYPE_VIEW_CONFIGURATION_VIEW,
                                    nullptr,
                                    static_cast<std::uint32_t>(kSide),
                                    4096,
                                    static_cast<std::uint32_t>(kSide),
                                    4096,
                                    1,
                                    4};
  return fill(std::vector{one, one}, room, count, items);
}

XrResult XRAPI_CALL graphicsRequirements(XrInstance, XrSystemId, XrGraphicsRequirementsOpenGLKHR* needs) {
  KNOWN_INSTANCE();
  s.asked = true;
  needs->minApiVersionSupported = XR_MAKE_VERSION(3, 3, 0);
  needs->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createSession(XrInstance, const XrSessionCreateInfo* info, XrSession* session) {
  KNOWN_INSTANCE();
  s.note("xrCreateSession");
  if (s.session) return s.fault(XR_ERROR_LIMIT_REACHED, "a second session");
  if (!s.asked) return s.fault(XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING, "the graphics requirements were not asked");
  const auto* next = static_cast<const XrBaseInStructure*>(info->next);
  if (!next) return s.fault(XR_ERROR_GRAPHICS_DEVICE_INVALID, "no graphics binding");
  if (next->type == XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR) {
    const auto& glx = *reinterpret_cast<const XrGraphicsBindingOpenGLXlibKHR*>(next);
    if (!glx.xDisplay || !glx.glxContext || !glx.glxDrawable || !glx.glxFBConfig || !glx.visualid)
      return s.fault(XR_ERROR_GRAPHICS_DEVICE_INVALID, "an incomplete GLX binding");
    if (glXGetCurrentContext() != glx.glxContext) s.fault(XR_SUCCESS, "the GLX context is not current");
    s.note("graphics GLX");
  } else if (next->type == XR_TYPE_GRAPHICS_BINDING_EGL_MNDX) {
    const auto& egl = *reinterpret_cast<const XrGraphicsBindingEGLMNDX*>(next);
    if (!s.egl) return s.fault(XR_ERROR_GRAPHICS_DEVICE_INVALID, "EGL without its extension");
    if (!egl.display || !egl.context || !egl.getProcAddress)
      return s.fault(XR_ERROR_GRAPHICS_DEVICE_INVALID, "an incomplete EGL binding");
    if (eglGetCurrentContext() != egl.context) s.fault(XR_SUCCESS, "the EGL context is not current");
    s.note("graphics EGL");
  } else {
    return s.fault(XR_ERROR_GRAPHICS_DEVICE_INVALID, "an unknown graphics binding");
  }
  s.session = ++s.handles;
  s.state = XR_SESSION_STATE_UNKNOWN;
  s.running = s.lost = s.exitAsked = s.attached = s.firstEnd = s.rendering = false;
  s.begun = s.ended = s.waited;
  become(XR_SESSION_STATE_IDLE);
  become(XR_SESSION_STATE_READY);
  *session = handleOf<XrSession>(s.session);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroySession(XrSession session) {
  Stub& s = stub();
  s.note("xrDestroySession");
  if (number(session) != s.session) return s.fault(XR_ERROR_HANDLE_INVALID, "xrDestroySession: not this session");
  if (!s.chains.empty()) s.fault(XR_SUCCESS, "the session ends before its swapchains");
  if (!s.spaces.empty()) s.fault(XR_SUCCESS, "the session ends before its spaces");
  s.session = 0;
  s.running = false;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL beginSession(XrSession session, const XrSessionBeginInfo* info) {
  KNOWN_SESSION();
  s.note("xrBeginSession");
  if (s.running) return s.fault(XR_ERROR_SESSION_RUNNING, "begun twice");
  if (s.state != XR_SESSION_STATE_READY) return s.fault(XR_ERROR_SESSION_NOT_READY, "begun before it was ready");
  if (info->primaryViewConfigurationType != XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO)
    return s.fault(XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED, "not stereo");
  s.running = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL endSession(XrSession session) {
  KNOWN_SESSION();
  s.note("xrEndSession");
  if (!s.running) return s.fault(XR_ERROR_SESSION_NOT_RUNNING, "ended before it ran");
  if (s.state != XR_SESSION_STATE_STOPPING) return s.fault(XR_ERROR_SESSION_NOT_STOPPING, "ended before it was to");
  s.running = false;
  become(XR_SESSION_STATE_IDLE);
  if (s.exitAsked) become(XR_SESSION_STATE_EXITING);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL requestExit(XrSession session) {
  KNOWN_SESSION();
  s.note("xrRequestExitSession");
  if (!s.running) return s.fault(XR_ERROR_SESSION_NOT_RUNNING, "asked to end before it ran");
  s.exitAsked = true;
  while (s.state > XR_SESSION_STATE_SYNCHRONIZED) become(static_cast<XrSessionState>(s.state - 1));
  become(XR_SESSION_STATE_STOPPING);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateSpaces(XrSession session, std::uint32_t room, std::uint32_t* count,
                                    XrReferenceSpaceType* items) {
  KNOWN_SESSION();
  std::vector all{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
  if (!s.has("local")) all.push_back(XR_REFERENCE_SPACE_TYPE_STAGE);
  return fill(all, room, count, items);
}

XrResult XRAPI_CALL createSpace(XrSession session, const XrReferenceSpaceCreateInfo* info, XrSpace* space) {
  KNOWN_SESSION();
  if (info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_STAGE && s.has("local"))
    return s.fault(XR_ERROR_REFERENCE_SPACE_UNSUPPORTED, "STAGE, which is not there");
  const bool head = info->referenceSpaceType == XR_REFERENCE_SPACE_TYPE_VIEW;
  s.note("space " + std::to_string(info->referenceSpaceType));
  s.spaces[++s.handles] = {head ? Space::Of::Head : Space::Of::Room, 0};
  *space = handleOf<XrSpace>(s.handles);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createActionSpace(XrSession session, const XrActionSpaceCreateInfo* info, XrSpace* space) {
  KNOWN_SESSION();
  const auto action = s.actions.find(number(info->action));
  if (action == s.actions.end() || action->second.type != XR_ACTION_TYPE_POSE_INPUT)
    return s.fault(XR_ERROR_ACTION_TYPE_MISMATCH, "a space of no pose");
  const std::size_t path = info->subactionPath;
  if (path == 0 || path > s.paths.size()) return s.fault(XR_ERROR_PATH_INVALID, "a space of no hand");
  bool aim = false;
  for (const auto& [profile, bound] : action->second.bound)
    for (const std::string& p : bound) aim |= p.ends_with("/aim/pose");
  s.spaces[++s.handles] = {aim ? Space::Of::Aim : Space::Of::Palm, s.paths[path - 1] == "/user/hand/left" ? 0u : 1u};
  *space = handleOf<XrSpace>(s.handles);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroySpace(XrSpace space) {
  Stub& s = stub();
  if (s.spaces.erase(number(space)) == 0) return s.fault(XR_ERROR_HANDLE_INVALID, "xrDestroySpace");
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locateSpace(XrSpace space, XrSpace base, XrTime time, XrSpaceLocation* at) {
  KNOWN_INSTANCE();
  if (s.lost) return XR_ERROR_SESSION_LOST;
  const auto found = s.spaces.find(number(space)), room = s.spaces.find(number(base));
  if (found == s.spaces.end() || room == s.spaces.end() || room->second.of != Space::Of::Room)
    return s.fault(XR_ERROR_HANDLE_INVALID, "xrLocateSpace");
  if (time <= 0) return s.fault(XR_ERROR_TIME_INVALID, "xrLocateSpace's time");
  const long picture = pictureAt(time);
  constexpr auto kAll = XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT |
                        XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
  at->locationFlags = kAll;
  at->pose = poseOf({});
  if (found->second.of == Space::Of::Head) {
    at->pose = poseOf(headAt(picture));
  } else if (found->second.of != Space::Of::Room) {
    const ControllerState hand = s.script.handAt(found->second.side, picture);
    if (!hand.tracked || s.state != XR_SESSION_STATE_FOCUSED)
      at->locationFlags = 0;
    else
      at->pose = poseOf(found->second.of == Space::Of::Aim ? hand.aim : hand.grip);
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL locateViews(XrSession session, const XrViewLocateInfo* info, XrViewState* state, std::uint32_t room,
                                std::uint32_t* count, XrView* views) {
  KNOWN_SESSION();
  *count = 2;
  if (room == 0) return XR_SUCCESS;
  if (room < 2) return XR_ERROR_SIZE_INSUFFICIENT;
  const Rigid head = headAt(pictureAt(info->displayTime));
  state->viewStateFlags = XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    if (views[eye].type != XR_TYPE_VIEW) return s.fault(XR_ERROR_VALIDATION_FAILURE, "view's type");
    Rigid turned = karinui::after(head, karinui::turnAbout({0, 1, 0}, eye == 0 ? kCant : -kCant));
    turned.carry = head({eye == 0 ? -kEyesApart / 2 : kEyesApart / 2, 0, 0});
    views[eye].pose = s.eyes[eye] = poseOf(turned);
    views[eye].fov = kFov[eye];
  }
  return XR_SUCCESS;
}

std::vector<std::int64_t> formatsOf() {
  if (stub().has("linear")) return {GL_RGBA16F, GL_RGBA8};
  return {GL_RGBA16F, GL_SRGB8_ALPHA8, GL_RGBA8};
}

XrResult XRAPI_CALL enumerateFormats(XrSession session, std::uint32_t room, std::uint32_t* count, std::int64_t* items) {
  KNOWN_SESSION();
  return fill(formatsOf(), room, count, items);
}

XrResult XRAPI_CALL createSwapchain(XrSession session, const XrSwapchainCreateInfo* info, XrSwapchain* chain) {
  KNOWN_SESSION();
  s.note("xrCreateSwapchain " + std::to_string(info->format));
  const auto formats = formatsOf();
  if (std::find(formats.begin(), formats.end(), info->format) == formats.end())
    return s.fault(XR_ERROR_SWAPCHAIN_FORMAT_UNSUPPORTED, "a format that was not offered");
  const auto side = static_cast<std::uint32_t>(kSide);
  if (info->width != side || info->height != side || info->sampleCount != 1 || info->arraySize != 1 ||
      info->faceCount != 1 || info->mipCount != 1)
    return s.fault(XR_ERROR_VALIDATION_FAILURE, "a swapchain that was not recommended");
  Chain made;
  made.format = info->format;
  GLint before = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &before);
  glGenTextures(kImages, made.textures);
  for (const unsigned texture : made.textures) {
    glBindTexture(GL_TEXTURE_2D, texture);
    const bool half = info->format == GL_RGBA16F;
    glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(info->format), kSide, kSide, 0, GL_RGBA,
                 half ? GL_HALF_FLOAT : GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  }
  glBindTexture(GL_TEXTURE_2D, static_cast<unsigned>(before));
  s.chains[++s.handles] = made;
  *chain = handleOf<XrSwapchain>(s.handles);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroySwapchain(XrSwapchain chain) {
  Stub& s = stub();
  const auto found = s.chains.find(number(chain));
  if (found == s.chains.end()) return s.fault(XR_ERROR_HANDLE_INVALID, "xrDestroySwapchain");
  glDeleteTextures(kImages, found->second.textures);
  s.chains.erase(found);
  return XR_SUCCESS;
}

#define KNOWN_CHAIN()                                                                                      \
  KNOWN_INSTANCE();                                                                                        \
  if (s.lost) return XR_ERROR_SESSION_LOST;                                                                \
  const auto found = s.chains.find(number(chain));                                                         \
  if (found == s.chains.end()) return s.fault(XR_ERROR_HANDLE_INVALID, std::string(__func__) + ": chain"); \
  Chain& c = found->second

XrResult XRAPI_CALL enumerateImages(XrSwapchain chain, std::uint32_t room, std::uint32_t* count,
                                    XrSwapchainImageBaseHeader* items) {
  KNOWN_CHAIN();
  *count = kImages;
  if (room == 0) return XR_SUCCESS;
  if (room < kImages) return XR_ERROR_SIZE_INSUFFICIENT;
  auto* images = reinterpret_cast<XrSwapchainImageOpenGLKHR*>(items);
  for (std::size_t i = 0; i < kImages; ++i) {
    if (images[i].type != XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR)
      return s.fault(XR_ERROR_VALIDATION_FAILURE, "swapchain image's type");
    images[i].image = c.textures[i];
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL acquireImage(XrSwapchain chain, const XrSwapchainImageAcquireInfo*, std::uint32_t* index) {
  KNOWN_CHAIN();
  if (c.acquired.size() == kImages) return s.fault(XR_ERROR_CALL_ORDER_INVALID, "all images are acquired");
  if (!s.rendering) s.fault(XR_SUCCESS, "an image is acquired outside a frame");
  *index = c.next;
  c.acquired.push_back(c.next);
  c.next = (c.next + 1) % kImages;
  return XR_SUCCESS;
}
XrResult XRAPI_CALL waitImage(XrSwapchain chain, const XrSwapchainImageWaitInfo*) {
  KNOWN_CHAIN();
  if (c.acquired.empty() || c.waited) return s.fault(XR_ERROR_CALL_ORDER_INVALID, "waited for no image");
  c.waited = true;
  return XR_SUCCESS;
}
XrResult XRAPI_CALL releaseImage(XrSwapchain chain, const XrSwapchainImageReleaseInfo*) {
  KNOWN_CHAIN();
  if (!c.waited) return s.fault(XR_ERROR_CALL_ORDER_INVALID, "released before it was waited for");
  c.last = c.acquired.front();
  c.acquired.pop_front();
  c.waited = false, c.everReleased = true;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL waitFrame(XrSession session, const XrFrameWaitInfo*, XrFrameState* state) {
  KNOWN_SESSION();
  if (!s.running) return s.fault(XR_ERROR_SESSION_NOT_RUNNING, "xrWaitFrame before the session runs");
  if (s.waited != s.begun)
    return s.fault(XR_ERROR_CALL_ORDER_INVALID, "waited for a second frame before the first began");
  ++s.waited;
  playEvents();
  if (s.lost) return XR_ERROR_SESSION_LOST;
  if (s.has("slow")) std::this_thread::sleep_for(std::chrono::nanoseconds(kPeriod));
  state->predictedDisplayTime = timeOf(s.waited);
  state->predictedDisplayPeriod = kPeriod;
  state->shouldRender = s.state >= XR_SESSION_STATE_VISIBLE && s.state <= XR_SESSION_STATE_FOCUSED ? XR_TRUE : XR_FALSE;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL beginFrame(XrSession session, const XrFrameBeginInfo*) {
  KNOWN_SESSION();
  if (!s.running) return s.fault(XR_ERROR_SESSION_NOT_RUNNING, "xrBeginFrame before the session runs");
  if (s.begun == s.waited) return s.fault(XR_ERROR_CALL_ORDER_INVALID, "begun without waiting");
  const bool discarded = s.rendering;
  s.begun = s.waited, s.rendering = true;
  return discarded ? s.fault(XR_FRAME_DISCARDED, "the frame before was never ended") : XR_SUCCESS;
}

// The submitted picture as sRGB bytes, rows from the top.
void leave(const Chain& chain, const std::string& path) {
  GLint before = 0, target = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
  unsigned name = 0;
  glGenFramebuffers(1, &name);
  target = static_cast<GLint>(name);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned>(target));
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, chain.textures[chain.last], 0);
  const auto side = static_cast<std::size_t>(kSide);
  std::vector<float> pixels(3 * side * side);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, kSide, kSide, GL_RGB, GL_FLOAT, pixels.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned>(before));
  glDeleteFramebuffers(1, &name);
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << kSide << " " << kSide << "\n255\n";
  for (int y = kSide - 1; y >= 0; --y)
    for (int i = 0; i < 3 * kSide; ++i) {
      double v = pixels[3 * side * static_cast<std::size_t>(y) + static_cast<std::size_t>(i)];
      if (chain.format != GL_SRGB8_ALPHA8) v = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
      file.put(static_cast<char>(std::lround(255 * std::fmin(1, std::fmax(0, v)))));
    }
}

XrResult XRAPI_CALL endFrame(XrSession session, const XrFrameEndInfo* info) {
  KNOWN_SESSION();
  if (!s.rendering) return s.fault(XR_ERROR_CALL_ORDER_INVALID, "ended without beginning");
  s.rendering = false, s.ended = s.begun;
  if (info->displayTime != timeOf(s.begun)) s.fault(XR_SUCCESS, "not the time that was predicted");
  if (info->environmentBlendMode != XR_ENVIRONMENT_BLEND_MODE_OPAQUE)
    return s.fault(XR_ERROR_ENVIRONMENT_BLEND_MODE_UNSUPPORTED, "not opaque");
  for (std::uint32_t k = 0; k < info->layerCount; ++k) {
    if (info->layers[k]->type != XR_TYPE_COMPOSITION_LAYER_PROJECTION)
      return s.fault(XR_ERROR_LAYER_INVALID, "an unknown layer");
    const auto& layer = *reinterpret_cast<const XrCompositionLayerProjection*>(info->layers[k]);
    if (layer.viewCount != 2) return s.fault(XR_ERROR_VALIDATION_FAILURE, "not two views");
    if (s.spaces.find(number(layer.space)) == s.spaces.end()) return s.fault(XR_ERROR_HANDLE_INVALID, "layer's space");
    for (std::size_t eye = 0; eye < 2; ++eye) {
      const XrCompositionLayerProjectionView& view = layer.views[eye];
      const auto chain = s.chains.find(number(view.subImage.swapchain));
      if (chain == s.chains.end()) return s.fault(XR_ERROR_HANDLE_INVALID, "layer's swapchain");
      if (!chain->second.everReleased || !chain->second.acquired.empty())
        return s.fault(XR_ERROR_LAYER_INVALID, "a swapchain that was not released");
      if (std::memcmp(&view.pose, &s.eyes[eye], sizeof view.pose) != 0 ||
          std::memcmp(&view.fov, &kFov[eye], sizeof view.fov) != 0)
        s.fault(XR_SUCCESS, "a view that was not located");
      if (view.subImage.imageRect.extent.width != kSide || view.subImage.imageRect.extent.height != kSide)
        return s.fault(XR_ERROR_SWAPCHAIN_RECT_INVALID, "layer's rectangle");
      for (const std::string& name : s.wanted)
        leave(chain->second, s.folder + "/" + name + (eye == 0 ? "_left.ppm" : "_right.ppm"));
    }
    s.wanted.clear();
  }
  s.firstEnd = true;
  strive();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL stringToPath(XrInstance, const char* text, XrPath* path) {
  KNOWN_INSTANCE();
  const auto found = std::find(s.paths.begin(), s.paths.end(), text);
  if (found == s.paths.end()) s.paths.emplace_back(text);
  *path = static_cast<XrPath>(std::find(s.paths.begin(), s.paths.end(), text) - s.paths.begin()) + 1;
  return XR_SUCCESS;
}
XrResult XRAPI_CALL pathToString(XrInstance, XrPath path, std::uint32_t room, std::uint32_t* count, char* text) {
  KNOWN_INSTANCE();
  if (path == 0 || path > s.paths.size()) return s.fault(XR_ERROR_PATH_INVALID, "xrPathToString");
  const std::string& said = s.paths[path - 1];
  *count = static_cast<std::uint32_t>(said.size() + 1);
  if (room == 0) return XR_SUCCESS;
  if (room < *count) return XR_ERROR_SIZE_INSUFFICIENT;
  std::memcpy(text, said.c_str(), said.size() + 1);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createActionSet(XrInstance, const XrActionSetCreateInfo* info, XrActionSet* set) {
  KNOWN_INSTANCE();
  for (const auto& [n, known] : s.sets)
    if (known.name == info->actionSetName) return s.fault(XR_ERROR_NAME_DUPLICATED, "action set's name");
  s.sets[++s.handles] = {info->actionSetName, false};
  *set = handleOf<XrActionSet>(s.handles);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL destroyActionSet(XrActionSet set) {
  Stub& s = stub();
  if (s.sets.erase(number(set)) == 0) return s.fault(XR_ERROR_HANDLE_INVALID, "xrDestroyActionSet");
  std::erase_if(s.actions, [&](const auto& a) { return a.second.set == number(set); });
  return XR_SUCCESS;
}
XrResult XRAPI_CALL createAction(XrActionSet set, const XrActionCreateInfo* info, XrAction* action) {
  KNOWN_INSTANCE();
  const auto found = s.sets.find(number(set));
  if (found == s.sets.end()) return s.fault(XR_ERROR_HANDLE_INVALID, "xrCreateAction");
  if (found->second.attached) return s.fault(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "xrCreateAction");
  if (info->countSubactionPaths != 2) s.fault(XR_SUCCESS, "an action without hands");
  s.actions[++s.handles] = {number(set), info->actionType, info->actionName, {}};
  *action = handleOf<XrAction>(s.handles);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL destroyAction(XrAction) { return XR_SUCCESS; }

// What each controller of the specification has (6.4, "Interaction Profile Paths").
const std::map<std::string, std::set<std::string>>& componentsOf() {
  static const std::map<std::string, std::set<std::string>> all{
      {"/interaction_profiles/khr/simple_controller",
       {"/input/select/click", "/input/menu/click", "/input/grip/pose", "/input/aim/pose", "/output/haptic"}},
      {"/interaction_profiles/oculus/touch_controller",
       {"/input/squeeze/value", "/input/trigger/value", "/input/trigger/touch", "/input/thumbstick",
        "/input/thumbstick/x", "/input/thumbstick/y", "/input/thumbstick/click", "/input/thumbstick/touch",
        "/input/grip/pose", "/input/aim/pose", "/output/haptic", "left/input/x/click", "left/input/y/click",
        "left/input/menu/click", "right/input/a/click", "right/input/b/click"}},
      {"/interaction_profiles/valve/index_controller",
       {"/input/a/click", "/input/b/click", "/input/squeeze/value", "/input/squeeze/force", "/input/trigger/click",
        "/input/trigger/value", "/input/thumbstick", "/input/thumbstick/click", "/input/trackpad", "/input/grip/pose",
        "/input/aim/pose", "/output/haptic"}}};
  return all;
}

XrResult XRAPI_CALL suggest(XrInstance, const XrInteractionProfileSuggestedBinding* info) {
  KNOWN_INSTANCE();
  const std::string profile = info->interactionProfile > 0 && info->interactionProfile <= s.paths.size()
                                  ? s.paths[info->interactionProfile - 1]
                                  : "";
  const auto known = componentsOf().find(profile);
  if (known == componentsOf().end()) return s.fault(XR_ERROR_PATH_UNSUPPORTED, "an unknown controller: " + profile);
  s.note("suggested " + profile);
  for (std::uint32_t i = 0; i < info->countSuggestedBindings; ++i) {
    const auto action = s.actions.find(number(info->suggestedBindings[i].action));
    if (action == s.actions.end()) return s.fault(XR_ERROR_HANDLE_INVALID, "a binding of no action");
    if (s.sets[action->second.set].attached)
      return s.fault(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "a binding after attaching");
    const std::string path = s.paths.at(info->suggestedBindings[i].binding - 1);
    bool there = false;
    for (const std::string side : {"left", "right"})
      for (const std::string& component : known->second)
        there |= path == "/user/hand/" + (component[0] == '/' ? side + component : component);
    if (!there) return s.fault(XR_ERROR_PATH_UNSUPPORTED, profile + " has no " + path);
    action->second.bound[profile].insert(path);
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL attachSets(XrSession session, const XrSessionActionSetsAttachInfo* info) {
  KNOWN_SESSION();
  s.note("xrAttachSessionActionSets");
  if (s.attached) return s.fault(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "attached twice");
  for (std::uint32_t i = 0; i < info->countActionSets; ++i) s.sets[number(info->actionSets[i])].attached = true;
  s.attached = true;
  XrEventDataBuffer buffer{};
  auto& event = reinterpret_cast<XrEventDataInteractionProfileChanged&>(buffer);
  event.type = XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED;
  event.session = session;
  s.events.push_back(buffer);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL currentProfile(XrSession session, XrPath, XrInteractionProfileState* state) {
  KNOWN_SESSION();
  if (!s.attached) return s.fault(XR_ERROR_ACTIONSET_NOT_ATTACHED, "the profile before attaching");
  return stringToPath(XR_NULL_HANDLE, s.profile().c_str(), &state->interactionProfile);
}

XrResult XRAPI_CALL syncActions(XrSession session, const XrActionsSyncInfo* info) {
  KNOWN_SESSION();
  for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i)
    if (!s.attached || !s.sets[number(info->activeActionSets[i].actionSet)].attached)
      return s.fault(XR_ERROR_ACTIONSET_NOT_ATTACHED, "synchronised before attaching");
  return s.state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}

// The action of a hand, and whether the controller in it has what it is bound to.
const Action* actionOf(const XrActionStateGetInfo* info, XrActionType type, std::size_t& side, bool& active,
                       XrResult& result) {
  Stub& s = stub();
  const auto found = s.actions.find(number(info->action));
  result = XR_SUCCESS;
  if (found == s.actions.end()) return result = s.fault(XR_ERROR_HANDLE_INVALID, "a state of no action"), nullptr;
  if (found->second.type != type)
    return result = s.fault(XR_ERROR_ACTION_TYPE_MISMATCH, "a state of another type: " + found->second.name), nullptr;
  if (info->subactionPath == 0 || info->subactionPath > s.paths.size())
    return result = s.fault(XR_ERROR_PATH_INVALID, "a state of no hand"), nullptr;
  const std::string hand = s.paths[info->subactionPath - 1];
  side = hand == "/user/hand/left" ? 0 : 1;
  active = false;
  const auto bound = found->second.bound.find(s.profile());
  if (bound != found->second.bound.end())
    for (const std::string& path : bound->second) active |= path.starts_with(hand);
  active = active && s.state == XR_SESSION_STATE_FOCUSED && s.script.handAt(side, s.waited).tracked;
  return &found->second;
}

XrResult XRAPI_CALL getFloat(XrSession session, const XrActionStateGetInfo* info, XrActionStateFloat* state) {
  KNOWN_SESSION();
  std::size_t side = 0;
  bool active = false;
  XrResult result = XR_SUCCESS;
  const Action* action = actionOf(info, XR_ACTION_TYPE_FLOAT_INPUT, side, active, result);
  if (!action) return result;
  const ControllerState hand = s.script.handAt(side, s.waited);
  state->isActive = active;
  state->currentState = static_cast<float>(!active ? 0 : action->name == "act" ? hand.trigger : hand.hold);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL getBoolean(XrSession session, const XrActionStateGetInfo* info, XrActionStateBoolean* state) {
  KNOWN_SESSION();
  std::size_t side = 0;
  bool active = false;
  XrResult result = XR_SUCCESS;
  const Action* action = actionOf(info, XR_ACTION_TYPE_BOOLEAN_INPUT, side, active, result);
  if (!action) return result;
  const ControllerState hand = s.script.handAt(side, s.waited);
  state->isActive = active;
  state->currentState = active && (action->name == "finish"   ? hand.confirm
                                   : action->name == "cancel" ? hand.cancel
                                                              : hand.scaleSwitch);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL getVector(XrSession session, const XrActionStateGetInfo* info, XrActionStateVector2f* state) {
  KNOWN_SESSION();
  std::size_t side = 0;
  bool active = false;
  XrResult result = XR_SUCCESS;
  if (!actionOf(info, XR_ACTION_TYPE_VECTOR2F_INPUT, side, active, result)) return result;
  const ControllerState hand = s.script.handAt(side, s.waited);
  state->isActive = active;
  if (active) state->currentState = {static_cast<float>(hand.stick.u), static_cast<float>(hand.stick.v)};
  return XR_SUCCESS;
}
XrResult XRAPI_CALL getPose(XrSession session, const XrActionStateGetInfo* info, XrActionStatePose* state) {
  KNOWN_SESSION();
  std::size_t side = 0;
  bool active = false;
  XrResult result = XR_SUCCESS;
  if (!actionOf(info, XR_ACTION_TYPE_POSE_INPUT, side, active, result)) return result;
  state->isActive = active;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL vibrate(XrSession session, const XrHapticActionInfo* info, const XrHapticBaseHeader* how) {
  KNOWN_SESSION();
  if (s.state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
  const auto found = s.actions.find(number(info->action));
  if (found == s.actions.end() || found->second.type != XR_ACTION_TYPE_VIBRATION_OUTPUT)
    return s.fault(XR_ERROR_ACTION_TYPE_MISMATCH, "a vibration of no motor");
  if (how->type != XR_TYPE_HAPTIC_VIBRATION) return s.fault(XR_ERROR_VALIDATION_FAILURE, "vibration's type");
  const auto& pulse = *reinterpret_cast<const XrHapticVibration*>(how);
  if (!(pulse.amplitude >= 0 && pulse.amplitude <= 1) || pulse.duration <= 0)
    s.fault(XR_ERROR_VALIDATION_FAILURE, "a vibration out of its range");
  s.vibration << s.waited << " " << s.paths.at(info->subactionPath - 1) << " " << pulse.amplitude << " "
              << pulse.duration << "\n";
  s.vibration.flush();
  return XR_SUCCESS;
}
XrResult XRAPI_CALL stopVibration(XrSession session, const XrHapticActionInfo*) {
  KNOWN_SESSION();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL procAddress(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  static const std::map<std::string, PFN_xrVoidFunction> all = [] {
    std::map<std::string, PFN_xrVoidFunction> made;
    const auto add = [&](const char* n, auto f) { made[n] = reinterpret_cast<PFN_xrVoidFunction>(f); };
    add("xrGetInstanceProcAddr", procAddress);
    add("xrEnumerateInstanceExtensionProperties", enumerateExtensions);
    add("xrCreateInstance", createInstance);
    add("xrDestroyInstance", destroyInstance);
    add("xrGetInstanceProperties", getInstanceProperties);
    add("xrPollEvent", pollEvent);
    add("xrResultToString", resultToString);
    add("xrStructureTypeToString", structureTypeToString);
    add("xrGetSystem", getSystem);
    add("xrGetSystemProperties", getSystemProperties);
    add("xrEnumerateEnvironmentBlendModes", enumerateBlends);
    add("xrEnumerateViewConfigurations", enumerateConfigurations);
    add("xrGetViewConfigurationProperties", configurationProperties);
    add("xrEnumerateViewConfigurationViews", enumerateViews);
    add("xrGetOpenGLGraphicsRequirementsKHR", graphicsRequirements);
    add("xrCreateSession", createSession);
    add("xrDestroySession", destroySession);
    add("xrBeginSession", beginSession);
    add("xrEndSession", endSession);
    add("xrRequestExitSession", requestExit);
    add("xrEnumerateReferenceSpaces", enumerateSpaces);
    add("xrCreateReferenceSpace", createSpace);
    add("xrCreateActionSpace", createActionSpace);
    add("xrDestroySpace", destroySpace);
    add("xrLocateSpace", locateSpace);
    add("xrLocateViews", locateViews);
    add("xrEnumerateSwapchainFormats", enumerateFormats);
    add("xrCreateSwapchain", createSwapchain);
    add("xrDestroySwapchain", destroySwapchain);
    add("xrEnumerateSwapchainImages", enumerateImages);
    add("xrAcquireSwapchainImage", acquireImage);
    add("xrWaitSwapchainImage", waitImage);
    add("xrReleaseSwapchainImage", releaseImage);
    add("xrWaitFrame", waitFrame);
    add("xrBeginFrame", beginFrame);
    add("xrEndFrame", endFrame);
    add("xrStringToPath", stringToPath);
    add("xrPathToString", pathToString);
    add("xrCreateActionSet", createActionSet);
    add("xrDestroyActionSet", destroyActionSet);
    add("xrCreateAction", createAction);
    add("xrDestroyAction", destroyAction);
    add("xrSuggestInteractionProfileBindings", suggest);
    add("xrAttachSessionActionSets", attachSets);
    add("xrGetCurrentInteractionProfile", currentProfile);
    add("xrSyncActions", syncActions);
    add("xrGetActionStateFloat", getFloat);
    add("xrGetActionStateBoolean", getBoolean);
    add("xrGetActionStateVector2f", getVector);
    add("xrGetActionStatePose", getPose);
    add("xrApplyHapticFeedback", vibrate);
    add("xrStopHapticFeedback", stopVibration);
    return made;
  }();
  const auto found = all.find(name);
  *function = found == all.end() ? nullptr : found->second;
  return *function ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) XrResult XRAPI_CALL
xrNegotiateLoaderRuntimeInterface(const XrNegotiateLoaderInfo* loader, XrNegotiateRuntimeRequest* request) {
  if (!loader || !request || loader->minInterfaceVersion > 1 || loader->maxInterfaceVersion < 1)
    return XR_ERROR_INITIALIZATION_FAILED;
  request->runtimeInterfaceVersion = 1;
  request->runtimeApiVersion = XR_CURRENT_API_VERSION;
  request->getInstanceProcAddr = procAddress;
  return XR_SUCCESS;
}

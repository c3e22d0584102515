#include "stub.h"

#include <cstdlib>
#include <sstream>

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

namespace karinui::room::stub {

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
    if (const std::string side = from("KARINUI_STUB_SIDE"); !side.empty()) kSide = std::atoi(side.c_str());
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

namespace {

XrResult XRAPI_CALL procAddress(XrInstance, const char* name, PFN_xrVoidFunction* function) {
  static const Calls all = [] {
    Calls made;
    add(made, "xrGetInstanceProcAddr", procAddress);
    addInstance(made), addSession(made), addSwapchains(made), addActions(made);
    return made;
  }();
  const auto found = all.find(name);
  *function = found == all.end() ? nullptr : found->second;
  return *function ? XR_SUCCESS : XR_ERROR_FUNCTION_UNSUPPORTED;
}

}  // namespace

}  // namespace karinui::room::stub

extern "C" __attribute__((visibility("default"))) XrResult XRAPI_CALL
xrNegotiateLoaderRuntimeInterface(const XrNegotiateLoaderInfo* loader, XrNegotiateRuntimeRequest* request) {
  if (!loader || !request || loader->minInterfaceVersion > 1 || loader->maxInterfaceVersion < 1)
    return XR_ERROR_INITIALIZATION_FAILED;
  request->runtimeInterfaceVersion = 1;
  request->runtimeApiVersion = XR_CURRENT_API_VERSION;
  request->getInstanceProcAddr = karinui::room::stub::procAddress;
  return XR_SUCCESS;
}

#include "stub.h"

namespace karinui::room::stub {

namespace {

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
    if (s.has("refuses_egl")) return s.note("refused EGL"), XR_ERROR_GRAPHICS_DEVICE_INVALID;
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

}  // namespace

void addSession(Calls& calls) {
  add(calls, "xrCreateSession", createSession);
  add(calls, "xrDestroySession", destroySession);
  add(calls, "xrBeginSession", beginSession);
  add(calls, "xrEndSession", endSession);
  add(calls, "xrRequestExitSession", requestExit);
  add(calls, "xrEnumerateReferenceSpaces", enumerateSpaces);
  add(calls, "xrCreateReferenceSpace", createSpace);
  add(calls, "xrCreateActionSpace", createActionSpace);
  add(calls, "xrDestroySpace", destroySpace);
  add(calls, "xrLocateSpace", locateSpace);
  add(calls, "xrLocateViews", locateViews);
}

}  // namespace karinui::room::stub

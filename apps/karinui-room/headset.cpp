// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include "headset.h"
#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr_platform.h>

#include <algorithm>

#include "xr_values.h"

namespace karinui::room {

namespace {

constexpr std::size_t kMostFailures = 32;

}  // namespace

bool Headset::check(XrResult result, const char* call) {
  if (XR_SUCCEEDED(result)) {
    if (result == XR_SESSION_LOSS_PENDING && status_ == HeadsetStatus::Good) status_ = HeadsetStatus::SessionLost;
    return true;
  }
  if (result == XR_ERROR_INSTANCE_LOST)
    status_ = HeadsetStatus::InstanceLost;
  else if (result == XR_ERROR_SESSION_LOST && status_ == HeadsetStatus::Good)
    status_ = HeadsetStatus::SessionLost;
  else if (failures_.size() < kMostFailures)
    failures_.push_back(std::string(call) + ": " + nameOf(result));
  return false;
}

Result<std::unique_ptr<Headset>> Headset::open(const Runtime& runtime, Graphics& graphics) {
  std::unique_ptr<Headset> made(new Headset(runtime, graphics));
  for (const auto step : {&Headset::openSystem, &Headset::openSession, &Headset::openSpaces, &Headset::openSwapchains})
    if (const Done done = ((*made).*step)(); !done) return done.error();
  return made;
}

Done Headset::openSystem() {
  XrSystemGetInfo wanted{};
  wanted.type = XR_TYPE_SYSTEM_GET_INFO;
  wanted.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
  const XrResult got = xrGetSystem(runtime_.instance(), &wanted, &systemId_);
  if (got == XR_ERROR_FORM_FACTOR_UNAVAILABLE)
    return notFound(say("The headset is not connected, or is asleep. Connect it and put it on; the garment waits."));
  if (got == XR_ERROR_INSTANCE_LOST) status_ = HeadsetStatus::InstanceLost;
  if (XR_FAILED(got)) return refused(say("{0} knows no headset ({1}).", runtime_.name(), nameOf(got)));
  XrSystemProperties about{};
  about.type = XR_TYPE_SYSTEM_PROPERTIES;
  if (XR_SUCCEEDED(xrGetSystemProperties(runtime_.instance(), systemId_, &about))) system_ = about.systemName;

  const auto kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  std::vector<XrViewConfigurationType> ways;
  list(ways, kStereo, [&](std::uint32_t room, std::uint32_t* count, XrViewConfigurationType* items) {
    return xrEnumerateViewConfigurations(runtime_.instance(), systemId_, room, count, items);
  });
  if (std::find(ways.begin(), ways.end(), kStereo) == ways.end())
    return refused(say("“{0}” does not show two pictures, one for each eye.", system_));
  XrViewConfigurationView like{};
  like.type = XR_TYPE_VIEW_CONFIGURATION_VIEW;
  std::vector<XrViewConfigurationView> views;
  list(views, like, [&](std::uint32_t room, std::uint32_t* count, XrViewConfigurationView* items) {
    return xrEnumerateViewConfigurationViews(runtime_.instance(), systemId_, kStereo, room, count, items);
  });
  if (views.size() != eyes_.size()) return refused(say("“{0}” does not show two pictures, one for each eye.", system_));
  for (std::size_t eye = 0; eye < eyes_.size(); ++eye)
    eyes_[eye].width = views[eye].recommendedImageRectWidth, eyes_[eye].height = views[eye].recommendedImageRectHeight;
  std::vector<XrEnvironmentBlendMode> blends;
  list(blends, blend_, [&](std::uint32_t room, std::uint32_t* count, XrEnvironmentBlendMode* items) {
    return xrEnumerateEnvironmentBlendModes(runtime_.instance(), systemId_, kStereo, room, count, items);
  });
  if (!blends.empty() && std::find(blends.begin(), blends.end(), blend_) == blends.end()) blend_ = blends.front();
  return {};
}

Done Headset::openSession() {
  // The specification wants this asked before a session is made.
  PFN_xrGetOpenGLGraphicsRequirementsKHR ask = nullptr;
  XrGraphicsRequirementsOpenGLKHR needs{};
  needs.type = XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR;
  XrResult r = xrGetInstanceProcAddr(runtime_.instance(), "xrGetOpenGLGraphicsRequirementsKHR",
                                     reinterpret_cast<PFN_xrVoidFunction*>(&ask));
  if (XR_SUCCEEDED(r)) r = ask(runtime_.instance(), systemId_, &needs);
  if (XR_FAILED(r)) return refused(say("{0} shares no OpenGL pictures ({1}).", runtime_.name(), nameOf(r)));
  graphics_.makeCurrent();
  const int have = epoxy_gl_version();
  if (XR_MAKE_VERSION(have / 10, have % 10, 0) < needs.minApiVersionSupported)
    return refused(say("{0} needs OpenGL {1}.{2}; this machine's driver offers {3}.{4}.", runtime_.name(),
                       static_cast<int>(XR_VERSION_MAJOR(needs.minApiVersionSupported)),
                       static_cast<int>(XR_VERSION_MINOR(needs.minApiVersionSupported)), have / 10, have % 10));
  XrSessionCreateInfo create{};
  create.type = XR_TYPE_SESSION_CREATE_INFO;
  create.next = graphics_.binding();
  create.systemId = systemId_;
  r = xrCreateSession(runtime_.instance(), &create, &session_);
  graphics_.makeCurrent();
  if (XR_FAILED(r)) {
    session_ = XR_NULL_HANDLE;
    return refused(say("{0} would not begin: {1}.", runtime_.name(), nameOf(r)));
  }
  return {};
}

Done Headset::openSpaces() {
  std::vector<XrReferenceSpaceType> there;
  list(there, XR_REFERENCE_SPACE_TYPE_LOCAL,
       [&](std::uint32_t room, std::uint32_t* count, XrReferenceSpaceType* items) {
         return xrEnumerateReferenceSpaces(session_, room, count, items);
       });
  stage_ = std::find(there.begin(), there.end(), XR_REFERENCE_SPACE_TYPE_STAGE) != there.end();
  XrReferenceSpaceCreateInfo create{};
  create.type = XR_TYPE_REFERENCE_SPACE_CREATE_INFO;
  create.poseInReferenceSpace.orientation.w = 1;
  create.referenceSpaceType = stage_ ? XR_REFERENCE_SPACE_TYPE_STAGE : XR_REFERENCE_SPACE_TYPE_LOCAL;
  XrResult r = xrCreateReferenceSpace(session_, &create, &space_);
  create.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_VIEW;
  if (XR_SUCCEEDED(r)) r = xrCreateReferenceSpace(session_, &create, &headSpace_);
  if (XR_FAILED(r)) return refused(say("{0} would not begin: {1}.", runtime_.name(), nameOf(r)));
  return {};
}

Done Headset::openSwapchains() {
  std::vector<std::int64_t> formats;
  list(formats, std::int64_t{0}, [&](std::uint32_t room, std::uint32_t* count, std::int64_t* items) {
    return xrEnumerateSwapchainFormats(session_, room, count, items);
  });
  const auto format = formatAmong(formats);
  if (!format) return refused(say("{0} offers no kind of picture that Karinui can draw.", runtime_.name()));
  format_ = *format;
  for (EyeChain& eye : eyes_) {
    XrSwapchainCreateInfo create{};
    create.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
    create.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
    create.format = format_;
    create.sampleCount = 1;
    create.width = eye.width, create.height = eye.height;
    create.faceCount = create.arraySize = create.mipCount = 1;
    XrResult r = xrCreateSwapchain(session_, &create, &eye.chain);
    XrSwapchainImageOpenGLKHR like{};
    like.type = XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR;
    std::vector<XrSwapchainImageOpenGLKHR> images;
    if (XR_SUCCEEDED(r))
      r = list(images, like, [&](std::uint32_t room, std::uint32_t* count, XrSwapchainImageOpenGLKHR* items) {
        return xrEnumerateSwapchainImages(eye.chain, room, count, reinterpret_cast<XrSwapchainImageBaseHeader*>(items));
      });
    if (XR_FAILED(r)) return refused(say("{0} would not begin: {1}.", runtime_.name(), nameOf(r)));
    for (const auto& image : images) eye.textures.push_back(image.image);
  }
  graphics_.makeCurrent();
  return {};
}

Headset::~Headset() {
  graphics_.makeCurrent();
  for (EyeChain& eye : eyes_)
    if (eye.chain != XR_NULL_HANDLE) xrDestroySwapchain(eye.chain);
  for (const XrSpace space : {headSpace_, space_})
    if (space != XR_NULL_HANDLE) xrDestroySpace(space);
  if (session_ != XR_NULL_HANDLE) xrDestroySession(session_);
  graphics_.makeCurrent();
}

void Headset::changed(const XrEventDataSessionStateChanged& event) {
  if (event.session != session_) return;
  state_ = event.state;
  states_.push_back(state_);
  switch (state_) {
    case XR_SESSION_STATE_READY: {
      XrSessionBeginInfo begin{};
      begin.type = XR_TYPE_SESSION_BEGIN_INFO;
      begin.primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
      running_ = check(xrBeginSession(session_, &begin), "xrBeginSession");
      return;
    }
    case XR_SESSION_STATE_STOPPING:
      running_ = false;
      check(xrEndSession(session_), "xrEndSession");
      return;
    case XR_SESSION_STATE_LOSS_PENDING:
      running_ = false;
      if (status_ == HeadsetStatus::Good) status_ = HeadsetStatus::SessionLost;
      return;
    case XR_SESSION_STATE_EXITING:
      running_ = false;
      if (status_ == HeadsetStatus::Good) status_ = HeadsetStatus::Ended;
      return;
    default:
      return;
  }
}

Headset::News Headset::poll() {
  News news;
  for (;;) {
    XrEventDataBuffer event{};
    event.type = XR_TYPE_EVENT_DATA_BUFFER;
    const XrResult r = xrPollEvent(runtime_.instance(), &event);
    if (!check(r, "xrPollEvent") || r == XR_EVENT_UNAVAILABLE) return news;
    switch (event.type) {
      case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED:
        changed(*reinterpret_cast<const XrEventDataSessionStateChanged*>(&event));
        break;
      case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
        running_ = false;
        status_ = HeadsetStatus::InstanceLost;
        return news;
      case XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED:
        news.profileChanged = true;
        break;
      case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING: {
        const auto& change = *reinterpret_cast<const XrEventDataReferenceSpaceChangePending*>(&event);
        news.recentred |=
            change.referenceSpaceType == (stage_ ? XR_REFERENCE_SPACE_TYPE_STAGE : XR_REFERENCE_SPACE_TYPE_LOCAL);
        break;
      }
      default:
        break;
    }
  }
}

void Headset::askToEnd() {
  if (running_)
    check(xrRequestExitSession(session_), "xrRequestExitSession");
  else
    status_ = HeadsetStatus::Ended;
}

}  // namespace karinui::room

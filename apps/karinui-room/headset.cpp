// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include "headset.h"
#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr_platform.h>

#include <algorithm>
#include <cstring>

namespace karinui::room {

namespace {

constexpr const char* kSharesEgl = "XR_MNDX_egl_enable";
constexpr std::int64_t kTextureWait = 100'000'000;  // nanoseconds,
constexpr int kTextureWaits = 20;                   // so often: then the runtime is taken for dead
constexpr std::size_t kMostFailures = 32;
constexpr int kMostRefused = 50;  // frames in a row

Error noRuntime(XrResult why) {
  return notFound(
      say("No headset runtime was found. Install one (Monado, SteamVR or the headset's own) and make it the active "
          "OpenXR runtime. ({0})",
          nameOf(why)));
}

template <std::size_t Size>
void put(char (&into)[Size], const char* text) {
  std::strncpy(into, text, Size - 1);
  into[Size - 1] = 0;
}

// The two-call way of OpenXR's lists.
template <class Item, class Call>
XrResult list(std::vector<Item>& items, const Item& like, Call&& call) {
  std::uint32_t count = 0;
  if (const XrResult r = call(0, &count, static_cast<Item*>(nullptr)); XR_FAILED(r)) return r;
  items.assign(count, like);
  if (count == 0) return XR_SUCCESS;
  const XrResult r = call(count, &count, items.data());
  items.resize(XR_FAILED(r) ? 0 : count);
  return r;
}

}  // namespace

Rigid rigidOf(const XrPosef& p) {
  return {
      p.orientation.w, p.orientation.x, p.orientation.y, p.orientation.z, {p.position.x, p.position.y, p.position.z}};
}

std::string nameOf(XrResult result) {
  switch (result) {
#define KARINUI_NAME(name) \
  case name:               \
    return #name;
    KARINUI_NAME(XR_ERROR_RUNTIME_UNAVAILABLE)
    KARINUI_NAME(XR_ERROR_RUNTIME_FAILURE)
    KARINUI_NAME(XR_ERROR_FILE_ACCESS_ERROR)
    KARINUI_NAME(XR_ERROR_FILE_CONTENTS_INVALID)
    KARINUI_NAME(XR_ERROR_INSTANCE_LOST)
    KARINUI_NAME(XR_ERROR_SESSION_LOST)
    KARINUI_NAME(XR_ERROR_FORM_FACTOR_UNAVAILABLE)
    KARINUI_NAME(XR_ERROR_FORM_FACTOR_UNSUPPORTED)
    KARINUI_NAME(XR_ERROR_INITIALIZATION_FAILED)
    KARINUI_NAME(XR_ERROR_API_VERSION_UNSUPPORTED)
    KARINUI_NAME(XR_ERROR_EXTENSION_NOT_PRESENT)
    KARINUI_NAME(XR_ERROR_GRAPHICS_DEVICE_INVALID)
    KARINUI_NAME(XR_ERROR_CALL_ORDER_INVALID)
    KARINUI_NAME(XR_ERROR_LIMIT_REACHED)
    KARINUI_NAME(XR_ERROR_VALIDATION_FAILURE)
#undef KARINUI_NAME
    default:
      return "XrResult " + std::to_string(static_cast<int>(result));
  }
}

Result<std::unique_ptr<Runtime>> Runtime::open() {
  std::vector<XrExtensionProperties> offered;
  XrExtensionProperties like{};
  like.type = XR_TYPE_EXTENSION_PROPERTIES;
  const XrResult listed =
      list(offered, like, [](std::uint32_t room, std::uint32_t* count, XrExtensionProperties* items) {
        return xrEnumerateInstanceExtensionProperties(nullptr, room, count, items);
      });
  if (XR_FAILED(listed)) return noRuntime(listed);
  std::unique_ptr<Runtime> made(new Runtime);
  for (const char* wanted : {XR_KHR_OPENGL_ENABLE_EXTENSION_NAME, kSharesEgl})
    if (std::any_of(offered.begin(), offered.end(),
                    [&](const XrExtensionProperties& e) { return std::strcmp(e.extensionName, wanted) == 0; }))
      made->extensions_.emplace_back(wanted);
  if (!made->offers(XR_KHR_OPENGL_ENABLE_EXTENSION_NAME))
    return notFound(
        say("The headset runtime of this machine shares no OpenGL pictures; Karinui needs "
            "XR_KHR_opengl_enable."));
  std::vector<const char*> names;
  for (const std::string& name : made->extensions_) names.push_back(name.c_str());
  XrInstanceCreateInfo create{};
  create.type = XR_TYPE_INSTANCE_CREATE_INFO;
  put(create.applicationInfo.applicationName, "karinui-room");
  create.applicationInfo.applicationVersion = 1;
  put(create.applicationInfo.engineName, "karinui");
  create.applicationInfo.engineVersion = 1;
  create.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);  // any 1.x runtime
  create.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
  create.enabledExtensionNames = names.data();
  if (const XrResult r = xrCreateInstance(&create, &made->instance_); XR_FAILED(r)) {
    made->instance_ = XR_NULL_HANDLE;
    return notFound(say(
        "The headset runtime of this machine is installed but does not begin ({0}). Start its service and try again.",
        nameOf(r)));
  }
  XrInstanceProperties about{};
  about.type = XR_TYPE_INSTANCE_PROPERTIES;
  if (XR_SUCCEEDED(xrGetInstanceProperties(made->instance_, &about))) made->name_ = about.runtimeName;
  return made;
}

Runtime::~Runtime() {
  if (instance_ != XR_NULL_HANDLE) xrDestroyInstance(instance_);
}

bool Runtime::offers(const char* extension) const {
  return *extension == 0 || std::find(extensions_.begin(), extensions_.end(), extension) != extensions_.end();
}

XrPath Runtime::path(const char* text) const {
  XrPath path = XR_NULL_PATH;
  xrStringToPath(instance_, text, &path);
  return path;
}

std::string Runtime::pathText(XrPath path) const {
  if (path == XR_NULL_PATH) return {};
  char text[XR_MAX_PATH_LENGTH] = "";
  std::uint32_t length = 0;
  return XR_SUCCEEDED(xrPathToString(instance_, path, sizeof text, &length, text)) ? text : "";
}

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

std::optional<Headset::Frame> Headset::begin() {
  XrFrameWaitInfo wait{};
  wait.type = XR_TYPE_FRAME_WAIT_INFO;
  XrFrameState state{};
  state.type = XR_TYPE_FRAME_STATE;
  XrFrameBeginInfo begin{};
  begin.type = XR_TYPE_FRAME_BEGIN_INFO;
  if (!check(xrWaitFrame(session_, &wait, &state), "xrWaitFrame") ||
      !check(xrBeginFrame(session_, &begin), "xrBeginFrame")) {
    // A session that refuses frame after frame is begun anew.
    if (++refusedFrames_ > kMostRefused && status_ == HeadsetStatus::Good) status_ = HeadsetStatus::SessionLost;
    return std::nullopt;
  }
  refusedFrames_ = 0;
  return Frame{state.predictedDisplayTime, state.shouldRender == XR_TRUE};
}

std::optional<Rigid> Headset::head(XrTime time) {
  XrSpaceLocation at{};
  at.type = XR_TYPE_SPACE_LOCATION;
  if (!check(xrLocateSpace(headSpace_, space_, time, &at), "xrLocateSpace")) return std::nullopt;
  constexpr auto kKnown = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  if ((at.locationFlags & kKnown) != kKnown) return std::nullopt;
  return rigidOf(at.pose);
}

std::optional<std::array<Headset::View, 2>> Headset::views(XrTime time) {
  XrViewLocateInfo where{};
  where.type = XR_TYPE_VIEW_LOCATE_INFO;
  where.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  where.displayTime = time;
  where.space = space_;
  XrViewState state{};
  state.type = XR_TYPE_VIEW_STATE;
  for (XrView& view : located_) view = XrView{XR_TYPE_VIEW, nullptr, {}, {}};
  std::uint32_t count = 0;
  if (!check(xrLocateViews(session_, &where, &state, 2, &count, located_.data()), "xrLocateViews") || count != 2)
    return std::nullopt;
  constexpr auto kKnown = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
  if ((state.viewStateFlags & kKnown) != kKnown) return std::nullopt;
  std::array<View, 2> views;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const XrFovf& fov = located_[eye].fov;
    views[eye] = {rigidOf(located_[eye].pose), {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}};
  }
  return views;
}

std::optional<unsigned> Headset::acquire(std::size_t eye) {
  XrSwapchainImageAcquireInfo acquire{};
  acquire.type = XR_TYPE_SWAPCHAIN_IMAGE_ACQUIRE_INFO;
  std::uint32_t index = 0;
  if (!check(xrAcquireSwapchainImage(eyes_[eye].chain, &acquire, &index), "xrAcquireSwapchainImage"))
    return std::nullopt;
  XrSwapchainImageWaitInfo wait{};
  wait.type = XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO;
  wait.timeout = kTextureWait;
  XrResult r = XR_TIMEOUT_EXPIRED;
  // An image that was acquired must be waited for before it may be released.
  for (int k = 0; k < kTextureWaits && r == XR_TIMEOUT_EXPIRED; ++k) {
    r = xrWaitSwapchainImage(eyes_[eye].chain, &wait);
    if (!check(r, "xrWaitSwapchainImage")) return std::nullopt;
  }
  if (r == XR_TIMEOUT_EXPIRED) {
    if (status_ == HeadsetStatus::Good) status_ = HeadsetStatus::SessionLost;
    return std::nullopt;
  }
  graphics_.makeCurrent();
  if (index >= eyes_[eye].textures.size()) return std::nullopt;
  return eyes_[eye].textures[index];
}

void Headset::release(std::size_t eye) {
  XrSwapchainImageReleaseInfo release{};
  release.type = XR_TYPE_SWAPCHAIN_IMAGE_RELEASE_INFO;
  check(xrReleaseSwapchainImage(eyes_[eye].chain, &release), "xrReleaseSwapchainImage");
}

void Headset::end(const Frame& frame, bool drawn) {
  std::array<XrCompositionLayerProjectionView, 2> parts{};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    parts[eye].type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW;
    parts[eye].pose = located_[eye].pose;
    parts[eye].fov = located_[eye].fov;
    parts[eye].subImage.swapchain = eyes_[eye].chain;
    parts[eye].subImage.imageRect.extent = {width(eye), height(eye)};
  }
  XrCompositionLayerProjection layer{};
  layer.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION;
  layer.space = space_;
  layer.viewCount = 2;
  layer.views = parts.data();
  const XrCompositionLayerBaseHeader* layers[] = {reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer)};
  XrFrameEndInfo end{};
  end.type = XR_TYPE_FRAME_END_INFO;
  end.displayTime = frame.time;
  end.environmentBlendMode = blend_;
  end.layerCount = drawn ? 1 : 0;
  end.layers = drawn ? layers : nullptr;
  check(xrEndFrame(session_, &end), "xrEndFrame");
}

}  // namespace karinui::room

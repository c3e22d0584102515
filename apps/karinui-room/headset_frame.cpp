#include "headset.h"

namespace karinui::room {

namespace {

constexpr std::int64_t kTextureWait = 100'000'000;  // nanoseconds,
constexpr int kTextureWaits = 20;                   // so often: then the runtime is taken for dead
constexpr int kMostRefused = 50;                    // frames in a row

}  // namespace

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
  constexpr auto kPlaceKnown = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  if ((at.locationFlags & kPlaceKnown) != kPlaceKnown) return std::nullopt;
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
  constexpr auto kViewKnown = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
  if ((state.viewStateFlags & kViewKnown) != kViewKnown) return std::nullopt;
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

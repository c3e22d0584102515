#include "stub.h"

#include <chrono>
#include <thread>

namespace karinui::room::stub {

namespace {

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
  const bool visible = s.state >= XR_SESSION_STATE_VISIBLE && s.state <= XR_SESSION_STATE_FOCUSED;
  state->shouldRender = visible && (!s.has("seldom") || s.waited % kSeldom == 0) ? XR_TRUE : XR_FALSE;
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
  if (s.has("finish")) glFinish();  // a frame is submitted when it is drawn
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

}  // namespace

void addSwapchains(Calls& calls) {
  add(calls, "xrEnumerateSwapchainFormats", enumerateFormats);
  add(calls, "xrCreateSwapchain", createSwapchain);
  add(calls, "xrDestroySwapchain", destroySwapchain);
  add(calls, "xrEnumerateSwapchainImages", enumerateImages);
  add(calls, "xrAcquireSwapchainImage", acquireImage);
  add(calls, "xrWaitSwapchainImage", waitImage);
  add(calls, "xrReleaseSwapchainImage", releaseImage);
  add(calls, "xrWaitFrame", waitFrame);
  add(calls, "xrBeginFrame", beginFrame);
  add(calls, "xrEndFrame", endFrame);
}

}  // namespace karinui::room::stub

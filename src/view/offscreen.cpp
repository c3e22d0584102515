#include "karinui/view/offscreen.h"

// epoxy's EGL header must come first
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>

namespace karinui {
namespace {

constexpr EGLint kContextWanted[] = {
    EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};

struct Opened {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;
};

void close(Opened& opened) {
  if (opened.surface != EGL_NO_SURFACE) eglDestroySurface(opened.display, opened.surface);
  if (opened.context != EGL_NO_CONTEXT) eglDestroyContext(opened.display, opened.context);
  // The display stays initialised: EGL shares it with everyone else in the process (a Qt window, a second Picture).
  opened = {};
}

bool openOn(EGLDisplay display, Opened& opened) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return false;
  opened.display = display;
  if (!eglBindAPI(EGL_OPENGL_API)) return false;
  const bool needsNoSurface = epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context");
  if (needsNoSurface && epoxy_has_egl_extension(display, "EGL_KHR_no_config_context"))
    opened.context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kContextWanted);
  if (opened.context == EGL_NO_CONTEXT) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config{};
    EGLint count = 0;
    if (!eglChooseConfig(display, wanted, &config, 1, &count) || count < 1) return false;
    opened.context = eglCreateContext(display, config, EGL_NO_CONTEXT, kContextWanted);
    if (opened.context == EGL_NO_CONTEXT) return false;
    if (!needsNoSurface) {
      const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
      opened.surface = eglCreatePbufferSurface(display, config, size);
      if (opened.surface == EGL_NO_SURFACE) return close(opened), false;
    }
  }
  return true;
}

bool openAny(Opened& opened) {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless") &&
        openOn(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), opened))
      return true;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
      std::array<EGLDeviceEXT, 16> devices{};
      EGLint count = 0;
      if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count))
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
          if (openOn(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr), opened)) return true;
    }
  }
  return openOn(eglGetDisplay(EGL_DEFAULT_DISPLAY), opened);
}

Error noGraphics(const char* what) {
  return notFound(
      say("No picture can be drawn: this machine offers no OpenGL 3.3 ({0}). Mesa's software renderer is enough: "
          "install libegl1 and libgl1-mesa-dri.",
          what));
}

}  // namespace

struct OffscreenContext::Current::Before {
  EGLDisplay display, ours;
  EGLContext context;
  EGLSurface draw, read;
  EGLenum api;
};

OffscreenContext::Current::Current(OffscreenContext& c)
    : before_(new Before{eglGetCurrentDisplay(), c.display_, eglGetCurrentContext(), eglGetCurrentSurface(EGL_DRAW),
                         eglGetCurrentSurface(EGL_READ), eglQueryAPI()}) {
  eglBindAPI(EGL_OPENGL_API);
  ok_ = eglMakeCurrent(c.display_, c.surface_, c.surface_, c.context_);
}

OffscreenContext::Current::~Current() {
  if (before_->context != EGL_NO_CONTEXT)
    eglMakeCurrent(before_->display, before_->draw, before_->read, before_->context);
  else
    eglMakeCurrent(before_->ours, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglBindAPI(before_->api);
}

Result<std::unique_ptr<OffscreenContext>> OffscreenContext::open() {
  Opened opened;
  if (!openAny(opened)) {
    // A driver that is there but cannot be used (a container without /dev/dri rights) is passed over for software.
    if (std::getenv("LIBGL_ALWAYS_SOFTWARE")) return noGraphics("EGL gives no context");
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
    opened = {};
    const bool second = openAny(opened);
    ::unsetenv("LIBGL_ALWAYS_SOFTWARE");
    if (!second) return noGraphics("EGL gives no context");
  }
  std::unique_ptr<OffscreenContext> context(new OffscreenContext);
  context->display_ = opened.display;
  context->context_ = opened.context;
  context->surface_ = opened.surface;
  Current current(*context);
  if (!current.ok()) return noGraphics("its context cannot be used");
  if (epoxy_gl_version() < 33) return noGraphics("its version is older");
  const GLubyte* name = glGetString(GL_RENDERER);
  context->renderer_ = name ? reinterpret_cast<const char*>(name) : "";
  return context;
}

OffscreenContext::~OffscreenContext() {
  Opened opened{display_, context_, surface_};
  close(opened);
}

}  // namespace karinui

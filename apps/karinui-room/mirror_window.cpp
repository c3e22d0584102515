// Before Xlib, whose macros (None, Always, …) are words of ours.
#include "graphics.h"

#include <epoxy/gl.h>
#include <epoxy/glx.h>

#include <cstring>

#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_XLIB
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

namespace karinui::room {

namespace {

constexpr unsigned kWide = 960, kHigh = 960;

bool refused = false;
int remember(Display*, XErrorEvent*) {
  refused = true;
  return 0;
}

class MirrorWindow : public Graphics {
 public:
  ~MirrorWindow() override {
    if (!display_) return;
    glXMakeCurrent(display_, None, nullptr);
    if (context_) glXDestroyContext(display_, context_);
    if (window_) XDestroyWindow(display_, window_);
    if (colours_) XFreeColormap(display_, colours_);
    XCloseDisplay(display_);
  }

  Done open(const std::string& title) {
    display_ = XOpenDisplay(nullptr);
    if (!display_) return notFound(say("There is no display to open the mirror window on."));
    const int screen = DefaultScreen(display_);
    const int wanted[] = {GLX_X_RENDERABLE,
                          True,
                          GLX_DRAWABLE_TYPE,
                          GLX_WINDOW_BIT,
                          GLX_RENDER_TYPE,
                          GLX_RGBA_BIT,
                          GLX_RED_SIZE,
                          8,
                          GLX_GREEN_SIZE,
                          8,
                          GLX_BLUE_SIZE,
                          8,
                          GLX_DOUBLEBUFFER,
                          True,
                          None};
    int count = 0;
    GLXFBConfig* found = epoxy_has_glx(display_) ? glXChooseFBConfig(display_, screen, wanted, &count) : nullptr;
    if (!found || count < 1) return noOpenGl();
    const GLXFBConfig config = found[0];
    XFree(found);
    XVisualInfo* visual = glXGetVisualFromFBConfig(display_, config);
    if (!visual) return noOpenGl();
    colours_ = XCreateColormap(display_, RootWindow(display_, screen), visual->visual, AllocNone);
    XSetWindowAttributes attributes{};
    attributes.colormap = colours_;
    attributes.event_mask = StructureNotifyMask;
    window_ = XCreateWindow(display_, RootWindow(display_, screen), 0, 0, kWide, kHigh, 0, visual->depth, InputOutput,
                            visual->visual, CWColormap | CWEventMask, &attributes);
    const auto visualId = static_cast<std::uint32_t>(visual->visualid);
    XFree(visual);
    closing_ = XInternAtom(display_, "WM_DELETE_WINDOW", False);
    XSetWMProtocols(display_, window_, &closing_, 1);
    name(title);
    XMapWindow(display_, window_);
    if (!epoxy_has_glx_extension(display_, screen, "GLX_ARB_create_context_profile")) return noOpenGl();
    const int version[] = {
        GLX_CONTEXT_MAJOR_VERSION_ARB,    3,   GLX_CONTEXT_MINOR_VERSION_ARB, 3, GLX_CONTEXT_PROFILE_MASK_ARB,
        GLX_CONTEXT_CORE_PROFILE_BIT_ARB, None};
    refused = false;
    const auto before = XSetErrorHandler(remember);  // an older driver answers with an X error
    context_ = glXCreateContextAttribsARB(display_, config, nullptr, True, version);
    XSync(display_, False);
    XSetErrorHandler(before);
    if (!context_ || refused || !glXMakeCurrent(display_, window_, context_)) return noOpenGl();
    if (epoxy_gl_version() < 33) return noOpenGl();
    // The headset sets the pace, never the screen.
    if (epoxy_has_glx_extension(display_, screen, "GLX_EXT_swap_control")) glXSwapIntervalEXT(display_, window_, 0);
    if (const GLubyte* name = glGetString(GL_RENDERER)) renderer_ = reinterpret_cast<const char*>(name);
    binding_.type = XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR;
    binding_.xDisplay = display_;
    binding_.visualid = visualId;
    binding_.glxFBConfig = config;
    binding_.glxDrawable = window_;
    binding_.glxContext = context_;
    return {};
  }

  const char* extension() const override { return ""; }
  const void* binding() const override { return &binding_; }
  void makeCurrent() override {
    if (glXGetCurrentContext() != context_ || glXGetCurrentDrawable() != window_)
      glXMakeCurrent(display_, window_, context_);
  }
  void mirror(EyeTarget* eye, const std::string& title) override {
    pump();
    if (title != title_) name(title);
    makeCurrent();
    if (eye) {
      eye->show(0, width_, height_);
    } else {
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
      glDisable(GL_SCISSOR_TEST);
      glClearColor(0.12f, 0.115f, 0.11f, 1);
      glClear(GL_COLOR_BUFFER_BIT);
    }
    glXSwapBuffers(display_, window_);
  }
  bool closed() override {
    pump();
    return closed_;
  }
  const std::string& renderer() const override { return renderer_; }

 private:
  static Error noOpenGl() {
    return notFound(say("This display offers no OpenGL 3.3; Karinui needs it. A newer graphics driver may help."));
  }
  void name(const std::string& title) {
    title_ = title;
    const Atom called = XInternAtom(display_, "_NET_WM_NAME", False),
               utf8 = XInternAtom(display_, "UTF8_STRING", False);
    XChangeProperty(display_, window_, called, utf8, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(title.data()), static_cast<int>(title.size()));
  }
  void pump() {
    while (XPending(display_)) {
      XEvent event;
      XNextEvent(display_, &event);
      if (event.type == ConfigureNotify) width_ = event.xconfigure.width, height_ = event.xconfigure.height;
      if (event.type == ClientMessage && static_cast<Atom>(event.xclient.data.l[0]) == closing_) closed_ = true;
    }
  }

  Display* display_ = nullptr;
  Window window_ = 0;
  Colormap colours_ = 0;
  GLXContext context_ = nullptr;
  Atom closing_ = 0;
  bool closed_ = false;
  int width_ = kWide, height_ = kHigh;
  std::string title_, renderer_;
  XrGraphicsBindingOpenGLXlibKHR binding_{};
};

}  // namespace

Result<std::unique_ptr<Graphics>> mirrorWindow(const std::string& title) {
  auto window = std::make_unique<MirrorWindow>();
  if (const Done done = window->open(title); !done) return done.error();
  return std::unique_ptr<Graphics>(std::move(window));
}

}  // namespace karinui::room

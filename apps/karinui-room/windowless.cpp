#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "graphics.h"
#include "karinui/view/offscreen.h"
#define XR_USE_GRAPHICS_API_OPENGL
#define XR_USE_PLATFORM_EGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

namespace karinui::room {

namespace {

class Windowless : public Graphics {
 public:
  explicit Windowless(std::unique_ptr<OffscreenContext> context) : context_(std::move(context)) {
    makeCurrent();
    binding_.type = XR_TYPE_GRAPHICS_BINDING_EGL_MNDX;
    binding_.getProcAddress = eglGetProcAddress;
    binding_.display = context_->display();
    binding_.context = context_->context();
    // The context's own configuration; of one that was made without, any that draws OpenGL.
    EGLint id = 0, count = 0;
    eglQueryContext(context_->display(), context_->context(), EGL_CONFIG_ID, &id);
    const EGLint wanted[] = {id != 0 ? EGL_CONFIG_ID : EGL_RENDERABLE_TYPE, id != 0 ? id : EGL_OPENGL_BIT, EGL_NONE};
    eglChooseConfig(context_->display(), wanted, &binding_.config, 1, &count);
  }
  ~Windowless() override { current_.reset(); }

  const char* extension() const override { return XR_MNDX_EGL_ENABLE_EXTENSION_NAME; }
  const void* binding() const override { return &binding_; }
  void makeCurrent() override {
    if (eglGetCurrentContext() == context_->context()) return;
    current_.reset();
    current_ = std::make_unique<OffscreenContext::Current>(*context_);
  }
  void mirror(EyeTarget*, const std::string&) override {}
  bool closed() override { return false; }
  const std::string& renderer() const override { return context_->renderer(); }

 private:
  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<OffscreenContext::Current> current_;
  XrGraphicsBindingEGLMNDX binding_{};
};

}  // namespace

Result<std::unique_ptr<Graphics>> windowless() {
  auto context = OffscreenContext::open();
  if (!context) return context.error();
  return std::unique_ptr<Graphics>(std::make_unique<Windowless>(std::move(*context)));
}

}  // namespace karinui::room

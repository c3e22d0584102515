#pragma once
// An OpenGL 3.3 context with no window and no display (EGL): surfaceless Mesa, else a graphics device, else the default
// display; on a machine with no graphics at all Mesa's software renderer.
#include <memory>
#include <string>

#include "karinui/base/result.h"

namespace karinui {

class OffscreenContext {
 public:
  static Result<std::unique_ptr<OffscreenContext>> open();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  // The context is current on this thread while the scope lives; whatever was current before comes back after it. At
  // most one thread at a time.
  class Current {
   public:
    explicit Current(OffscreenContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    bool ok() const { return ok_; }

   private:
    struct Before;
    std::unique_ptr<Before> before_;
    bool ok_ = false;
  };

  const std::string& renderer() const { return renderer_; }  // what draws, as the driver names itself
  // EGLDisplay and EGLContext, for an interface that shares them (a headset's).
  void* display() const { return display_; }
  void* context() const { return context_; }

 private:
  OffscreenContext() = default;
  void* display_ = nullptr;
  void* context_ = nullptr;
  void* surface_ = nullptr;
  std::string renderer_;
};

}  // namespace karinui

#pragma once
// The OpenGL context that is shared with a headset's runtime: a mirror window's (GLX), or one without a window (EGL).
// One thread.
#include <memory>
#include <string>

#include "eye_target.h"
#include "karinui/base/result.h"

namespace karinui::room {

class Graphics {
 public:
  virtual ~Graphics() = default;
  // The OpenXR extension that shares such a context, beside XR_KHR_opengl_enable; empty: that alone.
  virtual const char* extension() const = 0;
  // What hangs at XrSessionCreateInfo::next; lives as long as this.
  virtual const void* binding() const = 0;
  virtual void makeCurrent() = 0;  // again, in case the runtime left another one current
  // Shows an eye's picture (null: nothing but the title) where there is a window.
  virtual void mirror(EyeTarget* eye, const std::string& title) = 0;
  virtual bool closed() = 0;  // the person closed the window
  virtual const std::string& renderer() const = 0;
};

// A window on the display of this machine.
Result<std::unique_ptr<Graphics>> mirrorWindow(const std::string& title);
// No window and no display.
Result<std::unique_ptr<Graphics>> windowless();

}  // namespace karinui::room

#pragma once
// The OpenXR runtime of this machine. One thread.
#include <openxr/openxr.h>

#include <memory>
#include <string>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/geometry/vec.h"

namespace karinui::room {

// The extension that shares a context without a window, beside XR_KHR_opengl_enable, which shares a window's.
inline constexpr const char* kSharesEgl = "XR_MNDX_egl_enable";

Rigid rigidOf(const XrPosef& pose);
// "XR_ERROR_SESSION_LOST", for sentences.
std::string nameOf(XrResult result);

// An instance of the runtime that is active on this machine.
class Runtime {
 public:
  // NotFound, with a sentence for the person: no runtime, or one that cannot share OpenGL.
  static Result<std::unique_ptr<Runtime>> open();
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  XrInstance instance() const { return instance_; }
  const std::string& name() const { return name_; }
  bool offers(const char* extension) const;  // of those that share a context
  std::string pathText(XrPath path) const;
  XrPath path(const char* text) const;

 private:
  Runtime() = default;
  XrInstance instance_ = XR_NULL_HANDLE;
  std::string name_;
  std::vector<std::string> extensions_;
};

}  // namespace karinui::room

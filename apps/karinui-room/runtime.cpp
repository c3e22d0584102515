#include "runtime.h"
#define XR_USE_GRAPHICS_API_OPENGL
#include <epoxy/gl.h>
#include <openxr/openxr_platform.h>

#include <algorithm>

#include "xr_values.h"

namespace karinui::room {

namespace {

Error noRuntime(XrResult why) {
  return notFound(
      say("No headset runtime was found. Install one (Monado, SteamVR or the headset's own) and make it the active "
          "OpenXR runtime. ({0})",
          nameOf(why)));
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
  putText(create.applicationInfo.applicationName, "karinui-room");
  create.applicationInfo.applicationVersion = 1;
  putText(create.applicationInfo.engineName, "karinui");
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

}  // namespace karinui::room

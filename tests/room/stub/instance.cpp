#include "stub.h"

#include <cstdio>

namespace karinui::room::stub {

namespace {

XrResult XRAPI_CALL enumerateExtensions(const char*, std::uint32_t room, std::uint32_t* count,
                                        XrExtensionProperties* items) {
  Stub& s = stub();
  std::vector<const char*> names{XR_KHR_OPENGL_ENABLE_EXTENSION_NAME};
  if (!s.has("no_egl")) names.push_back(XR_MNDX_EGL_ENABLE_EXTENSION_NAME);
  *count = static_cast<std::uint32_t>(names.size());
  if (room == 0) return XR_SUCCESS;
  if (room < names.size()) return XR_ERROR_SIZE_INSUFFICIENT;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (items[i].type != XR_TYPE_EXTENSION_PROPERTIES) return s.fault(XR_ERROR_VALIDATION_FAILURE, "extension's type");
    std::strcpy(items[i].extensionName, names[i]);
    items[i].extensionVersion = 1;
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL createInstance(const XrInstanceCreateInfo* info, XrInstance* instance) {
  Stub& s = stub();
  s.note("xrCreateInstance");
  if (s.instance) return s.fault(XR_ERROR_LIMIT_REACHED, "a second instance");
  if (s.has("no_service")) return XR_ERROR_RUNTIME_FAILURE;
  bool opengl = false;
  for (std::uint32_t i = 0; i < info->enabledExtensionCount; ++i) {
    opengl |= std::strcmp(info->enabledExtensionNames[i], XR_KHR_OPENGL_ENABLE_EXTENSION_NAME) == 0;
    s.egl |= std::strcmp(info->enabledExtensionNames[i], XR_MNDX_EGL_ENABLE_EXTENSION_NAME) == 0;
  }
  if (!opengl) return s.fault(XR_ERROR_EXTENSION_NOT_PRESENT, "XR_KHR_opengl_enable is not asked for");
  s.instance = true, s.instanceLost = false, s.asked = false;
  s.events.clear();
  *instance = handleOf<XrInstance>(++s.handles);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL destroyInstance(XrInstance) {
  Stub& s = stub();
  s.note("xrDestroyInstance");
  if (s.session) s.fault(XR_SUCCESS, "the instance ends before its session");
  if (!s.sets.empty()) s.fault(XR_SUCCESS, "the instance ends before its action sets");
  s.instance = false;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getInstanceProperties(XrInstance, XrInstanceProperties* about) {
  KNOWN_INSTANCE();
  about->runtimeVersion = XR_MAKE_VERSION(0, 1, 0);
  std::strcpy(about->runtimeName, "Karinui's stub");
  return XR_SUCCESS;
}

XrResult XRAPI_CALL pollEvent(XrInstance, XrEventDataBuffer* event) {
  Stub& s = stub();
  if (!s.instance) return s.fault(XR_ERROR_HANDLE_INVALID, "xrPollEvent without an instance");
  if (event->type != XR_TYPE_EVENT_DATA_BUFFER) return s.fault(XR_ERROR_VALIDATION_FAILURE, "event's type");
  if (s.events.empty()) return XR_EVENT_UNAVAILABLE;
  *event = s.events.front();
  s.events.pop_front();
  return XR_SUCCESS;
}

XrResult XRAPI_CALL resultToString(XrInstance, XrResult value, char buffer[XR_MAX_RESULT_STRING_SIZE]) {
  std::snprintf(buffer, XR_MAX_RESULT_STRING_SIZE, "XrResult %d", value);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL structureTypeToString(XrInstance, XrStructureType value, char buffer[XR_MAX_STRUCTURE_NAME_SIZE]) {
  std::snprintf(buffer, XR_MAX_STRUCTURE_NAME_SIZE, "XrStructureType %d", value);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getSystem(XrInstance, const XrSystemGetInfo* info, XrSystemId* id) {
  KNOWN_INSTANCE();
  s.note("xrGetSystem");
  if (info->formFactor != XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY) return XR_ERROR_FORM_FACTOR_UNSUPPORTED;
  if (s.has("no_headset")) return XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  if (s.absent > 0) return --s.absent, XR_ERROR_FORM_FACTOR_UNAVAILABLE;
  *id = 1;
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getSystemProperties(XrInstance, XrSystemId, XrSystemProperties* about) {
  KNOWN_INSTANCE();
  about->systemId = 1;
  std::strcpy(about->systemName, "Recorded head and hands");
  about->graphicsProperties = {4096, 4096, 16};
  about->trackingProperties = {XR_TRUE, XR_TRUE};
  return XR_SUCCESS;
}

XrResult XRAPI_CALL enumerateBlends(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t room,
                                    std::uint32_t* count, XrEnvironmentBlendMode* items) {
  KNOWN_INSTANCE();
  return fill(std::vector{XR_ENVIRONMENT_BLEND_MODE_OPAQUE}, room, count, items);
}
XrResult XRAPI_CALL enumerateConfigurations(XrInstance, XrSystemId, std::uint32_t room, std::uint32_t* count,
                                            XrViewConfigurationType* items) {
  KNOWN_INSTANCE();
  return fill(std::vector{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO}, room, count, items);
}
XrResult XRAPI_CALL configurationProperties(XrInstance, XrSystemId, XrViewConfigurationType type,
                                            XrViewConfigurationProperties* about) {
  KNOWN_INSTANCE();
  about->viewConfigurationType = type;
  about->fovMutable = XR_FALSE;
  return XR_SUCCESS;
}
XrResult XRAPI_CALL enumerateViews(XrInstance, XrSystemId, XrViewConfigurationType, std::uint32_t room,
                                   std::uint32_t* count, XrViewConfigurationView* items) {
  KNOWN_INSTANCE();
  const XrViewConfigurationView one{XR_TYPE_VIEW_CONFIGURATION_VIEW,
                                    nullptr,
                                    static_cast<std::uint32_t>(kSide),
                                    4096,
                                    static_cast<std::uint32_t>(kSide),
                                    4096,
                                    1,
                                    4};
  return fill(std::vector{one, one}, room, count, items);
}

XrResult XRAPI_CALL graphicsRequirements(XrInstance, XrSystemId, XrGraphicsRequirementsOpenGLKHR* needs) {
  KNOWN_INSTANCE();
  s.asked = true;
  needs->minApiVersionSupported = XR_MAKE_VERSION(3, 3, 0);
  needs->maxApiVersionSupported = XR_MAKE_VERSION(4, 6, 0);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL stringToPath(XrInstance, const char* text, XrPath* path) {
  KNOWN_INSTANCE();
  *path = s.pathOf(text);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL pathToString(XrInstance, XrPath path, std::uint32_t room, std::uint32_t* count, char* text) {
  KNOWN_INSTANCE();
  if (path == 0 || path > s.paths.size()) return s.fault(XR_ERROR_PATH_INVALID, "xrPathToString");
  const std::string& said = s.paths[path - 1];
  *count = static_cast<std::uint32_t>(said.size() + 1);
  if (room == 0) return XR_SUCCESS;
  if (room < *count) return XR_ERROR_SIZE_INSUFFICIENT;
  std::memcpy(text, said.c_str(), said.size() + 1);
  return XR_SUCCESS;
}

}  // namespace

void addInstance(Calls& calls) {
  add(calls, "xrEnumerateInstanceExtensionProperties", enumerateExtensions);
  add(calls, "xrCreateInstance", createInstance);
  add(calls, "xrDestroyInstance", destroyInstance);
  add(calls, "xrGetInstanceProperties", getInstanceProperties);
  add(calls, "xrPollEvent", pollEvent);
  add(calls, "xrResultToString", resultToString);
  add(calls, "xrStructureTypeToString", structureTypeToString);
  add(calls, "xrGetSystem", getSystem);
  add(calls, "xrGetSystemProperties", getSystemProperties);
  add(calls, "xrEnumerateEnvironmentBlendModes", enumerateBlends);
  add(calls, "xrEnumerateViewConfigurations", enumerateConfigurations);
  add(calls, "xrGetViewConfigurationProperties", configurationProperties);
  add(calls, "xrEnumerateViewConfigurationViews", enumerateViews);
  add(calls, "xrGetOpenGLGraphicsRequirementsKHR", graphicsRequirements);
  add(calls, "xrStringToPath", stringToPath);
  add(calls, "xrPathToString", pathToString);
}

}  // namespace karinui::room::stub

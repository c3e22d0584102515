#pragma once
// A headset by OpenXR 1.0: its session from idle to lost, the frame loop, its spaces and textures. The
// specification is https://registry.khronos.org/OpenXR/specs/1.0/html/xrspec.html. One thread, that of the graphics'
// context.
#include <openxr/openxr.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eye_view.h"
#include "graphics.h"
#include "runtime.h"

namespace karinui::room {

// Where a runtime tells something went wrong. Lost: the session (or the instance) is gone; a new one may be had.
enum class HeadsetStatus { Good, SessionLost, InstanceLost, Ended };

class Headset {
 public:
  // NotFound with no headset connected (try again later), Refused where the runtime will not have this program.
  static Result<std::unique_ptr<Headset>> open(const Runtime& runtime, Graphics& graphics);
  ~Headset();
  Headset(const Headset&) = delete;
  Headset& operator=(const Headset&) = delete;

  // What the events since the last call came to. Begins and ends the session as it is told to.
  struct News {
    bool profileChanged = false, recentred = false;
  };
  News poll();
  HeadsetStatus status() const { return status_; }
  bool running() const { return running_; }  // begun: frames are to be made
  bool focused() const { return state_ == XR_SESSION_STATE_FOCUSED; }
  XrSessionState state() const { return state_; }
  void askToEnd();  // the session ends, then status() says so
  // Call after every xr function of a session's own; false: it failed. Losses become the health, other failures a
  // sentence for the log.
  bool check(XrResult result, const char* call);
  const std::vector<std::string>& failures() const { return failures_; }
  std::vector<XrSessionState> takeStates() { return std::exchange(states_, {}); }  // gone through since the last call

  // --- one picture: begin(), then all drawing, then end()
  struct Frame {
    XrTime time = 0;  // when it will be seen
    bool draw = false;
  };
  std::optional<Frame> begin();            // waits for the headset's pace
  std::optional<Rigid> head(XrTime time);  // between the eyes, in the room; nothing while it is not tracked
  struct View {
    Rigid eye;
    FieldOfView fov;
  };
  std::optional<std::array<View, 2>> views(XrTime time);
  // The texture that the eye's picture goes into; nothing where there is none now. release() gives it back.
  std::optional<unsigned> acquire(std::size_t eye);
  void release(std::size_t eye);
  void end(const Frame& frame, bool drawn);

  XrSession session() const { return session_; }
  XrSpace space() const { return space_; }
  bool stage() const { return stage_; }  // the room's y = 0 is the floor
  std::int64_t format() const { return format_; }
  int width(std::size_t eye) const { return static_cast<int>(eyes_[eye].width); }
  int height(std::size_t eye) const { return static_cast<int>(eyes_[eye].height); }
  const std::string& system() const { return system_; }

 private:
  explicit Headset(const Runtime& runtime, Graphics& graphics) : runtime_(runtime), graphics_(graphics) {}
  Done openSystem();
  Done openSession();
  Done openSpaces();
  Done openSwapchains();
  void changed(const XrEventDataSessionStateChanged& event);

  const Runtime& runtime_;
  Graphics& graphics_;
  XrSystemId systemId_ = XR_NULL_SYSTEM_ID;
  std::string system_;
  XrSession session_ = XR_NULL_HANDLE;
  XrSpace space_ = XR_NULL_HANDLE, headSpace_ = XR_NULL_HANDLE;
  XrEnvironmentBlendMode blend_ = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  bool stage_ = false, running_ = false;
  XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
  HeadsetStatus status_ = HeadsetStatus::Good;
  std::int64_t format_ = 0;
  struct EyeChain {
    XrSwapchain chain = XR_NULL_HANDLE;
    std::uint32_t width = 0, height = 0;
    std::vector<unsigned> textures;
  };
  std::array<EyeChain, 2> eyes_;
  std::array<XrView, 2> located_{};
  std::vector<std::string> failures_;
  int refusedFrames_ = 0;
  std::vector<XrSessionState> states_;
};

}  // namespace karinui::room

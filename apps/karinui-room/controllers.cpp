#include "controllers.h"

#include <cmath>

#include "xr_values.h"

namespace karinui::room {

namespace {

Error wouldNot(const Runtime& runtime, const char* call, XrResult why) {
  return refused(say("{0} does not take the controllers' actions ({1}: {2}).", runtime.name(), call, nameOf(why)));
}

}  // namespace

Result<std::unique_ptr<Controllers>> Controllers::make(const Runtime& runtime, Headset& headset) {
  std::unique_ptr<Controllers> made(new Controllers(runtime, headset));
  for (const auto step : {&Controllers::makeActions, &Controllers::suggest, &Controllers::attach})
    if (const Done done = ((*made).*step)(); !done) return done.error();
  return made;
}

Done Controllers::makeActions() {
  sides_ = {runtime_.path("/user/hand/left"), runtime_.path("/user/hand/right")};
  XrActionSetCreateInfo create{};
  create.type = XR_TYPE_ACTION_SET_CREATE_INFO;
  putText(create.actionSetName, "fitting");
  putText(create.localizedActionSetName, "Fitting a garment");
  if (const XrResult r = xrCreateActionSet(runtime_.instance(), &create, &set_); XR_FAILED(r))
    return wouldNot(runtime_, "xrCreateActionSet", r);
  const struct {
    XrAction& action;
    const char *name, *said;
    XrActionType type;
  } wanted[] = {{aim_, "aim", "Where the hand points", XR_ACTION_TYPE_POSE_INPUT},
                {palm_, "palm", "Where the hand is", XR_ACTION_TYPE_POSE_INPUT},
                {trigger_, "act", "Act with the tool", XR_ACTION_TYPE_FLOAT_INPUT},
                {hold_, "hold", "Take hold of the room", XR_ACTION_TYPE_FLOAT_INPUT},
                {confirm_, "finish", "Finish; with the other hand undo", XR_ACTION_TYPE_BOOLEAN_INPUT},
                {cancel_, "cancel", "Cancel; with the other hand redo", XR_ACTION_TYPE_BOOLEAN_INPUT},
                {stick_, "stick", "Height, and turning the body", XR_ACTION_TYPE_VECTOR2F_INPUT},
                {scale_, "scale", "Life size or on a desk", XR_ACTION_TYPE_BOOLEAN_INPUT},
                {motor_, "feel", "Contact, snap and tension", XR_ACTION_TYPE_VIBRATION_OUTPUT}};
  for (const auto& w : wanted) {
    XrActionCreateInfo one{};
    one.type = XR_TYPE_ACTION_CREATE_INFO;
    one.actionType = w.type;
    putText(one.actionName, w.name);
    putText(one.localizedActionName, w.said);
    one.countSubactionPaths = static_cast<std::uint32_t>(sides_.size());
    one.subactionPaths = sides_.data();
    if (const XrResult r = xrCreateAction(set_, &one, &w.action); XR_FAILED(r))
      return wouldNot(runtime_, "xrCreateAction", r);
  }
  return {};
}

Done Controllers::suggest() {
  struct Bound {
    XrAction action;
    const char* path;  // after /user/hand/<side>; of one side only where it begins with that
  };
  const struct {
    const char* profile;
    std::vector<Bound> bound;
  } known[] = {{"/interaction_profiles/khr/simple_controller",
                {{aim_, "/input/aim/pose"},
                 {palm_, "/input/grip/pose"},
                 {trigger_, "/input/select/click"},
                 {hold_, "/input/menu/click"},
                 {motor_, "/output/haptic"}}},
               {"/interaction_profiles/oculus/touch_controller",
                {{aim_, "/input/aim/pose"},
                 {palm_, "/input/grip/pose"},
                 {trigger_, "/input/trigger/value"},
                 {hold_, "/input/squeeze/value"},
                 {confirm_, "left/input/x/click"},
                 {cancel_, "left/input/y/click"},
                 {confirm_, "right/input/a/click"},
                 {cancel_, "right/input/b/click"},
                 {stick_, "/input/thumbstick"},
                 {scale_, "/input/thumbstick/click"},
                 {motor_, "/output/haptic"}}},
               {"/interaction_profiles/valve/index_controller",
                {{aim_, "/input/aim/pose"},
                 {palm_, "/input/grip/pose"},
                 {trigger_, "/input/trigger/value"},
                 {hold_, "/input/squeeze/value"},
                 {confirm_, "/input/a/click"},
                 {cancel_, "/input/b/click"},
                 {stick_, "/input/thumbstick"},
                 {scale_, "/input/thumbstick/click"},
                 {motor_, "/output/haptic"}}}};
  std::size_t taken = 0;
  XrResult last = XR_SUCCESS;
  for (const auto& k : known) {
    std::vector<XrActionSuggestedBinding> all;
    for (const Bound& b : k.bound)
      for (const std::string side : {"left", "right"}) {
        const bool both = b.path[0] == '/';
        if (!both && !std::string_view(b.path).starts_with(side)) continue;
        const std::string path = "/user/hand/" + (both ? side + b.path : std::string(b.path));
        all.push_back({b.action, runtime_.path(path.c_str())});
      }
    XrInteractionProfileSuggestedBinding suggestion{};
    suggestion.type = XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING;
    suggestion.interactionProfile = runtime_.path(k.profile);
    suggestion.countSuggestedBindings = static_cast<std::uint32_t>(all.size());
    suggestion.suggestedBindings = all.data();
    last = xrSuggestInteractionProfileBindings(runtime_.instance(), &suggestion);
    taken += XR_SUCCEEDED(last);
  }
  // A runtime need not know every controller there is, but one.
  return taken > 0 ? Done() : Done(wouldNot(runtime_, "xrSuggestInteractionProfileBindings", last));
}

Done Controllers::attach() {
  for (std::size_t side = 0; side < 2; ++side)
    for (const auto& [action, space] : {std::pair(aim_, &aimSpaces_[side]), {palm_, &palmSpaces_[side]}}) {
      XrActionSpaceCreateInfo create{};
      create.type = XR_TYPE_ACTION_SPACE_CREATE_INFO;
      create.action = action;
      create.subactionPath = sides_[side];
      create.poseInActionSpace.orientation.w = 1;
      if (const XrResult r = xrCreateActionSpace(headset_.session(), &create, space); XR_FAILED(r))
        return wouldNot(runtime_, "xrCreateActionSpace", r);
    }
  XrSessionActionSetsAttachInfo attach{};
  attach.type = XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO;
  attach.countActionSets = 1;
  attach.actionSets = &set_;
  if (const XrResult r = xrAttachSessionActionSets(headset_.session(), &attach); XR_FAILED(r))
    return wouldNot(runtime_, "xrAttachSessionActionSets", r);
  return {};
}

Controllers::~Controllers() {
  for (const auto& spaces : {aimSpaces_, palmSpaces_})
    for (const XrSpace space : spaces)
      if (space != XR_NULL_HANDLE) xrDestroySpace(space);
  if (set_ != XR_NULL_HANDLE) xrDestroyActionSet(set_);
}

std::array<ControllerState, 2> Controllers::read(XrTime time) {
  std::array<ControllerState, 2> hands;
  XrActiveActionSet active{set_, XR_NULL_PATH};
  XrActionsSyncInfo sync{};
  sync.type = XR_TYPE_ACTIONS_SYNC_INFO;
  sync.countActiveActionSets = 1;
  sync.activeActionSets = &active;
  const XrResult synced = xrSyncActions(headset_.session(), &sync);
  if (!headset_.check(synced, "xrSyncActions") || synced == XR_SESSION_NOT_FOCUSED) return hands;
  for (std::size_t side = 0; side < 2; ++side) {
    XrActionStateGetInfo which{};
    which.type = XR_TYPE_ACTION_STATE_GET_INFO;
    which.subactionPath = sides_[side];
    const auto number = [&](XrAction action) {
      which.action = action;
      XrActionStateFloat state{};
      state.type = XR_TYPE_ACTION_STATE_FLOAT;
      const bool good =
          headset_.check(xrGetActionStateFloat(headset_.session(), &which, &state), "xrGetActionStateFloat");
      return good && state.isActive ? static_cast<double>(state.currentState) : 0.0;
    };
    const auto button = [&](XrAction action) {
      which.action = action;
      XrActionStateBoolean state{};
      state.type = XR_TYPE_ACTION_STATE_BOOLEAN;
      const bool good =
          headset_.check(xrGetActionStateBoolean(headset_.session(), &which, &state), "xrGetActionStateBoolean");
      return good && state.isActive && state.currentState;
    };
    const auto pose = [&](XrAction action, XrSpace space, Rigid& into) {
      which.action = action;
      XrActionStatePose state{};
      state.type = XR_TYPE_ACTION_STATE_POSE;
      if (!headset_.check(xrGetActionStatePose(headset_.session(), &which, &state), "xrGetActionStatePose") ||
          !state.isActive)
        return false;
      XrSpaceLocation at{};
      at.type = XR_TYPE_SPACE_LOCATION;
      if (!headset_.check(xrLocateSpace(space, headset_.space(), time, &at), "xrLocateSpace")) return false;
      constexpr auto kKnown = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
      if ((at.locationFlags & kKnown) != kKnown) return false;
      into = rigidOf(at.pose);
      return true;
    };
    ControllerState& hand = hands[side];
    hand.tracked = pose(aim_, aimSpaces_[side], hand.aim);
    if (!pose(palm_, palmSpaces_[side], hand.grip)) hand.grip = hand.aim;
    hand.trigger = number(trigger_);
    hand.hold = number(hold_);
    hand.confirm = button(confirm_);
    hand.cancel = button(cancel_);
    hand.scaleSwitch = button(scale_);
    which.action = stick_;
    XrActionStateVector2f stick{};
    stick.type = XR_TYPE_ACTION_STATE_VECTOR2F;
    if (headset_.check(xrGetActionStateVector2f(headset_.session(), &which, &stick), "xrGetActionStateVector2f") &&
        stick.isActive)
      hand.stick = {stick.currentState.x, stick.currentState.y};
  }
  return hands;
}

void Controllers::vibrate(std::size_t side, const HapticPulse& pulse) {
  XrHapticActionInfo where{};
  where.type = XR_TYPE_HAPTIC_ACTION_INFO;
  where.action = motor_;
  where.subactionPath = sides_[side];
  XrHapticVibration how{};
  how.type = XR_TYPE_HAPTIC_VIBRATION;
  how.amplitude = static_cast<float>(pulse.amplitude);
  how.duration = static_cast<XrDuration>(std::lround(pulse.seconds * 1e9));
  how.frequency = XR_FREQUENCY_UNSPECIFIED;
  headset_.check(xrApplyHapticFeedback(headset_.session(), &where, reinterpret_cast<const XrHapticBaseHeader*>(&how)),
                 "xrApplyHapticFeedback");
}

void Controllers::still(std::size_t side) {
  XrHapticActionInfo where{};
  where.type = XR_TYPE_HAPTIC_ACTION_INFO;
  where.action = motor_;
  where.subactionPath = sides_[side];
  headset_.check(xrStopHapticFeedback(headset_.session(), &where), "xrStopHapticFeedback");
}

std::string Controllers::profile(std::size_t side) const {
  XrInteractionProfileState state{};
  state.type = XR_TYPE_INTERACTION_PROFILE_STATE;
  if (XR_FAILED(xrGetCurrentInteractionProfile(headset_.session(), sides_[side], &state))) return {};
  return runtime_.pathText(state.interactionProfile);
}

}  // namespace karinui::room

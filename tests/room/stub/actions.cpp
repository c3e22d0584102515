#include "stub.h"

namespace karinui::room::stub {

namespace {

XrResult XRAPI_CALL createActionSet(XrInstance, const XrActionSetCreateInfo* info, XrActionSet* set) {
  KNOWN_INSTANCE();
  for (const auto& [n, known] : s.sets)
    if (known.name == info->actionSetName) return s.fault(XR_ERROR_NAME_DUPLICATED, "action set's name");
  s.sets[++s.handles] = {info->actionSetName, false};
  *set = handleOf<XrActionSet>(s.handles);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL destroyActionSet(XrActionSet set) {
  Stub& s = stub();
  if (s.sets.erase(number(set)) == 0) return s.fault(XR_ERROR_HANDLE_INVALID, "xrDestroyActionSet");
  std::erase_if(s.actions, [&](const auto& a) { return a.second.set == number(set); });
  return XR_SUCCESS;
}
XrResult XRAPI_CALL createAction(XrActionSet set, const XrActionCreateInfo* info, XrAction* action) {
  KNOWN_INSTANCE();
  const auto found = s.sets.find(number(set));
  if (found == s.sets.end()) return s.fault(XR_ERROR_HANDLE_INVALID, "xrCreateAction");
  if (found->second.attached) return s.fault(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "xrCreateAction");
  if (info->countSubactionPaths != 2) s.fault(XR_SUCCESS, "an action without hands");
  s.actions[++s.handles] = {number(set), info->actionType, info->actionName, {}};
  *action = handleOf<XrAction>(s.handles);
  return XR_SUCCESS;
}
XrResult XRAPI_CALL destroyAction(XrAction) { return XR_SUCCESS; }

// What each controller of the specification has (6.4, "Interaction Profile Paths").
const std::map<std::string, std::set<std::string>>& componentsOf() {
  static const std::map<std::string, std::set<std::string>> all{
      {"/interaction_profiles/khr/simple_controller",
       {"/input/select/click", "/input/menu/click", "/input/grip/pose", "/input/aim/pose", "/output/haptic"}},
      {"/interaction_profiles/oculus/touch_controller",
       {"/input/squeeze/value", "/input/trigger/value", "/input/trigger/touch", "/input/thumbstick",
        "/input/thumbstick/x", "/input/thumbstick/y", "/input/thumbstick/click", "/input/thumbstick/touch",
        "/input/grip/pose", "/input/aim/pose", "/output/haptic", "left/input/x/click", "left/input/y/click",
        "left/input/menu/click", "right/input/a/click", "right/input/b/click"}},
      {"/interaction_profiles/valve/index_controller",
       {"/input/a/click", "/input/b/click", "/input/squeeze/value", "/input/squeeze/force", "/input/trigger/click",
        "/input/trigger/value", "/input/thumbstick", "/input/thumbstick/click", "/input/trackpad", "/input/grip/pose",
        "/input/aim/pose", "/output/haptic"}}};
  return all;
}

XrResult XRAPI_CALL suggest(XrInstance, const XrInteractionProfileSuggestedBinding* info) {
  KNOWN_INSTANCE();
  const std::string profile = info->interactionProfile > 0 && info->interactionProfile <= s.paths.size()
                                  ? s.paths[info->interactionProfile - 1]
                                  : "";
  const auto known = componentsOf().find(profile);
  if (known == componentsOf().end()) return s.fault(XR_ERROR_PATH_UNSUPPORTED, "an unknown controller: " + profile);
  s.note("suggested " + profile);
  for (std::uint32_t i = 0; i < info->countSuggestedBindings; ++i) {
    const auto action = s.actions.find(number(info->suggestedBindings[i].action));
    if (action == s.actions.end()) return s.fault(XR_ERROR_HANDLE_INVALID, "a binding of no action");
    if (s.sets[action->second.set].attached)
      return s.fault(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "a binding after attaching");
    const std::string path = s.paths.at(info->suggestedBindings[i].binding - 1);
    bool there = false;
    for (const std::string side : {"left", "right"})
      for (const std::string& component : known->second)
        there |= path == "/user/hand/" + (component[0] == '/' ? side + component : component);
    if (!there) return s.fault(XR_ERROR_PATH_UNSUPPORTED, profile + " has no " + path);
    action->second.bound[profile].insert(path);
  }
  return XR_SUCCESS;
}

XrResult XRAPI_CALL attachSets(XrSession session, const XrSessionActionSetsAttachInfo* info) {
  KNOWN_SESSION();
  s.note("xrAttachSessionActionSets");
  if (s.attached) return s.fault(XR_ERROR_ACTIONSETS_ALREADY_ATTACHED, "attached twice");
  for (std::uint32_t i = 0; i < info->countActionSets; ++i) s.sets[number(info->actionSets[i])].attached = true;
  s.attached = true;
  XrEventDataBuffer buffer{};
  auto& event = reinterpret_cast<XrEventDataInteractionProfileChanged&>(buffer);
  event.type = XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED;
  event.session = session;
  s.events.push_back(buffer);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL currentProfile(XrSession session, XrPath, XrInteractionProfileState* state) {
  KNOWN_SESSION();
  if (!s.attached) return s.fault(XR_ERROR_ACTIONSET_NOT_ATTACHED, "the profile before attaching");
  state->interactionProfile = s.pathOf(s.profile());
  return XR_SUCCESS;
}

XrResult XRAPI_CALL syncActions(XrSession session, const XrActionsSyncInfo* info) {
  KNOWN_SESSION();
  for (std::uint32_t i = 0; i < info->countActiveActionSets; ++i)
    if (!s.attached || !s.sets[number(info->activeActionSets[i].actionSet)].attached)
      return s.fault(XR_ERROR_ACTIONSET_NOT_ATTACHED, "synchronised before attaching");
  return s.state == XR_SESSION_STATE_FOCUSED ? XR_SUCCESS : XR_SESSION_NOT_FOCUSED;
}

// What an application asks of one action of one hand. `name` is empty where the call is refused.
struct Asked {
  XrResult result = XR_SUCCESS;
  std::string name = {};
  ControllerState hand = {};
  bool active = false;  // the controller in that hand has what the action is bound to
};

Asked asked(const XrActionStateGetInfo* info, XrActionType type) {
  Stub& s = stub();
  const auto found = s.actions.find(number(info->action));
  if (found == s.actions.end()) return {.result = s.fault(XR_ERROR_HANDLE_INVALID, "a state of no action")};
  const auto& action = found->second;
  if (action.type != type)
    return {.result = s.fault(XR_ERROR_ACTION_TYPE_MISMATCH, "a state of another type: " + action.name)};
  if (info->subactionPath == 0 || info->subactionPath > s.paths.size())
    return {.result = s.fault(XR_ERROR_PATH_INVALID, "a state of no hand")};
  const std::string hand = s.paths[info->subactionPath - 1];
  Asked made{.name = action.name, .hand = s.script.handAt(hand == "/user/hand/left" ? 0 : 1, s.waited)};
  if (const auto bound = action.bound.find(s.profile()); bound != action.bound.end())
    for (const std::string& path : bound->second) made.active |= path.starts_with(hand);
  made.active = made.active && s.state == XR_SESSION_STATE_FOCUSED && made.hand.tracked;
  return made;
}

// Fills in a state of any type: isActive, and by `set` what an active controller says.
template <class State, class Set>
XrResult answer(const XrActionStateGetInfo* info, XrActionType type, State* state, Set&& set) {
  const Asked found = asked(info, type);
  if (found.name.empty()) return found.result;
  state->isActive = found.active;
  if (found.active) set(found);
  return XR_SUCCESS;
}

XrResult XRAPI_CALL getFloat(XrSession session, const XrActionStateGetInfo* info, XrActionStateFloat* state) {
  KNOWN_SESSION();
  state->currentState = 0;
  return answer(info, XR_ACTION_TYPE_FLOAT_INPUT, state, [&](const Asked& a) {
    state->currentState = static_cast<float>(a.name == "act" ? a.hand.trigger : a.hand.hold);
  });
}
XrResult XRAPI_CALL getBoolean(XrSession session, const XrActionStateGetInfo* info, XrActionStateBoolean* state) {
  KNOWN_SESSION();
  state->currentState = XR_FALSE;
  return answer(info, XR_ACTION_TYPE_BOOLEAN_INPUT, state, [&](const Asked& a) {
    state->currentState = a.name == "finish" ? a.hand.confirm : a.name == "cancel" ? a.hand.cancel : a.hand.scaleSwitch;
  });
}
XrResult XRAPI_CALL getVector(XrSession session, const XrActionStateGetInfo* info, XrActionStateVector2f* state) {
  KNOWN_SESSION();
  return answer(info, XR_ACTION_TYPE_VECTOR2F_INPUT, state, [&](const Asked& a) {
    state->currentState = {static_cast<float>(a.hand.stick.u), static_cast<float>(a.hand.stick.v)};
  });
}
XrResult XRAPI_CALL getPose(XrSession session, const XrActionStateGetInfo* info, XrActionStatePose* state) {
  KNOWN_SESSION();
  return answer(info, XR_ACTION_TYPE_POSE_INPUT, state, [](const Asked&) {});
}

XrResult XRAPI_CALL vibrate(XrSession session, const XrHapticActionInfo* info, const XrHapticBaseHeader* how) {
  KNOWN_SESSION();
  if (s.state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
  const auto found = s.actions.find(number(info->action));
  if (found == s.actions.end() || found->second.type != XR_ACTION_TYPE_VIBRATION_OUTPUT)
    return s.fault(XR_ERROR_ACTION_TYPE_MISMATCH, "a vibration of no motor");
  if (how->type != XR_TYPE_HAPTIC_VIBRATION) return s.fault(XR_ERROR_VALIDATION_FAILURE, "vibration's type");
  const auto& pulse = *reinterpret_cast<const XrHapticVibration*>(how);
  if (!(pulse.amplitude >= 0 && pulse.amplitude <= 1) || pulse.duration <= 0)
    s.fault(XR_ERROR_VALIDATION_FAILURE, "a vibration out of its range");
  s.vibration << s.waited << " " << s.paths.at(info->subactionPath - 1) << " " << pulse.amplitude << " "
              << pulse.duration << "\n";
  s.vibration.flush();
  return XR_SUCCESS;
}
XrResult XRAPI_CALL stopVibration(XrSession session, const XrHapticActionInfo*) {
  KNOWN_SESSION();
  return XR_SUCCESS;
}

}  // namespace

void addActions(Calls& calls) {
  add(calls, "xrCreateActionSet", createActionSet);
  add(calls, "xrDestroyActionSet", destroyActionSet);
  add(calls, "xrCreateAction", createAction);
  add(calls, "xrDestroyAction", destroyAction);
  add(calls, "xrSuggestInteractionProfileBindings", suggest);
  add(calls, "xrAttachSessionActionSets", attachSets);
  add(calls, "xrGetCurrentInteractionProfile", currentProfile);
  add(calls, "xrSyncActions", syncActions);
  add(calls, "xrGetActionStateFloat", getFloat);
  add(calls, "xrGetActionStateBoolean", getBoolean);
  add(calls, "xrGetActionStateVector2f", getVector);
  add(calls, "xrGetActionStatePose", getPose);
  add(calls, "xrApplyHapticFeedback", vibrate);
  add(calls, "xrStopHapticFeedback", stopVibration);
}

}  // namespace karinui::room::stub

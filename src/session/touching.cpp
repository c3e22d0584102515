// What the hand feels of the session: made of the garment that is shown and of the gesture in hand.
#include "karinui/session/touch_scene_of.h"
#include "session/session_impl.h"

namespace karinui {

void Session::Impl::countClicks() {
  Handling handling;
  gesture->addTo(handling);
  if (handling.snap != 0 && handling.snap != snapped) ++clicks;
  snapped = handling.snap;
}

TouchScene Session::touchScene(Vec3 tip) const {
  const auto& in = *impl_;
  Handling handling;
  in.gesture->addTo(handling);
  handling.changing = in.tasks.busy(TaskQueue::Kind::Step);
  handling.clicks = in.clicks;
  return touchSceneOf(shown(), tip, handling);
}

}  // namespace karinui

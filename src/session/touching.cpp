// What the hand feels of the session: made of the garment that is shown and of the gesture in hand.
#include "session/session_impl.h"

namespace karinui {

void Session::Impl::countClicks() {
  Handling handling;
  gesture->addTo(handling);
  if (handling.snap != 0 && handling.snap != snapped) ++clicks;
  snapped = handling.snap;
}

TouchSource Session::touchSource() const {
  const auto& in = *impl_;
  TouchSource source{shownPtr(), {}};
  in.gesture->addTo(source.handling);
  source.handling.changing = in.stepping();
  source.handling.clicks = in.clicks;
  return source;
}

}  // namespace karinui

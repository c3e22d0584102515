#pragma once
// How the cloth of an open document stands.
#include "karinui/design/drape.h"
#include "karinui/session/fit.h"
#include "open_document.h"

namespace karinui::app {

// Brings the garment to rest; what is at rest is left as it is unless `again`: the report then is that of the drape
// that is kept.
struct Settled {
  bool kept = false;
  Examination check;
};
Result<Settled> settle(OpenDocument& opened, StopRequest& stop, bool again);

// How it fits: girths of garment and body at the levels it covers, and what it presses with. Needs a body.
struct Fit {
  std::vector<Girths> girths;
  std::optional<PressureReport> pressure;
};
Result<Fit> fitOf(OpenDocument& opened);

}  // namespace karinui::app

#pragma once
// How the cloth of an open document stands.
#include "karinui/design/drape.h"
#include "karinui/session/fit.h"
#include "karinui/session/wide_edges.h"
#include "open_document.h"

namespace karinui::app {

// Brings the garment to rest; what is at rest is left as it is unless `again`: the report then is that of the drape
// that is kept.
struct Settled {
  bool kept = false;
  Examination check;
};
Result<Settled> settle(OpenDocument& opened, StopRequest& stop, bool again);

// How it fits: girths of garment and body at the levels it covers, what it presses with, and where most. Needs a body.
struct Fit {
  std::vector<Girths> girths;
  std::optional<PressureReport> pressure;
  std::optional<BodyPoint> pressedMost;
  std::string stretchedMost;  // the piece whose cloth is; empty: nothing is known
  std::vector<WideEdge> wide;
};
Result<Fit> fitOf(OpenDocument& opened);

}  // namespace karinui::app

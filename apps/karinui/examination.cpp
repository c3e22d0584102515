#include "examination.h"

#include "karinui/design/drape.h"

namespace karinui::app {

Result<Settled> settle(OpenDocument& opened, StopRequest& stop, bool again) {
  Settled settled;
  settled.kept = opened.document().atRest() && !again;
  if (!settled.kept) {
    opened.context().stop = &stop;
    const Result<Step> step = opened.perform(DrapePieces{});
    opened.context().stop = nullptr;
    if (!step) return step.error();
  }
  const Result<Examination> check = examined(opened.document(), opened.context());
  if (!check) return check.error();
  settled.check = *check;
  return settled;
}

Result<Fit> fitOf(OpenDocument& opened) {
  const Result<BodyPtr> body = bodyOf(opened.document(), opened.context());
  if (!body) return body.error();
  const SnapshotPtr garment = snapshotOf(opened.document(), *body);
  const std::vector<float> pressure = pressureOnBody(*garment, opened.context().workers);
  return Fit{girthsOf(*garment), pressureReport(pressure), mostPressed(pressure, **body), mostStretched(garment->frame),
             wideEdges(*garment)};
}

}  // namespace karinui::app

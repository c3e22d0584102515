#include "examination.h"

#include <algorithm>

#include "karinui/design/drape.h"

namespace karinui::app {

namespace {

bool atRest(const Document& document) {
  return document.drape.last && document.drape.last->settled && document.drape.dirty.empty();
}

// Where the skin is pressed most.
std::optional<BodyPoint> mostPressed(const std::vector<float>& pressure, const Body& body) {
  const auto most = std::max_element(pressure.begin(), pressure.end());
  if (most == pressure.end() || *most <= 0) return std::nullopt;
  const auto there = body.bvh().nearest(body.mesh().points[static_cast<std::size_t>(most - pressure.begin())]);
  return there ? std::optional(body.describe(there->place)) : std::nullopt;
}

// The cloth of which one point in a hundred is stretched more than that of any other.
std::string mostStretched(const SceneFrame& frame) {
  std::string name;
  float most = 0;
  for (const SceneCloth& cloth : frame.cloths) {
    if (cloth.strain.empty()) continue;
    std::vector<float> strain = cloth.strain;
    const auto at = strain.begin() + static_cast<std::ptrdiff_t>((strain.size() - 1) * 99 / 100);
    std::nth_element(strain.begin(), at, strain.end());
    if (*at > most) most = *at, name = cloth.name;
  }
  return name;
}

}  // namespace

Result<Settled> settle(OpenDocument& opened, StopRequest& stop, bool again) {
  Settled settled;
  settled.kept = atRest(opened.document()) && !again;
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

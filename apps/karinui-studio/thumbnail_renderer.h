#pragma once
// Small pictures of fittings, for the list of steps and the dialogs: quickly drawn, from the front and a little from
// the side. A context must be current, the same for its whole life. GUI thread.
#include <QImage>
#include <memory>

#include "karinui/view/renderer.h"

namespace karinui::studio {

class ThumbnailRenderer {
 public:
  ThumbnailRenderer();
  QImage of(const SceneFrame& frame, QSize pixels);

 private:
  std::unique_ptr<Renderer> renderer_;  // null: none to be had
};

}  // namespace karinui::studio

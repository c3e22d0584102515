// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include "thumbnail_renderer.h"

#include <QOpenGLFramebufferObject>

namespace karinui::studio {

namespace {
constexpr int kFiner = 3;  // drawn larger and made smaller, for smooth edges
}

ThumbnailRenderer::ThumbnailRenderer() {
  Studio plain;
  plain.skyDirections = 6, plain.skyMap = 128, plain.keyMap = 256;
  if (auto made = Renderer::make(plain)) renderer_ = std::move(*made);
}

QImage ThumbnailRenderer::of(const SceneFrame& frame, QSize pixels) {
  if (!renderer_ || pixels.isEmpty()) return {};
  const QSize large = pixels * kFiner;
  QOpenGLFramebufferObjectFormat format;
  format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
  QOpenGLFramebufferObject target(large, format);
  const double aspect = static_cast<double>(large.width()) / large.height();
  SceneFrame seen;  // the garment, once there is one; the figure's feet say nothing
  seen.cloths = frame.cloths;
  const Camera camera = frameAll(seen.cloths.empty() ? frame : seen, View::Oblique, aspect);
  renderer_->show(frame);
  renderer_->light(camera);
  target.bind();
  renderer_->draw(eyeOf(camera, aspect), {.x = 0, .y = 0, .width = large.width(), .height = large.height()});
  return target.toImage()
      .convertToFormat(QImage::Format_RGB32)
      .scaled(pixels, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

}  // namespace karinui::studio

#pragma once
// One picture out of two: each eye is drawn for itself, then both are put together as the screen wants them. Its
// context must be current. Anaglyph: least-squares colours for red-cyan glasses (E. Dubois, 2001), as in pictures.
#include <QOpenGLFramebufferObject>
#include <array>
#include <memory>

#include "space_view.h"

class QOpenGLShaderProgram;

namespace karinui::studio {

class EyeCompositor {
 public:
  EyeCompositor();
  ~EyeCompositor();
  QOpenGLFramebufferObject& eye(int which, int width, int height);
  void copy(QOpenGLFramebufferObject& from, unsigned target, int width, int height);
  void compose(Stereo stereo, unsigned target, int width, int height);

 private:
  std::array<std::unique_ptr<QOpenGLFramebufferObject>, 2> eyes_;
  std::unique_ptr<QOpenGLShaderProgram> program_;
  unsigned arrays_ = 0;
};

}  // namespace karinui::studio

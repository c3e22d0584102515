#pragma once
// Both eyes' pictures on a screen that shows two at once (quad-buffered stereo: shutter glasses, mirrors), in a window
// of its own that fills it. GUI thread.
#include <QOpenGLWindow>
#include <array>
#include <memory>

class QOpenGLShaderProgram;

namespace karinui::studio {

// Draws each eye's texture over the whole of a buffer of its own. Its context must be current.
class EyesApart {
 public:
  EyesApart();
  ~EyesApart();
  void draw(std::array<unsigned, 2> eyes, std::array<unsigned, 2> buffers);  // left, right; as glDrawBuffer has them

 private:
  std::unique_ptr<QOpenGLShaderProgram> program_;
  unsigned arrays_ = 0;
};

class QuadWindow : public QOpenGLWindow {
 public:
  static bool mayBeHad();                       // this system shows two pictures at once
  explicit QuadWindow(QOpenGLContext* shared);  // whose textures it shows
  ~QuadWindow() override;
  void show(std::array<unsigned, 2> eyes);  // textures: left, right

 protected:
  void initializeGL() override;
  void paintGL() override;

 private:
  std::array<unsigned, 2> eyes_{};
  std::unique_ptr<EyesApart> apart_;
};

}  // namespace karinui::studio

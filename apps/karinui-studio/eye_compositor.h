#pragma once
// One picture out of two: each eye is drawn for itself, then both are put together as the screen wants them. Its
// context must be current. Anaglyph: least-squares colours for red-cyan glasses (E. Dubois, 2001), as in pictures.
#include <QOpenGLFramebufferObject>
#include <array>
#include <memory>

#include "space_view.h"

class QOpenGLShaderProgram;

namespace karinui::studio {

// A triangle over the whole target; `at` runs from 0 to 1 across it and up.
inline constexpr const char* kWholeTarget = R"(#version 330 core
out vec2 at;
void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;
  gl_Position = vec4(at * 2.0 - 1.0, 0.0, 1.0);
}
)";

class EyeCompositor {
 public:
  EyeCompositor();
  ~EyeCompositor();
  // The scene as an eye sees it, kept as long as nothing in it moves; may be larger than the screen, for smooth edges.
  QOpenGLFramebufferObject& scene(int which, int width, int height);
  // The same at the screen's size, to draw on; with its depths (slow where the processor draws) for what may lie
  // behind.
  QOpenGLFramebufferObject& onScreen(int which, int width, int height, bool depths);
  std::array<unsigned, 2> textures() const;                          // both eyes, as on screen
  void show(Stereo stereo, unsigned target, int width, int height);  // what is on screen, on the screen

 private:
  void copy(QOpenGLFramebufferObject& from, unsigned target, int width, int height);  // colours only
  std::array<std::unique_ptr<QOpenGLFramebufferObject>, 2> scenes_, eyes_;
  void fill();  // the target, with the program that is bound
  std::unique_ptr<QOpenGLShaderProgram> program_, copying_;
  unsigned arrays_ = 0;
};

}  // namespace karinui::studio

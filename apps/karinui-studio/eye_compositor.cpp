// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include "eye_compositor.h"

#include <QOpenGLShaderProgram>

namespace karinui::studio {

namespace {

constexpr const char* kFragment = R"(#version 330 core
in vec2 at;
uniform sampler2D leftEye, rightEye;
uniform int way;  // 1 side by side, 2 top and bottom, 3 anaglyph, 4 rows
out vec4 colour;
const mat3 kLeft = mat3(0.4561, -0.0400822, -0.0152161, 0.500484, -0.0378246, -0.0205971, 0.176381, -0.0157589, -0.00546856);
const mat3 kRight = mat3(-0.0434706, 0.378476, -0.0721527, -0.0879388, 0.73364, -0.112961, -0.00155529, -0.0184503, 1.2264);
vec3 decoded(vec3 c) { return pow(c, vec3(2.2)); }
void main() {
  vec3 seen;
  if (way == 1) seen = at.x < 0.5 ? texture(leftEye, vec2(at.x * 2.0, at.y)).rgb : texture(rightEye, vec2(at.x * 2.0 - 1.0, at.y)).rgb;
  else if (way == 2) seen = at.y >= 0.5 ? texture(leftEye, vec2(at.x, at.y * 2.0 - 1.0)).rgb : texture(rightEye, vec2(at.x, at.y * 2.0)).rgb;
  else if (way == 3) seen = pow(clamp(kLeft * decoded(texture(leftEye, at).rgb) + kRight * decoded(texture(rightEye, at).rgb), 0.0, 1.0), vec3(1.0 / 2.2));
  else seen = (int(gl_FragCoord.y) & 1) == 0 ? texture(rightEye, at).rgb : texture(leftEye, at).rgb;
  colour = vec4(seen, 1.0);
}
)";

constexpr const char* kCopied = R"(#version 330 core
in vec2 at;
uniform sampler2D from;
out vec4 colour;
void main() { colour = texture(from, at); }
)";

std::unique_ptr<QOpenGLShaderProgram> overWholeTarget(const char* fragment) {
  auto program = std::make_unique<QOpenGLShaderProgram>();
  program->addShaderFromSourceCode(QOpenGLShader::Vertex, kWholeTarget);
  program->addShaderFromSourceCode(QOpenGLShader::Fragment, fragment);
  program->link();
  return program;
}

void readyToFill(unsigned target, int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, width, height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
}

}  // namespace

EyeCompositor::EyeCompositor() : program_(overWholeTarget(kFragment)), copying_(overWholeTarget(kCopied)) {
  glGenVertexArrays(1, &arrays_);
}

EyeCompositor::~EyeCompositor() { glDeleteVertexArrays(1, &arrays_); }

namespace {
QOpenGLFramebufferObject& sized(std::unique_ptr<QOpenGLFramebufferObject>& target, int width, int height) {
  const QSize size(std::max(1, width), std::max(1, height));
  if (!target || target->size() != size) {
    QOpenGLFramebufferObjectFormat format;
    format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
    target = std::make_unique<QOpenGLFramebufferObject>(size, format);
    glBindTexture(GL_TEXTURE_2D, target->texture());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }
  return *target;
}
}  // namespace

QOpenGLFramebufferObject& EyeCompositor::scene(int which, int width, int height) {
  return sized(scenes_[static_cast<std::size_t>(which)], width, height);
}

QOpenGLFramebufferObject& EyeCompositor::onScreen(int which, int width, int height, bool depths) {
  QOpenGLFramebufferObject& from = *scenes_[static_cast<std::size_t>(which)];
  QOpenGLFramebufferObject& to = sized(eyes_[static_cast<std::size_t>(which)], width, height);
  copy(from, to.handle(), width, height);
  if (depths) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.handle());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.handle());
    glBlitFramebuffer(0, 0, from.width(), from.height(), 0, 0, width, height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  }
  to.bind();
  return to;
}

// Drawn, not blitted: where the processor draws, Mesa compiles what blits anew for each window, a twentieth of a
// second.
void EyeCompositor::copy(QOpenGLFramebufferObject& from, unsigned target, int width, int height) {
  readyToFill(target, width, height);
  copying_->bind();
  copying_->setUniformValue("from", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, from.texture());
  fill();
  copying_->release();
}

void EyeCompositor::fill() {
  glBindVertexArray(arrays_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

std::array<unsigned, 2> EyeCompositor::textures() const {
  return {eyes_[0] ? eyes_[0]->texture() : 0, eyes_[1] ? eyes_[1]->texture() : 0};
}

void EyeCompositor::show(Stereo stereo, unsigned target, int width, int height) {
  if (stereo == Stereo::Off || stereo == Stereo::QuadBuffer) return copy(*eyes_[0], target, width, height);
  readyToFill(target, width, height);
  program_->bind();
  program_->setUniformValue("leftEye", 0);
  program_->setUniformValue("rightEye", 1);
  program_->setUniformValue("way", static_cast<int>(stereo));
  for (unsigned k = 0; k < 2; ++k) {
    glActiveTexture(GL_TEXTURE0 + k);
    glBindTexture(GL_TEXTURE_2D, eyes_[k]->texture());
  }
  fill();
  glActiveTexture(GL_TEXTURE0);
  program_->release();
}

}  // namespace karinui::studio

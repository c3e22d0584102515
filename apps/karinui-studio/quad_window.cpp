// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include "quad_window.h"

#include <QOpenGLContext>
#include <QOpenGLShaderProgram>

#include "eye_compositor.h"

namespace karinui::studio {

namespace {

constexpr const char* kFragment = R"(#version 330 core
in vec2 at;
uniform sampler2D eye;
out vec4 colour;
void main() { colour = vec4(texture(eye, at).rgb, 1.0); }
)";

QSurfaceFormat twofold() {
  QSurfaceFormat format = QSurfaceFormat::defaultFormat();
  format.setStereo(true);
  return format;
}

}  // namespace

EyesApart::EyesApart() : program_(std::make_unique<QOpenGLShaderProgram>()) {
  program_->addShaderFromSourceCode(QOpenGLShader::Vertex, kWholeTarget);
  program_->addShaderFromSourceCode(QOpenGLShader::Fragment, kFragment);
  program_->link();
  glGenVertexArrays(1, &arrays_);
}

EyesApart::~EyesApart() { glDeleteVertexArrays(1, &arrays_); }

void EyesApart::draw(std::array<unsigned, 2> eyes, std::array<unsigned, 2> buffers) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  program_->bind();
  program_->setUniformValue("eye", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(arrays_);
  for (std::size_t k = 0; k < 2; ++k) {
    glDrawBuffer(buffers[k]);
    glBindTexture(GL_TEXTURE_2D, eyes[k]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glBindVertexArray(0);
  program_->release();
}

bool QuadWindow::mayBeHad() {
  QOpenGLContext context;
  context.setFormat(twofold());
  return context.create() && context.format().stereo();
}

QuadWindow::QuadWindow(QOpenGLContext* shared) : QOpenGLWindow(shared) {
  setFormat(twofold());
  setTitle("Karinui");
}

QuadWindow::~QuadWindow() {
  makeCurrent();
  apart_.reset();
  doneCurrent();
}

void QuadWindow::show(std::array<unsigned, 2> eyes) {
  eyes_ = eyes;
  update();
}

void QuadWindow::initializeGL() { apart_ = std::make_unique<EyesApart>(); }

void QuadWindow::paintGL() {
  const double ratio = devicePixelRatioF();
  glViewport(0, 0, static_cast<int>(width() * ratio), static_cast<int>(height() * ratio));
  if (format().stereo()) apart_->draw(eyes_, {GL_BACK_LEFT, GL_BACK_RIGHT});
}

}  // namespace karinui::studio

#pragma once
// OpenGL names that give themselves back. Their context must be current when they end.
#include <epoxy/gl.h>

#include <string>
#include <utility>

#include "karinui/base/result.h"
#include "karinui/geometry/vec.h"

namespace karinui {

template <void (*give)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& o) noexcept : name_(std::exchange(o.name_, 0)) {}
  GlName& operator=(GlName&& o) noexcept {
    std::swap(name_, o.name_);
    return *this;
  }
  ~GlName() {
    if (name_) give(name_);
  }
  operator GLuint() const { return name_; }

 private:
  GLuint name_ = 0;
};

inline void giveBuffer(GLuint n) { glDeleteBuffers(1, &n); }
inline void giveTexture(GLuint n) { glDeleteTextures(1, &n); }
inline void giveTarget(GLuint n) { glDeleteFramebuffers(1, &n); }
inline void giveStore(GLuint n) { glDeleteRenderbuffers(1, &n); }
inline void giveArrays(GLuint n) { glDeleteVertexArrays(1, &n); }
inline void giveProgram(GLuint n) { glDeleteProgram(n); }
using GlBuffer = GlName<giveBuffer>;
using GlTexture = GlName<giveTexture>;
using GlTarget = GlName<giveTarget>;
using GlStore = GlName<giveStore>;
using GlArrays = GlName<giveArrays>;
using GlProgram = GlName<giveProgram>;

inline GlBuffer newBuffer() {
  GLuint n = 0;
  return glGenBuffers(1, &n), GlBuffer(n);
}
inline GlTexture newTexture() {
  GLuint n = 0;
  return glGenTextures(1, &n), GlTexture(n);
}
inline GlTarget newTarget() {
  GLuint n = 0;
  return glGenFramebuffers(1, &n), GlTarget(n);
}
inline GlStore newStore() {
  GLuint n = 0;
  return glGenRenderbuffers(1, &n), GlStore(n);
}
inline GlArrays newArrays() {
  GLuint n = 0;
  return glGenVertexArrays(1, &n), GlArrays(n);
}

// Of the program in use.
inline void set(GLuint program, const char* name, Vec3 v) {
  glUniform3f(glGetUniformLocation(program, name), static_cast<float>(v.x), static_cast<float>(v.y),
              static_cast<float>(v.z));
}
inline void set(GLuint program, const char* name, double v) {
  glUniform1f(glGetUniformLocation(program, name), static_cast<float>(v));
}

// Compiles and links; the driver's words come back in the error. An empty fragment source draws depth only.
Result<GlProgram> makeProgram(const std::string& vertexSource, const std::string& fragmentSource);

}  // namespace karinui

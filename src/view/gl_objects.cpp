#include "view/gl_objects.h"

namespace karinui {
namespace {

bool compiled(GLuint shader, const std::string& source, std::string& said) {
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return true;
  char log[1024] = "";
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  said = log;
  return false;
}

}  // namespace

Result<GlProgram> makeProgram(const std::string& vertexSource, const std::string& fragmentSource) {
  const std::string head = "#version 330 core\n";
  GlProgram program(glCreateProgram());
  const GLuint vertex = glCreateShader(GL_VERTEX_SHADER), fragment = glCreateShader(GL_FRAGMENT_SHADER);
  std::string said;
  bool good = compiled(vertex, head + vertexSource, said) &&
              compiled(fragment, head + (fragmentSource.empty() ? "void main() {}\n" : fragmentSource), said);
  if (good) {
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    good = linked != 0;
    if (!good) {
      char log[1024] = "";
      glGetProgramInfoLog(program, sizeof log, nullptr, log);
      said = log;
    }
  }
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  if (good) return program;
  return notFound(say("The graphics driver refuses the renderer's programs: {0}", said));
}

}  // namespace karinui

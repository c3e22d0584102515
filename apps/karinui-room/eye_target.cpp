#include "eye_target.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

namespace karinui::room {

namespace {

constexpr std::array<std::int64_t, 7> kKnown{GL_SRGB8_ALPHA8, GL_SRGB8, GL_RGBA16F, GL_RGBA16,
                                             GL_RGB10_A2,     GL_RGBA8, GL_RGBA32F};

const char* const kWhole = R"(#version 330 core
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;
  gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0);
}
)";
// The picture's texture is sRGB: reading it gives linear light.
const char* const kLinear = R"(#version 330 core
uniform sampler2D picture;
in vec2 place;
out vec4 colour;
void main() { colour = vec4(texture(picture, place).rgb, 1.0); }
)";

unsigned programOf(const char* vertexSource, const char* fragmentSource) {
  const unsigned program = glCreateProgram();
  for (const auto& [kind, source] : {std::pair(GL_VERTEX_SHADER, vertexSource), {GL_FRAGMENT_SHADER, fragmentSource}}) {
    const unsigned shader = glCreateShader(static_cast<GLenum>(kind));
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good) return program;
  glDeleteProgram(program);
  return 0;
}

}  // namespace

bool isSrgb(std::int64_t format) { return format == GL_SRGB8_ALPHA8 || format == GL_SRGB8; }

std::optional<std::int64_t> formatAmong(std::span<const std::int64_t> offered) {
  for (const std::int64_t wanted : kKnown)
    if (std::find(offered.begin(), offered.end(), wanted) != offered.end()) return wanted;
  return std::nullopt;
}

struct EyeTarget::Parts {
  int width = 0, height = 0;
  unsigned many = 0, one = 0, out = 0;  // framebuffers: with samples, without, round the headset's texture
  unsigned colour = 0, depth = 0;       // renderbuffers of `many`
  unsigned texture = 0;                 // of `one`
  unsigned program = 0, arrays = 0;

  ~Parts() {
    const unsigned targets[] = {many, one, out}, stores[] = {colour, depth};
    glDeleteFramebuffers(3, targets);
    glDeleteRenderbuffers(2, stores);
    glDeleteTextures(1, &texture);
    glDeleteVertexArrays(1, &arrays);
    glDeleteProgram(program);
  }
  void resolve() const {
    glDisable(GL_FRAMEBUFFER_SRGB);
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, many);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, one);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
};

EyeTarget::EyeTarget() : parts_(std::make_unique<Parts>()) {}
EyeTarget::~EyeTarget() = default;
int EyeTarget::width() const { return parts_->width; }
int EyeTarget::height() const { return parts_->height; }

Result<std::unique_ptr<EyeTarget>> EyeTarget::make(int width, int height, int samples) {
  std::unique_ptr<EyeTarget> made(new EyeTarget);
  Parts& p = *made->parts_;
  p.width = width, p.height = height;
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  samples = std::clamp(samples, 1, std::max(1, most));
  const auto store = [&](unsigned& name, GLenum format, GLenum at) {
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, at, GL_RENDERBUFFER, name);
  };
  glGenFramebuffers(1, &p.many);
  glBindFramebuffer(GL_FRAMEBUFFER, p.many);
  store(p.colour, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
  store(p.depth, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  bool good = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glGenTextures(1, &p.texture);
  glBindTexture(GL_TEXTURE_2D, p.texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glGenFramebuffers(1, &p.one);
  glBindFramebuffer(GL_FRAMEBUFFER, p.one);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, p.texture, 0);
  good = good && glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glGenFramebuffers(1, &p.out);
  glGenVertexArrays(1, &p.arrays);
  p.program = programOf(kWhole, kLinear);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!good || p.program == 0) return notFound(say("The graphics driver gives no place to draw into."));
  return made;
}

void EyeTarget::bind() {
  glDisable(GL_FRAMEBUFFER_SRGB);
  glBindFramebuffer(GL_FRAMEBUFFER, parts_->many);
}

void EyeTarget::copyTo(unsigned texture, std::int64_t format) {
  const Parts& p = *parts_;
  p.resolve();
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, p.out);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  glDisable(GL_FRAMEBUFFER_SRGB);
  if (isSrgb(format)) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, p.one);
    glBlitFramebuffer(0, 0, p.width, p.height, 0, 0, p.width, p.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  } else {
    glViewport(0, 0, p.width, p.height);
    glDisable(GL_DEPTH_TEST), glDisable(GL_BLEND), glDisable(GL_CULL_FACE), glDisable(GL_SCISSOR_TEST);
    glUseProgram(p.program);
    glUniform1i(glGetUniformLocation(p.program, "picture"), 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, p.texture);
    glBindVertexArray(p.arrays);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glUseProgram(0);
  }
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void EyeTarget::show(unsigned framebuffer, int width, int height) {
  const Parts& p = *parts_;
  p.resolve();
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  const double scale = std::min(1.0 * width / p.width, 1.0 * height / p.height);
  const int w = static_cast<int>(p.width * scale), h = static_cast<int>(p.height * scale);
  const int x = (width - w) / 2, y = (height - h) / 2;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, p.one);
  glBlitFramebuffer(0, 0, p.width, p.height, x, y, x + w, y + h, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

Image EyeTarget::image() {
  const Parts& p = *parts_;
  p.resolve();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, p.one);
  Image upward(p.width, p.height), image(p.width, p.height);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, p.width, p.height, GL_RGBA, GL_UNSIGNED_BYTE, upward.rgba.data());
  const std::ptrdiff_t row = 4 * static_cast<std::ptrdiff_t>(p.width);
  for (int y = 0; y < p.height; ++y)
    std::copy_n(upward.rgba.begin() + row * (p.height - 1 - y), row, image.rgba.begin() + row * y);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return image;
}

}  // namespace karinui::room

#include "karinui/view/boards.h"

#include <algorithm>
#include <map>

#include "view/gl_objects.h"

namespace karinui {

namespace {

const std::string kBoardVertex = R"(
uniform mat4 toClip;
uniform vec3 corner, across, upward;
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = toClip * vec4(corner + across * place.x + upward * place.y, 1.0);
}
)";

// Pictures hold screen values already.
const std::string kBoardFragment = R"(
uniform sampler2D picture;
in vec2 place;
out vec4 colour;
void main() {
  colour = texture(picture, vec2(place.x, 1.0 - place.y));
  if (colour.a < 0.01) discard;
}
)";

const std::string kWholeVertex = R"(
out vec2 clip;
void main() {
  clip = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(clip, 0.0, 1.0);
}
)";

const std::string kVignetteFragment = R"(
uniform vec2 slope, middle;  // tangents of the view's angles: of half its clip width and height, and of its middle
uniform float strength, inner, outer;
in vec2 clip;
out vec4 colour;
void main() {
  float away = atan(length(clip * slope + middle));
  colour = vec4(0.0, 0.0, 0.0, strength * smoothstep(inner, outer, away));
}
)";

GlTexture textureOf(const Image& image) {
  GlTexture texture = newTexture();
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

struct Boards::Parts {
  GlProgram board, vignette;
  GlArrays noArrays;
  std::vector<Board> shown;
  std::map<std::shared_ptr<const Image>, GlTexture> textures;  // of those that are shown
};

Boards::Boards() : parts_(std::make_unique<Parts>()) {}
Boards::~Boards() = default;

Result<std::unique_ptr<Boards>> Boards::make() {
  std::unique_ptr<Boards> made(new Boards);
  auto board = makeProgram(kBoardVertex, kBoardFragment), vignette = makeProgram(kWholeVertex, kVignetteFragment);
  if (!board || !vignette) return board ? vignette.error() : board.error();
  made->parts_->board = std::move(*board), made->parts_->vignette = std::move(*vignette);
  made->parts_->noArrays = newArrays();
  return made;
}

void Boards::show(std::vector<Board> boards) {
  Parts& p = *parts_;
  std::erase_if(boards, [](const Board& b) { return !b.image || b.image->width <= 0 || b.image->height <= 0; });
  std::map<std::shared_ptr<const Image>, GlTexture> kept;
  for (const Board& b : boards) {
    if (kept.contains(b.image)) continue;
    const auto known = p.textures.find(b.image);
    kept.emplace(b.image, known != p.textures.end() ? std::move(known->second) : textureOf(*b.image));
  }
  p.textures = std::move(kept);
  p.shown = std::move(boards);
}

void Boards::draw(const Eye& eye, const DrawArea& area) const {
  const Parts& p = *parts_;
  if (p.shown.empty()) return;
  glViewport(area.x, area.y, area.width, area.height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(p.board);
  glUniformMatrix4fv(glGetUniformLocation(p.board, "toClip"), 1, GL_FALSE,
                     (area.crop() * eye.projection * eye.view).floats().data());
  glUniform1i(glGetUniformLocation(p.board, "picture"), 0);
  glActiveTexture(GL_TEXTURE0);
  glBindVertexArray(p.noArrays);
  for (const Board& b : p.shown) {
    (b.overAll ? glDisable : glEnable)(GL_DEPTH_TEST);
    set(p.board, "corner", b.corner), set(p.board, "across", b.across), set(p.board, "upward", b.upward);
    glBindTexture(GL_TEXTURE_2D, p.textures.at(b.image));
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glBindVertexArray(0);
  glUseProgram(0);
}

void Boards::vignette(const Eye& eye, const DrawArea& area, double strength) const {
  constexpr double kInner = 0.45, kOuter = 0.75;  // radians off the axis: clear up to, fully dark from there on
  if (strength <= 0) return;
  const Parts& p = *parts_;
  glViewport(area.x, area.y, area.width, area.height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(p.vignette);
  const auto m = (area.crop() * eye.projection).m;  // x / -z = (clip + m8) / m0
  glUniform2f(glGetUniformLocation(p.vignette, "slope"), static_cast<float>(1 / m[0]), static_cast<float>(1 / m[5]));
  glUniform2f(glGetUniformLocation(p.vignette, "middle"), static_cast<float>(m[8] / m[0]),
              static_cast<float>(m[9] / m[5]));
  set(p.vignette, "strength", std::clamp(strength, 0.0, 1.0));
  set(p.vignette, "inner", kInner), set(p.vignette, "outer", kOuter);
  glBindVertexArray(p.noArrays);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
  glBindVertexArray(0);
  glUseProgram(0);
}

}  // namespace karinui

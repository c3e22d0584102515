#include "karinui/view/picture.h"

// epoxy before anything that might pull in the system's GL
#include <epoxy/gl.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "karinui/view/offscreen.h"
#include "karinui/view/strain_scale.h"
#include "view/gl_objects.h"
#include "view/legend.h"
#include "view/stereo.h"

namespace karinui {
namespace {

constexpr int kLeast = 16, kMost = 8192;
constexpr int kTile = 2048;  // pixels drawn at once: keeps the memory small however large the picture

Error badSize(const std::string& said) {
  return badInput(
      say("A picture cannot be {0} pixels; each side may be {1} to {2}, as in 1200x1600.", said, kLeast, kMost));
}

// Mean of samples x samples pixels, into the image. Rows of `from` go upward, as GL keeps them.
void shrink(const std::vector<std::uint8_t>& from, int wide, int high, int samples, Image& to, int left, int top) {
  const int cells = samples * samples;
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x) {
      std::array<int, 3> sum{};
      for (int j = 0; j < samples; ++j) {
        const std::size_t row =
            static_cast<std::size_t>((high - 1 - y) * samples + j) * static_cast<std::size_t>(wide * samples);
        for (int i = 0; i < samples; ++i) {
          const std::size_t at = 4 * (row + static_cast<std::size_t>(x * samples + i));
          for (std::size_t c = 0; c < 3; ++c) sum[c] += from[at + c];
        }
      }
      to.set(left + x, top + y,
             {static_cast<std::uint8_t>((sum[0] + cells / 2) / cells),
              static_cast<std::uint8_t>((sum[1] + cells / 2) / cells),
              static_cast<std::uint8_t>((sum[2] + cells / 2) / cells), 255});
    }
}

// A framebuffer of our own for one tile.
struct Tile {
  GlTarget target = newTarget();
  GlStore colour = newStore(), depth = newStore();
  bool good = false;

  Tile(int wide, int high) {
    glBindRenderbuffer(GL_RENDERBUFFER, colour);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, wide, high);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, wide, high);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    good = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
};

// The eye's window, widened to the whole row of pictures that this one is a part of.
Eye overRow(Eye eye, const InRow& row) {
  Matrix4 widened;
  widened.m[0] = 1.0 / row.of, widened.m[12] = (2 * row.at + 1.0) / row.of - 1;
  eye.projection = widened * eye.projection;
  return eye;
}

Result<Image> drawEye(const Renderer& renderer, const Eye& eye, int width, int height, int samples, const InRow& row) {
  Image image(width, height);
  const int step = kTile / samples;
  const Tile tile(std::min(width, step) * samples, std::min(height, step) * samples);
  if (!tile.good) return notFound(say("The graphics driver gives no place to draw into."));
  std::vector<std::uint8_t> drawn;
  for (int top = 0; top < height; top += step)
    for (int left = 0; left < width; left += step) {
      const int wide = std::min(step, width - left), high = std::min(step, height - top);
      const double w = width, h = height;
      const DrawArea area{0,
                          0,
                          wide * samples,
                          high * samples,
                          (row.at + left / w) / row.of,
                          1 - (top + high) / h,
                          (row.at + (left + wide) / w) / row.of,
                          1 - top / h,
                          h * samples};
      renderer.draw(eye, area);
      drawn.resize(std::size_t{4} * static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height));
      glPixelStorei(GL_PACK_ALIGNMENT, 4);
      glReadPixels(0, 0, area.width, area.height, GL_RGBA, GL_UNSIGNED_BYTE, drawn.data());
      shrink(drawn, wide, high, samples, image, left, top);
    }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return image;
}

// What one eye sees.
std::array<int, 2> eyeSize(const PictureOptions& o) {
  return {o.eyes == Eyes::SideBySide ? o.width / 2 : o.width, o.eyes == Eyes::TopBottom ? o.height / 2 : o.height};
}
double aspectOf(const PictureOptions& o) {
  const auto [width, height] = eyeSize(o);
  return static_cast<double>(width) / height;
}

Error lost() { return notFound(say("The graphics driver has lost its context.")); }

bool usable(const Camera& camera) {
  return drawable(camera.eye) && drawable(camera.target) && finite(camera.up) && camera.distance() > 1e-4 &&
         camera.fieldOfView > 0.001 && camera.fieldOfView < 3.0;
}

Done usable(const PictureOptions& o) {
  if (o.width < kLeast || o.height < kLeast || o.width > kMost || o.height > kMost)
    return badSize(written(o.width) + "x" + written(o.height));
  if (o.samples < 1 || o.samples > 4)
    return badInput(say("A pixel cannot be the mean of {0} x {0} samples; 1 to 4.", o.samples));
  if (!std::isfinite(o.eyeSeparation) || std::fabs(o.eyeSeparation) > 10)
    return badInput(say("The eyes cannot be {0} m apart.", o.eyeSeparation));
  if (o.camera && !usable(*o.camera))
    return badInput(say("The camera stands nowhere: its places must be finite and apart."));
  KARINUI_ASSERT(o.row.at >= 0 && o.row.at < o.row.of);
  return {};
}

}  // namespace

Result<Map> mapNamed(std::string_view name) {
  if (name == "none") return Map::None;
  if (name == "strain") return Map::Strain;
  if (name == "pressure") return Map::Pressure;
  return badInput(say("There is no map “{0}”; say strain, pressure, or none.", name));
}

Result<std::array<int, 2>> sizeNamed(std::string_view said) {
  const std::size_t cut = said.find('x');
  std::array<int, 2> size{};
  if (cut == std::string_view::npos) return badSize(std::string(said));
  const std::string_view parts[] = {said.substr(0, cut), said.substr(cut + 1)};
  for (std::size_t i = 0; i < 2; ++i) {
    const char* end = parts[i].data() + parts[i].size();
    const auto read = std::from_chars(parts[i].data(), end, size[i]);
    if (read.ec != std::errc{} || read.ptr != end || size[i] < kLeast || size[i] > kMost)
      return badSize(std::string(said));
  }
  return size;
}

Result<PictureOptions> pictureOptions(const PictureWords& words, bool several) {
  const auto view = viewNamed(words.view);
  if (!view) return view.error();
  const auto map = mapNamed(words.map);
  if (!map) return map.error();
  const auto eyes = eyesNamed(words.eyes);
  if (!eyes) return eyes.error();
  if (several && *eyes != Eyes::Mono)
    return badInput(say("Garments side by side and whole turns are drawn for one eye; leave out the other."));
  const auto size = sizeNamed(!words.size.empty() ? words.size : several ? "600x1000" : "1200x1600");
  if (!size) return size.error();
  PictureOptions options;
  options.view = *view, options.map = *map, options.eyes = *eyes;
  options.width = (*size)[0], options.height = (*size)[1];
  options.language = spokenHere();
  return options;
}

struct Picture::Parts {
  std::unique_ptr<OffscreenContext> context;
  std::unique_ptr<Renderer> renderer;
  Lettering lettering;
  std::vector<std::string> captions;  // of what is shown
  Map map = Map::None;
  double mapTop = 0;
};

Picture::Picture() : parts_(std::make_unique<Parts>()) {}
Picture::~Picture() {
  if (!parts_->context) return;
  const OffscreenContext::Current current(*parts_->context);
  parts_->renderer.reset();
}
const std::string& Picture::renderer() const { return parts_->context->renderer(); }

Result<std::unique_ptr<Picture>> Picture::open(const Studio& studio) {
  std::unique_ptr<Picture> picture(new Picture);
  auto context = OffscreenContext::open();
  if (!context) return context.error();
  picture->parts_->context = std::move(*context);
  {
    const OffscreenContext::Current current(*picture->parts_->context);
    auto renderer = Renderer::make(studio);
    if (!renderer) return renderer.error();
    picture->parts_->renderer = std::move(*renderer);
  }
  return picture;
}

Result<Image> Picture::draw(const SceneFrame& frame, const PictureOptions& o) {
  notes_.clear();
  if (const Done good = usable(o); !good) return good.error();
  double top = 0;
  if (o.map != Map::None) {
    const double own = strainTop(frame);
    if (own == 0)
      return refused(o.map == Map::Strain ? say("There is no strain to show yet: settle the drape first.")
                                          : say("There is no pressure to show yet: settle the drape first."));
    top = o.mapTop > 0 && std::isfinite(o.mapTop) ? o.mapTop : own;
  }
  const OffscreenContext::Current current(*parts_->context);
  if (!current.ok()) return lost();
  parts_->renderer->show(frame, top);
  parts_->captions = frame.captions;
  parts_->map = o.map, parts_->mapTop = top;
  if (o.camera) return seen(*o.camera, o);
  std::size_t apart = 0;
  auto image = seen(frameAll(worn(frame, &apart), o.view, aspectOf(o)), o);
  if (apart > 0)
    notes_.push_back(say(
        "{0} {0|piece stands|pieces stand} apart from the figure, which the picture is framed for; place {0|it|them} "
        "on the body, or remove {0|it|them}.",
        apart));
  return image;
}

Result<Image> Picture::again(const PictureOptions& o) {
  KARINUI_ASSERT(o.camera);
  notes_.clear();
  if (const Done good = usable(o); !good) return good.error();
  const OffscreenContext::Current current(*parts_->context);
  if (!current.ok()) return lost();
  return seen(*o.camera, o);
}

Result<Image> Picture::seen(const Camera& camera, const PictureOptions& o) {
  const std::array size = eyeSize(o);
  Renderer& renderer = *parts_->renderer;
  renderer.light(camera);
  notes_ = renderer.notes();
  const auto drawn = [&](double sideways) -> Result<Image> {
    return drawEye(renderer, overRow(eyeOf(camera, aspectOf(o), sideways), o.row), size[0], size[1], o.samples, o.row);
  };
  const auto lettered = [&](Image& image) {
    if (!o.lettering) return;
    writeCaptions(image, parts_->lettering, parts_->captions);
    if (parts_->mapTop > 0) drawLegend(image, parts_->lettering, parts_->map, parts_->mapTop, o.language);
    for (Message& note : parts_->lettering.takeNotes()) notes_.push_back(std::move(note));
  };
  if (o.eyes == Eyes::Mono) {
    auto image = drawn(0);
    if (image) lettered(*image);
    return image;
  }
  auto left = drawn(-o.eyeSeparation / 2), right = drawn(o.eyeSeparation / 2);
  if (!left || !right) return left ? right.error() : left.error();
  if (o.eyes == Eyes::Anaglyph) {
    Image both = anaglyph(*left, *right);
    lettered(both);
    return both;
  }
  Image both(o.width, o.height);
  lettered(*left), lettered(*right);  // at the same place for each eye: the words lie in the plane of the target
  both.paste(*left, 0, 0);
  const bool sideBySide = o.eyes == Eyes::SideBySide;
  both.paste(*right, sideBySide ? size[0] : 0, sideBySide ? 0 : size[1]);
  return both;
}

}  // namespace karinui

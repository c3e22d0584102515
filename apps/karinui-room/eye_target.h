#pragma once
// Where an eye's picture is drawn before it goes into a headset's texture: with its depths, smoothed, and in sRGB
// values whatever the texture holds. Needs OpenGL 3.3 core; its context is current at every call and at its end.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "karinui/base/result.h"
#include "karinui/view/image.h"

namespace karinui::room {

// The best of the texture formats a runtime offers, in GL's numbers; none: none of them can be drawn into. sRGB formats
// first, for what is drawn are sRGB values; a linear format is given linear light.
std::optional<std::int64_t> formatAmong(std::span<const std::int64_t> offered);
bool isSrgb(std::int64_t format);

class EyeTarget {
 public:
  // `samples`: 1, or as many a pixel (as the driver has them).
  static Result<std::unique_ptr<EyeTarget>> make(int width, int height, int samples);
  ~EyeTarget();
  EyeTarget(const EyeTarget&) = delete;
  EyeTarget& operator=(const EyeTarget&) = delete;

  int width() const;
  int height() const;
  void bind();  // the renderer draws here
  // What was drawn goes into the texture, which holds this format and is as large.
  void copyTo(unsigned texture, std::int64_t format);
  // Into the framebuffer that is bound for drawing: scaled to fit this wide and high, the rest black.
  void show(unsigned framebuffer, int width, int height);
  Image image();  // what was drawn

 private:
  EyeTarget();
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace karinui::room

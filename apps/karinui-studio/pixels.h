#pragma once
#include <QImage>

#include "karinui/view/image.h"

namespace karinui::studio {

// Looks at the image's own pixels: it must not outlive them. copy() keeps them.
inline QImage pixelsOf(const Image& image) {
  return {image.rgba.data(), image.width, image.height, 4 * image.width, QImage::Format_RGBA8888};
}

}  // namespace karinui::studio

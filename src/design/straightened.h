#pragma once
// A photograph taken at a slant, as if taken from straight above. Pure; any thread.
#include <array>

#include "karinui/design/print_image.h"
#include "karinui/geometry/vec.h"

namespace karinui {

struct Straightened {
  PrintPixels image;
  double width = 0;  // metres, of the whole image
  Flat middle;       // from the first corner to the image's middle, metres, v up
};
// `corners`: of a rectangle on the paper, in pixels of the picture (down), in order; `sides`: how long it is from the
// first to the second and to the third, metres. Its sides become level and upright, turned as little as that takes.
Result<Straightened> straightened(const PrintPixels& picture, const std::array<Flat, 4>& corners, Flat sides);

}  // namespace karinui

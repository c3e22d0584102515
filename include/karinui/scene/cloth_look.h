#pragma once
// How cloth looks: how its threads lie, how it shines, what is printed on it. Places of a print are metres on paper,
// turned so that the grain runs upwards; so a print keeps its scale and follows the grain on any body. Plain values;
// any thread. Colours linear RGB in [0, 1].
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "karinui/geometry/vec.h"

namespace karinui {

using Colour = std::array<float, 3>;

// A photograph for a print: sRGB, three bytes a pixel, rows from the top.
struct PrintImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  bool operator==(const PrintImage&) const = default;
};

struct ClothLook {
  // What can be seen of the threads. Uneven: nothing but their unevenness (the studio's own plain cloth).
  enum class Weave { Uneven, Plain, Slub, Twill, Herringbone, Knit, Satin, Sheer, Pile, Hide };
  Weave weave = Weave::Uneven;
  float threads = 0.0012f;  // metres from one rib, twill line, slub or pore to the next
  float relief = 0.16f;     // how strongly they darken and lighten
  float gloss = 0;          // strength of the highlight: 0 wool, 1 silk satin
  float sharpness = 18;     // its exponent
  float fuzz = 0.16f;       // light that fine hairs catch towards the silhouette; velvet has most
  float cover = 1;          // 1: nothing is seen through it
  double thickness = 0;     // metres; its edges show it

  enum class Print { None, Stripe, Check, Dot, Photo };
  Print print = Print::None;
  Colour ink{0.9f, 0.9f, 0.88f};            // of stripe, check and dot
  double repeat = 0.02;                     // metres from one to the next; of a photograph its width
  double turn = 0;                          // radians, counter-clockwise from the grain
  Flat grain{0, 1};                         // unit, on paper
  Flat origin;                              // on paper: where the print begins
  std::shared_ptr<const PrintImage> photo;  // Print::Photo

  // Its other side, where that looks otherwise; its print has the repeat, turn and photograph of the right side's.
  struct Wrong {
    Colour colour{};
    Print print = Print::None;
    Colour ink{};
  };
  std::optional<Wrong> wrong;
};

// A place of the print: paper from the print's origin, turned by the grain and by the print's own turn, so that stripes
// run along y. The two steps on paper by which a place is measured: across and along the print.
std::array<Flat, 2> printAxes(const ClothLook& look);

}  // namespace karinui

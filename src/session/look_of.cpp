#include "karinui/session/look_of.h"

#include <array>
#include <cmath>

#include "karinui/design/print_image.h"

namespace karinui {

namespace {

// What the light does on the ten surfaces. Ribs and twills are drawn a little larger than they are, or no picture of a
// whole figure could show them; the order is that of Finish.
struct Surface {
  ClothLook::Weave weave;
  float threads, relief, gloss, sharpness, fuzz, cover;
};
using W = ClothLook::Weave;
constexpr std::array<Surface, 10> kSurfaces{{
    // threads (m), relief, gloss, its exponent, fuzz, cover
    {W::Plain, 0.0012f, 0.10f, 0.05f, 12, 0.12f, 1},      // poplin
    {W::Slub, 0.0022f, 0.34f, 0.02f, 10, 0.14f, 1},       // linen
    {W::Twill, 0.0030f, 0.36f, 0.02f, 10, 0.10f, 1},      // denim
    {W::Twill, 0.0022f, 0.14f, 0.05f, 10, 0.24f, 1},      // suiting
    {W::Herringbone, 0.0140f, 0.42f, 0, 10, 0.30f, 1},    // tweed
    {W::Knit, 0.0026f, 0.24f, 0.01f, 10, 0.20f, 1},       // jersey
    {W::Satin, 0.0008f, 0.03f, 0.85f, 14, 0.04f, 1},      // satin
    {W::Sheer, 0.0012f, 0.10f, 0.06f, 16, 0.10f, 0.46f},  // chiffon
    {W::Pile, 0.0020f, 0.10f, 0, 10, 1.30f, 1},           // velvet
    {W::Hide, 0.0050f, 0.26f, 0.42f, 34, 0.02f, 1},       // leather
}};

}  // namespace

// IEC 61966-2-1.
Colour linear(Dye dye) {
  const auto part = [](std::uint8_t value) {
    const double s = value / 255.0;
    return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  };
  return {part(dye.red), part(dye.green), part(dye.blue)};
}

ClothLook clothLookOf(const Look& look, const Fabric& fabric, Flat grain, Flat origin, const Prints& prints) {
  const Surface& surface = kSurfaces[static_cast<std::size_t>(look.finish)];
  ClothLook shown;
  shown.weave = surface.weave;
  shown.threads = surface.threads, shown.relief = surface.relief;
  shown.gloss = surface.gloss, shown.sharpness = surface.sharpness;
  shown.fuzz = surface.fuzz, shown.cover = surface.cover;
  shown.thickness = fabric.thickness;
  shown.print = static_cast<ClothLook::Print>(look.print);
  shown.ink = linear(look.ink);
  shown.repeat = look.repeat, shown.turn = look.turn;
  shown.grain = grain, shown.origin = origin;
  if (look.wrong)
    shown.wrong = {linear(look.wrong->colour), static_cast<ClothLook::Print>(look.wrong->print),
                   linear(look.wrong->ink)};
  const auto photo = [](ClothLook::Print print) { return print == ClothLook::Print::Photo; };
  if (prints && (photo(shown.print) || (shown.wrong && photo(shown.wrong->print)))) shown.photo = prints(look.photo);
  if (!shown.photo) {
    if (photo(shown.print)) shown.print = ClothLook::Print::None;
    if (shown.wrong && photo(shown.wrong->print)) shown.wrong->print = ClothLook::Print::None;
  }
  return shown;
}

void turnInsideOut(Colour& colour, ClothLook& look) {
  const ClothLook::Wrong right{colour, look.print, look.ink}, wrong = look.wrong.value_or(right);
  colour = wrong.colour, look.print = wrong.print, look.ink = wrong.ink;
  look.wrong = right;
}

std::shared_ptr<const PrintImage> PrintShelf::find(const std::string& photo, const Blobs& blobs) {
  const auto [at, fresh] = read_.emplace(photo, nullptr);
  if (!fresh) return at->second;
  const auto bytes = blobs.get(photo);
  if (!bytes) return nullptr;
  if (auto image = unpackPrint(*bytes))
    at->second = std::make_shared<const PrintImage>(PrintImage{image->width, image->height, std::move(image->rgb)});
  return at->second;
}

}  // namespace karinui

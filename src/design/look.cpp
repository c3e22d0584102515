#include "karinui/design/look.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "design/pack.h"
#include "karinui/design/document.h"
#include "karinui/design/print_image.h"

namespace karinui {

namespace {

struct Usual {
  std::string_view fabric;
  Finish finish;
  Dye colour;
};
// What the shop's cloths look like; the first of a finish has its usual colour.
constexpr std::array<Usual, 15> kUsual{{{"chiffon", Finish::Chiffon, {226, 178, 184}},
                                        {"cotton", Finish::Poplin, {137, 165, 205}},
                                        {"denim", Finish::Denim, {52, 73, 112}},
                                        {"jersey", Finish::Jersey, {156, 158, 164}},
                                        {"interfacing", Finish::Poplin, {232, 230, 222}},
                                        {"interlock", Finish::Jersey, {118, 138, 120}},
                                        {"leather", Finish::Leather, {92, 56, 36}},
                                        {"linen", Finish::Linen, {208, 194, 164}},
                                        {"satin", Finish::Satin, {216, 190, 164}},
                                        {"silk", Finish::Satin, {216, 190, 164}},
                                        {"tweed", Finish::Tweed, {124, 106, 84}},
                                        {"velvet", Finish::Velvet, {104, 22, 40}},
                                        {"viscose", Finish::Poplin, {134, 86, 104}},
                                        {"wool coating", Finish::Tweed, {124, 106, 84}},
                                        {"wool suiting", Finish::Suiting, {70, 74, 84}}}};

}  // namespace

Dye usualDye(Finish finish) {
  for (const Usual& usual : kUsual)
    if (usual.finish == finish) return usual.colour;
  return {};
}

// "wool_suiting_2" looks like wool suiting.
Look usualLook(std::string_view fabric) {
  std::string name(fabric);
  std::replace(name.begin(), name.end(), '_', ' ');
  for (const Usual& usual : kUsual)
    if (name.starts_with(usual.fabric)) {
      Look look;
      look.finish = usual.finish, look.colour = usual.colour;
      return look;
    }
  return {};
}

Look lookOf(const Document& document, std::string_view fabric) {
  const auto own = document.looks.fabrics.find(std::string(fabric));
  return own != document.looks.fabrics.end() ? own->second : usualLook(fabric);
}

Look lookOf(const Document& document, const Piece& piece) {
  for (const PieceId id : {piece.id, piece.mirrorOf})
    if (const auto own = document.looks.pieces.find(id); own != document.looks.pieces.end()) return own->second;
  return lookOf(document, piece.fabric);
}

Done checkLook(const Look& look) {
  constexpr double kLeast = 0.001, kMost = 2;  // metres
  if (!(look.repeat >= kLeast && look.repeat <= kMost))
    return refused(say("A print repeats every {0} mm; between {1} and {2} mm is possible.", look.repeat * 1000,
                       kLeast * 1000, kMost * 1000));
  if (!(std::fabs(look.turn) <= 6.3)) return refused(say("A print is turned by a full circle at most."));
  const bool photo = look.print == PrintKind::Photo || (look.wrong && look.wrong->print == PrintKind::Photo);
  if (photo && look.photo.empty()) return refused(say("There is no photograph to print yet; open one first."));
  return {};
}

namespace {
constexpr std::string_view kPrint = "karinui print 1";
}

std::string packPrint(const PrintPixels& image) {
  Writer w;
  w.add(kPrint).add(image.width).add(image.height);
  w.add(std::string_view(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size()));
  return w.taken();
}

Result<std::array<int, 2>> printSize(std::string_view bytes) {
  Reader r(bytes);
  const bool ours = r.text() == kPrint;
  const int width = r.number<int>(), height = r.number<int>();
  const auto side = [](int n) { return n >= 1 && n <= kMostScanSide; };
  if (!ours || !r.good() || !side(width) || !side(height))
    return storageError(say("The stored photograph is damaged."));
  return std::array{width, height};
}

Result<PrintPixels> unpackPrint(std::string_view bytes) {
  const auto size = printSize(bytes);
  if (!size) return size.error();
  Reader r(bytes);
  r.text(), r.number<int>(), r.number<int>();
  PrintPixels image{size->at(0), size->at(1), {}};
  const std::string pixels = r.text();
  if (!r.finished() ||
      pixels.size() != std::size_t{3} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    return storageError(say("The stored photograph is damaged."));
  image.rgb.assign(pixels.begin(), pixels.end());
  return image;
}

PrintPixels fitted(PrintPixels image, int mostSide) {
  const int longer = std::max(image.width, image.height), by = (longer + mostSide - 1) / mostSide;
  if (by <= 1) return image;
  PrintPixels small{std::max(1, image.width / by), std::max(1, image.height / by), {}};
  const auto at = [&](int x, int y, std::size_t c) {
    return image
        .rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) +
             c];
  };
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        int sum = 0, count = 0;
        for (int j = y * by; j < std::min((y + 1) * by, image.height); ++j)
          for (int i = x * by; i < std::min((x + 1) * by, image.width); ++i) sum += at(i, j, c), ++count;
        small.rgb.push_back(static_cast<std::uint8_t>((sum + count / 2) / std::max(1, count)));
      }
  return small;
}

}  // namespace karinui

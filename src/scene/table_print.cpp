#include "karinui/scene/table_print.h"

#include <algorithm>
#include <cmath>

namespace karinui {

namespace {

constexpr double kPale = 0.55;
constexpr int kMostRepeats = 20000;
constexpr double kStripe = 0.42, kChecked = 0.5, kDot = 0.19;  // shares of a repeat, as on the cloth

// Repeats are counted across and along the print; places of the table are found from them.
struct Repeats {
  Flat lies, across, along;  // where the print begins on the table; a repeat across and along it
  double left = 1e9, right = -1e9, low = 1e9, high = -1e9;

  Repeats(const ClothLook& look, const TablePiece& piece, double tall) : lies(piece.lies + look.origin) {
    const auto [u, v] = printAxes(look);
    across = u * look.repeat, along = v * tall;
    for (const Flat corner :
         {piece.low, Flat{piece.high.u, piece.low.v}, piece.high, Flat{piece.low.u, piece.high.v}}) {
      const Flat paper = corner - lies;
      const double x = dot(paper, u) / look.repeat, y = dot(paper, v) / tall;
      left = std::min(left, x), right = std::max(right, x), low = std::min(low, y), high = std::max(high, y);
    }
  }
  Flat at(double x, double y) const { return lies + across * x + along * y; }
  double count() const { return (right - left + 1) * (high - low + 1); }
};

}  // namespace

TablePrint printOn(const TablePiece& piece) {
  TablePrint print;
  const ClothLook& look = piece.look;
  const bool photo = look.print == ClothLook::Print::Photo && look.photo;
  if (look.print == ClothLook::Print::None || !(look.repeat > 0)) return print;
  const Repeats r(look, piece, photo ? look.repeat * look.photo->height / look.photo->width : look.repeat);
  if (!(r.count() <= kMostRepeats)) return print;
  const auto stripesAcross = [&] {
    for (double x = std::floor(r.left) + 0.5; x < r.right + 1; ++x)
      print.stripes.push_back({r.at(x, r.low), r.at(x, r.high)});
  };
  print.strength = kPale;
  switch (look.print) {
    case ClothLook::Print::Stripe:
      print.stripe = kStripe * look.repeat;
      stripesAcross();
      break;
    case ClothLook::Print::Check:
      print.stripe = kChecked * look.repeat;
      print.strength = kPale / 2;
      stripesAcross();
      for (double y = std::floor(r.low) + 0.5; y < r.high + 1; ++y)
        print.stripes.push_back({r.at(r.left, y), r.at(r.right, y)});
      break;
    case ClothLook::Print::Dot:
      print.dot = kDot * look.repeat;
      for (double y = std::floor(2 * r.low) / 2; y < r.high + 1; y += 0.5)
        for (double x = std::floor(r.left) + (std::fmod(std::fabs(2 * y), 2) == 1 ? 0.5 : 0); x < r.right + 1; ++x)
          print.dots.push_back(r.at(x, y));
      break;
    case ClothLook::Print::Photo:
      for (double y = std::floor(r.low); photo && y < r.high; ++y)
        for (double x = std::floor(r.left); x < r.right; ++x)
          print.photos.push_back({r.at(x, y + 1), r.at(x + 1, y + 1), r.at(x, y)});
      break;
    case ClothLook::Print::None:
      break;
  }
  return print;
}

}  // namespace karinui

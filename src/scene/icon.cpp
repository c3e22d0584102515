#include "karinui/scene/icon.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

namespace karinui {

namespace {

// M x y: begin a stroke; L x y …: on; C six numbers: a curve; O x y r: a circle; D x y r: a dot. After a letter's
// numbers the next letter.
std::vector<IconStroke> strokesOf(const char* drawing) {
  std::vector<IconStroke> strokes;
  std::istringstream in(drawing);
  char letter = 0;
  const auto place = [&] {
    Flat p;
    in >> p.u >> p.v;
    return p;
  };
  const auto circle = [&](bool filled) {
    const Flat c = place();
    double r = 0;
    in >> r;
    IconStroke round;
    round.filled = filled;
    for (int i = 0; i <= 32; ++i) {
      const double a = 2 * std::numbers::pi * i / 32;
      round.points.push_back(c + Flat{r * std::cos(a), r * std::sin(a)});
    }
    strokes.push_back(std::move(round));
  };
  while (in >> letter) {
    if (letter == 'M') {
      strokes.push_back({{place()}, false});
    } else if (letter == 'L') {
      strokes.back().points.push_back(place());
    } else if (letter == 'C') {
      const Flat a = strokes.back().points.back(), b = place(), c = place(), d = place();
      for (int i = 1; i <= 12; ++i) {
        const double t = i / 12.0, s = 1 - t;
        strokes.back().points.push_back(a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t));
      }
    } else {
      circle(letter == 'D');
    }
  }
  return strokes;
}

std::vector<Icon> drawnIcons() {
  std::vector<Icon> all;
  const auto add = [&](std::string_view name, const char* drawing) { all.push_back({name, strokesOf(drawing)}); };
  // A tailor's chalk line closing on itself.
  add("draw", "M 5 17 C 3 11 7 5 12 7 C 16 8 14 13 18 12 C 22 11 21 18 15 19 C 11 20 6 20 5 17 D 5 17 1.7");
  // Four ways.
  add("move",
      "M 12 3 L 12 21 M 3 12 L 21 12 M 9 6 L 12 3 L 15 6 M 9 18 L 12 21 L 15 18 M 6 9 L 3 12 L 6 15 M 18 9 L 21 "
      "12 L 18 15");
  // A needle and its thread.
  add("sew",
      "M 20 4 L 8.5 15.5 M 20 4 C 17.5 4.5 16 6 15 7.5 M 20 4 C 19.5 6.5 18 8 16.5 9 M 8.5 15.5 C 6 18 9.5 20.5 12 "
      "19 C 14.5 17.5 17 19 15.5 21 M 4 8 L 6.5 10.5 M 3 12 L 5 14");
  // Scissors.
  add("cut", "O 6.5 17.5 2.8 O 17.5 17.5 2.8 M 8.2 15.2 L 17 3.5 M 15.8 15.2 L 7 3.5 D 12 10.2 0.9");
  // A hand's pinch drawing cloth away.
  add("pull", "M 3 20 C 8 20 9 16 12 13 C 15 16 16 20 21 20 M 12 13 L 12 3.5 M 8.8 6.7 L 12 3.5 L 15.2 6.7");
  // An outline giving way at one point.
  add("reshape",
      "M 4 19 L 4 9 C 8 9 9 4 14 4 L 20 4 L 20 19 L 4 19 D 14 4 1.8 D 4 9 1.8 M 14 8 L 14 13 M 12 11 L 14 13 L "
      "16 11");
  add("points", "M 5 18 L 9 6 L 19 9 L 17 19 L 5 18 D 5 18 1.9 D 9 6 1.9 D 19 9 1.9 D 17 19 1.9");
  add("notch", "M 4 7 L 20 7 M 12 7 L 12 14 M 4 7 L 4 20 M 20 7 L 20 20");
  add("dart", "M 3 5 L 8 5 L 12 18 L 16 5 L 21 5 M 3 5 L 3 20 M 21 5 L 21 20 D 12 18 1.5");
  add("line", "M 3 4 L 21 4 L 21 20 L 3 20 L 3 4 M 7 14 L 9 13 M 11 12 L 13 11 M 15 10 L 17 9");
  add("select", "M 6 3.5 L 6 18 L 10 14.5 L 12.5 20.5 L 15 19.5 L 12.5 13.7 L 17.5 13.5 L 6 3.5");
  add("undo", "M 9 14 L 4 9 L 9 4 M 4 9 L 14 9 C 18 9 20 11.5 20 14.5 C 20 18 17.5 20 14 20 L 11 20");
  add("redo", "M 15 14 L 20 9 L 15 4 M 20 9 L 10 9 C 6 9 4 11.5 4 14.5 C 4 18 6.5 20 10 20 L 13 20");
  // A dress coming to rest.
  add("settle",
      "M 9 3.5 C 10 6 14 6 15 3.5 L 18.5 7 L 16 10 L 19.5 20.5 C 17 19 15 22 12 20.3 C 9 22 7 19 4.5 20.5 L 8 10 "
      "L 5.5 7 L 9 3.5");
  add("pause", "M 9 5 L 9 19 M 15 5 L 15 19");
  add("view", "M 2.5 12 C 7 4.5 17 4.5 21.5 12 C 17 19.5 7 19.5 2.5 12 O 12 12 3");
  add("new", "M 6 3 L 14 3 L 19 8 L 19 21 L 6 21 L 6 3 M 14 3 L 14 8 L 19 8");
  add("open", "M 3 19 L 3 5 L 9 5 L 11 8 L 19 8 L 19 11 M 3 19 L 6.5 11 L 22 11 L 18.5 19 L 3 19");
  add("export", "M 12 15 L 12 3 M 8 7 L 12 3 L 16 7 M 5 12 L 5 20 L 19 20 L 19 12");
  add("print",
      "M 7 8 L 7 3 L 17 3 L 17 8 M 7 17 L 4 17 L 4 8 L 20 8 L 20 17 L 17 17 M 7 14 L 17 14 L 17 21 L 7 21 L 7 14");
  add("body",
      "O 12 4.8 2.6 M 12 7.4 L 12 9 M 7 10 C 9 8.6 15 8.6 17 10 L 15.5 14 C 15 16 16.5 18 16.5 21 L 7.5 21 C 7.5 18 9 "
      "16 8.5 14 L 7 10");
  add("fabric",
      "M 4 8 L 16 4 L 20 16 L 8 20 L 4 8 M 8 6.7 L 12 18.7 M 12 5.4 L 16 17.3 M 5.3 12 L 17.3 8 M 6.7 16 L 18.7 12");
  // A tape measure.
  add("tape",
      "O 9 10 6 O 9 10 2 M 9 16 L 21 16 L 21 20 L 9 20 C 6 20 3.2 16 3 10 M 13 16 L 13 18 M 16 16 L 16 18 M 19 16 L "
      "19 18");
  add("fit",
      "M 4 20 L 4 15 L 8 15 L 8 20 M 10 20 L 10 10 L 14 10 L 14 20 M 16 20 L 16 4 L 20 4 L 20 20 M 3 20 L 21 20");
  add("history", "O 12 12 8.5 M 12 7 L 12 12 L 15.5 14");
  add("rectangle", "M 3 6 L 21 6 L 21 18 L 3 18 L 3 6");
  add("circle", "O 12 12 9");
  add("ring",
      "M 6.5 6.5 C 2 11 3 20 12 21 C 21 20 22 11 17.5 6.5 L 14.5 9.5 C 17 12 16 16 12 16 C 8 16 7 12 9.5 9.5 L 6.5 "
      "6.5");
  add("polygon", "M 5 19 L 4 9 L 12 3.5 L 20 8 L 17 14 L 19 20 L 5 19 D 4 9 1.5 D 12 3.5 1.5 D 20 8 1.5");
  // A sheet with a line on it, and the pencil that follows it.
  add("trace",
      "M 14 3 L 4 3 L 4 21 L 18 21 L 18 14 M 7 18 C 7 12 9 13 11 9 M 12 13 L 13 10 L 20 3 L 22 5 L 15 12 L 12 13");
  add("pin", "O 14.5 8 3.5 M 12 10.5 L 4 20");
  add("frame", "M 4 9 L 4 4 L 9 4 M 15 4 L 20 4 L 20 9 M 20 15 L 20 20 L 15 20 M 9 20 L 4 20 L 4 15 O 12 12 3");
  add("glasses", "O 6.5 14 3.5 O 17.5 14 3.5 M 10 13.5 C 11 12.6 13 12.6 14 13.5 M 3 13 L 5 6 M 21 13 L 19 6");
  add("trash",
      "M 4 6 L 20 6 M 9 6 L 9 3.5 L 15 3.5 L 15 6 M 6 6 L 7 20.5 L 17 20.5 L 18 6 M 10 10 L 10 17 M 14 10 L 14 17");
  return all;
}

}  // namespace

std::span<const Icon> icons() {
  static const std::vector<Icon> all = drawnIcons();
  return all;
}

const Icon* icon(std::string_view name) {
  for (const Icon& one : icons())
    if (one.name == name) return &one;
  return nullptr;
}

}  // namespace karinui

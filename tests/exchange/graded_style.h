#pragma once
// A style in four sizes. Metres.
#include "exchange/bodice_half.h"
#include "karinui/exchange/sheet.h"

namespace karinui::test {

// A front whose armhole is graded within, and a sleeve.
struct GradedStyle {
  Pattern pattern;
  SheetSettings sheet;
};
inline GradedStyle gradedStyle() {
  GradedStyle made;
  Piece front;
  front.id = {1}, front.name = "front";
  front.outline = bodiceHalf();
  front.marks = {{"waist", "side", 0.4, {}}};
  Piece sleeve;
  sleeve.id = {2}, sleeve.name = "sleeve";
  sleeve.outline.edges = {{"cuff", Curve::line({0.02, 0}, {0.2, 0})},
                          {"under", Curve::line({0.2, 0}, {0.22, 0.3})},
                          {"cap", Curve::cubic({0.22, 0.3}, {0.2, 0.45}, {0.02, 0.45}, {0, 0.3})},
                          {"under_2", Curve::line({0, 0.3}, {0.02, 0})}};
  Grading& grading = made.sheet.grading;
  grading.sizes = {"S", "M", "L", "XL"};
  grading.base = grading.standing = 1;
  const auto by = [](double u, double v) { return std::vector<Flat>{{-u, -v}, {}, {u, v}, {2 * u, 2 * v}}; };
  grading.pieces[{1}] = {{"hem", 0, by(0, 0)},
                         {"side", 0, by(.01, 0)},
                         {"armhole", 0, by(.01, .004)},
                         {"armhole", .5, by(.006, .005)},
                         {"shoulder", 0, by(.004, .006)},
                         {"neck", 0, by(.002, .006)},
                         {"centre", 0, by(0, .005)}};
  grading.pieces[{2}] = {{"cuff", 0, by(-.003, 0)},
                         {"under", 0, by(.003, 0)},
                         {"cap", 0, by(.005, .004)},
                         {"under_2", 0, by(-.005, .004)}};
  for (Piece piece : {front, sleeve}) {
    piece.outline = *checked(piece.outline);
    made.pattern.pieces[piece.id] = std::make_shared<const Piece>(piece);
  }
  return made;
}

}  // namespace karinui::test

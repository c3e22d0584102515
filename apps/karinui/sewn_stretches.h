#pragma once
// What each stretch of a piece's edges is sewn to: where on a waistband the sides and the centre come.
#include <vector>

#include "karinui/design/document.h"

namespace karinui::app {

struct SewnStretch {
  EdgeSpan own, other;  // from <= to in both
  SeamId seam;
  double length = 0;  // metres of the own edge
};
// In the order of the outline.
std::vector<SewnStretch> sewnStretches(const Document& document, const Piece& piece);
// As scripts name it: low, low@0.25:0.5.
std::string stretchNamed(const EdgeSpan& span);

}  // namespace karinui::app

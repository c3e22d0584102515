#pragma once
// An edge made longer or shorter to a typed length. Pure; any thread. Metres on paper.
#include <string>
#include <string_view>

#include "karinui/pattern/symmetry.h"

namespace karinui {

enum class KeptEnd { Start, End, Middle };  // Middle: both ends move by half of the difference

struct LengthChange {
  std::string edge;
  double to = 0;
  KeptEnd keep = KeptEnd::Start;
  // The edges at the moved ends keep their lengths where they can: each turns about its other end, or slides along the
  // axis where that end lies on it, and the edge itself turns a little to meet it. Where one of them would turn too far
  // for that (10 degrees the edge, 20 the neighbour) the neighbour stretches instead; so it does always if this is
  // false, and the edge then does not turn.
  bool neighboursKeep = true;
};

// The outline in which the edge has its new length to 1e-9 m: its shape is scaled, the kept end stays bit for bit, and
// so do all edges but it and its neighbours at the moved ends. With a symmetry both halves change alike (the edge needs
// a partner there): an end on the axis slides along it, an edge across the axis is changed in the middle. Refuses what
// cannot be and outlines that would cross themselves.
Result<Outline> withLength(const Outline& outline, const LengthChange& change, const PaperSymmetry* symmetry);

// The outline in which the end of the edge that does not stay (Middle: both ends) has gone along the edge beside it by
// a length, that one becoming as much shorter; straight on and longer where the length is negative. The edge's shape is
// scaled and turned with it. Refuses an end on the axis, where both halves change, and an edge beside it that is too
// short.
Result<Outline> withEndAlong(const Outline& outline, std::string_view edge, KeptEnd keep, double by,
                             const PaperSymmetry* symmetry);

// The outline in which a curved edge meets the edges beside it at the angles at which it met them in `was`, so that a
// line which went on smoothly over a seam still does. Its length becomes a little other. Straight edges and arcs stay.
Result<Outline> withAnglesOf(const Outline& was, Outline now, std::string_view edge, const PaperSymmetry* symmetry);

// Whether that end of the edge could be the one that moves.
bool canMoveEnd(const Outline& outline, std::size_t edge, bool end, const PaperSymmetry* symmetry);

}  // namespace karinui

#pragma once
// An examiner of draped cloth that shares no code with the solver: exact triangle tests against the body's mesh, not
// its field. It is a library of its own, karinui_check, in which there is nothing of the solver. Pure; any thread, but
// one at work.
#include "karinui/body/body.h"
#include "karinui/cloth/cloth.h"
#include "karinui/cloth/settle_report.h"

namespace karinui {

// Where two pieces, or a piece and itself (a = b), pass through each other.
struct ClothCrossing {
  PieceId a, b;
  std::size_t pairs = 0;  // of faces
  Vec3 middle;            // of them, in space
};

struct ClothCheck {
  bool finite = true;                   // false: nothing else was examined
  double penetration = 0;               // metres: deepest of all nodes and face samples below the body's mesh
  std::size_t clothBodyCrossings = 0;   // pairs of faces
  std::size_t clothClothCrossings = 0;  // pairs of faces that share no node and no tie
  // Pairs that share a node or a tie and pass through each other away from it: a fold that closed beside its crease or
  // at its seam.
  std::size_t foldCrossings = 0;
  std::vector<ClothCrossing> crossings;  // both kinds by pieces, the most pairs first
  double seamGap = 0;                    // metres, widest
  StrainReport strain;
  std::size_t vertices = 0;
};
// `state` has one place per node of `cloth`. No body (null): nothing is entered or crossed but the cloth itself.
ClothCheck check(const Cloth& cloth, const ClothState& state, const Body* body);

}  // namespace karinui

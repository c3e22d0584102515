#pragma once
// An examiner that shares no code with the solver: exact triangle tests against the body's mesh, not its field.
// Pure; any thread, but one at work.
#include "karinui/body/body.h"
#include "karinui/cloth/cloth.h"
#include "karinui/cloth/settle_report.h"

namespace karinui {

// An elastic as it lies in the cloth.
struct ElasticPull {
  PieceId piece;
  std::string edge;
  double cut = 0, now = 0;  // metres: its own length, and drawn out
  double pull = 0;          // N, on average along it
};

// A closed fastening as it holds.
struct FasteningPull {
  std::string name;
  FasteningKind kind = FasteningKind::Button;
  std::size_t number = 0;  // of its places, from 1; of a zip 0
  double gap = 0;          // metres between the two places, or the widest between a zip's sides
  double force = 0;        // N that draw it open; of a zip along all of its closed part
  double length = 0;       // metres of a zip's closed part
  bool holds() const;      // false: it does not reach, or its thread would tear
};

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
  std::vector<ElasticPull> elastics;
  std::vector<FasteningPull> fastenings;
};
// `state` has one place per node of `cloth`. No body (null): nothing is entered or crossed but the cloth itself.
std::vector<ElasticPull> elasticPulls(const Cloth& cloth, const ClothState& state);
std::vector<FasteningPull> fasteningPulls(const Cloth& cloth, const ClothState& state);
ClothCheck check(const Cloth& cloth, const ClothState& state, const Body* body);

}  // namespace karinui

#pragma once
// Cloth = what is fixed (lattices, fabrics, ties, masses); ClothState = what moves. A Cloth is built once per change of
// the pattern and shared. Metres, in space. Plain values and pure functions; any thread.
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "karinui/cloth/fabric.h"
#include "karinui/pattern/allowance.h"
#include "karinui/pattern/lattice.h"

namespace karinui {

struct ClothPiece {
  PieceId id;
  std::string name;
  std::shared_ptr<const Lattice> lattice;
  Fabric fabric;
  std::uint32_t firstNode = 0;  // the piece's lattice node k is cloth node firstNode + k
  int layer = 0;
  bool live = true;  // false: rigid or frozen, its nodes do not move and act as a fixed boundary
};

struct Tie {  // of cloth nodes; see SeamTie
  std::uint32_t a = 0, b = 0, c = kNoNode;
  std::uint32_t seam = 0;  // index into Cloth::seams
};

struct ClothEdge {        // an edge, or part of one, with something sewn to it or turned up
  std::size_t piece = 0;  // of Cloth::pieces
  std::string name;
  std::vector<std::uint32_t>
      nodes;          // cloth nodes along it, its ends included; the first is the last round a whole ring
  double length = 0;  // on paper
};
struct ElasticEdge {
  ClothEdge edge;
  Elastic elastic;
};
struct FoldedBackEdge {  // with a strip of its own cloth along it: a hem turned up, a seam allowance pressed open
  ClothEdge edge;
  double width = 0;
};
struct TrimmedEdge {  // a cord or a strip along it
  ClothEdge edge;
  double bending = 0;  // N m2 beyond the cloth's own
  double weight = 0;   // kg/m
};
struct CreasedLine {
  std::size_t piece = 0;
  std::vector<Flat> places;  // on paper, of a polyline
  Crease crease;
};

// A closed button, snap, hook or tie: a place on one piece, as weights in a triangle, held to a place on another.
struct ClothFastener {
  std::string name;        // of its fastening
  std::size_t number = 0;  // of the fastening's places, from 1
  FasteningKind kind = FasteningKind::Button;
  std::array<std::uint32_t, 6> nodes{};  // three of the piece that lies over, three of the other
  std::array<double, 6> weights{};       // the other's are negative: the sum of weighted places is the way between
  double gap = 0;                        // metres apart at which a tie holds
  bool laps = false;                     // the one lies over the other, and is led there from its right side
};
struct ClothZip {
  std::string name;
  std::uint32_t seam = 0;  // of Cloth::seams: its closed part
  double length = 0;       // of that, on paper
};

struct Cloth {
  double spacing = 0;
  std::vector<ClothPiece> pieces;
  std::vector<SeamId> seams;
  std::vector<Tie> ties;
  std::vector<std::uint32_t> pinned;  // nodes held where they are in the starting state
  bool pleated = false;               // layers of it lie over one another before it is sewn
  std::uint32_t nodeCount = 0;
  std::vector<ElasticEdge> elastics;
  std::vector<FoldedBackEdge> foldedBack;
  std::vector<TrimmedEdge> trims;
  std::vector<CreasedLine> creases;
  std::vector<ClothFastener> fasteners;
  std::vector<ClothZip> zips;
};

struct ClothState {
  std::vector<Vec3> position;  // one per cloth node
};

struct ClothChoice {
  std::map<PieceId, bool> live;               // missing: live unless the piece is frozen
  std::map<PieceId, std::vector<Flat>> pins;  // paper places; the nodes within `pinRadius` of each are held
  double pinRadius = 0.01;
  const Allowances* finish = nullptr;  // whose elastics, hems, trims and fastenings the edges have; null: none
};

// Puts a laid pattern's pieces, fabrics and ties together as one cloth. Refuses a piece that was not laid or whose
// fabric is neither in `fabrics` nor a preset. Closed zips are seams of the pattern (withZips), which was laid so.
Result<Cloth> assemble(const Pattern& pattern, const LaidPattern& laid, const std::map<std::string, Fabric>& fabrics,
                       const ClothChoice& choice);

// Where every node is when each piece stands as its form and pose say.
ClothState standing(const Pattern& pattern, const Cloth& cloth);

// The form a state leaves for one of its pieces (in space, so the piece's pose becomes identity).
std::shared_ptr<const Form> formOf(const Cloth& cloth, const ClothState& state, std::size_t piece);

}  // namespace karinui

#pragma once
// Node-face and edge-edge pairs of cloth that are near each other or might become so in a step.
#include <array>
#include <span>
#include <vector>

#include "cloth/proximity_list.h"

namespace karinui {

struct ContactPair {
  std::array<NodeIndex, 4> node{};
  std::array<double, 4> weight{};  // of the two closest points: first side positive, second negative
  int first = 1;                   // how many nodes are of the first side
  Vec3 normal;                     // from the second side to the first
  double gap = 0;                  // metres
  double push = 0;                 // newtons
  double along = 0, across = 0;    // stiffness, N/m: of the push, along the normal; of friction
};

class ContactPairs {
 public:
  // Both must outlive this. `radius`: of contact; `spacing`: of the cloth; metres.
  ContactPairs(const ClothTopology& topology, const SewnGroups& sewn, double radius, double spacing);

  // Two nodes that are both marked here do not make a pair. Empty: none is left out.
  void leaveOut(std::vector<std::uint8_t> marked) { leftOut_ = std::move(marked); }

  // Two pieces of one layer do not meet each other; they do at first.
  void onlyLayers(bool only) { list_.onlyLayers(only); }

  // The pairs with a gap below `within` at x; given moves, also those that may come so near during them.
  struct Search {
    std::span<const Vec3> x, move;  // `move` may be empty
    double within = 0;              // metres
  };
  std::vector<ContactPair> find(const Search& search, Workers& workers);

 private:
  // A node and a face or two edges, as they stood when the list was made.
  struct Candidate {
    std::array<NodeIndex, 4> node{};
    std::uint8_t first = 1;       // how many nodes are of the first side
    std::uint8_t neighbours = 0;  // a bit for each node of the one side with each of the other: whether they are that
    double gap = 0;               // metres
  };
  // How far nodes went: each, and by how much the other end of an edge at it went differently at most, metres.
  struct Motion {
    std::vector<Vec3> way;
    std::vector<double> spread;
    // By how much what is incident to one node and to the other came nearer to each other at most.
    double between(NodeIndex a, NodeIndex b) const { return length(way[a] - way[b]) + spread[a] + spread[b]; }
    double most(std::size_t node) const { return length(way[node]) + spread[node]; }
  };
  void makeCandidates(std::span<const Vec3> x, Workers& workers);
  void measureEdges(std::span<const Vec3> x);
  void measureNormals(std::span<const Vec3> x);
  void measureMotion(std::span<const Vec3> to, std::span<const Vec3> from, Motion& motion, Workers& workers) const;
  double sheetsApart(NodeIndex a, NodeIndex b) const;
  // Calls `use` with each candidate of two nodes of the list, without its gap. `reach`: what is surely farther apart
  // where the list was made may be left out, metres.
  template <class Use>
  void eachOf(NodeIndex a, NodeIndex b, double reach, const Use& use) const;
  template <class Use>
  void nodeFaces(NodeIndex a, NodeIndex b, double reach, const Use& use) const;
  template <class Use>
  void edgeEdges(NodeIndex a, NodeIndex b, double reach, const Use& use) const;
  // The bounds of opposite sides, before the list is made at x.
  void measureSides(std::span<const Vec3> x, Workers& workers);
  void measure(const Candidate& candidate, const Search& search, std::vector<ContactPair>& out) const;
  bool squeezed(const Candidate& candidate, std::span<const Vec3> x) const;
  bool nearOnPaper(const ContactPair& pair) const;

  const ClothTopology& topology_;
  ProximityList list_;
  double radius_, spacing_;
  std::vector<std::uint8_t> leftOut_;
  // Where the list was made: the longest edge at each node and of all, metres; the unit normal of the faces at a node.
  std::vector<double> longestEdge_;
  double longest_ = 0;
  std::vector<Vec3> normal_;
  // Of each pair of the list: the candidates nearer than candidateReach_, those of pair n from start_[n] to before the
  // next, and a bound below which no gap of any was, metres.
  double candidateReach_;
  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> start_;
  std::vector<double> clear_;
  std::vector<double> sidesClear_;  // of each node's opposite sides: a bound below which no gap was, metres
  Motion drift_, ahead_;            // since the list was made; of the search
  std::vector<double> bound_;       // of both, at each node, metres
  std::size_t worn_ = 0;  // how many pairs were looked at that had drifted farther than their candidates serve
};

}  // namespace karinui

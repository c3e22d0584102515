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
  ContactPairs(const ClothTopology& topology, const SewnGroups& sewn, double radius, double spacing)
      : topology_(topology), list_(topology, sewn, spacing), radius_(radius), spacing_(spacing) {}

  // Two nodes that are both marked here do not make a pair. Empty: none is left out.
  void leaveOut(std::vector<std::uint8_t> marked) { leftOut_ = std::move(marked); }

  // Two pieces of one layer do not meet each other; they do at first.
  void onlyLayers(bool only) { list_.onlyLayers(only); }

  // The pairs with a gap below `within` at x; given moves, also those that may come so near during them. Call
  // measureEdges for x first.
  struct Search {
    std::span<const Vec3> x, move;  // `move` may be empty
    double within = 0;              // metres
  };
  std::vector<ContactPair> find(const Search& search, Workers& workers);
  // The same for a search that differs from the last one only in the moves of the nodes that are marked.
  std::vector<ContactPair> findAgain(const Search& search, const std::vector<std::uint8_t>& moved, Workers& workers);
  void measureEdges(std::span<const Vec3> x);

 private:
  std::vector<ContactPair> search(const Search& search, const std::vector<std::uint8_t>& stale, Workers& workers);
  void nodeFaces(NodeIndex a, NodeIndex b, const Search& search, std::vector<ContactPair>& out) const;
  struct FacingEdge {  // at a node
    NodeIndex end = 0;
    Vec3 place;  // of its far end
    bool squeezed = false;
  };
  void facingEdges(NodeIndex own, NodeIndex other, const Search& search, std::vector<FacingEdge>& out) const;
  void edgeEdges(NodeIndex a, NodeIndex b, const Search& search, std::vector<ContactPair>& out) const;
  void measureSheets(const Search& search);
  bool sheetsApart(NodeIndex a, NodeIndex b, const Search& search) const;
  bool takes(NodeIndex a, NodeIndex b, bool& squeezed) const;
  bool nearOnPaper(const ContactPair& pair) const;
  bool keeps(const ContactPair& pair, const Search& search, bool squeezed) const;

  const ClothTopology& topology_;
  ProximityList list_;
  double radius_, spacing_;
  std::vector<std::uint8_t> leftOut_;
  std::vector<double> longestEdge_;  // at each node, metres
  double longest_ = 0;               // of all
  // Of the faces at each node: the unit normal of their sum, and by how much a corner's move differs from the node's at
  // most, metres.
  std::vector<Vec3> normal_;
  std::vector<double> spread_;
  // What the last search with moves found at each pair of nodes of the list: from `start_[n]` to before the next.
  std::vector<ContactPair> last_;
  std::vector<std::uint32_t> start_;
  std::vector<std::uint8_t> asked_;  // whether it was searched
};

}  // namespace karinui

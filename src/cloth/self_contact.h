#pragma once
// Cloth against cloth: node-against-face and edge-against-edge pairs nearer than a radius push apart along their
// nearest direction. Friction holds each pair by a spring between the two places where it stuck, slipping where the
// pull exceeds friction (return mapping), as on the body. A guard cuts the part of a move by which a pair would pass
// through. Neighbours on an edge and seam partners do not collide with each other. Frozen pieces stand in the way
// like any cloth.
//
// The guard keeps apart what is apart; it does not untangle what stands crossed at the start.
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "cloth/block_system.h"

namespace karinui {

class SelfContact {
 public:
  // `radius`: how near cloth comes to cloth before it pushes, metres; 0: cloth does not meet cloth.
  SelfContact(const Cloth& cloth, double radius);
  void setTies(const TieMap& ties);
  // Nodes marked here do not meet each other: they stand crossed. Empty: none.
  void leaveOut(std::vector<std::uint8_t> marked) { leftOut_ = std::move(marked); }
  void meet(bool on) { on_ = on; }  // whether cloth meets cloth at all; it does at first
  bool meets() const { return on_ && radius_ > 0; }

  // `sliding`: as BodyContact::find.
  void find(std::span<const Vec3> x, Workers& workers, bool sliding = false);
  void addGradient(std::span<Vec3> gradient) const;
  // As BodyContact's: what slips is expected to slip again.
  void addExpectedSlip(std::span<Vec3> force) const;
  void moveAnchors(std::span<const Vec3> x);  // after a step; once
  void forgetAnchors() { stuck_.clear(); }
  void addCouplings(const TieMap& ties, std::vector<Coupling>& couplings) const;
  // Shortens the moves of nodes where something would pass through; true when something was cut.
  bool guard(std::span<const Vec3> x, std::vector<Vec3>& move, Workers& workers);
  std::size_t pairs() const { return found_.size(); }

 private:
  struct Anchor {
    std::array<double, 4> weight{};  // of the places that stuck to each other,
    Vec3 offset;                     // which lay so far apart then, along the cloth
    double slip = 0;                 // metres, in the last step
    double push = 0;                 // newtons, of late: lying cloth trembles by micrometres, and so does each push
  };
  struct Stuck {
    std::array<NodeIndex, 4> node{};
    Anchor anchor;
  };
  struct Pair {
    std::array<NodeIndex, 4> node{};
    std::array<double, 4> weight{};  // of the two nearest places: first side positive, second negative
    int first = 1;                   // how many nodes are of the first side
    Vec3 normal;                     // from the second side to the first
    double gap = 0;
    double push = 0, across = 0;  // N, N/m
  };
  struct Hold {  // of a pair that was found
    Anchor anchor;
    Vec3 force, ahead;  // N: friction, and the part of it that expected slip does not load
  };
  struct Grid;
  struct Ask {
    std::span<const Vec3> x, move;  // move empty: none
    double within = 0;              // metres
    double longest = 0;             // edge
  };
  std::vector<Pair> collect(const Ask& ask, Workers& workers);
  void lookAround(std::span<const Vec3> x, double reach, Workers& workers);
  void nodeFaces(NodeIndex a, NodeIndex b, const Ask& ask, std::vector<Pair>& out) const;
  void edgeEdges(NodeIndex a, NodeIndex b, const Ask& ask, std::vector<Pair>& out) const;
  bool neighbours(NodeIndex a, NodeIndex b) const;
  bool asks(NodeIndex a, NodeIndex b, bool& squeezed) const;
  bool nearOnPaper(const Pair& pair) const;
  double folded(NodeIndex a, NodeIndex b, std::span<const Vec3> x) const;
  bool guardOnce(const Ask& ask, std::vector<Vec3>& move, Workers& workers);  // ask.move: the same
  double measureEdges(std::span<const Vec3> x);                               // the longest; of each node in longest_
  static Vec3 pullOf(const Pair& pair, const Anchor& anchor,
                     std::span<const Vec3> x);  // how far its places have been drawn apart
  Hold holdOn(Pair& pair, std::span<const Vec3> x) const;
  double frictionOf(const Pair& pair) const { return std::sqrt(friction_[pair.node[0]] * friction_[pair.node[3]]); }

  double radius_, firmness_, spacing_;
  std::vector<std::uint32_t> piece_;  // per node,
  std::vector<Flat> flat_;            // and where it is on paper
  std::vector<double> friction_;      // per node
  std::vector<std::uint8_t> live_;
  std::vector<Triangle> faces_;
  std::vector<std::array<NodeIndex, 2>> edges_;
  std::vector<std::uint32_t> faceStart_, faceItem_, edgeStart_, edgeItem_;  // around each node
  std::vector<std::uint32_t> partner_;                                      // seam partners share a number
  std::vector<std::uint32_t> nearStart_, nearItem_;                         // nodes that do not meet each node
  std::vector<std::uint32_t> overStart_, overItem_;                         // nodes beside each over a seam
  std::vector<std::vector<NodeIndex>> together_;                            // nodes that move as one, where several
  std::vector<std::uint32_t> togetherOf_;
  std::vector<std::uint8_t> held_, leftOut_;
  bool on_ = true;
  std::vector<double> longest_;  // of the edges at each node, metres
  std::vector<Pair> found_;
  std::vector<Hold> hold_;    // one for each of found_
  std::vector<Stuck> stuck_;  // by nodes
  // Nodes, no neighbours, that were nearer than nearReach_ when the cloth stood at nearAt_: good for all who ask for
  // less, less by what has moved since.
  std::vector<std::array<NodeIndex, 2>> near_;
  std::vector<Vec3> nearAt_;
  double nearReach_ = 0;
};

}  // namespace karinui

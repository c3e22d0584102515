#pragma once
// Cloth against the body: a push that grows with how deep a node stands in the skin's offset, and friction that holds
// each touching node by a spring to where it stuck, slipping where the pull exceeds friction (return mapping).
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/block_system.h"
#include "cloth/far_off.h"
#include "karinui/base/workers.h"
#include "karinui/cloth/settle.h"

namespace karinui {

// The body's push on `area` of cloth (m2) that stands `depth` deep in a skin of `offset`: newtons, and N/m by depth.
struct Push {
  double force = 0, slope = 0;
};
Push bodyPush(double area, double depth, double offset);

// Metres in a step: what slipped less is not said to slide.
inline constexpr double kSlides = 4e-6;

class BodyContact {
 public:
  struct Node {
    NodeIndex node = 0;
    double area = 0, friction = 0;
  };
  // `nodes`: those that move. `offset`: how far from the surface the push begins, metres.
  BodyContact(const Collider& body, std::vector<Node> nodes, double offset);

  // Finds who touches at these places. Forces, blocks and anchors speak of what was found last.
  // `sliding`: what slipped last is held by friction's force but by no stiffness, to see whether it goes on.
  void find(std::span<const Vec3> x, bool withFriction, Workers& workers, bool sliding = false);
  void addGradient(std::span<Vec3> gradient) const;
  // What a slipping node is expected to slip again does not load its friction: added to the step's right-hand side, it
  // lets sliding cloth gather way and lets it stop without turning back.
  void addExpectedSlip(std::span<Vec3> force) const;
  void addBlocks(const TieMap& ties, BlockSystem& system) const;
  void moveAnchors(std::span<const Vec3> x, Workers& workers);  // after a step; once
  void forgetAnchors();
  double anchorMove() const { return anchorMove_; }  // largest slip of the last step, metres
  std::size_t touching() const { return touching_; }
  // Where the node touches: its outward normal; zero length where it does not.
  Vec3 normalAt(NodeIndex node) const { return slot_[node] == kNoNode ? Vec3{} : at_[slot_[node]].normal; }

  // The part of a move that does not enter the body: it follows the surface from where it meets it.
  Vec3 limited(Vec3 from, Vec3 move) const;
  void cover(std::size_t nodeCount);

 private:
  struct At {
    bool touches = false, stuck = false;
    Vec3 normal, anchor, force, ahead;
    double push = 0, along = 0, across = 0;  // N, N/m
    double slip = 0;
  };
  const Collider& body_;
  std::vector<Node> nodes_;
  std::vector<At> at_;
  FarOff farOff_;
  std::vector<std::uint32_t> slot_;
  double offset_, anchorMove_ = 0;
  std::size_t touching_ = 0;
};

}  // namespace karinui

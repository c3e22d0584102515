#pragma once
// Where cloth intersects itself, which nodes are concerned, and the directions that shorten the intersection contour,
// the line in which sheets cross. No history tells the right side of a sheet, but the contour can be shortened until it
// is gone (P. Volino and N. Magnenat-Thalmann, "Resolving surface collisions through intersection contour
// minimization", 2006).
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/energy.h"
#include "karinui/cloth/cloth.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

class IntersectionContour {
 public:
  explicit IntersectionContour(const Cloth& cloth);

  // Finds the intersections; faces sewn to each other have none, nor have faces that both hold still.
  void find(std::span<const Vec3> x, Workers& workers);
  std::size_t crossings() const { return crossings_; }  // of an edge with a face
  // Per node: whether it is of a face that intersects another, or beside one.
  const std::vector<std::uint8_t>& near() const { return near_; }
  // Per node: the direction that shortens the contour, of length one at most; zero for nodes that are not concerned.
  const std::vector<Vec3>& direction() const { return direction_; }

 private:
  struct Edge {
    std::array<NodeIndex, 2> node{};
    std::array<std::uint32_t, 2> face{};  // the second kNoNode on a border
  };
  void addShortening(std::span<const Vec3> x, const Edge& edge, std::uint32_t face);

  TriangleMesh mesh_;               // the cloth's faces; its points are those of the last find
  std::vector<std::uint8_t> live_;  // per face
  std::vector<std::array<std::uint32_t, 3>> edgeOf_;
  std::vector<Edge> edges_;
  std::vector<std::uint32_t> group_;  // nodes sewn together carry the same number
  std::vector<std::uint8_t> near_;
  std::vector<Vec3> direction_;
  std::size_t crossings_ = 0;
};

}  // namespace karinui

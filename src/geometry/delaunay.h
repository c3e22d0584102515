#pragma once
// A Delaunay triangulation of points, grown point by point, into which sides can be forced. Places are rounded to a
// grid of 2^-27 of their extent and every decision is exact integer arithmetic, so it never tires and never depends on
// luck. Sloan, "A fast algorithm for generating constrained Delaunay triangulations", 1993.
#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "karinui/geometry/vec.h"

namespace karinui {

class Delaunay {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Face {
    std::array<std::uint32_t, 3> corner{};
    std::array<std::uint32_t, 3> beyond{kNone, kNone, kNone};  // the face across from each corner
  };
  enum class Forced { Made, Crossed, Touched };

  explicit Delaunay(std::span<const Flat> places);

  // The corner that stands for each given place; equal places share one.
  const std::vector<std::uint32_t>& cornerOf() const { return cornerOf_; }
  const std::vector<Face>& faces() const { return faces_; }
  bool real(const Face& face) const;  // no corner of the triangle that once held everything

  // Makes a - b an edge. Crossed: `met` is the forced edge in the way. Touched: met[0] is the corner on the way.
  Forced force(std::uint32_t a, std::uint32_t b, std::array<std::uint32_t, 2>& met);
  bool forced(std::uint32_t a, std::uint32_t b) const { return forced_.contains({std::min(a, b), std::max(a, b)}); }
  void improve();  // all edges that are not forced become Delaunay again

  // The face that has the directed edge a -> b, or kNone.
  std::uint32_t leftOf(std::uint32_t a, std::uint32_t b) const;

 private:
  struct Whole {
    std::int64_t u = 0, v = 0;
    auto operator<=>(const Whole&) const = default;
  };
  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;  // sign; > 0: counter-clockwise
  bool insideCircle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const;
  std::uint32_t locate(std::uint32_t corner) const;
  void insert(std::uint32_t corner);
  void settle(std::vector<std::uint32_t>& open, std::uint32_t apex);
  void flip(std::uint32_t face, int side);
  void replaceBeyond(std::uint32_t face, std::uint32_t before, std::uint32_t now);
  bool wantsFlip(std::uint32_t face, int side) const;

  std::vector<Whole> at_;
  std::vector<std::uint32_t> cornerOf_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> someFace_;  // one face at each corner
  std::set<std::array<std::uint32_t, 2>> forced_;
  std::uint32_t last_ = 0;
};

}  // namespace karinui

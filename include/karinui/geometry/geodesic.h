#pragma once
// Lines drawn straight over a surface: what a thread pulled taut between two places, or a tape laid on the skin, does.
// Metres; everything here is a pure function of the mesh, any number of threads may call it.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

// A line over a mesh. Consecutive places share a face, so each step is a straight segment inside that face; places
// between the ends lie exactly on an edge (one weight is 0) or on a corner (one weight is 1).
struct SurfacePath {
  std::vector<SurfacePoint> places;
  std::vector<Vec3> points;  // where the places are
  double length = 0;
  bool empty() const { return places.empty(); }
};
SurfacePath reversed(SurfacePath path);
// The place at a fraction (by length, 0 … 1) of a path.
SurfacePoint along(const TriangleMesh& mesh, const SurfacePath& path, double fraction);

// Knows who neighbours whom on one mesh. Built once, then any number of lines are drawn with it; the mesh must outlive
// it.
class SurfaceGuide {
 public:
  explicit SurfaceGuide(const TriangleMesh& mesh);
  const TriangleMesh& mesh() const { return *mesh_; }

  // The face across the edge from corner k to corner k+1 of a face, or kNone at a hole's border (or a broken edge).
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t across(std::uint32_t face, int k) const { return across_[face][static_cast<std::size_t>(k)]; }

  // The straight line between two places: the shortest strip of faces is found, unfolded into the plane and the line
  // pulled taut in it; where it bends round a corner whose other side turns less than half a circle the strip is led
  // round that side, until no such corner is left (then it is locally shortest; on a plane it is the straight line).
  // The line from a to b is the line from b to a read backwards, exactly. Refuses places on different parts of a mesh.
  Result<SurfacePath> straight(const SurfacePoint& from, const SurfacePoint& to) const;

  // The line between two places that stays in the plane dot(normal, p) = offset, the shorter way round. The two ends
  // are first brought onto the plane within their faces. Refuses places whose faces the plane does not meet or that no
  // such line joins.
  Result<SurfacePath> section(const SurfacePoint& from, const SurfacePoint& to, Vec3 normal, double offset) const;

 private:
  std::vector<std::uint32_t> strip(const SurfacePoint& from, const SurfacePoint& to) const;
  const TriangleMesh* mesh_;
  std::vector<std::array<std::uint32_t, 3>> across_;
};

}  // namespace karinui

#pragma once
// A piece of a surface cut out along a closed line: from "a line drawn on the body" to a sheet of triangles that can be
// laid flat. Metres. Pure; any thread.
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/geometry/bvh.h"
#include "karinui/geometry/geodesic.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

// A disk of triangles. Its border runs counter-clockwise seen from outside; each border step knows which side of the
// drawn line it belongs to.
struct Patch {
  TriangleMesh mesh;
  std::vector<std::uint32_t> border;  // points in order, closed, without a repeated last one
  std::vector<std::uint32_t> side;    // side[i]: of the step border[i] -> border[i + 1]
  std::vector<std::uint32_t> first;   // first[s]: the index into border where side s begins
  bool turned = false;                // the line was drawn clockwise: the border runs against it
  double area() const;                // square metres
  double borderLength() const;
  double sideLength(std::uint32_t s) const;
};

// Cuts a mesh along a closed line made of sides, each starting where the one before ends, and keeps the part inside:
// the one that holds `inside`, else the smaller one. Faces are split exactly along the line. A side may run back over
// another side in the opposite direction: then the part is slit there (a sleeve cut open along the underarm is one
// line). Refuses: a line that crosses itself (saying where), one that holds nothing, a part that is no disk (there is a
// hole in it), and a bag: a part whose area is far more than its border could ever hold flat, as when a line goes round
// a limb.
Result<Patch> cutPatch(const SurfaceGuide& guide, std::span<const SurfacePath> sides,
                       const std::optional<SurfacePoint>& inside = std::nullopt);

// The same sheet with well-shaped triangles of about `spacing`, its corners and the course of its sides kept. `flat` is
// where its points lie when flattened (any map without folds will do). Each new point's place on the old mesh is kept.
// Refuses a border too small for `spacing` or one that, laid flat, overlaps itself.
struct Remeshed {
  Patch patch;
  std::vector<Flat> flat;
  std::vector<SurfacePoint> from;  // on the old patch's mesh
};
Result<Remeshed> remeshed(const Patch& patch, std::span<const Flat> flat, double spacing);

// Lifts a sheet that lies on a body `ease` off it and smooths it as cloth would lie: hollows are spanned a little, no
// point comes nearer to the body than `ease`.
struct LiftSettings {
  double ease = 0.006;  // metres from the body
  int spanRounds = 40;  // how far hollows are spanned: about sqrt(rounds) triangles wide
  // For a half of a symmetric piece: border points that stay on the plane x = 0; the other half is taken to be there.
  std::vector<std::uint32_t> fold;
};
void liftOff(Patch& patch, const TriangleMesh& body, const Bvh& bvh, const LiftSettings& settings);

}  // namespace karinui

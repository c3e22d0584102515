#pragma once
// From a line on a figure to a flat piece and the shape it has in space. Knows nothing of documents.
#include <memory>
#include <string>
#include <vector>

#include "karinui/geometry/flatten.h"
#include "karinui/geometry/geodesic.h"
#include "karinui/geometry/patch.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// A figure's surface, ready to be drawn on.
struct DrawingGround {
  const TriangleMesh& mesh;
  const Bvh& bvh;
  SurfaceGuide guide;
  DrawingGround(const TriangleMesh& m, const Bvh& b) : mesh(m), bvh(b), guide(m) {}
};

struct DrawnLine {
  std::vector<SurfacePoint> places;
  std::vector<std::string> edges;  // of each place: the edge that begins there; empty: the line curves on
  bool symmetric = false;          // one half, from the plane x = 0 back to it;
  std::optional<double> square;    // led across that plane square to it where it comes less steeply: radians
  std::optional<SurfacePoint> inside;
};

struct DrawnSettings {
  double ease = 0.008;     // metres off the body
  double spacing = 0.010;  // of the sheet's triangles
  FlattenSettings flatten;
};

struct DrawnSheet {
  Outline outline;
  std::shared_ptr<const Form> form;
  Distortion distortion;
  Vec3 worst;               // in space: where the cloth is strained most
  std::string nearestEdge;  // from which a cut would reach it
  double cutLength = 0;     // metres on paper
  Flat worstFlat;           // the same place on paper
  double shrunk = 0;        // there: how much longer paper is than the drawn shape, < 0 shorter
  double fitMiss = 0;       // how far the outline passes from the drawn line
};

// The line through all places of a run, as a side: straight over the surface between two, else a smooth curve through
// all.
Result<SurfacePath> drawnSide(const DrawingGround& ground, std::span<const SurfacePoint> run);
Result<DrawnSheet> drawnSheet(const DrawingGround& ground, const DrawnLine& line, const DrawnSettings& settings,
                              const Token& token);

}  // namespace karinui

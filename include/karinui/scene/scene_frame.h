#pragma once
// A picture's worth of plain data: what session and command line hand to the renderer. Owns everything; no ids of the
// document, no pointers; any thread may read. Metres, y up; colours linear RGB in [0, 1].
#include <array>
#include <string>
#include <vector>

#include "karinui/geometry/bvh.h"
#include "karinui/geometry/mesh.h"
#include "karinui/scene/cloth_look.h"

namespace karinui {

// A place on a cloth's mesh: it goes where the mesh goes.
struct ClothPlace {
  Triangle corners{};
  std::array<double, 3> weight{};
  Vec3 on(const std::vector<Vec3>& points) const {
    return points[corners[0]] * weight[0] + points[corners[1]] * weight[1] + points[corners[2]] * weight[2];
  }
};

struct SceneStitches {  // a row that is to be seen
  std::vector<ClothPlace> line;
  Colour colour{};
  float stitchMm = 3, gapMm = 0.6f, widthMm = 0.7f;
};

// A cord along an edge, or a strip folded over it.
struct SceneTrim {
  enum class Kind { Cord, Strip };
  Kind kind = Kind::Strip;
  std::vector<ClothPlace> edge, inside;  // pairs: on the edge and within; of a cord `inside` tells which way cloth lies
  bool raised = false;                   // a cord in a seam: on the cloth, not beside it
  double thickness = 0;                  // metres: of the cord; of the strip's cloth
  Colour colour{};
  std::string fabric;  // of which it is
};
// As it lies on a cloth that stands so. A cord is a round tube; a strip lies on both sides and round the edge.
TriangleMesh meshOf(const SceneTrim& trim, const TriangleMesh& cloth);

struct SceneCloth {
  std::string name;
  TriangleMesh mesh;
  std::vector<Flat> flat;                            // paper place of each point (weave, UV)
  std::vector<float> strain;                         // per point, |l/L - 1|; may be empty
  std::vector<std::vector<std::uint32_t>> outlines;  // closed or open runs of points drawn as the cloth's edge
  std::vector<std::vector<std::uint32_t>> seams;     // runs of points drawn as stitches
  std::vector<SceneStitches> stitches = {};
  std::vector<SceneTrim> trims = {};
  Colour colour{0.35f, 0.45f, 0.65f};
  ClothLook look = {};
  bool live = false;  // marked
};

struct SceneBody {
  TriangleMesh mesh;  // closed, facing outward: its inside is not drawn
  Colour colour{0.78f, 0.66f, 0.58f};
};

struct SceneLine {  // a stroke, a force arrow, a tape
  std::vector<Vec3> points;
  Colour colour{0.8f, 0.1f, 0.1f};
  float widthMm = 2;
  bool arrow = false;
};

struct SceneFrame {
  std::vector<SceneBody> bodies;
  std::vector<SceneCloth> cloths;
  std::vector<SceneLine> lines;
  std::vector<std::string> captions;  // drawn top left, UTF-8
};

// A place further than this from the origin, or not a number, is a fault in the data: it is left out of every picture
// rather than shrinking the fitting to a dot.
inline constexpr double kStudioReach = 1000;  // metres
bool drawable(Vec3 place);

// The box of everything that can be drawn; empty when nothing can.
Box extent(const SceneFrame& frame);

}  // namespace karinui

#include "karinui/session/touch_scene_of.h"

#include "karinui/cloth/fabric.h"

namespace karinui {

namespace {

constexpr double kGripWidth = 0.02;   // metres of cloth between two fingers,
constexpr double kGripLength = 0.10;  // and from there to what holds it
constexpr double kSpacing = 0.01;     // metres between the nodes of Eq. (1)
constexpr double kStrainMost = 0.4;
constexpr double kCutResistance = 800;  // N for a metre of thickness: 0.4 N for cotton

void addNear(TouchScene& scene, const Bvh& tree, const TriangleMesh& mesh, bool twoSided) {
  const Vec3 reach{scene.radius, scene.radius, scene.radius};
  Box box;
  box.include(scene.centre - reach);
  box.include(scene.centre + reach);
  tree.touching(box, [&](std::uint32_t face) {
    const Triangle& f = mesh.faces[face];
    if (const auto facet = facetOf(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]], twoSided))
      if (distance(facet->middle, scene.centre) <= scene.radius + facet->radius) scene.facets.push_back(*facet);
  });
}

Grab grabOf(const Piece& piece, const Fabric& fabric, const Handling::Pull& pull) {
  Grab grab;
  const Stand stand(piece);
  grab.anchor = pull.from;
  const Vec3 beside = pull.from - stand(pull.at);  // fingers hold a little beside the cloth's middle
  grab.curve = tensionCurveOf(fabric, kGripWidth, kGripLength);
  // The neighbours of the historical simcloth: eight around, and four one further along warp and weft.
  grab.springStiffness = fabric.stretchWarp;
  for (const auto& [u, v] : {std::pair(1, 0),
                             {-1, 0},
                             {0, 1},
                             {0, -1},
                             {1, 1},
                             {1, -1},
                             {-1, 1},
                             {-1, -1},
                             {2, 0},
                             {-2, 0},
                             {0, 2},
                             {0, -2}}) {
    const Flat step{u * kSpacing, v * kSpacing};
    grab.neighbours.push_back({stand(pull.at + step) + beside, length(step)});
  }
  grab.place = pull.place;
  if (pull.force) {
    grab.force = *pull.force;
    const double stiff = fabric.warpCurve().tangent(fabric.toeWarp) * kGripWidth / kGripLength;
    grab.stiffness = {stiff, 0, 0, stiff, 0, stiff};
  }
  return grab;
}

}  // namespace

TensionCurve tensionCurveOf(const Fabric& fabric, double width, double length) {
  constexpr int kPlaces = 64;
  TensionCurve curve;
  const ThreadCurve warp = fabric.warpCurve(), weft = fabric.weftCurve();
  for (int k = 0; k <= kPlaces; ++k) {
    const double share = static_cast<double>(k) / kPlaces,
                 strain = kStrainMost * share * share * share;  // the toe is short
    curve.places.push_back({strain * length, width * (warp.force(strain) + weft.force(strain)) / 2});
  }
  return curve;
}

TouchScene touchSceneOf(const GarmentSnapshot& snapshot, Vec3 tip, const Handling& handling, double radius) {
  TouchScene scene;
  scene.centre = tip;
  scene.radius = radius;
  scene.changing = handling.changing;
  scene.clicks = handling.clicks;
  if (snapshot.body) addNear(scene, snapshot.body->bvh(), snapshot.body->mesh(), false);
  double friction = 0;
  for (std::size_t k = 0; k < snapshot.worn.size(); ++k) {
    const PieceId id = snapshot.worn[k].id;
    const Piece* piece = snapshot.document.find(id);
    const auto fabric = piece ? fabricOf(snapshot.document, *piece) : Result<Fabric>(cancelled());
    if (!fabric) continue;
    if (handling.carried.contains(id)) {
      scene.carriedMass += piece->outline.area() * fabric->weight;
      continue;
    }
    if (handling.pull && handling.pull->piece == id) {
      scene.grab = grabOf(*piece, *fabric, *handling.pull);
      continue;  // what is held is not touched
    }
    if (handling.cut == id) scene.cutting = kCutResistance * fabric->thickness;
    const std::size_t before = scene.facets.size();
    const TriangleMesh& mesh = snapshot.frame.cloths[k].mesh;
    if (!mesh.faces.empty()) addNear(scene, **snapshot.worn[k].tree, mesh, true);
    if (scene.facets.size() > before) friction = std::max(friction, fabric->frictionBody);
  }
  if (friction > 0) scene.friction = friction;
  return scene;
}

}  // namespace karinui

#include "karinui/session/touch_scene_of.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "karinui/cloth/fabric.h"

namespace karinui {

namespace {

constexpr double kGripWidth = 0.02;   // metres of cloth between two fingers,
constexpr double kGripLength = 0.10;  // and from there to what holds it
constexpr double kSpacing = 0.01;     // metres between the nodes of Eq. (1)
constexpr double kStrainMost = 0.4;
constexpr double kCutResistance = 800;  // N for a metre of thickness: 0.4 N for cotton
constexpr double kWeaveReach = 0.02;    // metres from the tip: further cloth has no texture yet
constexpr double kWeaveDepth = 0.1;     // of the contact force

// Around the tip, and where it was stopped: a tip pressed deep into the body is farther from the skin than it reaches.
void addNear(TouchScene& scene, std::optional<Vec3> proxy, const Bvh& tree, const TriangleMesh& mesh, bool twoSided) {
  const Vec3 reach{scene.radius, scene.radius, scene.radius};
  std::set<std::uint32_t> taken;
  const auto around = [&](Vec3 centre) {
    Box box;
    box.include(centre - reach);
    box.include(centre + reach);
    tree.touching(box, [&](std::uint32_t face) {
      const Triangle& f = mesh.faces[face];
      if (const auto facet = facetOf(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]], twoSided))
        if (distance(facet->middle, centre) <= scene.radius + facet->radius && taken.insert(face).second)
          scene.facets.push_back(*facet);
    });
  };
  around(scene.centre);
  if (proxy) around(*proxy);
}

bool reaches(const TriangleMesh& mesh, Vec3 centre, double radius) {
  const Box box = boxOf(mesh.points);
  if (box.empty()) return false;
  const Vec3 inside{std::clamp(centre.x, box.low.x, box.high.x), std::clamp(centre.y, box.low.y, box.high.y),
                    std::clamp(centre.z, box.low.z, box.high.z)};
  return distance(inside, centre) <= radius;
}

// Whether what stops the tip lies on skin through which the tip is pressed.
bool pressedIn(const Body* body, Vec3 tip, std::optional<Vec3> proxy) {
  if (!body || !proxy) return false;
  const double deep = distance(*proxy, tip);
  if (!(deep > 0)) return false;
  const auto skin = body->bvh().first(*proxy, (tip - *proxy) * (1 / deep));
  return skin && skin->along < deep;
}

// The threads of the cloth nearest to the tip, by the triangle there: how the paper's directions lie in space.
void addWeave(TouchScene& scene, const Bvh& tree, const SceneCloth& cloth, const Piece& piece, const Fabric& fabric,
              double& nearest) {
  const auto there = tree.nearest(scene.centre, nearest);
  if (!there || there->distance >= nearest || cloth.flat.size() != cloth.mesh.points.size()) return;
  const Triangle& f = cloth.mesh.faces[there->place.face];
  const Flat at = cloth.flat[f[0]], e = cloth.flat[f[1]] - at, g = cloth.flat[f[2]] - at;
  const double det = cross(e, g);
  if (det == 0) return;
  const Vec3 p = cloth.mesh.points[f[0]], s = cloth.mesh.points[f[1]] - p, t = cloth.mesh.points[f[2]] - p;
  const Vec3 alongU = (s * g.v - t * e.v) * (1 / det), alongV = (t * e.u - s * g.u) * (1 / det);
  const Flat warp = piece.grain, weft{warp.v, -warp.u};
  Weave& weave = scene.weave.emplace();
  weave.warp = normalized(alongU * warp.u + alongV * warp.v);
  weave.weft = normalized(alongU * weft.u + alongV * weft.v);
  weave.period = threadSpacing(fabric);
  weave.depth = kWeaveDepth;
  weave.origin = p;
  weave.u = dot(at, warp), weave.v = dot(at, weft);
  nearest = there->distance;
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

double threadSpacing(const Fabric& fabric) {
  constexpr double kThreadDensity = 909;  // kg/m3: 1.1 cm3/g
  constexpr double kFinest = 2e-4, kCoarsest = 3e-3;
  const double thick = fabric.thickness / 2, titre = kThreadDensity * std::numbers::pi / 4 * thick * thick;  // kg/m
  return fabric.weight > 0 ? std::clamp(2 * titre / fabric.weight, kFinest, kCoarsest) : kFinest;
}

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

TouchScene touchSceneOf(const GarmentSnapshot& snapshot, Vec3 tip, const Handling& handling, std::optional<Vec3> proxy,
                        double radius) {
  TouchScene scene;
  scene.centre = tip;
  scene.radius = radius;
  scene.changing = handling.changing;
  scene.clicks = handling.clicks;
  if (handling.still) return scene;
  if (snapshot.body) addNear(scene, proxy, snapshot.body->bvh(), snapshot.body->mesh(), false);
  // Cloth on skin stops the tip however deep that is pressed; cloth that hangs free lets a hand go that is led away.
  const std::optional<Vec3> stopped = pressedIn(snapshot.body.get(), tip, proxy) ? proxy : std::nullopt;
  double friction = 0, nearest = kWeaveReach;
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
    const SceneCloth& cloth = snapshot.frame.cloths[k];
    if (cloth.mesh.faces.empty() ||
        !(reaches(cloth.mesh, tip, radius) || (stopped && reaches(cloth.mesh, *stopped, radius))))
      continue;  // its tree is not built for that
    addNear(scene, stopped, **snapshot.worn[k].tree, cloth.mesh, true);
    addWeave(scene, **snapshot.worn[k].tree, cloth, *piece, *fabric, nearest);
    if (scene.facets.size() > before) friction = std::max(friction, fabric->frictionBody);
  }
  if (friction > 0) scene.friction = friction;
  return scene;
}

}  // namespace karinui

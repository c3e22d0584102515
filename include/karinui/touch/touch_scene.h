#pragma once
// What the hand can feel near its tip: an intermediate representation of the scene (Adachi, Kumano and Ogino 1995) that
// the servo evaluates a thousand times a second without ever seeing a document. Made outside the servo, then immutable;
// any thread may read it. Metres, newtons, kilograms, seconds; y up.
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "karinui/geometry/vec.h"

namespace karinui {

// A triangle of the contact patch. The skin is felt from outside only (counter-clockwise, as a mesh has it), rigid
// cloth from both sides.
struct Facet {
  std::array<Vec3, 3> corner;
  Vec3 normal;        // unit
  Vec3 middle;        // of a sphere around the triangle
  double radius = 0;  // of that sphere
  bool twoSided = false;
};
// Nothing for a triangle without area.
std::optional<Facet> facetOf(Vec3 a, Vec3 b, Vec3 c, bool twoSided);

// How a thread or a strip of cloth pulls over its extension, as places of a curve that begins at (0, 0) and rises
// towards both: metres and newtons. Beyond the last place it goes on as between the last two.
struct TensionCurve {
  struct Place {
    double extension = 0, force = 0;
  };
  std::vector<Place> places;
};

struct Stiffness {  // 3x3, symmetric and positive: rows xx xy xz yy yz zz, N/m
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  Vec3 operator*(Vec3 v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }
  double size() const;  // Frobenius norm: no eigenvalue is larger
};

// The place of the cloth that the hand holds, in the three ways it may be felt (see PullLaw).
struct Grab {
  struct Neighbour {
    Vec3 place;          // x_k
    double natural = 0;  // L, the natural length to it
  };
  std::vector<Neighbour> neighbours;  // Springs
  double springStiffness = 0;         // Springs: K of Eq. (1), N/m
  Vec3 anchor;                        // Curve: from where the cloth is pulled
  double natural = 0;                 // Curve: the length at which it begins to pull
  TensionCurve curve;                 // Curve
  Vec3 place;                         // Tangent: x0, where the solver last had the held place,
  Vec3 force;                         // f0, what the cloth then did to the hand,
  Stiffness stiffness;                // and how that changes: f = f0 - K (x - x0)
};

struct Weave {          // of the cloth that is touched, as a texture
  Vec3 warp, weft;      // unit, along the threads
  double period = 0;    // metres from thread to thread
  double depth = 0;     // share of the contact force, at most kMostDepth
  Vec3 origin = {};     // a place of the cloth,
  double u = 0, v = 0;  // and where it is along warp and weft: threads stay where they are from scene to scene
  static constexpr double kMostDepth = 0.15;
};

struct TouchScene {
  std::uint64_t version = 0;
  double published = 0;  // seconds of the servo's clock
  // Contact: the patch holds whatever is within `radius` of `centre`.
  std::vector<Facet> facets;
  Vec3 centre;
  double radius = 0;
  double stiffness = 400;  // N/m
  double damping = 1;      // N s/m, across the surface
  double friction = 0.3;   // Coulomb
  std::optional<Weave> weave;
  // What the hand carries, kg.
  double carriedMass = 0;
  std::optional<Grab> grab;
  double cutting = 0;        // N against the motion of scissors in cloth
  std::uint32_t clicks = 0;  // pairs of edges that have snapped together so far: each more is felt once
  bool changing = false;     // pieces are being cut or sewn: nothing but the weight is felt meanwhile
};

}  // namespace karinui

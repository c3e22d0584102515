#pragma once
// A stroke over the body as a hand draws it: rays, and where they met the skin. Seen along the skin a pixel is many
// pixels of depth, and beside the silhouette the ray misses; such samples are certain across the view only. Metres;
// pure functions.
#include <optional>
#include <span>
#include <vector>

#include "karinui/session/garment_snapshot.h"

namespace karinui {

struct StrokeSample {
  Ray ray;
  Vec3 facing{0, 0, 1};  // towards who looks
  double reach = 0.01;   // radians: how near is touching
  SurfacePoint skin;
  Vec3 point;            // on the skin: met by the ray, or beside it
  double along = 0;      // metres along the ray
  bool met = true;       // the ray met the skin there
  bool certain = true;   // in depth too
  bool touched = false;  // by a tip, which knows its depth: the ray is the skin's normal

  double touching() const { return reach * along; }  // metres at that depth
};

// Where a pointer's ray comes to on the skin, `before` being where the stroke was last: also what it just misses at the
// silhouette, and the trunk's rim rather than an arm far behind it. Nothing: well beside the body.
std::optional<StrokeSample> strokeSample(const GarmentSnapshot& snapshot, const PointerSample& sample,
                                         const std::optional<Vec3>& before);

// How far a place is from a ray.
double awayFromRay(const Ray& ray, Vec3 place);

// The stroke as the eye saw it: places in the plane across the view at the stroke's mean depth, or where a tip was.
std::vector<Vec3> pictureOf(std::span<const StrokeSample> stroke);

// A fair line over the skin through the first and the last sample: wiggles shorter than cloth follows (a few
// centimetres) are taken out, the drawn rays kept within the hand's tolerance, depth left to the smoothest course.
// `fixed` holds a place for every sample that must stay there.
std::vector<Vec3> faired(const Body& body, std::span<const StrokeSample> run,
                         std::span<const std::optional<Vec3>> fixed);

}  // namespace karinui

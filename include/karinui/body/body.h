#pragma once
// The figure one sews for: a closed surface with landmarks and, if it is a mannequin of ours, a template by which a place
// on it is found again on any other mannequin. Immutable and shared once built; any thread may read. Metres, y up,
// feet on y = 0, facing +z, +x is the body's left.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/body/measurements.h"
#include "karinui/geometry/bvh.h"
#include "karinui/geometry/distance_field.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

// A place on a body that survives a change of body.
//   Chart form:  part of the body + how far along it + around it. `along` counts named levels (see chartLevels): 2.5 is
//                half-way between level 2 and level 3. `around` in turns [0,1): 0 front, 0.25 the body's left.
//                Text: "torso:3.5@0.125", also with a level's name: "torso:waist@0.25", "torso:waist+0.4@0.25".
//   Landmark:    "landmark:shoulder_left".
//   Face form:   only for a body without a template: "face:123@0.2,0.3" (weights of the first two corners).
struct BodyPoint {
  enum class Part { Torso, LeftArm, RightArm, LeftLeg, RightLeg, Landmark, Face };
  Part part = Part::Torso;
  double along = 0, around = 0;
  std::string landmark;   // Part::Landmark
  SurfacePoint onFace;    // Part::Face
};
std::string text(const BodyPoint& point);
Result<BodyPoint> parseBodyPoint(std::string_view text);

class Body {
 public:
  // Takes a closed mesh as it is. `workers` builds the distance field once.
  struct Parts {
    std::string name;
    TriangleMesh mesh;
    Measurements measured;                 // may be empty
    std::map<std::string, Vec3> landmarks; // may be empty
    struct Template;                       // the mannequin's chart; private to body/
    std::shared_ptr<const Template> chart; // may be null
  };
  static Result<std::shared_ptr<const Body>> make(Parts parts, Workers& workers, const Token& token);

  const std::string& name() const { return parts_.name; }
  const TriangleMesh& mesh() const { return parts_.mesh; }
  const Bvh& bvh() const { return bvh_; }
  const DistanceField& field() const { return field_; }
  const Measurements& measured() const { return parts_.measured; }
  const std::map<std::string, Vec3>& landmarks() const { return parts_.landmarks; }
  const std::string& hash() const { return hash_; }  // of mesh and landmarks

  Result<SurfacePoint> find(const BodyPoint& point) const;
  BodyPoint describe(const SurfacePoint& place) const;         // chart form where there is a template
  Result<BodyPoint> mirrored(const BodyPoint& point) const;    // the same place on the other side (x -> -x)

  Body(Parts parts, Bvh bvh, DistanceField field, std::string hash);

 private:
  Parts parts_;
  Bvh bvh_;
  DistanceField field_;
  std::string hash_;
};
using BodyPtr = std::shared_ptr<const Body>;

// Our own mannequin. Every stated girth is met within 3 mm and every height or length within 5 mm on the finished mesh;
// what is not stated follows from what is. Refuses measurements no body can have, saying which.
Result<BodyPtr> makeMannequin(const Measurements& wanted, Workers& workers, const Token& token);

// Measures any standing A-pose body: height, girths as a tight tape (hull of a plane section), limbs, lengths. Keys as in
// measurements.h. What cannot be found on this body is left out.
Measurements measure(const TriangleMesh& mesh, const Bvh& bvh);

}  // namespace karinui

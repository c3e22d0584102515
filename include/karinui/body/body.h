#pragma once
// The figure one sews for: a closed surface with landmarks and, if it is a mannequin of ours, a template by which a
// place on it is found again on any other mannequin. Immutable and shared once built; any thread may read. Metres, y
// up, feet on y = 0, facing +z, +x is the body's left.
//
// What is exact and what is estimated. The chart's levels – crotch, waist, under bust, bust, armpit, knee, ankle – are
// those that measure() finds on the mesh (good to millimetres on any body); the joints of the arm are good to about
// half a centimetre, neck and shoulder levels to about two centimetres on strangers' bodies and exact on a mannequin of
// ours. So the same BodyPoint lies at the anatomically same place on every figure: the same level, the same direction
// from the middle. Landmarks lie on the skin; they are estimated from sections on every body.
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/body/measurements.h"
#include "karinui/body/pose.h"
#include "karinui/geometry/bvh.h"
#include "karinui/geometry/distance_field.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

// A place on a body that survives a change of body.
//   Chart form:  part of the body + how far along it + around it. `along` counts named levels (see chartLevels): 2.5 is
//                half-way between level 2 and level 3. `around` in turns [0,1): 0 front, 0.25 the body's left.
//                Text: "torso:3.5@0.125", also with a level's name: "torso:waist@0.25", "torso:waist+0.4@0.25".
//   Landmark:    "landmark:shoulder_left".
//   Line form:   a share of the length of one of the body's lines (lines.h): "line:side_left@0.4".
//   Face form:   only for a body without a template: "face:123@0.2,0.3" (weights of the first two corners).
struct BodyPoint {
  enum class Part { Torso, LeftArm, RightArm, LeftLeg, RightLeg, Landmark, Face, Line };
  Part part = Part::Torso;
  double along = 0, around = 0;  // Part::Line: along is the share of its length, 0 ... 1
  std::string landmark;          // Part::Landmark, Part::Line: its name
  SurfacePoint onFace;           // Part::Face
};
std::string text(const BodyPoint& point);
Result<BodyPoint> parseBodyPoint(std::string_view text);  // the exact inverse of text()
// The names of a part's levels, 0 first: torso from crotch to crown, arms from shoulder to fingertip, legs from crotch
// to sole. Empty for Landmark, Face and Line.
std::span<const std::string_view> chartLevels(BodyPoint::Part part);

struct BodyLine;  // lines.h

class Body {
 public:
  // Takes a closed mesh as it is; refuses one that is open or no surface at all.
  struct Parts {
    std::string name;
    TriangleMesh mesh;
    Measurements measured;                  // measured on the mesh when empty
    std::map<std::string, Vec3> landmarks;  // estimated when empty; put onto the skin
    struct Template;                        // the mannequin's chart; private to body/
    std::shared_ptr<const Template> chart;  // estimated when null, where the body can be read
    // Of a figure that stands in a pose: the same one in its own pose, whose faces it has. Then chart, measures and
    // lines are that one's, and a place on the skin is named and found on it.
    std::shared_ptr<const Body> own;
    BodyPose pose;
  };
  static Result<std::shared_ptr<const Body>> make(Parts parts);

  const std::string& name() const { return parts_.name; }
  const TriangleMesh& mesh() const { return parts_.mesh; }
  const Bvh& bvh() const { return bvh_; }
  // How far a place is from the skin: found where it is first asked for (distance_field.h). prepareField() finds it
  // everywhere at once, which takes seconds; an error only when cancelled. The same bits either way.
  const DistanceField& field() const;
  Done prepareField(Workers& workers, const Token& token) const;
  const Measurements& measured() const { return parts_.measured; }
  const std::map<std::string, Vec3>& landmarks() const { return parts_.landmarks; }
  const std::string& hash() const { return hash_; }     // of mesh and landmarks
  const BodyPose& pose() const { return parts_.pose; }  // empty: its own
  const Body& own() const { return parts_.own ? *parts_.own : *this; }
  const std::shared_ptr<const Body>& ownKept() const { return parts_.own; }  // null: it stands in its own pose
  // The lines a tailor works by, found on first need (a tenth of a second); those that cannot be found on this body are
  // left out. Any thread.
  const std::vector<BodyLine>& lines() const;

  // A place of the chart is where the ray from the middle of its part first leaves the body. Refused where there is no
  // skin (the inner side of the shoulder runs into the trunk).
  Result<SurfacePoint> find(const BodyPoint& point) const;
  // The inverse of find: chart form wherever find comes back to within 0.1 mm, else face form (between fingers and
  // toes, in folds that no ray from the middle reaches first).
  BodyPoint describe(const SurfacePoint& place) const;
  Result<BodyPoint> mirrored(const BodyPoint& point) const;  // the same place on the other side (x -> -x)

  // The chart as plain numbers, for keeping a figure; empty: no chart. And back; null: these numbers are no chart.
  std::vector<double> chartNumbers() const;
  static std::shared_ptr<const Parts::Template> chartFrom(std::span<const double> numbers);

  Body(Parts parts, Bvh bvh, std::string hash);
  ~Body();

 private:
  Parts parts_;
  Bvh bvh_;
  std::string hash_;
  mutable std::mutex making_;
  mutable std::unique_ptr<const DistanceField> made_;
  mutable std::atomic<const DistanceField*> field_ = nullptr;
  mutable std::once_flag drawing_;
  mutable std::unique_ptr<const std::vector<BodyLine>> lines_;
};
using BodyPtr = std::shared_ptr<const Body>;

// What a mannequin of ours ends in above the neck and beyond wrists and ankles. What lies between is the same for all,
// point for point.
enum class MannequinEnds {
  Modelled,   // a head, hands and feet of their own
  DressForm,  // caps at neck and armholes, closed at the thigh, on a stand; only what is left has landmarks
  Drawn       // as its sections draw them: the figures of documents made before there were others
};

// Our own mannequin. Every stated girth is met within 3 mm and every height or length within 5 mm on the finished mesh;
// what is not stated follows from what is. Refuses measurements no body can have, saying which.
Result<BodyPtr> makeMannequin(const Measurements& wanted, Workers& workers, const Token& token,
                              MannequinEnds ends = MannequinEnds::Modelled);

// Measures any standing A-pose body: height, girths as a tight tape (hull of a plane section), limbs, lengths. Keys as
// in measurements.h. What cannot be found on this body is left out.
Measurements measure(const TriangleMesh& mesh, const Bvh& bvh);

}  // namespace karinui

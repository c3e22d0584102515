#pragma once
// What of a fitting is not drawn: arms, hands, head, and what lies before a plane that cuts all open. Part of a view,
// never of the document. Plain values; any thread. Metres, y up, facing +z, +x is the body's left.
#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "karinui/body/body.h"
#include "karinui/geometry/cut_mesh.h"
#include "karinui/scene/scene_frame.h"

namespace karinui {

struct SectionPlane {
  enum class Across { Side, Front, Level };  // taken away: the body's left, its front, what is above
  Across across = Across::Side;
  double at = 0;        // metres along x, z or y
  Vec3 normal() const;  // towards what is taken away
  bool hides(Vec3 place) const { return dot(place, normal()) > at; }
  bool operator==(const SectionPlane&) const = default;
};
// "side", "front", "level", each with "@" and a length: "front@5cm". BadInput: no such plane.
Result<SectionPlane> sectionNamed(std::string_view text);

struct ViewCut {
  bool arms = false, hands = false, head = false;
  std::optional<SectionPlane> section;
  bool any() const { return arms || hands || head || section; }
  bool operator==(const ViewCut&) const = default;
};
// "arms", "hands", "head", with commas between. BadInput: no such part.
Result<ViewCut> hiddenNamed(std::string_view text);
// Both; of either nothing where its text is empty.
Result<ViewCut> viewCutNamed(std::string_view hidden, std::string_view section);

// What is left to be seen of a figure and of the cloth on it. Parts are cut off along the armhole, the wrist and the
// neck base; cut ends are closed, so that a body stays a body. A part whose line is not found on this body stays.
class VisibleParts {
 public:
  VisibleParts(const ViewCut& cut, BodyPtr body);  // body may be null
  bool shows(Vec3 place) const;                    // of cloth, or of a line in the room
  bool showsSkin(const SurfacePoint& place, Vec3 point) const;
  // The frame with the body exchanged, cloths cut off at the section, lines that lie in what is gone left out.
  // `underWay`: the body's points in the frame are on their way to another pose; the same of it is left, where that is
  // now, and lines on what is hidden are not looked for.
  void cut(SceneFrame& frame, bool underWay = false) const;

 private:
  struct Cut {  // of a part: the plane, and the faces of the body beyond it
    Vec3 at, normal;
    std::vector<bool> faces;
  };
  ViewCut cut_;
  BodyPtr body_;
  TriangleMesh sectioned(TriangleMesh mesh) const;
  std::vector<Cut> parts_;
  TriangleMesh left_;                         // of the body
  std::vector<Triangle> leftFaces_;           // without the parts, before the section
  std::vector<std::vector<CutPoint>> moved_;  // by each part's cut: where its points come from
};

}  // namespace karinui

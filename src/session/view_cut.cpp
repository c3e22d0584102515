#include "karinui/session/view_cut.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/body/lines.h"
#include "karinui/design/script.h"
#include "karinui/geometry/cut_mesh.h"

namespace karinui {

namespace {

constexpr std::pair<std::string_view, SectionPlane::Across> kAcross[]{{"side", SectionPlane::Across::Side},
                                                                      {"front", SectionPlane::Across::Front},
                                                                      {"level", SectionPlane::Across::Level}};

Vec3 middleOf(const std::vector<Vec3>& ring) {
  Vec3 sum;
  for (const Vec3 p : ring) sum = sum + p;
  return sum * (1.0 / static_cast<double>(std::max<std::size_t>(ring.size(), 1)));
}

// The plane that lies best in a ring (Newell's normal), its normal towards `out`.
struct RingPlane {
  Plane plane;
  double reach = 0;
};
std::optional<RingPlane> planeOf(const Body& body, std::string_view line, Vec3 out) {
  const BodyLine* ring = bodyLine(body, line);
  if (!ring || ring->points.size() < 3) return std::nullopt;
  const Vec3 middle = middleOf(ring->points);
  Vec3 normal;
  double reach = 0;
  for (std::size_t i = 0; i < ring->points.size(); ++i) {
    normal = normal + cross(ring->points[i] - middle, ring->points[(i + 1) % ring->points.size()] - middle);
    reach = std::fmax(reach, distance(ring->points[i], middle));
  }
  if (!(length(normal) > 1e-9)) return std::nullopt;
  normal = normalized(normal);
  return RingPlane{{middle, dot(normal, out) < 0 ? -normal : normal}, 1.15 * reach};
}

// The arm is cut off by an upright plane beside the trunk, as on a dress form. At the lowest place of the armhole it
// begins, and goes outwards until what it takes is no more than the arm: straight trunks run down to the legs.
std::optional<RingPlane> armPlane(const Body& body, bool left) {
  const BodyLine* ring = bodyLine(body, left ? "armhole_left" : "armhole_right");
  if (!ring || ring->points.size() < 3) return std::nullopt;
  constexpr double kFirst = 0.004, kStep = 0.004, kFurthest = 0.06;  // metres beyond the armpit
  const Vec3 low =
      *std::min_element(ring->points.begin(), ring->points.end(), [](Vec3 a, Vec3 b) { return a.y < b.y; });
  const Vec3 middle = middleOf(ring->points), out{left ? 1.0 : -1.0, 0, 0};
  double reach = 0;
  for (const Vec3 p : ring->points) reach = std::fmax(reach, distance(p, middle));
  for (double more = kFirst; more <= kFurthest; more += kStep) {
    RingPlane plane{{{low.x + more * out.x, middle.y, middle.z}, out}, 1.15 * reach};
    const std::vector<bool> part = partAbove(body.mesh(), plane.plane, plane.reach);
    bool legs = false;
    for (std::size_t f = 0; f < part.size(); ++f)
      legs = legs || (part[f] && body.mesh().points[body.mesh().faces[f][0]].y < 0.35 * low.y);
    if (!legs) return plane;
  }
  return std::nullopt;
}

std::vector<RingPlane> planesOf(const ViewCut& cut, const Body& body) {
  std::vector<RingPlane> all;
  const auto add = [&](std::optional<RingPlane> plane) {
    if (plane) all.push_back(*plane);
  };
  if (cut.head) add(planeOf(body, "neck_base", {0, 1, 0}));
  for (const bool left : {true, false}) {
    const std::string side = left ? "_left" : "_right";
    if (cut.arms) add(armPlane(body, left));
    const BodyLine* elbow = bodyLine(body, "elbow" + side);
    const BodyLine* wrist = bodyLine(body, "wrist" + side);
    if (cut.hands && !cut.arms && elbow && wrist)
      add(planeOf(body, "wrist" + side, middleOf(wrist->points) - middleOf(elbow->points)));
  }
  return all;
}

// Runs of points that are left after a cut: broken where points are gone.
std::vector<std::vector<std::uint32_t>> leftOf(const std::vector<std::vector<std::uint32_t>>& runs,
                                               const std::vector<bool>& gone) {
  std::vector<std::vector<std::uint32_t>> left;
  for (const auto& run : runs) {
    bool open = false;
    for (const std::uint32_t p : run) {
      if (p < gone.size() && gone[p]) {
        open = false;
        continue;
      }
      if (!open) left.emplace_back();
      open = true;
      left.back().push_back(p);
    }
  }
  std::erase_if(left, [](const auto& run) { return run.size() < 2; });
  return left;
}

void cutCloth(SceneCloth& cloth, const Plane& plane, const std::vector<bool>* only) {
  CutMesh cut = cutOff(cloth.mesh, plane, false, only);
  std::vector<bool> gone(cloth.mesh.points.size(), true);
  for (const Triangle& face : cut.mesh.faces)
    for (const std::uint32_t p : face)
      if (p < gone.size()) gone[p] = false;
  if (cloth.flat.size() == cloth.mesh.points.size())
    for (std::size_t i = gone.size(); i < cut.points.size(); ++i)
      cloth.flat.push_back(lerp(cloth.flat[cut.points[i].from], cloth.flat[cut.points[i].to], cut.points[i].share));
  if (cloth.strain.size() == cloth.mesh.points.size())
    for (std::size_t i = gone.size(); i < cut.points.size(); ++i)
      cloth.strain.push_back(std::lerp(cloth.strain[cut.points[i].from], cloth.strain[cut.points[i].to],
                                       static_cast<float>(cut.points[i].share)));
  cloth.outlines = leftOf(cloth.outlines, gone);
  cloth.seams = leftOf(cloth.seams, gone);
  const auto lost = [&](const ClothPlace& place) {
    return std::any_of(place.corners.begin(), place.corners.end(), [&](std::uint32_t p) { return gone[p]; });
  };
  std::vector<SceneStitches> stitches;
  for (const SceneStitches& row : cloth.stitches) {
    bool open = false;
    for (const ClothPlace& place : row.line) {
      if (lost(place)) {
        open = false;
        continue;
      }
      if (!open) stitches.push_back(row), stitches.back().line.clear();
      open = true;
      stitches.back().line.push_back(place);
    }
  }
  cloth.stitches = std::move(stitches);
  std::vector<SceneTrim> trims;
  for (const SceneTrim& trim : cloth.trims) {
    bool open = false;
    for (std::size_t k = 0; k < trim.edge.size(); ++k) {
      if (lost(trim.edge[k]) || lost(trim.inside[k])) {
        open = false;
        continue;
      }
      if (!open) trims.push_back(trim), trims.back().edge.clear(), trims.back().inside.clear();
      open = true;
      trims.back().edge.push_back(trim.edge[k]), trims.back().inside.push_back(trim.inside[k]);
    }
  }
  cloth.trims = std::move(trims);
  cloth.mesh = std::move(cut.mesh);
}

}  // namespace

Vec3 SectionPlane::normal() const {
  return across == Across::Side ? Vec3{1, 0, 0} : across == Across::Front ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
}

Result<SectionPlane> sectionNamed(std::string_view text) {
  const std::size_t cut = text.find('@');
  for (const auto& [name, across] : kAcross)
    if (text.substr(0, cut) == name) {
      if (const Done meant = cut == std::string_view::npos ? Done() : unitMeant(text.substr(cut + 1)); !meant)
        return meant.error();
      const Result<double> at = cut == std::string_view::npos ? Result<double>(0.0) : parseLength(text.substr(cut + 1));
      if (at && std::fabs(*at) <= 10) return SectionPlane{across, *at};
    }
  return badInput(say("There is no section plane “{0}”; write side, front or level, and where: front@5cm.", text));
}

Result<ViewCut> hiddenNamed(std::string_view text) {
  ViewCut cut;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    const std::string_view part = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (part == "arms")
      cut.arms = true;
    else if (part == "hands")
      cut.hands = true;
    else if (part == "head")
      cut.head = true;
    else
      return badInput(say("“{0}” cannot be hidden; arms, hands and head can.", part));
  }
  return cut;
}

Result<ViewCut> viewCutNamed(std::string_view hidden, std::string_view section) {
  Result<ViewCut> cut = hiddenNamed(hidden);
  if (!cut || section.empty()) return cut;
  const auto plane = sectionNamed(section);
  if (!plane) return plane.error();
  cut->section = *plane;
  return cut;
}

VisibleParts::VisibleParts(const ViewCut& cut, BodyPtr body) : cut_(cut), body_(std::move(body)) {
  if (!body_) return;
  left_ = body_->mesh();
  for (const RingPlane& part : planesOf(cut, *body_)) {
    parts_.push_back({part.plane.through, part.plane.normal, partAbove(body_->mesh(), part.plane, part.reach)});
    const std::vector<bool> gone = partAbove(left_, part.plane, part.reach);
    CutMesh left = cutOff(left_, part.plane, true, &gone);
    left_ = std::move(left.mesh);
    moved_.push_back(std::move(left.points));
  }
  leftFaces_ = left_.faces;
  left_ = sectioned(std::move(left_));
}

TriangleMesh VisibleParts::sectioned(TriangleMesh mesh) const {
  if (!cut_.section) return mesh;
  const Vec3 normal = cut_.section->normal();
  return cutOff(mesh, {normal * cut_.section->at, normal}, true).mesh;
}

bool VisibleParts::shows(Vec3 place) const { return !cut_.section || !cut_.section->hides(place); }

bool VisibleParts::showsSkin(const SurfacePoint& place, Vec3 point) const {
  return shows(point) && std::none_of(parts_.begin(), parts_.end(), [&](const Cut& part) {
           return place.face < part.faces.size() && part.faces[place.face] && dot(point - part.at, part.normal) >= 0;
         });
}

void VisibleParts::cut(SceneFrame& frame, bool underWay) const {
  const std::size_t points = body_ ? body_->mesh().points.size() : 0;
  for (SceneBody& one : frame.bodies) {
    if (!body_ || one.mesh.points.size() != points) continue;
    if (!underWay) {
      one.mesh = left_;
      continue;
    }
    for (const std::vector<CutPoint>& cut : moved_) {
      std::vector<Vec3> now;
      for (const CutPoint& p : cut) now.push_back(lerp(one.mesh.points[p.from], one.mesh.points[p.to], p.share));
      one.mesh.points = std::move(now);
    }
    one.mesh.faces = leftFaces_;
    one.mesh = sectioned(std::move(one.mesh));
  }
  const auto cutAll = [&](SceneCloth& cloth) {
    if (body_ && cloth.mesh.points.size() == points)  // the skin itself, in the colours of a map
      for (const Cut& part : parts_) {
        const std::vector<bool> gone = partAbove(cloth.mesh, {part.at, part.normal}, 0.2);
        cutCloth(cloth, {part.at, part.normal}, &gone);
      }
    if (!cut_.section) return;
    const Vec3 normal = cut_.section->normal();
    cutCloth(cloth, {normal * cut_.section->at, normal}, nullptr);
  };
  for (SceneCloth& cloth : frame.cloths) cutAll(cloth);
  std::vector<SceneLine> lines;
  for (SceneLine& line : frame.lines) {
    SceneLine run = line;
    run.points.clear();
    for (const Vec3 p : line.points) {
      bool seen = shows(p);
      if (seen && !parts_.empty() && !underWay)
        if (const auto skin = body_->bvh().nearest(p, 0.02)) seen = showsSkin(skin->place, skin->point);
      if (seen) run.points.push_back(p);
      if (!seen && run.points.size() > 1) lines.push_back(run);
      if (!seen) run.points.clear();
    }
    if (run.points.size() > 1) lines.push_back(std::move(run));
  }
  frame.lines = std::move(lines);
}

}  // namespace karinui

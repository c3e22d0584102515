// Writing GarmentCode specifications.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>
#include <optional>

#include "karinui/exchange/garment_code.h"
#include "karinui/pattern/seam_walk.h"
#include "names.h"
#include "strict_json.h"

namespace karinui {
namespace {

constexpr double kPerMetre = 100;  // centimetres

Json pairOf(Flat p) { return Json::array({p.u, p.v}); }

// Angles of R = Rz Ry Rx, degrees.
Json eulerOf(const Rigid& pose) {
  const Vec3 x = pose.turned({1, 0, 0}), y = pose.turned({0, 1, 0}), z = pose.turned({0, 0, 1});
  const double b = std::asin(std::clamp(-x.z, -1.0, 1.0));
  double a = 0, c = 0;
  if (std::abs(x.z) < 1 - 1e-12) {
    a = std::atan2(y.z, z.z);
    c = std::atan2(x.y, x.x);
  } else {  // looking straight along: only the sum of the other two turns is known
    c = std::atan2(-y.x, y.y);
  }
  constexpr double kDegrees = 180 / std::numbers::pi;
  return Json::array({a * kDegrees, b * kDegrees, c * kDegrees});
}

// The rigid placement that brings a form's paper places nearest to where they are in space (Horn 1987, unit
// quaternions).
Rigid nearestPlane(const Form& form) {
  const std::size_t count = std::min(form.flat.size(), form.space.size());
  if (count == 0) return {};
  Flat paper;
  Vec3 centre;
  for (std::size_t i = 0; i < count; ++i) paper += form.flat[i], centre += form.space[i];
  paper = paper * (1.0 / static_cast<double>(count));
  centre *= 1.0 / static_cast<double>(count);
  Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Flat p = form.flat[i] - paper;
    const Vec3 q = form.space[i] - centre;
    s += Eigen::Vector3d(p.u, p.v, 0) * Eigen::RowVector3d(q.x, q.y, q.z);
  }
  Eigen::Matrix4d n;
  n << s.trace(), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),                   //
      s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),  //
      s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),  //
      s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
  const Eigen::Vector4d q = Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(n).eigenvectors().col(3);
  Rigid pose{q[0], q[1], q[2], q[3], {}};
  pose.carry = centre - pose.turned({paper.u, paper.v, 0});
  return pose;
}

// Where edges must be split so that every seam joins whole edges: fractions of each edge's length, 0 and 1 left out.
class Splits {
 public:
  explicit Splits(const Pattern& pattern) : pattern_(pattern) {
    // The format has no chains: each cubic is an edge of its own.
    for (const auto& [id, piece] : pattern.pieces)
      for (const Edge& edge : piece->outline.edges) {
        const auto cubics = edge.curve.parts().size();
        const double whole = edge.curve.length();
        for (std::size_t k = 1; k < cubics; ++k)
          add({id, edge.name, edge.curve.lengthTo(static_cast<double>(k) / static_cast<double>(cubics)) / whole}, 0);
      }
    // A split made for one seam may lie within another; each round carries them across, and few rounds are needed.
    for (int round = 0; round < 8; ++round)
      if (!carryAcross()) break;
  }
  const std::vector<double>& of(PieceId piece, const std::string& edge) const {
    static const std::vector<double> kNone;
    const auto found = at_.find({piece, edge});
    return found == at_.end() ? kNone : found->second;
  }

 private:
  bool carryAcross() {
    bool grew = false;
    for (const auto& [id, seam] : pattern_.seams) {
      const SeamSides sides(pattern_, seam);
      for (const double x : sides.breaks())
        for (const SeamSide* side : {&sides.a, &sides.b}) grew |= add(side->at(x));
      grew |= carry(sides.a, sides.b);
      grew |= carry(sides.b, sides.a);
      for (const auto* spans : {&seam.a, &seam.b})
        for (const EdgeSpan& span : *spans)
          for (const double at : {span.from, span.to}) grew |= add({span.piece, span.edge, at});
    }
    return grew;
  }
  // Splits that lie within one side are needed at the same places of the other.
  bool carry(const SeamSide& from, const SeamSide& to) {
    bool grew = false;
    for (std::size_t i = 0; i < from.spans().size(); ++i) {
      const EdgeSpan& span = from.spans()[i];
      const std::vector<double> here = of(span.piece, span.edge);  // a copy: the other side may be the same edge
      for (const double f : here)
        if (f > span.from && f < span.to) grew |= add(to.at(from.fractionOf(i, f)));
    }
    return grew;
  }
  // `apart`: metres; nearer to another split (a hundredth of a millimetre) it is the same one.
  bool add(const SeamPlace& place, double apart = 1e-5) {
    const Edge* edge = edgeOf(pattern_, place.piece, place.edge);
    if (!edge) return false;
    const double tiny = apart / edge->curve.length();
    if (place.fraction <= tiny || place.fraction >= 1 - tiny) return false;
    auto& list = at_[{place.piece, place.edge}];
    for (const double f : list)
      if (std::abs(f - place.fraction) <= tiny) return false;
    list.insert(std::upper_bound(list.begin(), list.end(), place.fraction), place.fraction);
    return true;
  }

  const Pattern& pattern_;
  std::map<std::pair<PieceId, std::string>, std::vector<double>> at_;
};

Json curvatureOf(const Curve& curve) {
  const Flat along = curve.end - curve.start;
  const double square = dot(along, along);
  const auto relative = [&](Flat p) {
    const Flat step = p - curve.start;
    return Json::array({dot(step, along) / square, cross(along, step) / square});
  };
  if (curve.kind == Curve::Kind::Cubic)
    return {{"type", "cubic"}, {"params", {relative(curve.control1), relative(curve.control2)}}};
  const double quarter = std::atan(std::abs(curve.bulge));
  const double radius = length(along) / (2 * std::sin(2 * quarter));
  return {{"type", "circle"},
          {"params", {std::abs(radius) * kPerMetre, quarter > std::numbers::pi / 4 ? 1 : 0, curve.bulge > 0 ? 1 : 0}}};
}

struct WrittenEdge {
  std::string name;
  double from = 0, to = 1;
  Curve curve;
};

std::vector<WrittenEdge> edgesOf(const Piece& piece, const Splits& splits) {
  std::vector<WrittenEdge> out;
  for (const Edge& edge : piece.outline.edges) {
    std::vector<double> ends = splits.of(piece.id, edge.name);
    ends.push_back(1);
    double from = 0, t = 0;
    Flat start = edge.curve.start;
    const double whole = edge.curve.length();
    for (const double to : ends) {
      const double next = to == 1 ? 1 : edge.curve.parameterAt(to * whole);
      Curve part = ends.size() == 1 ? edge.curve : edge.curve.part(t, next);
      part.start = start;
      out.push_back({edge.name, from, to, part});
      from = to, t = next, start = part.end;
    }
  }
  return out;
}

Json panelOf(const Piece& piece, const std::vector<WrittenEdge>& edges) {
  const Rigid pose = piece.form ? after(piece.pose, nearestPlane(*piece.form)) : piece.pose;
  Json panel;
  panel["translation"] = {pose.carry.x * kPerMetre, pose.carry.y * kPerMetre, pose.carry.z * kPerMetre};
  panel["rotation"] = eulerOf(pose);
  panel["vertices"] = Json::array();
  panel["edges"] = Json::array();
  DistinctNames taken;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    panel["vertices"].push_back(pairOf(edges[i].curve.start * kPerMetre));
    Json edge{{"endpoints", {i, (i + 1) % edges.size()}}};
    if (edges[i].curve.kind == Curve::Kind::Cubic ||
        (edges[i].curve.kind == Curve::Kind::Arc && edges[i].curve.bulge != 0))
      edge["curvature"] = curvatureOf(edges[i].curve);
    // Not as its label: the program refuses a stitch between two labels that differ.
    edge["name"] = taken.give(edges[i].name);
    panel["edges"].push_back(std::move(edge));
  }
  return panel;
}

}  // namespace

Result<std::string> writeGarmentCode(const Pattern& pattern) {
  const Splits splits(pattern);
  std::map<PieceId, std::string> names;
  std::map<PieceId, std::vector<WrittenEdge>> edges;
  DistinctNames taken;
  Json panels = Json::object(), order = Json::array(), stitches = Json::array();
  for (const auto& [id, piece] : pattern.pieces) {
    edges[id] = edgesOf(*piece, splits);
    names[id] = taken.give(cleanText(piece->name));
    panels[names[id]] = panelOf(*piece, edges[id]);
    order.push_back(names[id]);
  }
  const auto sideAt = [&](const SeamPlace& place) -> std::optional<Json> {
    const auto found = edges.find(place.piece);
    if (found == edges.end()) return std::nullopt;
    for (std::size_t i = 0; i < found->second.size(); ++i) {
      const WrittenEdge& edge = found->second[i];
      if (edge.name == place.edge && edge.from <= place.fraction && place.fraction <= edge.to)
        return Json{{"panel", names[place.piece]}, {"edge", i}};
    }
    return std::nullopt;  // on a hole, which the format does not have
  };
  for (const auto& [id, seam] : pattern.seams) {
    const SeamSides sides(pattern, seam);
    // Every place where an edge of either side was split is a place where one stitch ends and the next begins.
    std::vector<double> ends = sides.breaks();
    for (const SeamSide* side : {&sides.a, &sides.b})
      for (std::size_t k = 0; k < side->spans().size(); ++k) {
        const EdgeSpan& span = side->spans()[k];
        for (const double f : splits.of(span.piece, span.edge))
          if (f > span.from && f < span.to) ends.push_back(side->fractionOf(k, f));
      }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (ends[i + 1] - ends[i] < 1e-5) continue;
      const double middle = (ends[i] + ends[i + 1]) / 2;
      const auto a = sideAt(sides.a.at(middle)), b = sideAt(sides.b.at(middle));
      if (!a || !b) continue;
      Json stitch = Json::array({*a, *b});
      if (!seam.reversed) stitch.push_back("right_wrong");
      stitches.push_back(std::move(stitch));
    }
  }
  const Json root{{"pattern", {{"panels", panels}, {"stitches", stitches}, {"panel_order", order}}},
                  {"parameters", Json::object()},
                  {"parameter_order", Json::array()},
                  {"properties",
                   {{"curvature_coords", "relative"},
                    {"normalize_panel_translation", false},
                    {"normalized_edge_loops", true},
                    {"generator", "Karinui"},  // so that reading it back trusts the rule of the right sides
                    {"units_in_meter", static_cast<int>(kPerMetre)}}}};
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace karinui

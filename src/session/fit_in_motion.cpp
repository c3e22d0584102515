#include "karinui/session/fit_in_motion.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "session/csv.h"
#include "session/pose_steps.h"

namespace karinui {

namespace {

using Part = BodyPoint::Part;
constexpr int kPlaces = 16;  // looked at along an edge
// Levels of the trunk: an open edge below the first is a hem, one above the second a neckline or an armhole.
constexpr double kHighHip = 2, kUnderBust = 4.2;

bool isArm(Part part) { return part == Part::LeftArm || part == Part::RightArm; }

std::optional<OpenEdge> kindAt(const BodyPoint& point) {
  switch (point.part) {
    case Part::LeftArm:
    case Part::RightArm:
      return point.along < 1 ? OpenEdge::Neck : OpenEdge::Cuff;
    case Part::LeftLeg:
    case Part::RightLeg:
      return OpenEdge::Hem;
    case Part::Torso:
      return point.along < kHighHip ? OpenEdge::Hem : point.along < kUnderBust ? OpenEdge::Waist : OpenEdge::Neck;
    default:
      return std::nullopt;
  }
}

// Towards the trunk along an arm, else upwards; in the own pose.
Vec3 inwards(const Skeleton& skeleton, Part part, double along) {
  if (!isArm(part)) return {0, 1, 0};
  const int side = part == Part::RightArm ? 1 : 0;
  const auto place = [&](Joint left) { return skeleton.place(static_cast<Joint>(static_cast<int>(left) + side)); };
  return along < 2 ? normalized(place(Joint::LeftShoulder) - place(Joint::LeftElbow))
                   : normalized(place(Joint::LeftElbow) - place(Joint::LeftWrist));
}

// A place of an open edge.
struct EdgePlace {
  PieceId piece;
  Flat paper;
  SurfacePoint skin;  // it lay nearest to
  bool ofArm = false;
  Vec3 inwards;
};
// By what the edge is.
using EdgePlaces = std::array<std::vector<EdgePlace>, kOpenEdges.size()>;

bool isOpen(const Document& document, const Piece& piece, const std::string& edge) {
  const auto holds = [&](const std::vector<EdgeSpan>& side) {
    return std::any_of(side.begin(), side.end(),
                       [&](const EdgeSpan& span) { return span.piece == piece.id && span.edge == edge; });
  };
  const auto held = [&](const auto& all) {
    return std::any_of(all.begin(), all.end(),
                       [&](const auto& sewn) { return holds(sewn.second.a) || holds(sewn.second.b); });
  };
  return !held(document.pattern.seams) && !held(document.allowances.fastenings);
}

EdgePlaces openEdges(const FitInPose& first, const Skeleton& skeleton) {
  EdgePlaces all;
  const Body& own = first.body->own();
  for (const auto& [id, piece] : first.document.pattern.pieces) {
    if (!piece->form) continue;
    const Stand stand(*piece);
    for (const Edge& edge : piece->outline.edges) {
      if (!isOpen(first.document, *piece, edge.name)) continue;
      std::array<std::vector<EdgePlace>, kOpenEdges.size()> here;
      for (int k = 0; k < kPlaces; ++k) {
        const Flat paper = edge.curve.atFraction((k + 0.5) / kPlaces);
        const auto near = first.body->bvh().nearest(stand(paper));
        const BodyPoint point = own.describe(near->place);
        if (const auto kind = kindAt(point))
          here[static_cast<std::size_t>(*kind)].push_back(
              {id, paper, near->place, isArm(point.part), inwards(skeleton, point.part, point.along)});
      }
      // An edge is what most of it is.
      const auto most =
          std::max_element(here.begin(), here.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
      auto& kind = all[static_cast<std::size_t>(most - here.begin())];
      kind.insert(kind.end(), most->begin(), most->end());
    }
  }
  return all;
}

Result<FitInPose> measured(Document document, Context& context) {
  FitInPose fit;
  const auto body = bodyOf(document, context);
  if (!body) return body.error();
  fit.body = *body;
  fit.settled = document.drape.last && document.drape.last->settled;
  const auto check = examined(document, context);
  if (!check) return check.error();
  fit.strain = check->strain;
  fit.garment = snapshotOf(document, *body);
  fit.pressureAt = pressureOnBody(*fit.garment, context.workers);
  fit.pressure = pressureReport(fit.pressureAt);
  fit.document = std::move(document);
  return fit;
}

Result<FitInPose> posed(const Document& start, const std::string& pose, Context& context) {
  auto carried = apply(start, poseStep(pose), context);
  if (!carried) return carried.error();
  auto now = rested(*std::move(carried), context);
  if (!now) return now.error();
  return measured(*std::move(now), context);
}

// How far the edges slid over the skin since the first pose.
void slide(FitInPose& fit, const EdgePlaces& edges, const Body& body) {
  const TriangleMesh& own = body.mesh();
  for (std::size_t kind = 0; kind < edges.size(); ++kind) {
    double sum = 0;
    int places = 0;
    std::map<PieceId, Stand> stands;
    for (const EdgePlace& place : edges[kind]) {
      auto stand = stands.find(place.piece);
      if (stand == stands.end()) stand = stands.emplace(place.piece, Stand(*fit.document.find(place.piece))).first;
      const auto near = fit.body->bvh().nearest(stand->second(place.paper));
      // A hand that hangs beside the hem says nothing of how far it slid.
      if (isArm(body.describe(near->place).part) != place.ofArm) continue;
      sum += dot(at(own, near->place) - at(own, place.skin), place.inwards);
      ++places;
    }
    if (places > 0) fit.slid[kind] = sum / places;
  }
}

}  // namespace

Message openEdgeSaid(OpenEdge edge) {
  switch (edge) {
    case OpenEdge::Neck:
      return say("Neck, armhole");
    case OpenEdge::Waist:
      return say("Waist");
    case OpenEdge::Hem:
      return say("Hem");
    case OpenEdge::Cuff:
      return say("Cuff");
  }
  return {};
}

Result<std::vector<FitInPose>> fitInMotion(const Document& document, const std::vector<std::string>& poses,
                                           Context& context, const std::function<void(const FitInPose&)>& each) {
  if (!document.body.chosen()) return bodyOf(document, context).error();
  if (const Done known = posesKnown(document, poses, context); !known) return known.error();
  const auto skeleton = context.bodies.skeleton(document.body, context.blobs, context.workers, context.token);
  if (!skeleton) return skeleton.error();
  const auto start = rested(document, context);
  if (!start) return start.error();
  std::vector<FitInPose> fits;
  auto first = measured(*start, context);
  if (!first) return first.error();
  first->said = say("As it stands");
  const EdgePlaces edges = openEdges(*first, **skeleton);
  const Body& body = first->body->own();
  const auto add = [&](FitInPose fit) {
    if (!fit.refused) slide(fit, edges, body);
    fits.push_back(std::move(fit));
    if (each) each(fits.back());
  };
  add(*std::move(first));
  for (const std::string& name : poses) {
    auto fit = posed(*start, name, context);
    if (!fit && fit.error().hindered()) return fit.error();
    if (!fit) {
      FitInPose none;
      none.refused = fit.error().what;
      fit = std::move(none);
    }
    fit->name = name, fit->said = namedPose(name)->said;
    add(*std::move(fit));
  }
  return fits;
}

std::string csvOf(const std::vector<FitInPose>& fits) {
  static constexpr std::array<const char*, kOpenEdges.size()> kEdges{"neck_m", "waist_m", "hem_m", "cuff_m"};
  std::vector<std::string> head{"pose",       "settled",          "strain_mean",    "strain_p99",
                                "strain_max", "pressure_mean_pa", "pressure_p99_pa"};
  head.insert(head.end(), kEdges.begin(), kEdges.end());
  head.push_back("refused");
  std::string csv = csvRow(head);
  for (const FitInPose& fit : fits) {
    const auto number = [&](double value) { return fit.refused ? "" : shortest(value); };
    std::vector<std::string> row{fit.name,
                                 fit.settled ? "yes" : "no",
                                 number(fit.strain.mean),
                                 number(fit.strain.p99),
                                 number(fit.strain.max),
                                 fit.pressure ? shortest(fit.pressure->mean) : "",
                                 fit.pressure ? shortest(fit.pressure->p99) : ""};
    for (const auto& slid : fit.slid) row.push_back(slid ? shortest(*slid) : "");
    row.push_back(fit.refused ? text(*fit.refused) : "");
    csv += csvRow(row);
  }
  return csv;
}

}  // namespace karinui

#include "karinui/session/wide_edges.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "karinui/base/number.h"
#include "karinui/design/step_words.h"
#include "session/sewn_border.h"

namespace karinui {

namespace {

constexpr double kLeastWider = 0.01, kLeastBelow = 0.02;  // metres: what is less is as it should be
constexpr double kAbove = 0.04;      // metres that cloth stands above an edge at most, for it to be the topmost
constexpr double kEndsApart = 0.04;  // metres between the ends of a run that goes round, as with a hook
constexpr double kSampled = 0.01;    // metres of a run from place to place
constexpr double kCorner = 0.7;      // cosine: where the border turns more, the run ends

// Pieces that hang together, by seams and fastenings: of each the first one.
std::map<PieceId, PieceId> garmentsOf(const Document& document) {
  std::map<PieceId, PieceId> first;
  for (const auto& [id, piece] : document.pattern.pieces) first[id] = id;
  const auto join = [&](const std::vector<EdgeSpan>& a, const std::vector<EdgeSpan>& b) {
    for (const EdgeSpan& one : a)
      for (const EdgeSpan& other : b) {
        if (!first.contains(one.piece) || !first.contains(other.piece)) continue;
        const PieceId from = first.at(one.piece), to = first.at(other.piece);
        for (auto& [id, own] : first)
          if (own == from) own = to;
      }
  };
  for (const auto& [id, seam] : document.pattern.seams)
    join(seam.a, seam.b), join(seam.a, seam.a), join(seam.b, seam.b);
  for (const auto& [name, fastening] : document.allowances.fastenings) join(fastening.a, fastening.b);
  return first;
}

// A run of edges as it stands.
struct Run {
  std::vector<EdgeRef> parts;
  std::vector<Vec3> places;
  double length = 0;
  bool closed = false;  // it is all of its border
};

class Standings {
 public:
  explicit Standings(const Document& document) : document_(document) {}
  const Piece& piece(PieceId id) const { return *document_.pattern.pieces.at(id); }
  const Curve& curve(const EdgeRef& part) const {
    const Piece& own = piece(part.piece.id);
    return own.outline.edges[*own.outline.find(part.edge)].curve;
  }
  Vec3 at(const EdgeRef& part, double share) {
    const auto stand = stands_.try_emplace(part.piece.id, piece(part.piece.id)).first;
    return stand->second(curve(part).atFraction(part.from + (part.to - part.from) * share));
  }
  void add(Run& run, const EdgeRef& part) {
    const double length = curve(part).length() * (part.to - part.from);
    const int steps = std::max(1, static_cast<int>(std::ceil(length / kSampled)));
    for (int k = 0; k <= steps; ++k) run.places.push_back(at(part, static_cast<double>(k) / steps));
    run.parts.push_back(part);
    run.length += length;
  }
  // Whether the border goes straight on from one part to the next. Over a seam it does.
  bool goesOn(const EdgeRef& part, const EdgeRef& next) const {
    if (part.piece.id != next.piece.id || next.from > 1e-6 || part.to < 1 - 1e-6) return true;
    const Curve &one = curve(part), &other = curve(next);
    const Flat a = one.atFraction(1) - one.atFraction(0.95), b = other.atFraction(0.05) - other.atFraction(0);
    return dot(a, b) > kCorner * length(a) * length(b);
  }

 private:
  const Document& document_;
  std::map<PieceId, Stand> stands_;
};

bool sewnInMiddle(const Document& document, PieceId piece, const std::string& edge) {
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto* side : takenSides(seam))
      for (const EdgeSpan& span : *side)
        if (span.piece == piece && span.edge == edge && span.from < 0.5 + 1e-6 && span.to > 0.5 - 1e-6) return true;
  return false;
}

// The border in runs from corner to corner, or as one.
std::vector<Run> runsOf(const std::vector<EdgeRef>& border, Standings& stands) {
  std::size_t begin = 0;
  for (std::size_t k = 0; k < border.size() && begin == 0; ++k)
    if (!stands.goesOn(border[k], border[(k + 1) % border.size()])) begin = k + 1;
  std::vector<Run> runs(1);
  for (std::size_t k = 0; k < border.size(); ++k) {
    const EdgeRef& part = border[(begin + k) % border.size()];
    stands.add(runs.back(), part);
    if (k + 1 < border.size() && !stands.goesOn(part, border[(begin + k + 1) % border.size()])) runs.emplace_back();
  }
  runs.front().closed = runs.size() == 1;
  return runs;
}

struct Round {
  enum { Nothing, Trunk, Legs } what = Nothing;
  double length = 0;  // of one turn, metres: a wrapped run goes on beyond that
};

// What it goes round: its ends are together, or lie over each other as a wrapped skirt's.
Round roundOf(const Run& run, const Body& body) {
  if (run.places.size() < 8) return {};
  const bool apart = !run.closed && distance(run.places.front(), run.places.back()) > kEndsApart;
  Vec3 middle;
  for (const Vec3& p : run.places) middle += p * (1.0 / static_cast<double>(run.places.size()));
  const Vec3 first = apart ? run.places.front() : run.places.back();
  double turned = 0, before = std::atan2(first.x - middle.x, first.z - middle.z);
  for (const Vec3& p : run.places) {
    const double now = std::atan2(p.x - middle.x, p.z - middle.z);
    turned += std::remainder(now - before, 2 * std::numbers::pi);
    before = now;
  }
  const double turns = std::fabs(turned) / (2 * std::numbers::pi);
  if (turns < (apart ? 1 : 0.95)) return {};
  using Part = BodyPoint::Part;
  std::map<Part, std::size_t> on;
  std::size_t seen = 0;
  for (std::size_t k = 0; k < run.places.size(); k += 4, ++seen)
    if (const auto near = body.bvh().nearest(run.places[k])) ++on[body.describe(near->place).part];
  const double length = run.length / (apart ? turns : 1);
  if (2 * on[Part::Torso] > seen) return {Round::Trunk, length};
  const bool both = on[Part::LeftLeg] > 0 && on[Part::RightLeg] > 0;
  if (both && 2 * (on[Part::LeftLeg] + on[Part::RightLeg]) > seen) return {Round::Legs, length};
  return {};
}

std::optional<double> waistHeight(const Body& body) {
  double height = 0;
  for (const char* at : {"torso:waist@0.25", "torso:waist@0.75"}) {
    const auto place = body.find(*parseBodyPoint(at));
    if (!place) return std::nullopt;
    height += 0.5 * karinui::at(body.mesh(), *place).y;
  }
  return height;
}

bool standsStraight(const BodyPose& pose) {
  return std::none_of(pose.begin(), pose.end(), [](const auto& joint) {
    return joint.first == Joint::Pelvis || joint.first == Joint::Spine || joint.first == Joint::LeftHip ||
           joint.first == Joint::RightHip;
  });
}

}  // namespace

std::vector<WideEdge> wideEdges(const GarmentSnapshot& snapshot) {
  std::vector<WideEdge> wide;
  const Document& document = snapshot.document;
  if (!snapshot.body || !document.drape.last || !document.drape.dirty.empty()) return wide;
  const Body& body = *snapshot.body;
  const auto girth = body.measured().value.find("waist_girth");
  if (girth == body.measured().value.end() || !standsStraight(body.pose())) return wide;
  const auto waist = waistHeight(body);
  if (!waist) return wide;

  const std::map<PieceId, PieceId> garments = garmentsOf(document);
  std::map<PieceId, double> top;  // of each garment, metres above the floor
  std::set<PieceId> pinned;
  for (const auto& [id, piece] : document.pattern.pieces) {
    if (!piece->form) continue;
    for (const Vec3& p : piece->form->space) {
      double& own = top.try_emplace(garments.at(id), -1e9).first->second;
      own = std::max(own, piece->pose(p).y);
    }
  }
  for (const auto& [id, places] : document.pins)
    if (garments.contains(id) && !places.empty()) pinned.insert(garments.at(id));

  Standings stands(document);
  std::set<std::pair<PieceId, std::string>> seen;
  for (const auto& [id, piece] : document.pattern.pieces) {
    const PieceId garment = garments.at(id);
    if (!top.contains(garment) || pinned.contains(garment) || top.at(garment) > *waist + kAbove) continue;
    for (const Edge& edge : piece->outline.edges) {
      if (seen.contains({id, edge.name}) || sewnInMiddle(document, id, edge.name)) continue;
      const SewnBorder border(document.pattern, {id, edge.name, 0.5, 0});
      const std::vector<EdgeRef> parts = border.between(0, border.length());
      for (const EdgeRef& part : parts) seen.insert({part.piece.id, part.edge});
      for (const Run& run : runsOf(parts, stands)) {
        double height = 0, upTo = -1e9;
        for (const Vec3& p : run.places) {
          height += p.y / static_cast<double>(run.places.size());
          upTo = std::max(upTo, p.y);
        }
        const bool elastic = std::any_of(run.parts.begin(), run.parts.end(), [&](const EdgeRef& part) {
          return std::any_of(document.allowances.elastics.begin(), document.allowances.elastics.end(),
                             [&](const auto& own) { return own.first.first == part.piece.id; });
        });
        if (elastic || top.at(garment) > upTo + kAbove || height > *waist - kLeastBelow) continue;
        const Round round = roundOf(run, body);
        const bool narrow = round.length < girth->second + kLeastWider;
        if (round.what == Round::Legs || (round.what == Round::Trunk && !narrow))
          wide.push_back({run.parts, round.length, girth->second, *waist - height, round.what == Round::Legs, narrow});
      }
    }
  }
  return wide;
}

Message wideEdgeSaid(const Document& document, const WideEdge& edge) {
  const auto cm = [](double metres) { return fixed(metres * 100, 1); };
  std::vector<Message> names;
  for (const EdgeRef& part : edge.run) {
    Message name = edgeSaid(document, {part.piece, part.edge});
    if (std::none_of(names.begin(), names.end(), [&](const Message& had) { return text(had) == text(name); }))
      names.push_back(std::move(name));
  }
  Message all = names.front();
  if (names.size() > 1) all = say("{0} and the edges that go on from it", names.front());
  if (edge.narrow)
    return say(
        "Off the hips: {0} has gone to {1} cm below the waist while it was put on, though with {2} cm on a waist of "
        "{3} "
        "cm it would stay up. Drape the garment anew on finer cells: set spacing=12mm, drape.",
        all, cm(edge.below), cm(edge.round), cm(edge.waist));
  if (edge.fallen)
    return say(
        "Too wide to stay up: {0}, {1} cm round on a waist of {2} cm, has fallen to {3} cm below it. Make it shorter, "
        "sew an elastic in, or hang it from straps.",
        all, cm(edge.round), cm(edge.waist), cm(edge.below));
  return say(
      "Wider than the waist: {0}, {1} cm round on a waist of {2} cm, has slid to {3} cm below it, where the body is as "
      "wide. Unless it is meant to lie there, make it shorter, sew an elastic in, or hang it from straps.",
      all, cm(edge.round), cm(edge.waist), cm(edge.below));
}

}  // namespace karinui

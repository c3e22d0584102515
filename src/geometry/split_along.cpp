#include "geometry/split_along.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "geometry/split_face.h"
#include "karinui/base/number.h"

namespace karinui {
namespace {

constexpr double kSnapWeight = 1e-5;                      // of a face: nearer to an edge or corner than this is on it
constexpr double kSnapLength = 1e-7;                      // metres: places this near are one
using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;  // lower corner first

struct Node {
  enum class On { Corner, Edge, Face } on = On::Corner;
  EdgeKey edge{};
  double t = 0;            // from the edge's lower corner
  std::uint32_t face = 0;  // a face it lies in
};

struct Step {
  std::uint32_t a, b, side;
};

class Splitter {
 public:
  explicit Splitter(const SurfaceGuide& guide) : guide_(guide), mesh_(guide.mesh()), points_(guide.mesh().points) {
    facesAt_.resize(mesh_.points.size());
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f)
      for (std::uint32_t v : mesh_.faces[f]) facesAt_[v].push_back(f);
  }

  Result<SplitMesh> split(std::span<const SurfacePath> sides) {
    std::vector<Step> steps;
    for (std::uint32_t s = 0; s < sides.size(); ++s) {
      const std::size_t before = steps.size();
      std::uint32_t last = node(sides[s].places.front());
      if (s > 0 && !steps.empty() && steps.back().b != last)
        return refused(say("The line is open after its {0}. side.", std::size_t{s}));
      for (const SurfacePoint& place : sides[s].places) {
        const std::uint32_t next = node(place);
        if (next != last) steps.push_back({last, next, s});
        last = next;
      }
      if (steps.size() == before)
        return refused(say("The {0}. side of the line has no length: two of its points are one.", std::size_t{s} + 1));
    }
    if (steps.empty() || steps.back().b != steps.front().a)
      return refused(say("The line is open: its ends do not meet."));
    for (auto& [edge, nodes] : onEdge_) std::sort(nodes.begin(), nodes.end());

    SplitMesh out;
    std::map<std::uint32_t, std::vector<Chord>> chords;
    for (const Step& step : steps) {
      if (const auto edge = sharedEdge(step.a, step.b)) {
        for (std::uint32_t n : runOnEdge(*edge, step.a, step.b)) add(out, n, step.side);
        continue;
      }
      const auto face = sharedFace(step.a, step.b);
      KARINUI_ASSERT(face);
      std::vector<Chord>& here = chords[*face];
      const bool known = std::any_of(here.begin(), here.end(), [&](const Chord& c) {
        return (c.a == step.a && c.b == step.b) || (c.a == step.b && c.b == step.a);
      });
      if (!known) here.push_back({step.a, step.b, step.side});
      add(out, step.a, step.side);
    }

    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      const std::vector<std::uint32_t> cycle = cycleOf(f);
      const auto here = chords.find(f);
      if (cycle.size() == 3 && here == chords.end()) {
        out.mesh.faces.push_back(mesh_.faces[f]);
        out.parent.push_back(f);
        continue;
      }
      const Frame frame(mesh_, f);
      const std::span<const Chord> cuts =
          here == chords.end() ? std::span<const Chord>{} : std::span<const Chord>(here->second);
      const SplitFace made = splitFace(cycle, cuts, [&](std::uint32_t n) { return frame(points_[n]); });
      if (made.trouble == SplitFace::Trouble::Crossing) return crossing(cuts[made.firstChord], cuts[made.secondChord]);
      if (made.trouble == SplitFace::Trouble::DeadEnd)
        return refused(
            say("The line turns back on itself {0} cm above the floor.", fixed(points_[cuts[0].a].y * 100, 1)));
      if (made.trouble == SplitFace::Trouble::Island)
        return refused(say("The line is too small to hold a piece of cloth."));
      for (const Triangle& t : made.triangles) {
        out.mesh.faces.push_back(t);
        out.parent.push_back(f);
      }
    }
    out.mesh.points = std::move(points_);
    return out;
  }

 private:
  // A face's plane as paper.
  struct Frame {
    Vec3 origin, x, y;
    Frame(const TriangleMesh& mesh, std::uint32_t face) : origin(mesh.points[mesh.faces[face][0]]) {
      const Vec3 a = mesh.points[mesh.faces[face][1]] - origin, b = mesh.points[mesh.faces[face][2]] - origin;
      x = normalized(a);
      y = normalized(b - x * dot(b, x));
    }
    Flat operator()(Vec3 p) const { return {dot(p - origin, x), dot(p - origin, y)}; }
  };

  static void add(SplitMesh& out, std::uint32_t node, std::uint32_t side) {
    out.loop.push_back(node);
    out.side.push_back(side);
  }

  Error crossing(const Chord& c, const Chord& d) const {
    const Vec3 p = (points_[c.a] + points_[c.b] + points_[d.a] + points_[d.b]) * 0.25;
    return refused(say("The line crosses itself where its {0}. and {1}. side meet, {2} cm above the floor.",
                       std::size_t{std::min(c.side, d.side)} + 1, std::size_t{std::max(c.side, d.side)} + 1,
                       fixed(p.y * 100, 1)));
  }

  std::uint32_t made(Node node, Vec3 p) {
    nodes_.push_back(node);
    points_.push_back(p);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }

  std::uint32_t node(const SurfacePoint& place) {
    const Triangle& t = mesh_.faces[place.face];
    std::vector<std::size_t> held;
    for (std::size_t k = 0; k < 3; ++k)
      if (place.weight[k] > kSnapWeight) held.push_back(k);
    if (held.size() == 1) return t[held[0]];
    if (held.size() == 2) {
      std::uint32_t a = t[held[0]], b = t[held[1]];
      double share = place.weight[held[1]] / (place.weight[held[0]] + place.weight[held[1]]);
      if (a > b) {
        std::swap(a, b);
        share = 1 - share;
      }
      const double whole = distance(points_[a], points_[b]);
      auto& known = onEdge_[{a, b}];
      for (const auto& [s, id] : known)
        if (std::fabs(s - share) * whole < kSnapLength) return id;
      const std::uint32_t id = made({Node::On::Edge, {a, b}, share, place.face}, lerp(points_[a], points_[b], share));
      known.emplace_back(share, id);
      return id;
    }
    const Vec3 p = at(mesh_, place);
    auto& known = inFace_[place.face];
    for (std::uint32_t id : known)
      if (distance(points_[id], p) < kSnapLength) return id;
    known.push_back(made({Node::On::Face, {}, 0, place.face}, p));
    return known.back();
  }

  const Node* madeNode(std::uint32_t id) const {
    return id < mesh_.points.size() ? nullptr : &nodes_[id - mesh_.points.size()];
  }

  // The mesh edge both nodes lie on, ends included.
  std::optional<EdgeKey> sharedEdge(std::uint32_t p, std::uint32_t q) const {
    const Node *a = madeNode(p), *b = madeNode(q);
    if (!a && !b) {
      for (std::uint32_t f : facesAt_[p])
        for (std::uint32_t v : mesh_.faces[f])
          if (v == q) return EdgeKey{std::min(p, q), std::max(p, q)};
      return std::nullopt;
    }
    if (!a) return sharedEdge(q, p);
    if (a->on != Node::On::Edge) return std::nullopt;
    if (!b) return a->edge.first == q || a->edge.second == q ? std::optional(a->edge) : std::nullopt;
    return b->on == Node::On::Edge && a->edge == b->edge ? std::optional(a->edge) : std::nullopt;
  }

  // The nodes from p to before q along an edge.
  std::vector<std::uint32_t> runOnEdge(EdgeKey edge, std::uint32_t p, std::uint32_t q) const {
    std::vector<std::uint32_t> all{edge.first};
    if (const auto known = onEdge_.find(edge); known != onEdge_.end())
      for (const auto& [t, id] : known->second) all.push_back(id);
    all.push_back(edge.second);
    const auto i = std::find(all.begin(), all.end(), p), j = std::find(all.begin(), all.end(), q);
    if (i < j) return {i, j};
    std::vector<std::uint32_t> run(j + 1, i + 1);
    std::reverse(run.begin(), run.end());
    return run;
  }

  std::vector<std::uint32_t> facesOf(std::uint32_t id) const {
    const Node* node = madeNode(id);
    if (!node) return facesAt_[id];
    std::vector<std::uint32_t> faces{node->face};
    if (node->on == Node::On::Edge)
      for (int k = 0; k < 3; ++k) {
        const Triangle& t = mesh_.faces[node->face];
        const std::uint32_t a = t[static_cast<std::size_t>(k)], b = t[static_cast<std::size_t>((k + 1) % 3)];
        if (EdgeKey{std::min(a, b), std::max(a, b)} == node->edge &&
            guide_.across(node->face, k) != SurfaceGuide::kNone)
          faces.push_back(guide_.across(node->face, k));
      }
    return faces;
  }

  std::optional<std::uint32_t> sharedFace(std::uint32_t p, std::uint32_t q) const {
    const auto b = facesOf(q);
    for (std::uint32_t f : facesOf(p))
      if (std::find(b.begin(), b.end(), f) != b.end()) return f;
    return std::nullopt;
  }

  std::vector<std::uint32_t> cycleOf(std::uint32_t f) const {
    std::vector<std::uint32_t> cycle;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh_.faces[f][k], b = mesh_.faces[f][(k + 1) % 3];
      cycle.push_back(a);
      const auto known = onEdge_.find({std::min(a, b), std::max(a, b)});
      if (known == onEdge_.end()) continue;
      std::vector<std::uint32_t> run;
      for (const auto& [t, id] : known->second) run.push_back(id);
      if (a > b) std::reverse(run.begin(), run.end());
      cycle.insert(cycle.end(), run.begin(), run.end());
    }
    return cycle;
  }

  const SurfaceGuide& guide_;
  const TriangleMesh& mesh_;
  std::vector<Vec3> points_;
  std::vector<Node> nodes_;  // of points_ beyond the mesh's own
  std::vector<std::vector<std::uint32_t>> facesAt_;
  std::map<EdgeKey, std::vector<std::pair<double, std::uint32_t>>> onEdge_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> inFace_;
};

}  // namespace

Result<SplitMesh> splitAlong(const SurfaceGuide& guide, std::span<const SurfacePath> sides) {
  KARINUI_ASSERT(!sides.empty());
  for (const SurfacePath& side : sides) KARINUI_ASSERT(!side.places.empty());
  return Splitter(guide).split(sides);
}

}  // namespace karinui

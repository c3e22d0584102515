#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "geometry/split_along.h"
#include "karinui/base/number.h"
#include "karinui/geometry/patch.h"

namespace karinui {
namespace {

// A part whose area is this many times that of the disk with its border's length is a bag. A cap of a ball reaches it
// when its rim is 70 degrees from its top; nothing one would cut from cloth in one piece does.
constexpr double kBag = 1.5;

double areaOf(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.points[t[0]];
  return 0.5 * length(cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a));
}

class Cutter {
 public:
  Cutter(const SplitMesh& split) : split_(split), mesh_(split.mesh), n_(split.loop.size()) {
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f)
      for (std::uint32_t k = 0; k < 3; ++k) face_[key(mesh_.faces[f][k], mesh_.faces[f][(k + 1) % 3])] = f;
    for (std::size_t i = 0; i < n_; ++i) cut_[edgeKey(split.loop[i], split.loop[(i + 1) % n_])] = true;
  }

  struct Region {
    std::vector<std::uint8_t> in;  // per face
    double area = 0;
    std::size_t faces = 0, rim = 0, holes = 0;  // rim: face sides on the cut; holes: face sides on nothing
    bool whole = false;                         // every step of the line, run this way, has it on its left
    bool together = false;                      // it hangs together
  };

  // Everything reached from the left of the line, run forwards or backwards, without crossing it.
  Region region(bool backwards) const {
    Region out;
    out.in.assign(mesh_.faces.size(), 0);
    std::vector<std::uint32_t> open;
    std::size_t first = 0;
    out.whole = true;
    for (std::size_t i = 0; i < n_; ++i) {
      const std::uint32_t f = leftFace(i, backwards);
      if (f == SurfaceGuide::kNone) {
        out.whole = false;
        continue;
      }
      if (!out.in[f]) {
        out.in[f] = 1;
        open.push_back(f);
        flood(open, out);
      }
      if (first == 0) first = out.faces;
    }
    out.together = first == out.faces && first > 0;
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      if (!out.in[f]) continue;
      out.area += areaOf(mesh_, mesh_.faces[f]);
    }
    return out;
  }

  bool disk(const Region& r) const { return r.whole && r.together && r.holes == 0 && r.rim == n_; }

  // The part as a mesh of its own: points are doubled where the line slits it.
  Result<Patch> extract(const Region& r, bool backwards) const {
    std::vector<std::uint32_t> root(mesh_.faces.size() * 3);
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](std::uint32_t c) {
      while (root[c] != c) c = root[c] = root[root[c]];
      return c;
    };
    const auto corner = [&](std::uint32_t f, std::uint32_t v) {
      const Triangle& t = mesh_.faces[f];
      return f * 3 + (t[0] == v ? 0u : t[1] == v ? 1u : 2u);
    };
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      if (!r.in[f]) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.faces[f][k], b = mesh_.faces[f][(k + 1) % 3];
        if (cut_.count(edgeKey(a, b))) continue;
        const auto other = face_.find(key(b, a));
        if (other == face_.end()) continue;
        for (std::uint32_t v : {a, b}) {
          const std::uint32_t x = find(corner(f, v)), y = find(corner(other->second, v));
          if (x != y) root[std::max(x, y)] = std::min(x, y);
        }
      }
    }
    Patch patch;
    std::unordered_map<std::uint32_t, std::uint32_t> named;
    const auto name = [&](std::uint32_t c) {
      const auto [it, fresh] = named.emplace(find(c), static_cast<std::uint32_t>(patch.mesh.points.size()));
      if (fresh) patch.mesh.points.push_back(mesh_.points[mesh_.faces[c / 3][c % 3]]);
      return it->second;
    };
    for (std::uint32_t f = 0; f < mesh_.faces.size(); ++f)
      if (r.in[f]) patch.mesh.faces.push_back({name(f * 3), name(f * 3 + 1), name(f * 3 + 2)});
    for (std::size_t i = 0; i < n_; ++i) {
      const std::size_t step = backwards ? n_ - 1 - i : i;
      const std::uint32_t start = split_.loop[backwards ? (step + 1) % n_ : step];
      patch.border.push_back(name(corner(leftFace(step, backwards), start)));
      patch.side.push_back(split_.side[step]);
    }
    patch.turned = backwards;
    const std::size_t corners = patch.mesh.points.size(), edges = (3 * patch.mesh.faces.size() + n_) / 2;
    if (corners + patch.mesh.faces.size() != edges + 1)
      return refused(
          say("What lies inside the line is not one whole sheet: the line touches itself, or there is a hole inside."));
    beginWithFirstSide(patch);
    return patch;
  }

  // Where the line comes back to a place it has passed without running back along itself.
  Error touching() const {
    std::unordered_map<std::uint32_t, std::size_t> seen;
    for (std::size_t i = 0; i < n_; ++i) {
      const auto [it, fresh] = seen.emplace(split_.loop[i], i);
      if (fresh) continue;
      return refused(say("The line crosses itself where its {0}. and {1}. side meet, {2} cm above the floor.",
                         std::size_t{split_.side[it->second]} + 1, std::size_t{split_.side[i]} + 1,
                         fixed(mesh_.points[split_.loop[i]].y * 100, 1)));
    }
    return refused(
        say("What lies inside the line is not one whole sheet: the line touches itself, or there is a hole inside."));
  }

  const SplitMesh& split() const { return split_; }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }
  static std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) { return key(std::min(a, b), std::max(a, b)); }

  std::uint32_t leftFace(std::size_t step, bool backwards) const {
    std::uint32_t a = split_.loop[step], b = split_.loop[(step + 1) % n_];
    if (backwards) std::swap(a, b);
    const auto it = face_.find(key(a, b));
    return it == face_.end() ? SurfaceGuide::kNone : it->second;
  }

  void flood(std::vector<std::uint32_t>& open, Region& out) const {
    while (!open.empty()) {
      const std::uint32_t f = open.back();
      open.pop_back();
      ++out.faces;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.faces[f][k], b = mesh_.faces[f][(k + 1) % 3];
        if (cut_.count(edgeKey(a, b))) {
          ++out.rim;
          continue;
        }
        const auto other = face_.find(key(b, a));
        if (other == face_.end()) {
          ++out.holes;
        } else if (!out.in[other->second]) {
          out.in[other->second] = 1;
          open.push_back(other->second);
        }
      }
    }
  }

  static void beginWithFirstSide(Patch& patch) {
    const std::size_t n = patch.border.size();
    std::size_t start = 0;
    while (start < n && !(patch.side[start] == 0 && patch.side[(start + n - 1) % n] != 0)) ++start;
    if (start < n) {
      std::rotate(patch.border.begin(), patch.border.begin() + static_cast<std::ptrdiff_t>(start), patch.border.end());
      std::rotate(patch.side.begin(), patch.side.begin() + static_cast<std::ptrdiff_t>(start), patch.side.end());
    }
    const std::uint32_t sides = *std::max_element(patch.side.begin(), patch.side.end()) + 1;
    patch.first.assign(sides, 0);
    for (std::size_t i = n; i-- > 0;)
      if (i == 0 || patch.side[i - 1] != patch.side[i]) patch.first[patch.side[i]] = static_cast<std::uint32_t>(i);
  }

  const SplitMesh& split_;
  const TriangleMesh& mesh_;
  std::size_t n_;
  std::unordered_map<std::uint64_t, std::uint32_t> face_;  // the face that runs a -> b; looked up, never walked through
  std::unordered_map<std::uint64_t, bool> cut_;
};

}  // namespace

double Patch::area() const {
  double sum = 0;
  for (const Triangle& t : mesh.faces) sum += areaOf(mesh, t);
  return sum;
}

double Patch::borderLength() const {
  double sum = 0;
  for (std::size_t i = 0; i < border.size(); ++i)
    sum += distance(mesh.points[border[i]], mesh.points[border[(i + 1) % border.size()]]);
  return sum;
}

double Patch::sideLength(std::uint32_t s) const {
  double sum = 0;
  for (std::size_t i = 0; i < border.size(); ++i)
    if (side[i] == s) sum += distance(mesh.points[border[i]], mesh.points[border[(i + 1) % border.size()]]);
  return sum;
}

Result<Patch> cutPatch(const SurfaceGuide& guide, std::span<const SurfacePath> sides,
                       const std::optional<SurfacePoint>& inside) {
  const auto split = splitAlong(guide, sides);
  if (!split) return split.error();
  const Cutter cutter(*split);
  const Cutter::Region parts[2] = {cutter.region(false), cutter.region(true)};

  int chosen = -1;
  if (inside) {
    // The face may have been split: any of its parts that lies wholly on one side will do, the nearest first.
    const Vec3 here = at(guide.mesh(), *inside);
    double nearest = 0;
    for (std::uint32_t f = 0; f < split->mesh.faces.size(); ++f) {
      if (split->parent[f] != inside->face) continue;
      const Triangle& t = split->mesh.faces[f];
      const Vec3 middle = (split->mesh.points[t[0]] + split->mesh.points[t[1]] + split->mesh.points[t[2]]) * (1.0 / 3);
      const double d = distance(middle, here);
      if (chosen >= 0 && d >= nearest) continue;
      // A slit part is reached from both sides of its slit; it is the one the whole line goes round.
      const int side = parts[0].in[f] && !(parts[1].in[f] && cutter.disk(parts[1])) ? 0 : parts[1].in[f] ? 1 : -1;
      if (side < 0) continue;
      chosen = side;
      nearest = d;
    }
    if (chosen < 0) return refused(say("The place that should lie inside the line does not lie within it."));
  } else {
    for (int side = 0; side < 2; ++side)
      if (cutter.disk(parts[side]) && (chosen < 0 || parts[side].area < parts[chosen].area)) chosen = side;
    if (chosen < 0) {
      for (int side = 0; side < 2; ++side)
        if (parts[side].whole && parts[side].together && parts[side].rim == split->loop.size() && parts[side].holes > 0)
          return refused(say("There is a hole in the body inside the line: no cloth can be taken from there."));
      return cutter.touching();
    }
  }
  const Cutter::Region& part = parts[chosen];
  if (part.holes > 0)
    return refused(say("There is a hole in the body inside the line: no cloth can be taken from there."));
  if (!cutter.disk(part)) return cutter.touching();

  auto patch = cutter.extract(part, chosen == 1);
  if (!patch) return patch;
  const double border = patch->borderLength(), area = patch->area();
  if (area > kBag * border * border / (4 * std::numbers::pi))
    return refused(
        say("The line goes round the body like a ring of {0} cm: what lies beyond is a bag, not a flat piece. Lead "
            "the line back along a seam, or draw two halves.",
            fixed(border * 100, 1)));
  return patch;
}

}  // namespace karinui

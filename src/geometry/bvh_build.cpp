#include "geometry/bvh_build.h"

#include <algorithm>
#include <array>

#include "karinui/base/result.h"

namespace karinui {
namespace {

constexpr std::uint32_t kLeafFaces = 4;
constexpr int kBins = 16;
constexpr std::size_t kHalveBeyond = 60;  // deeper than this, split in equal halves: 2^32 faces need 32 more levels

Vec3 middleOf(const Corners& c) { return (c[0] + c[1] + c[2]) * (1.0 / 3); }

double axisOf(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

double halfArea(const Box& box) {
  if (box.empty()) return 0;
  const Vec3 s = box.size();
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

void include(Box& box, const Box& other) {
  box.include(other.low);
  box.include(other.high);
}

Box boxOfFace(const BvhFace& f) {
  Box box;
  for (Vec3 p : f.corners) box.include(p);
  return box;
}

class Builder {
 public:
  explicit Builder(BvhArrays& out) : out_(out) {}

  void build(std::uint32_t begin, std::uint32_t end, std::size_t depth) {
    const std::size_t self = out_.nodes.size();
    out_.nodes.emplace_back();
    Box box, middles;
    for (std::uint32_t i = begin; i < end; ++i) {
      include(box, boxOfFace(out_.faces[i]));
      middles.include(middleOf(out_.faces[i].corners));
    }
    out_.nodes[self].box = box;
    if (end - begin <= kLeafFaces) {
      out_.nodes[self].first = begin;
      out_.nodes[self].count = end - begin;
      return;
    }
    const std::uint32_t split = depth < kHalveBeyond ? cheapestSplit(begin, end, middles) : halve(begin, end, middles);
    build(begin, split, depth + 1);
    out_.nodes[self].first = static_cast<std::uint32_t>(out_.nodes.size());
    build(split, end, depth + 1);
  }

 private:
  static int longestAxis(const Box& box) {
    const Vec3 s = box.size();
    return s.x >= s.y && s.x >= s.z ? 0 : s.y >= s.z ? 1 : 2;
  }

  std::uint32_t halve(std::uint32_t begin, std::uint32_t end, const Box& middles) {
    const int axis = longestAxis(middles);
    const std::uint32_t half = begin + (end - begin) / 2;
    std::nth_element(out_.faces.begin() + begin, out_.faces.begin() + half, out_.faces.begin() + end,
                     [&](const BvhFace& a, const BvhFace& b) {
                       const double x = axisOf(middleOf(a.corners), axis), y = axisOf(middleOf(b.corners), axis);
                       return x != y ? x < y : a.face < b.face;
                     });
    return half;
  }

  // The surface area heuristic over bins of the longest axis. Source: I. Wald, "On fast Construction of SAH-based
  // Bounding Volume Hierarchies", 2007.
  std::uint32_t cheapestSplit(std::uint32_t begin, std::uint32_t end, const Box& middles) {
    const int axis = longestAxis(middles);
    const double low = axisOf(middles.low, axis), extent = axisOf(middles.size(), axis);
    if (!(extent > 0)) return begin + (end - begin) / 2;
    const auto binOf = [&](const BvhFace& f) {
      const double x = (axisOf(middleOf(f.corners), axis) - low) / extent * kBins;
      return x > 0 ? std::min(static_cast<int>(std::fmin(x, kBins)), kBins - 1) : 0;  // not a number: the first bin
    };
    std::array<Box, kBins> boxes;
    std::array<std::uint32_t, kBins> counts{};
    for (std::uint32_t i = begin; i < end; ++i) {
      const int bin = binOf(out_.faces[i]);
      include(boxes[bin], boxOfFace(out_.faces[i]));
      ++counts[bin];
    }
    std::array<double, kBins> costBelow{};  // of everything in the bins before this one
    Box below;
    std::uint32_t number = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      costBelow[bin] = halfArea(below) * number;
      if (counts[bin]) include(below, boxes[bin]);
      number += counts[bin];
    }
    int best = 0;
    double bestCost = std::numeric_limits<double>::infinity();
    Box above;
    number = 0;
    for (int bin = kBins - 1; bin > 0; --bin) {
      if (counts[bin]) include(above, boxes[bin]);
      number += counts[bin];
      const double cost = costBelow[bin] + halfArea(above) * number;
      if (number > 0 && number < end - begin && cost < bestCost) {
        bestCost = cost;
        best = bin;
      }
    }
    if (best == 0) return halve(begin, end, middles);
    const auto split = std::stable_partition(out_.faces.begin() + begin, out_.faces.begin() + end,
                                             [&](const BvhFace& f) { return binOf(f) < best; });
    return static_cast<std::uint32_t>(split - out_.faces.begin());
  }

  BvhArrays& out_;
};

// Children follow their parent in the array, so one walk from the back has them ready.
void measureDipoles(BvhArrays& tree) {
  tree.dipoles.resize(tree.nodes.size());
  std::vector<double> area(tree.nodes.size(), 0.0);
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const BvhNode& node = tree.nodes[i];
    BvhDipole& dipole = tree.dipoles[i];
    Vec3 moment;
    const auto gather = [&](Vec3 centre, Vec3 areaNormal, double weight) {
      moment += centre * weight;
      area[i] += weight;
      dipole.areaNormal += areaNormal;
    };
    if (node.leaf()) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
        const Corners& c = tree.faces[k].corners;
        const Vec3 n = cross(c[1] - c[0], c[2] - c[0]) * 0.5;
        gather(middleOf(c), n, length(n));
      }
    } else {
      for (std::size_t child : {i + 1, std::size_t{node.first}})
        gather(tree.dipoles[child].centre, tree.dipoles[child].areaNormal, area[child]);
    }
    dipole.centre = area[i] > 0 ? moment * (1 / area[i]) : node.box.centre();
    const Vec3 far{std::fmax(node.box.high.x - dipole.centre.x, dipole.centre.x - node.box.low.x),
                   std::fmax(node.box.high.y - dipole.centre.y, dipole.centre.y - node.box.low.y),
                   std::fmax(node.box.high.z - dipole.centre.z, dipole.centre.z - node.box.low.z)};
    dipole.radius = length(far);
  }
}

}  // namespace

BvhArrays buildBvh(const TriangleMesh& mesh) {
  BvhArrays tree;
  if (mesh.faces.empty()) return tree;
  tree.faces.reserve(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f];
    for (std::uint32_t i : t) KARINUI_ASSERT(i < mesh.points.size());
    tree.faces.push_back({{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, f});
  }
  tree.nodes.reserve(mesh.faces.size());
  Builder(tree).build(0, static_cast<std::uint32_t>(mesh.faces.size()), 0);
  measureDipoles(tree);
  return tree;
}

}  // namespace karinui

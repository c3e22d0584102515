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

// Sorts numbers of faces; what is asked of a face at every level is found once.
class Builder {
 public:
  Builder(const std::vector<BvhFace>& faces, std::vector<BvhNode>& nodes)
      : nodes_(nodes), box_(faces.size()), middle_(faces.size()), order_(faces.size()), bin_(faces.size()) {
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      for (const Vec3 p : faces[f].corners) box_[f].include(p);
      middle_[f] = middleOf(faces[f].corners);
      order_[f] = f;
    }
  }
  const std::vector<std::uint32_t>& order() const { return order_; }  // that of the leaves

  void build(std::uint32_t begin, std::uint32_t end, std::size_t depth) {
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    Box box, middles;
    for (std::uint32_t i = begin; i < end; ++i) {
      include(box, box_[order_[i]]);
      middles.include(middle_[order_[i]]);
    }
    nodes_[self].box = box;
    if (end - begin <= kLeafFaces) {
      nodes_[self].first = begin;
      nodes_[self].count = end - begin;
      return;
    }
    const std::uint32_t split = depth < kHalveBeyond ? cheapestSplit(begin, end, middles) : halve(begin, end, middles);
    build(begin, split, depth + 1);
    nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
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
    std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = axisOf(middle_[a], axis), y = axisOf(middle_[b], axis);
                       return x != y ? x < y : a < b;
                     });
    return half;
  }

  // The surface area heuristic over bins of the longest axis. Source: I. Wald, "On fast Construction of SAH-based
  // Bounding Volume Hierarchies", 2007.
  std::uint32_t cheapestSplit(std::uint32_t begin, std::uint32_t end, const Box& middles) {
    const int axis = longestAxis(middles);
    const double low = axisOf(middles.low, axis), extent = axisOf(middles.size(), axis);
    if (!(extent > 0)) return begin + (end - begin) / 2;
    std::array<Box, kBins> boxes;
    std::array<std::uint32_t, kBins> counts{};
    for (std::uint32_t i = begin; i < end; ++i) {
      const double x = (axisOf(middle_[order_[i]], axis) - low) / extent * kBins;
      const int bin =
          x > 0 ? std::min(static_cast<int>(std::fmin(x, kBins)), kBins - 1) : 0;  // not a number: the first
      bin_[i] = static_cast<std::uint8_t>(bin);
      include(boxes[bin], box_[order_[i]]);
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
    std::uint32_t split = begin;
    above_.clear();
    for (std::uint32_t i = begin; i < end; ++i)  // each side in its order
      if (bin_[i] < best)
        order_[split++] = order_[i];
      else
        above_.push_back(order_[i]);
    std::copy(above_.begin(), above_.end(), order_.begin() + split);
    return split;
  }

  std::vector<BvhNode>& nodes_;
  std::vector<Box> box_;
  std::vector<Vec3> middle_;
  std::vector<std::uint32_t> order_, above_;
  std::vector<std::uint8_t> bin_;  // of the places in `order_`
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
  std::vector<BvhFace> faces;
  faces.reserve(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& t = mesh.faces[f];
    for (std::uint32_t i : t) KARINUI_ASSERT(i < mesh.points.size());
    faces.push_back({{mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, f});
  }
  tree.nodes.reserve(mesh.faces.size());
  Builder builder(faces, tree.nodes);
  builder.build(0, static_cast<std::uint32_t>(faces.size()), 0);
  tree.faces.reserve(faces.size());
  for (const std::uint32_t f : builder.order()) tree.faces.push_back(faces[f]);
  measureDipoles(tree);
  return tree;
}

}  // namespace karinui

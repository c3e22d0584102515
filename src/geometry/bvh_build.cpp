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

// A face while the tree is built, with all that is asked of it again and again.
struct Sorted {
  Box box;
  Vec3 middle;
  std::uint32_t face = 0;
  int bin = 0;  // of the node that is split
};

class Builder {
 public:
  Builder(BvhArrays& out, std::vector<Sorted>& faces) : out_(out), faces_(faces) {}

  void build(std::uint32_t begin, std::uint32_t end, std::size_t depth) {
    const std::size_t self = out_.nodes.size();
    out_.nodes.emplace_back();
    Box box, middles;
    for (std::uint32_t i = begin; i < end; ++i) {
      include(box, faces_[i].box);
      middles.include(faces_[i].middle);
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
    std::nth_element(faces_.begin() + begin, faces_.begin() + half, faces_.begin() + end,
                     [&](const Sorted& a, const Sorted& b) {
                       const double x = axisOf(a.middle, axis), y = axisOf(b.middle, axis);
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
    const auto binOf = [&](const Sorted& f) {
      const double x = (axisOf(f.middle, axis) - low) / extent * kBins;
      return x > 0 ? std::min(static_cast<int>(std::fmin(x, kBins)), kBins - 1) : 0;  // not a number: the first bin
    };
    std::array<Box, kBins> boxes;
    std::array<std::uint32_t, kBins> counts{};
    for (std::uint32_t i = begin; i < end; ++i) {
      const int bin = faces_[i].bin = binOf(faces_[i]);
      include(boxes[bin], faces_[i].box);
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
    aside_.clear();
    std::uint32_t split = begin;
    for (std::uint32_t i = begin; i < end; ++i)
      if (faces_[i].bin < best)
        faces_[split++] = faces_[i];
      else
        aside_.push_back(faces_[i]);
    std::copy(aside_.begin(), aside_.end(), faces_.begin() + split);
    return split;
  }

  BvhArrays& out_;
  std::vector<Sorted>& faces_;
  std::vector<Sorted> aside_;
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
  std::vector<Sorted> sorted(mesh.faces.size());
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::uint32_t i : mesh.faces[f]) KARINUI_ASSERT(i < mesh.points.size());
    const Corners corners = cornersOf(mesh, mesh.faces[f]);
    for (const Vec3 p : corners) sorted[f].box.include(p);
    sorted[f].middle = middleOf(corners);
    sorted[f].face = f;
  }
  tree.nodes.reserve(mesh.faces.size());
  Builder(tree, sorted).build(0, static_cast<std::uint32_t>(mesh.faces.size()), 0);
  tree.faces.reserve(mesh.faces.size());
  for (const Sorted& one : sorted) tree.faces.push_back({cornersOf(mesh, mesh.faces[one.face]), one.face});
  measureDipoles(tree);
  return tree;
}

}  // namespace karinui

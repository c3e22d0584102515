#include "cloth/flat_folds.h"

#include <algorithm>

#include "cloth/cloth_topology.h"
#include "cloth/intersection_contour.h"

namespace karinui {
namespace {

constexpr int kSmoothings = 20;  // of averages: a knot is some ten nodes wide

}  // namespace

std::vector<Vec3> withFlatFolds(const DetailTransfer& detail, const Cloth& fine, const Cloth& coarse,
                                std::span<const Vec3> places, Workers& workers) {
  std::vector<double> share(fine.nodeCount, 1);
  IntersectionContour contour(fine), coarseContour(coarse);
  std::vector<Vec3> out = detail.at(places, share, workers);
  contour.find(out, workers);
  if (contour.crossings() == 0) return out;
  coarseContour.find(places, workers);

  std::vector<std::uint32_t> flat, kept;
  for (std::uint32_t k = 0; k < share.size(); ++k) {
    const auto& around = detail.around(k);
    if (std::any_of(around.begin(), around.end(), [&](std::uint32_t n) { return coarseContour.near()[n] != 0; }))
      kept.push_back(k);
    else if (contour.near()[k] != 0)
      flat.push_back(k);
  }
  const auto beside = neighboursOf(fine);
  const auto give = [&](const std::vector<std::uint32_t>& nodes, double own) {  // half way to it beside them
    for (const std::uint32_t k : nodes)
      for (const std::uint32_t n : beside[k]) share[n] = own < 0.5 ? std::min(share[n], 0.5) : std::max(share[n], 0.5);
    for (const std::uint32_t k : nodes) share[k] = own;
  };
  give(flat, 0);
  give(kept, 1);
  return detail.at(places, share, workers);
}

std::vector<Vec3> withKnotsSmoothed(const Cloth& cloth, std::vector<Vec3> places, Workers& workers) {
  IntersectionContour contour(cloth);
  contour.find(places, workers);
  const auto beside = neighboursOf(cloth);
  std::vector<Vec3> next = places;
  for (int round = 0; round < kSmoothings; ++round) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (contour.near()[k] == 0 || beside[k].empty()) continue;
      Vec3 sum;
      for (const std::uint32_t n : beside[k]) sum += places[n];
      next[k] = sum * (1.0 / static_cast<double>(beside[k].size()));
    }
    places = next;
  }
  return places;
}

}  // namespace karinui

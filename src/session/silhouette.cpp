#include "karinui/session/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "karinui/cloth/drape_disc.h"

namespace karinui {

namespace {

constexpr int kLeastApart = 24;         // of 255: cloth and ground that are nearer to each other are not told apart
constexpr double kLeastCovered = 0.02;  // of the picture

using Histogram = std::array<std::size_t, 256>;

int medianOf(const Histogram& counts) {
  std::size_t all = 0, below = 0;
  for (const std::size_t count : counts) all += count;
  int value = 0;
  while (value < 255 && 2 * (below += counts[static_cast<std::size_t>(value)]) < all) ++value;
  return value;
}

// The ground: the median of each channel along the picture's edge.
std::array<int, 3> groundOf(const PrintPixels& image) {
  std::array<Histogram, 3> counts{};
  const int band = std::max(1, std::min(image.width, image.height) / 50);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (std::min({x, y, image.width - 1 - x, image.height - 1 - y}) >= band) continue;
      const auto at =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
      for (std::size_t c = 0; c < 3; ++c) ++counts[c][image.rgb[at + c]];
    }
  return {medianOf(counts[0]), medianOf(counts[1]), medianOf(counts[2])};
}

// Between two heaps of values, where the variance within each is least (Otsu 1979); and how far apart their means are.
struct Threshold {
  int value = 0;
  double apart = 0;
};
Threshold thresholdOf(const std::vector<std::uint8_t>& values) {
  Histogram counts{};
  for (const std::uint8_t v : values) ++counts[v];
  double all = 0, sum = 0;
  for (std::size_t v = 0; v < 256; ++v)
    all += static_cast<double>(counts[v]), sum += static_cast<double>(v * counts[v]);
  Threshold best;
  double low = 0, lowSum = 0, most = -1;
  for (std::size_t v = 0; v < 255; ++v) {
    low += static_cast<double>(counts[v]), lowSum += static_cast<double>(v * counts[v]);
    if (low == 0 || low == all) continue;
    const double apart = (sum - lowSum) / (all - low) - lowSum / low, between = low * (all - low) * apart * apart;
    if (between > most) most = between, best = {static_cast<int>(v), apart};
  }
  return best;
}

// Pixels of one kind that hang together with one of them; each is marked as taken.
std::vector<std::size_t> connected(std::size_t from, std::size_t width, const std::vector<std::uint8_t>& cloth,
                                   std::vector<std::uint8_t>& taken) {
  std::vector<std::size_t> all{from};
  taken[from] = 1;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::size_t at = all[k], x = at % width;
    const auto add = [&](bool there, std::size_t next) {
      if (there && !taken[next] && cloth[next] == cloth[from]) taken[next] = 1, all.push_back(next);
    };
    add(x > 0, at - 1), add(x + 1 < width, at + 1);
    add(at >= width, at - width), add(at + width < cloth.size(), at + width);
  }
  return all;
}

}  // namespace

Result<double> coveredShare(const PrintPixels& image) {
  const auto width = static_cast<std::size_t>(image.width), count = width * static_cast<std::size_t>(image.height);
  if (count == 0 || image.rgb.size() != 3 * count)
    return badInput(say("There is nothing in this photograph; choose another."));
  const std::array<int, 3> ground = groundOf(image);
  std::vector<std::uint8_t> away(count);
  for (std::size_t k = 0; k < count; ++k) {
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) sum += std::pow(image.rgb[3 * k + c] - ground[c], 2);
    away[k] = static_cast<std::uint8_t>(std::min(255.0, std::sqrt(sum)));
  }
  const Threshold threshold = thresholdOf(away);
  if (threshold.apart < kLeastApart)
    return badInput(
        say("Cloth and ground can hardly be told apart in the photograph; lay the cloth on a plain ground of another "
            "colour."));
  std::vector<std::uint8_t> cloth(count), taken(count);
  std::transform(away.begin(), away.end(), cloth.begin(),
                 [&](std::uint8_t v) { return static_cast<std::uint8_t>(v > threshold.value); });
  // What is largest on the ground is the cloth; what of the ground does not reach the edge is light on it.
  std::vector<std::size_t> largest;
  for (std::size_t k = 0; k < count; ++k)
    if (cloth[k] && !taken[k])
      if (auto part = connected(k, width, cloth, taken); part.size() > largest.size()) largest = std::move(part);
  std::fill(cloth.begin(), cloth.end(), std::uint8_t{0});
  const auto atEdge = [&](std::size_t k) {
    const std::size_t x = k % width;
    return x == 0 || x + 1 == width || k < width || k + width >= count;
  };
  for (const std::size_t k : largest) {
    if (atEdge(k)) return badInput(say("The cloth reaches the edge of the photograph; take it from higher up."));
    cloth[k] = 1;
  }
  std::fill(taken.begin(), taken.end(), std::uint8_t{0});
  std::size_t bare = 0;
  for (std::size_t k = 0; k < count; ++k)
    if (atEdge(k) && !taken[k]) bare += connected(k, width, cloth, taken).size();
  const double share = static_cast<double>(count - bare) / static_cast<double>(count);
  if (share < kLeastCovered) return badInput(say("There is hardly any cloth in the photograph; take it from nearer."));
  return share;
}

Result<double> drapeOfPhotographs(const PrintPixels& flat, const PrintPixels& draped) {
  if (flat.width != draped.width || flat.height != draped.height)
    return badInput(
        say("The photographs are {0} by {1} and {2} by {3} pixels; take both with the same camera from the same place.",
            flat.width, flat.height, draped.width, draped.height));
  const auto whole = coveredShare(flat);
  if (!whole) return whole.error();
  const auto hanging = coveredShare(draped);
  if (!hanging) return hanging.error();
  return drapeCoefficient(*whole, *hanging);
}

}  // namespace karinui

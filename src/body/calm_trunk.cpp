#include <algorithm>
#include <cmath>

#include "body/figure.h"

namespace karinui {

namespace {

constexpr double kHarmonic = 6.0;  // above, the waves of a section are damped
constexpr double kFade = 0.03;     // of the height: so far below the bust the breast ends
constexpr int kRounds = 4;

}  // namespace

void calmTrunk(Figure& figure) {
  auto& station = figure.torso.station;
  const Harmonics harmonics = figure.torso.harmonics;
  const auto stood = torsoSections(figure);
  std::vector<double> share, girth;  // how much a section is evened
  for (const Section& s : stood) {
    const double off = std::max(figure.at.bust - kFade * figure.at.crown - s.centre.y, 0.0) / (kFade * figure.at.crown);
    share.push_back(1 - std::exp(-off * off));
    girth.push_back(hullGirth(s.shape, harmonics));
  }
  for (std::size_t i = 0; i < station.size(); ++i)
    for (int k = 2; k <= harmonics.count; ++k)
      station[i].shape[k] *= std::lerp(1.0, std::exp(-std::pow(k / kHarmonic, 4)), share[i]);
  for (int round = 0; round < kRounds; ++round) {
    const auto before = station;
    for (std::size_t i = 1; i + 1 < station.size(); ++i) {
      const double below = stood[i].centre.y - stood[i - 1].centre.y, above = stood[i + 1].centre.y - stood[i].centre.y;
      const double t = below / (below + above), w = 0.5 * share[i];
      for (int k = 3; k <= harmonics.count; ++k) {  // k below 3: breadth, depth and where the middle lies
        const auto shape = [&](std::size_t j) { return before[j].shape[k] / before[j].shape[0]; };
        station[i].shape[k] += w * (std::lerp(shape(i - 1), shape(i + 1), t) - shape(i)) * before[i].shape[0];
      }
    }
  }
  for (std::size_t i = 0; i < station.size(); ++i) {
    if (share[i] == 0) continue;  // bit for bit as it was
    const double back = girth[i] / hullGirth(station[i].shape, harmonics);
    for (double& c : station[i].shape) c *= back;
  }
}

}  // namespace karinui

#include "karinui/cloth/settle.h"

#include <algorithm>
#include <cmath>

#include "cloth/cascade.h"
#include "cloth/flat_piece.h"
#include "cloth/input_check.h"
#include "cloth/strain.h"
#include "cloth/tie_map.h"

namespace karinui {
namespace {

constexpr double kNear = 0.1;     // metres: one no farther is drawn together where it is, if no more of the pairs
constexpr double kFew = 1.0 / 3;  // than this are open

bool anyLive(const Cloth& cloth) {
  return std::any_of(cloth.pieces.begin(), cloth.pieces.end(), [](const ClothPiece& p) { return p.live; });
}

// Whether the finest level already stands formed, and sewn but for a few pairs that are near each other: then coarser
// levels are not needed.
bool standsFormed(const ClothLevel& finest) {
  const std::vector<Vec3>& x = finest.state.position;
  const std::vector<double> gaps = liveGaps(finest.cloth, x);
  const auto wider = [&](double than) {
    return static_cast<double>(std::count_if(gaps.begin(), gaps.end(), [&](double gap) { return !(gap <= than); }));
  };
  if (wider(kNear) > 0 || wider(kSewn * finest.cloth.spacing) > kFew * static_cast<double>(gaps.size())) return false;
  return std::none_of(finest.cloth.pieces.begin(), finest.cloth.pieces.end(),
                      [&](const ClothPiece& piece) { return piece.live && normalWhereFlat(piece, x); });
}

}  // namespace

Result<SettleReport> settle(std::vector<ClothLevel>& levels, const ColliderList& colliders,
                            const SettleSettings& settings, const Token& token, Workers& workers,
                            const SettleWatcher& watcher) {
  if (levels.empty()) return badInput(say("There is no cloth to drape."));
  for (const ClothLevel& level : levels)
    if (const auto fine = checkLevel(level); !fine) return fine.error();
  if (const auto fine = checkSettings(settings); !fine) return fine.error();
  if (token.cancelled()) return cancelled();

  ClothLevel& finest = levels.back();
  if (!anyLive(finest.cloth)) {
    const ResourceUse spent;
    SettleReport report;
    report.settled = true;
    report.why = say("No piece is live; nothing was moved.");
    report.seamGap = widestGap(finest.cloth, finest.state.position);
    report.strain = strainOf(finest.cloth, finest.state.position);
    spent.tell(report);
    return report;
  }
  Cascade cascade(levels, colliders, settings, token, workers, watcher);
  std::optional<CascadeStart> start = CascadeStart{!settings.fromCoarsest && standsFormed(finest)};
  while (start) {
    auto anew = cascade.descend(*start);
    if (!anew) return anew.error();
    start = *anew;
  }
  finest.state.position = std::move(cascade.positions);
  return std::move(cascade.report);
}

}  // namespace karinui

#include "session/standing_buttons.h"

namespace karinui {

StandingPlace standing(const Document& document, const FasteningPlace& at) {
  const Stand stand(*document.find(at.piece));
  const Vec3 place = stand(at.place), in = stand(at.place - at.outward * 1e-3);
  return {place, normalized(place - in),
          normalized(stand(at.place + leftOf(at.outward) * 1e-3 - at.outward * 1e-3) - in)};
}

std::vector<StandingButton> standingButtons(const Document& document) {
  std::vector<StandingButton> all;
  for (const auto& [name, own] : document.allowances.fastenings) {
    if (own.kind != FasteningKind::Button && own.kind != FasteningKind::Snap) continue;
    for (const FastenedPlaces& pair : placesOf(document.pattern, own)) {
      const StandingPlace at = standing(document, pair.closed ? pair.a : pair.b);
      all.push_back({name, pair.a.piece, pair.b.piece, own.kind, at.place, at.out, at.along, own.size});
    }
  }
  return all;
}

}  // namespace karinui

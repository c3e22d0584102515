#pragma once
// Where the buttons and snaps of a garment lie as it stands.
#include <string>
#include <vector>

#include "karinui/design/document.h"

namespace karinui {

struct StandingButton {
  std::string fastening;  // its name
  PieceId over, under;    // the pieces it holds together
  FasteningKind kind = FasteningKind::Button;
  Vec3 place, out, along;                                    // on the cloth; unit: towards the edge, along it
  double size = 0;                                           // metres across
  Vec3 up() const { return normalized(cross(out, along)); }  // away from the cloth
};
// In the order of the fastenings. A button that is closed lies in its buttonhole.
std::vector<StandingButton> standingButtons(const Document& document);

// A place of a fastening as it stands.
struct StandingPlace {
  Vec3 place, out, along;
};
StandingPlace standing(const Document& document, const FasteningPlace& at);

}  // namespace karinui

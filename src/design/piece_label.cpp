#include "karinui/design/piece_label.h"

#include "karinui/design/glossary.h"

namespace karinui {

std::vector<Message> labelOf(const Piece& piece) {
  return {nameSaid(piece.name), say("Cut 1 · {0}", nameSaid(piece.fabric))};
}

}  // namespace karinui

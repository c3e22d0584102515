#pragma once
// How sentences name an edge and a seam.
#include <string>

#include "karinui/design/document.h"
#include "karinui/design/values.h"

namespace karinui {

inline std::string spoken(const Document& document, const EdgeRef& ref) {  // its piece is there
  return document.find(ref.piece.id)->name + "." + ref.edge;
}
inline std::string spoken(const Seam& seam) { return seam.name.empty() ? text(seam.id) : seam.name; }

}  // namespace karinui

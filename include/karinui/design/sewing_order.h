#pragma once
// In which order a garment is sewn, from its pieces and seams alone. What is sewn within a piece or onto it comes
// first, while it lies flat; then pieces are joined, the shorter seams first; what closes a tube comes after what
// joins, and narrow pieces such as bands, cuffs and collars last. No seam is sewn over a place where two pieces do not
// meet yet. Pure; any thread.
#include <vector>

#include "karinui/design/document.h"

namespace karinui {

struct SewingStep {
  std::vector<std::size_t> seams;  // their numbers on the paper (seamTags); none for what is no seam
  Message words;
};
// Empty where nothing is sewn.
std::vector<SewingStep> sewingOrder(const Document& document);

}  // namespace karinui

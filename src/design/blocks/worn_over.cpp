// A block over what the figure wears already.
#include <algorithm>
#include <string_view>
#include <vector>

#include "karinui/design/block_numbers.h"
#include "karinui/design/glossary.h"

namespace karinui {

namespace {

std::vector<std::string_view> blockPieces(DraftBlock::Kind kind) {
  switch (kind) {
    case DraftBlock::Kind::Bodice:
      return {"front", "back"};
    case DraftBlock::Kind::Shirt:
      return {"front_left", "front_right", "back", "sleeve_left", "sleeve_right", "collar"};
    case DraftBlock::Kind::Sleeve:
      return {"sleeve_left", "sleeve_right"};
    case DraftBlock::Kind::Collar:
      return {"collar"};
    case DraftBlock::Kind::Skirt:
      return {"skirt_front", "skirt_back"};
    case DraftBlock::Kind::Trousers:
    case DraftBlock::Kind::Leggings:
      return {"leg_front_left", "leg_front_right", "leg_back_left", "leg_back_right"};
  }
  return {};
}

std::string overPrefix(DraftBlock::Kind kind) {
  if (kind == DraftBlock::Kind::Shirt) return "coat";
  return kind == DraftBlock::Kind::Bodice ? "vest" : "outer";
}

}  // namespace

std::string takenBy(const Document& document, const DraftBlock& block) {
  for (const std::string_view name : blockPieces(block.kind)) {
    const std::string whole = (block.prefix.empty() ? "" : block.prefix + "_") + std::string(name);
    if (document.pieceNamed(whole)) return whole;
  }
  return {};
}

DraftBlock wornOver(const Document& document, DraftBlock block) {
  constexpr int kOutermost = 20;
  if (!block.prefix.empty() || takenBy(document, block).empty()) return block;
  block.prefix = overPrefix(block.kind);
  for (int k = 2; !takenBy(document, block).empty(); ++k) block.prefix = overPrefix(block.kind) + std::to_string(k);
  int layer = 0;
  for (const auto& [id, piece] : document.pattern.pieces) {
    layer = std::max(layer, piece->layer + 1);
    block.over = block.over || piece->form;
  }
  if (block.layer == 0) block.layer = std::min(layer, kOutermost);
  return block;
}

Message wornOverSaid(const DraftBlock& block) {
  const std::string first = block.prefix + "_" + std::string(blockPieces(block.kind).front());
  return say("It is worn over what is there, in layer {0}; its pieces are called “{1}” and so on.", block.layer,
             nameSaid(first));
}

}  // namespace karinui

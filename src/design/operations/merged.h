#pragma once
#include "design/operations/operations.h"

namespace karinui {

// Both pieces of a merge as one. `likewise`: the merged piece whose symmetric copy this becomes, if it is to be one.
// `minted`: seams the operation has made before, counted on. `led`: cloth that stands elsewhere is led along the edge;
// otherwise it stays where it stands, as on both sides of an open dart.
Result<Document> merged(const Document& before, const MergePieces& op, const Piece* likewise, std::uint32_t& minted,
                        const Context& context, bool led = true);
// Whether edges are there that can be merged, as merge itself would say; the references are completed.
Done resolveRuns(const Document& before, MergePieces& op, const Context& context);

}  // namespace karinui

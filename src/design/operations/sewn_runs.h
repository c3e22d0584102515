#pragma once
// Runs of edges and internal lines that something is sewn to.
#include <vector>

#include "design/operations/operations.h"

namespace karinui {

// An internal line can be sewn to, as an edge can. Null: it is an edge, or not there.
const InternalLine* lineOf(const Document& document, const EdgeRef& ref);
Done resolveSewn(const Document& before, EdgeRef& ref);
// With the internal lines that are sewn to as one curve each, as a seam needs them.
Document withOneCurve(Document document, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b);
std::vector<EdgeSpan> spansOf(const std::vector<EdgeRef>& refs);
std::vector<EdgeRef> refsOf(const std::vector<EdgeSpan>& spans);

}  // namespace karinui

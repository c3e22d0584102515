#pragma once
// Our own exact text of a paper pattern, `karinui-pattern-1` (docs/format/pattern-json.md): every curve, seam, mark and
// placement, in metres, with numbers that read back as the same doubles. Pure; any thread.
#include <map>
#include <string>
#include <string_view>

#include "karinui/base/result.h"
#include "karinui/cloth/fabric.h"
#include "karinui/pattern/allowance.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// `allowances`: of each edge, told beside the outlines; null: nothing is told of them. `fabrics`: by name; those that
// pieces are cut from are told.
std::string writePatternJson(const Pattern& pattern, const AllowancePlan* allowances = nullptr,
                             const std::map<std::string, Fabric>& fabrics = {});

// Refuses what cannot be a pattern, naming the piece or seam: open or crossing outlines, names twice, seams to nothing.
// `allowances`: where to put the widths that are told of edges and are not as usual; null: nowhere. `fabrics`: where to
// put those that are told.
Result<Pattern> readPatternJson(std::string_view json, Allowances* allowances = nullptr,
                                std::map<std::string, Fabric>* fabrics = nullptr);

}  // namespace karinui

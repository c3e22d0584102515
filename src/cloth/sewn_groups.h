#pragma once
// The nodes that move as one because they are sewn together, and those that do not move.
#include "cloth/energy.h"
#include "cloth/tie_map.h"

namespace karinui {

struct SewnGroups {
  std::vector<std::vector<NodeIndex>> groups;  // of two nodes or more
  std::vector<std::uint32_t> groupOf;          // per node; kNoNode: it is in none
  std::vector<std::uint8_t> held;              // per node: it does not move

  SewnGroups() = default;
  SewnGroups(const TieMap& ties, std::size_t nodeCount) : groupOf(nodeCount, kNoNode), held(nodeCount, 0) {
    for (NodeIndex k = 0; k < nodeCount; ++k) held[k] = ties.terms(k).empty() ? 1 : 0;
    for (const auto& members : ties.groups()) {
      if (members.size() < 2) continue;
      for (NodeIndex k : members) groupOf[k] = static_cast<std::uint32_t>(groups.size());
      groups.push_back(members);
    }
  }
};

}  // namespace karinui

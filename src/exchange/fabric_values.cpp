#include "fabric_values.h"

#include <set>

namespace karinui {

std::string_view lawName(Fabric::Law law) { return law == Fabric::Law::Simcloth ? "simcloth" : "woven"; }

bool lawNamed(std::string_view name, Fabric::Law& law) {
  for (const Fabric::Law one : {Fabric::Law::Woven, Fabric::Law::Simcloth})
    if (lawName(one) == name) return law = one, true;
  return false;
}

std::vector<const Fabric*> fabricsOf(const Pattern& pattern, const std::map<std::string, Fabric>& known) {
  std::set<std::string> names;
  for (const auto& [id, piece] : pattern.pieces) names.insert(piece->fabric);
  std::vector<const Fabric*> all;
  for (const std::string& name : names)
    if (const auto at = known.find(name); at != known.end()) all.push_back(&at->second);
  return all;
}

}  // namespace karinui

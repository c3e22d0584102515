#include "kept_lattices.h"

#include <algorithm>

namespace karinui {

std::shared_ptr<const Lattice> KeptLattices::find(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& one) { return one.first == name; });
  if (found == kept_.end()) return nullptr;
  std::rotate(kept_.begin(), found, found + 1);
  return kept_.front().second;
}

void KeptLattices::keep(std::string name, std::shared_ptr<const Lattice> lattice) {
  const std::lock_guard lock(mutex_);
  nodes_ += lattice->nodes.size();
  kept_.emplace_front(std::move(name), std::move(lattice));
  while (nodes_ > room_) {
    nodes_ -= kept_.back().second->nodes.size();
    kept_.pop_back();
  }
}

KeptLattices& keptLattices() {
  static KeptLattices kept(200'000);  // some 15 MB
  return kept;
}

}  // namespace karinui

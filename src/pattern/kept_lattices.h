#pragma once
// The lattices laid last. Most looks at a garment ask for the very pieces the look before asked for, in another place
// or another state of drape; only what was cut anew is laid anew. What is kept never shows but in time: a lattice is
// found by the bits of all it is made from. Any thread.
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "karinui/pattern/lattice.h"

namespace karinui {

class KeptLattices {
 public:
  explicit KeptLattices(std::size_t nodesInAll) : room_(nodesInAll) {}
  std::shared_ptr<const Lattice> find(const std::string& name);  // null: not kept
  void keep(std::string name, std::shared_ptr<const Lattice> lattice);

 private:
  const std::size_t room_;  // nodes of all lattices kept
  std::mutex mutex_;
  std::deque<std::pair<std::string, std::shared_ptr<const Lattice>>> kept_;  // last asked for first
  std::size_t nodes_ = 0;
};

KeptLattices& keptLattices();

}  // namespace karinui

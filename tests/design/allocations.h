#pragma once
// The heap of the test program: what is in use, and allocations that fail on purpose. Replaces operator new; SQLite's
// allocations ask too, where a test has it so.
#include <atomic>
#include <cstddef>

namespace karinui {

struct MemoryShortage {
  std::atomic<bool> on{false};
  std::atomic<long> asked{0};  // while it was on
  long from = 0, to = 0;       // these are not given
  bool strikes();
};
MemoryShortage& shortage();

// Bytes that operator new gave and were not given back.
std::ptrdiff_t bytesInUse();

}  // namespace karinui

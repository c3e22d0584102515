#include "design/allocations.h"

#include <malloc.h>

#include <cstdlib>
#include <new>

namespace karinui {
namespace {
std::atomic<std::ptrdiff_t> inUse{0};
}  // namespace

bool MemoryShortage::strikes() {
  if (!on) return false;
  const long n = ++asked;
  return n >= from && n <= to;
}

MemoryShortage& shortage() {
  static MemoryShortage one;
  return one;
}

std::ptrdiff_t bytesInUse() { return inUse; }

}  // namespace karinui

void* operator new(std::size_t size) {
  void* memory = karinui::shortage().strikes() ? nullptr : std::malloc(size == 0 ? 1 : size);
  if (!memory) throw std::bad_alloc();
  karinui::inUse.fetch_add(static_cast<std::ptrdiff_t>(::malloc_usable_size(memory)), std::memory_order_relaxed);
  return memory;
}
// As the standard library has it; a sanitizer would bring its own, whose memory free() must not be given.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept {
  if (memory)
    karinui::inUse.fetch_sub(static_cast<std::ptrdiff_t>(::malloc_usable_size(memory)), std::memory_order_relaxed);
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }

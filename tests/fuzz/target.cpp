// One reader under libFuzzer; which one is told by the build (tests/fuzz/CMakeLists.txt).
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const karinui::test::FuzzedReader* const reader = [] {
    for (const auto& one : karinui::test::fuzzedReaders())
      if (one.name == KARINUI_FUZZED) return &one;
    std::abort();
  }();
  reader->read({reinterpret_cast<const char*>(data), size});
  return 0;
}

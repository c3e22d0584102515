#pragma once
// The readers of strangers' files, each as a function of bytes that must return, whatever the bytes are. What a reader
// accepts must be as its header promises, and must go through everything that an import does with it.
#include <span>
#include <string>
#include <string_view>

namespace karinui::test {

struct FuzzedReader {
  std::string_view name;    // of its target, fuzz_NAME
  std::string_view corpus;  // its folder in tests/fuzz/corpus
  void (*read)(std::string_view bytes);
};
std::span<const FuzzedReader> fuzzedReaders();

}  // namespace karinui::test

#include "karinui/base/threads.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <thread>

namespace karinui {

int usualThreads() {
  const char* set = std::getenv("KARINUI_THREADS");
  const std::string_view text = set ? set : "";
  int number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec == std::errc() && read.ptr == text.data() + text.size() && number >= 1 && number <= 256) return number;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace karinui

// A program of somebody else's: plays a script and tells what it came to.
#include <cstdio>
#include <fstream>
#include <iterator>

#include "karinui/design/history.h"
#include "karinui/design/script.h"

int main(int, char** words) {
  std::ifstream file(words[1]);
  const std::string script{std::istreambuf_iterator<char>(file), {}};
  const auto read = karinui::parseScript(script);
  if (!read) return std::puts(text(read.error().what).c_str()), 1;
  std::printf("%zu operations\n", read->size());
}

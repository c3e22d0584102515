#pragma once
// A list in order, each value in it once.
#include <algorithm>

namespace karinui {

template <class List>
void sortOnce(List& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace karinui

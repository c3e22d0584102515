#pragma once
// Delta debugging (Zeller and Hildebrandt 2002): the few lines of a failing script that it takes to fail.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace karinui {

using Lines = std::vector<std::string>;

// `fails(lines)` must hold. The result fails too, and no longer does when any one line is taken out.
inline Lines shrunk(Lines lines, const std::function<bool(const Lines&)>& fails) {
  for (std::size_t chunk = std::max<std::size_t>(1, lines.size() / 2);;) {
    bool less = false;
    for (std::size_t from = 0; from < lines.size();) {
      Lines fewer(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(from));
      const std::size_t to = std::min(lines.size(), from + chunk);
      fewer.insert(fewer.end(), lines.begin() + static_cast<std::ptrdiff_t>(to), lines.end());
      if (fails(fewer))
        lines = std::move(fewer), less = true;
      else
        from = to;
    }
    if (chunk == 1 && !less) return lines;
    if (!less || chunk > lines.size()) chunk = std::max<std::size_t>(1, chunk / 2);
  }
}

}  // namespace karinui

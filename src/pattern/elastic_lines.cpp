#include "karinui/pattern/elastic_lines.h"

namespace karinui {

Pattern withElasticLines(Pattern pattern, const Allowances& finish) {
  std::uint64_t id = std::uint64_t{1} << 63;  // below those of zips, above any document's
  for (const auto& [at, elastic] : finish.elastics) {
    const auto piece = pattern.pieces.find(at.first);
    if (piece == pattern.pieces.end() || findEdge(*piece->second, at.second) || !findCurve(*piece->second, at.second))
      continue;
    Seam seam;
    seam.id = {id++};
    seam.a = seam.b = {{at.first, at.second, 0, 1}};
    seam.reversed = false;
    pattern.seams[seam.id] = std::move(seam);
  }
  return pattern;
}

}  // namespace karinui

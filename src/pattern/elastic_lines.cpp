#include "karinui/pattern/elastic_lines.h"

#include <limits>

#include "karinui/geometry/polygon.h"

namespace karinui {

std::string elasticRowName(const std::string& edge, int row) { return edge + "_row_" + std::to_string(row); }

ElasticRows elasticRows(const Piece& piece, const std::string& edge, const Allowances& finish) {
  ElasticRows rows;
  for (int row = 2; row <= kMostRows; ++row)
    if (finish.elastics.contains({piece.id, elasticRowName(edge, row)})) rows.count = row;
  const auto own = findCurve(piece, edge), second = findCurve(piece, elasticRowName(edge, 2));
  if (rows.count == 1 || !own || !second) return rows;
  const std::vector<Flat> points = own->flattened(1e-4);
  rows.spacing = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    rows.spacing = std::min(rows.spacing, distanceToSegment(points[k], points[k + 1], second->atFraction(0.5)));
  return rows;
}

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

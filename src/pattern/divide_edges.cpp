#include "divide_edges.h"

#include <algorithm>

namespace karinui {

std::set<std::string> edgeNames(const Piece& piece) {
  std::set<std::string> names;
  for (const Edge& edge : piece.outline.edges) names.insert(edge.name);
  for (const Outline& hole : piece.holes)
    for (const Edge& edge : hole.edges) names.insert(edge.name);
  return names;
}

std::string freeName(const std::string& name, std::set<std::string>& taken) {
  // Of "hem_2" the next is "hem_3": a number is counted on, not given one of its own.
  std::size_t digits = name.size();
  while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9') --digits;
  const bool numbered = digits > 1 && digits < name.size() && name[digits - 1] == '_';
  const std::string stem = numbered ? name.substr(0, digits - 1) : name;
  std::string made = name;
  for (int k = 2; !taken.insert(made).second; ++k) made = stem + "_" + std::to_string(k);
  return made;
}

void divideEdges(Outline& outline, std::vector<EdgePlace> places, std::set<std::string> taken, PieceId piece,
                 EdgeMap& map) {
  std::sort(places.begin(), places.end(),
            [](EdgePlace a, EdgePlace b) { return std::pair(a.edge, a.t) < std::pair(b.edge, b.t); });
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < outline.edges.size(); ++k) {
    const Edge& old = outline.edges[k];
    std::vector<double> cuts{0};
    for (EdgePlace p : places)
      if (p.edge == k) cuts.push_back(p.t);
    cuts.push_back(1);
    if (cuts.size() == 2) {
      edges.push_back(old);
      continue;
    }
    const double whole = old.curve.length();
    auto& parts = map[{piece, old.name}];
    for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
      const std::string name = n == 0 ? old.name : freeName(old.name, taken);
      const double from = n == 0 ? 0 : parts.back().to;
      const double to = n + 2 == cuts.size() ? 1 : old.curve.lengthTo(cuts[n + 1]) / whole;
      edges.push_back({name, old.curve.part(cuts[n], cuts[n + 1])});
      parts.push_back({from, to, {piece, name, 0, 1}});
    }
  }
  outline.edges = std::move(edges);
}

EdgeMap composed(const EdgeMap& first, const EdgeMap& second) {
  EdgeMap all = second;
  for (const auto& [edge, parts] : first) {
    auto& out = all[edge];
    out.clear();
    for (const EdgePart& part : parts) {
      const auto next = second.find({part.now.piece, part.now.edge});
      if (next == second.end()) {
        out.push_back(part);
        continue;
      }
      for (const EdgePart& later : next->second) {
        const double low = std::max(part.now.from, later.from), high = std::min(part.now.to, later.to);
        if (high - low < 1e-9) continue;
        const auto share = [](double at, double a, double b) { return (at - a) / (b - a); };
        const auto old = [&](double at) {
          return std::lerp(part.from, part.to, share(at, part.now.from, part.now.to));
        };
        const auto now = [&](double at) {
          return std::lerp(later.now.from, later.now.to, share(at, later.from, later.to));
        };
        out.push_back({old(low), old(high), {later.now.piece, later.now.edge, now(low), now(high)}});
      }
    }
  }
  return all;
}

void followMarks(Piece& piece, const EdgeMap& map) {
  for (Mark& mark : piece.marks) {
    const auto parts = map.find({piece.id, mark.edge});
    if (parts == map.end()) continue;
    for (const EdgePart& part : parts->second) {
      if (mark.fraction > part.to) continue;
      const double share = std::clamp((mark.fraction - part.from) / (part.to - part.from), 0.0, 1.0);
      mark.edge = part.now.edge;
      mark.fraction = part.now.from + share * (part.now.to - part.now.from);
      break;
    }
  }
}

}  // namespace karinui

#include "design/unnamed.h"

#include <algorithm>

#include "karinui/design/share.h"

namespace karinui {

namespace {

// Names of one kind, numbered as they come.
class Neutral {
 public:
  std::string operator()(const std::string& name, const std::string& word) {
    if (name.empty()) return {};
    const auto [at, fresh] = now_.try_emplace(name);
    if (fresh) at->second = word + std::to_string(++count_[word]);
    return at->second;
  }
  // The name of one that was met.
  std::string of(const std::string& name) const {
    const auto at = now_.find(name);
    return at == now_.end() ? name : at->second;
  }

 private:
  std::map<std::string, std::string> now_;
  std::map<std::string, int> count_;
};

// What an edge is called says its kind where nothing is sewn to it.
std::string wordOfEdge(const std::string& name) {
  static const AllowancePlan alone({}, {});
  switch (alone.kind({}, name)) {
    case EdgeKind::Hem:
      return "hem";
    case EdgeKind::Neckline:
      return "neck";
    case EdgeKind::Fold:
      return "fold";
    case EdgeKind::Seam:
      break;
  }
  return "edge";
}

template <class Map>
Map renamed(const Map& map, const Neutral& names) {
  Map now;
  for (const auto& [at, value] : map) now[{at.first, names.of(at.second)}] = value;
  return now;
}

void rename(std::vector<EdgeSpan>& side, const Neutral& names) {
  for (EdgeSpan& span : side) span.edge = names.of(span.edge);
}

}  // namespace

std::vector<std::string> namesIn(const Document& document) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  const auto& pieces = document.pattern.pieces;
  for (const auto& [id, piece] : pieces) add(piece->name);
  for (const auto& [id, seam] : document.pattern.seams) add(seam.name);
  for (const auto& [name, fabric] : document.fabrics) add(name);
  for (const auto& [name, own] : document.allowances.fastenings) add(name);
  for (const std::string& size : document.grading.sizes) add(size);
  for (const auto& [id, piece] : pieces)
    for (const InternalLine& line : piece->lines) add(line.name);
  for (const auto& [id, piece] : pieces)
    for (const Mark& mark : piece->marks) add(mark.name);
  for (const auto& [id, piece] : pieces) {
    for (const Edge& edge : piece->outline.edges) add(edge.name);
    for (const Outline& hole : piece->holes)
      for (const Edge& edge : hole.edges) add(edge.name);
  }
  return names;
}

Document unnamed(Document document) {
  Neutral pieces, curves, marks, seams, fabrics, fastenings, sizes;  // edges and lines are curves of one set of names
  for (const auto& [id, piece] : document.pattern.pieces) {
    for (const Edge& edge : piece->outline.edges) curves(edge.name, wordOfEdge(edge.name));
    for (const Outline& hole : piece->holes)
      for (const Edge& edge : hole.edges) curves(edge.name, wordOfEdge(edge.name));
  }
  std::map<std::string, Fabric> ownFabrics;
  for (const auto& [name, fabric] : document.fabrics) {
    const std::string now = preset(name) ? name : fabrics(name, "fabric");
    (ownFabrics[now] = fabric).name = now;
    document.looks.fabrics[name] = lookOf(document, name);  // by the old name, which may say of what it is a copy
  }
  document.fabrics = std::move(ownFabrics);
  std::map<std::string, Look> looks;
  for (const auto& [name, look] : document.looks.fabrics) looks[fabrics.of(name)] = look;
  document.looks.fabrics = std::move(looks);
  for (auto& [id, piece] : document.pattern.pieces) {
    Piece now = *piece;
    now.name = pieces(now.name, "piece");
    for (Edge& edge : now.outline.edges) edge.name = curves.of(edge.name);
    for (Outline& hole : now.holes)
      for (Edge& edge : hole.edges) edge.name = curves.of(edge.name);
    for (InternalLine& line : now.lines) line.name = curves(line.name, "line");
    for (Mark& mark : now.marks) mark.name = marks(mark.name, "mark"), mark.edge = curves.of(mark.edge);
    now.fabric = fabrics.of(now.fabric), now.interfacing = fabrics.of(now.interfacing);
    piece = std::make_shared<const Piece>(std::move(now));
  }
  for (auto& [id, seam] : document.pattern.seams) {
    seam.name = seams(seam.name, "seam");
    rename(seam.a, curves), rename(seam.b, curves);
  }
  Allowances& all = document.allowances;
  all.edges = renamed(all.edges, curves), all.corners = renamed(all.corners, curves);
  Allowances::eachFinish(all, [&](auto& finish) { finish = renamed(finish, curves); });
  for (auto& [at, own] : all.pipings) own.fabric = fabrics.of(own.fabric);
  for (auto& [at, own] : all.bindings) own.fabric = fabrics.of(own.fabric);
  Fastenings held;
  for (auto& [name, own] : all.fastenings) {
    rename(own.a, curves), rename(own.b, curves);
    held[fastenings(name, "fastening")] = std::move(own);
  }
  all.fastenings = std::move(held);
  for (std::string& size : document.grading.sizes) size = sizes(size, "size");
  for (auto& [id, points] : document.grading.pieces)
    for (GradePoint& point : points) point.edge = curves.of(point.edge);
  return document;
}

}  // namespace karinui

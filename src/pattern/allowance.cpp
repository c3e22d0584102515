#include "karinui/pattern/allowance.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <utility>

namespace karinui {

namespace {

// Whether one of the words of a name, "side_hem_2", begins so.
bool saysSo(std::string_view name, std::string_view word) {
  for (std::size_t at = name.find(word); at != std::string_view::npos; at = name.find(word, at + 1))
    if (at == 0 || std::isalpha(static_cast<unsigned char>(name[at - 1])) == 0) return true;
  return false;
}

template <class Value>
void eraseGone(std::map<Allowances::At, Value>& all, const Pattern& now) {
  std::erase_if(all, [&](const auto& own) {
    const auto piece = now.pieces.find(own.first.first);
    if (piece == now.pieces.end()) return true;
    if constexpr (kOnLinesToo<Value>) return !findCurve(*piece->second, own.first.second);
    return !findEdge(*piece->second, own.first.second);
  });
}

}  // namespace

double usualAllowance(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::Hem:
      return 0.030;
    case EdgeKind::Neckline:
      return 0.007;
    case EdgeKind::Fold:
      return 0;
    default:
      return 0.010;
  }
}

CornerKind mirrored(CornerKind kind) {
  switch (kind) {
    case CornerKind::MirrorBefore:
      return CornerKind::MirrorAfter;
    case CornerKind::MirrorAfter:
      return CornerKind::MirrorBefore;
    case CornerKind::SquareBefore:
      return CornerKind::SquareAfter;
    case CornerKind::SquareAfter:
      return CornerKind::SquareBefore;
    default:
      return kind;
  }
}

void updateAllowances(Allowances& allowances, const EdgeMap& map, const Pattern& now) {
  constexpr double kStart = 1e-9;
  // Where several edges became one, `better` says which of their finishes stays.
  const auto follow = [&](auto& all, auto better) {
    std::remove_reference_t<decltype(all)> kept;
    const auto keep = [&](const Allowances::At& at, const auto& own) {
      const auto [there, fresh] = kept.emplace(at, own);
      if (!fresh && better(own, there->second)) there->second = own;
    };
    for (const auto& [at, own] : all) {
      const auto parts = map.find(at);
      if (parts == map.end())
        keep(at, own);
      else
        for (const EdgePart& part : parts->second) keep({part.now.piece, part.now.edge}, own);
    }
    all = std::move(kept);
    eraseGone(all, now);
  };
  follow(allowances.edges, std::greater<>());
  Allowances::eachFinish(allowances,
                         [&](auto& all) { follow(all, [](const auto& a, const auto& b) { return prevails(a, b); }); });
  updateFastenings(allowances.fastenings, map, now);
  decltype(allowances.corners) corners;
  for (const auto& [at, kind] : allowances.corners) {
    const auto parts = map.find(at);
    if (parts == map.end()) {
      corners[at] = kind;
      continue;
    }
    for (const EdgePart& part : parts->second)
      if (part.from < kStart && part.now.from < kStart) corners[{part.now.piece, part.now.edge}] = kind;
  }
  allowances.corners = std::move(corners);
  eraseGone(allowances.corners, now);
}

void copyAllowances(Allowances& allowances, const Piece& original, const Piece& copy, bool mirror) {
  const auto lead = [&](const Outline& from, const Outline& to) {
    const std::size_t n = from.edges.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Allowances::At at{original.id, from.edges[k].name};
      // The image of an edge starts where the edge ends.
      const auto width = mirror ? n - 1 - k : k, corner = mirror ? (n - k) % n : k;
      if (width >= to.edges.size() || corner >= to.edges.size()) continue;
      const auto give = [&](auto& all) {
        if (const auto own = all.find(at); own != all.end()) {
          const auto value = own->second;
          all[{copy.id, to.edges[width].name}] = value;
        }
      };
      give(allowances.edges), Allowances::eachFinish(allowances, give);
      if (const auto own = allowances.corners.find(at); own != allowances.corners.end())
        allowances.corners[{copy.id, to.edges[corner].name}] = mirror ? mirrored(own->second) : CornerKind{own->second};
    }
  };
  lead(original.outline, copy.outline);
  for (const InternalLine& line : original.lines)
    Allowances::eachFinish(allowances, [&]<class Finish>(std::map<Allowances::At, Finish>& all) {
      const auto own = all.find({original.id, line.name});
      if (!kOnLinesToo<Finish> || own == all.end() || findEdge(original, line.name)) return;
      const Finish value = own->second;
      all[{copy.id, mirror ? otherSide(line.name) : line.name}] = value;
    });
  for (std::size_t i = 0; i < original.holes.size() && i < copy.holes.size(); ++i)
    lead(original.holes[i], copy.holes[i]);
}

AllowancePlan::AllowancePlan(const Pattern& pattern, Allowances allowances) : allowances_(std::move(allowances)) {
  for (const auto& [id, seam] : pattern.seams)
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side) sewn_.insert({span.piece, span.edge});
  for (const auto& [name, own] : allowances_.fastenings)
    for (const auto* side : {&own.a, &own.b})
      for (const EdgeSpan& span : *side)
        if (own.kind == FasteningKind::Zip) sewn_.insert({span.piece, span.edge});
  for (const PaperDart& dart : dartsOf(pattern))
    if (dart.folded()) darts_[{dart.piece, dart.to}] = dart;
  for (const DoubleDart& dart : doubleDartsOf(pattern))
    if (dart.folded()) foldedHoles_[dart.piece].insert(dart.hole);
}

const std::set<std::size_t>& AllowancePlan::foldedHoles(PieceId piece) const {
  static const std::set<std::size_t> kNone;
  const auto found = foldedHoles_.find(piece);
  return found == foldedHoles_.end() ? kNone : found->second;
}

const PaperDart* AllowancePlan::foldedDart(PieceId piece, std::size_t to) const {
  const auto found = darts_.find({piece, to});
  return found == darts_.end() ? nullptr : &found->second;
}

bool AllowancePlan::onFold(const Piece& piece) const {
  return std::any_of(piece.outline.edges.begin(), piece.outline.edges.end(),
                     [&](const Edge& edge) { return kind(piece.id, edge.name) == EdgeKind::Fold; });
}

EdgeKind AllowancePlan::kind(PieceId piece, const std::string& edge) const {
  if (sewn_.contains({piece, edge})) return EdgeKind::Seam;
  if (saysSo(edge, "fold")) return EdgeKind::Fold;
  if (saysSo(edge, "hem")) return EdgeKind::Hem;
  if (saysSo(edge, "neck")) return EdgeKind::Neckline;
  return EdgeKind::Seam;
}

double AllowancePlan::width(EdgeKind kind) const {
  const auto own = allowances_.kinds.find(kind);
  return own != allowances_.kinds.end() ? own->second : usualAllowance(kind);
}

double AllowancePlan::width(PieceId piece, const std::string& edge) const {
  const auto own = allowances_.edges.find({piece, edge});
  return own != allowances_.edges.end() ? own->second : width(kind(piece, edge));
}

CornerKind AllowancePlan::corner(PieceId piece, const std::string& before, const std::string& after) const {
  const auto own = allowances_.corners.find({piece, after});
  if (own != allowances_.corners.end()) return own->second;
  const bool first = kind(piece, before) == EdgeKind::Hem, second = kind(piece, after) == EdgeKind::Hem;
  if (first == second) return CornerKind::Mitre;
  return first ? CornerKind::MirrorBefore : CornerKind::MirrorAfter;
}

}  // namespace karinui

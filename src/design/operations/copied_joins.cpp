#include "design/operations/copied_joins.h"

#include <algorithm>
#include <cmath>

#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

bool holds(const std::vector<EdgeSpan>& side, PieceId piece) {
  return std::any_of(side.begin(), side.end(), [&](const EdgeSpan& span) { return span.piece == piece; });
}

// The same side on the copies; nothing where one is missing or went its own way since. A mirror image's edges run the
// other way, its inner lines do not.
std::optional<std::vector<EdgeSpan>> copied(const Document& document, std::vector<EdgeSpan> side,
                                            const std::map<PieceId, PieceId>& copies, bool mirror, bool lines) {
  for (EdgeSpan& span : side) {
    const auto at = copies.find(span.piece);
    if (at == copies.end()) return std::nullopt;
    const Piece &piece = *document.find(span.piece), &copy = *document.find(at->second);
    span.piece = at->second;
    if (lines) {
      if (mirror) span.edge = otherSide(span.edge);
    } else if (mirror) {
      const auto edge = edgeOnCopy(copy, piece, span.edge);
      if (!edge) return std::nullopt;
      span = {copy.id, *edge, 1 - span.to, 1 - span.from};
    }
    if (!findCurve(copy, span.edge)) return std::nullopt;
  }
  if (mirror && !lines) std::reverse(side.begin(), side.end());
  return side;
}

std::optional<Fastening> copied(const Document& document, const Fastening& own,
                                const std::map<PieceId, PieceId>& copies, bool mirror) {
  bool edges = false, lines = false;
  for (const auto* side : {&own.a, &own.b})
    for (const EdgeSpan& span : *side) (document.find(span.piece)->outline.find(span.edge) ? edges : lines) = true;
  // What lies to the left of an inner line lies to the right of its image.
  if (lines && mirror && (edges || own.inset > 0)) return std::nullopt;
  const auto a = copied(document, own.a, copies, mirror, lines && !edges),
             b = copied(document, own.b, copies, mirror, lines && !edges);
  if (!a || !b) return std::nullopt;
  Fastening copy = own;
  copy.a = *a, copy.b = *b;
  if (mirror && !lines) {
    for (double& at : copy.at) at = 1 - at;
    std::reverse(copy.at.begin(), copy.at.end());
    copy.fromStart = !own.fromStart;
  }
  return copy;
}

bool closeTo(double a, double b) {
  constexpr double kSame = 1e-6;  // of a run's length
  return std::fabs(a - b) < kSame;
}
bool sameSide(const std::vector<EdgeSpan>& one, const std::vector<EdgeSpan>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](const EdgeSpan& a, const EdgeSpan& b) {
    return a.piece == b.piece && a.edge == b.edge && closeTo(a.from, b.from) && closeTo(a.to, b.to);
  });
}

}  // namespace

std::optional<Fastening> fasteningOnCopies(const Document& document, const Fastening& own) {
  std::map<PieceId, PieceId> copies;
  for (const auto* side : {&own.a, &own.b})
    for (const EdgeSpan& span : *side)
      if (const auto all = likenesses(document, span.piece); !all.empty()) copies[span.piece] = all.front();
  const auto copy = copied(document, own, copies, true);
  if (!copy) return std::nullopt;
  for (const auto* side : {&own.a, &own.b})
    for (const EdgeSpan& span : *side)
      if (holds(copy->a, span.piece) || holds(copy->b, span.piece)) return std::nullopt;
  return copy;
}

bool sameFastening(const Fastening& one, const Fastening& other) {
  return one.kind == other.kind && one.reversed == other.reversed && sameSide(one.a, other.a) &&
         sameSide(one.b, other.b) &&
         std::equal(one.at.begin(), one.at.end(), other.at.begin(), other.at.end(), closeTo);
}

Document withCopiedFastenings(Document document, PieceId piece, const std::map<PieceId, PieceId>& copies, bool mirror,
                              const Context& context) {
  const Fastenings all = document.allowances.fastenings;
  Fastenings& now = document.allowances.fastenings;
  for (const auto& [name, own] : all) {
    if (!holds(own.a, piece) && !holds(own.b, piece)) continue;
    const auto copy = copied(document, own, copies, mirror);
    const bool meets = copy && std::any_of(copies.begin(), copies.end(), [&, &own = own](const auto& pair) {
                         return (holds(copy->a, pair.first) || holds(copy->b, pair.first)) &&
                                (holds(own.a, pair.first) || holds(own.b, pair.first));
                       });
    if (!copy || meets) {
      if (context.advise)
        context.advise({say("“{0}” stays with “{1}” alone: the copy has nothing it could be fastened to.", name,
                            document.find(piece)->name)});
      continue;
    }
    std::string free = name;
    for (int n = 2; now.contains(free); ++n) free = name + "_" + std::to_string(n);
    now[free] = *copy;
  }
  return document;
}

std::vector<const Seam*> ownSeams(const Document& document, PieceId piece) {
  std::vector<const Seam*> own;
  const auto within = [&](const EdgeSpan& span) { return span.piece == piece; };
  for (const auto& [id, seam] : document.pattern.seams)
    if (std::all_of(seam.a.begin(), seam.a.end(), within) && std::all_of(seam.b.begin(), seam.b.end(), within))
      own.push_back(&seam);
  return own;
}

void decideSeamsWithin(const Document& document, PieceId piece, Choice& seams, const Context& context) {
  if (seams == Choice::Auto && !context.recorded && !ownSeams(document, piece).empty()) seams = Choice::Yes;
}

Document withCopiedSeams(Document document, PieceId piece, PieceId copy, bool mirror) {
  const Document before = document;
  std::uint32_t made = 0;
  for (const Seam* own : ownSeams(before, piece)) {
    const Piece& from = *before.find(piece);
    const bool aLine = !findEdge(from, own->a.front().edge), bLine = !findEdge(from, own->b.front().edge);
    const auto a = copied(document, own->a, {{piece, copy}}, mirror, aLine),
               b = copied(document, own->b, {{piece, copy}}, mirror, bLine);
    if (!a || !b) continue;
    Seam seam = *own;
    seam.id = mint<SeamId>(before, made++);
    seam.a = *a, seam.b = *b;
    if (mirror && aLine != bLine) seam.reversed = !own->reversed;
    // As the outline runs round the copy, the side of a dart that came second comes first.
    if (mirror && own->tie != Seam::Tie::Pleat) std::swap(seam.a, seam.b);
    const std::string name = mirror ? otherSide(own->name) : own->name;
    const auto taken = [&](const auto& one) { return one.second.name == seam.name; };
    seam.name = name;
    for (int n = 2; !name.empty() && std::any_of(document.pattern.seams.begin(), document.pattern.seams.end(), taken);
         ++n)
      seam.name = name + "_" + std::to_string(n);
    if (const auto eased = before.eases.find(own->id); eased != before.eases.end())
      document.eases[seam.id] = eased->second;
    document.pattern.seams[seam.id] = std::move(seam);
  }
  return document;
}

}  // namespace karinui

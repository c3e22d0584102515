#include "design/operations/copied_joins.h"

#include <algorithm>
#include <cmath>

#include "design/operations/sewn_runs.h"
#include "karinui/design/sewing.h"
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

namespace {

bool holds(const std::vector<EdgeSpan>& side, PieceId piece) {
  return std::any_of(side.begin(), side.end(), [&](const EdgeSpan& span) { return span.piece == piece; });
}

// The same side on the copies; nothing where one is missing or went its own way since. A mirror image's edges run the
// other way, its inner lines do not.
std::optional<std::vector<EdgeSpan>> copied(const Document& document, std::vector<EdgeSpan> side,
                                            const CopiesOf& copies, bool mirror, bool lines) {
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

std::optional<Fastening> copied(const Document& document, const Fastening& own, const CopiesOf& copies, bool mirror) {
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
  CopiesOf copies;
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

Document withCopiedFastenings(Document document, const std::vector<PieceRef>& pieces, const CopiesOf& copies,
                              bool mirror, const Context& context) {
  const Fastenings all = document.allowances.fastenings;
  Fastenings& now = document.allowances.fastenings;
  for (const auto& [name, own] : all) {
    const auto piece = std::find_if(pieces.begin(), pieces.end(), [&, &own = own](const PieceRef& one) {
      return holds(own.a, one.id) || holds(own.b, one.id);
    });
    if (piece == pieces.end()) continue;
    const auto copy = copied(document, own, copies, mirror);
    const bool meets = copy && std::any_of(copies.begin(), copies.end(), [&, &own = own](const auto& pair) {
                         return (holds(copy->a, pair.first) || holds(copy->b, pair.first)) &&
                                (holds(own.a, pair.first) || holds(own.b, pair.first));
                       });
    if (!copy || meets) {
      if (context.advise)
        context.advise({say("“{0}” stays with “{1}” alone: the copy has nothing it could be fastened to.", name,
                            document.find(piece->id)->name)});
      continue;
    }
    std::string free = name;
    for (int n = 2; now.contains(free); ++n) free = name + "_" + std::to_string(n);
    now[free] = *copy;
  }
  return document;
}

namespace {

bool within(const Seam& seam, const std::vector<PieceRef>& pieces) {
  const auto mine = [&](const EdgeSpan& span) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const PieceRef& one) { return one.id == span.piece; });
  };
  return std::all_of(seam.a.begin(), seam.a.end(), mine) && std::all_of(seam.b.begin(), seam.b.end(), mine);
}

}  // namespace

std::vector<const Seam*> seamsWithin(const Document& document, const std::vector<PieceRef>& pieces) {
  std::vector<const Seam*> own;
  for (const auto& [id, seam] : document.pattern.seams)
    if (within(seam, pieces)) own.push_back(&seam);
  return own;
}

void decideSeamsWithin(const Document& document, const std::vector<PieceRef>& pieces, Choice& seams,
                       const Context& context) {
  if (seams == Choice::Auto && !context.recorded && !seamsWithin(document, pieces).empty()) seams = Choice::Yes;
}

Document withCopiedSeams(Document document, const std::vector<PieceRef>& pieces, const CopiesOf& copies, bool mirror) {
  const Document before = document;
  std::uint32_t made = 0;
  for (const Seam* own : seamsWithin(before, pieces)) {
    const auto lined = [&](const std::vector<EdgeSpan>& side) {
      return !findEdge(*before.find(side.front().piece), side.front().edge);
    };
    const bool aLine = lined(own->a), bLine = lined(own->b);
    const auto a = copied(document, own->a, copies, mirror, aLine), b = copied(document, own->b, copies, mirror, bLine);
    if (!a || !b) continue;
    Seam seam = *own;
    seam.id = mint<SeamId>(before, made++);
    seam.a = *a, seam.b = *b;
    if (mirror && aLine != bLine) seam.reversed = !own->reversed;
    // As the outline runs round the copy, the side of a dart that came second comes first.
    const bool onePiece = within(*own, {PieceRef(own->a.front().piece)});
    if (mirror && onePiece && own->tie != Seam::Tie::Pleat) std::swap(seam.a, seam.b);
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

namespace {

// Where the mirror image of an inner line is drawn, and how it comes there: on the symmetric copy, or on the other
// half.
struct OtherHalf {
  PieceId piece;
  std::function<Curve(const Curve&)> image;
};
std::optional<OtherHalf> otherHalf(const Document& document, PieceId on) {
  if (const auto all = likenesses(document, on); !all.empty())
    return OtherHalf{all.front(), [](const Curve& curve) { return curve.mirrored({0, 0}, {0, 1}); }};
  if (const auto symmetry = symmetryOf(document.find(on)->outline))
    return OtherHalf{on, [symmetry](const Curve& curve) { return symmetry->image(curve); }};
  return std::nullopt;
}

// Whether what is sewn to one curve has no room beside what is sewn to the other.
bool nearEachOther(const Curve& one, const Curve& other) {
  constexpr double kNear = 0.005, kStep = 0.002;  // metres
  const auto places = [](const Curve& curve) {
    return curve.evenly(0, 1, std::max(1, static_cast<int>(curve.length() / kStep)));
  };
  const auto here = places(one), there = places(other);
  return std::any_of(here.begin(), here.end(), [&](Flat a) {
    return std::any_of(there.begin(), there.end(), [&](Flat b) { return distance(a, b) < kNear; });
  });
}

std::string nameOfImage(const Document& document, const std::string& name) {
  if (name.empty()) return name;
  const auto taken = [&](const std::string& wanted) {
    const auto& seams = document.pattern.seams;
    return std::any_of(seams.begin(), seams.end(), [&](const auto& one) { return one.second.name == wanted; });
  };
  std::string free = otherSide(name);
  for (int n = 2; taken(free); ++n) free = otherSide(name) + "_" + std::to_string(n);
  return free;
}

// Of edges that are sewn to edges.
std::optional<Seam> onEdges(const Document& document, const Seam& own, bool rings) {
  SewEdges sew;
  for (const auto& [from, to] : {std::pair{&own.a, &sew.a}, std::pair{&own.b, &sew.b}})
    for (const EdgeSpan& span : *from) to->push_back({PieceRef(span.piece), span.edge, span.from, span.to});
  const auto image = mirrorImage(document, sew, rings);
  if (!image) return std::nullopt;
  Seam seam = own;
  seam.a = spansOf(image->a), seam.b = spansOf(image->b);
  return seam;
}

// Of the piece's edges that are sewn to inner lines of another, as a pocket's: the lines are drawn, too, and run the
// other way as the edges do, so that they have the pocket on the same side.
std::optional<Seam> onLines(Document& document, const Seam& own, PieceId piece, PieceId copy) {
  const bool edgesFirst = holds(own.a, piece);
  const auto &edges = edgesFirst ? own.a : own.b, &lines = edgesFirst ? own.b : own.a;
  const PieceId on = lines.front().piece;
  const bool plain =
      std::all_of(
          edges.begin(), edges.end(),
          [&](const EdgeSpan& span) { return span.piece == piece && findEdge(*document.find(piece), span.edge); }) &&
      std::all_of(lines.begin(), lines.end(),
                  [&](const EdgeSpan& span) { return span.piece == on && !findEdge(*document.find(on), span.edge); });
  const auto there = plain ? otherHalf(document, on) : std::nullopt;
  auto copiedEdges = there ? copied(document, edges, {{piece, copy}}, true, false) : std::nullopt;
  if (!copiedEdges) return std::nullopt;
  const Piece& from = *document.find(on);
  Piece other = *document.find(there->piece);
  std::vector<EdgeSpan> copiedLines;
  for (const EdgeSpan& span : lines) {
    const Curve image = there->image(*findCurve(from, span.edge)).reversed();
    if (there->piece == on && std::any_of(lines.begin(), lines.end(), [&](const EdgeSpan& line) {
          return nearEachOther(image, *findCurve(from, line.edge));
        }))
      return std::nullopt;
    const std::string stem = document.find(piece)->name + "_";
    const std::string wanted = span.edge.starts_with(stem)
                                   ? document.find(copy)->name + "_" + otherSide(span.edge.substr(stem.size()))
                                   : otherSide(span.edge);
    std::string name = wanted;
    for (int n = 2; findCurve(other, name); ++n) name = wanted + "_" + std::to_string(n);
    other.lines.push_back({name, {image}, std::nullopt});
    copiedLines.push_back({other.id, name, 1 - span.to, 1 - span.from});
  }
  std::reverse(copiedLines.begin(), copiedLines.end());
  Seam seam = own;
  (edgesFirst ? seam.a : seam.b) = *std::move(copiedEdges);
  (edgesFirst ? seam.b : seam.a) = std::move(copiedLines);
  document = withPiece(std::move(document), std::move(other));
  return seam;
}

}  // namespace

MirroredSeams withMirroredSeams(Document document, const std::vector<PieceRef>& pieces, const CopiesOf& copies,
                                std::size_t made, bool rings) {
  const Document before = document;
  MirroredSeams all{std::move(document), 0, {}};
  const auto lined = [&](const std::vector<EdgeSpan>& side) {
    return std::any_of(side.begin(), side.end(),
                       [&](const EdgeSpan& span) { return !findEdge(*before.find(span.piece), span.edge); });
  };
  for (const auto& [id, own] : before.pattern.seams) {
    if (id >= mint<SeamId>(before, 0) || within(own, pieces)) continue;  // one made just now, or by withCopiedSeams
    PieceId on;
    std::optional<Seam> seam;
    for (const PieceRef& piece : pieces) {
      if (seam || (!holds(own.a, piece.id) && !holds(own.b, piece.id))) continue;
      if (!on) on = piece.id;
      seam = lined(own.a) || lined(own.b) ? onLines(all.document, own, piece.id, copies.at(piece.id))
                                          : onEdges(all.document, own, rings);
    }
    if (!on) continue;
    if (!seam) {
      all.left.emplace_back(id, on);
      continue;
    }
    seam->id = mint<SeamId>(before, static_cast<std::uint32_t>(made + all.sewn++));
    seam->name = nameOfImage(all.document, own.name);
    for (const auto* side : {&seam->a, &seam->b})
      for (const EdgeSpan& span : *side) all.document.drape.dirty.insert(span.piece);
    if (const auto eased = before.eases.find(id); eased != before.eases.end())
      all.document.eases[seam->id] = eased->second;
    all.document.pattern.seams[seam->id] = *std::move(seam);
  }
  return all;
}

}  // namespace karinui

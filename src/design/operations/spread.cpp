#include "karinui/pattern/spread.h"

#include <algorithm>
#include <cmath>

#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

constexpr int kMostSlashes = 50;
constexpr double kSame = 1e-4;  // of an edge's length: places nearer than this are one

bool same(const Slash& one, const Slash& other) {
  return one.from == other.from && one.to == other.to && std::fabs(one.at - other.at) < kSame &&
         std::fabs(one.toAt - other.toAt) < kSame;
}
// The same line, begun at its other end.
bool samePlace(const Slash& one, const Slash& other) {
  return same(one, other) || (one.from == other.to && one.to == other.from && std::fabs(one.at - other.toAt) < kSame &&
                              std::fabs(one.toAt - other.at) < kSame);
}

// On the piece's own other half; nothing where that has no such places.
std::optional<Slash> imageOf(const Outline& outline, const PaperSymmetry& symmetry, const Slash& slash) {
  const auto from = imageOf(outline, symmetry, {*outline.find(slash.from), slash.at}),
             to = imageOf(outline, symmetry, {*outline.find(slash.to), slash.toAt});
  if (!from || !to) return std::nullopt;
  Slash image = slash;
  image.from = outline.edges[from->edge].name, image.at = from->at;
  image.to = outline.edges[to->edge].name, image.toAt = to->at;
  return image;
}

// The slashes of an operation, as if each were the first.
std::vector<Slash> slashesOf(const SlashAndSpread& op) {
  std::vector<Slash> all;
  for (int k = 0; k < op.count; ++k) {
    const double share = (k + 0.5) / op.count;
    Slash slash{op.from.edge, op.to.edge};
    // The outline runs along one edge and back along the other.
    slash.at = op.at.value_or(std::lerp(op.from.from, op.from.to, share));
    slash.toAt = op.toAt.value_or(std::lerp(op.to.to, op.to.from, share));
    slash.by = op.by, slash.toBy = op.toBy, slash.smooth = op.smooth;
    all.push_back(slash);
  }
  return all;
}

// On the fold, and in a corner there: its image has the same places, and may have them on the edges beside.
bool inCornerOfFold(const Outline& outline, const Slash& slash, const Slash& image) {
  constexpr double kOne = 1e-4, kCorner = 1e-3;  // metres
  const auto curve = [&](const std::string& edge) { return outline.edges[*outline.find(edge)].curve; };
  const auto cornered = [&](const std::string& edge, double at) {
    return std::min(at, 1 - at) * curve(edge).length() < kCorner;
  };
  return (cornered(slash.from, slash.at) || cornered(slash.to, slash.toAt)) &&
         distance(curve(slash.from).atFraction(slash.at), curve(image.from).atFraction(image.at)) < kOne &&
         distance(curve(slash.to).atFraction(slash.toAt), curve(image.to).atFraction(image.toAt)) < kOne;
}

bool anyInCornerOfFold(const Piece& piece, const std::vector<Slash>& slashes) {
  const auto symmetry = symmetryOf(piece.outline);
  return symmetry && std::any_of(slashes.begin(), slashes.end(), [&](const Slash& slash) {
           const auto image = imageOf(piece.outline, *symmetry, slash);
           return image && inCornerOfFold(piece.outline, slash, *image);
         });
}

bool crossItsImage(const Outline& outline, const PaperSymmetry& symmetry, const Slash& slash, bool once) {
  const auto image = imageOf(outline, symmetry, slash);
  if (!image || (once && inCornerOfFold(outline, slash, *image))) return false;
  if (samePlace(slash, *image)) return !same(slash, *image) && slash.by != slash.toBy;
  return meet(outline, slash, *image);
}

// Those of a symmetric piece on both of its halves; of one on the fold both parts are moved.
std::vector<Slash> onBothHalves(const Outline& outline, const std::vector<Slash>& slashes, bool once) {
  const auto symmetry = *symmetryOf(outline);
  std::vector<Slash> all;
  const auto add = [&](const Slash& slash) {
    if (std::none_of(all.begin(), all.end(), [&](const Slash& other) { return samePlace(slash, other); }))
      all.push_back(slash);
  };
  for (Slash slash : slashes) {
    const Slash image = *imageOf(outline, symmetry, slash);
    slash.shared = once && inCornerOfFold(outline, slash, image);
    if (slash.shared || same(slash, image)) slash.stays = Slash::Stays::Neither;
    add(slash);
    if (!slash.shared) add(image);
  }
  return all;
}

// On the piece and, as its mirror image, on its symmetric copies. What became of the edges is left in `map`.
Result<Document> spread(Document document, PieceId id, const Slash& slash, EdgeMap& map) {
  const Piece piece = *document.find(id);
  const std::vector<PieceId> others = likenesses(document, id);
  const auto take = [&](const Piece& own, const Slash& there) -> Result<Slash::Stays> {
    auto opened = spreadPiece(own, there);
    if (!opened) return opened.error();
    document = withOwnEdit(std::move(document), opened->edited);
    if (const auto pins = document.pins.find(own.id); pins != document.pins.end())
      for (Flat& pin : pins->second) pin = opened->place(pin);
    if (own.id == id) map = std::move(opened->edited.edges);
    return opened->stays;
  };
  const auto stays = take(piece, slash);
  if (!stays) return stays.error();
  Slash decided = slash;
  decided.stays = *stays;
  for (const PieceId other : others) {
    const Piece copy = *document.find(other);
    const auto done =
        take(copy, mirrored(decided, *edgeOnCopy(copy, piece, slash.from), *edgeOnCopy(copy, piece, slash.to)));
    if (!done) return done.error();
  }
  return document;
}

// The edge along the grain where the garment opens, as a centre front with its buttons; empty: none, or several.
std::string opening(const Document& before, const Piece& piece, const SlashAndSpread& op) {
  constexpr double kAlong = 0.9998;  // cosine of 1 degree
  std::string found;
  for (const Edge& edge : piece.outline.edges) {
    const Flat way = edge.curve.end - edge.curve.start;
    const bool straight = edge.curve.kind == Curve::Kind::Line && std::fabs(dot(normalized(way), piece.grain)) > kAlong;
    const auto lies = [&](const EdgeSpan& span) { return span.piece == piece.id && span.edge == edge.name; };
    const auto holds = [&](const auto& one) {
      const Fastening& fastening = one.second;
      return std::any_of(fastening.a.begin(), fastening.a.end(), lies) ||
             std::any_of(fastening.b.begin(), fastening.b.end(), lies);
    };
    const auto& fastenings = before.allowances.fastenings;
    if (!straight || edge.name == op.from.edge || edge.name == op.to.edge ||
        std::none_of(fastenings.begin(), fastenings.end(), holds))
      continue;
    if (!found.empty()) return {};
    found = edge.name;
  }
  return found;
}

void keepOpening(const Document& before, const Piece& piece, SlashAndSpread& op, const Context& context) {
  if (op.keep.empty() && !context.recorded) op.keep = opening(before, piece, op);
}

}  // namespace

Done resolve(const Document& before, SlashAndSpread& op, Context& context) {
  if (Done done = resolve(before, op.from); !done) return done;
  if (Done done = resolve(before, op.to); !done) return done;
  if (op.from.piece != op.to.piece)
    return refused(say("A slash leads from one edge to another of the same piece; cut pieces singly."));
  if (op.count < 1 || op.count > kMostSlashes) return refused(say("There are 1 to {0} slashes.", kMostSlashes));
  if ((op.at || op.toAt) && op.count > 1)
    return refused(say("The place is that of a single slash; several are spread over the edges or parts of them."));
  const Piece& piece = *before.find(op.from.piece.id);
  if (!op.keep.empty()) {
    EdgeRef kept{op.from.piece, op.keep};
    if (Done done = resolve(before, kept); !done) return done;
    if (op.keep == op.from.edge || op.keep == op.to.edge)
      return refused(say("“{0}” is slashed itself; name an edge that lies to one side.", op.keep));
  }
  const std::vector<Slash> slashes = slashesOf(op);
  for (const Slash& slash : slashes)  // what is wrong with a single one is said of it
    if (const auto opened = spreadPiece(piece, slash); !opened) return opened.error();
  // Half of what is cut has no other half on the paper, even where that is symmetric.
  if (op.symmetric == Choice::Auto && AllowancePlan(before.pattern, before.allowances).onFold(piece))
    op.symmetric = Choice::No;
  if (op.symmetric == Choice::No) {
    keepOpening(before, piece, op, context);
    return {};
  }
  if (op.once == Choice::Auto && !context.recorded && anyInCornerOfFold(piece, slashes)) op.once = Choice::Yes;
  const auto symmetry = symmetryOf(piece.outline);
  if (symmetry && std::any_of(slashes.begin(), slashes.end(), [&](const Slash& slash) {
        return crossItsImage(piece.outline, *symmetry, slash, op.once == Choice::Yes);
      })) {
    if (op.symmetric == Choice::Yes)
      return refused(say("On both halves the slashes would cross; write symmetric=no for one alone."));
    op.symmetric = Choice::No;
    if (context.advise)
      context.advise({say("Slashed once: on both halves of “{0}” the slashes would cross.", piece.name)});
    return {};
  }
  if (Done done = resolveSymmetric(piece, op.symmetric, context,
                                   [&](const PaperSymmetry& own) {
                                     return std::all_of(slashes.begin(), slashes.end(), [&](const Slash& slash) {
                                       return imageOf(piece.outline, own, slash).has_value();
                                     });
                                   });
      !done)
    return done;
  if (op.symmetric == Choice::Yes && !op.keep.empty())
    return refused(say("Slashed on both halves the middle stays; leave keep= away, or write symmetric=no."));
  if (op.symmetric != Choice::Yes) keepOpening(before, piece, op, context);
  return {};
}

Result<Document> perform(const Document& before, const SlashAndSpread& op, Context& context) {
  const PieceId id = op.from.piece.id;
  const Piece& piece = *before.find(id);
  std::vector<Slash> slashes = slashesOf(op);
  if (op.symmetric == Choice::Yes) slashes = onBothHalves(piece.outline, slashes, op.once == Choice::Yes);
  const AllowancePlan kinds(before.pattern, before.allowances);
  const auto kept = [&](const std::string& edge) {
    return op.keep.empty() ? kinds.kind(id, edge) == EdgeKind::Fold : edge == op.keep;
  };
  Document after = before;
  std::vector<EdgeMap> maps;
  for (Slash slash : slashes) {
    slash.stays = staying(piece.outline, slash, kept);
    for (const EdgeMap& map : maps) {
      slash.at = placeNow(map, id, slash.from, slash.at)->second;
      slash.toAt = placeNow(map, id, slash.to, slash.toAt)->second;
    }
    auto next = spread(std::move(after), id, slash, maps.emplace_back());
    if (!next) return next.error();
    after = *std::move(next);
  }
  tellLengths(piece, *after.find(id), context);
  tellSeams(before, after, context);
  return after;
}

}  // namespace karinui

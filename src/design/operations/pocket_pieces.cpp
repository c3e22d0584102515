#include "design/operations/pocket_pieces.h"

#include <cmath>

#include "design/operations/cut_parts.h"
#include "design/operations/lifted_form.h"
#include "design/operations/said.h"
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/pockets.h"

namespace karinui {

std::optional<EdgeRef> edgeOnOtherHalf(const Document& document, const EdgeRef& edge) {
  const Piece& piece = *document.find(edge.piece.id);
  for (const PieceId copy : likenesses(document, piece.id))
    if (const auto image = edgeOnCopy(*document.find(copy), piece, edge.edge)) return EdgeRef{PieceRef(copy), *image};
  const auto symmetry = symmetryOf(piece.outline);
  const std::size_t k = *piece.outline.find(edge.edge);
  if (!symmetry || !symmetry->partner[k] || symmetry->partner[k] == k) return std::nullopt;
  return EdgeRef{edge.piece, piece.outline.edges[*symmetry->partner[k]].name};
}

std::vector<EdgeRef> pocketEdges(const Document& document, const SewPocket& op) {
  std::vector<EdgeRef> edges{op.edge};
  if (op.copies == Choice::Yes)
    if (const auto image = edgeOnOtherHalf(document, op.edge)) edges.push_back(*image);
  return edges;
}

Done checkFree(const Document& document, const DownEdge& side, double from, double to) {
  constexpr double kCommon = 1e-3;  // metres
  const std::string opening = "_opening";
  for (const SewnPocket& pocket : pocketsOf(document.pattern))
    for (const SeamId id : pocket.caught)
      for (const EdgeSpan& span : document.find(id)->a) {
        if (span.piece != side.piece.id || span.edge != side.edge.name) continue;
        const double first = (side.down ? span.from : 1 - span.to) * side.whole,
                     last = (side.down ? span.to : 1 - span.from) * side.whole;
        if (std::min(to, last) - std::max(from, first) < kCommon) continue;
        const std::string& seam = document.find(pocket.opening)->name;
        const std::string name = seam.substr(0, seam.find(opening));
        const double below = std::ceil((last + kBagBeyond) * 200 - 1e-6) / 200;
        return refused(
            say("The pocket “{0}” has {1} of “{2}” from {3} to {4} cm down. Begin this one at {5} cm or lower, choose "
                "another seam, or change or take back the step of that pocket.",
                name.empty() ? document.find(document.find(id)->b.front().piece)->name : name, side.edge.name,
                side.piece.name, centimetres(first), centimetres(last), centimetres(below)));
      }
  return {};
}

PocketPieces::PocketPieces(const Document& before, const SewPocket& op, Document now)
    : after(std::move(now)), before_(before), op_(op) {}

Done PocketPieces::room(const std::vector<PieceId>& outers) {
  for (int layers = 0; layers < 2; ++layers) {
    auto wider = withLayersBeneath(std::move(after), outers);
    if (!wider) return wider.error();
    after = *std::move(wider);
  }
  return {};
}

std::string PocketPieces::nameOf(const char* what, bool first) const {
  const std::string name = op_.name + "_" + what;
  return first ? usableName(after, name) : nameOfCopy(after, name);
}

PieceId PocketPieces::pieceId() {
  while (after.find(mint<PieceId>(before_, pieces_))) ++pieces_;
  return mint<PieceId>(before_, pieces_);
}

Result<std::shared_ptr<const Form>> PocketPieces::beneath(const Piece& piece, const Piece& outer,
                                                          const std::function<double(Flat)>& apart) const {
  return liftedForm(piece, outer, before_.settings.spacing, [&](Flat place) {
    return LiftedPlace{place, -apart(place)};
  });
}

Result<PieceId> PocketPieces::addBag(const DividedPart& paper, std::vector<Mark> marks, const Piece& outer, int under,
                                     std::string name) {
  Piece piece;
  piece.id = pieceId();
  piece.name = std::move(name);
  piece.outline = paper.outline;
  piece.marks = std::move(marks);
  piece.grain = outer.grain;
  piece.fabric = op_.fabric;
  piece.layer = after.find(outer.id)->layer - under;
  piece.pose = outer.pose;
  auto form = beneath(piece, outer, [&](Flat) { return under * kLayersApart; });
  if (!form) return form.error();
  piece.form = *std::move(form);
  std::vector<DividedPart::EdgePart> parts = paper.edges;
  for (DividedPart::EdgePart& part : parts) part.own.piece = piece.id;
  gradeParts(after.grading, outer, parts, piece);
  const PieceId id = piece.id;
  after = withPiece(std::move(after), std::move(piece));
  return id;
}

SeamId PocketPieces::seamId() {
  while (after.find(mint<SeamId>(before_, seams_))) ++seams_;
  return mint<SeamId>(before_, seams_);
}

std::uint32_t& PocketPieces::freeSeams() {
  seamId();
  return seams_;
}

void PocketPieces::sew(std::vector<EdgeSpan> a, std::vector<EdgeSpan> b, Seam::Tie tie, bool reversed,
                       const std::string& name) {
  Seam seam;
  seam.id = seamId();
  seam.name = name;
  seam.a = std::move(a), seam.b = std::move(b);
  seam.reversed = reversed, seam.tie = tie;
  after.pattern.seams[seam.id] = std::move(seam);
}

std::string PocketPieces::openingName(bool first) const {
  const std::string name = op_.name + "_opening";
  if (first) return name;
  const std::string other = otherSide(name);
  return other == name ? name + "_mirrored" : other;
}

}  // namespace karinui

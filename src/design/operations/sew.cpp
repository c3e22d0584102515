#include <cmath>

#include "design/operations/operations.h"

namespace karinui {

namespace {

constexpr double kTwoToOneFrom = 1.41421356;  // nearer to 2:1 than to 1:1 in ratio
constexpr double kMostEase = 10;
constexpr int kSamples = 24;

std::string spoken(const Seam& seam) { return seam.name.empty() ? text(seam.id) : seam.name; }

std::string spoken(const Document& document, const EdgeRef& edge) {
  return document.find(edge.piece.id)->name + "." + edge.edge;
}

bool overlap(const EdgeRef& a, PieceId piece, const std::string& edge, double from, double to) {
  return a.piece.id == piece && a.edge == edge && std::fmin(a.to, to) - std::fmax(a.from, from) > 1e-6;
}

std::vector<EdgeSpan> spans(const std::vector<EdgeRef>& refs) {
  std::vector<EdgeSpan> side;
  for (const EdgeRef& ref : refs) side.push_back({ref.piece.id, ref.edge, ref.from, ref.to});
  return side;
}

// Places in space along a side, evenly by length, about their own middle: so a piece that still hangs apart is judged
// by its shape.
std::vector<Vec3> stood(const Document& document, const std::vector<EdgeSpan>& side) {
  const double whole = length(document.pattern, side);
  std::vector<Vec3> places;
  double done = 0;
  std::size_t next = 0;
  for (const EdgeSpan& span : side) {
    const Piece& piece = *document.find(span.piece);
    const Stand stand(piece);
    const Curve& curve = piece.outline.edges[*piece.outline.find(span.edge)].curve;
    const double part = length(document.pattern, {span});
    for (; next <= kSamples; ++next) {
      const double s = whole * static_cast<double>(next) / kSamples - done;
      if (s > part + 1e-12 && &span != &side.back()) break;
      places.push_back(stand(curve.atFraction(span.from + (span.to - span.from) * std::fmin(1, s / part))));
    }
    done += part;
  }
  Vec3 middle;
  for (const Vec3 p : places) middle += p * (1.0 / static_cast<double>(places.size()));
  for (Vec3& p : places) p = p - middle;
  return places;
}

}  // namespace

Done resolve(const Document& before, SewEdges& op, Context&) {
  if (op.a.empty() || op.b.empty()) return refused(say("A seam joins two sides; say both: a=… b=…."));
  std::vector<EdgeRef*> all;
  for (auto* side : {&op.a, &op.b})
    for (EdgeRef& edge : *side) all.push_back(&edge);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EdgeRef& edge = *all[i];
    if (Done done = resolve(before, edge); !done) return done;
    for (std::size_t j = 0; j < i; ++j) {
      if (overlap(edge, all[j]->piece.id, all[j]->edge, all[j]->from, all[j]->to)) {
        return refused(say("{0} cannot be sewn to itself.", spoken(before, edge)));
      }
    }
    for (const auto& [id, seam] : before.pattern.seams) {
      for (const auto* side : {&seam.a, &seam.b}) {
        for (const EdgeSpan& span : *side) {
          if (overlap(edge, span.piece, span.edge, span.from, span.to)) {
            return refused(
                say("{0} is already sewn by seam {1}; take that out first.", spoken(before, edge), spoken(seam)));
          }
        }
      }
    }
  }
  if (!op.name.empty()) {
    if (Done done = checkName(op.name); !done) return done;
    for (const auto& [id, seam] : before.pattern.seams)
      if (seam.name == op.name) return refused(say("There is already a seam “{0}”; choose another name.", op.name));
  }
  const auto a = spans(op.a), b = spans(op.b);
  const double la = length(before.pattern, a), lb = length(before.pattern, b);
  const double ratio = std::fmax(la, lb) / std::fmin(la, lb);
  if (!(ratio <= kMostEase)) {
    return refused(say("One side of this seam is {0} times as long as the other; that much cannot be gathered.",
                       written(std::round(ratio * 10) / 10)));
  }
  if (op.reversed == Choice::Auto)
    op.reversed = facesReversed(stood(before, a), stood(before, b)) ? Choice::Yes : Choice::No;
  if (op.tie == SewEdges::Tie::Auto) {
    op.tie = ratio >= kTwoToOneFrom ? SewEdges::Tie::TwoToOne : SewEdges::Tie::OneToOne;
  }
  return {};
}

Result<Document> perform(const Document& before, const SewEdges& op, Context&) {
  Document after = before;
  Seam seam;
  seam.id = mint<SeamId>(before, 0);
  seam.name = op.name;
  seam.a = spans(op.a);
  seam.b = spans(op.b);
  seam.reversed = op.reversed == Choice::Yes;
  seam.tie = op.tie == SewEdges::Tie::TwoToOne ? Seam::Tie::TwoToOne : Seam::Tie::OneToOne;
  for (const auto* side : {&seam.a, &seam.b})
    for (const EdgeSpan& span : *side) after.drape.dirty.insert(span.piece);
  after.pattern.seams[seam.id] = std::move(seam);
  return after;
}

}  // namespace karinui

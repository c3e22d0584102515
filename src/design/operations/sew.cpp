#include <algorithm>
#include <cmath>

#include "design/operations/new_piece.h"
#include "design/operations/sewn_runs.h"
#include "design/sewn_corners.h"
#include "design/spoken.h"
#include "karinui/design/sewing.h"

namespace karinui {

namespace {

constexpr double kTwoToOneFrom = 1.41421356;  // nearer to 2:1 than to 1:1 in ratio
constexpr double kMostEase = 10;
constexpr double kTiny = 0.01;  // metres: sides as short as that meet in a place, however unequal they are

// Without the seams that are in the way, if they are to go.
Document cleared(const Document& before, const SewEdges& op) {
  Document after = before;
  if (!op.replace) return after;
  for (const auto* side : {&op.a, &op.b})
    for (const SeamId id : seamsOn(after, *side)) {
      const Seam& seam = after.pattern.seams.at(id);
      for (const auto* held : {&seam.a, &seam.b})
        for (const EdgeSpan& span : *held) after.drape.dirty.insert(span.piece);
      after.pattern.seams.erase(id);
    }
  return after;
}

// The parts of an edge to which nothing is sewn yet, as they are typed: "yoke.top@0.5:1".
std::string freeOf(const Document& document, const EdgeRef& edge) {
  constexpr double kLeast = 0.005;  // metres: nothing is sewn to less
  std::vector<std::pair<double, double>> taken;
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto* held : takenSides(seam))
      for (const EdgeSpan& span : *held)
        if (span.piece == edge.piece.id && span.edge == edge.edge) taken.emplace_back(span.from, span.to);
  std::sort(taken.begin(), taken.end());
  taken.emplace_back(1, 1);
  std::string all;
  double from = 0;
  for (const auto& [start, end] : taken) {
    EdgeRef part = edge;
    part.from = from, part.to = start;
    if (start > from && lengthOf(document, {part}) > kLeast) {
      const std::string& piece = document.find(edge.piece.id)->name;
      all += (all.empty() ? "" : ", ") + piece + "." + edge.edge + "@" + written(std::round(from * 1e3) / 1e3) + ":" +
             written(std::round(start * 1e3) / 1e3);
    }
    from = std::fmax(from, end);
  }
  return all;
}

// Places on edges are told and typed by thousandths: a part that reaches a hair into what is sewn already ends there.
void endAtSeams(const Document& document, EdgeRef& edge) {
  constexpr double kHair = 1.5e-3;  // metres
  constexpr double kSame = 1e-9;    // of an edge
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto* held : takenSides(seam))
      for (const EdgeSpan& span : *held) {
        if (span.piece != edge.piece.id || span.edge != edge.edge) continue;
        EdgeRef both = edge;
        both.from = std::fmax(edge.from, span.from), both.to = std::fmin(edge.to, span.to);
        if (both.to - both.from < kSame || lengthOf(document, {both}) > kHair) continue;
        const bool atStart = both.from<edge.from + kSame, atEnd = both.to> edge.to - kSame;
        if (atStart != atEnd) (atStart ? edge.from : edge.to) = atStart ? both.to : both.from;
      }
}

bool onOutlines(const Document& document, const std::vector<EdgeRef>& side) {
  return std::all_of(side.begin(), side.end(), [&](const EdgeRef& edge) {
    return document.find(edge.piece.id)->outline.find(edge.edge).has_value();
  });
}

void sew(Document& document, const SewEdges& op, SeamId id) {
  Seam seam;
  seam.id = id;
  seam.name = op.name;
  seam.a = spansOf(op.a);
  seam.b = spansOf(op.b);
  seam.reversed = op.reversed == Choice::Yes;
  seam.tie = op.tie == SewEdges::Tie::TwoToOne ? Seam::Tie::TwoToOne
             : op.tie == SewEdges::Tie::Pleat  ? Seam::Tie::Pleat
                                               : Seam::Tie::OneToOne;
  for (const auto* side : {&seam.a, &seam.b})
    for (const EdgeSpan& span : *side) document.drape.dirty.insert(span.piece);
  document.pattern.seams[id] = std::move(seam);
}

// The seam that was probably meant, in the place of the one that is there by then; pieces by their names, to be read.
SewEdges sewnInstead(const Document& document, SewEdges meant) {
  meant.replace = true;
  for (auto* side : {&meant.a, &meant.b})
    for (EdgeRef& edge : *side) {
      const std::string& name = document.find(edge.piece.id)->name;
      edge.piece = PieceRef();
      edge.piece.name = name;
    }
  return meant;
}

bool lieOn(const std::vector<EdgeRef>& side, const std::vector<EdgeSpan>& held) {
  return std::any_of(side.begin(), side.end(), [&](const EdgeRef& ref) {
    return std::any_of(held.begin(), held.end(),
                       [&](const EdgeSpan& span) { return span.piece == ref.piece.id && span.edge == ref.edge; });
  });
}

// Where a zip joins two edges no seam joins them, or a place would be tied to two others. A seam between them that
// comes a few millimetres too far ends where the zip ends.
Done clearOfZips(const Document& document, SewEdges& op) {
  constexpr double kTooFar = 0.01;  // metres
  constexpr double kSame = 1e-6;    // of an edge
  for (const auto& [name, own] : document.allowances.fastenings) {
    Fastening whole = own;
    whole.zipped = 1;
    const auto zip = zipSeam(document.pattern, whole);
    if (!zip || !((lieOn(op.a, zip->a) && lieOn(op.b, zip->b)) || (lieOn(op.a, zip->b) && lieOn(op.b, zip->a))))
      continue;
    for (auto* side : {&op.a, &op.b})
      for (EdgeRef& edge : *side)
        for (const auto* held : {&zip->a, &zip->b})
          for (const EdgeSpan& span : *held) {
            if (span.piece != edge.piece.id || span.edge != edge.edge) continue;
            const double from = std::fmax(edge.from, span.from), to = std::fmin(edge.to, span.to);
            if (to - from < kSame) continue;
            EdgeRef both = edge;
            both.from = from, both.to = to;
            const bool atStart = from<edge.from + kSame, atEnd = to> edge.to - kSame;
            if (atStart == atEnd || lengthOf(document, {both}) > kTooFar)
              return refused(say("The zip “{0}” closes {1}; sew the part that it leaves, or take it out first.", name,
                                 spoken(document, edge)));
            (atStart ? edge.from : edge.to) = atStart ? to : from;
          }
  }
  return {};
}

}  // namespace

Done resolve(const Document& given, SewEdges& op, Context& context) {
  if (op.a.empty() || op.b.empty()) return refused(say("A seam joins two sides; say both: a=… b=…."));
  std::vector<EdgeRef*> all;
  for (auto* side : {&op.a, &op.b})
    for (EdgeRef& edge : *side) all.push_back(&edge);
  for (EdgeRef* edge : all)
    if (Done done = resolveSewn(given, *edge); !done) return done;
  const Document before = withOneCurve(given, op.a, op.b);
  if (!context.recorded)
    if (Done done = clearOfZips(before, op); !done) return done;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EdgeRef& edge = *all[i];
    for (std::size_t j = 0; j < i; ++j)
      if (overlap(edge, *all[j])) return refused(say("{0} cannot be sewn to itself.", spoken(before, edge)));
    const bool over = op.tie == SewEdges::Tie::Pleat && i < op.a.size();
    if (op.replace || over || lineOf(before, edge)) continue;  // to a line several things can be sewn
    if (!context.recorded) endAtSeams(before, edge);
    for (const SeamId id : seamsOn(before, {edge})) {
      const std::string free = freeOf(before, edge);
      if (free.empty())
        return refused(say("{0} is already sewn by seam {1}; take that out first.", spoken(before, edge),
                           spoken(*before.find(id))));
      return refused(say("{0} is already sewn there by seam {1}; take that out first, or sew to what is free: {2}.",
                         spoken(before, edge), spoken(*before.find(id)), free));
    }
  }
  for (auto* side : {&op.a, &op.b}) {
    *side = inOutlineOrder(before, std::move(*side));
    if (!context.recorded && brokenRun(before, *side) && onOutlines(before, *side))
      if (auto run = asOneRun(before, *side)) *side = *std::move(run);
    if (!context.recorded && onOutlines(before, *side)) *side = asTheyFollow(before, std::move(*side));
  }
  if (!op.name.empty()) {
    if (Done done = checkName(op.name); !done) return done;
    for (const auto& [id, seam] : cleared(before, op).pattern.seams)  // a seam that goes leaves its name free
      if (seam.name == op.name) return refused(say("There is already a seam “{0}”; choose another name.", op.name));
  }
  const double la = lengthOf(before, op.a), lb = lengthOf(before, op.b);
  const double ratio = std::fmax(la, lb) / std::fmin(la, lb);
  if (!(ratio <= kMostEase) && std::fmax(la, lb) > kTiny) {
    return refused(say("One side of this seam is {0} times as long as the other; that much cannot be gathered.",
                       written(std::round(ratio * 10) / 10)));
  }
  if (op.reversed == Choice::Auto) {
    BodyPtr body;
    if (before.body.chosen()) {
      auto found = bodyOf(before, context);
      if (!found) return found.error();
      body = *std::move(found);
    }
    op.reversed = facesReversed(before, op, body.get()) ? Choice::Yes : Choice::No;
  }
  if (!context.recorded && onOutlines(before, op.a) && onOutlines(before, op.b)) meetAsRings(before, op);
  if (op.tie == SewEdges::Tie::Auto) {
    op.tie = ratio >= kTwoToOneFrom ? SewEdges::Tie::TwoToOne : SewEdges::Tie::OneToOne;
  }
  if (op.mirror)
    if (const auto image = mirrorImage(cleared(before, op), op); !image) return image.error();
  return {};
}

Result<Document> perform(const Document& given, const SewEdges& op, Context& context) {
  const Document before = withOneCurve(given, op.a, op.b);
  if (context.advise)
    for (const SeamDoubt& doubt : seamDoubts(before, op, context.bodies.known(before.body.hash).get())) {
      Advice advice{doubt.what};
      // Sewn to the other side, edge and image are those of each other: what is in the way of one is so of both.
      const bool both = doubt.kind == SeamDoubt::Kind::OtherSide;
      if (doubt.instead && (!op.mirror || both) && doubt.kind != SeamDoubt::Kind::Sewn)
        advice.mend = sewnInstead(before, *doubt.instead);
      context.advise(advice);
    }
  Document after = cleared(before, op);
  // The image is found before the seam is there: it may stand in its own way only where resolve() refused it.
  std::optional<SewEdges> image;
  if (op.mirror) {
    auto found = mirrorImage(after, op);
    if (!found) return found.error();
    image = *std::move(found);
  }
  sew(after, op, mint<SeamId>(before, 0));
  if (image) sew(after, *image, mint<SeamId>(before, 1));
  return after;
}

}  // namespace karinui

// Seams are taken in or let out.
#include <algorithm>
#include <cmath>
#include <set>

#include "design/operations/operations.h"
#include "design/operations/pocket_follows.h"
#include "karinui/base/number.h"
#include "karinui/design/edge_run.h"
#include "karinui/design/step_words.h"
#include "karinui/pattern/allowance.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

constexpr double kMostTakenIn = 0.5;  // metres
constexpr double kAtAnEnd = 1e-3;     // metres: nearer to an end than this is the end
constexpr double kSameShare = 1e-6;

using TakenEdge = std::pair<PieceId, std::string>;

bool lies(const EdgeSpan& span, const TakenEdge& edge) { return span.piece == edge.first && span.edge == edge.second; }

// Those of the operation, each followed by what it is sewn to.
std::vector<TakenEdge> meant(const Document& document, const TakeIn& op) {
  std::vector<TakenEdge> all;
  const auto add = [&](const TakenEdge& edge) {
    if (std::find(all.begin(), all.end(), edge) == all.end()) all.push_back(edge);
  };
  for (const EdgeRef& ref : op.edges) {
    const TakenEdge edge{ref.piece.id, ref.edge};
    add(edge);
    if (op.partners == Choice::No) continue;
    for (const auto& [id, seam] : document.pattern.seams)
      for (const auto& [own, other] : {std::pair(&seam.a, &seam.b), std::pair(&seam.b, &seam.a)})
        if (std::any_of(own->begin(), own->end(), [&](const EdgeSpan& span) { return lies(span, edge); }))
          for (const EdgeSpan& span : *other) add({span.piece, span.edge});
  }
  return all;
}

void tellTakenIn(double by, const std::string& edges, const Context& context) {
  if (context.advise)
    context.advise({by > 0 ? say("Taken in by {0} mm: {1}.", fixed(by * 1e3, 1), edges)
                           : say("Let out by {0} mm: {1}.", fixed(-by * 1e3, 1), edges)});
}

// One edge after another, as records of before have it: a corner between two of them went twice as far, and what a
// symmetric copy is sewn to stayed.
Result<Document> oneByOne(const Document& before, const TakeIn& op, Context& context) {
  Document after = before;
  std::set<TakenEdge> moved;
  std::string said;
  for (const TakenEdge& edge : meant(before, op)) {
    if (moved.contains(edge)) continue;
    const Piece piece = *after.find(edge.first);
    auto in = moveEdge(piece, edge.second, op.by, op.whole == Choice::Yes);
    if (!in) return in.error();
    moved.insert(edge);
    ReshapePiece reshape;  // marks, seams, the shape in space and the symmetric copy follow as they do there
    reshape.piece = edge.first;
    reshape.outline = std::move(in->outline);
    const auto symmetry = op.symmetric == Choice::No ? std::nullopt : symmetryOf(piece.outline);
    if (const auto k = piece.outline.find(edge.second); symmetry && k) {
      if (const auto other = symmetry->partner[*k]) moved.insert({edge.first, piece.outline.edges[*other].name});
      reshape.outline = onBothHalves(piece.outline, std::move(reshape.outline), *symmetry);
    }
    const Document was = after;
    auto next = cutAnew(was, reshape);
    if (!next) return next.error();
    after = *std::move(next);
    for (const auto& [id, one] : after.pattern.pieces) {  // symmetric copies have followed
      const Piece& old = *was.find(id);
      if (id != edge.first && one->outline != old.outline) moved.insert({id, otherSide(edge.second)});
    }
    said += (said.empty() ? "" : ", ") + piece.name + "." + edge.second;
  }
  tellTakenIn(op.by, said, context);
  tellMisfits(before, after, context);
  return after;
}

// --- All at once.

// Where a share of an edge's length is on the edges it is sewn to; both may be parts of their sides.
class ThroughSeam {
 public:
  ThroughSeam(const Pattern& pattern, const Seam& seam, bool fromA) : seam_(seam), fromA_(fromA) {
    for (const auto* side : {&seam.a, &seam.b}) {
      double along = 0;
      for (const EdgeSpan& span : *side) {
        const double whole = findCurve(*pattern.pieces.at(span.piece), span.edge)->length();
        parts_[side == &seam.b].push_back({along, whole});
        along += (span.to - span.from) * whole;
      }
      length_[side == &seam.b] = along;
    }
  }
  double operator()(std::size_t own, std::size_t other, double at) const {
    const EdgeSpan& span = (fromA_ ? seam_.a : seam_.b)[own];
    const Part& here = parts_[!fromA_][own];
    double share = (here.along + (at - span.from) * here.whole) / length_[!fromA_];
    if (seam_.reversed) share = 1 - share;
    const EdgeSpan& there = (fromA_ ? seam_.b : seam_.a)[other];
    const Part& part = parts_[fromA_][other];
    const double place = there.from + (share * length_[fromA_] - part.along) / part.whole;
    return std::fabs(place) < kSameShare ? 0 : std::fabs(place - 1) < kSameShare ? 1 : place;
  }

 private:
  struct Part {
    double along = 0, whole = 0;  // of the side, before it; of the edge
  };
  const Seam& seam_;
  bool fromA_;
  std::vector<Part> parts_[2];
  double length_[2] = {};
};

struct Carried {
  TakenEdge edge;
  std::optional<Taper> taper;
  bool image = false;  // of another one of them: it follows that one
  bool other = false;  // on another piece, a symmetric copy
  bool lets = false;   // it is let out as far as the others are taken in
};

// Every edge that goes: those of the operation, their images on other halves and copies, what all these are sewn to,
// and the images of that.
class EdgesThatGo {
 public:
  EdgesThatGo(const Document& document, const TakeIn& op)
      : document_(document), op_(op), pockets_(seamsOfPockets(document.pattern)) {}

  Result<std::vector<Carried>> find() {
    for (const EdgeRef& ref : op_.edges) {
      const double whole =
          document_.find(ref.piece.id)->outline.edges[*indexOf({ref.piece.id, ref.edge})].curve.length();
      std::optional<Taper> taper;
      if (op_.at) taper = Taper{0, *op_.at * whole < kAtAnEnd ? 0 : (1 - *op_.at) * whole < kAtAnEnd ? 1 : *op_.at, 1};
      if (Done done = add({ref.piece.id, ref.edge}, taper); !done) return done.error();
    }
    lets_ = op_.moves;
    for (std::size_t i = 0, own = all_.size(); op_.partners != Choice::No && i < own; ++i)
      if (Done done = addSewn(all_[i]); !done) return done.error();
    // Beyond a slanted pocket's edge a side goes on as that of the side piece. Its bags follow by themselves.
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (all_[i].taper) continue;
      lets_ = all_[i].lets;
      for (const EdgeRef& beyond :
           beyondPockets(document_.pattern, {PieceRef(all_[i].edge.first), all_[i].edge.second}))
        if (Done done = add({beyond.piece.id, beyond.edge}, {}); !done) return done.error();
    }
    return all_;
  }

 private:
  std::optional<std::size_t> indexOf(const TakenEdge& edge) const {
    return document_.find(edge.first)->outline.find(edge.second);
  }
  bool push(Carried carried) {
    carried.lets = lets_;
    if (std::any_of(all_.begin(), all_.end(), [&](const Carried& one) { return one.edge == carried.edge; }))
      return false;
    all_.push_back(std::move(carried));
    return true;
  }
  // A seam between two that are each other's image, as the centre front, cannot go to one side.
  Done bothWays(const TakenEdge& edge) const {
    const auto other = std::find_if(all_.begin(), all_.end(), [&](const Carried& one) { return one.edge == edge; });
    if (!lets_ || other == all_.end() || other->lets) return {};
    return refused(
        say("{0} is to be taken in and let out at once: that seam is the middle of the garment, or between "
            "two of the edges that are named. A seam that moves goes to one side of it.",
            edgeSaid(document_, {PieceRef(edge.first), edge.second})));
  }
  // With its images.
  Done add(const TakenEdge& edge, const std::optional<Taper>& taper) {
    const auto k = indexOf(edge);
    if (!k || !push({edge, taper})) return {};
    const Piece& piece = *document_.find(edge.first);
    const auto turned = taper ? std::optional(taper->reversed()) : std::nullopt;
    const auto symmetry = op_.symmetric == Choice::No ? std::nullopt : symmetryOf(piece.outline);
    std::vector<TakenEdge> here{edge};
    if (const auto other = symmetry ? symmetry->partner[*k] : std::nullopt) {
      if (*other == *k && taper && std::fabs(taper->most - turned->most) > kSameShare)
        return refused(
            say("{0} goes across the middle of “{1}”; write at=0.5, or symmetric=no.", edge.second, piece.name));
      if (*other != *k) {
        here.push_back({edge.first, piece.outline.edges[*other].name});
        push({here.back(), turned, true});
      }
    }
    for (const TakenEdge& one : here)
      for (const PieceId copy : likenesses(document_, edge.first))
        if (const auto name = edgeOnCopy(*document_.find(copy), piece, one.second))
          push({{copy, *name}, one == edge ? turned : taper, true, true});
    return {};
  }
  Done addSewn(const Carried from) {
    for (const auto& [id, seam] : document_.pattern.seams)
      for (const bool a : {true, false}) {
        if (pockets_.contains(id)) continue;
        const auto &own = a ? seam.a : seam.b, &others = a ? seam.b : seam.a;
        for (std::size_t i = 0; i < own.size(); ++i) {
          if (!lies(own[i], from.edge)) continue;
          const ThroughSeam through(document_.pattern, seam, a);
          for (std::size_t j = 0; j < others.size(); ++j) {
            const TakenEdge other{others[j].piece, others[j].edge};
            std::optional<Taper> taper;
            if (from.taper) {
              taper = Taper{through(i, j, from.taper->from), through(i, j, from.taper->most),
                            through(i, j, from.taper->to)};
              if (taper->from > taper->to) std::swap(taper->from, taper->to);
              if (taper->to <= 0 || taper->from >= 1) continue;  // it is sewn to another part of the seam
              const bool abrupt = taper->most == taper->from || taper->most == taper->to;
              if (abrupt && taper->most > 0 && taper->most < 1)
                return refused(
                    say("{0} ends where {1}, to which it is sewn, goes on; say another place, or partners=no.",
                        edgeSaid(document_, {PieceRef(from.edge.first), from.edge.second}),
                        edgeSaid(document_, {PieceRef(other.first), other.second})));
            }
            if (Done done = bothWays(other); !done) return done;
            if (Done done = add(other, taper); !done) return done;
          }
        }
      }
    return {};
  }

  const Document& document_;
  const TakeIn& op_;
  std::set<SeamId> pockets_;
  std::vector<Carried> all_;
  bool lets_ = false;  // those that are added now
};

Result<Document> allAtOnce(const Document& before, const TakeIn& op, Context& context) {
  const auto all = EdgesThatGo(before, op).find();
  if (!all) return all.error();
  Document after = before;
  std::string said, letOut;
  for (const Carried& first : *all) {
    const PieceId id = first.edge.first;
    std::string& list = first.lets ? letOut : said;
    if (!first.image || first.other)
      list += (list.empty() ? "" : ", ") + before.find(id)->name + "." + first.edge.second;
    const Piece& piece = *before.find(id);
    if (after.find(id)->outline != piece.outline) continue;  // carried already, or as a copy
    std::vector<EdgeCarry> carries;
    for (const Carried& one : *all)
      if (one.edge.first == id)
        carries.push_back({one.edge.second, one.lets ? -op.by : op.by, one.taper, op.follow == Choice::Yes});
    const auto symmetry = op.symmetric == Choice::No ? std::nullopt : symmetryOf(piece.outline);
    auto carried = carryEdges(piece, carries, symmetry ? &*symmetry : nullptr);
    if (!carried) return carried.error();
    ReshapePiece reshape;  // marks, seams, the shape in space and the symmetric copy follow as they do there
    reshape.piece = id;
    reshape.outline = std::move(carried->outline);
    auto next = cutAnew(after, reshape);
    if (!next) return next.error();
    after = *std::move(next);
  }
  if (op.moves && letOut.empty())
    return refused(say("A seam moves where there is one: {0} is sewn to nothing.", edgeSaid(before, op.edges.front())));
  tellTakenIn(op.by, said, context);
  if (!letOut.empty()) tellTakenIn(-op.by, letOut, context);
  tellMisfits(before, after, context);
  return after;
}

}  // namespace

bool areHems(const Document& document, const std::vector<EdgeRef>& edges) {
  const AllowancePlan plan(document.pattern, document.allowances);
  return !edges.empty() && std::all_of(edges.begin(), edges.end(), [&](const EdgeRef& edge) {
    return plan.kind(edge.piece.id, edge.edge) == EdgeKind::Hem ||
           document.allowances.hems.contains({edge.piece.id, edge.edge});
  });
}

Done resolve(const Document& before, TakeIn& op, Context& context) {
  if (op.by == 0.0 || !(std::fabs(op.by) <= kMostTakenIn))
    return refused(say("A seam is taken in or let out by up to 50 cm, not by {0} mm.", fixed(op.by * 1e3, 1)));
  if (op.at && !(*op.at >= 0 && *op.at <= 1))
    return refused(say("A place along an edge lies between 0 and 1, not at {0}.", *op.at));
  if (op.moves && op.partners == Choice::No)
    return refused(say("A seam moves with both its sides; leave partners= away, or moves=."));
  if (op.whole == Choice::Auto && !context.recorded) op.whole = Choice::Yes;
  if (op.together == Choice::Auto && !context.recorded) op.together = Choice::Yes;
  if (Done done = resolveWhole(before, op.edges, op.symmetric, context); !done) return done;
  const bool allAlong = !op.at && !op.moves && op.together == Choice::Yes;
  if (op.follow == Choice::Yes && !allAlong)
    return refused(
        say("The ends go along the edges beside them where the edge goes as far all along; leave follow= "
            "away, or at= and moves=."));
  if (op.follow == Choice::Auto && !context.recorded && allAlong)
    op.follow = areHems(before, op.edges) ? Choice::Yes : Choice::No;
  return {};
}

Result<Document> perform(const Document& before, const TakeIn& op, Context& context) {
  return op.together == Choice::Yes || op.at || op.moves ? allAtOnce(before, op, context)
                                                         : oneByOne(before, op, context);
}

}  // namespace karinui

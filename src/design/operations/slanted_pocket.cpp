// A slanted pocket: the front's upper corner is cut away, and is the beginning of a side piece that goes on beneath the
// front. A bag is caught in along the front's new edge, turned in as a facing is, and sewn to the side piece within.
// The front's edge is held on the side piece's line, as basting does until the garment is pressed.
#include <array>
#include <cmath>

#include "design/operations/cut_parts.h"
#include "design/operations/lifted_form.h"
#include "design/operations/pocket_pieces.h"
#include "design/operations/said.h"
#include "karinui/pattern/darts.h"

namespace karinui {

namespace {

constexpr double kLeastBesideSlant = 0.02;  // metres of the edge above that the bags have beyond the slanted line
const char* const kSlantEdge = "slant";

// What a slanted pocket has of the paper of a front that is not cut yet.
struct SlantPlan {
  DownEdge side;
  EdgeAbove above;
  double inset = 0, length = 0;
  double topTo = 0, sideTo = 0;  // how far the bags reach along both from the corner

  Flat onSide(double metres) const {
    const double share = metres / side.whole;
    return side.edge.curve.atFraction(side.down ? share : 1 - share);
  }
  Flat corner() const { return onSide(0); }
  Flat upper() const { return above.at(inset); }
  Flat lower() const { return onSide(length); }
};

Result<SlantPlan> slantPlanOf(const Document& document, const SewPocket& op, const EdgeRef& ref) {
  const DownEdge side = downEdgeOf(document, ref);
  SlantPlan plan{side, edgeAbove(side), *op.inset, op.length, 0, 0};
  const double top = plan.above.whole;
  if (plan.inset + kLeastBesideSlant + kToNextCorner > top)
    return refused(say("{0} is {1} cm long from the corner: a slanted pocket begins there up to {2} cm in.",
                       plan.above.edge.name, centimetres(top),
                       centimetres(std::max(0.0, top - kLeastBesideSlant - kToNextCorner))));
  plan.topTo = std::min(std::max(op.depth.metres, plan.inset + kLeastBesideSlant), top - kToNextCorner);
  plan.sideTo = plan.length + kBagBeyond;
  if (plan.sideTo > side.whole)
    return refused(say("{0} is {1} cm long; this opening ends {2} cm down it, and its bags go on for 1.5 cm.", ref.edge,
                       centimetres(side.whole), centimetres(plan.length)));
  return plan;
}

Result<std::vector<Curve>> slantedBag(const Pattern& pattern, const SewPocket& op, const SlantPlan& plan) {
  return bagLine(pattern, plan.side,
                 {0, plan.sideTo, plan.length, op.depth, op.below, plan.topTo, op.copies == Choice::Yes});
}

// The stretch of an edge beside its end (or its start), as a share.
std::pair<double, double> shareBeside(const Edge& edge, bool end, double metres) {
  const double share = std::min(1.0, metres / edge.curve.length());
  return end ? std::pair(1 - share, 1.0) : std::pair(0.0, share);
}

// A front that was cut, and the corner that fell off.
struct CutFront {
  Piece front, corner;
  std::size_t slant = 0, cornerSlant = 0;  // of their edges

  const Edge& frontEdge(int steps) const { return edgeAt(front, slant, steps); }
  const Edge& cornerEdge(int steps) const { return edgeAt(corner, cornerSlant, steps); }

 private:
  static const Edge& edgeAt(const Piece& piece, std::size_t from, int steps) {
    const auto n = static_cast<int>(piece.outline.edges.size());
    return piece.outline.edges[static_cast<std::size_t>((static_cast<int>(from) + steps + n) % n)];
  }
};

std::optional<std::size_t> edgeBetween(const Piece& piece, Flat a, Flat b) {
  constexpr double kThere = 1e-4;  // metres
  const auto& edges = piece.outline.edges;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Curve& curve = edges[k].curve;
    if (std::min(distance(curve.start, a) + distance(curve.end, b), distance(curve.start, b) + distance(curve.end, a)) <
        kThere)
      return k;
  }
  return std::nullopt;
}

std::optional<CutFront> cutFrontOf(const Document& before, const Document& cut, const SlantPlan& plan) {
  const Piece& front = *cut.find(plan.side.piece.id);
  const auto slant = edgeBetween(front, plan.upper(), plan.lower());
  if (!slant) return std::nullopt;
  for (const auto& [id, piece] : cut.pattern.pieces) {
    if (before.find(id) || piece->outline.edges.size() != 3) continue;
    const auto own = edgeBetween(*piece, plan.upper(), plan.lower());
    const bool there = std::any_of(piece->outline.edges.begin(), piece->outline.edges.end(),
                                   [&](const Edge& edge) { return distance(edge.curve.start, plan.corner()) < 1e-6; });
    if (own && there) return CutFront{front, *piece, *slant, *own};
  }
  return std::nullopt;
}

// The fronts without their corners, on both halves where that is meant.
Result<Document> withoutCorners(const Document& before, const SewPocket& op, const SlantPlan& plan, Context& context) {
  constexpr double kOut = 0.002;  // metres: the line runs out of the piece at both ends
  const Flat way = normalized(plan.lower() - plan.upper()) * kOut;
  CutPiece cut;
  cut.piece = op.edge.piece;
  cut.line = {plan.upper() - way, plan.lower() + way};
  cut.name = usableName(before, op.name + "_side");
  cut.edge = kSlantEdge;
  cut.corners = Choice::No, cut.twins = Choice::No, cut.quantities = Choice::Yes;
  if (op.copies == Choice::Yes)
    (likenesses(before, op.edge.piece.id).empty() ? cut.symmetric : cut.copies) = Choice::Yes;
  Context silent = context;
  silent.advise = {};
  silent.recorded = true;  // all of it is decided
  if (Done done = resolve(before, cut, silent); !done) return done.error();
  return perform(before, cut, op.copies == Choice::Yes ? silent : context);
}

struct SlantPieces {
  PieceId side, bag;
};

Result<SlantPieces> slantSewn(PocketPieces& made, const Document& before, const SewPocket& op, const SlantPlan& plan,
                              bool first) {
  const auto cut = cutFrontOf(before, made.after, plan);
  if (!cut) return refused(say("The corner of “{0}” cannot be cut away there.", plan.side.piece.name));
  const auto line = slantedBag(before.pattern, op, plan);
  if (!line) return line.error();
  const bool down = plan.side.down;
  const int on = down ? 1 : -1;  // from the slanted edge on to what is left of the side
  const Edge top = cut->frontEdge(-on), low = cut->frontEdge(on), slant = cut->frontEdge(0);
  const Edge cornerTop = cut->cornerEdge(on), cornerSide = cut->cornerEdge(-on);
  const auto topShare = shareBeside(top, down, plan.topTo - plan.inset),
             lowShare = shareBeside(low, !down, plan.sideTo - plan.length);
  const auto running = [&](const Curve& curve) { return down ? curve : curve.reversed(); };
  const Curve topPart = running(curvePart(top.curve, topShare.first, topShare.second)),
              lowPart = running(curvePart(low.curve, lowShare.first, lowShare.second));
  const Curve inner = Curve::joined(*line);
  const Piece& outer = plan.side.piece;  // as it was, with its corner
  const PieceId front = outer.id;

  Piece side = cut->corner;
  side.outline = bagOutline({{"top_under", topPart},
                             {cornerTop.name, running(cornerTop.curve)},
                             {cornerSide.name, running(cornerSide.curve)},
                             {"side_under", lowPart},
                             {kBagInner, inner}},
                            down);
  if (auto sound = checked(side.outline); !sound) return sound.error();
  side.lines.push_back({kSlantEdge, {slant.curve}, std::nullopt});
  side.layer = made.after.find(front)->layer - 2;
  const Flat across = normalized(leftOf(plan.lower() - plan.upper())) * (down ? 1.0 : -1.0);
  auto form = made.beneath(side, outer, [&](Flat place) {
    constexpr double kUnder = 0.01;  // metres behind the line within which the cloth goes under the front
    return std::clamp(dot(place - plan.upper(), across) / kUnder, 0.0, 1.0) * 2 * kLayersApart;
  });
  if (!form) return form.error();
  side.form = *std::move(form), side.pose = outer.pose;
  side.mirrorOf = {};
  const PieceId sideId = side.id;
  made.after = withPiece(std::move(made.after), std::move(side));

  DividedPart bag;
  bag.inner = kBagInner;
  bag.outline = bagOutline(
      {{kBagTop, topPart}, {kSlantEdge, running(slant.curve)}, {kBagSide, lowPart}, {kBagInner, inner}}, down);
  if (auto sound = checked(bag.outline); !sound) return sound.error();
  const auto bagId = made.addBag(bag, {}, outer, 1, made.nameOf("bag", first));
  if (!bagId) return bagId.error();

  const EdgeSpan topSpan{front, top.name, topShare.first, topShare.second},
      lowSpan{front, low.name, lowShare.first, lowShare.second};
  std::vector<EdgeSpan> caught{topSpan, {front, slant.name, 0, 1}, lowSpan},
      bagSpans{{*bagId, kBagTop, 0, 1}, {*bagId, kSlantEdge, 0, 1}, {*bagId, kBagSide, 0, 1}};
  if (!down) std::reverse(caught.begin(), caught.end()), std::reverse(bagSpans.begin(), bagSpans.end());
  // Pleat: the front's edges are sewn to others as well.
  made.sew(std::move(caught), std::move(bagSpans), Seam::Tie::Pleat, false);
  made.sew({topSpan}, {{sideId, "top_under", 0, 1}}, Seam::Tie::Pleat, false);
  made.sew({lowSpan}, {{sideId, "side_under", 0, 1}}, Seam::Tie::Pleat, false);
  made.sew({{*bagId, kBagInner, 0, 1}}, {{sideId, kBagInner, 0, 1}}, Seam::Tie::OneToOne, false);
  made.sew({{front, slant.name, 0, 1}}, {{sideId, kSlantEdge, 0, 1}}, Seam::Tie::OneToOne, false,
           made.openingName(first));
  return SlantPieces{sideId, *bagId};
}

}  // namespace

Done checkSlanted(const Document& document, const SewPocket& op, const EdgeRef& edge) {
  const auto plan = slantPlanOf(document, op, edge);
  if (!plan) return plan.error();
  for (const PaperDart& dart : dartsOf(document.pattern))
    if (dart.piece == edge.piece.id)
      for (const std::size_t leg : {dart.to, dart.back})
        if (const std::string& name = plan->side.piece.outline.edges[leg].name;
            name == edge.edge || name == plan->above.edge.name)
          return refused(say("{0} is a side of a dart; a slanted pocket lies between two edges of the outline.", name));
  if (const auto line = slantedBag(document.pattern, op, *plan); !line) return line.error();
  return {};
}

Result<Document> withSlanted(const Document& before, const SewPocket& op, Context& context) {
  const std::vector<EdgeRef> edges = pocketEdges(before, op);
  std::vector<SlantPlan> plans;
  std::vector<PieceId> fronts;
  for (const EdgeRef& edge : edges) {
    auto plan = slantPlanOf(before, op, edge);
    if (!plan) return plan.error();
    plans.push_back(*std::move(plan));
    fronts.push_back(edge.piece.id);
  }
  auto cut = withoutCorners(before, op, plans.front(), context);
  if (!cut) return cut;
  PocketPieces made(before, op, *std::move(cut));
  if (Done done = made.room(fronts); !done) return done.error();
  std::vector<SlantPieces> pieces;
  for (const SlantPlan& plan : plans) {
    const auto both = slantSewn(made, before, op, plan, pieces.empty());
    if (!both) return both.error();
    pieces.push_back(*both);
  }
  if (pieces.size() == 2) {
    made.after = withLikeness(std::move(made.after), pieces[0].side, pieces[1].side);
    made.after = withLikeness(std::move(made.after), pieces[0].bag, pieces[1].bag);
  }
  return std::move(made.after);
}

}  // namespace karinui

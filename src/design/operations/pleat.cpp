#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "design/operations/lifted_form.h"
#include "design/operations/new_piece.h"
#include "design/operations/operations.h"
#include "design/operations/sewn_runs.h"
#include "karinui/design/sewing.h"
#include "karinui/pattern/pleats.h"

namespace karinui {

namespace {

constexpr double kAtEnd = 1e-6;        // of an edge
constexpr double kClearOfEnds = 0.01;  // metres
constexpr double kToEnd = 0.005;       // metres: stitching that ends as near to the line's end runs to it

Flat across(Flat p) { return {-p.u, p.v}; }

// The direction the pleats run in: along the grain where that leads into the piece, or square to the edge.
Flat directionOf(const Piece& piece, const EdgeRef& ref) {
  const Curve& curve = piece.outline.edges[*piece.outline.find(ref.edge)].curve;
  const Flat inward = leftOf(normalized(curve.atFraction(ref.to) - curve.atFraction(ref.from)));
  const Flat grain = normalized(piece.grain) * (dot(piece.grain, inward) < 0 ? -1 : 1);
  constexpr double kAlong = 0.7071;  // within 45 degrees
  return dot(grain, inward) >= kAlong ? grain : inward;
}

// Whether the pleats' direction leads out of the piece all along that part of the edge. Folds are counted along the
// edge as it is seen into the piece: told the other way they would lie in the wrong order.
bool leadsOut(const Piece& piece, const AddPleat& op) {
  const Curve& curve = piece.outline.edges[*piece.outline.find(op.edge.edge)].curve;
  const double from = op.edge.from, to = op.edge.to, shares[] = {from, (from + to) / 2, to, op.at.value_or(from)};
  return std::all_of(std::begin(shares), std::end(shares), [&](double share) {
    return dot(*op.along, leftOf(curve.tangent(curve.parameterAt(share * curve.length())))) < 0;
  });
}

PleatPlan planOf(const Piece& piece, const AddPleat& op) {
  PleatPlan plan;
  plan.edge = op.edge.edge, plan.kind = op.kind, plan.depth = op.depth, plan.name = op.name;
  plan.taper = op.taper, plan.taperLength = op.taperLength;
  if (op.along) plan.along = normalized(*op.along);
  const double whole = op.edge.to - op.edge.from;
  const double length = piece.outline.edges[*piece.outline.find(op.edge.edge)].curve.length();
  // The middle of what a knife pleat covers is its place.
  const double half = op.kind == PleatKind::Knife ? op.depth / 2 / length : 0;
  // A kilt's cover more than they are apart. Where the outer two would reach past the ends, all are spread between.
  // Sewn down, they stay clear of the ends: a line along the side could not be laid as cloth.
  const double outer = whole / 2 / op.count, room = std::fmax(0, whole / 2 - half),
               clear = op.stitch > 0 ? std::fmin(kClearOfEnds / length, room) : 0;
  const bool between = op.count > 1 && 2 * half <= whole &&
                       (op.edge.from + outer - half < -kAtEnd || op.edge.to - outer + half > 1 + kAtEnd);
  for (int n = 0; n < op.count; ++n) {
    const double share = (n + 0.5) / op.count;
    using Turned = AddPleat::Turned;
    const bool first = share < 0.5;
    plan.toStart.push_back(op.turned == Turned::Against || (op.turned == Turned::Inwards && !first) ||
                           (op.turned == Turned::Outwards && first));
    const double middle = between
                              ? std::lerp(op.edge.from + half + clear, op.edge.to - half - clear, n / (op.count - 1.0))
                              : op.edge.from + whole * share;
    plan.at.push_back(op.at ? *op.at : middle + (plan.toStart.back() ? -half : half));
  }
  return plan;
}

// What is sewn onto a piece, as a pocket, by the inner lines that hold it.
std::map<PieceId, std::set<std::string>> sewnOnto(const Document& document, const Piece& piece) {
  std::map<PieceId, std::set<std::string>> on;
  for (const auto& [id, seam] : document.pattern.seams)
    for (const bool a : {true, false})
      for (const EdgeSpan& span : a ? seam.a : seam.b)
        if (const PieceId other = (a ? seam.b : seam.a).front().piece;
            span.piece == piece.id && other != piece.id && !findEdge(piece, span.edge))
          on[other].insert(span.edge);
  return on;
}

Result<PleatedPiece> pleated(const Document& document, const Piece& whole, const AddPleat& op) {
  const auto foldIn = [&](const Piece& piece, bool sewnBeyond) {
    if (!op.lines.empty())
      return foldDrawn(
          piece, {op.lines[0].edge, op.lines[1].edge, op.lines[2].edge, normalized(*op.along), op.name, sewnBeyond});
    PleatPlan plan = planOf(piece, op);
    plan.sewnBeyond = sewnBeyond;
    return addPleats(piece, plan);
  };
  auto made = foldIn(whole, false);
  if (!made && op.lines.empty())
    for (const auto& [patch, lines] : sewnOnto(document, whole)) {
      Piece bare = whole;
      std::erase_if(bare.lines, [&](const InternalLine& line) { return lines.contains(line.name); });
      if (foldIn(bare, false))
        return refused(
            say("The pleats would run through “{0}”, which is sewn onto “{1}” there. Fold them beside it, or "
                "before it is sewn on.",
                document.find(patch)->name, whole.name));
    }
  if (!made || seamsOn(document, {{PieceRef(whole.id), made->beyondOf}}).empty()) return made;
  return foldIn(whole, true);
}

// The ends of a fold where it is farther from its place, and where nearer; the same place twice: it is as far all
// along.
std::pair<Flat, Flat> endsByWidth(const InternalLine& fold, const InternalLine& place) {
  constexpr double kAsFar = 2e-3;  // metres
  const Flat from = fold.curves.front().start, to = fold.curves.back().end, along = normalized(to - from);
  Flat beside = place.curves.front().start, beyond = place.curves.back().end;
  if (dot(beyond - beside, along) < 0) std::swap(beside, beyond);
  const double first = std::fabs(cross(along, beside - from)), last = std::fabs(cross(along, beyond - from));
  if (std::fabs(first - last) <= kAsFar) return {from, from};
  return first > last ? std::pair(from, to) : std::pair(to, from);
}

// The three lines are there, and which edge they run from.
Done resolveLines(const Document& before, AddPleat& op) {
  if (op.lines.size() != 3)
    return refused(
        say("A pleat is drawn with three lines: the fold, the fold inside it, and where the fold comes to lie."));
  if (op.kind != PleatKind::Knife || op.count != 1 || op.at || op.taper > 0)
    return refused(
        say("A drawn pleat has its place and depth from its lines; leave kind=, count=, at= and taper= away."));
  for (EdgeRef& ref : op.lines) {
    ref.from = 0, ref.to = 1;
    if (Done done = resolveSewn(before, ref); !done) return done;
    if (!lineOf(before, ref)) return refused(say("“{0}” is an edge; a pleat is drawn with inner lines.", ref.edge));
    if (ref.piece.id != op.lines.front().piece.id) return refused(say("The three lines of a pleat lie on one piece."));
  }
  const Piece& piece = *before.find(op.lines.front().piece.id);
  const InternalLine& fold = lineNamed(piece, op.lines.front().edge);
  Flat near = fold.curves.front().start, far = fold.curves.back().end;
  const auto away = [](const Curve& curve, Flat place) {
    double least = HUGE_VAL;
    for (const Flat p : curve.evenly(0, 1, 100)) least = std::min(least, distance(p, place));
    return least;
  };
  if (op.edge) {
    if (Done done = resolve(before, op.edge); !done) return done;
    const Edge* edge = op.edge.piece.id == piece.id ? findEdge(piece, op.edge.edge) : nullptr;
    if (!edge) return refused(say("The edge and the lines of a pleat belong to one piece."));
    if (away(edge->curve, far) < away(edge->curve, near)) std::swap(near, far);
  } else {
    // Where they come nearer to each other they run out; else they run down.
    const auto [wide, narrow] = endsByWidth(fold, lineNamed(piece, op.lines.back().edge));
    if (far.v > near.v) std::swap(near, far);
    if (distance(wide, narrow) > 0) near = wide, far = narrow;
    const auto& edges = piece.outline.edges;
    op.edge = {PieceRef(piece.id), std::min_element(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
                                     return away(a.curve, near) < away(b.curve, near);
                                   })->name};
  }
  op.along = normalized(far - near);
  return {};
}

// Pleats that are folded one after the other stand together, when the last of them is.
struct PleatSeries {
  const Document& first;  // before all of them
  std::vector<PleatedPiece> earlier;
  std::uint32_t seams = 0;  // that they have made
  bool last = false;
};

class Pleating {
 public:
  Pleating(const Document& before, const AddPleat& op, const PleatedPiece& made, const PleatSeries& all)
      : before_(before), op_(op), made_(made), was_(*before.find(op.edge.piece.id)), all_(all), seams_(all.seams) {}

  Result<Document> performed() {
    press();
    std::vector<PieceId> others;
    after_ = withEdit(before_, made_.edited, &others);
    finishBeyond(was_.id, [](const std::string& name) { return name; });
    sew(was_.id, [](const EdgeSpan& span) { return span; });
    if (Done done = stand(was_.id, [&](Flat place) { return folded(place); }); !done) return done.error();
    movePins(was_.id, [&](Flat place) { return made_.spread(place); });
    for (const PieceId other : others)
      if (Done done = onCopy(other); !done) return done.error();
    return std::move(after_);
  }
  std::uint32_t seams() const { return seams_; }

 private:
  void press() {
    if (op_.hold <= 0) return;
    const auto crease = [&](const std::string& name, double angle) {
      for (InternalLine& line : made_.edited.piece.lines)
        if (line.name == name) line.crease = Crease{angle, op_.hold};
    };
    for (const PleatFold& fold : made_.folds)
      crease(fold.fold, -Crease::kSharpest), crease(fold.inner, Crease::kSharpest);
  }

  // New parts of the edge the pleats end in are finished as it is.
  void finishBeyond(PieceId id, const std::function<std::string(const std::string&)>& named) {
    const auto give = [&](auto& all) {
      const auto own = all.find({id, named(made_.beyondOf)});
      if (own == all.end()) return;
      const auto value = own->second;
      for (const std::string& name : made_.beyond) all[{id, named(name)}] = value;
    };
    give(after_.allowances.edges), Allowances::eachFinish(after_.allowances, give);
  }

  void sew(PieceId id, const std::function<EdgeSpan(const EdgeSpan&)>& led) {
    const auto add = [&](const EdgeSpan& a, const EdgeSpan& b, bool reversed, Seam::Tie tie) {
      Seam seam;
      seam.id = mint<SeamId>(before_, seams_++);
      seam.a = {led(a)}, seam.b = {led(b)};
      seam.a.front().piece = seam.b.front().piece = id;
      seam.reversed = reversed, seam.tie = tie;
      after_.pattern.seams[seam.id] = std::move(seam);
    };
    for (const auto& layer : made_.layers) add(layer.a, layer.b, layer.reversed, Seam::Tie::Pleat);
    if (!(op_.stitch > 0)) return;
    // Sewn down: the fold to the line where it comes to lie. Lines keep their names on a copy.
    for (const PleatFold& fold : made_.folds) {
      const Piece& piece = *after_.find(id);
      const double whole = findCurve(piece, fold.fold)->length();
      const double to = op_.stitch < whole - kToEnd ? op_.stitch / whole : 1;
      Seam seam;
      seam.id = mint<SeamId>(before_, seams_++);
      seam.a = {{id, fold.place, 0, to}}, seam.b = {{id, fold.fold, 0, to}};
      seam.reversed = false;
      after_.pattern.seams[seam.id] = std::move(seam);
    }
  }

  // Folded in place, each layer over the other. A piece that stands nowhere yet stays flat.
  Done stand(PieceId id, const std::function<FoldedPlace(Flat)>& folded) {
    const Piece& old = *all_.first.find(id);
    if (!all_.last || (!old.form && old.pose == Rigid())) return {};
    Piece now = *after_.find(old.id);
    const auto whole = wholeOf(old);
    std::vector<const Seam*> sewn;
    for (std::uint32_t k = 0; k < seams_; ++k) sewn.push_back(&after_.pattern.seams.at(mint<SeamId>(before_, k)));
    const auto edge = nodesOfSewnLayers(now, before_.settings.spacing, sewn);
    if (!edge) return edge.error();
    auto form = liftedForm(now, old, before_.settings.spacing, [&](Flat place) {
      const FoldedPlace in = folded(place);
      // Where the layers are sewn to each other they lie together, no higher at a fold than beside it.
      if (!made_.overlapping && edge->contains({place.u, place.v})) return LiftedPlace{whole(in.place), kLayersApart};
      return LiftedPlace{whole(in.place + in.clear), in.lifted * kLayersApart, made_.taper > 0 || made_.wedge};
    });
    if (!form) return form.error();
    now.form = *std::move(form);
    after_ = withPiece(std::move(after_), std::move(now));
    return {};
  }

  // On the paper as it was before the first of the pleats.
  FoldedPlace folded(Flat place) const {
    FoldedPlace in = made_.folded(place);
    for (auto before = all_.earlier.rbegin(); before != all_.earlier.rend(); ++before) {
      const FoldedPlace further = before->folded(in.place);
      in = {further.place, in.lifted + further.lifted, in.clear + further.clear};
    }
    return in;
  }

  // The paper of a drawn pleat stands with all its cloth: what is left of it is spread over the same room, which the
  // drape then draws together. Flat paper is folded together at once.
  std::function<Flat(Flat)> wholeOf(const Piece& old) const {
    if (!made_.drawn || !old.form) return [](Flat place) { return place; };
    if (made_.wedge) {
      const auto reopened = made_.wedge->reopened(was_.outline);
      if (old.id == was_.id) return reopened;
      return [reopened](Flat place) { return across(reopened(across(place))); };
    }
    const Flat across = old.id == was_.id ? made_.across : Flat{-made_.across.u, made_.across.v};
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Flat p : old.outline.flattened(1e-3))
      low = std::min(low, dot(p, across)), high = std::max(high, dot(p, across));
    const double stretch = (high - low) / (high - low - 2 * made_.depth);
    return [=](Flat place) { return place + across * ((dot(place, across) - low) * (stretch - 1)); };
  }

  void movePins(PieceId id, const std::function<Flat(Flat)>& spread) {
    const auto pins = after_.pins.find(id);
    if (pins == after_.pins.end()) return;
    for (Flat& pin : pins->second) pin = spread(pin);
  }

  // A symmetric copy: its outline was pleated likewise; its edges run the other way round.
  Done onCopy(PieceId id) {
    const Piece& old = *before_.find(id);
    const Outline& mine = made_.edited.piece.outline;
    const auto named = [&](const std::string& name) {
      const auto& edges = after_.find(id)->outline.edges;
      return edges[edges.size() - 1 - *mine.find(name)].name;
    };
    Piece now = *after_.find(id);
    const Piece likeness = mirrored(made_.edited.piece);
    if (old.lines == mirrored(was_).lines)
      now.lines = likeness.lines;
    else
      now.lines.insert(now.lines.end(), likeness.lines.end() - static_cast<std::ptrdiff_t>(made_.linesAdded),
                       likeness.lines.end());
    for (std::size_t k = 0; k < now.marks.size(); ++k)
      if (now.marks[k].edge.empty()) now.marks[k].place = across(made_.spread(across(now.marks[k].place)));
    after_ = withPiece(std::move(after_), std::move(now));
    finishBeyond(id, named);
    sew(id, [&](const EdgeSpan& span) { return EdgeSpan{id, named(span.edge), 1 - span.to, 1 - span.from}; });
    movePins(id, [&](Flat place) { return across(made_.spread(across(place))); });
    return stand(id, [&](Flat place) {
      const FoldedPlace in = folded(across(place));
      return FoldedPlace{across(in.place), in.lifted, across(in.clear)};
    });
  }

  const Document& before_;
  const AddPleat& op_;
  PleatedPiece made_;
  const Piece& was_;
  const PleatSeries& all_;
  Document after_;
  std::uint32_t seams_;
};

// Layers that are sewn to each other have to be bent within their depth: tucks of 10 and 15 mm on cells of 9 mm tore,
// of 10 mm on 5 mm and 20 mm on 9 mm lay.
void tellCoarse(const Document& before, const Piece& piece, const AddPleat& op, const Context& context) {
  constexpr double kTorn = 1.8, kCells = 2;  // of its depth
  const double spacing = before.settings.spacing;
  if (!context.advise || !op.lines.empty() || !(op.stitch > 0) || op.depth >= kTorn * spacing) return;
  const auto said = [](double metres) { return written(std::floor(metres * 1e4 + 1e-6) / 10); };
  context.advise({say("Pleats {0} mm deep that are sewn down may tear on cells of {1} mm; they need finer ones: set "
                      "spacing={2}mm.",
                      said(op.depth), said(spacing), said(op.depth / kCells)),
                  piece.id});
}

// Pleats that run out at another edge, one after the other: each slashes the paper the one before has left.
Result<Document> pleatedTo(const Document& before, const Piece& piece, const AddPleat& op) {
  const PleatPlan plan = planOf(piece, op);
  const AllowancePlan kinds(before.pattern, before.allowances);
  const auto onFold = [&](const std::string& edge) { return kinds.kind(piece.id, edge) == EdgeKind::Fold; };
  Document after = before;
  std::vector<EdgeMap> maps;
  PleatSeries all{before, {}};
  for (std::size_t n = 0; n < plan.at.size(); ++n) {
    // The outline runs along one edge and back along the other.
    const double share = (plan.at[n] - op.edge.from) / (op.edge.to - op.edge.from);
    Slash slash{op.edge.edge, op.to.edge, plan.at[n], op.toAt.value_or(std::lerp(op.to.to, op.to.from, share))};
    slash.by = 2 * op.depth;
    slash.stays = staying(piece.outline, slash, onFold);
    for (const EdgeMap& map : maps) {
      std::tie(slash.from, slash.at) = *placeNow(map, piece.id, slash.from, slash.at);
      std::tie(slash.to, slash.toAt) = *placeNow(map, piece.id, slash.to, slash.toAt);
    }
    auto made = addPleatTo(*after.find(piece.id), slash, plan.toStart[n], op.name);
    if (!made) return made.error();
    maps.push_back(made->edited.edges);
    all.last = n + 1 == plan.at.size();
    Pleating pleating(after, op, *made, all);
    auto next = pleating.performed();
    if (!next) return next;
    all.seams = pleating.seams(), all.earlier.push_back(*std::move(made));
    after = *std::move(next);
  }
  return after;
}

// The same pleats on the other half of a symmetric piece; nothing where that has no such edge, or where they lie across
// the middle and are their own image.
std::optional<AddPleat> pleatsOnOtherHalf(const Piece& piece, const PaperSymmetry& symmetry, const AddPleat& op) {
  const std::size_t own = *piece.outline.find(op.edge.edge);
  const auto image = [&](double at) { return imageOf(piece.outline, symmetry, {own, at}); };
  const auto from = image(op.edge.to), to = image(op.edge.from);  // the other half runs the other way round
  if (!from || !to || from->edge != to->edge || !(from->at < to->at)) return std::nullopt;
  AddPleat other = op;
  other.edge = {op.edge.piece, piece.outline.edges[from->edge].name, from->at, to->at};
  if (op.at) {
    const auto at = image(*op.at);
    if (!at || at->edge != from->edge) return std::nullopt;
    other.at = at->at;
  }
  using Turned = AddPleat::Turned;
  if (op.turned == Turned::Along) other.turned = Turned::Against;
  if (op.turned == Turned::Against) other.turned = Turned::Along;
  if (op.along) other.along = symmetry.imageOf(*op.along);
  const auto same = [](double a, double b) { return std::fabs(a - b) < kAtEnd; };
  const bool sameRun =
      other.edge.edge == op.edge.edge && same(other.edge.from, op.edge.from) && same(other.edge.to, op.edge.to);
  if (sameRun && (!op.at || same(*other.at, *op.at))) return std::nullopt;
  return other;
}

// Whether they run across the middle, as those of a sash from side to side: what is one half's is the other's then.
bool runAcross(const Piece& piece, const PaperSymmetry& symmetry, const AddPleat& op) {
  const Curve& curve = piece.outline.edges[*piece.outline.find(op.edge.edge)].curve;
  const Flat square = leftOf(symmetry.axis), along = normalized(*op.along);
  const Ring ring = piece.outline.flattened(1e-4);
  const double from = op.edge.from, to = op.edge.to, shares[] = {from, (from + to) / 2, to, op.at.value_or(from)};
  return std::any_of(std::begin(shares), std::end(shares), [&](double share) {
    const Flat start = curve.atFraction(share);
    const double away = dot(start - symmetry.through, square), nearer = -dot(along, square);
    const double reach = away / nearer;
    return std::fabs(nearer) > 1e-9 && reach > kAtEnd && contains(ring, start + along * reach);
  });
}

// On both halves, one after the other, and then folded together.
Result<Document> pleatedTwice(const Document& before, const AddPleat& op, AddPleat other) {
  const PieceId id = op.edge.piece.id;
  PleatSeries all{before, {}};
  auto made = pleated(before, *before.find(id), op);
  if (!made) return made.error();
  const EdgeMap map = made->edited.edges;
  Pleating first(before, op, *made, all);
  auto half = first.performed();
  if (!half) return half;
  all.seams = first.seams(), all.last = true, all.earlier.push_back(*std::move(made));
  const auto now = [&](double at) { return placeNow(map, id, other.edge.edge, at); };
  const auto from = now(other.edge.from), to = now(other.edge.to), at = now(other.at.value_or(other.edge.from));
  if (!from || !to || !at || from->first != to->first || at->first != from->first)
    return refused(say("The pleats of both halves would meet; write symmetric=no for one alone."));
  other.edge.edge = from->first, other.edge.from = from->second, other.edge.to = to->second;
  if (other.at) other.at = at->second;
  const auto then = pleated(*half, *half->find(id), other);
  if (!then) return then.error();
  return Pleating(*half, other, *then, all).performed();
}

// Auto is decided. An edge across the middle has its pleats told place by place: it is taken as it is said.
Done resolvePleatedHalves(const Document& before, AddPleat& op, Context& context) {
  if (context.recorded && op.symmetric == Choice::Auto) op.symmetric = Choice::No;
  if (op.symmetric == Choice::No) return {};
  const Piece& piece = *before.find(op.edge.piece.id);
  const bool plain = op.lines.empty() && !op.to;
  if (op.symmetric == Choice::Yes && !plain)
    return refused(
        say("Pleats that are drawn, or that run out at another edge, are folded on one half; leave symmetric= away."));
  const auto symmetry = symmetryOf(piece.outline);
  const bool across = symmetry && symmetry->partner[*piece.outline.find(op.edge.edge)] ==
                                      std::optional(*piece.outline.find(op.edge.edge));
  const bool half = AllowancePlan(before.pattern, before.allowances).onFold(piece),
             over = plain && symmetry && runAcross(piece, *symmetry, op);
  if (op.symmetric == Choice::Yes && over)
    return refused(say("The pleats of both halves would meet; write symmetric=no for one alone."));
  if (op.symmetric == Choice::Auto && (!plain || across || half || over)) {
    op.symmetric = Choice::No;
    return {};
  }
  return resolveSymmetric(piece, op.symmetric, context, [&](const PaperSymmetry& of) {
    return across || pleatsOnOtherHalf(piece, of, op).has_value();
  });
}

Done resolveTo(const Document& before, AddPleat& op) {
  if (!op.to) {
    if (op.toAt)
      return refused(say("to_at is a place on the edge at which the pleat runs out; name that, too: to=EDGE."));
    return {};
  }
  if (!op.lines.empty()) return refused(say("A drawn pleat ends where its lines do; leave to= away."));
  if (op.kind != PleatKind::Knife)
    return refused(
        say("Pleats that run out at another edge are knife pleats; two of them, turned=outwards or inwards, make a box "
            "or inverted pleat."));
  if (op.taper > 0) return refused(say("A pleat that runs out at another edge tapers to there; leave taper= away."));
  if (Done done = resolve(before, op.to); !done) return done;
  if (op.to.piece.id != op.edge.piece.id || op.to.edge == op.edge.edge)
    return refused(say("A pleat runs out at another edge of its piece."));
  if (op.toAt && op.count > 1)
    return refused(say("The place is that of a single pleat; several are spread over the edge or a part of it."));
  if (op.toAt && !(*op.toAt >= 0 && *op.toAt <= 1))
    return refused(say("A place on an edge lies between 0, its beginning, and 1, its end."));
  return {};
}

}  // namespace

Done resolve(const Document& before, AddPleat& op, Context& context) {
  if (!op.lines.empty()) {
    if (Done done = resolveLines(before, op); !done) return done;
  } else {
    if (!op.edge)
      return refused(
          say("Say which edge is pleated: edge=skirt.waist; or three lines that are drawn: "
              "lines=\"skirt.fold skirt.inner skirt.place\"."));
    if (Done done = resolve(before, op.edge); !done) return done;
  }
  if (Done done = resolveTo(before, op); !done) return done;
  if (op.name.empty()) op.name = "pleat";
  if (Done done = checkName(op.name); !done) return done;
  if (op.count < 1 || op.count > 200) return refused(say("An edge takes 1 to 200 pleats."));
  if (op.at && op.count > 1)
    return refused(say("The place is that of a single pleat; several are spread over the edge or a part of it."));
  if (op.at && !(*op.at >= 0 && *op.at <= 1))
    return refused(say("A pleat lies between 0, the edge's beginning, and 1, its end."));
  if (!(op.taper >= 0 && op.taperLength >= 0)) return refused(say("A taper and its length are 0 or more."));
  if (op.taperLength > 0 && op.taper == 0 && !context.recorded)
    return refused(say("taper_length says where the taper ends; say by how much the pleats taper, too: taper=16mm."));
  if (!(op.stitch >= 0)) return refused(say("A pleat is sewn down for a length, or not at all (0)."));
  if (op.hold != 0 && !Crease{0, op.hold}.sound()) return refused(say("A fold holds 0.1 to 0.99 of its angle."));
  if (op.along && !(length(*op.along) > 1e-6 && finite(*op.along)))
    return refused(say("The pleats have no direction; write along=0,1 for upwards."));
  const Piece& piece = *before.find(op.edge.piece.id);
  if (op.to) {
    if (op.along) return refused(say("Pleats that run out at another edge lead straight there; leave along= away."));
    return resolvePleatedHalves(before, op, context);
  }
  if (!op.along) op.along = directionOf(piece, op.edge);
  if (!context.recorded && op.lines.empty() && leadsOut(piece, op)) op.along = Flat{} - *op.along;
  return resolvePleatedHalves(before, op, context);
}

Result<Document> perform(const Document& before, const AddPleat& op, Context& context) {
  const Piece& piece = *before.find(op.edge.piece.id);
  if (op.to) {
    auto made = pleatedTo(before, piece, op);
    if (made) tellCoarse(before, piece, op, context);
    return made;
  }
  if (op.symmetric == Choice::Yes)
    if (const auto other = pleatsOnOtherHalf(piece, *symmetryOf(piece.outline), op)) {
      auto both = pleatedTwice(before, op, *other);
      if (both) tellCoarse(before, piece, op, context);
      return both;
    }
  const auto made = pleated(before, piece, op);
  if (!made) return made.error();
  tellCoarse(before, piece, op, context);
  return Pleating(before, op, *made, {before, {}, 0, true}).performed();
}

}  // namespace karinui

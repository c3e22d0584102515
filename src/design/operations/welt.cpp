// A welt pocket: a slit within a piece, between two stitched lines. The welt, one piece that stands up or one strip for
// both jets, closes it and is sewn on along the box. Behind hang two bags: the front one from the lower line, the back
// one, of the piece's own cloth, which shows where the pocket gapes, from the upper one. The slit and the cuts into the
// corners are drawn; the cloth itself stays whole, as it is while the pocket is basted closed.
#include <cmath>

#include "design/operations/lifted_form.h"
#include "design/operations/pocket_pieces.h"
#include "design/operations/said.h"
#include "karinui/pattern/lattice.h"
#include "karinui/pattern/likeness.h"

namespace karinui {

namespace {

constexpr double kBagWider = 0.015;  // metres, than the opening, on both sides
constexpr double kWeltSeam = 0.01, kJetEnds = 0.02, kJetBehind = 0.015;
constexpr double kBesideBox = 2e-3;  // metres of cloth between the pocket and an edge
constexpr double kUsualAngle = 1.6;  // radians: a slit is turned by a right angle at most

// The box that is stitched, on the paper of a piece: from its middle along the slit and up from it.
struct WeltBox {
  Flat middle, along, up;
  double length = 0, width = 0;
  Flat operator()(double across, double high) const { return middle + along * across + up * high; }
  Flat corner(int side, int high) const { return (*this)(side * length / 2, high * width / 2); }
};

WeltBox boxOn(const SewWelt& op, bool mirrored) {
  const double turn = mirrored ? -op.turn.radians : op.turn.radians, side = mirrored ? -1 : 1;
  const Flat along{std::cos(turn), std::sin(turn)};
  return {{side * op.at.u, op.at.v}, along, leftOf(along), *op.length, *op.width};
}

Outline boxOutline(const WeltBox& box) {
  const auto line = [&](const char* name, Flat from, Flat to) { return Edge{name, Curve::line(from, to)}; };
  return {{line("low", box.corner(-1, -1), box.corner(1, -1)), line("end_right", box.corner(1, -1), box.corner(1, 1)),
           line("top", box.corner(1, 1), box.corner(-1, 1)), line("end_left", box.corner(-1, 1), box.corner(-1, -1))}};
}

// From the left end of the box's lower line round the bag to its right end.
Curve bagRound(const WeltBox& box, double below) {
  const double half = box.length / 2 + kBagWider, low = -box.width / 2, bottom = low - below, turn = 0.03;
  const std::vector<Curve> parts{Curve::line(box.corner(-1, -1), box(-half, low)),
                                 Curve::line(box(-half, low), box(-half, bottom + turn)),
                                 Curve::cubic(box(-half, bottom + turn), box(-half, bottom + turn * 0.45),
                                              box(-half + turn * 0.55, bottom), box(-half + turn, bottom)),
                                 Curve::line(box(-half + turn, bottom), box(half - turn, bottom)),
                                 Curve::cubic(box(half - turn, bottom), box(half - turn * 0.55, bottom),
                                              box(half, bottom + turn * 0.45), box(half, bottom + turn)),
                                 Curve::line(box(half, bottom + turn), box(half, low)),
                                 Curve::line(box(half, low), box.corner(1, -1))};
  return Curve::joined(parts);
}

DividedPart frontBag(const WeltBox& box, double below) {
  DividedPart bag;
  bag.outline = {{{kBagTop, Curve::line(box.corner(1, -1), box.corner(-1, -1))}, {kBagInner, bagRound(box, below)}}};
  return bag;
}
DividedPart backBag(const WeltBox& box, double below) {
  DividedPart bag;
  bag.outline = {{{kBagTop, Curve::line(box.corner(1, 1), box.corner(-1, 1))},
                  {"end_left", Curve::line(box.corner(-1, 1), box.corner(-1, -1))},
                  {kBagInner, bagRound(box, below)},
                  {"end_right", Curve::line(box.corner(1, -1), box.corner(1, 1))}}};
  return bag;
}

bool liesWithin(const Piece& piece, const Outline& part) {
  const Ring ring = piece.outline.flattened(1e-4);
  for (const Flat place : part.flattened(2e-3)) {
    if (!contains(ring, place) || distanceToRing(ring, place) < kBesideBox) return false;
    for (const Outline& hole : piece.holes)
      if (contains(hole.flattened(1e-4), place)) return false;
  }
  return true;
}

Done checkWeltRoom(const Document& document, const SewWelt& op, PieceId id, bool mirrored) {
  const Piece& piece = *document.find(id);
  const WeltBox box = boxOn(op, mirrored);
  if (!liesWithin(piece, boxOutline(box)))
    return refused(
        say("The box of a welt pocket there, {0} × {1} cm, leaves “{2}” or runs into a dart of it. Place it "
            "elsewhere by at=, or make it shorter by length=.",
            centimetres(box.length), centimetres(box.width), piece.name));
  if (liesWithin(piece, backBag(box, op.below).outline)) return {};
  for (double less = std::floor(op.below * 100 - 1e-6) / 100; less >= 0.05; less -= 0.01)
    if (liesWithin(piece, backBag(box, less).outline))
      return refused(say("“{0}” has no room for bags that hang {1} cm below the box; {2} cm have.", piece.name,
                         centimetres(op.below), centimetres(less)));
  return refused(
      say("“{0}” has no room for the bags of a welt pocket there: they are {1} cm wide and hang {2} cm below "
          "the box. Place it elsewhere by at=.",
          piece.name, centimetres(box.length + 2 * kBagWider), centimetres(op.below)));
}

class WeltPocket {
 public:
  WeltPocket(const Document& before, const SewWelt& op)
      : op_(op), likePocket_(bagsOf(op)), made_(before, likePocket_, before) {}

  Result<Document> sewnInto(const std::vector<PieceId>& pieces) {
    if (Done done = made_.room(pieces); !done) return done.error();
    std::vector<std::array<PieceId, 3>> all;
    for (const PieceId id : pieces) {
      const auto one = sewInto(id, !all.empty());
      if (!one) return one.error();
      all.push_back(*one);
    }
    for (std::size_t k = 1; k < all.size(); ++k)
      for (std::size_t part = 0; part < 3; ++part)
        made_.after = withLikeness(std::move(made_.after), all[0][part], all[k][part]);
    return std::move(made_.after);
  }

 private:
  static SewPocket bagsOf(const SewWelt& op) {
    SewPocket like;
    like.name = op.name, like.fabric = op.fabric;
    return like;
  }

  std::string lineName(const Piece& piece, const char* what) const {
    const std::string wanted = op_.name + "_" + what;
    std::string name = wanted;
    for (int n = 2; findCurve(piece, name) ||
                    std::any_of(piece.lines.begin(), piece.lines.end(), [&](const auto& l) { return l.name == name; });
         ++n)
      name = wanted + "_" + std::to_string(n);
    return name;
  }

  // The welt and both bags.
  Result<std::array<PieceId, 3>> sewInto(PieceId id, bool copy) {
    const bool jetted = op_.kind == SewWelt::Kind::Jetted;
    const WeltBox box = boxOn(op_, copy);
    Piece outer = *made_.after.find(id);
    const auto draw = [&](const char* what, std::vector<Curve> curves) {
      outer.lines.push_back({lineName(outer, what), std::move(curves), std::nullopt});
      return EdgeSpan{id, outer.lines.back().name, 0, 1};
    };
    const auto line = [&](const char* what, Flat from, Flat to) { return draw(what, {Curve::line(from, to)}); };
    // As the bags' upper edges run.
    const EdgeSpan lower = line("low", box.corner(1, -1), box.corner(-1, -1)),
                   upper = line("top", box.corner(1, 1), box.corner(-1, 1)),
                   left = line("end_left", box.corner(-1, 1), box.corner(-1, -1)),
                   right = line("end_right", box.corner(1, -1), box.corner(1, 1));
    const double in = box.length / 2 - std::min(0.01, box.length / 4);
    draw("slit", {Curve::line(box.corner(-1, 1), box(-in, 0)), Curve::line(box(-in, 0), box(in, 0)),
                  Curve::line(box(in, 0), box.corner(1, 1))});
    line("slit_left", box.corner(-1, -1), box(-in, 0)), line("slit_right", box.corner(1, -1), box(in, 0));
    made_.after = withPiece(std::move(made_.after), outer);

    Piece welt;
    welt.id = made_.pieceId();
    welt.name = made_.nameOf("welt", !copy);
    welt.outline = boxOutline(box);
    welt.grain = outer.grain, welt.fabric = outer.fabric;
    welt.layer = std::min(outer.layer + 1, 20);
    welt.pose = outer.pose;
    auto form = made_.beneath(welt, outer, [](Flat) { return -kLayersApart; });
    if (!form) return form.error();
    welt.form = *std::move(form);
    const PieceId weltId = welt.id;
    made_.after = withPiece(std::move(made_.after), std::move(welt));
    // What is turned in is cut on: of a single welt its facing, of a strip for two jets both of them and what lies
    // behind.
    const auto cutOn = [&](const char* edge, double width) { made_.after.allowances.edges[{weltId, edge}] = width; };
    cutOn("top", box.width + (jetted ? kJetBehind : kWeltSeam));
    cutOn("low", jetted ? box.width + kJetBehind : kWeltSeam);
    for (const char* end : {"end_left", "end_right"}) cutOn(end, jetted ? kJetEnds : kWeltSeam);

    const auto sewWelt = [&](const char* edge, const EdgeSpan& on, bool reversed) {
      made_.sew({{weltId, edge, 0, 1}}, {on}, Seam::Tie::OneToOne, reversed);
    };
    sewWelt("low", lower, true), sewWelt("end_left", left, false), sewWelt("end_right", right, false);
    if (jetted) sewWelt("top", upper, false);

    const auto front = made_.addBag(frontBag(box, op_.below), {}, outer, 1, made_.nameOf("bag_front", !copy));
    if (!front) return front.error();
    const auto back = made_.addBag(backBag(box, op_.below), {}, outer, 2, made_.nameOf("bag_back", !copy));
    if (!back) return back.error();
    Piece facing = *made_.after.find(*back);
    facing.fabric = outer.fabric;
    made_.after = withPiece(std::move(made_.after), std::move(facing));
    made_.sew({lower}, {{*front, kBagTop, 0, 1}}, Seam::Tie::Pleat, false);
    made_.sew({upper}, {{*back, kBagTop, 0, 1}}, Seam::Tie::Pleat, false);
    made_.sew({{*front, kBagInner, 0, 1}}, {{*back, kBagInner, 0, 1}}, Seam::Tie::OneToOne, false);
    return std::array{weltId, *front, *back};
  }

  const SewWelt& op_;
  SewPocket likePocket_;
  PocketPieces made_;
};

}  // namespace

Done resolve(const Document& before, SewWelt& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (Done done = checkName(op.name); !done) return done;
  const bool jetted = op.kind == SewWelt::Kind::Jetted;
  if (!op.length) op.length = Length{jetted ? 0.135 : 0.105};
  if (!op.width) op.width = Length{jetted ? 0.01 : 0.022};
  if (!finite(op.at)) return refused(say("Say where on the piece the middle of the slit comes."));
  if (!(std::abs(op.turn.radians) <= kUsualAngle)) return refused(say("A welt pocket is turned by 90° at most."));
  if (!(*op.length >= 0.05 && *op.length <= 0.25))
    return refused(say("The opening of a welt pocket is 5 to 25 cm long."));
  if (!(*op.width >= 0.006 && *op.width <= 0.06)) return refused(say("The box of a welt pocket is 0.6 to 6 cm high."));
  if (!(op.below >= 0.05 && op.below <= 0.4))
    return refused(say("The bags of a welt pocket hang 5 to 40 cm below the box."));
  if (op.fabric.empty()) op.fabric = "cotton";
  if (Done done = checkFabricName(before, op.fabric); !done) return done;
  if (Done done = resolveCopies(before, {op.piece}, op.copies, context); !done) return done;
  if (Done done = checkWeltRoom(before, op, op.piece.id, false); !done) return done;
  for (const PieceId copy : copiesMeant(before, op.piece.id, op.copies))
    if (Done done = checkWeltRoom(before, op, copy, true); !done) return done;
  return {};
}

Result<Document> perform(const Document& before, const SewWelt& op, Context& context) {
  std::vector<PieceId> pieces{op.piece.id};
  for (const PieceId copy : copiesMeant(before, op.piece.id, op.copies)) pieces.push_back(copy);
  auto after = WeltPocket(before, op).sewnInto(pieces);
  if (!after || context.recorded) return after;
  const double spacing = before.settings.spacing;
  if (lay(before.pattern, spacing) && !lay(after->pattern, spacing))
    return refused(
        say("A welt pocket cannot be set in there: its box runs into a dart, a line or another pocket of "
            "“{0}”. Move it by a centimetre.",
            before.find(op.piece.id)->name));
  return after;
}

}  // namespace karinui

#include <algorithm>
#include <cmath>

#include "design/operations/lifted_form.h"
#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/design/sewing.h"

namespace karinui {

namespace {

// Where the paper of the sewn piece lies on the paper of the other.
struct Laid {
  Flat middle, at;
  double cosine = 1, sine = 0;
  Flat operator()(Flat p) const {
    const Flat d = p - middle;
    return at + Flat{d.u * cosine - d.v * sine, d.u * sine + d.v * cosine};
  }
  Curve operator()(const Curve& curve) const {
    Curve now = curve;
    for (Flat* p : {&now.start, &now.end}) *p = (*this)(*p);
    if (curve.kind == Curve::Kind::Cubic)
      for (Flat* p : {&now.control1, &now.control2}) *p = (*this)(*p);
    for (Flat& p : now.between) p = (*this)(p);
    return now;
  }
};

Laid laidOn(const Piece& piece, const SewPatch& op) {
  const FlatBox box = boxOf(piece.outline.flattened(1e-4));
  return {lerp(box.low, box.high, 0.5), op.at, std::cos(op.turn), std::sin(op.turn)};
}

bool isOpen(const SewPatch& op, const std::string& edge) {
  return std::find(op.open.begin(), op.open.end(), edge) != op.open.end();
}

// The sewn edges as runs that go on over corners, each beginning behind an open edge.
std::vector<std::vector<const Edge*>> sewnRuns(const Outline& outline, const SewPatch& op) {
  const std::size_t n = outline.edges.size();
  std::size_t first = 0;
  for (std::size_t k = 0; k < n; ++k)
    if (isOpen(op, outline.edges[k].name)) first = k;
  std::vector<std::vector<const Edge*>> runs;
  bool goesOn = false;
  for (std::size_t k = 0; k < n; ++k) {
    const Edge& edge = outline.edges[(first + k) % n];
    if (isOpen(op, edge.name)) {
      goesOn = false;
      continue;
    }
    if (!goesOn) runs.emplace_back();
    goesOn = true;
    runs.back().push_back(&edge);
  }
  return runs;
}

// What is said of a place off the paper, with where the middle of the sewn piece has room.
Message outside(const Piece& piece, const Piece& on, const Laid& laid, const std::string& edge) {
  FlatBox own;
  for (const Edge& side : piece.outline.edges)
    for (const Flat p : laid(side.curve).flattened(1e-3)) own.include(p - laid.at);
  const FlatBox paper = boxOf(on.outline.flattened(1e-3));
  const Flat from = paper.low - own.low, to = paper.high - own.high;
  if (from.u > to.u || from.v > to.v)
    return say("{0} is larger than {1} there; turn it, or make it smaller.", piece.name, on.name);
  const auto cm = [](double metres) { return fixed(metres * 100, 0); };
  return say(
      "{0} does not lie on {1} there: its edge {2} leaves it. Its middle comes between {3} and {4} cm across, and {5} "
      "and {6} cm up on the paper of {1}.",
      piece.name, on.name, edge, cm(from.u), cm(to.u), cm(from.v), cm(to.v));
}

}  // namespace

Done resolve(const Document& before, SewPatch& op, Context&) {
  if (Done done = resolve(before, op.piece); !done) return done;
  if (Done done = resolve(before, op.on); !done) return done;
  if (op.piece == op.on) return refused(say("A piece cannot be sewn onto itself."));
  const Piece &piece = *before.find(op.piece.id), &on = *before.find(op.on.id);
  for (const std::string& name : op.open)
    if (!piece.outline.find(name)) {
      EdgeRef edge{op.piece, name};
      return resolve(before, edge);  // says which edges there are
    }
  std::size_t sewn = 0;
  for (const Edge& edge : piece.outline.edges) {
    if (isOpen(op, edge.name)) continue;
    ++sewn;
    for (const SeamId id : seamsOn(before, {{op.piece, edge.name}})) {
      const Seam& seam = *before.find(id);
      return refused(say("{0}.{1} is already sewn by seam {2}; take that out first, or leave the edge open.",
                         piece.name, edge.name, seam.name.empty() ? text(id) : seam.name));
    }
  }
  if (sewn == 0) return refused(say("All edges of {0} are left open; at least one has to be sewn.", piece.name));
  if (!finite(op.at) || !(std::abs(op.turn) <= 100)) return refused(say("That turn is too large."));
  const Laid laid = laidOn(piece, op);
  const Ring ring = on.outline.flattened(1e-4);
  constexpr double kInside = 0.002;  // metres: nearer to the edge there is no room to sew
  for (const Edge& edge : piece.outline.edges)
    for (const Flat p : laid(edge.curve).flattened(1e-4)) {
      const bool open = isOpen(op, edge.name);
      if (!open && (!contains(ring, p) || distanceToRing(ring, p) < kInside))
        return refused(outside(piece, on, laid, edge.name));
      for (const Outline& hole : on.holes)
        if (!open && contains(hole.flattened(1e-4), p))
          return refused(say("{0} would be sewn over a hole of {1}; choose another place.", piece.name, on.name));
    }
  return {};
}

Result<Document> perform(const Document& before, const SewPatch& op, Context& context) {
  Piece piece = *before.find(op.piece.id), on = *before.find(op.on.id);
  const Laid laid = laidOn(piece, op);
  const auto taken = [&](const std::string& name) {
    return findEdge(on, name) ||
           std::any_of(on.lines.begin(), on.lines.end(), [&](const InternalLine& line) { return line.name == name; });
  };
  Document after = before;
  std::uint32_t seams = 0;
  for (const auto& run : sewnRuns(piece.outline, op)) {
    Seam seam;
    seam.id = mint<SeamId>(before, seams++);
    seam.reversed = false;
    for (const Edge* edge : run) {
      const std::string wanted = piece.name + "_" + edge->name;
      std::string name = wanted;
      for (int n = 2; taken(name); ++n) name = wanted + "_" + std::to_string(n);
      on.lines.push_back({name, {laid(edge->curve)}, std::nullopt});
      seam.a.push_back({piece.id, edge->name, 0, 1});
      seam.b.push_back({on.id, name, 0, 1});
    }
    after.pattern.seams[seam.id] = std::move(seam);
  }
  auto form = liftedForm(piece, on, before.settings.spacing, [&](Flat place) {
    return LiftedPlace{laid(place), kLayersApart};
  });
  if (!form) return form.error();
  piece.form = *std::move(form), piece.pose = on.pose;
  piece.layer = std::max(piece.layer, std::min(on.layer + 1, 20));
  const std::string name = piece.name, onName = on.name;
  after = withPiece(std::move(after), std::move(on));
  after = withPiece(std::move(after), std::move(piece));
  // Said here, where it can be helped, and not at the next drape.
  const double spacing = before.settings.spacing;
  if (!context.recorded && lay(before.pattern, spacing) && !lay(after.pattern, spacing))
    return refused(
        say("“{0}” cannot be sewn on there: its line runs into an edge, a dart or another line of “{1}”. Move it by a "
            "centimetre.",
            name, onName));
  return after;
}

}  // namespace karinui

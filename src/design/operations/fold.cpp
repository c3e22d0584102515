#include <algorithm>
#include <cmath>
#include <numbers>

#include "design/operations/finished_edges.h"
#include "design/operations/lifted_form.h"
#include "design/operations/operations.h"
#include "design/spoken.h"
#include "karinui/base/number.h"
#include "karinui/design/glossary.h"
#include "karinui/pattern/turn_back.h"

namespace karinui {

namespace {

// A line across a piece, by which its paper is parted.
class Parting {
 public:
  Parting(const Piece& piece, const InternalLine& line) {
    for (const Curve& curve : line.curves)
      for (const Flat place : curve.flattened(1e-4))
        if (points_.empty() || distance(points_.back(), place) > 1e-6) points_.push_back(place);
    smallerToTheLeft_ = 2 * leftShare(piece) < 1;
  }
  bool beyond(Flat place) const { return left(place) == smallerToTheLeft_; }
  Flat foot(Flat place) const { return nearest(place).foot; }
  bool reachesAcross(const Piece& piece) const {
    constexpr double kReach = 0.003;  // metres
    const Ring ring = piece.outline.flattened();
    return points_.size() > 1 && distanceToRing(ring, points_.front()) < kReach &&
           distanceToRing(ring, points_.back()) < kReach;
  }

 private:
  struct Near {
    Flat foot, along;
  };
  // Beyond its ends the line goes straight on.
  Near nearest(Flat place) const {
    Near best{points_.front(), {1, 0}};
    double least = HUGE_VAL;
    for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
      const Flat a = points_[k], way = points_[k + 1] - a;
      double t = dot(place - a, way) / dot(way, way);
      if (k > 0) t = std::max(t, 0.0);
      if (k + 2 < points_.size()) t = std::min(t, 1.0);
      const Flat foot = a + way * t;
      if (distance(foot, place) < least) least = distance(foot, place), best = {foot, normalized(way)};
    }
    return best;
  }
  bool left(Flat place) const {
    const Near near = nearest(place);
    return cross(near.along, place - near.foot) > 0;
  }
  double leftShare(const Piece& piece) const {
    constexpr int kLooks = 60;
    const Ring ring = piece.outline.flattened(1e-3);
    const auto [low, high] = boxOf(ring);
    int all = 0, onLeft = 0;
    for (int i = 0; i < kLooks; ++i)
      for (int k = 0; k < kLooks; ++k) {
        const Flat p{std::lerp(low.u, high.u, (i + 0.5) / kLooks), std::lerp(low.v, high.v, (k + 0.5) / kLooks)};
        if (!contains(ring, p)) continue;
        ++all, onLeft += left(p);
      }
    return all > 0 ? onLeft / static_cast<double>(all) : 0.5;
  }

  std::vector<Flat> points_;
  bool smallerToTheLeft_ = true;
};

Result<Flared> flared(const Piece& piece, const FoldLine& op) {
  const Parting parting(piece, lineNamed(piece, op.lines.front()));
  return flaredBeyond(piece, op.lines.front(), [&](Flat place) { return parting.beyond(place); });
}

// What narrows towards the line is tight where it is turned back.
void tellTight(const Piece& piece, const FoldLine& op, const Context& context) {
  constexpr double kTold = 0.003;  // metres
  if (!context.advise || op.flared) return;
  const auto fits = flared(piece, op);
  if (!fits || fits->wider < kTold) return;
  FoldLine mend = op;
  mend.flared = true;
  context.advise(
      {say("What is turned back along “{0}” is {1} mm narrower at its end than what it comes to lie on, and is "
           "too tight there; cut it as the mirror image of that.",
           op.lines.front(), fixed(fits->wider * 1e3, 1)),
       piece.id,
       {},
       {},
       Operation(mend)});
}

// What is turned back on both of two fronts opens only where they are not sewn to each other.
void tellHeld(const Document& document, const FoldLine& op, const Context& context) {
  constexpr double kTold = 0.01;  // metres of the seam
  constexpr int kLooks = 50;
  if (!context.advise) return;
  const Piece& piece = *document.find(op.piece.id);
  const Parting parting(piece, lineNamed(piece, op.lines.front()));
  const std::vector<PieceId> copies = copiesMeant(document, piece.id, op.copies);
  for (const auto& [id, seam] : document.pattern.seams)
    for (const auto& [own, other] : {std::pair(&seam.a, &seam.b), std::pair(&seam.b, &seam.a)}) {
      if (own->size() != 1 || other->size() != 1 || own->front().piece != piece.id ||
          std::find(copies.begin(), copies.end(), other->front().piece) == copies.end())
        continue;
      const EdgeSpan& span = own->front();
      const Edge* edge = findEdge(piece, span.edge);
      if (!edge) continue;
      int beyond = 0;
      for (int k = 0; k < kLooks; ++k)
        beyond += parting.beyond(edge->curve.atFraction(std::lerp(span.from, span.to, (k + 0.5) / kLooks)));
      if (beyond * edge->curve.length() * (span.to - span.from) / kLooks < kTold) continue;
      return context.advise(
          {say("What is turned back is still sewn to {0}, by seam {1}, and cannot open: unpick that seam, and sew what "
               "lies below the fold again, or button it.",
               nameSaid(document.find(other->front().piece)->name), spoken(seam)),
           piece.id});
    }
}

// The smaller part laid back over the rest, where that is.
Result<std::shared_ptr<const Form>> turnedForm(const Piece& now, const Piece& old, const FoldLine& op, double spacing) {
  constexpr double kRound = 0.004;  // metres from the fold within which the layers part
  const Parting parting(old, lineNamed(old, op.lines.front()));
  const double side = op.angle > 0 ? 1 : -1;
  return liftedForm(now, old, spacing, [&](Flat place) {
    if (!parting.beyond(place)) return LiftedPlace{place, 0};
    const Flat foot = parting.foot(place);
    return LiftedPlace{foot * 2 - place, side * kLayersApart * std::min(1.0, distance(place, foot) / kRound)};
  });
}

// Whether a piece was cut after this one's paper, to lie beneath it: sewn to it along edges that are the same.
bool faces(const Piece& facing, const Piece& piece, const Pattern& pattern) {
  constexpr double kSame = 0.0005;  // metres
  const auto alike = [&](const EdgeSpan& own, const EdgeSpan& other) {
    const Edge *a = findEdge(piece, own.edge), *b = findEdge(facing, other.edge);
    return a && b && distance(a->curve.atFraction(0.5), b->curve.atFraction(0.5)) < kSame &&
           distance(a->curve.start, b->curve.start) < kSame;
  };
  const auto along = [&](const std::vector<EdgeSpan>& one, const std::vector<EdgeSpan>& other) {
    return one.size() == other.size() && !one.empty() && one.front().piece == piece.id &&
           other.front().piece == facing.id && std::equal(one.begin(), one.end(), other.begin(), alike);
  };
  return facing.layer < piece.layer && std::any_of(pattern.seams.begin(), pattern.seams.end(), [&](const auto& seam) {
           return along(seam.second.a, seam.second.b) || along(seam.second.b, seam.second.a);
         });
}

// The facing of what is turned back to the right side goes round the fold in a half circle, and over it: what was
// beneath is above then.
Result<Piece> turnedFacing(Piece facing, const Piece& old, const FoldLine& op, double spacing) {
  constexpr double kRadius = 1.5 * kLayersApart, kRound = std::numbers::pi * kRadius;
  const Parting parting(old, lineNamed(old, op.lines.front()));
  auto form = liftedForm(facing, old, spacing, [&](Flat place) {
    if (!parting.beyond(place)) return LiftedPlace{place, -kLayersApart};
    const Flat foot = parting.foot(place);
    const double far = distance(place, foot), turn = std::min(far, kRound) / kRadius;
    const double beside = kRadius * std::sin(turn) - std::max(0.0, far - kRound);
    return LiftedPlace{far > 0 ? foot + (place - foot) * (beside / far) : foot,
                       -kLayersApart + kRadius * (1 - std::cos(turn))};
  });
  if (!form) return form.error();
  facing.form = *std::move(form);
  facing.pose = old.pose;
  return facing;
}

// Presses the lines of one piece, whose paper may have been cut anew since `old`, and lays it over where it is turned.
Result<Document> folded(Document document, const Piece& old, const FoldLine& op, double spacing) {
  Piece piece = *document.find(old.id);
  for (InternalLine& line : piece.lines)
    if (std::find(op.lines.begin(), op.lines.end(), line.name) != op.lines.end())
      line.crease = op.angle == 0 ? std::nullopt : std::optional(Crease{op.angle, op.hold});
  if (op.turned) {
    auto form = turnedForm(piece, old, op, spacing);
    if (!form) return form.error();
    piece.form = *std::move(form);
  }
  document = withPiece(std::move(document), std::move(piece));
  if (!op.turned || op.facings != Choice::Yes || op.angle < 0) return document;
  for (const auto& [id, other] : std::map(document.pattern.pieces)) {
    if (!faces(*other, old, document.pattern)) continue;
    auto facing = turnedFacing(*other, old, op, spacing);
    if (!facing) return facing.error();
    document = withPiece(std::move(document), *std::move(facing));
  }
  return document;
}

// The same fold on a symmetric copy: its lines are those that lie where the images do. Nothing where one is missing.
std::optional<FoldLine> foldOnCopy(const Piece& piece, const Piece& copy, FoldLine op) {
  for (std::string& name : op.lines) {
    const InternalLine* image = lineOnCopy(lineNamed(piece, name), copy);
    if (!image) return std::nullopt;
    name = image->name;
  }
  op.piece = PieceRef(copy.id);
  return op;
}

}  // namespace

Done resolve(const Document& before, FoldLine& op, Context& context) {
  if (Done done = resolve(before, op.piece); !done) return done;
  const Piece& piece = *before.find(op.piece.id);
  if (op.lines.empty()) return refused(say("Say which lines are folded: line=turn."));
  for (const std::string& name : op.lines)
    if (std::none_of(piece.lines.begin(), piece.lines.end(), [&](const auto& line) { return line.name == name; }))
      return refused(say("“{0}” has no line “{1}”; draw it first: line piece={0} along=… name={1}.", piece.name, name));
  if (Done done = resolveCopies(before, {op.piece}, op.copies, context); !done) return done;
  constexpr double kRounded = 1e-9;  // radians: 170 degrees as they were written are no more than that
  if (std::fabs(op.angle) > Crease::kSharpest && std::fabs(op.angle) < Crease::kSharpest + kRounded)
    op.angle = Angle{std::copysign(Crease::kSharpest, op.angle)};
  if (!(std::fabs(op.angle) <= Crease::kSharpest))
    return refused(
        say("Cloth is folded by up to 170 degrees; what is turned over altogether is a hem or a piece of "
            "its own."));
  if (!(op.hold >= 0.1 && op.hold <= 0.99)) return refused(say("A fold holds 0.1 to 0.99 of its angle."));
  if (op.facings == Choice::Auto && op.turned && !context.recorded) op.facings = Choice::Yes;
  if (op.flared && !op.turned)
    return refused(say("Only what is turned back is cut as the mirror image of what it comes to lie on: turned=yes."));
  if (!op.turned) return {};
  constexpr double kOver = 2.6;  // radians: less is no turning over
  if (op.lines.size() != 1 || std::fabs(op.angle) < kOver)
    return refused(say("What is turned back is folded along one line, by 150 to 170 degrees: line=turn angle=170deg."));
  if (!Parting(piece, lineNamed(piece, op.lines.front())).reachesAcross(piece))
    return refused(say("“{0}” does not reach from edge to edge; only then can what is beyond it be turned back.",
                       op.lines.front()));
  return {};
}

Result<Document> perform(const Document& before, const FoldLine& op, Context& context) {
  const Piece& old = *before.find(op.piece.id);
  Document cut = before;
  if (op.flared) {
    const auto shaped = flared(old, op);
    if (!shaped) return shaped.error();
    cut = withEdit(std::move(cut), shaped->edited);
  }
  if (op.turned) tellTight(old, op, context), tellHeld(before, op, context);
  auto after = folded(std::move(cut), old, op, before.settings.spacing);
  for (const PieceId id : copiesMeant(before, op.piece.id, op.copies)) {
    if (!after) return after;
    const Piece& copy = *before.find(id);
    if (const auto there = foldOnCopy(old, copy, op))
      after = folded(*std::move(after), copy, *there, before.settings.spacing);
    else if (context.advise)
      context.advise({say("“{0}” has no such line and is not folded.", copy.name)});
  }
  return after;
}

}  // namespace karinui

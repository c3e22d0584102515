// A dart moved along the edge it opens at, as it is: what the edge gives up on its one side it gains on the other.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "divide_edges.h"
#include "karinui/base/number.h"
#include "karinui/pattern/edit.h"
#include "words.h"

namespace karinui {

namespace {

constexpr double kLeastBesideDart = 1e-3;                 // metres of the edge that are left beside it
constexpr double kOneLine = 30 * std::numbers::pi / 180;  // by which the edge may turn where the dart is closed
constexpr double kDrillAtTip = 2e-3;                      // metres: a drill hole there marks the point
constexpr double kSeamKept = 1e-8, kSeamTrue = 5e-4;      // metres

// The curve so that it starts and ends there.
Curve carriedEnds(Curve curve, Flat start, Flat end) {
  if (curve.kind == Curve::Kind::Cubic) curve.control1 += start - curve.start, curve.control2 += end - curve.end;
  curve.start = start, curve.end = end;
  return curve;
}

Curve shiftedBy(Curve curve, Flat by) {
  curve.start += by, curve.end += by, curve.control1 += by, curve.control2 += by;
  for (Flat& p : curve.between) p += by;
  return curve;
}

// Two curves in one, which stays a straight line where both are.
Curve oneAfterOther(const Curve& first, const Curve& second) {
  if (first.kind == Curve::Kind::Line && second.kind == Curve::Kind::Line) return Curve::line(first.start, second.end);
  const std::array both{first, second};
  return Curve::joined(both);
}

// A dart of a piece, with the edges on both its sides.
class DartShift {
 public:
  // `leg`: the place of the dart's first leg in the outline.
  DartShift(const Piece& piece, std::size_t leg)
      : piece_(piece),
        edges_(piece.outline.edges),
        in_(leg),
        out_((leg + 1) % edges_.size()),
        before_((leg + edges_.size() - 1) % edges_.size()),
        behind_((leg + 2) % edges_.size()),
        from_(edges_[in_].curve.start),
        tip_(edges_[in_].curve.end),
        until_(edges_[out_].curve.end),
        closing_(std::remainder(angleAtTip(from_) - angleAtTip(until_), 2 * std::numbers::pi)),
        one_(before().length()),
        other_(behind().length()) {
    // The edge is one line as the dart is closed, where it was trued, or as it lies open, where it was drawn so.
    open_ = turnInto(behind()) <= turnInto(closed(behind()));
  }

  Result<EditedPiece> by(double by) {
    const std::string& leg = edges_[in_].name;
    if (before_ == behind_ || turnInto(open_ ? behind() : closed(behind())) > kOneLine)
      return refused(
          say("The dart {0} of “{1}” opens at a corner, not within an edge: there is nothing to move it along.", leg,
              piece_.name));
    const double side = by > 0 ? other_ : one_;
    if (std::fabs(by) > side - kLeastBesideDart)
      return refused(say("There are {0} mm of {1} on that side of the dart {2}; it cannot be moved {3} mm.", inMm(side),
                         edges_[by > 0 ? behind_ : before_].name, leg, inMm(std::fabs(by))));
    changeSides(by);
    const double off = asLongAsItWas(std::fabs(by));
    if (std::fabs(longer(off)) > kSeamTrue)
      return refused(
          say("Moved {0} mm, the dart {1} of “{2}” would leave an edge {3} mm longer than it is. Move it less.",
              inMm(std::fabs(by)), leg, piece_.name, inMm(longer(off))));
    return shifted(by, off);
  }

 private:
  const Curve& before() const { return edges_[before_].curve; }
  const Curve& behind() const { return edges_[behind_].curve; }
  double angleAtTip(Flat p) const { return std::atan2(p.v - tip_.v, p.u - tip_.u); }
  Curve closed(const Curve& curve, double way = 1) const { return curve.rotated(tip_, closing_ * way); }
  double turnInto(const Curve& next) const {
    return std::fabs(angleFrom(endTangent(before(), true), endTangent(next, false)));
  }
  Curve toOtherSide(const Curve& curve, double way) const {
    return open_ ? shiftedBy(curve, (from_ - until_) * way) : closed(curve, way);
  }

  // So much of the edge changes sides.
  void changeSides(double by) {
    if (by > 0) {
      const double t = behind().parameterAt(by);
      const Curve taken = toOtherSide(behind().part(0, t), 1);
      second_ = behind().part(t, 1);
      first_ = oneAfterOther(before(), carriedEnds(taken, before().end, taken.end));
      step_ = ((taken.end - from_) + (second_.start - until_)) * 0.5;
    } else {
      const double t = before().parameterAt(one_ + by);
      const Curve taken = toOtherSide(before().part(t, 1), -1);
      first_ = before().part(0, t);
      second_ = oneAfterOther(carriedEnds(taken, taken.start, behind().start), behind());
      step_ = ((first_.end - from_) + (taken.start - until_)) * 0.5;
    }
  }

  // The dart goes as it is; square to its way it goes `off`.
  Flat way(double off) const { return step_ + leftOf(normalized(step_)) * off; }
  std::pair<Curve, Curve> beside(double off) const {
    return {carriedEnds(first_, before().start, from_ + way(off)),
            carriedEnds(second_, until_ + way(off), behind().end)};
  }
  double longer(double off) const {
    const auto [left, right] = beside(off);
    return left.length() + right.length() - one_ - other_;
  }
  // So far off, `most` at most, that the edge is as long as it was, or else as near to that as can be. It is the longer
  // the farther off the dart is, either way, from where it is shortest.
  double asLongAsItWas(double most) const {
    if (std::fabs(longer(0)) <= kSeamKept) return 0;
    double low = -most, high = most;
    for (int k = 0; k < 100; ++k) {
      const double third = (high - low) / 3;
      if (longer(low + third) < longer(high - third))
        high -= third;
      else
        low += third;
    }
    const double shortest = (low + high) / 2;
    if (longer(shortest) >= 0) return shortest;
    double near = shortest, far = shortest <= 0 ? most : -most;  // the side that is nearer to its way
    if (longer(far) < 0) far = -far;
    for (int k = 0; k < 100; ++k) (longer((near + far) / 2) < 0 ? near : far) = (near + far) / 2;
    return (near + far) / 2;
  }

  Result<EditedPiece> shifted(double by, double off) const {
    const Flat moved = way(off);
    EditedPiece result{piece_, {}};
    Outline& outline = result.piece.outline;
    std::tie(outline.edges[before_].curve, outline.edges[behind_].curve) = beside(off);
    for (const std::size_t side : {in_, out_}) outline.edges[side].curve = shiftedBy(edges_[side].curve, moved);
    outline.edges[in_].curve.start = outline.edges[before_].curve.end;
    outline.edges[out_].curve.end = outline.edges[behind_].curve.start;
    const Ring wedge{from_ + moved, until_ + moved, tip_ + moved};
    for (const Outline& hole : piece_.holes)
      for (const Flat p : hole.flattened(1e-3))
        if (contains(wedge, p)) return refused(say("The dart would run into a hole of {0}.", piece_.name));
    auto good = checked(outline);
    if (!good) return good.error();
    outline = *std::move(good);
    result.edges = partsThatChangeSides(outline, by);
    followMarks(result.piece, result.edges);
    for (Mark& mark : result.piece.marks)
      if (mark.edge.empty() && distance(mark.place, tip_) < kDrillAtTip) mark.place += moved;
    return result;
  }

  EdgeMap partsThatChangeSides(const Outline& outline, double by) const {
    const PieceId id = piece_.id;
    const std::string &ahead = edges_[before_].name, &after = edges_[behind_].name;
    const double now = outline.edges[before_].curve.length(), rest = outline.edges[behind_].curve.length();
    EdgeMap map;
    if (by > 0) {
      const double share = by / other_, where = one_ / now;
      map[{id, ahead}] = {{0, 1, {id, ahead, 0, where}}};
      map[{id, after}] = {{0, share, {id, ahead, where, 1}}, {share, 1, {id, after, 0, 1}}};
    } else {
      const double share = 1 + by / one_, where = -by / rest;
      map[{id, ahead}] = {{0, share, {id, ahead, 0, 1}}, {share, 1, {id, after, 0, where}}};
      map[{id, after}] = {{0, 1, {id, after, where, 1}}};
    }
    return map;
  }

  const Piece& piece_;
  const std::vector<Edge>& edges_;
  const std::size_t in_, out_, before_, behind_;  // legs and edges beside them, in the outline
  const Flat from_, tip_, until_;                 // the dart's corners
  const double closing_;                          // radians that close it
  const double one_, other_;                      // the lengths of the edges beside it
  bool open_ = false;
  Curve first_, second_;  // those edges with what changes sides
  Flat step_;             // the dart's own
};

}  // namespace

Result<EditedPiece> shiftDart(const Piece& piece, std::string_view leg, double by) {
  const auto i = piece.outline.find(leg);
  if (!i) return noEdge(piece, leg);
  return DartShift(piece, *i).by(by);
}

}  // namespace karinui

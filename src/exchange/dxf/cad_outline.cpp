#include "cad_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cad_ring.h"
#include "karinui/base/number.h"
#include "karinui/geometry/fit_curve.h"
#include "karinui/geometry/polygon.h"

namespace karinui {

namespace {

constexpr double kStraight = 2e-5;                    // points nearer than this to their chord make a line
constexpr double kCorner = std::numbers::pi / 36;     // 5 degrees between two curves part two edges
constexpr double kShortest = 2e-4;                    // of an edge: shorter ones belong to the edge before
constexpr double kOffBoundary = 5e-3;                 // a notch farther from the outline is none …
constexpr double kWidestAllowance = 0.06;             // … where it is the boundary; else they stand on the cut line
constexpr double kFarthestCut = 0.15;                 // of a cut line's corner from the seam line it belongs to
constexpr std::size_t kDenseFrom = 12;                // points of a run that are many enough to be fitted …
constexpr double kDenseBend = std::numbers::pi / 18;  // … if no chord turns more than this
constexpr std::size_t kMostMarks = 2000;              // of one kind, of one piece
constexpr std::size_t kMostVertices = 20'000;         // of one outline
constexpr std::size_t kMostAsked = 400;               // of a line's points, about how far it is from another

Flat unit(Flat way) { return normalized(way); }

// The point that would come before a curve's first one if it went on as it bends there: the third, mirrored.
Flat wentOn(Flat first, Flat second, Flat third) {
  const Flat way = unit(second - first), middle = 0.5 * (first + second);
  return third - 2 * dot(third - middle, way) * way;
}

// Centripetal Catmull-Rom through three points or more, as cubics (Yuksel, Schaefer, Keyser 2011: "Parameterization and
// applications of Catmull-Rom curves", the Bezier form of section 3). Industrial systems draw sparse points on a curve;
// of all readings tried this one comes nearest to the dense curve that some files hold beside them (12 curved runs of
// two files: misses of 0.25 mm in the median, 0.48 at most; with the second point turned about the first as the point
// before it 0.71).
std::vector<Curve> throughPoints(const std::vector<Flat>& p) {
  std::vector<Curve> parts;
  for (std::size_t k = 0; k + 1 < p.size(); ++k) {
    const Flat before = k > 0 ? p[k - 1] : wentOn(p[0], p[1], p[2]);
    const Flat after = k + 2 < p.size() ? p[k + 2] : wentOn(p[k + 1], p[k], p[k - 1]);
    const double a = std::sqrt(distance(before, p[k])), b = std::sqrt(distance(p[k], p[k + 1])),
                 c = std::sqrt(distance(p[k + 1], after));
    const Flat out =
        (1 / (3 * a * (a + b))) * (a * a * p[k + 1] - b * b * before + (2 * a * a + 3 * a * b + b * b) * p[k]);
    const Flat in =
        (1 / (3 * c * (c + b))) * (c * c * p[k] - b * b * after + (2 * c * c + 3 * c * b + b * b) * p[k + 1]);
    parts.push_back(Curve::cubic(p[k], out, in, p[k + 1]));
  }
  return parts;
}

bool dense(const std::vector<Flat>& p) {
  if (p.size() < kDenseFrom) return false;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const Flat in = p[i] - p[i - 1], out = p[i + 1] - p[i];
    if (std::abs(angleFrom(in, out)) > kDenseBend) return false;
  }
  return true;
}

std::vector<Curve> smooth(const std::vector<Flat>& points) {
  if (points.size() == 2 || bow(points) < kStraight) return {Curve::line(points.front(), points.back())};
  if (dense(points)) {
    FitSettings settings;
    settings.straight = settings.tolerance = kStraight;
    return fitEdge(points, settings).curves;
  }
  return throughPoints(points);
}

double cornerBetween(const Curve& in, const Curve& out) {
  const Flat a = in.tangent(1), b = out.tangent(0);
  return std::abs(angleFrom(a, b));
}

// The runs of curve between turns, gathered to edges between corners. `plan`: as it was done before, or, empty, how it
// was done now. Nothing: the points have other turns than those of the plan.
std::optional<Outline> edgesOf(CadRing ring, EdgePlan& plan) {
  const std::size_t n = ring.points.size();
  if (std::count(ring.turn.begin(), ring.turn.end(), 1) < 2) ring.turn[0] = ring.turn[n / 2] = 1;  // a round piece
  const auto first = static_cast<std::size_t>(std::find(ring.turn.begin(), ring.turn.end(), 1) - ring.turn.begin());
  std::vector<std::vector<Flat>> runs;
  std::vector<std::vector<Curve>> curves;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first + k) % n;
    if (ring.turn[i]) runs.emplace_back();
    runs.back().push_back(ring.points[i]);
    if (ring.turn[(i + 1) % n]) runs.back().push_back(ring.points[(i + 1) % n]);
  }
  for (const auto& run : runs) curves.push_back(smooth(run));

  std::size_t begin = 0;  // the run at whose start the sharpest corner lies
  double sharpest = -1;
  std::vector<char> corner(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double turned = cornerBetween(curves[(r + runs.size() - 1) % runs.size()].back(), curves[r].front());
    corner[r] = turned > kCorner;
    if (turned > sharpest) sharpest = turned, begin = r;
  }
  corner[begin] = 1;
  if (std::count(corner.begin(), corner.end(), 1) < 2) corner[(begin + runs.size() / 2) % runs.size()] = 1;
  const bool planned = !plan.corner.empty();
  if (planned && plan.corner.size() != runs.size()) return std::nullopt;
  if (!planned) plan.begin = begin, plan.corner = corner;
  begin = plan.begin, corner = plan.corner;

  Outline outline;
  std::vector<Curve> parts;
  std::vector<Flat> points;
  std::size_t closed = 0;
  const auto close = [&] {
    if (points.empty()) return;
    Curve whole = bow(points) < kStraight ? Curve::line(points.front(), points.back()) : Curve::joined(parts);
    if (!planned) plan.joined.push_back(!outline.edges.empty() && whole.length() < kShortest);
    if (plan.joined[closed++]) {
      const Curve both[] = {outline.edges.back().curve, whole};
      outline.edges.back().curve = Curve::joined(both);
    } else {
      outline.edges.push_back({"e" + std::to_string(outline.edges.size() + 1), std::move(whole)});
    }
    parts.clear(), points.clear();
  };
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::size_t r = (begin + k) % runs.size();
    if (corner[r]) close();
    parts.insert(parts.end(), curves[r].begin(), curves[r].end());
    points.insert(points.end(), runs[r].begin(), runs[r].end());
  }
  close();
  return outline;
}

// The points that are corners or ends of curves. Blocks of other sizes than the sample's have none of their own; they
// are drawn with as many points, in the same order.
std::vector<Flat> turnsOf(const CadPiece& drawn, const CadPiece* sample) {
  if (!drawn.turns.empty() || !sample || sample->boundary.size() != drawn.boundary.size()) return drawn.turns;
  const PlaceSet told(sample->turns);
  std::vector<Flat> turns;
  for (std::size_t l = 0; l < drawn.boundary.size(); ++l) {
    const auto &own = drawn.boundary[l].points, &theirs = sample->boundary[l].points;
    if (own.size() != theirs.size()) return {};
    for (std::size_t i = 0; i < own.size(); ++i)
      if (told.near(theirs[i])) turns.push_back(own[i]);
  }
  return turns;
}

bool holdsAll(const std::vector<Flat>& many, const std::vector<Flat>& few) {
  const PlaceSet places(many);
  return many.size() > few.size() && std::all_of(few.begin(), few.end(), [&](Flat p) { return places.near(p); });
}

// How far the farthest of some points is from a ring; of many a part is asked.
double farthest(const std::vector<Flat>& points, const std::vector<Flat>& ring) {
  double most = 0;
  for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / kMostAsked)
    most = std::max(most, distanceToRing(ring, points[i]));
  return most;
}

// The closed lines on the layer of seam lines: that of the outline, which runs along the whole boundary, those of
// cut-outs, which lie round them, and what is stitched on within the piece.
struct SeamLines {
  std::optional<std::vector<Flat>> outline;
  std::vector<std::optional<std::vector<Flat>>> cutouts;  // of each
  std::vector<std::size_t> inside;                        // lines of layer 14
};
SeamLines seamLinesOf(const CadPiece& drawn) {
  SeamLines found;
  found.cutouts.resize(drawn.cutouts.size());
  Flat gap;
  const auto boundary = chained(drawn.boundary, gap);
  std::vector<std::vector<Flat>> holes;
  for (const CadLine& line : drawn.cutouts) holes.push_back(chained({line}, gap).value_or(std::vector<Flat>()));
  std::vector<char> taken(drawn.sewing.size(), 0);
  std::vector<CadLoop> loops = loopsOf(drawn.sewing, gap);
  std::stable_sort(loops.begin(), loops.end(),
                   [](const CadLoop& a, const CadLoop& b) { return signedArea(a.points) > signedArea(b.points); });
  for (CadLoop& loop : loops) {
    bool use = false;
    if (!found.outline && (!boundary || farthest(*boundary, loop.points) < kFarthestCut))
      found.outline = loop.points, use = true;
    for (std::size_t k = 0; k < holes.size() && !use; ++k)
      if (!found.cutouts[k] && !holes[k].empty() && contains(loop.points, holes[k][0]) &&
          farthest(loop.points, holes[k]) < kFarthestCut)
        found.cutouts[k] = loop.points, use = true;
    for (const std::size_t line : loop.lines) taken[line] = taken[line] || use;
  }
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (!taken[i]) found.inside.push_back(i);
  return found;
}

// The seam line where there is one; else the boundary, by its dense drawing where that has every point of the boundary
// and more (in CLO's files it is the other way round).
Result<std::vector<Flat>> pointsOf(const CadPiece& drawn, const SeamLines& seams) {
  if (seams.outline) return *seams.outline;
  Flat gap, other;
  auto points = chained(drawn.boundary, gap);
  if (!points &&
      std::any_of(drawn.boundary.begin(), drawn.boundary.end(), [](const CadLine& one) { return one.closed; }))
    return badInput(say("the outline lies in a line and holds no cloth."));
  if (!points)
    return badInput(say("the outline is open at {0}, {1} mm.", fixed(gap.u * 1e3, 1), fixed(gap.v * 1e3, 1)));
  if (auto more = chained(drawn.dense, other); more && holdsAll(*more, *points)) return *std::move(more);
  return *std::move(points);
}

}  // namespace

PlaceOnOutline nearestOn(const Outline& outline, Flat place) {
  PlaceOnOutline best;
  for (const Edge& edge : outline.edges) {
    const std::vector<Flat> line = edge.curve.flattened();
    double before = 0, at = 0, nearest = 1e9;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Flat way = line[i + 1] - line[i];
      const double size = length(way);
      const double t = size > 0 ? std::clamp(dot(place - line[i], way) / (size * size), 0.0, 1.0) : 0.0;
      if (const double d = distance(place, line[i] + t * way); d < nearest) nearest = d, at = before + t * size;
      before += size;
    }
    if (nearest < best.distance) best = {edge.name, before > 0 ? at / before : 0, nearest};
  }
  return best;
}

namespace {

// Where the cut line's notch meets the seam line, straight inwards; nothing: it does not.
std::optional<Flat> metInward(const Outline& outline, const CadNotch& notch) {
  if (!notch.inward) return std::nullopt;
  double nearest = kWidestAllowance;
  bool any = false;
  for (const Edge& edge : outline.edges) {
    const std::vector<Flat> line = edge.curve.flattened();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Flat way = line[i + 1] - line[i], to = line[i] - notch.place;
      const double turned = cross(*notch.inward, way);
      if (std::abs(turned) < 1e-12) continue;
      const double along = cross(to, way) / turned, share = cross(to, *notch.inward) / turned;
      if (share >= 0 && share <= 1 && along >= 0 && along < nearest) nearest = along, any = true;
    }
  }
  return any ? std::optional(notch.place + nearest * *notch.inward) : std::nullopt;
}

class Making {
 public:
  Making(const CadPiece& drawn, const CadPiece* sample, std::vector<Message>& notes, EdgePlan& plan)
      : drawn_(drawn), sample_(sample), notes_(notes), plan_(plan), seams_(seamLinesOf(drawn)) {}

  Result<Piece> make() {
    piece_.name = drawn_.name;
    for (const Message& guessed : drawn_.notes) note(guessed);
    auto made = outline();
    if (!made) return made.error();
    piece_.outline = *std::move(made);
    holes(), lines(), marks(), rules();
    if (drawn_.grain && distance(drawn_.grain->first, drawn_.grain->second) > kShortest)
      piece_.grain = unit(drawn_.grain->second - drawn_.grain->first);
    return std::move(piece_);
  }

  Result<Outline> outline() {
    auto points = pointsOf(drawn_, seams_);
    if (!points) return wrong(points.error().what);
    std::vector<Flat> turns = turnsOf(drawn_, sample_);
    if (points->size() > kMostVertices) {
      if (turns.size() > kMostVertices / 2) turns.clear();  // which calls every point a corner says nothing
      *points = thinned(*points, true, turns);
      if (points->size() > kMostVertices)
        return wrong(
            say("the outline has more than {0} points. Write the file with fewer; a tolerance of 0.1 mm is enough.",
                kMostVertices));
      note(say("its outline has more than {0} points; {1} of them are read, and the line stays within 0.05 mm.",
               kMostVertices, points->size()));
    }
    if (std::max({drawn_.notches.size(), drawn_.drills.size(), drawn_.inside.size(), drawn_.cutouts.size()}) >
        kMostMarks)
      return wrong(say("it has more than {0} notches, holes or lines.", kMostMarks));
    CadRing ring = withTurns(*std::move(points), turns);
    if (drawn_.fold && distance(drawn_.fold->first, drawn_.fold->second) > kShortest) {
      const Flat axis = unit(drawn_.fold->second - drawn_.fold->first);
      if (auto whole = unfolded(ring, drawn_.fold->first, axis)) {
        ring = *std::move(whole);
        through_ = drawn_.fold->first, axis_ = axis;
      } else {
        note(say("its fold line lies apart from its outline, so it was not unfolded."));
      }
    }
    auto edges = edgesOf(std::move(ring), plan_);
    if (!edges) return wrong(say("it is drawn with other points than the size that is read."));
    auto good = checked(*std::move(edges));
    if (!good) return wrong(good.error().what);
    return good;
  }

 private:
  Error wrong(const Message& what) const {
    return badInput(say("Piece “{0}”, size {1}: {2}", drawn_.name, drawn_.size, what));
  }
  void note(const Message& what) { notes_.push_back(wrong(what).what); }

  void holes() {
    for (std::size_t k = 0; k < drawn_.cutouts.size(); ++k) {
      Flat gap;
      const auto points = seams_.cutouts[k] ? seams_.cutouts[k] : chained({drawn_.cutouts[k]}, gap);
      if (!points) {
        note(say("a cut-out is not closed and was left out."));
        continue;
      }
      std::vector<CadRing> rings{withTurns(*points, {})};
      if (axis_) {
        rings.push_back(rings[0]);
        for (Flat& p : rings[1].points) p = reflected(p, through_, *axis_);
        std::reverse(rings[1].points.begin(), rings[1].points.end());
        std::reverse(rings[1].turn.begin(), rings[1].turn.end());
      }
      for (CadRing& ring : rings) {
        EdgePlan own;
        Outline hole = *edgesOf(std::move(ring), own);
        for (Edge& edge : hole.edges) edge.name = "h" + std::to_string(piece_.holes.size() + 1) + "_" + edge.name;
        if (auto good = checked(std::move(hole)))
          piece_.holes.push_back(*std::move(good));
        else
          note(say("a cut-out cannot be cut and was left out."));
      }
    }
  }
  void lines() {
    std::vector<CadLine> all = drawn_.inside;
    for (const std::size_t i : seams_.inside) all.push_back(drawn_.sewing[i]);
    for (const CadLine& line : all) {
      std::vector<Flat> points = line.points;
      if (line.closed) points.push_back(points.front());
      points.erase(std::unique(points.begin(), points.end(), [](Flat a, Flat b) { return distance(a, b) < kStraight; }),
                   points.end());
      if (points.size() < 2) continue;
      add(smooth(points));
      if (!axis_) continue;
      const bool onFold = std::all_of(points.begin(), points.end(),
                                      [&](Flat p) { return std::abs(cross(*axis_, p - through_)) < kShortest; });
      for (Flat& p : points) p = reflected(p, through_, *axis_);
      if (!onFold) add(smooth(points));
    }
  }
  void add(std::vector<Curve> curves) {
    piece_.lines.push_back({"line" + std::to_string(piece_.lines.size() + 1), std::move(curves), {}});
  }
  void marks() {
    const bool onCutLine = seams_.outline.has_value();
    std::size_t off = 0;
    const auto add = [&](const CadNotch& notch) {
      const auto met = onCutLine ? metInward(piece_.outline, notch) : std::nullopt;
      const PlaceOnOutline at = nearestOn(piece_.outline, met.value_or(notch.place));
      if (at.distance > (onCutLine ? kWidestAllowance : kOffBoundary)) return void(++off);
      piece_.marks.push_back({"notch" + std::to_string(++notches_), at.edge, at.fraction, {}});
    };
    for (const CadNotch& notch : drawn_.notches) {
      add(notch);
      if (!axis_ || std::abs(cross(*axis_, notch.place - through_)) <= kShortest) continue;
      CadNotch other{reflected(notch.place, through_, *axis_), {}};
      if (notch.inward) other.inward = reflected(*notch.inward, {}, *axis_);
      add(other);
    }
    if (off > 0) note(say("{0} {0|notch lies|notches lie} apart from the outline and {0|was|were} left out.", off));
    for (const Flat drill : drawn_.drills) {
      const auto hole = [&](Flat place) {
        piece_.marks.push_back({"drill" + std::to_string(++drills_), "", 0, place});
      };
      hole(drill);
      if (axis_ && std::abs(cross(*axis_, drill - through_)) > kShortest) hole(reflected(drill, through_, *axis_));
    }
  }

  void rules() {
    if (drawn_.rules.size() > kMostMarks) return;
    for (const auto& rule : drawn_.rules) {
      plan_.rules.push_back(rule), plan_.folds.emplace_back();
      if (!axis_ || std::abs(cross(*axis_, rule.first - through_)) <= kShortest) continue;
      plan_.rules.emplace_back(reflected(rule.first, through_, *axis_), rule.second), plan_.folds.push_back(*axis_);
    }
  }

  const CadPiece& drawn_;
  const CadPiece* sample_;
  std::vector<Message>& notes_;
  EdgePlan& plan_;
  SeamLines seams_;
  Piece piece_;
  Flat through_;
  std::optional<Flat> axis_;
  std::size_t notches_ = 0, drills_ = 0;
};

}  // namespace

Result<Piece> pieceOf(const CadPiece& drawn, const CadPiece* sample, std::vector<Message>& notes, EdgePlan& plan) {
  return Making(drawn, sample, notes, plan).make();
}

Result<Outline> outlineOf(const CadPiece& drawn, const CadPiece* sample, const EdgePlan& plan) {
  std::vector<Message> notes;
  EdgePlan same = plan;
  return Making(drawn, sample, notes, same).outline();
}

}  // namespace karinui

#include "karinui/pattern/trims.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "karinui/geometry/fit_curve.h"

namespace karinui {

namespace {

constexpr double kRowStep = 0.002;           // metres between the places of a row that are looked at
constexpr double kPairStep = 0.004;          // metres between the pairs of a strip
constexpr double kMiss = 5e-6, kOff = 2e-5;  // metres: of chords from their curve; by which a place may be too near
constexpr double kLongestStrip = 0.75;       // metres of bias in one length: the diagonal of half a metre of cloth
constexpr double kStitchEnd = 0.010;         // metres at each end of a length

Flat unitTangent(const Curve& curve, double s) {
  const double whole = curve.length(), t = curve.parameterAt(std::clamp(s, 0.0, whole));
  const Flat there = curve.tangent(t);
  if (length(there) > 1e-9) return normalized(there);
  return normalized(t < 0.5 ? curve.at(t + 1e-3) - curve.at(t) : curve.at(t) - curve.at(t - 1e-3));
}

double away(const std::vector<Flat>& line, Flat place) {
  double least = 1e9;
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    least = std::min(least, distanceToSegment(line[k], line[k + 1], place));
  return least;
}

// An outline or the edge of a hole, walked with the cloth to the left, and one of its edges.
class InnerSide {
 public:
  using GoesOn = std::function<bool(const std::string&)>;  // whether another edge is finished likewise

  InnerSide(const Piece& piece, const std::string& edge, const GoesOn& goesOn) {
    outer_ = piece.outline.flattened(1e-4);
    for (const Outline& hole : piece.holes) holes_.push_back(hole.flattened(1e-4));
    found_ = walk(piece.outline, edge, false);
    for (const Outline& hole : piece.holes) found_ = found_ || walk(hole, edge, true);
    if (found_) finish(goesOn);
  }
  bool found() const { return found_; }
  double length() const { return length_; }
  Flat along(double s) const { return unitTangent(own_.curve, s); }
  // Beyond the edge's ends: on its tangent.
  Flat place(double s, double deep) const {
    const double on = std::clamp(s, 0.0, length_);
    const Flat way = along(on);
    return own_.curve.at(own_.curve.parameterAt(on)) + way * (s - on) + leftOf(way) * deep;
  }
  bool cloth(Flat place) const {
    return contains(outer_, place) &&
           std::none_of(holes_.begin(), holes_.end(), [&](const Ring& hole) { return contains(hole, place); });
  }
  // Whether cloth lies there, and no other edge that is finished likewise is nearer.
  bool belongs(Flat place, double deep) const {
    if (!cloth(place) || away(line_, place) < deep - kOff) return false;
    return std::none_of(others_.begin(), others_.end(),
                        [&](const std::vector<Flat>& other) { return away(other, place) < deep - kOff; });
  }
  // How far a parallel reaches beyond an end of the edge at most: to where it meets that of the next edge round an
  // inward corner, else to the outline beside a clear corner.
  double beyond(bool end, double deep) const {
    constexpr double kClear = 30 * std::numbers::pi / 180;  // the outline turns by as much
    const double turn = end ? turnAfter_ : turnBefore_;     // > 0: outwards
    if (turn < 0) return (end ? nextGoesOn_ : lastGoesOn_) ? deep * std::tan(-turn / 2) : 0;
    return !(end ? nextGoesOn_ : lastGoesOn_) && turn > kClear ? 4 * deep : 0;
  }
  bool mitredInwards(bool end) const {
    return (end ? turnAfter_ : turnBefore_) < -1e-3 && (end ? nextGoesOn_ : lastGoesOn_);
  }

 private:
  bool walk(const Outline& outline, const std::string& edge, bool hole) {
    const auto at = outline.find(edge);
    if (!at) return false;
    loop_ = outline.edges;
    std::size_t k = *at;
    if (hole) {
      std::reverse(loop_.begin(), loop_.end());
      for (Edge& one : loop_) one.curve = one.curve.reversed();
      k = loop_.size() - 1 - k;
    }
    at_ = k;
    return true;
  }
  void finish(const GoesOn& goesOn) {
    const std::size_t n = loop_.size();
    own_ = loop_[at_];
    length_ = own_.curve.length();
    line_ = own_.curve.flattened(kMiss);
    const Edge &last = loop_[(at_ + n - 1) % n], &next = loop_[(at_ + 1) % n];
    turnBefore_ = angleFrom(unitTangent(last.curve, last.curve.length()), along(0));
    turnAfter_ = angleFrom(along(length_), unitTangent(next.curve, 0));
    lastGoesOn_ = goesOn(last.name), nextGoesOn_ = goesOn(next.name);
    for (std::size_t k = 0; k < n; ++k)
      if (k != at_ && goesOn(loop_[k].name)) others_.push_back(loop_[k].curve.flattened(kMiss));
  }

  std::vector<Edge> loop_;
  std::size_t at_ = 0;
  Edge own_;
  Ring outer_;
  std::vector<Ring> holes_;
  std::vector<Flat> line_;
  std::vector<std::vector<Flat>> others_;
  double length_ = 0, turnBefore_ = 0, turnAfter_ = 0;
  bool found_ = false, lastGoesOn_ = false, nextGoesOn_ = false;
};

// Places on a straight line between their neighbours fall away.
std::vector<Flat> straightened(const std::vector<Flat>& points) {
  constexpr double kBow = 1e-5;
  std::vector<Flat> kept;
  std::size_t from = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    bool straight = k > 0 && k + 1 < points.size();
    for (std::size_t i = from + 1; straight && i <= k; ++i)
      straight = distanceToSegment(points[from], points[k + 1], points[i]) < kBow;
    if (!straight) kept.push_back(points[k]), from = k;
  }
  return kept;
}

// The longest stretch of an edge's parallel that belongs to it.
std::vector<Flat> parallelOf(const InnerSide& side, double deep) {
  const double low = -side.beyond(false, deep), high = side.length() + side.beyond(true, deep);
  const auto steps = static_cast<std::size_t>(std::clamp((high - low) / kRowStep, 8.0, 4000.0));
  const auto at = [&](std::size_t k) {
    return low + (high - low) * static_cast<double>(k) / static_cast<double>(steps);
  };
  const auto good = [&](double s) { return side.belongs(side.place(s, deep), deep); };
  std::size_t from = 0, count = 0;
  for (std::size_t k = 0, start = 0, run = 0; k <= steps; ++k) {
    run = good(at(k)) ? run + 1 : 0;
    if (run == 1) start = k;
    if (run > count) from = start, count = run;
  }
  if (count < 2) return {};
  const auto limit = [&](double in, double out) {  // between what belongs and what does not
    for (int k = 0; k < 30; ++k) (good(0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
    return in;
  };
  std::vector<Flat> points;
  if (from > 0) points.push_back(side.place(limit(at(from), at(from - 1)), deep));
  for (std::size_t k = from; k < from + count; ++k) points.push_back(side.place(at(k), deep));
  if (from + count <= steps) points.push_back(side.place(limit(at(from + count - 1), at(from + count)), deep));
  return straightened(points);
}

}  // namespace

std::vector<StitchRow> stitchRows(const Pattern& pattern, const Allowances& finish) {
  std::vector<StitchRow> rows;
  for (const auto& [at, own] : finish.topstitches) {
    const auto found = pattern.pieces.find(at.first);
    if (found == pattern.pieces.end()) continue;
    const Piece& piece = *found->second;
    const auto add = [&, id = at.first, topstitch = own](std::vector<Flat> points) {
      if (points.size() > 1) rows.push_back({id, std::move(points), topstitch});
    };
    if (findEdge(piece, at.second)) {
      const auto likewise = [&, id = at.first, topstitch = own](const std::string& edge) {
        const auto other = finish.topstitches.find({id, edge});
        return other != finish.topstitches.end() && other->second.offset == topstitch.offset;
      };
      const InnerSide side(piece, at.second, likewise);
      for (int row = 0; row < own.rows; ++row) add(parallelOf(side, own.offset + row * own.apart));
    } else if (const Curve* curve = findCurve(piece, at.second)) {
      const double whole = curve->length();
      const auto steps = static_cast<std::size_t>(std::clamp(whole / kRowStep, 4.0, 4000.0));
      for (int row = 0; row < own.rows; ++row) {
        const double aside = (row - 0.5 * (own.rows - 1)) * own.apart;
        std::vector<Flat> points;
        for (std::size_t k = 0; k <= steps; ++k) {
          const double s = whole * static_cast<double>(k) / static_cast<double>(steps);
          points.push_back(curve->at(curve->parameterAt(s)) + leftOf(unitTangent(*curve, s)) * aside);
        }
        add(straightened(points));
      }
    }
  }
  return rows;
}

std::optional<Curve> parallelInside(const Piece& piece, const std::string& edge, double deep) {
  const InnerSide side(piece, edge, [](const std::string&) { return false; });
  if (!side.found()) return std::nullopt;
  const std::vector<Flat> points = parallelOf(side, deep);
  if (points.size() < 2) return std::nullopt;
  if (points.size() == 2) return Curve::line(points[0], points[1]);
  std::vector<Flat> close;
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    for (int i = 0; i < 4; ++i) close.push_back(lerp(points[k], points[k + 1], i / 4.0));
  close.push_back(points.back());
  return fitEdge(close).curves.front();
}

TrimRun runOf(const Piece& piece, const std::string& edge, const Binding& binding, const Allowances& finish) {
  TrimRun run{piece.id, edge, {}, {}};
  const InnerSide side(piece, edge, [&](const std::string& other) {
    return finish.bindings.contains({piece.id, other});
  });
  if (!side.found()) return run;
  const auto add = [&](double s) {
    double deep = binding.width;
    constexpr double kWithin = 1e-4;  // metres: at its ends the other edge begins
    const auto belongs = [&, at = std::clamp(s, kWithin, side.length() - kWithin)](double d) {
      return side.belongs(side.place(at, d), d);
    };
    if (!belongs(deep)) {
      double in = 0, out = deep;
      for (int k = 0; k < 20; ++k) (belongs(0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
      deep = in;
    }
    run.edgewise.push_back(side.place(s, 0)), run.inside.push_back(side.place(s, deep));
  };
  const auto corner = [&](bool end) {  // round an inward corner the strip's inner edge is longer than its outer one
    if (!side.mitredInwards(end)) return;
    const double beyond = side.beyond(end, binding.width);
    run.edgewise.push_back(side.place(end ? side.length() : 0, 0));
    run.inside.push_back(side.place(end ? side.length() + beyond : -beyond, binding.width));
  };
  const int steps = std::clamp(static_cast<int>(side.length() / kPairStep), 2, 2000);
  corner(false);
  for (int k = 0; k <= steps; ++k) add(side.length() * k / steps);
  corner(true);
  return run;
}

TrimRun runOf(const Piece& piece, const std::string& edge, const Piping&) {
  constexpr double kIn = 0.002;  // metres
  TrimRun run{piece.id, edge, {}, {}};
  const InnerSide side(piece, edge, [](const std::string&) { return false; });
  if (!side.found()) return run;
  const int steps = std::clamp(static_cast<int>(side.length() / kPairStep), 2, 2000);
  for (int k = 0; k <= steps; ++k) {
    const double s = side.length() * k / steps;
    run.edgewise.push_back(side.place(s, 0)), run.inside.push_back(side.place(s, kIn));
  }
  return run;
}

std::vector<TrimRun> trimRuns(const Pattern& pattern, const Allowances& finish) {
  std::vector<TrimRun> runs;
  const auto add = [&](const Allowances::At& at, const auto& made) {
    const auto piece = pattern.pieces.find(at.first);
    if (piece == pattern.pieces.end()) return;
    if (TrimRun run = made(*piece->second); run.edgewise.size() > 1) runs.push_back(std::move(run));
  };
  for (const auto& piping : finish.pipings)
    add(piping.first, [&](const Piece& piece) {
      TrimRun run = runOf(piece, piping.first.second, piping.second);
      for (std::size_t k = 0; k < run.inside.size(); ++k)
        run.inside[k] = run.edgewise[k] + normalized(run.inside[k] - run.edgewise[k]) * piping.second.thickness;
      return run;
    });
  for (const auto& binding : finish.bindings)
    add(binding.first, [&](const Piece& piece) { return runOf(piece, binding.first.second, binding.second, finish); });
  return runs;
}

std::vector<BiasStrip> biasStrips(const Pattern& pattern, const Allowances& finish, const TimesCut& times) {
  std::map<std::pair<std::string, long>, double> lengths;  // by fabric and width in tenths of a millimetre
  const auto add = [&](const Allowances::At& at, const auto& own) {
    const auto piece = pattern.pieces.find(at.first);
    const Curve* curve = piece == pattern.pieces.end() ? nullptr : findCurve(*piece->second, at.second);
    if (!curve) return;
    const auto cut = times.find(at.first);
    const std::string& fabric = own.fabric.empty() ? piece->second->fabric : own.fabric;
    lengths[{fabric, std::lround(own.stripWidth() * 1e4)}] += curve->length() * (cut == times.end() ? 1 : cut->second);
  };
  for (const auto& [at, own] : finish.pipings) add(at, own);
  for (const auto& [at, own] : finish.bindings) add(at, own);
  std::vector<BiasStrip> strips;
  for (const auto& [kind, whole] : lengths) {
    BiasStrip strip{kind.first, static_cast<double>(kind.second) / 1e4, whole, 1, 0};
    strip.count = static_cast<int>(std::ceil(whole / (kLongestStrip - 2 * kStitchEnd)));
    strip.cutLength = whole / strip.count + 2 * kStitchEnd;
    strips.push_back(std::move(strip));
  }
  return strips;
}

std::shared_ptr<const Piece> stripPiece(const BiasStrip& strip, std::size_t number) {
  const double l = strip.cutLength, w = strip.width;
  auto piece = std::make_shared<Piece>();
  piece->id = {(std::uint64_t{1} << 62) + number};
  piece->name = "bias_strip" + (number > 0 ? "_" + std::to_string(number + 1) : "");
  piece->fabric = strip.fabric;
  piece->grain = normalized(Flat{1, 1});
  const Flat corners[] = {{0, 0}, {l, 0}, {l + w, w}, {w, w}};
  const char* names[] = {"long", "end", "long_2", "end_2"};
  for (std::size_t k = 0; k < 4; ++k)
    piece->outline.edges.push_back({names[k], Curve::line(corners[k], corners[(k + 1) % 4])});
  return piece;
}

}  // namespace karinui

#include <algorithm>
#include <cmath>

#include "divide_edges.h"
#include "folded_paper.h"
#include "karinui/pattern/pleats.h"

namespace karinui {

namespace {

constexpr double kAtFold = 1e-6;  // metres
constexpr double kAsDeep = 5e-4;  // metres

// One of the lines of a pleat, by the height along them: how far across it lies. Beyond its ends it runs straight on.
class PleatLine {
 public:
  PleatLine(const Piece& piece, Flat end, Flat along) : across_(-leftOf(along)), along_(along) {
    double longest = 0;
    for (const InternalLine& line : piece.lines) {
      if (line.curves.empty()) continue;
      const Flat first = line.curves.front().start, last = line.curves.back().end;
      const double reach = std::fabs(dot(last - first, along));
      if (std::min(distance(first, end), distance(last, end)) > kAtFold || reach <= longest) continue;
      longest = reach, curves_ = line.curves;
    }
    if (curves_.empty()) curves_.push_back(Curve::line(end, end + along));
    if (dot(curves_.back().end - curves_.front().start, along) < 0) {
      std::reverse(curves_.begin(), curves_.end());
      for (Curve& curve : curves_) curve = curve.reversed();
    }
  }
  double low() const { return dot(curves_.front().start, along_); }
  double high() const { return dot(curves_.back().end, along_); }
  double at(double height) const {
    if (height <= low()) return dot(curves_.front().start, across_);
    if (height >= high()) return dot(curves_.back().end, across_);
    const auto curve = std::find_if(curves_.begin(), curves_.end() - 1,
                                    [&](const Curve& one) { return height <= dot(one.end, along_); });
    double below = 0, above = 1;
    for (int round = 0; round < 60; ++round) {
      const double middle = (below + above) / 2;
      (dot(curve->at(middle), along_) < height ? below : above) = middle;
    }
    return dot(curve->at((below + above) / 2), across_);
  }

 private:
  Flat across_, along_;
  std::vector<Curve> curves_;
};

// Pleats that are equally deep at every height, but not equally at all heights.
struct TaperedPleats {
  struct Pleat {
    PleatLine fold, place;
  };
  Flat along, across;
  std::vector<Pleat> pleats;  // ascending
  bool overlapping = false;

  double depth(double height) const {
    return std::fabs(pleats.front().fold.at(height) - pleats.front().place.at(height)) / 2;
  }
  FoldedPaper paper(double height) const {
    FoldedPaper now{across, depth(height), overlapping, {}};
    for (const Pleat& pleat : pleats) {
      const double fold = pleat.fold.at(height), place = pleat.place.at(height), strip = std::min(fold, place);
      const double at = strip - 2 * now.depth * static_cast<double>(now.folds.size());
      const bool toStart = place < fold;
      now.folds.push_back({at, toStart ? at : at - now.depth, strip, toStart});
    }
    return now;
  }
  // What the folds give way by widens the cloth to both sides.
  FoldedPlace folded(Flat place, double depthAtEdge) const {
    const FoldedPaper now = paper(dot(place, along));
    FoldedPlace in = now.folded(place);
    in.place = in.place - across * ((depthAtEdge - now.depth) * static_cast<double>(pleats.size()));
    return in;
  }
};

std::optional<PaperFolding> taperedFolding(const Piece& piece, std::vector<PaperPleat> pleats) {
  constexpr double kSteepest = 0.5;  // of a line, across for along
  constexpr int kLooks = 32;
  TaperedPleats all;
  all.along = leftOf(normalized(pleats.front().place - pleats.front().fold));
  if (dot(all.along, pleats.front().along) < 0) all.along = Flat{} - all.along;
  all.across = -leftOf(all.along);
  double top = HUGE_VAL, low = HUGE_VAL, high = -HUGE_VAL;
  for (const PaperPleat& pleat : pleats) {
    const Flat way = normalized(pleat.place - pleat.fold);
    if (std::fabs(cross(way, all.across)) > 1e-3) return std::nullopt;
    all.pleats.push_back({{piece, pleat.fold, all.along}, {piece, pleat.place, all.along}});
    top = std::min(top, dot(pleat.fold, all.along));
    for (const PleatLine* line : {&all.pleats.back().fold, &all.pleats.back().place})
      low = std::min(low, line->low()), high = std::max(high, line->high());
  }
  const auto begins = [&](const TaperedPleats::Pleat& one) { return std::min(one.fold.at(top), one.place.at(top)); };
  std::sort(all.pleats.begin(), all.pleats.end(),
            [&](const auto& one, const auto& next) { return begins(one) < begins(next); });
  // Told at both edges where both are sewn.
  const auto same = [&](const auto& one, const auto& next) { return begins(next) - begins(one) < kAtFold; };
  all.pleats.erase(std::unique(all.pleats.begin(), all.pleats.end(), same), all.pleats.end());
  for (int look = 0; look <= kLooks; ++look) {
    const double height = std::lerp(low, high, look / double{kLooks}), step = (high - low) / kLooks;
    const double depth = all.depth(height);
    if (depth < kLeastEdge / 2) return std::nullopt;
    double before = -HUGE_VAL;
    for (const TaperedPleats::Pleat& one : all.pleats) {
      const double fold = one.fold.at(height), place = one.place.at(height);
      const bool steep = look > 0 && std::max(std::fabs(fold - one.fold.at(height - step)),
                                              std::fabs(place - one.place.at(height - step))) > kSteepest * step;
      if (steep || std::fabs(std::fabs(fold - place) / 2 - depth) > kAsDeep || std::min(fold, place) < before - kAtFold)
        return std::nullopt;
      before = std::max(fold, place);
    }
  }
  const FoldedPaper edge = all.paper(top);
  for (std::size_t k = 1; k < edge.folds.size(); ++k)
    all.overlapping = all.overlapping || (edge.folds[k].toStart == edge.folds[k - 1].toStart &&
                                          edge.folds[k].at - edge.folds[k - 1].at < edge.depth - kAsDeep);
  const bool together = !all.overlapping;
  return PaperFolding{[all = std::move(all), depth = edge.depth](Flat place) { return all.folded(place, depth); },
                      together};
}

}  // namespace

std::optional<PaperFolding> foldingOf(const Pattern& pattern, PieceId id) {
  constexpr double kParallel = 1e-3, kSameStrip = 1e-3;  // sine; metres
  std::vector<PaperPleat> pleats = pleatsOf(pattern);
  std::erase_if(pleats, [&](const PaperPleat& pleat) { return pleat.piece != id; });
  if (pleats.empty()) return std::nullopt;
  const Flat along = pleats.front().along, across = -leftOf(along);
  const auto straight = [&](Flat from) {
    const Piece& piece = *pattern.pieces.at(id);
    return std::all_of(piece.lines.begin(), piece.lines.end(), [&](const InternalLine& line) {
      if (line.curves.empty()) return true;
      const Flat start = line.curves.front().start, end = line.curves.back().end;
      if (std::min(distance(start, from), distance(end, from)) > kAtFold) return true;
      const auto points = line.curves.front().flattened(1e-4);
      return line.curves.size() == 1 && std::all_of(points.begin(), points.end(), [&](Flat p) {
               return std::fabs(dot(p - start, across)) <= kParallel * std::max(0.1, distance(start, end));
             });
    });
  };
  FoldedPaper paper{across, std::fabs(dot(pleats.front().fold - pleats.front().place, across)) / 2, false, {}};
  for (const PaperPleat& pleat : pleats) {
    const double fold = dot(pleat.fold, across), place = dot(pleat.place, across);
    if (std::fabs(cross(pleat.along, along)) > kParallel || !straight(pleat.fold) || !straight(pleat.place) ||
        std::fabs(std::fabs(fold - place) / 2 - paper.depth) > kAsDeep)
      return taperedFolding(*pattern.pieces.at(id), pleats);
    const double strip = std::min(fold, place);
    const bool known = std::any_of(paper.folds.begin(), paper.folds.end(),
                                   [&](const auto& one) { return std::fabs(one.strip - strip) < kSameStrip; });
    if (!known) paper.folds.push_back({0, 0, strip, place < fold});
  }
  std::sort(paper.folds.begin(), paper.folds.end(), [](const auto& a, const auto& b) { return a.strip < b.strip; });
  for (std::size_t k = 0; k < paper.folds.size(); ++k) {
    auto& fold = paper.folds[k];
    fold.at = fold.strip - 2 * paper.depth * static_cast<double>(k);
    fold.low = fold.toStart ? fold.at : fold.at - paper.depth;
    paper.overlapping = paper.overlapping || (k > 0 && fold.toStart == paper.folds[k - 1].toStart &&
                                              fold.at - paper.folds[k - 1].at < paper.depth - kAsDeep);
  }
  return PaperFolding{[paper](Flat place) { return paper.folded(place); }};
}

}  // namespace karinui

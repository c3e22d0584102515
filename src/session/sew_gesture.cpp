// Sewing: from edge to edge. A drag that ends on another edge sews whole edges; one that ends on its own edge chooses
// the part it ran along, and the other side is shown next in the same way.
#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kPart = 0.03;   // metres along an edge that make a part of it
constexpr double kSnaps = 0.02;  // metres: a part's end this near to a corner, a notch or the middle is there

class SewGesture : public Gesture {
 public:
  Told feed(const PointerSample& sample, const Hit& hit, const Workbench& bench) override {
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        hover_ = hit.edge;
        return {};
      case PointerSample::Phase::Press:
        hover_ = hit.edge;
        if (!hit.edge) return {.why = say("Begin on the edge of a piece.")};
        from_ = hit.edge;
        return {};
      case PointerSample::Phase::Drag:
        if (hit.edge || !from_) hover_ = hit.edge;
        if (!hit.edge) hover_.reset();
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    if (!from_) return {};
    const EdgeNear from = *std::exchange(from_, std::nullopt);
    if (!hit.edge) {
      if (first_) return {.why = say("End on the edge it is sewn to.")};
      return {.over = true, .why = say("End on the edge it is sewn to.")};
    }
    const EdgeNear to = *hit.edge;
    const bool same = to.piece == from.piece && to.edge == from.edge;
    if (!same && !first_) return sewn({ref(from)}, {ref(to)});
    const EdgeRef here = same ? part(bench, from, to) : ref(to);
    if (first_) return sewn({*std::exchange(first_, std::nullopt)}, {here});
    first_ = here;
    return {};
  }

  bool takeBack() override {
    const bool any = from_ || first_;
    from_.reset();
    first_.reset();
    return any;
  }

  Preview preview(const Workbench& bench) const override {
    Preview shown;
    const std::optional<EdgeRef> a = first_ ? first_ : from_ ? std::optional(ref(*from_)) : std::nullopt;
    std::optional<EdgeRef> b;
    if (hover_) b = from_ && same(*from_, *hover_) ? part(bench, *from_, *hover_) : ref(*hover_);
    if (a && !(b && from_ && !first_ && same(*from_, *hover_))) showEdge(shown, bench, *a, kChalk);
    if (b) showEdge(shown, bench, *b, a ? kPartner : kChalk);
    if (!b) return shown;
    const Vec3 where = edgeInSpace(*bench.fitting, *b).at(2);
    const std::string mine = bench.said(lengthOf(bench, *b));
    if (!a || (*a).edge.empty() || (a->piece == b->piece && a->edge == b->edge)) {
      shown.space.words.push_back({where, b->edge + "  " + mine});
      shown.table.words.push_back({edgeOnTable(bench, *b).at(20), b->edge + "  " + mine});
      return shown;
    }
    // Threads from side to side, and what is left over.
    const auto left = edgeInSpace(*bench.fitting, *a);
    const auto right = edgeInSpace(*bench.fitting, *b);
    const bool crossed = crosses(left, right);
    for (int i = 0; i <= 12; ++i) {
      const auto at = [&](const std::vector<Vec3>& line, int k) {
        return line[static_cast<std::size_t>(k) * (line.size() - 1) / 12];
      };
      shown.space.lines.push_back({{at(left, i), at(right, crossed ? 12 - i : i)}, kPartner, 1, false});
    }
    const std::string words = easeSaid(bench, lengthOf(bench, *a), lengthOf(bench, *b));
    shown.space.words.push_back({where, words});
    shown.table.words.push_back({edgeOnTable(bench, *b).at(20), words});
    return shown;
  }

  Message hint() const override {
    if (first_) return say("Now the other side: click an edge, or drag along the part of it.");
    if (from_) return say("Drag to the edge it is sewn to, or along this edge to sew a part of it.");
    return info(Command::Sew).hint;
  }
  bool begun() const override { return from_ || first_; }
  Stops stops() const override { return Stops::Edges; }

 private:
  static EdgeRef ref(const EdgeNear& near) { return {PieceRef(near.piece), near.edge, 0, 1}; }
  static bool same(const EdgeNear& a, const EdgeNear& b) { return a.piece == b.piece && a.edge == b.edge; }

  // The run between two places of one edge; hardly any run means the whole edge.
  static EdgeRef part(const Workbench& bench, const EdgeNear& from, const EdgeNear& to) {
    EdgeRef whole = ref(from);
    const double all = lengthOf(bench, whole);
    if (!(all > 0) || std::fabs(to.fraction - from.fraction) * all < kPart) return whole;
    std::vector<double> marks{0, 0.5, 1};
    if (const Piece* piece = bench.fitting->document.find(from.piece))
      for (const Mark& mark : piece->marks)
        if (mark.edge == from.edge) marks.push_back(mark.fraction);
    const auto snapped = [&](double f) {
      double best = std::round(f * 1000) / 1000, nearest = kSnaps / all;
      for (const double mark : marks)
        if (std::fabs(mark - f) < nearest) nearest = std::fabs(mark - f), best = mark;
      return best;
    };
    whole.from = snapped(std::min(from.fraction, to.fraction));
    whole.to = snapped(std::max(from.fraction, to.fraction));
    if (whole.to <= whole.from) whole.from = 0, whole.to = 1;
    return whole;
  }

  static bool crosses(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    const double straight = squaredLength(a.front() - b.front()) + squaredLength(a.back() - b.back());
    const double turned = squaredLength(a.front() - b.back()) + squaredLength(a.back() - b.front());
    return turned < straight;
  }

  static Told sewn(std::vector<EdgeRef> a, std::vector<EdgeRef> b) {
    SewEdges sew;
    sew.a = std::move(a);
    sew.b = std::move(b);
    return {.over = true, .operation = std::move(sew)};
  }

  std::optional<EdgeNear> hover_, from_;
  std::optional<EdgeRef> first_;
};

}  // namespace

std::unique_ptr<Gesture> sewGesture() { return std::make_unique<SewGesture>(); }

}  // namespace karinui

// Sewing: two runs of edges. A run is dragged along the border, past corners and over sewn neighbours; a click takes a
// whole edge, with Shift one more. A drag across to another edge takes whole edges and both sides at once. What is
// plain is sewn at the drop; else a menu asks how.
#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/design/sewing.h"
#include "session/gestures.h"
#include "session/sewn_border.h"

namespace karinui {

namespace {

using Where = PointerSample::Where;
using Run = std::vector<EdgeRef>;

constexpr double kPart = 0.03;        // metres along the border that make a run
constexpr double kSnaps = 0.02;       // metres: a run's end this near to a corner, a notch or the middle is there
constexpr double kAgain = 0.05;       // metres: how far from where it left the border a drag may come back to it
constexpr double kLeft = 4;           // reaches beside the border, after which a drag has left it
constexpr double kPlainRatio = 1.05;  // sides that differ by no more are eased in without asking,
constexpr double kPlainSpare = 0.01;  // or by so many metres
constexpr double kGathers = 1.25;     // from this ratio on it is called gathering, not ease

// A drag along a border or away from it.
class Stroke {
 public:
  Stroke(const Workbench& bench, EdgeNear from, PointerSample sample)
      : border_(bench.fitting->document.pattern, from),
        from_(std::move(from)),
        last_(sample),
        began_(border_.find(from_).value_or(0)) {}

  const EdgeNear& from() const { return from_; }
  const std::optional<EdgeNear>& target() const { return target_; }
  bool onBorder() const { return !left_ && !target_; }
  bool isRun() const { return std::fabs(total_) >= kPart; }

  // Follows the pointer, in steps no longer than its reach.
  void to(const Workbench& bench, const PointerSample& sample, const WantedEdge& other) {
    const PointerSample before = last_;
    const int steps = std::clamp(static_cast<int>(std::ceil(apart(before, sample))), 1, 400);
    for (int k = 1; k <= steps; ++k) {
      PointerSample now = sample;
      const double share = static_cast<double>(k) / steps;
      now.place = lerp(before.place, sample.place, share);
      now.ray.origin = lerp(before.ray.origin, sample.ray.origin, share);
      now.ray.direction = normalized(lerp(before.ray.direction, sample.ray.direction, share));
      step(bench, now, other);
    }
    last_ = sample;
  }

  // What was dragged along, its ends snapped. Empty: hardly anything.
  Run run(const Workbench&) const {
    if (!isRun()) return {};
    double a = began_, b = began_ + total_;
    if (a > b) std::swap(a, b);
    const double most = a + border_.length();
    a = snapped(a), b = snapped(b);
    if (b - a < 1e-3) return {};
    return border_.between(a, std::min(b, most));
  }
  // The whole of the pressed edge, or what a seam leaves of it.
  Run edge(const Workbench& bench) const {
    const auto there = border_.find(from_);
    if (there)
      for (const EdgeRef& part : border_.between(0, border_.length()))
        if (part.piece.id == from_.piece && part.edge == from_.edge && part.from <= from_.fraction + 1e-6 &&
            from_.fraction <= part.to + 1e-6)
          return {part};
    (void)bench;
    return {{PieceRef(from_.piece), from_.edge, 0, 1}};
  }
  // Side one of a drag to another edge: the run if at least one whole edge was dragged along before, else the edge.
  Run sideBeforeLeaving(const Workbench& bench) const {
    Run run = this->run(bench);
    const Run whole = edge(bench);
    if (std::find(run.begin(), run.end(), whole.front()) == run.end()) return whole;
    // The beginning of an edge beyond the last corner is where the drag turned away.
    const EdgeRef last = total_ > 0 ? run.back() : run.front();
    if (run.size() > 1 && last.to - last.from < 0.5) run.erase(total_ > 0 ? run.end() - 1 : run.begin());
    return run;
  }
  bool backwards() const { return total_ < 0; }

 private:
  // In reaches of the pointer.
  static double apart(const PointerSample& a, const PointerSample& b) {
    if (b.where == Where::Table) return distance(a.place, b.place) / b.reach;
    return (length(cross(a.ray.direction, b.ray.direction)) + distance(a.ray.origin, b.ray.origin)) / b.reach;
  }
  double metres(const Workbench& bench, const PointerSample& sample, const EdgeNear& near) const {
    if (sample.where == Where::Table) return sample.reach;
    const auto line = edgeInSpace(*bench.fitting, {PieceRef(near.piece), near.edge, 0, 1});
    return line.empty() ? sample.reach : sample.reach * distance(line[line.size() / 2], sample.ray.origin);
  }
  double forth(double along) const {  // the shorter way to a place of the border
    const double whole = border_.length(), by = border_.wrapped(along - began_ - total_);
    return by > whole / 2 ? by - whole : by;
  }

  void step(const Workbench& bench, const PointerSample& sample, const WantedEdge& other) {
    PointerSample wide = sample;
    wide.reach *= 1.5;
    const auto own = pickEdge(*bench.fitting, *bench.table, wide,
                              [&](const EdgeNear& near) { return border_.find(near).has_value(); });
    const auto any = pickEdge(*bench.fitting, *bench.table, sample, other);
    const bool elsewhere = any && (!own || (own->away > 0.5 * sample.reach && any->away < 0.5 * own->away)) &&
                           !(any->piece == from_.piece && any->edge == from_.edge);
    const double reach = metres(bench, sample, from_);
    if (own && !elsewhere) {
      const double by = forth(*border_.find(*own));
      const bool same = own->piece == onto_.piece && own->edge == onto_.edge;
      if (std::fabs(by) < (left_ ? kAgain : 4 * reach + 0.02) || same ||
          (own->piece == from_.piece && own->edge == from_.edge)) {
        total_ = std::clamp(total_ + by, -border_.length(), border_.length());
        onto_ = *own, left_ = false, beside_ = 0;
        target_.reset();
        return;
      }
    }
    beside_ += 1;
    if (beside_ > kLeft) left_ = true;
    target_.reset();
    if (any && (left_ || elsewhere) && !(any->piece == from_.piece && any->edge == from_.edge)) target_ = any;
  }

  double snapped(double along) const {
    double best = along, nearest = kSnaps;
    for (const double stop : border_.stops())
      for (const double turn : {-border_.length(), 0.0, border_.length(), 2 * border_.length()})
        if (const double away = std::fabs(stop + turn - along); away < nearest) nearest = away, best = stop + turn;
    return best;
  }

  SewnBorder border_;
  EdgeNear from_, onto_;
  PointerSample last_;
  double began_, total_ = 0, beside_ = 0;
  bool left_ = false;
  std::optional<EdgeNear> target_;
};

class SewGesture : public Gesture {
 public:
  Told feed(const PointerSample& sample, const Hit&, const Workbench& bench) override {
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        if (!asks_) hover_ = under(bench, sample);
        return {};
      case PointerSample::Phase::Press:
        return press(bench, sample);
      case PointerSample::Phase::Drag:
        if (stroke_) stroke_->to(bench, sample, free());
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    if (!stroke_) return {};
    stroke_->to(bench, sample, free());
    const Stroke stroke = *std::exchange(stroke_, std::nullopt);
    where_ = sample.where;
    if (asks_) return added(bench, second_, stroke);
    if (stroke.target()) {
      const Run other = Stroke(bench, *stroke.target(), sample).edge(bench);
      const Run mine = overlap(first_, stroke.edge(bench)) ? first_ : stroke.sideBeforeLeaving(bench);
      backwards_ = overlap(first_, mine) ? backwards_ : stroke.isRun() && stroke.backwards();
      return dropped(bench, mine, other);
    }
    if (!stroke.onBorder()) {
      const Told told{.over = first_.empty(), .operation = {}, .why = say("End on the edge it is sewn to.")};
      return told;
    }
    if (!first_.empty() && sample.shift) return added(bench, first_, stroke);
    Run run = stroke.isRun() ? stroke.run(bench) : stroke.edge(bench);
    if (run.empty()) run = stroke.edge(bench);
    if (first_.empty()) {
      first_ = std::move(run);
      backwards_ = stroke.isRun() && stroke.backwards();
      return {};
    }
    if (overlap(first_, run)) {
      if (!stroke.isRun() || run == first_) return first_.clear(), Told{.over = true};  // chosen no more
      return {.why = say("{0} cannot be sewn to itself; choose another edge for the other side.",
                         spoken(bench, run.front()))};
    }
    return dropped(bench, first_, std::move(run));
  }

  Told confirm(const Workbench& bench) override { return asks_ ? choose(current_, bench) : Told(); }

  bool takeBack() override {
    if (std::exchange(asks_, false)) return second_.clear(), swapped_ = false, true;
    const bool any = stroke_ || !first_.empty();
    stroke_.reset();
    first_.clear();
    return any;
  }

  std::optional<DropMenu> dropMenu(const Workbench& bench) const override {
    if (!asks_) return std::nullopt;
    DropMenu menu;
    const Plan plan = planned(bench);
    for (const SeamDoubt& doubt : plan.doubts) menu.title.push_back(doubt.what);
    if (plan.doubts.empty()) menu.title.push_back(say("How is it sewn?  {0}", easeSaid(bench, plan.la, plan.lb)));
    for (const Item& item : plan.items) menu.items.push_back({item.label, item.checked});
    menu.current = std::min(current_, menu.items.size() - 1);
    menu.where = where_;
    menu.space = middleOf(edgeInSpace(*bench.fitting, second_.back()));
    menu.table = middleOf(edgeOnTable(bench, second_.back()));
    return menu;
  }

  Told choose(std::size_t which, const Workbench& bench) override {
    if (!asks_) return {};
    const Plan plan = planned(bench);
    if (which >= plan.items.size()) return {};
    const Item& item = plan.items[which];
    switch (item.does) {
      case Item::Does::Sew:
        return sewn(bench, item.sew);
      case Item::Does::Swap:
        swapped_ = !swapped_;
        return {};
      case Item::Does::Mirror:
        return {.mirrorSeams = !bench.mirrorSeams};
      case Item::Does::Leave:
        break;
    }
    return {.over = true};
  }
  void moveInMenu(int by, const Workbench& bench) override {
    if (!asks_) return;
    const std::size_t count = planned(bench).items.size();
    current_ = (std::min(current_, count - 1) + count + static_cast<std::size_t>(by + static_cast<int>(count))) % count;
  }

  Preview preview(const Workbench& bench) const override {
    Preview shown;
    Run a = first_, b;
    std::optional<SewEdges> seam;
    if (asks_) {
      const Plan plan = planned(bench);
      const Item& item = plan.items[std::min(current_, plan.items.size() - 1)];
      seam = item.does == Item::Does::Sew ? item.sew : plan.whole;
    } else if (stroke_ && stroke_->target()) {
      a = overlap(first_, stroke_->edge(bench)) ? first_ : stroke_->sideBeforeLeaving(bench);
      b = {{PieceRef(stroke_->target()->piece), stroke_->target()->edge, 0, 1}};
    } else if (stroke_ && stroke_->onBorder()) {
      b = stroke_->isRun() ? stroke_->run(bench) : stroke_->edge(bench);
      if (a.empty()) std::swap(a, b);
    } else if (stroke_) {
      if (a.empty()) a = stroke_->sideBeforeLeaving(bench);
    } else if (hover_) {
      b = {{PieceRef(hover_->piece), hover_->edge, 0, 1}};
      if (a.empty()) std::swap(a, b);
    }
    if (!seam && !a.empty() && !b.empty() && !overlap(a, b)) seam = both(bench, a, b);
    if (!seam) {
      for (const EdgeRef& ref : a) showEdge(shown, bench, ref, kChalk);
      for (const EdgeRef& ref : b) showEdge(shown, bench, ref, kBad);
      const Run& last = b.empty() ? a : b;
      if (last.empty()) return shown;
      std::string words;
      for (const EdgeRef& ref : last) words += (words.empty() ? "" : " + ") + ref.edge;
      words += "  " + bench.said(lengthOf(bench.fitting->document, last));
      shown.space.words.push_back({middleOf(edgeInSpace(*bench.fitting, last.back())), words});
      shown.table.words.push_back({middleOf(edgeOnTable(bench, last.back())), words});
      return shown;
    }
    showSeam(shown, bench, *seam);
    if (seam->mirror)
      if (const auto image = mirrorImage(bench.fitting->document, *seam)) showSeam(shown, bench, *image);
    const Document& document = bench.fitting->document;
    const std::string words = easeSaid(bench, lengthOf(document, seam->a), lengthOf(document, seam->b));
    shown.space.words.push_back({middleOf(edgeInSpace(*bench.fitting, seam->b.back())), words});
    shown.table.words.push_back({middleOf(edgeOnTable(bench, seam->b.back())), words});
    return shown;
  }

  Message hint() const override {
    if (asks_)
      return say("Choose how it is sewn: click, or arrows and Enter; Esc leaves it. Shift+click adds an edge.");
    if (stroke_)
      return say("Drag along the side, past corners too, to sew all of it; or across to the edge it is sewn to.");
    if (!first_.empty())
      return say("Now the other side: click an edge or drag along it. Shift+click adds an edge to the first.");
    return info(Command::Sew).hint;
  }
  bool begun() const override { return stroke_ || !first_.empty(); }
  Stops stops() const override { return Stops::Edges; }

 private:
  struct Item {
    enum class Does { Sew, Swap, Mirror, Leave } does;
    Message label;
    SewEdges sew = {};
    std::optional<bool> checked = {};
  };
  struct Plan {
    double la, lb;
    SewEdges whole;  // both runs, all of them
    std::vector<SeamDoubt> doubts;
    std::vector<Item> items;
  };

  static std::string spoken(const Workbench& bench, const EdgeRef& ref) {
    return bench.fitting->document.find(ref.piece.id)->name + "." + ref.edge;
  }
  template <class Point>
  static Point middleOf(const std::vector<Point>& line) {
    return line.empty() ? Point() : line[line.size() / 2];
  }

  // Edges of the side chosen already are not offered for the other.
  WantedEdge free() const {
    return [this](const EdgeNear& near) {
      return std::none_of(first_.begin(), first_.end(), [&](const EdgeRef& ref) {
        return ref.piece.id == near.piece && ref.edge == near.edge && ref.from <= near.fraction &&
               near.fraction <= ref.to;
      });
    };
  }
  std::optional<EdgeNear> under(const Workbench& bench, const PointerSample& sample) const {
    if (auto near = pickEdge(*bench.fitting, *bench.table, sample, free())) return near;
    return pickEdge(*bench.fitting, *bench.table, sample, [](const EdgeNear&) { return true; });
  }

  Told press(const Workbench& bench, const PointerSample& sample) {
    stroke_.reset(), hover_.reset();
    if (asks_ && !sample.shift) return {};
    const auto near = under(bench, sample);
    if (!near) return {.why = say("Begin on the edge of a piece.")};
    stroke_.emplace(bench, *near, sample);
    return {};
  }

  // One more edge or run of a side; an edge of it that is clicked again is taken away.
  Told added(const Workbench& bench, Run& side, const Stroke& stroke) {
    Run more = stroke.isRun() ? stroke.run(bench) : stroke.edge(bench);
    if (more.empty()) more = stroke.edge(bench);
    const auto at = std::find(side.begin(), side.end(), more.front());
    if (more.size() == 1 && at != side.end() && side.size() > 1) {
      side.erase(at);
    } else if (overlap(first_, more) || overlap(second_, more)) {
      return {.why = say("{0} is chosen already.", spoken(bench, more.front()))};
    } else {
      // Before or after what there is: where the ends are nearer; in the order of the clicks where both are.
      const auto end = [&](const Run& run) { return edgeInSpace(*bench.fitting, run.back()).back(); };
      const auto begin = [&](const Run& run) { return edgeInSpace(*bench.fitting, run.front()).front(); };
      constexpr double kSameGap = 0.02;  // metres
      const bool before = distance(end(more), begin(side)) + kSameGap < distance(end(side), begin(more));
      side.insert(before ? side.begin() : side.end(), more.begin(), more.end());
    }
    current_ = 0;
    return {};
  }

  SewEdges both(const Workbench& bench, const Run& a, const Run& b) const {
    const Document& document = bench.fitting->document;
    SewEdges sew;
    sew.a = a, sew.b = b;
    if (swapped_) sew.reversed = facesReversed(document, sew) ? Choice::No : Choice::Yes;
    sew.mirror = bench.mirrorSeams && mirrorImage(document, sew);
    return sew;
  }

  Plan planned(const Workbench& bench) const {
    const Document& document = bench.fitting->document;
    Plan plan{lengthOf(document, first_), lengthOf(document, second_), both(bench, first_, second_), {}, {}};
    plan.doubts = seamDoubts(document, plan.whole, bench.fitting->body.get());
    const bool mirrors = static_cast<bool>(mirrorImage(document, plan.whole));
    const auto offer = [&](Message label, SewEdges sew) {
      plan.items.push_back({Item::Does::Sew, std::move(label), std::move(sew)});
    };
    for (const SeamDoubt& doubt : plan.doubts)
      if (doubt.instead && !(swapped_ && doubt.kind == SeamDoubt::Kind::Twisted)) {
        SewEdges instead = *doubt.instead;
        instead.mirror = bench.mirrorSeams && mirrorImage(document, instead);
        offer(doubt.proposal, std::move(instead));
      }
    const double shorter = std::fmin(plan.la, plan.lb), spare = std::fabs(plan.la - plan.lb);
    const double ratio = (shorter + spare) / shorter;
    SewEdges whole = plan.whole;
    const bool sewn = std::any_of(plan.doubts.begin(), plan.doubts.end(),
                                  [](const SeamDoubt& d) { return d.kind == SeamDoubt::Kind::Sewn; });
    const bool meant = std::all_of(plan.doubts.begin(), plan.doubts.end(), [](const SeamDoubt& d) {
      return d.kind == SeamDoubt::Kind::Gathered || d.kind == SeamDoubt::Kind::Twisted;
    });
    if (!sewn) {
      if (!meant)
        offer(say("Sew it all the same"), whole);
      else if (ratio >= kGathers)
        offer(say("All of it, gathered {0}:1", fixed(ratio, 2)), whole);
      else if (spare < 1e-3)
        offer(say("1:1"), whole);
      else
        offer(say("All of it, {0} of ease", bench.said(spare)), whole);
      // The longer side only as far as it goes with so much fullness, from where the hand began.
      const bool against =
          whole.reversed == Choice::Auto ? facesReversed(document, whole) : whole.reversed == Choice::Yes;
      for (const double wanted : {1.0, 1.5, 2.0}) {
        if (ratio < wanted * 1.02 || !meant) continue;
        SewEdges part = whole;
        auto& longer = plan.la > plan.lb ? part.a : part.b;
        longer = trimmed(document, longer, wanted * shorter, plan.la > plan.lb ? backwards_ : backwards_ != against);
        part.tie = wanted == 2 ? SewEdges::Tie::TwoToOne : SewEdges::Tie::OneToOne;
        const std::string open = bench.said(shorter + spare - wanted * shorter);
        offer(wanted == 1     ? say("1:1, {0} stays open", open)
              : wanted == 1.5 ? say("Gathered 1.5:1, {0} stays open", open)
                              : say("Gathered 2:1, {0} stays open", open),
              std::move(part));
      }
      plan.items.push_back({Item::Does::Swap, say("The other way round"), {}, swapped_});
    }
    if (mirrors) plan.items.push_back({Item::Does::Mirror, say("The mirrored seam too"), {}, bench.mirrorSeams});
    plan.items.push_back({Item::Does::Leave, say("Leave it")});
    return plan;
  }

  // Both sides are there.
  Told dropped(const Workbench& bench, Run a, Run b) {
    if (overlap(a, b))
      return {.over = first_.empty(),
              .why = say("{0} cannot be sewn to itself; choose another edge for the other side.",
                         spoken(bench, b.front()))};
    first_ = std::move(a), second_ = std::move(b);
    current_ = 0;
    const Plan plan = planned(bench);
    const double spare = std::fabs(plan.la - plan.lb);
    if (plan.doubts.empty() && (spare <= kPlainSpare || spare <= (kPlainRatio - 1) * std::fmin(plan.la, plan.lb)))
      return sewn(bench, plan.whole);
    asks_ = true;
    return {};
  }

  static Told sewn(const Workbench&, SewEdges sew) { return {.over = true, .operation = std::move(sew)}; }

  // Both sides, and threads from one to the other.
  static void showSeam(Preview& shown, const Workbench& bench, const SewEdges& sew) {
    const auto line = [&](const Run& run) {
      std::vector<Vec3> points;
      for (const EdgeRef& ref : run) {
        const auto part = edgeInSpace(*bench.fitting, ref);
        points.insert(points.end(), part.begin(), part.end());
      }
      return points;
    };
    for (const EdgeRef& ref : sew.a) showEdge(shown, bench, ref, kChalk);
    for (const EdgeRef& ref : sew.b) showEdge(shown, bench, ref, kPartner);
    const auto a = line(sew.a), b = line(sew.b);
    if (a.empty() || b.empty()) return;
    const bool against =
        sew.reversed == Choice::Auto ? facesReversed(bench.fitting->document, sew) : sew.reversed == Choice::Yes;
    constexpr std::size_t kThreads = 12;
    for (std::size_t i = 0; i <= kThreads; ++i) {
      const auto at = [&](const std::vector<Vec3>& points, std::size_t k) {
        return points[k * (points.size() - 1) / kThreads];
      };
      shown.space.lines.push_back({{at(a, i), at(b, against ? kThreads - i : i)}, kPartner, 1, false});
    }
  }

  std::optional<EdgeNear> hover_;
  std::optional<Stroke> stroke_;
  Run first_, second_;
  bool backwards_ = false;  // the first side was dragged against its outlines' direction
  bool asks_ = false, swapped_ = false;
  std::size_t current_ = 0;
  Where where_ = Where::Space;
};

}  // namespace

std::unique_ptr<Gesture> sewGesture() { return std::make_unique<SewGesture>(); }

}  // namespace karinui

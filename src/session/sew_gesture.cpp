// Sewing: two runs of edges. A run is dragged along the border, past corners and over sewn neighbours; a click takes a
// whole edge, with Shift one more. A drag across to another edge takes whole edges and both sides at once. What is
// plain is sewn at the drop; else a menu asks how.
#include <algorithm>
#include <cmath>

#include "karinui/base/number.h"
#include "karinui/design/sewing.h"
#include "karinui/design/step_words.h"
#include "karinui/session/touch_scene_of.h"
#include "session/gestures.h"
#include "session/sew_plan.h"
#include "session/sew_stroke.h"

namespace karinui {

namespace {

using Where = PointerSample::Where;

class SewGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit&, const GestureContext& context) override {
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        if (!asks_) hover_ = under(context, sample);
        return {};
      case PointerSample::Phase::Press:
        return press(context, sample);
      case PointerSample::Phase::Drag:
        if (stroke_) stroke_->to(context, sample, free());
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    if (!stroke_) return {};
    stroke_->to(context, sample, free());
    const SewStroke stroke = *std::exchange(stroke_, std::nullopt);
    where_ = sample.where, always_ = sample.control;
    if (asks_) return added(context, second_, stroke);
    if (stroke.target()) {
      const Run other = SewStroke(context, *stroke.target(), sample).edge();
      const Run mine = overlap(first_, stroke.edge()) ? first_ : stroke.sideBeforeLeaving();
      backwards_ = overlap(first_, mine) ? backwards_ : stroke.isRun() && stroke.backwards();
      return dropped(context, mine, other);
    }
    if (!stroke.onBorder()) {
      return {.over = first_.empty(), .why = say("End on the edge it is sewn to.")};
    }
    if (!first_.empty() && sample.shift) return added(context, first_, stroke);
    Run run = stroke.run();
    if (first_.empty()) {
      first_ = std::move(run);
      backwards_ = stroke.isRun() && stroke.backwards();
      return {};
    }
    if (overlap(first_, run)) {
      if (!stroke.isRun() || run == first_) return first_.clear(), GestureResult{.over = true};  // chosen no more
      return {.why = say("{0} cannot be sewn to itself; choose another edge for the other side.",
                         spoken(context, run.front()))};
    }
    return dropped(context, first_, std::move(run));
  }

  GestureResult confirm(const GestureContext& context) override {
    return asks_ ? choose(current_, context) : GestureResult();
  }

  bool takeBack() override {
    if (std::exchange(asks_, false)) return second_.clear(), swapped_ = false, true;
    const bool any = stroke_ || !first_.empty();
    stroke_.reset();
    first_.clear();
    return any;
  }

  std::optional<DropMenu> dropMenu(const GestureContext& context) const override {
    if (!asks_) return std::nullopt;
    DropMenu menu;
    const SewPlan plan = planned(context);
    for (const SeamDoubt& doubt : plan.doubts) menu.title.push_back(doubt.what);
    if (plan.doubts.empty()) menu.title.push_back(say("How is it sewn?  {0}", easeSaid(context, plan.la, plan.lb)));
    for (const SewPlan::Item& item : plan.items) menu.items.push_back({item.label, item.checked});
    menu.current = std::min(current_, menu.items.size() - 1);
    menu.number = plan.ratio;
    if (menu.number) menu.number->asked = typing_;
    menu.where = where_;
    menu.space = middleOf(edgeInSpace(*context.snapshot, second_.back()));
    menu.table = middleOf(edgeOnTable(context, second_.back()));
    return menu;
  }

  GestureResult choose(std::size_t which, const GestureContext& context) override {
    if (!asks_) return {};
    const SewPlan plan = planned(context);
    if (which >= plan.items.size()) return {};
    const SewPlan::Item& item = plan.items[which];
    switch (item.does) {
      case SewPlan::Does::Sew:
        return sewn(context, item.sew);
      case SewPlan::Does::Type:  // a face without keys takes the ratio as it stands by choosing it again
        if (std::exchange(typing_, true)) return chooseNumber(plan.ratio->value, context);
        return {};
      case SewPlan::Does::Swap:
        swapped_ = !swapped_;
        return {};
      case SewPlan::Does::Mirror: {
        ToolOptions options = context.options;
        options.mirrorSeams = !options.mirrorSeams;
        return {.options = options};
      }
      case SewPlan::Does::Leave:
        break;
    }
    return {.over = true};
  }
  GestureResult chooseNumber(double ratio, const GestureContext& context) override {
    if (!asks_) return {};
    const SewPlan plan = planned(context);
    if (!plan.ratio) return {};
    if (!(ratio >= plan.ratio->least && ratio <= plan.ratio->most))
      return {.why = say("The longer side is {0} times as long as the other; type a ratio between 1 and that.",
                         fixed(plan.ratio->most, 2))};
    return sewn(context, gatheredTo(context, plan, ratio, backwards_));
  }
  void moveInMenu(int by, const GestureContext& context) override {
    if (!asks_) return;
    const std::size_t count = planned(context).items.size();
    typing_ = false;
    current_ = (std::min(current_, count - 1) + count + static_cast<std::size_t>(by + static_cast<int>(count))) % count;
  }

  Preview preview(const GestureContext& context) const override {
    Preview shown;
    Run a = first_, b;
    std::optional<SewEdges> seam;
    bool doubted = false;
    if (asks_) {
      const SewPlan plan = planned(context);
      const SewPlan::Item& item = plan.items[std::min(current_, plan.items.size() - 1)];
      seam = item.does == SewPlan::Does::Sew ? item.sew : plan.whole;
      doubted = !plan.doubts.empty() && seam->a == plan.whole.a && seam->b == plan.whole.b && !seam->replace;
    } else if (stroke_ && stroke_->target()) {
      a = overlap(first_, stroke_->edge()) ? first_ : stroke_->sideBeforeLeaving();
      b = {{PieceRef(stroke_->target()->piece), stroke_->target()->edge, 0, 1}};
    } else if (stroke_ && stroke_->onBorder()) {
      b = stroke_->run();
      if (a.empty()) std::swap(a, b);
    } else if (stroke_) {
      if (a.empty()) a = stroke_->sideBeforeLeaving();
    } else if (hover_) {
      b = {{PieceRef(hover_->piece), hover_->edge, 0, 1}};
      if (a.empty()) std::swap(a, b);
    }
    if (!seam && !a.empty() && !b.empty() && !overlap(a, b)) seam = seamOf(context, a, b, false);
    if (!seam) {
      for (const EdgeRef& ref : a) showEdge(shown, context, ref, kChalk);
      for (const EdgeRef& ref : b) showEdge(shown, context, ref, kBad);
      const Run& last = b.empty() ? a : b;
      if (last.empty()) return shown;
      std::string words;
      for (const EdgeRef& ref : last)
        words +=
            (words.empty() ? "" : " + ") +
            text(edgeNameSaid(context.snapshot->document, *context.snapshot->document.find(ref.piece.id), ref.edge),
                 context.language);
      words += "  " + context.said(lengthOf(context.snapshot->document, last));
      shown.space.words.push_back({middleOf(edgeInSpace(*context.snapshot, last.back())), words});
      shown.table.words.push_back({middleOf(edgeOnTable(context, last.back())), words});
      return shown;
    }
    showSeam(shown, context, *seam, doubted ? kBad : kPartner);
    if (seam->mirror)
      if (const auto image = mirrorImage(context.snapshot->document, *seam)) showSeam(shown, context, *image, kPartner);
    const Document& document = context.snapshot->document;
    const std::string words = easeSaid(context, lengthOf(document, seam->a), lengthOf(document, seam->b));
    shown.space.words.push_back({middleOf(edgeInSpace(*context.snapshot, seam->b.back())), words});
    shown.table.words.push_back({middleOf(edgeOnTable(context, seam->b.back())), words});
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
  // An edge that will be sewn is felt when the hand comes to it.
  void addTo(Handling& handling) const override {
    const bool second = !stroke_ && !first_.empty() && !asks_ && hover_ &&
                        !overlap(first_, {{PieceRef(hover_->piece), hover_->edge, 0, 1}});
    if (const auto other = stroke_ ? stroke_->target() : second ? hover_ : std::nullopt)
      handling.snap = std::hash<std::string>()(text(other->piece) + "." + other->edge) | 1;
  }
  KeyStops keyStops() const override { return KeyStops::Edges; }

 private:
  static std::string spoken(const GestureContext& context, const EdgeRef& ref) {
    return context.snapshot->document.find(ref.piece.id)->name + "." + ref.edge;
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
  std::optional<EdgeNear> under(const GestureContext& context, const PointerSample& sample) const {
    if (auto near = pickEdge(*context.snapshot, *context.table, sample, free())) return near;
    return pickEdge(*context.snapshot, *context.table, sample, [](const EdgeNear&) { return true; });
  }

  GestureResult press(const GestureContext& context, const PointerSample& sample) {
    stroke_.reset(), hover_.reset();
    if (asks_ && !sample.shift) return {};
    const auto near = under(context, sample);
    if (!near) return {.why = say("Begin on the edge of a piece.")};
    stroke_.emplace(context, *near, sample);
    return {};
  }

  // One more edge or run of a side; an edge of it that is clicked again is taken away.
  GestureResult added(const GestureContext& context, Run& side, const SewStroke& stroke) {
    const Run more = stroke.run();
    const auto at = std::find(side.begin(), side.end(), more.front());
    if (more.size() == 1 && at != side.end() && side.size() > 1) {
      side.erase(at);
    } else if (overlap(first_, more) || overlap(second_, more)) {
      return {.why = say("{0} is chosen already.", spoken(context, more.front()))};
    } else {
      // Before or after what there is: where the ends are nearer; in the order of the clicks where both are.
      const auto end = [&](const Run& run) { return edgeInSpace(*context.snapshot, run.back()).back(); };
      const auto begin = [&](const Run& run) { return edgeInSpace(*context.snapshot, run.front()).front(); };
      constexpr double kSameGap = 0.02;  // metres
      const bool before = distance(end(more), begin(side)) + kSameGap < distance(end(side), begin(more));
      side.insert(before ? side.begin() : side.end(), more.begin(), more.end());
    }
    current_ = 0;
    return {};
  }

  SewPlan planned(const GestureContext& context) const {
    return sewPlan(context, first_, second_, swapped_, backwards_);
  }

  // Both sides are there.
  GestureResult dropped(const GestureContext& context, Run a, Run b) {
    if (overlap(a, b))
      return {.over = first_.empty(),
              .why = say("{0} cannot be sewn to itself; choose another edge for the other side.",
                         spoken(context, b.front()))};
    first_ = std::move(a), second_ = std::move(b);
    current_ = 0, typing_ = false;
    const SewPlan plan = planned(context);
    if (!always_ && plan.plain()) return sewn(context, plan.whole);
    asks_ = true;
    return {};
  }

  static GestureResult sewn(const GestureContext&, SewEdges sew) { return {.over = true, .operation = std::move(sew)}; }

  // Both sides, and threads from one to the other.
  static void showSeam(Preview& shown, const GestureContext& context, const SewEdges& sew, const Colour& threads) {
    const auto line = [&](const Run& run) {
      std::vector<Vec3> points;
      for (const EdgeRef& ref : run) {
        const auto part = edgeInSpace(*context.snapshot, ref);
        points.insert(points.end(), part.begin(), part.end());
      }
      return points;
    };
    for (const EdgeRef& ref : sew.a) showEdge(shown, context, ref, kChalk);
    for (const EdgeRef& ref : sew.b) showEdge(shown, context, ref, kPartner);
    const auto a = line(sew.a), b = line(sew.b);
    if (a.empty() || b.empty()) return;
    const bool against = sew.reversed == Choice::Auto
                             ? facesReversed(context.snapshot->document, sew, context.snapshot->body.get())
                             : sew.reversed == Choice::Yes;
    constexpr std::size_t kThreads = 12;
    for (std::size_t i = 0; i <= kThreads; ++i) {
      const auto at = [&](const std::vector<Vec3>& points, std::size_t k) {
        return points[k * (points.size() - 1) / kThreads];
      };
      shown.space.lines.push_back({{at(a, i), at(b, against ? kThreads - i : i)}, threads, 1, false});
    }
  }

  std::optional<EdgeNear> hover_;
  std::optional<SewStroke> stroke_;
  Run first_, second_;
  bool backwards_ = false;  // the first side was dragged against its outlines' direction
  bool asks_ = false, swapped_ = false, typing_ = false;
  bool always_ = false;  // Ctrl at the drop: the menu opens even where all is plain
  std::size_t current_ = 0;
  Where where_ = Where::Space;
};

}  // namespace

std::unique_ptr<Gesture> sewGesture() { return std::make_unique<SewGesture>(); }

}  // namespace karinui

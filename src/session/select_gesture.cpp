// Choosing pieces, edges and seams, in space and on the table alike. The slider of a zip is dragged.
#include <cmath>

#include "session/gestures.h"
#include "session/zip_slider.h"

namespace karinui {

namespace {

class SelectGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        hover_ = hit.edge;
        slider_ = sliderAt(sample, hit, context);
        return {};
      case PointerSample::Phase::Press: {
        Selection selection;
        if (hit.piece) selection.pieces = {hit.piece};
        selection.edge = hit.edge;
        if (hit.edge) selection.seam = seamAt(context.snapshot->document, *hit.edge);
        chosen_ = selection;
        if (sample.shift) chosen_.reset();
        if (sample.shift && hit.piece) chosen_ = Selection{{hit.piece}, {}, {}};  // one more of several, or one less
        slider_ = held_ = sliderAt(sample, hit, context);
        if (held_) closed_ = held_->closed();
        return {};
      }
      case PointerSample::Phase::Drag: {
        if (!held_) return {};
        const double closed = held_->drawnTo(sample, *context.table);
        if (closed == closed_) return {};
        closed_ = closed;
        return {.request = OperationPreview{drawn(), true}};
      }
      case PointerSample::Phase::Release:
        break;
    }
    if (!held_) return {};
    if (std::fabs(closed_ - held_->closed()) < kSame) return {.over = true};
    return {.over = true, .operation = drawn()};
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (slider_) return showSlider(context);
    if (!hover_) return shown;
    showEdge(shown, context, {PieceRef(hover_->piece), hover_->edge}, kChalk);
    // Where it is sewn: to what, and what one side has to spare.
    const Document& document = context.snapshot->document;
    if (const auto at = document.pattern.seams.find(seamAt(document, *hover_)); at != document.pattern.seams.end()) {
      const auto whole = [&](const std::vector<EdgeSpan>& side) {
        double sum = 0;
        for (const EdgeSpan& s : side) {
          const EdgeRef part{PieceRef(s.piece), s.edge, s.from, s.to};
          sum += lengthOf(context, part);
          showEdge(shown, context, part, kPartner);
        }
        return sum;
      };
      const double one = whole(at->second.a), other = whole(at->second.b);
      const std::string words = easeSaid(context, one, other);
      const EdgeRef here{PieceRef(hover_->piece), hover_->edge};
      if (const auto line = edgeInSpace(*context.snapshot, here); !line.empty())
        shown.space.words.push_back({line[line.size() / 2], words});
      if (const auto line = edgeOnTable(context, here); !line.empty())
        shown.table.words.push_back({line[line.size() / 2], words});
    }
    return shown;
  }
  Message hint() const override {
    return slider_ ? say("Drag the slider along the zip: it is closed as far as you draw it.")
                   : info(Command::Select).hint;
  }
  bool begun() const override { return held_.has_value(); }
  KeyStops keyStops() const override { return KeyStops::PiecesAndSliders; }
  bool clicks() const override { return !slider_; }
  std::optional<Selection> chosen() override { return std::exchange(chosen_, std::nullopt); }

 private:
  static constexpr double kSame = 1e-4;  // metres

  static std::optional<ZipWay> sliderAt(const PointerSample& sample, const Hit& hit, const GestureContext& context) {
    constexpr double kBehind = 0.03;  // metres: a slider just behind the first thing met is seen still
    std::optional<ZipWay> nearest;
    double least = sample.reach;
    for (ZipWay& way : zipsOf(context.snapshot->document)) {
      const double away = way.away(sample, *context.table);
      const bool hidden = sample.where == PointerSample::Where::Space && !sample.tip && hit.on != Hit::On::Nothing &&
                          distance(way.at(way.closed()).over.space, sample.ray.origin) > hit.along + kBehind;
      if (away <= least && !hidden) least = away, nearest = std::move(way);
    }
    return nearest;
  }
  Operation drawn() const {
    Fasten fasten;
    fasten.name = held_->name();
    fasten.closedLength = Length{closed_};
    return fasten;
  }
  Preview showSlider(const GestureContext& context) const {
    Preview shown;
    const double closed = held_ ? closed_ : slider_->closed();
    const ZipPlace place = slider_->at(closed);
    const std::string words = context.said(closed) + " / " + context.said(slider_->whole());
    shown.space.dots.push_back(place.over.space);
    shown.space.words.push_back({place.over.space, words});
    for (const ZipPlace::Side* side : {&place.over, &place.under}) {
      const Flat table = side->paper + context.table->at(side->piece);
      shown.table.dots.push_back(table);
      if (side == &place.over) shown.table.words.push_back({table, words});
    }
    return shown;
  }

  std::optional<EdgeNear> hover_;
  std::optional<Selection> chosen_;
  std::optional<ZipWay> slider_, held_;  // under the hand; in it
  double closed_ = 0;                    // metres, as far as it is drawn
};

}  // namespace

std::unique_ptr<Gesture> selectGesture() { return std::make_unique<SelectGesture>(); }

}  // namespace karinui

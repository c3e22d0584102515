// Cutting along a drag. The line lives on the paper of the first piece it meets. With Ctrl it keeps to no middle.
#include <algorithm>
#include <cmath>

#include "karinui/pattern/edit.h"
#include "karinui/session/touch_scene_of.h"
#include "session/gestures.h"

namespace karinui {

namespace {

constexpr double kStep = 0.003;      // metres on paper before a place is noted
constexpr double kCutMiss = 0.0025;  // metres the cut may pass from the hand's line
constexpr double kBrink = 0.004;     // metres from the outline that still mean the outline
constexpr double kBeyond = 0.025;    // metres at least that a line which ran off the cloth is led on

class CutGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        hover(sample, hit, context);
        return {};
      case PointerSample::Phase::Press:
        *this = CutGesture();
        down_ = true;
        break;
      case PointerSample::Phase::Drag:
      case PointerSample::Phase::Release:
        break;
    }
    if (!down_) return {};
    straight_ = sample.shift;
    alone_ = sample.alt;
    note(sample, hit, context);
    line_ = lineNow(context);
    why_.reset();
    will_ = false;
    if (piece_ && line_.size() > 1) {
      const Piece* piece = context.snapshot->document.find(piece_);
      const auto second = [](std::size_t k) { return NewPart{{k + 1}, "second"}; };
      const auto cut = piece ? cutAcrossDarts(context.snapshot->document.pattern, *piece, line_, second, {}, {}, true)
                             : Result<CutAcross>(cancelled());
      if (!cut)
        why_ = cut.error().what;
      else
        will_ = true, parts_ = cut->cut.pieces.size();
    }
    if (sample.phase != PointerSample::Phase::Release) return {};
    down_ = false;
    if (!piece_ || (line_.size() < 2 && left_))
      return {.over = true, .why = say("The line met no cloth; drag across a piece, or in from its edge.")};
    if (line_.size() < 2) return {.over = true};
    if (!will_) return {.over = true, .why = why_};
    CutPiece cut;
    cut.piece = piece_;
    cut.line = line_;
    if (!alone_ && !copiesOf(context.snapshot->document, piece_).empty()) cut.copies = Choice::Yes;
    return {.over = true, .operation = std::move(cut)};
  }

  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (middle_ && on_) showMiddle(shown, context, on_, *middle_);
    showOnPaper(shown, context, piece_, line_, will_ ? kGood : kBad);
    if (will_ && !alone_) showOnCopies(shown, context, piece_, line_);
    return shown;
  }
  Message hint() const override { return middle_ ? say("{0} {1}", middle_->said(), usualHint()) : usualHint(); }
  bool begun() const override { return down_; }
  void addTo(Handling& handling) const override {
    if (down_ && !left_) handling.cut = piece_;
  }
  KeyStops keyStops() const override { return KeyStops::Corners; }

 private:
  Message usualHint() const {
    if (!down_ || !piece_) return info(Command::Cut).hint;
    if (will_)
      return parts_ > 2   ? say("Let go to cut the piece into {0}.", parts_)
             : parts_ > 1 ? say("Let go to cut the piece in two.")
                          : say("Let go to cut a slit.");
    return why_ ? *why_ : info(Command::Cut).hint;
  }
  void hover(const PointerSample& sample, const Hit& hit, const GestureContext& context) {
    middle_.reset(), on_ = hit.piece;
    const Piece* piece = context.snapshot->document.find(hit.piece);
    if (!piece) return;
    const bool table = sample.where == PointerSample::Where::Table;
    if (sample.control || (!table && hit.on != Hit::On::Cloth)) return;
    middle_ =
        middleNear(*piece, table ? sample.place - context.table->at(hit.piece) : hit.paper, nearMiddle(sample, hit));
  }
  void note(const PointerSample& sample, const Hit& hit, const GestureContext& context) {
    std::optional<Flat> paper;
    const bool table = sample.where == PointerSample::Where::Table;
    if (!piece_ && hit.piece && (hit.on == Hit::On::Cloth || table)) piece_ = hit.piece;
    if (table) {
      if (!piece_) return before_.push_back(sample.place);
      const Flat lies = context.table->at(piece_);
      if (!before_.empty()) noted_.push_back(before_.back() - lies), before_.clear();
      paper = sample.place - lies;
    } else if (hit.on == Hit::On::Cloth && hit.piece == piece_) {
      paper = hit.paper;
    }
    middle_.reset(), on_ = piece_;
    if (const Piece* piece = paper && !sample.control ? context.snapshot->document.find(piece_) : nullptr)
      middle_ = middleNear(*piece, *paper, nearMiddle(sample, hit));
    if (paper && !left_) {
      if (noted_.empty()) from_ = middle_, alongAxis_ = true;
      alongAxis_ = alongAxis_ && middle_ && middle_->onAxis;
      until_ = middle_;
    }
    if (!paper) {
      if (piece_) left_ = true;  // ran off; what follows elsewhere does not count
      if (!piece_) came_ = true;
      return;
    }
    if (left_) return;
    brink_ = brink(hit, context, *paper);
    if (noted_.empty()) beganAt_ = brink_;
    if (noted_.empty() || distance(noted_.back(), *paper) >= kStep)
      noted_.push_back(*paper);
    else if (sample.phase == PointerSample::Phase::Release)
      noted_.back() = *paper;
  }

  // From a place on the cloth onwards until it is off it.
  static Flat runOff(const Ring& ring, Flat from, Flat way) {
    constexpr double kStride = 0.005, kFurthest = 0.2;
    double far = kBeyond;
    while (far < kFurthest && contains(ring, from + way * far)) far += kStride;
    return from + way * (far + kStride);
  }

  // Just beyond the outline, where a place lies on its brink.
  std::optional<Flat> brink(const Hit& hit, const GestureContext& context, Flat paper) const {
    const Piece* piece = context.snapshot->document.find(piece_);
    const Edge* edge = piece && hit.edge && hit.edge->piece == piece_ ? findEdge(*piece, hit.edge->edge) : nullptr;
    if (!edge) return std::nullopt;
    const double t = edge->curve.parameterAt(hit.edge->fraction * edge->curve.length());
    if (distance(edge->curve.at(t), paper) > kBrink) return std::nullopt;
    return edge->curve.at(t) - leftOf(normalized(edge->curve.tangent(t))) * kBrink;
  }

  std::vector<Flat> lineNow(const GestureContext& context) const {
    std::vector<Flat> line = noted_;
    if (line.size() < 2) return line;
    const Piece* piece = context.snapshot->document.find(piece_);
    if (!piece) return line;
    const Ring ring = piece->outline.flattened(1e-3);
    const std::size_t look = std::min<std::size_t>(3, line.size() - 1);
    const Flat first = line.front(), last = line.back();
    const Flat in = normalized(first - line[look]), out = normalized(last - line[line.size() - 1 - look]);
    if (beganAt_ && !came_) line.insert(line.begin(), *beganAt_);
    if (brink_ && !left_) line.push_back(*brink_);
    if (came_) line.insert(line.begin(), runOff(ring, first, in));
    if (left_) line.push_back(runOff(ring, last, out));
    if (straight_) line = {line.front(), line.back()};
    std::vector<Flat> kept;
    for (const std::size_t i : mattering<Flat>(line, kCutMiss)) kept.push_back(tenth(line[i]));
    return throughMiddles(std::move(kept));
  }

  // Begun or ended at a middle, the line goes exactly through it, and beyond the outline where that is on it.
  std::vector<Flat> throughMiddles(std::vector<Flat> line) const {
    const std::optional<MiddleSnap> ends[] = {came_ ? std::nullopt : from_, left_ ? std::nullopt : until_};
    if (straight_ || alongAxis_) line = {line.front(), line.back()};
    for (std::size_t k = 0; k < 2; ++k, std::reverse(line.begin(), line.end())) {
      if (!ends[k]) {
        const auto &own = k == 0 ? from_ : until_, &other = k == 0 ? until_ : from_;
        if (alongAxis_ && own && other)  // run off along the middle line
          line.front() = own->place + normalized(own->place - other->place) * distance(line.front(), own->place);
        continue;
      }
      const Flat place = ends[k]->place;
      const double near = distance(line.front(), place) + kStep;
      while (line.size() > 2 && distance(line[1], place) <= near) line.erase(line.begin());
      line.front() = place;
    }
    const std::vector<Flat> through = line;
    for (std::size_t k = 0; k < 2; ++k)
      if (ends[k] && !ends[k]->edge.empty()) {
        const Flat place = k == 0 ? through.front() : through.back();
        const Flat next = k == 0 ? through[1] : through[through.size() - 2];
        (k == 0 ? line.front() : line.back()) = exact(place + normalized(place - next) * kBrink);
      }
    return line;
  }

  std::optional<MiddleSnap> middle_, from_, until_;  // where the hand is, where it began, where it was last
  PieceId on_;                                       // of which piece
  bool alongAxis_ = false;                           // all of the line keeps to the middle line
  bool down_ = false, came_ = false, left_ = false, straight_ = false, alone_ = false, will_ = false;
  std::size_t parts_ = 0;
  PieceId piece_;
  std::vector<Flat> noted_, before_, line_;
  std::optional<Flat> beganAt_, brink_;  // beyond the outline, where the line begins and ends
  std::optional<Message> why_;
};

}  // namespace

std::unique_ptr<Gesture> cutGesture() { return std::make_unique<CutGesture>(); }

}  // namespace karinui

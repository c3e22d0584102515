// Lines inside a piece: clicks make a line of straight parts, a drag a curve. Enter, or a click where it ended, is the
// end; a drag ends with its release.
#include "session/gestures.h"

namespace karinui {

namespace {

class LineGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    const bool table = sample.where == PointerSample::Where::Table;
    std::optional<Flat> paper;
    if (table && (piece_ || hit.piece)) paper = sample.place - context.table->at(piece_ ? piece_ : hit.piece);
    if (!table && hit.on == Hit::On::Cloth && (!piece_ || hit.piece == piece_)) paper = hit.paper;
    const auto end = paper ? std::optional(tenth(*paper)) : std::nullopt;
    switch (sample.phase) {
      case PointerSample::Phase::Hover:
        now_ = end;
        return {};
      case PointerSample::Phase::Press:
        if (!end || !hit.piece) return {.why = say("A line lies inside a piece.")};
        if (!along_.empty() && distance(along_.back(), *end) < kSame)
          return along_.size() > 1 ? finished() : GestureResult{};
        piece_ = hit.piece;
        along_.push_back(*end);
        stroke_ = {*end};
        now_.reset();
        return {};
      case PointerSample::Phase::Drag:
        if (end && !stroke_.empty() && distance(stroke_.back(), *end) > kStep) stroke_.push_back(*end);
        return {};
      case PointerSample::Phase::Release:
        break;
    }
    const auto stroke = std::exchange(stroke_, {});
    if (along_.size() != 1 || stroke.size() < 3) return {};
    along_.clear();
    for (const std::size_t i : mattering<Flat>(stroke, kMiss)) along_.push_back(stroke[i]);
    smooth_ = along_.size() > 2;
    return finished();
  }
  GestureResult confirm(const GestureContext&) override {
    if (along_.size() < 2) return {.why = say("A line needs at least two places.")};
    return finished();
  }
  bool takeBack() override {
    if (along_.empty()) return false;
    along_.pop_back();
    stroke_.clear();
    if (along_.empty()) piece_ = {};
    return true;
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (!piece_) return shown;
    std::vector<Flat> line = along_;
    line.insert(line.end(), stroke_.begin(), stroke_.end());
    if (now_) line.push_back(*now_);
    showOnPaper(shown, context, piece_, line, kChalk);
    double length = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) length += distance(line[i], line[i + 1]);
    if (length > 0) shown.table.words.push_back({line.back() + context.table->at(piece_), context.said(length)});
    return shown;
  }
  Message hint() const override {
    return piece_ ? say("Click on, and Enter ends the line.") : info(Command::Line).hint;
  }
  bool begun() const override { return static_cast<bool>(piece_); }
  bool clicks() const override { return true; }

 private:
  static constexpr double kSame = 0.003, kStep = 0.003, kMiss = 0.001;  // metres
  GestureResult finished() {
    AddLine line;
    line.piece = piece_;
    line.along = along_;
    line.smooth = smooth_;
    return {.over = true, .operation = std::move(line)};
  }
  PieceId piece_;
  std::vector<Flat> along_, stroke_;
  std::optional<Flat> now_;
  bool smooth_ = false;
};

}  // namespace

std::unique_ptr<Gesture> lineGesture() { return std::make_unique<LineGesture>(); }

}  // namespace karinui

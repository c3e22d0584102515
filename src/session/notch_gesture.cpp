// Notches: a click on an edge puts one, a click on one takes it away. On a symmetric piece both halves are marked, and
// on a symmetric copy and on the edge it is sewn to it is done likewise, unless Alt is held.
#include <cmath>

#include "karinui/pattern/fastening.h"
#include "karinui/pattern/seam_walk.h"
#include "karinui/pattern/symmetry.h"
#include "session/gestures.h"

namespace karinui {

namespace {

class NotchGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    here_ = hit.edge ? found(*hit.edge, sample, context) : std::nullopt;
    alone_ = sample.alt;
    if (sample.phase != PointerSample::Phase::Press) return {};
    if (!here_) return {.why = say("A notch lies on the edge of a piece.")};
    const Piece& piece = *context.snapshot->document.find(here_->edge.piece.id);
    const Choice others = sample.alt ? Choice::No : Choice::Auto;  // and so nothing over a zip
    if (here_->there)
      return {.over = true, .operation = EraseMarks{here_->edge.piece, {}, tenth(here_->paper), others, others}};
    AddNotch notch;
    notch.copies = notch.partners = others;
    notch.edge = here_->edge;
    notch.at = here_->at;
    const auto symmetry = sample.alt ? std::nullopt : symmetryOf(piece.outline);
    const auto edge = piece.outline.find(here_->edge.edge);
    notch.symmetric = symmetry && edge && imageOf(piece.outline, *symmetry, {*edge, here_->at});
    GestureResult told{.over = true};
    if (symmetry && !notch.symmetric) told.why = onlyThisHalf();
    told.operation = std::move(notch);
    return told;
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
    if (!here_) return shown;
    showEdge(shown, context, here_->edge, here_->there ? kBad : kChalk);
    if (const auto place = spaceOf(*context.snapshot, here_->edge.piece.id, here_->paper)) {
      shown.space.dots.push_back(*place);
      shown.space.words.push_back({*place, words(context)});
    }
    const Flat table = here_->paper + context.table->at(here_->edge.piece.id);
    shown.table.dots.push_back(table);
    shown.table.words.push_back({table, words(context)});
    if (alone_) return shown;
    const Document& document = context.snapshot->document;
    Fastenings shut = document.allowances.fastenings;
    for (auto& [name, own] : shut) own.zipped = 1;
    for (const SeamPlace& there :
         sewnTo(withZips(document.pattern, shut), {here_->edge.piece.id, here_->edge.edge, here_->at}))
      if (const Curve* curve = curveOf(document.pattern, there.piece, there.edge)) {
        const Flat paper = curve->atFraction(there.fraction);
        showOnPaper(shown, context, there.piece, {paper, paper + inwards(*curve, there.fraction) * kStroke}, kPartner);
      }
    return shown;
  }
  Message hint() const override {
    return here_ && here_->there ? say("Click to take this notch away.") : info(Command::Notch).hint;
  }
  bool begun() const override { return false; }
  KeyStops keyStops() const override { return KeyStops::Edges; }
  bool clicks() const override { return true; }

 private:
  static constexpr double kStroke = 0.01;  // metres
  static Flat inwards(const Curve& curve, double at) {
    return leftOf(normalized(curve.tangent(curve.parameterAt(at * curve.length()))));
  }
  struct Here {
    EdgeRef edge;
    double at = 0;
    Flat paper;
    bool there = false;  // a notch is there already
  };
  // From both ends of the edge, as a tailor would note it.
  std::string words(const GestureContext& context) const {
    const double whole = lengthOf(context, here_->edge);
    return context.said(here_->at * whole) + " | " + context.said((1 - here_->at) * whole);
  }
  static std::optional<Here> found(const EdgeNear& near, const PointerSample& sample, const GestureContext& context) {
    constexpr double kNear = 0.006;  // metres along the edge
    const Piece* piece = context.snapshot->document.find(near.piece);
    const Edge* edge = piece ? findEdge(*piece, near.edge) : nullptr;
    if (!edge) return std::nullopt;
    const double whole = edge->curve.length();
    const double reach = sample.where == PointerSample::Where::Table ? sample.reach : kNear;
    Here here{{PieceRef(near.piece), near.edge}, roundShare(near.fraction, reach / whole), {}, false};
    for (const Mark& mark : piece->marks)
      if (mark.edge == near.edge && std::fabs(mark.fraction - near.fraction) * whole < reach)
        here.at = mark.fraction, here.there = true;
    here.paper = edge->curve.atFraction(here.at);
    return here;
  }
  std::optional<Here> here_;
  bool alone_ = false;  // neither on the symmetric copy nor on what the edge is sewn to
};

}  // namespace

std::unique_ptr<Gesture> notchGesture() { return std::make_unique<NotchGesture>(); }

}  // namespace karinui

// Choosing pieces, edges and seams, in space and on the table alike.
#include "session/gestures.h"

namespace karinui {

namespace {

class SelectGesture : public Gesture {
 public:
  Told feed(const PointerSample& sample, const Hit& hit, const Workbench& bench) override {
    if (sample.phase == PointerSample::Phase::Hover) hover_ = hit.edge;
    if (sample.phase != PointerSample::Phase::Press) return {};
    Selection selection;
    if (hit.piece) selection.pieces = {hit.piece};
    selection.edge = hit.edge;
    if (hit.edge)
      for (const auto& [id, seam] : bench.fitting->document.pattern.seams)
        for (const auto* side : {&seam.a, &seam.b})
          for (const EdgeSpan& span : *side)
            if (span.piece == hit.edge->piece && span.edge == hit.edge->edge &&
                span.from <= hit.edge->fraction + 1e-9 && hit.edge->fraction <= span.to + 1e-9)
              selection.seam = id;
    chosen_ = selection;
    return {};
  }
  Preview preview(const Workbench& bench) const override {
    Preview shown;
    if (hover_) showEdge(shown, bench, {PieceRef(hover_->piece), hover_->edge}, kChalk);
    return shown;
  }
  Message hint() const override { return info(Command::Select).hint; }
  bool begun() const override { return false; }
  std::optional<Selection> chosen() override { return std::exchange(chosen_, std::nullopt); }

 private:
  std::optional<EdgeNear> hover_;
  std::optional<Selection> chosen_;
};

}  // namespace

std::unique_ptr<Gesture> selectGesture() { return std::make_unique<SelectGesture>(); }

}  // namespace karinui

// Choosing pieces, edges and seams, in space and on the table alike.
#include "session/gestures.h"

namespace karinui {

namespace {

class SelectGesture : public Gesture {
 public:
  GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) override {
    if (sample.phase == PointerSample::Phase::Hover) hover_ = hit.edge;
    if (sample.phase != PointerSample::Phase::Press) return {};
    Selection selection;
    if (hit.piece) selection.pieces = {hit.piece};
    selection.edge = hit.edge;
    if (hit.edge) selection.seam = seamAt(context.snapshot->document, *hit.edge);
    chosen_ = selection;
    return {};
  }
  Preview preview(const GestureContext& context) const override {
    Preview shown;
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
  Message hint() const override { return info(Command::Select).hint; }
  bool begun() const override { return false; }
  bool clicks() const override { return true; }
  std::optional<Selection> chosen() override { return std::exchange(chosen_, std::nullopt); }

 private:
  std::optional<EdgeNear> hover_;
  std::optional<Selection> chosen_;
};

}  // namespace

std::unique_ptr<Gesture> selectGesture() { return std::make_unique<SelectGesture>(); }

}  // namespace karinui

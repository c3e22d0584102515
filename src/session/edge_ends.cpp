// Which end of the chosen edge stays when its length is typed.
#include "karinui/design/edge_length.h"
#include "karinui/pattern/symmetry.h"
#include "session/session_impl.h"

namespace karinui {

const Session::Impl::EdgeEnds& Session::Impl::edgeEnds() const {
  using Keep = SetLength::Keep;
  if (edgeEnds_ && edgeEnds_->of == state.snapshot && edgeEnds_->edge == selection.edge &&
      edgeEnds_->wished == keepWished)
    return *edgeEnds_;
  EdgeEnds ends{state.snapshot, selection.edge, keepWished, Keep::Start, false, {}, {}};
  const Piece* piece = selection.edge ? state.snapshot->document.find(selection.edge->piece) : nullptr;
  const auto k = piece ? piece->outline.find(selection.edge->edge) : std::nullopt;
  if (k) {
    const auto symmetry = symmetryOf(piece->outline);
    const auto partner = symmetry ? symmetry->partner[*k] : std::nullopt;
    ends.bothHalves = partner.has_value();
    ends.keep = keepWished != Keep::Auto && partner != k
                    ? keepWished
                    : karinui::keptEnd(state.snapshot->document, *piece, selection.edge->edge, ends.bothHalves);
    const auto mark = [&](Flat place, bool stays) {
      (stays ? ends.stay : ends.move).push_back(place);
      if (partner && partner != k) (stays ? ends.stay : ends.move).push_back(symmetry->image(place));
    };
    const Curve& curve = piece->outline.edges[*k].curve;
    mark(curve.start, ends.keep == Keep::Start);
    mark(curve.end, ends.keep == Keep::End);
    if (ends.keep == Keep::Middle) mark(curve.atFraction(0.5), true);
  }
  edgeEnds_ = std::move(ends);
  return *edgeEnds_;
}

}  // namespace karinui

// The line is trued across the ends of seams.
#include <set>

#include "design/operations/operations.h"
#include "karinui/base/number.h"
#include "karinui/pattern/truing.h"

namespace karinui {

namespace {

constexpr std::size_t kTimesTrued = 8;
constexpr double kLeastTrued = 0.005, kMostTrued = 0.5;  // metres

std::vector<CornerTruing> missed(const Document& document, SeamId seam) {
  std::vector<CornerTruing> all = truing(document.pattern).corners;
  std::erase_if(all, [&](const CornerTruing& corner) { return corner.seam != seam || corner.smooth(); });
  return all;
}

// The outlines that have the corners, trued.
std::map<PieceId, Outline> outlinesTrued(const Document& document, const std::vector<CornerTruing>& corners,
                                         double within) {
  std::map<PieceId, Outline> all;
  for (const CornerTruing& corner : corners)
    for (const CornerTruing::Side* side : {&corner.a, &corner.b}) {
      Outline& outline = all.try_emplace(side->piece, document.find(side->piece)->outline).first->second;
      Edge& edge = outline.edges[*outline.find(side->edge)];
      edge.curve = truedEdge(outline, *side, corner.off(), within);
    }
  return all;
}

}  // namespace

Done resolve(const Document& before, TrueUp& op, Context& context) {
  if (op.seams.empty()) return refused(say("Say which seam is meant."));
  if (!(op.within >= kLeastTrued && op.within <= kMostTrued))
    return refused(say("A line is trued over 5 mm to 50 cm on each side of its seam, not over {0} mm.",
                       fixed(op.within * 1e3, 1)));
  for (SeamRef& ref : op.seams) {
    if (Done done = resolve(before, ref); !done) return done;
    if (op.symmetric != Choice::Yes) continue;
    for (const CornerTruing& corner : missed(before, ref.id))
      for (const PieceId id : {corner.a.piece, corner.b.piece}) {
        Choice here = op.symmetric;
        const auto both = [](const PaperSymmetry&) { return true; };
        if (Done done = resolveSymmetric(*before.find(id), here, context, both); !done) return done;
      }
  }
  return {};
}

Result<Document> perform(const Document& before, const TrueUp& op, Context& context) {
  Document after = before;
  std::size_t trued = 0, smooth = 0;
  // Where several of the seams meet, as under an arm, each bends what another has trued: they come nearer every time.
  for (std::size_t k = 0; k < kTimesTrued * op.seams.size() && smooth < op.seams.size(); ++k) {
    const auto corners = missed(after, op.seams[k % op.seams.size()].id);
    trued += corners.size(), smooth = corners.empty() ? smooth + 1 : 0;
    for (auto& [id, outline] : outlinesTrued(after, corners, op.within)) {
      const Outline was = after.find(id)->outline;
      ReshapePiece reshape;  // marks, seams, the shape in space and the symmetric copy follow as they do there
      reshape.piece = id;
      const auto symmetry = op.symmetric == Choice::No ? std::nullopt : symmetryOf(was);
      reshape.outline = symmetry ? onBothHalves(was, std::move(outline), *symmetry) : std::move(outline);
      auto next = cutAnew(after, reshape);
      if (!next) return next.error();
      after = *std::move(next);
    }
  }
  if (trued == 0 && context.advise)
    context.advise({say("The lines already go on smoothly beyond the ends of these seams.")});
  tellSeams(before, after, context);
  return after;
}

}  // namespace karinui

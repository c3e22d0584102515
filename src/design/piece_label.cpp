#include "karinui/design/piece_label.h"
#include "karinui/body/sizes.h"

#include "karinui/design/glossary.h"
#include "karinui/pattern/facing.h"
#include "karinui/pattern/symmetry.h"

namespace karinui {

std::set<PieceId> cutFaceDown(const Pattern& pattern, const AllowancePlan& plan,
                              const std::map<PieceId, Cutting>& cutting) {
  const std::set<PieceId> inside = wornInsideOut(pattern);
  std::set<PieceId> twins;  // left and right: either is what the other would be, turned over
  for (const PieceId id : inside)
    if (const PieceId twin = pattern.pieces.at(id)->mirrorOf; inside.contains(twin)) twins.insert({id, twin});
  std::set<PieceId> down;
  for (const PieceId id : inside) {
    const Piece& piece = *pattern.pieces.at(id);
    const auto told = cutting.find(id);
    const bool pairs = told != cutting.end() && told->second.pairs;
    if (!pairs && !twins.contains(id) && !plan.onFold(piece) && !symmetryOf(piece.outline)) down.insert(id);
  }
  return down;
}

bool ofItsSize(const BodyChoice& body) {
  if (body.size.empty()) return false;
  const auto size = builtInSize(body.size);
  return size && *size == body.measurements;
}

Message sizeSaid(const Document& document) {
  const Grading& grading = document.grading;
  const std::string size = grading.empty() ? document.body.size : grading.sizes[grading.standing];
  if (grading.empty() && document.body.measurements != Measurements() && !ofItsSize(document.body))
    return say("made to measure");
  return size.empty() ? Message() : termSaid(Term::Size, size).value_or(say("{0}", size));
}

std::vector<Message> labelOf(const Piece& piece, const CutFacts& facts) {
  const auto& [count, pairs] = facts.cutting;
  Message cut = pairs ? say("Cut {0} ({1} {1|pair|pairs})", count, count / 2) : say("Cut {0}", count);
  if (facts.onFold) cut = say("{0} on fold", cut);
  const Message name =
      facts.twin.empty() ? nameSaid(piece.name) : say("{0}, {1}", nameSaid(piece.name), nameSaid(facts.twin));
  std::vector<Message> lines{name, say("{0} · {1}", cut, nameSaid(piece.fabric))};
  if (facts.faceDown) lines.push_back(say("paper face down"));
  if (!piece.interfacing.empty()) lines.push_back(say("fused: {0}", nameSaid(piece.interfacing)));
  if (!facts.size.empty() && !facts.date.empty())
    lines.push_back(say("{0} · {1}", facts.size, facts.date));
  else if (!facts.size.empty() || !facts.date.empty())
    lines.push_back(facts.size.empty() ? say("{0}", facts.date) : facts.size);
  return lines;
}

}  // namespace karinui

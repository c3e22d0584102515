#include "karinui/design/piece_label.h"

#include "karinui/design/glossary.h"

namespace karinui {

std::vector<Message> labelOf(const Piece& piece, const CutFacts& facts) {
  const auto& [count, pairs] = facts.cutting;
  Message cut = pairs ? say("Cut {0} ({1} {1|pair|pairs})", count, count / 2) : say("Cut {0}", count);
  if (facts.onFold) cut = say("{0} on fold", cut);
  std::vector<Message> lines{nameSaid(piece.name), say("{0} · {1}", cut, nameSaid(piece.fabric))};
  if (!piece.interfacing.empty()) lines.push_back(say("fused: {0}", nameSaid(piece.interfacing)));
  const Message size =
      facts.size.empty() ? Message() : termSaid(Term::Size, facts.size).value_or(say("{0}", facts.size));
  if (!size.empty() && !facts.date.empty())
    lines.push_back(say("{0} · {1}", size, facts.date));
  else if (!size.empty() || !facts.date.empty())
    lines.push_back(size.empty() ? say("{0}", facts.date) : size);
  return lines;
}

}  // namespace karinui

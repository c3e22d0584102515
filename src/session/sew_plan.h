#pragma once
// What sewing two runs would be, and what may be chosen about it. Pure; the session's thread.
#include "karinui/design/sewing.h"
#include "session/gestures.h"

namespace karinui {

struct SewPlan {
  enum class Does { Sew, Type, Swap, Mirror, Leave };
  struct Item {  // of the drop menu
    Does does;
    Message label;
    SewEdges sew = {};
    std::optional<bool> checked = {};
  };
  double la = 0, lb = 0;  // metres
  SewEdges whole;         // both runs, all of them
  std::vector<SeamDoubt> doubts;
  std::vector<Item> items;
  std::optional<DropMenu::Number> ratio;  // to which the longer side may be gathered
  bool plain() const;                     // nothing to ask about
};
// All of both runs, their mirror image with them if that is wanted and there is one; swapped: the other way round than
// they lie.
SewEdges seamOf(const GestureContext& context, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b,
                bool swapped);
// `backwards`: where a side is longer than is sewn, it is sewn from the last end of `a` on.
// The longer side only as far as it goes with so much fullness; the tie as the ratio asks for.
SewEdges gatheredTo(const GestureContext& context, const SewPlan& plan, double ratio, bool backwards);
SewPlan sewPlan(const GestureContext& context, const std::vector<EdgeRef>& a, const std::vector<EdgeRef>& b,
                bool swapped, bool backwards);

}  // namespace karinui

#pragma once
// An outline cut anew where its cloth was pulled. What the pulls did not reach stays exactly as it is; straight edges
// stay straight unless they were pulled between their ends; where edges meet they keep their angle, unless that is not
// asked for.
#include <functional>

#include "karinui/design/document.h"

namespace karinui {

// `shift`: how far a paper place moved; exactly nothing beyond the pulls' reach. `angles`: whether edges keep the
// angles at which they meet; else each ends as the places on it lead.
Outline recutOutline(const Outline& old, const std::function<Flat(Flat)>& shift, bool angles);

// Which place of an edge cut anew was which of the old one: the ends that stayed keep their lengths, what is between is
// spread evenly.
class FollowEdge {
 public:
  FollowEdge(const Curve& was, const Curve& is);
  double operator()(double fraction) const;  // of the old length -> of the new

 private:
  double was_, is_;             // metres
  double head_ = 0, tail_ = 0;  // metres that stayed, at the start and at the end
};

// The document with this piece cut along another outline of the same edges, and not its symmetric copies: marks, form
// and what is sewn to parts of its edges follow.
Document cutAlone(Document document, const Piece& piece, const Outline& outline);

}  // namespace karinui

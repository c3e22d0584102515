#pragma once
// A drag of the sewing tool: along the border of a piece and of what is sewn to it, or across to another edge. The
// session's thread.
#include "session/gestures.h"
#include "session/sewn_border.h"

namespace karinui {

using Run = std::vector<EdgeRef>;  // edges that follow each other, in the outlines' order

class SewStroke {
 public:
  SewStroke(const GestureContext& context, EdgeNear from, PointerSample sample);
  // Follows the pointer; `other` are the edges it may end on.
  void to(const GestureContext& context, const PointerSample& sample, const WantedEdge& other);

  const std::optional<EdgeNear>& target() const { return target_; }  // the other edge it is on now
  bool onBorder() const { return !left_ && !target_; }
  bool isRun() const;                            // it went along the border by more than a hand trembles
  bool backwards() const { return total_ < 0; }  // against the outlines' direction
  Run run() const;                               // what it went along, its ends snapped; the edge where that is nothing
  Run edge() const;                              // the whole of the pressed edge, or what seams leave of it
  // The side a drag to another edge begins with: the run if a whole edge was dragged along before, else the edge.
  Run sideBeforeLeaving() const;

 private:
  double forth(double along) const;  // the shorter way to a place of the border
  void step(const GestureContext& context, const PointerSample& sample, const WantedEdge& other);
  double snapped(double along) const;

  EdgeNear from_, onto_;
  SewnBorder border_;
  PointerSample last_;
  double began_, total_ = 0, beside_ = 0;
  bool left_ = false;
  std::optional<EdgeNear> target_;
};

}  // namespace karinui

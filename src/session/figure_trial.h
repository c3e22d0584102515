#pragma once
// A figure whose measures are being turned: shown, but no step yet. State only; one thread.
#include "karinui/design/operation.h"
#include "session/latest_request.h"

namespace karinui {

class FigureTrial {
 public:
  void propose(SetBody figure) { active_ = true, requests_.put(std::move(figure)); }
  std::optional<SetBody> next() { return requests_.next(); }               // to be built now; built() ends it
  bool built() { return requests_.answered(), active_; }                   // false: the trial is over, it is not shown
  bool end() { return requests_.clear(), std::exchange(active_, false); }  // false: there was none
  bool active() const { return active_; }

 private:
  LatestRequest<SetBody> requests_;
  bool active_ = false;
};

}  // namespace karinui

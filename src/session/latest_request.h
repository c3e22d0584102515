#pragma once
// Requests of which only the newest counts: one is worked out at a time, and what was asked meanwhile replaces what
// waits. State only; the owner works them out. One thread.
#include <optional>
#include <utility>

namespace karinui {

template <class Request>
class LatestRequest {
 public:
  void put(Request request) { waiting_ = std::move(request); }
  // What is to be worked out now: nothing while one is on its way, or where nothing waits. answered() ends it.
  std::optional<Request> next() {
    if (underWay_ || !waiting_) return std::nullopt;
    underWay_ = true;
    return std::exchange(waiting_, std::nullopt);
  }
  void answered() { underWay_ = false; }
  bool idle() const { return !underWay_ && !waiting_; }
  void clear() { waiting_.reset(), underWay_ = false; }  // what is on its way is wanted no more, nor waited for

 private:
  std::optional<Request> waiting_;
  bool underWay_ = false;
};

}  // namespace karinui

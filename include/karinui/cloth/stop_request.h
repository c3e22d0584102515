#pragma once
#include <atomic>

namespace karinui {

// Asks a settle under way to stop where the cloth is. Any thread, also a signal handler; it must outlive the settle.
class StopRequest {
 public:
  // False: nothing was reached yet (the solver has made no step), or it was asked before; then cancel the token.
  bool ask() { return begun_.load() && !asked_.exchange(true); }
  bool asked() const { return asked_.load(); }
  bool askedAfterStep() { return begun_.store(true), asked(); }  // for the solver

 private:
  std::atomic<bool> begun_{false}, asked_{false};
};

}  // namespace karinui

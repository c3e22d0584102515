#pragma once
// Carried by all long work: the worker reports progress, the owner may cancel from any thread. A cancelled job leaves
// everything as it was. Long loops ask cancelled() at least every 100 ms.
#include <atomic>
#include <functional>

#include "karinui/base/message.h"

namespace karinui {

class Token {
 public:
  using Watcher = std::function<void(double fraction, const Message& doing)>;
  Token() = default;  // silent: nobody watches
  explicit Token(Watcher watcher) : watcher_(std::move(watcher)) {}

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  // Called by the working thread only; the watcher runs on that thread. fraction in [0, 1].
  void progress(double fraction, const Message& doing = {}) const {
    if (watcher_) watcher_(fraction, doing);
  }

 private:
  std::atomic<bool> cancelled_{false};
  Watcher watcher_;
};

}  // namespace karinui

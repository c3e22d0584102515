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
  // A stage of a longer work: its progress goes from one fraction of the whole to another, and it is cancelled with the
  // whole, which must outlive it.
  Token(const Token& whole, double from, double to)
      : watcher_([&whole, from, to](double fraction, const Message& doing) {
          whole.progress(from + (to - from) * fraction, doing);
        }),
        whole_(&whole) {}

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed) || (whole_ && whole_->cancelled()); }
  // Called by the working thread only; the watcher runs on that thread. fraction in [0, 1].
  void progress(double fraction, const Message& doing = {}) const {
    if (watcher_) watcher_(fraction, doing);
  }

 private:
  std::atomic<bool> cancelled_{false};
  Watcher watcher_;
  const Token* whole_ = nullptr;
};

}  // namespace karinui

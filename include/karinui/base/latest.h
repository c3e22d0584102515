#pragma once
// The newest value one thread has for another. The writer never waits for the reader, the reader never waits for the
// writer longer than it takes to swap two pointers, and nobody sees half a value. One writer, one reader.
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace karinui {

template <class T>
class Latest {
 public:
  void publish(T value) {  // replaces what was not read yet
    auto fresh = std::make_unique<T>(std::move(value));
    const std::lock_guard lock(mutex_);
    waiting_.swap(fresh);
  }
  std::optional<T> take() {  // nothing: none since the last time
    std::unique_ptr<T> taken;
    {
      const std::lock_guard lock(mutex_);
      taken.swap(waiting_);
    }
    return taken ? std::optional<T>(std::move(*taken)) : std::nullopt;
  }

 private:
  std::mutex mutex_;
  std::unique_ptr<T> waiting_;
};

}  // namespace karinui

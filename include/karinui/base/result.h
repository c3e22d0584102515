#pragma once
// A value, or why there is none. Bad input never throws and never changes anything: it comes back as an Error whose
// sentence says what is wrong, where, and what to do. Our own bugs are assertions (KARINUI_ASSERT), always on.
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>
#include <variant>

#include "karinui/base/message.h"

namespace karinui {

struct Error {
  enum class Kind {
    BadInput,   // a file or a value that cannot be used
    Refused,    // an operation that makes no sense here
    NotFound,   // a name or a file that is not there
    Storage,    // the disk or the file said no
    Damaged,    // a document that is not whole; what is whole of it can be rescued
    Memory,     // there is not enough of it here and now; with more, the same may go well
    Cancelled,  // the person stopped it
  };
  Kind kind = Kind::BadInput;
  Message what;
  // Told by the machine or the person, not about what was asked: another time the same may go well.
  bool hindered() const { return kind == Kind::Storage || kind == Kind::Memory || kind == Kind::Cancelled; }
};

inline Error badInput(Message what) { return {Error::Kind::BadInput, std::move(what)}; }
inline Error refused(Message what) { return {Error::Kind::Refused, std::move(what)}; }
inline Error notFound(Message what) { return {Error::Kind::NotFound, std::move(what)}; }
inline Error storageError(Message what) { return {Error::Kind::Storage, std::move(what)}; }
inline Error damagedDocument(Message what) { return {Error::Kind::Damaged, std::move(what)}; }
inline Error outOfMemory() {
  return {Error::Kind::Memory,
          say("There is not enough memory for this. Close other programs, or set threads farther apart (set "
              "spacing=…).")};
}
inline Error cancelled() { return {Error::Kind::Cancelled, say("Stopped; nothing was changed.")}; }

#define KARINUI_ASSERT(condition)                                                                     \
  do {                                                                                                \
    if (!(condition)) {                                                                               \
      std::fprintf(stderr, "karinui: broken promise at %s:%d: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                                   \
    }                                                                                                 \
  } while (false)

template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : held_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : held_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const { return held_.index() == 0; }
  T& value() & { return check(), std::get<0>(held_); }
  const T& value() const& { return check(), std::get<0>(held_); }
  T&& value() && { return check(), std::get<0>(std::move(held_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }
  const Error& error() const {
    KARINUI_ASSERT(!*this);
    return std::get<1>(held_);
  }

 private:
  void check() const { KARINUI_ASSERT(held_.index() == 0); }
  std::variant<T, Error> held_;
};

// Done, or why not.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}
  explicit operator bool() const { return !error_; }
  const Error& error() const {
    KARINUI_ASSERT(error_);
    return *error_;
  }

 private:
  std::optional<Error> error_;
};
using Done = Result<void>;

}  // namespace karinui

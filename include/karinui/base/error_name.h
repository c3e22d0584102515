#pragma once
// The kinds of errors as words for programs: of JSON answers and of exceptions in Python. Pure; any thread.
#include "karinui/base/result.h"

namespace karinui {

constexpr const char* errorName(Error::Kind kind) {
  switch (kind) {
    case Error::Kind::BadInput:
      return "bad_input";
    case Error::Kind::Refused:
      return "refused";
    case Error::Kind::NotFound:
      return "not_found";
    case Error::Kind::Storage:
      return "storage";
    case Error::Kind::Damaged:
      return "damaged";
    case Error::Kind::Memory:
      return "out_of_memory";
    case Error::Kind::Cancelled:
      return "stopped";
  }
  return "bad_input";
}

}  // namespace karinui

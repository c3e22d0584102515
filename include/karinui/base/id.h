#pragma once
// Small typed names of things. Zero is "none". An id is minted from the serial of the step that made the thing, so
// editing an early step renames nothing that later steps point to.
#include <compare>
#include <cstdint>
#include <string>

namespace karinui {

template <class Tag>
struct Id {
  std::uint64_t value = 0;
  explicit operator bool() const { return value != 0; }
  auto operator<=>(const Id&) const = default;
};

using PieceId = Id<struct PieceTag>;
using SeamId = Id<struct SeamTag>;

// The nth thing (from 0, below 65536) made by the step with this serial (from 1).
template <class AnyId>
constexpr AnyId madeBy(std::uint32_t serial, std::uint32_t nth) {
  return {std::uint64_t{serial} << 16 | nth};
}

}  // namespace karinui

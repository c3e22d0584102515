#pragma once
// How much of a loop is one piece of work for a thread. Sums are added piece by piece in their order, so these numbers
// are part of a result's bits.
#include <cstddef>

namespace karinui {

constexpr std::size_t kNodeBlock = 256;  // nodes, faces or rows
constexpr std::size_t kPairBlock = 128;  // places that are each compared with many

}  // namespace karinui

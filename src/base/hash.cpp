#include "karinui/base/hash.h"

namespace karinui {

namespace {
// The finalizer of splitmix64 (Steele, Lea, Flood 2014): spreads every input bit over the word.
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}
}  // namespace

Hasher& Hasher::bytes(const void* data, std::size_t size) {
  const auto* at = static_cast<const unsigned char*>(data);
  const auto take = [&](std::uint64_t word) {
    a_ = mix(a_ ^ word);
    b_ = mix(b_ + word * 0x9ddfea08eb382d69ull + 0x632be59bd9b4e019ull);
  };
  for (; size >= 8; size -= 8, at += 8) {
    std::uint64_t word;
    std::memcpy(&word, at, 8);
    take(word);
  }
  if (size > 0) {
    std::uint64_t word = std::uint64_t{size} << 56;  // so that "a" and "a\0" differ
    std::memcpy(&word, at, size);
    take(word);
  }
  return *this;
}

std::string Hasher::hex() const {
  std::string digits;
  for (std::uint64_t lane : {a_, b_}) {
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[(lane >> shift) & 15];
  }
  return digits;
}

}  // namespace karinui

#pragma once
// A 128-bit content hash (two independently seeded FNV/mix lanes): names blobs, caches and steps. Not against
// attackers. Numbers are hashed by their little-endian bytes, so a hash is the same on every machine with the same
// bits. One Hasher belongs to one thread.
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace karinui {

class Hasher {
 public:
  Hasher& bytes(const void* data, std::size_t size);
  Hasher& add(std::string_view text) {
    return add(static_cast<std::uint64_t>(text.size())).bytes(text.data(), text.size());
  }
  Hasher& add(double value) { return bytes(&value, sizeof value); }
  Hasher& add(std::uint64_t value) { return bytes(&value, sizeof value); }
  template <class T>
  requires std::is_trivially_copyable_v<T> Hasher& add(std::span<const T> values) {
    return add(static_cast<std::uint64_t>(values.size())).bytes(values.data(), values.size_bytes());
  }
  std::string hex() const;  // 32 lower-case hexadecimal digits

 private:
  std::uint64_t a_ = 0xcbf29ce484222325ull, b_ = 0x9e3779b97f4a7c15ull;
};

}  // namespace karinui

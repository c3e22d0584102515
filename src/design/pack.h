#pragma once
// Values as bytes for blobs: little-endian, length-checked. Reading never trusts the bytes: a Reader that meets
// anything impossible turns bad and gives zeros from then on.
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/design/document.h"

namespace karinui {

static_assert(std::endian::native == std::endian::little, "blobs are written as the machine holds numbers");

class Writer {
 public:
  template <class Number>
  requires std::is_arithmetic_v<Number> Writer& add(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Writer& add(std::string_view text) { return add(std::uint64_t{text.size()}), bytes_.append(text), *this; }
  Writer& add(Flat p) { return add(p.u).add(p.v); }
  Writer& add(Vec3 p) { return add(p.x).add(p.y).add(p.z); }
  Writer& add(const Triangle& t) { return add(t[0]).add(t[1]).add(t[2]); }
  template <class T>
  Writer& all(const std::vector<T>& items) {
    add(std::uint64_t{items.size()});
    for (const T& item : items) add(item);
    return *this;
  }
  std::string taken() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  bool good() const { return good_; }
  bool finished() const { return good_ && rest_.empty(); }
  void fail() { good_ = false, rest_ = {}; }

  template <class Number>
  requires std::is_arithmetic_v<Number> Number number() {
    Number value{};
    if (rest_.size() < sizeof value) return fail(), value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) return fail(), Number{};
    }
    return value;
  }
  // How many items follow, each at least `size` bytes long.
  std::size_t count(std::size_t size) {
    const auto n = number<std::uint64_t>();
    if (n > rest_.size() / size) return fail(), 0;
    return static_cast<std::size_t>(n);
  }
  std::string text() {
    const std::size_t n = count(1);
    std::string value(rest_.substr(0, n));
    rest_.remove_prefix(value.size());
    return value;
  }
  Flat flat() {
    const double u = number<double>(), v = number<double>();
    return {u, v};
  }
  Vec3 vec3() {
    const double x = number<double>(), y = number<double>(), z = number<double>();
    return {x, y, z};
  }
  Triangle triangle(std::size_t points) {
    Triangle t{};
    for (auto& corner : t) {
      corner = number<std::uint32_t>();
      if (corner >= points) fail(), corner = 0;
    }
    return t;
  }

 private:
  std::string_view rest_;
  bool good_ = true;
};

// A piece without its form, a form, and everything else of a document without its pieces.
std::string packPiece(const Piece& piece);
Result<Piece> unpackPiece(std::string_view bytes);
std::string packForm(const Form& form);
Result<std::shared_ptr<const Form>> unpackForm(std::string_view bytes);
std::string packRest(const Document& document);
Result<Document> unpackRest(std::string_view bytes);

}  // namespace karinui

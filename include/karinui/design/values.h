#pragma once
// The kinds of values an operation is made of. Each has one text form: parse(text(x)) == x bit for bit.
// Lengths read "12mm", "5cm", "0.3m", "2in" or bare metres; angles "30deg" or bare radians.
// Plain values; any thread.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/id.h"
#include "karinui/body/body.h"
#include "karinui/geometry/vec.h"

namespace karinui {

struct Length {
  double metres = 0;
  operator double() const { return metres; }
};
struct Angle {
  double radians = 0;
  operator double() const { return radians; }
};

// A piece (seam) by id or, until the operation is recorded, by name. Text: "p3", "p3.2" or "sleeve".
struct PieceRef {
  PieceId id;
  std::string name;
  PieceRef() = default;
  PieceRef(PieceId i) : id(i) {}
  PieceRef(std::string n) : name(std::move(n)) {}
  explicit operator bool() const { return id || !name.empty(); }
  bool operator==(const PieceRef&) const = default;
};
struct SeamRef {
  SeamId id;
  std::string name;
  SeamRef() = default;
  SeamRef(SeamId i) : id(i) {}
  SeamRef(std::string n) : name(std::move(n)) {}
  explicit operator bool() const { return id || !name.empty(); }
  bool operator==(const SeamRef&) const = default;
};

// A named edge of a piece or a part of it by length fractions. Text: "front.side_left", "p3.side_left@0.25:0.5".
struct EdgeRef {
  PieceRef piece;
  std::string edge;
  double from = 0, to = 1;
  explicit operator bool() const { return piece && !edge.empty(); }
  bool operator==(const EdgeRef&) const = default;
};

// A turn about an axis through the thing's own middle. Text: "y 90deg", "0,1,0 1.5".
struct Turn {
  Vec3 axis{0, 1, 0};
  Angle angle;
  bool operator==(const Turn&) const = default;
};

// One stated measurement. Text: "bust_girth=88cm", or "waist_girth=bust_girth - 16cm": then `value` is what that was
// last worked out to, and does not tell two apart.
struct Stated {
  std::string key;
  Length value;              // metres, or radians
  std::string formula = {};  // of measurements stated beside it; empty: a number
  bool operator==(const Stated& other) const {
    return key == other.key && formula == other.formula && (!formula.empty() || value == other.value);
  }
};

// The same place said the same way.
inline bool operator==(const BodyPoint& a, const BodyPoint& b) {
  return a.part == b.part && a.along == b.along && a.around == b.around && a.landmark == b.landmark &&
         a.onFace.face == b.onFace.face && a.onFace.weight == b.onFace.weight;
}

// A colour as a dyer would match it, in sRGB. Text: "1f3b6e".
struct Dye {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Dye&) const = default;
};

enum class Choice { Auto, Yes, No };  // Auto is decided when the operation is performed, and recorded as decided

}  // namespace karinui

#pragma once
// What is done along edges: elastics, hems, topstitching, piping, bindings. Of topstitching and elastics also along
// inner lines. Metres on paper. Plain values; any thread.
#include <cstdint>
#include <optional>
#include <string>

namespace karinui {

inline constexpr double kWidestAllowance = 0.1;

// An elastic sewn along an edge, as even over all of it.
struct Elastic {
  double ratio = 0.75;   // its cut length over the edge's
  double strength = 10;  // N with which it pulls when it is drawn out to one and a half times its cut length
  double stiffness() const { return 2 * strength; }  // N per unit of strain: its force grows evenly
  bool operator==(const Elastic&) const = default;
};
inline constexpr double kTightestElastic = 0.2, kLoosestElastic = 0.99;
inline constexpr double kWeakestElastic = 0.1, kStrongestElastic = 500;  // N

// An edge turned up: folded at the edge, `width` deep, and `under` of it turned in once more.
struct Hem {
  double width = 0.03, under = 0.01;                  // metres
  double allowance() const { return width + under; }  // what is cut beyond the edge
  bool operator==(const Hem&) const = default;
};
inline constexpr double kNarrowestHem = 0.003;

// Stitches to be seen. Along an edge the first row lies `offset` inside it and the others further in; along an inner
// line the rows lie evenly to both sides of it.
struct Topstitch {
  double offset = 0.006;
  int rows = 1;
  double apart = 0.006;                 // from row to row
  double length = 0.003;                // of a stitch
  std::optional<std::uint32_t> colour;  // of the thread, 0xrrggbb; nothing: a shade of the cloth's own
  bool operator==(const Topstitch&) const = default;
};
inline constexpr int kMostRows = 8;
inline constexpr double kStitchGap = 0.2;  // between two stitches, of a stitch's length

// A cord in a strip of cloth, caught in along an edge or in a seam.
struct Piping {
  double thickness = 0.004;   // of the cord
  std::string fabric;         // of the strip round it; empty: the piece's own
  double stripWidth() const;  // round the cord, and a seam's allowance on both sides
  bool operator==(const Piping&) const = default;
};
inline constexpr double kThinnestCord = 0.001, kThickestCord = 0.02;

// A strip folded over an edge, which ends there: `width` of it is seen on either side, and as much is turned in.
struct Binding {
  double width = 0.008;
  std::string fabric;                              // empty: the piece's own
  double stripWidth() const { return 4 * width; }  // cut
  bool operator==(const Binding&) const = default;
};
inline constexpr double kNarrowestBinding = 0.003, kWidestBinding = 0.05;

bool sound(const Elastic& elastic);  // within what is above
bool sound(const Hem& hem);
bool sound(const Topstitch& topstitch);
bool sound(const Piping& piping);
bool sound(const Binding& binding);

// Where several edges became one: whether the first is the finish that stays. The tightest, the widest.
bool prevails(const Elastic& a, const Elastic& b);
bool prevails(const Hem& a, const Hem& b);
bool prevails(const Topstitch& a, const Topstitch& b);
bool prevails(const Piping& a, const Piping& b);
bool prevails(const Binding& a, const Binding& b);

template <class Finish>
inline constexpr bool kOnLinesToo = false;  // whether an inner line can have it
template <>
inline constexpr bool kOnLinesToo<Elastic> = true;
template <>
inline constexpr bool kOnLinesToo<Topstitch> = true;

}  // namespace karinui

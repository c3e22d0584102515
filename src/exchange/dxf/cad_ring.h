#pragma once
// The boundary of a CAD piece as one ring of points. Metres on paper. Pure.
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "cad_style.h"

namespace karinui {

inline constexpr double kSamePlace = 2e-5;  // of two points: the files' numbers have three decimals of mm

// Which of many places are near one.
class PlaceSet {
 public:
  explicit PlaceSet(const std::vector<Flat>& places) {
    for (const Flat p : places) cells_.insert({cell(p.u), cell(p.v)});
  }
  bool near(Flat p) const {
    for (const long du : {-1L, 0L, 1L})
      for (const long dv : {-1L, 0L, 1L})
        if (cells_.contains({cell(p.u) + du, cell(p.v) + dv})) return true;
    return false;
  }

 private:
  static long cell(double x) { return std::lround(x / kSamePlace); }
  std::set<std::pair<long, long>> cells_;
};

struct CadRing {
  std::vector<Flat> points;  // counter-clockwise, no two of them in one place
  std::vector<char> turn;    // for each: the line may have a corner there; between two turns it is one smooth curve
};

// Lines chained end to end in any order and direction, as several open polylines draw one outline: those that close.
struct CadLoop {
  std::vector<Flat> points;        // counter-clockwise, no two neighbours in one place
  std::vector<std::size_t> lines;  // that it is made of
};
// `gap`: where lines that do not close leave off. `meet`: how far apart ends may lie that are one place.
std::vector<CadLoop> loopsOf(const std::vector<CadLine>& lines, Flat& gap, double meet = 5e-4);
// The largest of them. Nothing: they leave a gap, which lies at `gap`.
std::optional<std::vector<Flat>> chained(const std::vector<CadLine>& lines, Flat& gap);

// As few of a line's points as keep all of it within 0.03 mm, none of them farther from the next than a millimetre (or
// a ten-thousandth of a very long line), so that a curve through them stays beside the line. Those at `stay` are kept.
// The time is that of one walk along the points.
std::vector<Flat> thinned(const std::vector<Flat>& points, bool closed, const std::vector<Flat>& stay);

// The ring with its turns: the points that the file calls so, or where it calls none, those where the chords bend much.
CadRing withTurns(std::vector<Flat> points, const std::vector<Flat>& turns);

// The half and its mirror image, without the part of the ring on the line. Nothing: no part of the ring lies on it.
std::optional<CadRing> unfolded(const CadRing& half, Flat through, Flat unitAxis);

inline Flat reflected(Flat p, Flat through, Flat unitAxis) {
  const Flat way = p - through;
  return through + 2 * dot(way, unitAxis) * unitAxis - way;
}

}  // namespace karinui

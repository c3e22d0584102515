#pragma once
// What the entities of a DXF block draw: lines, points and texts on numbered layers, blocks that are inserted there put
// in their place, curves as chords whose ends lie on them. In the file's unit. Pure.
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "dxf_file.h"
#include "karinui/base/result.h"

namespace karinui {

struct DxfShape {
  enum class Kind { Line, Point, Text } kind = Kind::Point;
  int layer = -1;
  std::string_view layerName;   // as the file has it
  std::vector<Flat> points;     // of a line; else one
  bool closed = false;          // of a line
  bool round = false;           // a circle: a drill hole may be drawn so
  std::optional<Flat> heading;  // unit: the way of group 50, as it is turned with the block
  std::string_view words;       // of a text
};

// How an inserted block lies: u and v are where its axes come to, `at` its base point's place.
struct DxfFrame {
  Flat u{1, 0}, v{0, 1}, at;
  Flat operator()(Flat p) const { return at + p.u * u + p.v * v; }
  Flat turned(Flat way) const { return way.u * u + way.v * v; }
};
DxfFrame frameOf(const DxfEntity& insert, Flat base);

// Inserted blocks of the names in `without` are left out. Refuses blocks that hold each other in a circle, and what is
// larger than a pattern can be.
Result<std::vector<DxfShape>> shapesOf(const DxfFile& file, const std::vector<DxfEntity>& entities,
                                       const DxfFrame& frame, const std::set<std::string_view>& without);

}  // namespace karinui

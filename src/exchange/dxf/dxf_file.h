#pragma once
// A DXF file as its groups: a code and a value on a line each (Autodesk, DXF reference, R12 to 2018). Nothing is
// understood here but sections, blocks and the vertices of polylines. The strings point into the bytes that were read.
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/geometry/vec.h"

namespace karinui {

struct DxfVertex {
  Flat place;
  double bulge = 0;  // of the way to the next vertex: the tangent of a quarter of the angle it turns to the left
};

struct DxfEntity {
  std::string_view type;  // LINE, POLYLINE, POINT, TEXT, INSERT …
  std::size_t line = 0;   // of the file, counted from 1
  std::vector<std::pair<int, std::string_view>> groups;
  std::vector<DxfVertex> vertices;  // of a POLYLINE or LWPOLYLINE

  bool is(std::string_view name) const;             // in any letter case
  std::string_view text(int code) const;            // the first of that code; empty: none
  std::optional<double> number(int code) const;     // nothing: none, or none that is finite
  std::vector<double> numbers(int code) const;      // all of that code
  std::vector<Flat> places(int xCode = 10) const;   // each x with the y that follows it
  std::optional<Flat> place(int xCode = 10) const;  // with the code after it by ten
  int flags() const { return static_cast<int>(number(70).value_or(0)); }
  bool closed() const { return (flags() & 1) != 0; }  // of polylines and splines
};
// "1"; and "L1", "Layer 1", "AAMA_1" as some programs call it. -1: no number of a layer.
int layerNumber(std::string_view name);
inline bool isNotchLayer(int layer) { return layer == 4 || (layer >= 80 && layer <= 83); }

struct DxfBlock {
  std::string_view name;
  Flat base;
  std::vector<DxfEntity> entities;
};

struct DxfFile {
  std::vector<DxfBlock> blocks;
  std::map<std::string_view, std::size_t> named;  // of the blocks, the first of each name
  std::vector<DxfEntity> entities;
  int unitCode = 0;           // $INSUNITS: 1 inches, 4 mm, 5 cm, 6 m; 0: not told
  std::string_view codePage;  // $DWGCODEPAGE; empty: not told

  const DxfBlock* block(std::string_view name) const;  // null: there is none
};

// Refuses what is no DXF text, ends in the middle, or is larger than a pattern can be.
Result<DxfFile> parseDxf(std::string_view bytes);

}  // namespace karinui

#pragma once
// A DXF file as its groups: a code and a value on a line each (Autodesk, DXF reference, R12). Nothing is understood
// here but sections, blocks and the vertices of polylines. The strings point into the bytes that were read.
#include <string_view>
#include <utility>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/geometry/vec.h"

namespace karinui {

struct DxfEntity {
  std::string_view type;  // LINE, POLYLINE, POINT, TEXT, INSERT …
  std::size_t line = 0;   // of the file, counted from 1
  std::vector<std::pair<int, std::string_view>> groups;
  std::vector<Flat> vertices;  // of a POLYLINE or LWPOLYLINE

  std::string_view text(int code) const;                       // the first of that code; empty: none
  std::optional<double> number(int code) const;                // nothing: none, or none that is finite
  std::optional<Flat> place(int xCode = 10) const;             // with the code after it by ten
  int layer() const;                                           // -1: not a number
  bool closed() const { return number(70).value_or(0) != 0; }  // of a polyline in these files: 0 or 1
};

struct DxfBlock {
  std::string_view name;
  std::vector<DxfEntity> entities;
};

struct DxfFile {
  std::vector<DxfBlock> blocks;
  std::vector<DxfEntity> entities;
};

// Refuses what is no DXF text, ends in the middle, or is larger than a pattern can be.
Result<DxfFile> parseDxf(std::string_view bytes);

}  // namespace karinui

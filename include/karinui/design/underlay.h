#pragma once
// Scans and photographs of paper patterns that lie under the flat pattern, to be traced. Part of the document, so that
// they are there again when it is opened, but of no print, export or shared pattern. Plain values; any thread.
#include <map>
#include <string>

#include "karinui/base/result.h"
#include "karinui/geometry/vec.h"

namespace karinui {

struct Underlay {
  std::string photo;       // name of a blob: packPrint()
  int wide = 1, high = 1;  // pixels of it
  Flat at;                 // where its middle lies on the table, metres
  double width = 0.21;     // metres, along its rows
  double turn = 0;         // radians, counter-clockwise
  double strength = 0.5;   // 0: nothing of it is seen, 1: all
  bool hidden = false;
  bool operator==(const Underlay&) const = default;

  double pixel() const { return width / wide; }  // metres
  double height() const { return pixel() * high; }
  // Between places of the table and of the picture, which are counted in pixels from its upper left corner, down.
  Flat inPicture(Flat table) const;
  Flat onTable(Flat picture) const;
  bool holds(Flat table) const;
};
using Underlays = std::map<std::string, Underlay>;  // by name

inline constexpr int kMostUnderlays = 64;
inline constexpr double kUsualScan = 0.0254 / 150;  // metres a pixel, of a scan whose width nobody has said
Done checkUnderlay(const Underlay& underlay);       // sizes that no paper has
const std::string* underlayAt(const Underlays& underlays, Flat table);  // the uppermost that is seen there; null: none

}  // namespace karinui

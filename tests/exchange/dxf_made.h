#pragma once
// DXF files of our own making, as other programs write them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "karinui/exchange/dxf.h"

namespace karinui::test {

struct DxfMade {
  std::string all = "0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n";
  DxfMade& block(const std::string& name) { return add("0\nBLOCK\n8\n0\n2\n" + name + "\n70\n64\n10\n0\n20\n0\n"); }
  DxfMade& endBlock() { return add("0\nENDBLK\n8\n0\n"); }
  DxfMade& says(const std::string& words) { return add("0\nTEXT\n8\n1\n10\n0\n20\n0\n40\n5\n1\n" + words + "\n"); }
  DxfMade& line(int layer, const std::vector<Flat>& points, bool closed = false) {
    const std::string on = std::to_string(layer);
    add("0\nPOLYLINE\n8\n" + on + "\n66\n1\n70\n" + (closed ? "1" : "0") + "\n");
    for (const Flat p : points) add("0\nVERTEX\n8\n" + on + "\n" + at(p));
    return add("0\nSEQEND\n");
  }
  DxfMade& straight(int layer, Flat a, Flat b) {
    return add("0\nLINE\n8\n" + std::to_string(layer) + "\n" + at(a) + "11\n" + std::to_string(b.u) + "\n21\n" +
               std::to_string(b.v) + "\n");
  }
  DxfMade& points(int layer, const std::vector<Flat>& all_) {
    for (const Flat p : all_) add("0\nPOINT\n8\n" + std::to_string(layer) + "\n" + at(p));
    return *this;
  }
  std::string done(const std::vector<std::string>& words = {"Units: METRIC", "Sample Size: 38"}) {
    add("0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    for (const std::string& w : words) says(w);
    return all + "0\nENDSEC\n0\nEOF\n";
  }
  DxfMade& add(const std::string& more) { return all += more, *this; }
  static std::string at(Flat p) { return "10\n" + std::to_string(p.u) + "\n20\n" + std::to_string(p.v) + "\n"; }
};

inline const Piece& only(const CadPattern& read, std::size_t which = 0) {
  static const Piece none;
  EXPECT_LT(which, read.pattern.pieces.size());
  if (which >= read.pattern.pieces.size()) return none;
  return *std::next(read.pattern.pieces.begin(), static_cast<std::ptrdiff_t>(which))->second;
}

inline std::string told(const CadPattern& read) {
  std::string all;
  for (const Message& note : read.notes) all += text(note) + "\n";
  return all;
}

}  // namespace karinui::test

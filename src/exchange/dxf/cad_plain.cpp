#include "cad_plain.h"

#include <algorithm>
#include <cctype>

#include "cad_ring.h"
#include "karinui/geometry/polygon.h"

namespace karinui {

namespace {

constexpr double kNearlyAsLarge = 0.5;  // of the outline's area: a seam line
constexpr double kFrame = 0.8;          // of a frame's area: a line that is larger within it is a seam line

// What a layer of such a program is called; -1: nothing that is known; 0: nothing that is cut or sewn.
int layerCalled(std::string_view name) {
  std::string low(name);
  for (char& c : low) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  struct Word {
    std::string_view part;
    int layer;
  };
  for (const Word& word : {Word{"grain", 7},    {"fadenlauf", 7},
                           {"notch", 4},        {"fold", 6},
                           {"mirror", 6},       {"drill", 13},
                           {"button", 13},      {"sew", 14},
                           {"seam", 14},        {"stitch", 14},
                           {"internal", 8},     {"inside", 8},
                           {"mark", 8},         {"placement", 8},
                           {"cut", 1},          {"boundary", 1},
                           {"outline", 1},      {"contour", 1},
                           {"dim", 0},          {"defpoint", 0},
                           {"construction", 0}, {"guide", 0},
                           {"frame", 0},        {"border", 0},
                           {"title", 0},        {"\xE5\x9C\xB0\xE3\x81\xAE\xE7\x9B\xAE", 7}})
    if (low.find(word.part) != std::string::npos) return word.layer;
  return -1;
}

bool isLine(const DxfShape& shape) { return shape.kind == DxfShape::Kind::Line && !shape.points.empty(); }

struct Loops {
  std::vector<CadLoop> loops;      // the largest first
  std::vector<std::size_t> shape;  // of each line of them
};
Loops loopsOn(const std::vector<DxfShape>& shapes, int layer) {
  Loops found;
  std::vector<CadLine> lines;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (isLine(shapes[i]) && shapes[i].layer == layer)
      lines.push_back({shapes[i].points, shapes[i].closed}), found.shape.push_back(i);
  Flat gap;
  found.loops = loopsOf(lines, gap, slipOf(shapes));
  std::stable_sort(found.loops.begin(), found.loops.end(),
                   [](const CadLoop& a, const CadLoop& b) { return signedArea(a.points) > signedArea(b.points); });
  return found;
}

bool isFrame(const std::vector<CadLoop>& loops) {
  if (loops.size() < 3) return false;
  FlatBox box;
  for (const Flat p : loops[0].points) box.include(p);
  return signedArea(loops[0].points) > 0.999 * box.size().u * box.size().v &&
         signedArea(loops[1].points) < kFrame * signedArea(loops[0].points) &&
         std::all_of(loops.begin() + 1, loops.end(),
                     [&](const CadLoop& one) { return contains(loops[0].points, one.points.front()); });
}

}  // namespace

double slipOf(const std::vector<DxfShape>& shapes) {
  FlatBox box;
  for (const DxfShape& shape : shapes)
    if (isLine(shape))
      for (const Flat p : shape.points) box.include(p);
  return 2e-4 * std::max(box.size().u, box.size().v);
}

void putOnLayers(std::vector<DxfShape>& shapes) {
  constexpr int kPerhaps = 1;
  for (DxfShape& shape : shapes) {
    if (shape.kind == DxfShape::Kind::Text) continue;
    if (const int called = layerCalled(shape.layerName); called >= 0)
      shape.layer = called;
    else if (isLine(shape))
      shape.layer = kPerhaps;
  }
  const Loops found = loopsOn(shapes, kPerhaps);
  std::vector<int> layer(shapes.size(), 8);
  for (const CadLoop& loop : found.loops)
    for (const std::size_t line : loop.lines) layer[found.shape[line]] = 1;
  if (isFrame(found.loops))
    for (const std::size_t line : found.loops[0].lines) layer[found.shape[line]] = 0;
  for (const std::size_t i : found.shape) shapes[i].layer = layer[i];
}

void tellInnerLines(std::vector<DxfShape>& shapes) {
  for (DxfShape& shape : shapes)
    if (isLine(shape) && shape.layer == 11) shape.layer = 1;  // no cut-out: perhaps a pocket's place
  const Loops found = loopsOn(shapes, 1);
  for (std::size_t k = 1; k < found.loops.size(); ++k) {
    const CadLoop& loop = found.loops[k];
    const bool seam = k == 1 && signedArea(loop.points) >= kNearlyAsLarge * signedArea(found.loops[0].points);
    for (const std::size_t line : loop.lines) shapes[found.shape[line]].layer = seam ? 14 : 0;
    if (seam) continue;
    DxfShape& whole = shapes[found.shape[loop.lines.front()]];  // one line, of however many it was drawn
    whole.points = loop.points, whole.closed = true, whole.layer = 8;
  }
}

std::string plainNameOf(const std::vector<DxfShape>& shapes, const DxfWords& words) {
  for (const DxfShape& shape : shapes)
    if (shape.kind == DxfShape::Kind::Text)
      if (std::string name = words(shape.words); !name.empty() && name[0] != '#') return name;
  for (const DxfShape& shape : shapes) {
    if (!isLine(shape) || shape.layer != 1) continue;
    std::string low(shape.layerName);
    for (char& c : low) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const bool made = low.starts_with("layer") || layerCalled(low) >= 0 ||
                      low.find_first_not_of("0123456789 _-") == std::string::npos;
    return made ? "" : words(shape.layerName);
  }
  return {};
}

}  // namespace karinui

// The readers of karinui-import, in process and without its cell: a sanitizer's shadow memory does not fit in there.
// What a library of others does wrong with a file ends the cell and nothing else; what is looked for here is what ours
// do.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "../apps/karinui-import/reader.h"
#include "readers.h"

namespace karinui::test {

namespace {

// As main() of karinui-import: whatever a library throws is a refusal.
template <class Read>
void guarded(const Read& read) {
  import::Reading reading;
  try {
    reading = read(import::Limits{1u << 30, 10, 200'000, 400'000});
  } catch (...) {
    return;
  }
  if (reading.refused != wire::Reason::None) return;
  const auto demand = [](bool promise, const char* what) {
    if (promise) return;
    std::fprintf(stderr, "broken promise of a reader: %s\n", what);
    std::abort();
  };
  demand(reading.needs.size() <= wire::kMostSideFiles, "no more side files than may be asked for");
  demand(reading.mesh.points.size() <= 200'000 && reading.mesh.faces.size() <= 400'000, "no more than was allowed");
  demand(reading.rgb.size() == 3 * reading.width * reading.height, "a picture is whole");
  demand(reading.width > 0 || !reading.needs.empty() || !reading.mesh.faces.empty(), "something was read");
  for (const Triangle& face : reading.mesh.faces)
    for (const std::uint32_t corner : face) demand(corner < reading.mesh.points.size(), "a corner is a point");
}

void polygons(std::string_view bytes, const char* format) {
  guarded([&](const import::Limits& limits) { return import::readPolygons(std::string(bytes), format, limits); });
}

void gltf(std::string_view bytes, bool binary) {
  guarded([&](const import::Limits& limits) {
    const std::map<std::string, std::string> beside{{"beside.bin", std::string(bytes)}};
    return import::readGltf(std::string(bytes), binary, beside, limits);
  });
}

constexpr FuzzedReader kReaders[] = {
    {"obj", "obj", [](std::string_view bytes) { polygons(bytes, "obj"); }},
    {"ply", "ply", [](std::string_view bytes) { polygons(bytes, "ply"); }},
    {"gltf", "gltf", [](std::string_view bytes) { gltf(bytes, false); }},
    {"glb", "glb", [](std::string_view bytes) { gltf(bytes, true); }},
    {"picture", "picture",
     [](std::string_view bytes) {
       guarded([&](const import::Limits& limits) { return import::readPicture(std::string(bytes), limits); });
     }},
};

}  // namespace

std::span<const FuzzedReader> fuzzedReaders() { return kReaders; }

}  // namespace karinui::test

#pragma once
// Inside karinui-import: bytes in, one flat mesh out.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "exchange/import_wire.h"
#include "karinui/geometry/mesh.h"

namespace karinui::import {

struct Limits {
  std::uint64_t memoryBytes = 0, seconds = 0, points = 0, triangles = 0;
};

struct Reading {
  wire::Reason refused = wire::Reason::None;
  std::set<std::string> needs = {};  // side files to be handed over
  TriangleMesh mesh = {};
  std::uint64_t line = 0;               // where a refused file is wrong, if that is known
  std::uint64_t width = 0, height = 0;  // of a picture
  std::vector<std::uint8_t> rgb = {};
};

// Lets this process do nothing from here on but compute, read what it holds and answer. False if the system will not.
bool enterCell(const Limits& limits);

Reading readPolygons(const std::string& bytes, const std::string& format, const Limits& limits);  // obj, ply
Reading readPicture(const std::string& bytes, const Limits& limits);  // limits.points: of pixels
Reading readGltf(const std::string& bytes, bool binary, const std::map<std::string, std::string>& sideFiles,
                 const Limits& limits);

}  // namespace karinui::import

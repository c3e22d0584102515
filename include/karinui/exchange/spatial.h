#pragma once
// A garment and the body it is worn on, as shapes for other programs: OBJ and GLB (glTF 2.0). Metres, y up, facing +z;
// texture coordinates are the flat pattern in metres, so that a fabric's picture keeps its scale. The same values give
// the same bytes. Pure; any thread.
//
// The body is an object named `body`, every piece and the buttons of every fastening an object of its own name; a name
// that cannot be one (empty, `body`, one that another piece has) gets a number.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

// How a piece's cloth looks. Its picture, if it has one, is a tile of the print that is repeated over the paper.
struct SpatialLook {
  double roughness = 0.9;
  double sheen = 0;      // light that fine hairs catch, 0 to 1
  double cover = 1;      // less: it is seen through
  double thickness = 0;  // metres; a GLB shows it at the edges
  struct Tile {
    int width = 0, height = 0;       // pixels
    std::vector<std::uint8_t> rgb;   // sRGB, rows from the top; instead of the colour
    double wide = 0, high = 0;       // metres on paper
    Flat across{1, 0}, along{0, 1};  // unit, on paper: its right and its top
    Flat origin = {};                // on paper: a lower left corner
    // The same picture, wherever it begins.
    bool operator==(const Tile& o) const {
      return width == o.width && height == o.height && rgb == o.rgb && wide == o.wide && high == o.high &&
             across == o.across && along == o.along;
    }
  };
  std::optional<Tile> tile;
  struct Wrong {                    // its other side, where that looks otherwise
    std::array<float, 3> colour{};  // linear
    std::optional<Tile> tile;
    bool operator==(const Wrong&) const = default;
  };
  std::optional<Wrong> wrong;
  bool operator==(const SpatialLook&) const = default;
};

struct SpatialPiece {
  std::string name, fabric;
  TriangleMesh mesh;                                 // in space, posed
  std::vector<Flat> flat;                            // where each point is on paper
  std::array<float, 3> colour{0.35f, 0.45f, 0.65f};  // linear RGB
  SpatialLook look = {};
};

// What is sewn on, as buttons: all of one fastening are one object.
struct SpatialNotion {
  std::string name, material;
  TriangleMesh mesh;  // in space
  std::array<float, 3> colour{};
};

// Where every point of a garment has come after a time, in the order of its meshes.
struct SpatialKeyframe {
  double seconds = 0;  // from the beginning, growing from one to the next
  double held = 0;     // for so many it stays so
  std::string name;    // of the shape; empty: it is named by its time
  std::vector<Vec3> body;
  std::vector<std::vector<Vec3>> pieces, notions;
};

struct SpatialGarment {
  std::optional<TriangleMesh> body;
  std::vector<SpatialPiece> pieces;
  std::vector<SpatialNotion> notions = {};
  // How it moves, from where its meshes are; empty: it stands still. A GLB has each as a morph target, between which an
  // animation goes in straight lines. OBJ knows no motion.
  std::vector<SpatialKeyframe> motion = {};
};

// Refused with a sentence: points that are not finite, faces that name points that are not there, a keyframe that has
// another number of points.
Result<std::string> writeObj(const SpatialGarment& garment);
// A file that is written beside another, which names it.
struct SideFile {
  std::string name, bytes;
};
// The same with materials: one for each fabric, colour and print. They are in STEM.mtl, prints in pictures beside it.
Result<std::string> writeObj(const SpatialGarment& garment, std::string_view stem, std::vector<SideFile>& beside);
Result<std::string> writeObj(const TriangleMesh& mesh, std::string_view name);  // points and faces only
Result<std::string> writeGlb(const SpatialGarment& garment);

}  // namespace karinui

#pragma once
// A stranger's body file (OBJ, PLY, glTF, GLB) becomes a closed, outward, standing mesh in metres, or a sentence. The
// file is taken apart by the program karinui-import in a process of its own that has little memory, little time, no
// files and no network; what it hands back is checked again here. Blocking; call from any one thread.
#include <filesystem>
#include <optional>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/base/workers.h"
#include "karinui/geometry/mesh.h"

namespace karinui {

enum class LengthUnit { Metre, Decimetre, Centimetre, Millimetre, Inch, Foot };
enum class UpAxis { X, Y, Z };

struct BodyReadLimits {
  std::size_t fileBytes = 256u << 20;
  std::size_t points = 5'000'000;
  std::size_t triangles = 10'000'000;
  std::size_t memoryBytes = 1u << 30;  // of the reading process
  int seconds = 10;                    // of its processor time, and of the clock
};

struct BodyReadOptions {
  std::optional<LengthUnit> unit;  // guessed from the height when not given
  std::optional<UpAxis> up;        // found by the body's shape, else guessed, when not given
  bool wrap = false;               // put a watertight skin over a surface that is not closed
  bool* open = nullptr;            // set where a surface is refused because it is not closed
  double wrapCell = 0.008;         // metres: finer keeps more detail and takes longer
  BodyReadLimits limits;
  std::filesystem::path helper;  // karinui-import; looked for beside the running program when empty
};

struct ImportedBody {
  TriangleMesh mesh;  // closed, outward, metres, y up, facing +z where its feet tell, lowest point on y = 0
  MeshReport found;   // as it was in the file, after equal points were joined
  MeshReport report;  // as it is now
  LengthUnit unit = LengthUnit::Metre;
  UpAxis up = UpAxis::Y;
  double legs = 0;  // how high the legs part, as a share of the height; 0: it was not recognised as a person
  bool turnedOutward = false, wrapped = false;
  std::vector<Message> notes;  // everything that was guessed, changed or found, for the person
};

Result<ImportedBody> readBody(const std::filesystem::path& path, const BodyReadOptions& options, Workers& workers,
                              const Token& token);

}  // namespace karinui

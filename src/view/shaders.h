#pragma once
// The renderer's GLSL, without the version line.
#include <string>

namespace karinui::glsl {

extern const std::string kDepthVertex;  // shadow maps
extern const std::string kWholeVertex;  // one triangle over the whole target
extern const std::string kSkyFragment;  // soft light, a texel for each vertex
extern const std::string kBackdropFragment;
// Body and cloth; the floor. Two programs, for a software renderer works out both sides of every `if`. Before their
// fragment shaders comes kFine or kQuick: how much is worked out for a pixel.
extern const std::string kFine, kQuick;
extern const std::string kSolidVertex, kSolidFragment, kFloorFragment;
extern const std::string kRibbonVertex, kRibbonFragment;

inline constexpr int kSkyWide = 1024;  // texels in a row of the soft light's table
inline constexpr int kYarnSide = 256;  // side of the table of unevenness

}  // namespace karinui::glsl

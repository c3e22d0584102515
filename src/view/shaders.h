#pragma once
// The renderer's GLSL, without the version line.
#include <string>

namespace karinui::glsl {

extern const std::string kDepthVertex;              // shadow maps
extern const std::string kSkyVertex, kSkyFragment;  // soft light, a texel for each vertex
extern const std::string kBackdropVertex, kBackdropFragment;
extern const std::string kSolidVertex, kSolidFragment;  // body, cloth, floor
extern const std::string kRibbonVertex, kRibbonFragment;

inline constexpr int kSkyWide = 1024;  // texels in a row of the soft light's table

}  // namespace karinui::glsl

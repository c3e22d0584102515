#pragma once
// A garment in motion: how it follows its figure from pose to pose, and comes to rest in each. For programs that play
// animations (GLB). The document is left as it is. Long; any thread, with its own context.
#include <filesystem>
#include <string>
#include <vector>

#include "karinui/design/apply.h"
#include "karinui/exchange/spatial.h"
#include "karinui/session/look_of.h"

namespace karinui {

// The garment as it stands, brought to rest if it is not, with a motion through the poses in turn. On the way the
// fastest skin goes a metre a second; keyframes are a twenty-fifth of a second apart, and the one of a rest has the
// pose's name. Buttons, threads and bindings go with the cloth they lie on. Refused: no body, no piece, no pose, a pose
// that does not exist or that the figure cannot take.
Result<SpatialGarment> animationOf(const Document& document, const std::vector<std::string>& poses, Context& context,
                                   const Prints& prints = {});
// The same as a GLB; how many bytes it has.
Result<std::size_t> writeAnimation(const std::filesystem::path& file, const Document& document,
                                   const std::vector<std::string>& poses, Context& context, const Prints& prints = {});

}  // namespace karinui

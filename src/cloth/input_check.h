#pragma once
// What a drape refuses to begin with.
#include "karinui/cloth/settle.h"

namespace karinui {

Done checkLevel(const ClothLevel& level);
Done checkSettings(const SettleSettings& settings);

}  // namespace karinui

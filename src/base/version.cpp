#include "karinui/base/version.h"

namespace karinui {

std::string_view version() { return KARINUI_VERSION; }

}  // namespace karinui

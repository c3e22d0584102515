#pragma once
// Which names a command may give to what it writes: the one rule for every verb and request.
#include <string>
#include <vector>

#include "karinui/base/result.h"

namespace karinui::app {

// A file of one of the endings (as "png") in a folder that is there and may be written, and none of those that the same
// command reads: what is written over is lost. A word that is read may be more than a name, as L=larger.karinui.
Done mayWrite(const std::string& file, const std::vector<std::string>& endings, const std::vector<std::string>& read);
// The refusal of an option that a file of this ending has no use for.
Error unasked(const char* option, const std::string& file);
// A folder, which may be there or not.
Done mayBeFolder(const std::string& folder);

}  // namespace karinui::app

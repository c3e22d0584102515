#pragma once
// Where the person keeps documents, as the desktop says it; the studio's folders. Any thread.
#include <filesystem>

namespace karinui::room {

std::filesystem::path documentsFolder();  // Documents/Karinui; empty: there is no home

}  // namespace karinui::room

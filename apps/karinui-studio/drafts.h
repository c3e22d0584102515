#pragma once
// Where garments are kept that were given no name yet, and what they are called. Any thread.
#include <filesystem>
#include <string>

#include "karinui/base/message.h"
#include "karinui/design/document.h"
#include "karinui/design/operation.h"

namespace karinui::studio {

std::filesystem::path documentsFolder();  // Documents/Karinui
std::filesystem::path draftsFolder();     // Documents/Karinui/Drafts
// "Draft 2026-11-22", or what it is about and the day; without ending.
std::string draftName(const std::string& about, Language language);
// What a ready block makes and for whom: "Skirt EU 44 (women)"; empty: the step was another.
std::string garmentName(const Document& made, const Operation& by, Language language);

}  // namespace karinui::studio

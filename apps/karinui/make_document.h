#pragma once
// A command that leaves a new document.
#include <functional>
#include <string>

#include "open_document.h"

namespace karinui::app {

// Makes a new document in a file beside the wanted one and gives it its name only when all went well: a refused or
// stopped command leaves nothing behind, and a document that was there stays until the new one is whole. `tell` adds
// to the answer.
int makeDocument(Program& program, const std::string& wanted, bool overwrite,
                 const std::function<Result<void>(OpenDocument&)>& fill,
                 const std::function<void(Json& answer, std::string& words)>& tell = {});

}  // namespace karinui::app

#pragma once
// A .karinui file as text and back, for version control and for people who want to see all of it: every step of every
// branch, where the person stands, and the parts kept beside the steps. Two exact inverses: the document a dump is
// loaded into has the same steps, hashes and parts, and its dump is the same text. docs/format/dump.md. Any thread.
#include <filesystem>
#include <string>
#include <string_view>

#include "karinui/base/result.h"

namespace karinui {

// Refuses a file that is not whole, as opening it does; `document` is only read.
Result<std::string> dumped(const std::filesystem::path& document);

// Whether a text begins as what dumped() writes.
bool isDump(std::string_view text);

// Makes a new document of a dump. Refused, with nothing left behind, where the text is not a dump (the error names the
// line) or `to` exists already. The content is a stranger's: DocumentFile::open() looks it through.
Done loadDump(std::string_view dump, const std::filesystem::path& to);

}  // namespace karinui

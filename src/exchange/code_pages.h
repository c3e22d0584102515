#pragma once
// Letters of other code pages than UTF-8, as files of other programs have them. Only code pages of a list of our own
// are asked of the system, whatever a file calls its own.
#include <optional>
#include <string>
#include <string_view>

namespace karinui {

bool isUtf8(std::string_view text);
// Nothing: the bytes are no text of that code page, or it is none that is known here.
std::optional<std::string> inUtf8(std::string_view bytes, std::string_view codePage);
// Of letters that are no UTF-8 and whose code page nothing tells: CP932 (Japanese), GBK (Chinese) or CP1252 (Western).
std::string likelyCodePage(std::string_view letters);
// A text that begins with the mark of UTF-16, as Notepad and PowerShell write it, in UTF-8; all else as it is.
std::string withoutUtf16(std::string text);
// An XML file in UTF-8: by its mark, else by the encoding that it names, else by its letters.
std::string xmlInUtf8(std::string_view text);

}  // namespace karinui

#include "karinui/exchange/read_pattern.h"

#include <algorithm>

#include "karinui/base/file.h"

namespace karinui {

Result<Pattern> readPattern(const std::filesystem::path& file, FormatTable table) {
  std::vector<const FileFormat*> formats = formatsReading(file, table);
  std::erase_if(formats, [](const FileFormat* format) { return format->in != FileContent::Pattern; });
  if (formats.empty()) return unreadable(file, {FileContent::Pattern}, table);
  const Result<std::string> bytes = readFile(file);
  if (!bytes) return bytes.error();
  const auto format = std::find_if(formats.begin(), formats.end() - 1,
                                   [&](const FileFormat* one) { return !one->recognises || one->recognises(*bytes); });
  auto pattern = (*format)->readPattern(*bytes);
  if (!pattern) return inFile(file, pattern.error());
  return pattern;
}

}  // namespace karinui

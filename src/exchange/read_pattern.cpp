#include "karinui/exchange/read_pattern.h"

#include <algorithm>

#include "karinui/base/file.h"

namespace karinui {

Result<CadPattern> readPatternSize(const std::filesystem::path& file, std::string_view size, FormatTable table) {
  std::vector<const FileFormat*> formats = formatsReading(file, table);
  std::erase_if(formats, [](const FileFormat* format) { return format->in != FileContent::Pattern; });
  if (formats.empty()) return unreadable(file, {FileContent::Pattern}, table);
  const Result<std::string> bytes = readFile(file);
  if (!bytes) return bytes.error();
  const FileFormat& format = **std::find_if(formats.begin(), formats.end() - 1, [&](const FileFormat* one) {
    return !one->recognises || one->recognises(*bytes);
  });
  if (format.readSize) {
    auto read = format.readSize(*bytes, size);
    return read ? std::move(read) : inFile(file, read.error());
  }
  if (!size.empty()) return inFile(file, badInput(say("Such a file holds one size only.")));
  auto pattern = format.readPattern(*bytes);
  if (!pattern) return inFile(file, pattern.error());
  CadPattern whole;
  whole.pattern = *std::move(pattern);
  return whole;
}

Result<Pattern> readPattern(const std::filesystem::path& file, FormatTable table) {
  auto read = readPatternSize(file, {}, table);
  if (!read) return read.error();
  return std::move(read->pattern);
}

}  // namespace karinui

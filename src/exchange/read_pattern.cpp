#include "karinui/exchange/read_pattern.h"

#include "karinui/base/file.h"
#include "karinui/exchange/garment_code.h"
#include "karinui/exchange/pattern_json.h"
#include "karinui/exchange/sheet.h"

namespace karinui {

Result<Pattern> readPattern(const std::filesystem::path& file) {
  const Result<std::string> bytes = readFile(file);
  if (!bytes) return bytes.error();
  const bool drawn = file.extension() == ".svg";
  const bool ours = bytes->find("\"karinui-pattern-1\"") != std::string::npos;
  auto pattern = drawn ? readSvg(*bytes) : ours ? readPatternJson(*bytes) : readGarmentCode(*bytes);
  if (!pattern) return inFile(file, pattern.error());
  return pattern;
}

}  // namespace karinui

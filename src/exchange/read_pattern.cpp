#include "karinui/exchange/read_pattern.h"

#include "karinui/base/file.h"
#include "karinui/exchange/garment_code.h"
#include "karinui/exchange/pattern_json.h"
#include "karinui/exchange/sheet.h"

namespace karinui {

Result<Pattern> readPattern(const std::filesystem::path& file) {
  const Result<std::string> bytes = readFile(file);
  if (!bytes) return bytes.error();
  if (file.extension() == ".svg") return readSvg(*bytes);
  const bool ours = bytes->find("\"karinui-pattern-1\"") != std::string::npos;
  return ours ? readPatternJson(*bytes) : readGarmentCode(*bytes);
}

}  // namespace karinui

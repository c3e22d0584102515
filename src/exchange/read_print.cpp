#include "karinui/exchange/read_print.h"

#include "exchange/reading_process.h"

namespace karinui {

Result<PrintPixels> readPrint(const std::filesystem::path& path, const Token& token,
                              const std::filesystem::path& helper) {
  const auto reader = importHelper(helper);
  if (!reader) return reader.error();
  auto image = readPictureInOtherProcess(path, *reader, token);
  if (!image) return image.error();
  return fitted(*std::move(image));
}

}  // namespace karinui

#include "karinui/exchange/read_print.h"

#include "exchange/reading_process.h"

namespace karinui {

namespace {

constexpr std::size_t kMostPrintPixels = 40'000'000;

Result<PrintPixels> pixelsOf(const std::filesystem::path& path, std::size_t most, const Token& token,
                             const std::filesystem::path& helper) {
  const auto reader = importHelper(helper);
  if (!reader) return reader.error();
  return readPictureInOtherProcess(path, *reader, most, token);
}

}  // namespace

Result<PrintPixels> readPrint(const std::filesystem::path& path, const Token& token,
                              const std::filesystem::path& helper) {
  auto image = pixelsOf(path, kMostPrintPixels, token, helper);
  if (!image) return image.error();
  return fitted(*std::move(image), kMostPrintSide);
}

Result<Scan> readScan(const std::filesystem::path& path, const Token& token, const std::filesystem::path& helper) {
  auto image = pixelsOf(path, kMostScanPixels, token, helper);
  if (!image) return image.error();
  Scan scan;
  scan.width = image->width, scan.height = image->height;
  scan.image = fitted(*std::move(image), kMostScanSide);
  return scan;
}

std::optional<Message> Scan::shrunk() const {
  if (image.width == width) return std::nullopt;
  return say("The scan of {0} × {1} pixels is kept in {2} × {3}.", width, height, image.width, image.height);
}

}  // namespace karinui

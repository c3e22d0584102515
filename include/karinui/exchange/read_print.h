#pragma once
// A photograph (PNG or JPEG) for a print on cloth, or a scan to trace. It is taken apart by karinui-import in a process
// of its own, as body files are (read_body.h); what comes back is checked and made small here. Blocking; call from any
// one thread.
#include <filesystem>
#include <optional>

#include "karinui/base/message.h"
#include "karinui/base/result.h"
#include "karinui/base/token.h"
#include "karinui/design/print_image.h"

namespace karinui {

// Refuses files of more than 64 MB and photographs of more than 40 million pixels. `helper`: karinui-import; looked for
// beside the running program when empty.
Result<PrintPixels> readPrint(const std::filesystem::path& path, const Token& token,
                              const std::filesystem::path& helper = {});

// A scan of a paper pattern: of more pixels, and kept larger.
struct Scan {
  PrintPixels image;
  int width = 0, height = 0;              // pixels, as it was scanned
  std::optional<Message> shrunk() const;  // told where it was made smaller
};
inline constexpr std::size_t kMostScanPixels = 120'000'000;
Result<Scan> readScan(const std::filesystem::path& path, const Token& token, const std::filesystem::path& helper = {});

}  // namespace karinui

#pragma once
// A photograph that is printed on cloth, or a scan that is traced, as a document keeps it: plain pixels, so that
// nothing has to be decoded when it is read again. Pure; any thread.
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"

namespace karinui {

inline constexpr int kMostPrintSide = 1024, kMostScanSide = 4096;  // pixels

struct PrintPixels {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // sRGB, three bytes a pixel, rows from the top
};
PrintPixels fitted(PrintPixels image, int mostSide);  // made smaller by a whole number where a side is longer
std::string packPrint(const PrintPixels& image);
Result<PrintPixels> unpackPrint(std::string_view bytes);       // refuses damaged ones
Result<std::array<int, 2>> printSize(std::string_view bytes);  // width and height alone

}  // namespace karinui

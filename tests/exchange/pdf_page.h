#pragma once
// A page of a PDF as poppler draws it, in grey values.
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "karinui/base/file.h"
#include "patterns.h"

namespace karinui::test {

struct Picture {
  int width = 0, height = 0;
  std::string grey;
  int at(int x, int y) const {
    return static_cast<unsigned char>(
        grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
  }
};

inline bool drawsPdf() { return std::system("pdftoppm -v >/dev/null 2>&1") == 0; }

inline Picture rendered(const std::string& pdf, int page, int dpi, const std::string& crop = "") {
  std::string folder = (std::filesystem::temp_directory_path() / "karinui-pdf-XXXXXX").string();
  if (!::mkdtemp(folder.data()) || !writeFile(folder + "/a.pdf", pdf)) return {};
  const std::string number = std::to_string(page);
  const std::string command = "pdftoppm -gray -singlefile -aa no -aaVector no -f " + number + " -l " + number + " -r " +
                              std::to_string(dpi) + " " + crop + " " + folder + "/a.pdf " + folder + "/a 2>/dev/null";
  Picture out;
  if (std::system(command.c_str()) == 0) {
    std::istringstream file(content(folder + "/a.pgm"));
    std::string magic;
    int most = 0;
    file >> magic >> out.width >> out.height >> most;
    file.get();
    out.grey.assign(std::istreambuf_iterator<char>(file), {});
  }
  std::filesystem::remove_all(folder);
  return out;
}

}  // namespace karinui::test

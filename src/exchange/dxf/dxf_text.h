#pragma once
// The words of a DXF file as UTF-8. Files before release 2007 are written in the code page of their maker's country,
// which the header may tell. Pure but for the C library's tables of code pages.
#include <string>
#include <string_view>

#include "dxf_file.h"

namespace karinui {

class DxfWords {
 public:
  explicit DxfWords(const DxfFile& file);
  std::string operator()(std::string_view bytes) const;  // clean (cleanText), without blanks at its ends
  bool guessed() const { return guessed_; }              // the file does not tell its code page

 private:
  std::string codePage_;  // as iconv calls it; empty: UTF-8
  bool guessed_ = false;
};

}  // namespace karinui

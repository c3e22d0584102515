#pragma once
// A report of pictures and tables on A4 pages, as PDF. Pure; any thread.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/base/result.h"

namespace karinui {

struct ReportPicture {
  Message caption;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // rows from the top, as in Image (view/image.h)
};
struct ReportTable {
  Message heading;
  std::vector<Message> columns;  // above the values; may be empty
  std::vector<std::vector<Message>> rows;
};
struct Report {
  std::string title;
  Message under;  // below the title
  std::vector<ReportPicture> pictures;
  std::vector<ReportTable> tables;
};
// Pictures first, three beside each other, then the tables in two columns; as many pages as it takes. No date: the same
// report gives the same bytes.
Result<std::string> writeReport(const Report& report, Language language);

}  // namespace karinui

#pragma once
// A report of pictures, plots and tables on A4 pages, as PDF. Pure; any thread.
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
// How values are distributed: a histogram for each row, all on one axis. Values beyond the limit are dark and counted.
struct ReportPlot {
  struct Row {
    Message name;
    std::vector<double> values;  // may be empty
  };
  Message heading;
  std::string unit;  // "cm"
  std::vector<Row> rows;
  double limit = 0;
  bool least = false;  // the limit is a least one: beyond it are the values below
};
struct Report {
  std::string title;
  Message under;  // below the title
  std::vector<ReportTable> summary;
  std::vector<ReportPicture> pictures;
  std::vector<ReportPlot> plots;
  std::vector<ReportTable> tables, lists;
};
// In this order: the summary; pictures, three beside each other; plots; tables in two columns; lists. Summary and lists
// have the width of the page, and a row with fewer cells than columns gives its last one, of any length, the rest of
// the row. As many pages as it takes. No date: the same report gives the same bytes.
Result<std::string> writeReport(const Report& report, Language language);

}  // namespace karinui

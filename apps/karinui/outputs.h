#pragma once
// What leaves an open document as a file of another program.
#include <optional>
#include <string>
#include <vector>

#include "open_document.h"

namespace karinui::app {

struct ExportRequest {
  std::string out;  // a file's name; its ending says what is written
  std::string paper = "sheet", format;
  std::optional<double> allowanceMm;
  double overlapMm = 10;
  std::string date;
  bool nest = false;
};
std::vector<std::string> patternFormats();  // what `format` may name: the texts of a pattern, which share an ending
Result<std::string> exportBytes(OpenDocument& opened, const ExportRequest& request);

}  // namespace karinui::app

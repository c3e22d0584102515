#pragma once
// What leaves an open document as a file of another program.
#include <optional>
#include <string>
#include <vector>

#include "open_document.h"

namespace karinui::app {

struct ExportRequest {
  std::string out;            // a file's name; its ending says what is written
  std::string paper, format;  // empty, like the next ones: not asked for
  std::optional<double> allowanceMm, overlapMm;
  std::string date;
  bool nest = false;
  std::string poses;  // through which a GLB goes: T,step,A
};
std::vector<std::string> patternFormats();  // what `format` may name: the texts of a pattern, which share an ending
// Writes it, with what stands beside it; how many bytes it has. What a format has no use for is refused rather than
// left out.
Result<std::size_t> exportFile(OpenDocument& opened, const ExportRequest& request);

}  // namespace karinui::app

#pragma once
// What leaves an open document as a file of another program.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "open_document.h"

namespace karinui::app {

// What paper a PDF is laid on; "sheet", or nothing named: one sheet as large as it takes.
inline constexpr std::array kPapers{"sheet", "a4", "letter", "a3", "a0", "36in"};
std::string paperFormat(const std::string& paper);  // the id of its file format

struct ExportRequest {
  std::string out;            // a file's name; its ending says what is written
  std::string paper, format;  // empty, like the next ones: not asked for
  std::optional<double> allowanceMm, overlapMm;
  std::string date;
  bool nest = false, pairsOnce = false;
  std::string poses;  // through which a GLB goes: T,step,A
};
std::vector<std::string> patternFormats();  // what `format` may name: the texts of a pattern, which share an ending
// Writes it, with what stands beside it; how many bytes it has. What a format has no use for is refused rather than
// left out.
Result<std::size_t> exportFile(OpenDocument& opened, const ExportRequest& request);

}  // namespace karinui::app

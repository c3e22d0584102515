#pragma once
// What leaves an open document: exports and pictures.
#include <optional>
#include <string>
#include <vector>

#include "karinui/view/image.h"
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

struct PictureRequest {
  std::string view = "front", map = "none", eyes = "mono", size = "1200x1600", hide, section;
  bool table = false, nest = false, scans = false;  // the flat pattern instead; in all its sizes; over what is traced
};
Done checkPicture(const PictureRequest& request);  // whether its words can be understood
Result<Image> pictureOf(OpenDocument& opened, const PictureRequest& request);

}  // namespace karinui::app

#pragma once
// Pictures of an open document: one, several garments side by side, whole turns.
#include <array>
#include <string>

#include "comparison.h"
#include "karinui/view/picture.h"

namespace karinui::app {

struct PictureRequest : PictureWords {
  std::string hide, section;
  bool table = false, nest = false, scans = false;  // the flat pattern instead; in all its sizes; over what is traced
  ComparisonWish compare;
  int turns = 0;   // so many sides of a whole turn on one sheet; 0: one side
  int frames = 0;  // so many pictures of a whole turn, for writeFrames()
  bool several() const { return compare.any() || turns > 0 || frames > 0; }
};
Done checkPicture(const PictureRequest& request);  // whether its words can be understood
Result<Image> pictureOf(OpenDocument& opened, const PictureRequest& request);
// Each picture of a whole turn, numbered, into a folder that is new or empty; gives the size of one, which is even.
Result<std::array<int, 2>> writeFrames(OpenDocument& opened, const PictureRequest& request, const std::string& folder);

}  // namespace karinui::app

#pragma once
// Pictures a script asks for while it is played: a comment "# picture: NAME view=back map=strain" draws NAME.png of the
// garment as it stands at that line.
#include <string>
#include <vector>

#include "karinui/view/picture.h"
#include "open_document.h"

namespace karinui::app {

class StagePictures {
 public:
  StagePictures(std::string folder, const std::string& script);  // an empty folder: no pictures
  Done before(int line, OpenDocument& opened);                   // draws those asked for before this line of the script
  Done rest(OpenDocument& opened);

 private:
  struct Wish {
    int line = 0;
    std::string name, words;
  };
  Done draw(const Wish& wish, OpenDocument& opened);
  std::string folder_;
  std::vector<Wish> wishes_;  // in the script's order
  std::size_t next_ = 0;
  std::unique_ptr<Picture> picture_;
};

}  // namespace karinui::app

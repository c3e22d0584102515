#include "stage_pictures.h"

#include <filesystem>
#include <limits>
#include <sstream>

#include "comparison.h"
#include "karinui/base/file.h"

namespace karinui::app {

StagePictures::StagePictures(std::string folder, const std::string& script) : folder_(std::move(folder)) {
  if (folder_.empty()) return;
  std::istringstream lines(script);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    constexpr std::string_view kAsk = "# picture:";
    if (!line.starts_with(kAsk)) continue;
    std::istringstream words(line.substr(kAsk.size()));
    Wish wish{number, "", ""};
    words >> wish.name;
    std::getline(words, wish.words);
    wishes_.push_back(std::move(wish));
  }
}

Done StagePictures::before(int line, OpenDocument& opened) {
  for (; next_ < wishes_.size() && wishes_[next_].line < line; ++next_) {
    if (const Done drawn = draw(wishes_[next_], opened); !drawn) return drawn;
  }
  return {};
}

Done StagePictures::rest(OpenDocument& opened) { return before(std::numeric_limits<int>::max(), opened); }

Done StagePictures::draw(const Wish& wish, OpenDocument& opened) {
  // A script may be a stranger's: it names pictures in the folder, and no other file.
  if (!isPlainName(wish.name))
    return badInput(say("Line {0}: “{1}” is no name of a picture; write it without a folder.", wish.line, wish.name));
  if (!picture_) {
    auto fresh = Picture::open();
    if (!fresh) return fresh.error();
    picture_ = std::move(*fresh);
  }
  PictureOptions options;
  std::istringstream words(wish.words);
  for (std::string word; words >> word;) {
    const std::size_t is = word.find('=');
    const std::string key = word.substr(0, is), value = is == std::string::npos ? "" : word.substr(is + 1);
    if (key == "view") {
      const auto view = viewNamed(value);
      if (!view) return view.error();
      options.view = *view;
    } else if (key == "map") {
      const auto map = mapNamed(value);
      if (!map) return map.error();
      options.map = *map;
    } else {
      return badInput(say("A picture knows “view” and “map”, not “{0}”.", key));
    }
  }
  const Result<SeenGarment> garment = seen(opened, opened.document(), {}, options.map);
  if (!garment) return garment.error();
  options.mapTop = garment->mapTop;
  const Result<Image> image = picture_->draw(garment->frame, options);
  if (!image) return image.error();
  std::error_code trouble;
  std::filesystem::create_directories(folder_, trouble);
  return writePng((std::filesystem::path(folder_) / (wish.name + ".png")).string(), *image);
}

}  // namespace karinui::app

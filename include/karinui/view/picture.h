#pragma once
// Pictures of a fitting without a screen. One Picture may draw any number of frames; one thread at a time, any thread.
//   auto picture = Picture::open();
//   auto image = (*picture)->draw(frame, {.view = View::Back, .width = 1200, .height = 1600});
//   writePng("back.png", *image);
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/base/result.h"
#include "karinui/scene/scene_frame.h"
#include "karinui/view/camera.h"
#include "karinui/view/image.h"
#include "karinui/view/lettering.h"
#include "karinui/view/renderer.h"

namespace karinui {

// Pressure is shown of frames whose cloths have pascals in place of strains (pressedFrame in session/fit.h).
enum class Map { None, Strain, Pressure };
Result<Map> mapNamed(std::string_view name);  // "none", "strain", "pressure"

// "1200x1600" as width and height; refuses what Picture would refuse.
Result<std::array<int, 2>> sizeNamed(std::string_view text);

// The place of a picture among those that are laid side by side as one: the backdrop goes on from one to the next.
struct InRow {
  int at = 0, of = 1;
};

struct PictureOptions {
  View view = View::Front;
  Eyes eyes = Eyes::Mono;
  Map map = Map::None;
  int width = 1200, height = 1600;    // of the whole picture, both eyes; 16 … 8192 each
  std::optional<Camera> camera = {};  // instead of the view's own
  double mapTop = 0;                  // top of the map's scale, e.g. 0.05, or pascals; 0: a round number from the frame
  double eyeSeparation = 0.063;       // metres
  int samples = 2;                    // each pixel is the mean of samples x samples; 1 … 4
  bool lettering = true;              // captions and legend
  InRow row = {};
  Language language = Language::English;
};

// What a picture is asked for in words, by karinui picture as from Python. `several`: garments side by side or a whole
// turn, which are drawn smaller, and for one eye.
struct PictureWords {
  std::string view = "front", map = "none", eyes = "mono", size;  // no size: the usual
};
Result<PictureOptions> pictureOptions(const PictureWords& words, bool several = false);

class Picture {
 public:
  // Refuses with a sentence where no OpenGL 3.3 can be had.
  static Result<std::unique_ptr<Picture>> open(const Studio& studio = {});
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  Result<Image> draw(const SceneFrame& frame, const PictureOptions& options = {});
  // The frame drawn last from another camera, which is quicker: it is in graphics memory, and the soft light is known.
  Result<Image> again(const PictureOptions& options);

  // What the last picture leaves out or could not show, as sentences.
  const std::vector<Message>& notes() const { return notes_; }
  // What draws, as the driver names itself ("llvmpipe …").
  const std::string& renderer() const;

 private:
  Picture();
  Result<Image> seen(const Camera& camera, const PictureOptions& options);
  struct Parts;
  std::unique_ptr<Parts> parts_;
  std::vector<Message> notes_;
};

// Pictures side by side with words under each, for the stages of a fitting. Pictures may differ in size; each cell is
// as large as the largest. Refuses an empty sheet and one larger than 32768 pixels.
struct SheetItem {
  Image image;
  std::string caption;                  // UTF-8
  std::vector<std::string> below = {};  // smaller, broken into lines where it is long
  bool marked = false;                  // a red bar under the picture, and its words in red
};
struct SheetLayout {
  int columns = 0;            // 0: all in one row
  bool joined = false;        // no gap between neighbours: one picture (InRow)
  int width = 0, height = 0;  // of the sheet, what is left over beside and below; 0, or too little: as it comes
};
// How large so many pictures are, each with a caption of one line, that fill a sheet of the layout's size.
struct SheetCell {
  int width = 0, height = 0;
};
SheetCell sheetCell(int count, SheetLayout layout);
Result<Image> contactSheet(const std::vector<SheetItem>& items, SheetLayout layout = {},
                           std::vector<Message>* notes = nullptr);

}  // namespace karinui

#pragma once
// Writing on pictures: UTF-8 text with the fonts of this machine, Latin and Japanese. One thread at a time.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/result.h"
#include "karinui/view/image.h"

namespace karinui {

class Lettering {
 public:
  // Looks for fonts in the usual places. Never fails: without any font text is left out, and notes() says so.
  Lettering();
  explicit Lettering(const std::vector<std::string>& fontFiles);  // these only, the first that knows a letter draws it
  ~Lettering();
  Lettering(Lettering&&) noexcept;
  Lettering& operator=(Lettering&&) noexcept;

  // Writes one line with its baseline's left end at (x, y); sizePx is the height of the em.
  void write(Image& image, std::string_view utf8, double x, double y, double sizePx, Pixel colour);
  double width(std::string_view utf8, double sizePx);  // pixels

  // What could not be written so far: no font at all, or letters no font knows (drawn as an empty box). Emptied by
  // taking.
  std::vector<Message> takeNotes();

 private:
  struct Fonts;
  std::unique_ptr<Fonts> fonts_;
};

}  // namespace karinui

#pragma once
// What hangs in the air as pictures: the floating menu, choices, sentences and numbers. Pictures are kept by what they
// show, so that the same words are written once. One thread.
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "karinui/scene/overlay.h"
#include "karinui/view/boards.h"
#include "karinui/view/image.h"
#include "karinui/view/lettering.h"

namespace karinui::room {

using ImagePtr = std::shared_ptr<const Image>;

enum class Tone { Plain, Advice, Refused };

class BoardImages {
 public:
  // A panel with its buttons. Kept while it looks the same.
  ImagePtr panel(const SceneMenu& panel, int pixelsWide, Language language);
  // A line of text on a small plate, letters `letterPixels` high.
  ImagePtr word(const std::string& utf8, int letterPixels = 40);
  // Sentences below each other, broken at the width.
  struct Line {
    std::string text;
    Tone tone = Tone::Plain;
  };
  ImagePtr sentences(const std::vector<Line>& lines, int pixelsWide, int letterPixels);
  // Forgets what was not asked for since the last call.
  void tidy();
  // What no font could write.
  std::vector<Message> takeNotes() { return lettering_.takeNotes(); }

 private:
  struct Kept {
    ImagePtr image;
    bool used = true;
  };
  template <class Make>
  ImagePtr kept(const std::string& key, Make&& make);
  Lettering lettering_;
  std::map<std::string, Kept> kept_;
};

// Moves a board that faces the eye up until it is clear of the others.
void liftClear(Board& board, const std::vector<Board>& others);

// A line of text broken where it becomes wider than `pixels`: at spaces, else (Japanese) between letters.
std::vector<std::string> broken(Lettering& lettering, const std::string& utf8, double pixels, double letterPixels);

}  // namespace karinui::room

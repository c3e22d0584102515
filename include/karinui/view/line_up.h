#pragma once
// Fittings side by side in one picture: on one floor, at one scale, seen from one side, and turned together, each about
// its own upright axis. One thread at a time.
//   LineUp pair({{shirt, "cotton"}, {same, "silk"}}, {.width = 600, .height = 1000});
//   auto front = pair.draw();
//   auto sheet = pair.turns(8);
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "karinui/base/token.h"
#include "karinui/view/picture.h"

namespace karinui {

class LineUp {
 public:
  struct Figure {
    std::string name;                     // UTF-8, written below it
    std::vector<std::string> below = {};  // more words, smaller
    bool marked = false;                  // in red
  };
  // `frames` are those of the figures and outlive this. `each` is how one of them is drawn: its size, side and map; a
  // camera of its own is taken for all as it is. A map has one scale for all.
  LineUp(std::vector<Figure> figures, std::span<const SceneFrame> frames, PictureOptions each);

  // All of them, turned by so many radians, in rows of so many columns (0: one row). One alone that has
  // no name is the whole picture.
  Result<Image> draw(double turn = 0, int columns = 0, const Token& token = {});
  // A row for each figure, a column for each of so many turns of a whole one; a single figure takes two rows for many.
  Result<Image> turns(int count, const Token& token = {});
  // The picture is as large as this from now on, what is left over beside and below the figures (sheetCell).
  void fill(int width, int height) { fill_ = {width, height}; }
  // Keeps every figure in graphics memory, so that many pictures of few figures are quick.
  void keepAll() { easels_.resize(figures_.size()); }

  // What the last picture leaves out or could not show.
  const std::vector<Message>& notes() const { return notes_; }

 private:
  struct Easel {
    std::unique_ptr<Picture> picture;
    std::size_t shows = ~std::size_t{0};
  };
  Result<Image> see(std::size_t which, double turn, InRow row, bool legend);
  Result<Image> laidOut(const std::vector<SheetItem>& items, int columns);

  std::vector<Figure> figures_;
  std::span<const SceneFrame> frames_;
  PictureOptions each_;
  Camera camera_;           // about an axis at x = z = 0
  std::vector<Vec3> axes_;  // of the figures
  std::vector<Easel> easels_;
  std::pair<int, int> fill_{};
  std::vector<Message> notes_;
};

}  // namespace karinui

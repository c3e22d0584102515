#pragma once
// What lies over a picture and changes with every move of the hand: lines, words, the floating menu. Plain values; any
// thread. Metres; colours linear RGB.
#include <optional>
#include <string>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/scene/scene_frame.h"

namespace karinui {

// Where someone looks from, without any window: unit vectors, half the height of the picture at distance 1.
struct Viewpoint {
  Vec3 eye, right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};
  double tanHalf = 0.21, aspect = 1;
  double distance = 4;  // to what is looked at
  double points = 0;    // the view's height in device-independent pixels; 0: not known
};

// A board in space with buttons on it, facing the one who looks. Buttons are placed in the board's own metres from its
// lower left corner.
struct SceneMenu {
  struct Button {
    double left = 0, bottom = 0, width = 0, height = 0;
    std::string icon;  // name in scene/icon.h; empty: none
    Message label;
    bool hot = false, chosen = false, enabled = true;
  };
  Vec3 corner, across, upward;  // lower left; the whole width and height as vectors
  std::vector<Button> buttons;
};

struct SceneWord {
  Vec3 place;
  std::string text;  // UTF-8
};

struct SceneOverlay {
  std::vector<SceneLine> lines;
  std::vector<Vec3> dots, rings;  // filled, and hollow
  std::vector<SceneWord> words;
  std::vector<SceneMenu> panels;
};

// The same over the flat pattern, in metres on the table.
struct TableLine {
  std::vector<Flat> points;
  Colour colour{0.8f, 0.1f, 0.1f};
  bool dashed = false;
};
struct TableWord {
  Flat place;
  std::string text;
};
struct TableOverlay {
  std::vector<TableLine> lines;
  std::vector<Flat> dots, rings;
  std::vector<TableWord> words;
};

}  // namespace karinui

#pragma once
// Everything a key, a menu or the floating bar can ask for, told once: name, words, icon, usual key. A face (a window,
// a headset) only shows these. Constants; any thread.
#include <memory>
#include <span>
#include <string_view>

#include "karinui/base/message.h"

namespace karinui {

enum class Command {
  // What the hand holds.
  Select,
  Draw,
  Move,
  Sew,
  Cut,
  Pull,
  Reshape,
  Points,
  Notch,
  Dart,
  Line,
  Rectangle,
  Circle,
  RingSector,
  Polygon,
  Pin,
  Trace,
  // Where one looks from.
  ViewFront,
  ViewBack,
  ViewLeft,
  ViewRight,
  ViewOblique,
  ViewAll,
  // What is done at once.
  Undo,
  Redo,
  Settle,
  Cancel,
  Confirm,
  SelectAll,
  Remove,
  Duplicate,
  Mirror,
  Freeze,
  FlipSeam,
  Mend,
  BodyLines,
  HideArms,
  HideHands,
  HideHead,
  Section,
  SectionBack,
  SectionOn,
};

// What there must be before a command can be given. What a session alone knows (steps to undo, a gesture begun) it asks
// besides.
enum class Needs { Nothing, Body, BodyToDraw, Pieces, BodyAndPieces, ChosenPiece, ChosenSeam, ChosenThing, Scan };

class Gesture;
struct CommandInfo {
  Command command;
  std::string_view name;  // as key bindings say it: "draw"
  std::string_view icon;  // in scene/icon.h; empty: none
  std::string_view key;   // the usual one: "Space", "Ctrl+Z", "D"
  Message label, hint;    // a word or two; a sentence that teaches
  Needs needs = Needs::Nothing;
  std::unique_ptr<Gesture> (*gesture)() = nullptr;  // of a tool; null: done at once
  bool onBar = false;                               // a button of the floating bar, in this order
  std::string_view otherKey = {};                   // a second usual one
};
std::span<const CommandInfo> commands();  // one row each
const CommandInfo& info(Command command);
inline bool isTool(Command command) { return info(command).gesture != nullptr; }

}  // namespace karinui

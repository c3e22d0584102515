#pragma once
// Everything a key, a menu or the floating bar can ask for, told once: name, words, icon, usual key. A face (a window,
// a headset) only shows these. Constants; any thread.
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
  Pin,
  // What is done at once.
  Undo,
  Redo,
  Settle,
  Cancel,
  Confirm,
  Remove,
  Duplicate,
  Mirror,
  Freeze,
  FlipSeam,
  Mend,
  // Where one looks from.
  ViewFront,
  ViewBack,
  ViewLeft,
  ViewRight,
  ViewOblique,
  ViewAll,
  BodyLines,
};

struct CommandInfo {
  Command command;
  std::string_view name;           // as key bindings say it: "draw"
  std::string_view icon;           // in scene/icon.h; empty: none
  std::string_view key;            // the usual one: "Space", "Ctrl+Z", "D"
  Message label, hint;             // a word or two; a sentence that teaches
  std::string_view otherKey = {};  // a second usual one
};
std::span<const CommandInfo> commands();
const CommandInfo& info(Command command);
inline bool isTool(Command command) { return command <= Command::Pin; }

}  // namespace karinui

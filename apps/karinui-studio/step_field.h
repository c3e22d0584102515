#pragma once
// One field of a step as a person reads and types it: choices by their names, lengths in the person's unit, pieces and
// edges as they are called. What was not touched stays as it was, to the last digit; what scripts write is understood
// wherever one types. Fields too rich for that (lines on the body, outlines) show what they hold, and their script text
// while one types. GUI thread.
#include <functional>
#include <string>

#include "karinui/design/step_words.h"

class QWidget;

namespace karinui::studio {

struct StepField {
  std::string name;                    // as in scripts; also the box's object name
  QWidget* box = nullptr;              // owned by whom it is shown in
  std::function<std::string()> value;  // as scripts write it; empty: left out
};

// `value` is the field's text, empty where it has its default. `entered` is called when Return is struck in it.
StepField stepField(const Document& document, std::string_view operation, const FieldHelp& field,
                    const std::string& value, std::function<void()> entered);

}  // namespace karinui::studio

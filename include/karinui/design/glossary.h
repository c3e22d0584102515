#pragma once
// The one place that knows what a person calls what scripts, documents and JSON name by identifiers: bust_girth is
// "Bust girth", torso:waist@0.25 is "waist, left side", front.e3_right is "edge 3, right half, of front". Identifiers
// stay what they are in every text form; only what a person reads goes through here. Names that people gave are said as
// given, with spaces for the underscores that stand for them. Pure; any thread.
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/base/message.h"
#include "karinui/body/body.h"

namespace karinui {

enum class Term {
  Measure,        // measurementKeys()
  Landmark,       // Body::landmarks()
  Part,           // torso, left_arm …
  Level,          // chartLevels()
  Fabric,         // presets()
  Size,           // builtInSizes()
  OperationName,  // operationHelp()
  Field,          // "ease", or "line.cut" where an operation's own differs from the others'
  Value,          // of a field that has a few: yes, 2:1, woven, planes …
  Word            // what pieces, edges, lines and marks are called by the program itself: front, armhole, dart …
};
std::optional<Message> termSaid(Term kind, std::string_view identifier);  // nothing: there is no such identifier

// A field of an operation, as a label.
Message fieldSaid(std::string_view operation, std::string_view field);
// A place on the body: by its landmark, else by the nearest levels and the side.
Message placeSaid(const BodyPoint& place);
// The name of a piece, an edge, a line, a mark or a fabric: "sleeve_left", "e3_right", "cotton_2", and of words that
// belong to each other: "skirt_side_left" is "left side of skirt".
Message nameSaid(std::string_view name);
Message edgeSaid(std::string_view piece, std::string_view edge);
// The name of a fastening; what would be an edge of a piece, as "inner", is no edge here.
Message fasteningSaid(std::string_view name);

// The whole of `text` as one of the above, or as a list of them with commas; nothing: it is no identifier of ours.
// This is what Look and other faces put sentences' values through.
std::optional<Message> identifierSaid(std::string_view text);

// The way back, for what a person types: the identifier that is said so in either language (letters of any case);
// "左脇" is side_left. Nothing: no such word.
std::optional<std::string> identifierOf(std::string_view said);

// The name that a person means who types it: identifierOf(), else as typed, with underscores for spaces.
std::string nameTyped(std::string_view said);

// Messages one after the other: "a, b, c", in Japanese "a、b、c".
Message listSaid(const std::vector<Message>& all);

}  // namespace karinui

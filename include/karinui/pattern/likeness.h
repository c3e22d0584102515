#pragma once
// A piece and its symmetric copy, whose edges run the other way round, the last one first. Pure; any thread.
#include <optional>
#include <string>
#include <string_view>

#include "karinui/pattern/piece.h"

namespace karinui {

// What an edge of the piece, or of a hole of it, is called on the copy; nothing if the copy went its own way since.
std::optional<std::string> edgeOnCopy(const Piece& copy, const Piece& piece, std::string_view edge);

}  // namespace karinui

#pragma once
// A piece and its symmetric copy, whose edges run the other way round, the last one first. Pure; any thread.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "karinui/pattern/edit.h"
#include "karinui/pattern/piece.h"

namespace karinui {

// What an edge of the piece, or of a hole of it, is called on the copy; nothing if the copy went its own way since.
std::optional<std::string> edgeOnCopy(const Piece& copy, const Piece& piece, std::string_view edge);

// Where the outline and the holes of `copy` are the mirror image of the piece's, its edges get the names that
// mirrored() would give them, in `edges`, by which they came to be, too. False: they are not, and nothing is changed.
bool nameLikeImage(Piece& copy, EdgeMap& edges, const Piece& piece);

// Calls edges of the piece, also of its holes, as `names` says (from, to), in its marks and in `edges`, by which they
// came to be, too.
void renameEdges(Piece& piece, EdgeMap& edges, const std::map<std::string, std::string>& names);
// The edges of a part that a cut made: neither the whole's nor parts of them, in the order of the line.
std::vector<std::string> cutEdgesOf(const Piece& part, const Piece& whole, const EdgeMap& edges);
// Calls the edges of a part that a cut made by a name, with numbers where there are more.
void nameCutEdges(Piece& part, const Piece& whole, EdgeMap& edges, const std::string& name);

}  // namespace karinui

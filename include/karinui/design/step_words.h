#pragma once
// A step of the history as a person reads it: pieces, edges and seams by their names, lengths as "{0} mm" (which a face
// says in the person's own unit, see base/said_lengths.h), places of the body by levels and sides. Pure; any thread.
#include "karinui/design/glossary.h"
#include "karinui/design/script.h"

namespace karinui {

// By name; one that is not in the document by its number.
Message pieceSaid(const Document& document, const PieceRef& piece);
Message edgeSaid(const Document& document, const EdgeRef& edge);
// An edge of a piece by its name. One that has only a number ("e3") by how it is cut and where it lies, the grain
// upwards and left and right the wearer's: "left side", "hem"; alike ones of a piece are counted along its outline. It
// stays the same while the cloth drapes.
Message edgeNameSaid(const Document& document, const Piece& piece, std::string_view edge);
// For lists: "left side, sewn to back" where it has only a number.
Message edgeWithPartnerSaid(const Document& document, const Piece& piece, std::string_view edge);
// identifierSaid() where edges of this garment are known: "front.e3" is "left side of front".
std::optional<Message> identifierSaid(const Document& document, std::string_view identifier);
Message seamSaid(const Document& document, const SeamRef& seam);  // its own name, else its two sides
Message seamSaid(const Document& document, const Seam& seam);

// A field's value, given as its text form.
Message valueSaid(const Document& document, std::string_view operation, const FieldHelp& field, std::string_view value);
// All that matters of a step in one line, without the operation's name.
Message stepSaid(const Document& document, const Operation& operation);

// A sentence that shows what a script says, as it reads who has dialogs instead: "write symmetric=no for one alone" is
// "write “On both halves: No” for one alone". `english` is its key in the catalogue, `pattern` the words to be changed.
std::string withoutScript(std::string_view english, std::string_view pattern, Language language);

const OperationHelp& helpOf(const Operation& operation);  // of operationHelp()

}  // namespace karinui

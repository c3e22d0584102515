#pragma once
// A step of the history as a person reads it: pieces, edges and seams by their names, lengths as "{0} mm" (which a face
// says in the person's own unit, see base/said_lengths.h), places of the body by levels and sides. Pure; any thread.
#include "karinui/design/glossary.h"
#include "karinui/design/script.h"

namespace karinui {

// By name; one that is not in the document by its number.
Message pieceSaid(const Document& document, const PieceRef& piece);
Message edgeSaid(const Document& document, const EdgeRef& edge);
Message seamSaid(const Document& document, const SeamRef& seam);  // its own name, else its two sides
Message seamSaid(const Document& document, const Seam& seam);

// A field's value, given as its text form.
Message valueSaid(const Document& document, std::string_view operation, const FieldHelp& field, std::string_view value);
// All that matters of a step in one line, without the operation's name.
Message stepSaid(const Document& document, const Operation& operation);

const OperationHelp& helpOf(const Operation& operation);  // of operationHelp()

}  // namespace karinui

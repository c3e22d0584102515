#pragma once
// Edges whose length is linked to that of others: given by a formula that names an edge, itself or through variables.
// A link is kept among the document's variables under the edge's own name ("p4.hem"), which no variable can have. What
// a later step does to the edges of its formula it pulls along. Pure; any thread.
#include <optional>
#include <string>
#include <string_view>

#include "karinui/design/apply.h"

namespace karinui {

std::string linkName(const EdgeRef& edge);                     // of an edge by ids
std::optional<EdgeRef> linkedEdge(std::string_view variable);  // nothing: it is a plain variable
// Refuses a link that would go round in a circle, naming it.
Done checkLink(const Document& document, const EdgeRef& edge, const std::string& formula);
// After a length was given to an edge: its link is there where the formula names other edges, else there is none.
Document withLink(Document document, const EdgeRef& edge, const std::string& formula);
// After an edge was renamed: in all formulas and links too.
void renameInFormulas(Document& document, PieceId piece, const std::string& from, const std::string& to);
// Every linked edge as long as its formula says, after a step that led there from `before`. What cannot follow keeps
// its length and is told as advice. A link ends, and that is told, where one of its edges is gone or was parted: split,
// cut or opened by a dart.
Document linksFollowed(const Document& before, Document document, Context& context);

}  // namespace karinui

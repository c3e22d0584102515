#pragma once
// The same garment in another size or another fabric, to be looked at beside it. The document is left as it is.
#include "karinui/design/apply.h"

namespace karinui {

// The fabrics there are to cut from: the document's own, then the presets it has none of that name for.
std::vector<std::string> fabricNames(const Document& document);
// Every piece cut from this fabric.
SetFabric cutFrom(const Document& document, const std::string& fabric);

// The garment after one more operation, and at rest again where it hung before. The size that stands already is the
// garment itself. Long; any thread, with its own context.
Result<Document> variantOf(const Document& document, const Operation& change, Context& context);

// Why the garment does not hang at rest, to be written below its picture; nothing: it does.
std::optional<Message> unrestSaid(const Document& document);

}  // namespace karinui

#pragma once
#include "karinui/design/document.h"

namespace karinui {

// Whether a document that was read from a file is one that operations could have led to, in all that the rest of the
// program takes for granted: outlines closed and clear of themselves, names that exist, fractions and numbers in range.
// A seal does not say so: whoever can write the file can seal it.
bool soundContent(const Document& document);
// The same of how a piece is bent.
bool soundForm(const Form& form);

}  // namespace karinui

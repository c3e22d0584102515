#pragma once
// Layers (optional content, PDF 1.7, 8.11) put into a PDF that cairo wrote, which knows none: every page was drawn once
// for each layer, and the drawings become one page whose parts a viewer shows or hides. Only the end of the file is
// new.
#include <string>
#include <vector>

namespace karinui {

// `names`, UTF-8: of the layers; an empty name is always shown. The file's pages are those of the first page in the
// layers' order, then those of the second …; a file that is not so is left as it is. Viewers are asked not to scale.
std::string layered(std::string pdf, const std::vector<std::string>& names);

}  // namespace karinui

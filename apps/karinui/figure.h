#pragma once
// Where a body comes from on the command line: a built-in size's name, a file of measures, or a body's file.
#include "karinui/design/operation.h"
#include "open_document.h"

namespace karinui::app {

// The operation that chooses this body; a file's mesh becomes a blob of the document.
// `wrap` puts a skin over a scan with holes.
Result<SetBody> bodyOperation(OpenDocument& opened, const std::string& sizeOrFile, bool wrap = false);

// A file of measures: those that a mannequin can be made to. What is left out is said on stderr.
Result<Measurements> readFigureMeasures(Program& program, const std::string& path);

// A body file, read. What was guessed about it (its unit) and what is wrong with it is said on stderr.
Result<Body::Parts> readFigure(Program& program, Workers& workers, const std::string& path, bool wrap);

}  // namespace karinui::app

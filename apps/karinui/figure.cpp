#include "figure.h"

#include <algorithm>
#include <filesystem>

#include "karinui/exchange/read_body.h"

namespace karinui::app {

Result<Body::Parts> readFigure(Program& program, Workers& workers, const std::string& path, bool wrap) {
  BodyReadOptions options;
  options.wrap = wrap;
  Result<ImportedBody> read = readBody(path, options, workers, program.console.token());
  if (!read) return read.error();
  for (const Message& note : read->notes) program.console.note(note);
  Body::Parts parts;
  parts.name = std::filesystem::path(path).stem().string();
  parts.mesh = std::move(read->mesh);
  return parts;
}

Result<SetBody> bodyOperation(OpenDocument& opened, const std::string& sizeOrFile) {
  SetBody chosen;
  const auto sizes = builtInSizes();
  if (std::find(sizes.begin(), sizes.end(), sizeOrFile) != sizes.end()) {
    chosen.size = sizeOrFile;
    return chosen;
  }
  Result<Body::Parts> parts = readFigure(opened.program(), opened.context().workers, sizeOrFile, false);
  if (!parts) return parts.error();
  Result<std::string> blob = opened.file().blobs().put(packBody(*parts));
  if (!blob) return blob.error();
  chosen.mesh = std::move(*blob);
  return chosen;
}

}  // namespace karinui::app

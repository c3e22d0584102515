#include "figure.h"

#include <algorithm>
#include <filesystem>

#include "karinui/body/sizes.h"
#include "karinui/design/glossary.h"
#include "karinui/exchange/formats.h"
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

Result<Measurements> readFigureMeasures(Program& program, const std::string& path) {
  const Result<MeasuresRead> read = readMeasures(path);
  if (!read) return read.error();
  Measurements made = forMannequin(read->measures);
  std::vector<Message> left;
  for (const auto& [key, value] : read->measures.value)
    if (!made.value.contains(key)) left.push_back(say("{0}", key));
  if (!left.empty()) program.console.note(say("Left out, as no mannequin can be made to it: {0}.", listSaid(left)));
  for (const auto& unread : read->unread) program.console.note(unread.why);
  for (const std::string& name : read->unknown)
    program.console.note(say("“{0}” has no counterpart here and is left out.", name));
  return made;
}

Result<SetBody> bodyOperation(OpenDocument& opened, const std::string& sizeOrFile, bool wrap) {
  SetBody chosen;
  const auto sizes = builtInSizes();
  if (const std::string size = plainSize(sizeOrFile); std::find(sizes.begin(), sizes.end(), size) != sizes.end()) {
    chosen.size = size;
    return chosen;
  }
  if (contentOf(sizeOrFile) == FileContent::Measures || endingOf(sizeOrFile) == "json") {  // no body is JSON
    const Result<Measurements> measures = readFigureMeasures(opened.program(), sizeOrFile);
    if (!measures) return measures.error();
    chosen.sex = measures->sex;
    for (const auto& [key, value] : measures->value) chosen.set.push_back({key, {value}});
    return chosen;
  }
  if (contentOf(sizeOrFile) != FileContent::Body)
    return unreadable(sizeOrFile, {FileContent::Measures, FileContent::Body});
  Result<Body::Parts> parts = readFigure(opened.program(), opened.context().workers, sizeOrFile, wrap);
  if (!parts) return parts.error();
  Result<std::string> blob = opened.file().blobs().put(packBody(*parts));
  if (!blob) return blob.error();
  chosen.mesh = std::move(*blob);
  return chosen;
}

}  // namespace karinui::app

// Files in and out of a session.
#include "karinui/base/file.h"
#include "karinui/design/script.h"
#include "karinui/design/steps_of.h"
#include "karinui/exchange/read_body.h"
#include "karinui/exchange/read_pattern.h"
#include "session/room.h"

namespace karinui {

namespace {

Done patternInto(Room& room, const std::filesystem::path& file, const Token& token) {
  if (file.extension() == ".ops") {
    const Result<std::string> bytes = readFile(file);
    if (!bytes) return bytes.error();
    const auto lines = parseScript(*bytes);
    if (!lines) return inFile(file, lines.error());
    for (std::size_t i = 0; i < lines->size(); ++i) {
      token.progress(static_cast<double>(i) / static_cast<double>(lines->size()), say("Playing the script"));
      if (const auto step = room.perform((*lines)[i].operation, token); !step)
        return inFile(file, {step.error().kind, say("Line {0}: {1}", (*lines)[i].number, step.error().what)});
    }
    return {};
  }
  const Result<Pattern> pattern = readPattern(file);
  if (!pattern) return pattern.error();
  for (Operation& operation : stepsOf(*pattern, room.file().document()))
    if (const auto step = room.perform(std::move(operation), token); !step) return step.error();
  return {};
}

Done bodyInto(Room& room, const std::filesystem::path& file, const Token& token, std::vector<Message>& notes) {
  Result<ImportedBody> read = readBody(file, {}, room.workers(), token);
  if (!read) return read.error();
  notes = read->notes;
  Body::Parts parts;
  parts.name = file.stem().string();
  parts.mesh = std::move(read->mesh);
  // Its bytes go into the document's file.
  if (const Done draft = room.beginDraft(parts.name); !draft) return draft;
  const Result<std::string> blob = room.file().blobs().put(packBody(parts));
  if (!blob) return blob.error();
  SetBody choice;
  choice.mesh = *blob;
  const auto step = room.perform(std::move(choice), token);
  return step ? Done() : Done(step.error());
}

}  // namespace

Done importPatternInto(Room& room, const std::filesystem::path& file, const Token& token) {
  if (const Done draft = room.beginDraft(file.stem().string()); !draft) return draft;
  const Done done = patternInto(room, file, token);
  room.dropEmptyDraft();
  return done;
}

Done importBodyInto(Room& room, const std::filesystem::path& file, const Token& token, std::vector<Message>& notes) {
  const Done done = bodyInto(room, file, token, notes);
  room.dropEmptyDraft();
  return done;
}

}  // namespace karinui

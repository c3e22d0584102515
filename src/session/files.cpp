// Files in and out of a session.
#include "karinui/base/file.h"
#include "karinui/design/make_up.h"
#include "karinui/design/script.h"
#include "karinui/design/steps_of.h"
#include "karinui/exchange/read_body.h"
#include "karinui/exchange/read_pattern.h"
#include "karinui/exchange/read_print.h"
#include "session/document_worker.h"

namespace karinui {

namespace {

Done patternInto(DocumentWorker& documentWorker, const std::filesystem::path& file, std::string_view unit,
                 const Token& token, std::vector<Message>& notes, std::optional<GuessedUnit>* guessed) {
  if (contentOf(file) == FileContent::Script) {
    const Result<std::string> bytes = readFile(file);
    if (!bytes) return bytes.error();
    const auto lines = parseScript(*bytes);
    if (!lines) return inFile(file, lines.error());
    for (std::size_t i = 0; i < lines->size(); ++i) {
      token.progress(static_cast<double>(i) / static_cast<double>(lines->size()), say("Playing the script"));
      if (const auto step = documentWorker.perform((*lines)[i].operation, token); !step)
        return inFile(file, {step.error().kind, say("Line {0}: {1}", (*lines)[i].number, step.error().what)});
    }
    return {};
  }
  if (contentOf(file) != FileContent::Pattern) return unreadable(file, {FileContent::Pattern, FileContent::Script});
  const Result<CadPattern> read = readPatternSize(file, {}, fileFormats(), {}, unit);
  if (!read) return read.error();
  const Document& document = documentWorker.file().document();
  Pattern pattern = read->pattern;
  if (document.body.chosen()) {
    Context context = documentWorker.context(token);
    const Result<BodyPtr> figure = bodyOf(document, context);
    if (!figure) return figure.error();
    pattern = raisedTo(**figure, std::move(pattern)).pattern;
  }
  notes = read->notes;
  for (Message& unknown : unknownFabricsSaid(pattern, document, read->fabrics)) notes.push_back(std::move(unknown));
  std::size_t performed = 0;
  for (Operation& operation :
       stepsOf(pattern, document, read->grading, read->cutting, &documentWorker.file().blobs(), read->fabrics)) {
    if (const auto step = documentWorker.perform(std::move(operation), token); !step) {
      for (; performed > 0; --performed)  // a pattern comes whole or not at all
        if (const auto back = documentWorker.undo(Token()); !back) return back.error();
      return step.error();
    }
    ++performed;
  }
  if (guessed && read->guessedUnit > 0 && performed > 0) {
    double longest = 0;
    for (const auto& [id, piece] : read->pattern.pieces) {
      const Flat size = boxOf(piece->outline.flattened(1e-4)).size();
      longest = std::max({longest, size.u, size.v});
    }
    *guessed = GuessedUnit{file, read->guessedUnit, longest, performed, documentWorker.file().steps().back().seq};
  }
  return {};
}

Done bodyInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const BodyReadOptions& options,
              const Token& token, std::vector<Message>& notes) {
  Result<ImportedBody> read = readBody(file, options, documentWorker.workers(), token);
  if (!read) return read.error();
  notes = read->notes;
  Body::Parts parts;
  parts.name = file.stem().string();
  parts.mesh = std::move(read->mesh);
  // Its bytes go into the document's file.
  if (const Done draft = documentWorker.beginDraft(parts.name); !draft) return draft;
  const Result<std::string> blob = documentWorker.file().blobs().put(packBody(parts));
  if (!blob) return blob.error();
  SetBody choice;
  choice.mesh = *blob;
  const auto step = documentWorker.perform(std::move(choice), token);
  return step ? Done() : Done(step.error());
}

}  // namespace

Done importPatternInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const Token& token,
                       std::vector<Message>& notes, std::optional<GuessedUnit>* guessed) {
  if (const Done draft = documentWorker.beginDraft(file.stem().string()); !draft) return draft;
  const Done done = patternInto(documentWorker, file, {}, token, notes, guessed);
  documentWorker.dropEmptyDraft();
  return done;
}

Done readAgainIn(DocumentWorker& documentWorker, const GuessedUnit& guessed, std::string_view unit, const Token& token,
                 std::vector<Message>& notes) {
  const auto& steps = documentWorker.file().steps();
  if (steps.empty() || steps.back().seq != guessed.last)
    return refused(
        say("The garment has gone on since; undo up to “{0}”, and read it again.", guessed.file.filename().string()));
  for (std::size_t k = 0; k < guessed.steps; ++k)
    if (const auto back = documentWorker.undo(token); !back) return back.error();
  const Done done = patternInto(documentWorker, guessed.file, unit, token, notes, nullptr);
  if (!done)  // what was there stays
    if (const Done back = documentWorker.goTo(guessed.last, 0, token); !back) return back;
  return done;
}

Done importPrintInto(DocumentWorker& documentWorker, const std::filesystem::path& file, SetLook look,
                     const Token& token) {
  const auto image = readPrint(file, token);
  if (!image) return image.error();
  if (const Done draft = documentWorker.beginDraft({}); !draft) return draft;
  const Result<std::string> blob = documentWorker.file().blobs().put(packPrint(*image));
  if (!blob) return blob.error();
  look.photo = *blob;
  look.print = PrintKind::Photo;
  const auto step = documentWorker.perform(std::move(look), token);
  return step ? Done() : Done(step.error());
}

Done importScanInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const Token& token,
                    const std::optional<Flat>& corner, std::vector<Message>& notes) {
  const auto scan = readScan(file, token);
  if (!scan) return scan.error();
  if (const auto note = scan->shrunk()) notes.push_back(*note);
  if (const Done draft = documentWorker.beginDraft(file.stem().string()); !draft) return draft;
  const Result<std::string> blob = documentWorker.file().blobs().put(packPrint(scan->image));
  if (!blob) return blob.error();
  LayUnderlay lay;
  lay.photo = *blob;
  if (corner) {
    const double wide = kUsualScan * scan->image.width, high = kUsualScan * scan->image.height;
    lay.at = *corner - Flat{0.5 * wide, 0.5 * high};
  }
  const auto step = documentWorker.perform(std::move(lay), token);
  return step ? Done() : Done(step.error());
}

Done importBodyInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const BodyReadOptions& options,
                    const Token& token, std::vector<Message>& notes) {
  const Done done = bodyInto(documentWorker, file, options, token, notes);
  documentWorker.dropEmptyDraft();
  return done;
}

}  // namespace karinui

#include "make_document.h"

#include <unistd.h>

#include <filesystem>

#include "json_answers.h"

namespace karinui::app {

namespace fs = std::filesystem;

int makeDocument(Program& program, const std::string& wanted, bool overwrite,
                 const std::function<Result<void>(OpenDocument&)>& fill,
                 const std::function<void(Json& answer, std::string& words)>& tell) {
  std::error_code trouble;
  if (!overwrite && fs::exists(wanted, trouble)) {
    return program.console.refuse(
        refused(say("“{0}” is there already. Choose another name, or say --overwrite.", wanted)));
  }
  if (fs::is_directory(wanted, trouble))
    return program.console.refuse(
        storageError(say("\"{0}\" cannot be written: it is a folder. Give a file's name.", wanted)));
  const fs::path folder = fs::path(wanted).has_parent_path() ? fs::path(wanted).parent_path() : fs::path(".");
  if (!fs::is_directory(folder, trouble))
    return program.console.refuse(
        storageError(say("\"{0}\" cannot be written: there is no such folder. Make it first.", wanted)));
  if (::access(folder.c_str(), W_OK) != 0)
    return program.console.refuse(storageError(
        say("“{0}” cannot be made: the folder “{1}” may not be written. Choose another.",
            fs::path(wanted).filename().string(), fs::absolute(folder, trouble).lexically_normal().string())));
  const std::string part = wanted + ".part";
  fs::remove(part, trouble);
  int exit = kDone;
  Json answer;
  std::string words;
  {
    Result<DocumentFile> file = DocumentFile::create(part);
    if (!file) return program.console.refuse(file.error());
    OpenDocument opened(program, std::move(*file));
    if (const Result<void> filled = fill(opened); !filled) {
      exit = program.console.refuse(filled.error());
    } else {
      if (!opened.settled()) exit = kNotSettled;
      const Document& document = opened.document();
      answer = {{"document", wanted},
                {"operations", document.operations},
                {"pieces", document.pattern.pieces.size()},
                {"seams", document.pattern.seams.size()},
                {"hash", hash(document)},
                {"drape_hash", drapeHash(document)}};
      answer.update(restJson(document, opened.settled()));
      words = program.console.said(say("{0}: {1} {1|operation|operations}, {2} {2|piece|pieces}, {3} {3|seam|seams}",
                                       wanted, written(static_cast<long long>(document.operations)),
                                       document.pattern.pieces.size(), document.pattern.seams.size()));
      if (tell) tell(answer, words);
    }
  }
  if (exit == kRefused) {
    fs::remove(part, trouble);
    return exit;
  }
  fs::rename(part, wanted, trouble);
  if (trouble) {
    const Error why = storageError(say("“{0}” could not be written: {1}", wanted, trouble.message()));
    fs::remove(part, trouble);
    return program.console.refuse(why);
  }
  dropJournal(wanted);
  program.console.answer(answer, words);
  return exit;
}

}  // namespace karinui::app

#pragma once
// An open document and what operations on it need. One per command.
#include <optional>
#include <string>

#include "commands.h"
#include "karinui/design/history.h"
#include "karinui/design/script.h"
#include "karinui/scene/scene_frame.h"
#include "karinui/session/look_of.h"

namespace karinui::app {

class OpenDocument {
 public:
  OpenDocument(Program& program, DocumentFile file)
      : program_(program), workers_(program.threads), file_(std::move(file)) {
    listenTo(program.console.token());
  }
  void tellRemarks();  // what was found in the file since they were told last
  // What follows is told to this token and stopped by it.
  void listenTo(const Token& token) {
    context_.emplace(Context{workers_, token, file_.blobs(), bodies_, {}, {}});
    context_->advise = [this](const Advice& advice) {
      program_.console.note(advice.mend ? say("{0} Mended by: {1}", advice.what, text(*advice.mend)) : advice.what);
    };
  }

  Program& program() { return program_; }
  DocumentFile& file() { return file_; }
  const Document& document() const { return file_.document(); }
  Context& context() { return *context_; }

  // Records one operation; says on stderr what a drape or a pull came to. `settled` becomes false for one that did not
  // rest. The first Ctrl-C stops a drape where the cloth is, which is recorded; `stopped` tells.
  Result<Step> perform(Operation operation);
  Result<Step> performWith(Operation operation, Context& context);  // with another's blobs
  // Makes a step another one. Says so where the last drape, done again, did not rest.
  Done amend(std::size_t step, Operation operation);
  bool settled() const { return settled_; }
  bool stopped() const { return stopped_; }
  Result<SceneFrame> scene();  // the garment on its body
  Prints prints();

 private:
  void tellUnsettled();

  Program& program_;
  Workers workers_;
  Bodies bodies_;
  DocumentFile file_;
  std::optional<Context> context_;
  PrintShelf shelf_;
  bool settled_ = true, stopped_ = false;
  std::size_t remarksTold_ = 0;
};

// Opens a document and runs `work` on it; the exit status is what `work` gives, or that of a refusal.
int withDocument(Program& program, const std::string& path, bool forReading,
                 const std::function<int(OpenDocument&)>& work);

}  // namespace karinui::app

#include "open_document.h"

#include "karinui/design/sewing.h"
#include "karinui/session/scene_of.h"

namespace karinui::app {

Result<Step> OpenDocument::perform(Operation operation) {
  if (context_->stop) return performWith(std::move(operation), *context_);  // whoever set it stops it
  StopRequest stop;
  program_.console.stopFirst(&stop);
  context_->stop = &stop;
  Result<Step> step = performWith(std::move(operation), *context_);
  context_->stop = nullptr;
  program_.console.stopFirst(nullptr);
  stopped_ = step && stop.asked();
  return step;
}

Result<Step> OpenDocument::performWith(Operation operation, Context& context) {
  program_.console.newJob();
  const bool rests = std::holds_alternative<DrapePieces>(operation) || std::holds_alternative<PullCloth>(operation);
  Result<Step> step = file_.perform(std::move(operation), context);
  if (const auto* sew = step ? std::get_if<SewEdges>(&step->operation) : nullptr)
    for (const auto& told :
         {brokenRun(document(), sew->a), brokenRun(document(), sew->b), longerSide(document(), *sew)})
      if (told) program_.console.note(*told);
  if (!step || !rests || !document().drape.last) return step;
  const SettleReport& report = *document().drape.last;
  settled_ = settled_ && (report.settled || std::holds_alternative<PullCloth>(step->operation));
  tellUnsettled();
  for (const PieceId id : report.toActivate)
    if (const Piece* piece = document().find(id))
      program_.console.note(
          say("“{0}” stood still, but what is sewn to it pulls at it anew: drape it, too.", piece->name));
  return step;
}

Done OpenDocument::amend(std::size_t step, Operation operation) {
  program_.console.newJob();
  if (Done done = file_.amend(step, std::move(operation), *context_); !done) return done;
  settled_ = !document().drape.last || document().drape.last->settled;
  tellUnsettled();
  return {};
}

void OpenDocument::tellUnsettled() {
  if (const auto& last = document().drape.last)
    if (const auto advice = adviceOn(*last)) program_.console.note(*advice);
}

void OpenDocument::tellRemarks() {
  for (; remarksTold_ < file_.remarks().size(); ++remarksTold_) program_.console.note(file_.remarks()[remarksTold_]);
}

Prints OpenDocument::prints() {
  return [this](const std::string& photo) { return shelf_.find(photo, file_.blobs()); };
}

Result<SceneFrame> OpenDocument::scene() {
  if (!document().body.chosen()) return sceneOf(document(), nullptr, prints());
  const Result<BodyPtr> body = bodyOf(document(), *context_);
  if (!body) return body.error();
  return sceneOf(document(), body->get(), prints());
}

int withDocument(Program& program, const std::string& path, bool forReading,
                 const std::function<int(OpenDocument&)>& work) {
  Result<DocumentFile> file = forReading ? DocumentFile::openForReading(path) : DocumentFile::open(path);
  if (!file) return program.console.refuse(file.error());
  OpenDocument opened(program, std::move(*file));
  opened.tellRemarks();
  const int exit = work(opened);
  opened.tellRemarks();  // of what was read meanwhile
  return exit;
}

}  // namespace karinui::app

#pragma once
// The document and what working on it needs, as the worker thread has it: nothing here is touched by the
// hand's thread while a task runs.
#include <filesystem>
#include <memory>

#include "karinui/design/drape.h"
#include "karinui/design/history.h"
#include "karinui/session/session.h"

namespace karinui {

// Everything the caller's thread is told after a step.
struct DocumentState {
  SnapshotPtr snapshot;
  std::vector<Step> steps, undone, otherBranches;
  std::filesystem::path path;
  bool readOnly = false;
  std::vector<Advice> advice = {};  // on what was done since the last time
};

class DocumentWorker {
 public:
  DocumentWorker(DocumentFile file, const SessionOptions& options, std::shared_ptr<Bodies> bodies,
                 std::shared_ptr<Workers> workers, bool readOnly = false)
      : file_(std::move(file)),
        options_(options),
        bodies_(std::move(bodies)),
        workers_(std::move(workers)),
        readOnly_(readOnly) {}

  // Published while a drape is worked out: the garment as it stands then, some times a second.
  std::function<void(SnapshotPtr)> predicted;

  DocumentFile& file() { return file_; }
  bool readOnly() const { return readOnly_; }
  // The first step of a document without a file makes it a draft; `stop` stops a drape where it is (null: nobody does).
  Result<Step> perform(Operation operation, const Token& token, StopRequest* stop = nullptr);
  Result<Step> undo(const Token& token);
  Result<Step> redo(const Token& token);
  Done goTo(std::uint64_t seq, const Token& token);
  Done amend(std::size_t which, Operation operation, const Token& token);
  DocumentState state(const Token& token);
  SnapshotPtr snapshotAfter(std::uint64_t seq, const Token& token);           // null: not to be had
  Result<SnapshotPtr> after(const Operation& operation, const Token& token);  // without doing it
  Result<SnapshotPtr> onFigure(const SetBody& body, const Token& token);      // on a figure that is kept nowhere
  Result<Vec3> pullTo(const PullPreview& pull, const Token& token, SnapshotPtr& shown);
  void letGo() { pull_.reset(); }
  Done moveTo(const std::filesystem::path& path);  // see Session::saveAs
  Done beginDraft(const std::string& about);       // a file, where there is none and drafts are kept
  void dropEmptyDraft();                           // a draft begun here in which nothing was done leaves no file
  Context context(const Token& token);
  Workers& workers() { return *workers_; }

 private:
  SnapshotPtr fitted(Document document, const Token& token);
  DocumentFile file_;
  SessionOptions options_;
  std::shared_ptr<Bodies> bodies_;
  std::shared_ptr<Workers> workers_;
  bool readOnly_ = false;
  bool begunDraft_ = false;
  std::vector<Advice> advice_;
  struct Pulling {
    PieceId piece;
    Flat at;
    LivePull live;
  };
  std::unique_ptr<Pulling> pull_;
};

// Whether a document lies in the drafts folder.
bool isDraft(const SessionOptions& options, const std::filesystem::path& path);

// Files in and out (session's second thread).
Done importPatternInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const Token& token);
Done importBodyInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const Token& token,
                    std::vector<Message>& notes);

}  // namespace karinui

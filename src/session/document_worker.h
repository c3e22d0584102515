#pragma once
// The document and what working on it needs, as the worker thread has it: nothing here is touched by the
// hand's thread while a task runs.
#include <deque>
#include <filesystem>
#include <memory>

#include "karinui/design/drape.h"
#include "karinui/design/history.h"
#include "karinui/exchange/read_body.h"
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
        readOnly_(readOnly),
        opened_(newestOf(file_)) {}

  // Published while a drape is worked out, and while the figure is on its way to another pose: the garment as it stands
  // then, some times a second.
  std::function<void(SnapshotPtr)> predicted;

  DocumentFile& file() { return file_; }
  bool readOnly() const { return readOnly_; }
  // The first step of a document without a file makes it a draft; `stop` stops a drape where it is (null: nobody does).
  Result<Step> perform(Operation operation, const Token& token, StopRequest* stop = nullptr);
  Result<Step> undo(const Token& token);
  Result<Step> redo(const Token& token);
  // Whether a drape that follows the head, and was there when the document was opened, came by itself after the step
  // there: nothing of that is written, but it drapes what that step disturbed and nothing that was at rest.
  bool cameByItself(const Step& drape, const Token& token);
  // Redo walks on from there to `towards`, a later step of its branch; 0: as far as it did, if it is on the present
  // one.
  Done goTo(std::uint64_t seq, std::uint64_t towards, const Token& token);
  Done amend(std::size_t which, Operation operation, const Token& token);
  DocumentState state(const Token& token);
  SnapshotPtr snapshotAfter(std::uint64_t seq, const Token& token);  // null: not to be had
  // The garment after an operation, without doing it. Where the cloth is to settle, what was cut otherwise is first
  // carried along (carried_shape.h); settleAfter() then drapes it as will be done by itself after the step, telling
  // `predicted` of it once the cloth is as fine as it is shown.
  Result<SnapshotPtr> after(const OperationPreview& preview, const Token& token);
  Result<SnapshotPtr> settleAfter(const std::set<PieceId>& live, const Token& token);
  Result<SnapshotPtr> onFigure(const SetBody& body, const Token& token);  // on a figure that is kept nowhere
  Result<Vec3> pullTo(const PullPreview& pull, const Token& token, SnapshotPtr& shown);
  void letGo() { pull_.reset(); }
  Done moveTo(const std::filesystem::path& path);  // see Session::saveAs
  Done beginDraft(const std::string& about);       // a file, where there is none and drafts are kept
  void dropEmptyDraft();                           // a draft begun here in which nothing was done leaves no file
  Context context(const Token& token);
  Workers& workers() { return *workers_; }

 private:
  static std::uint64_t newestOf(const DocumentFile& file);
  std::filesystem::path draftPath(const std::string& name, int n) const;  // `n`: of those that are called so
  void nameAfterGarment(const Operation* by);  // a draft begun here; `by`: the step that was just done
  Prints prints();
  SnapshotPtr fitted(Document document, const Token& token);
  PoseOnlooker onlooker(const Token& token);
  DocumentFile file_;
  PrintShelf shelf_;
  SessionOptions options_;
  std::shared_ptr<Bodies> bodies_;
  std::shared_ptr<Workers> workers_;
  bool readOnly_ = false;
  std::uint64_t opened_ = 0;  // the newest step that was there
  bool begunDraft_ = false;
  std::optional<Operation> madeBy_;  // the step that made the first pieces of a draft begun here
  std::string garmentName_;          // what the draft was called after them
  std::vector<Advice> advice_;
  struct Pulling {
    PieceId piece;
    Flat at;
    LivePull live;
    SnapshotPtr start;
  };
  std::unique_ptr<Pulling> pull_;
  SnapshotPtr latest_;             // of the document as it is; null: it was not asked for yet
  std::optional<Document> after_;  // of the preview whose cloth is to settle
  bool onlyFine_ = false;          // what is published of a drape
  // The last drapes by what they depend on: what a preview came to need not be worked out again for its step.
  Result<DrapeOutcome> draped(const Document& document, const DrapePieces& drape, Context& own);
  std::deque<std::pair<std::string, DrapeOutcome>> drapes_;  // newest first
};

// Whether a document lies in the drafts folder.
bool isDraft(const SessionOptions& options, const std::filesystem::path& path);

// Files in and out (session's second thread).
// `guessed` (may be null): where the file's unit was guessed, what of it.
Done importPatternInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const Token& token,
                       std::vector<Message>& notes, std::optional<GuessedUnit>* guessed = nullptr);
// The pattern once more in another unit, in place of the steps that made it.
Done readAgainIn(DocumentWorker& documentWorker, const GuessedUnit& guessed, std::string_view unit, const Token& token,
                 std::vector<Message>& notes);
Done importPrintInto(DocumentWorker& documentWorker, const std::filesystem::path& file, SetLook look,
                     const Token& token);
// `corner` is the upper right one; where it is not said the scan begins where pieces do.
Done importScanInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const Token& token,
                    const std::optional<Flat>& corner, std::vector<Message>& notes);
Done importBodyInto(DocumentWorker& documentWorker, const std::filesystem::path& file, const BodyReadOptions& options,
                    const Token& token, std::vector<Message>& notes);

}  // namespace karinui

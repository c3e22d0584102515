#pragma once
// What a session keeps between two moves of the hand. The caller's thread only, but for `documentWorker`. Its work lies
// in files by what is done: steps.cpp, settling.cpp, preview_requests.cpp, documents.cpp.
#include "karinui/base/latest.h"
#include "karinui/session/session.h"
#include "session/document_worker.h"
#include "session/figure_trial.h"
#include "session/latest_request.h"
#include "session/settle_schedule.h"
#include "session/task_queue.h"

namespace karinui {

struct Session::Impl {
  SessionOptions options;
  std::shared_ptr<Bodies> bodies;
  std::shared_ptr<Workers> workers;
  std::shared_ptr<DocumentWorker> documentWorker;  // the worker thread only, once the session has begun

  DocumentState state;
  SnapshotPtr preview;            // what a drag or a drape under way would come to
  Latest<SnapshotPtr> predicted;  // from the other thread
  TableLayout table;
  Selection selection;
  Command tool = Command::Select;
  std::unique_ptr<Gesture> gesture;
  Language language = Language::English;
  SetLength::Keep keepWished = SetLength::Keep::Auto;  // for the chosen edge
  bool inches = false;
  ToolOptions toolOptions;
  std::optional<Viewpoint> viewpoint;
  std::optional<Command> hot;
  bool onCross = false;      // the pointer is on the mark of a crossed seam
  bool onMenu = false;       // the button was pressed on the menu
  std::size_t snapped = 0;   // what the hand has snapped to (Handling::snap)
  std::uint32_t clicks = 0;  // how often it has
  KeyboardPointer keyboard;
  ViewCut viewCut;
  std::optional<Command> viewAsked;
  std::optional<Operation> asked;
  std::optional<std::filesystem::path> damaged;   // that was not opened
  std::optional<GuessedUnit> guessedUnit;         // that nobody was told yet
  std::optional<std::filesystem::path> openBody;  // that was not taken, for its surface has holes
  bool poseStopped = false;                       // by the person, while the figure is on its way
  std::optional<SetBody> figureAsked;             // whose steps are being played again
  bool past = false;                              // steps are being played again, and what is shown is from before
  std::optional<Flat> drawnAt;                    // where the next new piece comes to lie on the table
  std::vector<Notice> notices;
  std::vector<std::string> dropMenuSaid;  // what a drop menu said before the step: it is not told again as advice
  SessionChanges changes;
  BodyPtr ready;  // for which makeReady() was done already

  std::vector<Advice> advice;  // that still holds
  bool linesShown = false;     // of the body

  SettleSchedule schedule;
  LatestRequest<PreviewRequest> previews;
  FigureTrial trial;

  // Steps that were changed: where one stood before and after, so that undo and redo can go between the two ways.
  struct Amended {
    std::uint64_t before, after;
    std::uint64_t tip = 0;  // as far as redo went on from `after` when undo left it
  };
  std::vector<Amended> amended;

  int longWorks = 0;            // under way
  std::uint64_t documents = 0;  // that came and went: what was asked about another is not told

  TaskQueue tasks;  // last: it stops before anything it uses goes

  explicit Impl(SessionOptions options);
  GestureContext context() const {
    return {seen(), &table, language, inches, toolOptions, linesShown, &selection.pieces};
  }

  // The garment with what of it is drawn.
  SnapshotPtr seen() const;

  // Whether marks of crossed seams are shown, to be clicked.
  bool turnsCrossed() const { return (tool == Command::Select || tool == Command::Sew) && !gesture->begun(); }
  const std::vector<CrossedSeam>& crossed() const {  // found once for a garment, not for each of its pictures
    if (crossedOf_ != state.snapshot) crossed_ = crossedSeams(*state.snapshot), crossedOf_ = state.snapshot;
    return crossed_;
  }

  void choose(Selection chosen);
  Selection withEdge(const Selection& before, Selection chosen);
  bool has(Needs needs) const;

  // The ends of the chosen edge, and of its image on the other half, when its length is typed. Found once for a garment
  // and an edge.
  struct EdgeEnds {
    SnapshotPtr of;
    std::optional<EdgeNear> edge;
    SetLength::Keep wished = SetLength::Keep::Auto, keep = SetLength::Keep::Start;
    bool bothHalves = false;
    std::vector<Flat> stay, move;  // on the paper of the edge's piece
  };
  const EdgeEnds& edgeEnds() const;
  const Advice* mendable() const {  // null: nothing that was advised can be done at once
    for (const Advice& one : advice)
      if (one.mend) return &one;
    return nullptr;
  }
  void showAdvice(Preview& preview) const;

  // Sentences for the person.
  void tell(Notice::Kind kind, Message what);
  void tellError(const Error& error);

  // steps.cpp
  void take(DocumentState fresh);  // what the worker thread found out after a step
  void takeAdvice(const GarmentSnapshot& before);
  void makeReady();  // finds out, while nobody waits, what drapes and poses of a figure that is new here will ask
  void perform(Operation operation);
  void amend(std::size_t which, Operation operation, std::function<void(const Done&)> then = {});
  void turn(bool back);  // one step back or forth; a drape that came by itself goes with the step it belongs to
  void goTo(std::uint64_t seq, std::uint64_t towards = 0);
  std::uint64_t head() const { return state.steps.empty() ? 0 : state.steps.back().seq; }
  std::optional<std::size_t> otherWay(bool back) const;  // where undo (redo) of a changed step leads from here

  // A pose is a step that can be stopped, as a drape can; it changes nothing then.
  bool posingNow() const { return tasks.busy(TaskQueue::Kind::Pose); }
  bool stepping() const { return tasks.busy(TaskQueue::Kind::Step) || posingNow(); }
  void stopPosing();

  // settling.cpp
  bool settlingNow() const { return tasks.busy(TaskQueue::Kind::Settle); }
  void settle(std::set<PieceId> live, bool automatic, DrapePieces drape = {});  // its own pieces aside
  void interruptSettling();
  void settleInterrupted();
  static std::set<PieceId> unsettled(const std::set<PieceId>& of, const Document& document);  // and not frozen
  bool shows(const GarmentSnapshot& prediction) const;                                        // of a drape that goes on
  void dropSettling();                                                                        // as if it had not begun
  void stopSettling();  // where the cloth is; before the first step it is dropped

  // pointing.cpp
  void point(const PointerSample& sample);
  void carryOnTable(const std::optional<Gesture::Aside>& aside);
  bool overMenu(const PointerSample& sample);  // then it is not for the gesture

  // touching.cpp
  void countClicks();

  // preview_requests.cpp: the gesture in hand, and what it asks
  void request(PreviewRequest request);  // the newest only, one at a time
  void requestNext();
  void settlePreview();  // of the paper as it is under the hand
  void takeResult(GestureResult result, bool begunBefore);
  void dropGesture();

  // figure.cpp
  void tryNextFigure();
  void dropFigure();

  // documents.cpp
  void leave();  // another document comes: whatever was under way for the old one is over
  // Work that may replace the document or add many steps to it. `notes`: what it has to say besides.
  // `refused`: what is to be asked then, besides being told. `taken`: what is to be done where it went well.
  void longWork(std::function<Result<std::shared_ptr<DocumentWorker>>(const Token&)> work, Message done,
                std::shared_ptr<std::vector<Message>> notes = {}, std::function<void(const Error&)> refused = {},
                std::function<void()> taken = {});
  std::shared_ptr<DocumentWorker> workerOf(DocumentFile file, bool readOnly);  // any thread

  mutable SnapshotPtr seen_, seenOf_;
  mutable std::optional<EdgeEnds> edgeEnds_;
  mutable std::vector<CrossedSeam> crossed_;
  mutable SnapshotPtr crossedOf_;  // the garment they are of
};

}  // namespace karinui

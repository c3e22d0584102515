#pragma once
// What a session keeps between two moves of the hand. The hand's thread only, but for `room`, which is the line's once
// the session has begun. Its work lies in files by what is done: steps.cpp, settling.cpp, questions.cpp, documents.cpp.
#include "karinui/base/latest.h"
#include "karinui/session/session.h"
#include "session/room.h"
#include "session/task_line.h"

namespace karinui {

struct Session::Inside {
  SessionOptions options;
  std::shared_ptr<Bodies> bodies;
  std::shared_ptr<Workers> workers;
  std::shared_ptr<Room> room;  // the line's thread only, once the session has begun

  RoomState state;
  FittingPtr preview;            // what a drag or a drape under way would come to
  Latest<FittingPtr> predicted;  // from the other thread
  Table table;
  Selection selection;
  Command tool = Command::Select;
  std::unique_ptr<Gesture> gesture;
  Language language = Language::English;
  double dartWidth = 0.02;
  SetLength::Keep keepWished = SetLength::Keep::Auto;  // for the chosen edge
  bool inches = false;
  bool mirrorSeams = true;
  std::optional<Sight> sight;
  std::optional<Command> hot;
  bool onCross = false;  // the pointer is on the mark of a crossed seam
  bool onMenu = false;   // the button was pressed on the menu
  KeyHand keyHand;
  std::optional<Command> viewAsked;
  std::vector<Notice> notices;
  std::vector<std::string> answered;  // what a drop menu said before the step: it is not told again as advice
  SessionNews news;
  BodyPtr ready;  // whose distances were asked for already

  std::vector<Advice> advice;  // that still holds
  bool linesShown = false;     // of the body

  // Settling.
  std::set<PieceId> settling;  // what the running (or waiting) drape brings to rest
  bool settlingByItself = false;
  std::shared_ptr<StopRequest> stop;  // of the running (or waiting) drape; null: none
  std::set<PieceId> interrupted;      // what a step interrupted
  std::set<std::uint64_t> byItself;   // steps that nobody asked for, by seq

  // Steps that were changed: where one stood before and after, so that undo and redo can go between the two ways.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> amended;

  int longWorks = 0;            // under way
  std::uint64_t documents = 0;  // that came and went: what was asked about another is not told

  // A figure whose measures are being turned: the newest wish that is not built yet.
  std::optional<SetBody> tried;
  bool trying = false, figureTurns = false;

  // Previews: only the newest question is asked.
  bool asking = false;
  Ask next;

  TaskLine line;  // last: it stops before anything it uses goes

  explicit Inside(SessionOptions options);
  Workbench bench() const { return {state.fitting, &table, language, dartWidth, inches, mirrorSeams, linesShown}; }

  // Whether marks of crossed seams are shown, to be clicked.
  bool turnsCrossed() const { return (tool == Command::Select || tool == Command::Sew) && !gesture->begun(); }
  const std::vector<CrossedSeam>& crossed() const {  // found once for a garment, not for each of its pictures
    if (crossedOf_ != state.fitting) crossed_ = crossedSeams(*state.fitting), crossedOf_ = state.fitting;
    return crossed_;
  }

  void choose(Selection chosen);

  // The ends of the chosen edge, and of its image on the other half, when its length is typed. Found once for a garment
  // and an edge.
  struct EdgeEnds {
    FittingPtr of;
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
  void take(RoomState fresh);  // what the line's thread found out after a step
  void takeAdvice(const Fitting& before);
  void perform(Operation operation);
  void turn(bool back);  // one step back or forth; a drape that came by itself goes with the step it belongs to
  void goTo(std::uint64_t seq);
  std::uint64_t head() const { return state.steps.empty() ? 0 : state.steps.back().seq; }
  std::optional<std::uint64_t> otherWay(bool back) const;  // where undo (redo) of a changed step leads from here

  // settling.cpp
  bool settlingNow() const { return line.busy(TaskLine::Kind::Settle); }
  void settle(std::set<PieceId> live, bool byItselfNow, DrapePieces drape = {});  // its own pieces aside
  void settleStirred(const std::set<PieceId>& live, const SettleReport& report);
  void interruptSettling();
  void settleInterrupted();
  void dropSettling();  // as if it had not begun
  void stopSettling();  // where the cloth is; before the first step it is dropped

  // pointing.cpp
  void point(const PointerSample& sample);
  bool overMenu(const PointerSample& sample);  // then it is not for the gesture

  // questions.cpp: the gesture in hand, and what it asks
  void ask(Ask question);  // the newest only, one at a time
  void askNext();
  void told(Told answer, bool begunBefore);
  void dropGesture();

  // figure.cpp
  void tryNextFigure();
  void dropFigure();

  // documents.cpp
  void leave();  // another document comes: whatever was under way for the old one is over
  // Work that may replace the document or add many steps to it.
  void longWork(std::function<Result<std::shared_ptr<Room>>(const Token&)> work, Message done);
  std::shared_ptr<Room> roomOf(DocumentFile file, bool readOnly);  // any thread

  mutable std::optional<EdgeEnds> edgeEnds_;
  mutable std::vector<CrossedSeam> crossed_;
  mutable FittingPtr crossedOf_;  // the garment they are of
};

}  // namespace karinui

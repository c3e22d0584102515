// What keys, menus and the floating bar ask for.
#include "session/inside.h"

namespace karinui {

bool Session::can(Command command) const {
  const auto& in = *inside_;
  const Document& document = in.state.fitting->document;
  switch (command) {
    case Command::Draw:
      return document.body.chosen() && !in.state.readOnly;
    case Command::Move:
    case Command::Sew:
    case Command::Cut:
    case Command::Pull:
    case Command::Reshape:
    case Command::Points:
    case Command::Notch:
    case Command::Dart:
    case Command::Line:
    case Command::Pin:
      return !document.pattern.pieces.empty() && !in.state.readOnly;
    case Command::Undo:
      return in.gesture->begun() || in.settlingNow() || (!in.state.steps.empty() && !in.state.readOnly);
    case Command::Redo:
      return (!in.state.undone.empty() || in.otherWay(false)) && !in.state.readOnly;
    case Command::Settle:
      return in.settlingNow() || (!document.pattern.pieces.empty() && document.body.chosen() && !in.state.readOnly);
    case Command::Confirm:
      return in.gesture->begun();
    case Command::Mend:
      return !in.state.readOnly && !in.gesture->begun() && in.mendable();
    case Command::BodyLines:
      return in.state.fitting->body != nullptr;
    case Command::Remove:
      return !in.state.readOnly && (!in.selection.pieces.empty() || in.selection.seam);
    case Command::Duplicate:
    case Command::Mirror:
    case Command::Freeze:
      return !in.state.readOnly && !in.selection.pieces.empty();
    case Command::FlipSeam:
      return !in.state.readOnly && static_cast<bool>(in.selection.seam);
    default:
      return true;
  }
}

void Session::command(Command command) {
  auto& in = *inside_;
  ++in.news.overlay;
  if (!can(command)) {
    if (in.state.readOnly)
      in.tell(Notice::Kind::Refused, say("This garment was opened for reading only; keep a copy to work on it."));
    else if (command == Command::Draw || command == Command::Settle)
      in.tell(Notice::Kind::Refused, in.state.fitting->document.body.chosen()
                                         ? say("There is no piece yet; draw one on the body.")
                                         : say("There is no body yet; choose a figure in the body panel."));
    else if (isTool(command))
      in.tell(Notice::Kind::Refused, say("There is no piece yet; draw one on the body."));
    return;
  }
  if (isTool(command)) {
    in.tool = command;
    in.dropGesture();
    return;
  }
  const auto chosen = [&] {
    std::vector<PieceRef> refs;
    for (const PieceId id : in.selection.pieces) refs.push_back(PieceRef(id));
    return refs;
  };
  switch (command) {
    case Command::Undo:
      if (in.gesture->begun()) {
        if (!in.gesture->takeBack()) in.dropGesture();
        return;
      }
      return in.turn(true);
    case Command::Redo:
      if (in.gesture->begun()) return;
      return in.turn(false);
    case Command::Cancel:
      if (in.figureTurns) {
        in.dropFigure();
        return in.settleInterrupted();
      }
      if (in.gesture->begun()) {
        in.dropGesture();
        in.settleInterrupted();
        return;
      }
      in.stopSettling();
      in.advice.clear();
      if (in.tool != Command::Select) in.tool = Command::Select, in.gesture = gestureFor(in.tool);
      return;
    case Command::Settle: {
      if (in.settlingNow()) {
        return in.stopSettling();
      }
      std::set<PieceId> live;
      for (const PieceId id : in.state.fitting->document.drape.dirty)
        if (const Piece* piece = in.state.fitting->document.find(id); piece && !piece->frozen) live.insert(id);
      return in.settle(live, false);
    }
    case Command::Confirm: {
      const bool begun = in.gesture->begun();
      return in.told(in.gesture->confirm(in.bench()), begun);
    }
    case Command::Remove:
      if (!in.selection.line.empty()) return in.perform(EraseMarks{chosen().front(), {in.selection.line}, {}});
      if (in.selection.mark) return in.perform(EraseMarks{chosen().front(), {}, in.selection.mark});
      if (in.selection.seam) return in.perform(Unsew{{SeamRef(in.selection.seam)}});
      return in.perform(RemovePieces{chosen()});
    case Command::Duplicate: {
      DuplicatePiece copy;
      copy.piece = chosen().front();
      copy.name = usableName(in.state.fitting->document, in.state.fitting->document.find(copy.piece.id)->name);
      copy.by = {0.05, 0, 0.05};
      return in.perform(std::move(copy));
    }
    case Command::Mirror:
      return in.perform(MirrorPiece{chosen().front(), ""});
    case Command::Freeze: {
      const Piece* first = in.state.fitting->document.find(chosen().front().id);
      return in.perform(FreezePieces{chosen(), !first->frozen});
    }
    case Command::FlipSeam:
      return in.perform(FlipSeam{SeamRef(in.selection.seam)});
    case Command::Mend:
      return in.perform(*in.mendable()->mend);
    case Command::BodyLines:
      in.linesShown = !in.linesShown;
      ++in.news.garment;
      return;
    default:
      in.viewAsked = command;
  }
}

}  // namespace karinui

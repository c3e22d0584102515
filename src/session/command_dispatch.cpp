// What keys, menus and the floating bar ask for.
#include <algorithm>
#include <cmath>

#include "session/session_impl.h"

namespace karinui {

namespace {

// It has its mirror image, or is one, or lies across the body's middle.
bool onBothSides(const Document& document, PieceId id) {
  constexpr double kNear = 0.05;  // metres: cloth at rest is not quite symmetric
  const Piece& piece = *document.find(id);
  if (document.find(piece.mirrorOf)) return true;
  for (const auto& [other, copy] : document.pattern.pieces)
    if (copy->mirrorOf == id) return true;
  const Stand stand(piece);
  std::vector<Vec3> corners;
  for (const Edge& edge : piece.outline.edges) corners.push_back(stand(edge.curve.start));
  return std::all_of(corners.begin(), corners.end(), [&](Vec3 corner) {
    return std::any_of(corners.begin(), corners.end(), [&](Vec3 other) {
      return distance(Vec3{-corner.x, corner.y, corner.z}, other) < kNear;
    });
  });
}

}  // namespace

bool Session::Impl::has(Needs needs) const {
  const Document& document = state.snapshot->document;
  const bool pieces = !document.pattern.pieces.empty(), body = document.body.chosen();
  switch (needs) {
    case Needs::Nothing:
      return true;
    case Needs::Body:
      return state.snapshot->body != nullptr;
    case Needs::BodyToDraw:
      return body;
    case Needs::Pieces:
      return pieces;
    case Needs::BodyAndPieces:
      return body && pieces;
    case Needs::ChosenPiece:
      return !selection.pieces.empty();
    case Needs::ChosenSeam:
      return static_cast<bool>(selection.seam);
    case Needs::Scan:
      return !document.underlays.empty();
    case Needs::ChosenThing:
      return !selection.pieces.empty() || selection.seam;
  }
  return false;
}

bool Session::can(Command command) const {
  const auto& in = *impl_;
  switch (command) {
    case Command::Undo:
      return in.gesture->begun() || in.settlingNow() || in.posingNow() ||
             (!in.state.steps.empty() && !in.state.readOnly);
    case Command::Redo:
      return (!in.state.undone.empty() || in.otherWay(false)) && !in.state.readOnly;
    case Command::Settle:
      if (in.settlingNow() || in.posingNow()) return true;
      break;
    case Command::Confirm:
      return in.gesture->begun();
    case Command::SelectAll:  // which changes nothing
      return in.has(Needs::Pieces) && !in.gesture->begun();
    case Command::SectionBack:
    case Command::SectionOn:
      return in.viewCut.section.has_value();
    case Command::Remove:  // not from under the hand that holds it
    case Command::Duplicate:
    case Command::Mirror:
    case Command::Freeze:
    case Command::FlipSeam:
      if (in.gesture->begun()) return false;
      break;
    case Command::Mend:
      return !in.state.readOnly && !in.gesture->begun() && in.mendable();
    default:
      break;
  }
  const Needs needs = info(command).needs;
  const bool looks = needs == Needs::Nothing || needs == Needs::Body;  // changes nothing of the document
  return in.has(needs) && (looks || !in.state.readOnly);
}

void Session::command(Command command) {
  auto& in = *impl_;
  ++in.changes.overlay;
  if (!can(command)) {
    if (in.state.readOnly)
      in.tell(Notice::Kind::Refused, say("This garment was opened for reading only; keep a copy to work on it."));
    else if (command == Command::Draw || command == Command::Settle)
      in.tell(Notice::Kind::Refused, in.state.snapshot->document.body.chosen()
                                         ? say("There is no piece yet; draw one on the body.")
                                         : say("There is no body yet; choose a figure in the body panel."));
    else if (command == Command::Trace)
      in.tell(Notice::Kind::Refused, say("There is no scan yet: Work, Lay a scan under the pattern."));
    else if (isTool(command))
      in.tell(Notice::Kind::Refused, say("There is no piece yet; draw one on the body."));
    return;
  }
  if (isTool(command)) {
    if (in.gesture->begun()) in.tell(Notice::Kind::Said, say("What “{0}” had begun is dropped.", info(in.tool).label));
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
      if (in.trial.active()) {
        in.dropFigure();
        return in.settleInterrupted();
      }
      if (in.gesture->begun()) {
        in.dropGesture();
        in.settleInterrupted();
        return;
      }
      // One thing at a time: what is under way, what was advised, the tool, and then what is chosen.
      if (!in.settlingNow() && !in.posingNow() && in.advice.empty() && in.tool == Command::Select) return select({});
      in.stopSettling();
      in.advice.clear();
      if (in.tool != Command::Select) in.tool = Command::Select, in.gesture = gestureFor(in.tool);
      return;
    case Command::Settle: {
      if (in.settlingNow() || in.posingNow()) return in.stopSettling();
      std::set<PieceId> live;
      for (const PieceId id : in.state.snapshot->document.drape.dirty)
        if (const Piece* piece = in.state.snapshot->document.find(id); piece && !piece->frozen) live.insert(id);
      return in.settle(live, false);
    }
    case Command::Confirm: {
      const bool begun = in.gesture->begun();
      return in.takeResult(in.gesture->confirm(in.context()), begun);
    }
    case Command::SelectAll: {
      Selection all;
      for (const auto& [id, piece] : in.state.snapshot->document.pattern.pieces) all.pieces.insert(id);
      return select(std::move(all));
    }
    case Command::Remove:
      if (!in.selection.line.empty()) return in.perform(EraseMarks{chosen().front(), {in.selection.line}, {}});
      if (in.selection.mark) return in.perform(EraseMarks{chosen().front(), {}, in.selection.mark});
      if (in.selection.seam) return in.perform(Unsew{{SeamRef(in.selection.seam)}});
      if (in.selection.edge)
        return in.tell(Notice::Kind::Refused, say("An edge goes only with its piece; click inside the piece to choose "
                                                  "that, then take it away."));
      return in.perform(RemovePieces{chosen()});
    case Command::Duplicate: {
      DuplicatePiece copy;
      copy.pieces = chosen();
      copy.by = {0.05, 0, 0.05};
      return in.perform(std::move(copy));
    }
    case Command::Mirror: {
      MirrorPiece copy;
      copy.pieces = chosen(), copy.sewn = true;
      if (copy.pieces.size() > 1) {  // of all that are chosen, those that have no other side yet
        const Document& document = in.state.snapshot->document;
        std::erase_if(copy.pieces, [&](const PieceRef& piece) { return onBothSides(document, piece.id); });
        if (copy.pieces.empty())
          return in.tell(Notice::Kind::Refused, say("Each of the chosen pieces is on both sides of the body already."));
        if (const std::size_t left = in.selection.pieces.size() - copy.pieces.size(); left > 0)
          in.tell(Notice::Kind::Said,
                  say("{0} {0|piece|pieces} of the chosen {0|is|are} on both sides of the body already, and {0|is|are} "
                      "not mirrored.",
                      left));
      }
      return in.perform(std::move(copy));
    }
    case Command::Freeze: {
      const Document& document = in.state.snapshot->document;
      const bool all = std::all_of(in.selection.pieces.begin(), in.selection.pieces.end(),
                                   [&](PieceId id) { return document.find(id)->frozen; });
      return in.perform(FreezePieces{chosen(), !all});
    }
    case Command::FlipSeam:
      return in.perform(FlipSeam{SeamRef(in.selection.seam)});
    case Command::Mend:
      return in.perform(*in.mendable()->mend);
    case Command::BodyLines:
      in.linesShown = !in.linesShown;
      ++in.changes.garment;
      return;
    case Command::HideArms:
    case Command::HideHands:
    case Command::HideHead: {
      ViewCut cut = in.viewCut;
      bool& hidden = command == Command::HideArms ? cut.arms : command == Command::HideHands ? cut.hands : cut.head;
      hidden = !hidden;
      return setViewCut(cut);
    }
    case Command::Section: {  // from the side, from the front, from above, none
      using Across = SectionPlane::Across;
      ViewCut cut = in.viewCut;
      const double chest = in.state.snapshot->body ? 0.7 * extent(in.state.snapshot->frame).high.y : 1.2;
      if (!cut.section)
        cut.section = SectionPlane{Across::Side, 0};
      else if (cut.section->across == Across::Side)
        cut.section = SectionPlane{Across::Front, 0};
      else if (cut.section->across == Across::Front)
        cut.section = SectionPlane{Across::Level, std::round(chest * 100) / 100};
      else
        cut.section.reset();
      return setViewCut(cut);
    }
    case Command::SectionBack:
    case Command::SectionOn: {
      constexpr double kStep = 0.01;  // metres
      ViewCut cut = in.viewCut;
      if (cut.section) cut.section->at += command == Command::SectionOn ? kStep : -kStep;
      return setViewCut(cut);
    }
    default:
      in.viewAsked = command;
  }
}

}  // namespace karinui

#include "karinui/session/command.h"

#include <vector>

#include "karinui/base/result.h"
#include "session/gestures.h"

namespace karinui {

std::span<const CommandInfo> commands() {
  static const std::vector<CommandInfo> all{
      {Command::Select, "select", "select", "Q", say("Select"), say("Click a piece, an edge or a seam to choose it."),
       Needs::Nothing, selectGesture},
      {Command::Draw, "draw", "draw", "D", say("Draw"),
       say("Draw a closed line on the body, by dragging (with Ctrl straight) or click by click; half a line from "
           "centre to centre makes a symmetric piece."),
       Needs::BodyToDraw, drawGesture, true},
      {Command::Move, "move", "move", "G", say("Move"),
       say("Drag a piece to carry it; with Ctrl it turns. Near another outline it snaps, unless Alt is held."),
       Needs::Pieces, moveGesture, true},
      {Command::Sew, "sew", "sew", "N", say("Sew"),
       say("Drag from one edge to the one it is sewn to; or along a side, past its corners, then along the other."),
       Needs::Pieces, sewGesture, true},
      {Command::Cut, "cut", "cut", "C", say("Cut"),
       say("Drag across a piece to cut it, or from its edge inwards for a slit; Shift keeps the line straight."),
       Needs::Pieces, cutGesture, true},
      {Command::Pull, "pull", "pull", "P", say("Pull"),
       say("Take hold of the cloth and pull: it drapes while you pull. With Shift it stays held."), Needs::Pieces,
       pullGesture, true},
      {Command::Reshape, "reshape", "reshape", "R", say("Reshape"),
       say("Pull the cloth to where it should be; its paper is cut anew to fit."), Needs::Pieces, reshapeGesture, true},
      {Command::Points, "points", "points", "Z", say("Edit points"),
       say("On the flat pattern: drag a corner, or bend an edge; Shift moves the whole edge, Ctrl puts a point on an "
           "edge or takes one away."),
       Needs::Pieces, pointsGesture},
      {Command::Notch, "notch", "notch", "K", say("Notch"),
       say("Click an edge to put a notch on it; click a notch to take it away."), Needs::Pieces, notchGesture},
      {Command::Dart, "dart", "dart", "T", say("Dart"),
       say("Click the edge where the dart opens, then its tip; or both points of a dart inside the piece."),
       Needs::Pieces, dartGesture},
      {Command::Line, "line", "line", "L", say("Inner line"),
       say("Click from place to place inside a piece, and Enter; or drag a curve."), Needs::Pieces, lineGesture},
      {Command::Rectangle, "rectangle", "rectangle", "E", say("Rectangle"),
       say("Drag a rectangle on the flat pattern, with Shift a square; or click and type its size. It becomes a "
           "piece."),
       Needs::Nothing, rectangleGesture},
      {Command::Circle, "circle", "circle", "O", say("Circle"),
       say("Drag a circle on the flat pattern, from its middle outwards; or click and type its size. It becomes a "
           "piece."),
       Needs::Nothing, circleGesture},
      {Command::RingSector, "ring", "ring", "U", say("Ring"),
       say("Drag on the flat pattern from the middle to the outer edge, then click where the inner edge ends: the "
           "angle there is that of the sector. It becomes a piece."),
       Needs::Nothing, ringGesture},
      {Command::Polygon, "polygon", "polygon", "Y", say("Polygon"),
       say("Click from corner to corner on the flat pattern; with Ctrl the line curves on. Enter, or a click on the "
           "first place, closes it. It becomes a piece."),
       Needs::Nothing, polygonGesture},
      {Command::Pin, "pin", "pin", "W", say("Pin"),
       say("Click the cloth to pin it where it is; click a pin to take it out. With Shift a whole edge is pinned."),
       Needs::Pieces, pinGesture},
      {Command::Trace, "trace", "trace", "I", say("Trace"),
       say("Drag a scan under the flat pattern to move it, with Ctrl to turn it; or click two places on it and say how "
           "far apart they are."),
       Needs::Scan, traceGesture},
      {Command::ViewFront, "front", "", "1", say("Front"), say("Looks from the front.")},
      {Command::ViewBack, "back", "", "3", say("Back"), say("Looks from the back.")},
      {Command::ViewLeft, "left", "", "4", say("Left side"), say("Looks from the body's left.")},
      {Command::ViewRight, "right", "", "6", say("Right side"), say("Looks from the body's right.")},
      {Command::ViewOblique, "oblique", "view", "2", say("Oblique"),
       say("Looks from the front and a little from the side."), Needs::Nothing, nullptr, true},
      {Command::ViewAll, "all", "frame", "0", say("All"), say("Shows everything.")},
      {Command::Undo, "undo", "undo", "Ctrl+Z", say("Undo"), say("Takes back the last step; in mid-drag, the drag."),
       Needs::Nothing, nullptr, true},
      {Command::Redo, "redo", "redo", "Ctrl+Shift+Z", say("Redo"), say("Does again what was undone."), Needs::Nothing,
       nullptr, false, "Ctrl+Y"},
      {Command::Settle, "settle", "settle", "Space", say("Settle"),
       say("Brings the pieces that changed to rest on the body; again to stop."), Needs::BodyAndPieces, nullptr, true},
      {Command::Cancel, "cancel", "", "Esc", say("Cancel"), say("Drops what the hand is doing.")},
      {Command::Confirm, "confirm", "", "Return", say("Finish"), say("Ends a line drawn click by click.")},
      {Command::SelectAll, "select_all", "", "Ctrl+A", say("Select all"),
       say("Chooses every piece; Esc chooses nothing again."), Needs::Pieces},
      {Command::Remove, "remove", "trash", "Del", say("Remove"), say("Takes away the chosen pieces or seam."),
       Needs::ChosenThing},
      {Command::Duplicate, "duplicate", "", "Ctrl+D", say("Duplicate"),
       say("Makes second pieces beside the chosen ones."), Needs::ChosenPiece},
      {Command::Mirror, "mirror", "", "Ctrl+M", say("Mirror"),
       say("Makes the copies of the chosen pieces for the body's other side, and sews them there as the pieces are "
           "sewn."),
       Needs::ChosenPiece},
      {Command::Freeze, "freeze", "", "Ctrl+K", say("Freeze"),
       say("Keeps the chosen pieces as they are; again thaws them."), Needs::ChosenPiece},
      {Command::FlipSeam, "flip", "", "F", say("Turn the seam round"), say("Sews a crossed seam the other way round."),
       Needs::ChosenSeam},
      {Command::Mend, "mend", "", "M", say("Mend it"), say("Does what was advised; undo takes it back.")},
      {Command::BodyLines, "lines", "", "B", say("Lines on the body"),
       say("Shows the side, centre, waist and all other lines of the body; a drawn line snaps to them."), Needs::Body},
      {Command::HideArms, "arms", "", "A", say("Hide the arms"),
       say("Cuts the figure's arms off at the armhole; again shows them."), Needs::Body},
      {Command::HideHands, "hands", "", "J", say("Hide the hands"),
       say("Cuts the figure's hands off at the wrist; again shows them."), Needs::Body},
      {Command::HideHead, "head", "", "H", say("Hide the head"),
       say("Cuts the figure's head off at the neck base; again shows it."), Needs::Body},
      {Command::Section, "section", "", "X", say("Cut open"),
       say("Cuts figure and cloth open: along the middle, from side to side, across; then not at all.")},
      {Command::SectionBack, "section_back", "", "[", say("Section 1 cm back"),
       say("Moves the plane that cuts all open: more is taken away.")},
      {Command::SectionOn, "section_on", "", "]", say("Section 1 cm on"),
       say("Moves the plane that cuts all open: less is taken away.")},
  };
  return all;
}

const CommandInfo& info(Command command) {
  for (const CommandInfo& one : commands())
    if (one.command == command) return one;
  KARINUI_ASSERT(false);
}

}  // namespace karinui

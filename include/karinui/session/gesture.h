#pragma once
// A drag as a little state machine: press, drag, release. Until release the document is untouched and only a preview
// moves; then there is at most one operation. Dropping a gesture undoes nothing, for nothing was done. A gesture
// belongs to the session's thread and knows no clock but that of its samples.
#include <memory>
#include <optional>
#include <set>
#include <variant>

#include "karinui/base/number.h"
#include "karinui/design/operation.h"
#include "karinui/scene/overlay.h"
#include "karinui/session/command.h"
#include "karinui/session/fitting.h"
#include "karinui/session/key_hand.h"

namespace karinui {

// What a gesture sees of the room.
struct Workbench {
  FittingPtr fitting;
  const Table* table = nullptr;
  Language language = Language::English;
  double dartWidth = 0.02;  // metres
  bool inches = false;
  bool mirrorSeams = true;  // a seam's mirror image is sewn with it
  bool linesShown = false;  // the lines of the body
  std::string said(double metres) const { return lengthSaid(metres, inches); }
};

// What a gesture shows meanwhile.
struct Preview {
  SceneOverlay space;
  TableOverlay table;
  std::map<PieceId, Rigid> carried;     // pieces shown moved in space, as rigid things
  std::map<PieceId, Outline> outlines;  // pieces whose paper is about to be so
};

// What a gesture would like to know, worked out beside it; only the newest question is answered.
struct AskPull {  // live drape: the hand at `by` from where it took hold
  PieceId piece;
  Flat at;
  Vec3 by;
};
struct AskAfter {  // the garment as it would be
  Operation operation;
};
using Ask = std::variant<std::monostate, AskPull, AskAfter>;
struct Answer {
  FittingPtr after;            // AskAfter
  std::optional<Vec3> force;   // AskPull: newtons
  std::optional<Message> why;  // refused
};

// A menu where a drag was dropped: what is still to be chosen before anything is done. Lengths are written as the
// person reads them.
struct DropMenu {
  struct Item {
    Message label;
    std::optional<bool> checked = {};  // a check mark that is set or taken away; the menu stays
  };
  std::vector<Message> title;  // sentences
  std::vector<Item> items;
  std::size_t current = 0;  // the item Enter takes
  PointerSample::Where where = PointerSample::Where::Space;
  Vec3 space;  // beside which place it opens,
  Flat table;  // in either view
};

struct Told {
  bool over = false;                        // the gesture has ended
  std::optional<Operation> operation = {};  // then: what it comes to
  std::optional<Message> why = {};  // a sentence for the person: refused, what to do next, or advice on the operation
  Ask ask = {};
  std::optional<bool> mirrorSeams = {};  // as it was just set in a drop menu
};

// What is chosen, in space and on the table alike.
struct Selection {
  std::set<PieceId> pieces;
  std::optional<EdgeNear> edge;
  SeamId seam;
  std::string line = {};          // an inner line of the first piece
  std::optional<Flat> mark = {};  // a notch or drill hole of it, by its place on the paper
  bool operator==(const Selection&) const = default;
};

class Gesture {
 public:
  virtual ~Gesture() = default;
  virtual Told feed(const PointerSample& sample, const Hit& hit, const Workbench& bench) = 0;
  virtual Told confirm(const Workbench&) { return {}; }  // Enter
  virtual bool takeBack() { return false; }              // undo within the gesture; false: there is nothing
  virtual void answered(const Answer&) {}
  virtual Preview preview(const Workbench& bench) const = 0;
  // The menu at the drop, if something is to be chosen there; choose() takes one of its items.
  virtual std::optional<DropMenu> dropMenu(const Workbench&) const { return std::nullopt; }
  virtual Told choose(std::size_t, const Workbench&) { return {}; }
  virtual void moveInMenu(int, const Workbench&) {}  // by so many items
  virtual Message hint() const = 0;                  // what to do now
  virtual bool begun() const = 0;                    // something would be lost
  // To a hand without a pointer: what it is led to, and whether it clicks or drags.
  virtual Stops stops() const { return Stops::Pieces; }
  virtual bool clicks() const { return false; }
  // Select and Move on the table, which change the view only.
  virtual std::optional<Selection> chosen() { return std::nullopt; }
  virtual std::optional<std::pair<PieceId, Flat>> laidAside() { return std::nullopt; }
};
std::unique_ptr<Gesture> gestureFor(Command tool);

}  // namespace karinui

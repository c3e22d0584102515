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
#include "karinui/session/garment_snapshot.h"
#include "karinui/session/keyboard_pointer.h"

namespace karinui {

// What tools ask for besides the drag itself; kept from one gesture to the next.
struct ToolOptions {
  double dartWidth = 0.02;  // metres, of the next dart
  bool mirrorSeams = true;  // a seam's mirror image is sewn with it
};

// What a gesture sees of the session.
struct GestureContext {
  SnapshotPtr snapshot;
  const TableLayout* table = nullptr;
  Language language = Language::English;
  bool inches = false;
  ToolOptions options = {};
  bool linesShown = false;                    // the lines of the body
  const std::set<PieceId>* chosen = nullptr;  // pieces
  std::string said(double metres) const { return lengthSaid(metres, inches); }
};

// What a gesture shows meanwhile.
struct Preview {
  SceneOverlay space;
  TableOverlay table;
  std::map<PieceId, Rigid> carried;     // pieces shown moved in space, as rigid things
  std::map<PieceId, Outline> outlines;  // pieces whose paper is about to be so
  Underlays underlays;                  // scans shown moved
};

// A preview a gesture requests of the worker thread; only the newest request is answered.
struct PullPreview {  // live drape: the hand at `by` from where it took hold
  PieceId piece;
  Flat at;
  Vec3 by;
};
struct OperationPreview {  // the garment as it would be
  Operation operation;
  bool settle = false;  // and then, while the hand rests, how its cloth comes to rest
};
using PreviewRequest = std::variant<std::monostate, PullPreview, OperationPreview>;
struct PreviewReply {
  SnapshotPtr after;           // OperationPreview
  std::optional<Vec3> force;   // PullPreview: newtons
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
  struct Number {           // typed instead of an item
    Message label;
    double value = 1, least = 1, most = 1;
    int decimals = 2;
    bool asked = false;  // its item was chosen: the hand types now
    double unit = 0;     // metres, of a length, which may be typed in any unit; 0: a plain number
  };
  std::optional<Number> number = {};
  PointerSample::Where where = PointerSample::Where::Space;
  Vec3 space;  // beside which place it opens,
  Flat table;  // in either view
};

struct GestureResult {
  bool over = false;                        // the gesture has ended
  std::optional<Operation> operation = {};  // then: what it comes to
  std::optional<Message> why = {};  // a sentence for the person: refused, what to do next, or advice on the operation
  PreviewRequest request = {};
  std::optional<ToolOptions> options = {};  // as they were just set in a drop menu
  std::optional<Flat> drawnAt = {};         // of a piece drawn on paper: where its origin lies on the table
  std::optional<Operation> asked = {};      // instead of one: its numbers are to be typed first
};

// What is chosen, in space and on the table alike.
struct Selection {
  std::set<PieceId> pieces;
  std::optional<EdgeNear> edge;
  SeamId seam;
  std::string line = {};               // an inner line of the first piece
  std::optional<Flat> mark = {};       // a notch or drill hole of it, by its place on the paper
  std::vector<EdgeNear> more = {};     // edges chosen before `edge`, one after another, with it
  std::vector<EdgeRef> edges() const;  // all of them, whole, in the order in which they were chosen
  bool operator==(const Selection&) const = default;
};

struct Handling;  // karinui/session/touch_scene_of.h

class Gesture {
 public:
  virtual ~Gesture() = default;
  virtual GestureResult feed(const PointerSample& sample, const Hit& hit, const GestureContext& context) = 0;
  virtual GestureResult confirm(const GestureContext&) { return {}; }  // Enter
  virtual bool takeBack() { return false; }  // undo within the gesture; false: there is nothing
  virtual void previewed(const PreviewReply&) {}
  virtual Preview preview(const GestureContext& context) const = 0;
  // The menu at the drop, if something is to be chosen there; choose() takes one of its items.
  virtual std::optional<DropMenu> dropMenu(const GestureContext&) const { return std::nullopt; }
  virtual GestureResult choose(std::size_t, const GestureContext&) { return {}; }
  virtual GestureResult chooseNumber(double, const GestureContext&) { return {}; }  // the menu's number was typed
  virtual void moveInMenu(int, const GestureContext&) {}                            // by so many items
  virtual Message hint() const = 0;                                                 // what to do now
  virtual bool begun() const = 0;                                                   // something would be lost
  // To a hand without a pointer: what it is led to, and whether it clicks or drags.
  virtual KeyStops keyStops() const { return KeyStops::Pieces; }
  virtual bool clicks() const { return false; }
  // What the hand would feel of it: adds what it carries, pulls, cuts or has snapped to.
  virtual void addTo(Handling&) const {}
  // Select and Move on the table, which change the view only.
  virtual std::optional<Selection> chosen() { return std::nullopt; }
  struct Aside {
    std::set<PieceId> pieces;
    Flat by;
  };
  virtual std::optional<Aside> laidAside() { return std::nullopt; }
  virtual std::optional<Aside> putBack() { return std::nullopt; }  // what the hand drops
};
std::unique_ptr<Gesture> gestureFor(Command tool);

}  // namespace karinui

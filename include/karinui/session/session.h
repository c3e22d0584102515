#pragma once
// The one owner of a document while a person works on it. Samples of a pointer become gestures, gestures operations,
// operations steps of the document's history; drapes and everything else that takes time run on a thread of the
// session's own. A window or a headset is a thin face over this.
//
// All functions belong to one thread, the hand's. None of them waits for a drape (finish() does, for tests and for
// leaving). What the other thread has finished is taken in by update(), which also tells whether there is anything new
// to show.
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "karinui/design/share.h"
#include "karinui/session/command.h"
#include "karinui/session/export.h"
#include "karinui/session/fit_over_bodies.h"
#include "karinui/session/garment_snapshot.h"
#include "karinui/session/gesture.h"
#include "karinui/session/menu.h"
#include "karinui/session/touch_scene_of.h"

namespace karinui {

struct SessionOptions {
  int threads = 1;                 // for drapes
  bool autoSettle = true;          // what was at rest is brought to rest again after it was changed
  std::function<void()> wake;      // from any thread: call update() soon
  std::shared_ptr<Bodies> bodies;  // figures that were built already; empty: its own
  // Where a document that was given no file gets one with its first step; made when needed. Empty: it stays in memory.
  std::filesystem::path drafts;
  // A name for a draft, without ending; a number is added where it is taken. `about`: what it begins with (a size, an
  // imported file), or empty. Called on the worker thread. Not set: `about`, or "draft".
  std::function<std::string(const std::string& about)> nameDraft;
  // Instead of the real solver, for tests; called on the worker thread.
  std::function<Result<DrapeOutcome>(const Document&, const DrapePieces&, Context&)> drape;
  std::function<Result<DrapeOutcome>(const Document&, const PullCloth&, Context&)> pull;
  // A better name for a draft that was begun here, once it has its first pieces: asked with what is there and the step
  // that made those. The file is renamed, until a person saves it. Empty: it stays. Called on the worker thread.
  std::function<std::string(const Document& made, const Operation& by)> nameGarment = {};
};

struct Notice {  // what the person should read once
  enum class Kind { Said, Advice, Refused } kind = Kind::Said;
  Message what;
};

// A pattern that was read in a unit that its file does not tell.
struct GuessedUnit {
  std::filesystem::path file;
  double unit = 0;         // metres, as it was read
  double longest = 0;      // of its pieces, as it was read, up or across
  std::size_t steps = 0;   // that made it
  std::uint64_t last = 0;  // the last of these
};

struct Busy {
  bool any = false;       // something is being worked out
  bool settling = false;  // and it is a drape
  bool posing = false;    // and it is the figure on its way to another pose
  bool loading = false;   // and it is a document, a pattern or a figure that comes from a file
  double fraction = 0;
  Message doing;
  bool past = false;  // what is shown meanwhile is the garment as it was before
};

// Where the hand's time goes; read with the face's own clock. Counts only.
struct SessionChanges {
  std::uint64_t garment = 0;    // the shown garment changed
  std::uint64_t history = 0;    // steps were added, undone, redone, or another document came
  std::uint64_t overlay = 0;    // preview, menu, hint, selection
  std::uint64_t settled = 0;    // drapes that came to rest
  std::uint64_t predicted = 0;  // first new drapes, and pictures of drapes and poses on their way
};

class Session {
 public:
  explicit Session(SessionOptions options = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // --- the document. Each replaces the one before, which is closed. A document without a file (there is one at first)
  // becomes a draft with its first step; where no draft can be written the step is refused.
  void begin(DocumentFile file);                   // takes it over
  void create(const std::filesystem::path& path);  // refuses to overwrite
  void open(const std::filesystem::path& path);    // read-only where it cannot be written
  // A document that was not opened because it is damaged, told once: rescueTo() may save what is whole of it.
  std::optional<std::filesystem::path> takeDamaged();
  // What is whole of a damaged document, in a new one, which is gone on with. A file that is there is refused.
  void rescueTo(const std::filesystem::path& damaged, const std::filesystem::path& to);
  // Works on in `path`, which is replaced: a draft moves there, another document leaves a copy behind, an empty one
  // without a file begins there.
  void saveAs(const std::filesystem::path& path);
  // Plays the steps of this document anew on another figure, into a new document at `path`.
  void replayOn(SetBody body, const std::filesystem::path& path);
  // `wrap`: a surface with holes is closed by a watertight skin. Without it such a file is refused, and told once.
  void importBody(const std::filesystem::path& file, bool wrap = false);
  std::optional<std::filesystem::path> takeOpenBody();
  // A photograph (PNG or JPEG) as the print of a fabric or of pieces, as `look` says.
  void importPrint(const std::filesystem::path& file, SetLook look);
  // A scan or photograph of a paper pattern, laid under the flat pattern to be traced.
  void importScan(const std::filesystem::path& file);
  void importPattern(const std::filesystem::path& file);  // into this document; .json of ours or GarmentCode, .ops
  // Of a pattern that was read in a unit that was guessed; told once.
  std::optional<GuessedUnit> takeGuessedUnit();
  // The same in another unit (mm, cm, m, in, pt), in place of the steps that made it. Refused once the garment went on.
  void readAgain(const GuessedUnit& guessed, const std::string& unit);
  void exportTo(const std::filesystem::path& file, const ExportWish& wish);
  // The pattern for others, with nothing of the person it was made for (share.h). What others will read in it is told.
  void shareTo(const std::filesystem::path& file, SharedNames names = SharedNames::Kept);
  const std::filesystem::path& path() const;  // empty: no step yet (or no drafts folder)
  bool draft() const;                         // lies in the drafts folder
  bool readOnly() const;

  // --- what there is
  const GarmentSnapshot& snapshot() const;  // the document as it is
  SnapshotPtr snapshotPtr() const;          // the same, to be kept: another pointer, another document
  SnapshotPtr pickedPtr() const;            // the same as it is picked from: what viewCut() hides is not
  const GarmentSnapshot& shown() const;     // what to draw: a prediction or a drag's preview while there is one
  SnapshotPtr shownPtr() const;
  const TableLayout& table() const;
  const std::vector<Step>& steps() const;
  const std::vector<Step>& undone() const;
  const Selection& selection() const;
  Command tool() const;
  Message hint() const;
  Preview preview() const;
  std::optional<DropMenu> dropMenu() const;  // where a drag was dropped and something is to be chosen
  std::optional<SceneMenu> menu() const;     // nothing before setViewpoint()
  Busy busy() const;
  std::vector<Notice> takeNotices();
  const std::vector<Advice>& advice() const;  // what was advised and still holds; Command::Mend does the first
  bool linesShown() const;                    // the body's lines, by Command::BodyLines
  bool begun() const;                         // a gesture is under way: a view turned now keeps pan and zoom
  void refuse(const Error& why);              // what a face could not make of something typed, told like any refusal
  void advise(Message what);                  // told once, like advice on a step
  std::optional<Command> takeView();          // a view that was asked for
  std::optional<Operation> takeAsked();  // a tool was clicked where it is dragged: a face lets its numbers be typed
  const SessionChanges& changes() const;
  // What a tip would feel now: the skin and cloth that are shown, and what the gesture in hand does. For a force
  // device, or for whatever else answers to touch (a controller's vibration); the session knows none of them. Cheap.
  TouchSource touchSource() const;

  // --- what the person does
  void feed(const PointerSample& sample);
  void leave();  // the pointer left the view: what was shown only because it hovered there goes
  // The same with keys alone. `with` says where, when, how near touching is, and which modifiers are held; the rest is
  // the fingertip's.
  void strike(KeyStroke key, const PointerSample& with);
  std::optional<PointerSample> fingertip() const;  // nothing while a pointer is used
  Message keyHint() const;                         // what keys do now; empty while a pointer is used
  Message underFingertip() const;                  // for those who hear the screen
  void setViewpoint(const Viewpoint& viewpoint);
  void setLanguage(Language language);
  void setInches(bool inches);  // instead of centimetres, in what gestures tell
  const ToolOptions& toolOptions() const;
  void setToolOptions(const ToolOptions& options);
  void choose(std::size_t item);    // of the drop menu
  void chooseNumber(double typed);  // of the drop menu
  // Which parts of the figure are not drawn, and where all is cut open. Part of the view, not of the document; what is
  // not drawn is neither picked nor snapped to.
  const ViewCut& viewCut() const;
  void setViewCut(const ViewCut& cut);
  // Which end of the chosen edge stays when its length is typed: by itself as keptEnd() has it, until another edge is
  // chosen. Start where no edge is chosen. preview() marks what stays with dots, what moves with rings.
  void setKeptEnd(SetLength::Keep keep);
  SetLength::Keep keptEnd() const;
  bool bothHalves() const;  // the edge's image on the other half is changed with it
  bool can(Command command) const;
  void command(Command command);
  void select(Selection selection);
  void perform(Operation operation);
  void goTo(std::size_t steps);  // back or forth until this many steps are done

  // --- the steps' whole tree
  const std::vector<Step>& otherBranches() const;  // where ways that were left end, newest first
  void switchBranch(const Step& end);              // goes there
  // Makes step `which` (from 1) this operation and plays all that follows again; Space or Escape stops it. Refused or
  // stopped, nothing has changed. One undo brings the old way back.
  void amend(std::size_t which, Operation operation);
  // The garment as it was after a step of steps() or undone() (0: the beginning), told to `then` by update() when it
  // is there (null: it could not be made); never, where another document came first.
  void snapshotAfter(std::uint64_t seq, std::function<void(SnapshotPtr)> then);

  // What leads to the garment, to be made again on other figures (fit_over_bodies.h), told to `then` by update();
  // never, where another document came first.
  void recipe(std::function<void(Result<RecipePtr>)> then);

  // --- the figure
  // Shows the garment on a figure while one still turns its measures: nothing is done yet, the newest wish only is
  // built, and Cancel, or the next step, shows what is there again.
  void previewFigure(SetBody body);
  // The figure that was chosen last becomes this one, and every step that followed is played again on it: made to
  // measure. Space stops it, one undo brings the old figure back. Refused, the one that was asked for before it and is
  // not there yet goes on.
  void applyFigure(SetBody body);
  const SetBody* figure() const;  // as it was chosen last, also where it is not there yet; null: none

  // --- time
  bool update();  // takes in what was finished; true: something is new
  void finish();  // waits until nothing is left to do
  bool idle() const;
  // Before leaving: waits for the steps that were asked for, stops a drape where it is. Imports are not waited for.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace karinui

#include "karinui/session/session.h"

#include <algorithm>

#include "session/gestures.h"
#include "session/session_impl.h"

namespace karinui {

Session::Impl::Impl(SessionOptions o)
    : options(std::move(o)),
      bodies(options.bodies ? options.bodies : std::make_shared<Bodies>()),
      workers(std::make_shared<Workers>(options.threads)),
      tasks(options.wake) {
  gesture = gestureFor(tool);
  documentWorker = workerOf(DocumentFile::inMemory(), false);
  state.snapshot = snapshotOf({}, nullptr);
}

SnapshotPtr Session::Impl::seen() const {
  if (!viewCut.any()) return state.snapshot;
  if (seenOf_ != state.snapshot) {
    auto cut = std::make_shared<GarmentSnapshot>(*state.snapshot);
    cut->visible = seen_ && seen_->visible && seen_->body == cut->body
                       ? seen_->visible
                       : std::make_shared<const VisibleParts>(viewCut, cut->body);
    seen_ = std::move(cut), seenOf_ = state.snapshot;
  }
  return seen_;
}

const ViewCut& Session::viewCut() const { return impl_->viewCut; }
void Session::setViewCut(const ViewCut& cut) {
  auto& in = *impl_;
  if (cut == in.viewCut) return;
  in.viewCut = cut;
  in.seen_.reset(), in.seenOf_.reset();
  ++in.changes.garment, ++in.changes.overlay;
  if (in.options.wake) in.options.wake();
}

void Session::Impl::tell(Notice::Kind kind, Message what) {
  if (!what.empty()) notices.push_back({kind, std::move(what)});
}

void Session::Impl::tellError(const Error& error) {
  if (error.kind != Error::Kind::Cancelled) tell(Notice::Kind::Refused, error.what);
}

Session::Session(SessionOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}
Session::~Session() = default;

const std::filesystem::path& Session::path() const { return impl_->state.path; }
bool Session::draft() const { return isDraft(impl_->options, impl_->state.path); }
bool Session::readOnly() const { return impl_->state.readOnly; }
const GarmentSnapshot& Session::snapshot() const { return *impl_->state.snapshot; }
SnapshotPtr Session::snapshotPtr() const { return impl_->state.snapshot; }
SnapshotPtr Session::pickedPtr() const { return impl_->seen(); }
SnapshotPtr Session::shownPtr() const { return impl_->preview ? impl_->preview : impl_->state.snapshot; }
const GarmentSnapshot& Session::shown() const { return *(impl_->preview ? impl_->preview : impl_->state.snapshot); }
const TableLayout& Session::table() const { return impl_->table; }
const std::vector<Step>& Session::steps() const { return impl_->state.steps; }
const std::vector<Step>& Session::undone() const { return impl_->state.undone; }
const Selection& Session::selection() const { return impl_->selection; }
Command Session::tool() const { return impl_->tool; }
Preview Session::preview() const {
  const auto& in = *impl_;
  Preview preview = in.gesture->preview(in.context());
  if (in.selection.edge && in.selection.more.empty() && !in.gesture->begun()) {
    const auto& ends = in.edgeEnds();
    const PieceId piece = in.selection.edge->piece;
    const auto mark = [&](const std::vector<Flat>& paper, std::vector<Flat>& table, std::vector<Vec3>& space) {
      for (const Flat place : paper) {
        table.push_back(place + in.table.at(piece));
        if (const auto there = spaceOf(*in.state.snapshot, piece, place)) space.push_back(*there);
      }
    };
    mark(ends.stay, preview.table.dots, preview.space.dots);
    mark(ends.move, preview.table.rings, preview.space.rings);
  }
  if (!in.gesture->begun()) in.showAdvice(preview);
  if (!in.turnsCrossed()) return preview;
  for (const CrossedSeam& one : in.crossed()) {
    preview.space.words.push_back({one.place, "⇄"});
    for (const auto& [piece, place] : one.paper) preview.table.words.push_back({place + in.table.at(piece), "⇄"});
  }
  return preview;
}
std::optional<DropMenu> Session::dropMenu() const { return impl_->gesture->dropMenu(impl_->context()); }
// The edge and the place that were advised on, on the body and on the paper.
void Session::Impl::showAdvice(Preview& shown) const {
  constexpr Colour kAdvised{0.85f, 0.45f, 0.02f};
  for (const Advice& one : advice) {
    if (!one.edge.empty()) showEdge(shown, context(), EdgeRef{PieceRef(one.piece), one.edge}, kAdvised);
    if (!one.at) continue;
    if (const auto there = spaceOf(*state.snapshot, one.piece, *one.at)) shown.space.dots.push_back(*there);
    shown.table.dots.push_back(*one.at + table.at(one.piece));
    if (const auto* dart = one.mend ? std::get_if<AddDart>(&*one.mend) : nullptr)
      if (const Edge* edge = findEdge(*state.snapshot->document.find(one.piece), one.edge))
        showOnPaper(shown, context(), one.piece, {edge->curve.atFraction(dart->at), dart->tip}, kAdvised);
    if (const auto* cut = one.mend ? std::get_if<CutPiece>(&*one.mend) : nullptr)
      showOnPaper(shown, context(), one.piece, cut->line, kAdvised);
  }
}
const std::vector<Advice>& Session::advice() const { return impl_->advice; }
bool Session::linesShown() const { return impl_->linesShown; }
bool Session::begun() const { return impl_->gesture->begun(); }
void Session::refuse(const Error& why) {
  impl_->tellError(why);
  if (impl_->options.wake) impl_->options.wake();
}
void Session::advise(Message what) {
  impl_->tell(Notice::Kind::Advice, std::move(what));
  if (impl_->options.wake) impl_->options.wake();
}
const SessionChanges& Session::changes() const { return impl_->changes; }
std::vector<Notice> Session::takeNotices() { return std::exchange(impl_->notices, {}); }
std::optional<Operation> Session::takeAsked() { return std::exchange(impl_->asked, std::nullopt); }
std::optional<Command> Session::takeView() { return std::exchange(impl_->viewAsked, std::nullopt); }

Message Session::hint() const {
  if (impl_->onCross) return say("This seam crosses itself; click to sew it the other way round.");
  if (impl_->hot) return info(*impl_->hot).hint;
  if (impl_->trial.active())
    return say("Let go and every step is played again on this figure; Esc leaves it as it was.");
  const Message usual = impl_->gesture->hint();
  const Document& document = snapshot().document;
  if (usual.pattern != info(Command::Select).hint.pattern) return usual;
  if (document.pattern.pieces.empty() && snapshot().body)
    return say("Draw a piece on the body, or take a ready block.");
  if (const auto& last = document.drape.last; last && !last->settled && document.drape.dirty.empty())
    return say("The cloth did not come to rest: settle it again, or undo the step that led to it.");
  return usual;
}

std::optional<SceneMenu> Session::menu() const {
  if (!impl_->viewpoint) return std::nullopt;
  MenuState state;
  state.enabled = [this](Command c) { return can(c); };
  state.chosen = [this](Command c) { return c == impl_->tool || (c == Command::Settle && impl_->settlingNow()); };
  state.hot = impl_->hot;
  return menuPanel(*impl_->viewpoint, state);
}

Busy Session::busy() const {
  Busy busy;
  busy.any = impl_->stepping() || impl_->settlingNow();
  busy.settling = impl_->settlingNow();
  busy.posing = impl_->posingNow();
  busy.loading = impl_->longWorks > 0;
  const auto progress = impl_->tasks.progress();
  busy.fraction = progress.fraction;
  busy.doing = progress.doing;
  busy.past = impl_->past && busy.settling && impl_->schedule.live().empty();
  return busy;
}

void Session::setViewpoint(const Viewpoint& viewpoint) { impl_->viewpoint = viewpoint, ++impl_->changes.overlay; }
void Session::setLanguage(Language language) { impl_->language = language, ++impl_->changes.overlay; }

void Session::setInches(bool inches) { impl_->inches = inches, ++impl_->changes.overlay; }
const ToolOptions& Session::toolOptions() const { return impl_->toolOptions; }
void Session::setToolOptions(const ToolOptions& options) { impl_->toolOptions = options, ++impl_->changes.overlay; }
void Session::setKeptEnd(SetLength::Keep keep) { impl_->keepWished = keep, ++impl_->changes.overlay; }
SetLength::Keep Session::keptEnd() const { return impl_->edgeEnds().keep; }
bool Session::bothHalves() const { return impl_->edgeEnds().bothHalves; }

// Steps that are played again are shown once the garment is whole, so that none of it goes out of sight meanwhile.
bool Session::Impl::shows(const GarmentSnapshot& prediction) const {
  if (prediction.underWay) return posingNow() && !gesture->begun();
  if (!schedule.live().empty()) return true;
  if (gesture->begun()) return tasks.busy(TaskQueue::Kind::SettlePreview);
  const auto& pieces = state.snapshot->document.pattern.pieces;
  return settlingNow() && std::all_of(pieces.begin(), pieces.end(), [&](const auto& piece) {
           return prediction.document.find(piece.first) != nullptr;
         });
}

bool Session::update() {
  auto& in = *impl_;
  bool any = in.tasks.takeIn();
  in.makeReady();
  if (auto fresh = in.predicted.take(); fresh && in.shows(**fresh)) {
    in.preview = *fresh;
    in.past = false;
    ++in.changes.garment, ++in.changes.predicted;
    any = true;
  }
  return any;
}

void Session::finish() {
  do {
    impl_->tasks.wait();
    update();
  } while (impl_->tasks.busy());
}

bool Session::idle() const { return !impl_->tasks.busy(); }

void Session::close() {
  auto& in = *impl_;
  in.dropGesture();
  const bool byItself = std::exchange(in.options.autoSettle, false);
  in.stopSettling();
  while (in.longWorks == 0 && (in.stepping() || in.settlingNow())) {
    for (const auto kind : {TaskQueue::Kind::Preview, TaskQueue::Kind::SettlePreview, TaskQueue::Kind::Figure,
                            TaskQueue::Kind::SnapshotAfter})
      in.tasks.cancel(kind);
    in.tasks.wait();
    update();
  }
  in.options.autoSettle = byItself;
}

}  // namespace karinui

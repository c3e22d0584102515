#include "karinui/session/session.h"

#include "session/gestures.h"
#include "session/inside.h"

namespace karinui {

Session::Inside::Inside(SessionOptions o)
    : options(std::move(o)),
      bodies(options.bodies ? options.bodies : std::make_shared<Bodies>()),
      workers(std::make_shared<Workers>(options.threads)),
      line(options.wake) {
  gesture = gestureFor(tool);
  room = roomOf(DocumentFile::inMemory(), false);
  state.fitting = fittingOf({}, nullptr);
}

void Session::Inside::tell(Notice::Kind kind, Message what) {
  if (!what.empty()) notices.push_back({kind, std::move(what)});
}

void Session::Inside::tellError(const Error& error) {
  if (error.kind != Error::Kind::Cancelled) tell(Notice::Kind::Refused, error.what);
}

Session::Session(SessionOptions options) : inside_(std::make_unique<Inside>(std::move(options))) {}
Session::~Session() = default;

const std::filesystem::path& Session::path() const { return inside_->state.path; }
bool Session::draft() const { return isDraft(inside_->options, inside_->state.path); }
bool Session::readOnly() const { return inside_->state.readOnly; }
const Fitting& Session::fitting() const { return *inside_->state.fitting; }
FittingPtr Session::shownPtr() const { return inside_->preview ? inside_->preview : inside_->state.fitting; }
const Fitting& Session::shown() const { return *(inside_->preview ? inside_->preview : inside_->state.fitting); }
const Table& Session::table() const { return inside_->table; }
const std::vector<Step>& Session::steps() const { return inside_->state.steps; }
const std::vector<Step>& Session::undone() const { return inside_->state.undone; }
const Selection& Session::selection() const { return inside_->selection; }
Command Session::tool() const { return inside_->tool; }
Preview Session::preview() const {
  const auto& in = *inside_;
  Preview preview = in.gesture->preview(in.bench());
  if (in.selection.edge && !in.gesture->begun()) {
    const auto& ends = in.edgeEnds();
    const PieceId piece = in.selection.edge->piece;
    const auto mark = [&](const std::vector<Flat>& paper, std::vector<Flat>& table, std::vector<Vec3>& space) {
      for (const Flat place : paper) {
        table.push_back(place + in.table.at(piece));
        if (const auto there = spaceOf(*in.state.fitting, piece, place)) space.push_back(*there);
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
std::optional<DropMenu> Session::dropMenu() const { return inside_->gesture->dropMenu(inside_->bench()); }
// The edge and the place that were advised on, on the body and on the paper.
void Session::Inside::showAdvice(Preview& shown) const {
  constexpr Colour kAdvised{0.85f, 0.45f, 0.02f};
  for (const Advice& one : advice) {
    if (!one.edge.empty()) showEdge(shown, bench(), EdgeRef{PieceRef(one.piece), one.edge}, kAdvised);
    if (!one.at) continue;
    if (const auto there = spaceOf(*state.fitting, one.piece, *one.at)) shown.space.dots.push_back(*there);
    shown.table.dots.push_back(*one.at + table.at(one.piece));
    if (const auto* dart = one.mend ? std::get_if<AddDart>(&*one.mend) : nullptr)
      if (const Edge* edge = findEdge(*state.fitting->document.find(one.piece), one.edge))
        showOnPaper(shown, bench(), one.piece, {edge->curve.atFraction(dart->at), dart->tip}, kAdvised);
    if (const auto* cut = one.mend ? std::get_if<CutPiece>(&*one.mend) : nullptr)
      showOnPaper(shown, bench(), one.piece, cut->line, kAdvised);
  }
}
const std::vector<Advice>& Session::advice() const { return inside_->advice; }
bool Session::linesShown() const { return inside_->linesShown; }
bool Session::begun() const { return inside_->gesture->begun(); }
void Session::refuse(const Error& why) {
  inside_->tellError(why);
  if (inside_->options.wake) inside_->options.wake();
}
void Session::advise(Message what) {
  inside_->tell(Notice::Kind::Advice, std::move(what));
  if (inside_->options.wake) inside_->options.wake();
}
const SessionNews& Session::news() const { return inside_->news; }
std::vector<Notice> Session::takeNotices() { return std::exchange(inside_->notices, {}); }
std::optional<Command> Session::takeView() { return std::exchange(inside_->viewAsked, std::nullopt); }

Message Session::hint() const {
  if (inside_->onCross) return say("This seam crosses itself; click to sew it the other way round.");
  if (inside_->hot) return info(*inside_->hot).hint;
  if (inside_->figureTurns)
    return say("Let go and every step is played again on this figure; Esc leaves it as it was.");
  return inside_->gesture->hint();
}

std::optional<ScenePanel> Session::menu() const {
  if (!inside_->sight) return std::nullopt;
  MenuState state;
  state.enabled = [this](Command c) { return can(c); };
  state.chosen = [this](Command c) { return c == inside_->tool || (c == Command::Settle && inside_->settlingNow()); };
  state.hot = inside_->hot;
  return menuPanel(*inside_->sight, state);
}

Busy Session::busy() const {
  Busy busy;
  busy.any = inside_->line.busy(TaskLine::Kind::Step) || inside_->line.busy(TaskLine::Kind::Settle);
  busy.settling = inside_->settlingNow();
  const auto progress = inside_->line.progress();
  busy.fraction = progress.fraction;
  busy.doing = progress.doing;
  return busy;
}

void Session::setSight(const Sight& sight) { inside_->sight = sight, ++inside_->news.overlay; }
void Session::setLanguage(Language language) { inside_->language = language, ++inside_->news.overlay; }

void Session::setInches(bool inches) { inside_->inches = inches, ++inside_->news.overlay; }
void Session::setDartWidth(double metres) { inside_->dartWidth = metres, ++inside_->news.overlay; }
double Session::dartWidth() const { return inside_->dartWidth; }
void Session::setMirrorSeams(bool on) { inside_->mirrorSeams = on, ++inside_->news.overlay; }
bool Session::mirrorSeams() const { return inside_->mirrorSeams; }
void Session::setKeptEnd(SetLength::Keep keep) { inside_->keepWished = keep, ++inside_->news.overlay; }
SetLength::Keep Session::keptEnd() const { return inside_->edgeEnds().keep; }
bool Session::bothHalves() const { return inside_->edgeEnds().bothHalves; }

bool Session::update() {
  auto& in = *inside_;
  bool any = in.line.takeIn();
  if (auto fresh = in.predicted.take(); fresh && !in.settling.empty()) {
    in.preview = *fresh;
    ++in.news.garment, ++in.news.predicted;
    any = true;
  }
  return any;
}

void Session::finish() {
  do {
    inside_->line.wait();
    update();
  } while (inside_->line.busy());
}

bool Session::idle() const { return !inside_->line.busy(); }

void Session::conclude() {
  auto& in = *inside_;
  in.dropGesture();
  const bool byItself = std::exchange(in.options.settleByItself, false);
  in.stopSettling();
  while (in.longWorks == 0 && (in.line.busy(TaskLine::Kind::Step) || in.line.busy(TaskLine::Kind::Settle))) {
    for (const auto kind : {TaskLine::Kind::Preview, TaskLine::Kind::Figure, TaskLine::Kind::Glimpse})
      in.line.cancel(kind);
    in.line.wait();
    update();
  }
  in.options.settleByItself = byItself;
}

}  // namespace karinui

#include "karinui/session/session.h"

#include <algorithm>
#include <cmath>

#include "karinui/base/latest.h"
#include "session/room.h"
#include "session/task_line.h"

namespace karinui {

namespace {

bool drapes(const Operation& op) {
  return std::holds_alternative<DrapePieces>(op) || std::holds_alternative<PullCloth>(op);
}

// What changes cloth so that it should come to rest again where it was at rest before.
bool disturbs(const Operation& op) {
  return std::holds_alternative<CutPiece>(op) || std::holds_alternative<ReshapePiece>(op) ||
         std::holds_alternative<SetFabric>(op) || std::holds_alternative<Unsew>(op) ||
         std::holds_alternative<UnpinCloth>(op) || std::holds_alternative<SetGrain>(op) ||
         std::holds_alternative<SetBody>(op);
}

}  // namespace

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
  std::optional<Sight> sight;
  std::optional<Command> hot;
  bool onMenu = false;  // the button was pressed on the menu
  std::optional<Command> viewAsked;
  std::vector<Notice> notices;
  SessionNews news;
  Message doing;
  BodyPtr ready;  // whose distances were asked for already

  // Settling.
  std::set<PieceId> settling;  // what the running (or waiting) drape brings to rest
  bool settlingByItself = false;
  std::set<PieceId> interrupted;     // what a step interrupted
  std::set<std::uint64_t> byItself;  // steps that nobody asked for, by seq

  // Previews: only the newest question is asked.
  bool asking = false;
  Ask next;

  TaskLine line;  // last: it stops before anything it uses goes

  explicit Inside(SessionOptions o)
      : options(std::move(o)),
        bodies(options.bodies ? options.bodies : std::make_shared<Bodies>()),
        workers(std::make_shared<Workers>(options.threads)),
        line(options.wake) {
    gesture = gestureFor(tool);
    room = roomOf(DocumentFile::inMemory(), false);
    state.fitting = fittingOf({}, nullptr);
  }

  Workbench bench() const { return {state.fitting, &table, language}; }

  void tell(Notice::Kind kind, Message what) {
    if (!what.empty()) notices.push_back({kind, std::move(what)});
  }
  void tellError(const Error& error) {
    if (error.kind != Error::Kind::Cancelled) tell(Notice::Kind::Refused, error.what);
  }

  void take(RoomState fresh) {
    state = std::move(fresh);
    preview.reset();
    if (state.fitting->trouble) tell(Notice::Kind::Advice, *state.fitting->trouble);
    table.arrange(*state.fitting);
    std::erase_if(selection.pieces, [&](PieceId id) { return !state.fitting->document.find(id); });
    if (selection.edge && !edgeThere(*selection.edge)) selection.edge.reset();
    if (selection.seam && !state.fitting->document.find(selection.seam)) selection.seam = {};
    ++news.garment, ++news.history, ++news.overlay;
    // The first drape and the first pull need to know how far everything is from the skin: find out while nobody waits.
    if (state.fitting->body && state.fitting->body != ready && !options.drape) {
      ready = state.fitting->body;
      line.add(TaskLine::Kind::Preview, [this, body = ready](const Token& token) {
        (void)body->prepareField(*workers, token);
        return TaskLine::Finish();
      });
    }
  }
  bool edgeThere(const EdgeNear& edge) const {
    const Piece* piece = state.fitting->document.find(edge.piece);
    return piece && findEdge(*piece, edge.edge);
  }

  // Another document comes: whatever was under way for the old one is over.
  void leave() {
    dropGesture();
    line.cancel(TaskLine::Kind::Preview);
    line.cancel(TaskLine::Kind::Settle);
    settling.clear(), interrupted.clear(), byItself.clear();
  }
  void dropGesture() {
    line.cancel(TaskLine::Kind::Preview);
    next = {};
    line.add(TaskLine::Kind::Preview, [this](const Token&) {
      room->letGo();
      return TaskLine::Finish();
    });
    gesture = gestureFor(tool);
    if (preview && !settlingNow()) preview.reset(), ++news.garment;
    ++news.overlay;
  }
  bool settlingNow() const { return line.busy(TaskLine::Kind::Settle); }

  void interruptSettling() {
    if (settling.empty()) return;
    interrupted.insert(settling.begin(), settling.end());
    settling.clear();
    line.cancel(TaskLine::Kind::Settle);
  }

  void perform(Operation operation) {
    if (const auto* drape = std::get_if<DrapePieces>(&operation)) {
      std::set<PieceId> live;
      for (const PieceRef& ref : drape->live) {
        const Document& document = state.fitting->document;
        const Piece* piece = ref.id ? document.find(ref.id) : document.pieceNamed(ref.name);
        if (!piece) return tell(Notice::Kind::Refused, say("There is no piece “{0}”.", ref.name));
        live.insert(piece->id);
      }
      return settle(live, false);
    }
    interruptSettling();
    const bool pull = std::holds_alternative<PullCloth>(operation);
    doing = pull ? say("Pulling the cloth") : Message{};
    const auto before = state.fitting;
    line.add(TaskLine::Kind::Step, [this, before, operation = std::move(operation)](const Token& token) mutable {
      const bool disturbing = disturbs(operation);
      Result<Step> step = room->perform(std::move(operation), token);
      const auto fresh = std::make_shared<RoomState>(room->state(token));
      return [this, before, disturbing, step = std::move(step), fresh, doing = line.progress().doing] {
        if (!step) {
          tellError(step.error());
          preview.reset();
          ++news.garment, ++news.overlay;
          return settleInterrupted();
        }
        take(*fresh);
        if (drapes(step->operation)) ++news.settled;
        if (std::holds_alternative<DrawPiece>(step->operation) && !doing.empty()) tell(Notice::Kind::Advice, doing);
        if (std::holds_alternative<PullCloth>(step->operation))
          if (const auto& last = state.fitting->document.drape.last; last && !last->why.empty())
            tell(Notice::Kind::Said, last->why);
        if (disturbing && options.settleByItself) {
          const DrapeInfo& old = before->document.drape;
          for (const PieceId id : state.fitting->document.drape.dirty)
            if (old.last && !old.dirty.contains(id)) interrupted.insert(id);
        }
        settleInterrupted();
      };
    });
  }

  void settleInterrupted() {
    std::set<PieceId> live;
    for (const PieceId id : std::exchange(interrupted, {})) {
      const Piece* piece = state.fitting->document.find(id);
      if (piece && !piece->frozen && state.fitting->document.drape.dirty.contains(id)) live.insert(id);
    }
    if (!live.empty() && !line.busy(TaskLine::Kind::Step))
      settle(live, true);
    else
      interrupted = live;
  }

  void settle(std::set<PieceId> live, bool byItselfNow) {
    line.cancel(TaskLine::Kind::Settle);
    if (live.empty()) live = livePieces(state.fitting->document, {});
    if (live.empty()) return tell(Notice::Kind::Refused, say("There is no cloth to drape."));
    settling = live;
    settlingByItself = byItselfNow;
    DrapePieces drape;
    for (const PieceId id : live) drape.live.push_back(PieceRef(id));
    ++news.overlay;
    line.add(TaskLine::Kind::Settle, [this, drape, byItselfNow](const Token& token) {
      Result<Step> step = room->perform(drape, token);
      const auto fresh = step ? std::make_shared<RoomState>(room->state(token)) : nullptr;
      return [this, step = std::move(step), fresh, byItselfNow] {
        ++news.overlay;
        if (!step) {
          tellError(step.error());
          if (preview && !gesture->begun()) preview.reset(), ++news.garment;
          if (step.error().kind != Error::Kind::Cancelled) settling.clear();
          return;
        }
        settling.clear();
        if (byItselfNow) byItself.insert(step->seq);
        take(*fresh);
        ++news.settled;
        const SettleReport& report = *state.fitting->document.drape.last;
        if (!report.settled) tell(Notice::Kind::Advice, say("The cloth did not come to rest: {0}", report.why));
      };
    });
  }

  // One step back or forth; a drape that came by itself goes with the step it belongs to.
  void turn(bool back) {
    interrupted.clear();
    const bool wasAsked = settlingNow() && !settlingByItself;
    if (settlingNow()) {
      settling.clear();
      line.cancel(TaskLine::Kind::Settle);
      preview.reset();
      ++news.garment;
      if (back && wasAsked) return tell(Notice::Kind::Said, say("Stopped; nothing was changed."));
    }
    const auto own = byItself;
    line.add(TaskLine::Kind::Step, [this, back, own](const Token& token) {
      Result<Step> step = back ? room->undo(token) : room->redo(token);
      if (step && back && own.contains(step->seq)) step = room->undo(token);
      if (step && !back) {
        const auto waiting = room->file().undone();
        if (!waiting.empty() && own.contains(waiting.front().seq)) (void)room->redo(token);
      }
      const auto fresh = std::make_shared<RoomState>(room->state(token));
      return [this, step = std::move(step), fresh] {
        if (!step) return tellError(step.error());
        take(*fresh);
      };
    });
  }

  // Work that may replace the document or add many steps to it.
  void longWork(std::function<Result<std::shared_ptr<Room>>(const Token&)> work, Message done) {
    leave();
    line.add(TaskLine::Kind::Step, [this, work = std::move(work), done = std::move(done)](const Token& token) {
      Result<std::shared_ptr<Room>> made = work(token);
      const bool other = made && *made != room;
      if (other) room = *made;
      const auto fresh = std::make_shared<RoomState>(room->state(token));
      std::optional<Error> why;
      if (!made) why = made.error();
      return [this, other, why, fresh, done] {
        if (other) {
          table = Table();
          selection = {};
          viewAsked = Command::ViewAll;
        }
        take(*fresh);
        if (why)
          tellError(*why);
        else
          tell(Notice::Kind::Said, done);
      };
    });
  }
  std::shared_ptr<Room> roomOf(DocumentFile file, bool readOnly) {  // any thread
    auto made = std::make_shared<Room>(std::move(file), options, bodies, workers, readOnly);
    made->predicted = [this](FittingPtr fitting) {
      predicted.publish(std::move(fitting));
      if (options.wake) options.wake();
    };
    return made;
  }

  // Asks a gesture's newest question, one at a time.
  void ask(Ask question) {
    if (std::holds_alternative<std::monostate>(question)) return;
    next = std::move(question);
    askNext();
  }
  void askNext() {
    if (asking || std::holds_alternative<std::monostate>(next)) return;
    interruptSettling();
    asking = true;
    const Gesture* asker = gesture.get();
    line.add(TaskLine::Kind::Preview, [this, asker, question = std::exchange(next, {})](const Token& token) {
      Answer answer;
      FittingPtr look;
      if (const auto* pull = std::get_if<AskPull>(&question)) {
        if (const auto force = room->pullTo(*pull, token, look))
          answer.force = *force;
        else if (force.error().kind != Error::Kind::Cancelled)
          answer.why = force.error().what;
      } else {
        const auto after = room->after(std::get<AskAfter>(question).operation, token);
        if (after)
          look = answer.after = *after;
        else if (after.error().kind != Error::Kind::Cancelled)
          answer.why = after.error().what;
      }
      return [this, asker, answer, look] {
        asking = false;
        if (gesture.get() == asker && gesture->begun()) {
          gesture->answered(answer);
          if (look) preview = look, ++news.garment, ++news.predicted;
          ++news.overlay;
        }
        askNext();
      };
    });
  }

  void told(Told answer, bool begunBefore) {
    if (answer.why) tell(Notice::Kind::Refused, *answer.why);
    if (!answer.over) return ask(std::move(answer.ask));
    line.cancel(TaskLine::Kind::Preview);
    asking = false;
    next = {};
    const bool performs = answer.operation.has_value();
    if (performs) {
      perform(std::move(*answer.operation));
    } else {
      if (preview && !settlingNow()) preview.reset(), ++news.garment;
      if (begunBefore) settleInterrupted();
    }
    gesture = gestureFor(tool);
    ++news.overlay;
  }
};

Session::Session(SessionOptions options) : inside_(std::make_unique<Inside>(std::move(options))) {}
Session::~Session() = default;

void Session::begin(DocumentFile file) {
  auto& in = *inside_;
  const auto made = in.roomOf(std::move(file), false);
  in.longWork([made](const Token&) -> Result<std::shared_ptr<Room>> { return made; }, {});
}

void Session::create(const std::filesystem::path& path) {
  auto& in = *inside_;
  in.longWork(
      [&in, path](const Token&) -> Result<std::shared_ptr<Room>> {
        auto file = DocumentFile::create(path);
        if (!file) return file.error();
        return in.roomOf(*std::move(file), false);
      },
      {});
}

void Session::open(const std::filesystem::path& path) {
  auto& in = *inside_;
  in.longWork(
      [&in, path](const Token& token) -> Result<std::shared_ptr<Room>> {
        // The one that is open here would refuse itself.
        if (std::error_code same;
            !in.room->file().path().empty() && std::filesystem::equivalent(in.room->file().path(), path, same))
          return in.room;
        MemoryBlobs none;
        Context how{*in.workers, token, none, *in.bodies, {}, {}};
        auto file = DocumentFile::open(path, &how);
        if (file) return in.roomOf(*std::move(file), false);
        if (file.error().kind != Error::Kind::Storage) return file.error();
        auto reading = DocumentFile::openForReading(path, &how);
        if (!reading) return file.error();
        return in.roomOf(*std::move(reading), true);
      },
      {});
}

void Session::saveCopy(const std::filesystem::path& path) {
  auto& in = *inside_;
  in.longWork(
      [&in, path](const Token&) -> Result<std::shared_ptr<Room>> {
        if (const Done done = in.room->moveTo(path); !done) return done.error();
        return in.room;
      },
      say("Kept as “{0}”; every step is saved at once.", path.filename().string()));
}

void Session::replayOn(SetBody body, const std::filesystem::path& path) {
  auto& in = *inside_;
  in.longWork(
      [&in, body, path](const Token& token) -> Result<std::shared_ptr<Room>> {
        auto file = DocumentFile::create(path);
        if (!file) return file.error();
        const auto made = in.roomOf(*std::move(file), false);
        const auto give = [&](const Error& error) -> Result<std::shared_ptr<Room>> {
          made->file() = DocumentFile::inMemory();
          std::error_code trouble;
          std::filesystem::remove(path, trouble);
          return error;
        };
        if (const auto step = made->perform(body, token); !step) return give(step.error());
        const std::vector<Step> steps = in.room->file().steps();
        for (std::size_t i = 0; i < steps.size(); ++i) {
          token.progress(static_cast<double>(i) / static_cast<double>(steps.size()),
                         say("Sewing it for the new figure"));
          if (std::holds_alternative<SetBody>(steps[i].operation)) continue;
          if (const auto step = made->perform(steps[i].operation, token); !step)
            return give({step.error().kind, say("Step {0}: {1}", i + 1, step.error().what)});
        }
        return made;
      },
      say("Made again for the new figure, as “{0}”.", path.filename().string()));
}

void Session::importBody(const std::filesystem::path& file) {
  auto& in = *inside_;
  in.longWork(
      [&in, file](const Token& token) -> Result<std::shared_ptr<Room>> {
        std::vector<Message> notes;
        if (const Done done = importBodyInto(*in.room, file, token, notes); !done) return done.error();
        return in.room;
      },
      say("“{0}” was read.", file.filename().string()));
  in.viewAsked = Command::ViewAll;
}

void Session::importPattern(const std::filesystem::path& file) {
  auto& in = *inside_;
  in.longWork(
      [&in, file](const Token& token) -> Result<std::shared_ptr<Room>> {
        if (const Done done = importPatternInto(*in.room, file, token); !done) return done.error();
        return in.room;
      },
      say("“{0}” was read.", file.filename().string()));
}

void Session::exportTo(const std::filesystem::path& file, double allowance, bool a4, Language language) {
  auto& in = *inside_;
  const auto fitting = in.state.fitting;
  in.line.add(TaskLine::Kind::Step, [this, fitting, file, allowance, a4, language](const Token&) {
    const Done done = exportFrom(*fitting, inside_->room->file().log(), {file, allowance, a4, language});
    return [this, done, file] {
      if (done)
        inside_->tell(Notice::Kind::Said, say("“{0}” was written.", file.string()));
      else
        inside_->tellError(done.error());
    };
  });
}

const std::filesystem::path& Session::path() const { return inside_->state.path; }
bool Session::readOnly() const { return inside_->state.readOnly; }
const Fitting& Session::fitting() const { return *inside_->state.fitting; }
FittingPtr Session::shownPtr() const { return inside_->preview ? inside_->preview : inside_->state.fitting; }
const Fitting& Session::shown() const { return *(inside_->preview ? inside_->preview : inside_->state.fitting); }
const Table& Session::table() const { return inside_->table; }
const std::vector<Step>& Session::steps() const { return inside_->state.steps; }
const std::vector<Step>& Session::undone() const { return inside_->state.undone; }
const Selection& Session::selection() const { return inside_->selection; }
Command Session::tool() const { return inside_->tool; }
Preview Session::preview() const { return inside_->gesture->preview(inside_->bench()); }
const SessionNews& Session::news() const { return inside_->news; }
std::vector<Notice> Session::takeNotices() { return std::exchange(inside_->notices, {}); }
std::optional<Command> Session::takeView() { return std::exchange(inside_->viewAsked, std::nullopt); }

Message Session::hint() const {
  if (inside_->hot) return info(*inside_->hot).hint;
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

void Session::feed(const PointerSample& sample) {
  auto& in = *inside_;
  ++in.news.overlay;
  using Phase = PointerSample::Phase;
  // The menu comes first, unless a drag is on its way across it.
  if (in.sight && sample.where == PointerSample::Where::Space &&
      (sample.phase == Phase::Hover || sample.phase == Phase::Press || in.onMenu)) {
    const ScenePanel panel = menuPanel(*in.sight, {});
    const auto hit = menuHit(panel, sample.ray);
    const bool board = meets(panel, sample.ray);
    in.hot = hit;
    if (sample.phase == Phase::Press && board) {
      in.onMenu = true;
      if (hit) command(*hit == Command::ViewOblique ? Command::ViewAll : *hit);
      return;
    }
    if (in.onMenu) {
      if (sample.phase == Phase::Release) in.onMenu = false;
      return;
    }
    if (board) return;
  } else {
    in.hot.reset();
  }
  const bool begun = in.gesture->begun();
  const Hit hit = pick(*in.state.fitting, in.table, sample);
  Told told = in.gesture->feed(sample, hit, in.bench());
  if (const auto chosen = in.gesture->chosen()) select(*chosen);
  if (const auto aside = in.gesture->laidAside()) in.table.carry(aside->first, aside->second);
  if (sample.phase == Phase::Press && in.gesture->begun() && hit.piece && in.tool != Command::Draw) {
    Selection selection;
    selection.pieces = {hit.piece};
    selection.edge = hit.edge;
    select(selection);
  }
  in.told(std::move(told), begun);
}

void Session::select(Selection selection) {
  if (selection == inside_->selection) return;
  inside_->selection = std::move(selection);
  ++inside_->news.overlay;
  if (inside_->options.wake) inside_->options.wake();
}

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
      return !document.pattern.pieces.empty() && !in.state.readOnly;
    case Command::Undo:
      return in.gesture->begun() || in.settlingNow() || (!in.state.steps.empty() && !in.state.readOnly);
    case Command::Redo:
      return !in.state.undone.empty() && !in.state.readOnly;
    case Command::Settle:
      return in.settlingNow() || (!document.pattern.pieces.empty() && document.body.chosen() && !in.state.readOnly);
    case Command::Confirm:
      return in.gesture->begun();
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
      if (in.gesture->begun()) {
        in.dropGesture();
        in.settleInterrupted();
        return;
      }
      in.line.cancel(TaskLine::Kind::Settle);
      in.settling.clear(), in.interrupted.clear();
      if (in.tool != Command::Select) in.tool = Command::Select, in.gesture = gestureFor(in.tool);
      return;
    case Command::Settle: {
      if (in.settlingNow()) {
        in.line.cancel(TaskLine::Kind::Settle);
        in.settling.clear(), in.interrupted.clear();
        return;
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
    case Command::FlipSeam: {
      const Seam seam = *in.state.fitting->document.find(in.selection.seam);
      SewEdges sew;
      for (const EdgeSpan& s : seam.a) sew.a.push_back({PieceRef(s.piece), s.edge, s.from, s.to});
      for (const EdgeSpan& s : seam.b) sew.b.push_back({PieceRef(s.piece), s.edge, s.from, s.to});
      sew.name = seam.name;
      sew.reversed = seam.reversed ? Choice::No : Choice::Yes;
      sew.tie = seam.tie == Seam::Tie::TwoToOne ? SewEdges::Tie::TwoToOne : SewEdges::Tie::OneToOne;
      in.perform(Unsew{{SeamRef(seam.id)}});
      return in.perform(std::move(sew));
    }
    default:
      in.viewAsked = command;
  }
}

void Session::perform(Operation operation) { inside_->perform(std::move(operation)); }

void Session::goTo(std::size_t steps) {
  auto& in = *inside_;
  in.leave();
  in.line.add(TaskLine::Kind::Step, [this, steps](const Token& token) {
    std::optional<Error> why;
    Room& room = *inside_->room;
    while (!why && room.file().steps().size() != steps) {
      const Result<Step> step = room.file().steps().size() > steps ? room.undo(token) : room.redo(token);
      if (!step) why = step.error();
    }
    const auto fresh = std::make_shared<RoomState>(room.state(token));
    return [this, why, fresh] {
      if (why) inside_->tellError(*why);
      inside_->take(*fresh);
    };
  });
}

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

}  // namespace karinui

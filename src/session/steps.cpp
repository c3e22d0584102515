// Steps of the document's history, asked for by the hand and taken in when they are done.
#include <algorithm>
#include <utility>

#include "session/session_impl.h"

namespace karinui {

namespace {

bool drapes(const Operation& op) {
  return std::holds_alternative<DrapePieces>(op) || std::holds_alternative<PullCloth>(op);
}

// What an edge is called now: another name, where the step before or its undoing gave it one.
std::optional<std::string> renamed(const Piece& was, const Piece& is, const std::string& edge) {
  const auto in = [&](const Outline& before, const Outline& now) -> std::optional<std::string> {
    const auto k = before.find(edge);
    if (!k || before.edges.size() != now.edges.size() || findEdge(was, now.edges[*k].name)) return std::nullopt;
    return now.edges[*k].name;
  };
  if (const auto name = in(was.outline, is.outline)) return name;
  for (std::size_t h = 0; h < std::min(was.holes.size(), is.holes.size()); ++h)
    if (const auto name = in(was.holes[h], is.holes[h])) return name;
  return std::nullopt;
}

}  // namespace

void Session::Impl::take(DocumentState fresh) {
  const SnapshotPtr before = state.snapshot;
  state = std::move(fresh);
  dropFigure();
  preview.reset();
  if (state.snapshot->trouble) tell(Notice::Kind::Advice, *state.snapshot->trouble);
  takeAdvice(*before);
  dropMenuSaid.clear();
  table.arrange(*state.snapshot);
  if (drawnAt)
    for (const auto& [id, piece] : state.snapshot->document.pattern.pieces)
      if (drawnAt && !before->document.find(id)) table.carry(id, *drawnAt - table.at(id)), drawnAt.reset();
  std::erase_if(selection.pieces, [&](PieceId id) { return !state.snapshot->document.find(id); });
  const auto gone = [&](EdgeNear& edge) {  // its name may be another one now
    const Piece* piece = state.snapshot->document.find(edge.piece);
    if (piece && findEdge(*piece, edge.edge)) return false;
    const Piece* was = before->document.find(edge.piece);
    const auto name = was && piece ? renamed(*was, *piece, edge.edge) : std::nullopt;
    if (name) edge.edge = *name;
    return !name;
  };
  std::erase_if(selection.more, gone);
  if (selection.edge && gone(*selection.edge)) {
    selection.edge.reset();
    if (!selection.more.empty()) selection.edge = selection.more.back(), selection.more.pop_back();
  }
  selection.line.clear(), selection.mark.reset();  // the step may have been about them
  if (selection.seam && !state.snapshot->document.find(selection.seam)) selection.seam = {};
  ++changes.garment, ++changes.history, ++changes.overlay;
}

void Session::Impl::makeReady() {
  const SnapshotPtr& now = state.snapshot;
  if (!now->body || now->body == ready || options.drape) return;
  ready = now->body;
  tasks.add(TaskQueue::Kind::Preview, [this, now](const Token& token) {
    const DistanceField& field = now->body->field();
    for (const SceneCloth& cloth : now->frame.cloths)
      workers->forBlocks(cloth.mesh.points.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end && !token.cancelled(); ++k) (void)field.distance(cloth.mesh.points[k]);
      });
    if (!token.cancelled()) (void)now->body->lines();
    if (token.cancelled()) return TaskQueue::Finish();
    Context own = documentWorker->context(token);
    if (const auto skeleton = bodies->skeleton(now->document.body, own.blobs, *workers, token)) (*skeleton)->prepare();
    return TaskQueue::Finish();
  });
}

// What was advised holds until its piece changes.
void Session::Impl::takeAdvice(const GarmentSnapshot& before) {
  const auto pieceOf = [](const GarmentSnapshot& snapshot, PieceId id) { return snapshot.document.find(id); };
  std::erase_if(advice, [&](const Advice& one) {
    return !pieceOf(*state.snapshot, one.piece) || pieceOf(*state.snapshot, one.piece) != pieceOf(before, one.piece);
  });
  for (Advice& fresh : std::exchange(state.advice, {})) {
    if (std::find(dropMenuSaid.begin(), dropMenuSaid.end(), text(fresh.what)) == dropMenuSaid.end())
      tell(Notice::Kind::Advice, fresh.what);
    if (pieceOf(*state.snapshot, fresh.piece)) advice.push_back(std::move(fresh));
  }
}

void Session::Impl::perform(Operation operation) {
  if (state.readOnly)
    return tell(Notice::Kind::Refused, say("This garment was opened for reading only; keep a copy to work on it."));
  if (const auto* drape = std::get_if<DrapePieces>(&operation)) {
    std::set<PieceId> live;
    for (const PieceRef& ref : drape->live) {
      const Document& document = state.snapshot->document;
      const Piece* piece = ref.id ? document.find(ref.id) : document.pieceNamed(ref.name);
      if (!piece) return tell(Notice::Kind::Refused, say("There is no piece “{0}”.", ref.name));
      live.insert(piece->id);
    }
    return settle(live, false, *drape);
  }
  interruptSettling();
  const auto before = state.snapshot;
  const bool poses = std::holds_alternative<PoseBody>(operation);
  const auto kind = poses ? TaskQueue::Kind::Pose : TaskQueue::Kind::Step;
  tasks.add(kind, [this, before, poses, operation = std::move(operation)](const Token& token) mutable {
    Result<Step> step = documentWorker->perform(std::move(operation), token);
    const auto fresh = std::make_shared<DocumentState>(documentWorker->state(token));
    return [this, before, poses, step = std::move(step), fresh] {
      (void)predicted.take();  // what was seen on the way to this is over
      const bool stopped = poses && std::exchange(poseStopped, false);
      if (!step) {
        tellError(step.error());
        if (stopped) tell(Notice::Kind::Said, say("Stopped; nothing was changed."));
        drawnAt.reset();
        preview.reset();
        ++changes.garment, ++changes.overlay;
        return settleInterrupted();
      }
      const SnapshotPtr seen = preview;
      take(*fresh);
      if (stopped) return turn(true);                                 // it had arrived already
      if (std::holds_alternative<DuplicatePiece>(step->operation)) {  // what is done next is done to the copy
        Selection copies;
        for (const auto& [id, piece] : state.snapshot->document.pattern.pieces)
          if (!before->document.find(id)) copies.pieces.insert(id);
        choose(std::move(copies));
      }
      if (drapes(step->operation)) ++changes.settled;
      if (const auto* sew = std::get_if<SewEdges>(&step->operation); sew && sew->mirror)
        tell(Notice::Kind::Said, say("Sewn, and its mirror image too; one undo takes both back."));
      if (std::holds_alternative<PullCloth>(step->operation))
        if (const auto& last = state.snapshot->document.drape.last; last && !last->why.empty())
          tell(Notice::Kind::Said, last->why);
      if (options.autoSettle)
        for (const PieceId id : disturbedBy(before->document, state.snapshot->document, step->operation))
          schedule.disturb(id);
      settleInterrupted();
      // What the drag showed of this very garment stays until the drape has something better to show.
      if (seen && settlingNow() && hash(seen->document) == hash(state.snapshot->document))
        preview = seen, ++changes.garment;
    };
  });
}

void Session::Impl::turn(bool back) {
  if (back && posingNow() && !tasks.busy(TaskQueue::Kind::Step)) return stopPosing();
  const bool wasAsked = settlingNow() && !schedule.automatic();
  schedule.drop();
  if (settlingNow()) {
    tasks.cancel(TaskQueue::Kind::Settle);
    preview.reset();
    ++changes.garment;
    if (back && wasAsked) return tell(Notice::Kind::Said, say("Stopped; nothing was changed."));
  }
  if (const auto there = otherWay(back)) {
    Amended& way = amended[*there];
    if (back) way.tip = state.undone.empty() ? head() : state.undone.back().seq;
    return back ? goTo(way.before) : goTo(way.after, way.tip);
  }
  const auto own = schedule.automaticSteps();
  tasks.add(TaskQueue::Kind::Step, [this, back, own](const Token& token) {
    // A drape that came by itself goes and comes with its cause.
    const auto goesAlong = [&](const Step& drape) {
      return own.contains(drape.seq) || documentWorker->cameByItself(drape, token);
    };
    Result<Step> step = back ? documentWorker->undo(token) : documentWorker->redo(token);
    while (step && back && goesAlong(*step)) step = documentWorker->undo(token);
    while (step && !back) {
      const auto waiting = documentWorker->file().undone();
      if (waiting.empty() || !goesAlong(waiting.front()) || !documentWorker->redo(token)) break;
    }
    const auto fresh = std::make_shared<DocumentState>(documentWorker->state(token));
    return [this, step = std::move(step), fresh] {
      if (!step) return tellError(step.error());
      take(*fresh);
    };
  });
}

void Session::Impl::goTo(std::uint64_t seq, std::uint64_t towards) {
  dropGesture();
  dropSettling();
  tasks.add(TaskQueue::Kind::Step, [this, seq, towards](const Token& token) {
    const Done done = documentWorker->goTo(seq, towards, token);
    const auto fresh = std::make_shared<DocumentState>(documentWorker->state(token));
    return [this, done, fresh] {
      if (!done) tellError(done.error());
      take(*fresh);
    };
  });
}

std::optional<std::size_t> Session::Impl::otherWay(bool back) const {
  for (std::size_t k = amended.size(); k-- > 0;) {
    if (back && amended[k].after == head()) return k;
    if (!back && amended[k].before == head() && state.undone.empty()) return k;
  }
  return std::nullopt;
}

void Session::perform(Operation operation) { impl_->perform(std::move(operation)); }

void Session::goTo(std::size_t steps) {
  const auto& in = *impl_;
  const auto& done = in.state.steps;
  const auto& undone = in.state.undone;
  if (steps == done.size() || steps > done.size() + undone.size()) return;
  impl_->goTo(steps == 0 ? 0 : steps < done.size() ? done[steps - 1].seq : undone[steps - done.size() - 1].seq);
}

const std::vector<Step>& Session::otherBranches() const { return impl_->state.otherBranches; }
void Session::switchBranch(const Step& end) { impl_->goTo(end.seq); }

void Session::amend(std::size_t which, Operation operation) { impl_->amend(which, std::move(operation)); }

void Session::Impl::amend(std::size_t which, Operation operation, std::function<void(const Done&)> then) {
  KARINUI_ASSERT(which >= 1 && which <= state.steps.size());
  // What a reshape led to is kept with it; pulled otherwise it leads elsewhere.
  if (auto* now = std::get_if<ReshapePiece>(&operation))
    if (const auto* old = std::get_if<ReshapePiece>(&state.steps[which - 1].operation);
        old && now->outline == old->outline && !(*now == *old) && !now->at.empty())
      now->outline = {};
  dropGesture();
  dropSettling();
  const std::uint64_t old = head();
  const bool figure = std::holds_alternative<SetBody>(operation), last = which == state.steps.size();
  past = true;
  ++changes.garment;
  tasks.add(TaskQueue::Kind::Settle, [this, which, old, figure, last, operation = std::move(operation),
                                      then = std::move(then)](const Token& token) mutable {
    const Done done = documentWorker->amend(which, std::move(operation), token);
    const auto fresh = std::make_shared<DocumentState>(documentWorker->state(token));
    return [this, done, old, which, figure, last, fresh, then = std::move(then)] {
      past = false;
      if (done) {
        take(*fresh);
        amended.push_back({old, head()});
        if (!last)
          tell(Notice::Kind::Said, figure ? say("The garment was made again for the changed figure.")
                                          : say("Step {0} was changed, and all that followed done again.", which));
        else if (!figure)  // a figure that wears nothing yet shows by itself that it was changed
          tell(Notice::Kind::Said, say("Step {0} was changed.", which));
      } else {
        tellError(done.error());
        preview.reset();
        ++changes.garment;
      }
      if (then) then(done);
    };
  });
}

void Session::snapshotAfter(std::uint64_t seq, std::function<void(SnapshotPtr)> then) {
  auto& in = *impl_;
  in.tasks.add(TaskQueue::Kind::SnapshotAfter,
               [this, seq, of = in.documents, then = std::move(then)](const Token& token) {
                 SnapshotPtr found = impl_->documentWorker->snapshotAfter(seq, token);
                 return [this, of, then, found] {
                   if (of == impl_->documents) then(found);
                 };
               });
}

void Session::recipe(std::function<void(Result<RecipePtr>)> then) {
  auto& in = *impl_;
  in.tasks.add(TaskQueue::Kind::SnapshotAfter, [this, of = in.documents, then = std::move(then)](const Token& token) {
    Context context = impl_->documentWorker->context(token);
    Result<RecipePtr> found = recipeOf(impl_->documentWorker->file(), context);
    return [this, of, then, found] {
      if (of == impl_->documents) then(found);
    };
  });
}

}  // namespace karinui

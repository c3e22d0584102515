// Steps of the document's history, asked for by the hand and taken in when they are done.
#include <algorithm>
#include <utility>

#include "session/inside.h"

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
         std::holds_alternative<SetBody>(op) || std::holds_alternative<AddDart>(op) ||
         std::holds_alternative<JoinEdges>(op) || std::holds_alternative<FlipSeam>(op) ||
         std::holds_alternative<SetLength>(op);
}

}  // namespace

void Session::Inside::take(RoomState fresh) {
  const FittingPtr before = state.fitting;
  state = std::move(fresh);
  dropFigure();
  preview.reset();
  if (state.fitting->trouble) tell(Notice::Kind::Advice, *state.fitting->trouble);
  takeAdvice(*before);
  answered.clear();
  table.arrange(*state.fitting);
  std::erase_if(selection.pieces, [&](PieceId id) { return !state.fitting->document.find(id); });
  if (selection.edge)
    if (const Piece* piece = state.fitting->document.find(selection.edge->piece);
        !piece || !findEdge(*piece, selection.edge->edge))
      selection.edge.reset();
  selection.line.clear(), selection.mark.reset();  // the step may have been about them
  if (selection.seam && !state.fitting->document.find(selection.seam)) selection.seam = {};
  ++news.garment, ++news.history, ++news.overlay;
  // The first drape and the first pull need to know how far everything is from the skin: find out while nobody waits.
  if (state.fitting->body && state.fitting->body != ready && !options.drape) {
    ready = state.fitting->body;
    line.add(TaskLine::Kind::Preview, [this, body = ready](const Token& token) {
      (void)body->prepareField(*workers, token);
      (void)body->lines();
      return TaskLine::Finish();
    });
  }
}

// What was advised holds until its piece changes.
void Session::Inside::takeAdvice(const Fitting& before) {
  const auto pieceOf = [](const Fitting& fitting, PieceId id) { return fitting.document.find(id); };
  std::erase_if(advice, [&](const Advice& one) {
    return !pieceOf(*state.fitting, one.piece) || pieceOf(*state.fitting, one.piece) != pieceOf(before, one.piece);
  });
  for (Advice& fresh : std::exchange(state.advice, {})) {
    if (std::find(answered.begin(), answered.end(), text(fresh.what)) == answered.end())
      tell(Notice::Kind::Advice, fresh.what);
    if (pieceOf(*state.fitting, fresh.piece)) advice.push_back(std::move(fresh));
  }
}

void Session::Inside::perform(Operation operation) {
  if (const auto* drape = std::get_if<DrapePieces>(&operation)) {
    std::set<PieceId> live;
    for (const PieceRef& ref : drape->live) {
      const Document& document = state.fitting->document;
      const Piece* piece = ref.id ? document.find(ref.id) : document.pieceNamed(ref.name);
      if (!piece) return tell(Notice::Kind::Refused, say("There is no piece “{0}”.", ref.name));
      live.insert(piece->id);
    }
    return settle(live, false, *drape);
  }
  interruptSettling();
  const auto before = state.fitting;
  line.add(TaskLine::Kind::Step, [this, before, operation = std::move(operation)](const Token& token) mutable {
    const bool disturbing = disturbs(operation);
    Result<Step> step = room->perform(std::move(operation), token);
    const auto fresh = std::make_shared<RoomState>(room->state(token));
    return [this, before, disturbing, step = std::move(step), fresh] {
      if (!step) {
        tellError(step.error());
        preview.reset();
        ++news.garment, ++news.overlay;
        return settleInterrupted();
      }
      take(*fresh);
      if (drapes(step->operation)) ++news.settled;
      if (const auto* sew = std::get_if<SewEdges>(&step->operation); sew && sew->mirror)
        tell(Notice::Kind::Said, say("Sewn, and its mirror image too; one undo takes both back."));
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

void Session::Inside::turn(bool back) {
  interrupted.clear();
  const bool wasAsked = settlingNow() && !settlingByItself;
  if (settlingNow()) {
    settling.clear();
    line.cancel(TaskLine::Kind::Settle);
    preview.reset();
    ++news.garment;
    if (back && wasAsked) return tell(Notice::Kind::Said, say("Stopped; nothing was changed."));
  }
  if (const auto there = otherWay(back)) return goTo(*there);
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

void Session::Inside::goTo(std::uint64_t seq) {
  dropGesture();
  dropSettling();
  line.add(TaskLine::Kind::Step, [this, seq](const Token& token) {
    const Done done = room->goTo(seq, token);
    const auto fresh = std::make_shared<RoomState>(room->state(token));
    return [this, done, fresh] {
      if (!done) tellError(done.error());
      take(*fresh);
    };
  });
}

std::optional<std::uint64_t> Session::Inside::otherWay(bool back) const {
  for (auto way = amended.rbegin(); way != amended.rend(); ++way) {
    if (back && way->second == head()) return way->first;
    if (!back && way->first == head() && state.undone.empty()) return way->second;
  }
  return std::nullopt;
}

void Session::perform(Operation operation) { inside_->perform(std::move(operation)); }

void Session::goTo(std::size_t steps) {
  const auto& in = *inside_;
  const auto& done = in.state.steps;
  const auto& undone = in.state.undone;
  if (steps == done.size() || steps > done.size() + undone.size()) return;
  inside_->goTo(steps == 0 ? 0 : steps < done.size() ? done[steps - 1].seq : undone[steps - done.size() - 1].seq);
}

const std::vector<Step>& Session::otherEnds() const { return inside_->state.otherEnds; }
void Session::takeWay(const Step& end) { inside_->goTo(end.seq); }

void Session::amend(std::size_t which, Operation operation) {
  auto& in = *inside_;
  KARINUI_ASSERT(which >= 1 && which <= in.state.steps.size());
  // What a reshape led to is kept with it; pulled otherwise it leads elsewhere.
  if (auto* now = std::get_if<ReshapePiece>(&operation))
    if (const auto* old = std::get_if<ReshapePiece>(&in.state.steps[which - 1].operation);
        old && now->outline == old->outline && !(*now == *old) && !now->at.empty())
      now->outline = {};
  in.dropGesture();
  in.dropSettling();
  in.settlingByItself = false;
  const std::uint64_t old = in.head();
  in.line.add(TaskLine::Kind::Settle, [this, which, old, operation = std::move(operation)](const Token& token) mutable {
    auto& inside = *inside_;
    const Done done = inside.room->amend(which, std::move(operation), token);
    const auto fresh = std::make_shared<RoomState>(inside.room->state(token));
    return [this, done, old, which, fresh] {
      auto& own = *inside_;
      if (!done) {
        own.tellError(done.error());
        own.preview.reset();
        ++own.news.garment;
        return;
      }
      own.take(*fresh);
      own.amended.push_back({old, own.head()});
      own.tell(Notice::Kind::Said, say("Step {0} was changed, and all that followed done again.", which));
    };
  });
}

void Session::glimpse(std::uint64_t seq, std::function<void(FittingPtr)> then) {
  auto& in = *inside_;
  in.line.add(TaskLine::Kind::Glimpse, [this, seq, of = in.documents, then = std::move(then)](const Token& token) {
    FittingPtr found = inside_->room->glimpse(seq, token);
    return [this, of, then, found] {
      if (of == inside_->documents) then(found);
    };
  });
}

}  // namespace karinui

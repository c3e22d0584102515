#include "session/document_worker.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "karinui/base/file.h"
#include "karinui/design/script.h"
#include "karinui/exchange/formats.h"
#include "session/carried_shape.h"
#include "session/clear_of_skin.h"
#include "session/settle_schedule.h"

namespace karinui {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetween = std::chrono::milliseconds(40);  // two looks at cloth on its way, at least,
constexpr std::size_t kDrapes = 6;                        // kept in memory
constexpr int kShare = 5;                                 // and looking takes no more than so small a share of the time

}  // namespace

Context DocumentWorker::context(const Token& token) {
  Context context{*workers_, token, file_.blobs(), *bodies_, {}, options_.pull};
  context.advise = [this](const Advice& advice) { advice_.push_back(advice); };
  context.drape = [this](const Document& document, const DrapePieces& drape, Context& own) {
    const std::string key = hash(document) + drapeHash(document) + text(Operation(drape));
    for (const auto& [of, outcome] : drapes_)
      if (of == key) return Result<DrapeOutcome>(outcome);
    Result<DrapeOutcome> outcome = draped(document, drape, own);
    if (outcome && outcome->report.stoppedAfter == 0) drapes_.emplace_front(key, *outcome);
    if (drapes_.size() > kDrapes) drapes_.pop_back();
    return outcome;
  };
  return context;
}

Result<DrapeOutcome> DocumentWorker::draped(const Document& document, const DrapePieces& drape, Context& own) {
  if (options_.drape) return options_.drape(document, drape, own);
  if (!predicted) return drapeOnBody(document, drape, own);
  Clock::time_point next = Clock::now();
  SnapshotPtr start;
  return drapeOnBody(document, drape, own, [&](const FormsNow& forms) {
    const auto now = Clock::now();
    if (now < next || own.token.cancelled()) return;
    if (!start) start = fitted(document, own.token);
    if (const Forms here = forms(); !onlyFine_ || asFine(*start, here)) predicted(snapshotStanding(*start, here));
    next = Clock::now() + std::max<Clock::duration>(kBetween, kShare * (Clock::now() - now));
  });
}

PoseOnlooker DocumentWorker::onlooker(const Token& token) {
  if (!predicted) return {};
  return [this, &token, next = Clock::time_point::min()](const PoseUnderWay& way) mutable {
    const auto now = Clock::now();
    if (now < next || token.cancelled()) return;
    if (!latest_) latest_ = fitted(file_.document(), token);
    predicted(snapshotUnderWay(*latest_, way));
    next = Clock::now() + std::max<Clock::duration>(kBetween, kShare * (Clock::now() - now));
  };
}

Prints DocumentWorker::prints() {
  return [this](const std::string& photo) { return shelf_.find(photo, file_.blobs()); };
}

SnapshotPtr DocumentWorker::fitted(Document document, const Token& token) {
  BodyPtr body;
  if (document.body.chosen()) {
    Context own = context(token);
    if (auto found = bodyOf(document, own)) body = *found;
  }
  return snapshotOf(std::move(document), std::move(body), prints());
}

Result<Step> DocumentWorker::perform(Operation operation, const Token& token, StopRequest* stop) {
  const auto* body = std::get_if<SetBody>(&operation);
  if (const Done file = beginDraft(body ? body->size : std::string()); !file) return file.error();
  Context own = context(token);
  own.stop = stop;
  own.onPose = onlooker(token);
  Result<Step> step = file_.perform(std::move(operation), own);
  latest_.reset();
  if (!step) dropEmptyDraft();
  if (step) nameAfterGarment(&step->operation);
  return step;
}
Result<Step> DocumentWorker::undo(const Token& token) {
  Context own = context(token);
  return file_.undo(own);
}
Result<Step> DocumentWorker::redo(const Token& token) {
  Context own = context(token);
  return file_.redo(own);
}

std::uint64_t DocumentWorker::newestOf(const DocumentFile& file) {
  std::uint64_t newest = 0;
  for (const auto& steps : {file.steps(), file.undone(), file.otherBranches()})
    for (const Step& step : steps) newest = std::max(newest, step.seq);
  return newest;
}

bool DocumentWorker::cameByItself(const Step& drape, const Token& token) {
  const auto* op = std::get_if<DrapePieces>(&drape.operation);
  const std::vector<Step> steps = file_.steps();
  if (!op || drape.seq > opened_ || steps.empty() || !options_.autoSettle) return false;
  std::set<PieceId> live;
  for (const PieceRef& piece : op->live) live.insert(piece.id);
  if (!(*op == drapeOf(live))) return false;  // of another kind
  const Document& after = file_.document();
  const Step& cause = steps.back();
  if (const auto* other = std::get_if<DrapePieces>(&cause.operation)) {
    std::set<PieceId> rested;
    for (const PieceRef& piece : other->live) rested.insert(piece.id);
    // It took along what the one before had pulled at, which stood at rest till then.
    return live.size() > rested.size() && std::includes(live.begin(), live.end(), rested.begin(), rested.end()) &&
           std::none_of(live.begin(), live.end(), [&](PieceId id) {
             const Piece* piece = after.find(id);  // a file may name one that is not there
             return !rested.contains(id) && (!piece || piece->frozen || after.drape.dirty.contains(id));
           });
  }
  Context own = context(token);
  const Result<Document> before = file_.documentAfter(cause.parent, own);
  if (!before) return false;
  std::set<PieceId> disturbed = disturbedBy(*before, after, cause.operation);
  std::erase_if(disturbed, [&](PieceId id) { return after.find(id)->frozen; });
  const auto& dirty = after.drape.dirty;  // what an interrupted drape had left is among them
  return !disturbed.empty() && std::includes(live.begin(), live.end(), disturbed.begin(), disturbed.end()) &&
         std::includes(dirty.begin(), dirty.end(), live.begin(), live.end());
}

Done DocumentWorker::goTo(std::uint64_t seq, std::uint64_t towards, const Token& token) {
  Context own = context(token);
  if (towards != 0)
    if (Done done = file_.goTo(towards, own); !done) return done;
  return file_.goTo(seq, own);
}
Done DocumentWorker::amend(std::size_t which, Operation operation, const Token& token) {
  Context own = context(token);
  own.advise = {};  // every step after it is done anew
  Done done = file_.amend(which, std::move(operation), own);
  if (done) nameAfterGarment(nullptr);
  return done;
}

DocumentState DocumentWorker::state(const Token& token) {
  pull_.reset();
  latest_ = fitted(file_.document(), token);
  return {latest_,
          file_.steps(),
          file_.undone(),
          file_.otherBranches(),
          file_.path(),
          readOnly_,
          std::exchange(advice_, {})};
}

SnapshotPtr DocumentWorker::snapshotAfter(std::uint64_t seq, const Token& token) {
  Context own = context(token);
  Result<Document> document = file_.documentAfter(seq, own);
  return document ? fitted(*std::move(document), token) : nullptr;
}

Result<SnapshotPtr> DocumentWorker::after(const OperationPreview& preview, const Token& token) {
  Context own = context(token);
  own.advise = {};
  after_.reset();
  Result<Document> document = apply(file_.document(), preview.operation, own);
  if (!document) return document.error();
  if (!preview.settle) return fitted(*std::move(document), token);
  after_ = *document;
  return fitted(carriedAlong(file_.document(), *std::move(document)), token);
}

Result<SnapshotPtr> DocumentWorker::settleAfter(const std::set<PieceId>& live, const Token& token) {
  if (!after_) return cancelled();
  Context own = context(token);
  own.advise = {};
  onlyFine_ = true;
  const Result<Document> document = apply(*after_, drapeOf(live), own);
  onlyFine_ = false;
  if (!document) return document.error();
  return fitted(*document, token);
}

Result<SnapshotPtr> DocumentWorker::onFigure(const SetBody& body, const Token& token) {
  Bodies passing;
  Context own{*workers_, token, file_.blobs(), passing, {}, {}};
  Result<Document> document = apply(file_.document(), body, own);
  if (!document) return document.error();
  Result<BodyPtr> figure = bodyOf(*document, own);
  if (!figure) return figure.error();
  return snapshotOf(clearOfSkin(*std::move(document), **figure, *workers_), *figure, prints());
}

Result<Vec3> DocumentWorker::pullTo(const PullPreview& pull, const Token& token, SnapshotPtr& shown) {
  Context own = context(token);
  if (!pull_ || pull_->piece != pull.piece || !(pull_->at == pull.at)) {
    PullCloth cloth;
    cloth.piece = pull.piece;
    cloth.at = pull.at;
    auto live = LivePull::take(file_.document(), cloth, own);
    if (!live) return live.error();
    pull_ = std::make_unique<Pulling>(Pulling{pull.piece, pull.at, *std::move(live), fitted(file_.document(), token)});
  }
  Result<Vec3> force = pull_->live.to(pull.by, own);
  if (force) shown = snapshotStanding(*pull_->start, pull_->live.forms());
  return force;
}

Done DocumentWorker::moveTo(const std::filesystem::path& path) {
  std::error_code trouble;
  if (file_.path().empty()) {
    if (!file_.steps().empty() || !file_.undone().empty())
      return refused(say("This garment has no file yet; open it as a document first."));
    auto made = DocumentFile::create(path);
    if (!made) return made.error();
    file_ = *std::move(made);
    return {};
  }
  const std::filesystem::path old = file_.path();
  const bool there = !file_.moved();
  if (there && std::filesystem::equivalent(old, path, trouble)) return {};
  const bool leaves = there && isDraft(options_, old) && !readOnly_;
  const auto goOnWith = [&](DocumentFile file) {
    file_ = std::move(file);
    readOnly_ = false, begunDraft_ = false;
    return Done();
  };
  if (leaves) {
    file_ = DocumentFile::inMemory();  // closes: one whole file
    std::filesystem::rename(old, path, trouble);
    if (!trouble) dropJournal(path);
    auto opened = DocumentFile::open(trouble ? old : path);
    if (!opened) return opened.error();
    if (!trouble) return goOnWith(*std::move(opened));
    file_ = *std::move(opened);
  }
  // A copy; a draft may also go to another disk. What is open stays open until the copy is: it may be all there is.
  const auto bytes = file_.bytes();
  if (!bytes) return bytes.error();
  if (Done written = writeFile(path, *bytes, Readers::Owner); !written) return written;
  dropJournal(path);
  auto opened = DocumentFile::open(path);
  if (!opened) return opened.error();
  Done done = goOnWith(*std::move(opened));
  if (leaves) std::filesystem::remove(old, trouble);
  return done;
}

std::filesystem::path DocumentWorker::draftPath(const std::string& name, int n) const {
  const std::string numbered = name + (n > 1 ? " " + std::to_string(n) : "") + ".";
  return options_.drafts / (numbered + std::string(fileFormat("document").endings.front()));
}

// Where it cannot be moved it keeps its name: nothing is lost by that.
void DocumentWorker::nameAfterGarment(const Operation* by) {
  if (!begunDraft_ || !options_.nameGarment || file_.document().pattern.pieces.empty()) return;
  if (!madeBy_ && by) madeBy_ = *by;
  const std::string name = madeBy_ ? options_.nameGarment(file_.document(), *madeBy_) : std::string();
  if (name.empty() || name == garmentName_) return;
  garmentName_ = name;
  std::error_code trouble;
  for (int n = 1;; ++n) {
    const auto path = draftPath(name, n);
    if (std::filesystem::exists(path, trouble)) continue;
    if (moveTo(path)) begunDraft_ = true;  // nobody has chosen this name
    return;
  }
}

Done DocumentWorker::beginDraft(const std::string& about) {
  if (!file_.path().empty() || options_.drafts.empty() || !file_.steps().empty()) return {};
  std::error_code trouble;
  std::filesystem::create_directories(options_.drafts, trouble);
  const std::string name = options_.nameDraft ? options_.nameDraft(about) : about.empty() ? "draft" : about;
  for (int n = 1;; ++n) {
    const auto path = draftPath(name, n);
    if (std::filesystem::exists(path, trouble)) continue;
    auto made = DocumentFile::create(path);
    if (!made && std::filesystem::exists(path, trouble)) continue;  // another Karinui was quicker
    if (!made)
      return storageError(say(
          "A new garment is kept in “{0}” from its first step on, and no file can be made there. Choose a place for "
          "it with File, Save as; nothing was done.",
          options_.drafts.string()));
    file_ = *std::move(made);
    begunDraft_ = true, madeBy_.reset(), garmentName_.clear();
    return {};
  }
}

void DocumentWorker::dropEmptyDraft() {
  if (!begunDraft_ || !file_.steps().empty() || !file_.undone().empty() || !file_.otherBranches().empty()) return;
  const std::filesystem::path path = file_.path();
  file_ = DocumentFile::inMemory();
  begunDraft_ = false;
  std::error_code none;
  std::filesystem::remove(path, none);
}

bool isDraft(const SessionOptions& options, const std::filesystem::path& path) {
  std::error_code trouble;
  return !options.drafts.empty() && !path.empty() &&
         std::filesystem::equivalent(path.parent_path(), options.drafts, trouble);
}

}  // namespace karinui

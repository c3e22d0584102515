#include "design/document_inside.h"

#include <algorithm>

#include "design/chain.h"
#include "karinui/design/script.h"

namespace karinui {

namespace {

// Drapes, pulls and figures: what a person waits for.
bool takesLong(const Operation& operation) {
  return std::holds_alternative<DrapePieces>(operation) || std::holds_alternative<PullCloth>(operation) ||
         std::holds_alternative<SetBody>(operation);
}

constexpr std::size_t kMostRemarks = 5;  // of one kind

Error notOpened(const std::filesystem::path& path, const Error& why) {
  const Error::Kind kind = why.hindered() ? why.kind : Error::Kind::Damaged;
  return {kind, say("“{0}” cannot be opened. {1} What is whole of it goes to a new document by “karinui rescue”.",
                    path.filename().string(), why.what)};
}

}  // namespace

Error atStep(std::size_t serial, const Error& error) { return {error.kind, say("Step {0}: {1}", serial, error.what)}; }

std::vector<const Step*> DocumentFile::Inside::line(std::uint64_t seq) const {
  std::vector<const Step*> all;
  for (const Step* s = step(seq); s != nullptr; s = step(s->parent)) all.push_back(s);
  std::reverse(all.begin(), all.end());
  return all;
}

std::optional<Document> DocumentFile::Inside::kept(const Step& s) {
  if (!store) return std::nullopt;
  const auto parts = store->parts(s.seq);
  if (!parts || parts->empty()) return std::nullopt;
  auto document = KeptDocuments(*store).read(s, *parts);
  if (document)
    keptParts.remember(*document, *parts);
  else
    remarks.push_back(
        say("What the file keeps of step {0} is damaged; it was made again from the steps.", std::size_t{s.serial}));
  return document;
}

Result<const Document*> DocumentFile::Inside::documentAt(std::uint64_t seq, Context& context) {
  std::vector<const Step*> missing;
  for (const Step* s = step(seq); s != nullptr && !documents.contains(s->seq); s = step(s->parent)) {
    if (auto document = kept(*s)) {
      documents[s->seq] = *std::move(document);
      break;
    }
    missing.push_back(s);
  }
  Borrowing borrowing(&blobs, &context.blobs);
  Context own{context.workers, context.token, borrowing, context.bodies, context.drape, context.pull};
  own.recorded = true;
  for (auto s = missing.rbegin(); s != missing.rend(); ++s) {
    auto document = apply(documents.at((*s)->parent), (*s)->operation, own);
    if (!document) return atStep((*s)->serial, document.error());
    if (hash(*document) != (*s)->after)
      remarks.push_back(say("Step {0} leads to another pattern than the file says; the steps were followed.",
                            std::size_t{(*s)->serial}));
    documents[(*s)->seq] = *std::move(document);
  }
  return &documents.at(seq);
}

const Document* DocumentFile::Inside::madeBefore(const Step* parent, const Document& before,
                                                 const Operation& operation) {
  const std::string after = parent ? parent->after : hash(before), stand = parent ? parent->stand : drapeHash(before);
  std::optional<std::string> said;
  for (auto s = steps.rbegin(); s != steps.rend(); ++s) {
    if (s->serial != before.operations + 1 || s->before != after || s->operation.index() != operation.index()) continue;
    if (const Step* other = step(s->parent); (other ? other->stand : drapeHash(Document())) != stand) continue;
    if (!said) said = text(operation);
    if (text(s->operation) != *said) continue;
    const Document* start = keptAt(s->parent);
    if (!start || start->drape.dirty != before.drape.dirty) continue;
    if (const Document* made = keptAt(s->seq)) return made;
  }
  return nullptr;
}

const Document* DocumentFile::Inside::keptAt(std::uint64_t seq) {
  if (const auto at = documents.find(seq); at != documents.end()) return &at->second;
  const Step* s = step(seq);
  auto document = s ? kept(*s) : std::nullopt;
  return document ? &(documents[seq] = *std::move(document)) : nullptr;
}

const Step* DocumentFile::Inside::step(std::uint64_t seq) const {
  const auto at =
      std::lower_bound(steps.begin(), steps.end(), seq, [](const Step& s, std::uint64_t n) { return s.seq < n; });
  return at != steps.end() && at->seq == seq ? &*at : nullptr;
}

Done DocumentFile::Inside::writable() const {
  if (!store || store->writable()) return {};
  return storageError(say("“{0}” was opened for reading only.", path.filename().string()));
}

Done DocumentFile::Inside::begin(Store opened, Context* how) {
  path = opened.path();
  for (const StepRow& row : opened.rows()) {
    auto operation = parseOperation(row.args.empty() ? row.kind : row.kind + " " + row.args);
    if (!operation) return notOpened(path, atStep(row.serial, operation.error()));
    const Step* parent = step(row.parent);
    const std::string chain = chained(parent ? parent->chain : std::string(), *operation);
    if (chain != row.chain) {
      return damagedDocument(
          say("“{0}” is damaged at step {1}; nothing was changed. What is whole of it goes to a new document by "
              "“karinui rescue”.",
              path.filename().string(), std::size_t{row.serial}));
    }
    if (row.before != (parent ? parent->after : hash(Document())))
      remarks.push_back(
          say("Step {0} does not begin where the step before it ends: the file was changed by another program.",
              std::size_t{row.serial}));
    steps.push_back(
        {row.seq, row.parent, row.serial, *std::move(operation), row.chain, row.before, row.after, row.stand});
  }
  head = opened.head();
  store = std::move(opened);
  Workers one(1);
  Token quiet;
  Bodies bodies;
  Context alone{one, quiet, blobs, bodies, {}, {}};
  const auto document = documentAt(head.seq, how ? *how : alone);
  if (!document && document.error().kind == Error::Kind::Cancelled) return document.error();
  if (!document) return notOpened(path, document.error());
  compareKept();
  return {};
}

void DocumentFile::Inside::compareKept() {
  KeptDocuments reader(*store);
  std::optional<Document> last;  // holds what the next one shares with it
  std::size_t damaged = 0;
  for (const Step& s : steps) {
    if (s.seq == head.seq) continue;  // was read just now
    const auto parts = store->parts(s.seq);
    if (!parts || parts->empty()) continue;
    auto document = reader.read(s, *parts);
    if (document) {
      last = std::move(document);
      reader.forget();
    } else if (++damaged <= kMostRemarks) {
      remarks.push_back(
          say("What the file keeps of step {0} is damaged; it is made again from the steps once it is needed.",
              std::size_t{s.serial}));
    }
  }
  if (damaged > kMostRemarks)
    remarks.push_back(say("So is what it keeps of {0} more {0|step|steps}.", damaged - kMostRemarks));
}

namespace {

// What imported bodies are made of, and no figure that was kept.
struct OnlyGiven : Blobs {
  const Blobs& all;
  explicit OnlyGiven(const Blobs& a) : all(a) {}
  Result<std::string> put(std::string) override { return refused({}); }
  Result<std::string> get(const std::string& name) const override { return all.get(name); }
};

// Makes figures again, each once, and looks whether they are those that are kept.
class FigureCheck {
 public:
  FigureCheck(const Store& store, const Blobs& blobs, Context& context)
      : store_(store), given_(blobs), context_(context) {}
  // Another is kept, or it cannot be made. Of the same part and choice it is told once: the steps after keep it, too.
  bool anotherIsKept(const BodyChoice& choice, const Parts& parts) {
    const auto part = parts.find("figure");
    if (!choice.chosen() || part == parts.end()) return false;
    BodyChoice own = choice;
    own.hash = choice.ownHash(), own.own.clear(), own.pose.clear();
    if (std::find(looked_.begin(), looked_.end(), std::pair(part->second, own)) != looked_.end()) return false;
    looked_.emplace_back(part->second, own);
    const auto kept = store_.blob(part->second);
    if (!kept) return false;  // damaged: that is told elsewhere
    const auto made = bodies_.find(own, given_, context_.workers, context_.token);
    return !context_.token.cancelled() && !(made && packFigure(**made) == *kept);
  }
  // Whether the operation chooses what the document says.
  bool chooses(const Document& before, const Operation& operation, const BodyChoice& choice) {
    Context own{context_.workers, context_.token, given_, bodies_, context_.drape, context_.pull};
    own.recorded = true;
    Document stands = before;
    stands.body.pose.clear();  // how the figure stands is another step's
    const auto made = apply(stands, operation, own);
    if (!made) return context_.token.cancelled();
    const BodyChoice& now = made->body;
    return now.size == choice.size && now.measurements == choice.measurements && now.form == choice.form &&
           now.mesh == choice.mesh;
  }

 private:
  const Store& store_;
  OnlyGiven given_;
  Context& context_;
  Bodies bodies_;  // that knows none yet
  std::vector<std::pair<std::string, BodyChoice>> looked_;
};

}  // namespace

Done DocumentFile::Inside::compareSteps(Context& context) {
  KeptDocuments reader(*store);
  std::map<std::uint64_t, Document> known;  // of the steps that others go on from
  known[0] = Document();
  std::map<std::uint64_t, std::size_t> following;
  for (const Step& s : steps) ++following[s.parent];
  Borrowing borrowing(&blobs, &context.blobs);
  Context own{context.workers, context.token, borrowing, context.bodies, context.drape, context.pull};
  own.recorded = true;
  std::size_t elsewhere = 0, otherFigures = 0;
  FigureCheck figures(*store, blobs, context);
  for (const Step& s : steps) {
    if (context.token.cancelled()) return cancelled();
    const auto parts = store->parts(s.seq);
    auto document = parts && !parts->empty() ? reader.read(s, *parts) : std::nullopt;
    const auto before = known.find(s.parent);
    if (document && before != known.end() && !takesLong(s.operation) &&
        !std::holds_alternative<PoseBody>(s.operation)) {
      const auto made = apply(before->second, s.operation, own);
      const bool same = made && hash(*made) == s.after && drapeHash(*made) == s.stand;
      if (!same && ++elsewhere <= kMostRemarks)
        remarks.push_back(
            say("Step {0}, “{1}”, leads to another garment than the file keeps: it was changed, or another version of "
                "Karinui took it. What is kept is shown.",
                std::size_t{s.serial}, std::string(nameOf(s.operation))));
    }
    const bool other = document && (figures.anotherIsKept(document->body, *parts) ||
                                    (before != known.end() && std::holds_alternative<SetBody>(s.operation) &&
                                     !figures.chooses(before->second, s.operation, document->body)));
    if (other && ++otherFigures <= kMostRemarks)
      remarks.push_back(
          say("The figure kept with step {0} is not the one that its measures or its imported body give: it was "
              "changed, or another version of Karinui made it. What is kept is shown.",
              std::size_t{s.serial}));
    if (before != known.end() && --following[s.parent] == 0) known.erase(before);
    if (document && following.contains(s.seq)) known[s.seq] = *std::move(document);
    reader.forget();
  }
  if (elsewhere > kMostRemarks) remarks.push_back(say("So do {0} more {0|step|steps}.", elsewhere - kMostRemarks));
  return {};
}

Result<DocumentFile::Inside::Worked> DocumentFile::Inside::work(const Step* parent, const Document& before,
                                                                std::uint64_t seq, Operation operation,
                                                                Context& context) {
  Borrowing borrowing(&blobs, &context.blobs);
  Context own{context.workers, context.token, borrowing,      context.bodies,
              context.drape,   context.pull,  context.advise, context.stop};
  own.onPose = context.onPose;
  auto settled = resolved(before, std::move(operation), own);
  if (!settled) return settled.error();
  const Document* known = takesLong(*settled) ? madeBefore(parent, before, *settled) : nullptr;
  auto after = known ? Result<Document>(*known) : apply(before, *settled, own);
  if (!after) return after.error();
  if (known && std::holds_alternative<SetBody>(*settled))  // what is known of the last drape comes from before it
    after->drape = {before.drape.last, before.drape.force, known->drape.dirty, before.drape.rested};
  Worked worked{{}, *std::move(after), std::move(borrowing.borrowed)};
  Step& step = worked.step;
  step.seq = seq;
  step.parent = parent ? parent->seq : 0;
  step.serial = worked.after.operations;
  step.operation = *std::move(settled);
  if (auto* drape = std::get_if<DrapePieces>(&step.operation)) {
    const SettleReport& last = *worked.after.drape.last;
    if (last.stoppedAfter > 0) drape->stop = static_cast<int>(last.stoppedAfter);
    if (last.finer) drape->finer = true;
    if (last.insideLast) drape->insideLast = true;
    if (last.dressed) drape->dressed = true;
  }
  step.chain = chained(parent ? parent->chain : std::string(), step.operation);
  step.before = parent ? parent->after : hash(before);
  step.after = hash(worked.after);
  step.stand = drapeHash(worked.after);
  return worked;
}

Done DocumentFile::Inside::keep(Worked worked, Head then, const Bodies& bodies) {
  const Step& step = worked.step;
  // All memory is taken before the file is written: what is in the file is known here, too.
  std::map<std::uint64_t, Document> after;
  after.emplace(step.seq, std::move(worked.after));
  const Document& document = after.begin()->second;
  if (steps.size() == steps.capacity()) steps.reserve(2 * steps.size() + 1);
  if (store) {
    const Parts parts = keptParts.pack(document, bodies, worked.borrowed);
    const std::string line = text(step.operation);
    const std::string kind(nameOf(step.operation));
    const StepRow row{
        step.seq,   step.parent, step.serial, kind,      line.size() > kind.size() ? line.substr(kind.size() + 1) : "",
        step.chain, step.before, step.after,  step.stand};
    if (Done done = store->fill({{{row, parts}}, std::move(worked.borrowed), then}); !done) return done.error();
    keptParts.remember(document, parts);
  } else {
    for (auto& [name, bytes] : worked.borrowed) (void)memory.put(bytes);
  }
  head = then;
  documents.insert(after.extract(after.begin()));
  steps.push_back(std::move(worked.step));
  forget();
  return {};
}

Done DocumentFile::Inside::stand(Head there) {
  if (store) {
    if (Done done = store->move(there); !done) return done;
  }
  head = there;
  forget();
  return {};
}

// What lies in the file need not lie in memory too, but for the steps one is about to see again.
void DocumentFile::Inside::forget() {
  if (!store) return;
  constexpr std::size_t kNear = 24;
  for (auto at = documents.begin(); documents.size() > kNear && at != documents.end();)
    at = at->first == 0 || at->first == head.seq ? std::next(at) : documents.erase(at);
  keptParts.forget();
}

}  // namespace karinui

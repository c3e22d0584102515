#include "karinui/design/history.h"

#include <algorithm>
#include <set>

#include "design/chain.h"
#include "design/content.h"
#include "design/file/store.h"
#include "design/pack.h"
#include "karinui/base/hash.h"
#include "karinui/design/script.h"

namespace karinui {

namespace {

// Drapes, pulls and figures: what a person waits for.
bool takesLong(const Operation& operation) {
  return std::holds_alternative<DrapePieces>(operation) || std::holds_alternative<PullCloth>(operation) ||
         std::holds_alternative<SetBody>(operation);
}

Error atStep(std::size_t serial, const Error& error) { return {error.kind, say("Step {0}: {1}", serial, error.what)}; }

}  // namespace

Result<Document> replayed(const std::vector<Operation>& operations, Context& context) {
  Document document;
  for (std::size_t i = 0; i < operations.size(); ++i) {
    auto next = apply(document, operations[i], context);
    if (!next) return atStep(i + 1, next.error());
    document = *std::move(next);
  }
  return document;
}

struct DocumentFile::Inside {
  std::optional<Store> store;  // nothing: in memory only
  MemoryBlobs memory;          // blobs of a document without a file
  std::vector<Step> steps;     // all branches, by seq
  Head head;
  std::map<std::uint64_t, Document> documents;  // after a step, by seq; 0 is the empty one
  std::filesystem::path path;
  std::vector<Message> remarks;
  // Names of parts that are in the file already. Holding the part keeps its address from being used again.
  std::map<std::shared_ptr<const void>, std::string> packed;
  std::map<std::string, std::string> figures;  // Body::hash() of figures that are in the file, and their blobs

  // The file's blobs as the rest of the program sees them.
  struct FileBlobs : Blobs {
    Inside* in;
    explicit FileBlobs(Inside* i) : in(i) {}
    Result<std::string> put(std::string bytes) override {
      if (!in->store) return in->memory.put(std::move(bytes));
      if (Done done = in->writable(); !done) return done.error();
      std::string name = blobName(bytes);
      if (in->store->blob(name)) return name;
      if (Done done = in->store->keep(name, bytes); !done) return done.error();
      return name;
    }
    Result<std::string> get(const std::string& name) const override {
      return in->store ? in->store->blob(name) : in->memory.get(name);
    }
    Result<std::string> figure(const std::string& hash) const override {
      const auto at = in->figures.find(hash);
      if (at == in->figures.end()) return Blobs::figure(hash);
      auto bytes = get(at->second);
      if (!bytes) in->figures.erase(at);  // lost or damaged: kept anew with the next step
      return bytes;
    }
  } blobs{this};

  // The file's blobs first, then the caller's; what the caller had to give is remembered, to be kept with the step.
  struct Borrowing : Blobs {
    Blobs* own;
    Blobs* other;
    mutable std::map<std::string, std::string> borrowed;
    Borrowing(Blobs* o, Blobs* t) : own(o), other(t) {}
    Result<std::string> put(std::string bytes) override { return own->put(std::move(bytes)); }
    Result<std::string> get(const std::string& name) const override {
      auto mine = own->get(name);
      if (mine || other == own) return mine;
      auto theirs = other->get(name);
      if (theirs) borrowed[name] = *theirs;
      return theirs ? theirs : mine;
    }
    Result<std::string> figure(const std::string& hash) const override {
      auto mine = own->figure(hash);
      return mine || other == own ? mine : other->figure(hash);
    }
  };

  Done writable() const {
    if (!store || store->writable()) return {};
    return storageError(say("“{0}” was opened for reading only.", path.filename().string()));
  }

  const Step* step(std::uint64_t seq) const {
    const auto at =
        std::lower_bound(steps.begin(), steps.end(), seq, [](const Step& s, std::uint64_t n) { return s.seq < n; });
    return at != steps.end() && at->seq == seq ? &*at : nullptr;
  }

  // From the beginning (left out) to a step.
  std::vector<const Step*> line(std::uint64_t seq) const {
    std::vector<const Step*> all;
    for (const Step* s = step(seq); s != nullptr; s = step(s->parent)) all.push_back(s);
    std::reverse(all.begin(), all.end());
    return all;
  }

  // The document's parts as blobs. Only what the file does not have yet comes into `fresh`.
  Parts pack(const Document& document, const Bodies& bodies, std::map<std::string, std::string>& fresh) {
    Parts parts;
    const auto put = [&](const std::string& part, std::shared_ptr<const void> thing, auto&& bytesOf) {
      const auto known = thing ? packed.find(thing) : packed.end();
      if (known != packed.end()) return void(parts[part] = known->second);
      std::string bytes = bytesOf();
      const std::string name = blobName(bytes);
      fresh.emplace(name, std::move(bytes));
      parts[part] = name;
    };
    put("rest", nullptr, [&] { return packRest(document); });
    // The figure is kept so that nobody waits for it again. Where no figure was needed nothing is built for this.
    if (const auto known = figures.find(document.body.hash); known != figures.end()) {
      parts["figure"] = known->second;
    } else if (const BodyPtr figure = bodies.known(document.body.hash)) {
      put("figure", nullptr, [&] { return packFigure(*figure); });
    }
    for (const auto& [id, piece] : document.pattern.pieces) {
      put("piece " + std::to_string(id.value), piece, [&p = piece] { return packPiece(*p); });
      if (piece->form)
        put("form " + std::to_string(id.value), piece->form, [&p = piece] { return packForm(*p->form); });
    }
    return parts;
  }

  void remember(const Document& document, const Parts& parts) {
    if (const auto figure = parts.find("figure"); figure != parts.end()) figures[document.body.hash] = figure->second;
    for (const auto& [id, piece] : document.pattern.pieces) {
      packed[piece] = parts.at("piece " + std::to_string(id.value));
      if (piece->form) packed[piece->form] = parts.at("form " + std::to_string(id.value));
    }
  }

  // The document kept beside a step, if it is whole, sound and matches the step's hashes.
  std::optional<Document> kept(const Step& s) {
    if (!store) return std::nullopt;
    const auto parts = store->parts(s.seq);
    if (!parts || parts->empty()) return std::nullopt;
    auto document = unpacked(s, *parts);
    if (document)
      remember(*document, *parts);
    else
      remarks.push_back(
          say("What the file keeps of step {0} is damaged; it was made again from the steps.", std::size_t{s.serial}));
    return document;
  }

  std::optional<Document> unpacked(const Step& s, const Parts& parts) {
    const auto bytesOf = [&](const std::string& part) {
      const auto at = parts.find(part);
      auto bytes = at == parts.end() ? Result<std::string>(notFound({})) : store->blob(at->second);
      return bytes ? std::optional(*std::move(bytes)) : std::nullopt;
    };
    const auto rest = bytesOf("rest");
    auto document = rest ? unpackRest(*rest) : Result<Document>(notFound({}));
    if (!document) return std::nullopt;
    for (const auto& [part, blob] : parts) {
      if (!part.starts_with("piece ")) continue;
      const auto bytes = bytesOf(part);
      auto piece = bytes ? unpackPiece(*bytes) : Result<Piece>(notFound({}));
      if (!piece || part != "piece " + std::to_string(piece->id.value)) return std::nullopt;
      if (const auto form = "form " + std::to_string(piece->id.value); parts.contains(form)) {
        const auto formBytes = bytesOf(form);
        auto shape = formBytes ? unpackForm(*formBytes) : Result<std::shared_ptr<const Form>>(notFound({}));
        if (!shape) return std::nullopt;
        piece->form = *shape;
      }
      document->pattern.pieces[piece->id] = std::make_shared<const Piece>(*piece);
    }
    if (document->operations != s.serial || hash(*document) != s.after || drapeHash(*document) != s.stand ||
        !soundContent(*document))
      return std::nullopt;
    return *document;
  }

  // The document after a step: known, kept beside it, or made again from the nearest one before it.
  Result<const Document*> documentAt(std::uint64_t seq, Context& context) {
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

  Done begin(Store opened, Context* how);

  // What this very operation made of this very garment before, on whatever branch: nothing that a drape depends on lies
  // outside the two (apply() is pure), so that nobody waits for it twice. Null: it was not done yet, or is not kept.
  const Document* madeBefore(const Step* parent, const Document& before, const Operation& operation) {
    const std::string after = parent ? parent->after : hash(before), stand = parent ? parent->stand : drapeHash(before);
    std::optional<std::string> said;
    for (auto s = steps.rbegin(); s != steps.rend(); ++s) {
      if (s->serial != before.operations + 1 || s->before != after || s->operation.index() != operation.index())
        continue;
      if (const Step* other = step(s->parent); (other ? other->stand : drapeHash(Document())) != stand) continue;
      if (!said) said = text(operation);
      if (text(s->operation) != *said) continue;
      const Document* start = keptAt(s->parent);
      if (!start || start->drape.dirty != before.drape.dirty) continue;
      if (const Document* made = keptAt(s->seq)) return made;
    }
    return nullptr;
  }
  const Document* keptAt(std::uint64_t seq) {  // null: it would have to be made again
    if (const auto at = documents.find(seq); at != documents.end()) return &at->second;
    const Step* s = step(seq);
    auto document = s ? kept(*s) : std::nullopt;
    return document ? &(documents[seq] = *std::move(document)) : nullptr;
  }

  struct Worked;
  std::uint64_t nextSeq() const { return steps.empty() ? 1 : steps.back().seq + 1; }
  Result<Worked> work(const Step* parent, const Document& before, std::uint64_t seq, Operation operation,
                      Context& context);
  Done keep(Worked worked, Head then, const Bodies& bodies);
  Done stand(Head there);
  void forget();
};

DocumentFile::DocumentFile(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {
  inside_->documents[0] = Document();
}
DocumentFile::DocumentFile(DocumentFile&&) noexcept = default;
DocumentFile& DocumentFile::operator=(DocumentFile&&) noexcept = default;
DocumentFile::~DocumentFile() = default;

DocumentFile DocumentFile::inMemory() { return DocumentFile(std::make_unique<Inside>()); }

Result<DocumentFile> DocumentFile::create(const std::filesystem::path& path) {
  auto store = Store::create(path);
  if (!store) return store.error();
  DocumentFile file(std::make_unique<Inside>());
  file.inside_->store = *std::move(store);
  file.inside_->path = path;
  return file;
}

Done DocumentFile::Inside::begin(Store opened, Context* how) {
  path = opened.path();
  for (const StepRow& row : opened.rows()) {
    auto operation = parseOperation(row.args.empty() ? row.kind : row.kind + " " + row.args);
    if (!operation) return atStep(row.serial, operation.error());
    const Step* parent = step(row.parent);
    const std::string chain = chained(parent ? parent->chain : std::string(), *operation);
    if (chain != row.chain) {
      return badInput(
          say("“{0}” is damaged at step {1}; nothing was changed.", path.filename().string(), std::size_t{row.serial}));
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
  return document ? Done() : Done(document.error());
}

Result<DocumentFile> DocumentFile::open(const std::filesystem::path& path, Context* how) {
  auto store = Store::open(path, true);
  if (!store) return store.error();
  DocumentFile file(std::make_unique<Inside>());
  if (Done done = file.inside_->begin(*std::move(store), how); !done) return done.error();
  return file;
}

Result<DocumentFile> DocumentFile::openForReading(const std::filesystem::path& path, Context* how) {
  auto store = Store::open(path, false);
  if (!store) return store.error();
  DocumentFile file(std::make_unique<Inside>());
  if (Done done = file.inside_->begin(*std::move(store), how); !done) return done.error();
  return file;
}

const Document& DocumentFile::document() const { return inside_->documents.at(inside_->head.seq); }
const std::filesystem::path& DocumentFile::path() const { return inside_->path; }
const std::vector<Message>& DocumentFile::remarks() const { return inside_->remarks; }
Blobs& DocumentFile::blobs() { return inside_->blobs; }

std::vector<Step> DocumentFile::steps() const {
  std::vector<Step> all;
  for (const Step* s : inside_->line(inside_->head.seq)) all.push_back(*s);
  return all;
}

std::vector<Step> DocumentFile::undone() const {
  std::vector<Step> all;
  for (const Step* s = inside_->step(inside_->head.tip); s != nullptr && s->seq != inside_->head.seq;
       s = inside_->step(s->parent)) {
    all.push_back(*s);
  }
  std::reverse(all.begin(), all.end());
  return all;
}

// One step worked out on the document before it, and what keeping it needs.
struct DocumentFile::Inside::Worked {
  Step step;
  Document after;
  std::map<std::string, std::string> borrowed;  // blobs of the caller's that it used
};

Result<DocumentFile::Inside::Worked> DocumentFile::Inside::work(const Step* parent, const Document& before,
                                                                std::uint64_t seq, Operation operation,
                                                                Context& context) {
  Borrowing borrowing(&blobs, &context.blobs);
  Context own{context.workers, context.token, borrowing,      context.bodies,
              context.drape,   context.pull,  context.advise, context.stop};
  auto settled = resolved(before, std::move(operation), own);
  if (!settled) return settled.error();
  const Document* known = takesLong(*settled) ? madeBefore(parent, before, *settled) : nullptr;
  auto after = known ? Result<Document>(*known) : apply(before, *settled, own);
  if (!after) return after.error();
  if (known && std::holds_alternative<SetBody>(*settled))  // what is known of the last drape comes from before it
    after->drape = {before.drape.last, before.drape.force, known->drape.dirty};
  Worked worked{{}, *std::move(after), std::move(borrowing.borrowed)};
  Step& step = worked.step;
  step.seq = seq;
  step.parent = parent ? parent->seq : 0;
  step.serial = worked.after.operations;
  step.operation = *std::move(settled);
  if (auto* drape = std::get_if<DrapePieces>(&step.operation); drape && worked.after.drape.last->stoppedAfter > 0)
    drape->stop = static_cast<int>(worked.after.drape.last->stoppedAfter);
  step.chain = chained(parent ? parent->chain : std::string(), step.operation);
  step.before = parent ? parent->after : hash(before);
  step.after = hash(worked.after);
  step.stand = drapeHash(worked.after);
  return worked;
}

Done DocumentFile::Inside::keep(Worked worked, Head then, const Bodies& bodies) {
  const Step& step = worked.step;
  if (store) {
    const Parts parts = pack(worked.after, bodies, worked.borrowed);
    const std::string line = text(step.operation);
    const std::string kind(nameOf(step.operation));
    const StepRow row{
        step.seq,   step.parent, step.serial, kind,      line.size() > kind.size() ? line.substr(kind.size() + 1) : "",
        step.chain, step.before, step.after,  step.stand};
    if (Done done = store->append(row, parts, worked.borrowed, then); !done) return done.error();
    remember(worked.after, parts);
  } else {
    for (auto& [name, bytes] : worked.borrowed) (void)memory.put(bytes);
  }
  head = then;
  documents[step.seq] = std::move(worked.after);
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
  std::erase_if(packed, [](const auto& part) { return part.first.use_count() == 1; });
}

Result<Step> DocumentFile::perform(Operation operation, Context& context) {
  Inside& in = *inside_;
  if (Done done = in.writable(); !done) return done.error();
  auto worked = in.work(in.step(in.head.seq), document(), in.nextSeq(), std::move(operation), context);
  if (!worked) return worked.error();
  const Step step = worked->step;
  if (Done done = in.keep(*std::move(worked), {step.seq, step.seq}, context.bodies); !done) return done.error();
  return step;
}

Result<Document> DocumentFile::documentAfter(std::uint64_t seq, Context& context) {
  if (seq != 0 && !inside_->step(seq)) return notFound(say("There is no such step in this document."));
  const auto found = inside_->documentAt(seq, context);
  if (!found) return found.error();
  Document document = **found;
  inside_->forget();
  return document;
}

Done DocumentFile::goTo(std::uint64_t seq, Context& context) {
  Inside& in = *inside_;
  if (Done done = in.writable(); !done) return done;
  if (seq != 0 && !in.step(seq)) return notFound(say("There is no such step in this document."));
  if (const auto document = in.documentAt(seq, context); !document) return document.error();
  const auto way = in.line(in.head.tip);
  const bool here = seq == 0 || std::any_of(way.begin(), way.end(), [&](const Step* s) { return s->seq == seq; });
  return in.stand({seq, here ? in.head.tip : seq});
}

std::vector<Step> DocumentFile::otherBranches() const {
  std::set<std::uint64_t> parents;
  for (const Step& s : inside_->steps) parents.insert(s.parent);
  std::vector<Step> ends;
  for (auto s = inside_->steps.rbegin(); s != inside_->steps.rend(); ++s)
    if (!parents.contains(s->seq) && s->seq != inside_->head.tip) ends.push_back(*s);
  return ends;
}

Done DocumentFile::amend(std::size_t which, Operation operation, Context& context) {
  Inside& in = *inside_;
  if (Done done = in.writable(); !done) return done;
  const auto way = in.line(in.head.seq);
  KARINUI_ASSERT(which >= 1 && which <= way.size());
  // All of it is worked out first: only what holds to the end is written.
  std::vector<Inside::Worked> all;
  const std::uint64_t before = way[which - 1]->parent;
  const auto start = in.documentAt(before, context);
  if (!start) return start.error();
  const Document* document = *start;
  const Step* parent = in.step(before);
  for (std::size_t i = which - 1; i < way.size(); ++i) {
    context.token.progress(static_cast<double>(i - (which - 1)) / static_cast<double>(way.size() - (which - 1)),
                           say("Playing step {0} again", i + 1));
    auto worked = in.work(parent, *document, in.nextSeq() + all.size(),
                          i + 1 == which ? std::move(operation) : way[i]->operation, context);
    if (!worked) return worked.error().kind == Error::Kind::Cancelled ? worked.error() : atStep(i + 1, worked.error());
    all.reserve(way.size());  // what points into it stays
    all.push_back(*std::move(worked));
    document = &all.back().after;
    parent = &all.back().step;
  }
  // The head stays where it is until the last is on the disk: whatever happens, it is the old garment or the new.
  const Head old = in.head;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint64_t seq = all[i].step.seq;
    const Head then = i + 1 == all.size() ? Head{seq, seq} : old;
    if (Done done = in.keep(std::move(all[i]), then, context.bodies); !done) return done;
  }
  return {};
}

Result<Step> DocumentFile::undo(Context& context) {
  Inside& in = *inside_;
  if (Done done = in.writable(); !done) return done.error();
  const Step* step = in.step(in.head.seq);
  if (!step) return refused(say("There is nothing to undo."));
  if (const auto document = in.documentAt(step->parent, context); !document) return document.error();
  if (Done done = in.stand({step->parent, in.head.tip}); !done) return done.error();
  return *step;
}

Result<Step> DocumentFile::redo(Context& context) {
  Inside& in = *inside_;
  if (Done done = in.writable(); !done) return done.error();
  const auto waiting = undone();
  if (waiting.empty()) return refused(say("There is nothing to redo."));
  const Step& step = waiting.front();
  if (const auto document = in.documentAt(step.seq, context); !document) return document.error();
  if (Done done = in.stand({step.seq, in.head.tip}); !done) return done.error();
  return step;
}

std::string DocumentFile::log() const {
  std::string all;
  for (const Step* s : inside_->line(inside_->head.seq)) {
    all += text(s->operation) + "  # " + std::to_string(s->serial) + "\n";
  }
  return all;
}

}  // namespace karinui

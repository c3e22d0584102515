#include "karinui/design/history.h"

#include <algorithm>
#include <set>

#include "design/document_inside.h"
#include "karinui/base/memory.h"
#include "karinui/design/script.h"

namespace karinui {

Operation asRecorded(Operation operation) {
  std::visit(
      [](auto& op) {
        if constexpr (requires { op.copies; })
          if (op.copies == Choice::Auto) op.copies = Choice::No;
        if constexpr (std::is_same_v<decltype(op), AddNotch&> || std::is_same_v<decltype(op), EraseMarks&>)
          for (Choice* one : {&op.partners, &op.zips})
            if (*one == Choice::Auto) *one = Choice::No;
        if constexpr (std::is_same_v<decltype(op), TakeIn&>)
          if (op.follow == Choice::Auto) op.follow = Choice::No;
        if constexpr (std::is_same_v<decltype(op), AddPleat&>)
          if (op.symmetric == Choice::Auto) op.symmetric = Choice::No;
        if constexpr (std::is_same_v<decltype(op), MirrorPiece&>)
          if (op.rings == Choice::Auto) op.rings = Choice::No;
        if constexpr (std::is_same_v<decltype(op), DraftBlock&>)
          if (op.meets == Choice::Auto) op.meets = Choice::No;
        if constexpr (std::is_same_v<decltype(op), DrawBand&>)
          if (op.joined == Choice::Auto && op.sew && op.extra == 0 && op.wrap.empty()) op.joined = Choice::Yes;
      },
      static_cast<PlainOperation&>(operation));
  return operation;
}

DocumentFile::DocumentFile(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {
  inside_->documents[0] = Document();
}
DocumentFile::DocumentFile(DocumentFile&&) noexcept = default;
DocumentFile& DocumentFile::operator=(DocumentFile&&) noexcept = default;
DocumentFile::~DocumentFile() = default;

DocumentFile DocumentFile::inMemory() { return DocumentFile(std::make_unique<Inside>()); }

Result<DocumentFile> DocumentFile::create(const std::filesystem::path& path) {
  return withinMemory([&]() -> Result<DocumentFile> {
    auto store = Store::create(path);
    if (!store) return store.error();
    DocumentFile file(std::make_unique<Inside>());
    file.inside_->store = *std::move(store);
    file.inside_->path = path;
    return file;
  });
}

Result<DocumentFile> DocumentFile::open(const std::filesystem::path& path, Context* how) {
  return withinMemory([&]() -> Result<DocumentFile> {
    auto store = Store::open(path, true);
    if (!store) return store.error();
    DocumentFile file(std::make_unique<Inside>());
    if (Done done = file.inside_->begin(*std::move(store), how); !done) return done.error();
    return file;
  });
}

Result<DocumentFile> DocumentFile::openForReading(const std::filesystem::path& path, Context* how) {
  return withinMemory([&]() -> Result<DocumentFile> {
    auto store = Store::open(path, false);
    if (!store) return store.error();
    DocumentFile file(std::make_unique<Inside>());
    if (Done done = file.inside_->begin(*std::move(store), how); !done) return done.error();
    return file;
  });
}

const Document& DocumentFile::document() const { return inside_->documents.at(inside_->head.seq); }
const std::filesystem::path& DocumentFile::path() const { return inside_->path; }
bool DocumentFile::moved() const { return inside_->store && inside_->store->moved(); }
Result<std::string> DocumentFile::bytes() const {
  return withinMemory([&]() -> Result<std::string> {
    if (!inside_->store) return karinui::refused(say("This garment has no file yet; open it as a document first."));
    return inside_->store->bytes();
  });
}
const std::vector<Message>& DocumentFile::remarks() const { return inside_->remarks; }
Done DocumentFile::checkSteps(Context& context) {
  return withinMemory([&] { return inside_->store ? inside_->compareSteps(context) : Done(); });
}
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

Result<Step> DocumentFile::perform(Operation operation, Context& context) {
  return withinMemory([&]() -> Result<Step> {
    Inside& in = *inside_;
    if (Done done = in.writable(); !done) return done.error();
    auto worked = in.work(in.step(in.head.seq), document(), in.nextSeq(), std::move(operation), context);
    if (!worked) return worked.error();
    Result<Step> step = worked->step;
    if (Done done = in.keep(*std::move(worked), {step->seq, step->seq}, context.bodies); !done) return done.error();
    return step;
  });
}

Result<Document> DocumentFile::documentAfter(std::uint64_t seq, Context& context) {
  if (seq != 0 && !inside_->step(seq)) return notFound(say("There is no such step in this document."));
  return withinMemory([&]() -> Result<Document> {
    const auto found = inside_->documentAt(seq, context);
    if (!found) return found.error();
    Document document = **found;
    inside_->forget();
    return document;
  });
}

Done DocumentFile::goTo(std::uint64_t seq, Context& context) {
  return withinMemory([&]() -> Done {
    Inside& in = *inside_;
    if (Done done = in.writable(); !done) return done;
    if (seq != 0 && !in.step(seq)) return notFound(say("There is no such step in this document."));
    if (const auto document = in.documentAt(seq, context); !document) return document.error();
    const auto way = in.line(in.head.tip);
    const bool here = seq == 0 || std::any_of(way.begin(), way.end(), [&](const Step* s) { return s->seq == seq; });
    return in.stand({seq, here ? in.head.tip : seq});
  });
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
  return withinMemory([&]() -> Done {
    Inside& in = *inside_;
    if (Done done = in.writable(); !done) return done;
    const auto way = in.line(in.head.seq);
    if (which < 1 || which > way.size())
      return refused(say("There is no step {0}; the document has {1}, as log tells.", which, way.size()));
    // All of it is worked out first: only what holds to the end is written.
    std::vector<Inside::Worked> all;
    all.reserve(way.size());  // what points into it stays
    const std::uint64_t before = way[which - 1]->parent;
    const auto start = in.documentAt(before, context);
    if (!start) return start.error();
    const Document* document = *start;
    const Step* parent = in.step(before);
    for (std::size_t i = which - 1; i < way.size(); ++i) {
      context.token.progress(static_cast<double>(i - (which - 1)) / static_cast<double>(way.size() - (which - 1)),
                             say("Playing step {0} again", i + 1));
      auto worked = in.work(parent, *document, in.nextSeq() + all.size(),
                            i + 1 == which ? std::move(operation) : asRecorded(way[i]->operation), context);
      if (!worked)
        return worked.error().kind == Error::Kind::Cancelled ? worked.error() : atStep(i + 1, worked.error());
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
  });
}

Result<Step> DocumentFile::undo(Context& context) {
  return withinMemory([&]() -> Result<Step> {
    Inside& in = *inside_;
    if (Done done = in.writable(); !done) return done.error();
    const Step* undone = in.step(in.head.seq);
    if (!undone) return refused(say("There is nothing to undo."));
    Result<Step> step = *undone;
    if (const auto document = in.documentAt(step->parent, context); !document) return document.error();
    if (Done done = in.stand({step->parent, in.head.tip}); !done) return done.error();
    return step;
  });
}

Result<Step> DocumentFile::redo(Context& context) {
  return withinMemory([&]() -> Result<Step> {
    Inside& in = *inside_;
    if (Done done = in.writable(); !done) return done.error();
    const auto waiting = undone();
    if (waiting.empty()) return refused(say("There is nothing to redo."));
    Result<Step> step = waiting.front();
    if (const auto document = in.documentAt(step->seq, context); !document) return document.error();
    if (Done done = in.stand({step->seq, in.head.tip}); !done) return done.error();
    return step;
  });
}

std::string DocumentFile::log() const {
  std::string all;
  for (const Step* s : inside_->line(inside_->head.seq)) {
    all += withShortLengths(text(s->operation)) + "  # " + std::to_string(s->serial) + "\n";
  }
  return all;
}

}  // namespace karinui

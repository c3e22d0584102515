#include <set>

#include "design/document_parts.h"

#include "design/chain.h"
#include "design/file/store.h"
#include "karinui/design/history.h"
#include "karinui/design/share.h"

namespace karinui {

namespace {

// The rows whose operation can be read and whose chain holds, by seq.
std::vector<StepRow> wholeRows(const Store& store) {
  std::map<std::uint64_t, std::string> chains{{0, {}}};
  std::vector<StepRow> whole;
  for (const StepRow& row : store.rows()) {
    const auto operation = parseOperation(row.args.empty() ? row.kind : row.kind + " " + row.args);
    const auto parent = chains.find(row.parent);
    if (!operation || parent == chains.end() || chained(parent->second, *operation) != row.chain) continue;
    chains[row.seq] = row.chain;
    whole.push_back(row);
  }
  return whole;
}

Done copy(const Store& damaged, const std::vector<StepRow>& rows, Store& fresh) {
  std::set<std::string> whole;
  for (const std::string& name : damaged.blobNames()) {
    const auto bytes = damaged.blob(name);
    if (!bytes) continue;
    if (Done done = fresh.keep(name, *bytes); !done) return done;
    whole.insert(name);
  }
  for (const StepRow& row : rows) {
    // A document with a part missing, or one of a name that no document gives, is made again from the steps when it is
    // needed.
    Parts parts = damaged.parts(row.seq) ? *damaged.parts(row.seq) : Parts();
    for (const auto& [part, blob] : parts)
      if (!whole.contains(blob) || !isPart(part)) {
        parts.clear();
        break;
      }
    if (Done done = fresh.fill({{{row, parts}}, {}, {}}); !done) return done;
  }
  return {};
}

// The steps of the copy whose garments can be had, kept or made again: an operation may name what no step before it
// made, where one was taken out and all seals made anew.
// Further what a person should know of what is kept beside them.
Result<std::set<std::uint64_t>> reachable(const std::filesystem::path& copy, const std::vector<StepRow>& rows,
                                          Context& context, std::vector<Message>& remarks) {
  auto file = DocumentFile::open(copy, &context);
  if (!file) return file.error();
  std::set<std::uint64_t> had{0};
  for (const StepRow& row : rows) {
    if (!had.contains(row.parent)) continue;
    const auto document = file->documentAfter(row.seq, context);
    if (document)
      had.insert(row.seq);
    else if (document.error().kind == Error::Kind::Cancelled)
      return document.error();
  }
  const std::size_t told = file->remarks().size();
  if (const Done done = file->checkSteps(context); !done) return done.error();
  remarks.assign(file->remarks().begin() + static_cast<std::ptrdiff_t>(told), file->remarks().end());
  return had;
}

// What the damaged file keeps, to be read only.
struct StoredBlobs : Blobs {
  const Store& store;
  explicit StoredBlobs(const Store& s) : store(s) {}
  Result<std::string> put(std::string) override { return refused({}); }
  Result<std::string> get(const std::string& name) const override { return store.blob(name); }
};

// The garment beside the newest step that has one, if none of these steps led to it.
std::optional<Document> garmentBeyond(const Store& damaged, const std::set<std::uint64_t>& had) {
  constexpr std::size_t kTries = 20;
  KeptDocuments reader(damaged);
  std::size_t tries = 0;
  for (const std::uint64_t seq : damaged.keptSteps()) {
    if (had.contains(seq) || ++tries > kTries) break;
    const auto parts = damaged.parts(seq);
    auto document = parts && !parts->empty() ? reader.readAny(*parts) : std::nullopt;
    if (document && !document->pattern.pieces.empty()) return document;
  }
  return std::nullopt;
}

// Makes it by steps of its own, without its formulas and its drape. How many steps.
Result<std::size_t> makeAnew(const Document& garment, const Store& damaged, const std::filesystem::path& to,
                             const Context& how) {
  auto file = DocumentFile::create(to);
  if (!file) return file.error();
  StoredBlobs blobs(damaged);
  Context context{how.workers, how.token, blobs, how.bodies, how.drape, how.pull};
  std::vector<Operation> steps;
  if (const BodyChoice& body = garment.body; body.chosen()) {
    SetBody op;
    op.size = body.size, op.form = body.form, op.mesh = body.mesh;
    if (body.mesh.empty()) {
      op.sex = body.measurements.sex;
      for (const auto& [key, value] : body.measurements.value) op.set.push_back({key, Length{value}, {}});
    }
    steps.emplace_back(std::move(op));
  }
  for (Operation& step : sharedSteps(garment)) steps.push_back(std::move(step));
  for (const auto& [id, places] : garment.pins)
    if (const Piece* piece = garment.find(id)) steps.emplace_back(PinCloth{PieceRef(piece->name), places, {}});
  for (Operation& step : steps)
    if (const auto made = file->perform(std::move(step), context); !made) return made.error();
  return file->steps().size();
}

}  // namespace

Message rescuedSaid(const Rescued& rescued) {
  if (rescued.anew > 0)
    return say(
        "Steps on the way are lost. The garment that was kept last was made anew by {0} {0|step|steps} of its "
        "own, without history, formulas and drape: drape it.",
        rescued.anew);
  if (rescued.lost == 0) return say("All {0} {0|step is|steps are} whole.", rescued.steps);
  return say("{0} {0|step is|steps are} whole and {0|was|were} kept; {1} were not.", rescued.steps, rescued.lost);
}

Result<Rescued> rescue(const std::filesystem::path& from, const std::filesystem::path& to, Context& context) {
  const Error nothing = badInput(say(
      "Not one step of “{0}” is whole; nothing could be saved. Take an older copy of it.", from.filename().string()));
  const auto damaged = Store::openDamaged(from);
  if (!damaged) return damaged.error().kind == Error::Kind::Damaged ? nothing : damaged.error();
  auto rows = wholeRows(*damaged);
  const auto write = [&]() -> Done {
    auto fresh = Store::create(to);
    return fresh ? copy(*damaged, rows, *fresh) : Done(fresh.error());
  };
  std::error_code trouble;
  if (std::filesystem::exists(to, trouble)) return Store::create(to).error();  // it stays
  std::size_t anew = 0;
  std::vector<Message> remarks;
  const Done done = [&]() -> Done {
    if (Done first = write(); !first) return first;
    const auto had = reachable(to, rows, context, remarks);
    if (!had) return had.error();
    if (const auto garment = garmentBeyond(*damaged, *had)) {
      std::filesystem::remove(to, trouble);
      const auto made = makeAnew(*garment, *damaged, to, context);
      if (made) anew = *made;
      if (made || made.error().kind == Error::Kind::Cancelled) return made ? Done() : Done(made.error());
      std::filesystem::remove(to, trouble);
      if (Done again = write(); !again) return again;
    }
    if (rows.empty()) return nothing;
    if (std::erase_if(rows, [&](const StepRow& row) { return !had->contains(row.seq); }) > 0) {
      if (rows.empty()) return nothing;
      std::filesystem::remove(to, trouble);
      if (Done again = write(); !again) return again;
    }
    Head head = damaged->head();
    if (!had->contains(head.seq) || !had->contains(head.tip)) head.seq = head.tip = rows.back().seq;
    auto fresh = Store::open(to, true);
    return fresh ? fresh->move(head) : Done(fresh.error());
  }();
  if (!done) {
    std::filesystem::remove(to, trouble);
    return done.error();
  }
  if (anew > 0) return Rescued{0, damaged->unsound() + damaged->rows().size(), anew, {}};
  return Rescued{rows.size(), damaged->unsound() + damaged->rows().size() - rows.size(), 0, remarks};
}

}  // namespace karinui

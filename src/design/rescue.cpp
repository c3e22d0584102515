#include <set>

#include "design/chain.h"
#include "design/file/store.h"
#include "karinui/design/history.h"

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
Result<std::set<std::uint64_t>> reachable(const std::filesystem::path& copy, const std::vector<StepRow>& rows,
                                          Context& context) {
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
  return had;
}

}  // namespace

Result<Rescued> rescue(const std::filesystem::path& from, const std::filesystem::path& to, Context& context) {
  const auto damaged = Store::openDamaged(from);
  if (!damaged) return damaged.error();
  auto rows = wholeRows(*damaged);
  const Error nothing = badInput(say(
      "Not one step of “{0}” is whole; nothing could be saved. Take an older copy of it.", from.filename().string()));
  if (rows.empty()) return nothing;
  const auto write = [&]() -> Done {
    auto fresh = Store::create(to);
    return fresh ? copy(*damaged, rows, *fresh) : Done(fresh.error());
  };
  std::error_code trouble;
  if (std::filesystem::exists(to, trouble)) return Store::create(to).error();  // it stays
  const Done done = [&]() -> Done {
    if (Done first = write(); !first) return first;
    const auto had = reachable(to, rows, context);
    if (!had) return had.error();
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
  return Rescued{rows.size(), damaged->unsound() + damaged->rows().size() - rows.size()};
}

}  // namespace karinui

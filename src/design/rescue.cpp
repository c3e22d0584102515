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
  std::set<std::uint64_t> there{0};
  for (const StepRow& row : rows) {
    // A document with a part missing, or one of a name that no document gives, is made again from the steps when it is
    // needed.
    Parts parts = damaged.parts(row.seq) ? *damaged.parts(row.seq) : Parts();
    for (const auto& [part, blob] : parts)
      if (!whole.contains(blob) || !isPart(part)) {
        parts.clear();
        break;
      }
    there.insert(row.seq);
    if (Done done = fresh.fill({{{row, parts}}, {}, {row.seq, row.seq}}); !done) return done;
  }
  const Head head = damaged.head();
  return there.contains(head.seq) && there.contains(head.tip) ? fresh.move(head) : Done();
}

}  // namespace

Result<Rescued> rescue(const std::filesystem::path& from, const std::filesystem::path& to) {
  const auto damaged = Store::openDamaged(from);
  if (!damaged) return damaged.error();
  const auto rows = wholeRows(*damaged);
  if (rows.empty())
    return badInput(say("Not one step of “{0}” is whole; nothing could be saved.", from.filename().string()));
  auto fresh = Store::create(to);
  if (!fresh) return fresh.error();
  if (Done done = copy(*damaged, rows, *fresh); !done) {
    fresh = done.error();  // closes it, so that what was begun can go
    std::error_code trouble;
    std::filesystem::remove(to, trouble);
    return done.error();
  }
  return Rescued{rows.size(), damaged->unsound() + damaged->rows().size() - rows.size()};
}

}  // namespace karinui

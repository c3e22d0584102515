#pragma once
// The .karinui file's tables (docs/format/karinui-file.md): reads everything once, then appends. Knows rows and blobs,
// not what they mean.
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "design/file/database.h"

namespace karinui {

// A step as it lies in the file.
struct StepRow {
  std::uint64_t seq = 0, parent = 0;
  std::uint32_t serial = 0;
  std::string kind, args, chain, before, after, stand;
  std::string seal() const;  // of all the others: a changed byte is noticed
};

struct Head {
  std::uint64_t seq = 0;  // where the person stands
  std::uint64_t tip = 0;  // the end of the branch redo walks along
};

// The parts of the document after a step, each the name of a blob: "rest", "figure", "piece 65536", "form 65536",
// "rested 0.65536".
using Parts = std::map<std::string, std::string>;
bool isPart(std::string_view name);  // as one of these

class Store {
 public:
  // What is written at once: steps by seq, each with the parts of the document after it.
  struct Content {
    std::vector<std::pair<StepRow, Parts>> steps;
    std::map<std::string, std::string> blobs;
    Head head;
  };
  static Result<Store> create(const std::filesystem::path& path);
  static Result<Store> open(const std::filesystem::path& path, bool toWrite);
  // For reading what is whole of a damaged one: rows that are not sound are counted and left out.
  static Result<Store> openDamaged(const std::filesystem::path& path);

  const std::vector<StepRow>& rows() const { return rows_; }  // by seq, as they were when it was opened
  Head head() const { return head_; }
  std::size_t unsound() const { return unsound_; }  // rows left out
  bool writable() const { return writable_; }

  // One transaction each: on the disk when it returns, or nothing changed.
  Done fill(const Content& content);
  Done move(Head head);
  Done keep(const std::string& name, std::string_view bytes);

  Result<Parts> parts(std::uint64_t seq) const;
  // Steps beside which parts are kept, newest first, as far as they can be read; also of rows that are lost.
  std::vector<std::uint64_t> keptSteps() const;
  Result<std::string> blob(const std::string& name) const;  // checked against its name
  std::vector<std::string> blobNames() const;               // as far as they can be read
  const std::filesystem::path& path() const { return db_.path(); }
  bool moved() const { return db_.moved(); }
  Result<std::string> bytes() const { return db_.bytes(); }

 private:
  explicit Store(Database db) : db_(std::move(db)) {}
  Done load(bool damagedToo);
  // Parts of one transaction.
  Done insertBlob(const std::string& name, std::string_view bytes);
  Done insertRow(const StepRow& row, const Parts& parts);
  Done updateHead(Head head);
  Done inOneTransaction(const std::function<Done()>& work);
  Database db_;
  std::vector<StepRow> rows_;
  Head head_;
  std::size_t unsound_ = 0;
  bool writable_ = false;
};

}  // namespace karinui

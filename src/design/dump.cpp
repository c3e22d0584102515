#include "karinui/design/dump.h"

#include <charconv>

#include "design/chain.h"
#include "design/file/store.h"
#include "karinui/base/base64.h"

namespace karinui {

namespace {

constexpr std::string_view kFirstLine = "karinui dump 1";
constexpr std::size_t kLine = 76;  // letters of base64, as MIME has them

bool isHash(std::string_view word) {
  return word.size() == 32 && word.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::optional<std::uint64_t> wholeNumber(std::string_view word) {
  std::uint64_t value = 0;
  const auto [end, trouble] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (trouble != std::errc() || end != word.data() + word.size() || (word.size() > 1 && word[0] == '0'))
    return std::nullopt;
  return value;
}

Error notOurs(const Store& store, std::string_view what) {
  return badInput(
      say("“{0}” holds something a Karinui document does not have (“{1}”): another program wrote into it. Take an "
          "older copy of it.",
          store.path().filename().string(), std::string(what.substr(0, 40))));
}

void addBlob(std::string& all, const std::string& name, std::string_view bytes) {
  all += "blob " + name + " " + std::to_string(bytes.size()) + "\n";
  const std::string letters = base64(bytes);
  for (std::size_t at = 0; at < letters.size(); at += kLine) all += letters.substr(at, kLine) + "\n";
}

// Takes a dump apart line by line. What it meets is a stranger's.
class DumpReader {
 public:
  explicit DumpReader(std::string_view text) : rest_(text) {}

  Result<Store::Content> read() {
    if (!next() || line_ != kFirstLine)
      return badInput(say("This is not a dump of a Karinui document: its first line is not “{0}”.", kFirstLine));
    bool ended = false, headed = false;
    while (!ended && next()) {
      Done done;
      if (line_.starts_with("step ")) {
        done = headed ? wrong() : step();
      } else if (line_.starts_with("part ")) {
        done = headed ? wrong() : part();
      } else if (line_.starts_with("head ")) {
        done = headed ? wrong() : head();
        headed = true;
      } else if (line_.starts_with("blob ")) {
        done = blob();
      } else if (line_ == "end") {
        ended = true;
      } else {
        done = wrong();
      }
      if (!done) return done.error();
    }
    if (!ended || !headed)
      return badInput(
          say("The dump breaks off after line {0}. Dump the document again, or copy the text whole.", number_));
    if (!rest_.empty())
      return badInput(
          say("The dump goes on after its end, in line {0}. Take out what follows the line “end”.", number_ + 1));
    return std::move(content_);
  }

 private:
  bool next() {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line_.ends_with('\r')) line_.remove_suffix(1);  // a file that went through a program of Windows
    ++number_;
    return true;
  }
  Done wrong() const {
    return badInput(
        say("Line {0} of the dump cannot be understood. Dump the document again, or take back what was changed there.",
            number_));
  }
  std::vector<std::string_view> words() const {
    std::vector<std::string_view> all;
    for (std::string_view rest = line_; !rest.empty();) {
      const std::size_t end = rest.find(' ');
      all.push_back(rest.substr(0, end));
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return all;
  }

  // step SEQ PARENT BEFORE AFTER STAND, and on the line below it the operation
  Done step() {
    const auto word = words();
    const auto seq = word.size() == 6 ? wholeNumber(word[1]) : std::nullopt;
    const auto parent = seq ? wholeNumber(word[2]) : std::nullopt;
    if (!parent || *seq >= std::uint64_t{1} << 63 || !isHash(word[3]) || !isHash(word[4]) || !isHash(word[5]))
      return wrong();
    const auto before = chains_.find(*parent);
    if (before == chains_.end() || *parent >= *seq ||
        (!content_.steps.empty() && *seq <= content_.steps.back().first.seq))
      return badInput(
          say("The step in line {0} of the dump does not follow from one before it. Take back what was changed there.",
              number_));
    StepRow row;
    row.seq = *seq, row.parent = *parent, row.serial = before->second.serial + 1;
    row.before = word[3], row.after = word[4], row.stand = word[5];
    if (!next()) return wrong();
    const auto operation = parseOperation(line_);
    if (!operation) return Error{operation.error().kind, say("Line {0}: {1}", number_, operation.error().what)};
    const std::string said = text(*operation);
    row.kind = nameOf(*operation);
    if (said.size() > row.kind.size()) row.args = said.substr(row.kind.size() + 1);
    row.chain = chained(before->second.chain, *operation);
    chains_[row.seq] = {row.chain, row.serial};
    content_.steps.push_back({std::move(row), {}});
    return {};
  }

  // part NAME BLOB
  Done part() {
    const std::size_t end = line_.rfind(' ');
    const std::string_view name = end > 5 ? line_.substr(5, end - 5) : "", blob = line_.substr(end + 1);
    if (content_.steps.empty() || !isPart(name) || !isHash(blob)) return wrong();
    return content_.steps.back().second.emplace(name, blob).second ? Done() : wrong();
  }

  // head SEQ TIP
  Done head() {
    const auto word = words();
    const auto seq = word.size() == 3 ? wholeNumber(word[1]) : std::nullopt;
    const auto tip = seq ? wholeNumber(word[2]) : std::nullopt;
    if (!tip || !chains_.contains(*seq) || !chains_.contains(*tip)) return wrong();
    content_.head = {*seq, *tip};
    return {};
  }

  // blob NAME SIZE, and on the lines below it its bytes
  Done blob() {
    const auto word = words();
    const auto size = word.size() == 3 ? wholeNumber(word[2]) : std::nullopt;
    if (!size || !isHash(word[1])) return wrong();
    const std::string name(word[1]);
    const std::size_t first = number_;
    if (*size > rest_.size()) return wrong();
    std::string letters;
    for (const std::size_t wanted = (*size + 2) / 3 * 4; letters.size() < wanted;) {
      if (!next() || line_.empty()) return wrong();
      letters += line_;
    }
    auto bytes = fromBase64(letters);
    if (!bytes || bytes->size() != *size || blobName(*bytes) != name)
      return badInput(say("The part in line {0} of the dump is damaged. Dump the document again.", first));
    return content_.blobs.emplace(name, *std::move(bytes)).second ? Done() : wrong();
  }

  struct Before {
    std::string chain;
    std::uint32_t serial = 0;
  };
  std::string_view rest_, line_;
  std::size_t number_ = 0;
  std::map<std::uint64_t, Before> chains_{{0, {}}};  // of the steps so far
  Store::Content content_;
};

}  // namespace

bool isDump(std::string_view text) {
  return text.starts_with(kFirstLine) && text.substr(kFirstLine.size()).find_first_not_of("\r\n") != 0;
}

Result<std::string> dumped(const std::filesystem::path& document) {
  const auto store = Store::open(document, false);
  if (!store) return store.error();
  std::string all(kFirstLine);
  all += "\n";
  std::map<std::uint64_t, std::string> chains{{0, {}}};
  for (const StepRow& row : store->rows()) {
    const auto operation = parseOperation(row.args.empty() ? row.kind : row.kind + " " + row.args);
    if (!operation) return operation.error();
    if (chained(chains.at(row.parent), *operation) != row.chain)
      return damagedDocument(
          say("“{0}” is damaged at step {1}; nothing was changed. What is whole of it goes to a new document by "
              "“karinui rescue”.",
              document.filename().string(), std::size_t{row.serial}));
    chains[row.seq] = row.chain;
    for (const std::string* hash : {&row.before, &row.after, &row.stand})
      if (!isHash(*hash)) return notOurs(*store, *hash);
    all += "step " + std::to_string(row.seq) + " " + std::to_string(row.parent) + " " + row.before + " " + row.after +
           " " + row.stand + "\n" + text(*operation) + "\n";
    const auto parts = store->parts(row.seq);
    if (!parts) return parts.error();
    for (const auto& [part, blob] : *parts) {
      if (!isPart(part)) return notOurs(*store, part);
      if (!isHash(blob)) return notOurs(*store, blob);
      all += "part " + part + " " + blob + "\n";
    }
  }
  all += "head " + std::to_string(store->head().seq) + " " + std::to_string(store->head().tip) + "\n";
  const auto names = store->blobNames();
  for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
    const auto bytes = store->blob(name);
    if (!bytes) return bytes.error();
    if (!isHash(name)) return notOurs(*store, name);
    addBlob(all, name, *bytes);
  }
  return all + "end\n";
}

Done loadDump(std::string_view dump, const std::filesystem::path& to) {
  const auto content = DumpReader(dump).read();
  if (!content) return content.error();
  auto store = Store::create(to);
  if (!store) return store.error();
  Done done = store->fill(*content);
  if (!done) {
    store = done.error();  // closes it, so that what was begun can go
    std::error_code trouble;
    std::filesystem::remove(to, trouble);
  }
  return done;
}

}  // namespace karinui

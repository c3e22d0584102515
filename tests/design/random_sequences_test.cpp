// Three hundred random garments of forty operations each, undone, done again and reopened in between: no crash; what is
// refused changes nothing; undo to the beginning gives the empty document; the log replays to the same one. A fault is
// told with its seed and the shortest script that shows it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <random>

#include "design/allocations.h"
#include "design/quick_folder.h"
#include "design/shrunk.h"
#include "design/workroom.h"

namespace karinui {
namespace {

class Tailor {
 public:
  explicit Tailor(std::uint64_t seed) : dice_(seed) {}

  std::string operation(const Document& d) {
    const std::string p = piece(d), q = piece(d);
    switch (below(28)) {
      case 0:
      case 1:
      case 2:
        return newPiece();
      case 3:
        return "move piece=" + p + " by=" + num(0.5) + "," + num(0.5) + "," + num(0.5) + " turn=\"" + num(1) + ",1,0 " +
               num(3) + "\"";
      case 4:
      case 5:
      case 6:
        return "sew a=" + edge(d) + " b=" + edge(d);
      case 7:
        return "sew a=" + edge(d) + "@0:" + num01() + " b=" + edge(d);
      case 8:
        return "unsew seam=" + seam(d);
      case 9:
      case 10:
      case 11:
        return "cut piece=" + p + " line=\"" + place() + "; " + place() + "\"";
      case 12:
        return "drape";
      case 13:
        return "drape live=" + p;
      case 14:
        return "pull piece=" + p + " at=" + place() + " by=0,5cm,5cm";
      case 15:
        return "fabric name=f" + std::to_string(below(3)) + " like=cotton weight=0." + std::to_string(1 + below(4)) +
               " piece=" + p;
      case 16:
        return "pin piece=" + p + " at=" + place();
      case 17:
        return "unpin piece=" + p;
      case 18:
        return below(3) == 0 ? "remove piece=" + p : "duplicate piece=" + p + " by=0.1,0,0";
      case 19:
        return "mirror piece=" + p;
      case 20:
        return "rename edge=" + edge(d) + " to=r" + std::to_string(below(20));
      case 21:
        return "freeze piece=\"" + p + " " + q + "\" frozen=" + (below(2) == 0 ? "yes" : "no");
      case 22:
        return "notch edge=" + edge(d) + " at=" + num01();
      case 23:
        return "reshape piece=" + p + " at=" + place() + " by=" + num(0.05) + "," + num(0.05) + "," + num(0.05) +
               " within=" + std::to_string(1 + below(9)) + "cm";
      case 24:
        return "dart edge=" + edge(d) + " at=" + num01() + " tip=" + place() + " width=2cm";
      case 25:
        return below(2) == 0 ? "hem edges=" + edge(d) + " width=3cm"
                             : "allowance edges=" + edge(d) + " width=" + std::to_string(below(40)) + "mm";
      case 26:
        return below(2) == 0 ? "split edge=" + edge(d) + " at=" + num01() : "join edge=" + edge(d);
      default:
        return below(2) == 0 ? "grain piece=" + p + " to=" + num(1) + "," + num(1)
                             : "set spacing=" + std::to_string(below(60)) + "mm";
    }
  }
  std::uint64_t below(std::uint64_t n) { return dice_() % n; }

 private:
  std::string num(double size) { return std::to_string(size * (static_cast<double>(below(2001)) / 1000 - 1)); }
  std::string num01() { return std::to_string(static_cast<double>(below(1001)) / 1000); }
  std::string place() {
    return std::to_string(static_cast<int>(below(500)) - 50) + "mm," +
           std::to_string(static_cast<int>(below(500)) - 50) + "mm";
  }
  template <class Map>
  auto any(const Map& map) {
    auto at = map.begin();
    std::advance(at, static_cast<long>(below(map.size())));
    return at;
  }
  std::string piece(const Document& d) {
    return d.pattern.pieces.empty() || below(30) == 0 ? "p99" : text(any(d.pattern.pieces)->first);
  }
  std::string seam(const Document& d) { return d.pattern.seams.empty() ? "s99" : text(any(d.pattern.seams)->first); }
  std::string edge(const Document& d) {
    if (d.pattern.pieces.empty()) return "p99.hem";
    const Piece& p = *any(d.pattern.pieces)->second;
    return text(p.id) + "." + p.outline.edges[below(p.outline.edges.size())].name;
  }
  std::string newPiece() {
    std::string all = "piece name=n" + std::to_string(below(1000)) + " outline=\"M 0 0";
    all += "; hem L " + std::to_string(100 + below(300)) + " 0";
    all += "; side C " + std::to_string(300 + below(200)) + " 100 350 200 " + std::to_string(300 + below(100)) + " " +
           std::to_string(200 + below(200));
    all += below(2) == 0 ? "; top A 0.3 0 300" : "; top L 0 300";
    return all + "; left L 0 0\" pose=\"0,1,0." + std::to_string(below(9)) + "\"";
  }
  std::mt19937_64 dice_;
};

// Plays a script, whose lines are operations, undo, redo and reopen, on a file, and looks for faults after each.
class Rehearsal {
 public:
  Rehearsal() {
    folder_ = quickFolder();
    file_.emplace(*DocumentFile::create(folder_ / "garment.karinui"));
  }
  ~Rehearsal() {
    file_.reset();
    std::filesystem::remove_all(folder_);
  }
  const Document& document() const { return file_->document(); }
  std::size_t performed() const { return performed_; }

  // What is wrong after this line; empty: nothing.
  std::string play(const std::string& line) {
    const std::string before = hash(document()), stand = drapeHash(document());
    if (line == "undo") return (void)file_->undo(room_.context), "";
    if (line == "redo") return (void)file_->redo(room_.context), "";
    if (line == "reopen") return reopened();
    const auto operation = parseOperation(line);
    if (!operation) return line + ": " + text(operation.error().what);
    const auto step = file_->perform(*operation, room_.context);
    if (!step && text(step.error().what).empty()) return line + " is refused without a word";
    if (!step && (before != hash(document()) || stand != drapeHash(document()))) return line + ": refused, yet changed";
    if (step && step->after != hash(document())) return line + " leads to another document than it says";
    performed_ += step ? 1 : 0;
    for (const auto& [id, seam] : document().pattern.seams)
      for (const auto* side : {&seam.a, &seam.b})
        for (const EdgeSpan& span : *side)
          if (const Piece* piece = document().find(span.piece); !piece || !piece->outline.find(span.edge))
            return line + ": seam " + text(id) + " has lost its edge";
    return "";
  }

  // The same at the end, once: replay and undo.
  std::string end() {
    const std::string before = hash(document()), stand = drapeHash(document()), log = file_->log();
    DocumentFile again = DocumentFile::inMemory();
    if (const Done replay = room_.play(again, log); !replay) return "replay: " + text(replay.error().what);
    if (hash(again.document()) != before || drapeHash(again.document()) != stand) return "replay leads elsewhere";
    if (again.log() != log) return "replay has another log";
    while (file_->undo(room_.context)) {
    }
    return hash(document()) == hash(Document()) ? "" : "undo does not lead to nothing";
  }

 private:
  std::string reopened() {
    const std::string before = hash(document()), stand = drapeHash(document()), log = file_->log();
    file_.reset();
    auto opened = DocumentFile::open(folder_ / "garment.karinui", &room_.context);
    if (!opened) return "reopen: " + text(opened.error().what);
    file_.emplace(*std::move(opened));
    if (!file_->remarks().empty()) return "reopen: " + text(file_->remarks().front());
    const bool same = hash(document()) == before && drapeHash(document()) == stand && file_->log() == log;
    return same ? "" : "reopen leads elsewhere";
  }

  std::filesystem::path folder_;
  Workroom room_;
  std::optional<DocumentFile> file_;
  std::size_t performed_ = 0;
};

std::string faultOf(const Lines& lines) {
  Rehearsal rehearsal;
  for (const std::string& line : lines)
    if (std::string fault = rehearsal.play(line); !fault.empty()) return fault;
  return rehearsal.end();
}

struct Garment {
  Lines lines;
  std::string fault;
  std::size_t performed = 0;
};
Garment randomGarment(std::uint64_t seed, int operations) {
  Tailor tailor(seed);
  Rehearsal rehearsal;
  Garment garment;
  for (int i = 0; i < operations && garment.fault.empty(); ++i) {
    const std::uint64_t way = tailor.below(24);
    garment.lines.push_back(way < 2    ? "undo"
                            : way < 4  ? "redo"
                            : way == 4 ? "reopen"
                                       : tailor.operation(rehearsal.document()));
    garment.fault = rehearsal.play(garment.lines.back());
  }
  if (garment.fault.empty()) garment.fault = rehearsal.end();
  garment.performed = rehearsal.performed();
  return garment;
}

std::string script(const Lines& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

TEST(RandomGarments, NeverCrashUndoToNothingAndReplay) {
  std::size_t performed = 0, asked = 0;
  for (std::uint64_t seed = 1, last = static_cast<std::uint64_t>(soak(300)); seed <= last; ++seed) {
    const Garment garment = randomGarment(seed, 40);
    performed += garment.performed;
    for (const std::string& line : garment.lines) asked += line != "undo" && line != "redo" && line != "reopen";
    if (garment.fault.empty()) continue;
    const Lines few = shrunk(garment.lines, [](const Lines& lines) { return !faultOf(lines).empty(); });
    FAIL() << "seed " << seed << ": " << garment.fault << "\nThe shortest script that shows it (" << faultOf(few)
           << "):\n"
           << script(few);
  }
  EXPECT_GT(performed * 2, asked);  // the dice are not so bad that little happens
}

// What a fault would be told as, by a fault made up: three pieces at once.
TEST(RandomGarments, AFailingScriptIsShrunkToWhatItTakes) {
  const auto fails = [](const Lines& lines) {
    Rehearsal rehearsal;
    for (const std::string& line : lines) {
      (void)rehearsal.play(line);
      if (rehearsal.document().pattern.pieces.size() >= 3) return true;
    }
    return false;
  };
  const Lines all = randomGarment(8, 40).lines;
  ASSERT_TRUE(fails(all)) << script(all);
  const Lines few = shrunk(all, fails);
  EXPECT_TRUE(fails(few));
  EXPECT_LE(few.size(), 3u) << script(few);
  for (std::size_t k = 0; k < few.size(); ++k) {
    Lines fewer = few;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_FALSE(fails(fewer));
  }
  const auto needs = [](const Lines& lines) {
    return std::count(lines.begin(), lines.end(), "a") > 0 && std::count(lines.begin(), lines.end(), "b") > 0;
  };
  Lines hay(1000, "-");
  hay[17] = "a", hay[800] = "b", hay[801] = "b";
  EXPECT_THAT(shrunk(hay, needs), testing::ElementsAre("a", "b"));
}

// The same garments again and again take no more memory than they did: for eight hours with
// KARINUI_SOAK_SECONDS=28800, otherwise a few times.
TEST(RandomGarments, MemoryStaysFlat) {
  const auto inUse = [] { return static_cast<double>(bytesInUse() + sqlite3_memory_used()); };
  const auto pass = [] {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) ASSERT_EQ(randomGarment(seed, 40).fault, "") << "seed " << seed;
  };
  pass();
  const double warm = inUse();
  const char* asked = std::getenv("KARINUI_SOAK_SECONDS");
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(asked ? std::atoi(asked) : 0);
  int passes = 0;
  for (; passes < soak(5) || std::chrono::steady_clock::now() < until; ++passes) {
    pass();
    ASSERT_LT(inUse(), 1.02 * warm) << "after " << passes + 1 << " passes";
  }
  std::printf("%d passes of 10 garments: %.0f kB in use before, %.0f kB after.\n", passes, warm / 1024, inUse() / 1024);
}

}  // namespace
}  // namespace karinui

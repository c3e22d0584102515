// Three hundred random garments of forty operations each: no crash; undo to the beginning gives the empty document; the
// log replays to the same one.
#include <gtest/gtest.h>

#include <random>

#include "design/workroom.h"

namespace karinui {
namespace {

class Tailor {
 public:
  explicit Tailor(std::uint64_t seed) : dice_(seed) {}

  std::string operation(const Document& d) {
    const std::string p = piece(d), q = piece(d);
    switch (below(24)) {
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

TEST(RandomGarments, NeverCrashUndoToNothingAndReplay) {
  Workroom room;
  std::size_t performed = 0, asked = 0;
  for (std::uint64_t seed = 1, last = static_cast<std::uint64_t>(soak(300)); seed <= last; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Tailor tailor(seed);
    DocumentFile file = DocumentFile::inMemory();
    for (int i = 0; i < 40; ++i) {
      switch (tailor.below(12)) {
        case 0:
          (void)file.undo(room.context);
          continue;
        case 1:
          (void)file.redo(room.context);
          continue;
        default:
          break;
      }
      const std::string line = tailor.operation(file.document());
      const auto op = parseOperation(line);
      ASSERT_TRUE(op) << line << ": " << text(op.error().what);
      const std::string before = hash(file.document());
      const auto step = file.perform(*op, room.context);
      ++asked, performed += step ? 1 : 0;
      if (step) {
        ASSERT_EQ(step->after, hash(file.document()));
      } else {
        ASSERT_EQ(before, hash(file.document())) << line;
        ASSERT_FALSE(step.error().what.empty());
      }
      for (const auto& [id, seam] : file.document().pattern.seams) {
        for (const auto* side : {&seam.a, &seam.b}) {
          for (const EdgeSpan& span : *side) {
            const Piece* piece = file.document().find(span.piece);
            ASSERT_TRUE(piece && piece->outline.find(span.edge))
                << line << ": seam " << text(id) << " has lost its edge";
          }
        }
      }
    }
    const std::string end = hash(file.document()), stand = drapeHash(file.document()), log = file.log();
    DocumentFile again = DocumentFile::inMemory();
    const Done replay = room.play(again, log);
    ASSERT_TRUE(replay) << text(replay.error().what) << "\n" << log;
    ASSERT_EQ(hash(again.document()), end) << log;
    ASSERT_EQ(drapeHash(again.document()), stand) << log;
    ASSERT_EQ(again.log(), log);
    while (file.undo(room.context)) {
    }
    ASSERT_EQ(hash(file.document()), hash(Document()));
  }
  EXPECT_GT(performed * 2, asked);  // the dice are not so bad that little happens
}

}  // namespace
}  // namespace karinui

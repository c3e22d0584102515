// Pleats stand folded before they are draped: closed where they are sewn, no layer of them passes through another.
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>

#include "design/draping_room.h"
#include "karinui/pattern/pleats.h"

namespace karinui {
namespace {

// What is sewn within a piece, brought together.
ClothState sewnTogether(const Cloth& cloth, ClothState state) {
  std::vector<std::uint32_t> parent(cloth.nodeCount);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::uint32_t k) {
    while (parent[k] != k) k = parent[k];
    return k;
  };
  for (const Tie& tie : cloth.ties) parent[root(tie.b)] = root(tie.a);
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
  for (std::uint32_t k = 0; k < cloth.nodeCount; ++k) groups[root(k)].push_back(k);
  for (const auto& [first, members] : groups) {
    Vec3 sum;
    for (const std::uint32_t k : members) sum += state.position[k];
    for (const std::uint32_t k : members) state.position[k] = sum * (1.0 / static_cast<double>(members.size()));
  }
  return state;
}

// Does a script and examines the cloth where it stands, with so many places at most where it goes through itself;
// false: the pleats have no room on the edge.
bool standsInOrder(const std::string& script, std::size_t most = 0) {
  SCOPED_TRACE(script);
  Document document;
  bool refused = false;
  const auto lines = parseScript(script);
  EXPECT_TRUE(lines) << text(lines.error().what);
  for (const ScriptLine& line : *lines) {
    auto next = apply(document, line.operation, drapingRoom().context);
    refused = refused || !next;
    if (next) document = *std::move(next);
  }
  if (refused) return false;
  const auto stands = standingCloth(document, livePieces(document, {}));
  if (!stands) throw std::runtime_error(text(stands.error().what));
  const ClothCheck found = check(stands->cloth, sewnTogether(stands->cloth, stands->state), nullptr);
  EXPECT_LE(found.clothClothCrossings + found.foldCrossings, most);
  return true;
}

TEST(FoldedPleats, StandInTheirOrder) {
  std::mt19937_64 random(20);
  const auto between = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const char* const kinds[] = {"knife", "box", "inverted"};
  const char* const turned[] = {"along", "against", "inwards", "outwards"};
  int stood = 0;
  for (int k = 0; k < soak(12); ++k) {
    const char* const kind = kinds[between(0, 2)];
    const int least = kind == kinds[1] ? 16 : 11;  // mm: behind a box pleat shallower than that lie no whole cells
    std::string pleat = "pleat edge=front.top kind=" + std::string(kind) + " count=" + std::to_string(between(1, 7)) +
                        " depth=" + std::to_string(between(least, 30)) + "mm stitch=" + std::to_string(between(0, 80)) +
                        "mm";
    if (kind == kinds[0]) pleat += " turned=" + std::string(turned[between(0, 3)]);
    // Box pleats that taper begin crossed where the stitches end in one case of some hundred; the drape separates them.
    if (between(0, 1) && kind != kinds[1]) pleat += " taper=" + std::to_string(between(0, 8)) + "mm taper_length=15cm";
    const std::string script =
        "body size=eu38\nset spacing=10mm\nrectangle name=front width=" + std::to_string(between(300, 450)) +
        "mm height=30cm fabric=linen\n"
        "place piece=front at=\"torso:hip-0.65@0\" ease=10mm\n" +
        pleat + "\n";
    stood += standsInOrder(script);
  }
  EXPECT_GT(stood, soak(12) / 2);
}

// So do those that run out at the lower edge, but for the last cells there, which are wider than the pleat is deep.
TEST(FoldedPleats, ThatRunOutStandInTheirOrder) {
  std::mt19937_64 random(21);
  const auto between = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const char* const turned[] = {"along", "against", "inwards", "outwards"};
  int stood = 0;
  for (int k = 0; k < soak(12); ++k) {
    const std::string script =
        "body size=eu38\nset spacing=10mm\nrectangle name=front width=" + std::to_string(between(300, 450)) +
        "mm height=40cm fabric=linen\n"
        "place piece=front at=\"torso:hip-0.65@0\" ease=10mm\n"
        "pleat edge=front.top to=front.bottom count=" +
        std::to_string(between(1, 4)) + " depth=" + std::to_string(between(11, 30)) +
        "mm stitch=" + std::to_string(between(0, 80)) + "mm turned=" + std::string(turned[between(0, 3)]) + "\n";
    stood += standsInOrder(script, 8);
  }
  EXPECT_GT(stood, soak(12) / 2);
}

// The drape parts those.
TEST(FoldedPleats, OfAPegTopSkirtRest) {
  DocumentFile file = DocumentFile::inMemory();
  std::string script = "body size=eu38\nset spacing=15mm\n";
  for (const char* panel : {"front", "back"})
    script += std::string("polygon name=") + panel +
              " points=\"-24cm,0; 24cm,0; 18.7cm,54cm; -18.7cm,54cm\" fabric=\"wool suiting\"\nplace piece=" + panel +
              " at=\"torso:hip-0.65@" + (panel[0] == 'f' ? "0" : "0.5") + "\" ease=10mm\npleat edge=" + panel +
              ".e3 to=" + panel + ".e1 count=2 depth=35mm turned=inwards stitch=3cm hold=0\n";
  const Done played =
      drapingRoom().play(file, script +
                                   "sew a=front.e4 b=back.e2\nsew a=front.e2 b=back.e4\n"
                                   "band name=waistband depth=4cm sew=yes of=\"front.e3* back.e3*\"\ndrape\n");
  ASSERT_TRUE(played) << text(played.error().what);
  expectHangsWell(file.document());
}

// Of pleats that cover more than they are apart the outer two end at the edge's ends.
TEST(FoldedPleats, OfAKiltLieBetweenTheEndsOfTheEdge) {
  for (const char* turned : {"along", "against"}) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const Done done = room.play(file, std::string("rectangle name=kilt width=60cm height=60cm\npleat edge=kilt.top "
                                                  "count=20 depth=5cm stitch=12cm turned=") +
                                          turned + "\n");
    ASSERT_TRUE(done) << text(done.error().what);
    const Piece& kilt = *file.document().pieceNamed("kilt");
    EXPECT_NEAR(findEdge(kilt, "bottom")->curve.length(), 0.6 + 20 * 2 * 0.05, 1e-9);
    EXPECT_EQ(pleatsOf(file.document().pattern).size(), 20u);
    // Sewn down, the outermost is sewn to a line; on the side itself that could not be laid as cloth.
    const auto laid = lay(file.document().pattern, 0.01);
    EXPECT_TRUE(laid) << text(laid.error().what);
  }
}

TEST(FoldedPleats, CellsTooCoarseForTucksAreTold) {
  Workroom room;
  std::vector<Advice> told;
  room.context.advise = [&](const Advice& advice) { told.push_back(advice); };
  const auto after = [&](const char* pleat) {
    told.clear();
    DocumentFile file = DocumentFile::inMemory();
    const Done done =
        room.play(file, std::string("set spacing=9mm\npiece name=sash outline=\"M 0 0; low L 400 0; end L "
                                    "400 200; top L 0 200; start L 0 0\"\n") +
                            pleat + "\n");
    EXPECT_TRUE(done) << text(done.error().what);
  };
  after("pleat edge=sash.top count=2 depth=15mm stitch=1m");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(text(told[0].what).find("set spacing=7.5mm"), std::string::npos) << text(told[0].what);
  after("pleat edge=sash.top count=2 depth=20mm stitch=1m");
  EXPECT_TRUE(told.empty());
  after("pleat edge=sash.top count=2 depth=15mm");
  EXPECT_TRUE(told.empty()) << "nothing is sewn down";
}

// The lines of a pleat have no beginning: out of the piece is the same direction as into it.
TEST(FoldedPleats, RunIntoThePieceWhicheverWayTheyAreTold) {
  const auto folded = [](const std::string& along) {
    Workroom room;
    DocumentFile file = DocumentFile::inMemory();
    const Done done = room.play(file,
                                "rectangle name=sash width=90cm height=12cm fabric=silk\n"
                                "pleat edge=sash.side_left kind=knife count=4 depth=1cm along=" +
                                    along + "\n");
    EXPECT_TRUE(done) << text(done.error().what);
    return hash(file.document());
  };
  EXPECT_EQ(folded("1,0"), folded("-1,0"));
}

// What is pleated first and placed then stays folded: it is as wide as it was folded, and its layers lie in order.
TEST(FoldedPleats, StayFoldedWhenTheyArePlaced) {
  const std::string pleated =
      "body size=eu38\nset spacing=20mm\nrectangle name=panel width=24cm height=40cm edges=\"hem right waist left\"\n"
      "pleat edge=panel.waist count=3 depth=2cm turned=along\n";
  const auto wide = [](const std::string& script) {
    Document document;
    const auto lines = parseScript(script);
    for (const ScriptLine& line : *lines) {
      auto next = apply(document, line.operation, drapingRoom().context);
      EXPECT_TRUE(next) << text(next.error().what);
      if (next) document = *std::move(next);
    }
    double low = HUGE_VAL, high = -HUGE_VAL;
    const Piece& panel = *document.pieceNamed("panel");
    for (const Vec3 p : panel.form->space) low = std::min(low, panel.pose(p).x), high = std::max(high, panel.pose(p).x);
    return high - low;
  };
  const std::string placed = "place piece=panel at=torso:waist@0 ease=2cm";
  EXPECT_TRUE(standsInOrder(pleated + placed + "\n"));
  const double before =
      wide("body size=eu38\nset spacing=20mm\nrectangle name=panel width=24cm height=40cm\n" + placed);
  EXPECT_NEAR(wide(pleated + placed), before, 0.02);
  EXPECT_GT(wide(pleated + placed + " folded=no"), before + 0.02);
}

// So do those that are deeper at the waist than at the hip: below it the folded cloth is wider, at the waist it is not.
TEST(FoldedPleats, ThatTaperStayFoldedWhenTheyArePlaced) {
  for (const char* kind : {"knife", "box", "inverted"}) {
    const std::string pleated =
        "body size=eu38\nset spacing=12mm\nrectangle name=panel width=36cm height=40cm "
        "edges=\"hem right waist left\"\npleat edge=panel.waist count=3 depth=25mm taper=12mm taper_length=18cm kind=" +
        std::string(kind) + "\n";
    EXPECT_TRUE(standsInOrder(pleated + "place piece=panel at=torso:waist@0 ease=2cm\n")) << kind;
    Document document;
    const auto lines = parseScript(pleated);
    for (const ScriptLine& line : *lines) document = *apply(document, line.operation, drapingRoom().context);
    const Piece& panel = *document.pieceNamed("panel");
    const auto folding = foldingOf(document.pattern, panel.id);
    ASSERT_TRUE(folding) << kind;
    // The taper begins where the waist lies; halfway down three quarters of it are given up.
    const FlatBox box = boxOf(panel.outline.flattened(1e-4));
    const auto wide = [&](double below) {
      const double v = box.high.v - below;
      return folding->folded({box.high.u, v}).place.u - folding->folded({box.low.u, v}).place.u;
    };
    const double folds = std::string(kind) == "knife" ? 3 : 6;
    EXPECT_NEAR(wide(0), 0.36, 1e-4) << kind;
    EXPECT_NEAR(wide(0.09), 0.36 + folds * 0.012 * 0.75, 1e-4) << kind;
    EXPECT_NEAR(wide(0.30), 0.36 + folds * 0.012, 1e-4) << kind;
  }
}

}  // namespace
}  // namespace karinui

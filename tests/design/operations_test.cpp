// Every operation has a folder in tests/design/operations: `start.ops` leads to a document, `operation.ops` holds the
// operation (and later ones), `expected.txt` the facts afterwards, `refused.txt` operations that are refused and the
// sentence. Each is also undone and replayed from its log.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "design/workroom.h"
#include "karinui/base/number.h"
#include "karinui/design/print_image.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream all;
  all << file.rdbuf();
  return all.str();
}

std::vector<std::string> lines(const fs::path& path) {
  std::vector<std::string> all;
  std::istringstream in(read(path));
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line[0] != '#') all.push_back(line);
  return all;
}

// The document as facts, one a line, in words a person can check.
std::string facts(const Document& d) {
  std::ostringstream out;
  const auto name = [&](PieceId id) { return d.find(id) ? d.find(id)->name : text(id); };
  const auto side = [&](const std::vector<EdgeSpan>& spans) {
    std::string all;
    for (const EdgeSpan& s : spans) {
      all += (all.empty() ? "" : "+") + name(s.piece) + "." + s.edge;
      if (s.from != 0 || s.to != 1) all += "@" + fixed(s.from, 2) + ":" + fixed(s.to, 2);
    }
    return all;
  };
  if (d.body.chosen()) out << "body " << (d.body.mesh.empty() ? d.body.size : "mesh") << "\n";
  for (const auto& [joint, a] : d.body.pose)
    out << "joint " << jointNames()[static_cast<std::size_t>(joint)] << " " << fixed(a.flex, 3) << " "
        << fixed(a.abduct, 3) << " " << fixed(a.turn, 3) << "\n";
  for (const auto& [id, p] : d.pattern.pieces) {
    out << "piece " << text(id) << " " << p->name << " area_cm2 " << fixed(p->outline.area() * 1e4, 1) << " edges";
    for (const Edge& e : p->outline.edges) out << " " << e.name << ":" << fixed(e.curve.length() * 1000, 1);
    out << "\n";
    if (p->fabric != "cotton") out << "  fabric " << p->fabric << "\n";
    if (!p->interfacing.empty()) out << "  fused " << p->interfacing << "\n";
    if (p->layer != 0) out << "  layer " << p->layer << "\n";
    if (p->frozen) out << "  frozen\n";
    if (p->mirrorOf) out << "  mirror of " << name(p->mirrorOf) << "\n";
    if (p->grain != Flat{0, 1}) out << "  grain " << fixed(p->grain.u, 3) << " " << fixed(p->grain.v, 3) << "\n";
    for (const Mark& m : p->marks)
      out << "  mark " << m.name << " " << (m.edge.empty() ? "hole" : m.edge + "@" + fixed(m.fraction, 3)) << "\n";
    for (const Outline& h : p->holes) out << "  hole area_cm2 " << fixed(h.area() * 1e4, 1) << "\n";
    for (const InternalLine& l : p->lines) out << "  line " << l.name << "\n";
    const Ring ring = p->outline.flattened(1e-3);
    const Vec3 first = Stand(*p)(ring.front());
    out << "  stands " << fixed(first.x, 3) << " " << fixed(first.y, 3) << " " << fixed(first.z, 3) << "\n";
    if (d.drape.dirty.contains(id)) out << "  dirty\n";
  }
  for (const auto& [id, s] : d.pattern.seams) {
    out << "seam " << text(id) << (s.name.empty() ? "" : " " + s.name) << " " << side(s.a)
        << (s.reversed ? " against " : " along ") << side(s.b) << " " << tieName(s.tie) << " ease "
        << fixed(easeRatio(d.pattern, s), 3) << "\n";
  }
  for (const auto& [fabricName, f] : d.fabrics)
    out << "fabric " << fabricName << " weight " << fixed(f.weight, 3) << "\n";
  for (const auto& [kind, width] : d.allowances.kinds)
    out << "allowance kind " << static_cast<int>(kind) << " mm " << fixed(width * 1000, 1) << "\n";
  for (const auto& [at, width] : d.allowances.edges)
    out << "allowance " << name(at.first) << "." << at.second << " mm " << fixed(width * 1000, 1) << "\n";
  for (const auto& [at, kind] : d.allowances.corners)
    out << "corner " << name(at.first) << "." << at.second << " kind " << static_cast<int>(kind) << "\n";
  for (const auto& [at, own] : d.allowances.elastics)
    out << "elastic " << name(at.first) << "." << at.second << " ratio " << fixed(own.ratio, 4) << " strength "
        << fixed(own.strength, 1) << "\n";
  for (const auto& [at, own] : d.allowances.hems)
    out << "hem " << name(at.first) << "." << at.second << " mm " << fixed(own.width * 1000, 1) << " "
        << fixed(own.under * 1000, 1) << "\n";
  for (const auto& [at, own] : d.allowances.topstitches)
    out << "topstitch " << name(at.first) << "." << at.second << " mm " << fixed(own.offset * 1000, 1) << " rows "
        << own.rows << " apart " << fixed(own.apart * 1000, 1) << " stitch " << fixed(own.length * 1000, 1)
        << " colour " << (own.colour ? std::to_string(*own.colour) : "own") << "\n";
  for (const auto& [at, own] : d.allowances.pipings)
    out << "piping " << name(at.first) << "." << at.second << " mm " << fixed(own.thickness * 1000, 1) << " of "
        << (own.fabric.empty() ? "its own" : own.fabric) << "\n";
  for (const auto& [at, own] : d.allowances.bindings)
    out << "binding " << name(at.first) << "." << at.second << " mm " << fixed(own.width * 1000, 1) << " of "
        << (own.fabric.empty() ? "its own" : own.fabric) << "\n";
  for (const auto& [fastened, own] : d.allowances.fastenings) {
    out << "fastening " << fastened << " kind " << static_cast<int>(own.kind) << " " << side(own.a)
        << (own.reversed ? " against " : " along ") << side(own.b) << " at";
    for (const double at : own.at) out << " " << fixed(at, 3);
    out << (own.fromStart ? " from start closed " : " from end closed ") << own.closed << " zipped "
        << fixed(own.zipped, 3) << " inset_mm " << fixed(own.inset * 1000, 1) << " size_mm "
        << fixed(own.size * 1000, 1) << " gap_mm " << fixed(own.gap * 1000, 1) << (own.holesAlong ? " along\n" : "\n");
  }
  for (const auto& [id, p] : d.pattern.pieces)
    for (const InternalLine& line : p->lines)
      if (line.crease)
        out << "fold " << p->name << "." << line.name << " " << fixed(line.crease->angle, 4) << " "
            << fixed(line.crease->hold, 2) << "\n";
  for (const auto& [id, cutting] : d.cutting)
    out << "cut " << name(id) << " times " << cutting.count << (cutting.pairs ? " in pairs\n" : "\n");
  for (const auto& [id, ease] : d.eases) out << "ease " << text(id) << " mm " << fixed(ease * 1000, 1) << "\n";
  for (std::size_t i = 0; i < d.grading.sizes.size(); ++i)
    out << "size " << d.grading.sizes[i] << (i == d.grading.base ? " base" : "")
        << (i == d.grading.standing ? " stands\n" : "\n");
  for (const auto& [id, points] : d.grading.pieces)
    for (const GradePoint& point : points) {
      out << "graded " << name(id) << "." << point.edge << "@" << fixed(point.at, 3);
      for (const Flat by : point.by) out << " " << fixed(by.u * 1000, 2) << "," << fixed(by.v * 1000, 2);
      out << "\n";
    }
  const auto look = [&](const std::string& whose, const Look& l) {
    const auto dye = [](const Dye& c) {
      return std::to_string(c.red) + "," + std::to_string(c.green) + "," + std::to_string(c.blue);
    };
    out << "look " << whose << " finish " << static_cast<int>(l.finish) << " colour " << dye(l.colour);
    if (l.print != PrintKind::None)
      out << " print " << static_cast<int>(l.print) << " ink " << dye(l.ink) << " repeat_mm "
          << fixed(l.repeat * 1000, 1) << " turn " << fixed(l.turn, 3);
    if (l.wrong)
      out << " wrong side " << dye(l.wrong->colour) << " print " << static_cast<int>(l.wrong->print) << " ink "
          << dye(l.wrong->ink);
    out << "\n";
  };
  for (const auto& [id, shift] : d.looks.shifts)
    out << "print of " << name(id) << " begins_mm " << fixed(shift.u * 1000, 1) << "," << fixed(shift.v * 1000, 1)
        << "\n";
  for (const auto& [fabricName, l] : d.looks.fabrics) look(fabricName, l);
  for (const auto& [id, l] : d.looks.pieces) look(name(id), l);
  for (const auto& [id, places] : d.pins) out << "pins " << name(id) << " " << places.size() << "\n";
  const Settings usual;
  if (d.settings.spacing != usual.spacing) out << "spacing_mm " << fixed(d.settings.spacing * 1000, 1) << "\n";
  if (d.settings.ease != usual.ease) out << "ease_mm " << fixed(d.settings.ease * 1000, 1) << "\n";
  if (d.settings.collider != usual.collider) out << "collider planes\n";
  for (const auto& [own, formula] : d.variables) out << "variable " << own << " " << formula << "\n";
  for (const auto& [own, u] : d.underlays)
    out << "scan " << own << " pixels " << u.wide << "x" << u.high << " width_mm " << fixed(u.width * 1000, 2)
        << " at_mm " << fixed(u.at.u * 1000, 2) << "," << fixed(u.at.v * 1000, 2) << " turn " << fixed(u.turn, 4)
        << " strength " << fixed(u.strength, 1) << (u.hidden ? " hidden" : "") << "\n";
  if (d.drape.last) out << "draped " << (d.drape.last->settled ? "settled" : "not settled") << "\n";
  return out.str();
}

class EachOperation : public ::testing::TestWithParam<std::string> {
 protected:
  fs::path folder() const { return fs::path(KARINUI_SOURCE_DIR) / "tests/design/operations" / GetParam(); }
  // "EGG" in a script stands for the name of the test's figure, "SCAN" for that of a grey picture of 400 x 300 pixels.
  std::string script(const char* name) {
    std::string all = read(folder() / name);
    for (std::size_t at; (at = all.find("EGG")) != std::string::npos;)
      all.replace(at, 3, *room_.blobs.put(packBody(egg())));
    const PrintPixels grey{400, 300, std::vector<std::uint8_t>(std::size_t{3} * 400 * 300, 128)};
    for (std::size_t at; (at = all.find("SCAN")) != std::string::npos;)
      all.replace(at, 4, *room_.blobs.put(packPrint(grey)));
    return all;
  }
  static Workroom& room() {
    static Workroom shared;  // figures are built once for all
    return shared;
  }
  Workroom& room_ = room();
};

TEST_P(EachOperation, DoesWhatItSaysCanBeUndoneAndReplays) {
  DocumentFile file = DocumentFile::inMemory();
  const Done started = room_.play(file, script("start.ops"));
  ASSERT_TRUE(started) << text(started.error().what);
  const std::string before = facts(file.document()), beforeHash = hash(file.document()),
                    beforeStand = drapeHash(file.document());
  const std::size_t had = file.steps().size();

  const Done done = room_.play(file, script("operation.ops"));
  ASSERT_TRUE(done) << text(done.error().what);
  // KARINUI_ACCEPT=1 writes what was found as the new expectation; read the difference before keeping it.
  if (std::getenv("KARINUI_ACCEPT") != nullptr) std::ofstream(folder() / "expected.txt") << facts(file.document());
  const std::string expected = read(folder() / "expected.txt");
  EXPECT_EQ(facts(file.document()), expected);
  const std::string afterHash = hash(file.document()), afterStand = drapeHash(file.document());

  DocumentFile again = DocumentFile::inMemory();
  const std::string log = file.log();
  const Done replay = room_.play(again, log);
  ASSERT_TRUE(replay) << text(replay.error().what) << "\n" << log;
  EXPECT_EQ(again.log(), log);
  EXPECT_EQ(hash(again.document()), afterHash);
  EXPECT_EQ(drapeHash(again.document()), afterStand);

  while (file.steps().size() > had) ASSERT_TRUE(file.undo(room_.context));
  EXPECT_EQ(facts(file.document()), before);
  EXPECT_EQ(hash(file.document()), beforeHash);
  EXPECT_EQ(drapeHash(file.document()), beforeStand);
  while (!file.undone().empty()) ASSERT_TRUE(file.redo(room_.context));
  EXPECT_EQ(hash(file.document()), afterHash);
}

TEST_P(EachOperation, RefusesInWordsAndChangesNothing) {
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room_.play(file, script("start.ops")));
  const std::string before = hash(file.document()), stand = drapeHash(file.document());
  const auto refusals = lines(folder() / "refused.txt");
  ASSERT_FALSE(refusals.empty());
  for (const std::string& line : refusals) {
    const std::size_t arrow = line.find(" => ");
    ASSERT_NE(arrow, std::string::npos) << line;
    const auto op = parseOperation(line.substr(0, arrow));
    ASSERT_TRUE(op) << line << ": " << text(op.error().what);
    const auto step = file.perform(*op, room_.context);
    ASSERT_FALSE(step) << line;
    EXPECT_THAT(text(step.error().what), ::testing::HasSubstr(line.substr(arrow + 4)));
    EXPECT_EQ(hash(file.document()), before);
    EXPECT_EQ(drapeHash(file.document()), stand);
  }
}

std::vector<std::string> folders() {
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(fs::path(KARINUI_SOURCE_DIR) / "tests/design/operations"))
    if (fs::exists(entry.path() / "start.ops")) all.push_back(entry.path().filename().string());
  std::sort(all.begin(), all.end());
  return all;
}
TEST(Pieces, AreNoMoreThanAThousand) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, "piece name=a outline=\"M 0 0; low L 20 0; side L 20 20; left L 0 0\"\n"));
  Document full = file.document();
  for (std::uint64_t k = 2; k <= 1000; ++k) {
    Piece piece = *full.pattern.pieces.begin()->second;
    piece.id = PieceId{(k << 40)};
    piece.name = "a" + std::to_string(k);
    full.pattern.pieces[piece.id] = std::make_shared<const Piece>(std::move(piece));
  }
  const auto done = [&](const char* line) { return apply(full, *parseOperation(line), room.context); };
  const auto one = done("duplicate piece=a");
  ASSERT_FALSE(one);
  EXPECT_THAT(text(one.error().what), testing::HasSubstr("no more than 1000 pieces, and this would make 1001"));
  EXPECT_TRUE(done("remove piece=a2")) << "what makes none is not refused";
}

INSTANTIATE_TEST_SUITE_P(Folders, EachOperation, ::testing::ValuesIn(folders()), [](const auto& p) { return p.param; });

}  // namespace
}  // namespace karinui

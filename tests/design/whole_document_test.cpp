// Whole documents: as text and back, and given away without the person they were made for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include "design/workroom.h"
#include "karinui/base/base64.h"
#include "karinui/design/dump.h"
#include "karinui/design/print_image.h"
#include "karinui/design/share.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Base64, IsThatOfTheStandardAndItsInverse) {
  // RFC 4648, section 10.
  for (const auto& [bytes, letters] : {std::pair{"", ""},
                                       {"f", "Zg=="},
                                       {"fo", "Zm8="},
                                       {"foo", "Zm9v"},
                                       {"foob", "Zm9vYg=="},
                                       {"fooba", "Zm9vYmE="},
                                       {"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(base64(bytes), letters);
    EXPECT_EQ(fromBase64(letters), bytes);
  }
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  EXPECT_EQ(fromBase64(base64(all)), all);
  for (const char* wrong : {"Zg", "Zg=", "Zh==", "Zm9=", "Z===", "====", "Zm 8", "Zm9v=", "Zm9\xff"})
    EXPECT_FALSE(fromBase64(wrong)) << wrong;
}

class WholeDocument : public ::testing::Test {
 protected:
  WholeDocument() {
    std::string name = (fs::temp_directory_path() / "karinui-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    path_ = folder_ / "coat.karinui";
  }
  ~WholeDocument() override { fs::remove_all(folder_); }

  // A garment with a figure of its own, a photograph, formulas, sizes, finishing, two branches and undone steps.
  void make() {
    auto file = DocumentFile::create(path_);
    ASSERT_TRUE(file);
    Body::Parts figure = egg();
    figure.name = kPerson;
    figure.measured.value["bust_girth"] = kBust;
    photo_ = *file->blobs().put(packPrint({2, 1, {255, 0, 0, 0, 0, 255}}));
    oldPhoto_ = *file->blobs().put(packPrint({1, 1, {7, 8, 9}}));
    figure_ = packBody(figure);
    const std::string mesh = *file->blobs().put(figure_);
    Context own{room_.workers, room_.token, file->blobs(), room_.bodies, room_.context.drape, room_.context.pull};
    const auto play = [&](const std::string& line) {
      const auto operation = parseOperation(line);
      ASSERT_TRUE(operation) << line << ": " << text(operation.error().what);
      const auto step = file->perform(*operation, own);
      ASSERT_TRUE(step) << line << ": " << text(step.error().what);
    };
    play("body mesh=" + mesh);
    play("set spacing=20mm");
    play("variable name=cuff value=\"91.37cm/4\"");
    play("fabric name=my_wool like=cotton weight=0.321");
    std::istringstream lines{std::string(kTwoPieces)};
    for (std::string line; std::getline(lines, line);) play(line);
    play("sew a=front.side_left b=back.side_left");
    play("ease seam=s7 by=1cm");
    play("look piece=front photo=" + oldPhoto_ + " repeat=20cm");
    play("look piece=front photo=" + photo_ + " repeat=20cm");
    play("look fabric=my_wool colour=0a141e");
    play("fabric name=my_wool piece=front");
    play("hem edges=front.hem width=4cm under=1cm");
    play("allowance edges=back.neck width=8mm start=points");
    play("elastic edges=back.neck ratio=0.7 strength=12");
    play("fasten name=opening kind=zip a=front.side_right b=back.side_right length=10cm closed_length=6cm");
    play("fasten name=loops kind=hook a=front.neck@0.2:0.8 b=back.neck@0.2:0.8 count=3 first=1cm last=2cm closed=2");
    play("quantity piece=back count=2 pairs=yes");
    play("grade sizes=\"S M L\" base=M");
    play("grade corners=front.hem by=5mm,0");
    play("size name=L");
    play("line piece=front along=\"10cm,10cm; 20cm,10cm\" name=turn");
    play("notch edge=front.side_left at=0.4");
    play("pin piece=front at=20cm,30cm");
    play("drape");
    ASSERT_TRUE(file->undo(own));
    play("move piece=front by=0.1,0,0");
    play("drape");
    play("quantity piece=front count=3");
    ASSERT_TRUE(file->undo(own));
  }

  static constexpr const char* kPerson = "Hanako_Yamada_scan";
  static constexpr double kBust = 0.91370912;
  fs::path folder_, path_;
  std::string photo_, oldPhoto_, figure_;
  Workroom room_;
};

TEST_F(WholeDocument, IsTheSameAsTextAndBack) {
  make();
  const auto dump = dumped(path_);
  ASSERT_TRUE(dump) << text(dump.error().what);
  const fs::path again = folder_ / "again.karinui";
  const Done done = loadDump(*dump, again);
  ASSERT_TRUE(done) << text(done.error().what);
  EXPECT_EQ(*dumped(again), *dump);
  const auto before = DocumentFile::openForReading(path_), now = DocumentFile::openForReading(again);
  ASSERT_TRUE(before && now) << text(now.error().what);
  EXPECT_THAT(now->remarks(), IsEmpty());
  EXPECT_EQ(hash(now->document()), hash(before->document()));
  EXPECT_EQ(drapeHash(now->document()), drapeHash(before->document()));
  const auto same = [](const std::vector<Step>& a, const std::vector<Step>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Step& x, const Step& y) {
      return x.seq == y.seq && x.parent == y.parent && x.serial == y.serial && x.operation == y.operation &&
             x.chain == y.chain && x.before == y.before && x.after == y.after && x.stand == y.stand;
    });
  };
  EXPECT_TRUE(same(now->steps(), before->steps()));
  EXPECT_TRUE(same(now->undone(), before->undone()));
  EXPECT_TRUE(same(now->otherBranches(), before->otherBranches()));
  EXPECT_EQ(before->otherBranches().size(), 1u);
  EXPECT_EQ(before->undone().size(), 1u);
}

TEST_F(WholeDocument, ADumpThatWasChangedIsRefusedOrTold) {
  make();
  const std::string dump = *dumped(path_);
  const auto wrong = [&](std::string changed, const std::string& from, const std::string& to, const char* says) {
    const std::size_t at = changed.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    const fs::path out = folder_ / "out.karinui";
    const Done done = loadDump(changed, out);
    ASSERT_FALSE(done) << from;
    EXPECT_THAT(text(done.error().what), HasSubstr(says)) << from;
    EXPECT_FALSE(fs::exists(out));
  };
  wrong(dump, "karinui dump 1", "karinui dump 2", "not a dump");
  wrong(dump, "step 3 2 ", "step 3 9 ", "does not follow");
  wrong(dump, "\nset spacing=20mm", "\nknit spacing=20mm", "Line ");
  wrong(dump, "\nend\n", "\n", "breaks off");
  wrong(dump, "\nend\n", "\nend\nmore\n", "goes on after its end");
  wrong(dump, "\nhead ", "\nfoot ", "cannot be understood");
  const std::size_t letters = dump.find('\n', dump.find("\nblob ") + 1) + 1;
  std::string damaged = dump;
  damaged[letters] = damaged[letters] == 'A' ? 'B' : 'A';
  wrong(damaged, "head", "head", "is damaged");
  wrong(dump.substr(0, letters + 10), "head", "head", "");
  // An operation that was edited by hand is followed, and told.
  std::string edited = dump;
  edited.replace(edited.find("spacing=20mm"), 12, "spacing=25mm");
  ASSERT_TRUE(loadDump(edited, folder_ / "edited.karinui"));
  const auto file = DocumentFile::openForReading(folder_ / "edited.karinui", &room_.context);
  ASSERT_TRUE(file) << text(file.error().what);
}

TEST_F(WholeDocument, AnyDumpIsRefusedInASentenceOrLoaded) {
  make();
  const std::string dump = *dumped(path_);
  std::mt19937_64 dice(911);
  std::size_t loaded = 0;
  for (int seed = 0; seed < soak(150); ++seed) {
    std::string bad = dump;
    for (std::size_t i = 0, n = 1 + dice() % 3; i < n; ++i) {
      const std::size_t at = dice() % (dice() % 2 ? bad.size() : std::min(bad.size(), bad.find("\nblob ")));
      switch (dice() % 4) {
        case 0:
          bad[at] = static_cast<char>(dice());
          break;
        case 1:
          bad.erase(at, 1 + dice() % 200);
          break;
        case 2:  // one digit for another
          if (std::isdigit(static_cast<unsigned char>(bad[at]))) bad[at] = static_cast<char>('0' + dice() % 10);
          break;
        default:
          bad.insert(at, bad.substr(dice() % bad.size(), dice() % 100));
          break;
      }
    }
    const fs::path out = folder_ / "out.karinui";
    if (const Done done = loadDump(bad, out); !done) {
      EXPECT_FALSE(text(done.error().what).empty()) << seed;
      EXPECT_FALSE(fs::exists(out)) << seed;
      continue;
    }
    const auto file = DocumentFile::openForReading(out, &room_.context);
    EXPECT_TRUE(file || !text(file.error().what).empty()) << seed;
    fs::remove(out);
    ++loaded;
  }
  EXPECT_GT(loaded, 0u);
}

TEST_F(WholeDocument, SharedItHasThePatternAndNothingOfThePerson) {
  make();
  const fs::path to = folder_ / "for_others.karinui";
  Document before;
  {
    auto file = DocumentFile::openForReading(path_);
    ASSERT_TRUE(file);
    before = file->document();
    EXPECT_FALSE(share(*file, path_, room_.context)) << "not over itself";
    const auto shared = share(*file, to, room_.context);
    ASSERT_TRUE(shared) << text(shared.error().what);
    EXPECT_THAT(shared->notes, IsEmpty());
    for (const char* name : {"front", "back", "my_wool", "loops", "opening", "S", "M", "L", "turn", "side_left", "hem"})
      EXPECT_THAT(shared->names, testing::Contains(name));
  }
  // What a person wants to have of it.
  auto file = DocumentFile::open(to);
  ASSERT_TRUE(file) << text(file.error().what);
  const Document& now = file->document();
  ASSERT_EQ(now.pattern.pieces.size(), 2u);
  for (const auto& [id, piece] : before.pattern.pieces) {
    const Piece& made = *now.pieceNamed(piece->name);
    EXPECT_EQ(made.outline, piece->outline);
    EXPECT_EQ(made.lines, piece->lines);
    EXPECT_EQ(made.marks, piece->marks);
    EXPECT_EQ(made.fabric, piece->fabric);
    EXPECT_EQ(made.form, nullptr);
  }
  ASSERT_EQ(now.pattern.seams.size(), 1u);
  EXPECT_EQ(now.eases.begin()->second, before.eases.begin()->second);
  EXPECT_EQ(now.fabrics, before.fabrics);
  EXPECT_EQ(now.looks.fabrics, before.looks.fabrics);
  EXPECT_EQ(now.looks.pieces.begin()->second, before.looks.pieces.begin()->second);
  EXPECT_EQ(now.settings, before.settings);
  EXPECT_EQ(now.cutting.begin()->second, before.cutting.begin()->second);
  const auto values = [](const auto& map) {
    std::vector<std::pair<std::string, typename std::decay_t<decltype(map)>::mapped_type>> all;
    for (const auto& [at, value] : map) all.emplace_back(at.second, value);
    return all;
  };
  EXPECT_EQ(values(now.allowances.edges), values(before.allowances.edges));
  EXPECT_EQ(values(now.allowances.corners), values(before.allowances.corners));
  EXPECT_EQ(values(now.allowances.elastics), values(before.allowances.elastics));
  EXPECT_EQ(values(now.allowances.hems), values(before.allowances.hems));
  ASSERT_EQ(now.allowances.fastenings.size(), 2u);
  for (const auto& [name, own] : before.allowances.fastenings) {
    const Fastening& made = now.allowances.fastenings.at(name);
    EXPECT_EQ(std::tie(made.kind, made.reversed, made.fromStart, made.closed),
              std::tie(own.kind, own.reversed, own.fromStart, own.closed));
    EXPECT_NEAR(made.zipped, own.zipped, 1e-9);
    for (std::size_t k = 0; k < own.at.size(); ++k) EXPECT_NEAR(made.at.at(k), own.at[k], 1e-9);
  }
  EXPECT_EQ(now.grading.sizes, before.grading.sizes);
  EXPECT_EQ(now.grading.standing, before.grading.standing);
  const Piece &old = *before.pieceNamed("front"), &made = *now.pieceNamed("front");
  for (std::size_t size = 0; size < 3; ++size) {
    const auto was = inSize(old, before.grading, size), is = inSize(made, now.grading, size);
    ASSERT_TRUE(was && is);
    for (std::size_t i = 0; i < was->outline.edges.size(); ++i)
      EXPECT_LT(distance(was->outline.edges[i].curve.start, is->outline.edges[i].curve.start), 1e-9) << size;
  }
  EXPECT_TRUE(file->blobs().get(photo_));
  // What nobody else is to have: in no byte of the file.
  const std::string bytes = contents(to), whole = contents(path_);
  const auto has = [](const std::string& all, const std::string& part) { return all.find(part) != std::string::npos; };
  const auto number = [](double value) {
    std::string part(sizeof value, '\0');
    std::memcpy(part.data(), &value, sizeof value);
    return part;
  };
  std::vector<std::string> secrets = {kPerson,     number(kBust),    "91.37",
                                      "cuff",      "variable ",      oldPhoto_,
                                      "body mesh", folder_.string(), packPrint({1, 1, {7, 8, 9}})};
  for (const Vec3 p : egg().mesh.points)
    if (p.x != 0) secrets.push_back(number(p.x) + number(p.y) + number(p.z));
  for (const auto& [id, piece] : before.pattern.pieces) {
    ASSERT_TRUE(piece->form);
    for (const Vec3 p : piece->form->space) secrets.push_back(number(p.x) + number(p.y) + number(p.z));
  }
  std::size_t known = 0;
  for (const std::string& secret : secrets) {
    EXPECT_FALSE(has(bytes, secret)) << testing::PrintToString(secret);
    known += has(whole, secret);
  }
  EXPECT_GT(known, secrets.size() / 2) << "the search finds them where they are";
  char host[256] = {};
  ASSERT_EQ(gethostname(host, sizeof host - 1), 0);
  EXPECT_FALSE(has(bytes, host));
}

// Somebody's name in every name: none of them is in a byte of it, and the pattern is the same.
TEST_F(WholeDocument, UnnamedItHasNoNameThatAPersonGave) {
  Document before;
  {
    auto file = DocumentFile::create(path_);
    ASSERT_TRUE(file);
    for (const char* line :
         {"fabric name=Hanako_wool like=linen weight=0.321",
          "piece name=Hanako_front outline=\"M 0 0; hem_Hanako L 400 0; side_Hanako L 400 500; neckHanako C 300 450 "
          "100 450 "
          "0 500; rightHanako L 0 0\" fabric=Hanako_wool",
          "piece name=Hanako_back outline=\"M 0 0; hem_Hanako L 400 0; right_Hanako L 400 500; topHanako L 0 500; "
          "side_Hanako L 0 0\" fabric=denim",
          "sew a=Hanako_front.side_Hanako b=Hanako_back.side_Hanako name=Hanako_seam",
          "hem edges=Hanako_front.hem_Hanako width=4cm under=1cm", "allowance edges=Hanako_back.topHanako width=8mm",
          "piping edges=Hanako_back.topHanako fabric=Hanako_wool",
          "fasten name=Hanako_opening kind=zip a=Hanako_front.rightHanako b=Hanako_back.right_Hanako length=10cm",
          "grade sizes=\"Hanako Hanakos_sister\" base=Hanako", "grade corners=Hanako_front.hem_Hanako by=5mm,0",
          "line piece=Hanako_front along=\"10cm,10cm; 20cm,10cm\" name=Hanako_line",
          "notch edge=Hanako_front.side_Hanako at=0.4 name=Hanako_notch"}) {
      const auto operation = parseOperation(line);
      ASSERT_TRUE(operation) << line << ": " << text(operation.error().what);
      const auto step = file->perform(*operation, room_.context);
      ASSERT_TRUE(step) << line << ": " << text(step.error().what);
    }
    before = file->document();
    const auto shared = share(*file, folder_ / "unnamed.karinui", room_.context, SharedNames::Neutral);
    ASSERT_TRUE(shared) << text(shared.error().what);
    EXPECT_THAT(shared->names, IsEmpty());
    EXPECT_THAT(shared->notes, IsEmpty());
    EXPECT_THAT(text(sharedSaid(*shared)), HasSubstr("all names are neutral"));
    const auto named = share(*file, folder_ / "named.karinui", room_.context);
    ASSERT_TRUE(named);
    EXPECT_THAT(named->names, testing::IsSupersetOf({"Hanako_front", "Hanako_seam", "Hanako_wool", "Hanako_opening",
                                                     "Hanakos_sister", "Hanako_line", "Hanako_notch", "topHanako"}));
  }
  EXPECT_THAT(contents(path_), HasSubstr("Hanako"));
  EXPECT_THAT(contents(folder_ / "named.karinui"), HasSubstr("Hanako_notch"));
  EXPECT_EQ(contents(folder_ / "unnamed.karinui").find("Hanako"), std::string::npos);
  const auto file = DocumentFile::openForReading(folder_ / "unnamed.karinui");
  ASSERT_TRUE(file) << text(file.error().what);
  const Document& now = file->document();
  const AllowancePlan old(before.pattern, before.allowances), made(now.pattern, now.allowances);
  ASSERT_EQ(now.pattern.pieces.size(), 2u);
  auto next = now.pattern.pieces.begin();
  for (const auto& [id, piece] : before.pattern.pieces) {
    for (std::size_t i = 0; i < piece->outline.edges.size(); ++i) {
      const Edge &was = piece->outline.edges[i], &is = next->second->outline.edges.at(i);
      EXPECT_EQ(is.curve, was.curve) << was.name;
      EXPECT_EQ(made.kind(next->first, is.name), old.kind(id, was.name)) << was.name;
      EXPECT_EQ(made.width(next->first, is.name), old.width(id, was.name)) << was.name;
    }
    ++next;
  }
  const Piece& front = *now.pieceNamed("piece1");
  EXPECT_EQ(front.fabric, "fabric1");
  EXPECT_EQ(now.pieceNamed("piece2")->fabric, "denim") << "comes with the program";
  Fabric wool = before.fabrics.at("Hanako_wool");
  wool.name = "fabric1";
  EXPECT_EQ(now.fabrics.at("fabric1"), wool);
  EXPECT_EQ(lookOf(now, "fabric1"), lookOf(before, "Hanako_wool"));
  EXPECT_EQ(front.marks.at(0).edge, front.outline.edges[1].name);
  EXPECT_EQ(front.outline.edges[1].name, now.pieceNamed("piece2")->outline.edges[3].name) << "called alike before";
  EXPECT_EQ(now.grading.sizes, (std::vector<std::string>{"size1", "size2"}));
  EXPECT_EQ(now.grading.pieces.begin()->second.size(), before.grading.pieces.begin()->second.size());
  EXPECT_EQ(now.allowances.fastenings.size(), 1u);
  EXPECT_EQ(now.allowances.hems.size(), 1u);
  EXPECT_EQ(now.allowances.pipings.begin()->second.fabric, "fabric1");
}

TEST_F(WholeDocument, SharedIntoAFolderThatIsMissingTheFileThatWasAskedForIsNamed) {
  make();
  auto file = DocumentFile::openForReading(path_);
  ASSERT_TRUE(file);
  const auto shared = share(*file, folder_ / "none" / "out.karinui", room_.context);
  ASSERT_FALSE(shared);
  EXPECT_THAT(text(shared.error().what), HasSubstr("out.karinui"));
  EXPECT_THAT(text(shared.error().what), Not(HasSubstr(".part")));
}

}  // namespace
}  // namespace karinui

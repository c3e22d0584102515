// The examples of the guide, as they are written there: each is done, line by line, and the Japanese page has the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "design/quick_folder.h"
#include "design/workroom.h"

namespace karinui {
namespace {

using Lines = std::vector<std::string>;

// Lines that are set in by four blanks, or stand between lines of ```, are examples; a page has several, with prose
// between.
std::vector<Lines> examplesOf(const std::string& page) {
  std::ifstream file(std::string(KARINUI_SOURCE_DIR) + "/docs/" + page);
  EXPECT_TRUE(file) << page;
  std::vector<Lines> all;
  bool within = false, fenced = false;
  for (std::string line; std::getline(file, line);) {
    const bool fence = line.starts_with("```");
    if (fence) fenced = !fenced;
    const bool in = line.starts_with("    ") && line.find_first_not_of(' ') != std::string::npos;
    const bool set = !fence && (fenced || in);
    if (set && !within) all.emplace_back();
    if (set) all.back().push_back(line.substr(in ? 4 : 0));
    within = set;
  }
  return all;
}

const std::string kTop =
    "body size=jis9ar\nset spacing=30mm ease=12mm\n"
    "draw name=front symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" line=\"torso:shoulder+0.5@0; "
    "torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; landmark:shoulder_left; torso:armpit+0.5@0.16; "
    "torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0\"\n"
    "draw name=back symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" line=\"torso:neck_base@0.5; "
    "torso:neck_base+0.05@0.42; torso:neck_base+0.2@0.25; landmark:shoulder_left; torso:armpit+0.5@0.34; "
    "torso:armpit@0.31; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0.5\"\n"
    "sew a=front.shoulder_left b=back.shoulder_left mirror=yes\n"
    "sew a=front.side_left b=back.side_left mirror=yes\n";
constexpr const char* kFigure = "body size=eu38\n";
constexpr const char* kShirt = "body size=eu38\nblock kind=shirt\n";
constexpr const char* kSkirtBlock = "body size=eu38\nblock kind=skirt\n";
const std::string kPieces =
    "rectangle name=skirt width=90cm height=60cm edges=\"hem side_left waist side_right\"\n"
    "polygon name=sleeve points=\"-16cm,0; 16cm,0; 19cm,20cm; 0,33cm; -19cm,20cm\" "
    "edges=\"hem under_front cap ~ under_back\"\n";

// Where an example is done: on the garment of the first row whose words it has; else on the top of the page.
const std::vector<std::pair<std::string, std::string>>& garments() {
  static const std::vector<std::pair<std::string, std::string>> all{
      {"draw name=front", kFigure},
      {"sew a=front.shoulder_left b=back.shoulder_left", kTop + "unsew seam=s5\nunsew seam=s5.2\n"},
      {"match seam=side_left", std::string(kShirt) + "look fabric=cotton print=check ink=ffffff repeat=3cm\n"},
      {"band name=cuff of=sleeve.hem", kTop + kPieces + "mirror piece=sleeve name=sleeve_right\n"},
      {"allowance edges=sleeve.hem", kTop + kPieces},
      {"elastic edges=\"front.waist back.waist\"",
       "rectangle name=front width=50cm height=60cm edges=\"hem side_left waist side_right\"\n"
       "rectangle name=back width=50cm height=60cm edges=\"hem side_left waist side_right\"\n"
       "rectangle name=sleeve width=40cm height=50cm edges=\"wrist side_left top side_right\"\n"},
      {"line piece=dress", "polygon name=dress points=\"-30cm,0; 30cm,0; 25cm,110cm; -25cm,110cm\"\n"},
      {"elastic edges=\"front.top back.top\"",
       "rectangle name=front width=50cm height=60cm\nrectangle name=back width=50cm height=60cm\n"},
      {"fold piece=cuff",
       "polygon name=cuff points=\"0,0; 24cm,0; 24cm,10cm; 0,10cm\"\n"
       "polygon name=sleeve points=\"-12cm,0; 12cm,0; 20cm,45cm; -20cm,45cm\"\n"
       "line piece=sleeve along=\"-13.2cm,7cm; 13.2cm,7cm\" name=turn_back\n"},
      {"topstitch edges=trousers_front.fly_line",
       kTop + "rectangle name=trousers_front width=30cm height=100cm\n"
              "line piece=trousers_front along=\"-5cm,30cm; -5cm,45cm\" name=fly_line\n"},
      {"fasten kind=hook a=band.end_left",
       std::string(kShirt) + "unsew seam=opening\nunsew seam=collar\nrectangle name=band width=70cm height=4cm "
                             "edges=\"low end_left top end_right\"\n"},
      {"last=8cm stand=15mm", kShirt},
      {"fasten kind=zip a=skirt_front.side_left", kSkirtBlock},
      {"fasten name=buttons closed=4",
       std::string(kShirt) + "unsew seam=opening\nfasten a=front_right.centre b=front_left.centre count=6\n"
                             "rectangle name=one width=20cm height=30cm\nrectangle name=two width=20cm height=30cm\n"
                             "fasten kind=zip a=one.side_left b=two.side_right length=20cm\n"},
      {"pleat edge=skirt.waist count=6", kPieces},
      {"pleat edge=skirt.waist to=skirt.hem", kPieces},
      {"pleat edge=kilt.waist", "rectangle name=kilt width=60cm height=50cm edges=\"hem left waist right\"\n"},
      {"pleat edge=front.top", "body size=eu38\nrectangle name=front width=\"waist_girth/2 + 15mm\" height=54cm\n"},
      {"pleat lines=",
       "rectangle name=skirt width=60cm height=50cm\nline piece=skirt along=\"20cm,0; 20cm,50cm\" name=fold\n"
       "line piece=skirt along=\"22cm,0; 22cm,50cm\" name=inner\n"
       "line piece=skirt along=\"24cm,0; 24cm,50cm\" name=place\n"},
      {"patch piece=pocket", kPieces},
      {"sew a=strap.low", kPieces + "rectangle name=strap width=8cm height=30cm edges=\"low left high right\"\n"},
      {"strap name=strap_left",
       "body size=eu38\nrectangle name=front width=44cm height=40cm\nrectangle name=back width=44cm height=40cm\n"
       "place piece=front at=torso:armpit@0 point=\"0,38cm\"\nplace piece=back at=torso:armpit@0.5 point=\"0,38cm\"\n"
       "sew a=front.side_left b=back.side_right\nsew a=front.side_right b=back.side_left\n"},
      {"pivot dart=front.dart", "body size=eu38\nblock kind=bodice\n"},
      {"shift_dart dart=skirt_front", kSkirtBlock},
      {"lengthen edges=", kShirt},
      {"cut piece=skirt_front", kSkirtBlock},
      {"spread from=skirt.hem", kTop + kPieces},
      {"fair edges=\"sleeve.cap_back",
       "polygon name=sleeve points=\"-16cm,0; 16cm,0; 19cm,40cm; 0,54cm; -19cm,40cm\" "
       "edges=\"hem under_front cap_front cap_back under_back\"\n"},
      {"interface piece=\"collar stand",
       std::string(kShirt) + "rectangle name=stand width=40cm height=3cm\nrectangle name=cuff_left width=24cm "
                             "height=6cm\nrectangle name=cuff_right width=24cm height=6cm\n"
                             "rectangle name=waistband width=70cm height=4cm\n"},
      {"ease seam=armhole_left", std::string(kShirt) + "rectangle name=pocket width=14cm height=16cm\n"},
      {"trueup seam=underarm_left", kShirt},
      {"length edge=sleeve.cap", kTop + kPieces},
      {"block kind=shirt", ""},
      {"block kind=bodice", ""},
      {"fly a=leg_front_left", std::string(kFigure) + "block kind=trousers\n"},
      {"pocket edge=skirt_front", kSkirtBlock},
      {"pocket kind=slant", std::string(kFigure) + "block kind=trousers\n"},
      {"welt piece=leg_back_left", std::string(kFigure) + "block kind=trousers\n"},
      {"welt piece=front_left", std::string(kFigure) + "block kind=shirt\n"},
      {"band name=belt", kSkirtBlock},
      {"ring name=cape_left", kFigure},
      {"duplicate piece=front name=back by=0,0,-40cm", ""},
      {"piece name=front outline", ""},
  };
  return all;
}

std::string garmentFor(const Lines& example) {
  for (const auto& [words, made] : garments())
    for (const std::string& line : example)
      if (line.find(words) != std::string::npos) return made;
  return kTop;
}

class GuideExamples : public testing::TestWithParam<const char*> {};

TEST_P(GuideExamples, AreDoneAsTheyAreWritten) {
  std::size_t done = 0;
  for (const Lines& example : examplesOf(GetParam())) {
    if (example.front().starts_with("karinui")) continue;  // commands, and what needs a photograph
    std::string script;
    for (const std::string& line : example) script += line + "\n";
    const auto lines = parseScript(script);
    ASSERT_TRUE(lines) << script << text(lines.error().what);
    static Workroom room;  // figures are built once
    DocumentFile file = DocumentFile::inMemory();
    const Done made = room.play(file, garmentFor(example));
    ASSERT_TRUE(made) << example.front() << "\n" << text(made.error().what);
    for (const ScriptLine& line : *lines) {
      const auto step = file.perform(line.operation, room.context);
      EXPECT_TRUE(step) << text(line.operation) << "\n" << (step ? "" : text(step.error().what));
      ++done;
    }
  }
  EXPECT_GT(done, 0u);
}

INSTANTIATE_TEST_SUITE_P(Pages, GuideExamples,
                         testing::Values("user/operations.md", "user/blocks.md", "format/operations.md"));

// What the page of the file says of its first bytes (SQLite's: the application at 68, the form at 60).
TEST(GuideExamples, AFileBeginsAsItsPageSays) {
  const auto folder = quickFolder();
  ASSERT_TRUE(DocumentFile::create(folder / "a.karinui"));
  std::ifstream file(folder / "a.karinui", std::ios::binary);
  std::string bytes(100, '\0');
  ASSERT_TRUE(file.read(bytes.data(), 100));
  std::filesystem::remove_all(folder);
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = at; k < at + 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
    return std::to_string(value);
  };
  std::ifstream page(std::string(KARINUI_SOURCE_DIR) + "/docs/format/karinui-file.md");
  const std::string told{std::istreambuf_iterator<char>(page), {}};
  EXPECT_THAT(told,
              testing::HasSubstr("`PRAGMA application_id` is " + number(68) + " (`" + bytes.substr(68, 4) + "`)"));
  EXPECT_THAT(told, testing::HasSubstr("the form of the file, now **" + number(60) + "**"));
}

// Without what is said beside a command, which each page says in its language.
Lines plain(Lines lines) {
  for (std::string& line : lines) {
    line.erase(std::min(line.find(" # "), line.size()));
    line.erase(line.find_last_not_of(' ') + 1);
  }
  return lines;
}

TEST(GuideExamples, AreTheSameInJapanese) {
  for (const std::string page :
       {"../README", "user/first_garment", "user/operations", "user/blocks", "user/body", "user/poses", "user/batch",
        "user/documents", "user/python", "user/blender", "user/room", "user/touch"}) {
    const auto english = examplesOf(page + ".md"), japanese = examplesOf(page + ".ja.md");
    ASSERT_EQ(japanese.size(), english.size()) << page;
    for (std::size_t k = 0; k < english.size(); ++k) EXPECT_EQ(plain(japanese[k]), plain(english[k])) << page;
  }
}

}  // namespace
}  // namespace karinui

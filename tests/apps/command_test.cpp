// The command line as people and other programs meet it: verbs, JSON keys, exit statuses, and that a refused command
// leaves nothing behind.
#include "apps/command.h"

#include <gmock/gmock.h>

#include "karinui/base/version.h"

namespace karinui::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

// A sleeveless tunic drawn on a small size, coarsely laid: quick to settle.
const char* const kTunic =
    "body size=jis9ar\n"
    "set spacing=30mm\n"
    "draw name=front symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" line=\"torso:shoulder+0.5@0; "
    "torso:shoulder+0.8@0.08; torso:neck_base+0.2@0.25; landmark:shoulder_left; torso:armpit+0.5@0.16; "
    "torso:armpit@0.19; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0\"\n"
    "draw name=back symmetric=yes edges=\"neck ~ shoulder armhole ~ ~ side ~ hem\" line=\"torso:neck_base@0.5; "
    "torso:neck_base+0.05@0.42; torso:neck_base+0.2@0.25; landmark:shoulder_left; torso:armpit+0.5@0.34; "
    "torso:armpit@0.31; torso:armpit-0.3@0.25; torso:waist@0.25; torso:hip@0.25; torso:hip@0.5\"\n"
    "sew a=front.shoulder_left b=back.shoulder_left\n"
    "sew a=front.shoulder_right b=back.shoulder_right\n"
    "sew a=front.side_left b=back.side_left\n"
    "sew a=front.side_right b=back.side_right\n";

class Command : public testing::Test {
 protected:
  Folder folder;
  std::string script(const std::string& text) {
    write(folder / "script.ops", text);
    return folder / "script.ops";
  }
  std::string document() { return folder / "d.karinui"; }
  Said play(const std::string& text) { return karinui("play " + script(text) + " -o " + document() + " --json"); }
  // The tunic played, once for all tests, as this test's document.
  void haveTunic() {
    static Folder kept;
    if (!fs::exists(kept / "d.karinui")) {
      const Said said = play(kTunic);
      ASSERT_EQ(said.exit, 0);
      EXPECT_NE(said.err.find("Cloth cannot lie as drawn"), std::string::npos) << "advice on the drawing: " << said.err;
      EXPECT_NE(said.err.find("Mended by: "), std::string::npos) << said.err;
      fs::rename(document(), kept / "d.karinui");
    }
    fs::copy(kept / "d.karinui", document());
  }
};

TEST_F(Command, HelpIsAskedForByAVerbToo) {
  EXPECT_EQ(karinui("help undo").out, karinui("undo --help").out);
  EXPECT_EQ(karinui("help").out, karinui("--help").out);
  const Said unknown = karinui("help nonsense");
  EXPECT_EQ(unknown.exit, 2);
  EXPECT_THAT(unknown.err, HasSubstr("has no command “nonsense”"));
}

// Ctrl-C keeps what a script came to: the drape as far as it got, and nothing that follows.
TEST_F(Command, APlayThatIsStoppedInADrapeKeepsIt) {
  std::string fine(kTunic);
  fine.replace(fine.find("30mm"), 4, "6mm");
  const std::string path = script(fine + "drape\nrename piece=front to=later\n"), err = folder / "err";
  const std::string line = std::string(KARINUI_COMMAND) + " play " + path + " -o " + document() + " >/dev/null 2>" +
                           err + " & until grep -qs Draping " + err +
                           " || ! kill -0 $!; do sleep 0.05; done; kill -INT $!; wait $!";
  const int status = std::system(("bash -c '" + line + "'").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 4) << contents(err);
  EXPECT_THAT(contents(err), HasSubstr("Stopped in line 9; the garment is kept as it is there."));
  const std::string log = karinui("log " + document()).out;
  EXPECT_THAT(log, HasSubstr("drape"));
  EXPECT_THAT(log, HasSubstr("stop="));
  EXPECT_THAT(log, testing::Not(HasSubstr("later")));
}

// A script may come from anyone.
TEST_F(Command, AScriptNamesPicturesInTheFolderAndNoOtherFile) {
  for (const char* name : {"../outside", "/tmp/karinui_outside", ".hidden", "sub/outside"}) {
    const Said said = karinui("play " + script(std::string("set spacing=20mm\n# picture: ") + name + " view=front\n") +
                              " -o " + (folder / "drawn.karinui") + " --pictures " + (folder / "pictures"));
    EXPECT_EQ(said.exit, 3) << name;
    EXPECT_NE(said.err.find("is no name of a picture"), std::string::npos) << said.err;
  }
  EXPECT_FALSE(fs::exists(folder / "outside.png"));
  EXPECT_FALSE(fs::exists("/tmp/karinui_outside.png"));
}

TEST_F(Command, SaysWhichVersionItIs) {
  EXPECT_EQ(karinui("--version").out, "karinui " + std::string(version()) + "\n");
}

TEST_F(Command, TeachesWhenAskedAndRefusesWrongCalls) {
  const Said help = karinui("--help");
  EXPECT_EQ(help.exit, 0);
  for (const char* verb : {"body", "play", "do", "undo", "redo", "amend", "log", "import", "settle", "check", "info",
                           "export", "picture", "bench"}) {
    EXPECT_NE(help.out.find(verb), std::string::npos) << verb;
  }
  EXPECT_EQ(karinui("").exit, 2);
  EXPECT_EQ(karinui("iron my.shirt").exit, 2);
  EXPECT_EQ(karinui("settle").exit, 2);
  EXPECT_EQ(karinui("do --help").exit, 0);
  EXPECT_NE(karinui("do --help").out.find("reshape"), std::string::npos);
  EXPECT_NE(karinui("do --help cut").out.find("the piece to cut"), std::string::npos);
  EXPECT_NE(karinui("do --help cut", "ja_JP.UTF-8").out.find("切るパーツ"), std::string::npos);
}

TEST_F(Command, ExplainsAWrongCallInBothLanguages) {
  struct Wrong {
    const char *words, *english, *japanese;
  };
  for (const auto& [words, english, japanese] : {
           Wrong{"", "what “karinui” should do", "何をさせるか"},
           Wrong{"iron my.shirt", "has no command “iron”", "「iron」というコマンドはありません"},
           Wrong{"body knit", "“karinui body” has no command “knit”", "「knit」というコマンドはありません"},
           Wrong{"settle", "“karinui settle” needs document: The .karinui document", "document が必要です"},
           Wrong{"export a.karinui", "“karinui export” needs --output", "--output が必要です"},
           Wrong{"export a.karinui -o", "--output needs a value", "--output には値が必要です"},
           Wrong{"export a.karinui -o b.pdf --page b4", "cannot be “b4”", "「b4」は使えません"},
           Wrong{"settle a.karinui --threads many", "--threads cannot be “many”: How many threads work, 1 to 256",
                 "--threads に「many」は使えません"},
           Wrong{"settle a.karinui --thraeds 2", "“karinui settle” has no option “--thraeds”",
                 "「--thraeds」というオプションはありません"},
           Wrong{"undo a.karinui b.karinui", "“b.karinui” is one word too many", "「b.karinui」が余分です"},
       }) {
    const Said said = karinui(words), inJapanese = karinui(words, "ja_JP.UTF-8");
    EXPECT_EQ(said.exit, 2) << words;
    EXPECT_NE(said.err.find(english), std::string::npos) << words << "\n" << said.err;
    EXPECT_NE(said.err.find("--help"), std::string::npos) << words;
    EXPECT_NE(inJapanese.err.find(japanese), std::string::npos) << words << "\n" << inJapanese.err;
    EXPECT_TRUE(said.out.empty()) << words;
  }
  EXPECT_TRUE(karinui("settle --json").json().contains("error"));
}

TEST_F(Command, TellsWherePiecesLieOnPaper) {
  ASSERT_EQ(play("piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; top C 300 510 100 510 0 500; centre L "
                 "0 0\"\nline piece=front along=\"5cm,10cm 5cm,30.5cm\" name=fold\n")
                .exit,
            0);
  const Said info = karinui("info " + document() + " --piece front");
  EXPECT_EQ(info.exit, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("40.00,0.00  →  40.00,50.00  500.0 mm"));
  EXPECT_THAT(info.out, HasSubstr("5.00,10.00  →  5.00,30.50"));
  EXPECT_THAT(info.out, HasSubstr("curved"));
  const auto json = karinui("info " + document() + " --piece p1 --json").json();
  EXPECT_EQ(json["edges"][1]["to_m"], nlohmann::json({0.4, 0.5}));
  EXPECT_EQ(json["lines"][0]["places_m"].size(), 2u);
  const Said none = karinui("info " + document() + " --piece sleeve");
  EXPECT_EQ(none.exit, 3);
  EXPECT_THAT(none.err, HasSubstr("there are: front"));
}

TEST_F(Command, ADocumentReplacesAnotherWholeAndNoFolder) {
  const std::string words = "play " +
                            script("piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; back L 0 0\"\n") +
                            " --overwrite --json -o ";
  fs::create_directory(folder / "coat.karinui");
  const Said refused = karinui(words + (folder / "coat.karinui"));
  EXPECT_EQ(refused.exit, 3);
  ASSERT_TRUE(refused.json().is_object()) << "one answer: " << refused.out;
  EXPECT_THAT(refused.json()["error"], HasSubstr("it is a folder"));
  EXPECT_FALSE(fs::exists(folder / "coat.karinui.part"));

  const std::string old = folder / "old.karinui";
  test::write(old, "what was there");
  test::write(old + "-journal", "of a program that fell down");
  EXPECT_EQ(karinui(words + old).exit, 0);
  EXPECT_FALSE(fs::exists(old + "-journal")) << "it would be taken for the new document's";
  EXPECT_EQ(karinui("log " + old).exit, 0);
}

TEST_F(Command, SaysWhereNothingIsDoneOrSeen) {
  const Said empty = play("# nothing\n");
  EXPECT_EQ(empty.exit, 0);
  EXPECT_THAT(empty.err, HasSubstr("holds no operation"));
  for (const char* how : {"", " --table", " --turns 4"}) {
    const Said picture = karinui("picture " + document() + " -o " + (folder / "p.png") + how);
    EXPECT_EQ(picture.exit, 3) << how;
    EXPECT_THAT(picture.err,
                testing::AnyOf(HasSubstr("There is nothing to see"), HasSubstr("There is no piece to draw")));
  }
  EXPECT_FALSE(fs::exists(folder / "p.png"));
}

TEST_F(Command, LengthsAreTypedWithUnitsAndReadWithoutNoise) {
  const Said metres = play("rectangle name=r width=10 height=5\n");
  EXPECT_EQ(metres.exit, 3);
  EXPECT_THAT(metres.err, HasSubstr("Line 1: “10” has no unit and would be 10 metres; write 10cm or 10mm"));
  EXPECT_FALSE(fs::exists(document()));
  EXPECT_THAT(karinui("body make --set bust_girth=88 -o " + (folder / "b.obj")).err, HasSubstr("write 88cm or 88mm"));
  EXPECT_THAT(karinui("layout " + document() + " --width 150").err, HasSubstr("write 150cm"));
  ASSERT_EQ(play("rectangle name=r width=111.99999999999999mm height=5.123456cm\n").exit, 0);
  const std::string log = karinui("log " + document()).out;
  EXPECT_THAT(log, HasSubstr("width=112mm"));
  EXPECT_THAT(log, HasSubstr("height=51.23456mm")) << "what may be played again is not rounded";
  ASSERT_EQ(karinui("export " + document() + " -o " + (folder / "steps.ops")).exit, 0);
  EXPECT_THAT(contents(folder / "steps.ops"), HasSubstr("width=111.99999999999999mm"));
  // On a screen it is.
  ASSERT_EQ(std::system(("script -qec \"'" KARINUI_COMMAND "' log " + document() + "\" /dev/null >" +
                         (folder / "screen") + " 2>&1 </dev/null")
                            .c_str()),
            0);
  EXPECT_THAT(contents(folder / "screen"), HasSubstr("height=51.23mm"));
}

// A log is read afterwards: one line for each stage, and of each it only grows.
TEST_F(Command, ProgressIsToldInFewLinesWhereNobodyWatches) {
  haveTunic();
  ASSERT_EQ(karinui("do " + document() + " 'set spacing=10mm'").exit, 0);
  const Said settled = karinui("settle " + document());
  ASSERT_EQ(settled.exit, 0) << settled.err;
  std::istringstream lines(settled.err);
  std::map<std::string, int> most;
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t percent = line.find("% ");
    if (percent == std::string::npos) continue;
    const std::string stage = line.substr(percent, line.find(", some") - percent);
    const int now = std::stoi(line.substr(0, percent));
    EXPECT_GT(now, most.contains(stage) ? most[stage] : -1) << settled.err;
    most[stage] = now, ++count;
  }
  EXPECT_LE(count, 3) << settled.err;
}

TEST_F(Command, CallsAFacingsSeamEven) {
  ASSERT_EQ(play("piece name=skirt outline=\"M 0 0; hem L 400 0; side L 400 500; waist L 0 500; other L 0 0\"\n"
                 "facing edges=skirt.waist width=4cm\n"
                 "rectangle name=sash width=30cm height=40cm\npleat edge=sash.top at=0.5 depth=2cm\n")
                .exit,
            0);
  std::istringstream lines(karinui("info " + document()).out);
  int even = 0, pleated = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("skirt_facing.waist") != std::string::npos && line.ends_with("even")) ++even;
    if (line.find("sash") != std::string::npos && line.ends_with("pleated")) ++pleated;
  }
  EXPECT_EQ(even, 1);
  EXPECT_GE(pleated, 1);
}

TEST_F(Command, AnswersInSentencesWithUnits) {
  ASSERT_EQ(play("piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; top L 0 500; centre L 0 0\"\n"
                 "piece name=back outline=\"M 0 0; hem L 400 0; side L 400 505; top L 0 505; centre L 0 0\" "
                 "pose=\"0,0,-0.1 y 180deg\"\nsew a=front.side b=back.centre name=left_side\n")
                .exit,
            0);
  const Said info = karinui("info " + document()), japanese = karinui("info " + document(), "ja_JP.UTF-8");
  for (const char* part :
       {"3 operations", "10.0 mm apart",
        "Piece front (p1): Cotton, layer 0; 2000.0 cm2, 1800.0 mm "
        "round; not draped yet",
        "  centre          500.0 mm", "left_side  front.side 500.0 mm", "back.centre 505.0 mm", "eased, 1.0 % longer"})
    EXPECT_NE(info.out.find(part), std::string::npos) << part << "\n" << info.out;
  for (const char* part : {"パーツ「前身頃 (front)」（p1）", "綿ブロード", "中心 (centre)", "2000.0 cm2", "未ドレープ",
                           "いせ込み、1.0 % 長い"})
    EXPECT_NE(japanese.out.find(part), std::string::npos) << part << "\n" << japanese.out;
  const Said check = karinui("check " + document());
  for (const char* part : {"Widest gap in a seam", " mm\n", "Stretch, at most", " %\n"})
    EXPECT_NE(check.out.find(part), std::string::npos) << part << "\n" << check.out;
  EXPECT_EQ(check.out.find('_'), std::string::npos) << "no raw keys";
}

TEST_F(Command, WearsMeasuresOfAnyFileThatHasThem) {
  std::ofstream(folder / "her.json") << R"({"chest": 900, "waist": 740, "seat": 1000, "bustSpan": 180, "hips": 950})";
  std::ofstream(folder / "flap.ops") << "piece name=flap outline=\"M 0 0; low L 400 0; side L 400 500; left L 0 0\"\n";
  const Said worn =
      karinui("play " + (folder / "flap.ops") + " --body " + (folder / "her.json") + " -o " + (folder / "a.karinui"));
  ASSERT_EQ(worn.exit, 0) << worn.err;
  EXPECT_THAT(worn.err, HasSubstr("Left out, as no mannequin can be made to it: bust_span, high_hip_girth."));
  EXPECT_THAT(karinui("log " + (folder / "a.karinui")).out, HasSubstr("hip_girth=1000mm"));
}

TEST_F(Command, TellsInItsHelpWhichFormatsShareAnEnding) {
  EXPECT_THAT(karinui("export --help").out, HasSubstr("dxf-aama or dxf-astm"));
  const Said report = karinui("report --help");
  EXPECT_THAT(report.out, HasSubstr("--no-pictures "));
  EXPECT_THAT(report.out, Not(HasSubstr("{false}")));
}

TEST_F(Command, MakesAndMeasuresABody) {
  const std::string body = folder / "b.obj";
  const Said made = karinui("body make --size jis9ar -o " + body + " --json");
  ASSERT_EQ(made.exit, 0) << made.err;
  const Said measured = karinui("body measure " + body + " --json");
  ASSERT_EQ(measured.exit, 0) << measured.err;
  const auto json = measured.json();
  EXPECT_NEAR(json["measurements"]["bust_girth"].get<double>(), 0.83, 0.003);
  EXPECT_NEAR(json["measurements"]["waist_girth"].get<double>(), 0.64, 0.003);
  EXPECT_NEAR(json["measurements"]["hip_girth"].get<double>(), 0.91, 0.003);
  EXPECT_NEAR(json["measurements"]["height"].get<double>(), 1.58, 0.005);
  for (const char* key :
       {"under_bust_girth", "neck_girth", "upper_arm_girth", "wrist_girth", "thigh_girth", "arm_length"}) {
    EXPECT_TRUE(json["measurements"].contains(key)) << key;
  }
  EXPECT_TRUE(json["closed"].get<bool>());
  EXPECT_EQ(json["self_crossings"].get<int>(), 0);
  EXPECT_GE(json["triangles"].get<int>(), 10'000);
  EXPECT_LE(json["triangles"].get<int>(), 45'000);
}

TEST_F(Command, ReadsAndWritesFilesOfMeasures) {
  const std::string her = folder / "her.vit", body = folder / "her.obj", back = folder / "back.yaml";
  test::write(her,
              "<vit><unit>cm</unit><m name=\"bust_circ\" value=\"90\"/><m name=\"hip_circ\" value=\"bust_circ + 8\"/>"
              "<m name=\"rise\" value=\"3\"/></vit>");
  const Said made = karinui("body make --measures " + her + " --set waist_girth=70cm -o " + body);
  ASSERT_EQ(made.exit, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("“rise” has no counterpart"));
  const Said measured = karinui("body measure " + body + " -o " + back + " --json");
  ASSERT_EQ(measured.exit, 0) << measured.err;
  EXPECT_NEAR(measured.json()["measurements"]["hip_girth"].get<double>(), 0.98, 0.003);
  EXPECT_THAT(test::contents(back), HasSubstr("  seat: 98"));
  EXPECT_EQ(karinui("body measure " + body + " -o " + (folder / "back.xyz")).exit, 3);
  // A document on that figure, with formulas.
  const std::string script = folder / "a.ops", garment = folder / "a.karinui";
  test::write(script,
              "variable name=wide value=\"hip_girth/4 + 1cm\"\n"
              "piece name=a outline=\"M 0 0; hem L (wide) 0; side L (wide) 300; top L 0 300; fold L 0 0\"\n");
  const Said played = karinui("play " + script + " --body " + her + " -o " + garment);
  ASSERT_EQ(played.exit, 0) << played.err;
  EXPECT_THAT(karinui("variables " + garment).out, HasSubstr("wide = hip_girth/4 + 1cm  # 25.50 cm"));
  EXPECT_THAT(karinui("variables " + garment + " a.hem*2").out, HasSubstr("51.00 cm"));
  const Said wrong = karinui("variables " + garment + " 'wide + 2'");
  EXPECT_EQ(wrong.exit, 3);
  EXPECT_THAT(wrong.err, HasSubstr("do not go together"));
}

TEST_F(Command, RefusesABodyNobodyHas) {
  const Said said = karinui("body make --set bust_girth=5m -o " + (folder / "b.obj"));
  EXPECT_EQ(said.exit, 3);
  EXPECT_FALSE(said.err.empty());
  EXPECT_FALSE(fs::exists(folder / "b.obj"));
  EXPECT_EQ(karinui("body make --set best_girth=88cm -o " + (folder / "b.obj")).exit, 3);
  EXPECT_THAT(karinui("body make --size eu38 --set arm_angle=40deg -o " + (folder / "b.obj")).err,
              HasSubstr("only measured"));
}

TEST_F(Command, PlaysSettlesChecksAndExports) {
  haveTunic();
  const Said settled = karinui("settle " + document() + " --json");
  ASSERT_EQ(settled.exit, 0) << settled.err << settled.out;
  const auto json = settled.json();
  for (const char* key :
       {"settled", "why", "residual", "cpu_s", "wall_s", "peak_mb", "finite", "penetration_mm", "cloth_body_crossings",
        "cloth_cloth_crossings", "seam_gap_mm", "strain_mean", "strain_p99", "strain_max", "vertices"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_TRUE(json["settled"].get<bool>());
  EXPECT_THAT(karinui("check " + document()).out, HasSubstr("The garment is at rest."));
  fs::copy(document(), folder / "moved.karinui");
  ASSERT_EQ(
      karinui("do " + (folder / "moved.karinui") + " 'allowance kind=hem width=5cm' 'move piece=front by=0,0,1cm'")
          .exit,
      0);
  EXPECT_THAT(karinui("check " + (folder / "moved.karinui")).out, HasSubstr("changed since it was draped: "));
  EXPECT_LE(json["penetration_mm"].get<double>(), 1.0);
  EXPECT_LE(json["seam_gap_mm"].get<double>(), 1.0);
  EXPECT_LE(json["strain_mean"].get<double>(), 0.02);

  const auto info = karinui("info " + document() + " --json").json();
  EXPECT_EQ(info["pieces"].size(), 2u);
  EXPECT_EQ(info["seams"].size(), 4u);
  EXPECT_GT(info["pieces"][0]["edges"][0]["length_m"].get<double>(), 0.05);

  for (const char* ending : {"svg", "pdf", "obj", "glb", "json", "ops"}) {
    const std::string file = folder / (std::string("out.") + ending);
    EXPECT_EQ(karinui("export " + document() + " -o " + file).exit, 0) << ending;
    EXPECT_GT(contents(file).size(), 200u) << ending;
  }
  for (const char* ending : {"svg", "json"}) {
    const std::string again = folder / (std::string("again_") + ending + ".karinui");
    ASSERT_EQ(karinui("import " + (folder / (std::string("out.") + ending)) + " -o " + again).exit, 0) << ending;
    const auto read = karinui("info " + again + " --json").json();
    ASSERT_EQ(read["pieces"].size(), 2u) << ending;
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(read["pieces"][i]["name"], info["pieces"][i]["name"]) << ending;
      EXPECT_NEAR(read["pieces"][i]["perimeter_m"].get<double>(), info["pieces"][i]["perimeter_m"].get<double>(), 5e-5);
    }
  }
  // An ending in capital letters is the same ending; one that is not known is told what there is.
  EXPECT_EQ(karinui("export " + document() + " -o " + (folder / "OUT.SVG")).exit, 0);
  EXPECT_EQ(contents(folder / "OUT.SVG"), contents(folder / "out.svg"));
  EXPECT_EQ(karinui("export " + document() + " -o " + (folder / "X.OPS")).exit, 0);
  EXPECT_EQ(karinui("import " + (folder / "X.OPS") + " -o " + (folder / "x.karinui")).exit, 0);
  const auto unknown = karinui("import " + (folder / "body.stl") + " -o " + (folder / "y.karinui"));
  EXPECT_EQ(unknown.exit, 3);
  EXPECT_NE(
      unknown.err.find("patterns (.svg, .json, .dxf), bodies (.glb, .obj, .gltf, .ply), scripts of operations (.ops)"),
      std::string::npos)
      << unknown.err;
  const std::string obj = contents(folder / "out.obj");
  for (const char* object : {"\no body\n", "\no front\n", "\no back\n"}) EXPECT_NE(obj.find(object), std::string::npos);
  EXPECT_EQ(karinui("export " + document() + " -o " + (folder / "out.xyz")).exit, 3);
  EXPECT_EQ(
      karinui("picture " + document() + " -o " + (folder / "p.png") + " --view oblique --map strain --size 300x400")
          .exit,
      0);
  EXPECT_EQ(contents(folder / "p.png").substr(1, 3), "PNG");
  const std::string table = "picture " + document() + " --size 300x400 -o " + (folder / "t.png");
  ASSERT_EQ(karinui(table + " --table").exit, 0);
  const std::string flat = contents(folder / "t.png");
  EXPECT_EQ(flat.substr(1, 3), "PNG");
  ASSERT_EQ(karinui(table).exit, 0);
  EXPECT_NE(flat, contents(folder / "t.png")) << "the flat pattern is another picture than the garment on its body";
  const auto both = karinui(table + " --table --view back");
  EXPECT_EQ(both.exit, 2);
  EXPECT_NE(both.err.find("cannot be given together"), std::string::npos) << both.err;
}

TEST_F(Command, CtrlCLeavesTheClothWhereItIs) {
  haveTunic();
  const auto before = karinui("info " + document() + " --json").json();
  ASSERT_EQ(karinui("do " + document() + " 'set spacing=5mm'").exit, 0);
  // As soon as it tells that the solver is at work.
  write(folder / "stop.sh", "'" KARINUI_COMMAND "' settle " + document() + " --threads 1 2>" + (folder / "said") +
                                " &\nwhile kill -0 $! && ! grep -qE \"Draping|seams\" " + (folder / "said") +
                                "; do :; done\nkill -INT $!\nwait $!\n");
  const int status = std::system(("LC_ALL=C bash -m " + (folder / "stop.sh") + " >/dev/null").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 4) << contents(folder / "said");
  EXPECT_NE(contents(folder / "said").find("Stopped after"), std::string::npos) << contents(folder / "said");
  EXPECT_NE(karinui("log " + document()).out.find(" stop="), std::string::npos);
  EXPECT_NE(before["drape_hash"], karinui("info " + document() + " --json").json()["drape_hash"]);
  EXPECT_EQ(karinui("undo " + document()).exit, 0);
  EXPECT_EQ(before["drape_hash"], karinui("info " + document() + " --json").json()["drape_hash"]);
}

TEST_F(Command, SameBitsForOneAndTwoThreadsAndOnReplay) {
  haveTunic();
  fs::copy(document(), folder / "two.karinui");
  ASSERT_EQ(karinui("settle " + document() + " --threads 1").exit, 0);
  ASSERT_EQ(karinui("settle " + (folder / "two.karinui") + " --threads 2").exit, 0);
  const auto one = karinui("info " + document() + " --json").json();
  EXPECT_EQ(one["drape_hash"], karinui("info " + (folder / "two.karinui") + " --json").json()["drape_hash"]);

  write(folder / "log.ops", karinui("log " + document()).out);
  ASSERT_EQ(karinui("play " + (folder / "log.ops") + " -o " + (folder / "again.karinui")).exit, 0);
  const auto again = karinui("info " + (folder / "again.karinui") + " --json").json();
  EXPECT_EQ(one["hash"], again["hash"]);
  EXPECT_EQ(one["drape_hash"], again["drape_hash"]);
}

TEST_F(Command, UndoAndRedoSurviveClosing) {
  haveTunic();
  const auto before = karinui("info " + document() + " --json").json()["hash"];
  ASSERT_EQ(karinui("do " + document() + " 'rename piece=front to=bodice'").exit, 0);
  const auto renamed = karinui("info " + document() + " --json").json()["hash"];
  EXPECT_NE(before, renamed);
  EXPECT_EQ(karinui("undo " + document()).exit, 0);
  EXPECT_EQ(karinui("info " + document() + " --json").json()["hash"], before);
  EXPECT_EQ(karinui("redo " + document()).exit, 0);
  EXPECT_EQ(karinui("info " + document() + " --json").json()["hash"], renamed);
  EXPECT_EQ(karinui("redo " + document()).exit, 3);
}

TEST_F(Command, TellsWhatWasTakenBackAndWhatWasDoneAgain) {
  haveTunic();
  ASSERT_EQ(karinui("do " + document() + " 'rename piece=front to=bodice'").exit, 0);
  EXPECT_THAT(karinui("undo " + document()).out, testing::MatchesRegex("Taken back: rename .*to=bodice\n"));
  EXPECT_THAT(karinui("redo " + document()).out, testing::MatchesRegex("Done again: rename .*to=bodice\n"));
  EXPECT_THAT(karinui("undo " + document(), "ja_JP.UTF-8").out, HasSubstr("取り消しました"));
  EXPECT_THAT(std::string(karinui("redo " + document() + " --json").json()["operation"]),
              testing::StartsWith("rename"));
}

// What a pulled outline became is in the log, not on the screen.
TEST_F(Command, ALongOutlineIsNotEchoed) {
  haveTunic();
  const std::string reshape = "do " + document() + " 'reshape piece=front at=0,0 by=0,-1cm,0 within=10cm'";
  const Said said = karinui(reshape);
  ASSERT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("reshape piece="));
  EXPECT_THAT(said.out, HasSubstr("outline=\"M "));
  EXPECT_LT(said.out.size(), 300u) << said.out;
  EXPECT_THAT(karinui("undo " + document()).out, testing::SizeIs(testing::Lt(300u)));
  EXPECT_GT(std::string(karinui("redo " + document() + " --json").json()["operation"]).size(), 400u);
  EXPECT_GT(karinui("log " + document()).out.size(), 800u);
}

// What the last drape came to is known to who only looks.
TEST_F(Command, AnExaminationTellsWhetherTheClothRests) {
  ASSERT_EQ(play("rectangle name=skirt width=20cm height=20cm\nrectangle name=other width=20cm height=20cm\n"
                 "body size=jis9ar\n")
                .exit,
            0);
  EXPECT_FALSE(karinui("check " + document() + " --json").json().contains("settled")) << "never draped";
  EXPECT_EQ(karinui("check " + document() + " --json").json()["at_rest"], false);
  EXPECT_THAT(karinui("check " + document()).out, HasSubstr("has not been draped yet"));
  ASSERT_EQ(karinui("do " + document() + " 'place piece=skirt at=torso:waist@0' 'drape stop=1'").exit, 4);
  const auto said = karinui("check " + document() + " --json").json();
  EXPECT_EQ(said["settled"], false);
  EXPECT_THAT(said.value("why", ""), HasSubstr("Stopped"));
  EXPECT_THAT(karinui("check " + document()).out, HasSubstr("did not come to rest: Stopped"));
}

// Where on a waistband the sides and the centre come is where what it is sewn to changes.
TEST_F(Command, TellsWhatEachStretchOfAnEdgeIsSewnTo) {
  ASSERT_EQ(play("rectangle name=front width=40cm height=20cm\nrectangle name=back width=60cm height=20cm\n"
                 "rectangle name=band width=100cm height=4cm edges=\"low end top start\"\n"
                 "sew a=band.low b=\"front.top back.top\" reversed=yes name=waist\n")
                .exit,
            0);
  const Said info = karinui("info " + document() + " --piece band");
  EXPECT_THAT(info.out, HasSubstr("low@0.000:0.400"));
  EXPECT_THAT(info.out, HasSubstr("600.0 mm"));
  EXPECT_THAT(info.out, HasSubstr("–  back.top"));
  EXPECT_THAT(info.out, HasSubstr("low@0.400:1.000"));
  EXPECT_THAT(info.out, HasSubstr("–  front.top"));
  const auto sewn = karinui("info " + document() + " --piece band --json").json()["sewn"];
  ASSERT_EQ(sewn.size(), 2u);
  EXPECT_EQ(sewn[0]["other"], "front.top");
  EXPECT_NEAR(sewn[0]["to"].get<double>(), 0.4, 1e-6);
  EXPECT_NEAR(sewn[1]["length_m"].get<double>(), 0.6, 1e-6);
  EXPECT_EQ(karinui("info " + document() + " --piece front --json").json()["sewn"][0]["other"], "band.low@0.000:0.400");
}

// Corners that miss each other by a fifth of a millimetre are meant to meet.
TEST_F(Command, TellsOfNoSliverOfAnEdge) {
  ASSERT_EQ(play("rectangle name=left width=40cm height=9cm\nrectangle name=right width=60cm height=9cm\n"
                 "rectangle name=front width=400.2mm height=20cm\nrectangle name=back width=599.8mm height=20cm\n"
                 "sew a=\"left.top right.top\" b=\"front.bottom back.bottom\" reversed=yes\n")
                .exit,
            0);
  for (const auto& [piece, other] :
       {std::pair("left", "front.bottom"), {"right", "back.bottom"}, {"front", "left.top"}}) {
    const auto sewn = karinui("info " + document() + " --piece " + piece + " --json").json()["sewn"];
    ASSERT_EQ(sewn.size(), 1u) << sewn;
    EXPECT_EQ(sewn[0]["other"], other);
    EXPECT_EQ(sewn[0]["from"], 0.0);
    EXPECT_EQ(sewn[0]["to"], 1.0);
  }
}

TEST_F(Command, AmendsAStepAndPlaysThoseAfterIt) {
  ASSERT_EQ(
      play("set spacing=30mm\npiece name=flap outline=\"M 0 0; low L 400 0; side L 400 500; top L 0 500; left L 0 0\"\n"
           "rename piece=flap to=pocket\n")
          .exit,
      0);
  const std::string log = karinui("log " + document()).out;
  const Said said = karinui("amend " + document() + " 1 'set spacing=20mm' --json");
  ASSERT_EQ(said.exit, 0) << said.err;
  EXPECT_EQ(said.json()["operations"], 3);
  const std::string now = karinui("log " + document()).out;
  EXPECT_THAT(now, AllOf(HasSubstr("set spacing=20mm"), HasSubstr("to=pocket"), Not(HasSubstr("spacing=30mm"))));
  const Said gone = karinui("amend " + document() + " 9 'set spacing=20mm'");
  EXPECT_EQ(gone.exit, 3);
  EXPECT_THAT(gone.err, HasSubstr("There is no step 9; the document has 3"));
  const Said refused = karinui("amend " + document() + " 2 'set spacing=10mm'");  // what step 3 renames is then missing
  EXPECT_EQ(refused.exit, 3);
  EXPECT_THAT(refused.err, HasSubstr("Step 3"));
  EXPECT_EQ(karinui("log " + document()).out, now) << "all or nothing";
}

TEST_F(Command, SaysWhatAnAmendedDrapeCameTo) {
  ASSERT_EQ(play("body size=eu38\nset spacing=20mm\npiece name=flap outline=\"M 0 0; low L 400 0; side L 400 500; top "
                 "L 0 500; left L 0 0\"\n"
                 "pin piece=flap at=\"0,50cm; 40cm,50cm\"\ndrape\n")
                .exit,
            0);
  const Said said = karinui("amend " + document() + " 5 'drape stop=1' --json");
  EXPECT_EQ(said.exit, 4) << said.err;
  EXPECT_EQ(said.json()["settled"], false);
  EXPECT_THAT(said.err, HasSubstr("The cloth did not come to rest"));
}

TEST_F(Command, SaysWhereQuotationMarksWereForgotten) {
  ASSERT_EQ(play("piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; top L 0 500; centre L 0 0\"\n").exit,
            0);
  const Said cut = karinui("do " + document() + " cut piece=front line='0,-1cm 0,20cm' name=slit 'set ease=1cm'");
  EXPECT_NE(cut.exit, 0);
  EXPECT_THAT(cut.err, HasSubstr("“piece=front” stands by itself"));
  EXPECT_THAT(cut.err, HasSubstr("'cut piece=front line=\"0,-1cm 0,20cm\" name=slit'"));
  EXPECT_THAT(karinui("do " + document() + " ease=1cm").err, HasSubstr("'OPERATION ease=1cm'"));
  EXPECT_EQ(karinui("do " + document() + " 'cut piece=front line=\"10cm,-1cm 10cm,20cm\"' 'set ease=1cm'").exit, 0);
}

// What was never draped is not told to have come to rest.
TEST_F(Command, SaysOfRestOnlyWhatADrapeCameTo) {
  const std::string flap =
      "body size=eu38\nset spacing=50mm\npiece name=flap outline=\"M 0 0; low L 400 0; side L 400 500; top L 0 500; "
      "left "
      "L 0 0\"\npin piece=flap at=\"0,50cm; 40cm,50cm\"\n";
  std::ofstream(folder / "flap.ops") << flap;
  std::ofstream(folder / "draped.ops") << flap << "drape\n";
  const auto played = karinui("play " + (folder / "flap.ops") + " -o " + (folder / "flap.karinui") + " --json").json();
  EXPECT_FALSE(played.contains("settled")) << played;
  EXPECT_EQ(played["at_rest"], false);
  ASSERT_EQ(karinui("export " + (folder / "flap.karinui") + " -o " + (folder / "flap.svg")).exit, 0);
  const auto read = karinui("import " + (folder / "flap.svg") + " -o " + (folder / "read.karinui") + " --json").json();
  EXPECT_FALSE(read.contains("settled")) << read;
  EXPECT_EQ(read["pieces"], 1);
  const auto amended = karinui("amend " + (folder / "flap.karinui") + " 2 'set spacing=40mm' --json").json();
  EXPECT_FALSE(amended.contains("settled")) << amended;
  const auto draped =
      karinui("play " + (folder / "draped.ops") + " -o " + (folder / "draped.karinui") + " --json").json();
  EXPECT_EQ(draped["settled"], true);
  EXPECT_EQ(draped["at_rest"], true);
}

TEST_F(Command, SaysHowMuchLongerOneSideOfASeamIs) {
  const std::string pieces =
      "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; top L 0 500; centre L 0 0\"\n"
      "piece name=back outline=\"M 0 0; hem L 400 0; side L 400 LONG; top L 0 500; centre L 0 0\"\n"
      "sew a=front.side b=back.side\n";
  const auto with = [&](const char* tall) {
    std::string script = pieces;
    fs::remove(document());
    return play(script.replace(script.find("LONG"), 4, tall)).err;
  };
  EXPECT_THAT(with("620"), HasSubstr("back.side is 120.0 mm longer than front.side"));
  EXPECT_THAT(with("540"), Not(HasSubstr("longer")));
  fs::remove(document());
  EXPECT_THAT(play("piece name=skirt outline=\"M 0 0; hem L 900 0; side L 900 500; top L 0 500; centre L 0 0\"\n"
                   "piece name=bodice outline=\"M 0 600; hem_2 L 200 600; hem L 400 600; end L 400 640; top L 0 640; "
                   "begin L 0 600\"\nsew a=skirt.top b=\"bodice.hem_2 bodice.hem\" reversed=yes\n")
                  .err,
              HasSubstr("skirt.top is 500.0 mm longer than bodice.hem_2 … bodice.hem, to which it is sewn."));
}

TEST_F(Command, SaysWhereARunOfEdgesIsBroken) {
  const std::string pieces =
      "piece name=skirt outline=\"M 0 0; hem L 400 0; side L 400 500; waist_2 L 200 500; waist L 0 500; centre L 0 "
      "0\"\n"
      "piece name=band outline=\"M 0 600; low L 400 600; end L 400 640; top L 0 640; begin L 0 600\"\n";
  EXPECT_THAT(play(pieces + "sew a=band.low b=\"skirt.waist_2 skirt.waist\" reversed=yes\n").err,
              Not(HasSubstr("does not end where")));
  fs::remove(document());
  EXPECT_THAT(play(pieces + "sew a=band.low b=\"skirt.waist_2 skirt.side skirt.waist\" reversed=yes\n").err,
              Not(HasSubstr("does not end where")))
      << "they are a run in another order";
  fs::remove(document());
  EXPECT_THAT(play(pieces + "sew a=band.low b=\"skirt.hem skirt.waist\" reversed=yes\n").err,
              HasSubstr(" does not end where skirt."));
}

TEST_F(Command, TellsTheNamesThatItGivesAwayOrGivesNone) {
  ASSERT_EQ(play("piece name=Hanako outline=\"M 0 0; low L 400 0; side L 400 500; top L 0 500; centre L 0 0\"\n").exit,
            0);
  Said said = karinui("share " + document() + " -o " + (folder / "named.karinui"));
  EXPECT_THAT(said.out, HasSubstr("Hanako, low, side, top, centre"));
  said = karinui("share " + document() + " --unnamed -o " + (folder / "unnamed.karinui"));
  EXPECT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("all names are neutral ones"));
  EXPECT_THAT(contents(folder / "named.karinui"), HasSubstr("Hanako"));
  EXPECT_THAT(contents(folder / "unnamed.karinui"), testing::Not(HasSubstr("Hanako")));
  said = karinui("share " + document() + " -o " + (folder / "none/x.karinui"));
  EXPECT_EQ(said.exit, 3);
  EXPECT_THAT(said.err, HasSubstr("none/x.karinui"));
  EXPECT_THAT(said.err, testing::Not(HasSubstr(".part")));
}

TEST_F(Command, TellsASewistWhatItMadeOfAMeasuredCloth) {
  const std::string weighed = "fabric measure --name mine --swatch 100x100 --mass 1.5";
  const Said rough = karinui(weighed + " --overhang-warp 50");
  ASSERT_EQ(rough.exit, 0) << rough.err;
  EXPECT_THAT(rough.err, HasSubstr("The weight is sure to ± 77 % only")) << "scales of whole grams";
  EXPECT_THAT(rough.out, HasSubstr("not measured, in proportion"));
  EXPECT_THAT(rough.out, HasSubstr("what was not measured is as there"));
  EXPECT_THAT(rough.out, HasSubstr("The operation that makes it:\n  fabric name=mine"));
  const Said fine = karinui(weighed + " --scales 0.01 --like linen");
  EXPECT_EQ(fine.err, "");
  EXPECT_THAT(fine.out, HasSubstr("What was not measured is as in Linen."));
  EXPECT_THAT(karinui(weighed + " --hang-warp 500:203").err, HasSubstr("say how far apart its marks are"));
  ASSERT_EQ(play("set ease=1cm\n").exit, 0);
  EXPECT_THAT(karinui(weighed + " --scales 0.01 --into " + document()).out, HasSubstr("Added to " + document() + ":"));
}

TEST_F(Command, ADumpIsItsOwnersAlone) {
  ASSERT_EQ(play("body size=jis9ar\n").exit, 0);
  ASSERT_EQ(karinui("dump " + document() + " -o " + (folder / "d.txt")).exit, 0);
  EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "d.txt").permissions()), 0600u);
}

TEST_F(Command, TextsAreSentToTheVerbThatReadsThem) {
  ASSERT_EQ(play("body size=jis9ar\n").exit, 0);
  const std::string dump = folder / "d.txt", log = folder / "l.txt", other = " -o " + (folder / "new.karinui");
  ASSERT_EQ(karinui("dump " + document() + " -o " + dump).exit, 0);
  std::ofstream(log) << karinui("log " + document()).out;
  for (const std::string verb : {"import ", "play "})
    EXPECT_THAT(karinui(verb + dump + other).err, HasSubstr("karinui load " + dump)) << verb;
  for (const std::string verb : {"import ", "load "})
    EXPECT_THAT(karinui(verb + log + other).err, HasSubstr("karinui play " + log)) << verb;
  std::ofstream(folder / "x.txt") << "something else\n";
  EXPECT_THAT(karinui("import " + (folder / "x.txt") + other).err, HasSubstr("none of the endings"));
  EXPECT_FALSE(fs::exists(folder / "new.karinui"));
  EXPECT_EQ(karinui("load " + dump + other).exit, 0);
}

// By what is typed into `sew`: on paper that stands nowhere left and right are not the wearer's.
TEST_F(Command, ProposedSeamsNameTheirEdgesAsScriptsDo) {
  ASSERT_EQ(play("body size=eu38\nblock kind=shirt fabric=cotton\n").exit, 0);
  ASSERT_EQ(karinui("export " + document() + " -o " + (folder / "s.dxf")).exit, 0);
  const Said said = karinui("import " + (folder / "s.dxf") + " --sew list");
  EXPECT_EQ(said.exit, 0) << said.err;
  EXPECT_THAT(said.out, HasSubstr("shoulder_left: front_left.e"));
  EXPECT_THAT(said.out, HasSubstr(" — back.e"));
  EXPECT_THAT(said.out, testing::Not(HasSubstr("right shoulder")));
}

TEST_F(Command, RefusedInputChangesNothing) {
  EXPECT_EQ(play("body size=jis9ar\nsew a=front.side b=back.side\n").exit, 3);
  EXPECT_FALSE(fs::exists(document()));
  haveTunic();
  const std::string bytes = contents(document());
  const Said refused = karinui("do " + document() + " 'cut piece=front line=\"0,10cm 0,20cm\"'");
  EXPECT_EQ(refused.exit, 3);
  EXPECT_FALSE(refused.err.empty());
  EXPECT_EQ(karinui("do " + document() + " 'knit piece=front'").exit, 3);
  EXPECT_EQ(contents(document()), bytes);
  EXPECT_EQ(play(kTunic).exit, 3) << "a document that is there is not overwritten";
  for (const auto& entry : fs::directory_iterator(fs::path(document()).parent_path())) {
    EXPECT_TRUE(entry.path().extension() == ".karinui" || entry.path().extension() == ".ops") << entry.path();
  }
}

TEST_F(Command, OfSeveralOperationsThoseBeforeTheRefusedOneAreToldAsKept) {
  haveTunic();
  const Said said = karinui("do " + document() + " 'rename piece=front to=bodice' 'rename piece=nobody to=x'");
  EXPECT_EQ(said.exit, 3);
  EXPECT_THAT(said.err, HasSubstr("Done and kept: 1 of 2 operations."));
  EXPECT_THAT(karinui("log " + document()).out, HasSubstr("to=bodice"));
  EXPECT_THAT(karinui("do " + document() + " 'rename piece=nobody to=x'").err, Not(HasSubstr("kept")));
}

TEST_F(Command, EveryReaderRefusesNonsenseInASentence) {
  const std::string nonsense[] = {"",
                                  std::string(4, '\0'),
                                  "nan nan nan",
                                  "{\"pattern\":",
                                  std::string(70'000, '['),
                                  "v nan 0 0\nf 1 1 1\n",
                                  "SQLite format 3",
                                  "\xff\xfe\xfa"};
  int number = 0;
  for (const char* ending : {"json", "svg", "obj", "ply", "glb", "gltf", "ops", "karinui", "xyz"}) {
    for (const std::string& bytes : nonsense) {
      const std::string file = folder / ("bad" + std::to_string(number++) + "." + ending);
      write(file, bytes);
      const bool opened = std::string(ending) == "karinui";
      const Said said = opened ? karinui("info " + file) : karinui("import " + file + " -o " + document());
      const bool emptyScript = std::string(ending) == "ops" && bytes.empty();
      EXPECT_EQ(said.exit, emptyScript ? 0 : 3) << file << "\n" << said.err;
      EXPECT_EQ(fs::exists(document()), emptyScript) << file;
      EXPECT_EQ(said.err.find(fs::path(file).filename()) == std::string::npos, emptyScript) << file << "\n" << said.err;
      fs::remove(document());
    }
  }
  EXPECT_EQ(karinui("import " + (folder / "not_there.obj") + " -o " + document()).exit, 3);
  const Said unreadable = karinui("info '" + (folder / "\xff.karinui") + "' --json");  // a name that is no text
  EXPECT_EQ(unreadable.exit, 3) << unreadable.err;
  EXPECT_TRUE(unreadable.json().contains("error")) << unreadable.out;
}

}  // namespace
}  // namespace karinui::test

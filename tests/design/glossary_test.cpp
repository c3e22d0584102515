// Every identifier a person can see has a name in both languages.
#include "karinui/design/glossary.h"
#include "karinui/body/sizes.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "design/glossary/terms.h"
#include "design/workroom.h"
#include "karinui/cloth/fabric.h"
#include "karinui/design/step_words.h"

namespace karinui {
namespace {

bool hasJapanese(const std::string& text) {
  static const std::regex kana("[\xE3-\xE9][\x80-\xBF][\x80-\xBF]");
  return std::regex_search(text, kana);
}
bool looksLikeAnIdentifier(const std::string& text) {
  static const std::regex machine("[a-z0-9]_[a-z0-9]|\\be[0-9]|\\bp[0-9]|[a-z]:[a-z]|[a-z]@");
  return std::regex_search(text, machine);
}
void expectNamed(Term kind, std::string_view identifier) {
  const auto name = termSaid(kind, identifier);
  ASSERT_TRUE(name) << identifier << " has no name";
  const std::string english = text(*name), japanese = text(*name, Language::Japanese);
  EXPECT_FALSE(looksLikeAnIdentifier(english)) << english;
  EXPECT_TRUE(hasJapanese(japanese)) << identifier << " is “" << japanese << "” in Japanese";
  EXPECT_NE(japanese, english);
  // Words of the body and of the pattern are English words already.
  if (kind != Term::Word && kind != Term::Level && kind != Term::Part) {
    EXPECT_NE(english, identifier);
  }
}

// A second name of one identifier would never be said.
TEST(Glossary, NamesEachIdentifierOnce) {
  for (const TermTable table : {measureTerms(), landmarkTerms(), partTerms(), levelTerms(), sizeTerms(),
                                operationTerms(), fieldTerms(), valueTerms(), fabricTerms(), wordTerms()}) {
    std::set<std::string_view> named;
    for (const NamedTerm& term : table) EXPECT_TRUE(named.insert(term.identifier).second) << term.identifier;
  }
}

TEST(Glossary, EveryMeasureHasAName) {
  for (const auto key : measurementKeys()) expectNamed(Term::Measure, key);
  for (const auto key : mannequinKeys()) expectNamed(Term::Measure, key);
}

TEST(Glossary, EveryPlaceOfTheBodyHasAName) {
  Workers workers(1);
  Token token;
  const auto body = makeMannequin(*builtInSize("jis9ar"), workers, token);
  ASSERT_TRUE(body);
  ASSERT_GT((*body)->landmarks().size(), 20u);
  for (const auto& [landmark, place] : (*body)->landmarks()) expectNamed(Term::Landmark, landmark);
  using Part = BodyPoint::Part;
  for (const Part part : {Part::Torso, Part::LeftArm, Part::RightArm, Part::LeftLeg, Part::RightLeg})
    for (const auto level : chartLevels(part)) expectNamed(Term::Level, level);
  for (const char* part : {"torso", "left_arm", "right_arm", "left_leg", "right_leg"}) expectNamed(Term::Part, part);
}

TEST(Glossary, EveryFabricAndSizeHasAName) {
  for (const Fabric& fabric : presets()) expectNamed(Term::Fabric, fabric.name);
  for (const auto size : builtInSizes()) expectNamed(Term::Size, size);
}

TEST(Glossary, EveryOperationFieldAndChoiceHasAName) {
  for (const OperationHelp& operation : operationHelp()) {
    expectNamed(Term::OperationName, operation.name);
    EXPECT_TRUE(hasJapanese(text(Message{operation.help, {}}, Language::Japanese))) << operation.help;
    for (const FieldHelp& field : operation.fields) {
      SCOPED_TRACE(operation.name + "." + field.name);
      expectNamed(Term::Field, field.name);
      EXPECT_TRUE(hasJapanese(text(fieldSaid(operation.name, field.name), Language::Japanese)));
      if (const std::string kind = field.kind; kind.find('|') != std::string::npos)
        for (std::size_t at = 0, end; at <= kind.size(); at = end + 1) {
          end = std::min(kind.find('|', at), kind.size());
          expectNamed(Term::Value, kind.substr(at, end - at));
        }
    }
  }
}

std::string said(const std::optional<Message>& message, Language language = Language::English) {
  return message ? text(*message, language) : "nothing";
}

TEST(Glossary, NamesTheProgramMadeUpAreSaidAsATailorSaysThem) {
  const std::vector<std::array<const char*, 3>> names{
      {"e3", "edge 3", "辺3"},
      {"e3_right", "edge 3, right half", "辺3（右半分）"},
      {"edge_0", "edge 1", "辺1"},
      {"side_left", "left side", "左脇"},
      {"armhole_l", "left armhole", "左袖ぐり"},
      {"hem_2", "hem 2", "裾 2"},
      {"front", "front", "前身頃"},
      {"sleeve_right", "right sleeve", "右袖"},
      {"left_sleeve_f", "left front sleeve", "左前袖"},
      {"front.e3_right", "edge 3, right half of front", "前身頃の辺3（右半分）"},
      {"p6.edge_0", "edge 1 of piece 6", "パーツ6の辺1"},
      {"front.side_left@0.25:0.5", "left side of front, 25 % to 50 %", "前身頃の左脇（25～50 %）"},
      {"bust_girth", "Bust girth", "バスト囲"},
      {"cotton_2", "Cotton 2", "綿ブロード 2"},
      {"wool suiting", "Wool suiting", "ウールの服地"},
      {"torso:waist+0.1@0.25", "waist, left side", "ウエストの左脇"},
      {"torso:waist+0.5@0", "between waist and under bust, front", "ウエストとアンダーバストの間の前"},
      {"left_arm:elbow@0", "left arm, elbow, front", "左腕、ひじの前"},
      {"landmark:shoulder_left", "left shoulder point", "左ショルダーポイント"},
      {"p3.2", "piece 3-2", "パーツ3-2"},
      {"hem, side_left, e3", "hem, left side, edge 3", "裾、左脇、辺3"},
      {"skirt_side_left", "left side of skirt", "スカートの左脇"},
      {"top_front_left", "left front of top", "トップスの左前身頃"},
      {"top_sleeve_right", "right sleeve of top", "トップスの右袖"},
      {"outer_skirt_front", "front skirt of outer layer", "外側の服の前スカート"},
      {"outer2_leg_back_left", "left back trouser leg of outer layer 2", "外側の服 2の左後ろ脚部"},
      {"top_left", "left top edge", "左上端"},
      {"vest_front_left_lining", "lining of left front of vest", "ベストの左前身頃の裏地"},
      {"pocket_left_low_right", "right lower edge of left pocket", "左ポケットの右下の辺"},
      {"pleat_fold_3", "pleat fold 3", "プリーツの折り山 3"},
      {"waist_row_2", "row 2 of waist", "ウエストの段 2"},
      {"notch3", "notch 3", "合印 3"},
      {"h2_e1", "edge 1 of hole 2", "穴2の辺1"},
      {"front.pleat_2", "pleat 2 of front", "前身頃のプリーツ 2"},
  };
  for (const auto& [identifier, english, japanese] : names) {
    EXPECT_EQ(said(identifierSaid(identifier)), english);
    EXPECT_EQ(said(identifierSaid(identifier), Language::Japanese), japanese);
  }
}

// As the cutting trade draws a front, its grain along u: it lies on its side, and is called as it will be worn.
TEST(Glossary, EdgesOfAPieceDrawnOnItsSideAreCalledWithTheGrainUpwards) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done played = room.play(
      file,
      "piece name=front grain=1,0 outline=\"M 0 200; e1 L 0 -200; e2 L 300 -220; e3 C 330 -160 430 -150 480 -170; e4 L "
      "520 -70; e5 C 420 -60 420 60 520 70; e6 L 480 170; e7 C 430 150 330 160 300 220; e8 L 0 200\"\n");
  ASSERT_TRUE(played) << text(played.error().what);
  const std::pair<const char*, const char*> names[] = {
      {"e1", "hem"},      {"e2", "left side"},      {"e3", "left armhole"},  {"e4", "left shoulder"},
      {"e5", "neckline"}, {"e6", "right shoulder"}, {"e7", "right armhole"}, {"e8", "right side"}};
  for (const auto& [edge, said] : names)
    EXPECT_EQ(text(edgeNameSaid(file.document(), *file.document().pieceNamed("front"), edge)), said) << edge;
}

TEST(Glossary, EdgesWithANumberAreCalledByHowTheyAreCutAndWhereTheyLie) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done played = room.play(
      file,
      "piece name=front pose=\"0,1,0.1\" outline=\"M -200 0; e1 L 200 0; e2 L 220 300; e3 C 160 330 150 430 170 480; "
      "e4 L 70 520; e5 C 60 420 -60 420 -70 520; e6 L -170 480; e7 C -150 430 -160 330 -220 300; e8 L -200 0\"\n"
      "piece name=back pose=\"0,1,-0.1 y 180deg\" outline=\"M -200 0; edge_0 L 200 0; edge_1 L 220 500; edge_2 L -220 "
      "500; edge_3 L -200 0\"\n"
      "piece name=skirt pose=\"0,0.9,0\" outline=\"M 0 0; e1 L 300 0; e2 L 300 200; e3 L 300 400; e4 L 0 400; "
      "side_left L 0 "
      "0\"\n");
  ASSERT_TRUE(played) << text(played.error().what);
  const auto called = [&](const char* piece, const char* edge, Language language = Language::English) {
    return text(edgeNameSaid(file.document(), *file.document().pieceNamed(piece), edge), language);
  };
  const std::vector<std::array<const char*, 4>> names{{"front", "e1", "hem", "裾"},
                                                      {"front", "e2", "left side", "左脇"},
                                                      {"front", "e3", "left armhole", "左袖ぐり"},
                                                      {"front", "e4", "left shoulder", "左肩"},
                                                      {"front", "e5", "neckline", "衿ぐり"},
                                                      {"front", "e6", "right shoulder", "右肩"},
                                                      {"front", "e7", "right armhole", "右袖ぐり"},
                                                      {"front", "e8", "right side", "右脇"},
                                                      {"back", "edge_1", "right side", "右脇"},
                                                      {"back", "edge_3", "left side", "左脇"},
                                                      {"skirt", "e2", "left side 1", "左脇 1"},
                                                      {"skirt", "e3", "left side 2", "左脇 2"}};
  const auto all = [&] {
    std::vector<std::string> said;
    for (const auto& [piece, edge, english, japanese] : names) said.push_back(called(piece, edge));
    return said;
  };
  for (const auto& [piece, edge, english, japanese] : names) {
    EXPECT_EQ(called(piece, edge), english) << piece << "." << edge;
    EXPECT_EQ(called(piece, edge, Language::Japanese), japanese) << piece << "." << edge;
  }
  // The names stay while the cloth drapes, and say what an edge is sewn to.
  const auto before = all();
  ASSERT_TRUE(room.play(file, "drape\n"));
  EXPECT_EQ(all(), before);
  ASSERT_TRUE(room.play(file, "sew a=front.e2 b=back.edge_3\n"));
  const Document& document = file.document();
  const auto partner = [&](Language language) {
    return text(edgeWithPartnerSaid(document, *document.pieceNamed("front"), "e2"), language);
  };
  EXPECT_EQ(partner(Language::English), "left side, sewn to back");
  EXPECT_EQ(partner(Language::Japanese), "左脇（後ろ身頃と縫い合わせ）");
  EXPECT_EQ(text(edgeSaid(document, {PieceRef("front"), "e2"})), "left side (e2) of front");
  EXPECT_EQ(text(seamSaid(document, document.pattern.seams.begin()->second)),
            "left side (e2) of front – left side (edge_3) of back");
  Seam pleated;
  pleated.a = {{document.pieceNamed("front")->id, "e2"}};
  for (const char* edge : {"edge_0", "edge_1", "edge_2", "edge_3", "edge_0"})
    pleated.b.push_back({document.pieceNamed("back")->id, edge});
  EXPECT_EQ(text(seamSaid(document, pleated)), "left side (e2) of front – " +
                                                   text(edgeSaid(document, {PieceRef("back"), "edge_0"})) + " … " +
                                                   text(edgeSaid(document, {PieceRef("back"), "edge_0"})))
      << "a dozen edges are not read";
  EXPECT_EQ(said(identifierSaid(document, "front.e2")), "left side of front");
  EXPECT_EQ(said(identifierSaid(document, "front.e12")), "edge 12 of front") << "there is no such edge";
  EXPECT_EQ(said(identifierSaid(document, "bust_girth")), "Bust girth");
}

// A dart is called by its own name, as on paper; its two legs were said one after the other, and looked alike.
TEST(Glossary, ASeamThatClosesADartIsCalledAsTheDart) {
  Workroom room;
  auto file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file,
                        "rectangle name=skirt_front width=40cm height=50cm\n"
                        "dart edge=skirt_front.top at=0.3 width=2cm tip=-8cm,38cm symmetric=no\n"));
  const Document& document = file.document();
  ASSERT_EQ(document.pattern.seams.size(), 1u);
  const Seam& dart = document.pattern.seams.begin()->second;
  EXPECT_EQ(text(seamSaid(document, dart)), "dart of front skirt");
  EXPECT_EQ(text(seamSaid(document, dart), Language::Japanese), "前スカートのダーツ");
}

// Every piece, edge, line, seam, mark and fabric of the garments in `examples` and of the blocks.
std::set<std::string> namesOfDraftsAndSamples() {
  namespace fs = std::filesystem;
  std::set<std::string> names;
  Workroom room;
  const auto play = [&](const std::string& script) {
    const auto lines = parseScript(script);
    ASSERT_TRUE(lines);
    DocumentFile file = DocumentFile::inMemory();
    for (const ScriptLine& line : *lines) {
      ASSERT_TRUE(file.perform(line.operation, room.context)) << text(line.operation);
      const Document& document = file.document();
      for (const auto& [id, kept] : document.pattern.pieces) {
        const Piece& piece = *kept;
        names.insert({piece.name, piece.fabric});
        for (const Edge& edge : piece.outline.edges) names.insert(edge.name);
        for (const InternalLine& own : piece.lines) names.insert(own.name);
        for (const Mark& mark : piece.marks) names.insert(mark.name);
      }
      for (const auto& [id, seam] : document.pattern.seams) names.insert(seam.name);
    }
  };
  for (const auto& entry : fs::directory_iterator(fs::path(KARINUI_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".ops") continue;
    SCOPED_TRACE(entry.path().filename().string());
    std::ifstream in(entry.path());
    play({std::istreambuf_iterator<char>(in), {}});
  }
  for (const OperationHelp& operation : operationHelp())
    for (const FieldHelp& field : operation.fields)
      if (operation.name == "block" && field.name == "kind") {
        std::stringstream kinds(field.kind);
        for (std::string kind; std::getline(kinds, kind, '|');)
          play(std::string("body size=jis9ar\n") + (kind == "collar" ? "block kind=bodice\n" : "") +
               "block kind=" + kind + "\n");
      }
  names.erase("");
  return names;
}

TEST(Glossary, NamesOfDraftsAndSamplesAreWords) {
  const auto names = namesOfDraftsAndSamples();
  EXPECT_GT(names.size(), 50u);
  static const std::regex latin("[a-z_]");
  for (const std::string& name : names) {
    const std::string english = text(nameSaid(name)), japanese = text(nameSaid(name), Language::Japanese);
    EXPECT_EQ(english.find('_'), std::string::npos) << name;
    EXPECT_FALSE(std::regex_search(japanese, latin)) << name << " is " << japanese;
  }
}

// A fastening that is given no name is called by what it is, in the menus and the steps.
TEST(Glossary, FasteningsAreCalledByWhatTheyAre) {
  for (const char* kind : {"buttons", "snaps", "hooks", "ties", "zip"})
    for (const std::string& name : {std::string(kind), std::string(kind) + "_2"})
      EXPECT_TRUE(hasJapanese(text(nameSaid(name), Language::Japanese))) << name;
}

TEST(Glossary, WhatAPersonNamedIsSaidAsGiven) {
  for (const char* own : {"my_edge", "袖口", "cuff-links", "3", "yes", "coat.karinui", "12cm,3cm", ""})
    EXPECT_EQ(said(identifierSaid(own)), "nothing") << own;
  EXPECT_EQ(text(nameSaid("袖口"), Language::English), "袖口");
  // A name has no spaces; an underscore between words stands for one.
  EXPECT_EQ(text(nameSaid("my_edge")), "my edge");
  EXPECT_EQ(text(nameSaid("placket_under")), "placket under");
  EXPECT_EQ(text(nameSaid("under_collar"), Language::Japanese), "地衿");
  EXPECT_EQ(text(nameSaid("under_front_left")), "left front underarm");
  for (const char* own : {"_edge", "edge_", "my__edge"}) EXPECT_EQ(text(nameSaid(own)), own);
  // What is said is found again when it is typed.
  for (const char* name : {"my_edge", "私の袖口", "side_left", "front", "Müllers_Mantel", "cotton"})
    for (const Language language : {Language::English, Language::Japanese})
      EXPECT_EQ(nameTyped(text(nameSaid(name), language)), name);
  EXPECT_EQ(nameTyped("  my   edge "), "my_edge");
  EXPECT_EQ(nameTyped("私の　袖口"), "私の_袖口");
  EXPECT_EQ(nameTyped("Left Sleeve"), "sleeve_left");
  EXPECT_EQ(nameTyped(""), "");
}

TEST(Glossary, ThePersonsOwnNamesAreKnownInSentences) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(
      room.play(file, "piece name=my_pocket outline=\"M 0 0; lower_rim L 100 0; right_rim L 100 100; e3 L 0 0\"\n"));
  EXPECT_EQ(said(identifierSaid(file.document(), "my_pocket")), "my pocket");
  EXPECT_EQ(said(identifierSaid(file.document(), "lower_rim")), "lower rim");
  EXPECT_EQ(said(identifierSaid(file.document(), "my_pocket.lower_rim")), "lower rim of my pocket");
  EXPECT_EQ(said(identifierSaid(file.document(), "my_file.json")), "nothing");
}

TEST(Glossary, SentencesReadWithoutScripts) {
  const auto read = [](const char* sentence, Language language = Language::English) {
    const Message message{sentence, {}};
    return withoutScript(sentence, text(message, language), language);
  };
  EXPECT_EQ(read("This seam is its own mirror image; leave mirror= away."),
            "This seam is its own mirror image; leave “Also the other side” away.");
  EXPECT_EQ(read("This seam is its own mirror image; leave mirror= away.", Language::Japanese),
            "この縫い目は左右対称にしても同じものです。「反対側にも作る」を省いてください。");
  EXPECT_EQ(read("The darts of both halves would meet; write symmetric=no for one alone."),
            "The darts of both halves would meet; write “On both halves: No” for one alone.");
  EXPECT_EQ(read("“{0}” is frozen; thaw it first: freeze piece={0} frozen=no."),
            "“{0}” is frozen; thaw it first: “Freeze (Piece: {0}, Stays as it is: No)”.");
  EXPECT_EQ(read("Say which edges are turned up: edges=skirt.hem."), "Say which edges are turned up: “Edges”.");
  EXPECT_EQ(read("“{0}” is not a measurement; write it like bust_girth=88cm."),
            "“{0}” is not a measurement; write it like “Bust girth: 88cm”.");
  for (const char* same : {"No script here.", "{0} = {1}", "a≠b", ""}) EXPECT_EQ(read(same), same);
}

// Every sentence that shows a script is read without it in a window, in both languages.
TEST(Glossary, NoSentenceKeepsAScript) {
  std::ifstream catalogue(std::string(KARINUI_SOURCE_DIR) + "/data/messages.ja.tsv");
  static const std::regex script("(^|[^a-z_#-])[a-z_]{2,}=");
  std::string line;
  int seen = 0;
  while (std::getline(catalogue, line)) {
    const std::string english = line.substr(0, line.find('\t')), japanese = line.substr(line.find('\t') + 1);
    if (!std::regex_search(english, script)) continue;
    // Of scripts themselves, which no window speaks of.
    if (english.starts_with("'OP") || english.find("NAME") != english.npos) continue;
    if (english.find("name=value") != english.npos) continue;
    ++seen;
    for (const std::string& said :
         {withoutScript(english, english, Language::English), withoutScript(english, japanese, Language::Japanese)})
      EXPECT_FALSE(std::regex_search(said, script)) << said;
  }
  EXPECT_GT(seen, 50);
}

// An elastic typed as 14 cm is a share of its edge, with all its digits in the record only.
TEST(Glossary, AShareIsSaidInFourDecimals) {
  const auto elastic = parseOperation("elastic edges=p1.hem ratio=0.585236529476");
  ASSERT_TRUE(elastic);
  EXPECT_THAT(text(stepSaid(Document(), *elastic)), testing::HasSubstr("0.5852"));
  EXPECT_THAT(text(stepSaid(Document(), *elastic)), testing::Not(testing::HasSubstr("0.58523")));
}

TEST(Glossary, StepsAreSaidWithoutAnyIdentifier) {
  Document document;
  const auto step = [&](const char* line, Language language = Language::English) {
    const auto operation = parseOperation(line);
    EXPECT_TRUE(operation) << line;
    return text(stepSaid(document, *operation), language);
  };
  EXPECT_EQ(step("drape gravity=0,-5,0"), "Gravity: 5 m/s² downwards");
  EXPECT_EQ(step("drape gravity=0,-5,0", Language::Japanese), "重力：下向き 5 m/s²");
  EXPECT_EQ(step("sew a=front.side_left b=back.side_left tie=2:1"),
            "left side: front – back, Ease or gathers: Gathered (2:1)");
  EXPECT_EQ(step("move piece=p3 by=0,5cm,10cm turn=\"y 90deg\""),
            "piece 3, 50.0 mm upwards, 100.0 mm forwards, Turn: 90.0° about the upright axis");
  EXPECT_EQ(step("body size=jis9ar set=\"bust_girth=88cm\""), "JIS 9AR (women), Bust girth 880.0 mm");
  EXPECT_EQ(step("set spacing=30mm ease=12mm"), "Fineness of the cloth: 30.0 mm, Ease: 12.0 mm");
  EXPECT_EQ(step("notch edge=p6.edge_0 at=0.25"), "edge 1 of piece 6, Place along the edge: 25.0 %");
  for (const char* line :
       {"draw name=front line=\"torso:waist@0.1; torso:hip@0.1; torso:hip@0.2\"", "cut piece=p1 line=\"0,0; 5cm,5cm\"",
        "pull piece=p1 at=1cm,2cm by=\"0,5cm,0; 0,10cm,1cm\"", "fabric name=loden like=\"wool suiting\" weight=0.3",
        "pin edge=p2.waist", "place piece=p2 at=torso:waist@0 ease=1cm turn=30deg", "unsew seam=s5",
        "piece name=p outline=\"M 0 0; a L 10 0; b L 10 10; c L 0 0\" at=0,1,0"}) {
    const auto operation = parseOperation(line);
    if (!operation) continue;
    for (const Language language : {Language::English, Language::Japanese})
      EXPECT_FALSE(looksLikeAnIdentifier(text(stepSaid(document, *operation), language)))
          << text(stepSaid(document, *operation), language);
  }
}

// A fastening may be called as an edge is, and is none.
TEST(Glossary, AFasteningIsNoEdge) {
  EXPECT_EQ(text(nameSaid("inner")), "inner edge");
  EXPECT_EQ(text(fasteningSaid("inner")), "inner fastening");
  EXPECT_EQ(text(fasteningSaid("outer_2")), "outer fastening 2");
  EXPECT_EQ(text(fasteningSaid("top_left")), "left upper fastening");
  EXPECT_EQ(text(fasteningSaid("buttons")), "buttons");
  EXPECT_EQ(text(fasteningSaid("my_hooks")), "my hooks");
}

}  // namespace
}  // namespace karinui

// Text and operations are exact inverses, for every operation and every kind of value.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

#include "design/workroom.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

// Fills any value with something arbitrary but allowed.
struct Dice {
  std::mt19937_64 engine;
  explicit Dice(std::uint64_t seed) : engine(seed) {}
  std::uint64_t below(std::uint64_t n) { return engine() % n; }
  double real() {
    switch (below(6)) {
      case 0:
        return static_cast<double>(below(2000)) / 1000 - 1;
      case 1:
        return 0;
      case 2:
        return std::ldexp(static_cast<double>(engine() >> 11), -53);
      case 3:
        return -1e-9 * static_cast<double>(below(1000000));
      case 4:
        return std::nextafter(static_cast<double>(below(100)) / 100, 1);
      default:
        return std::ldexp(static_cast<double>(engine() >> 11), static_cast<int>(below(30)) - 70);
    }
  }
  std::string word() {
    static const std::vector<std::string> kWords{"front", "袖", "a", "x_1", "Left-2", "rück"};
    return kWords[below(kWords.size())];
  }
  void fill(std::string& v) { v = below(8) == 0 ? "say \"hi\" \\ #1\n\tx" : below(8) == 0 ? "" : word(); }
  void fill(bool& v) { v = below(2) == 0; }
  void fill(int& v) { v = static_cast<int>(below(20)) - 5; }
  void fill(double& v) { v = real(); }
  void fill(Length& v) { v.metres = real(); }
  void fill(Angle& v) { v.radians = real(); }
  void fill(Flat& v) { v = {real(), real()}; }
  void fill(Vec3& v) { v = {real(), real(), real()}; }
  void fill(Turn& v) { v = {below(2) == 0 ? Vec3{0, 1, 0} : Vec3{real(), 1, real()}, {real()}}; }
  void fill(Rigid& v) {
    v = turnAbout({real(), 1, real()}, below(3) == 0 ? 0 : real());
    fill(v.carry);
  }
  void fill(Stated& v) { v = {"bust_girth", {real()}}; }
  template <class Ref>
  void fillRef(Ref& v) {
    if (below(2) == 0) {
      v.name = word();
    } else {
      v.id = madeBy<decltype(v.id)>(static_cast<std::uint32_t>(1 + below(1000)), static_cast<std::uint32_t>(below(4)));
    }
  }
  void fill(PieceRef& v) { fillRef(v); }
  void fill(SeamRef& v) { fillRef(v); }
  void fill(EdgeRef& v) {
    v = EdgeRef();
    fillRef(v.piece);
    v.edge = "hem";
    if (below(2) == 0) v.from = 0.25, v.to = 1.0 / 3;
  }
  void fill(BodyPoint& v) { v = *parseBodyPoint(below(2) == 0 ? "landmark:neck_left" : "torso:2.5@0.125"); }
  Curve curve(Flat from) {
    Flat a, b, c;
    fill(a), fill(b), fill(c);
    switch (below(4)) {
      case 0:
        return Curve::line(from, a);
      case 1:
        return Curve::cubic(from, a, b, c);
      case 2:
        return Curve::joined(std::vector<Curve>{Curve::cubic(from, a, b, c), Curve::cubic(c, b, from, a)});
      default:
        return Curve::arc(from, a, real());
    }
  }
  void fill(Outline& v) {
    Flat pen;
    fill(pen);
    for (std::size_t i = 0, n = 1 + below(5); i < n; ++i) {
      v.edges.push_back({"e" + std::to_string(i), curve(pen)});
      pen = v.edges.back().curve.end;
    }
  }
  void fill(InternalLine& v) {
    v.name = word();
    Flat pen;
    fill(pen);
    for (std::size_t i = 0, n = 1 + below(3); i < n; ++i) {
      if (below(3) == 0) fill(pen);
      v.curves.push_back(curve(pen));
      pen = v.curves.back().end;
    }
  }
  void fill(Mark& v) {
    v = Mark();
    if (below(2) == 0) v.name = word();
    if (below(2) == 0) {
      v.edge = "hem", v.fraction = real();
    } else {
      fill(v.place);
    }
  }
  void fill(GradePoint& v) {
    v.edge = "hem", v.at = real(), v.by.resize(1 + static_cast<std::size_t>(below(4)));
    for (Flat& by : v.by) fill(by);
  }
  void fill(Sex& v) { v = below(2) == 0 ? Sex::Female : Sex::Male; }
  void fill(Choice& v) { v = static_cast<Choice>(below(3)); }
  void fill(SewEdges::Tie& v) { v = static_cast<SewEdges::Tie>(below(4)); }
  void fill(PleatKind& v) { v = static_cast<PleatKind>(below(3)); }
  void fill(AddPleat::Turned& v) { v = static_cast<AddPleat::Turned>(below(4)); }
  void fill(SetLength::Keep& v) { v = static_cast<SetLength::Keep>(below(4)); }
  void fill(DraftBlock::Worn& value) { value = static_cast<DraftBlock::Worn>(below(4)); }
  void fill(DraftBlock::Kind& value) { value = static_cast<DraftBlock::Kind>(below(6)); }
  void fill(Finish& v) { v = static_cast<Finish>(below(10)); }
  void fill(PrintKind& v) { v = static_cast<PrintKind>(below(5)); }
  void fill(FasteningKind& v) { v = static_cast<FasteningKind>(below(5)); }
  void fill(Fasten::From& v) { v = static_cast<Fasten::From>(below(5)); }
  void fill(Fasten::Holes& v) { v = static_cast<Fasten::Holes>(below(2)); }
  void fill(SewPocket::Kind& v) { v = static_cast<SewPocket::Kind>(below(2)); }
  void fill(SewWelt::Kind& v) { v = static_cast<SewWelt::Kind>(below(2)); }
  void fill(EdgeKind& v) { v = static_cast<EdgeKind>(below(4)); }
  void fill(CornerKind& v) { v = static_cast<CornerKind>(below(6)); }
  void fill(Dye& v) {
    for (std::uint8_t* part : {&v.red, &v.green, &v.blue}) *part = static_cast<std::uint8_t>(below(256));
  }
  void fill(SetLength::Neighbours& v) { v = static_cast<SetLength::Neighbours>(below(2)); }
  void fill(Lengthen::Beside& v) { v = static_cast<Lengthen::Beside>(below(3)); }
  void fill(Fabric::Law& v) { v = static_cast<Fabric::Law>(below(2)); }
  void fill(Settings::Collider& v) { v = static_cast<Settings::Collider>(below(2)); }
  template <class T>
  void fill(std::optional<T>& v) {
    if (below(2) == 0) fill(v.emplace());
  }
  template <class T>
  void fill(std::vector<T>& v) {
    for (std::size_t i = 0, n = below(4); i < n; ++i) fill(v.emplace_back());
  }
  void fill(std::vector<std::string>& v) {
    for (std::size_t i = 0, n = below(4); i < n; ++i) v.push_back(word());
  }
};

template <std::size_t i>
void everyOperationRoundTrips() {
  using Op = std::variant_alternative_t<i, PlainOperation>;
  Dice dice(1000 + i);
  for (int round = 0; round < 200; ++round) {
    Op op;
    Op::fields(op, [&](auto, auto& value, auto, Need need) {
      if (need == kNeeded || dice.below(2) == 0) dice.fill(value);
    });
    const std::string line = text(Operation(op));
    const auto back = parseOperation(line);
    ASSERT_TRUE(back) << line << "\n" << text(back.error().what);
    ASSERT_EQ(*back, Operation(op)) << line;
    ASSERT_EQ(text(*back), line);
  }
  if constexpr (i + 1 < std::variant_size_v<PlainOperation>) everyOperationRoundTrips<i + 1>();
}

TEST(OperationText, IsTheExactInverseOfReadingForEveryOperation) { everyOperationRoundTrips<0>(); }

TEST(OperationText, TakesTheSpellingsPeopleWrite) {
  const auto canonical = [](std::string_view line) {
    const auto op = parseOperation(line);
    return op ? text(*op) : text(op.error().what);
  };
  EXPECT_EQ(canonical("sew a=\"front.armhole_l back.armhole_l\" b=sleeve.cap"),
            "sew a=\"front.armhole_l; back.armhole_l\" b=sleeve.cap");
  EXPECT_EQ(canonical("cut piece=sleeve line=\"10mm,0 1cm, 80mm\""), "cut piece=sleeve line=\"10mm,0; 10mm,80mm\"");
  EXPECT_EQ(canonical("  drape   live=sleeve   # only that one"), "drape live=sleeve");
  EXPECT_EQ(canonical("body size=eu38 set=\"bust_girth = 88cm; waist_girth=0.7\""),
            "body size=eu38 set=\"bust_girth=880mm; waist_girth=700mm\"");
  EXPECT_EQ(canonical("pull piece=p3.2 at=\"12cm,3cm\" by=\"0,5cm,10cm; 0,2in,15cm\" let_go=no"),
            "pull piece=p3.2 at=120mm,30mm by=\"0,50mm,100mm; 0,50.8mm,150mm\" let_go=no");
  EXPECT_EQ(canonical("unsew seam=s5"), "unsew seam=s5");
}

// The shortest length that is the same number is told; what cannot be told shorter stays.
TEST(OperationText, ShortLengthsAreTheSameNumbers) {
  const auto given = parseOperation("rectangle name=a_93.26 width=93.26mm height=55.1mm");
  ASSERT_TRUE(given);
  EXPECT_THAT(text(*given), testing::HasSubstr("0000000")) << "the noise that is kept out";
  const std::string shortly = withShortLengths(text(*given));
  EXPECT_THAT(shortly, testing::HasSubstr("width=93.26mm"));
  EXPECT_EQ(*parseOperation(shortly), *given);
  std::mt19937_64 random(5);
  int shorter = 0;
  for (int n = 0; n < 4000; ++n) {
    MovePiece move;
    move.pieces = {PieceRef{"a"}};
    const auto any = [&]() -> double {
      const double whole = static_cast<double>(static_cast<std::int64_t>(random() % 4'000'001) - 2'000'000);
      return n % 4 == 0 ? whole * 1.0000000001e-7 : n % 4 == 1 ? whole / 100 / 1000 : whole / 100 / 100;
    };
    move.by = {any(), any(), any()};
    const Operation operation(move);
    const std::string all = text(operation), less = withShortLengths(all);
    EXPECT_LE(less.size(), all.size());
    shorter += less.size() < all.size();
    const auto again = parseOperation(less);
    ASSERT_TRUE(again) << less;
    ASSERT_EQ(*again, operation) << all << " as " << less;
  }
  EXPECT_GT(shorter, 500);
  EXPECT_EQ(withShortLengths("a1.50000000000000000mm 12.34567890123456mmx"),
            "a1.50000000000000000mm 12.34567890123456mmx");
}

TEST(OperationText, SaysWhatIsWrong) {
  const auto wrong = [](std::string_view line) {
    const auto op = parseOperation(line);
    return op ? "accepted: " + text(*op) : text(op.error().what);
  };
  EXPECT_THAT(wrong("stitch a=b"), HasSubstr("There is no operation “stitch”"));
  EXPECT_THAT(wrong("cut line=\"0,0 1cm,1cm\""), HasSubstr("“cut” needs piece"));
  EXPECT_THAT(wrong("cut piece=a line=\"0,0 1cm\""), HasSubstr("not a place on paper"));
  EXPECT_THAT(wrong("cut piece=a line=\"0,nan\""), HasSubstr("not a length"));
  EXPECT_THAT(wrong("cut piece=a line=0,0 colour=red"), HasSubstr("knows no colour="));
  EXPECT_THAT(wrong("cut piece=a piece=b line=0,0"), HasSubstr("given twice"));
  EXPECT_THAT(wrong("cut piece=\"a line=0,0"), HasSubstr("never closed"));
  EXPECT_THAT(wrong("sew front back"), HasSubstr("stands alone"));
  EXPECT_THAT(wrong("sew a=front b=back.x"), HasSubstr("not an edge"));
  EXPECT_THAT(wrong("piece name=a outline=\"L 0 0\""), HasSubstr("begins with “M u v”"));
  EXPECT_THAT(wrong(""), HasSubstr("no operation on this line"));
  EXPECT_THAT(wrong("blok kind=skirt"), testing::EndsWith("near names: block."));
  EXPECT_THAT(wrong("quilt piece=a"), HasSubstr("there are: body, "));
}

TEST(Text, ALengthWithoutAUnitIsNotTakenForMetres) {
  const auto wrong = [](std::string_view line) {
    const auto read = parseOperation(line);
    return read ? "read: " + text(*read) : text(read.error().what);
  };
  const std::string fault = "“10” has no unit and would be 10 metres; write 10cm or 10mm, or 10m if it is meant.";
  EXPECT_EQ(wrong("rectangle name=r width=10 height=5cm"), fault);
  EXPECT_EQ(wrong("cut piece=a line=\"0,0 1cm,10\""), fault);
  EXPECT_EQ(wrong("move piece=a by=0,10,0"), fault);
  EXPECT_EQ(wrong("body size=eu38 set=\"waist_girth=66cm bust_girth=10\""), fault);
  EXPECT_THAT(wrong("rectangle name=r width=-2.5 height=5cm"), HasSubstr("write -2.5cm or -2.5mm"));
  for (const char* right :
       {"rectangle name=r width=0.4 height=1.99", "rectangle name=r width=10m height=5cm",
        "rectangle name=r width=\"bust_girth/4 + 20cm\" height=\"3 * 5cm\"", "move piece=a by=0,0,0.5",
        "body size=eu38 set=\"bust_girth=88cm; waist_girth=bust_girth - 20cm\"", "body size=eu38 set=bust_girth=0.88"})
    EXPECT_TRUE(parseOperation(right)) << wrong(right);
  // What is written without a unit, because millimetres would not read back as the same number, is read.
  int bare = 0;
  for (double metres = 2; metres < 12; metres = std::nextafter(metres * 1.001, 100)) {
    MovePiece move;
    move.by = {0, metres, 0};
    const std::string line = text(Operation(move));
    bare += line.find("mm") == std::string::npos;
    const auto read = parseOperation(line);
    ASSERT_TRUE(read) << line;
    EXPECT_EQ(text(*read), line);
  }
  EXPECT_GT(bare, 0);
}

TEST(Script, ContinuesLinesSkipsCommentsAndNamesTheLineOfAnError) {
  const auto script =
      parseScript("# a shirt\n\nbody size=jis9ar\r\nsew a=front.side_left \\\n  b=back.side_left\n  # end\n");
  ASSERT_TRUE(script) << text(script.error().what);
  ASSERT_EQ(script->size(), 2u);
  EXPECT_EQ((*script)[1].number, 4);
  const auto wrong = parseScript("body size=jis9ar\n\nsew a=front.x \\\n b=nothing\n");
  ASSERT_FALSE(wrong);
  EXPECT_THAT(text(wrong.error().what), HasSubstr("Line 3: "));
  EXPECT_FALSE(parseScript(std::string_view("body\0size", 9)));
}

TEST(Script, SurvivesArbitraryBytes) {
  Dice dice(7);
  const std::string good =
      "piece name=front outline=\"M 0 0; hem L 400 0; side C 400 500 1 2 3 4\" at=\"1,2\" \\\n# x\nsew a=f.x b=g.y";
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = good;
    for (std::size_t i = 0, n = 1 + dice.below(8); i < n; ++i)
      bytes[dice.below(bytes.size())] = static_cast<char>(dice.below(256));
    bytes.resize(dice.below(bytes.size() + 1));
    if (const auto script = parseScript(bytes)) {
      for (const ScriptLine& line : *script)
        EXPECT_EQ(text(*parseOperation(text(line.operation))), text(line.operation));
    }
  }
}

// docs/format/operations.md tells of every operation and field, in the words of the code.
TEST(Manual, TellsOfEveryOperationAndField) {
  std::ifstream file(std::string(KARINUI_SOURCE_DIR) + "/docs/format/operations.md");
  std::stringstream manual;
  manual << file.rdbuf();
  for (const OperationHelp& op : operationHelp()) {
    EXPECT_THAT(manual.str(), HasSubstr("### " + op.name + "\n\n" + op.help + "\n"));
    for (const FieldHelp& field : op.fields) {
      const std::string kind = field.needed ? field.kind + ", needed" : field.kind;
      EXPECT_THAT(manual.str(), HasSubstr("- `" + field.name + "` (" + kind + "): " + field.help + "\n")) << op.name;
    }
  }
}

// What a kind of fastening has is told with its help, as the operation itself decides.
TEST(OperationHelp, TellsWhichKindsHaveAField) {
  const auto all = operationHelp();
  const auto help = std::find_if(all.begin(), all.end(), [](const OperationHelp& one) { return one.name == "fasten"; });
  ASSERT_NE(help, all.end());
  EXPECT_EQ(help->kindField, "kind");
  const auto kinds = [&](std::string_view field) {
    for (const FieldHelp& one : help->fields)
      if (one.name == field) return one.kinds;
    return std::vector<std::string>{"no such field"};
  };
  EXPECT_EQ(kinds("length"), std::vector<std::string>{"zip"});
  EXPECT_EQ(kinds("count"), (std::vector<std::string>{"button", "snap", "hook", "tie"}));
  EXPECT_EQ(kinds("size"), (std::vector<std::string>{"button", "snap"}));
  EXPECT_EQ(kinds("holes"), std::vector<std::string>{"button"});
  EXPECT_EQ(kinds("gap"), std::vector<std::string>{"tie"});
  EXPECT_TRUE(kinds("first").empty()) << "all have it";
  EXPECT_TRUE(kinds("a").empty());
}

}  // namespace
}  // namespace karinui

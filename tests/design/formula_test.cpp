// Formulas: read and written exactly, worked out with dimensions, refused in sentences.
#include "karinui/design/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "design/workroom.h"

namespace karinui {
namespace {

using ::testing::HasSubstr;

struct Fixed : FormulaNames {
  std::map<std::string, Quantity> values;
  Result<Quantity> named(const std::string& name) override {
    const auto at = values.find(name);
    if (at == values.end()) return refused(say("There is no variable “{0}”.", name));
    return at->second;
  }
  Result<double> edgeLength(const EdgeRef&, bool mirrored) override { return mirrored ? 0.5 : 0.25; }
};

Fixed someNames() {
  Fixed names;
  names.values = {{"bust", {0.88, kLength}}, {"slope", {0.4, kAngle}}, {"n", {3, kPlainNumber}}};
  return names;
}

std::string sentenceOf(std::string_view formula) {
  const auto read = Formula::parse(formula);
  if (!read) return text(read.error().what);
  Fixed names = someNames();
  const auto value = evaluate(*read, names);
  return value ? "fine" : text(value.error().what);
}

Quantity valueOf(std::string_view formula) {
  Fixed names = someNames();
  const auto read = Formula::parse(formula);
  if (!read) return ADD_FAILURE() << formula << ": " << text(read.error().what), Quantity{NAN, {}};
  const auto value = evaluate(*read, names);
  if (!value) return ADD_FAILURE() << formula << ": " << text(value.error().what), Quantity{NAN, {}};
  return *value;
}

TEST(Formula, UnitsAndDimensions) {
  EXPECT_EQ(valueOf("bust/4 + 1.5cm"), (Quantity{0.88 / 4 + 1.5 / 100, kLength}));
  EXPECT_EQ(valueOf("1.5 cm"), (Quantity{1.5 / 100, kLength}));
  EXPECT_EQ(valueOf("30deg"), (Quantity{30 / (180 / std::numbers::pi), kAngle}));
  EXPECT_EQ(valueOf("sin(30°)").dimension, kPlainNumber);
  EXPECT_NEAR(valueOf("sin(30°)").value, 0.5, 1e-15);
  EXPECT_NEAR(valueOf("atan(3cm/4cm)").value, std::atan(0.75), 1e-15);
  EXPECT_EQ(valueOf("atan(3cm/4cm)").dimension, kAngle);
  EXPECT_NEAR(valueOf("sqrt((5cm)^2 - (3cm)^2)").value, 0.04, 1e-15);
  EXPECT_EQ(valueOf("sqrt((5cm)^2 - (3cm)^2)").dimension, kLength);
  EXPECT_NEAR(valueOf("bust*5%").value, 0.044, 1e-15);
  EXPECT_NEAR(valueOf("round(bust/7, 5mm)").value, 0.125, 1e-15);
  EXPECT_EQ(valueOf("max(1cm, 2cm, 3cm) - min(1cm, 2cm)").value, 0.03 - 0.01);
  EXPECT_EQ(valueOf("-2^2").value, -4);
  EXPECT_EQ(valueOf("2^3^2").value, 512);
  EXPECT_EQ(valueOf("front.side + [left-front.side@0:0.5] + mirror(front.side)").value, 1.0);
  EXPECT_EQ(valueOf("bust × 2 ÷ 4 − 1cm").value, 0.88 * 2 / 4 - 1.0 / 100);
}

TEST(Formula, TakesDigitsOfFullWidth) {
  EXPECT_EQ(valueOf("bust／４＋１．５ｃｍ"), valueOf("bust/4+1.5cm"));
  EXPECT_EQ(valueOf("（９５ｃｍ＋５cm）＊２"), valueOf("(95cm+5cm)*2"));
}

TEST(Formula, TakesInchesWithAFraction) {
  EXPECT_EQ(valueOf("27 1/2in - 1 in"), (Quantity{27.5 * 0.0254 - 0.0254, kLength}));
  EXPECT_NEAR(valueOf("bust/4 + 1 3/8\"").value, 0.22 + 1.375 * 0.0254, 1e-15);
  EXPECT_EQ(Formula::parse("bust + 1 3/8″")->text(), "bust + 1.375in");
  for (const char* bad : {"27 1/2", "27 1/2cm", "27 3/2in", "bust 1/2in"})
    EXPECT_THAT(sentenceOf(bad), HasSubstr("cannot go on with")) << bad;
}

TEST(Formula, RefusalsQuoteThePart) {
  EXPECT_THAT(sentenceOf("bust/4 + 1.5"), HasSubstr("“bust/4” is a length and “1.5” is a plain number"));
  EXPECT_THAT(sentenceOf("sin(30)"), HasSubstr("sin() wants an angle, and “30” is a plain number"));
  EXPECT_THAT(sentenceOf("bust + slope"), HasSubstr("is an angle"));
  EXPECT_THAT(sentenceOf("bust/(n - 3)"), HasSubstr("“n - 3” is zero"));
  EXPECT_THAT(sentenceOf("sqrt(bust)"), HasSubstr("no square root"));
  EXPECT_THAT(sentenceOf("sqrt(0 - 4)"), HasSubstr("“sqrt(0 - 4)” has no value"));
  EXPECT_THAT(sentenceOf("bust^0.5"), HasSubstr("whole powers"));
  EXPECT_THAT(sentenceOf("2^bust"), HasSubstr("plain number"));
  EXPECT_THAT(sentenceOf("bust/4 +"), HasSubstr("ends too soon"));
  EXPECT_THAT(sentenceOf("bust 4"), HasSubstr("cannot go on with “4”"));
  EXPECT_THAT(sentenceOf("3 ells"), HasSubstr("“ells” is no unit"));
  EXPECT_THAT(sentenceOf("sine(3)"), HasSubstr("no function “sine”"));
  EXPECT_THAT(sentenceOf("hypot(1cm)"), HasSubstr("wants 2 values"));
  EXPECT_THAT(sentenceOf("mirror(bust)"), HasSubstr("wants one edge"));
  EXPECT_THAT(sentenceOf("(bust"), HasSubstr("ends too soon"));
  EXPECT_THAT(sentenceOf(""), HasSubstr("ends too soon"));
  EXPECT_THAT(sentenceOf("waste + 1cm"), HasSubstr("waste"));
  EXPECT_THAT(sentenceOf(std::string(3000, '(') + "1"), HasSubstr("too long"));
  EXPECT_THAT(sentenceOf(std::string(300, '(') + "1" + std::string(300, ')')), HasSubstr("too deep"));
  EXPECT_THAT(sentenceOf(std::string(300, '-') + "1"), HasSubstr("too deep"));
  EXPECT_THAT(sentenceOf("1cm*1cm*1cm*1cm*1cm*1cm*1cm*1cm*1cm"), HasSubstr("Too many lengths"));
}

// A random formula as text with more brackets than needed, and its value reckoned beside by the tree itself.
struct Grown {
  std::string text;
  double value = 0;
};
struct Garden {
  std::mt19937_64 engine;
  int below(int n) { return static_cast<int>(engine() % static_cast<std::uint64_t>(n)); }
  std::string blank() { return below(3) == 0 ? " " : ""; }
  // Of lengths: every operand is a length, every factor a plain number.
  Grown plain(int depth) {
    if (depth == 0 || below(3) == 0) {
      const double number = below(2) == 0 ? below(9) + 1 : (below(1000) + 1) / 8.0;
      if (below(4) == 0) return {"n", 3};
      return {std::to_string(number), number};
    }
    const Grown a = plain(depth - 1), b = plain(depth - 1);
    switch (below(5)) {
      case 0:
        return {"(" + a.text + blank() + "+" + blank() + b.text + ")", a.value + b.value};
      case 1:
        return {"(" + a.text + "*" + b.text + ")", a.value * b.value};
      case 2:
        return {"(-" + a.text + ")", -a.value};
      case 3:
        return {"max(" + a.text + "," + blank() + b.text + ")", std::max(a.value, b.value)};
      default:
        return {"(" + a.text + " - " + b.text + ")", a.value - b.value};
    }
  }
  Grown length(int depth) {
    if (depth == 0 || below(4) == 0) {
      const int which = below(4);
      if (which == 0) return {"bust", 0.88};
      if (which == 1) return {"p3.side_left", 0.25};
      const int mm = below(500) + 1;
      if (which == 2) return {std::to_string(mm) + "mm", mm / 1000.0};
      return {std::to_string(mm) + blank() + "cm", mm / 100.0};
    }
    const Grown a = length(depth - 1);
    if (const int which = below(5); which == 0) {
      const Grown f = plain(depth - 1);
      return {"(" + a.text + blank() + "*" + blank() + f.text + ")", a.value * f.value};
    } else if (which == 1) {
      const int f = below(9) + 1;
      return {"(" + a.text + "/" + std::to_string(f) + ")", a.value / f};
    } else if (which == 2) {
      return {"abs(" + a.text + ")", std::fabs(a.value)};
    } else {
      const Grown b = length(depth - 1);
      if (which == 3) return {"(" + a.text + "-" + b.text + ")", a.value - b.value};
      return {"((" + a.text + ")+" + blank() + b.text + ")", a.value + b.value};
    }
  }
};

TEST(Formula, WrittenAndReadBackIsTheSameAndWorthTheSame) {
  Garden garden{std::mt19937_64(7)};
  Fixed names = someNames();
  for (int i = 0; i < soak(3000); ++i) {
    const Grown grown = garden.length(5);
    if (grown.text.size() > 900) continue;
    const auto read = Formula::parse(grown.text);
    ASSERT_TRUE(read) << grown.text << ": " << text(read.error().what);
    const auto again = Formula::parse(read->text());
    ASSERT_TRUE(again) << read->text();
    ASSERT_EQ(*again, *read) << grown.text << " became " << read->text();
    ASSERT_EQ(again->text(), read->text());
    const auto value = evaluate(*read, names);
    ASSERT_TRUE(value) << grown.text << ": " << text(value.error().what);
    ASSERT_EQ(value->value, grown.value) << grown.text;  // bit for bit: the same sums in the same order
    ASSERT_EQ(value->dimension, kLength);
  }
}

TEST(Formula, AnyTextIsReadOrRefusedAndReadTextIsAFixedPoint) {
  static const std::vector<std::string> kScraps{"1", "2.5", "cm", "deg", "bust", "+", "-",       "*", "/",  "^",
                                                "(", ")",   ",",  "sin", "max(", "[", "]",       ".", "@",  "p3.e1",
                                                " ", "1e5", "°",  "×",   "\x80", "%", "mirror(", ":", "袖", "\0"};
  std::mt19937_64 dice(11);
  Fixed names = someNames();
  int read = 0;
  for (int i = 0; i < soak(20000); ++i) {
    std::string scrap;
    for (std::uint64_t n = dice() % 12; n > 0; --n) scrap += kScraps[dice() % kScraps.size()];
    const auto formula = Formula::parse(scrap);
    if (!formula) {
      EXPECT_FALSE(text(formula.error().what).empty());
      continue;
    }
    ++read;
    const auto again = Formula::parse(formula->text());
    ASSERT_TRUE(again) << scrap << " became " << formula->text();
    ASSERT_EQ(*again, *formula) << scrap;
    (void)evaluate(*formula, names);
  }
  EXPECT_GT(read, 300);
}

// --- in a garment

const char* const kDrafted =
    "body size=eu38 set=\"height=1.68; hip=bust_girth + 9cm\"\n"
    "variable name=ease value=4cm\n"
    "variable name=quarter value=\"(bust + ease)/4\"\n"
    "piece name=front outline=\"M 0 0; hem L (quarter) 0; side_left L (quarter) 500; neck L 0 500; side_right L 0 0\"\n"
    "piece name=back outline=\"M 0 0; hem L 300 0; side_left L 300 450; neck L 0 450; side_right L 0 0\"\n"
    "length edge=front.hem to=\"back.hem - quarter/10 + 2cm\" symmetric=no keep=start\n";

double edgeOf(const Document& document, std::string_view piece, std::string_view edge) {
  const Piece* own = document.pieceNamed(piece);
  return own->outline.edges[*own->outline.find(edge)].curve.length();
}

std::string refusalOf(Workroom& room, DocumentFile& file, const std::string& line) {
  const std::string before = hash(file.document());
  const auto operation = parseOperation(line);
  if (!operation) return text(operation.error().what);
  const auto step = file.perform(*operation, room.context);
  EXPECT_EQ(hash(file.document()), before) << line;
  return step ? "done" : text(step.error().what);
}

TEST(FormulaInAGarment, IsKeptAndWorkedOutAnewOnAnotherFigure) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  Done played = room.play(file, kDrafted);
  ASSERT_TRUE(played) << text(played.error().what);
  const double quarter = (0.88 + 0.04) / 4;
  EXPECT_NEAR(file.document().body.measurements.value.at("hip_girth"), 0.97, 1e-12);
  EXPECT_NEAR(edgeOf(file.document(), "front", "neck"), quarter, 1e-12);
  EXPECT_NEAR(edgeOf(file.document(), "front", "hem"), 0.3 - quarter / 10 + 0.02, 1e-9);
  // What is recorded names the edge by its id and keeps the formula.
  EXPECT_EQ(text(file.steps().back().operation).substr(0, 57),
            "length edge=p4.hem to=\"p5.hem - quarter/10 + 2cm\" keep=st");
  // Another figure: the steps' text is the same, the garment is not.
  const std::string was = file.log();
  auto larger = parseOperation("body size=eu38 set=\"height=1.68; bust=1; hip=bust_girth + 9cm\"");
  ASSERT_TRUE(larger);
  ASSERT_TRUE(file.amend(1, *larger, room.context));
  EXPECT_NEAR(edgeOf(file.document(), "front", "neck"), 0.26, 1e-12);
  EXPECT_NEAR(edgeOf(file.document(), "front", "hem"), 0.3 - 0.026 + 0.02, 1e-9);
  EXPECT_NEAR(file.document().body.measurements.value.at("hip_girth"), 1.09, 1e-12);
  EXPECT_EQ(file.log().substr(file.log().find('\n')), was.substr(was.find('\n')));
  // Another value of a variable, where it was given: everything after follows.
  ASSERT_TRUE(file.amend(2, *parseOperation("variable name=ease value=8cm"), room.context));
  EXPECT_NEAR(edgeOf(file.document(), "front", "neck"), 0.27, 1e-12);
}

TEST(FormulaInAGarment, TextIsTheInverseAndReplaysToTheSameBits) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kDrafted));
  std::vector<Operation> again;
  for (const Step& step : file.steps()) {
    auto read = parseOperation(text(step.operation));
    ASSERT_TRUE(read) << text(step.operation);
    EXPECT_EQ(*read, step.operation);
    EXPECT_EQ(text(*read), text(step.operation));
    again.push_back(*std::move(read));
  }
  const auto document = replayed(again, room.context);
  ASSERT_TRUE(document);
  EXPECT_EQ(hash(*document), hash(file.document()));
  EXPECT_EQ(document->variables, file.document().variables);
  Document other = *document;
  other.variables["ease"] = "5cm";
  EXPECT_NE(hash(other), hash(*document));
}

TEST(FormulaInAGarment, InchesWithAFractionAreNumbers) {
  const auto recorded = [](const char* line) {
    const auto read = parseOperation(line);
    return read ? text(*read) : text(read.error().what);
  };
  EXPECT_EQ(recorded("polygon name=c points=\"0,0; 10 1/2in,0; 10 1/2in,8-1/4in\""),
            recorded("polygon name=c points=\"0,0; 10.5in,0; 10.5in,8.25in\""));
  EXPECT_EQ(recorded("rectangle name=a width=\"27 1/2in\" height=1/2in"),
            recorded("rectangle name=a width=27.5in height=0.5in"));
  EXPECT_EQ(recorded("body size=eu38 set=\"bust=34 1/2in; waist=27-1/2in\""),
            recorded("body size=eu38 set=\"bust=34.5in; waist=27.5in\""));
  EXPECT_THAT(recorded("body size=eu38 set=\"bust=34 1/2\""), HasSubstr("34"));
}

TEST(FormulaInAGarment, StaysInItsFile) {
  const auto path = std::filesystem::temp_directory_path() / "karinui_formula_test.karinui";
  std::filesystem::remove(path);
  Workroom room;
  std::string kept;
  {
    auto file = DocumentFile::create(path);
    ASSERT_TRUE(file);
    ASSERT_TRUE(room.play(*file, kDrafted));
    kept = hash(file->document());
  }
  auto file = DocumentFile::open(path, &room.context);
  ASSERT_TRUE(file) << text(file.error().what);
  EXPECT_EQ(hash(file->document()), kept);
  EXPECT_EQ(file->document().variables.at("quarter"), "(bust_girth + ease)/4");
  ASSERT_TRUE(room.play(*file, "length edge=back.neck to=quarter symmetric=no\n"));
  EXPECT_NEAR(edgeOf(file->document(), "back", "neck"), 0.23, 1e-9);
  std::filesystem::remove(path);
}

// What a window hands over was never text; the record must read back as itself all the same.
TEST(FormulaInAGarment, FormulasTypedAnyhowAreRecordedInCanonicalForm) {
  const auto path = std::filesystem::temp_directory_path() / "karinui_formula_typed.karinui";
  std::filesystem::remove(path);
  Workroom room;
  {
    auto file = DocumentFile::create(path);
    ASSERT_TRUE(file);
    SetBody body;
    body.size = "eu38";
    body.set = {{"hip_girth", {}, "bust+( 9cm )"}};
    ASSERT_TRUE(file->perform(body, room.context));
    EXPECT_EQ(text(file->steps().back().operation), "body size=eu38 set=\"hip_girth=bust_girth + 9cm\"");
    ASSERT_TRUE(room.play(*file, kTwoPieces));
    Operation length = *parseOperation("length edge=front.hem to=1cm symmetric=no");
    length.formulas = {{"to", "( bust )/4+1cm"}};
    ASSERT_TRUE(file->perform(length, room.context));
    EXPECT_THAT(text(file->steps().back().operation), HasSubstr("to=\"bust_girth/4 + 1cm\""));
    SetVariable half;
    half.name = "half";
    half.value = "バスト囲 ÷ 2";
    ASSERT_TRUE(file->perform(half, room.context));
    EXPECT_EQ(file->document().variables.at("half"), "bust_girth/2");
  }
  const auto file = DocumentFile::open(path, &room.context);
  EXPECT_TRUE(file) << text(file.error().what);
  std::filesystem::remove(path);
}

TEST(FormulaInAGarment, EdgesAreLinked) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const Done played =
      room.play(file, std::string(kTwoPieces) +
                          "mirror piece=back name=other\n"
                          "length edge=front.side_left to=\"back.neck + back.hem/8\" symmetric=no\n"
                          "length edge=front.hem to=\"mirror(back.side_right) - 2cm\" symmetric=no\n"
                          "length edge=front.side_right to=\"[p2.side_right@0:0.5]\" symmetric=no\n"
                          "notch edge=front.side_left at=\"7cm/front.side_left\"\n"
                          "dart edge=front.hem tip=\"front.hem/2,p2.side_right/2\" width=\"1cm + 5mm\"\n");
  ASSERT_TRUE(played) << text(played.error().what);
  const Document& d = file.document();
  EXPECT_NEAR(edgeOf(d, "front", "side_left"), 0.45, 1e-9);
  EXPECT_NEAR(edgeOf(d, "front", "hem") + edgeOf(d, "front", "hem_2"), 0.48 - 0.015, 5e-4)
      << "parted, no link holds it";
  EXPECT_FALSE(d.variables.contains("p1.hem"));
  EXPECT_TRUE(d.variables.contains("p1.side_left"));
  EXPECT_NEAR(edgeOf(d, "front", "side_right"), 0.25, 1e-9);
  EXPECT_NEAR(d.pieceNamed("front")->marks.at(0).fraction, 0.07 / 0.45, 1e-9);
}

// An edge that was made as long as another follows it in later steps, through any number of links, until its length is
// given by a plain number.
TEST(FormulaInAGarment, ALinkedEdgeIsPulledByLaterSteps) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  std::vector<std::string> told;
  room.context.advise = [&](const Advice& advice) { told.push_back(text(advice.what)); };
  ASSERT_TRUE(room.play(file, std::string(kTwoPieces) +
                                  "variable name=side value=\"front.side_left - 2cm\"\n"
                                  "length edge=back.side_right to=side symmetric=no\n"
                                  "length edge=back.hem to=\"back.side_right/2\" symmetric=no\n"));
  const auto is = [&](const char* piece, const char* edge) { return edgeOf(file.document(), piece, edge); };
  EXPECT_NEAR(is("back", "side_right"), 0.48, 1e-7);
  ASSERT_TRUE(room.play(file, "length edge=front.side_left to=56cm symmetric=no\n"));
  EXPECT_NEAR(is("back", "side_right"), 0.54, 1e-7) << "the edge it is linked to was given a length";
  EXPECT_NEAR(is("back", "hem"), 0.27, 1e-7) << "and what is linked to that";
  EXPECT_TRUE(file.document().drape.dirty.contains(file.document().pieceNamed("back")->id));
  // Its edge is gone: the link too, and that is told where there is an edge to tell of.
  told.clear();
  ASSERT_TRUE(room.play(file, "remove piece=front\n"));
  EXPECT_NEAR(is("back", "side_right"), 0.54, 1e-7);
  EXPECT_THAT(told, ::testing::Contains(HasSubstr("not linked any more")));
  const std::string kept = hash(file.document());
  std::vector<Operation> again;
  for (const Step& step : file.steps()) again.push_back(step.operation);
  const auto replay = replayed(again, room.context);
  ASSERT_TRUE(replay);
  EXPECT_EQ(hash(*replay), kept);
}

TEST(FormulaInAGarment, ALinkIsUndoneByANumberAndKeptThroughANewName) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  const auto is = [&](const char* piece, const char* edge) { return edgeOf(file.document(), piece, edge); };
  ASSERT_TRUE(room.play(file, std::string(kTwoPieces) +
                                  "length edge=back.side_left to=front.side_left symmetric=no\n"
                                  "rename edge=front.side_left to=seite\nrename edge=back.side_left to=flanke\n"
                                  "length edge=front.seite to=45cm symmetric=no\n"));
  EXPECT_NEAR(is("back", "flanke"), 0.45, 1e-7);
  EXPECT_THAT(refusalOf(room, file, "length edge=front.seite to=back.flanke symmetric=no"), HasSubstr("in a circle"));
  // Once, of itself: no link.
  ASSERT_TRUE(room.play(file, "length edge=front.seite to=\"front.seite*1.2\" symmetric=no\n"));
  EXPECT_NEAR(is("front", "seite"), 0.54, 1e-7);
  EXPECT_NEAR(is("back", "flanke"), 0.54, 1e-7);
  ASSERT_TRUE(room.play(file,
                        "length edge=back.flanke to=40cm symmetric=no\n"
                        "length edge=front.seite to=50cm symmetric=no\n"));
  EXPECT_NEAR(is("back", "flanke"), 0.40, 1e-7) << "a plain number ends the link";
  EXPECT_TRUE(file.document().variables.empty());
}

TEST(FormulaInAGarment, RefusalsSayWhy) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, kDrafted));
  const auto said = [&](const std::string& line) { return refusalOf(room, file, line); };
  EXPECT_THAT(said("variable name=ease value=\"quarter + 1cm\""), HasSubstr("ease → quarter → ease"));
  EXPECT_THAT(said("variable name=ease value=\"ease + 1cm\""), HasSubstr("ease → ease"));
  EXPECT_THAT(said("variable name=b value=\"a + 1cm\""),
              HasSubstr("There is no variable “a”; there are: ease, quarter"));
  EXPECT_THAT(said("variable name=bust value=1cm"), HasSubstr("is the measure bust_girth"));
  EXPECT_THAT(said("variable name=sin value=1cm"), HasSubstr("means something else"));
  EXPECT_THAT(said("variable name=cm value=1cm"), HasSubstr("means something else"));
  EXPECT_THAT(said("variable name=2a value=1cm"), HasSubstr("cannot name a variable"));
  EXPECT_THAT(said("variable name=ease remove=yes"), HasSubstr("is used by quarter"));
  EXPECT_THAT(said("variable name=x remove=yes"), HasSubstr("no variable “x”"));
  EXPECT_THAT(said("variable name=x value=\"nowhere.hem\""), HasSubstr("There is no piece “nowhere”"));
  EXPECT_THAT(said("length edge=front.hem to=\"bust/ease\""), HasSubstr("is a plain number; here goes a length"));
  EXPECT_THAT(said("length edge=front.hem to=\"bust/4 + 2\""), HasSubstr("they do not go together"));
  EXPECT_THAT(said("length edge=front.hem to=wast_girth"), HasSubstr("waist_girth"));
  EXPECT_THAT(said("place piece=front at=torso:waist@0 turn=\"quarter\""), HasSubstr("here goes an angle"));
  EXPECT_THAT(said("body size=eu38 set=\"waist=hip - 20cm; hip=waist + 20cm\""),
              HasSubstr("waist_girth → hip_girth → waist_girth"));
  EXPECT_THAT(said("body size=eu38 set=\"waist=neck_girth*2\""), HasSubstr("neck_girth is not typed for this figure"));
  EXPECT_THAT(said("layer piece=front layer=\"1 + 1\""), HasSubstr("not a whole number"));
  ASSERT_TRUE(
      room.play(file, "piece name=lone outline=\"M 0 0; low L 300 0; long L 300 500; top L 0 400; short L 0 0\"\n"));
  EXPECT_THAT(said("length edge=front.hem to=\"mirror(lone.long)\""), HasSubstr("has no mirror image"));
  EXPECT_THAT(said("length edge=front.hem to=12xm"), HasSubstr("not a length"));
}

TEST(FormulaInAGarment, ManyVariablesAreWorkedOutOnceEach) {
  Workroom room;
  DocumentFile file = DocumentFile::inMemory();
  ASSERT_TRUE(room.play(file, "variable name=v0 value=1mm\n"));
  std::string trouble;
  int made = 0;
  for (int i = 1; i < 200 && trouble.empty(); ++i) {  // 2^n sums, were they worked out one by one
    const std::string before = "v" + std::to_string(i - 1);
    auto step = file.perform(
        *parseOperation("variable name=v" + std::to_string(i) + " value=\"(" + before + " + " + before + ")/2\""),
        room.context);
    if (step)
      ++made;
    else
      trouble = text(step.error().what);
  }
  EXPECT_EQ(made, 99);
  EXPECT_THAT(trouble, HasSubstr("in a row"));
}

}  // namespace
}  // namespace karinui

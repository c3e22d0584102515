// What programs of the trade do to DXF files, each in a small file of our own: it is read as meant, or refused with a
// sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "exchange/dxf_made.h"
#include "karinui/pattern/markings.h"

namespace karinui {
namespace {

using test::only;
using test::told;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using Made = test::DxfMade;

const std::vector<Flat> kPanel = {{0, 0}, {300, 0}, {280, 400}, {0, 400}};  // 0.116 m2
constexpr double kPanelArea = 0.116;

CadPattern readHabit(const std::string& bytes, std::string_view size = {}) {
  auto all = readCadPattern(bytes, size);
  EXPECT_TRUE(all) << (all ? "" : text(all.error().what));
  return all ? *std::move(all) : CadPattern();
}
std::string why(const std::string& bytes) {
  const auto all = readCadPattern(bytes);
  return all ? std::string("read") : text(all.error().what);
}
std::string replaced(std::string all, const std::string& what, const std::string& by) {
  for (auto at = all.find(what); at != std::string::npos; at = all.find(what, at + by.size()))
    all.replace(at, what.size(), by);
  return all;
}
std::string cadPanel(const std::string& more = {}) {
  Made made;
  made.block("FRONT_38").says("Piece Name: FRONT").says("Size: 38").line(1, kPanel, true).add(more);
  return made.endBlock().done();
}
// One line of a kind of entity, on layer 1 or another.
std::string entity(const std::string& kind, int layer, const std::string& groups) {
  return "0\n" + kind + "\n8\n" + std::to_string(layer) + "\n" + groups;
}
std::string pairs(std::initializer_list<std::pair<int, double>> groups) {
  std::string all;
  for (const auto& [code, value] : groups) all += std::to_string(code) + "\n" + std::to_string(value) + "\n";
  return all;
}

TEST(DxfHabits, LettersOfAnyCaseAndAnyEndOfLine) {
  const std::string plain = cadPanel();
  const auto upper = readHabit(replaced(replaced(plain, "Piece Name:", "PIECE NAME :"), "Size:", "size:"));
  EXPECT_EQ(only(upper).name, "FRONT");
  EXPECT_EQ(upper.size, "38");
  for (const std::string& bytes :
       {replaced(plain, "\n", "\r\n"), replaced(plain, "\n", "\r"), "\xEF\xBB\xBF" + plain, "999\na remark\n" + plain,
        replaced(replaced(plain, "POLYLINE", "Polyline"), "SECTION", "section"),
        replaced(plain, "8\n1\n", "8\nLayer 1\n"), plain.substr(0, plain.size() - 6)})  // without EOF
    EXPECT_NEAR(only(readHabit(bytes)).outline.area(), kPanelArea, 1e-9);
}

TEST(DxfHabits, CommasForPoints) {
  EXPECT_NEAR(only(readHabit(replaced(cadPanel(), ".000000", ",000000"))).outline.area(), kPanelArea, 1e-9);
  EXPECT_THAT(why(replaced(cadPanel(), "280.000000", "28O.0")), HasSubstr("“28O.0” stands where a coordinate should"));
}

TEST(DxfHabits, OutlinesOfAnyEntity) {
  const auto outline = [](const std::string& drawn) {
    Made made;
    made.block("FRONT_38").says("Size: 38").add(drawn);
    return readHabit(made.endBlock().done());
  };
  const std::string lines = entity("LINE", 1, pairs({{10, 0}, {20, 0}, {11, 300}, {21, 0}})) +
                            entity("LINE", 1, pairs({{10, 280}, {20, 400}, {11, 300}, {21, 0}})) +
                            entity("LINE", 1, pairs({{10, 280}, {20, 400}, {11, 0}, {21, 400}}));
  EXPECT_NEAR(only(outline(lines + entity("LINE", 1, pairs({{10, 0}, {20, 0}, {11, 0}, {21, 400}})))).outline.area(),
              kPanelArea, 1e-9);
  std::string many = "70\n1\n";
  for (int k = 0; k < 400; ++k)
    many += pairs({{10, 300 * std::cos(k * std::numbers::pi / 200)}, {20, 300 * std::sin(k * std::numbers::pi / 200)}});
  EXPECT_NEAR(only(outline(entity("LWPOLYLINE", 1, many))).outline.area(), std::numbers::pi * 0.09, 1e-4)
      << "400 vertices";
  // Half a disc: a bulge of 1 is half a circle to the left; an arc with a chord; half an ellipse that is one.
  const double half = std::numbers::pi * 0.0225 / 2;
  const std::string chord = entity("LINE", 1, pairs({{10, 150}, {20, 0}, {11, -150}, {21, 0}}));
  for (const std::string& drawn :
       {entity("LWPOLYLINE", 1, "70\n129\n" + pairs({{10, 150}, {20, 0}, {42, 1}, {10, -150}, {20, 0}})),
        chord + entity("ARC", 1, pairs({{10, 0}, {20, 0}, {40, 150}, {50, 0}, {51, 180}})),
        chord + entity("ELLIPSE", 1,
                       pairs({{10, 0}, {20, 0}, {11, 150}, {21, 0}, {40, 1}, {41, 0}, {42, std::numbers::pi}})),
        "0\nPOLYLINE\n8\n1\n66\n1\n70\n1\n" + entity("VERTEX", 1, pairs({{10, 150}, {20, 0}, {42, 1}})) +
            entity("VERTEX", 1, pairs({{10, -150}, {20, 0}})) + "0\nSEQEND\n",
        // Half a circle as a rational spline of degree 2: weights of 1 and cos 45 degrees.
        chord + entity("SPLINE", 1, "70\n4\n71\n2\n" + pairs({{40, 0},   {40, 0},
                                                              {40, 0},   {40, 1},
                                                              {40, 1},   {40, 2},
                                                              {40, 2},   {40, 2},
                                                              {41, 1},   {41, std::sqrt(0.5)},
                                                              {41, 1},   {41, std::sqrt(0.5)},
                                                              {41, 1},   {10, 150},
                                                              {20, 0},   {10, 150},
                                                              {20, 150}, {10, 0},
                                                              {20, 150}, {10, -150},
                                                              {20, 150}, {10, -150},
                                                              {20, 0}}))}) {
    const auto made = outline(drawn);
    EXPECT_NEAR(only(made).outline.area(), half, 2e-5) << drawn;
    EXPECT_EQ(told(made), "") << drawn;
  }
}

TEST(DxfHabits, InsertedBlocks) {
  // The piece itself scaled, turned and turned over where it is inserted, twice: cut twice.
  Made made;
  made.block("FRONT_38").says("Size: 38").line(1, kPanel, true).line(7, {{50, 50}, {50, 350}});
  made.points(4, {{150, 0}}).endBlock();
  std::string bytes = made.done();
  const std::string insert =
      entity("INSERT", 1, "2\nFRONT_38\n" + pairs({{10, 5000}, {20, 70}, {41, -2}, {42, 2}, {50, 90}}));
  bytes.insert(bytes.rfind("0\nENDSEC"), insert + insert);
  const auto turned = readHabit(bytes);
  EXPECT_NEAR(only(turned).outline.area(), 4 * kPanelArea, 1e-9);
  EXPECT_NEAR(only(turned).grain.u, -1, 1e-9);
  EXPECT_THAT(notchPlaces(turned.pattern), SizeIs(1));
  EXPECT_EQ(turned.rows[0].quantity, 2);

  // Blocks within blocks: the outline on layer 0 of one that is inserted on layer 1, notches as symbols.
  Made nested;
  nested.block("shape").line(0, kPanel, true).endBlock();
  nested.block("slit").line(0, {{0, 0}, {0, 5}}).endBlock();
  nested.block("FRONT_38").says("Size: 38").add(entity("INSERT", 1, "2\nshape\n" + pairs({{10, 10}, {20, 20}})));
  nested.add(entity("INSERT", 4, "2\nslit\n" + pairs({{10, 160}, {20, 20}}))).endBlock();
  nested.block("sheet").add(entity("INSERT", 0, "2\nFRONT_38\n" + pairs({{10, 0}, {20, 0}}))).endBlock();
  const auto within = readHabit(nested.done());
  ASSERT_THAT(within.pattern.pieces, SizeIs(1));
  EXPECT_NEAR(only(within).outline.area(), kPanelArea, 1e-9);
  EXPECT_EQ(only(within).name, "FRONT");
  EXPECT_THAT(notchPlaces(within.pattern), SizeIs(1));

  Made round;
  round.block("a").line(1, kPanel, true).add(entity("INSERT", 8, "2\nb\n" + pairs({{10, 0}, {20, 0}}))).endBlock();
  round.block("b").line(8, {{1, 1}, {9, 9}}).add(entity("INSERT", 8, "2\nb\n" + pairs({{10, 0}, {20, 0}}))).endBlock();
  EXPECT_THAT(why(round.done()), HasSubstr("deep in each other"));
}

TEST(DxfHabits, PiecesWithoutBlocks) {
  Made made;
  std::string bytes = made.done();
  Made beside;
  beside.all.clear();
  std::vector<Flat> moved = kPanel;
  for (Flat& p : moved) p.u += 500;
  beside.line(1, kPanel, true)
      .line(1, moved, true)
      .line(7, {{550, 50}, {650, 50}})
      .points(4, {{150, 0}, {650, 0}, {700, 0}});
  beside.line(1, {{50, 50}, {90, 50}, {90, 90}}, true);  // within the first: a cut-out
  bytes.insert(bytes.rfind("0\nENDSEC"), beside.all);
  const auto two = readHabit(bytes);
  ASSERT_THAT(two.pattern.pieces, SizeIs(2));
  EXPECT_THAT(two.sizes, ElementsAre("38")) << "the style's sample size";
  std::size_t marks = 0;
  for (const auto& [id, piece] : two.pattern.pieces) {
    EXPECT_NEAR(piece->outline.area(), kPanelArea, 1e-9);
    marks = 10 * marks + piece->marks.size();
  }
  EXPECT_EQ(marks, 12u);
  EXPECT_THAT(only(two, 0).holes, SizeIs(1));
  EXPECT_NEAR(only(two, 1).grain.u, 1, 1e-9);
}

TEST(DxfHabits, NotchesAsLinesAndHolesAsCircles) {
  const auto all = readHabit(cadPanel(
      entity("LINE", 4, pairs({{10, 104}, {20, 4}, {11, 100}, {21, 0}})) +
      entity("LWPOLYLINE", 80, "70\n0\n" + pairs({{10, 198}, {20, 0}, {10, 200}, {20, 5}, {10, 202}, {20, 0}})) +
      entity("CIRCLE", 13, pairs({{10, 120}, {20, 200}, {40, 2}}))));
  std::vector<double> at;
  for (const NotchPlace& notch : notchPlaces(all.pattern)) at.push_back(std::round(notch.place.u * 1e4) / 10);
  EXPECT_THAT(at, ElementsAre(100, 200));
  ASSERT_THAT(drillHoles(only(all)), SizeIs(1));
  EXPECT_LT(distance(drillHoles(only(all))[0], {0.12, 0.2}), 1e-6);
}

TEST(DxfHabits, TextsOnAnyLayerAndQuantities) {
  const auto with = [](const std::string& name, const std::string& words) {
    const std::string all = cadPanel(entity("TEXT", 15, "10\n5\n20\n5\n1\n" + words + "\n"));
    return readHabit(replaced(all, "Piece Name: FRONT", "Piece Name: " + name)).cutting.quantities;
  };
  EXPECT_EQ(with("A", "Quantity: 2").at({1}), (Cutting{2, true})) << "not alike on both sides: left and right";
  EXPECT_EQ(with("A", "QUANTITY: 3").at({1}), (Cutting{3, false}));
  EXPECT_EQ(with("A", "Quantity: 2,2").at({1}), (Cutting{4, true}));
  EXPECT_EQ(with("A", "Quantity: LEFT 1, RIGHT 1").at({1}), (Cutting{2, true})) << "beside words";
  EXPECT_EQ(with("A", "Annotation: CUT 1 PAIR").at({1}), (Cutting{2, true}));
  EXPECT_EQ(with("A", "annotation: Shell, cut 4").at({1}), (Cutting{4, true}));
  EXPECT_TRUE(with("A", "Annotation: cut along the line").empty());
}

TEST(DxfHabits, UnitsByTheHeader) {
  for (const auto& [code, unit] : {std::pair{1, 25.4}, {4, 1.0}, {5, 10.0}, {6, 1000.0}}) {
    std::vector<Flat> drawn = kPanel;
    for (Flat& p : drawn) p = p * (1 / unit);
    Made made;
    made.all = replaced(made.all, "HEADER\n", "HEADER\n9\n$INSUNITS\n70\n" + std::to_string(code) + "\n");
    made.block("A_1").line(1, drawn, true);
    const auto all = readHabit(made.endBlock().done({}));
    EXPECT_NEAR(only(all).outline.area(), kPanelArea, 1e-7) << code;
    EXPECT_EQ(told(all), "") << code;
  }
}

TEST(DxfHabits, NamesOfAnyCodePage) {
  const auto named = [](const std::string& bytes, const std::string& codePage) {
    std::string all = replaced(cadPanel(), "Name: FRONT", "Name: " + bytes);
    if (!codePage.empty()) all = replaced(all, "HEADER\n", "HEADER\n9\n$DWGCODEPAGE\n3\n" + codePage + "\n");
    return readHabit(all);
  };
  EXPECT_EQ(only(named("前身頃", "")).name, "前身頃");
  EXPECT_EQ(only(named("\\U+524D\\U+8EAB", "ANSI_1252")).name, "前身");
  EXPECT_EQ(only(named("\x91\x4F\x90\x67\x8D\xA0", "ANSI_932")).name, "前身頃");
  EXPECT_EQ(only(named("\xC7\xB0\xC6\xAC", "ANSI_936")).name, "前片");
  EXPECT_EQ(only(named("R\xFC"
                       "cken",
                       "ANSI_1252"))
                .name,
            "Rücken");
  const auto guessed = named("\x91\x4F\x90\x67\x8D\xA0", "");
  EXPECT_EQ(only(guessed).name, "前身頃");
  EXPECT_THAT(told(guessed), HasSubstr("code page"));
  EXPECT_EQ(only(named("\xD0\xE4\xD7\xD3", "")).name, "袖子");
  for (const auto& [bytes, name] : {std::pair<std::string, std::string>{"R\xFC"
                                                                        "cken",
                                                                        "Rücken"},
                                    {"\xC4rmel", "Ärmel"},
                                    {"Gr\xF6\xDF"
                                     "e",
                                     "Größe"},
                                    {"Devant c\xF4t\xE9", "Devant_côté"},
                                    {"Espa\xF1"
                                     "a",
                                     "España"}})
    EXPECT_EQ(only(named(bytes, "")).name, name);
  EXPECT_EQ(only(named("\xBA\xF3\xC6\xAC"
                       "A",
                       ""))
                .name,
            "后片A");
}

TEST(DxfHabits, AUnitThatIsSaidGoesBeforeWhatTheFileTells) {
  const auto read = readCadPattern(cadPanel(), {}, 0.01);
  ASSERT_TRUE(read);
  EXPECT_NEAR(only(*read).outline.area(), 100 * kPanelArea, 1e-7);
  EXPECT_EQ(told(*read), "");
}

// The outline stands in a block of its own, its words beside where that is inserted.
TEST(DxfHabits, WordsBesideAnInsertedOutline) {
  Made made;
  made.block("LINES").line(1, kPanel, true).endBlock();
  made.block("FRONT_38").says("Piece Name: FRONT").says("Size: 38").says("Quantity: 2");
  const auto read = readHabit(made.add("0\nINSERT\n8\n1\n2\nLINES\n10\n5\n20\n5\n").endBlock().done());
  EXPECT_EQ(only(read).name, "FRONT");
  EXPECT_THAT(read.sizes, ElementsAre("38"));
  ASSERT_THAT(read.rows, SizeIs(1));
  EXPECT_EQ(read.rows[0].quantity, 2);
  EXPECT_EQ(told(read), "");
}

TEST(DxfHabits, WordsOfSeveralLinesAndHowTheyAreLettered) {
  Made made;
  made.block("A").line(1, kPanel, true);
  made.add("0\nMTEXT\n8\n1\n10\n5\n20\n5\n1\n{\\fArial|b0|i0;\\H2.5x;Piece Name: FRONT}\\PSize: 38\\PQuantity: 2\n");
  const auto read = readHabit(made.endBlock().done());
  EXPECT_EQ(only(read).name, "FRONT");
  ASSERT_THAT(read.rows, SizeIs(1));
  EXPECT_EQ(read.rows[0].quantity, 2);
  EXPECT_EQ(only(readHabit(replaced(cadPanel(), "Name: FRONT", "Name: %%uFRONT%%u"))).name, "FRONT");
}

TEST(DxfHabits, OutlinesThatHoldNothing) {
  Made made;
  made.block("FRONT_38").says("Size: 38").line(1, {{0, 0}, {400, 0}, {400, 0}, {0, 0}}, true);
  EXPECT_THAT(why(made.endBlock().done()), HasSubstr("holds no cloth"));
  EXPECT_THAT(told(readHabit(cadPanel("0\nPOINT\n8\n4\n10\n150\n20\n200\n"))),
              HasSubstr("1 notch lies apart from the outline and was left out"));
}

TEST(DxfHabits, ABlockWithoutAnOutlineIsTold) {
  Made made;
  made.block("FRONT_38").says("Piece Name: FRONT").says("Size: 38").line(1, kPanel, true).endBlock();
  made.block("BELT_38").says("Piece Name: BELT").says("Size: 38");
  const auto read = readHabit(made.endBlock().done());
  EXPECT_THAT(read.pattern.pieces, SizeIs(1));
  EXPECT_THAT(told(read), HasSubstr("Piece “BELT” has no outline and was left out."));
}

// What is drawn in a program that knows nothing of the trade.
TEST(DxfHabits, PlainDrawings) {
  const auto line = [](const std::string& layer, Flat a, Flat b) {
    return "0\nLINE\n8\n" + layer + "\n" + pairs({{10, a.u}, {20, a.v}, {11, b.u}, {21, b.v}});
  };
  // Four lines whose ends miss each other by 0.02 mm, as a hand draws them with snapping off.
  const auto box = [&](const std::string& layer, double u, double v, double wide, double high) {
    return line(layer, {u, v}, {u + wide, v}) + line(layer, {u + wide, v + 0.02}, {u + wide, v + high}) +
           line(layer, {u, v + high}, {u + wide - 0.02, v + high}) + line(layer, {u, v}, {u, v + high});
  };
  const auto lettering = [](const std::string& words, Flat at) {
    return "0\nTEXT\n8\n0\n" + pairs({{10, at.u}, {20, at.v}, {40, 10}}) + "1\n" + words + "\n";
  };
  const auto file = [](const std::string& drawn) {
    return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + drawn +
           "0\nENDSEC\n0\nEOF\n";
  };
  const auto all =
      readHabit(file(box("0", -20, -20, 1000, 700) + box("0", 0, 0, 300, 400) + box("0", 10, 10, 280, 380) +
                     box("0", 100, 100, 80, 90) + line("0", {50, 50}, {50, 300}) + lettering("Front", {150, 50}) +
                     box("0", 400, 0, 200, 500) + lettering("Rear", {450, 50})));
  ASSERT_THAT(all.pattern.pieces, SizeIs(2)) << "the frame is none";
  EXPECT_THAT(told(all), HasSubstr("not those of AAMA and ASTM"));
  for (const auto& [id, piece] : all.pattern.pieces) {
    const bool front = piece->name == "Front";
    EXPECT_TRUE(front || piece->name == "Rear") << piece->name;
    EXPECT_NEAR(piece->outline.area(), front ? 0.28 * 0.38 : 0.1, 2e-5) << "the seam line";
    EXPECT_THAT(piece->holes, SizeIs(0));
    EXPECT_EQ(piece->lines.size(), front ? 2u : 0u);
  }
  const auto named =
      readHabit(file(box("Cutting line", 0, 0, 300, 400) + box("Seam line", 10, 10, 280, 380) +
                     line("Grain line", {100, 200}, {200, 200}) + line("Dimensions", {-50, 0}, {-50, 400})));
  EXPECT_NEAR(only(named).outline.area(), 0.28 * 0.38, 2e-5);
  EXPECT_NEAR(only(named).grain.u, 1, 1e-9);
  EXPECT_THAT(only(named).lines, SizeIs(0));
  const auto byLayer = readHabit(file(box("Sleeve", 0, 0, 300, 400) + box("Cuff", 400, 0, 200, 80)));
  ASSERT_THAT(byLayer.pattern.pieces, SizeIs(2));
  EXPECT_EQ(only(byLayer, 0).name, "Sleeve");
  EXPECT_EQ(only(byLayer, 1).name, "Cuff");
  EXPECT_THAT(why(file(line("0", {0, 0}, {300, 0}) + line("0", {300, 0}, {300, 400}))),
              HasSubstr("It has lines on: 0"));
  // On layer 1, too, outlines of single lines are told apart.
  EXPECT_THAT(readHabit(file(box("1", 0, 0, 300, 400) + box("1", 400, 0, 200, 500))).pattern.pieces, SizeIs(2));
}

TEST(DxfHabits, HalvesThatLeaveTheFoldToItsLayer) {
  Made made;
  made.block("BACK_38").says("Size: 38").line(1, {{0, 0}, {300, 0}, {280, 400}}).line(1, {{280, 400}, {0, 400}});
  made.straight(6, {0, 0}, {0, 400});
  const auto all = readHabit(made.endBlock().done());
  EXPECT_NEAR(only(all).outline.area(), 2 * kPanelArea, 1e-9);
  EXPECT_EQ(told(all), "");
  Made open;
  open.block("BACK_38").says("Size: 38").line(1, kPanel);
  const auto closed = readHabit(open.endBlock().done());
  EXPECT_NEAR(only(closed).outline.area(), kPanelArea, 1e-9);
  EXPECT_THAT(told(closed), HasSubstr("closed by a straight line"));
}

TEST(DxfHabits, FarAwayAndDoubledPoints) {
  std::vector<Flat> far;
  for (const Flat p : kPanel)
    for (int twice = 0; twice < 2; ++twice) far.push_back(p + Flat{4e6, -9e6});
  Made made;
  made.block("A_38").says("Size: 38").line(1, far, true).points(4, {Flat{150, 0} + Flat{4e6, -9e6}});
  const auto all = readHabit(made.endBlock().done());
  EXPECT_NEAR(only(all).outline.area(), kPanelArea, 1e-6);
  for (const Flat p : only(all).outline.flattened()) EXPECT_LT(length(p), 1);
  EXPECT_THAT(only(all).marks, SizeIs(1));
  EXPECT_EQ(only(all).outline.edges.size(), 4u);
}

// A coat's front with a round hem, in chords of a few thousandths of a millimetre.
TEST(DxfHabits, OutlinesOfVeryManyPoints) {
  constexpr int kRound = 90'000;
  std::vector<Flat> front{{0, 800}, {0, 0}};
  for (int k = 1; k <= kRound; ++k) {
    const double t = M_PI / 2 * k / kRound;
    front.push_back(Flat{400 * std::sin(t), 250 * (1 - std::cos(t))});
  }
  front.push_back({400, 800});
  const double area = 400 * 800 - 100'000 * (1 - M_PI / 4);
  for (const bool single : {false, true}) {
    Made made;
    made.block("FRONT_38").says("Size: 38");
    if (single)
      for (std::size_t k = 0; k < front.size(); ++k) made.straight(1, front[k], front[(k + 1) % front.size()]);
    else
      made.line(1, front, true).points(2, {front[0], front[1], front[front.size() - 2], front.back()});
    const auto all = readHabit(made.points(4, {{400, 500}}).endBlock().done());
    EXPECT_NEAR(only(all).outline.area() * 1e6, area, 10) << "mm2";
    EXPECT_EQ(only(all).outline.edges.size(), 3u) << "the hem runs smoothly into the side";
    EXPECT_THAT(only(all).marks, SizeIs(1));
    EXPECT_THAT(told(all), HasSubstr("its outline has more than 20000 points; "));
    for (const Edge& edge : only(all).outline.edges) EXPECT_LT(edge.curve.flattened().size(), 400u);
  }
  // What is no line at all is refused as before.
  std::vector<Flat> saw;
  for (int k = 0; k < 30'000; ++k) saw.push_back({0.05 * k, k % 2 == 0 ? 0.0 : -0.4});
  saw.push_back({1500, 900}), saw.push_back({0, 900});
  Made jagged;
  jagged.block("SAW_38").says("Size: 38").line(1, saw, true);
  const auto refused = readCadPattern(jagged.endBlock().done());
  ASSERT_FALSE(refused);
  EXPECT_THAT(text(refused.error().what), HasSubstr("more than 20000 points"));
}

TEST(DxfHabits, BlocksThatNameNoSize) {
  Made made;
  made.block("FRONT_LEFT").line(1, kPanel, true).endBlock();
  made.block("POCKET_BIG").line(1, kPanel, true).endBlock();
  const auto all = readHabit(made.done({"Units: METRIC"}));
  ASSERT_EQ(all.pattern.pieces.size(), 2u);
  EXPECT_EQ(only(all, 0).name, "FRONT_LEFT") << "no size";
  Made sizes;
  for (const char* name : {"FRONT_38", "FRONT_40", "BACK_38", "BACK_40"})
    sizes.block(name).line(1, kPanel, true).endBlock();
  EXPECT_THAT(readHabit(sizes.done({"Units: METRIC"})).sizes, ElementsAre("38", "40"));
  // A pocket in one size only is there in all.
  Made lacking;
  for (const char* name : {"FRONT_38", "FRONT_40", "POCKET_38"})
    lacking.block(name)
        .says(std::string("Size: ") + (name + std::string(name).size() - 2))
        .line(1, kPanel, true)
        .endBlock();
  const auto other = readHabit(lacking.done(), "40");
  EXPECT_EQ(other.pattern.pieces.size(), 2u);
  EXPECT_THAT(told(other), HasSubstr("“POCKET” is not drawn in size 40; it was taken in size 38"));
}

// A left and a right piece of one name, each with its sizes; and a symbol beside an outline, which is no piece.
TEST(DxfHabits, SeveralBlocksOfOneName) {
  const auto sized = [](double wide, double by) {
    return std::vector<Flat>{{0, 0}, {wide + by, 0}, {wide + by, 400}, {0, 400}};
  };
  Made made;
  for (const auto& [size, by] : {std::pair{"38", 0.0}, {"40", 10.0}})
    for (const double wide : {300.0, 200.0}) {
      made.block(std::string("P") + std::to_string(wide)[0] + "_" + size).says("Piece Name: SIDE");
      made.says(std::string("Size: ") + size).line(1, sized(wide, by * wide / 100), true);
      made.line(1, {{900, 0}, {905, 0}, {905, 5}}, true).endBlock();
    }
  const auto all = readHabit(made.done());
  ASSERT_THAT(all.pattern.pieces, SizeIs(2));
  ASSERT_THAT(all.grading.pieces, SizeIs(2));
  for (const auto& [nth, wide] : {std::pair{0u, 0.33}, {1u, 0.22}}) {
    const auto large = inSize(only(all, nth), all.grading, 1);
    ASSERT_TRUE(large);
    EXPECT_NEAR(large->outline.area(), wide * 0.4, 1e-6);
  }
}

TEST(DxfHabits, WhatLiesOnOtherLayersThanOne) {
  EXPECT_NEAR(only(readHabit(replaced(replaced(cadPanel(), "POLYLINE\n8\n1\n", "POLYLINE\n8\n14\n"), "VERTEX\n8\n1\n",
                                      "VERTEX\n8\n14\n")))
                  .outline.area(),
              kPanelArea, 1e-9);
  EXPECT_THAT(why(replaced(cadPanel(), "POLYLINE\n8\n1\n", "POLYLINE\n8\nCUT\n")), HasSubstr("It has lines on: CUT."));
  // A pocket's stitching on the layer of seam lines is no outline.
  const auto stitched = readHabit(cadPanel(
      entity("LWPOLYLINE", 14, "70\n1\n" + pairs({{10, 180}, {20, 300}, {10, 230}, {20, 300}, {10, 230}, {20, 350}}))));
  EXPECT_NEAR(only(stitched).outline.area(), kPanelArea, 1e-9);
  EXPECT_THAT(only(stitched).lines, SizeIs(1));
}

TEST(DxfHabits, OtherKindsOfFilesAreCalledByTheirName) {
  EXPECT_THAT(why("AutoCAD Binary DXF\r\n\x1a"), HasSubstr("binary DXF"));
  EXPECT_THAT(why("AC1015 and more"), HasSubstr("DWG"));
  Made empty;
  empty.block("*Model_Space").endBlock();
  empty.block("FRONT_38").says("Size: 38").line(1, kPanel, true).endBlock();
  empty.block("nothing").endBlock();
  EXPECT_EQ(readHabit(empty.done()).pattern.pieces.size(), 1u);
}

}  // namespace
}  // namespace karinui

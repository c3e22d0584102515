// Patterns through the trade's DXF: our own out and in again, the habits of other programs in small files of our own
// making, and, where they lie beside the project, files from industrial CAD and CLO.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "exchange/bodice_half.h"
#include "exchange/dxf/cad_style.h"
#include "exchange/dxf_made.h"
#include "karinui/base/file.h"
#include "karinui/design/apply.h"
#include "karinui/design/script.h"
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/read_pattern.h"
#include "karinui/pattern/markings.h"

namespace karinui {
namespace {

namespace fs = std::filesystem;
using test::only;
using test::told;
using Text = test::DxfMade;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// A bodice half with a curved armhole and neck, a notch, a drill hole, a cut-out and an inner line; and a sleeve sewn
// to it.
Pattern style() {
  Piece front;
  front.id = {1}, front.name = "front", front.grain = normalized(Flat{0.1, 1});
  front.outline = bodiceHalf();
  front.marks = {{"waist", "side", 0.4, {}}, {"bust", "", 0, {0.12, 0.33}}};
  front.holes = {
      {{{"eyelet_a", Curve::arc({0.03, 0.1}, {0.07, 0.1}, 1)}, {"eyelet_b", Curve::arc({0.07, 0.1}, {0.03, 0.1}, 1)}}}};
  front.lines = {{"pocket", {Curve::line({0.08, 0.2}, {0.16, 0.2})}, {}}};
  Piece sleeve;
  sleeve.id = {2}, sleeve.name = "袖 left sleeve with a long name";
  sleeve.outline.edges = {{"cuff", Curve::line({0.02, 0}, {0.2, 0})},
                          {"under", Curve::line({0.2, 0}, {0.22, 0.3})},
                          {"cap", Curve::cubic({0.22, 0.3}, {0.2, 0.45}, {0.02, 0.45}, {0, 0.3})},
                          {"under_2", Curve::line({0, 0.3}, {0.02, 0})}};
  Pattern all;
  for (Piece piece : {front, sleeve}) {
    piece.outline = *checked(piece.outline);
    all.pieces[piece.id] = std::make_shared<const Piece>(piece);
  }
  all.seams[{1}] = {{1}, "sleeve", {{{1}, "armhole", 0, 1}}, {{{2}, "cap", 0, 0.5}}, true, Seam::Tie::OneToOne};
  return all;
}

TEST(Dxf, WhatIsWrittenComesBackTrue) {
  for (const DxfDialect dialect : {DxfDialect::Aama, DxfDialect::Astm})
    for (const double allowance : {0.0, 0.012}) {
      const Pattern wanted = style();
      SheetSettings settings;
      settings.allowance = allowance;
      const auto text = writeDxf(wanted, dialect, settings);
      ASSERT_TRUE(text);
      const auto read = readCadPattern(*text);
      ASSERT_TRUE(read) << karinui::text(read.error().what);
      EXPECT_EQ(told(*read), "");
      ASSERT_THAT(read->pattern.pieces, SizeIs(2));
      for (std::size_t k = 0; k < 2; ++k) {
        const Piece &was = *std::next(wanted.pieces.begin(), static_cast<std::ptrdiff_t>(k))->second,
                    &is = only(*read, k);
        ASSERT_EQ(is.outline.edges.size(), was.outline.edges.size());
        for (std::size_t e = 0; e < was.outline.edges.size(); ++e) {  // an edge that starts where it did
          const Curve& curve = was.outline.edges[e].curve;
          double miss = 1;
          for (const Edge& edge : is.outline.edges)
            if (distance(edge.curve.start, curve.start) < 1e-5) miss = std::abs(edge.curve.length() - curve.length());
          EXPECT_LT(miss, 5e-5) << was.outline.edges[e].name;
        }
        EXPECT_NEAR(is.outline.area() / was.outline.area(), 1, 5e-4);
        EXPECT_GT(dot(is.grain, was.grain), std::cos(0.1 * std::numbers::pi / 180));
      }
      const Piece& front = only(*read);
      ASSERT_THAT(front.holes, SizeIs(1));
      EXPECT_NEAR(front.holes[0].area(), style().pieces.at({1})->holes[0].area(), 1e-6);
      EXPECT_THAT(front.lines, SizeIs(1));
      ASSERT_THAT(drillHoles(front), SizeIs(1));
      EXPECT_LT(distance(drillHoles(front)[0], {0.12, 0.33}), 1e-5);
      const auto before = notchPlaces(wanted), after = notchPlaces(read->pattern);
      ASSERT_EQ(after.size(), before.size());
      for (const NotchPlace& notch : before)
        EXPECT_TRUE(std::any_of(after.begin(), after.end(), [&](const NotchPlace& n) {
          return n.piece == notch.piece && distance(n.place, notch.place) < 1e-4;
        }));
    }
}

// Names keep their length, and letters beyond ASCII are written as AutoCAD does.
TEST(Dxf, NamesComeBackWhole) {
  Pattern wanted = style();
  Piece leg = *wanted.pieces.at({1});
  leg.name = "leg_front_left_with_a_name_beyond_any_block";
  wanted.pieces[{1}] = std::make_shared<const Piece>(leg);
  for (const DxfDialect dialect : {DxfDialect::Aama, DxfDialect::Astm}) {
    const auto bytes = writeDxf(wanted, dialect);
    ASSERT_TRUE(bytes);
    EXPECT_TRUE(std::all_of(bytes->begin(), bytes->end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
    EXPECT_THAT(*bytes, HasSubstr("Piece Name: leg_front_left_with_a_name_beyond_any_block\r\n"));
    EXPECT_THAT(*bytes, HasSubstr("Piece Name: \\U+8896 left"));
    const auto read = readCadPattern(*bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(only(*read).name, leg.name);
    EXPECT_EQ(only(*read, 1).name, "袖_left_sleeve_with_a_long_name");
    const auto file = parseDxf(*bytes);
    for (const DxfBlock& block : file->blocks) EXPECT_LE(block.name.size(), 20u) << block.name;
  }
}

// How far it is along the outline from where one place lies on it to where another does.
double between(const Outline& outline, Flat from, Flat to) {
  const Ring ring = outline.flattened(1e-6);
  double whole = 0, at[2] = {}, nearest[2] = {1e9, 1e9};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Flat a = ring[i], way = ring[(i + 1) % ring.size()] - a;
    const double size = length(way);
    for (const int k : {0, 1}) {
      const Flat place = k == 0 ? from : to;
      const double t = std::clamp(dot(place - a, way) / (size * size), 0.0, 1.0);
      if (const double d = distance(place, a + t * way); d < nearest[k]) nearest[k] = d, at[k] = whole + t * size;
    }
    whole += size;
  }
  return at[1] > at[0] ? at[1] - at[0] : at[1] - at[0] + whole;
}

// A waist where the side turns by four degrees is a corner, however blunt.
TEST(Dxf, DraftedBlocksComeBackTrue) {
  Workers workers(1);
  MemoryBlobs blobs;
  Bodies bodies;
  Token token;
  Context context{workers, token, blobs, bodies, {}, {}};
  auto body = apply({}, *parseOperation("body size=eu38"), context);
  ASSERT_TRUE(body);
  for (const char* kind : {"shirt", "bodice", "sleeve", "skirt", "trousers"}) {
    const auto made = apply(*body, *parseOperation(std::string("block kind=") + kind), context);
    ASSERT_TRUE(made) << text(made.error().what);
    for (const DxfDialect dialect : {DxfDialect::Aama, DxfDialect::Astm})
      for (const double allowance : {0.0, 0.01}) {
        SheetSettings settings;
        settings.allowance = allowance;
        const auto bytes = writeDxf(made->pattern, dialect, settings);
        ASSERT_TRUE(bytes);
        const auto read = readCadPattern(*bytes);
        ASSERT_TRUE(read) << text(read.error().what);
        ASSERT_EQ(read->pattern.pieces.size(), made->pattern.pieces.size());
        auto back = read->pattern.pieces.begin();
        for (const auto& [id, piece] : made->pattern.pieces) {
          const Outline& is = (back++)->second->outline;
          SCOPED_TRACE(std::string(kind) + " " + piece->name);
          EXPECT_NEAR(is.area() / piece->outline.area(), 1, 1e-4);
          for (const Edge& edge : piece->outline.edges)
            EXPECT_NEAR(between(is, edge.curve.start, edge.curve.end), edge.curve.length(), 2e-4) << edge.name;
        }
      }
  }
}

// Where buttons are set there are drill holes on both sides, with words; a zip's ends are notches.
TEST(Dxf, FasteningsAreDrillHolesAndNotches) {
  const Pattern pattern = style();
  SheetSettings settings;
  Fastening& buttons = settings.allowances.fastenings["cuff"];
  buttons.a = {{{2}, "under", 0, 1}}, buttons.b = {{{2}, "under_2", 0, 1}};
  buttons.at = {0.25, 0.75}, buttons.inset = 0.015;
  Fastening& zip = settings.allowances.fastenings["zip"];
  zip.kind = FasteningKind::Zip;
  zip.a = {{{1}, "side", 0, 1}}, zip.b = {{{2}, "cap", 0, 1}}, zip.at = {0.2, 0.6};
  const auto bytes = writeDxf(pattern, DxfDialect::Aama, settings), plain = writeDxf(pattern, DxfDialect::Aama);
  ASSERT_TRUE(bytes && plain);
  EXPECT_THAT(*bytes, HasSubstr("buttonhole cuff 1"));
  EXPECT_THAT(*bytes, HasSubstr("button cuff 2"));
  const auto read = readCadPattern(*bytes), before = readCadPattern(*plain);
  ASSERT_TRUE(read && before) << text(read.error().what);
  const std::vector<Flat> holes = drillHoles(only(*read, 1));
  ASSERT_THAT(holes, SizeIs(4));
  for (const FastenedPlaces& pair : placesOf(pattern, buttons))
    for (const FasteningPlace& at : {pair.a, pair.b})
      EXPECT_TRUE(std::any_of(holes.begin(), holes.end(), [&](Flat p) { return distance(p, at.place) < 1e-4; }));
  EXPECT_EQ(notchPlaces(read->pattern).size(), notchPlaces(before->pattern).size() + 4);
  EXPECT_EQ(read->rows.size(), before->rows.size());
}

// A round cut-out of 20 mm is cut 12 mm within its seam line; one of 10 mm is filled by that and only marked.
TEST(Dxf, CutOutsAreCutWithinTheirSeamLine) {
  Pattern pattern = style();
  Piece front = *pattern.pieces.at({1});
  front.holes.push_back(
      {{{"small_a", Curve::arc({0.12, 0.1}, {0.14, 0.1}, 1)}, {"small_b", Curve::arc({0.14, 0.1}, {0.12, 0.1}, 1)}}});
  pattern.pieces[{1}] = std::make_shared<const Piece>(front);
  SheetSettings settings;
  settings.allowance = 0.012;
  for (const DxfDialect dialect : {DxfDialect::Aama, DxfDialect::Astm}) {
    const auto bytes = writeDxf(pattern, dialect, settings);
    ASSERT_TRUE(bytes);
    const auto style = cadStyle(*parseDxf(*bytes));
    ASSERT_TRUE(style);
    const CadPiece& drawn = style->pieces.front();
    ASSERT_THAT(drawn.cutouts, SizeIs(1));
    for (const Flat p : drawn.cutouts[0].points) EXPECT_NEAR(distance(p, {0.05, 0.1}), 0.008, 5e-5);
    EXPECT_THAT(drawn.sewing, SizeIs(3));
    const auto read = readCadPattern(*bytes);
    ASSERT_TRUE(read);
    ASSERT_THAT(only(*read).holes, SizeIs(1));
    EXPECT_NEAR(only(*read).holes[0].area(), 4e-4 * std::numbers::pi, 2e-6);
    EXPECT_THAT(only(*read).lines, SizeIs(2)) << "the pocket, and the hole that is not cut";
  }
}

TEST(Dxf, IsAnOrderlyFileForReadersOfTheTrade) {
  const auto text = writeDxf(style(), DxfDialect::Aama);
  ASSERT_TRUE(text);
  EXPECT_TRUE(std::all_of(text->begin(), text->end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
  const auto header = text->find("HEADER"), blocks = text->find("BLOCKS"), entities = text->find("ENTITIES");
  EXPECT_LT(header, blocks);
  EXPECT_LT(blocks, entities);
  EXPECT_EQ(text->find("TABLES"), std::string::npos);
  EXPECT_THAT(*text, HasSubstr("2\r\nfront_M\r\n"));
  EXPECT_THAT(*text, HasSubstr("Units: METRIC"));
  EXPECT_FALSE(writeDxf({}, DxfDialect::Aama));
}

// --- the habits of others, in files of our own

// Half of a back as Gerber draws it: three open polylines, one of them the wrong way round, a sparse neckline, the
// fold on layer 6; the points of corners in the sample size only.
Text halfBack(double size, const std::string& name, bool sample) {
  const std::vector<Flat> neck = {{0, 400 + size}, {40, 408 + size}, {70, 430 + size}};
  Text text;
  text.block("BACK_" + name).says("PIECE NAME: BACK").says("Size: " + name);
  text.line(1, {{0, 400 + size}, {0, 0}, {200 + size, 0}}).line(1, {neck[2], neck[1], neck[0]});
  text.line(1, {neck[2], {180, 410 + size}, {200 + size, 0}}).straight(6, {0, 0}, {0, 400 + size});
  text.straight(7, {50, 50}, {50, 230});
  if (sample)
    text.says("Quantity: 1,1")
        .points(2, {{0, 400 + size}, {0, 0}, {200 + size, 0}, neck[2], {180, 410 + size}})
        .points(3, {neck[1]});
  if (sample) text.points(4, {{190 + size / 2, 205 + size / 2}});
  return text.endBlock();
}
std::string halfBacks() {
  Text both = halfBack(0, "38", true);
  both.add(halfBack(10, "40", false).all.substr(Text().all.size()));
  return both.done();
}

TEST(Dxf, HowOftenAPieceIsCutIsWritten) {
  const Pattern pattern = readCadPattern(halfBacks())->pattern;
  SheetSettings settings;
  const PieceId back = pattern.pieces.begin()->first;
  for (const Cutting cutting : {Cutting{1, false}, Cutting{3, false}, Cutting{4, true}}) {
    settings.cutting[back] = cutting;
    const auto aama = readCadPattern(*writeDxf(pattern, DxfDialect::Aama, settings)),
               astm = readCadPattern(*writeDxf(pattern, DxfDialect::Astm, settings));
    ASSERT_TRUE(aama && astm);
    for (const auto* read : {&*aama, &*astm}) EXPECT_EQ(read->rows[0].quantity, cutting.count);
    EXPECT_EQ(astm->rows[0].pairs, cutting.pairs);
  }
  EXPECT_THAT(*writeDxf(pattern, DxfDialect::Astm, settings), HasSubstr("Quantity: 2,2"));
}

TEST(Dxf, OpenLinesAreChainedAndHalvesUnfolded) {
  const auto read = readCadPattern(halfBacks());
  ASSERT_TRUE(read) << text(read.error().what);
  EXPECT_EQ(told(*read), "");
  EXPECT_EQ(read->size, "38");
  EXPECT_THAT(read->sizes, ElementsAre("38", "40"));
  ASSERT_THAT(read->rows, SizeIs(1));
  EXPECT_EQ(read->rows[0].quantity, 2);
  const Piece& back = only(*read);
  EXPECT_EQ(back.name, "BACK");
  // Hem and neck run over the fold: hem, two sides, two shoulders, neck.
  EXPECT_EQ(back.outline.edges.size(), 6u);
  double hem = 0;
  for (const Edge& edge : back.outline.edges)
    if (edge.curve.kind == Curve::Kind::Line) hem = std::max(hem, std::abs(edge.curve.end.u - edge.curve.start.u));
  EXPECT_NEAR(hem, 0.4, 1e-6);
  EXPECT_NEAR(back.outline.area(), 2 * 0.07903, 0.001);
  EXPECT_THAT(back.marks, SizeIs(2));  // on both halves
  EXPECT_NEAR(back.grain.v, 1, 1e-9);
}

TEST(Dxf, OtherSizesHaveTheSamplesCorners) {
  const auto read = readCadPattern(halfBacks(), "40");
  ASSERT_TRUE(read) << text(read.error().what);
  EXPECT_EQ(only(*read).outline.edges.size(), 6u);
  EXPECT_NEAR(only(*read).outline.area(), 2 * 0.08303, 0.001);
  const auto none = readCadPattern(halfBacks(), "50");
  ASSERT_FALSE(none);
  EXPECT_EQ(text(none.error().what), "The file has no size “50”; it has 38, 40.");
}

// Sparse points lie *on* the curve: a quarter of a circle in four chords of 6 mm height comes out round.
TEST(Dxf, SparsePointsAreJoinedByACurve) {
  std::vector<Flat> round;
  for (int k = 0; k <= 4; ++k)
    round.push_back({300 * std::cos(k * std::numbers::pi / 8), 300 * std::sin(k * std::numbers::pi / 8)});
  Text drawn;
  drawn.block("HALF_38")
      .line(1, round)
      .line(1, {{-0.0, 300}, {0, 0}, {300, 0}})
      .points(2, {round.front(), round.back(), {0, 0}});
  drawn.points(3, {round[1], round[2], round[3]});
  const auto read = readCadPattern(drawn.endBlock().done());
  ASSERT_TRUE(read) << text(read.error().what);
  for (const Edge& edge : only(*read).outline.edges)
    if (edge.curve.kind != Curve::Kind::Line) {
      for (const Flat p : edge.curve.flattened()) EXPECT_NEAR(length(p), 0.3, 3e-4);
    }
}

TEST(Dxf, CentimetresThatCallThemselvesMetricAreSeenByTheGrainLine) {
  Text drawn;
  drawn.block("7_M").line(1, {{0, 0}, {30, 0}, {30, 70}, {0, 70}}, true).straight(7, {10, 10}, {10, 28});
  const std::string text = drawn.endBlock().done({"AUTHOR: CLO Virtual Fashion Inc.", "UNITS: METRIC"});
  const auto read = readCadPattern(text);
  ASSERT_TRUE(read);
  EXPECT_NEAR(only(*read).outline.area(), 0.21, 1e-9);
  EXPECT_EQ(told(*read), "");
}

TEST(Dxf, AGuessedUnitIsTold) {
  Text drawn;
  drawn.block("a_1").line(1, {{0, 0}, {20, 0}, {20, 30}, {0, 30}}, true);
  const auto read = readCadPattern(drawn.endBlock().done({}));
  ASSERT_TRUE(read);
  EXPECT_NEAR(only(*read).outline.area(), 20 * 30 * 0.0254 * 0.0254, 1e-9);
  ASSERT_THAT(read->notes, SizeIs(1));
  EXPECT_THAT(text(read->notes[0]), HasSubstr("guessed"));
}

TEST(Dxf, WhatCannotBeReadIsToldInASentence) {
  const auto why = [](const std::string& bytes) {
    const auto read = readCadPattern(bytes);
    return read ? std::string("read") : text(read.error().what);
  };
  EXPECT_THAT(why(""), HasSubstr("not whole"));
  EXPECT_THAT(why("a letter to a friend\nand more\n"), HasSubstr("This is no DXF text: line 1"));
  EXPECT_THAT(why("0\nSECTION\n2\n"), HasSubstr("ends in the middle of a group, at line 3"));
  EXPECT_THAT(why(Text().done()), HasSubstr("nothing is drawn on layer 1"));
  Text open;
  open.block("front_38").line(1, {{0, 0}, {300, 0}}).line(1, {{300, 400}, {0, 400}});
  EXPECT_THAT(why(open.endBlock().done()), HasSubstr("Piece “front”, size 38: the outline is open at"));
  Text many;
  many.block("front_38")
      .line(1, {{0, 0}, {300, 0}, {300, 400}, {0, 400}}, true)
      .points(4, std::vector<Flat>(3000, {100, 0}));
  EXPECT_THAT(why(many.endBlock().done()), HasSubstr("more than 2000 notches, holes or lines"));
  Text crossed;
  crossed.block("front_38").line(1, {{0, 0}, {300, 400}, {300, 0}, {0, 400}}, true);
  EXPECT_THAT(why(crossed.endBlock().done()), HasSubstr("crosses or touches itself"));
}

// Bytes changed, taken out and doubled: a sentence or a pattern whose outlines are whole.
TEST(Dxf, DamagedFilesAreRefusedOrWhole) {
  const std::string good = halfBacks();
  std::mt19937_64 dice(20261123);
  for (int seed = 0; seed < 2000; ++seed) {
    std::string bad = good;
    for (std::size_t i = 0, n = 1 + dice() % 8; i < n && bad.size() > 2; ++i) {
      const std::size_t at = dice() % bad.size(), size = std::min<std::size_t>(1 + dice() % 30, bad.size() - at);
      switch (dice() % 3) {
        case 0:
          bad[at] = static_cast<char>(dice() % 256);
          break;
        case 1:
          bad.erase(at, size);
          break;
        default:
          bad.insert(at, bad.substr(at, size));
      }
    }
    const auto read = readCadPattern(bad);
    if (!read) {
      EXPECT_FALSE(text(read.error().what).empty());
      continue;
    }
    for (const auto& [id, piece] : read->pattern.pieces) EXPECT_TRUE(checked(piece->outline)) << seed;
  }
}

// --- the real ones

fs::path sharedDxf(const std::string& name) { return fs::path(KARINUI_SHARED_DIR) / "patterns/dxf" / name; }

TEST(Dxf, FilesFromIndustryAreReadWhole) {
  if (!fs::exists(sharedDxf("README.md"))) GTEST_SKIP() << "no shared patterns beside the project";
  struct Row {
    const char* file;
    std::size_t pieces, sizes, inSample;
  };
  for (const Row& row : {Row{"tank_14_sizes_aama.dxf", 2, 14, 2}, Row{"shorts_aama.dxf", 3, 14, 3},
                         Row{"trousers_waistband_aama.dxf", 2, 14, 2}, Row{"trousers_waistband_astm.dxf", 2, 14, 2},
                         Row{"clo_pattern_astm.dxf", 9, 1, 9}, Row{"polo_drill_holes.dxf", 8, 15, 8}}) {
    SCOPED_TRACE(row.file);
    const auto read = readPatternSize(sharedDxf(row.file), {});
    ASSERT_TRUE(read) << text(read.error().what);
    EXPECT_EQ(told(*read), "");
    EXPECT_EQ(read->rows.size(), row.pieces);
    EXPECT_EQ(read->sizes.size(), row.sizes);
    EXPECT_EQ(read->pattern.pieces.size(), row.inSample);
  }
}

TEST(Dxf, BothDialectsOfOneStyleGiveTheSameOutlines) {
  if (!fs::exists(sharedDxf("README.md"))) GTEST_SKIP() << "no shared patterns beside the project";
  const auto aama = readPatternSize(sharedDxf("trousers_waistband_aama.dxf"), {}),
             astm = readPatternSize(sharedDxf("trousers_waistband_astm.dxf"), {});
  ASSERT_TRUE(aama && astm);
  for (const auto& [id, piece] : astm->pattern.pieces) {
    const Piece& other = *aama->pattern.pieces.at(id);
    ASSERT_EQ(other.outline.edges.size(), piece->outline.edges.size());
    EXPECT_NEAR(other.outline.area() / piece->outline.area(), 1, 5e-4);
    for (std::size_t e = 0; e < piece->outline.edges.size(); ++e)
      EXPECT_NEAR(other.outline.edges[e].curve.length(), piece->outline.edges[e].curve.length(), 1e-3);
  }
}

}  // namespace
}  // namespace karinui

#include "karinui/exchange/pattern_json.h"

#include <gtest/gtest.h>

#include "karinui/design/script.h"
#include "karinui/design/steps_of.h"
#include "karinui/exchange/dxf.h"
#include "karinui/exchange/formats.h"
#include "patterns.h"

namespace karinui {
namespace {

void expectSame(const Piece& a, const Piece& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.outline, b.outline) << a.name;
  EXPECT_EQ(a.holes, b.holes) << a.name;
  EXPECT_EQ(a.lines, b.lines) << a.name;
  EXPECT_EQ(a.marks, b.marks) << a.name;
  EXPECT_EQ(a.grain, b.grain) << a.name;
  EXPECT_EQ(a.fabric, b.fabric);
  EXPECT_EQ(a.layer, b.layer);
  EXPECT_EQ(a.frozen, b.frozen);
  EXPECT_EQ(a.mirrorOf, b.mirrorOf);
  EXPECT_EQ(a.pose, b.pose) << a.name;
  ASSERT_EQ(!a.form, !b.form);
  if (a.form) {
    EXPECT_EQ(a.form->flat, b.form->flat);
    EXPECT_EQ(a.form->space, b.form->space);
    EXPECT_EQ(a.form->faces, b.form->faces);
  }
}

TEST(PatternJson, ReadsBackExactly) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    Pattern once = test::random(seed);
    Piece odd = *once.pieces.begin()->second;
    odd.name = "前身頃 <&\"'> ../\\";
    odd.frozen = true;
    odd.mirrorOf = madeBy<PieceId>(7, 1);
    odd.form = std::make_shared<const Form>(
        Form{{{0, 0}, {0.1, 0}, {0, 1.0 / 3}}, {{0, 0, 0}, {0.1, 0, 0.05}, {0, 0.3, 0}}, {{0, 1, 2}}});
    once.pieces[odd.id] = std::make_shared<const Piece>(odd);
    const std::string text = writePatternJson(once);
    const auto again = readPatternJson(text);
    ASSERT_TRUE(again) << karinui::text(again.error().what);
    ASSERT_EQ(again->pieces.size(), once.pieces.size());
    for (const auto& [id, piece] : once.pieces) expectSame(*piece, *again->pieces.at(id));
    EXPECT_EQ(again->seams, once.seams);
    EXPECT_EQ(writePatternJson(*again), text);
  }
}

TEST(PatternJson, AllowancesAreToldBesideThePattern) {
  const Pattern once = test::random(3);
  Allowances own;
  const PieceId first = once.pieces.begin()->first;
  own.edges[{first, "side_0"}] = 0.025;
  const AllowancePlan plan(once, own);
  const std::string written = writePatternJson(once, &plan);
  const auto json = nlohmann::json::parse(written);
  EXPECT_EQ(json["pieces"][0]["allowances"]["side_0"], 0.025);
  EXPECT_EQ(json["pieces"][0]["allowances"]["hole_a"], plan.width(first, "hole_a"));
  // The pattern beside them is as it was, and of the widths those come back that are not as usual.
  Allowances told;
  const auto again = readPatternJson(written, &told);
  ASSERT_TRUE(again);
  EXPECT_EQ(writePatternJson(*again), writePatternJson(once));
  EXPECT_EQ(told, own);
  const AllowancePlan after(*again, told);
  EXPECT_EQ(writePatternJson(*again, &after), written);
  for (const char* wrong : {"0.5", "-0.01", "\"wide\""}) {
    std::string broken = written;
    broken.replace(broken.find("\"side_0\": 0.025") + 10, 5, wrong);
    const auto refused = readPatternJson(broken);
    ASSERT_FALSE(refused);
    EXPECT_NE(text(refused.error().what).find("allowances"), std::string::npos);
  }
}

// What an import makes of them: steps that lead to the same file.
TEST(PatternJson, AllowancesGoThroughAnImport) {
  Pattern once = test::random(3);
  once.seams.clear();
  for (auto& [id, piece] : once.pieces) {
    Piece plain = *piece;
    plain.marks.clear(), plain.fabric = "cotton";
    piece = std::make_shared<const Piece>(plain);
  }
  Allowances own;
  const PieceId first = once.pieces.begin()->first;
  own.edges[{first, "side_0"}] = 0.025, own.edges[{first, "hole_a"}] = 0.003;
  const AllowancePlan plan(once, own);
  const auto read = fileFormat("karinui").readSize(writePatternJson(once, &plan), {}, 0);
  ASSERT_TRUE(read);
  Workers workers(1);
  MemoryBlobs blobs;
  Bodies bodies;
  Token token;
  Context context{workers, token, blobs, bodies, {}, {}};
  Document document;
  for (const Operation& step : stepsOf(read->pattern, document, read->grading, read->cutting)) {
    auto next = apply(document, step, context);
    ASSERT_TRUE(next) << text(next.error().what);
    document = *std::move(next);
  }
  const PieceId piece = document.pattern.pieces.begin()->first;
  EXPECT_EQ(document.allowances.edges.size(), 1u);
  EXPECT_EQ(document.allowances.edges.at({piece, "side_0"}), 0.025);
  ASSERT_EQ(read->notes.size(), 1u);
  EXPECT_NE(text(read->notes[0]).find("of holes"), std::string::npos);
}

// A pattern that was cut from a fabric of its own document's, as one that was measured, is read elsewhere.
TEST(PatternJson, APatternOfAFabricThatIsNotKnownHereIsRead) {
  Pattern once = test::random(3);
  once.seams.clear();
  std::size_t n = 0;
  for (auto& [id, piece] : once.pieces) {
    Piece own = *piece;
    own.marks.clear(), own.fabric = n++ == 0 ? "Shirt_cotton" : n == 2 ? "no name; at all" : "denim";
    piece = std::make_shared<const Piece>(own);
  }
  ASSERT_GE(n, 2u);
  Workers workers(1);
  MemoryBlobs blobs;
  Bodies bodies;
  Token token;
  Context context{workers, token, blobs, bodies, {}, {}};
  Document document;
  const auto take = [&](const Pattern& pattern) {
    for (const Operation& step : stepsOf(pattern, document)) {
      auto next = apply(document, step, context);
      ASSERT_TRUE(next) << text(next.error().what);
      document = *std::move(next);
    }
  };
  const auto said = unknownFabricsSaid(once, document);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(text(said[0]).find("Shirt cotton"), std::string::npos) << text(said[0]);
  take(once);
  auto piece = document.pattern.pieces.begin();
  EXPECT_EQ(piece->second->fabric, "Shirt_cotton");
  EXPECT_EQ(std::next(piece)->second->fabric, "cotton") << "what is no name of a fabric";
  ASSERT_TRUE(document.fabrics.contains("Shirt_cotton"));
  EXPECT_EQ(document.fabrics.at("Shirt_cotton").weight, preset("cotton")->weight);
  // Where the fabric is known it is left as it is.
  document.fabrics.at("Shirt_cotton").weight = 0.3;
  EXPECT_TRUE(unknownFabricsSaid(once, document).empty());
  take(once);
  EXPECT_EQ(document.fabrics.at("Shirt_cotton").weight, 0.3);
}

// The values of fabrics are told, and a document that is made of the file has the same.
TEST(PatternJson, FabricsComeBackWithTheirValues) {
  Pattern once = test::random(4);
  once.seams.clear();
  for (auto& [id, piece] : once.pieces) {
    Piece own = *piece;
    own.marks.clear(), own.fabric = "my_wool";
    piece = std::make_shared<const Piece>(own);
  }
  Fabric wool = *preset("linen");
  wool.name = "my_wool", wool.weight = 0.3217, wool.bendWarp = 1.0 / 30000, wool.toeWeft = 0.0031;
  const std::map<std::string, Fabric> told{{"my_wool", wool}, {"cotton", *preset("cotton")}};
  SheetSettings sheet;
  sheet.fabrics = told;
  const std::string written = writePatternJson(once, nullptr, told);
  const auto drawn = writeSvg(once, sheet);
  ASSERT_TRUE(drawn) << text(drawn.error().what);
  const auto fromDrawing = readDrawing(*drawn);
  ASSERT_TRUE(fromDrawing) << text(fromDrawing.error().what);
  std::map<std::string, Fabric> fabrics;
  const auto again = readPatternJson(written, nullptr, &fabrics);
  ASSERT_TRUE(again) << text(again.error().what);
  for (const auto& read : {fabrics, fromDrawing->fabrics}) {
    ASSERT_EQ(read.size(), 1u) << "only those that a piece is cut from";
    EXPECT_EQ(read.at("my_wool"), wool);
  }
  EXPECT_EQ(writePatternJson(*again, nullptr, fabrics), written);
  Workers workers(1);
  MemoryBlobs blobs;
  Bodies bodies;
  Token token;
  Context context{workers, token, blobs, bodies, {}, {}};
  const auto made = [&](Document document) {
    for (const Operation& step : stepsOf(*again, document, {}, {}, nullptr, fabrics)) {
      auto next = apply(document, step, context);
      EXPECT_TRUE(next) << text(next.error().what);
      if (next) document = *std::move(next);
    }
    return document;
  };
  EXPECT_TRUE(unknownFabricsSaid(*again, {}, fabrics).empty());
  EXPECT_EQ(made({}).fabrics.at("my_wool"), wool);
  // What the garment has under that name is not changed, and that is told.
  Document own;
  own.fabrics["my_wool"] = wool, own.fabrics["my_wool"].weight = 0.5;
  EXPECT_EQ(made(own).fabrics.at("my_wool").weight, 0.5);
  const auto said = unknownFabricsSaid(*again, own, fabrics);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(text(said[0]).find("of its own"), std::string::npos) << text(said[0]);
  for (const char* wrong : {"\"weight\": -1", "\"weight\": \"heavy\"", "\"weight\": 1e9"}) {
    std::string broken = written;
    const std::size_t at = broken.find("\"weight\": ");
    broken.replace(at, broken.find_first_of(",\n", at) - at, wrong);
    EXPECT_FALSE(readPatternJson(broken)) << wrong;
  }
}

// What was bent on a body stands as it stood, and what was frozen stays so.
TEST(PatternJson, PiecesStandAsTheFileSays) {
  Pattern once = test::random(3);
  once.seams.clear();
  for (auto& [id, piece] : once.pieces) {
    Piece bent = *piece;
    bent.marks.clear(), bent.fabric = "cotton";
    Form form;
    form.flat = bent.outline.flattened(1e-3);
    for (const Flat p : form.flat) form.space.push_back({p.u, p.v, 0.3 * p.u * p.u});
    for (std::uint32_t i = 1; i + 1 < form.flat.size(); ++i) form.faces.push_back({0, i, i + 1});
    bent.form = std::make_shared<const Form>(std::move(form));
    bent.frozen = id == once.pieces.begin()->first;
    piece = std::make_shared<const Piece>(bent);
  }
  const auto read = fileFormat("karinui").readSize(writePatternJson(once), {}, 0);
  ASSERT_TRUE(read);
  Workers workers(1);
  MemoryBlobs blobs, others;
  Bodies bodies;
  Token token;
  Context context{workers, token, blobs, bodies, {}, {}}, elsewhere{workers, token, others, bodies, {}, {}};
  Document document;
  const auto steps = stepsOf(read->pattern, document, read->grading, read->cutting, &blobs);
  for (const Operation& step : steps) {
    const auto again = parseOperation(text(step));
    ASSERT_TRUE(again);
    auto next = apply(document, *again, context);
    ASSERT_TRUE(next) << text(next.error().what);
    document = *std::move(next);
  }
  ASSERT_EQ(document.pattern.pieces.size(), once.pieces.size());
  auto was = once.pieces.begin();
  for (const auto& [id, piece] : document.pattern.pieces) {
    const Piece& wanted = *(was++)->second;
    ASSERT_TRUE(piece->form) << piece->name;
    EXPECT_EQ(piece->form->flat, wanted.form->flat);
    EXPECT_EQ(piece->form->space, wanted.form->space);
    EXPECT_EQ(piece->form->faces, wanted.form->faces);
    EXPECT_LT(distance(piece->pose({0.1, 0.2, 0.3}), wanted.pose({0.1, 0.2, 0.3})), 1e-12);
    EXPECT_EQ(piece->frozen, wanted.frozen);
  }
  // The steps alone do not hold the shapes; where these are not wanted, nobody asks for them.
  const auto refused = apply({}, steps.front(), elsewhere);
  ASSERT_FALSE(refused);
  EXPECT_NE(text(refused.error().what).find("leave bent away"), std::string::npos);
  const auto flat = apply({}, stepsOf(read->pattern, {}).front(), elsewhere);
  ASSERT_TRUE(flat);
  EXPECT_FALSE(flat->pattern.pieces.begin()->second->form);
}

// A shape that no drape leaves is refused when it is to stand.
TEST(PatternJson, RefusesShapesOutOfTheRoom) {
  Pattern once = test::random(3);
  Piece bent = *once.pieces.begin()->second;
  bent.marks.clear(), bent.fabric = "cotton";
  for (const double far : {0.0, 1e6}) {
    bent.form = std::make_shared<const Form>(
        Form{{{0, 0}, {0.1, 0}, {0, 0.1}}, {{0, 0, 0}, {0.1, 0, far}, {0, 0.1, 0}}, {{0, 1, 2}}});
    Pattern one;
    one.pieces[bent.id] = std::make_shared<const Piece>(bent);
    Workers workers(1);
    MemoryBlobs blobs;
    Bodies bodies;
    Token token;
    Context context{workers, token, blobs, bodies, {}, {}};
    EXPECT_EQ(static_cast<bool>(apply({}, stepsOf(one, {}, {}, {}, &blobs).front(), context)), far == 0) << far;
  }
}

TEST(PatternJson, DraftedPatternsToo) {
  if (!exists(test::shared("patterns/shirt_m_eu50.json"))) GTEST_SKIP() << "the shared patterns are not here";
  for (const std::string name :
       {"shirt_m_eu50", "bodice_block_f_eu38", "trouser_block_m_eu50", "pencil_skirt_f_eu38"}) {
    const Pattern once = test::drafted(test::shared("patterns/" + name + ".json"));
    ASSERT_FALSE(once.pieces.empty()) << name;
    const auto again = readPatternJson(writePatternJson(once));
    ASSERT_TRUE(again) << name;
    for (const auto& [id, piece] : once.pieces) expectSame(*piece, *again->pieces.at(id));
  }
}

TEST(PatternJson, RefusesWhatCannotBe) {
  const std::string good = writePatternJson(test::random(3));
  const auto broken = [&](const std::string& what, const std::string& by) {
    std::string json = good;
    const std::size_t at = json.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    json.replace(at, what.size(), by);
    const auto result = readPatternJson(json);
    EXPECT_FALSE(result) << what << " -> " << by;
    return result ? std::string() : text(result.error().what);
  };
  EXPECT_NE(broken("karinui-pattern-1", "karinui-pattern-9").find("format"), std::string::npos);
  EXPECT_NE(broken("\"piece 1\"", "\"piece 0\"").find("two pieces"), std::string::npos);
  EXPECT_NE(broken("\"side_0\"", "\"side 0\"").find("name"), std::string::npos);
  EXPECT_NE(broken("\"grain\": [", "\"grain\": [7,").find("grain"), std::string::npos);
  EXPECT_NE(broken("\"from\": 0", "\"from\": 2").find("from"), std::string::npos);
  EXPECT_NE(broken("\"tie\": \"1:1\"", "\"tie\": \"3:1\"").find("tie"), std::string::npos);
  EXPECT_NE(broken("\"id\": 458752", "\"id\": -1").find("id"), std::string::npos);
  EXPECT_FALSE(broken("\"start\": [", "\"start\": [1e9,").empty());
  for (std::size_t cut = 0; cut + 2 < good.size(); cut += 97) EXPECT_FALSE(readPatternJson(good.substr(0, cut))) << cut;
}

TEST(PatternJson, EveryMalformedJsonIsRefused) {
  if (!exists(test::shared("badinput/json"))) GTEST_SKIP() << "the shared bad input is not here";
  for (const auto& file : std::filesystem::recursive_directory_iterator(test::shared("badinput/json")))
    if (file.path().extension() == ".json") {
      EXPECT_FALSE(readPatternJson(test::content(file.path()))) << file.path().filename();
    }
}

}  // namespace
}  // namespace karinui

#include "karinui/exchange/garment_code.h"

#include <gtest/gtest.h>

#include "patterns.h"

namespace karinui {
namespace {

using test::content;
using test::shared;

Pattern readGarment(const std::string& text) {
  auto pattern = readGarmentCode(text);
  EXPECT_TRUE(pattern) << (pattern ? "" : karinui::text(pattern.error().what));
  return pattern ? *pattern : Pattern{};
}

const Piece& named(const Pattern& pattern, const std::string& name) {
  for (const auto& [id, piece] : pattern.pieces)
    if (piece->name == name) return *piece;
  ADD_FAILURE() << "no piece " << name;
  return *pattern.pieces.begin()->second;
}

Vec3 centre(const Piece& piece) {
  Vec3 sum;
  for (const Edge& edge : piece.outline.edges) sum += piece.pose({edge.curve.start.u, edge.curve.start.v, 0});
  return sum * (1.0 / static_cast<double>(piece.outline.edges.size()));
}

// A square panel of 20 cm with one edge replaced.
std::string square(const std::string& curvature, const std::string& more = "") {
  return R"({"pattern":{"panels":{"p":{"translation":[0,0,0],"rotation":[0,0,0],"vertices":[[0,0],[20,0],[20,20],[0,20]],
    "edges":[{"endpoints":[0,1])" +
         (curvature.empty() ? "" : ",\"curvature\":" + curvature) +
         R"(},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}]}})" + more + "}}";
}

TEST(GarmentCode, ReadsTheShirt) {
  if (!exists(shared("patterns/garmentcode"))) GTEST_SKIP() << "the shared patterns are not here";
  const Pattern shirt = readGarment(content(shared("patterns/garmentcode/shirt_mean_specification.json")));
  EXPECT_EQ(shirt.pieces.size(), 8u);
  EXPECT_EQ(shirt.seams.size(), 18u);
  for (const auto& [id, piece] : shirt.pieces) {
    EXPECT_GT(piece->outline.area(), 0) << piece->name;
    const Vec3 at = centre(*piece), outward = piece->pose.turned({0, 0, 1});
    const bool front = piece->name.find("ftorso") != std::string::npos || piece->name.ends_with("_f");
    EXPECT_EQ(at.z > 0, front) << piece->name;
    EXPECT_NEAR(outward.z, front ? 1 : -1, 1e-9)
        << piece->name << ": the right side of the fabric looks away from the body";
    EXPECT_EQ(at.x > 0, piece->name.starts_with("left")) << piece->name << ": the body's left is +x";
    if (piece->name.find("sleeve") != std::string::npos) {
      EXPECT_GT(std::abs(at.x), 0.3) << piece->name;
    }
  }
  EXPECT_NEAR(named(shirt, "left_ftorso").pose.carry.y, 0.9457103, 1e-6);
}

TEST(GarmentCode, StitchedEdgesFitTogether) {
  if (!exists(shared("patterns/garmentcode"))) GTEST_SKIP() << "the shared patterns are not here";
  for (const std::string name : {"shirt_mean", "dress_pencil"}) {
    const Pattern pattern = readGarment(content(shared("patterns/garmentcode/" + name + "_specification.json")));
    for (const auto& [id, seam] : pattern.seams) {
      EXPECT_TRUE(seam.reversed) << name << " " << seam.name;
      // The dress is gathered at its waist by three tenths; the shirt is sewn even but for its sleeves.
      EXPECT_LT(easeRatio(pattern, seam), name == "shirt_mean" ? 1.03 : 1.31) << name << " " << seam.name;
      // The ends that are to meet are nearer to each other than to the other ends.
      const auto place = [&](const EdgeSpan& span, bool end) {
        const Piece& piece = *pattern.pieces.at(span.piece);
        const Curve& curve = findEdge(piece, span.edge)->curve;
        const Flat p = end ? curve.end : curve.start;
        return piece.pose({p.u, p.v, 0});
      };
      const double straight = distance(place(seam.a[0], false), place(seam.b[0], true)) +
                              distance(place(seam.a[0], true), place(seam.b[0], false));
      const double crossed = distance(place(seam.a[0], false), place(seam.b[0], false)) +
                             distance(place(seam.a[0], true), place(seam.b[0], true));
      EXPECT_LE(straight, crossed + 1e-3) << name << " " << seam.name;
    }
  }
}

TEST(GarmentCode, KeepsLabelsAndNumbers) {
  if (!exists(shared("patterns/garmentcode"))) GTEST_SKIP() << "the shared patterns are not here";
  const Pattern dress = readGarment(content(shared("patterns/garmentcode/dress_pencil_specification.json")));
  EXPECT_EQ(dress.pieces.size(), 6u);
  EXPECT_EQ(dress.seams.size(), 23u);
  EXPECT_TRUE(findEdge(named(dress, "skirt_front"), "lower_interface"));
  EXPECT_TRUE(findEdge(named(dress, "skirt_front"), "lower_interface_3"));
  EXPECT_TRUE(findEdge(named(dress, "skirt_front"), "edge_0"));
}

TEST(GarmentCode, CurvesAreTheirsExactly) {
  // Quadratic with its control point at (10, 4) cm: both spellings; y at the middle is half the control's.
  for (const std::string bend : {"[0.5,0.2]", R"({"type":"quadratic","params":[[0.5,0.2]]})"}) {
    const Pattern p = readGarment(square(bend));
    const Curve& curve = p.pieces.begin()->second->outline.edges[0].curve;
    EXPECT_NEAR(curve.at(0.5).v, 0.02, 1e-12);
    EXPECT_NEAR(curve.at(0.25).v, 2 * 0.25 * 0.75 * 0.04, 1e-12);
  }
  const Pattern cubic = readGarment(square(R"({"type":"cubic","params":[[0.2,0.1],[0.7,-0.1]]})"));
  EXPECT_NEAR(distance(cubic.pieces.begin()->second->outline.edges[0].curve.control2, {0.14, -0.02}), 0, 1e-12);
  // A half circle to the right of the edge, and three quarters of one.
  const Pattern half = readGarment(square(R"({"type":"circle","params":[10,0,1]})"));
  EXPECT_NEAR(half.pieces.begin()->second->outline.area(), 0.04 + M_PI * 0.005, 1e-9);
  const Pattern more = readGarment(square(R"({"type":"circle","params":[14.142135623730951,1,1]})"));
  EXPECT_NEAR(more.pieces.begin()->second->outline.edges[0].curve.length(), 1.5 * M_PI * 0.14142135623730951, 1e-9);
  EXPECT_LT(more.pieces.begin()->second->outline.edges[0].curve.at(0.5).v, -0.2);
}

// Programs leave edges of a fraction of a millimetre where two curves nearly meet: they are kept, with what is stitched
// to them, and written again.
TEST(GarmentCode, KeepsEdgesMuchShorterThanACell) {
  const std::string text = R"({"pattern":{"panels":{
    "a":{"translation":[0,0,10],"rotation":[0,0,0],"vertices":[[0,0],[20,0],[20,29.91],[19.99,30],[0,30]],
         "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},{"endpoints":[4,0]}]},
    "b":{"translation":[0,0,-10],"rotation":[0,180,0],"vertices":[[0,0],[20,0],[20,29.91],[19.99,30],[0,30]],
         "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},{"endpoints":[4,0]}]}},
    "stitches":[[{"panel":"a","edge":1},{"panel":"b","edge":4}],[{"panel":"a","edge":2},{"panel":"b","edge":2}]]}})";
  const Pattern first = readGarment(text);
  ASSERT_EQ(first.pieces.size(), 2u);
  EXPECT_NEAR(findEdge(named(first, "a"), "edge_2")->curve.length(), 0.00090554, 1e-7);
  EXPECT_EQ(first.seams.size(), 2u);
  const auto written = writeGarmentCode(first);
  ASSERT_TRUE(written);
  const Pattern again = readGarment(*written);
  EXPECT_EQ(test::difference(first, again, 1e-12), "");
  EXPECT_EQ(again.seams.size(), 2u);
  for (const auto& [id, piece] : first.pieces)
    EXPECT_LT(distance(centre(*piece), centre(named(again, piece->name))), 1e-12) << piece->name;
}

TEST(GarmentCode, TurnsAboutXThenYThenZ) {
  std::string text = square("");
  text.replace(text.find("\"rotation\":[0,0,0]"), 18, "\"rotation\":[90,0,90]");
  text.replace(text.find("\"translation\":[0,0,0]"), 21, "\"translation\":[1,2,3]");
  const Pattern pattern = readGarment(text);
  const Vec3 up = pattern.pieces.begin()->second->pose({0.1, 0.2, 0});
  EXPECT_NEAR(distance(up, {0.01, 0.02 + 0.1, 0.03 + 0.2}), 0, 1e-12);  // x turns v up to z, then z turns u to y
}

TEST(GarmentCode, HonoursUnits) {
  const Pattern inches = readGarment(square("", R"(},"properties":{"units_in_meter":39.37007874015748)"));
  EXPECT_NEAR(inches.pieces.begin()->second->outline.length(), 80 * 0.0254, 1e-9);
}

TEST(GarmentCode, OlderFilesMeetAtTheNearerEnds) {
  // Front and back both counter-clockwise in one frame: the rule of the right side would twist every side seam.
  const std::string panel =
      R"({"rotation":[0,0,0],"vertices":[[0,0],[20,0],[20,30],[0,30]],"edges":[{"endpoints":[0,1]},
    {"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}],"translation":)";
  const Pattern pattern = readGarment(R"({"pattern":{"panels":{"front":)" + panel + "[0,0,10]},\"back\":" + panel +
                                      R"([0,0,-10]}},"stitches":[[{"panel":"front","edge":1},{"panel":"back","edge":1}],
                               [{"panel":"front","edge":3},{"panel":"back","edge":3}]]}})");
  for (const auto& [id, seam] : pattern.seams) EXPECT_FALSE(seam.reversed);
}

TEST(GarmentCode, RightToWrongIsKept) {
  const std::string stitch = R"(,"stitches":[[{"panel":"p","edge":0},{"panel":"p","edge":2},"right_wrong"]])";
  EXPECT_FALSE(readGarment(square("", stitch)).seams.begin()->second.reversed);
}

TEST(GarmentCode, WritesWhatItReads) {
  if (!exists(shared("patterns/garmentcode"))) GTEST_SKIP() << "the shared patterns are not here";
  for (const std::string name : {"shirt_mean", "dress_pencil"}) {
    const Pattern once = readGarment(content(shared("patterns/garmentcode/" + name + "_specification.json")));
    const auto written = writeGarmentCode(once);
    ASSERT_TRUE(written);
    const Pattern again = readGarment(*written);
    EXPECT_EQ(test::difference(once, again, 1e-9), "");
    ASSERT_EQ(once.seams.size(), again.seams.size());
    for (const auto& [id, seam] : once.seams) EXPECT_EQ(seam.a, again.seams.at(id).a) << seam.name;
    for (const auto& [id, piece] : once.pieces) {
      const Rigid &a = piece->pose, &b = again.pieces.at(id)->pose;
      EXPECT_NEAR(distance(a({0.3, 0.2, 0}), b({0.3, 0.2, 0})), 0, 1e-9);
    }
  }
}

TEST(GarmentCode, SplitsEdgesWhereSeamsEnd) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Pattern once = test::random(seed);
    const auto written = writeGarmentCode(once);
    ASSERT_TRUE(written) << seed;
    const Pattern again = readGarment(*written);
    double before = 0, after = 0;
    for (const auto& [id, seam] : once.seams) before += length(once, seam.a);
    for (const auto& [id, seam] : again.seams) after += length(again, seam.a);
    EXPECT_NEAR(before, after, 5e-5) << seed;
    ASSERT_EQ(once.pieces.size(), again.pieces.size());
    auto other = again.pieces.begin();
    for (const auto& [id, piece] : once.pieces) {
      EXPECT_NEAR(piece->outline.length(), other->second->outline.length(), 5e-5) << seed << piece->name;
      EXPECT_NEAR(distance(piece->pose({0.1, 0.2, 0}), other->second->pose({0.1, 0.2, 0})), 0, 1e-9) << seed;
      ++other;
    }
    EXPECT_GT(again.seams.size(), once.seams.size());
    // A seam keeps its ease in every part it was split into.
    const Seam& two = once.seams.at(madeBy<SeamId>(8, 2));
    const double ease = length(once, two.a) / length(once, two.b);
    std::size_t parts = 0;
    for (const auto& [id, seam] : again.seams)
      if (!seam.reversed) {
        EXPECT_NEAR(length(again, seam.a) / length(again, seam.b), ease, 1e-4);
        ++parts;
      }
    EXPECT_GE(parts, 2u);
  }
}

TEST(GarmentCode, RefusesWithASentence) {
  const auto sentence = [](const std::string& json) {
    const auto result = readGarmentCode(json);
    return result ? std::string("accepted") : text(result.error().what);
  };
  EXPECT_NE(sentence("").find("empty"), std::string::npos);
  EXPECT_NE(sentence("{}").find("no pattern that is read here"), std::string::npos);
  EXPECT_NE(sentence("[1,2]").find("no pattern that is read here"), std::string::npos);
  EXPECT_NE(sentence("{\n \"a\": [1,\n  2,, 3]}").find("line 3, column 5"), std::string::npos);
  EXPECT_NE(sentence("{\"a\": [1,").find("breaks off in line 1, column 10"), std::string::npos);
  EXPECT_NE(sentence(square("[0.5,NaN]")).find("not JSON"), std::string::npos);
  EXPECT_NE(sentence(square("[0.5,1e999]")), "accepted");
  EXPECT_NE(sentence(square("[0.5,1e300]")), "accepted");
  EXPECT_NE(sentence(square(R"({"type":"spiral","params":[]})")).find("edge 0"), std::string::npos);
  EXPECT_NE(sentence(square(R"({"type":"circle","params":[-1,0,1]})")).find("circle"), std::string::npos);
  EXPECT_NE(sentence(square(R"({"type":"cubic","params":[[0,0]]})")).find("control points"), std::string::npos);
  EXPECT_NE(sentence(square("", R"(,"stitches":[[{"panel":"q","edge":0},{"panel":"p","edge":1}]])")).find("\"q\""),
            std::string::npos);
  EXPECT_NE(sentence(square("", R"(,"stitches":[[{"panel":"p","edge":9},{"panel":"p","edge":1}]])")).find("no edge 9"),
            std::string::npos);
  EXPECT_NE(sentence(square("", R"(,"stitches":[[{"panel":"p","edge":-1},{"panel":"p","edge":1}]])")), "accepted");
  EXPECT_NE(sentence(square("", R"(,"stitches":{})")), "accepted");
  EXPECT_NE(sentence(square("", R"(,"panels":{})")).find("twice"), std::string::npos);
  EXPECT_NE(sentence(square("", R"(,"panel_order":["q"])")).find("panel_order names the panel \"q\""),
            std::string::npos);
  EXPECT_NE(sentence(square("", R"(},"properties":{"units_in_meter":1)")).find("20 m long, for units_in_meter is 1."),
            std::string::npos);
  EXPECT_NE(sentence(square("", R"(,"panel_order":[7])")).find("panel_order"), std::string::npos);
  std::string open = square("");
  open.replace(open.find("[3,0]"), 5, "[3,1]");
  EXPECT_NE(sentence(open).find("not closed"), std::string::npos);
  std::string wild = square("");
  wild.replace(wild.find("[2,3]"), 5, "[2,7]");
  EXPECT_NE(sentence(wild).find("edge 2"), std::string::npos);
  std::string bow = square("");
  bow.replace(bow.find("[20,20],[0,20]"), 14, "[0,20],[20,20]");
  EXPECT_NE(sentence(bow).find("Panel \"p\""), std::string::npos);
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "[";
  EXPECT_NE(sentence(deep).find("levels deep"), std::string::npos);
  const std::string whole = square("[0.5,0.2]");
  for (std::size_t cut = 0; cut < whole.size(); ++cut) EXPECT_FALSE(readGarmentCode(whole.substr(0, cut))) << cut;
}

TEST(GarmentCode, EveryMalformedJsonIsRefused) {
  if (!exists(shared("badinput/json"))) GTEST_SKIP() << "the shared bad input is not here";
  std::size_t seen = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(shared("badinput/json"))) {
    if (file.path().extension() != ".json") continue;
    const auto result = readGarmentCode(content(file.path()));
    EXPECT_FALSE(result) << file.path().filename();
    if (!result) {
      EXPECT_FALSE(text(result.error().what).empty());
    }
    ++seen;
  }
  EXPECT_GT(seen, 150u);
}

}  // namespace
}  // namespace karinui

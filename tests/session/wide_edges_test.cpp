// A garment whose upper edge is wider than the waist is told of; one that hangs from above, or is held, is not.
#include "karinui/session/wide_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/workroom.h"

namespace karinui {
namespace {

std::vector<std::string> told(const std::string& script) {
  static Bodies bodies;
  Workers workers;
  Token token;
  MemoryBlobs blobs;
  Context context{workers,
                  token,
                  blobs,
                  bodies,
                  [](const Document& of, const DrapePieces&, Context&) {
                    std::vector<PieceRef> all;
                    for (const auto& [id, piece] : of.pattern.pieces) all.push_back(id);
                    return fallABit(of, all);
                  },
                  {}};
  Document document;
  const auto lines = parseScript("body size=jis9ar\nset spacing=40mm\n" + script);
  EXPECT_TRUE(lines) << text(lines.error().what);
  for (const ScriptLine& line : *lines) {
    auto next = apply(document, line.operation, context);
    EXPECT_TRUE(next) << text(line.operation) << ": " << text(next.error().what);
    if (next) document = *std::move(next);
  }
  std::vector<std::string> all;
  for (const WideEdge& edge : wideEdges(*snapshotOf(document, *bodyOf(document, context))))
    all.push_back(text(wideEdgeSaid(document, edge)));
  return all;
}

// Two panels round the trunk, as wide as said, their upper edges at a level or so far below it.
std::string skirt(const std::string& width, const std::string& level, const std::string& below = "0") {
  std::string script;
  for (const auto& [name, around] : {std::pair("front", "0"), std::pair("back", "0.5")})
    script += std::string("rectangle name=") + name + " width=\"" + width + "\" height=30cm\nplace piece=" + name +
              " at=\"" + level + "@" + around + "\" point=\"(" + width + ")/2,30cm\" ease=5mm\n";
  if (below != "0") script += "move piece=\"front back\" by=0,-" + below + ",0\n";
  return script + "sew a=front.side_right b=back.side_left\nsew a=front.side_left b=back.side_right\n";
}

TEST(WideEdges, OfASkirtThatHasSlidDownAreTold) {
  const auto all = told(skirt("waist_girth/2 + 6cm", "torso:waist-0.25") + "drape\n");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_THAT(all[0], testing::HasSubstr("has slid to"));
  EXPECT_THAT(all[0], testing::HasSubstr(
                          "top edge of front and the edges that go on from it, 76.0 cm round on a waist of 64.0 cm"));
}

TEST(WideEdges, OfASkirtThatFellDownTheLegsAreTold) {
  const auto all = told(skirt("hip_girth/2 + 10cm", "torso:waist-0.25", "45cm") + "drape\n");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_THAT(all[0], testing::StartsWith("Too wide to stay up: top edge of front"));
  // Narrow enough for the waist it would have stayed up.
  const auto narrow = told(skirt("waist_girth/2 - 2cm", "torso:waist-0.25", "45cm") + "drape\n");
  ASSERT_EQ(narrow.size(), 1u);
  EXPECT_THAT(narrow[0], testing::StartsWith("Off the hips: top edge of front"));
  EXPECT_THAT(narrow[0], testing::HasSubstr("on finer cells"));
  // Round one leg it is a stocking.
  const std::string stocking =
      "rectangle name=tube width=45cm height=20cm\nplace piece=tube at=\"left_leg:knee@0\" ease=1cm\n"
      "sew a=tube.side_left b=tube.side_right\ndrape\n";
  EXPECT_TRUE(told(stocking).empty());
}

// A wrapped skirt's ends lie over each other: what goes round is its length without what laps.
TEST(WideEdges, OfAWrappedSkirtAreTold) {
  std::string wrap;  // five panels round the hips, the fifth before the first
  for (const auto& [name, pose] :
       {std::pair("a", "0,0.75,0.2"), std::pair("b", "0.2,0.75,0 y 90deg"), std::pair("c", "0,0.75,-0.2 y 180deg"),
        std::pair("d", "-0.2,0.75,0 y 270deg"), std::pair("e", "0,0.75,0.21")})
    wrap += std::string("piece name=") + name +
            " outline=\"M -200 0; hem L 200 0; right L 200 200; top L -200 200; left L -200 0\" pose=\"" + pose +
            "\"\n";
  for (const auto& [one, next] : {std::pair("a", "b"), std::pair("b", "c"), std::pair("c", "d"), std::pair("d", "e")})
    wrap += std::string("sew a=") + one + ".right b=" + next + ".left\n";
  wrap += "fasten name=button a=e.right b=a.left count=1\n";
  const auto all = told(wrap + "drape\n");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_THAT(all[0], testing::HasSubstr("has slid to"));
  EXPECT_THAT(all[0], testing::HasSubstr("156.0 cm round"));
}

TEST(WideEdges, AreNotToldWhereNothingIsWrong) {
  const std::string wide = skirt("waist_girth/2 + 6cm", "torso:waist-0.25");
  EXPECT_TRUE(told(wide).empty()) << "not draped yet";
  EXPECT_TRUE(told(skirt("waist_girth/2 + 6cm", "torso:waist") + "drape\n").empty()) << "it lies at the waist";
  EXPECT_TRUE(told(skirt("waist_girth/2 + 4mm", "torso:waist-0.25") + "drape\n").empty()) << "it is no wider";
  EXPECT_TRUE(told(wide + "elastic edges=front.top length=25cm\ndrape\n").empty()) << "an elastic holds it";
  EXPECT_TRUE(told(wide + "pin piece=front at=2cm,28cm\ndrape\n").empty()) << "it is pinned";
  EXPECT_TRUE(told(wide + "drape\npose joint=hip flex=80deg\ndrape\n").empty()) << "the figure sits";
  // A strap over the shoulder: the edge is not the topmost.
  EXPECT_TRUE(told(wide +
                   "rectangle name=strap width=4cm height=50cm\nplace piece=strap at=\"torso:bust@0.1\" ease=5mm\n"
                   "sew a=strap.bottom b=front.top@0.4:0.5\ndrape\n")
                  .empty());
}

}  // namespace
}  // namespace karinui

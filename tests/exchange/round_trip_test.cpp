// Lengths, areas, grain and notches of random patterns through every format that is read back.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "karinui/exchange/dxf.h"
#include "karinui/exchange/formats.h"
#include "karinui/pattern/markings.h"
#include "patterns.h"

namespace karinui {
namespace {

struct Way {
  const char* format;
  bool names, grain, marks;  // whether it has a place for them; GarmentCode divides edges into single curves
};
std::ostream& operator<<(std::ostream& out, const Way& way) { return out << way.format; }

Result<Pattern> there(const Way& way, const Pattern& pattern) {
  SheetSettings sheet;
  sheet.allowance = 0.01;
  const auto bytes = fileFormat(way.format).write({pattern, {}, {}, sheet});
  if (!bytes) return bytes.error();
  const FileFormat& reader = fileFormat(std::string_view(way.format).starts_with("dxf") ? "dxf-aama" : way.format);
  if (reader.readPattern) return reader.readPattern(*bytes);
  auto read = reader.readSize(*bytes, {}, 0);
  if (!read) return read.error();
  return std::move(read->pattern);
}

class RoundTrip : public ::testing::TestWithParam<Way> {};

TEST_P(RoundTrip, KeepsWhatATailorMeasures) {
  const Way& way = GetParam();
  for (unsigned seed = 31; seed <= 36; ++seed) {
    Pattern once = test::random(seed);
    // Edges are divided where a seam begins within them: that is not what is asked here.
    if (std::string_view(way.format) == "garmentcode") once.seams.clear();
    const auto again = there(way, once);
    ASSERT_TRUE(again) << seed << text(again.error().what);
    ASSERT_EQ(again->pieces.size(), once.pieces.size()) << seed;
    auto other = again->pieces.begin();
    for (const auto& [id, piece] : once.pieces) {
      const Piece& back = *(other++)->second;
      SCOPED_TRACE(std::to_string(seed) + " " + piece->name);
      EXPECT_NEAR(back.outline.area() / piece->outline.area(), 1, 5e-4);
      // Each edge lies on the outline that comes back, and the outline is no longer than they are together.
      const Ring ring = back.outline.flattened(1e-6);
      // GarmentCode's panels have a place of their own in space: theirs is compared by lengths alone.
      const bool placed = std::string_view(way.format) != "garmentcode";
      EXPECT_NEAR(back.outline.length(), piece->outline.length(),
                  5e-5 * static_cast<double>(piece->outline.edges.size()));
      for (const Edge& edge : piece->outline.edges) {
        const auto found = back.outline.find(edge.name);
        if (way.names && found) {
          EXPECT_NEAR(back.outline.edges[*found].curve.length(), edge.curve.length(), 5e-5) << edge.name;
        }
        for (const double f : {0.0, 0.2, 0.5, 0.7})
          EXPECT_TRUE(!placed || distanceToRing(ring, edge.curve.atFraction(f)) < 5e-5) << edge.name;
      }
      EXPECT_TRUE(!way.grain || std::abs(std::asin(cross(back.grain, piece->grain))) * 180 / std::numbers::pi < 0.1);
      if (!way.marks) continue;
      for (const Mark& mark : piece->marks) {
        const Flat place =
            mark.edge.empty() ? mark.place : findEdge(*piece, mark.edge)->curve.atFraction(mark.fraction);
        double nearest = 1e9;
        for (const Mark& one : back.marks)
          if (one.edge.empty() == mark.edge.empty())
            nearest = std::min(
                nearest, distance(place, one.edge.empty() ? one.place
                                                          : findEdge(back, one.edge)->curve.atFraction(one.fraction)));
        EXPECT_LT(nearest, 1e-4) << mark.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Values(Way{"svg", true, true, true}, Way{"karinui", true, true, true},
                                           Way{"garmentcode", false, false, false}, Way{"dxf-aama", false, true, true},
                                           Way{"dxf-astm", false, true, true}));

TEST(Hpgl, IsTrueToSize) {
  const Pattern pattern = test::random(5);
  const auto plot = fileFormat("hpgl").write({pattern, {}, {}, {}});
  ASSERT_TRUE(plot);
  EXPECT_TRUE(plot->starts_with("IN;"));
  EXPECT_NE(plot->find("PD"), std::string::npos);
  // The square's first side: 100 mm are 4000 units.
  EXPECT_NE(plot->find("PU800,800;PD800,4800,4800,4800,4800,800,800,800;"), std::string::npos);
  EXPECT_TRUE(std::all_of(plot->begin(), plot->end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
  EXPECT_FALSE(fileFormat("hpgl").write({Pattern(), {}, {}, {}}));
}

}  // namespace
}  // namespace karinui

#include "karinui/view/table_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace karinui {
namespace {

TableFrame square() {
  TablePiece piece;
  piece.name = "pocket";
  piece.colour = {0.25f, 0.38f, 0.60f};
  piece.low = {0, 0}, piece.high = {0.2, 0.2};
  const Flat corners[] = {{0, 0}, {0.2, 0}, {0.2, 0.2}, {0, 0.2}};
  for (std::size_t i = 0; i < 4; ++i) {
    TableEdge edge;
    edge.points = {corners[i], corners[(i + 1) % 4]};
    piece.edges.push_back(std::move(edge));
  }
  TableFrame frame;
  frame.pieces.push_back(std::move(piece));
  return frame;
}

// Pixels of nearly this colour in a part of the picture, given in fractions of it.
int count(const Image& image, Pixel wanted, double left, double top, double right, double bottom, int close = 40) {
  int found = 0;
  for (int y = static_cast<int>(top * image.height); y < bottom * image.height; ++y)
    for (int x = static_cast<int>(left * image.width); x < right * image.width; ++x) {
      const Pixel p = image.at(x, y);
      int away = 0;
      for (std::size_t c = 0; c < 3; ++c) away = std::max(away, std::abs(int{p[c]} - int{wanted[c]}));
      found += away <= close;
    }
  return found;
}
constexpr Pixel kInk{59, 54, 48, 255};

TEST(TablePicture, ShowsThePieceInItsFabricOnPaper) {
  const auto image = drawTable(square(), {400, 400, Language::English});
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 400);
  const Pixel inside = image->at(200, 180), outside = image->at(2, 2);
  EXPECT_GT(int{outside[0]}, 250);
  EXPECT_LT(int{inside[0]}, 235);
  EXPECT_GT(int{inside[2]}, int{inside[0]}) << "the fabric is blue";
  TableFrame holed = square();
  holed.pieces[0].holes.push_back(holed.pieces[0].edges);
  for (TableEdge& edge : holed.pieces[0].holes[0])
    for (Flat& p : edge.points) p = Flat{0.1, 0.1} + (p - Flat{0.1, 0.1}) * 0.3;
  const auto with = drawTable(holed, {400, 400, Language::English});
  EXPECT_EQ(with->at(200, 188), outside) << "through a hole one sees the paper";
}

TEST(TablePicture, ShowsSeamsNotchesAndLettering) {
  TableFrame frame = square();
  const auto plain = drawTable(frame, {600, 600, Language::English});
  TableSeam seam{"side", {0.0160f, 0.2462f, 0.0331f}, false, {}};
  seam.sides[0].runs = {{{{0.2, 0}, {0.2, 0.2}}, {{-1, 0}, {-1, 0}}}};
  frame.seams.push_back(seam);
  frame.pieces[0].labels = {{TableLabel::Says::Name, say("{0}", "pocket"), {0.1, 0.1}, 0.012, true}};
  frame.pieces[0].notches = {{{{0.1, 0}, {0.1, 0.02}}, true}};
  const auto image = drawTable(frame, {600, 600, Language::English});
  ASSERT_TRUE(image && plain);
  const Pixel green{0x22, 0x88, 0x33, 255};
  EXPECT_EQ(count(*plain, green, 0.5, 0, 1, 0.9), 0);
  EXPECT_GT(count(*image, green, 0.8, 0, 1, 0.9), 300) << "along the right edge";
  EXPECT_EQ(count(*image, green, 0, 0, 0.8, 0.9), 0);
  EXPECT_EQ(count(*plain, kInk, 0.3, 0.4, 0.7, 0.6), 0);
  const int level = count(*image, kInk, 0.3, 0.4, 0.7, 0.6);
  EXPECT_GT(level, 30) << "the name in the middle";
  const int edgeOnly = count(*plain, kInk, 0.45, 0.7, 0.55, 0.95, 120),
            notched = count(*image, kInk, 0.45, 0.7, 0.55, 0.95, 120);
  EXPECT_GT(notched, edgeOnly + 20);
  // Turned it is as dark, and higher than wide.
  frame.pieces[0].labels[0].upright = false;
  const auto turned = drawTable(frame, {600, 600, Language::English});
  EXPECT_GT(count(*image, kInk, 0.3, 0.46, 0.7, 0.52), level / 2);
  EXPECT_GT(count(*turned, kInk, 0.46, 0.3, 0.54, 0.7), level / 2);
  EXPECT_LT(count(*turned, kInk, 0.3, 0.46, 0.46, 0.52), 5);
}

TEST(TablePicture, ALargerNameStaysBesideTheGrainLine) {
  TableFrame frame = square();
  frame.pieces[0].grain = TableStroke{{0.1, 0.02}, {0.1, 0.18}};
  frame.pieces[0].labels = {{TableLabel::Says::Name, say("{0}", "front"), {0.098, 0.1}, 0.0005, true}};
  const auto image = drawTable(frame, {300, 300, Language::English});
  ASSERT_TRUE(image);
  EXPECT_EQ(count(*image, kInk, 0.52, 0.40, 0.7, 0.55, 60), 0) << "nothing on the line's other side";
  EXPECT_GT(count(*image, kInk, 0.3, 0.40, 0.49, 0.55, 60), 5);
}

// Narrow pieces side by side, whose names are wider than they are.
TableFrame strips(const std::vector<std::string>& names) {
  TableFrame frame;
  for (std::size_t k = 0; k < names.size(); ++k) {
    TableFrame one = square();
    TablePiece& strip = one.pieces[0];
    const auto carried = [&](Flat p) { return Flat{p.u * 0.1 + 0.025 * static_cast<double>(k), p.v}; };
    strip.high = carried(strip.high), strip.low = carried(strip.low);
    for (TableEdge& edge : strip.edges)
      for (Flat& p : edge.points) p = carried(p);
    if (!names[k].empty())
      strip.labels = {{TableLabel::Says::Name, say("{0}", names[k]), lerp(strip.low, strip.high, 0.5), 0.0005, true}};
    frame.pieces.push_back(std::move(strip));
  }
  return frame;
}

// Pixels that the names of these strips change.
int inked(const std::vector<std::string>& names) {
  const TablePictureOptions options{400, 400, Language::English};
  const auto with = drawTable(strips(names), options),
             without = drawTable(strips(std::vector<std::string>(names.size())), options);
  int changed = 0;
  for (int y = 0; y < with->height; ++y)
    for (int x = 0; x < with->width; ++x) changed += with->at(x, y) != without->at(x, y);
  return changed;
}

TEST(TablePicture, NamesOnNarrowPiecesDoNotLieOverEachOther) {
  const std::string a = "waistband_facing_left_lower", b = "waistband_facing_right_lower", c = "waistband_lining_upper";
  const int alone = inked({a, "", ""}) + inked({"", b, ""}) + inked({"", "", c});
  EXPECT_GT(inked({a, b, c}), 0.93 * alone);
}

TEST(TablePicture, WhatFindsNoRoomIsShortenedOrLeftOut) {
  std::vector<std::string> names;
  for (int k = 0; k < 60; ++k) names.push_back("waistband_facing_" + std::to_string(k));
  TableFrame frame = strips(names);
  for (TablePiece& strip : frame.pieces) {  // hardly higher than a line
    for (TableEdge& edge : strip.edges)
      for (Flat& p : edge.points) p.v *= 0.2;
    strip.high.v *= 0.2;
    strip.labels[0].place.v *= 0.2;
  }
  const auto image = drawTable(frame, {400, 400, Language::English});
  for (TablePiece& strip : frame.pieces) strip.labels.clear();
  const auto without = drawTable(frame, {400, 400, Language::English});
  // Words one over another make a black bar; those that stand apart leave paper between them.
  int most = 0;
  for (int y = 0; y < image->height; ++y) {
    int row = 0;
    for (int x = 0; x < image->width; ++x) row += image->at(x, y) != without->at(x, y);
    most = std::max(most, row);
  }
  EXPECT_GT(most, 20);
  EXPECT_LT(most, 0.85 * image->width);
}

TEST(TablePicture, RefusesWhatIsNoPicture) {
  EXPECT_FALSE(drawTable({}));
  EXPECT_FALSE(drawTable(square(), {0, 400, Language::English}));
  EXPECT_FALSE(drawTable(square(), {400, 100000, Language::English}));
  EXPECT_TRUE(drawTable(square(), {16, 16, Language::English}));
  EXPECT_TRUE(drawTable(square(), {16, 3000, Language::Japanese}));
}

}  // namespace
}  // namespace karinui

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

TEST(TablePicture, RefusesWhatIsNoPicture) {
  EXPECT_FALSE(drawTable({}));
  EXPECT_FALSE(drawTable(square(), {0, 400, Language::English}));
  EXPECT_FALSE(drawTable(square(), {400, 100000, Language::English}));
  EXPECT_TRUE(drawTable(square(), {16, 16, Language::English}));
  EXPECT_TRUE(drawTable(square(), {16, 3000, Language::Japanese}));
}

}  // namespace
}  // namespace karinui

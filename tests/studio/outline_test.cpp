// The drawing of a piece whose numbers are typed.
#include "outline_drawing.h"

#include "studio/window.h"

namespace karinui::studio {
namespace {

std::shared_ptr<Piece> rectangleOf(double wide, double high) {
  auto piece = std::make_shared<Piece>();
  const Flat corners[] = {{0, 0}, {wide, 0}, {wide, high}, {0, high}};
  const char* names[] = {"lower", "left", "top", "right"};
  for (std::size_t k = 0; k < 4; ++k)
    piece->outline.edges.push_back({names[k], Curve::line(corners[k], corners[(k + 1) % 4])});
  return piece;
}

// Of a collar or a belt one saw the four lengths and nothing of the band between them.
TEST(StudioOutline, WhatIsSaidOfTheEdgesLeavesThePaperToBeSeen) {
  KARINUI_NEEDS_DISPLAY();
  application();
  OutlineDrawing drawing;
  for (const QSize size : {QSize(340, 150), QSize(360, 190)})
    for (const auto& [wide, high] : {std::pair(0.492, 0.035), std::pair(0.7, 0.1), std::pair(0.2, 0.2),
                                     std::pair(0.05, 0.3), std::pair(0.3, 0.2)}) {
      drawing.resize(size);
      drawing.show(rectangleOf(wide, high));
      const OutlineDrawing::Drawn drawn = drawing.drawn();
      ASSERT_EQ(drawn.words.size(), 4u);
      QPainterPath seen = drawn.paper;
      std::vector<QRectF> tags;
      for (const auto& [above, words] : drawn.words) {
        const QRectF tag = wordTag(drawing.font(), above, words, drawing.rect());
        for (const QRectF& other : tags)
          EXPECT_FALSE(tag.intersects(other)) << wide << " × " << high << ": " << words.toStdString();
        EXPECT_TRUE(QRectF(drawing.rect()).contains(tag));
        tags.push_back(tag);
        QPainterPath hidden;
        hidden.addRect(tag);
        seen = seen.subtracted(hidden);
      }
      const QRectF all = drawn.paper.boundingRect(), left = seen.boundingRect();
      EXPECT_GT(left.width(), 0.9 * all.width()) << wide << " × " << high;
      EXPECT_GT(left.height(), 0.6 * all.height()) << wide << " × " << high;
      if (wide > 6 * high) {
        EXPECT_GT(all.width(), 0.6 * size.width()) << "a band fills the drawing";
      }
    }
}

// A waistband laps: what is said of the long edge and of the short one beside it both want the same place.
TEST(StudioOutline, WhatIsSaidOfALapHidesNothing) {
  KARINUI_NEEDS_DISPLAY();
  application();
  OutlineDrawing drawing;
  auto piece = std::make_shared<Piece>();
  const Flat corners[] = {{0, 0}, {0.66, 0}, {0.69, 0}, {0.69, 0.04}, {0, 0.04}};
  const char* names[] = {"lower_edge", "lap_of_lower_edge", "right_end", "top_edge", "left_end"};
  for (std::size_t k = 0; k < 5; ++k)
    piece->outline.edges.push_back({names[k], Curve::line(corners[k], corners[(k + 1) % 5])});
  drawing.show(piece);
  for (const int wide : {360, 460}) {
    drawing.resize(wide, 150);
    std::vector<QRectF> tags;
    QString all;
    for (const auto& [above, words] : drawing.drawn().words) {
      const QRectF tag = wordTag(drawing.font(), above, words, drawing.rect());
      for (const QRectF& other : tags) EXPECT_FALSE(tag.intersects(other)) << words.toStdString();
      EXPECT_TRUE(QRectF(drawing.rect()).contains(tag));
      tags.push_back(tag);
      all += words + "\n";
    }
    EXPECT_TRUE(all.contains("66.0 cm")) << "the long edge is told in any case";
    EXPECT_GE(tags.size(), wide > 400 ? 5u : 4u) << all.toStdString();
  }
}

}  // namespace
}  // namespace karinui::studio

// Seam allowances in the real window: the board of the chosen edge, and the cut line round the pattern's pieces.
#include <gmock/gmock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QSpinBox>
#include <QTest>

#include "karinui/design/script.h"
#include "karinui/pattern/cut_line.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;

// A front and a back whose sides are sewn, the back's a centimetre and a half longer.
void sewnPanels(Window& w) {
  const std::string front = "M 0 0; hem L 300 0; side L 300 400; neckline L 0 400; centre L 0 0",
                    back = "M 0 0; hem L 300 0; centre L 300 415; neckline L 0 415; side L 0 0";
  for (const std::string& step :
       {"piece name=front outline=\"" + front + "\"", "piece name=back pose=\"0.5,0,0\" outline=\"" + back + "\"",
        std::string("sew a=front.side b=back.side")}) {
    w.session().perform(*parseOperation(step));
    w.rest();
  }
}

TEST(StudioAllowance, IsTypedForTheChosenEdge) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().begin(DocumentFile::inMemory());
  sewnPanels(w);
  const Document& start = w.session().snapshot().document;
  const PieceId front = start.pieceNamed("front")->id;
  Selection chosen;
  chosen.pieces = {front};
  chosen.edge = EdgeNear{front, "hem", 0.5, 0};
  w.session().select(chosen);
  w.rest();
  EXPECT_NEAR(w.box("Seam allowance").value(), 0.030, 1e-9) << "a hem";
  w.type(w.box("Seam allowance"), "4");
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("allowance edges=p1.hem width=40mm"));
  const auto cut = [&] {
    const Document& now = w.session().snapshot().document;
    const AllowancePlan plan(now.pattern, now.allowances);
    return signedArea(cutLines(*now.find(front), plan)->outer);
  };
  EXPECT_NEAR(cut(), 0.32 * (0.4 + 0.04 + 0.007), 1e-9);
  auto* corner = w.main().findChild<QComboBox*>("corner_end");
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->currentIndex(), static_cast<int>(CornerKind::MirrorBefore)) << "as hems are";
  corner->setCurrentIndex(static_cast<int>(CornerKind::Points));
  emit corner->activated(corner->currentIndex());
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("end=points"));
  EXPECT_NEAR(cut(), 0.32 * (0.4 + 0.04 + 0.007) - 0.5 * 0.04 * 0.01, 1e-9) << "the corner's triangle is gone";
  w.keep("allowance");
  QTest::mouseClick(&w.button("As usual"), Qt::LeftButton);
  w.rest();
  EXPECT_TRUE(w.session().snapshot().document.allowances.empty());
  EXPECT_NEAR(w.box("Seam allowance").value(), 0.030, 1e-9);
}

TEST(StudioTruing, IsToldForTheChosenEdge) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().begin(DocumentFile::inMemory());
  sewnPanels(w);
  w.main().boards().setCurrentIndex(0);
  const PieceId front = w.session().snapshot().document.pieceNamed("front")->id;
  Selection chosen;
  chosen.pieces = {front};
  chosen.edge = EdgeNear{front, "side", 0.5, 0};
  w.session().select(chosen);
  w.rest();
  const auto told = [&] {
    std::string all;
    for (const QLabel* label : w.main().findChildren<QLabel*>())
      if (label->isVisible()) all += label->text().toStdString() + "\n";
    return all;
  };
  EXPECT_THAT(told(), HasSubstr("longer than"));
  w.type(w.box("Ease in the seam"), "1.5");
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("ease seam=s3 by=15mm"));
  EXPECT_THAT(told(), testing::Not(HasSubstr("longer than")));
}

TEST(StudioQuantity, IsTypedForTheChosenPiece) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().begin(DocumentFile::inMemory());
  sewnPanels(w);
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("back")->id};
  w.session().select(chosen);
  w.rest();
  auto* count = w.main().findChild<QSpinBox*>("cut_count");
  ASSERT_TRUE(count);
  EXPECT_EQ(count->value(), 1);
  count->setValue(3);
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("quantity piece=p2 count=3"));
  for (QCheckBox* box : w.main().findChildren<QCheckBox*>())
    if (box->text() == "in pairs") box->click();
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("count=4 pairs=yes"));
  EXPECT_EQ(count->value(), 4);
}

}  // namespace
}  // namespace karinui::studio

// Sewing with the mouse and the keys in the real window: runs of edges, the mirrored seam, and what is asked first.
#include <gmock/gmock.h>

#include <QAction>
#include <QDoubleSpinBox>
#include <QFrame>
#include <QTest>

#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class StudioSew : public testing::Test {
 protected:
  void SetUp() override {
    KARINUI_NEEDS_DISPLAY();
    w.emplace();
    w->openTunic();
  }
  const Pattern& pattern() { return w->session().snapshot().document.pattern; }
  void unpick() {
    w->session().perform(FreezePieces{{PieceRef("front"), PieceRef("back")}, true});  // unpicked, they would fall
    Unsew all;
    for (const auto& [id, seam] : pattern().seams) all.seams.push_back(SeamRef(id));
    w->session().perform(all);
    w->rest();
    ASSERT_TRUE(pattern().seams.empty());
    before = w->count();
  }
  QPointF onTable(const char* piece, const char* edge, double share) {
    const Piece* p = w->session().snapshot().document.pieceNamed(piece);
    return w->onTable(piece, findEdge(*p, edge)->curve.atFraction(share));
  }
  std::vector<QPointF> along(const char* piece, const char* edge, double from, double to) {
    std::vector<QPointF> path;
    for (int k = 0; k <= 8; ++k) path.push_back(onTable(piece, edge, from + (to - from) * k / 8));
    return path;
  }
  QFrame* menuIn(QWidget& view) {
    auto* menu = view.findChild<QFrame*>("drop_menu");
    return menu && menu->isVisible() ? menu : nullptr;
  }
  void clickOn(QPushButton& button) { QTest::mouseClick(&button, Qt::LeftButton); }
  std::vector<QPushButton*> items(QFrame& menu) {
    std::vector<QPushButton*> shown;
    for (QPushButton* one : menu.findChildren<QPushButton*>())
      if (one->isVisible()) shown.push_back(one);
    return shown;
  }
  void wrongShoulder() {
    w->key(Command::Sew);
    w->drag(w->table(), {onTable("front", "shoulder_right", 0.5), onTable("back", "shoulder_left", 0.5)});
    w->rest();
  }

  std::optional<Window> w;
  std::size_t before = 0;
};

TEST_F(StudioSew, ASideOfTwoEdgesIsDraggedAlong) {
  SplitEdge split;
  split.edge = {PieceRef("front"), "side_left"};
  split.at = 0.4;
  w->session().perform(split);
  w->rest();
  unpick();
  w->key(Command::Sew);
  auto path = along("front", "side_left", 0.02, 1);
  const auto more = along("front", "side_left_2", 0, 0.98);
  path.insert(path.end(), more.begin(), more.end());
  w->drag(w->table(), path, {}, [&] {
    ASSERT_FALSE(w->session().preview().table.words.empty());
    EXPECT_THAT(w->session().preview().table.words.back().text, HasSubstr("left side + left side 2"));
  });
  EXPECT_EQ(w->count(), before) << "nothing is sewn to itself";
  w->drag(w->table(), along("back", "side_left", 0.98, 0.02), {}, [&] { w->keep("studio_sew_run"); });
  w->rest();
  ASSERT_EQ(w->count(), before + 1) << w->main().said().toStdString();
  EXPECT_THAT(w->last(), StartsWith("sew a=\"p3.side_left; p3.side_left_2\" b=p4.side_left"));
  EXPECT_EQ(pattern().seams.size(), 2u) << "the mirror image is sewn too";
  EXPECT_THAT(w->main().said().toStdString(), HasSubstr("one undo takes both back"));
  w->key(Command::Undo);
  w->rest();
  EXPECT_TRUE(pattern().seams.empty());
}

TEST_F(StudioSew, TheWrongShoulderIsAskedAboutBefore) {
  unpick();
  wrongShoulder();
  EXPECT_EQ(w->count(), before) << "nothing is done before it is answered";
  ASSERT_TRUE(w->session().dropMenu()) << w->main().said().toStdString();
  QFrame* menu = menuIn(w->table());
  ASSERT_TRUE(menu);
  w->keep("studio_sew_asked");
  const auto shown = items(*menu);
  ASSERT_GE(shown.size(), 3u);
  EXPECT_EQ(shown[0]->text(), "Sew to right shoulder of back");
  clickOn(*shown[0]);
  w->rest();
  ASSERT_EQ(w->count(), before + 1) << w->main().said().toStdString();
  EXPECT_THAT(w->last(), StartsWith("sew a=p3.shoulder_right b=p4.shoulder_right"));
  EXPECT_EQ(pattern().seams.size(), 2u);
  EXPECT_FALSE(menuIn(w->table()));
}

TEST_F(StudioSew, TheRatioIsTypedAtTheDrop) {
  w->session().perform(*parseOperation(
      "piece name=frill outline=\"M 0 0; hem L 700 0; e2 L 700 80; top L 0 80; e4 L 0 0\" pose=\"0,0.5,0.4\""));
  w->session().perform(*parseOperation(
      "piece name=band outline=\"M 0 0; lower L 300 0; e2 L 300 40; upper L 0 40; e4 L 0 0\" pose=\"0,0.7,0.4\""));
  w->rest();
  before = w->count();
  w->key(Command::Sew);
  const auto drop = [&] {
    w->drag(w->table(), {onTable("band", "lower", 0.5), onTable("frill", "top", 0.5)});
    w->rest();
  };
  drop();
  QFrame* menu = menuIn(w->table());
  ASSERT_TRUE(menu) << w->main().said().toStdString();
  auto* number = menu->findChild<QDoubleSpinBox*>("drop_number");
  ASSERT_TRUE(number && number->isVisible());
  EXPECT_DOUBLE_EQ(number->maximum(), 2.33);
  w->keep("studio_sew_ratio");
  // With the mouse: into the box, typed, Enter.
  number->setFocus();
  number->selectAll();
  QTest::keyClicks(number, "1.8");
  QTest::keyClick(number, Qt::Key_Return);
  w->rest();
  ASSERT_EQ(w->count(), before + 1) << w->main().said().toStdString();
  const Seam* seam = nullptr;
  for (const auto& [id, one] : pattern().seams)
    if (one.a.front().edge == "lower" || one.b.front().edge == "lower") seam = &one;
  ASSERT_TRUE(seam);
  EXPECT_NEAR(easeRatio(pattern(), *seam), 1.8, 1e-6);
  EXPECT_EQ(seam->tie, Seam::Tie::OneToOne);
  EXPECT_FALSE(menuIn(w->table()));
  w->key(Command::Undo);
  w->rest();
  // With the keys of the view: down to its item, Enter, typed, Enter. Digits are not taken for views meanwhile.
  drop();
  std::size_t item = 0;
  while (text(w->session().dropMenu()->items[item].label) != "Another ratio…") ++item;
  for (std::size_t k = w->session().dropMenu()->current; k < item; ++k) w->type(w->table(), Qt::Key_Down);
  w->type(w->table(), Qt::Key_Return);
  w->rest();
  menu = menuIn(w->table());
  ASSERT_TRUE(menu);
  number = menu->findChild<QDoubleSpinBox*>("drop_number");
  ASSERT_TRUE(number && w->main().focusWidget() == number);
  QTest::keyClicks(number, "2");
  QTest::keyClick(number, Qt::Key_Return);
  w->rest();
  ASSERT_EQ(w->count(), before + 1);
  for (const auto& [id, one] : pattern().seams)
    if (one.a.front().edge == "lower" || one.b.front().edge == "lower") {
      EXPECT_EQ(one.tie, Seam::Tie::TwoToOne);
    }
}

TEST_F(StudioSew, EscapeLeavesWhatIsAsked) {
  unpick();
  wrongShoulder();
  ASSERT_TRUE(menuIn(w->table()));
  w->key(Command::Cancel);
  w->rest();
  EXPECT_FALSE(menuIn(w->table()));
  EXPECT_EQ(w->count(), before);
  EXPECT_FALSE(w->session().can(Command::Confirm)) << "nothing is left in the hand";
}

TEST_F(StudioSew, TheMenuIsWorkedWithTheKeysOfTheView) {
  unpick();
  w->key(Command::Sew);
  w->drag(w->table(), {onTable("front", "side_left", 0.5), onTable("back", "shoulder_left", 0.5)});
  w->rest();
  QFrame* menu = menuIn(w->table());
  ASSERT_TRUE(menu) << w->main().said().toStdString();
  w->main().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w->main()));
  w->table().setFocus();
  QTest::keyClick(&w->table(), Qt::Key_Down);
  QApplication::processEvents();
  EXPECT_EQ(w->session().dropMenu()->current, 1u);
  QTest::keyClick(&w->table(), Qt::Key_Return);
  w->rest();
  EXPECT_EQ(w->count(), before + 1);
  EXPECT_THAT(w->last(), StartsWith("sew a="));
}

TEST_F(StudioSew, TheMenuOpensInTheSpaceToo) {
  unpick();
  w->view(View::Front);
  w->key(Command::Sew);
  const auto place = [&](const char* edge, double share) {
    const Piece* p = w->session().snapshot().document.pieceNamed("front");
    return w->inSpace("front", findEdge(*p, edge)->curve.atFraction(share));
  };
  w->click(w->space(), place("hem_left", 0.5));
  w->click(w->space(), place("neck_left", 0.5));
  w->rest();
  QFrame* menu = menuIn(w->space());
  ASSERT_TRUE(menu) << w->main().said().toStdString();
  EXPECT_TRUE(w->space().rect().contains(menu->geometry()));
  w->keep("studio_sew_menu");
  clickOn(*items(*menu).back());
  w->rest();
  EXPECT_FALSE(menuIn(w->space()));
  EXPECT_EQ(w->count(), before) << "left as it was";
}

TEST_F(StudioSew, TheMirroredSeamIsAChoice) {
  unpick();
  w->main().findChild<QAction*>("mirror_seams")->trigger();
  w->key(Command::Sew);
  w->drag(w->table(), {onTable("front", "side_left", 0.5), onTable("back", "side_left", 0.5)});
  w->rest();
  ASSERT_EQ(w->count(), before + 1) << w->main().said().toStdString();
  EXPECT_EQ(pattern().seams.size(), 1u);
  EXPECT_THAT(w->last(), testing::Not(HasSubstr("mirror")));
}

}  // namespace
}  // namespace karinui::studio

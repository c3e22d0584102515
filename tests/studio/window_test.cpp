// The real window: what it shows, and the ways into and out of it.
#include <gmock/gmock.h>

#include <QAccessible>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QScrollArea>
#include <QTabWidget>
#include <QToolBar>
#include <QTreeWidget>
#include <fstream>

#include "karinui/design/script.h"
#include "quad_window.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// How many pixels of two pictures differ clearly.
int differing(const QImage& a, const QImage& b) {
  int count = 0;
  for (int y = 0; y < std::min(a.height(), b.height()); ++y)
    for (int x = 0; x < std::min(a.width(), b.width()); ++x) {
      const QColor p = a.pixelColor(x, y), q = b.pixelColor(x, y);
      count += std::abs(p.red() - q.red()) + std::abs(p.green() - q.green()) + std::abs(p.blue() - q.blue()) > 40;
    }
  return count;
}

// While it turns less is drawn (the tests' display has no graphics card); a moment later the whole picture is there.
TEST(StudioWindow, DrawsLessWhileItTurnsAndAllOfItThen) {
  KARINUI_NEEDS_DISPLAY();
  Window w(Pictures::Whole);
  w.openTunic();
  const QPointF middle = QRectF(w.space().rect()).center();
  QImage turning;
  w.drag(
      w.space(), {middle, middle + QPointF(60, 10)}, {},
      [&] {
        EXPECT_FALSE(w.space().still());
        turning = w.space().grabFramebuffer();
      },
      Qt::RightButton);
  w.rest();
  ASSERT_TRUE(w.space().still());
  const QImage still = w.space().grabFramebuffer();
  ASSERT_EQ(turning.size(), still.size());
  double away = 0;
  int other = 0;
  for (int y = 0; y < still.height(); ++y)
    for (int x = 0; x < still.width(); ++x) {
      const int d = std::abs(qGray(turning.pixel(x, y)) - qGray(still.pixel(x, y)));
      away += d, other += d > 8;
    }
  away /= still.width() * still.height();
  EXPECT_GT(other, 100) << "edges are not as sharp";
  EXPECT_LT(away, 4) << "but it is the same picture";
}

TEST(StudioWindow, ShowsAGarmentAndItsPattern) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  EXPECT_EQ(w.session().snapshot().document.pattern.pieces.size(), 2u);
  const QImage picture = w.space().grabFramebuffer();
  const QPointF chest = w.inSpace("front", {0, 0.3});
  const QColor cloth = picture.pixelColor(chest.toPoint() * w.space().devicePixelRatio());
  EXPECT_GT(cloth.blue(), cloth.red() + 20) << "the cloth is dyed blue";
  if (std::getenv("KARINUI_PICTURES")) w.openExample("first_tunic");  // whose seams fit
  w.keep("studio");
}

TEST(StudioWindow, SaysThatAGarmentIsBeingOpened) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const fs::path made = w.session().path();
  const QString path = QString::fromStdString(made.string());
  w.session().saveAs(made.parent_path() / "copy.karinui");  // so that the first is free
  w.rest();
  Window other;
  EXPECT_THAT(text(other.table().emptySaid()), testing::HasSubstr("draw on the body"));
  // A figure is made first, so that the garment is not open before anything could be looked at.
  other.session().perform(SetBody{.size = "eu44", .sex = {}, .set = {}, .mesh = {}});
  other.main().openPath(path);
  EXPECT_TRUE(other.session().snapshot().document.pattern.pieces.empty());
  EXPECT_THAT(text(other.table().emptySaid()), testing::HasSubstr("being opened"));
  EXPECT_THAT(other.main().findChild<QLabel*>("hint")->text().toStdString(), testing::HasSubstr("being opened"));
  other.rest();
  EXPECT_FALSE(other.session().snapshot().document.pattern.pieces.empty());
  EXPECT_THAT(text(other.table().emptySaid()), Not(testing::HasSubstr("being opened")));
}

TEST(StudioWindow, TheFloatingBarTakesTheSameClicks) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const SceneMenu panel = *w.session().menu();
  const auto& b = panel.buttons[3];
  const Vec3 there = panel.corner + normalized(panel.across) * (b.left + b.width / 2) +
                     normalized(panel.upward) * (b.bottom + b.height / 2);
  w.hover(w.space(), *w.space().onScreen(there));
  EXPECT_EQ(text(w.session().hint()), text(info(Command::Cut).hint));
  w.click(w.space(), *w.space().onScreen(there));
  w.rest();
  EXPECT_EQ(w.session().tool(), Command::Cut);
  EXPECT_TRUE(w.main().action(Command::Cut)->isChecked());
}

TEST(StudioWindow, ChoosingIsMirroredEverywhere) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  w.click(w.space(), w.inSpace("front", {0, 0.3}));
  w.rest();
  const PieceId front = w.session().snapshot().document.pieceNamed("front")->id;
  EXPECT_EQ(w.session().selection().pieces, std::set<PieceId>{front});
  auto* tree = w.main().findChild<QTreeWidget*>();
  ASSERT_EQ(tree->selectedItems().size(), 1);
  EXPECT_THAT(tree->selectedItems().front()->text(0).toStdString(), StartsWith("Front"));
  w.click(w.table(), w.onTable("back", {0, 0.3}));
  w.rest();
  EXPECT_THAT(tree->selectedItems().front()->text(0).toStdString(), StartsWith("Back"));
  tree->setCurrentItem(tree->topLevelItem(0));
  EXPECT_EQ(w.session().selection().pieces, std::set<PieceId>{front});
}

TEST(StudioWindow, TurnsPansAndZoomsWithoutAStep) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  const QPointF at = w.inSpace("front", {0, 0.3});
  const Camera first = w.space().camera();
  w.drag(w.space(), {at, at + QPointF(80, 10)}, {}, {}, Qt::RightButton);
  const Camera second = w.space().camera();
  EXPECT_GT(distance(first.eye, second.eye), 0.2);
  EXPECT_NEAR(distance(first.target, second.target), 0, 1e-9);
  const Vec3 place =
      *spaceOf(w.session().snapshot(), w.session().snapshot().document.pieceNamed("front")->id, {0, 0.3});
  const QPointF seen = *w.space().onScreen(place);
  QWheelEvent wheel(seen, w.space().mapToGlobal(seen), {}, {0, 240}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                    false);
  QApplication::sendEvent(&w.space(), &wheel);
  EXPECT_LT(w.space().camera().distance(), second.distance());
  EXPECT_LT(QLineF(*w.space().onScreen(place), seen).length(), 6) << "what is under the cursor stays there";
  w.key(Command::ViewBack);
  w.rest();
  EXPECT_LT(w.space().camera().eye.z, w.space().camera().target.z);
  EXPECT_EQ(w.count(), before);
}

TEST(StudioWindow, SpeaksJapaneseAtOnce) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const QString before = w.main().action(Command::Sew)->text();
  w.main().findChild<QAction*>("japanese")->trigger();
  w.rest();
  EXPECT_NE(w.main().action(Command::Sew)->text(), before);
  EXPECT_EQ(w.main().boards().tabText(0), QString::fromUtf8("服"));
  w.keep("studio_ja");
  w.main().findChild<QAction*>("english")->trigger();
  EXPECT_EQ(w.main().action(Command::Sew)->text(), before);
}

TEST(StudioWindow, EverythingThatTakesAKeySaysWhatItIs) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("front")->id};
  chosen.edge = EdgeNear{*chosen.pieces.begin(), "side_left", 0.5, 0};
  w.session().select(chosen);
  std::set<std::string> nameless;
  for (int board = 0; board < w.main().boards().count(); ++board) {
    w.main().boards().setCurrentIndex(board);
    w.rest();
    for (QWidget* one : w.main().findChildren<QWidget*>()) {
      if (!one->isVisible() || !(one->focusPolicy() & Qt::TabFocus) || qobject_cast<QLabel*>(one)) continue;
      if (qobject_cast<QScrollArea*>(one) || (one->parentWidget() && one->focusProxy())) continue;
      if (qobject_cast<QLineEdit*>(one) && qobject_cast<QAbstractSpinBox*>(one->parentWidget())) continue;
      QAccessibleInterface* heard = QAccessible::queryAccessibleInterface(one);
      if (!heard || heard->text(QAccessible::Name).isEmpty())
        nameless.insert(one->metaObject()->className() + (" on board " + std::to_string(board)) + " in " +
                        one->parentWidget()->metaObject()->className());
    }
  }
  EXPECT_TRUE(nameless.empty()) << testing::PrintToString(nameless);
  for (QToolBar* bar : w.main().findChildren<QToolBar*>())
    for (QAction* action : bar->actions()) {
      if (action->isSeparator()) continue;
      QAccessibleInterface* heard = QAccessible::queryAccessibleInterface(bar->widgetForAction(action));
      ASSERT_TRUE(heard);
      EXPECT_EQ(heard->text(QAccessible::Description), action->statusTip()) << "without the signs that make it bold";
    }
}

TEST(StudioWindow, IsDarkWhenAsked) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const QImage light = w.main().grab().toImage();
  w.main().findChild<QAction*>("dark")->trigger();
  w.rest();
  const QImage dark = w.main().grab().toImage();
  w.keep("studio_dark");
  w.main().findChild<QAction*>("dark")->trigger();
  EXPECT_GT(differing(light, dark), light.width() * light.height() / 4);
}

TEST(StudioWindow, ShowsStrainAndDistance) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const QImage plain = w.space().grabFramebuffer();
  w.space().setMap(FitMap::Strain);
  w.rest();
  const QImage strain = w.space().grabFramebuffer();
  EXPECT_GT(w.space().mapTop(), 0);
  w.keep("studio_strain");
  w.space().setMap(FitMap::Ease);
  w.rest();
  const QImage ease = w.space().grabFramebuffer();
  w.main().boards().setCurrentIndex(3);
  w.keep("studio_ease");
  EXPECT_GT(differing(plain, strain), 2000);
  EXPECT_GT(differing(strain, ease), 2000);
}

TEST(StudioWindow, GivesEachEyeItsOwnPicture) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.space().setStereo(Stereo::SideBySide);
  w.rest();
  const QImage side = w.space().grabFramebuffer();
  const int half = side.width() / 2;
  const QImage left = side.copy(0, 0, half, side.height()), right = side.copy(half, 0, half, side.height());
  EXPECT_GT(differing(left, right), 300);
  w.keep("studio_stereo");
  for (const Stereo way : {Stereo::TopBottom, Stereo::Anaglyph, Stereo::Interleaved}) {
    w.space().setStereo(way);
    w.rest();
    EXPECT_GT(differing(side, w.space().grabFramebuffer()), 2000);
  }
}

TEST(StudioWindow, WhereNoScreenShowsTwoPicturesAtOnceASentenceSaysSo) {
  KARINUI_NEEDS_DISPLAY();
  if (QuadWindow::mayBeHad()) GTEST_SKIP() << "this screen does";
  Window w;
  QComboBox* screen = nullptr;
  for (QComboBox* one : w.main().findChildren<QComboBox*>())
    if (one->accessibleName() == "Screen" || one->findText("row by row") >= 0) screen = one;
  ASSERT_TRUE(screen);
  screen->setCurrentIndex(static_cast<int>(Stereo::Anaglyph));
  screen->setCurrentIndex(static_cast<int>(Stereo::QuadBuffer));
  w.rest();
  EXPECT_EQ(w.space().stereo(), Stereo::Anaglyph) << "it stays as it was";
  EXPECT_EQ(screen->currentIndex(), static_cast<int>(Stereo::Anaglyph));
  EXPECT_THAT(w.main().said().toStdString(), StartsWith("No screen of this machine"));
}

TEST(StudioWindow, MeasuresWithATape) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const QImage before = w.space().grabFramebuffer();
  w.space().setTape(true);
  w.hover(w.space(), w.inSpace("front", {0, 0.25}));
  w.rest();
  w.keep("studio_tape");
  EXPECT_GT(differing(before, w.space().grabFramebuffer()), 150);
}

TEST(StudioWindow, WhatIsNoDocumentIsASentence) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  Folder folder;
  const fs::path bad = folder.path / "bad.karinui";
  std::ofstream(bad) << "this is no garment";
  w.open(bad);
  EXPECT_FALSE(w.main().said().isEmpty());
  EXPECT_EQ(w.count(), before) << "what was open stays open";
}

TEST(StudioWindow, GuidesThroughAFirstGarment) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.main().startGuide();
  w.rest();
  w.keep("studio_guide");
  w.session().begin(DocumentFile::inMemory());
  w.session().perform(SetBody{.size = "jis9ar", .sex = {}, .set = {}, .mesh = {}});
  w.rest();
  QString title;
  for (QLabel* label : w.main().findChild<QWidget*>("guide")->findChildren<QLabel*>())
    if (label->property("role") == "title") title = label->text();
  EXPECT_EQ(title, "The front") << "the guide saw the figure";
}

TEST(StudioWindow, WhatMayNotBeWrittenIsShownForReading) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Folder folder;
  const fs::path path = folder.path / "locked.karinui";
  fs::copy_file(w.session().path(), path);
  // Held by another program: the same as may not be written.
  const auto other = DocumentFile::open(path);
  ASSERT_TRUE(other);
  Window second;
  second.open(path);
  if (second.session().path() == path) {
    EXPECT_TRUE(second.session().readOnly());
    second.key(Command::Cut);
    second.rest();
  }
  EXPECT_FALSE(second.main().said().isEmpty()) << "the person is told";
}

// What could not be done is said until something else was done.
TEST(StudioWindow, ARefusalGoesWithTheNextStep) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const auto refusals = [&] {
    const auto shown = w.main().findChildren<QLabel*>("toast");
    return std::count_if(shown.begin(), shown.end(),
                         [](const QLabel* one) { return one->property("refusal").toBool(); });
  };
  w.session().perform(*parseOperation("rename piece=none to=other")), w.rest();
  EXPECT_EQ(refusals(), 1);
  w.session().perform(*parseOperation("rename piece=none to=another")), w.rest();
  EXPECT_GE(refusals(), 1) << "nothing was done yet";
  const std::size_t before = w.count();
  w.session().perform(*parseOperation("rename piece=front to=other")), w.rest();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_EQ(refusals(), 0);
  // A step that is changed is one that is done, as when a measure of the figure is typed once more.
  w.session().perform(*parseOperation("rename piece=none to=another")), w.rest();
  EXPECT_EQ(refusals(), 1);
  w.session().amend(before + 1, *parseOperation("rename piece=front to=third")), w.rest();
  ASSERT_TRUE(w.session().snapshot().document.pieceNamed("third"));
  EXPECT_EQ(refusals(), 0);
}

TEST(StudioWindow, WhatIsSaidOverAndOverIsKeptOnce) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(*parseOperation("rename piece=none to=other")), w.rest();
  for (int k = 0; k < 60; ++k) w.session().perform(*parseOperation("remove piece=nobody")), w.rest();
  w.main().findChild<QAction*>("what_was_said")->trigger();
  auto* dialog = w.main().findChild<QDialog*>("said");
  ASSERT_TRUE(dialog);
  auto* list = dialog->findChild<QListWidget*>();
  ASSERT_GE(list->count(), 2);
  EXPECT_THAT(list->item(0)->text().toStdString(), HasSubstr("nobody"));
  EXPECT_THAT(list->item(1)->text().toStdString(), HasSubstr("none"));
  dialog->close();
}

}  // namespace
}  // namespace karinui::studio

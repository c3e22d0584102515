// Menus and keys of the window: the right button, full screen, stereo, redo by either key.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QStatusBar>
#include <QTabWidget>
#include <QTest>
#include <QTreeWidget>
#include <numbers>

#include "karinui/pattern/symmetry.h"
#include "menu_letters.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

void rightClick(Window& w, QWidget& widget, QPointF at) { w.drag(widget, {at}, {}, {}, Qt::RightButton); }

QMenu* contextMenu() { return qobject_cast<QMenu*>(QApplication::activePopupWidget()); }

std::vector<std::string> offered() {
  std::vector<std::string> words;
  if (const QMenu* menu = contextMenu())
    for (const QAction* action : menu->actions())
      if (!action->isSeparator()) words.push_back(withoutLetter(*action).toStdString());
  return words;
}
void chooseEntry(Window& w, const char* words) {
  for (QAction* action : contextMenu()->actions())
    if (withoutLetter(*action) == words) {
      QTest::mouseClick(contextMenu(), Qt::LeftButton, {}, contextMenu()->actionGeometry(action).center());
      return w.rest();
    }
  FAIL() << "the menu has no " << words << " but " << testing::PrintToString(offered());
}

TEST(StudioMenus, AFigureTakesAPose) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  QMenu* poses = w.main().findChild<QMenu*>("poses");
  ASSERT_TRUE(poses);
  Q_EMIT poses->aboutToShow();
  const auto named = [&](const char* words) -> QAction* {
    for (QAction* one : poses->actions())
      if (withoutLetter(*one) == words) return one;
    return nullptr;
  };
  QAction* seated = named("Seated");
  ASSERT_TRUE(seated) << poses->actions().size();
  ASSERT_TRUE(seated->isEnabled());
  const double before = w.session().snapshot().body->mesh().points.front().y;
  seated->trigger();
  w.rest();
  EXPECT_THAT(w.last(), StartsWith("drape")) << "what it disturbs comes to rest by itself";
  EXPECT_TRUE(w.session().snapshot().document.drape.last->settled);
  EXPECT_FALSE(w.session().snapshot().document.body.pose.empty());
  EXPECT_NE(w.session().snapshot().body->mesh().points.front().y, before);
  for (int k = 0; k < 2 && !w.session().snapshot().document.body.pose.empty(); ++k) {
    w.key(Command::Undo);
    w.rest();
  }
  EXPECT_TRUE(w.session().snapshot().document.body.pose.empty());
}

TEST(StudioMenus, TheRightButtonOffersWhatCanBeDoneThere) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  const Piece front = *w.session().snapshot().document.pieceNamed("front");
  const Flat side = findEdge(front, "side_left")->curve.atFraction(0.5);
  for (const bool table : {false, true}) {
    QWidget& view = table ? static_cast<QWidget&>(w.table()) : w.space();
    const auto at = [&](Flat paper) { return table ? w.onTable("front", paper) : w.inSpace("front", paper); };
    rightClick(w, view, at({0, 0.3}));
    EXPECT_EQ(w.session().selection().pieces, std::set<PieceId>{front.id}) << "it is chosen first";
    EXPECT_THAT(offered(), Contains("Freeze"));
    EXPECT_THAT(offered(), Contains("Fuse interfacing"));
    EXPECT_THAT(offered(), Contains("Line it"));
    EXPECT_THAT(offered(), Contains("Line it, free at the hem"));
    EXPECT_THAT(offered(), Contains("Pin here"));
    EXPECT_THAT(offered(), Not(Contains("Unpick this seam")));
    const std::size_t before = w.count();
    chooseEntry(w, "Freeze");
    EXPECT_EQ(w.count(), before + 1);
    EXPECT_THAT(w.last(), StartsWith("freeze"));
    rightClick(w, view, at({0, 0.3}));
    chooseEntry(w, "Thaw");
    rightClick(w, view, at(side));
    EXPECT_THAT(offered(), Contains("Notch there"));
    chooseEntry(w, "Unpick this seam");
    EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), 3u);
    w.key(Command::Undo);
    w.rest();
    EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), 4u);
  }
  // On the body, beside the cloth: where to look from.
  rightClick(w, w.space(), {w.space().freeWidth() / 2, 12});
  EXPECT_THAT(offered(), Contains("Front"));
  chooseEntry(w, "Back");
}

// Each entry has a letter of its own, in Japanese the one of its English words; the letter chooses it.
TEST(StudioMenus, ALetterChoosesAnEntry) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  const Flat side = findEdge(*w.session().snapshot().document.pieceNamed("front"), "side_left")->curve.atFraction(0.5);
  const auto lettersOf = [&] {
    std::multimap<QString, QString> letters;  // by the letter, the words
    for (const QAction* action : contextMenu()->actions()) {
      if (action->isSeparator()) continue;
      const QString letter = QKeySequence::mnemonic(action->text()).toString().right(1);
      EXPECT_FALSE(letter.isEmpty()) << action->text().toStdString();
      letters.emplace(letter, withoutLetter(*action));
    }
    return letters;
  };
  rightClick(w, w.table(), w.onTable("front", side));
  const auto english = lettersOf();
  ASSERT_EQ(english.count("N"), 1u);
  EXPECT_EQ(english.find("N")->second, "Notch there");
  EXPECT_EQ(english.count("Z"), 1u);
  for (const auto& [letter, words] : english) EXPECT_EQ(english.count(letter), 1u) << words.toStdString();
  EXPECT_THAT(offered(), Not(Contains("Freeze"))) << "what is about the piece stands in a menu of its own";
  EXPECT_THAT(offered(), Contains("Piece front"));
  const auto* piece = w.main().findChild<QMenu*>("context_piece");
  ASSERT_TRUE(piece);
  const QList<QAction*> ofPiece = piece->actions();
  EXPECT_TRUE(
      std::any_of(ofPiece.begin(), ofPiece.end(), [](const QAction* one) { return withoutLetter(*one) == "Freeze"; }));
  const std::size_t before = w.count();
  QTest::keyClick(contextMenu(), Qt::Key_N);
  w.rest();
  ASSERT_EQ(w.count(), before + 1);
  EXPECT_THAT(w.last(), StartsWith("notch "));
  Theme::here().setLanguage(Language::Japanese);
  w.rest();
  rightClick(w, w.table(), w.onTable("front", side));
  const auto japanese = lettersOf();
  for (const QAction* action : contextMenu()->actions())
    if (withoutLetter(*action) == inWords(say("Notch there"))) {
      EXPECT_THAT(action->text().toStdString(), testing::EndsWith("(&N)"));
    } else if (withoutLetter(*action) == inWords(say("Pleats…"))) {
      EXPECT_THAT(action->text().toStdString(), testing::EndsWith(")…"));
    }
  EXPECT_EQ(japanese.size(), english.size());
  QTest::keyClick(contextMenu(), Qt::Key_N);
  w.rest();
  EXPECT_EQ(w.count(), before + 2);
  Theme::here().setLanguage(Language::English);
}

// A roll line runs out along the front edge: what lies right under the pointer is meant, not what is near it.
// Of several that are chosen it is about all; what only one can have done to it says so.
TEST(StudioMenus, TheRightButtonIsAboutAllThatAreChosen) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(*parseOperation("interface piece=back"));
  w.rest();
  w.key(Command::SelectAll);
  w.rest();
  rightClick(w, w.table(), w.onTable("front", {0, 0.3}));
  EXPECT_THAT(offered(), Contains("Remove the 2 pieces"));
  EXPECT_THAT(offered(), Contains("Line them"));
  EXPECT_THAT(offered(), Contains("Freeze"));
  chooseEntry(w, "Fuse interfacing");
  EXPECT_FALSE(w.session().snapshot().document.pieceNamed("front")->interfacing.empty());
  EXPECT_EQ(w.session().selection().pieces.size(), 2u);
  rightClick(w, w.table(), w.onTable("front", {0, 0.3}));
  EXPECT_THAT(offered(), Contains("Take the interfacing off"));
  chooseEntry(w, "Freeze");
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("front")->frozen);
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("back")->frozen);
  rightClick(w, w.space(), w.onSkin("left_leg:knee@0"));
  EXPECT_THAT(offered(), Contains("Only one piece is wrapped round here: choose it alone"));
  EXPECT_EQ(w.session().selection().pieces.size(), 2u);
}

TEST(StudioMenus, ALineBesideAnEdgeIsMet) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(*parseOperation(
      "piece name=front pose=\"0,1,0.3\" outline=\"M 0 0; hem L 250 0; side L 250 500; neck L 0 500; centre L 0 0\""));
  w.rest();
  w.session().perform(*parseOperation("line piece=front along=\"4mm,50cm; 4mm,0cm\" name=lapel"));
  w.rest();
  rightClick(w, w.table(), w.onTable("front", {0.004, 0.25}));
  EXPECT_THAT(offered(), Contains("Turn back along lapel…"));
  EXPECT_THAT(offered(), Not(Contains("Band along it…")));
  contextMenu()->close();
  QApplication::processEvents();
  rightClick(w, w.table(), w.onTable("front", {0, 0.25}));
  EXPECT_THAT(offered(), Contains("Band along it…"));
  contextMenu()->close();
}

TEST(StudioMenus, ARightDragTurnsAndAsksNothing) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const QPointF at = w.inSpace("front", {0, 0.3});
  const Camera before = w.space().camera();
  w.drag(w.space(), {at, at + QPointF(60, 0)}, {}, {}, Qt::RightButton);
  EXPECT_FALSE(contextMenu());
  EXPECT_GT(distance(before.eye, w.space().camera().eye), 0.1);
  w.drag(w.table(), {QPointF(40, 40), QPointF(90, 60)}, {}, {}, Qt::RightButton);
  EXPECT_FALSE(contextMenu());
}

TEST(StudioMenus, TheTreeHasItToo) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(0);
  w.rest();
  auto* tree = w.main().findChild<QTreeWidget*>();
  const QTreeWidgetItem* seam = tree->topLevelItem(tree->topLevelItemCount() - 1);
  tree->scrollToItem(seam);
  const QPoint at = tree->visualItemRect(seam).center();
  QTest::mouseClick(tree->viewport(), Qt::RightButton, {}, at);
  QContextMenuEvent asked(QContextMenuEvent::Mouse, at, tree->viewport()->mapToGlobal(at));
  QApplication::sendEvent(tree->viewport(), &asked);
  EXPECT_TRUE(w.session().selection().seam);
  const std::size_t seams = w.session().snapshot().document.pattern.seams.size();
  chooseEntry(w, "Unpick this seam");
  EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), seams - 1);
}

TEST(StudioMenus, RedoHasTwoKeys) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
  w.space().setFocus();
  const std::size_t all = w.count();
  for (const auto& [key, keys] : {std::pair{Qt::Key_Y, Qt::KeyboardModifiers(Qt::ControlModifier)},
                                  std::pair{Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier}}) {
    QTest::keyClick(&w.space(), Qt::Key_Z, Qt::ControlModifier);
    w.rest();
    ASSERT_EQ(w.count(), all - 1);
    QTest::keyClick(&w.space(), key, keys);
    w.rest();
    EXPECT_EQ(w.count(), all);
  }
}

TEST(StudioMenus, F11FillsTheScreenAndBack) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.main().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
  QTest::keyClick(&w.main(), Qt::Key_F11);
  QApplication::processEvents();
  EXPECT_TRUE(w.main().isFullScreen());
  QTest::keyClick(&w.main(), Qt::Key_F11);
  QApplication::processEvents();
  EXPECT_FALSE(w.main().isFullScreen());
}

TEST(StudioMenus, TheLanguageThatIsSpokenIsTicked) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  auto* english = w.main().findChild<QAction*>("english");
  auto* japanese = w.main().findChild<QAction*>("japanese");
  ASSERT_TRUE(english && japanese);
  EXPECT_TRUE(english->isChecked());
  EXPECT_FALSE(japanese->isChecked());
  Theme::here().setLanguage(Language::Japanese);
  EXPECT_TRUE(japanese->isChecked());
  EXPECT_FALSE(english->isChecked());
  english->trigger();
  english->trigger();
  EXPECT_TRUE(english->isChecked()) << "a second time, too";
}

TEST(StudioMenus, WhereThereIsNoOtherSizeTheMenuSaysWhy) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  auto* menu = w.main().findChild<QMenu*>("beside");
  ASSERT_TRUE(menu);
  emit menu->aboutToShow();
  EXPECT_TRUE(menu->toolTipsVisible());
  QAction* sizes = nullptr;
  for (QAction* one : menu->actions())
    if (withoutLetter(*one).startsWith("Another size")) sizes = one;
  ASSERT_TRUE(sizes);
  EXPECT_EQ(withoutLetter(*sizes), "Another size – this garment has none") << "to be read at once";
  EXPECT_FALSE(sizes->isEnabled());
  EXPECT_THAT(sizes->toolTip().toStdString(), testing::HasSubstr("no sizes"));
}

TEST(StudioMenus, StereoIsUnderView) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  auto* stereo = w.main().findChild<QMenu*>("stereo");
  ASSERT_TRUE(stereo);
  ASSERT_EQ(stereo->actions().size(), 6);
  stereo->actions()[3]->trigger();
  w.rest();
  EXPECT_EQ(w.space().stereo(), Stereo::Anaglyph);
  QComboBox* board = nullptr;
  for (QComboBox* one : w.main().findChildren<QComboBox*>())
    if (one->findText("row by row") >= 0) board = one;
  ASSERT_TRUE(board);
  EXPECT_EQ(board->currentIndex(), 3) << "the board says the same";
  board->setCurrentIndex(0);
  emit stereo->aboutToShow();
  EXPECT_TRUE(stereo->actions()[0]->isChecked());
}

TEST(StudioMenus, ABandAlongANecklineAndAPieceWrappedWhereOnePoints) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  const Piece front = *w.session().snapshot().document.pieceNamed("front");
  const std::size_t before = w.count();
  rightClick(w, w.table(), w.onTable("front", findEdge(front, "neck_left")->curve.atFraction(0.5)));
  chooseEntry(w, "Band along it…");
  auto* numbers = w.main().findChild<QDialog*>("step_dialog");
  ASSERT_TRUE(numbers);
  QTest::mouseClick(numbers->findChild<QPushButton*>("make"), Qt::LeftButton);
  w.rest();
  ASSERT_GE(w.count(), before + 1) << w.main().said().toStdString();
  const std::string band = text(w.session().steps()[before].operation);
  EXPECT_THAT(band, StartsWith("band name=collar of="));
  EXPECT_THAT(band, AllOf(HasSubstr("neck_left"), HasSubstr("neck_right"), HasSubstr("sew=yes")));
  EXPECT_EQ(w.session().steps()[before].operation.index(), Operation(DrawBand{}).index());
  EXPECT_EQ(std::get<DrawBand>(w.session().steps()[before].operation).of.size(), 4u) << "the whole neckline";

  DrawRectangle belt;
  belt.name = "belt", belt.width = {0.7}, belt.height = {0.04};
  w.session().perform(belt);
  w.rest();
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("belt")->id};
  w.session().select(chosen);
  w.view(View::Front);
  rightClick(w, w.space(), w.onSkin("left_leg:knee@0"));
  chooseEntry(w, "Wrap the chosen piece round here");
  EXPECT_THAT(w.last(), AllOf(StartsWith("place piece="), HasSubstr("left_leg:")));
  rightClick(w, w.space(), w.onSkin("right_leg:knee@0"));
  chooseEntry(w, "Wrap it half-way round, what is wider in waves");
  EXPECT_THAT(w.last(), AllOf(StartsWith("place piece="), HasSubstr("arc=0.5")));
}

TEST(StudioMenus, BothPlacesOfASlashAreShownAsShares) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  const Piece front = *w.session().snapshot().document.pieceNamed("front");
  const auto on = [&](const char* edge) { return w.onTable("front", findEdge(front, edge)->curve.atFraction(0.5)); };
  w.click(w.table(), on("armhole_left"));
  w.rest();
  rightClick(w, w.table(), on("hem_left"));
  chooseEntry(w, "Slash to left armhole of front and spread or fold out…");
  auto* numbers = w.main().findChild<QDialog*>("step_dialog");
  ASSERT_TRUE(numbers);
  for (const char* place : {"at", "to_at"})
    EXPECT_THAT(numbers->findChild<QLineEdit*>(place)->text().toStdString(), testing::EndsWith(" %")) << place;
  numbers->reject();
}

// A pleat that runs out at the edge that was chosen, at the place of the click.
TEST(StudioMenus, APleatRunsOutAtTheChosenEdge) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(*parseOperation("rectangle name=skirt width=60cm height=40cm")), w.rest();
  w.table().showAll();
  w.rest();
  w.key(Command::Select);
  const Piece skirt = *w.session().snapshot().document.pieceNamed("skirt");
  const auto on = [&](const char* edge, double share) {
    return w.onTable("skirt", findEdge(skirt, edge)->curve.atFraction(share));
  };
  w.click(w.table(), on("bottom", 0.6));
  w.rest();
  rightClick(w, w.table(), on("top", 0.35));
  w.keep("studio_pleat_to_menu");
  chooseEntry(w, "Pleat that runs out at bottom edge of skirt…");
  auto* numbers = w.main().findChild<QDialog*>("step_dialog");
  ASSERT_TRUE(numbers) << w.main().said().toStdString();
  EXPECT_FALSE(numbers->findChild<QLineEdit*>("count")->isVisible()) << "it has its place";
  EXPECT_TRUE(numbers->findChild<QLineEdit*>("depth")->isVisible());
  w.keepDialog(*numbers, "studio_pleat_to");
  QTest::mouseClick(numbers->findChild<QPushButton*>("make"), Qt::LeftButton);
  QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  w.rest();
  EXPECT_THAT(w.last(), AllOf(StartsWith("pleat edge="), HasSubstr("to=p1.bottom"), HasSubstr("hold=0")));
  const Piece& pleated = *w.session().snapshot().document.pieceNamed("skirt");
  EXPECT_NEAR(findEdge(pleated, "bottom")->curve.length(), 0.6, 1e-3);
  EXPECT_TRUE(findEdge(pleated, "pleat_2"));
  w.keep("studio_pleated_to");
}

// The mirrored copy of a cuff is sewn to the other sleeve.
TEST(StudioMenus, WhatIsMirroredIsSewnAsThePieceIs) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line :
       {"polygon name=sleeve_left points=\"-12cm,0; 12cm,0; 16cm,40cm; -16cm,40cm\" edges=\"hem a cap b\"",
        "mirror piece=sleeve_left", "rectangle name=cuff_left width=24cm height=6cm",
        "sew a=cuff_left.top b=sleeve_left.hem"})
    w.session().perform(*parseOperation(line)), w.rest();
  ASSERT_EQ(w.count(), 4u) << w.main().said().toStdString();
  Selection cuff;
  cuff.pieces = {w.session().snapshot().document.pieceNamed("cuff_left")->id};
  w.session().select(cuff);
  w.session().command(Command::Mirror);
  w.rest();
  const Document& now = w.session().snapshot().document;
  ASSERT_TRUE(now.pieceNamed("cuff_right")) << w.main().said().toStdString();
  ASSERT_EQ(now.pattern.seams.size(), 2u);
  const Seam& seam = now.pattern.seams.rbegin()->second;
  EXPECT_EQ(seam.a.front().piece, now.pieceNamed("cuff_right")->id);
  EXPECT_EQ(seam.b.front().piece, now.pieceNamed("sleeve_right")->id);
}

// What is sewn or pressed there is a step firmer or softer by one click, and stays what it is otherwise.
TEST(StudioMenus, AnElasticAndAFoldAreStrongerAndWeakerByOneClick) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  for (const char* line :
       {"elastic edges=front.hem_left ratio=0.9 strength=8", "line piece=front along=\"-8cm,20cm; 8cm,20cm\" name=tuck",
        "fold piece=front line=tuck angle=60deg hold=0.5"})
    w.session().perform(*parseOperation(line));
  w.rest();
  const auto front = [&] { return w.session().snapshot().document.pieceNamed("front"); };
  const auto elastic = [&] {
    return w.session().snapshot().document.allowances.elastics.at({front()->id, "hem_left"});
  };
  const Flat hem = findEdge(*front(), "hem_left")->curve.atFraction(0.5);
  rightClick(w, w.table(), w.onTable("front", hem));
  chooseEntry(w, "Stronger elastic: 12 N");
  w.rest();
  EXPECT_EQ(elastic(), (Elastic{0.9, 12})) << w.main().said().toStdString();
  rightClick(w, w.table(), w.onTable("front", hem));
  w.keep("studio_elastic_menu");
  chooseEntry(w, "Weaker elastic: 8 N");
  w.rest();
  EXPECT_EQ(elastic(), (Elastic{0.9, 8}));

  const auto crease = [&] {
    for (const InternalLine& line : front()->lines)
      if (line.name == "tuck") return *line.crease;
    return Crease{};
  };
  rightClick(w, w.table(), w.onTable("front", {0.03, 0.2}));
  chooseEntry(w, "Press the fold harder: 60 %");
  w.rest();
  EXPECT_NEAR(crease().hold, 0.6, 1e-12) << w.main().said().toStdString();
  EXPECT_NEAR(crease().angle, std::numbers::pi / 3, 1e-12);
  rightClick(w, w.table(), w.onTable("front", {0.03, 0.2}));
  chooseEntry(w, "Press the fold softer: 50 %");
  w.rest();
  EXPECT_NEAR(crease().hold, 0.5, 1e-12);
}

TEST(StudioMenus, OnlyAPieceThatIsSewnToNothingIsOfferedToBeSewnOn) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  DrawRectangle pocket;
  pocket.name = "pocket", pocket.width = {0.1}, pocket.height = {0.1};
  w.session().perform(pocket);
  w.rest();
  const auto offeredWith = [&](const char* piece) {
    Selection chosen;
    chosen.pieces = {w.session().snapshot().document.pieceNamed(piece)->id};
    w.session().select(chosen);
    rightClick(w, w.table(), w.onTable("back", {0.05, 0.3}));
    const auto all = offered();
    if (QMenu* menu = contextMenu()) menu->close();
    return all;
  };
  EXPECT_THAT(offeredWith("pocket"), Contains("Sew pocket on here…"));
  EXPECT_THAT(offeredWith("front"), Not(Contains(StartsWith("Sew front"))));
}

// The line at the foot belongs to the menu only while that is open.
TEST(StudioMenus, WhatAMenuSaysGoesWithIt) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const Piece front = *w.session().snapshot().document.pieceNamed("front");
  rightClick(w, w.table(), w.onTable("front", findEdge(front, "side_left")->curve.atFraction(0.5)));
  ASSERT_THAT(offered(), Contains("Unpick this seam"));
  QMenu* menu = contextMenu();
  const auto foot = [&] { return w.main().statusBar()->currentMessage().toStdString(); };
  QTest::keyClick(menu, Qt::Key_Down);
  EXPECT_EQ(foot(), "Sews a crossed seam the other way round.");
  QTest::keyClick(menu, Qt::Key_Down);
  EXPECT_EQ(foot(), "") << "of an entry that says nothing";
  QTest::keyClick(menu, Qt::Key_Up);
  QTest::keyClick(menu, Qt::Key_Down);
  QTest::keyClick(menu, Qt::Key_Return);
  w.rest();
  EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), 3u);
  EXPECT_EQ(foot(), "");
}

// What is on has a tick, however it was put on.
TEST(StudioMenus, WhatIsSwitchedOnIsTicked) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  QAction* dark = w.main().findChild<QAction*>("dark");
  ASSERT_TRUE(dark);
  EXPECT_TRUE(dark->isCheckable());
  EXPECT_FALSE(dark->isChecked());
  dark->trigger();
  EXPECT_TRUE(Theme::here().dark());
  EXPECT_TRUE(dark->isChecked());
  dark->trigger();
  EXPECT_FALSE(Theme::here().dark());
  EXPECT_FALSE(dark->isChecked());
  const auto ticked = [&] {
    auto* view = qobject_cast<QMenu*>(w.main().findChild<QAction*>("map_strain")->parent());
    Q_EMIT view->aboutToShow();
    std::string all;
    for (const char* name : {"map_strain", "map_ease", "map_pressure"}) {
      const QAction* one = w.main().findChild<QAction*>(name);
      EXPECT_TRUE(one->icon().isNull()) << "a picture stands in place of the tick";
      all += one->isChecked() ? '1' : '0';
    }
    return all;
  };
  ASSERT_TRUE(w.main().findChild<QAction*>("map_strain"));
  EXPECT_EQ(ticked(), "000");
  w.main().findChild<QAction*>("map_ease")->trigger();
  EXPECT_EQ(ticked(), "010");
  w.space().setMap(FitMap::Strain);  // as the board Fit does
  EXPECT_EQ(ticked(), "100");
  w.main().findChild<QAction*>("map_strain")->trigger();
  EXPECT_EQ(w.space().map(), FitMap::None);
  EXPECT_EQ(ticked(), "000");
}

// From an edge over the middle to one that is only half: on both halves alike. How many is typed without taking the
// place away that was clicked, which is that of a single slash.
TEST(StudioMenus, SeveralSlashesKeepAPieceSymmetric) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(*parseOperation(
      "piece name=back outline=\"M -200 0; hem_right L 0 0; hem_left L 200 0; side_left L 180 300; top L -180 300; "
      "side_right L -200 0\""));
  w.rest();
  w.table().showAll();
  w.rest();
  w.key(Command::Select);
  const Piece before = *w.session().snapshot().document.pieceNamed("back");
  const auto on = [&](const char* edge, double share) {
    return w.onTable("back", findEdge(before, edge)->curve.atFraction(share));
  };
  w.click(w.table(), on("hem_left", 0.5));
  w.rest();
  rightClick(w, w.table(), on("top", 0.3));
  chooseEntry(w, "Slash to left hem of back and spread or fold out…");
  auto* numbers = w.main().findChild<QDialog*>("step_dialog");
  ASSERT_TRUE(numbers);
  auto& count = *numbers->findChild<QLineEdit*>("count");
  count.selectAll();
  QTest::keyClicks(&count, "2");
  EXPECT_EQ(numbers->findChild<QLabel*>("said")->text().toStdString(), "");
  QTest::mouseClick(numbers->findChild<QPushButton*>("make"), Qt::LeftButton);
  w.rest();
  const Piece& after = *w.session().snapshot().document.pieceNamed("back");
  EXPECT_TRUE(symmetryOf(after.outline));
  EXPECT_NEAR(findEdge(after, "top")->curve.length(), 0.36 + 4 * 0.03, 0.01) << "two on either half";
}

// What a cut parted is sewn again from its menu, as a yoke is; on the other half of the garment, too.
TEST(StudioMenus, WhatACutPartedIsSewnAgain) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line :
       {"piece name=front_left outline=\"M 0 0; hem L 300 0; side L 300 400; top L 0 400; centre L 0 0\"",
        "mirror piece=front_left", "cut piece=front_left line=\"-3cm,25cm; 15cm,30cm; 33cm,30cm\" copies=yes"})
    w.session().perform(*parseOperation(line)), w.rest();
  ASSERT_EQ(w.session().snapshot().document.pattern.pieces.size(), 4u) << w.main().said().toStdString();
  w.table().showAll();
  w.rest();
  w.key(Command::Select);
  const Piece lower = *w.session().snapshot().document.pieceNamed("front_left");
  rightClick(w, w.table(), w.onTable("front_left", findEdge(lower, "cut")->curve.atFraction(0.5)));
  const auto words = offered();
  const auto again =
      std::find_if(words.begin(), words.end(), [](const auto& one) { return one.starts_with("Sew it"); });
  ASSERT_NE(again, words.end()) << testing::PrintToString(words);
  chooseEntry(w, again->c_str());
  const auto& seams = w.session().snapshot().document.pattern.seams;
  ASSERT_EQ(seams.size(), 2u) << w.main().said().toStdString();
  for (const auto& [id, seam] : seams) {
    EXPECT_EQ(seam.a.size(), 2u) << "the whole cut, over its corner";
    EXPECT_NEAR(lengthMismatch(w.session().snapshot().document.pattern, seam), 0, 1e-6);
  }
  rightClick(w, w.table(), w.onTable("front_left", findEdge(lower, "hem")->curve.atFraction(0.5)));
  EXPECT_THAT(offered(), Not(Contains(StartsWith("Sew it")))) << "no cut parted the hem";
  contextMenu()->close();
}

}  // namespace
}  // namespace karinui::studio

// Pieces drawn on paper in the real window: tools, numbers, bands and leading along edges; ready blocks.
#include <gmock/gmock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QScrollArea>
#include <QScrollBar>
#include <QTest>
#include <QTimer>
#include <cmath>
#include <numbers>

#include "drafts.h"
#include "karinui/design/edge_run.h"
#include "karinui/design/script.h"
#include "menu_letters.h"
#include "new_pieces.h"
#include "outline_drawing.h"
#include "step_dialog.h"
#include "studio/asked.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

TEST(StudioNewPieces, AnEdgeIsDrawnAnewAsAFairLineFromItsMenu) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(
      *parseOperation("piece name=cap outline=\"M 0 0; hem L 300 0; side L 300 60; top C 250 60 240 20 200 60; top_2 C "
                      "150 110 100 30 60 "
                      "60; rest L 0 60; left L 0 0\""));
  w.rest();
  menuOn(w, "cap", "hem");
  EXPECT_FALSE(choose(w, "Redraw as a fair line")) << "it is straight";
  for (QMenu* menu : w.main().findChildren<QMenu*>("context")) menu->close();
  QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  const double before = findEdge(piece(w, "cap"), "top_2")->curve.length();
  menuOn(w, "cap", "top_2");
  ASSERT_TRUE(choose(w, "Redraw as a fair line"));
  EXPECT_LT(findEdge(piece(w, "cap"), "top_2")->curve.length(), before - 0.001) << w.main().said().toStdString();
}

TEST(StudioNewPieces, TheSettingsOfTheGarmentAreTyped) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  fromTheMenu(w, say("Settings of the garment…"));
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    numbers.accept();  // nothing was changed
  }
  EXPECT_EQ(w.count(), before);
  fromTheMenu(w, say("Settings of the garment…"));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  numbers.type("spacing", "20cm");
  EXPECT_FALSE(numbers.make().isEnabled());
  EXPECT_THAT(numbers.said().toStdString(), HasSubstr("between 0.20 cm and 5.00 cm"));
  auto* area = numbers.dialog->findChild<QScrollArea*>();
  const auto hidden = [&] {
    QStringList names;
    for (const QWidget* box : area->widget()->findChildren<QWidget*>())
      if (box->isVisible() && box->focusPolicy() != Qt::NoFocus && box->parentWidget() == area->widget() &&
          !area->viewport()->rect().contains(QRect(box->mapTo(area->viewport(), QPoint()), box->size())))
        names << box->objectName();
    return names;
  };
  EXPECT_TRUE(QTest::qWaitFor([&] { return hidden().isEmpty(); }, 2000))
      << hidden().join(", ").toStdString() << " by what is told";
  numbers.type("spacing", "250");
  EXPECT_THAT(numbers.said().toStdString(), HasSubstr("between 0.20 cm and 5.00 cm")) << "centimetres, no metres";
  numbers.line("spacing").selectAll();
  numbers.line("spacing").insert("３");  // as Japanese input gives it
  numbers.type("ease", "1.5");
  numbers.accept();
  EXPECT_EQ(w.count(), before + 1);
  EXPECT_NEAR(w.session().snapshot().document.settings.spacing, 0.03, 1e-12);
  EXPECT_NEAR(w.session().snapshot().document.settings.ease, 0.015, 1e-12);
}

TEST(StudioNewPieces, AClickWithRectangleAsksForItsSizeAndAFormulaIsKept) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.key(Command::Rectangle);
  w.click(w.table(), {40, 40});
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(w.count(), before) << "nothing is done yet";
  numbers.type("width", "waist_girth/2 + 2cm");
  numbers.type("height", "0");
  EXPECT_THAT(numbers.said().toStdString(), HasSubstr("between 0 and 20 m"));
  EXPECT_FALSE(numbers.make().isEnabled());
  numbers.type("height", "12,5");
  EXPECT_FALSE(numbers.make().isEnabled()) << "two numbers are no height";
  numbers.type("height", "12.5");
  EXPECT_EQ(numbers.said(), "");
  w.keepDialog(*numbers.dialog, "studio_numbers");
  numbers.accept();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), AllOf(StartsWith("rectangle name=rectangle"), HasSubstr("waist_girth/2 + 2cm")));
  const double waist = w.session().snapshot().body->measured().value.at("waist_girth");
  EXPECT_NEAR(draftedLength(w, "rectangle", "bottom"), waist / 2 + 0.02, 2e-3);
  EXPECT_NEAR(draftedLength(w, "rectangle", "side_left"), 0.125, 1e-9);
}

TEST(StudioNewPieces, TheRingToolDrawsASectorAndAClickAsksForNumbers) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  std::size_t before = w.count();
  w.key(Command::RingSector);
  const QPointF middle(120, 60);
  const QPointF zero = w.table().onScreen({0, 0});
  const double metre = w.table().onScreen({1, 0}).x() - w.table().onScreen({0, 0}).x();
  w.drag(w.table(), {middle, middle + QPointF(0.2 * metre, 0)});
  EXPECT_EQ(w.count(), before) << "the inner edge is still to come";
  w.hover(w.table(), middle + QPointF(0.1 * metre, 0));
  EXPECT_FALSE(w.session().preview().table.lines.empty());
  w.click(w.table(), middle + QPointF(0.1 * metre, 0));
  w.rest();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  const auto ring = std::get<DrawRing>(w.session().steps().back().operation);
  EXPECT_NEAR(*ring.radius, 0.1, 1e-9);
  EXPECT_NEAR(ring.depth, 0.1, 1e-9);
  EXPECT_NEAR(ring.angle, M_PI, 1e-9) << "level with the middle: half a ring";
  EXPECT_NEAR(draftedLength(w, "ring", "waist"), M_PI * 0.1, 1e-5);
  // It lies where it was drawn.
  const Flat origin = w.session().table().at(piece(w, "ring").id);
  EXPECT_NEAR(origin.u, (middle.x() - zero.x()) / metre, 0.002);
  EXPECT_NEAR(origin.v, (zero.y() - middle.y()) / metre, 0.002);
  // By numbers: a quarter of a circle skirt round 70 cm.
  before = w.count();
  w.click(w.table(), {30, 200});
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  numbers.type("inner", "70");
  numbers.type("angle", "90");
  numbers.type("depth", "60 cm");
  w.keepDialog(*numbers.dialog, "studio_ring");
  numbers.accept();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_NEAR(draftedLength(w, "ring_2", "waist"), 0.7, 1e-5);
  EXPECT_NEAR(draftedLength(w, "ring_2", "hem"), 0.7 + 0.6 * M_PI / 2, 1e-4);
}

TEST(StudioNewPieces, APolygonIsClickedByPointerAndByKeys) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  std::size_t before = w.count();
  w.key(Command::Polygon);
  w.click(w.table(), {30, 30});
  w.click(w.table(), {110, 30});
  w.drag(w.table(), {QPointF(120, 70)}, Qt::ControlModifier);
  w.click(w.table(), {110, 110});
  w.click(w.table(), {60, 130});
  w.key(Command::Undo);
  w.click(w.table(), {30, 110});
  EXPECT_EQ(w.count(), before);
  w.keep("studio_polygon");
  w.click(w.table(), {30, 30});
  w.rest();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  const auto polygon = std::get<DrawPolygon>(w.session().steps().back().operation);
  EXPECT_EQ(polygon.points.size(), 5u);
  EXPECT_EQ(polygon.edges[2], "~");
  EXPECT_EQ(piece(w, "polygon").outline.edges.size(), 4u);
  // By keys: three places with the arrows, Enter twice at the last.
  before = w.count();
  w.main().activateWindow();
  w.table().setFocus();
  const auto strike = [&](int key, int times = 1) {
    for (int i = 0; i < times; ++i) w.type(w.table(), key);
  };
  strike(Qt::Key_Tab);  // the fingertip is there
  strike(Qt::Key_PageUp, 2);
  strike(Qt::Key_Return);
  strike(Qt::Key_Right, 3);
  strike(Qt::Key_Return);
  strike(Qt::Key_Down, 2);
  strike(Qt::Key_Return, 2);
  w.rest();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString() << " " << w.last();
  EXPECT_THAT(w.last(), StartsWith("polygon name=polygon_2 points="));
  EXPECT_EQ(piece(w, "polygon_2").outline.edges.size(), 3u);
}

TEST(StudioNewPieces, ACollarOfTheNecklineByItsNumbers) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(*parseOperation("fabric name=linen piece=front"));
  w.rest();
  w.key(Command::Select);
  const std::size_t before = w.count();
  menuOn(w, "front", "neck_left");
  ASSERT_TRUE(choose(w, QString::fromUtf8("Band along it…")));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers.line("name").text(), "collar");
  numbers.type("depth", "5");
  numbers.accept();
  ASSERT_GE(w.count(), before + 1) << w.main().said().toStdString();
  const auto& band = std::get<DrawBand>(w.session().steps()[before].operation);
  EXPECT_EQ(band.of.size(), 4u) << "the whole neckline";
  EXPECT_EQ(band.fabric, "linen") << "as the piece it is sewn to";
  EXPECT_TRUE(band.sew);
  EXPECT_NEAR(draftedLength(w, "collar", "end_left"), 0.05, 1e-9);
  double neck = 0;
  for (const char* half : {"neck_left", "neck_right"})
    neck += draftedLength(w, "front", half) + draftedLength(w, "back", half);
  EXPECT_NEAR(draftedLength(w, "collar", "low"), neck, 1e-6);
  // The board says of the edge what it is sewn to, all of it.
  int told = 0;
  for (const QLabel* label : w.main().findChildren<QLabel*>())
    if (label->isVisible() && label->text().contains("collar") && label->wordWrap()) {
      EXPECT_GE(label->height(), label->heightForWidth(label->width())) << label->text().toStdString();
      ++told;
    }
  EXPECT_EQ(told, 1);
}

// One place of an edge chosen, the right button on another: the strap goes over the shoulder and is sewn at both ends.
TEST(StudioNewPieces, AStrapFromOneEdgeToAnother) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  const std::size_t before = w.count(), seams = w.session().snapshot().document.pattern.seams.size();
  w.click(w.table(), w.onTable("front", findEdge(piece(w, "front"), "armhole_left")->curve.atFraction(0.3)));
  ASSERT_TRUE(w.session().selection().edge);
  menuOn(w, "back", "armhole_left");
  ASSERT_TRUE(choose(w, "Strap from *")) << w.main().said().toStdString();
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("width").text(), "2 cm");
    EXPECT_EQ(numbers.said(), "");
    numbers.type("width", "3");
    numbers.accept();
  }
  ASSERT_GE(w.count(), before + 1) << w.main().said().toStdString();
  const auto& strap = std::get<DrawStrap>(w.session().steps()[before].operation);
  ASSERT_TRUE(strap.over);
  EXPECT_EQ(strap.over->landmark, "shoulder_left");
  EXPECT_NEAR(draftedLength(w, "strap", "low"), 0.03, 1e-5);
  EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), seams + 2);
}

TEST(StudioNewPieces, AChosenEdgeIsLedAlongOthersAndSewn) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Select);
  DrawRectangle frill;
  frill.name = "frill";
  frill.width = {draftedLength(w, "front", "hem_left") + draftedLength(w, "front", "hem_right") +
                 draftedLength(w, "back", "hem_left") + draftedLength(w, "back", "hem_right")};
  frill.height = {0.1};
  w.session().perform(frill);
  w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  const std::size_t before = w.count();
  w.click(w.table(), w.onTable("frill", findEdge(piece(w, "frill"), "top")->curve.atFraction(0.5)));
  ASSERT_TRUE(w.session().selection().edge);
  ASSERT_EQ(w.session().selection().edge->edge, "top");
  menuOn(w, "front", "hem_left");
  ASSERT_TRUE(choose(w, "* along it and sew"));
  ASSERT_GE(w.count(), before + 2) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("attach edge="));
  EXPECT_THAT(text(w.session().steps()[before + 1].operation), StartsWith("sew a="));
  EXPECT_TRUE(piece(w, "frill").form) << "it stands along the hem";
}

TEST(StudioNewPieces, AYokeIsCutAcrossADartAndMergedFromTheMenu) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line :
       {"piece name=skirt outline=\"M 0 0; hem L 500 0; side L 480 400; waist L 20 400; side_2 L 0 0\"",
        "dart edge=skirt.waist at=0.4 width=40mm tip=300mm,250mm"})
    w.session().perform(*parseOperation(line)), w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Cut);
  w.drag(w.table(),
         {w.onTable("skirt", {-0.02, 0.34}), w.onTable("skirt", {0.25, 0.34}), w.onTable("skirt", {0.52, 0.34})});
  w.rest();
  ASSERT_THAT(w.last(), StartsWith("cut piece=")) << w.main().said().toStdString();
  ASSERT_EQ(w.session().snapshot().document.pattern.pieces.size(), 4u) << "the dart is on both halves";
  w.key(Command::Select);
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  std::string leg;
  for (const Edge& edge : piece(w, "skirt_2").outline.edges)
    if (edge.name.starts_with("dart")) leg = edge.name;
  menuOn(w, "skirt_2", leg.c_str());
  ASSERT_TRUE(choose(w, "Merge with*"));
  EXPECT_THAT(w.last(), StartsWith("merge a="));
  EXPECT_EQ(w.session().snapshot().document.pattern.pieces.size(), 3u);
}

TEST(StudioNewPieces, HalvesAreUnfoldedFromTheMenuOfTheirEdge) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(
      *parseOperation("polygon name=yoke points=\"0,0; 20cm,0; 15cm,10cm; 0,8cm\" "
                      "edges=\"hem side top fold\""));
  w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
  menuOn(w, "yoke", "fold");
  ASSERT_TRUE(choose(w, "Unfold on it: both halves"));
  EXPECT_THAT(w.last(), StartsWith("unfold edge="));
  EXPECT_FALSE(findEdge(piece(w, "yoke"), "fold"));
}

// Of a block only that is asked which its kind has; all of the dialog stays on the screen.
TEST(StudioNewPieces, ABlockIsAskedWhatItsKindHas) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().findChild<QAction*>("block_numbers")->trigger();
  w.rest();
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers.line("ease").placeholderText(), "by the block's own rule");
  auto& kinds = *numbers.dialog->findChild<QComboBox*>("kind");
  numbers.dialog->findChild<QCheckBox*>("more")->click();
  w.rest();
  const auto asked = [&](const char* field) { return numbers.dialog->findChild<QWidget*>(field)->isVisible(); };
  EXPECT_TRUE(asked("armhole") && asked("taper"));
  EXPECT_FALSE(asked("knee") || asked("belly")) << "of a shirt";
  kinds.setCurrentIndex(kinds.findData("trousers"));
  EXPECT_TRUE(asked("knee") && asked("belly") && asked("ease"));
  EXPECT_FALSE(asked("armhole") || asked("taper"));
  kinds.setCurrentIndex(kinds.findData("collar"));
  EXPECT_FALSE(asked("ease"));
  w.rest();
  const QRect there = numbers.dialog->screen()->availableGeometry();
  EXPECT_TRUE(there.contains(numbers.dialog->frameGeometry()))
      << numbers.dialog->frameGeometry().right() << " of " << there.right();
}

// By the right button on an edge, and by keys from the menu; the dialog offers pleats that fit.
TEST(StudioNewPieces, PleatsAndAPocketByTheirNumbers) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  for (const char* line :
       {"rectangle name=apron width=40cm height=45cm", "rectangle name=pocket width=10cm height=12cm"})
    w.session().perform(*parseOperation(line)), w.rest();
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Select);
  std::size_t before = w.count();
  menuOn(w, "apron", "top");
  ASSERT_TRUE(choose(w, QString::fromUtf8("Pleats…")));
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers.line("count").text(), "7");
    EXPECT_EQ(numbers.said(), "");
    numbers.type("count", "4");
    EXPECT_FALSE(numbers.line("lines").isVisible()) << "what few pleats need is asked under More";
    numbers.dialog->findChild<QCheckBox*>("more")->click();
    numbers.type("taper", "5");
    EXPECT_THAT(numbers.said().toStdString(), HasSubstr("at most"));
    numbers.type("taper", "0.8");
    EXPECT_EQ(numbers.said(), "");
    w.keepDialog(*numbers.dialog, "studio_pleats");
    numbers.accept();
  }
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_NEAR(draftedLength(w, "apron", "bottom"),
              0.4 + 4 * 2 * std::get<AddPleat>(w.session().steps()[before].operation).depth, 1e-9);
  // The pocket is chosen, and sewn on where the right button is pressed.
  before = w.count();
  Selection chosen;
  chosen.pieces = {piece(w, "pocket").id};
  w.session().select(chosen);
  w.drag(w.table(), {w.onTable("apron", {-0.06, 0.15})}, {}, {}, Qt::RightButton);
  ASSERT_TRUE(choose(w, QString::fromUtf8("Sew pocket on here…")));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers.line("open").text().toStdString(), "top edge") << "as a hand goes into a pocket";
  EXPECT_EQ(numbers.said().toStdString(), "");
  numbers.accept();
  ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("patch piece="));
  const Flat sewn = std::get<SewPatch>(w.session().steps()[before].operation).at;
  EXPECT_NEAR(std::remainder(sewn.u, 0.005), 0, 1e-9) << "to half centimetres, as what is drawn";
  EXPECT_NEAR(std::remainder(sewn.v, 0.005), 0, 1e-9);
  EXPECT_EQ(w.session().snapshot().document.pattern.seams.rbegin()->second.a.size(), 3u);
  // A top that dips in the middle is of two edges; the outline begins within it.
  w.session().perform(
      *parseOperation("piece name=dipped outline=\"M 50 110; top_left L 0 120; in L 0 0; low L 100 0; out L 100 120; "
                      "top_right L 50 110\""));
  w.rest();
  EXPECT_THAT(patchOf(w.session().snapshot().document, piece(w, "dipped").id).open,
              testing::ElementsAre("top_right", "top_left"));
}

TEST(StudioNewPieces, TheMenuWorkHasAllOfThemForKeys) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  auto *pieces = w.main().findChild<QMenu*>("new_piece"), *details = w.main().findChild<QMenu*>("details");
  ASSERT_TRUE(pieces && details);
  const auto offered = [&](const char* name) {
    QAction* found = nullptr;
    for (QMenu* menu : {pieces, details}) {
      emit menu->aboutToShow();
      if (auto* here = menu->findChild<QAction*>(QString("new_") + name)) found = here;
    }
    return found;
  };
  EXPECT_FALSE(pieces->findChild<QAction*>("new_pleat")) << "what makes no piece has a menu of its own";
  EXPECT_FALSE(pieces->findChild<QAction*>("new_binding"));
  w.session().select({});
  EXPECT_FALSE(offered("band")->isEnabled()) << "no edge is chosen";
  EXPECT_FALSE(offered("pleat")->isEnabled());
  EXPECT_TRUE(offered("pleat")->toolTip().contains("Choose an edge first.")) << "and the menu says why";
  EXPECT_FALSE(offered("patch")->isEnabled()) << "no piece is chosen";
  EXPECT_TRUE(offered("patch")->toolTip().contains("Choose a piece first."));
  Selection pocket;
  pocket.pieces = {piece(w, "front").id};
  w.session().select(pocket);
  EXPECT_TRUE(offered("patch")->isEnabled());
  EXPECT_TRUE(offered("patch")->toolTip().contains("Sews a piece onto another"));
  EXPECT_FALSE(offered("pleat")->isEnabled()) << "a piece is no edge";
  w.session().select({});
  for (const char* name : {"rectangle", "circle", "ring", "polygon"}) {
    const std::size_t before = w.count();
    ASSERT_TRUE(offered(name) && offered(name)->isEnabled()) << name;
    offered(name)->trigger();
    Numbers numbers(w);
    ASSERT_TRUE(numbers) << name;
    EXPECT_EQ(numbers.said(), "") << name;
    QTest::keyClick(&numbers.line("name"), Qt::Key_Return);  // as it is
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    w.rest();
    EXPECT_EQ(w.count(), before + 1) << name << ": " << w.main().said().toStdString();
  }
  Selection hem;
  hem.edge = EdgeNear{piece(w, "front").id, "hem_left", 0.5, 0};
  hem.pieces = {hem.edge->piece};
  w.session().select(hem);
  ASSERT_TRUE(offered("band")->isEnabled());
  offered("band")->trigger();
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers.line("name").text(), "band");
  QTest::keyClick(numbers.dialog, Qt::Key_Escape);
}

// What is needed and was left empty is asked for by its label.
TEST(StudioNewPieces, WhatIsNeededIsAskedForByItsLabel) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  menuOn(w, "front", "neck_left");
  ASSERT_TRUE(choose(w, QString::fromUtf8("Band along it…")));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  numbers.type("depth", "4");
  ASSERT_EQ(numbers.said(), "");
  numbers.line("depth").clear();
  EXPECT_EQ(numbers.said(), QString::fromUtf8("“Depth” has to be filled in."));
  EXPECT_FALSE(numbers.make().isEnabled());
}

// The same for what is sewn along edges; and a second time the dialog begins with what is there.
TEST(StudioNewPieces, FinishesAreRefusedInTheDialogAndAmendedFromWhatIsThere) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const auto asked = [&](const char* words) {
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    menuOn(w, "front", "hem_left");
    EXPECT_TRUE(choose(w, QString::fromUtf8(words))) << words;
    return Numbers(w);
  };
  const std::size_t before = w.count();
  struct Asked {
    const char *words, *field, *bad, *good, *shown, *step;
  };
  for (const Asked& one : {Asked{"Elastic…", "ratio", "3", "0.65", "0.65", "ratio=0.65"},
                           Asked{"Piping…", "thickness", "9cm", "6mm", "0.6 cm", "thickness=6mm"},
                           Asked{"Topstitch…", "rows", "30", "2", "2", "rows=2"},
                           Asked{"Binding…", "width", "1m", "12mm", "1.2 cm", "width=12mm"}}) {
    {
      Numbers numbers = asked(one.words);
      ASSERT_TRUE(numbers);
      numbers.type(one.field, one.bad);
      EXPECT_FALSE(numbers.make().isEnabled()) << one.words;
      EXPECT_NE(numbers.said(), "") << one.words;
      numbers.type(one.field, one.good);
      EXPECT_EQ(numbers.said(), "");
      numbers.accept();
    }
    {
      Numbers numbers = asked(one.words);
      ASSERT_TRUE(numbers);
      EXPECT_EQ(numbers.line(one.field).text().toStdString(), one.shown) << one.words;
      QTest::keyClick(numbers.dialog, Qt::Key_Escape);
    }
    const auto& steps = w.session().steps();
    const bool draped = w.last().starts_with("drape");
    EXPECT_THAT(text(steps[steps.size() - (draped ? 2 : 1)].operation), HasSubstr(one.step));
    w.key(Command::Undo), w.rest();
    EXPECT_EQ(w.count(), before) << "the drape goes with its cause";
  }
  {
    Numbers numbers = asked("Shirring…");
    numbers.type("ratio", "0.6"), numbers.type("rows", "3"), numbers.type("spacing", "8mm");
    numbers.accept();
  }
  {
    Numbers numbers = asked("Shirring…");
    EXPECT_EQ(numbers.line("ratio").text(), "0.6");
    EXPECT_EQ(numbers.line("rows").text(), "3");
    EXPECT_EQ(numbers.line("spacing").text(), "0.8 cm");
    numbers.type("rows", "4");
    numbers.accept();
  }
  int rows = 0;
  for (const InternalLine& line : piece(w, "front").lines) rows += line.name.starts_with("hem_left_row_");
  EXPECT_EQ(rows, 3) << "four with the edge's own";
}

// A waistband over a zip has a lap, and its ends stay open; one round a closed waist has none.
TEST(StudioNewPieces, ABandLapsWhereTheRingOpens) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (
      const char* step :
      {"piece name=front outline=\"M -200 0; hem L 200 0; side_left L 200 400; waist L -200 400; side_right L -200 0\"",
       "piece name=back pose=\"0,0,-0.3 y 180deg\" outline=\"M -200 0; hem L 200 0; side_right L 200 400; waist L -200 "
       "400; side_left L -200 0\"",
       "sew a=front.side_left b=back.side_left", "sew a=front.side_right b=back.side_right"})
    w.session().perform(*parseOperation(step)), w.rest();
  const EdgeRef waist{PieceRef(piece(w, "front").id), "waist"};
  const auto band = [&] {
    const Document& document = w.session().snapshot().document;
    return bandAlong(document, waist, runThrough(document, waist));
  };
  EXPECT_EQ(band().of.size(), 2u);
  EXPECT_EQ(band().extra, 0.0);
  w.session().perform(*parseOperation("fasten kind=zip a=front.side_left b=back.side_left length=18cm"));
  w.rest();
  EXPECT_EQ(band().extra, 0.03) << w.main().said().toStdString();
  w.session().perform(band());
  w.rest();
  EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), 3u) << "two sides and the waist: the ends are open";
}

// A line is turned back, and drawn in, from what it has.
TEST(StudioNewPieces, LinesAreAmendedFromWhatTheyHave) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const PieceId id = piece(w, "front").id;
  for (const char* step :
       {"line piece=front along=\"-4cm,22cm; 4cm,22cm\" name=pocket", "elastic edges=front.pocket ratio=0.8 strength=4",
        "fold piece=front line=pocket angle=30deg hold=0.7"})
    w.session().perform(*parseOperation(step)), w.rest();
  const Document& document = w.session().snapshot().document;
  const SewElastic elastic = elasticAlong(document, {{PieceRef(id), "pocket"}});
  EXPECT_EQ(elastic.ratio, 0.8);
  EXPECT_EQ(elastic.strength, 4);
  EXPECT_FALSE(elastic.rows);
  const FoldLine fold = turningAlong(document, id, "pocket");
  EXPECT_NEAR(fold.angle, 30 * std::numbers::pi / 180, 1e-9);
  EXPECT_EQ(fold.hold, 0.7);
}

// A cuff is cut anew so that it lies on the sleeve; a lapel, on a line that runs out along the front edge, keeps its
// shape, and what the dialog begins with can be made.
TEST(StudioNewPieces, ALapelIsTurnedBackAsItWasCut) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* step : {"piece name=front pose=\"0,1,0.3\" outline=\"M 0 0; hem L 250 0; side L 250 400; shoulder L "
                           "80 500; neckline L 0 "
                           "420; centre L 0 0\"",
                           "line piece=front along=\"8cm,50cm; 0,20cm\" name=roll_line",
                           "piece name=sleeve pose=\"0.5,1,0.3\" outline=\"M 0 0; hem L 250 0; side L 260 400; cap L "
                           "-10 400; other L 0 0\"",
                           "line piece=sleeve along=\"0,6cm; 25cm,6cm\" name=cuff_line"})
    w.session().perform(*parseOperation(step)), w.rest();
  const Document& document = w.session().snapshot().document;
  const FoldLine lapel = turningAlong(document, document.pieceNamed("front")->id, "roll_line");
  EXPECT_FALSE(lapel.flared);
  const FoldLine cuff = turningAlong(document, document.pieceNamed("sleeve")->id, "cuff_line");
  EXPECT_TRUE(cuff.flared);
  for (const FoldLine& fold : {lapel, cuff}) {
    const std::size_t before = w.count();
    w.session().perform(fold);
    w.rest();
    EXPECT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  }
}

// What is held is read in its field, or, where that is very long, under the pointer.
TEST(StudioNewPieces, WhatAFieldHoldsCanBeRead) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  FoldLine fold;
  fold.turned = true;
  for (const Operation& operation : {Operation(shirringAlong(w.session().snapshot().document,
                                                             runThrough(w.session().snapshot().document,
                                                                        {PieceRef(piece(w, "front").id), "hem_left"}))),
                                     Operation(fold), Operation(AddPleat{})}) {
    StepDialog dialog(w.session(), operation, &w.main());
    dialog.setAttribute(Qt::WA_DeleteOnClose, false);
    QApplication::processEvents();
    EXPECT_EQ(dialog.findChild<QScrollArea*>()->verticalScrollBar()->maximum(), 0) << "the screen has room for all";
    for (const QLineEdit* line : dialog.findChildren<QLineEdit*>()) {
      if (!line->isVisible() || line->text().isEmpty()) continue;
      const int wide = line->fontMetrics().horizontalAdvance(line->text());
      EXPECT_GE(line->width(), std::min(420, wide + 8)) << line->text().toStdString();
      EXPECT_TRUE(line->toolTip().contains(line->text().toHtmlEscaped())) << line->toolTip().toStdString();
    }
    for (const QComboBox* list : dialog.findChildren<QComboBox*>()) {
      if (!list->isVisible()) continue;
      EXPECT_GE(list->width(), list->fontMetrics().horizontalAdvance(list->currentText()) + 24)
          << list->objectName().toStdString();
    }
  }
}

// One begins to type where a person would, over a number that can stay.
TEST(StudioNewPieces, DialogsBeginInTheFirstNumber) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  menuOn(w, "front", "hem_left");
  ASSERT_TRUE(choose(w, QString::fromUtf8("Shirring…")));
  {
    Numbers numbers(w);
    ASSERT_TRUE(numbers);
    ASSERT_TRUE(numbers.dialog->focusWidget());
    EXPECT_EQ(numbers.dialog->focusWidget()->objectName(), "ratio");
    EXPECT_NE(numbers.line("ratio").text(), "");
    QTest::keyClick(numbers.dialog, Qt::Key_Escape);
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  }
  menuOn(w, "front", "hem_left");
  ASSERT_TRUE(choose(w, QString::fromUtf8("Facing…")));
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers.dialog->focusWidget()->objectName(), "width");
  EXPECT_EQ(numbers.line("width").text(), "6 cm");
  QTest::keyClick(numbers.dialog, Qt::Key_Escape);
}

// From the menu of new pieces a slash goes straight across, and only its width is left to be typed.
TEST(StudioNewPieces, ASlashFromTheChosenEdgeGoesStraightAcross) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(*parseOperation("rectangle name=apron width=40cm height=45cm")), w.rest();
  Selection bottom;
  bottom.edge = EdgeNear{piece(w, "apron").id, "bottom", 0.5, 0};
  bottom.pieces = {bottom.edge->piece};
  w.session().select(bottom);
  auto* menu = w.main().findChild<QMenu*>("details");
  ASSERT_TRUE(menu);
  emit menu->aboutToShow();
  menu->findChild<QAction*>("new_spread")->trigger();
  Numbers numbers(w);
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers.said(), "");
  ASSERT_TRUE(numbers.make().isEnabled());
  numbers.accept();
  EXPECT_THAT(w.last(), testing::HasSubstr(".top"));
  EXPECT_NEAR(draftedLength(w, "apron", "bottom"), 0.43, 1e-4) << w.main().said().toStdString();
}

// From nothing to a shirt at rest: the start page, the button, Enter.
TEST(StudioNewPieces, AShirtFromTheStartPage) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.main().showStart();
  w.rest();
  QPushButton& way = w.button("Start from a block…");
  w.click(way, way.rect().center());
  Numbers numbers(w, "block_dialog");
  ASSERT_TRUE(numbers);
  auto* size = numbers.dialog->findChild<QComboBox*>("size");
  size->setCurrentIndex(size->findText("EU 38 (women)"));  // as on the board "Body"
  ASSERT_EQ(size->currentData().toByteArray(), "eu38");
  for (QComboBox* box : numbers.dialog->findChildren<QComboBox*>())
    EXPECT_LT(box->findData("collar"), 0) << "there is no neckline yet";
  const auto* kinds = numbers.dialog->findChild<QComboBox*>("kind");
  ASSERT_TRUE(kinds);
  EXPECT_EQ(kinds->currentIndex(), 0) << "the arrow goes on from what it begins with";
  EXPECT_EQ(kinds->itemData(0).toString(), "shirt");
  EXPECT_EQ(kinds->itemData(1).toString(), "bodice");
  numbers.type("ease", "-500");
  QApplication::processEvents();
  for (const QLabel* label : numbers.dialog->findChildren<QLabel*>())
    EXPECT_GE(label->height(), label->heightForWidth(label->width())) << label->text().toStdString();
  numbers.type("ease", "bust_grith/4");
  QTest::mouseClick(&numbers.make(), Qt::LeftButton);
  EXPECT_TRUE(numbers.dialog->isVisible()) << "nothing is begun with what cannot be";
  EXPECT_THAT(numbers.said().toStdString(), HasSubstr("bust_grith"));
  EXPECT_TRUE(w.main().atStart());
  numbers.type("ease", "12");
  w.keepDialog(*numbers.dialog, "studio_block");
  numbers.accept();
  EXPECT_FALSE(w.main().atStart());
  ASSERT_EQ(w.count(), 3u) << w.main().said().toStdString();
  EXPECT_EQ(text(w.session().steps()[0].operation), "body size=eu38");
  EXPECT_EQ(text(w.session().steps()[1].operation),
            "block kind=shirt ease=120mm trued=yes armhole=yes taper=yes both_legs=yes");
  const auto& report = w.session().snapshot().document.drape.last;
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->settled);
  EXPECT_EQ(w.session().path().parent_path(), draftsFolder()) << "a file from its first step";
  w.keep("studio_shirt_block");
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(w.count(), 1u) << "the drape goes with the block";
}

}  // namespace
}  // namespace karinui::studio

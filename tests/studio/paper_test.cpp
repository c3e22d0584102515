// Editing on the paper in the real window: points, notches, darts, lines, by mouse and by number.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFrame>
#include <QLabel>
#include <QMenu>
#include <QPainter>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <numbers>

#include "karinui/design/script.h"
#include "karinui/pattern/cut_line.h"
#include "length_choice.h"
#include "menu_letters.h"
#include "studio/window.h"
#include "table_print.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Selection edgeOf(Window& w, const char* piece, const char* edge) {
  Selection chosen;
  const PieceId id = w.session().snapshot().document.pieceNamed(piece)->id;
  chosen.pieces = {id};
  chosen.edge = EdgeNear{id, edge, 0.5, 0};
  return chosen;
}
Flat onEdge(Window& w, const char* piece, const char* edge, double at) {
  return findEdge(*w.session().snapshot().document.pieceNamed(piece), edge)->curve.atFraction(at);
}

TEST(StudioPaper, MakesDartsWithTwoClicksAndTheClothFollows) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count(), seams = w.session().snapshot().document.pattern.seams.size();
  w.key(Command::Dart);
  const Flat mouth = onEdge(w, "front", "side_left", 0.5);
  w.click(w.table(), w.onTable("front", mouth));
  w.hover(w.table(), w.onTable("front", mouth + Flat{-0.07, 0.01}));
  w.keep("studio_dart");
  EXPECT_FALSE(w.session().preview().space.lines.empty()) << "it is seen on the cloth before it is made";
  w.click(w.table(), w.onTable("front", mouth + Flat{-0.07, 0.01}));
  w.rest();
  ASSERT_EQ(w.count(), before + 2) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("dart edge=p"));
  EXPECT_THAT(w.last(), StartsWith("drape live="));
  EXPECT_EQ(w.session().snapshot().document.pattern.seams.size(), seams + 2) << "one on each half, sewn";
  EXPECT_TRUE(w.session().snapshot().document.drape.last->settled);
  EXPECT_LT(w.session().snapshot().document.drape.last->seamGap, 0.002) << "the darts are closed";
}

// One click hides the scan that lies under the pattern, and one shows it again.
TEST(StudioPaper, AScanIsHiddenByOneClick) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  auto* button = w.table().findChild<QToolButton*>("show_scans");
  ASSERT_TRUE(button);
  EXPECT_FALSE(button->isVisible()) << "there is no scan";
  QTemporaryDir folder;
  const QString file = folder.filePath("sheet.png");
  QImage sheet(300, 400, QImage::Format_RGB32);
  sheet.fill(Qt::white);
  ASSERT_TRUE(sheet.save(file));
  w.session().importScan(file.toStdString());
  w.rest();
  ASSERT_EQ(w.session().snapshot().document.underlays.size(), 1u) << w.main().said().toStdString();
  const auto hidden = [&] { return w.session().snapshot().document.underlays.begin()->second.hidden; };
  EXPECT_TRUE(button->isVisible());
  EXPECT_TRUE(button->isChecked());
  w.click(*button, button->rect().center());
  w.rest();
  EXPECT_TRUE(hidden());
  EXPECT_FALSE(button->isChecked());
  w.click(*button, button->rect().center());
  w.rest();
  EXPECT_FALSE(hidden());
  // One that grows out of sight is shown as a whole.
  w.session().perform(*parseOperation("underlay width=3m at=-2m,-1m"));
  w.rest();
  EXPECT_TRUE(w.table().rect().contains(w.table().onScreen({-3.5, -1}).toPoint()));
  w.key(Command::Undo);
  w.rest();
  w.key(Command::Undo);
  w.rest();
  EXPECT_TRUE(hidden()) << "it is a step like others";
  EXPECT_FALSE(button->isChecked());
}

TEST(StudioPaper, AThinLineOfAScanIsWholeHoweverSmallItIsDrawn) {
  constexpr int kSide = 1600, kLine = 3, kSmall = 200;
  auto scan = std::make_shared<PrintImage>();
  scan->width = scan->height = kSide;
  scan->rgb.assign(3u * kSide * kSide, 255);
  for (int y = 0; y < kSide; ++y)
    for (int x = kSide / 2; x < kSide / 2 + kLine; ++x)
      std::fill_n(scan->rgb.begin() + 3 * (y * kSide + x), 3, std::uint8_t{0});
  QImage drawn(kSmall + 20, kSmall + 20, QImage::Format_RGB32);
  drawn.fill(Qt::white);
  QPainter painter(&drawn);
  paintPicture(painter, scan, {QPointF(10, 10), QPointF(10 + kSmall, 16), QPointF(4, 10 + kSmall)});
  painter.end();
  for (int y = 20; y < kSmall; ++y) {
    int darkest = 255;
    for (int x = 0; x < drawn.width(); ++x) darkest = std::min(darkest, qGray(drawn.pixel(x, y)));
    ASSERT_LT(darkest, 220) << "in row " << y;
  }
}

TEST(StudioPaper, TheRulerHasBothItsEndsAtEveryScale) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.rest();
  const QColor faint = Theme::here().palette().faint;
  for (int turn = 0; turn < 24; ++turn) {
    const QImage seen = w.table().grab().toImage();
    for (int y = seen.height() - 20; y < seen.height() - 16; ++y) {
      const QColor end = seen.pixelColor(seen.width() - 2, y);
      EXPECT_GT(std::abs(end.red() - faint.red()), 60) << "after " << turn << " turns of the wheel";
    }
    const QPointF middle = w.table().rect().center();
    QWheelEvent away(middle, w.table().mapToGlobal(middle), {}, {0, -120}, Qt::NoButton, Qt::NoModifier,
                     Qt::NoScrollPhase, false);
    QApplication::sendEvent(&w.table(), &away);
    QApplication::processEvents();
  }
}

TEST(StudioPaper, MakesADartWithTwoPointsInsideAPiece) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count(), seams = w.session().snapshot().document.pattern.seams.size();
  const Piece& front = *w.session().snapshot().document.pieceNamed("front");
  const Flat waist = front.outline.edges[*front.outline.find("side_left")].curve.atFraction(0.5);
  const Flat low{0.6 * waist.u, waist.v - 0.1}, high{0.6 * waist.u, waist.v + 0.08};
  w.key(Command::Dart);
  w.click(w.table(), w.onTable("front", low));
  w.hover(w.table(), w.onTable("front", high));
  w.keep("studio_double_dart");
  EXPECT_FALSE(w.session().preview().space.lines.empty()) << "it is seen on the cloth before it is made";
  w.click(w.table(), w.onTable("front", high));
  w.rest();
  ASSERT_EQ(w.count(), before + 2) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[before].operation), StartsWith("double_dart piece=p"));
  const Document& document = w.session().snapshot().document;
  EXPECT_EQ(document.pieceNamed("front")->holes.size(), 2u) << "one on each half";
  EXPECT_EQ(document.pattern.seams.size(), seams + 2);
  EXPECT_TRUE(document.drape.last->settled);
  EXPECT_LT(document.drape.last->seamGap, 0.002) << "they are closed";
}

// What the window paints is the table's frame: each notch and each seam is seen where the frame has it.
TEST(StudioPaper, PaintsTheFrameOfTheTable) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  AddNotch notch;
  const Piece& front = *w.session().snapshot().document.pieceNamed("front");
  notch.edge = {PieceRef(front.id), front.outline.edges[0].name};
  notch.at = 0.5;
  w.session().perform(notch);
  w.rest();
  w.session().select({});
  w.rest();
  const TableFrame frame = tableFrameOf(w.session().snapshot(), w.session().table());
  // How far the colour of the pixels at a place is from this one: lines are thin, so the nearest of five counts.
  const auto awayFrom = [&](const QImage& painted, Flat place, const QColor& colour) {
    int least = 1000;
    const QPoint at = w.table().onScreen(place).toPoint();
    for (const QPoint by : {QPoint(0, 0), QPoint(-1, 0), QPoint(1, 0), QPoint(0, -1), QPoint(0, 1)}) {
      const QColor is = painted.pixelColor(at + by);
      least = std::min(least, std::abs(is.red() - colour.red()) + std::abs(is.green() - colour.green()) +
                                  std::abs(is.blue() - colour.blue()));
    }
    return least;
  };
  const QImage whole = w.table().grab().toImage();
  const double pixel = 1 / (w.table().onScreen({1, 0}).x() - w.table().onScreen({0, 0}).x());
  ASSERT_EQ(frame.seams.size(), 4u);
  for (const TableSeam& seam : frame.seams)
    for (const TableSeam::Side& side : seam.sides) {
      const TableSeam::Run& run = side.runs.front();
      EXPECT_LT(awayFrom(whole, run.points[12] + run.inward[12] * (3 * pixel), shown(seam.colour)), 90);
    }
  std::vector<TableNotch> own;
  for (const TablePiece& piece : frame.pieces)
    for (const TableNotch& one : piece.notches)
      if (one.own) own.push_back(one);
  ASSERT_EQ(own.size(), 1u);
  const QPointF at = w.table().onScreen(own[0].stroke.from);
  for (int turn = 0; turn < 16; ++turn) {  // nearer, until five millimetres are more than the lines' thickness
    QWheelEvent wheel(at, w.table().mapToGlobal(at), {}, {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(&w.table(), &wheel);
  }
  const QImage near = w.table().grab().toImage();
  EXPECT_LT(awayFrom(near, lerp(own[0].stroke.from, own[0].stroke.to, 0.7), Theme::here().palette().ink), 200);
}

TEST(StudioPaper, ANumberTypedIsTheNumberCut) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().select(edgeOf(w, "front", "shoulder_left"));
  w.rest();
  const double now = findEdge(*w.session().snapshot().document.pieceNamed("front"), "shoulder_left")->curve.length();
  w.type(w.box("Length"), QString::fromStdString(fixed(now * 100 + 1, 4)) + " cm");
  w.rest();
  const Piece* after = w.session().snapshot().document.pieceNamed("front");
  EXPECT_NEAR(findEdge(*after, "shoulder_left")->curve.length(), now + 0.01, 1e-6);
}

// A piece that grows over its neighbours is laid anew with them; one that the hand laid aside stays there.
TEST(StudioPaper, APieceThatGrowsLiesOnNoOther) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line : {"rectangle name=long width=90cm height=40cm", "rectangle name=below width=90cm height=40cm",
                           "rectangle name=last width=90cm height=20cm"})
    w.session().perform(*parseOperation(line));
  w.rest();
  const auto lies = [&](const char* name) {
    const Piece* piece = w.session().snapshot().document.pieceNamed(name);
    FlatBox box;
    for (const Flat p : piece->outline.flattened(1e-3)) box.include(p + w.session().table().at(piece->id));
    return box;
  };
  const auto apart = [&](const char* one, const char* other) {
    const FlatBox a = lies(one), b = lies(other);
    return a.high.u < b.low.u || b.high.u < a.low.u || a.high.v < b.low.v || b.high.v < a.low.v;
  };
  ASSERT_TRUE(apart("long", "below"));
  const double at = lies("below").low.v;
  w.session().perform(*parseOperation("length edge=long.side_left to=42cm"));
  w.rest();
  EXPECT_EQ(lies("below").low.v, at) << "nothing moves as long as there is room";
  w.session().perform(*parseOperation("length edge=long.side_left to=75cm"));
  w.rest();
  EXPECT_GT(lies("long").high.v - lies("long").low.v, 0.7) << w.main().said().toStdString();
  EXPECT_TRUE(apart("long", "below"));
  EXPECT_TRUE(apart("long", "last"));
  EXPECT_TRUE(apart("below", "last"));
  // What the hand lays over another is meant.
  w.main().action(Command::ViewAll)->trigger();
  w.rest();
  w.key(Command::Move);
  w.drag(w.table(), {w.onTable("last", {0.1, 0.1}), w.onTable("below", {0.1, 0.2})});
  w.rest();
  ASSERT_FALSE(apart("below", "last"));
  const FlatBox laid = lies("last");
  w.session().perform(*parseOperation("length edge=last.side_left to=21cm"));
  w.rest();
  EXPECT_FALSE(apart("below", "last"));
  EXPECT_NEAR(lies("last").low.u, laid.low.u, 1e-9);
}

// What an edge is sewn to has the room it takes, and no more: not that of the edge that was chosen before.
TEST(StudioPaper, NoGapIsLeftBelowWhatAnEdgeIsSewnTo) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(
      *parseOperation("rename piece=back to=a_very_long_name_of_a_piece_that_takes_more_than_one_line"));
  w.rest();
  w.main().boards().setCurrentIndex(0);
  w.session().select(edgeOf(w, "front", "side_left"));
  w.rest();
  QLabel* sewn = nullptr;
  for (QLabel* label : w.main().boards().findChildren<QLabel*>())
    if (label->isVisible() && label->text().contains("very long name") && !label->text().contains("longer"))
      sewn = label;
  ASSERT_TRUE(sewn);
  const int line = sewn->fontMetrics().lineSpacing();
  EXPECT_GE(sewn->height(), 2 * line) << sewn->text().toStdString() << sewn->minimumHeight() << " in "
                                      << sewn->parentWidget()->metaObject()->className();
  w.session().select(edgeOf(w, "front", "hem_left"));
  w.rest();
  EXPECT_LT(sewn->height(), 2 * line) << sewn->text().toStdString();
}

// The ruler stands beside the pieces, not on them.
TEST(StudioPaper, TheRulerCoversNoPiece) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.session().perform(*parseOperation("rectangle name=long width=30cm height=140cm"));
  w.rest();
  const Piece* piece = w.session().snapshot().document.pieceNamed("long");
  const auto cut = cutLines(
      *piece, AllowancePlan(w.session().snapshot().document.pattern, w.session().snapshot().document.allowances), 1e-3);
  ASSERT_TRUE(cut);
  double low = 0;
  for (const Flat p : cut->outer) low = std::max(low, w.onTable("long", p).y());
  EXPECT_LT(low, w.table().height() - 27 - QFontMetricsF(w.table().font()).ascent());
  EXPECT_GT(low, 0.7 * w.table().height());
}

TEST(StudioPaper, PutsWhatIsTypedWhereItIsTyped) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().select(edgeOf(w, "front", "shoulder_left"));
  w.rest();
  const double whole = findEdge(*w.session().snapshot().document.pieceNamed("front"), "shoulder_left")->curve.length();
  Theme::here().setInches(true);
  w.type(w.box("Along the edge"), "2");
  w.button("Notch there").click();
  w.rest();
  EXPECT_THAT(w.last(), StartsWith("notch edge=p"));
  const Mark& mark = w.session().snapshot().document.pieceNamed("front")->marks.at(0);
  EXPECT_NEAR(mark.fraction * whole, 0.0508, 1e-6);
  EXPECT_EQ(w.session().snapshot().document.pieceNamed("front")->marks.size(), 2u) << "both halves are marked";
  EXPECT_THAT(w.box("Length").text().toStdString(), HasSubstr(" in"));
  Theme::here().setInches(false);
  EXPECT_THAT(w.box("Length").text().toStdString(), HasSubstr(" cm"));
  w.button("Point there").click();
  w.rest();
  const Piece* front = w.session().snapshot().document.pieceNamed("front");
  EXPECT_NEAR(findEdge(*front, "shoulder_left")->curve.length(), 0.0508, 1e-6);
  w.button("Take its end away").click();
  w.rest();
  front = w.session().snapshot().document.pieceNamed("front");
  EXPECT_NEAR(findEdge(*front, "shoulder_left")->curve.length(), whole, 1e-6);
}

TEST(StudioPaper, MarksAndLinesAreInTheListAndGoWithDelete) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const PieceId front = w.session().snapshot().document.pieceNamed("front")->id;
  w.session().perform(*parseOperation("line piece=front along=\"-0.05,0.3; 0.05,0.3\" name=pocket"));
  w.session().perform(*parseOperation("notch edge=front.hem_left at=0.25"));
  w.rest();
  w.session().select(edgeOf(w, "front", "hem_left"));
  w.rest();
  auto* tree = w.main().findChild<QTreeWidget*>();
  EXPECT_GE(tree->viewport()->height() / std::max(1, tree->sizeHintForRow(0)), 6)
      << "with an edge chosen the list is a list";
  w.keep("studio_tree");
  const auto inList = [&](const char* words) {
    const auto found = tree->findItems(words, Qt::MatchStartsWith | Qt::MatchRecursive);
    return found.empty() ? nullptr : found.front();
  };
  ASSERT_TRUE(inList("pocket"));
  tree->setCurrentItem(inList("pocket"));
  w.key(Command::Remove);
  w.rest();
  EXPECT_TRUE(w.session().snapshot().document.find(front)->lines.empty()) << w.main().said().toStdString();
  EXPECT_FALSE(inList("pocket"));
  ASSERT_EQ(w.session().snapshot().document.find(front)->marks.size(), 1u);
  ASSERT_TRUE(inList("Notch"));
  tree->setCurrentItem(inList("Notch"));
  w.key(Command::Remove);
  w.rest();
  EXPECT_TRUE(w.session().snapshot().document.find(front)->marks.empty());
}

TEST(StudioPaper, RefusesInTheMeasureThatWasChosen) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const auto refuse = [&] {
    w.session().perform(*parseOperation("dart edge=front.shoulder_left at=0.5 tip=0,0.3 width=60cm"));
    w.rest();
    return w.main().said().toStdString();
  };
  EXPECT_THAT(refuse(), HasSubstr("60.00 cm wide"));
  Theme::here().setInches(true);
  EXPECT_THAT(refuse(), HasSubstr("23.622 in wide"));
  Theme::here().setInches(false);
}

TEST(StudioPaper, PinsWithAClickAndHoldsWhileItSettles) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  EXPECT_EQ(w.main().action(Command::Pin)->shortcut(), QKeySequence("W"));
  const PieceId front = w.session().snapshot().document.pieceNamed("front")->id;
  w.key(Command::Pin);
  const Flat hem{0.06, 0.03};
  w.click(w.space(), w.inSpace("front", hem));
  w.rest();
  ASSERT_EQ(w.session().snapshot().document.pins.at(front).size(), 1u) << w.main().said().toStdString();
  const Flat pin = w.session().snapshot().document.pins.at(front)[0];
  EXPECT_LT(distance(pin, hem), 0.01);
  w.keep("studio_pin");
  w.click(w.table(), w.onTable("front", pin));
  w.rest();
  EXPECT_FALSE(w.session().snapshot().document.pins.contains(front)) << "a click on a pin takes it out";
}

TEST(StudioPaper, EditsBothHalvesAtOnce) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Points);
  const Flat corner = onEdge(w, "front", "side_left", 0);
  const Flat before = onEdge(w, "front", "side_right", 1);
  w.drag(w.table(), {w.onTable("front", corner), w.onTable("front", corner) + QPointF(10, 6)}, {}, [&] {
    w.session().finish();
    w.keep("studio_points_both");
  });
  w.rest();
  const Flat after = onEdge(w, "front", "side_right", 1);
  EXPECT_GT(distance(before, after), 0.005) << "the other half's corner went along";
}

// The cloth follows a point under the hand before it is let go: first carried along, then as it comes to rest, and the
// step that is made then finds that rest as it is.
TEST(StudioPaper, TheClothFollowsAPointThatIsDragged) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.key(Command::Points);
  const Flat corner = onEdge(w, "front", "side_left", 1);
  const PieceId front = w.session().snapshot().document.pieceNamed("front")->id;
  const auto cornerOf = [&](const GarmentSnapshot& shown) {
    const Piece* piece = shown.document.find(front);
    return spaceOf(shown, front, findEdge(*piece, "side_left")->curve.end).value_or(Vec3());
  };
  const std::size_t before = w.count();
  const Vec3 hung = cornerOf(w.session().snapshot());
  const std::uint64_t predicted = w.session().changes().predicted;
  SnapshotPtr rested;
  const QPointF from = w.onTable("front", corner), to = w.onTable("front", corner + Flat{0, -0.04});
  w.drag(w.table(), {from, to}, {}, [&] {
    until(w.main(), [&] { return w.session().changes().predicted > predicted; });
    EXPECT_LT(cornerOf(w.session().shown()).y, hung.y - 0.004) << "carried along with the first answer";
    EXPECT_EQ(w.count(), before) << "nothing is done yet";
    w.session().finish();
    rested = w.session().shownPtr();
    EXPECT_TRUE(rested->document.drape.dirty.empty()) << "the hand rests: so does the cloth";
    EXPECT_GT(distance(cornerOf(*rested), hung), 0.001);
    w.keep("studio_points_follow");
  });
  w.rest();
  ASSERT_EQ(w.count(), before + 2) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), StartsWith("drape live="));
  EXPECT_EQ(drapeHash(w.session().snapshot().document), drapeHash(rested->document)) << "as it was shown";
  EXPECT_EQ(w.session().snapshot().document.find(front)->form, rested->document.find(front)->form)
      << "and not worked out a second time";
}

double lengthOf(Window& w, const char* piece, const char* edge) {
  return findEdge(*w.session().snapshot().document.pieceNamed(piece), edge)->curve.length();
}

TEST(StudioPaper, ATypedLengthChangesBothHalvesAndShowsWhichEndStays) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().select(edgeOf(w, "front", "side_left"));
  w.rest();
  auto* stays = w.main().findChild<LengthChoice*>();
  ASSERT_TRUE(stays);
  auto* box = stays->findChild<QComboBox*>();
  EXPECT_EQ(box->currentText(), "the end at left armhole stays");
  const Preview shown = w.session().preview();
  ASSERT_EQ(shown.table.dots.size(), 2u) << "what stays, on both halves";
  ASSERT_EQ(shown.table.rings.size(), 2u) << "what moves";
  EXPECT_EQ(shown.space.rings.size(), 2u);
  w.keep("studio_length");
  const double side = lengthOf(w, "front", "side_left"), armhole = lengthOf(w, "front", "armhole_left"),
               hem = lengthOf(w, "front", "hem_left");
  w.type(w.box("Length"), QString::fromStdString(fixed(side * 100 + 2, 5)) + " cm");
  w.rest();
  EXPECT_NEAR(lengthOf(w, "front", "side_left"), side + 0.02, 1e-6);
  EXPECT_NEAR(lengthOf(w, "front", "side_right"), side + 0.02, 1e-6);
  EXPECT_EQ(lengthOf(w, "front", "armhole_left"), armhole);
  EXPECT_NEAR(lengthOf(w, "front", "hem_left"), hem, 1e-6);
  EXPECT_THAT(text(w.session().steps()[w.count() - 2].operation), StartsWith("length edge=p"));
  // The other end, by choice.
  const auto lower = [&] {
    const Flat a = onEdge(w, "front", "side_left", 0), b = onEdge(w, "front", "side_left", 1);
    return a.v < b.v ? a : b;
  };
  const Flat low = lower();
  box->setCurrentIndex(box->findText("the end at left hem stays"));
  emit box->activated(box->currentIndex());
  w.rest();
  w.type(w.box("Length"), QString::fromStdString(fixed(side * 100, 5)) + " cm");
  w.rest();
  EXPECT_NEAR(lengthOf(w, "front", "side_right"), side, 1e-6);
  EXPECT_LT(distance(lower(), low), 1e-12);
}

TEST(StudioPaper, EditsBothHalvesBesideASlit) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const Flat hem = onEdge(w, "front", "hem_left", 0.5);
  w.session().perform(*parseOperation("cut piece=front line=\"" + fixed(hem.u, 4) + "," + fixed(hem.v - 0.02, 4) + " " +
                                      fixed(hem.u, 4) + "," + fixed(hem.v + 0.1, 4) + "\""));
  w.rest();
  w.key(Command::Points);
  const Flat corner = onEdge(w, "front", "side_left", 1), before = onEdge(w, "front", "side_right", 0);
  w.drag(w.table(), {w.onTable("front", corner), w.onTable("front", corner) + QPointF(10, 6)});
  w.rest();
  EXPECT_GT(distance(before, onEdge(w, "front", "side_right", 0)), 0.005) << w.main().said().toStdString();
  // The tip of the slit has no image: only this half moves, and that is said.
  const Flat tip = onEdge(w, "front", "cut", 1);
  w.drag(w.table(), {w.onTable("front", tip), w.onTable("front", tip) + QPointF(6, 0)});
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("Only this half was changed"));
}

// A scan of a printed pattern at 200 dots an inch, which lay a little askew on the glass: half a skirt's front.
struct PrintedPattern {
  static constexpr double kDots = 200 / 0.0254, kTurn = -2.5;  // to the metre; degrees, clockwise on the screen
  std::vector<Flat> corners{{0.04, 0.05}, {0.24, 0.04}, {0.25, 0.20}, {0.23, 0.33}, {0.20, 0.42}, {0.04, 0.43}};
  std::vector<Flat> square{{0.26, 0.06}, {0.36, 0.06}, {0.36, 0.16}, {0.26, 0.16}};
  QImage image{static_cast<int>(0.40 * kDots), static_cast<int>(0.47 * kDots), QImage::Format_RGB888};
  QTransform paper;  // metres, from its lower left corner, to pixels

  PrintedPattern() {
    const QPointF middle(image.width() / 2.0, image.height() / 2.0);
    paper.translate(middle.x(), middle.y());
    paper.rotate(kTurn);
    paper.scale(kDots, -kDots);
    paper.translate(-0.20, -0.235);
    image.fill(QColor(214, 206, 190));
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setTransform(paper);
    painter.fillRect(QRectF(0.01, 0.01, 0.38, 0.45), QColor(246, 243, 235));
    const auto ring = [&](const std::vector<Flat>& places) {
      QPolygonF line;
      for (const Flat p : places) line << QPointF(p.u, p.v);
      painter.drawPolygon(line);
    };
    painter.setPen(QPen(QColor(40, 40, 60), 0.0008));
    ring(corners);
    ring(square);
    painter.drawLine(QPointF(0.12, 0.10), QPointF(0.12, 0.36));
    painter.drawPolyline(QPolygonF({QPointF(0.115, 0.35), QPointF(0.12, 0.36), QPointF(0.125, 0.35)}));
    painter.resetTransform();
    QFont font = painter.font();
    font.setPixelSize(90);
    painter.setFont(font);
    const auto write = [&](Flat at, const QString& words) { painter.drawText(paper.map(QPointF(at.u, at.v)), words); };
    write({0.135, 0.24}, "FRONT 38");
    write({0.285, 0.10}, "10 cm");
  }
  Flat seen(Flat place) const {
    const QPointF p = paper.map(QPointF(place.u, place.v));
    return {p.x(), p.y()};
  }
};

TEST(StudioPaper, AScanIsDroppedScaledByItsSquareTurnedAndTraced) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  const PrintedPattern pattern;
  Folder folder;
  const fs::path file = folder.path / "scan.png";
  ASSERT_TRUE(pattern.image.save(QString::fromStdString(file.string())));
  w.open(file);
  ASSERT_EQ(w.count(), 1u) << w.main().said().toStdString();
  const auto scan = [&]() -> const Underlay& { return w.session().snapshot().document.underlays.begin()->second; };
  const auto there = [&](Flat paper) { return w.table().onScreen(scan().onTable(pattern.seen(paper))); };
  const auto type = [&](double cm) {
    auto* number = w.table().findChild<QFrame*>("drop_menu")->findChild<QDoubleSpinBox*>("drop_number");
    ASSERT_TRUE(number && number->isVisible());
    const auto offered = w.session().dropMenu()->number;
    EXPECT_EQ(number->value(), offered->value) << "how far apart these places are, not those before";
    number->setValue(cm);
    w.type(*number, Qt::Key_Return);
    w.rest();
  };
  w.key(Command::Trace);
  w.click(w.table(), there(pattern.square[0]));
  w.click(w.table(), there(pattern.square[1]));
  w.rest();
  w.keep("studio_trace_menu");
  type(10);
  ASSERT_EQ(w.count(), 2u) << w.main().said().toStdString();
  EXPECT_NEAR(scan().width, 0.40, 0.001);
  // The grain line stands upright.
  w.click(w.table(), there({0.12, 0.10}));
  w.click(w.table(), there({0.12, 0.36}));
  w.session().choose(2);
  w.rest();
  EXPECT_NEAR(scan().turn * 180 / std::numbers::pi, PrintedPattern::kTurn, 0.1);
  w.click(w.table(), there(pattern.square[1]));
  w.click(w.table(), there(pattern.square[2]));
  w.rest();
  type(10);
  ASSERT_EQ(w.count(), 4u) << w.main().said().toStdString();
  EXPECT_NEAR(scan().width, 0.40, 0.001);
  w.table().showAll();
  w.key(Command::Polygon);
  for (const Flat corner : pattern.corners) w.click(w.table(), there(corner));
  w.hover(w.table(), there({0.10, 0.30}));
  w.keep("studio_tracing");
  w.key(Command::Confirm);
  w.rest();
  const Piece* piece = w.session().snapshot().document.pieceNamed("polygon");
  ASSERT_TRUE(piece) << w.main().said().toStdString();
  ASSERT_EQ(piece->outline.edges.size(), pattern.corners.size());
  for (std::size_t i = 0; i < pattern.corners.size(); ++i)
    EXPECT_NEAR(piece->outline.edges[i].curve.length(),
                distance(pattern.corners[i], pattern.corners[(i + 1) % pattern.corners.size()]), 0.0005);
  w.key(Command::Select);
  w.table().showAll();
  w.keep("studio_trace");
  // The right button hides it and takes it out, beside the piece.
  const auto choose = [&](const Message& words) {
    w.drag(w.table(), {there({0.31, 0.30})}, {}, {}, Qt::RightButton);
    for (QMenu* menu : w.main().findChildren<QMenu*>("context"))
      for (QAction* action : menu->actions())
        if (withoutLetter(*action) == inWords(words)) action->trigger(), menu->close();
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    w.rest();
  };
  choose(say("Fainter"));
  EXPECT_NEAR(scan().strength, 0.3, 1e-9) << w.main().said().toStdString();
  choose(say("Take the scan out"));
  EXPECT_TRUE(w.session().snapshot().document.underlays.empty());
  w.session().command(Command::Undo);
  w.rest();
  ASSERT_EQ(w.session().snapshot().document.underlays.size(), 1u);
  choose(say("Hide the scan"));
  EXPECT_TRUE(scan().hidden);
  choose(say("Show the scan"));
  EXPECT_FALSE(scan().hidden) << "where it lies";
  // Where a piece lies over it, its menu is one of the piece's.
  w.drag(w.table(), {there({0.10, 0.20})}, {}, {}, Qt::RightButton);
  bool below = false;
  for (QMenu* menu : w.main().findChildren<QMenu*>("context")) {
    for (QAction* action : menu->actions())
      below |= action->menu() && withoutLetter(*action) == inWords(say("Scan “{0}”", say("scan")));
    menu->close();
  }
  EXPECT_TRUE(below);
  QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  // The next one lies beside all that is there.
  w.open(file);
  const Document& document = w.session().snapshot().document;
  ASSERT_EQ(document.underlays.size(), 2u) << w.main().said().toStdString();
  const auto reach = [](const Underlay& one) {
    const auto corners = {one.onTable({0, 0}), one.onTable({double(one.wide), 0}),
                          one.onTable({double(one.wide), double(one.high)}), one.onTable({0, double(one.high)})};
    return std::pair(std::min_element(corners.begin(), corners.end(), [](Flat a, Flat b) { return a.u < b.u; })->u,
                     std::max_element(corners.begin(), corners.end(), [](Flat a, Flat b) { return a.u < b.u; })->u);
  };
  EXPECT_LT(reach(document.underlays.at("scan_2")).second, reach(document.underlays.at("scan")).first);
}

}  // namespace
}  // namespace karinui::studio

// The board of fabrics in the real window: pictures, curves whose points are dragged, a fabric for one piece.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QDialog>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPainter>
#include <QTabBar>
#include <QTimer>
#include <QTreeWidget>

#include "fabric_plot.h"
#include "karinui/base/number.h"
#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// A check that does not meet in a seam is told in the list, until it is matched, and again once that is undone.
TEST(StudioFabric, TheListTellsWhereAPrintMisses) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line :
       {"piece name=left_half outline=\"M 0 0; hem L 300 0; middle L 300 400; top L 0 400; side L 0 0\"",
        "piece name=right_half outline=\"M 0 20; hem L 300 20; side L 300 420; top L 0 420; middle L 0 20\"",
        "sew name=centre a=left_half.middle b=right_half.middle",
        "look fabric=cotton print=check ink=203060 repeat=5cm"})
    w.session().perform(*parseOperation(line));
  w.rest();
  const auto seamInList = [&]() -> QTreeWidgetItem* {
    auto* tree = w.main().findChild<QTreeWidget*>();
    return tree->topLevelItemCount() > 0 ? tree->topLevelItem(tree->topLevelItemCount() - 1) : nullptr;
  };
  const auto told = [&] { return seamInList() ? seamInList()->toolTip(0).toStdString() : "no such seam"; };
  EXPECT_THAT(told(), HasSubstr("the print misses by up to")) << w.main().said().toStdString();
  EXPECT_EQ(QString::fromStdString(told()).count("entre"), 1) << told();
  w.keep("studio_print_misses");
  w.session().perform(*parseOperation("match seam=centre"));
  w.rest();
  EXPECT_THAT(told(), Not(HasSubstr("the print misses by up to"))) << w.main().said().toStdString();
  w.keep("studio_print_meets");
  w.key(Command::Undo);
  w.rest();
  EXPECT_THAT(told(), HasSubstr("the print misses by up to"));
}

// The button says which pieces it is about.
TEST(StudioFabric, WithNothingChosenAllPiecesAreCutAndTheButtonSaysSo) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(2);
  w.rest();
  EXPECT_TRUE(w.button("Cut all pieces from it").isEnabled());
  w.key(Command::SelectAll);
  w.rest();
  EXPECT_EQ(w.session().selection().pieces.size(), w.session().snapshot().document.pattern.pieces.size());
  EXPECT_TRUE(w.button("Cut the chosen pieces from it").isEnabled());
  w.key(Command::Cancel);
  w.rest();
  EXPECT_TRUE(w.session().selection().pieces.empty());
  EXPECT_TRUE(w.button("Cut all pieces from it").isEnabled());
}

TEST(StudioFabric, EveryClothOfTheShopHangsOnTheTester) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.rest();
  QListWidget* list = nullptr;
  for (QListWidget* one : w.main().findChildren<QListWidget*>())
    if (one->accessibleName() == "Fabrics") list = one;
  ASSERT_TRUE(list);
  const auto shown = [&](const std::string& name) {
    for (int row = 0; row < list->count(); ++row)
      if (list->item(row)->data(Qt::UserRole).toString().toStdString() == name) return list->item(row);
    return static_cast<QListWidgetItem*>(nullptr);
  };
  std::vector<QImage> seen;
  for (const Fabric& fabric : presets()) {
    SCOPED_TRACE(fabric.name);
    if (fabric.law == Fabric::Law::Simcloth) {  // of old documents
      EXPECT_FALSE(shown(fabric.name));
      continue;
    }
    ASSERT_TRUE(shown(fabric.name));
    const auto figure = drapeFigure(fabric);
    if (!figure) continue;
    EXPECT_THAT(shown(fabric.name)->text().toStdString(), HasSubstr(fixed(figure->coefficient, 0) + " %"));
    const QImage picture = shown(fabric.name)->icon().pixmap(64, 64).toImage();
    ASSERT_FALSE(picture.isNull());
    int cloth = 0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x)
        cloth += picture.pixelColor(x, y).blue() > picture.pixelColor(x, y).red() + 25;
    EXPECT_GT(cloth, picture.width() * picture.height() / 6);
    for (const QImage& other : seen) EXPECT_FALSE(picture == other);
    seen.push_back(picture);
  }
  EXPECT_GE(seen.size(), 10u);
}

// Whoever opens a garment of linen is shown linen, prints linen, and draws new pieces of it.
TEST(StudioFabric, TheBoardShowsWhatTheGarmentIsCutFrom) {
  KARINUI_NEEDS_DISPLAY();
  application();
  Folder folder;
  const fs::path file = folder.path / "linen.karinui";
  {
    Window maker;
    for (const char* line : {"rectangle name=front width=40cm height=50cm fabric=linen",
                             "rectangle name=back width=40cm height=50cm fabric=linen",
                             "rectangle name=lining width=40cm height=50cm fabric=viscose"})
      maker.session().perform(*parseOperation(line));
    maker.rest();
    maker.session().saveAs(file);
    maker.rest();
  }
  Window w;
  w.open(file);
  w.main().boards().setCurrentIndex(2);
  w.rest();
  auto* plot = w.main().findChild<FabricPlot*>();
  ASSERT_TRUE(plot);
  EXPECT_EQ(plot->fabric().name, "linen") << "what most of it is cut from";
  // Another that one looked up stays, whatever is done meanwhile.
  QListWidget* list = nullptr;
  for (QListWidget* one : w.main().findChildren<QListWidget*>())
    if (one->accessibleName() == "Fabrics") list = one;
  ASSERT_TRUE(list);
  for (int row = 0; row < list->count(); ++row)
    if (list->item(row)->data(Qt::UserRole).toString() == "denim") list->setCurrentRow(row);
  EXPECT_EQ(plot->fabric().name, "denim");
  w.session().perform(*parseOperation("remove piece=back"));
  w.rest();
  EXPECT_EQ(plot->fabric().name, "denim");
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("lining")->id};
  w.session().select(chosen);
  w.rest();
  EXPECT_EQ(plot->fabric().name, "viscose");
  w.key(Command::Rectangle);
  const QPointF from(20, 20);
  w.drag(w.table(), {from, from + QPointF(60, 60)});
  w.rest();
  EXPECT_THAT(w.last(), AllOf(StartsWith("rectangle"), HasSubstr("fabric=viscose"))) << w.main().said().toStdString();
  w.session().select({});
  w.drag(w.table(), {from, from + QPointF(40, 60)});
  w.rest();
  EXPECT_THAT(w.last(), StartsWith("rectangle"));
}

TEST(StudioFabric, ACurveIsDraggedAndKeptForOnePiece) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(2);
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("back")->id};
  w.session().select(chosen);
  w.rest();
  auto* plot = w.main().findChild<FabricPlot*>();
  ASSERT_TRUE(plot);
  ASSERT_EQ(plot->fabric().name, "cotton") << "what the chosen piece is cut from";
  const Fabric before = plot->fabric();
  ASSERT_EQ(plot->points().size(), 6u);
  const auto pull = [&](std::size_t point, QPointF by) {
    const QPointF from = plot->points()[point];
    w.drag(*plot, {from, from + by});
  };
  pull(1, {0, 12});  // along the grain softer
  EXPECT_LT(plot->fabric().stretchWarp, 0.9 * before.stretchWarp);
  EXPECT_EQ(plot->fabric().stretchWeft, before.stretchWeft);
  pull(5, {0, -10});  // across it stiffer the further it goes
  EXPECT_GT(plot->fabric().stiffenWeft, 1.1 * before.stiffenWeft);
  pull(0, {9, 0});
  EXPECT_GT(plot->fabric().toeWarp, before.toeWarp);
  w.main().findChild<QTabBar*>("law")->setCurrentIndex(1);
  ASSERT_EQ(plot->points().size(), 2u);
  pull(0, {0, -10});
  EXPECT_GT(plot->fabric().shear, before.shear);
  const Fabric wished = plot->fabric();
  w.keep("studio_fabric");
  const std::size_t steps = w.count();
  w.button("Only for the chosen pieces").click();
  w.rest();
  const Document& document = w.session().snapshot().document;
  ASSERT_GT(w.count(), steps) << w.main().said().toStdString();
  EXPECT_THAT(text(w.session().steps()[steps].operation),
              StartsWith("fabric name=cotton_2 piece=p4 like=cotton stretch_warp="));
  EXPECT_EQ(document.pieceNamed("back")->fabric, "cotton_2");
  EXPECT_EQ(document.pieceNamed("front")->fabric, "cotton");
  Fabric kept = document.fabrics.at("cotton_2");
  kept.name = wished.name;
  EXPECT_EQ(kept, wished) << "every number of the curves is in the step";
}

TEST(StudioFabric, AFabricIsMeasuredOnATable) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(2);
  w.rest();
  w.button("Measure a fabric…").click();
  auto* wizard = w.main().findChild<QDialog*>("fabric_wizard");
  ASSERT_TRUE(wizard);
  const auto* told = wizard->findChild<QLabel*>("measured");
  const auto add = [&]() -> QPushButton* {
    for (QPushButton* one : wizard->findChildren<QPushButton*>())
      if (one->text() == "Add this fabric") return one;
    return nullptr;
  };
  const auto type = [&](const char* where, const char* what) {
    for (QLineEdit* one : wizard->findChildren<QLineEdit*>())
      if (one->accessibleName() == where) return one->setText(what);
    ADD_FAILURE() << "nothing is called " << where;
  };
  EXPECT_THAT(told->text().toStdString(), HasSubstr("Weigh a swatch first"));
  type("Length of the swatch", "10 cm");  // millimetres, unless another unit is written
  type("Width of the swatch", "10,0cm 100 mm 100");
  type("Its mass", "1.9cm");
  EXPECT_THAT(told->text().toStdString(), HasSubstr("is no number")) << "of grams";
  type("Its mass", "1.9、1,9　２．０");  // as they come of a Japanese keyboard
  type("Scales", "0.1");
  type("Overhang, warp", "45.5 45.0 46.0");
  type("Overhang, weft", "42.6 a");
  EXPECT_THAT(told->text().toStdString(), HasSubstr("is no number"));
  type("Overhang, weft", "4.26cm");
  type("Or a disc's drape", "64");
  EXPECT_THAT(told->text().toStdString(), HasSubstr("by strips or by a disc"));
  type("Or a disc's drape", "");
  type("Between the marks", "200");
  type("Width of the strip", "25");
  type("Weight that hangs on it", "500");
  type("Then, warp", "204.6");
  EXPECT_FALSE(add()->isEnabled()) << "it has no name yet";
  type("Name of the fabric", "grandmother's linen");
  EXPECT_FALSE(add()->isEnabled());
  EXPECT_THAT(told->text().toStdString(), HasSubstr("has a space or a sign in it"));
  type("Name of the fabric", "old_linen");
  EXPECT_THAT(told->text().toStdString(), HasSubstr("Linen"));
  ASSERT_TRUE(add()->isEnabled()) << told->text().toStdString();
  const auto readings = [&](const char* length, const char* width, const char* mass, const char* weft) {
    type("Length of the swatch", length);
    type("Width of the swatch", width);
    type("Its mass", mass);
    type("Overhang, weft", weft);
  };
  readings("100", "100", "1.9 1.9 2.0", "42.6");  // as the guide shows them
  w.keepDialog(*wizard, "studio_measure_fabric");
  readings("10 cm", "10,0cm 100 mm 100", "1.9、1,9　２．０", "4.26cm");
  const std::size_t steps = w.count();
  w.click(*add(), add()->rect().center());
  w.rest();
  ASSERT_EQ(w.count(), steps + 1) << w.main().said().toStdString();
  EXPECT_THAT(w.last(), HasSubstr("like=linen weight=0.193 "));
  const Fabric& made = w.session().snapshot().document.fabrics.at("old_linen");
  EXPECT_NEAR(made.bendWarp, 2.2e-5, 0.1e-5);
  EXPECT_EQ(made.shear, preset("linen")->shear) << "what was not measured";
  EXPECT_EQ(w.main().findChild<FabricPlot*>()->fabric().name, made.name) << "and the board shows it";
}

// Of several photographs the one that is no good is named.
TEST(StudioFabric, ThePhotographInWhichNoClothIsSeenIsNamed) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  Folder folder;
  w.openTunic();
  w.main().boards().setCurrentIndex(2);
  w.rest();
  const auto photographed = [&](const char* name, int radius) {
    QImage photo(300, 300, QImage::Format_RGB32);
    photo.fill(QColor(230, 225, 210));
    if (radius > 0) {
      QPainter painter(&photo);
      painter.setBrush(QColor(90, 40, 70));
      painter.drawEllipse(QPointF(150, 150), radius, radius);
    }
    const QString path = QString::fromStdString((folder.path / name).string());
    EXPECT_TRUE(photo.save(path));
    return path;
  };
  const QString flat = photographed("flat.png", 100), good = photographed("first.png", 75),
                bad = photographed("second.png", 0);
  w.button("Measure a fabric…").click();
  auto* wizard = w.main().findChild<QDialog*>("fabric_wizard");
  ASSERT_TRUE(wizard);
  const auto read = [&](const QString& lying, const QStringList& hanging) {
    int asked = 0;
    QTimer answers;
    QObject::connect(&answers, &QTimer::timeout, [&] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (!dialog || asked > 1) return;
      QStringList names;
      for (const QString& one : asked++ == 0 ? QStringList{lying} : hanging) names += "\"" + one + "\"";
      dialog->findChild<QLineEdit*>("fileNameEdit")
          ->setText(names.size() == 1 ? QString(names[0]).remove('"') : names.join(' '));
      static_cast<QDialog*>(dialog)->accept();
    });
    answers.start(100);
    for (QPushButton* one : wizard->findChildren<QPushButton*>())
      if (one->text() == "From photographs…") one->click();
    return wizard->findChild<QLabel*>("measured")->text().toStdString();
  };
  EXPECT_THAT(read(flat, {good, bad}), HasSubstr("second.png: "));
  EXPECT_THAT(read(bad, {good}), HasSubstr("second.png: "));
}

TEST(StudioLook, ColourAndPrintAreChosenUndoneAndSeen) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.view(View::Front);
  const auto seen = [&] {
    w.rest();
    const QPointF at = w.inSpace("front", {0, 0.3});
    return w.space().grabFramebuffer().pixelColor((at * w.space().devicePixelRatioF()).toPoint());
  };
  const std::size_t before = w.count();
  const QColor plain = seen();
  w.main().boards().setCurrentIndex(0);
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("front")->id};
  w.session().select(chosen);
  w.rest();
  QWidget& board = *w.main().boards().currentWidget();
  auto* finish = board.findChild<QComboBox*>("look_finish");
  ASSERT_TRUE(finish);
  finish->setCurrentIndex(2);
  emit finish->activated(2);
  w.rest();
  EXPECT_EQ(w.last(), "look piece=p3 finish=denim");
  const QColor denim = seen();
  EXPECT_LT(denim.lightness(), plain.lightness() - 20) << "indigo";
  for (QLineEdit* box : board.findChildren<QLineEdit*>())
    if (box->accessibleName() == "Colour") {
      box->setFocus();
      box->setText("a02020");
      emit box->editingFinished();
    }
  w.rest();
  EXPECT_EQ(w.last(), "look piece=p3 colour=a02020");
  EXPECT_GT(seen().red(), seen().blue() + 40);
  auto* print = board.findChild<QComboBox*>("look_print");
  print->setCurrentIndex(1);
  emit print->activated(1);
  w.rest();
  EXPECT_EQ(w.last(), "look piece=p3 print=stripe");
  w.keep("studio_look");
  EXPECT_FALSE(w.session().busy().settling) << "colour disturbs no drape";
  for (int k = 0; k < 3; ++k) w.key(Command::Undo), w.rest();
  EXPECT_EQ(w.count(), before);
  EXPECT_NEAR(seen().blue(), plain.blue(), 3);
  // On the board of fabrics, for every piece that is cut from it.
  w.main().boards().setCurrentIndex(2);
  w.rest();
  finish = w.main().boards().currentWidget()->findChild<QComboBox*>("look_finish");
  finish->setCurrentIndex(8);
  emit finish->activated(8);
  w.rest();
  EXPECT_EQ(w.last(), "look fabric=cotton finish=velvet");
}

// The wrong side and the place of the print, typed as a person does; what is chosen again is no step.
TEST(StudioLook, TheWrongSideAndThePrintsPlaceAreTyped) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(0);
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("front")->id};
  w.session().select(chosen);
  w.rest();
  const std::size_t before = w.count();
  QWidget& board = *w.main().boards().currentWidget();
  const auto choose = [&](const char* name, int k) {
    auto* box = board.findChild<QComboBox*>(name);
    box->setCurrentIndex(k);
    emit box->activated(k);
    w.rest();
  };
  choose("look_print", 2);
  EXPECT_EQ(w.last(), "look piece=p3 print=check");
  choose("look_print", 2);
  choose("look_wrong_print", 0);
  choose("look_finish", board.findChild<QComboBox*>("look_finish")->currentIndex());
  EXPECT_EQ(w.count(), before + 1) << "nothing new was chosen";
  const auto type = [&](const char* name, const char* text) {
    for (QLineEdit* box : board.findChildren<QLineEdit*>())
      if (box->accessibleName() == name && box->isVisible()) {
        box->setFocus(), box->selectAll();
        QTest::keyClicks(box, text);
        QTest::keyClick(box, Qt::Key_Return);
        w.rest();
        return;
      }
    FAIL() << name;
  };
  type("Colour of the wrong side", "#3355aa");
  EXPECT_EQ(w.last(), "look piece=p3 wrong=3355aa");
  choose("look_wrong_print", 1);
  EXPECT_EQ(w.last(), "look piece=p3 wrong_print=stripe");
  for (LengthBox* box : board.findChildren<LengthBox*>())
    if (box->accessibleName() == "Print begins, across the grain") w.type(*box, "3"), w.rest();
  EXPECT_EQ(w.last(), "look piece=p3 shift=30mm,0");
  for (QLineEdit* box : board.findChildren<QLineEdit*>()) {
    if (!box->isVisible() || !box->text().startsWith('#')) continue;
    EXPECT_GE(box->width(), box->fontMetrics().horizontalAdvance("#888888") + 18)
        << box->accessibleName().toStdString();
  }
  for (int k = 0; k < 4; ++k) w.key(Command::Undo), w.rest();
  EXPECT_EQ(w.count(), before);
  EXPECT_EQ(w.session().snapshot().document.looks, Looks());
}

TEST(StudioLook, StripesLieOnTheTableAlongTheGrain) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.session().perform(*parseOperation("look piece=front print=stripe repeat=4cm colour=#2040a0 ink=#ffffff"));
  w.rest();
  const QImage table = w.table().grab().toImage();
  const auto at = [&](double u, double v) {
    return table.pixelColor((w.onTable("front", {u, v}) * table.devicePixelRatioF()).toPoint()).lightness();
  };
  for (const double v : {0.15, 0.25}) {
    for (const double stripe : {0.10, 0.14}) {  // beside the grain arrow; half a repeat of 4 cm away there is none
      EXPECT_GT(at(stripe, v), at(0.12, v) + 12);
      EXPECT_NEAR(at(stripe, v), at(stripe, v + 0.02), 4) << "along the grain";
    }
  }
}

TEST(StudioLook, PartsAreHiddenAndAllIsCutOpenByKey) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.view(View::Front);
  const QPointF hand = w.onSkin("left_arm:wrist@0");
  const auto skinAt = [&](QPointF at) {
    w.rest();
    const QColor c = w.space().grabFramebuffer().pixelColor((at * w.space().devicePixelRatioF()).toPoint());
    return c.red() - c.blue();
  };
  const int skin = skinAt(hand);
  w.key(Command::HideArms);
  w.rest();
  EXPECT_TRUE(w.main().action(Command::HideArms)->isChecked());
  EXPECT_NE(skinAt(hand), skin);
  w.keep("studio_hidden_arms");
  w.key(Command::HideHead);
  w.key(Command::Section);
  w.rest();
  w.keep("studio_section");
  EXPECT_TRUE(w.session().viewCut().section);
  w.key(Command::SectionBack);
  EXPECT_NEAR(w.session().viewCut().section->at, -0.01, 1e-9);
  for (int k = 0; k < 3; ++k) w.key(Command::Section);
  EXPECT_FALSE(w.session().viewCut().section);
  w.key(Command::HideArms), w.key(Command::HideHead);
  w.rest();
  EXPECT_FALSE(w.session().viewCut().any());
  EXPECT_NEAR(skinAt(hand), skin, 3);
}

}  // namespace
}  // namespace karinui::studio

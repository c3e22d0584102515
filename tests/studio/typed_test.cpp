// Numbers and words that are typed: what cannot be is refused with what can, and the value that holds is shown.
#include <gmock/gmock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QScrollArea>
#include <QScrollBar>
#include <QSettings>
#include <QSpinBox>
#include <QTest>
#include <QToolTip>

#include "export_dialog.h"
#include "make_up_dialog.h"
#include "step_dialog.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

QLineEdit& lineOf(LengthBox& box) { return *box.findChild<QLineEdit*>(); }

void chooseEdge(Window& w, const char* piece, const char* edge) {
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed(piece)->id};
  chosen.edge = EdgeNear{*chosen.pieces.begin(), edge, 0.5, 0};
  w.session().select(chosen);
  w.main().boards().setCurrentIndex(0);
  w.rest();
}

// At the waist alone, to nothing at hem and armhole; and a hem without what is sewn to it.
TEST(StudioTyped, ASeamIsTakenInWhereItIsPinned) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line : {"piece name=front outline=\"M 0 0; hem L 300 0; side L 300 400; top L 0 400; centre L 0 0\"",
                           "piece name=back outline=\"M 0 0; hem L 310 0; side L 310 400; top L 0 400; centre L 0 0\"",
                           "sew a=front.side b=back.side"})
    w.session().perform(*parseOperation(line));
  w.rest();
  const auto curve = [&](const char* piece) {
    const Outline& outline = w.session().snapshot().document.pieceNamed(piece)->outline;
    return outline.edges[*outline.find("side")].curve;
  };
  chooseEdge(w, "front", "side");
  auto& where = *w.main().findChild<QComboBox*>("take_in_where");
  auto& place = *w.main().findChild<LengthBox*>("take_in_place");
  auto& partners = *w.main().findChild<QComboBox*>("take_in_partners");
  EXPECT_FALSE(place.isVisible());
  where.setCurrentIndex(3);
  emit where.activated(3);
  EXPECT_TRUE(place.isVisible());
  EXPECT_NEAR(place.value(), 0.2, 1e-9) << "where it was clicked";
  w.type(w.box("Take in"), "1");
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("at=0.5")) << w.main().said().toStdString();
  EXPECT_EQ(curve("front").start, (Flat{0.3, 0}));
  EXPECT_NEAR(curve("front").atFraction(0.5).u, 0.29, 1e-6);
  EXPECT_NEAR(curve("back").atFraction(0.5).u, 0.30, 1e-6);
  partners.setCurrentIndex(1);
  where.setCurrentIndex(1);
  w.type(w.box("Take in"), "-1");
  w.rest();
  EXPECT_THAT(w.last(), AllOf(HasSubstr("at=0"), HasSubstr("partners=no")));
  EXPECT_NEAR(curve("front").start.u, 0.31, 1e-6);
  EXPECT_NEAR(curve("back").start.u, 0.31, 1e-6);
  // What this side takes the other gives.
  partners.setCurrentIndex(2);
  w.type(w.box("Take in"), "0.5");
  w.rest();
  EXPECT_THAT(w.last(), AllOf(HasSubstr("at=0"), HasSubstr("moves=yes"), testing::Not(HasSubstr("partners"))));
  EXPECT_NEAR(curve("front").start.u, 0.305, 1e-6);
  EXPECT_NEAR(curve("back").start.u, 0.315, 1e-6);
  // What is typed for a length is given to the other side of the seam, too.
  auto& both = *w.main().findChild<QCheckBox*>("length_partners");
  ASSERT_TRUE(both.isEnabled());
  both.setChecked(true);
  w.type(w.box("Length"), "42");
  w.rest();
  EXPECT_THAT(w.last(), HasSubstr("partners=yes"));
  EXPECT_NEAR(curve("front").length(), 0.42, 1e-6);
  EXPECT_GT(curve("back").length(), 0.41);
  chooseEdge(w, "front", "hem");
  EXPECT_FALSE(both.isEnabled()) << "it is sewn to nothing";
  EXPECT_EQ(where.currentIndex(), 0) << "another edge, as a whole";
  EXPECT_EQ(partners.currentIndex(), 0);
  chooseEdge(w, "front", "side");
  EXPECT_FALSE(both.isChecked());
}

// What is chosen next is asked for its first numbers; an edge after an edge for the same number.
TEST(StudioTyped, TheBoardBeginsAboveForAnotherKindOfThing) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().resize(1200, 700);
  chooseEdge(w, "front", "hem_left");
  QScrollBar& bar = *w.main().findChild<QScrollArea*>("garment_numbers")->verticalScrollBar();
  ASSERT_GT(bar.maximum(), 100);
  bar.setValue(100);
  chooseEdge(w, "front", "side_left");
  EXPECT_EQ(bar.value(), 100);
  Selection piece;
  piece.pieces = {w.session().snapshot().document.pieceNamed("back")->id};
  w.session().select(piece);
  w.rest();
  EXPECT_EQ(bar.value(), 0);
}

TEST(StudioTyped, AMeasureIsTypedWhereverOneClicks) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(1);
  w.rest();
  LengthBox& box = w.box("Waist girth");
  QLineEdit& line = lineOf(box);
  ASSERT_EQ(line.text().toStdString(), "");
  EXPECT_THAT(line.placeholderText().toStdString(), HasSubstr("cm")) << "what the size has";
  box.setFocus(Qt::MouseFocusReason);
  for (int k = 0; k < 2; ++k) {
    QTest::mouseClick(&line, Qt::LeftButton, {}, line.rect().center());
    QApplication::processEvents();
  }
  QTest::keyClicks(&line, "75");
  EXPECT_EQ(line.text(), "75");
  w.type(box, Qt::Key_Return);
  w.rest();
  EXPECT_NEAR(box.value(), 0.75, 1e-9) << box.text().toStdString();
  EXPECT_NEAR(w.session().snapshot().body->measured().value.at("waist_girth"), 0.75, 0.004)
      << w.main().said().toStdString();
  w.type(box, "");
  w.rest();
  EXPECT_EQ(box.value(), 0) << "and taken away again";
  EXPECT_EQ(line.text().toStdString(), "");
  EXPECT_TRUE(w.session().figure()->set.empty());
}

// 94 × 0.01 is not 0.94.
TEST(StudioTyped, ALengthIsRecordedAsItWasTyped) {
  for (const int centimetres : {7, 29, 57, 94, 115}) {
    const auto metres = metresIn(QString::number(centimetres));
    ASSERT_TRUE(metres);
    EXPECT_EQ(*metres, centimetres / 100.0) << centimetres;
  }
}

TEST(StudioTyped, InchesInFractions) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* typed : {"27 1/2in", "27-1/2\"", "27½\"", "2' 3 1/2\""})
    EXPECT_DOUBLE_EQ(metresIn(QString::fromUtf8(typed)).value_or(0), 27.5 * 0.0254) << typed;
  EXPECT_FALSE(metresIn("27 1/2")) << "of centimetres";
  EXPECT_FALSE(metresIn("waist_girth/2")) << "a formula";
  Theme::here().setInches(true);
  EXPECT_DOUBLE_EQ(metresIn("27 1/2").value_or(0), 27.5 * 0.0254);
  EXPECT_DOUBLE_EQ(metresIn("1/2").value_or(0), 0.5 * 0.0254);
  EXPECT_FALSE(metresIn("waist_girth/2"));
  Theme::here().setInches(false);
}

TEST(StudioTyped, WhatCannotBeIsRefusedWithWhatCanAndTheOldNumberStays) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const std::size_t before = w.count();
  w.main().boards().setCurrentIndex(1);
  w.rest();
  LengthBox& bust = w.box("Bust girth");
  const QString was = bust.text();
  w.type(bust, "900");
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), AllOf(HasSubstr("Bust girth"), HasSubstr("900.00 cm")));
  w.type(bust, "2000");
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), AllOf(HasSubstr("Bust girth"), HasSubstr("2000.00 cm")));
  EXPECT_THAT(w.main().said().toStdString(), Not(AnyOf(HasSubstr("between 0.00 cm"), HasSubstr("1000.00 cm"))));
  EXPECT_EQ(bust.text(), was);
  chooseEdge(w, "front", "hem_left");
  auto& elastic = *w.main().findChild<LengthBox*>("edge_elastic");
  const QString none = elastic.text();
  w.type(elastic, "-5");
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("0.00 cm"));
  EXPECT_EQ(elastic.text(), none);
  w.type(elastic, "abc");
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("“abc”"));
  EXPECT_EQ(elastic.text(), none);
  w.type(elastic, "500");  // it can be as long, but not along this edge
  w.rest();
  EXPECT_EQ(elastic.text(), none) << w.main().said().toStdString();
  EXPECT_EQ(w.count(), before);
  auto* colour = w.main().findChild<QLineEdit*>("look_colour");
  ASSERT_TRUE(colour);
  const QString dye = colour->text();
  colour->setText("zzz");
  w.type(*colour, Qt::Key_Return);
  w.rest();
  EXPECT_EQ(colour->text(), dye);
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("“zzz”"));
}

TEST(StudioTyped, ADialogsNumberIsRefusedAtItsBox) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  ExportDialog dialog(w.session(), w.space(), &w.main());
  dialog.show();
  LengthBox* box = dialog.findChild<LengthBox*>();
  const double was = box->value();
  w.type(*box, "99");
  EXPECT_EQ(box->value(), was);
  EXPECT_THAT(QToolTip::text().toStdString(), HasSubstr("10.00 cm"));
  QToolTip::hideText();
}

TEST(StudioTyped, WhatABlockCannotHaveIsSaidWhileItIsTyped) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  DraftBlock skirt;  // nothing is worn there
  skirt.kind = DraftBlock::Kind::Skirt;
  auto* dialog = new StepDialog(w.session(), skirt, &w.main());
  const auto check = [](QDialog& one) {
    auto& ease = *one.findChild<QLineEdit*>("ease");
    auto& make = *one.findChild<QPushButton*>("make");
    ease.setText("-50");
    EXPECT_FALSE(make.isEnabled());
    EXPECT_THAT(one.findChild<QLabel*>("said")->text().toStdString(), HasSubstr("-30.00 cm"));
    ease.setText("5");
    EXPECT_TRUE(make.isEnabled());
    EXPECT_EQ(one.findChild<QLabel*>("said")->text(), "");
  };
  check(*dialog);
  dialog->reject();
  w.main().showStart();
  w.rest();
  w.button("Start from a block…").click();
  auto* fresh = w.main().findChild<QDialog*>("block_dialog");
  ASSERT_TRUE(fresh);
  check(*fresh);
  fresh->reject();
}

TEST(StudioTyped, WhatIsChosenForTheWindowIsKeptAtOnce) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  const auto kept = [](const char* key) { return QSettings().value(key).toString().toStdString(); };
  for (const char* key : {"dark", "inches", "language"}) QSettings().remove(key);
  for (const auto& [action, key] : {std::pair{"dark", "dark"}, {"inches", "inches"}}) {
    w.main().findChild<QAction*>(action)->trigger();
    EXPECT_EQ(kept(key), "true") << key;
    w.main().findChild<QAction*>(action)->trigger();
    EXPECT_EQ(kept(key), "false") << key;
    EXPECT_FALSE(QSettings().contains("language")) << "that of the desktop is followed on";
  }
  w.main().findChild<QAction*>("japanese")->trigger();
  EXPECT_EQ(kept("language"), "ja");
  w.main().findChild<QAction*>("english")->trigger();
  EXPECT_EQ(kept("language"), "en");
}

TEST(StudioTyped, ANameIsNeverReadAsHtml) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  QMessageBox box(QMessageBox::Question, "Karinui", "<b>x</b>", QMessageBox::Ok, &w.main());
  box.show();
  box.ensurePolished();
  const auto* label = box.findChild<QLabel*>("qt_msgbox_label");
  ASSERT_TRUE(label);
  EXPECT_EQ(label->textFormat(), Qt::PlainText);
  QLabel own("<b>x</b>", &w.main());
  own.ensurePolished();
  EXPECT_EQ(own.textFormat(), Qt::PlainText);
}

double luminance(QRgb c) {
  const auto linear = [](int v) {
    const double x = v / 255.0;
    return x <= 0.03928 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(qRed(c)) + 0.7152 * linear(qGreen(c)) + 0.0722 * linear(qBlue(c));
}

// WCAG 2.2, 1.4.11: what shows a control stands out 3:1.
TEST(StudioTyped, AnEmptyTickBoxIsSeenOnAnyGround) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const bool dark : {false, true}) {
    Theme::here().setDark(dark);
    QCheckBox box;
    box.resize(30, 30);
    const QImage picture = box.grab().toImage();
    const double ground = luminance(picture.pixel(28, 2));
    double most = 1;
    for (int x = 0; x < picture.width(); ++x) {
      const double here = luminance(picture.pixel(x, picture.height() / 2));
      most = std::max(most, (std::max(here, ground) + 0.05) / (std::min(here, ground) + 0.05));
    }
    EXPECT_GE(most, 3) << (dark ? "dark" : "light");
  }
  Theme::here().setDark(false);
}

TEST(StudioTyped, TheKeysAreSeenWhereTheyAre) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.main().showStart();
  w.main().activateWindow();
  w.rest();
  while (!w.main().isActiveWindow()) QApplication::processEvents(QEventLoop::AllEvents, 20);
  QPushButton& fresh = w.button("New garment…");
  QPushButton& open = w.button("Open…");
  for (QPushButton* one : {&fresh, &open}) {
    w.main().findChild<QWidget*>("start")->setFocus();
    const QImage before = one->grab().toImage();
    one->setFocus(Qt::TabFocusReason);
    EXPECT_NE(one->grab().toImage(), before) << one->text().toStdString();
  }
}

TEST(StudioTyped, NothingIsMadeUpOfNothing) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.main().newGarment("eu38", {});
  w.rest();
  auto* makeUp = w.main().findChild<QAction*>("make_up");
  ASSERT_TRUE(makeUp);
  makeUp->trigger();
  w.rest();
  EXPECT_FALSE(w.main().findChild<MakeUpDialog*>());
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("no piece"));
}

TEST(StudioTyped, WhereAPrintBeginsIsAskedOfAPieceAlone) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  SetLook look;
  look.fabric = w.session().snapshot().document.pieceNamed("front")->fabric;
  look.print = PrintKind::Stripe;
  w.session().perform(look);
  w.main().boards().setCurrentIndex(2);
  w.rest();
  std::size_t seen = 0;
  for (QLabel* label : w.main().boards().currentWidget()->findChildren<QLabel*>())
    if (label->text() == "Print begins at") seen += label->isVisible();
  EXPECT_EQ(seen, 0u);
}

// A photograph has its own colours: no ink is asked for.
TEST(StudioTyped, TheColourOfAPrintIsAskedOfStripesAndNotOfAPhotograph) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  Folder folder;
  w.openTunic();
  SetLook look;
  look.fabric = w.session().snapshot().document.pieceNamed("front")->fabric;
  look.print = PrintKind::Stripe;
  w.session().perform(look);
  w.main().boards().setCurrentIndex(2);
  w.rest();
  const auto asked = [&] {
    std::size_t seen = 0;
    for (QLabel* label : w.main().boards().currentWidget()->findChildren<QLabel*>())
      if (label->text() == "Colour of the print") seen += label->isVisible();
    return seen;
  };
  EXPECT_EQ(asked(), 1u);
  QImage photo(40, 40, QImage::Format_RGB32);
  photo.fill(Qt::darkGreen);
  const QString file = QString::fromStdString((folder.path / "rose.png").string());
  ASSERT_TRUE(photo.save(file));
  w.session().importPrint(file.toStdString(), look);
  w.rest();
  EXPECT_EQ(asked(), 0u) << w.main().said().toStdString();
}

// A box that has the keys claims Ctrl+Z; where nothing is half typed in it, it takes back the step.
TEST(StudioTyped, CtrlZTakesBackTheStepAlsoWhereABoxHasTheKeys) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
  SetLook look;
  look.fabric = w.session().snapshot().document.pieceNamed("front")->fabric;
  look.print = PrintKind::Stripe;
  w.session().perform(look);
  w.main().boards().setCurrentIndex(2);
  w.rest();
  QDoubleSpinBox* angle = nullptr;
  for (auto* box : w.main().boards().currentWidget()->findChildren<QDoubleSpinBox*>())
    if (box->accessibleName() == "Angle to the grain") angle = box;
  ASSERT_TRUE(angle);
  const std::size_t before = w.count();
  for (const char* typed : {"45", "30.0"}) {  // what is shown may be just what was typed
    angle->setFocus();
    angle->selectAll();
    QTest::keyClicks(angle, typed);
    QTest::keyClick(angle, Qt::Key_Z, Qt::ControlModifier);
    w.rest();
    EXPECT_EQ(w.count(), before) << "what is half typed is taken back by itself";
    EXPECT_EQ(angle->value(), 0);
    angle->selectAll();
    QTest::keyClicks(angle, typed);
    QTest::keyClick(angle, Qt::Key_Return);
    w.rest();
    ASSERT_EQ(w.count(), before + 1) << w.main().said().toStdString();
    ASSERT_TRUE(angle->hasFocus());
    QTest::keyClick(angle, Qt::Key_Z, Qt::ControlModifier);
    w.rest();
    EXPECT_EQ(w.count(), before) << typed;
    EXPECT_EQ(angle->value(), 0);
  }
}

// A piece is clicked, named, and looked at from behind.
TEST(StudioTyped, ANameThatIsGivenLeavesTheKeysToTheFitting) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
  Selection chosen;
  chosen.pieces = {w.session().snapshot().document.pieceNamed("front")->id};
  w.session().select(chosen);
  w.main().boards().setCurrentIndex(0);
  w.rest();
  QLineEdit* name = nullptr;
  for (QLineEdit* one : w.main().findChildren<QLineEdit*>())
    if (one->isVisible() && one->text() == "front") name = one;
  ASSERT_TRUE(name);
  const std::size_t before = w.count();
  name->setFocus(Qt::MouseFocusReason);
  name->selectAll();
  QTest::keyClicks(name, "panel");
  QTest::keyClick(name, Qt::Key_Return);
  w.rest();
  EXPECT_EQ(w.main().focusWidget(), &w.space());
  QTest::keyClick(w.main().focusWidget(), Qt::Key_3);
  w.rest();
  EXPECT_EQ(w.count(), before + 1) << w.main().said().toStdString();
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("panel"));
  EXPECT_EQ(name->text(), "panel");
  // A number too.
  auto* layer = w.main().findChild<QSpinBox*>("piece_layer");
  ASSERT_TRUE(layer);
  layer->setFocus(Qt::MouseFocusReason);
  layer->selectAll();
  QTest::keyClicks(layer, "2");
  QTest::keyClick(layer, Qt::Key_Return);
  w.rest();
  EXPECT_EQ(w.main().focusWidget(), &w.space());
  EXPECT_EQ(w.session().snapshot().document.pieceNamed("panel")->layer, 2);
  std::size_t layers = 0;
  for (const Step& step : w.session().steps()) layers += text(step.operation).starts_with("layer");
  EXPECT_EQ(layers, 1u);
}

// A name is given and Return pressed: the next key goes into no other box.
TEST(StudioTyped, AfterAnEdgeIsNamedItsBoxHasTheKeysStill) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&w.main()));
  chooseEdge(w, "front", "shoulder_left");
  QLineEdit* name = nullptr;
  for (QLineEdit* one : w.main().findChildren<QLineEdit*>())
    if (one->isVisible() && one->text() == "left shoulder") name = one;
  ASSERT_TRUE(name);
  name->setFocus();
  name->selectAll();
  QTest::keyClicks(name, "seam A");
  QTest::keyClick(name, Qt::Key_Return);
  w.rest();
  ASSERT_TRUE(w.session().selection().edge) << w.main().said().toStdString();
  EXPECT_EQ(w.session().selection().edge->edge, "seam_A");
  EXPECT_EQ(w.main().focusWidget(), name);
  // An edge that is no longer there leaves the keys to the list.
  w.session().select({});
  w.rest();
  EXPECT_FALSE(qobject_cast<QLineEdit*>(w.main().focusWidget()));
}

// What is asked beside two places of a scan is typed at once, in any unit; no digit turns the fitting meanwhile.
TEST(StudioTyped, ANumberAskedAtTheDropIsTypedAtOnceAndInAnyUnit) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  Folder folder;
  QImage sheet(600, 400, QImage::Format_RGB32);
  sheet.fill(Qt::white);
  const fs::path file = folder.path / "scan.png";
  ASSERT_TRUE(sheet.save(QString::fromStdString(file.string())));
  w.open(file);
  ASSERT_EQ(w.count(), 1u) << w.main().said().toStdString();
  const auto scan = [&]() -> const Underlay& { return w.session().snapshot().document.underlays.begin()->second; };
  const auto strike = [&](const QString& keys) {
    for (const QChar key : keys) QTest::keyClick(w.main().focusWidget(), key.toLatin1());
    QTest::keyClick(w.main().focusWidget(), Qt::Key_Return);
    w.rest();
  };
  const auto apart = [&] {  // as wide as the scan, but for a tenth at either side
    for (const double at : {60.0, 540.0}) w.click(w.table(), w.table().onScreen(scan().onTable({at, 200})));
    w.rest();
    ASSERT_TRUE(w.session().dropMenu());
    w.table().setFocus();
  };
  w.key(Command::Trace);
  const auto looks = [&] { return *w.space().onScreen({0.3, 1, 0.2}); };
  const QPointF before = looks();
  for (const auto& [keys, metres] :
       {std::pair("100", 1.0), std::pair("200mm", 0.2), std::pair("8in", 0.2032), std::pair("12,5", 0.125)}) {
    apart();
    strike(keys);
    EXPECT_NEAR(scan().width, metres * 600 / 480, 2e-3 * metres) << keys << ": " << w.main().said().toStdString();
    EXPECT_FALSE(w.session().dropMenu());
  }
  EXPECT_EQ(looks(), before);
  // What cannot be is told, and may be typed anew.
  const std::size_t steps = w.count();
  apart();
  strike("2o");
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("is no length"));
  strike("20m");
  EXPECT_THAT(w.main().said().toStdString(), AllOf(HasSubstr("between"), HasSubstr("2000.00 cm")));
  EXPECT_EQ(w.count(), steps);
  ASSERT_TRUE(w.session().dropMenu());
  strike("30");
  EXPECT_EQ(w.count(), steps + 1);
  EXPECT_NEAR(scan().width, 0.3 * 600 / 480, 1e-3);
}

// Steps and drapes come to an end while one types; what is half typed is not written over by what holds.
TEST(StudioTyped, WhatIsHalfTypedStaysWhileStepsEnd) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  chooseEdge(w, "front", "shoulder_left");
  const auto step = [&] {
    w.session().perform(*parseOperation("layer piece=back layer=" + std::to_string(w.count() % 2 + 1)));
    w.rest();
  };
  LengthBox& box = w.box("Length");
  box.setFocus();
  box.selectAll();
  QTest::keyClicks(&box, "1");
  const std::size_t before = w.count();
  step();
  ASSERT_GT(w.count(), before) << w.main().said().toStdString();
  EXPECT_EQ(lineOf(box).text(), "1");
  QTest::keyClicks(&box, "5");
  w.type(box, Qt::Key_Return);
  w.rest();
  const auto shoulder = [&] {
    return findEdge(*w.session().snapshot().document.pieceNamed("front"), "shoulder_left")->curve.length();
  };
  EXPECT_NEAR(shoulder(), 0.15, 1e-4) << w.main().said().toStdString();
  // Once it was entered the box shows what holds, though it has the keys still.
  w.key(Command::Undo);
  w.rest();
  EXPECT_GT(std::abs(shoulder() - 0.15), 1e-3);
  EXPECT_NEAR(box.value(), shoulder(), 1e-6);
  EXPECT_EQ(lineOf(box).text(), lengthText(shoulder(), 2));
  // A name too, and Return gives it.
  QLineEdit* name = nullptr;
  for (QLineEdit* one : w.main().findChildren<QLineEdit*>())
    if (one->isVisible() && one->text() == "front") name = one;
  if (!name) {
    Selection piece;
    piece.pieces = {w.session().snapshot().document.pieceNamed("front")->id};
    w.session().select(piece);
    w.rest();
    for (QLineEdit* one : w.main().findChildren<QLineEdit*>())
      if (one->isVisible() && one->text() == "front") name = one;
  }
  ASSERT_TRUE(name);
  name->setFocus();
  name->selectAll();
  QTest::keyClicks(name, "bod");
  step();
  EXPECT_EQ(name->text(), "bod");
  QTest::keyClicks(name, "ice");
  w.type(*name, Qt::Key_Return);
  w.rest();
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("bodice")) << w.main().said().toStdString();
}

// What is typed for an edge whose piece has a symmetric copy is done there too, and is said so.
TEST(StudioTyped, TheSymmetricCopyIsSaidToChangeToo) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  const char* const kOnly = "Only this edge changes.";
  const auto says = [&](const char* words) {
    const auto all = w.main().findChildren<QLabel*>();
    return std::any_of(all.begin(), all.end(),
                       [&](const QLabel* one) { return one->isVisible() && one->text() == words; });
  };
  w.session().perform(*parseOperation(
      "piece name=front_left outline=\"M 0 0; hem L 300 0; side L 320 400; top L 0 400; centre L 0 0\""));
  w.rest();
  chooseEdge(w, "front_left", "hem");
  EXPECT_TRUE(says(kOnly));
  w.session().perform(*parseOperation("mirror piece=front_left"));
  w.rest();
  chooseEdge(w, "front_left", "hem");
  EXPECT_TRUE(says("This edge changes, and that of the symmetric copy."));
  w.type(w.box("Length"), "33");
  w.rest();
  EXPECT_NEAR(findEdge(*w.session().snapshot().document.pieceNamed("front_right"), "hem")->curve.length(), 0.33, 1e-6);
}

}  // namespace
}  // namespace karinui::studio

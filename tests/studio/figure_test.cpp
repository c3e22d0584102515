// The board of the figure in the real window: turned, let go, taken back.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <QStyleOptionFrame>
#include <fstream>
#include <set>

#include "studio/window.h"

namespace karinui::studio {
namespace {

using Look = std::pair<std::string, std::string>;  // a figure and how the cloth stands

QSlider* sliderOf(Window& w, const char* name) {
  for (QSlider* one : w.main().findChildren<QSlider*>())
    if (one->accessibleName() == name) return one;
  return nullptr;
}

// A board without a figure offers a size; who types measures there means their own.
TEST(StudioFigure, IsMadeOfWhatWasTypedAndGoesOnWithoutItsSize) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.main().boards().setCurrentIndex(1);
  w.rest();
  w.type(w.box("Body height"), "165");
  w.rest();
  ASSERT_EQ(w.count(), 1u) << w.main().said().toStdString();
  EXPECT_EQ(w.last().find("size="), std::string::npos) << w.last();
  w.session().perform(*parseOperation("body size=eu42"));
  w.rest();
  const auto hip = [&] { return w.session().snapshot().body->measured().value.at("hip_girth"); };
  const double before = hip();
  QComboBox* sizes = nullptr;
  for (QComboBox* box : w.main().findChildren<QComboBox*>())
    if (box->itemText(0) == "by measurements only") sizes = box;
  ASSERT_TRUE(sizes);
  sizes->setCurrentIndex(0);
  emit sizes->activated(0);
  w.rest();
  EXPECT_EQ(w.last().find("size="), std::string::npos) << w.last() << " " << w.main().said().toStdString();
  EXPECT_NEAR(hip(), before, 0.005);
}

// A draft is called anew when its figure is no longer a size; the board of measures stays before the hand.
TEST(StudioFigure, TheBoardStaysWhereMeasuresAreTyped) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  for (const char* line : {"body size=eu38", "set spacing=30mm", "block kind=skirt"})
    w.session().perform(*parseOperation(line)), w.rest();
  const fs::path before = w.session().path();
  w.main().boards().setCurrentIndex(1);
  w.rest();
  w.type(w.box("Waist girth"), "79");
  w.rest();
  EXPECT_NE(w.session().path(), before) << "it is made to measure now";
  EXPECT_EQ(w.main().boards().currentIndex(), 1);
}

TEST(StudioFigure, FollowsASliderAndTheGarmentIsMadeAgain) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(1);
  w.rest();
  const std::size_t steps = w.count();
  const auto bust = [](const GarmentSnapshot& f) { return f.body->measured().value.at("bust_girth"); };
  const auto chest = [&] { return w.session().snapshot().document.pieceNamed("front")->outline.area(); };
  const double girth = bust(w.session().snapshot()), area = chest();
  QSlider* slider = sliderOf(w, "Bust girth");
  ASSERT_TRUE(slider);
  const QPointF knob = knobOf(*slider);
  w.drag(*slider, {knob, knob + QPointF(slider->width() * 0.12, 0)}, {}, [&] {
    w.session().finish();
    w.keep("studio_figure");
    EXPECT_GT(bust(w.session().shown()), girth + 0.02) << "the figure is seen at once";
    EXPECT_EQ(w.count(), steps);
    EXPECT_EQ(bust(w.session().snapshot()), girth) << "nothing is done before it is let go";
  });
  w.rest();
  EXPECT_EQ(w.count(), steps) << w.main().said().toStdString();
  EXPECT_GT(bust(w.session().snapshot()), girth + 0.02);
  EXPECT_GT(chest(), 1.01 * area) << "the garment was drawn anew on it";
  EXPECT_TRUE(w.session().snapshot().document.drape.last->settled) << "and hangs";
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(bust(w.session().snapshot()), girth);
  EXPECT_EQ(chest(), area);
  EXPECT_EQ(w.box("Bust girth").text().toStdString(), "") << "the board says what is worn";
  EXPECT_EQ(w.box("Bust girth").findChild<QLineEdit*>()->placeholderText(), lengthText(girth))
      << "and what follows from the size";
}

// While every step is played again for another figure the garment stays in sight, whole; the figure it came from is
// come back to without a drape.
TEST(StudioFigure, TheGarmentIsInSightWhileItIsMadeAgain) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(1);
  w.rest();
  const std::string stood = drapeHash(w.session().snapshot().document);
  const SetBody former = *w.session().figure();
  std::set<Look> looks;
  int dimmed = 0, bright = 0;
  QString doing;
  const auto grey = [&] {  // of the picture's middle: the cloth of the chest
    const QImage all = w.space().grabFramebuffer();
    if (const char* folder = std::getenv("KARINUI_PICTURES"))
      all.save(QString(folder) + (w.session().busy().past ? "/studio_dimmed.png" : "/studio_bright.png"));
    const QImage chest = all.copy(all.width() / 2 - 20, all.height() / 3 - 20, 40, 40);
    double colour = 0;
    for (int y = 0; y < chest.height(); ++y)
      for (int x = 0; x < chest.width(); ++x) colour += chest.pixelColor(x, y).hslSaturationF();
    return colour / (chest.width() * chest.height());
  };
  const double before = grey();
  const auto look = [&] {
    (w.session().busy().past ? dimmed : bright) += 1;
    const GarmentSnapshot& shown = w.session().shown();
    std::size_t points = 0;
    for (const SceneCloth& cloth : shown.frame.cloths) points += cloth.mesh.points.size();
    EXPECT_EQ(shown.worn.size(), 2u);
    EXPECT_GT(points, 100u);
    EXPECT_TRUE(shown.body);
    looks.insert({shown.body->hash(), drapeHash(shown.document)});
  };
  const auto a = QObject::connect(&w.space(), &SpaceView::painted, look);
  // The line at the foot is written where the window takes in what has changed, not with the picture.
  const auto told = QObject::connect(&w.main(), &MainWindow::refreshed, [&] {
    if (w.session().busy().past) doing += w.main().findChild<QLabel*>("hint")->text() + "\n";
  });
  w.type(w.box("Bust girth"), "92");
  EXPECT_TRUE(w.session().busy().any);
  ASSERT_TRUE(w.session().busy().past);
  const double dim = grey();
  ASSERT_TRUE(w.session().busy().past) << "still";
  EXPECT_LT(dim, 0.7 * before) << "its colours are dimmed";
  w.rest();
  EXPECT_GT(dimmed, 0) << "the garment as it was";
  EXPECT_GT(bright, 0) << "and then the new one";
  EXPECT_FALSE(w.session().busy().past);
  EXPECT_THAT(doing.toStdString(), testing::HasSubstr("The garment as it was; the new one is on its way"));
  EXPECT_NE(drapeHash(w.session().snapshot().document), stood);
  EXPECT_GE(looks.size(), 3u) << "before, on its way and after";
  QObject::disconnect(told);

  looks.clear();
  const std::uint64_t predicted = w.session().changes().predicted;
  w.session().applyFigure(former);
  w.rest();
  QObject::disconnect(a);
  EXPECT_EQ(drapeHash(w.session().snapshot().document), stood);
  EXPECT_EQ(w.session().changes().predicted, predicted) << "nothing had to be draped";
}

// A measure is turned by its slider, whatever the longest name: it took what the boxes left, which was a stub.
TEST(StudioFigure, TheSlidersHaveRoomInTheBoard) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().resize(1000, 620);
  w.main().boards().setCurrentIndex(1);
  for (const Language language : {Language::English, Language::Japanese}) {
    Theme::here().setLanguage(language);
    w.rest();
    const auto* board = qobject_cast<QScrollArea*>(w.main().boards().currentWidget());
    ASSERT_TRUE(board);
    for (const QScrollArea* area : w.main().boards().findChildren<QScrollArea*>())
      if (area == board || board->isAncestorOf(area)) {
        EXPECT_EQ(area->horizontalScrollBar()->maximum(), 0)
            << "lacks room for " << area->widget()->minimumSizeHint().width() << " in " << area->viewport()->width();
      }
    std::size_t seen = 0;
    for (const QSlider* slider : board->findChildren<QSlider*>()) {
      if (!slider->isVisible()) continue;
      ++seen;
      EXPECT_GE(slider->width(), 6 * slider->fontMetrics().horizontalAdvance("0"))
          << slider->accessibleName().toStdString();
    }
    EXPECT_GT(seen, 5u);
    for (const auto* box : board->findChildren<QDoubleSpinBox*>())
      if (box->isVisible()) {
        EXPECT_GT(box->width(), box->fontMetrics().horizontalAdvance("188.88 cm") + 16);
        QStyleOptionFrame option;
        auto* line = box->findChild<QLineEdit*>();
        option.initFrom(line);
        const int room = line->style()->subElementRect(QStyle::SE_LineEditContents, &option, line).width();
        constexpr int kMargins = 4, kCursor = 1;  // QLineEdit's own
        const QFontMetrics letters = line->fontMetrics();
        EXPECT_GE(room, letters.horizontalAdvance("199.00 cm") + kMargins + kCursor);
        const int bearing = std::max(0, -letters.minLeftBearing());  // what is greyed is told beside it
        EXPECT_GE(room, letters.horizontalAdvance("199.0 cm") + kMargins + bearing);
      }
  }
  Theme::here().setLanguage(Language::English);
}

// An imported body is as it is: sliders do not put another in its place, and its own measures are told.
TEST(StudioFigure, AnImportedBodyStaysUntilAMannequinIsAskedFor) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(1);
  w.rest();
  Folder folder;
  const fs::path file = folder.path / "client.obj";
  {
    std::ofstream out(file);
    const TriangleMesh& mesh = w.session().snapshot().body->mesh();
    for (const Vec3 p : mesh.points) out << "v " << 1.08 * p.x << ' ' << p.y << ' ' << 1.08 * p.z << '\n';
    for (const Triangle& f : mesh.faces) out << "f " << f[0] + 1 << ' ' << f[1] + 1 << ' ' << f[2] + 1 << '\n';
  }
  const auto bust = [](const GarmentSnapshot& f) { return f.body->measured().value.at("bust_girth"); };
  const double girth = bust(w.session().snapshot());
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file.string()))});
  QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&w.main(), &enter);
  QDropEvent drop(QPointF(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&w.main(), &drop);
  w.rest();
  w.session().finish();
  w.rest();
  ASSERT_NEAR(bust(w.session().snapshot()), 1.08 * girth, 0.02) << w.main().said().toStdString();
  const std::size_t steps = w.count();
  const std::string imported = w.session().snapshot().body->hash();

  QSlider* slider = sliderOf(w, "Bust girth");
  ASSERT_TRUE(slider);
  EXPECT_NEAR(w.box("Bust girth").value(), bust(w.session().snapshot()), 0.001) << "what was measured";
  const QPointF knob = knobOf(*slider);
  w.drag(*slider, {knob, knob + QPointF(slider->width() * 0.2, 0)}, {}, [&] {
    w.session().finish();
    EXPECT_EQ(w.session().shown().body->hash(), imported) << "no mannequin stands there";
  });
  w.rest();
  EXPECT_EQ(w.session().shown().body->hash(), imported);
  EXPECT_EQ(w.count(), steps);
  std::string said;
  for (const QLabel* label : w.main().findChildren<QLabel*>())
    if (label->isVisible()) said += label->text().toStdString() + "\n";
  EXPECT_THAT(said, testing::HasSubstr("The imported body “client”"));
  for (const QLabel* one : w.main().findChildren<QLabel*>()) {
    if (!one->text().startsWith("The imported body")) continue;
    EXPECT_GE(one->height(), one->heightForWidth(one->width())) << "its lines have room";
  }
  EXPECT_THAT(said, testing::HasSubstr("It takes this body's place"));
  w.keep("studio_imported_body");

  QPushButton& make = w.button("Make a mannequin with these measures");
  ASSERT_TRUE(make.isVisible());
  const double was = bust(w.session().snapshot());
  w.click(make, make.rect().center());
  w.rest();
  ASSERT_GT(w.count(), steps) << w.main().said().toStdString();
  EXPECT_TRUE(w.session().figure()->mesh.empty());
  EXPECT_NEAR(bust(w.session().snapshot()), was, 0.01);
  EXPECT_FALSE(make.isVisible());
  w.key(Command::Undo);
  w.rest();
  EXPECT_EQ(w.session().snapshot().body->hash(), imported) << "and Undo brings it back";
  EXPECT_TRUE(make.isVisible());
}

// While a figure is only tried on, the list tells its measures.
TEST(StudioFigure, TheListOfMeasuresIsOfTheFigureThatIsSeen) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(1);
  w.rest();
  const auto listed = [&] {
    for (const QLabel* label : w.main().findChildren<QLabel*>())
      if (label->isVisible() && label->text().startsWith("<table>") && label->text().contains("height"))
        return label->text();
    return QString();
  };
  const QString before = listed();
  ASSERT_FALSE(before.isEmpty());
  QSlider* slider = sliderOf(w, "Bust girth");
  const QPointF knob = knobOf(*slider);
  w.drag(*slider, {knob, knob + QPointF(slider->width() * 0.12, 0)}, {}, [&] {
    w.session().finish();
    w.rest();
    EXPECT_NE(listed(), before);
  });
  w.key(Command::Cancel);
  w.rest();
}

// A man after a child would stand with his head out of the picture; who went near stays there.
TEST(StudioFigure, AnotherFigureIsSeenWholeWhereNobodyWentNear) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  const auto figure = [&](const char* size) {
    w.session().perform(*parseOperation(std::string("body size=") + size));
    w.rest();
  };
  figure("child110");
  w.view(View::Front);
  const auto crown = [&] { return *w.space().onScreen({0, extent(w.session().snapshot().frame).high.y, 0}); };
  const auto feet = [&] { return *w.space().onScreen({0, 0, 0}); };
  const auto whole = [&] { return crown().y() > 0 && feet().y() < w.space().height(); };
  ASSERT_TRUE(whole());
  figure("eu50");
  EXPECT_TRUE(whole()) << crown().y() << " " << feet().y();
  w.session().command(Command::Undo);
  w.rest();
  EXPECT_TRUE(whole());
  EXPECT_GT(feet().y() - crown().y(), w.space().height() / 2) << "and not small";
  QWheelEvent nearer(QPointF(w.space().rect().center()), w.space().mapToGlobal(QPointF(w.space().rect().center())), {},
                     {0, 120}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&w.space(), &nearer);
  w.rest();
  const QPointF before = feet();
  figure("eu50");
  EXPECT_EQ(feet(), before);
  // The person's own height, typed.
  figure("jis9ar");
  w.view(View::Front);
  ASSERT_TRUE(whole());
  figure("jis9ar set=\"height=170cm\"");
  EXPECT_TRUE(whole()) << crown().y() << " " << w.main().said().toStdString();
}

}  // namespace
}  // namespace karinui::studio

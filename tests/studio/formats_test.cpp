// The window takes what the table of formats says, and nothing else.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QDropEvent>
#include <QFileDialog>
#include <QMessageBox>
#include <QMimeData>
#include <QTest>
#include <QTimer>
#include <fstream>

#include "karinui/exchange/formats.h"
#include "menu_letters.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAreArray;

QAction* actionCalled(MainWindow& window, const QString& words) {
  for (QAction* action : window.findChildren<QAction*>())
    if (withoutLetter(*action) == words) return action;
  return nullptr;
}

// The endings that the file dialog of a menu entry offers, "*.obj"; the dialog is left again.
QStringList offeredBy(MainWindow& window, const QString& entry) {
  QStringList offered;
  QTimer watch;
  QObject::connect(&watch, &QTimer::timeout, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    watch.stop();
    for (const QString& filter : dialog->nameFilters())
      offered << filter.section('(', 1).chopped(1).split(' ', Qt::SkipEmptyParts);
    dialog->reject();
  });
  watch.start(0);
  QAction* action = actionCalled(window, entry);
  if (action) action->trigger();
  return offered;
}

std::vector<std::string> written(const QStringList& offered) {
  std::vector<std::string> all;
  for (const QString& one : offered) all.push_back(one.toStdString());
  return all;
}

TEST(StudioFormats, DialogsOfferExactlyWhatCanBeRead) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  const std::vector<std::string> imported = written(offeredBy(w.main(), QString::fromUtf8("Import…")));
  const std::vector<std::string> opened = written(offeredBy(w.main(), QString::fromUtf8("Open…")));
  std::vector<std::string> readable;
  for (const FileFormat& format : fileFormats())
    for (const std::string_view ending : format.endings) {
      const std::string pattern = "*." + std::string(ending);
      const bool once = std::find(readable.begin(), readable.end(), pattern) == readable.end();
      if (format.in != FileContent::None && once) readable.push_back(pattern);
    }
  EXPECT_THAT(opened, testing::ElementsAre("*.karinui"));
  std::vector<std::string> both = imported;
  both.insert(both.end(), opened.begin(), opened.end());
  EXPECT_THAT(both, UnorderedElementsAreArray(readable));
  EXPECT_THAT(imported, testing::Contains("*.obj"));
}

void drop(MainWindow& window, const fs::path& file) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file.string()))});
  QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window, &enter);
  QDropEvent left(QPointF(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window, &left);
}

TEST(StudioFormats, ADroppedFileIsTakenByItsEndingInCapitalsAndAnUnknownOneTold) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  Folder folder;
  std::ofstream(folder.path / "X.OPS")
      << "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; back L 0 0\"\n";
  std::ofstream(folder.path / "body.stl") << "solid\n";
  const std::size_t before = w.count();
  drop(w.main(), folder.path / "body.stl");
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("“body.stl” has none of the endings that are read here: "
                                                       "documents (.karinui), bodies (.glb, .obj, .gltf, .ply)"));
  for (const char* also : {"measures (.measures", "Photographs (.png"})  // which are taken when they are dropped, too
    EXPECT_THAT(w.main().said().toStdString(), HasSubstr(also));
  EXPECT_EQ(w.count(), before);
  drop(w.main(), folder.path / "X.OPS");
  w.rest();
  EXPECT_EQ(w.count(), before + 1) << w.main().said().toStdString();
}

// Where the file's own window offers to move it, as file managers do, it is copied: a mover deletes what was taken.
TEST(StudioFormats, ADroppedFileStaysWhereItIs) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  Folder folder;
  const fs::path file = folder.path / "x.ops";
  std::ofstream(file) << "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; back L 0 0\"\n";
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file.string()))});
  const Qt::DropActions offered = Qt::CopyAction | Qt::MoveAction;
  QDragEnterEvent enter({200, 200}, offered, &data, Qt::LeftButton, Qt::ShiftModifier);
  ASSERT_EQ(enter.proposedAction(), Qt::MoveAction);
  QApplication::sendEvent(&w.main(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  EXPECT_EQ(enter.dropAction(), Qt::CopyAction);
  QDropEvent left(QPointF(200, 200), offered, &data, Qt::LeftButton, Qt::ShiftModifier);
  QApplication::sendEvent(&w.main(), &left);
  EXPECT_TRUE(left.isAccepted());
  EXPECT_EQ(left.dropAction(), Qt::CopyAction);
  w.rest();
  EXPECT_TRUE(w.session().snapshot().document.pieceNamed("front"));
}

// A drawing that tells no size: the right length is chosen from those that its units would make.
TEST(StudioFormats, AUnitThatIsNotToldIsAsked) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  Folder folder;
  const fs::path file = folder.path / "front.svg";
  std::ofstream(file) << "<svg viewBox='0 0 900 900'><rect id='front' width='400' height='300'/></svg>";
  drop(w.main(), file);
  w.rest();
  auto* dialog = w.main().findChild<QDialog*>("ask_unit");
  ASSERT_TRUE(dialog) << w.main().said().toStdString();
  auto* lengths = dialog->findChild<QComboBox*>("unit");
  ASSERT_TRUE(lengths);
  EXPECT_THAT(lengths->currentText().toStdString(), HasSubstr("10.6 cm"));
  const int millimetres = lengths->findText("40.0 cm", Qt::MatchStartsWith);
  ASSERT_GE(millimetres, 0);
  lengths->setCurrentIndex(millimetres);
  dialog->accept();
  w.rest();
  ASSERT_EQ(w.session().snapshot().document.pattern.pieces.size(), 1u) << w.main().said().toStdString();
  EXPECT_NEAR(w.session().snapshot().document.pattern.pieces.begin()->second->outline.area(), 0.12, 1e-9);
}

// A box without its lid, as a scan has holes: the skin that closes it is offered, and Escape leaves it.
TEST(StudioFormats, ABodyWithHolesIsOfferedASkin) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  Folder folder;
  const fs::path file = folder.path / "scan.obj";
  std::ofstream(file) << "v -0.2 0 -0.15\nv 0.2 0 -0.15\nv 0.2 1.6 -0.15\nv -0.2 1.6 -0.15\n"
                         "v -0.2 0 0.15\nv 0.2 0 0.15\nv 0.2 1.6 0.15\nv -0.2 1.6 0.15\n"
                         "f 1 4 3 2\nf 5 6 7 8\nf 1 5 8 4\nf 2 3 7 6\nf 1 2 6 5\nf 4 8 7\n";
  const auto offer = [&] {
    drop(w.main(), file);
    w.rest();
    return w.main().findChild<QMessageBox*>("offer_skin");
  };
  QMessageBox* box = offer();
  ASSERT_TRUE(box) << w.main().said().toStdString();
  EXPECT_THAT(box->text().toStdString(), HasSubstr("scan.obj"));
  QTest::keyClick(box, Qt::Key_Escape);
  w.rest();
  EXPECT_FALSE(w.session().snapshot().body);
  box = offer();
  ASSERT_TRUE(box);
  QTest::mouseClick(box->defaultButton(), Qt::LeftButton);
  w.rest();
  ASSERT_TRUE(w.session().snapshot().body) << w.main().said().toStdString();
  EXPECT_EQ(w.session().snapshot().body->name(), "scan");
}

}  // namespace
}  // namespace karinui::studio

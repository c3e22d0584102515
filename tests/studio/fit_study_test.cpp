// Fit in motion and over figures, in the real window.
#include <gmock/gmock.h>

#include <QAction>
#include <QLabel>
#include <QListWidget>
#include <QTableWidget>
#include <cstdlib>

#include "fit_study.h"
#include "karinui/base/file.h"
#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using ::testing::HasSubstr;

// Drawn by numbers, so that it is the same on every figure, on cells fine enough to tell what it presses with.
const char* const kOneSize =
    "body size=eu38\nset spacing=15mm\n"
    "piece name=front outline=\"M -262 -380; hem L 262 -380; side_left L 245 0; hip_left C 239 70 219 140 202 200; "
    "waist L -202 200; hip_right C -219 140 -239 70 -245 0; side_right L -262 -380\"\n"
    "place piece=front at=\"torso:hip@0\" ease=2cm\nduplicate piece=front name=back\n"
    "place piece=back at=\"torso:hip@0.5\" ease=2cm\n"
    "sew a=front.side_left b=back.side_right\nsew a=front.hip_left b=back.hip_right\n"
    "sew a=front.side_right b=back.side_left\nsew a=front.hip_right b=back.hip_left\n"
    "elastic edges=\"front.waist back.waist\" length=66cm\n";

class Study {
 public:
  explicit Study(const char* action, const std::string& script = "", bool tunic = true) {
    application();
    if (tunic) w.openTunic();
    if (const auto lines = parseScript(script))
      for (const ScriptLine& line : *lines) w.session().perform(line.operation);
    w.rest();
    auto* menu = w.main().findChild<QAction*>(action);
    if (menu) menu->trigger();
    dialog = w.main().findChild<FitStudy*>();
  }
  ~Study() { delete dialog; }
  void waitFor(void (FitStudy::*signal)()) {
    bool came = false;
    QObject::connect(dialog, signal, &w.main(), [&] { came = true; });
    while (!came) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  }
  QListWidget& choices() { return *dialog->findChild<QListWidget*>("study_choices"); }
  QTableWidget& table() { return *dialog->findChild<QTableWidget*>("study_table"); }
  QPushButton& go() { return *dialog->findChild<QPushButton*>("study_go"); }
  std::string said() { return dialog->findChild<QLabel*>("study_said")->text().toStdString(); }
  int ticked() {
    int all = 0;
    for (int k = 0; k < choices().count(); ++k) all += choices().item(k)->checkState() == Qt::Checked;
    return all;
  }
  void tickOnly(std::initializer_list<int> rows) {
    for (int k = 0; k < choices().count(); ++k) choices().item(k)->setCheckState(Qt::Unchecked);
    for (const int row : rows) choices().item(row)->setCheckState(Qt::Checked);
  }
  Window w;
  FitStudy* dialog = nullptr;
};

bool isLong() {
  const char* asked = std::getenv("KARINUI_LONG");
  return asked && *asked;
}

TEST(FitStudies, PosesAreTickedByKeysAndTheWorkIsStopped) {
  KARINUI_NEEDS_DISPLAY();
  Study study("motion");
  ASSERT_TRUE(study.dialog);
  EXPECT_EQ(study.ticked(), 4) << "the usual ones";
  EXPECT_TRUE(study.go().isEnabled()) << "with what is ticked already";
  study.choices().setFocus();
  study.choices().setCurrentRow(0);
  study.w.type(study.choices(), Qt::Key_Space);
  EXPECT_EQ(study.ticked(), 5);
  study.tickOnly({});
  EXPECT_FALSE(study.go().isEnabled()) << "there is nothing to look at";
  study.tickOnly({1});
  ASSERT_TRUE(study.go().isEnabled());
  const std::size_t steps = study.w.count();
  study.go().click();
  EXPECT_TRUE(study.dialog->busy());
  study.go().click();
  while (study.dialog->busy()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  EXPECT_THAT(study.said(), HasSubstr("Stopped"));
  EXPECT_EQ(study.w.count(), steps) << "the garment is left as it is";
}

// The way through the poses that are ticked becomes a file; the table that was made stays.
TEST(FitStudies, AnAnimationIsWritten) {
  KARINUI_NEEDS_DISPLAY();
  Study study("motion");
  ASSERT_TRUE(study.dialog);
  auto& motion = dynamic_cast<MotionStudy&>(*study.dialog);
  auto* save = motion.findChild<QPushButton*>("study_animation");
  ASSERT_TRUE(save);
  EXPECT_TRUE(save->isEnabled());
  study.tickOnly({});
  EXPECT_FALSE(save->isEnabled());
  study.tickOnly({2});  // arms down
  Folder folder;
  const std::string file = (folder.path / "moving.glb").string();
  const std::size_t steps = study.w.count();
  motion.saveAnimation(file);
  EXPECT_TRUE(study.dialog->busy());
  EXPECT_FALSE(save->isEnabled());
  study.waitFor(&FitStudy::finished);
  EXPECT_THAT(study.said(), HasSubstr("moving.glb"));
  const auto bytes = readFile(file);
  ASSERT_TRUE(bytes);
  EXPECT_THAT(*bytes, HasSubstr("\"arms_down\""));
  EXPECT_TRUE(save->isEnabled());
  EXPECT_EQ(study.w.count(), steps);
  motion.saveAnimation((folder.path / "none" / "moving.glb").string());
  study.waitFor(&FitStudy::finished);
  EXPECT_THAT(study.said(), HasSubstr("cannot be written"));
  // Stopped, and closed, in the middle: no file, nor a part of one.
  const auto files = [&] { return std::distance(std::filesystem::directory_iterator(folder.path), {}); };
  const auto before = files();
  motion.saveAnimation((folder.path / "stopped.glb").string());
  study.go().click();
  study.waitFor(&FitStudy::finished);
  EXPECT_THAT(study.said(), HasSubstr("Stopped"));
  motion.saveAnimation((folder.path / "closed.glb").string());
  delete study.dialog;
  study.dialog = nullptr;
  EXPECT_EQ(files(), before);
}

TEST(FitStudies, FiguresAreTickedAndReadFromATable) {
  KARINUI_NEEDS_DISPLAY();
  Study study("figures");
  ASSERT_TRUE(study.dialog);
  EXPECT_EQ(study.ticked(), 5) << "this figure, smaller and larger";
  EXPECT_TRUE(study.go().isEnabled());
  EXPECT_GT(study.choices().count(), 8);
  Folder folder;
  const std::string file = (folder.path / "people.csv").string();
  ASSERT_TRUE(writeFile(file, "name,sex,bust_girth_cm,waist_girth_cm\nAnna,female,84,66\nBea,female,92,74\n"));
  dynamic_cast<FiguresStudy&>(*study.dialog).addTable(file);
  EXPECT_EQ(study.ticked(), 2) << "those who were added are meant";
  EXPECT_EQ(study.choices().item(study.choices().count() - 1)->text(), "Bea");
  ASSERT_TRUE(writeFile(file, "name\nAnna\n"));
  dynamic_cast<FiguresStudy&>(*study.dialog).addTable(file);
  EXPECT_EQ(study.ticked(), 2);
  EXPECT_NE(study.said(), "");
}

TEST(FitStudies, TableAndPictureOfTwoPoses) {
  KARINUI_NEEDS_DISPLAY();
  if (!isLong()) GTEST_SKIP() << "./test --long";
  Study study("motion", "set spacing=15mm\ndrape\n");  // coarser cells press at single points
  study.tickOnly({1, 3});
  study.go().click();
  study.waitFor(&FitStudy::drawn);
  ASSERT_EQ(study.table().rowCount(), 3);
  EXPECT_EQ(study.table().columnCount(), 10);
  for (int row = 0; row < 3; ++row) EXPECT_THAT(study.table().item(row, 2)->text().toStdString(), HasSubstr("%"));
  for (int row = 0; row < 3; ++row)
    EXPECT_THAT(study.table().item(row, 8)->text().toStdString(), HasSubstr(" cm")) << "in the person's own unit";
  EXPECT_THAT(study.dialog->csv(), HasSubstr("pose,settled,strain_mean"));
  EXPECT_FALSE(study.dialog->findChild<QLabel*>("study_picture")->pixmap().isNull());
  study.w.keepDialog(*study.dialog, "studio_motion");
}

TEST(FitStudies, WhomItDoesNotFit) {
  KARINUI_NEEDS_DISPLAY();
  if (!isLong()) GTEST_SKIP() << "./test --long";
  Study study("figures", kOneSize, false);
  study.tickOnly({0, 2, 4});
  study.go().click();
  study.waitFor(&FitStudy::drawn);
  ASSERT_EQ(study.table().rowCount(), 3) << study.said();
  for (int row = 0; row < 2; ++row) EXPECT_EQ(study.table().item(row, 1)->text(), "fits") << row;
  EXPECT_NE(study.table().item(2, 1)->text(), "fits") << "8 cm more than it was cut for";
  EXPECT_THAT(study.dialog->csv(), HasSubstr("body,fits,fault"));
  EXPECT_FALSE(study.dialog->findChild<QLabel*>("study_picture")->pixmap().isNull());
  study.w.keepDialog(*study.dialog, "studio_figures");
}

}  // namespace
}  // namespace karinui::studio

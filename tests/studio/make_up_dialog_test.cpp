// Making up a pattern in the real window: what is proposed, corrected, and becomes steps.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QLabel>
#include <QTabBar>
#include <QTableWidget>
#include <cstdlib>

#include "karinui/design/script.h"
#include "make_up_dialog.h"
#include "make_up_view.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const char* const kTShirt =
    "piece name=front outline=\"M -250 0; a L 250 0; b L 240 350; c C 190 370 175 440 180 570; d L 80 600; "
    "e C 60 483 -60 483 -80 600; f L -180 570; g C -175 440 -190 370 -240 350; h L -250 0\" pose=\"1,1,0\"\n"
    "piece name=back outline=\"M -250 0; a L 250 0; b L 240 350; c C 190 370 175 440 180 570; d L 80 600; "
    "e C 60 567 -60 567 -80 600; f L -180 570; g C -175 440 -190 370 -240 350; h L -250 0\" pose=\"1,1,0\"\n"
    "piece name=sleeve outline=\"M -140 -80; a L 140 -80; b L 165 0; c C 110 10 100 150 0 150; "
    "d C -100 150 -110 5 -165 0; e L -140 -80\" pose=\"1,1,0\"\n";

struct MakingUpInTheWindow {
  explicit MakingUpInTheWindow(const std::string& more = "", const std::string& figure = "body size=eu38\n") {
    application();
    if (const auto lines = parseScript(figure + kTShirt + more))
      for (const ScriptLine& line : *lines) w.session().perform(line.operation);
    w.rest();
    before = w.count();
    for (QAction* action : w.main().findChildren<QAction*>())
      if (action->text() == QString::fromUtf8("Make up the pattern…")) action->trigger();
    dialog = w.main().findChild<MakeUpDialog*>();
    if (!dialog) return;
    const auto lists = dialog->findChildren<QTableWidget*>();
    pieces = lists.at(0), seams = lists.at(1);
    wait();
  }
  ~MakingUpInTheWindow() { delete w.main().findChild<MakeUpDialog*>(); }
  void wait() {
    while (dialog->busy()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    QApplication::processEvents();
  }
  std::string said() { return dialog->findChild<QLabel*>("make_up_said")->text().toStdString(); }
  const Document& document() { return w.session().snapshot().document; }

  Window w;
  std::size_t before = 0;
  MakeUpDialog* dialog = nullptr;
  QTableWidget *pieces = nullptr, *seams = nullptr;
};

TEST(StudioMakeUp, WhatIsTickedIsSewn) {
  KARINUI_NEEDS_DISPLAY();
  MakingUpInTheWindow bench;
  auto& [w, before, dialog, pieces, seams] = bench;
  ASSERT_TRUE(dialog && dialog->making());
  ASSERT_EQ(pieces->rowCount(), 3);
  EXPECT_EQ(qobject_cast<QComboBox*>(pieces->cellWidget(2, 1))->currentText(), "sleeve");
  ASSERT_EQ(dialog->making()->sewn.size(), 8u);  // two shoulders, sides, armholes, underarms
  w.keepDialog(*dialog, "studio_make_up");
  seams->selectRow(0);
  EXPECT_THAT(bench.said(), HasSubstr(" cm"));
  seams->item(0, 0)->setCheckState(Qt::Unchecked);
  bench.wait();
  EXPECT_EQ(dialog->making()->sewn.size(), 7u);
  EXPECT_EQ(seams->item(0, 0)->checkState(), Qt::Unchecked);
  w.button("Make up").click();
  w.rest();
  EXPECT_EQ(bench.document().pattern.seams.size(), 7u);
  EXPECT_EQ(bench.document().pattern.pieces.size(), 4u);
  EXPECT_GT(w.count(), before);
}

TEST(StudioMakeUp, APieceIsWhatThePersonSays) {
  KARINUI_NEEDS_DISPLAY();
  MakingUpInTheWindow bench;
  auto& [w, before, dialog, pieces, seams] = bench;
  ASSERT_TRUE(dialog && dialog->making());
  ASSERT_EQ(pieces->rowCount(), 3);
  auto* box = qobject_cast<QComboBox*>(pieces->cellWidget(2, 1));
  box->setCurrentIndex(box->findText("not needed to drape"));
  bench.wait();
  EXPECT_EQ(dialog->making()->sewn.size(), 4u);
  box->setCurrentIndex(box->findText("sleeve"));
  bench.wait();
  EXPECT_EQ(dialog->making()->sewn.size(), 8u);
  dialog->close();
  QApplication::processEvents();
  EXPECT_EQ(w.count(), before);  // nothing was done
}

// Where there is no figure, the pane says so and how to get one; the seams are proposed all the same.
TEST(StudioMakeUp, WithoutAFigureItSaysSo) {
  KARINUI_NEEDS_DISPLAY();
  MakingUpInTheWindow bench("", "");
  ASSERT_TRUE(bench.dialog && bench.dialog->making());
  ASSERT_FALSE(bench.w.session().snapshot().body);
  auto* view = bench.dialog->findChild<MakeUpView*>();
  ASSERT_TRUE(view);
  EXPECT_THAT(text(view->emptySaid()), AllOf(HasSubstr("no figure"), HasSubstr("Body")));
  const QImage pane = view->grab().toImage();
  int inked = 0;
  for (int y = 0; y < pane.height(); ++y)
    for (int x = 0; x < pane.width(); ++x) inked += pane.pixel(x, y) != pane.pixel(0, 0);
  EXPECT_GT(inked, 50) << "the sentence is seen";
  bench.dialog->findChild<QTabBar*>()->setCurrentIndex(1);
  EXPECT_TRUE(view->emptySaid().empty()) << "the pattern is there";
}

// The figure is taken as the garment has it, whatever pose it stands in: an imported one could not be built anew.
TEST(StudioMakeUp, NoFigureIsBuilt) {
  KARINUI_NEEDS_DISPLAY();
  MakingUpInTheWindow bench("pose name=T\n");
  ASSERT_TRUE(bench.dialog && bench.dialog->making());
  ASSERT_FALSE(bench.document().body.pose.empty());
  const Folder built;
  const char* const before = std::getenv("KARINUI_FIGURES");
  const std::string kept = before ? before : "";
  ::setenv("KARINUI_FIGURES", built.path.c_str(), 1);
  bench.seams->item(0, 0)->setCheckState(Qt::Unchecked);
  bench.wait();
  ::setenv("KARINUI_FIGURES", kept.c_str(), 1);
  EXPECT_EQ(bench.dialog->making()->sewn.size(), 7u);
  EXPECT_TRUE(fs::is_empty(built.path));
}

}  // namespace
}  // namespace karinui::studio

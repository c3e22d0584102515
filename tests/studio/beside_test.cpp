// Another size, fabric or garment beside the one that is worked on.
#include "beside.h"
#include "menu_letters.h"

#include <gmock/gmock.h>

#include <QComboBox>
#include <QFileDialog>
#include <QMenu>
#include <QTimer>
#include <fstream>

#include "karinui/design/variant.h"
#include "picture_dialog.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

Beside& besideOf(Window& w) { return *w.main().findChild<Beside*>(); }

void await(Window& w) {
  do {
    while (besideOf(w).busy()) application().processEvents(QEventLoop::WaitForMoreEvents);
    w.rest();
  } while (besideOf(w).busy());
}

// By its menu, as a person chooses it.
QAction* chosen(QMenu& menu, const QString& words) {
  for (QAction* action : menu.actions()) {
    if (withoutLetter(*action) == words) return action;
    if (action->menu())
      if (QAction* inner = chosen(*action->menu(), words)) return inner;
  }
  return nullptr;
}
void chooseKind(Window& w, const QString& words) {
  auto* menu = w.main().findChild<QMenu*>("beside");
  ASSERT_TRUE(menu);
  emit menu->aboutToShow();
  QAction* action = chosen(*menu, words);
  ASSERT_TRUE(action) << words.toStdString();
  action->trigger();
  await(w);
}

QImage leftOf(Window& w) {
  const QImage both = w.space().grabFramebuffer();
  return both.copy(0, 60, both.width() / 2, both.height() - 80);
}

TEST(StudioBeside, AnotherFabricIsDrapedBesideAndFollowsWhatIsDone) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.main().boards().setCurrentIndex(3);
  w.rest();
  const std::size_t steps = w.count();
  chooseKind(w, "in Denim");
  ASSERT_TRUE(w.space().beside());
  const Beside& beside = besideOf(w);
  std::vector<std::string> offered;
  for (const Beside::Choice& one : beside.choices()) offered.push_back(text(one.words));
  EXPECT_THAT(offered, testing::Contains("after step 9: Sew")) << "a step is known by what was done before";
  EXPECT_EQ(beside.fitting()->document.pieceNamed("front")->fabric, "denim");
  EXPECT_TRUE(beside.fitting()->document.drape.dirty.empty()) << "at rest in its fabric";
  EXPECT_NE(w.session().snapshot().document.pieceNamed("front")->fabric, "denim");
  EXPECT_EQ(w.count(), steps) << "nothing is done to the garment";
  w.keep("studio_compare");

  const QImage front = leftOf(w);
  w.view(View::Back);
  EXPECT_NE(leftOf(w), front) << "both are turned";
  const SnapshotPtr before = beside.fitting();
  w.session().perform(CutPiece{.piece = PieceRef(w.session().snapshot().document.pieceNamed("front")->id),
                               .line = {{0.03, -0.05}, {0.03, 0.15}},
                               .name = "",
                               .keeps = {},
                               .edge = {},
                               .twins = {}});
  await(w);
  EXPECT_NE(beside.fitting(), before);
  EXPECT_EQ(hash(beside.fitting()->document).size(), hash(before->document).size());
  EXPECT_GT(beside.fitting()->document.pieceNamed("front")->outline.edges.size(),
            before->document.pieceNamed("front")->outline.edges.size())
      << "the slit is in it, too";
  EXPECT_EQ(beside.fitting()->document.pieceNamed("front")->fabric, "denim");

  PictureDialog dialog(w.session(), w.space(), &w.main());
  const auto picture = dialog.draw(0.25);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, 450) << "both are on the picture";
  EXPECT_EQ(picture->height, 600);
  chooseKind(w, "nothing");
  EXPECT_FALSE(w.space().beside());
}

TEST(StudioBeside, AnotherGarmentIsChosenByItsFile) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.rest();
  Folder folder;
  const fs::path other = folder.path / "other.karinui";
  fs::copy(w.session().path(), other);
  Beside& beside = besideOf(w);
  beside.show({other, say("{0}", std::string("other"))});
  await(w);
  ASSERT_TRUE(w.space().beside());
  EXPECT_EQ(hash(beside.fitting()->document), hash(w.session().snapshot().document));
  const auto choices = beside.choices();
  EXPECT_EQ(choices.back().what, beside.what()) << "it stays to be seen in the list";
  w.session().command(Command::Undo);
  await(w);
  EXPECT_TRUE(w.space().beside()) << "it is another's";
  beside.show({folder.path / "none.karinui", say("{0}", std::string("none"))});
  await(w);
  EXPECT_FALSE(w.space().beside());
  EXPECT_THAT(w.main().said().toStdString(), testing::HasSubstr("none.karinui"));
}

// Words with a dot between them are an edge of a piece, but not in the name of a file.
TEST(StudioBeside, AFileIsCalledByItsName) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Folder folder;
  const fs::path other = folder.path / "first.sleeve.karinui";
  fs::copy(w.session().path(), other);
  QTimer watch;
  QObject::connect(&watch, &QTimer::timeout, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    watch.stop();
    dialog->selectFile(QString::fromStdString(other.string()));
    static_cast<QDialog*>(dialog)->accept();
  });
  watch.start(0);
  chooseKind(w, "Another garment…");
  ASSERT_TRUE(w.space().beside()) << w.main().said().toStdString();
  EXPECT_EQ(inWords(besideOf(w).choices().back().words), "first.sleeve.karinui");
}

TEST(StudioBeside, ASizeStandsBesideTheOneThatIsWorkedOn) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const auto operation = [&](const char* line) { w.session().perform(*parseOperation(line)), w.rest(); };
  operation("grade sizes=\"S M\" base=M");
  operation("grade corners=\"front.hem_left back.hem_left\" by=0,-4cm size=M");
  chooseKind(w, "Size S");
  ASSERT_TRUE(w.space().beside());
  EXPECT_EQ(besideOf(w).fitting()->document.grading.standing, 0u);
  EXPECT_EQ(w.session().snapshot().document.grading.standing, 1u);
  const std::uint64_t seq = w.session().steps().front().seq;
  w.session().goTo(std::size_t{1});
  await(w);
  EXPECT_FALSE(w.space().beside()) << "the size is gone with its step: " << seq;
}

}  // namespace
}  // namespace karinui::studio

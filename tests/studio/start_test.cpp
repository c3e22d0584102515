// No document is open: the start page. And whatever is begun from an empty window is a file from its first step on.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <QDropEvent>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QMimeData>
#include <QTest>
#include <QTimer>
#include <csignal>
#include <fstream>

#include "drafts.h"
#include "karinui/base/file.h"
#include "karinui/design/script.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::HasSubstr;

// A window before anything was made on this machine.
struct Fresh {
  Window w;
  Fresh() {
    std::error_code none;
    fs::remove_all(draftsFolder(), none);
    QSettings().remove("recent");
  }
  QListWidget& cards() {
    for (QListWidget* list : w.main().findChildren<QListWidget*>())
      if (list->accessibleName() == "Your garments" || list->accessibleName() == QString::fromUtf8("作った服"))
        return *list;
    ADD_FAILURE() << "no list of garments";
    std::abort();
  }
  void putOnFigure() {  // with the mouse, on the board of the body
    w.main().boards().setCurrentIndex(1);
    QPushButton& button = w.button("Put the garment on this figure");
    w.click(button, button.rect().center());
    w.rest();
  }
  void strike(QWidget& widget, Qt::Key key, Qt::KeyboardModifiers held = {}) {
    w.main().activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&w.main()));
    QTest::keyClick(&widget, key, held);
    QApplication::processEvents();
  }
};

std::vector<fs::path> draftsThere() {
  std::vector<fs::path> all;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(draftsFolder(), none)) all.push_back(entry.path());
  return all;
}

TEST(StudioStart, AFigureInAnEmptyWindowIsAFileAndIsFoundAgain) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  f.putOnFigure();
  ASSERT_EQ(f.w.count(), 1u);
  const fs::path draft = f.w.session().path();
  EXPECT_EQ(draft.parent_path(), draftsFolder());
  EXPECT_THAT(draft.filename().string(), testing::MatchesRegex("JIS 9AR .women. 20..-..-..\\.karinui"));
  EXPECT_TRUE(fs::exists(draft));

  f.strike(f.w.space(), Qt::Key_W, Qt::ControlModifier);
  ASSERT_TRUE(f.w.main().atStart());
  f.w.rest();
  ASSERT_EQ(f.cards().count(), 1);
  EXPECT_EQ(f.w.main().focusWidget(), &f.cards()) << "the keys are on what was left";
  const QListWidgetItem* card = f.cards().item(0);
  EXPECT_EQ(card->text().toStdString(), draft.stem().string());
  EXPECT_THAT(card->data(Qt::AccessibleTextRole).toString().toStdString(), HasSubstr("Draft, today"));
  const QImage picture = card->data(Qt::DecorationRole).value<QPixmap>().toImage();
  ASSERT_FALSE(picture.isNull());
  int figure = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 1; x < picture.width(); ++x)
      figure += std::abs(qGray(picture.pixel(x, y)) - qGray(picture.pixel(x - 1, y))) > 12;
  EXPECT_GT(figure, 200) << "the figure is seen";

  f.strike(f.cards(), Qt::Key_Space);
  f.strike(f.cards(), Qt::Key_Return);
  f.w.rest();
  EXPECT_FALSE(f.w.main().atStart());
  EXPECT_EQ(f.w.session().path(), draft);
  EXPECT_EQ(f.w.count(), 1u);
  EXPECT_FALSE(f.w.session().readOnly());
}

TEST(StudioStart, AClickOpensADocumentAndWhatIsGoneIsNotShown) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  f.w.openTunic();
  const fs::path tunic = f.w.session().path();
  QSettings().setValue("recent", QStringList{QString::fromStdString(tunic.string()), "/nowhere/gone.karinui"});
  f.w.main().showStart();
  f.w.rest();
  f.w.keep("studio_start");
  ASSERT_EQ(f.cards().count(), 1);
  EXPECT_FALSE(f.cards().item(0)->data(Qt::DecorationRole).value<QPixmap>().isNull());
  f.w.click(*f.cards().viewport(), f.cards().visualItemRect(f.cards().item(0)).center());
  f.w.rest();
  EXPECT_EQ(f.w.session().path(), tunic);
  EXPECT_GT(f.w.count(), 4u);
}

TEST(StudioStart, WithNothingMadeYetItSaysSoInBothLanguagesAndNamesItsWays) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  f.w.main().showStart();
  f.w.rest();
  for (const Language language : {Language::English, Language::Japanese}) {
    Theme::here().setLanguage(language);
    f.w.rest();
    for (const Message& words : {say("New garment…"), say("Open…"), say("Import…"),
                                 say("A first garment, step by step"), say("A sample garment")}) {
      const QPushButton& way = f.w.button(inWords(words).toUtf8().constData());
      EXPECT_TRUE(way.isVisible());
      EXPECT_GE(way.width(), way.fontMetrics().horizontalAdvance(way.text())) << way.text().toStdString();
      EXPECT_NE(way.focusPolicy() & Qt::TabFocus, 0);
      EXPECT_FALSE(way.accessibleDescription().isEmpty());
    }
    bool said = false;
    for (const QLabel* label : f.w.main().findChildren<QLabel*>())
      said =
          said || (label->isVisible() && label->text() == inWords(say("There is no garment yet. Each one is kept as a "
                                                                      "file from its first step on, and is found "
                                                                      "here again.")));
    EXPECT_TRUE(said);
  }
  Theme::here().setLanguage(Language::English);
  QPushButton& guide = f.w.button("A first garment, step by step");
  f.w.click(guide, guide.rect().center());
  EXPECT_FALSE(f.w.main().atStart());
  EXPECT_TRUE(f.w.space().isVisible());
}

TEST(StudioStart, WhatIsDroppedOnItIsADraft) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  f.w.main().showStart();
  Folder folder;
  const fs::path file = folder.path / "bag.ops";
  std::ofstream(file) << "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; back L 0 0\"\n";
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file.string()))});
  QDragEnterEvent enter({200, 200}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&f.w.main(), &enter);
  QDropEvent drop(QPointF(200, 200), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&f.w.main(), &drop);
  f.w.rest();
  EXPECT_FALSE(f.w.main().atStart());
  EXPECT_EQ(f.w.session().path().parent_path(), draftsFolder());
  EXPECT_THAT(f.w.session().path().filename().string(), testing::StartsWith("bag "));
}

TEST(StudioStart, CtrlSAnswersAndSaveAsMovesTheDraft) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  f.strike(f.w.space(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_THAT(f.w.main().said().toStdString(), HasSubstr("nothing to save yet"));
  f.putOnFigure();
  const fs::path draft = f.w.session().path();
  f.strike(f.w.space(), Qt::Key_S, Qt::ControlModifier);
  auto* box = f.w.main().findChild<QMessageBox*>();
  ASSERT_TRUE(box);
  EXPECT_THAT(box->text().toStdString(), testing::AllOf(HasSubstr("Saved"), HasSubstr(draft.string())));
  Folder folder;
  const fs::path coat = folder.path / "coat.karinui";
  bool asked = false;  // by the dialog that the button opens
  QTimer watch;
  QObject::connect(&watch, &QTimer::timeout, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    watch.stop();
    asked = true;
    auto* name = dialog->findChild<QLineEdit*>();
    name->setText(QString::fromStdString(coat.string()));
    QTest::keyClick(name, Qt::Key_Return);
  });
  watch.start(0);
  QPushButton* as = nullptr;
  for (QPushButton* one : box->findChildren<QPushButton*>())
    if (one->text() == QString::fromUtf8("Save as…")) as = one;
  ASSERT_TRUE(as);
  f.w.click(*as, as->rect().center());
  while (!asked) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  f.w.rest();
  EXPECT_EQ(f.w.session().path(), coat) << f.w.main().said().toStdString();
  EXPECT_TRUE(draftsThere().empty()) << "the draft itself moved";
  f.strike(f.w.space(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_THAT(f.w.main().said().toStdString(),
              testing::AllOf(HasSubstr("Saved: every step is on the disk"), HasSubstr(coat.string())));
}

TEST(StudioStart, ADraftThatCannotBePutIntoTheTrashIsToldOf) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  f.putOnFigure();
  const fs::path draft = f.w.session().path();
  f.w.main().showStart();
  f.w.rest();
  ASSERT_EQ(f.cards().count(), 1);
  f.cards().actions().front()->trigger();
  auto* box = f.w.main().findChild<QMessageBox*>();
  ASSERT_TRUE(box);
  fs::remove(draft);  // meanwhile
  for (QPushButton* one : box->findChildren<QPushButton*>())
    if (one->text() == "Into the trash") one->click();
  f.w.rest();
  std::string said;
  for (QMessageBox* one : f.w.main().findChildren<QMessageBox*>())
    if (one != box) said = one->text().toStdString();
  EXPECT_THAT(said, testing::AllOf(HasSubstr(draft.string()), HasSubstr("could not be put into the trash")));
}

TEST(StudioStart, WhereNoDraftCanBeWrittenASentenceSaysSoAndNothingIsDone) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  fs::create_directories(documentsFolder());
  std::ofstream(draftsFolder()) << "in the way";
  f.putOnFigure();
  EXPECT_EQ(f.w.count(), 0u);
  EXPECT_THAT(f.w.main().said().toStdString(), HasSubstr("no file can be made there"));
  fs::remove(draftsFolder());
  f.putOnFigure();
  EXPECT_EQ(f.w.count(), 1u);
}

// --- killed after a step

TEST(StudioKilled, DISABLED_AfterAStep) {  // run as a process of its own by the next test
  application();
  setenv("HOME", std::getenv("KARINUI_VICTIM"), 1);
  Fresh f;
  f.putOnFigure();
  raise(SIGKILL);
}

TEST(StudioStart, KilledAfterAStepEverythingIsThereOnTheStartPage) {
  KARINUI_NEEDS_DISPLAY();
  application();
  Folder home;
  const pid_t child = fork();
  if (child == 0) {
    setenv("KARINUI_VICTIM", home.path.c_str(), 1);
    execl("/proc/self/exe", "test_studio", "--gtest_also_run_disabled_tests", "--gtest_brief=1",
          "--gtest_filter=StudioKilled.DISABLED_AfterAStep", nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  const std::string before = std::getenv("HOME");
  setenv("HOME", home.path.c_str(), 1);
  {
    Window w;
    QSettings().remove("recent");  // the draft is found by itself
    w.main().showStart();
    w.rest();
    QListWidget* cards = nullptr;
    for (QListWidget* list : w.main().findChildren<QListWidget*>())
      if (list->accessibleName() == "Your garments") cards = list;
    ASSERT_TRUE(cards);
    ASSERT_EQ(cards->count(), 1);
    w.click(*cards->viewport(), cards->visualItemRect(cards->item(0)).center());
    w.rest();
    EXPECT_EQ(w.count(), 1u) << w.main().said().toStdString();
    EXPECT_EQ(w.last(), "body size=jis9ar");
    EXPECT_FALSE(w.session().readOnly());
  }
  setenv("HOME", before.c_str(), 1);
}

// A document that is damaged, and what is whole of it.
struct Damaged {
  Folder folder;
  const fs::path file = folder.path / "coat.karinui", saved = folder.path / "coat whole.karinui";
  Damaged() {
    Workers one(1);
    Token quiet;
    MemoryBlobs blobs;
    Bodies bodies;
    Context context{one, quiet, blobs, bodies, {}, {}};
    {
      auto made = DocumentFile::create(file);
      for (const char* line : {"set spacing=20mm",
                               "piece name=front outline=\"M 0 0; hem L 400 0; side L 400 500; "
                               "top L 0 500; left L 0 0\"",
                               "set ease=12mm"})
        EXPECT_TRUE(made && made->perform(*parseOperation(line), context));
    }
    // The last step says something else, and its seal stays.
    std::string bytes = *readFile(file);
    const std::size_t at = bytes.rfind("ease=");
    EXPECT_NE(at, std::string::npos);
    bytes[at + 5] = '9';
    std::ofstream(file, std::ios::binary) << bytes;
  }
};

TEST(StudioStart, ADamagedDocumentIsSavedAsFarAsItIsWhole) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  const Damaged damaged;
  const std::string before = *readFile(damaged.file);
  f.w.open(damaged.file);
  auto* box = f.w.main().findChild<QMessageBox*>();
  ASSERT_TRUE(box) << f.w.main().said().toStdString();
  EXPECT_THAT(box->text().toStdString(), HasSubstr("coat.karinui"));
  EXPECT_THAT(box->text().toStdString(), HasSubstr("damaged"));
  f.w.keepDialog(*box, "studio_rescue");
  bool asked = false;
  QTimer hand;
  QObject::connect(&hand, &QTimer::timeout, [&] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    hand.stop();
    asked = true;
    auto* name = dialog->findChild<QLineEdit*>();
    EXPECT_THAT(name->text().toStdString(), HasSubstr("coat"));
    name->setText(QString::fromStdString(damaged.saved.string()));
    QTest::keyClick(name, Qt::Key_Return);
  });
  hand.start(0);
  QTest::keyClick(box, Qt::Key_Return);  // the first button
  while (!asked) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  f.w.rest();
  EXPECT_EQ(f.w.session().path(), damaged.saved);
  EXPECT_TRUE(f.w.session().snapshot().document.pieceNamed("front"));
  EXPECT_FALSE(f.w.main().atStart());
  EXPECT_THAT(f.w.main().said().toStdString(), HasSubstr("made anew by"));
  EXPECT_EQ(*readFile(damaged.file), before);
}

TEST(StudioStart, ADamagedDocumentIsLeftAloneByEscape) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  const Damaged damaged;
  f.w.open(damaged.file);
  auto* box = f.w.main().findChild<QMessageBox*>();
  ASSERT_TRUE(box);
  QTest::keyClick(box, Qt::Key_Escape);
  f.w.rest();
  EXPECT_TRUE(f.w.session().path().empty());
  EXPECT_FALSE(fs::exists(damaged.saved));
  EXPECT_THAT(f.w.main().said().toStdString(), HasSubstr("karinui rescue"));
}

TEST(StudioStart, AWindowThatClosesInTheMiddleOfWorkIsWokenNoMore) {
  KARINUI_NEEDS_DISPLAY();
  for (int k = 0; k < 8; ++k) {
    Fresh f;
    f.w.main().showStart();
    f.w.rest();
    QPushButton& button = f.w.button("A sample garment");
    button.setFocus(Qt::TabFocusReason);
    f.strike(button, Qt::Key_Return);
    f.strike(button, Qt::Key_Space);
  }
  QApplication::processEvents();
}

// Enter presses the button that has the focus, as it opens the card.
TEST(StudioStart, EnterPressesTheButtonThatHasTheFocus) {
  KARINUI_NEEDS_DISPLAY();
  Fresh f;
  f.w.main().showStart();
  f.w.rest();
  QPushButton& button = f.w.button("A sample garment");
  button.setFocus(Qt::TabFocusReason);
  button.disconnect(SIGNAL(clicked()));  // what it begins is another test's
  button.disconnect(SIGNAL(clicked(bool)));
  int pressed = 0;
  QObject::connect(&button, &QPushButton::clicked, &button, [&] { ++pressed; });
  f.strike(button, Qt::Key_Return);
  f.strike(button, Qt::Key_Space);
  EXPECT_EQ(pressed, 2);
}

}  // namespace
}  // namespace karinui::studio

// What leaves the window: every kind of file with its preview, true-size print, pictures.
#include <gmock/gmock.h>

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPrintDialog>
#include <QPrinter>
#include <QSlider>
#include <QSpinBox>
#include <QTest>
#include <QTimer>
#include <cstdio>

#include "export_dialog.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "paper.h"
#include "picture_dialog.h"
#include "share_dialog.h"
#include "studio/asked.h"
#include "studio/window.h"

namespace karinui::studio {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

template <class Kind>
Kind& named(QWidget& dialog, const char* name) {
  for (Kind* one : dialog.findChildren<Kind*>())
    if (one->accessibleName() == name) return *one;
  ADD_FAILURE() << "nothing is called " << name;
  std::abort();
}

int inked(const QImage& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) count += qGray(image.pixel(x, y)) < 215 && qAlpha(image.pixel(x, y)) > 200;
  return count;
}

TEST(StudioSaveActions, EveryKindIsShownBeforeItIsWritten) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  ExportDialog dialog(w.session(), w.space(), &w.main());
  dialog.show();
  QApplication::processEvents();
  auto& kind = named<QComboBox>(dialog, "What");
  auto& picture = named<QLabel>(dialog, "Preview");
  auto& text = named<QPlainTextEdit>(dialog, "Preview");
  auto& page = named<QSlider>(dialog, "Page");
  Folder folder;
  for (int k = 0; k < kind.count(); ++k) {
    SCOPED_TRACE(kind.itemText(k).toStdString());
    kind.setCurrentIndex(k);
    QApplication::processEvents();
    const FileFormat& format = *dialog.wish().format;
    ASSERT_EQ(dialog.trouble().has_value(), format.id == "rul");  // the tunic has one size, and no rules
    if (dialog.trouble()) continue;
    if (format.out == FileContent::Pattern || format.out == FileContent::Script) {
      EXPECT_TRUE(text.isVisible());
      EXPECT_GT(text.toPlainText().size(), 100);
    } else {
      EXPECT_TRUE(picture.isVisible());
      EXPECT_GT(inked(picture.pixmap().toImage()), 150);
    }
    if (format.id == "pdf-a4") {
      w.keepDialog(dialog, "studio_export");
      const QImage overview = picture.pixmap().toImage();
      EXPECT_GT(page.maximum(), 4);
      page.setValue(3);
      EXPECT_NE(picture.pixmap().toImage(), overview) << "the pages are turned over";
      page.setValue(1);
    }
    const fs::path file = folder.path / ("out" + std::to_string(k) + "." + std::string(format.endings.front()));
    w.session().exportTo(file, dialog.wish());
    w.rest();
    const auto bytes = readFile(file);
    ASSERT_TRUE(bytes) << w.main().said().toStdString();
    const auto shown = exported(w.session().snapshot(), w.session().steps(), dialog.wish());
    ASSERT_TRUE(shown);
    // A file with others beside it names them.
    EXPECT_TRUE(*bytes == *shown || (format.id == "obj" && bytes->size() > shown->size())) << bytes->size();
  }
}

TEST(StudioSaveActions, WithNothingToWriteThereIsASentenceInstead) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  ExportDialog dialog(w.session(), w.space(), &w.main());
  ASSERT_TRUE(dialog.trouble());
  EXPECT_THAT(named<QLabel>(dialog, "Preview").text().toStdString(), HasSubstr("no piece yet"));
}

TEST(StudioSaveActions, ThePatternIsSharedWithoutThePerson) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const auto* item = w.main().findChild<QAction*>("share");
  ASSERT_TRUE(item && item->isEnabled());
  Folder folder;
  const fs::path file = folder.path / "for_others.karinui";
  w.session().shareTo(file);
  w.rest();
  const Document& own = w.session().snapshot().document;
  const auto shared = DocumentFile::openForReading(file);
  ASSERT_TRUE(shared) << w.main().said().toStdString();
  EXPECT_EQ(shared->document().pattern.pieces.size(), own.pattern.pieces.size());
  EXPECT_TRUE(own.body.chosen());
  EXPECT_FALSE(shared->document().body.chosen());
  // Not over the document itself.
  const auto before = readFile(w.session().path());
  w.session().shareTo(w.session().path());
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("the document itself"));
  EXPECT_EQ(*readFile(w.session().path()), *before);
}

// A name that is typed without its ending, or with another, may be that of a file that is there.
TEST(StudioSaveActions, NothingIsReplacedUnasked) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const fs::path own = w.session().path();
  Folder folder;
  for (const std::string typed : {"coat", "coat.v2", "coat.karinui"}) {
    const fs::path other = folder.path / (typed.ends_with(".karinui") ? typed : typed + ".karinui");
    ASSERT_TRUE(writeFile(other, "another garment"));
    int asked = 0;
    QTimer hand;
    QObject::connect(&hand, &QTimer::timeout, [&] {
      QWidget* modal = QApplication::activeModalWidget();
      if (auto* box = qobject_cast<QMessageBox*>(modal)) {
        ++asked;
        box->button(QMessageBox::No)->click();
      } else if (auto* dialog = qobject_cast<QFileDialog*>(modal); dialog && asked > 0) {
        hand.stop();
        dialog->reject();
      } else if (dialog) {
        auto* name = dialog->findChild<QLineEdit*>();
        if (name->text() != QString::fromStdString(other.filename().string()))  // else it is to be said once more
          name->setText(QString::fromStdString((folder.path / typed).string()));
        hand.stop();  // the question waits within this key
        QTimer::singleShot(0, &hand, [&, name] {
          hand.start(0);
          QTest::keyClick(name, Qt::Key_Return);
        });
      }
    });
    hand.start(0);
    for (QAction* action : w.main().findChildren<QAction*>())
      if (action->text() == QString::fromUtf8("Save as…")) action->trigger();
    hand.stop();
    w.rest();
    EXPECT_EQ(asked, 1) << typed;
    EXPECT_TRUE(*readFile(other) == "another garment") << typed;
    EXPECT_EQ(w.session().path(), own);
  }
}

// By keys alone: the dialog, its one choice, the file.
TEST(StudioSaveActions, ThePatternIsSharedUnderNeutralNames) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Folder folder;
  const fs::path file = folder.path / "for_others.karinui";
  std::string before, after;
  QTimer hand;
  QObject::connect(&hand, &QTimer::timeout, [&] {
    QWidget* modal = QApplication::activeModalWidget();
    if (auto* asked = qobject_cast<ShareDialog*>(modal)) {
      auto* neutral = asked->findChild<QCheckBox*>("neutral");
      auto* names = asked->findChild<QPlainTextEdit*>("names");
      if (before.empty()) {
        before = names->toPlainText().toStdString();
        EXPECT_TRUE(names->isEnabled());
        EXPECT_EQ(asked->names(), SharedNames::Kept);
        w.keepDialog(*asked, "studio_share");
        asked->activateWindow();
        neutral->setFocus(Qt::TabFocusReason);
        QTest::keyClick(neutral, Qt::Key_Space);
        EXPECT_EQ(asked->names(), SharedNames::Neutral);
        EXPECT_FALSE(names->isEnabled());
      }
      QTest::keyClick(neutral, Qt::Key_Return);
    } else if (auto* dialog = qobject_cast<QFileDialog*>(modal)) {
      hand.stop();
      auto* name = dialog->findChild<QLineEdit*>();
      name->setText(QString::fromStdString(file.string()));
      QTest::keyClick(name, Qt::Key_Return);
    }
  });
  hand.start(0);
  w.main().findChild<QAction*>("share")->trigger();
  hand.stop();
  w.rest();
  EXPECT_THAT(before, AllOf(HasSubstr("front"), HasSubstr("left shoulder")));
  const auto shared = DocumentFile::openForReading(file);
  ASSERT_TRUE(shared) << w.main().said().toStdString();
  for (const std::string& name : namesIn(shared->document()))
    EXPECT_EQ(before.find(name + ","), std::string::npos) << name;
  EXPECT_TRUE(shared->document().pieceNamed("piece1"));
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("neutral"));
  Theme::here().setLanguage(Language::Japanese);
  ShareDialog japanese(w.session().snapshot().document, &w.main());
  EXPECT_THAT(japanese.findChild<QPlainTextEdit*>("names")->toPlainText().toStdString(), HasSubstr("左"));
  w.keepDialog(japanese, "studio_share.ja");
  Theme::here().setLanguage(Language::English);
}

TEST(StudioSaveActions, WithNoPieceNothingIsShared) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.main().newGarment("jis9ar", {});
  w.rest();
  w.main().findChild<QAction*>("share")->trigger();  // no dialog waits for anyone
  w.rest();
  EXPECT_THAT(w.main().said().toStdString(), HasSubstr("There is no piece yet"));
}

// The first page of a PDF in grey, so many pixels a millimetre.
QImage pictureOf(const fs::path& pdf, double fine) {
  const std::string to = pdf.string() + ".page";
  const std::string command =
      "pdftoppm -r " + fixed(25.4 * fine, 2) + " -f 1 -l 1 -gray -singlefile '" + pdf.string() + "' '" + to + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return QImage(QString::fromStdString(to + ".pgm"));
}

TEST(StudioSaveActions, PrintsAtTrueSize) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Folder folder;
  const fs::path path = folder.path / "printed.pdf";
  {
    QPrinter printer(QPrinter::HighResolution);
    printer.setOutputFormat(QPrinter::PdfFormat);
    printer.setResolution(300);
    printer.setPageSize(QPageSize(QPageSize::A4));
    printer.setOutputFileName(QString::fromStdString(path.string()));
    w.main().printOn(printer);
  }
  const QImage page = pictureOf(path, 10);
  EXPECT_NEAR(page.width(), 2100, 3);
  EXPECT_NEAR(page.height(), 2970, 3);
  // The square of 100 mm stands at the lower left, 10 mm from the edges: its sides along the row through its middle.
  const int row = page.height() - 100 - 300;
  std::vector<int> dark;
  for (int x = 0; x < 1300; ++x)
    if (qGray(page.pixel(x, row)) < 140) dark.push_back(x);
  ASSERT_FALSE(dark.empty());
  EXPECT_NEAR(dark.front(), 100, 4);
  EXPECT_NEAR(dark.back() - dark.front(), 1000, 4);
}

// The cover is printed and measured first, and a sheet that was spoiled once more.
TEST(StudioSaveActions, PrintsThePagesThatWereAskedForHoweverTheSheetIsTurned) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Folder folder;
  const fs::path path = folder.path / "some.pdf";
  const auto printed = [&](int from, int to) {
    fs::remove(path);
    {
      QPrinter printer(QPrinter::HighResolution);
      printer.setOutputFormat(QPrinter::PdfFormat);
      printer.setResolution(72);
      printer.setPageSize(QPageSize(QPageSize::A4));
      printer.setPageOrientation(QPageLayout::Landscape);
      printer.setOutputFileName(QString::fromStdString(path.string()));
      if (from > 0) printer.setPrintRange(QPrinter::PageRange), printer.setFromTo(from, to);
      w.main().printOn(printer);
    }
    return w.main().said().toStdString();
  };
  EXPECT_THAT(printed(1, 1), HasSubstr("1 page was printed"));
  const QImage cover = pictureOf(path, 10);
  EXPECT_NEAR(cover.width(), 2100, 20);
  EXPECT_THAT(printed(2, 3), HasSubstr("2 pages were printed"));
  EXPECT_NE(pictureOf(path, 10), cover);
  EXPECT_THAT(printed(900, 901), HasSubstr("there is no page 900"));
  EXPECT_FALSE(fs::exists(path));
}

TEST(StudioSaveActions, ARollTakesTheWholeSheetAtItsOwnSize) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  Folder folder;
  const fs::path path = folder.path / "roll.pdf";
  ExportWish wish;
  wish.format = &fileFormat("pdf");
  const Flat size = paperOf(w.session().snapshot(), wish)->size(0);
  {
    QPrinter printer(QPrinter::HighResolution);
    printer.setOutputFormat(QPrinter::PdfFormat);
    printer.setResolution(150);
    printer.setPageSize(QPageSize(QSizeF(914, 500), QPageSize::Millimeter));
    printer.setOutputFileName(QString::fromStdString(path.string()));
    w.main().printOn(printer);
  }
  const QImage page = pictureOf(path, 2);
  EXPECT_NEAR(std::max(page.width(), page.height()), 2e3 * std::max(size.u, size.v), 3);
}

// What the window shows is what is saved: the pressure with its scale, too.
TEST(StudioSaveActions, ThePictureHasTheMapThatIsSeen) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  w.rest();
  const auto drawn = [&](FitMap map) {
    w.space().setMap(map);
    PictureDialog dialog(w.session(), w.space(), &w.main());
    named<QComboBox>(dialog, "From").setCurrentIndex(1);
    const auto image = dialog.draw(0.25);
    EXPECT_TRUE(image) << text(image.error().what);
    return image ? image->rgba : std::vector<std::uint8_t>();
  };
  const auto plain = drawn(FitMap::None), strain = drawn(FitMap::Strain), pressure = drawn(FitMap::Pressure);
  EXPECT_NE(plain, strain);
  EXPECT_NE(plain, pressure);
  EXPECT_NE(strain, pressure);
}

// A garment that has a name gives it to what is made of it.
TEST(StudioSaveActions, WhatIsWrittenIsCalledAfterTheGarment) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  const auto offered = [&](const Message& entry) {
    QString name;
    QTimer hand;
    QObject::connect(&hand, &QTimer::timeout, [&] {
      auto* modal = qobject_cast<QDialog*>(QApplication::activeModalWidget());
      if (!modal) return;
      if (auto* files = qobject_cast<QFileDialog*>(modal)) {
        name = files->findChild<QLineEdit*>()->text();
        hand.stop();
        return files->reject();
      }
      if (auto* print = qobject_cast<QPrintDialog*>(modal)) {
        if (auto* file = print->findChild<QLineEdit*>("filename")) name = QFileInfo(file->text()).fileName();
        hand.stop();
        return print->reject();
      }
      modal->accept();
    });
    hand.start(0);
    fromTheMenu(w, entry);
    return name;
  };
  const QString garment = QString::fromStdString(w.session().path().stem().string());
  ASSERT_FALSE(w.session().draft());
  EXPECT_EQ(offered(say("Picture of the fitting…")), garment + " – fitting.png");
  EXPECT_THAT(offered(say("Export…")).toStdString(), testing::StartsWith((garment + " – pattern.").toStdString()));
  EXPECT_EQ(offered(say("Share the pattern…")), garment + " – pattern to share.karinui");
  EXPECT_EQ(offered(say("Print the pattern…")), garment + " – pattern.pdf");
  // A draft has a name, too: what it is made as.
  w.main().newGarment("eu38", {});
  w.rest();
  w.session().perform(*parseOperation("block kind=skirt"));
  w.rest();
  ASSERT_TRUE(w.session().draft());
  const QString draft = QString::fromStdString(w.session().path().stem().string());
  EXPECT_TRUE(draft.startsWith("Skirt")) << draft.toStdString();
  EXPECT_EQ(offered(say("Print the pattern…")), draft + " – pattern.pdf");
}

TEST(StudioSaveActions, TakesAPictureFromEverySide) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  PictureDialog dialog(w.session(), w.space(), &w.main());
  named<QComboBox>(dialog, "Pixels").setCurrentIndex(0);
  auto& from = named<QComboBox>(dialog, "From");
  const auto now = dialog.draw(0.25);
  ASSERT_TRUE(now) << text(now.error().what);
  EXPECT_EQ(now->width, 225);
  from.setCurrentIndex(1);
  const auto front = dialog.draw(0.25);
  from.setCurrentIndex(2);
  const auto back = dialog.draw(0.25);
  ASSERT_TRUE(front && back);
  EXPECT_NE(front->rgba, back->rgba);
  from.setCurrentIndex(6);
  w.keepDialog(dialog, "studio_picture");
  Folder folder;
  const fs::path path = folder.path / "round.png";
  ASSERT_TRUE(dialog.write(path.string()));
  const QImage round(QString::fromStdString(path.string()));
  EXPECT_EQ(round.width(), 900) << "as large as was chosen";
  EXPECT_EQ(round.height(), 1200);
  from.setCurrentIndex(7);
  const auto strip = dialog.draw(0.25);
  ASSERT_TRUE(strip) << text(strip.error().what);
  EXPECT_EQ(strip->width, 225);
  EXPECT_EQ(strip->height, 300);
  EXPECT_EQ(dialog.frames(), 0);
}

TEST(StudioSaveActions, MakesATurntable) {
  KARINUI_NEEDS_DISPLAY();
  Window w;
  w.openTunic();
  PictureDialog dialog(w.session(), w.space(), &w.main());
  named<QComboBox>(dialog, "Pixels").setCurrentIndex(0);
  named<QComboBox>(dialog, "From").setCurrentIndex(8);
  auto& count = *dialog.findChild<QSpinBox*>("picture_count");
  EXPECT_FALSE(count.isHidden());
  count.setValue(8);
  EXPECT_EQ(dialog.frames(), 8);
  EXPECT_FALSE(named<QComboBox>(dialog, "Stereo").isEnabled());
  Folder folder;
  const fs::path turn = folder.path / "turn";
  int asked = 0;
  const auto written = dialog.writeTurn(
      turn.string(), [&](int) { return ++asked > 0; }, 0.25);
  ASSERT_TRUE(written) << text(written.error().what);
  EXPECT_EQ(*written, 8);
  const QImage first(QString::fromStdString((turn / "frame_0001.png").string()));
  const QImage half(QString::fromStdString((turn / "frame_0005.png").string()));
  EXPECT_EQ(first.width(), 225);
  EXPECT_EQ(first.size(), half.size());
  EXPECT_NE(first, half) << "seen from behind";
  EXPECT_TRUE(fs::exists(turn / "frame_0008.png"));
  const auto stopped = dialog.writeTurn((folder.path / "stopped").string(), [](int) { return false; }, 0.25);
  ASSERT_TRUE(stopped);
  EXPECT_LT(*stopped, 8);
  named<QComboBox>(dialog, "From").setCurrentIndex(1);
  EXPECT_TRUE(count.isHidden());
}

}  // namespace
}  // namespace karinui::studio

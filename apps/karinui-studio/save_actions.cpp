// What leaves the window: copies, exports, pictures, paper.
#include <QCheckBox>
#include <QDate>
#include <QDir>
#include <QFileDialog>
#include <QMessageBox>
#include <QPrintDialog>
#include <QPrinter>
#include <QProgressBar>
#include <QProgressDialog>
#include <QPushButton>
#include <algorithm>
#include <cmath>

#include "export_dialog.h"
#include "file_filter.h"
#include "main_window.h"
#include "paper.h"
#include "picture_dialog.h"
#include "share_dialog.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// How far something is that is written piece by piece, with a way to stop it.
class WritingProgress : public QProgressDialog {
 public:
  WritingProgress(const Message& words, const Message& title, int whole, QWidget* parent)
      : QProgressDialog(inWords(words), inWords(say("Stop")), 0, whole, parent) {
    auto* bar = new QProgressBar(this);  // too thin for figures
    bar->setTextVisible(false);
    setBar(bar);
    setRange(0, whole);
    setMinimumWidth(320);
    setWindowTitle(inWords(title));
    setWindowModality(Qt::WindowModal);
  }
};

}  // namespace

void MainWindow::save() {
  const std::string path = session_->path().string();
  if (path.empty())
    return tell(
        {Notice::Kind::Said, say("There is nothing to save yet: the first step makes a file, and each one is in "
                                 "it at once.")});
  if (session_->readOnly())
    return tell({Notice::Kind::Refused, say("This garment was opened for reading only; keep a copy to work on it.")});
  if (!session_->draft()) return tell({Notice::Kind::Said, say("Saved: every step is on the disk, in “{0}”.", path)});
  auto* box = new QMessageBox(
      QMessageBox::Information, "Karinui",
      inWords(
          say("Saved: every step is on the disk, in the draft “{0}”. Save as gives it a name and a place of its own.",
              path)),
      QMessageBox::NoButton, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* as = box->addButton(inWords(say("Save as…")), QMessageBox::AcceptRole);
  box->setEscapeButton(box->addButton(inWords(say("Leave it a draft")), QMessageBox::RejectRole));
  box->setDefaultButton(as);
  connect(as, &QPushButton::clicked, this, &MainWindow::askSaveAs, Qt::QueuedConnection);
  box->open();
}

void MainWindow::askSaveAs() {
  const QString name = session_->draft() || session_->path().empty()
                           ? inWords(say("my garment"))
                           : QString::fromStdString(session_->path().stem().string());
  const QString path = askToWrite(this, inWords(say("Save as")), freshPath(name),
                                  filterReading("Karinui", {FileContent::Document}), endingsOf(fileFormat("document")));
  if (path.isEmpty()) return;
  session_->saveAs(path.toStdString());
  refresh();
}

// After the garment. A draft has a name, too.
QString MainWindow::called(const Message& what) const {
  return !session_->path().empty() ? QString::fromStdString(session_->path().stem().string()) + " – " + inWords(what)
                                   : inWords(what);
}
QString MainWindow::proposed(const Message& what, const FileFormat& format) const {
  return freshPath(called(what), format);
}

void MainWindow::askExport() {
  ExportDialog dialog(*session_, *space_, this);
  if (dialog.exec() != QDialog::Accepted) return;
  const ExportWish wish = dialog.wish();
  const QString path = askToWrite(this, inWords(say("Export")), proposed(say("pattern"), *wish.format),
                                  filterWriting(*wish.format), endingsOf(*wish.format));
  if (path.isEmpty()) return;
  session_->exportTo(path.toStdString(), wish);
  refresh();
}

void MainWindow::askShare() {
  const Document& document = session_->snapshot().document;
  if (document.pattern.pieces.empty()) {
    session_->refuse(refused(say("There is no piece yet; draw one on the body.")));
    return refresh();
  }
  ShareDialog dialog(document, this);
  if (dialog.exec() != QDialog::Accepted) return;
  const QString path =
      askToWrite(this, inWords(say("Share the pattern")), proposed(say("pattern to share"), fileFormat("document")),
                 filterReading("Karinui", {FileContent::Document}), endingsOf(fileFormat("document")));
  if (path.isEmpty()) return;
  session_->shareTo(path.toStdString(), dialog.names());
  refresh();
}

void MainWindow::picture() {
  PictureDialog dialog(*session_, *space_, this);
  if (dialog.exec() != QDialog::Accepted) return;
  if (dialog.frames() > 0) return turntable(dialog);
  const FileFormat& format = fileFormat("png");
  const QString path = askToWrite(this, inWords(say("Picture of the fitting…")), proposed(say("fitting"), format),
                                  filterWriting(format), endingsOf(format));
  if (path.isEmpty()) return;
  if (const Done done = dialog.write(path.toStdString()); !done)
    tell({Notice::Kind::Refused, done.error().what});
  else
    tell({Notice::Kind::Said, say("“{0}” was written.", path.toStdString())});
}

// In a folder of its own within the one that is chosen.
void MainWindow::turntable(const PictureDialog& dialog) {
  const QString beside = QFileInfo(freshPath(called(say("turntable")))).absolutePath();
  const QString where = QFileDialog::getExistingDirectory(this, inWords(say("Folder for the turntable")), beside);
  if (where.isEmpty()) return;
  QString folder = QDir(where).filePath(called(say("turntable")));
  for (int k = 2; QDir(folder).exists(); ++k)
    folder = QDir(where).filePath(called(say("turntable")) + QString(" %1").arg(k));
  const auto drawing = [&](int drawn) {
    return say("Drawing the turntable: picture {0} of {1}", std::min(drawn + 1, dialog.frames()), dialog.frames());
  };
  WritingProgress progress(drawing(0), say("Picture of the fitting"), dialog.frames(), this);
  progress.setObjectName("turntable_progress");
  const auto written = dialog.writeTurn(folder.toStdString(), [&](int drawn) {
    progress.setLabelText(inWords(drawing(drawn)));
    progress.setValue(drawn);  // handles what is clicked meanwhile
    return !progress.wasCanceled();
  });
  progress.reset();
  if (!written) return tell({Notice::Kind::Refused, written.error().what});
  if (*written < dialog.frames())
    tell({Notice::Kind::Said,
          say("Stopped: {0} of {1} pictures are in “{2}”.", *written, dialog.frames(), folder.toStdString())});
  else
    tell({Notice::Kind::Said, say("{0} pictures of a whole turn are in “{1}”.", *written, folder.toStdString())});
}

void MainWindow::print() {
  QPrinter printer(QPrinter::HighResolution);
  printer.setDocName(called(say("pattern")));  // in the printer's list, and of a file it is printed into
  QPrintDialog dialog(&printer, this);
  QCheckBox* pairs = pairsOnceBox();
  pairs->setWindowTitle(inWords(say("Pattern")));  // the tab's
  dialog.setOptionTabs({pairs});
  if (dialog.exec() == QDialog::Accepted) printOn(printer, pairs->isChecked());
}

void MainWindow::printOn(QPrinter& printer, bool pairsOnce) {
  QSizeF paper = printer.pageLayout().fullRect(QPageLayout::Millimeter).size();
  ExportWish wish;
  const auto is = [&](double width, double height) {
    return std::fabs(paper.width() - width) < 2 && std::fabs(paper.height() - height) < 2;
  };
  if (is(279.4, 215.9) || is(297, 210) || is(420, 297)) {  // the sheets to be glued stand upright
    printer.setPageOrientation(QPageLayout::Portrait);
    paper.transpose();
  }
  // Paper larger than A4 by half is a roll or a plotter's: then one sheet.
  wish.format = &fileFormat(paper.width() > 1.5 * 297 ? "pdf"
                            : is(215.9, 279.4)        ? "pdf-letter"
                            : is(297, 420)            ? "pdf-a3"
                                                      : "pdf-a4");
  wish.sheet.date = QDate::currentDate().toString(Qt::ISODate).toStdString();
  wish.sheet.language = Theme::here().language();
  wish.sheet.pairsOnce = pairsOnce;
  if (const auto stem = session_->path().stem().string(); !stem.empty()) wish.sheet.title = stem;
  const auto pages = paperOf(session_->snapshot(), wish);
  if (!pages) return tell({Notice::Kind::Refused, pages.error().what});
  // Into a file go the lines themselves, not dots of a printer: a hundredth of the size, with its layers.
  if (printer.outputFormat() == QPrinter::PdfFormat && !printer.outputFileName().isEmpty() &&
      printer.printRange() == QPrinter::AllPages) {
    const auto written =
        exportedTo(printer.outputFileName().toStdString(), session_->snapshot(), session_->steps(), wish);
    if (!written) return tell({Notice::Kind::Refused, written.error().what});
    return tell({Notice::Kind::Said, say("{0} {0|page was|pages were} printed.", pages->count())});
  }
  constexpr int kWhole = 1000;
  WritingProgress progress(say("Printing the pattern"), say("Print"), kWhole, this);
  const auto printed = printPages(*pages, printer, [&](double share) {
    progress.setValue(static_cast<int>(kWhole * share));  // handles what is clicked meanwhile
    return !progress.wasCanceled();
  });
  progress.reset();
  if (printed)
    tell({Notice::Kind::Said, say("{0} {0|page was|pages were} printed.", *printed)});
  else if (printed.error().kind == Error::Kind::Cancelled)
    tell({Notice::Kind::Said, say("Stopped; not all pages were printed.")});
  else
    tell({Notice::Kind::Refused, printed.error().what});
}

}  // namespace karinui::studio

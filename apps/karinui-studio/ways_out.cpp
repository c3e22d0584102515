// What leaves the window: copies, exports, pictures, paper.
#include <QFileDialog>
#include <QPrintDialog>
#include <QPrinter>

#include "export_dialog.h"
#include "look.h"
#include "main_window.h"
#include "paper.h"
#include "picture_dialog.h"

namespace karinui::studio {

void MainWindow::askSaveCopy() {
  QString path =
      QFileDialog::getSaveFileName(this, inWords(say("Keep a copy as")), freshPath("garment"), "Karinui (*.karinui)");
  if (path.isEmpty()) return;
  if (!path.endsWith(".karinui")) path += ".karinui";
  session_->saveCopy(path.toStdString());
  refresh();
}

void MainWindow::askExport() {
  ExportDialog dialog(*session_, *space_, this);
  if (dialog.exec() != QDialog::Accepted) return;
  const ExportWish wish = dialog.wish();
  const QString ending = QString::fromStdString(std::string(info(wish.kind).ending));
  QString path = QFileDialog::getSaveFileName(this, inWords(say("Export")),
                                              freshPath("pattern").replace(".karinui", "." + ending), "*." + ending);
  if (path.isEmpty()) return;
  if (!path.endsWith("." + ending)) path += "." + ending;
  session_->exportTo(path.toStdString(), wish);
  refresh();
}

void MainWindow::picture() {
  PictureDialog dialog(*session_, *space_, this);
  if (dialog.exec() != QDialog::Accepted) return;
  QString path = QFileDialog::getSaveFileName(this, inWords(say("Picture of the fitting…")),
                                              freshPath("fitting").replace(".karinui", ".png"), "*.png");
  if (path.isEmpty()) return;
  if (!path.endsWith(".png")) path += ".png";
  if (const Done done = dialog.write(path.toStdString()); !done)
    tell({Notice::Kind::Refused, done.error().what});
  else
    tell({Notice::Kind::Said, say("“{0}” was written.", path.toStdString())});
}

void MainWindow::print() {
  QPrinter printer(QPrinter::HighResolution);
  QPrintDialog dialog(&printer, this);
  if (dialog.exec() == QDialog::Accepted) printOn(printer);
}

void MainWindow::printOn(QPrinter& printer) {
  // Paper larger than A4 by half is a roll or a plotter's: then one sheet.
  const QSizeF paper = printer.pageLayout().fullRect(QPageLayout::Millimeter).size();
  ExportWish wish;
  wish.kind = paper.width() > 1.5 * 297 ? ExportKind::PdfSheet : ExportKind::PdfA4;
  wish.sheet.language = Look::here().language();
  if (const auto stem = session_->path().stem().string(); !stem.empty()) wish.sheet.title = stem;
  const auto pages = paperOf(session_->fitting(), wish);
  const Done done = pages ? printPages(*pages, printer) : Done(pages.error());
  if (!done) tell({Notice::Kind::Refused, done.error().what});
}

}  // namespace karinui::studio

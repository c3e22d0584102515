// What leaves the window: copies, exports, pictures, paper.
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QPainter>
#include <QPrintDialog>
#include <QPrinter>
#include <cmath>

#include "length_box.h"
#include "look.h"
#include "main_window.h"

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
  QDialog dialog(this);
  dialog.setWindowTitle(inWords(say("Export")));
  auto* form = new QFormLayout(&dialog);
  form->setContentsMargins(24, 24, 24, 20);
  form->setSpacing(12);
  auto* kind = new QComboBox;
  const std::pair<const char*, Message> kinds[] = {{"pdf", say("Paper pattern, true size (PDF)")},
                                                   {"svg", say("Paper pattern (SVG)")},
                                                   {"glb", say("Garment in 3D (GLB)")},
                                                   {"obj", say("Garment in 3D (OBJ)")},
                                                   {"json", say("Pattern, exact (JSON)")},
                                                   {"ops", say("The steps as text")}};
  for (const auto& [ending, words] : kinds) kind->addItem(inWords(words), ending);
  auto* paper = new QComboBox;
  paper->addItems({inWords(say("one large sheet")), inWords(say("A4 sheets to glue"))});
  auto* allowance = new LengthBox(say("Seam allowance"), 0, 0.1);
  allowance->setMetres(0.010);
  form->addRow(inWords(say("What")), kind);
  form->addRow(inWords(say("Paper")), paper);
  form->addRow(inWords(say("Seam allowance")), allowance);
  const auto enable = [=] {
    const QString e = kind->currentData().toString();
    paper->setEnabled(e == "pdf");
    allowance->setEnabled(e == "pdf" || e == "svg");
  };
  connect(kind, &QComboBox::currentIndexChanged, &dialog, enable);
  enable();
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel);
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  if (dialog.exec() != QDialog::Accepted) return;
  const QString ending = kind->currentData().toString();
  QString path = QFileDialog::getSaveFileName(this, inWords(say("Export")),
                                              freshPath("pattern").replace(".karinui", "." + ending), "*." + ending);
  if (path.isEmpty()) return;
  if (!path.endsWith("." + ending)) path += "." + ending;
  session_->exportTo(path.toStdString(), allowance->value(), paper->currentIndex() == 1, Look::here().language());
  refresh();
}

void MainWindow::picture() {
  const QString path = QFileDialog::getSaveFileName(this, inWords(say("Picture of the fitting…")),
                                                    freshPath("fitting").replace(".karinui", ".png"), "*.png");
  if (!path.isEmpty() && !space_->grabFramebuffer().save(path))
    tell({Notice::Kind::Refused, say("“{0}” could not be written.", path.toStdString())});
}

// True size: each page of the printer shows its own part of the table.
void MainWindow::print() {
  QPrinter printer(QPrinter::HighResolution);
  printer.setFullPage(true);
  QPrintDialog dialog(&printer, this);
  if (dialog.exec() != QDialog::Accepted) return;
  const double dots = printer.resolution() / 0.0254;
  const QRectF page = printer.pageLayout().paintRect(QPageLayout::Millimeter);
  const double wide = page.width() / 1000 - 0.02, high = page.height() / 1000 - 0.02;
  Box box;
  const Fitting& fitting = session_->fitting();
  for (const auto& worn : fitting.worn)
    for (const Flat p : worn.ring)
      box.include({p.u + session_->table().at(worn.id).u, p.v + session_->table().at(worn.id).v, 0});
  if (box.empty()) return tell({Notice::Kind::Refused, say("There is no piece yet; draw one on the body.")});
  QPainter painter(&printer);
  const int columns = static_cast<int>(std::ceil(box.size().x / wide)),
            rows = static_cast<int>(std::ceil(box.size().y / high));
  bool first = true;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      if (!first) printer.newPage();
      first = false;
      const double left = box.low.x + c * wide, top = box.high.y - r * high;
      const auto at = [&](Flat p) { return QPointF((p.u - left + 0.01) * dots, (top - p.v + 0.01) * dots); };
      painter.setPen(QPen(Qt::black, 0.0005 * dots));
      for (const auto& worn : fitting.worn) {
        QPolygonF line;
        for (const Flat p : worn.ring) line << at(p + session_->table().at(worn.id));
        painter.drawPolygon(line);
        painter.drawText(at(session_->table().at(worn.id) + worn.ring.front()) + QPointF(0.01 * dots, -0.01 * dots),
                         QString::fromStdString(fitting.document.find(worn.id)->name));
      }
      painter.setPen(QPen(Qt::gray, 0.0002 * dots, Qt::DashLine));
      painter.drawRect(QRectF(0.01 * dots, 0.01 * dots, wide * dots, high * dots));
      painter.drawText(QPointF(0.014 * dots, 0.018 * dots), QString("%1%2").arg(QChar('A' + r)).arg(c + 1));
      if (r == 0 && c == 0)
        painter.drawRect(QRectF(0.03 * dots, 0.03 * dots, 0.1 * dots, 0.1 * dots));  // 100 mm to check
    }
}

}  // namespace karinui::studio

// Garments, patterns and bodies that come into the window.
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QTabWidget>

#include "look.h"
#include "main_window.h"

namespace karinui::studio {

QString MainWindow::freshPath(const QString& name) const {
  QDir folder(QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation));
  folder.mkpath("Karinui");
  folder.cd("Karinui");
  for (int n = 1;; ++n) {
    const QString path = folder.filePath(n == 1 ? name + ".karinui" : QString("%1 %2.karinui").arg(name).arg(n));
    if (!QFileInfo::exists(path)) return path;
  }
}

void MainWindow::remember(const QString& path) {
  QSettings settings;
  QStringList all = settings.value("recent").toStringList();
  all.removeAll(path);
  all.prepend(path);
  settings.setValue("recent", all.mid(0, 9));
}

void MainWindow::fillRecent() {
  recent_->clear();
  for (const QString& path : QSettings().value("recent").toStringList()) {
    QAction* one = recent_->addAction(QFileInfo(path).completeBaseName() + "   " + QFileInfo(path).absolutePath());
    connect(one, &QAction::triggered, this, [this, path] { openPath(path); });
  }
}

void MainWindow::openPath(const QString& path) {
  const QString ending = QFileInfo(path).suffix().toLower();
  const std::filesystem::path file = path.toStdString();
  if (ending == "karinui") {
    session_->open(file);
  } else if (ending == "obj" || ending == "ply" || ending == "glb" || ending == "gltf" || ending == "stl") {
    session_->importBody(file);
  } else if (ending == "ops" && session_->path().empty()) {
    session_->create(freshPath(QFileInfo(path).completeBaseName()).toStdString());
    session_->importPattern(file);
  } else {
    session_->importPattern(file);
  }
  refresh();
}

void MainWindow::newGarment(const std::string& size, const QString& path) {
  session_->create(path.toStdString());
  SetBody body;
  body.size = size;
  session_->perform(body);
  boards_->setCurrentIndex(0);
  refresh();
}

void MainWindow::askNew() {
  QDialog dialog(this);
  dialog.setWindowTitle(inWords(say("New garment")));
  auto* form = new QFormLayout(&dialog);
  form->setContentsMargins(24, 24, 24, 20);
  form->setSpacing(12);
  auto* name = new QLineEdit(inWords(say("my garment")));
  auto* size = new QComboBox;
  for (const std::string_view s : builtInSizes())
    size->addItem(QString::fromUtf8(s.data(), static_cast<int>(s.size())).toUpper());
  form->addRow(inWords(say("Name")), name);
  form->addRow(inWords(say("Figure")), size);
  auto* note =
      new QLabel(inWords(say("Measurements can be typed in the body panel at any time. Every step is saved at once.")));
  note->setWordWrap(true);
  note->setProperty("role", "faint");
  form->addRow(note);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Ok)->setText(inWords(say("Begin")));
  buttons->button(QDialogButtonBox::Cancel)->setText(inWords(say("Cancel")));
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  if (dialog.exec() != QDialog::Accepted) return;
  newGarment(std::string(builtInSizes()[static_cast<std::size_t>(size->currentIndex())]),
             freshPath(name->text().trimmed().isEmpty() ? "garment" : name->text().trimmed().replace('/', '-')));
}

void MainWindow::askOpen() {
  const QString path = QFileDialog::getOpenFileName(this, inWords(say("Open")), {}, "Karinui (*.karinui)");
  if (!path.isEmpty()) openPath(path);
}

void MainWindow::askImport() {
  const QString path = QFileDialog::getOpenFileName(
      this, inWords(say("Import")), {},
      inWords(say("Bodies and patterns")) + " (*.obj *.ply *.glb *.gltf *.json *.svg *.ops)");
  if (!path.isEmpty()) openPath(path);
}

void MainWindow::askReplay(const SetBody& body) {
  const QString base = QFileInfo(QString::fromStdString(session_->path().string())).completeBaseName();
  const QString path = freshPath((base.isEmpty() ? "garment" : base) + " – " +
                                 QString::fromStdString(body.size.empty() ? "measured" : body.size));
  session_->replayOn(body, path.toStdString());
  refresh();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) openPath(url.toLocalFile());
}

}  // namespace karinui::studio

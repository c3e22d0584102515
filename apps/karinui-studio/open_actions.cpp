// Garments, patterns and bodies that come into the window.
#include <QComboBox>
#include <QCoreApplication>
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
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QTabWidget>
#include <cmath>
#include <tuple>

#include "drafts.h"
#include "file_filter.h"
#include "karinui/design/glossary.h"
#include "karinui/exchange/read_body.h"
#include "main_window.h"
#include "measures_file.h"
#include "size_box.h"
#include "start_page.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// Installed beside the program, else those of the sources it was built from.
QString examplesFolder() {
  const QDir here(QCoreApplication::applicationDirPath());
  const QString installed = here.filePath("../share/karinui/examples");
  return QDir(installed).exists() ? installed : here.filePath("../../../examples");
}

// What was dropped is read where it is: a program that is told of a move may delete it.
void takeCopy(QDropEvent& event) {
  event.setDropAction(Qt::CopyAction);
  event.accept();
}

}  // namespace

QString MainWindow::freshPath(const QString& name, const FileFormat& format) const {
  const QDir folder(QString::fromStdString(documentsFolder().string()));
  folder.mkpath(".");
  const QString ending = QString::fromStdString("." + std::string(format.endings.front()));
  for (int n = 1;; ++n) {
    const QString path = folder.filePath((n == 1 ? name : QString("%1 %2").arg(name).arg(n)) + ending);
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
    if (!QFileInfo::exists(path)) continue;  // a draft that moved
    QAction* one = recent_->addAction(QFileInfo(path).completeBaseName() + "   " + QFileInfo(path).absolutePath());
    connect(one, &QAction::triggered, this, [this, path] { openPath(path); });
  }
}

void MainWindow::openPath(const QString& path) {
  const std::filesystem::path file = path.toStdString();
  const QString ending = QFileInfo(path).suffix().toLower();
  if (ending == "png" || ending == "jpg" || ending == "jpeg") return session_->importScan(file);
  const FileContent content = contentOf(file);
  if (content == FileContent::None) {
    const Error why = unreadable(file, {FileContent::Document, FileContent::Body, FileContent::Pattern,
                                        FileContent::Script, FileContent::Measures});
    return tell({Notice::Kind::Refused,
                 say("{0} Photographs (.png, .jpg, .jpeg) are laid under the pattern, to be traced.", why.what)});
  }
  if (atStart()) start_->leave();  // it may be reading this very file
  if (content == FileContent::Document) {
    session_->open(file);
  } else if (content == FileContent::Body) {
    session_->importBody(file);
  } else if (content == FileContent::Measures) {
    wearMeasures(*session_, file);
  } else {
    session_->importPattern(file);
  }
  refresh();
}

void MainWindow::offerRescue(const std::filesystem::path& damaged) {
  auto* box = new QMessageBox(
      QMessageBox::Warning, "Karinui",
      inWords(
          say("“{0}” is damaged and was not opened. What is whole of it can be saved in a new document; the damaged "
              "one stays as it is.",
              damaged.filename().string())),
      QMessageBox::NoButton, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* save = box->addButton(inWords(say("Save what is whole…")), QMessageBox::AcceptRole);
  box->setEscapeButton(box->addButton(inWords(say("Cancel")), QMessageBox::RejectRole));
  box->setDefaultButton(save);
  connect(
      save, &QPushButton::clicked, this, [this, damaged] { askRescue(damaged); }, Qt::QueuedConnection);
  box->open();
}

void MainWindow::offerSkin(const std::filesystem::path& body) {
  auto* box = new QMessageBox(
      QMessageBox::Question, "Karinui",
      inWords(
          say("The surface of “{0}” has holes, as scans often have, and it was not read. A watertight skin can be laid "
              "over it, which closes them; what is finer than {1} is lost.",
              body.filename().string(), lengthText(BodyReadOptions().wrapCell).toStdString())),
      QMessageBox::NoButton, this);
  box->setObjectName("offer_skin");
  box->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* wrap = box->addButton(inWords(say("Lay a skin over it")), QMessageBox::AcceptRole);
  box->setEscapeButton(box->addButton(inWords(say("Cancel")), QMessageBox::RejectRole));
  box->setDefaultButton(wrap);
  connect(
      wrap, &QPushButton::clicked, this,
      [this, body] {
        if (atStart()) start_->leave();
        session_->importBody(body, true);
        refresh();
      },
      Qt::QueuedConnection);
  box->open();
}

void MainWindow::askUnit(const GuessedUnit& guessed) {
  auto* dialog = new QDialog(this);
  dialog->setObjectName("ask_unit");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(inWords(say("Unit of the pattern")));
  auto* words =
      new QLabel(inWords(say("“{0}” does not tell what a unit of it is. How long is its longest piece, up or across?",
                             guessed.file.filename().string())));
  words->setWordWrap(true);
  auto* lengths = new QComboBox;
  lengths->setObjectName("unit");
  for (const auto& [name, metres, called] : {std::tuple<const char*, double, Message>{"mm", 0.001, say("millimetres")},
                                             {"cm", 0.01, say("centimetres")},
                                             {"m", 1, say("metres")},
                                             {"in", 0.0254, say("inches")},
                                             {"pt", 0.0254 / 72, say("points, 72 to the inch (Illustrator)")},
                                             {"px", 0.0254 / 96, say("pixels, 96 to the inch")}}) {
    const bool read = std::abs(metres - guessed.unit) < 1e-9;
    if (name == std::string_view("px") && !read) continue;
    lengths->addItem(lengthText(guessed.longest / guessed.unit * metres) + " – " + inWords(called), name);
    if (read) lengths->setCurrentIndex(lengths->count() - 1);
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok);
  auto* form = new QFormLayout(dialog);
  form->addRow(words);
  form->addRow(lengths);
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  connect(dialog, &QDialog::accepted, this, [this, guessed, lengths, as = lengths->currentIndex()] {
    if (lengths->currentIndex() == as) return;
    session_->readAgain(guessed, lengths->currentData().toString().toStdString());
    refresh();
  });
  dialog->open();
  lengths->setFocus();
}

void MainWindow::askRescue(const std::filesystem::path& damaged) {
  const QString name = inWords(say("{0} – rescued", damaged.stem().string()));  // beside the person's other documents
  // One that is there is never written over: that is refused, in a sentence.
  const QString path = QFileDialog::getSaveFileName(this, inWords(say("Save what is whole")), freshPath(name),
                                                    filterReading("Karinui", {FileContent::Document}), nullptr,
                                                    QFileDialog::DontConfirmOverwrite);
  if (path.isEmpty()) return;
  if (atStart()) start_->leave();
  session_->rescueTo(damaged, withEnding(path, fileFormat("document")).toStdString());
  refresh();
}

void MainWindow::newGarment(const std::string& size, const QString& path) {
  // Its first step makes it a draft, also where no file can be made as wished; what was open is left alone.
  session_->begin(DocumentFile::inMemory());
  if (!path.isEmpty()) session_->create(path.toStdString());
  SetBody body;
  body.size = size;
  session_->perform(body);
  boards_->setCurrentIndex(0);
  refresh();
}

void MainWindow::openExample(const QString& name) {
  session_->begin(DocumentFile::inMemory());
  session_->importPattern(QDir(examplesFolder()).filePath(name + ".ops").toStdString());
  refresh();
}

void MainWindow::askNew() {
  QDialog dialog(this);
  dialog.setWindowTitle(inWords(say("New garment")));
  auto* form = new QFormLayout(&dialog);
  form->setContentsMargins(24, 24, 24, 20);
  form->setSpacing(12);
  auto* name = new QLineEdit;
  name->setPlaceholderText(inWords(say("may be given later, with Save as")));
  constexpr int kFrame = 26;  // pixels
  name->ensurePolished();
  name->setMinimumWidth(name->fontMetrics().horizontalAdvance(name->placeholderText()) + kFrame);
  auto* size = new QComboBox;
  addSizes(*size);
  chooseSize(*size, kUsualSize);
  form->addRow(inWords(say("Name")), name);
  form->addRow(inWords(say("Figure")), size);
  auto* note = new QLabel(
      inWords(say("Measures can be typed on the board Body at any time. Every step is saved at once; without a name it "
                  "is a draft.")));
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
  const QString called = name->text().trimmed().replace('/', '-');
  newGarment(chosenSize(*size), called.isEmpty() ? QString() : freshPath(called));
}

void MainWindow::askOpen() {
  const QString path =
      QFileDialog::getOpenFileName(this, inWords(say("Open")), {}, filterReading("Karinui", {FileContent::Document}));
  if (!path.isEmpty()) openPath(path);
}

void MainWindow::askImport() {
  const QString path = QFileDialog::getOpenFileName(
      this, inWords(say("Import")), {},
      filterReading(inWords(say("Bodies and patterns")),
                    {FileContent::Body, FileContent::Pattern, FileContent::Script, FileContent::Measures}));
  if (!path.isEmpty()) openPath(path);
}

void MainWindow::askScan() {
  const QString path = QFileDialog::getOpenFileName(this, inWords(say("Lay a scan under the pattern")), {},
                                                    inWords(say("Photographs")) + " (*.png *.jpg *.jpeg)");
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
  if (event->mimeData()->hasUrls()) takeCopy(*event);
}

void MainWindow::dropEvent(QDropEvent* event) {
  takeCopy(*event);
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) openPath(url.toLocalFile());
}

}  // namespace karinui::studio

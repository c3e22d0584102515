#include "main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QPainter>
#include <QPrintDialog>
#include <QPrinter>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QSplitter>
#include <QStandardPaths>
#include <QStatusBar>
#include <QTabWidget>
#include <QToolBar>

#include "guide.h"
#include "karinui/base/number.h"
#include "look.h"

namespace karinui::studio {

MainWindow::MainWindow(int threads) {
  SessionOptions options;
  options.threads = threads;
  wake_.setSingleShot(true);
  wake_.setInterval(0);
  connect(&wake_, &QTimer::timeout, this, &MainWindow::refresh);
  options.wake = [this] {
    QMetaObject::invokeMethod(
        &wake_,
        [this] {
          if (!wake_.isActive()) wake_.start();
        },
        Qt::QueuedConnection);
  };
  session_ = std::make_unique<Session>(options);
  session_->setLanguage(Look::here().language());

  space_ = new SpaceView(*session_, clockwork_);
  table_ = new TableView(*session_, clockwork_);
  auto* split = new QSplitter(Qt::Horizontal);
  split->setHandleWidth(1);
  split->addWidget(space_);
  split->addWidget(table_);
  boards_ = new QTabWidget;
  boards_->setDocumentMode(true);
  boards_->setMinimumWidth(300);
  boards_->setMaximumWidth(420);
  auto* garment = new GarmentPanel(*session_);
  auto* body = new BodyPanel(*session_);
  auto* fabric = new FabricPanel(*session_);
  auto* fit = new FitPanel(*session_, *space_);
  auto* history = new HistoryPanel(*session_);
  const std::pair<Panel*, Message> boards[] = {{garment, say("Garment")},
                                               {body, say("Body")},
                                               {fabric, say("Fabric")},
                                               {fit, say("Fit")},
                                               {history, say("Steps")}};
  for (const auto& [panel, words] : boards) {
    panels_.push_back(panel);
    const int at = boards_->addTab(panel, QString());
    Look::here().keep(panel, [this, at, words = words] { boards_->setTabText(at, inWords(words)); });
  }
  split->addWidget(boards_);
  split->setStretchFactor(0, 5);
  split->setStretchFactor(1, 4);
  split->setStretchFactor(2, 0);
  split->setSizes({760, 520, 320});
  setCentralWidget(split);

  hint_ = new QLabel;
  hint_->setObjectName("hint");
  place_ = new QLabel;
  progress_ = new QProgressBar;
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setFixedWidth(150);
  progress_->hide();
  statusBar()->addWidget(hint_, 1);
  statusBar()->addPermanentWidget(place_);
  statusBar()->addPermanentWidget(progress_);
  statusBar()->setSizeGripEnabled(false);
  connect(table_, &TableView::pointed, this,
          [this](Flat p) { place_->setText(lengthText(p.u, inches_) + "  " + lengthText(p.v, inches_)); });

  toast_ = new QLabel(space_);
  toast_->setObjectName("toast");
  toast_->setWordWrap(true);
  toast_->setAlignment(Qt::AlignCenter);
  toast_->setAttribute(Qt::WA_TransparentForMouseEvents);
  toast_->hide();
  toastTime_.setSingleShot(true);
  connect(&toastTime_, &QTimer::timeout, toast_, &QLabel::hide);

  makeActions();
  makeMenus();
  connect(body, &BodyPanel::importAsked, this, &MainWindow::askImport);
  connect(body, &BodyPanel::replayAsked, this, &MainWindow::askReplay);
  connect(space_, &SpaceView::failed, this, [this](const QString& why) { statusBar()->showMessage(why); });
  space_->installEventFilter(this);
  table_->installEventFilter(this);
  setAcceptDrops(true);
  resize(1500, 920);
  const QSettings settings;
  if (settings.contains("window")) restoreGeometry(settings.value("window").toByteArray());
  connect(&Look::here(), &Look::changed, this, [this] {
    session_->setLanguage(Look::here().language());
    seen_.history = ~0ull;
    refresh();
  });
  refresh();
}

MainWindow::~MainWindow() {
  session_->command(Command::Cancel);
  // The views look at the session until they are gone.
  delete centralWidget();
}

void MainWindow::makeActions() {
  const QSettings settings;
  for (const CommandInfo& about : commands()) {
    auto* action = new QAction(this);
    const QString name = QString::fromUtf8(about.name.data(), static_cast<int>(about.name.size()));
    action->setObjectName(name);
    const QString usual = QString::fromUtf8(about.key.data(), static_cast<int>(about.key.size()));
    action->setShortcut(QKeySequence(settings.value("keys/" + name, usual).toString()));
    action->setShortcutContext(Qt::WindowShortcut);
    action->setCheckable(isTool(about.command));
    Look::here().keep(action, about.label, about.hint, about.icon);
    connect(action, &QAction::triggered, this, [this, c = about.command] { run(c); });
    addAction(action);
    actions_[about.command] = action;
  }
}

void MainWindow::run(Command command) {
  session_->command(command);
  refresh();
}

void MainWindow::makeMenus() {
  const auto menu = [this](const Message& words) {
    QMenu* made = menuBar()->addMenu(QString());
    Look::here().keep(made, [made, words] { made->setTitle(inWords(words)); });
    return made;
  };
  const auto add = [this](QMenu* to, const Message& words, const char* icon, const char* key, auto&& what) {
    QAction* action = to->addAction(QString());
    if (*key) action->setShortcut(QKeySequence(QString::fromLatin1(key)));
    Look::here().keep(action, words, words, icon);
    connect(action, &QAction::triggered, this, what);
    return action;
  };
  QMenu* file = menu(say("File"));
  QAction* fresh = add(file, say("New garment…"), "new", "Ctrl+N", [this] { askNew(); });
  QAction* open = add(file, say("Open…"), "open", "Ctrl+O", [this] { askOpen(); });
  recent_ = file->addMenu(QString());
  Look::here().keep(recent_, [this] { recent_->setTitle(inWords(say("Recent"))); });
  connect(recent_, &QMenu::aboutToShow, this, &MainWindow::fillRecent);
  QMenu* examples = file->addMenu(QString());
  Look::here().keep(examples, [examples] { examples->setTitle(inWords(say("Examples"))); });
  for (const char* name : {"first_tunic", "six_operations", "kyoto_fitting", "shirt_fitting"}) {
    QAction* one = examples->addAction(QString(name).replace('_', ' '));
    connect(one, &QAction::triggered, this, [this, name] {
      session_->create(freshPath(name).toStdString());
      session_->importPattern(QString(KARINUI_EXAMPLES "/%1.ops").arg(name).toStdString());
      refresh();
    });
  }
  file->addSeparator();
  add(file, say("Keep a copy as…"), "", "Ctrl+Shift+S", [this] { askSaveCopy(); });
  add(file, say("Import…"), "", "Ctrl+I", [this] { askImport(); });
  QAction* out = add(file, say("Export…"), "export", "Ctrl+E", [this] { askExport(); });
  add(file, say("Picture of the fitting…"), "", "", [this] { picture(); });
  add(file, say("Print the pattern…"), "print", "Ctrl+P", [this] { print(); });
  file->addSeparator();
  add(file, say("Close"), "", "Ctrl+Q", [this] { close(); });

  QMenu* edit = menu(say("Edit"));
  for (const Command c : {Command::Undo, Command::Redo}) edit->addAction(actions_[c]);
  edit->addSeparator();
  for (const Command c : {Command::Remove, Command::Duplicate, Command::Mirror, Command::Freeze, Command::FlipSeam})
    edit->addAction(actions_[c]);
  edit->addSeparator();
  add(edit, say("Keys…"), "", "", [this] { keysDialog(); });

  QMenu* work = menu(say("Work"));
  for (const CommandInfo& about : commands())
    if (isTool(about.command)) work->addAction(actions_[about.command]);
  work->addSeparator();
  work->addAction(actions_[Command::Settle]);
  work->addAction(actions_[Command::Confirm]);
  work->addAction(actions_[Command::Cancel]);

  viewMenu_ = menu(say("View"));
  for (const Command c : {Command::ViewFront, Command::ViewBack, Command::ViewLeft, Command::ViewRight,
                          Command::ViewOblique, Command::ViewAll})
    viewMenu_->addAction(actions_[c]);
  viewMenu_->addSeparator();
  const auto map = [&](const Message& words, const char* key, FitMap which) {
    QAction* action = add(viewMenu_, words, "fit", key, [this, which] {
      space_->setMap(space_->map() == which ? FitMap::None : which);
      refresh();
    });
    (void)action;
  };
  map(say("Strain map"), "Alt+7", FitMap::Strain);
  map(say("Distance to the body"), "Alt+8", FitMap::Ease);
  viewMenu_->addSeparator();
  QAction* dark = add(viewMenu_, say("Dark"), "", "", [] { Look::here().setDark(!Look::here().dark()); });
  dark->setObjectName("dark");
  QAction* inches = add(viewMenu_, say("Inches"), "", "", [this] {
    inches_ = !inches_;
    table_->setInches(inches_);
  });
  inches->setCheckable(true);
  QAction* blender = add(viewMenu_, say("Mouse as in Blender"), "", "", [this] {
    const bool on = !QSettings().value("blender").toBool();
    QSettings().setValue("blender", on);
    space_->setBlenderKeys(on);
  });
  blender->setCheckable(true);
  blender->setChecked(QSettings().value("blender").toBool());
  space_->setBlenderKeys(blender->isChecked());
  viewMenu_->addSeparator();
  QAction* english = viewMenu_->addAction("English");
  QAction* japanese = viewMenu_->addAction(QString::fromUtf8("日本語"));
  english->setObjectName("english");
  japanese->setObjectName("japanese");
  connect(english, &QAction::triggered, this, [] { Look::here().setLanguage(Language::English); });
  connect(japanese, &QAction::triggered, this, [] { Look::here().setLanguage(Language::Japanese); });

  QMenu* help = menu(say("Help"));
  add(help, say("A first garment, step by step"), "", "F1", [this] { startGuide(); });
  add(help, say("About Karinui"), "", "", [this] {
    QMessageBox::about(
        this, "Karinui",
        inWords(say("Karinui: made-to-measure clothes designed on the body, draped, and cut to paper patterns. "
                    "Apache-2.0; built with Qt (LGPL). Nothing is ever sent over a network.")));
  });

  top_ = addToolBar("top");
  top_->setMovable(false);
  top_->setIconSize(QSize(22, 22));
  for (QAction* a : {fresh, open, out}) top_->addAction(a);
  top_->addSeparator();
  top_->addAction(actions_[Command::Undo]);
  top_->addAction(actions_[Command::Redo]);
  top_->addSeparator();
  top_->addAction(actions_[Command::Settle]);
  top_->addSeparator();
  top_->addAction(actions_[Command::ViewOblique]);
  top_->addAction(actions_[Command::ViewAll]);
  tools_ = new QToolBar("tools");
  tools_->setMovable(false);
  tools_->setIconSize(QSize(25, 25));
  for (const CommandInfo& about : commands())
    if (isTool(about.command)) tools_->addAction(actions_[about.command]);
  addToolBar(Qt::LeftToolBarArea, tools_);
}

bool MainWindow::eventFilter(QObject*, QEvent* event) {
  // Every mouse event may have changed something of the session.
  if (event->type() == QEvent::MouseButtonRelease || event->type() == QEvent::MouseMove ||
      event->type() == QEvent::MouseButtonPress)
    wake_.start();
  return false;
}

void MainWindow::refresh() {
  session_->update();
  for (const Notice& notice : session_->takeNotices()) tell(notice);
  const SessionNews now = session_->news();
  if (const auto view = session_->takeView()) {
    const std::map<Command, View> views{{Command::ViewFront, View::Front},
                                        {Command::ViewBack, View::Back},
                                        {Command::ViewLeft, View::Left},
                                        {Command::ViewRight, View::Right}};
    const auto at = views.find(*view);
    space_->look(at == views.end() ? View::Oblique : at->second);
    if (*view == Command::ViewAll) table_->showAll();
  }
  if (now.predicted != seen_.predicted) {
    clockwork_.end("drag to preview");
    clockwork_.end("release to first drape");
  }
  if (now.settled != seen_.settled) {
    clockwork_.end("release to first drape");
    clockwork_.end("release to settled");
  }
  if (now.garment != seen_.garment || now.overlay != seen_.overlay) {
    space_->refresh();
    table_->refresh();
  }
  if (now.history != seen_.history) {
    const QString path = QString::fromStdString(session_->path().string());
    setWindowTitle((path.isEmpty() ? inWords(say("New garment")) : QFileInfo(path).completeBaseName()) +
                   "  –  Karinui");
    if (!path.isEmpty()) remember(path);
  }
  for (Panel* panel : panels_) panel->refresh();
  for (const auto& [command, action] : actions_) {
    // A tool that cannot be used yet stays clickable: it then says why.
    if (!isTool(command) && command != Command::Settle) action->setEnabled(session_->can(command));
    if (action->isCheckable()) action->setChecked(session_->tool() == command);
  }
  const Busy busy = session_->busy();
  progress_->setVisible(busy.any);
  progress_->setValue(static_cast<int>(1000 * busy.fraction));
  actions_[Command::Settle]->setIcon(Look::here().icon(busy.settling ? "pause" : "settle"));
  hint_->setText(busy.settling                     ? inWords(busy.doing) + "   –   " + inWords(say("Space stops"))
                 : busy.any && !busy.doing.empty() ? inWords(busy.doing)
                                                   : inWords(session_->hint()));
  if (guide_) guide_->refresh();
  seen_ = now;
  emit refreshed();
}

void MainWindow::tell(const Notice& notice) {
  const Palette& p = Look::here().palette();
  toast_->setText(inWords(notice.what));
  const QColor back = notice.kind == Notice::Kind::Refused  ? QColor("#8f2f1d")
                      : notice.kind == Notice::Kind::Advice ? QColor("#7a5a12")
                                                            : QColor("#2f4a3c");
  (void)p;
  toast_->setStyleSheet(
      QString(
          "QLabel#toast { background: %1; color: white; border-radius: 10px; padding: 10px 18px; font-size: 10.5pt; }")
          .arg(back.name()));
  placeToast();
  toast_->show();
  toast_->raise();
  toastTime_.start(notice.kind == Notice::Kind::Said ? 3500 : 8000);
}

void MainWindow::placeToast() {
  const int wide = std::min(space_->width() - 40, 620);
  toast_->setFixedWidth(wide);
  toast_->adjustSize();
  toast_->move((space_->width() - wide) / 2, 18);
}

QString MainWindow::said() const { return toast_->text(); }

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  placeToast();
}

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
void MainWindow::askSaveCopy() {
  QString path =
      QFileDialog::getSaveFileName(this, inWords(say("Keep a copy as")), freshPath("garment"), "Karinui (*.karinui)");
  if (path.isEmpty()) return;
  if (!path.endsWith(".karinui")) path += ".karinui";
  session_->saveCopy(path.toStdString());
  refresh();
}
void MainWindow::askReplay(const SetBody& body) {
  const QString base = QFileInfo(QString::fromStdString(session_->path().string())).completeBaseName();
  const QString path = freshPath((base.isEmpty() ? "garment" : base) + " – " +
                                 QString::fromStdString(body.size.empty() ? "measured" : body.size));
  session_->replayOn(body, path.toStdString());
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
  auto* allowance = new QDoubleSpinBox;
  allowance->setRange(0, 100);
  allowance->setValue(10);
  allowance->setSuffix(" mm");
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
  session_->exportTo(path.toStdString(), allowance->value() / 1000, paper->currentIndex() == 1,
                     Look::here().language());
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

void MainWindow::keysDialog() {
  QDialog dialog(this);
  dialog.setWindowTitle(inWords(say("Keys")));
  dialog.resize(460, 560);
  auto* column = new QVBoxLayout(&dialog);
  auto* inner = new QWidget;
  auto* form = new QFormLayout(inner);
  std::map<Command, QKeySequenceEdit*> edits;
  for (const CommandInfo& about : commands()) {
    auto* edit = new QKeySequenceEdit(actions_[about.command]->shortcut());
    form->addRow(inWords(about.label), edit);
    edits[about.command] = edit;
  }
  auto* scroll = new QScrollArea;
  scroll->setWidget(inner);
  scroll->setWidgetResizable(true);
  column->addWidget(scroll);
  auto* buttons =
      new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel | QDialogButtonBox::RestoreDefaults);
  column->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, &dialog, [&] {
    for (const CommandInfo& about : commands())
      edits[about.command]->setKeySequence(
          QKeySequence(QString::fromUtf8(about.key.data(), static_cast<int>(about.key.size()))));
  });
  if (dialog.exec() != QDialog::Accepted) return;
  QSettings settings;
  for (const auto& [command, edit] : edits) {
    actions_[command]->setShortcut(edit->keySequence());
    const auto name = info(command).name;
    settings.setValue("keys/" + QString::fromUtf8(name.data(), static_cast<int>(name.size())),
                      edit->keySequence().toString());
  }
}

void MainWindow::startGuide() {
  if (!guide_) guide_ = new Guide(*this, space_);
  guide_->begin();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}
void MainWindow::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) openPath(url.toLocalFile());
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QSettings settings;
  settings.setValue("window", saveGeometry());
  settings.setValue("dark", Look::here().dark());
  settings.setValue("language", Look::here().language() == Language::Japanese ? "ja" : "en");
  session_->command(Command::Cancel);
  event->accept();
}

}  // namespace karinui::studio

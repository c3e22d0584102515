#include "main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QSettings>
#include <QSplitter>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTabBar>
#include <QTabWidget>
#include <QToolBar>
#include <algorithm>

#include "accessibility.h"
#include "board_keys.h"
#include "cap.h"
#include "device_panel.h"
#include "drafts.h"
#include "drop_menu.h"
#include "focus_frame.h"
#include "force_feedback.h"
#include "guide.h"
#include "karinui/design/step_words.h"
#include "keys.h"
#include "length_box.h"
#include "notices.h"
#include "orbit.h"
#include "start_page.h"
#include "theme.h"
#include "variables_dialog.h"
#include "wheel_guard.h"

namespace karinui::studio {

namespace {

constexpr int kGarmentBoard = 0, kBodyBoard = 1;

}  // namespace

QSize firstSize(QSize available) {
  constexpr QSize kFrame(16, 40), kMost(1720, 1080);  // the window manager's borders; more than this tires
  return (available - kFrame).boundedTo(kMost);
}

MainWindow::MainWindow(SessionOptions options) {
  WheelGuard::install();
  BoardKeys::install();
  letViewsSpeak();
  wake_.setSingleShot(true);
  connect(&wake_, &QTimer::timeout, this, &MainWindow::refresh);
  // Work may still wake a window that goes: its timer is gone before the thread that works is.
  options.wake = [self = QPointer<MainWindow>(this)] {
    QMetaObject::invokeMethod(
        qApp,
        [self] {
          if (self && !self->wake_.isActive()) self->wake_.start(self->pause());
        },
        Qt::QueuedConnection);
  };
  // Drafts are named on the session's thread, in the language of the moment.
  const auto spoken = std::make_shared<std::atomic<Language>>(Theme::here().language());
  if (!options.nameDraft) options.nameDraft = [spoken](const std::string& about) { return draftName(about, *spoken); };
  if (!options.nameGarment)
    options.nameGarment = [spoken](const Document& made, const Operation& by) {
      return garmentName(made, by, *spoken);
    };
  connect(&Theme::here(), &Theme::changed, this, [spoken] { *spoken = Theme::here().language(); });
  session_ = std::make_unique<Session>(std::move(options));
  session_->setLanguage(Theme::here().language());

  // From the window inwards: what is put into something else later is given its style once more, with all that is in
  // it.
  parts_ = new QStackedWidget;
  setCentralWidget(parts_);
  auto* central = new QWidget;
  parts_->addWidget(central);
  auto* column = new QVBoxLayout(central);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  guide_ = new Guide(*this);  // a strip above the views, so that it covers none of them
  column->addWidget(guide_);
  auto* split = new QSplitter(Qt::Horizontal);
  column->addWidget(split, 1);
  split->setHandleWidth(1);
  space_ = new SpaceView(*session_, latencyLog_);
  table_ = new PatternView(*session_, latencyLog_);
  split->addWidget(space_);
  split->addWidget(table_);
  boards_ = new QTabWidget;
  boards_->setDocumentMode(true);
  split->addWidget(boards_);
  std::array<QScrollArea*, 6> boards{};
  std::size_t made = 0;
  for (const Message& words : {say("Garment"), say("Body"), say("Fabric"), say("Fit"), say("Steps"), say("Device")})
    boards[made++] = addBoard(words);
  auto* garment = new GarmentPanel(*session_, boards[0]->viewport());
  auto* body = new BodyPanel(*session_, boards[1]->viewport());
  auto* fabric = new FabricPanel(*session_, boards[2]->viewport());
  auto* fit = new FitPanel(*session_, *space_, boards[3]->viewport());
  auto* history = new HistoryPanel(*session_, *space_, boards[4]->viewport());
  force_ = std::make_unique<ForceFeedback>(*session_, *space_);
  space_->setForceFeedback(force_.get());
  connect(force_.get(), &ForceFeedback::fed, this, [this] { wake_.start(0); });
  auto* device = new DevicePanel(*session_, *force_, boards[5]->viewport());
  Panel* const panels[] = {garment, body, fabric, fit, history, device};
  for (std::size_t k = 0; k < boards.size(); ++k) put(panels[k], boards[k]);
  boards_->setCurrentIndex(kBodyBoard);
  Theme::here().keep(boards_, [this] {  // all tabs are seen, whatever the language
    boards_->ensurePolished();
    const int wide = std::max(20 * boards_->fontMetrics().height(), boards_->tabBar()->sizeHint().width() + 2);
    boards_->setMinimumWidth(wide);
    boards_->setMaximumWidth(std::max(28 * boards_->fontMetrics().height(), wide));
  });
  split->setStretchFactor(0, 5);
  split->setStretchFactor(1, 4);
  split->setStretchFactor(2, 0);
  split->setSizes({760, 520, 320});
  hint_ = new QLabel;
  hint_->setObjectName("hint");
  hint_->setWordWrap(true);  // a long sentence takes a second line; the window need not be wider for it
  Theme::here().keep(hint_, [this] {
    hint_->ensurePolished();
    hint_->setFixedHeight(2 * hint_->fontMetrics().lineSpacing() + 6);
  });
  hint_->setMinimumWidth(1);
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
  Theme::here().keep(statusBar(), [this] {  // a menu's words take the place of the hint: the bar stays as high
    statusBar()->setMinimumHeight(0);
    statusBar()->setMinimumHeight(statusBar()->sizeHint().height());
  });
  statusBar()->setContentsMargins(0, 0, 14, 0);  // the bar does not run into the edge
  connect(table_, &PatternView::pointed, this,
          [this](Flat p) { place_->setText(lengthText(p.u) + "  " + lengthText(p.v)); });

  connect(table_, &PatternView::left, place_, &QLabel::clear);

  notices_ = new Notices(space_, Notices::Drags::GoThrough);
  mend_ = new QPushButton(space_);
  mend_->setObjectName("mend");
  mend_->setCursor(Qt::ArrowCursor);
  mend_->setFocusPolicy(Qt::NoFocus);
  mend_->hide();
  Theme::here().keep(this, [this] {
    mend_->setText(inWords(info(Command::Mend).label));
    mend_->setToolTip(inWords(info(Command::Mend).hint));
  });
  connect(mend_, &QPushButton::clicked, this, [this] { run(Command::Mend); });
  connect(notices_, &Notices::newestGone, mend_, &QWidget::hide);

  spaceMenu_ = new DropMenuFrame(*session_, space_);
  tableMenu_ = new DropMenuFrame(*session_, table_);
  for (DropMenuFrame* menu : {spaceMenu_, tableMenu_})
    connect(menu, &DropMenuFrame::chosen, this, [this] { refresh(); });

  // Keys are the views' again after a click on a button and after a typed number: Space settles, and presses nothing.
  for (QPushButton* button : boards_->findChildren<QPushButton*>()) button->setFocusPolicy(Qt::TabFocus);
  for (LengthBox* box : boards_->findChildren<LengthBox*>()) {
    connect(box, &LengthBox::left, space_, [this] { space_->setFocus(); });
    connect(box, &LengthBox::refused, this, [this](const Error& why) { session_->refuse(why); });
  }
  nameForScreenReaders();
  makeActions();
  makeMenus();
  connect(body, &BodyPanel::importAsked, this, &MainWindow::askImport);
  connect(body, &BodyPanel::replayAsked, this, &MainWindow::askReplay);
  connect(space_, &SpaceView::failed, this, [this](const QString& why) { statusBar()->showMessage(why); });
  connect(space_, &SpaceView::menuAsked, this, &MainWindow::menuAt);
  connect(table_, &PatternView::menuAsked, this, &MainWindow::menuAt);
  connect(garment, &GarmentPanel::blockAsked, this, [this] { askNumbers(DraftBlock{}); });
  connect(garment, &GarmentPanel::menuAsked, this,
          [this](const QPoint& global) { menuOf(session_->selection(), std::nullopt, global); });
  space_->installEventFilter(this);
  table_->installEventFilter(this);
  cap_ = new Cap(this);
  connect(cap_, &Cap::moved, this,
          [this](const CapMotion& motion) { space_->setCamera(carried(space_->camera(), motion)); });
  connect(cap_, &Cap::pressed, this, [this](int button) { run(button == 0 ? Command::ViewAll : Command::ViewFront); });
  new FocusFrame(this);
  setAcceptDrops(true);
  resize(firstSize(screen()->availableSize()));
  const QSettings settings;
  if (settings.contains("window")) restoreGeometry(settings.value("window").toByteArray());
  connect(&Theme::here(), &Theme::changed, this, [this] {
    session_->setLanguage(Theme::here().language());
    session_->setInches(Theme::here().inches());
    notices_->clear();  // what they say is in the other language
    seen_.history = ~0ull;
    refresh();
  });
  refresh();
}

QScrollArea* MainWindow::addBoard(const Message& words) {
  auto* scroll = new QScrollArea;
  const int at = boards_->addTab(scroll, QString());
  scroll->setFocusPolicy(Qt::NoFocus);
  Theme::here().keep(scroll, [this, at, words] { boards_->setTabText(at, inWords(words)); });
  return scroll;
}

void MainWindow::put(Panel* panel, QScrollArea* board) {
  panels_.push_back(panel);
  board->setWidget(panel);
  board->setWidgetResizable(true);
  panel->refresh();
}

void MainWindow::addPanel(Panel* panel, const Message& words) { put(panel, addBoard(words)); }

// What is written before a box is its name for those who hear the screen; what nothing is written before names itself.
void MainWindow::nameForScreenReaders() {
  for (QFormLayout* form : boards_->findChildren<QFormLayout*>())
    for (int row = 0; row < form->rowCount(); ++row) {
      const QLayoutItem *label = form->itemAt(row, QFormLayout::LabelRole),
                        *field = form->itemAt(row, QFormLayout::FieldRole);
      QWidget* box = field ? field->widget() : nullptr;
      if (auto* words = label ? qobject_cast<QLabel*>(label->widget()) : nullptr; words && box) words->setBuddy(box);
    }
  nameEdges();
  Theme::here().keep(this, [this] {
    space_->setAccessibleName(inWords(say("Fitting in 3D")));
    table_->setAccessibleName(inWords(say("Flat pattern")));
    boards_->setAccessibleName(inWords(say("Boards")));
    if (QWidget* tabs = boards_->tabBar()) tabs->setAccessibleName(inWords(say("Boards")));
  });
}

MainWindow::~MainWindow() {
  Theme::here().setNames([](std::string_view identifier) { return identifierSaid(identifier); });
  session_->command(Command::Cancel);
  space_->setForceFeedback(nullptr);
  force_.reset();  // no force outlives the window
  // The views look at the session until they are gone.
  delete centralWidget();
}

void MainWindow::run(Command command) {
  session_->command(command);
  refresh();
}

bool MainWindow::eventFilter(QObject*, QEvent* event) {
  // Every mouse event may have changed something of the session.
  if (event->type() == QEvent::MouseButtonRelease || event->type() == QEvent::MouseMove ||
      event->type() == QEvent::MouseButtonPress)
    wake_.start(0);
  return false;
}

// Space presses the button that has the focus; it settles everywhere else. A button does not claim the key by itself.
bool MainWindow::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Space &&
      qobject_cast<QAbstractButton*>(focusWidget()))
    event->accept();
  return QMainWindow::event(event);
}

// Edges that have only a number are called by where they lie, in every sentence.
void MainWindow::nameEdges() {
  Theme::here().setNames([this](std::string_view identifier) -> std::optional<Message> {
    const Document& document = session_->snapshot().document;
    const auto& chosen =
        session_->selection().edge;  // one that is named without its piece is most likely the chosen one
    if (const Piece* piece = chosen ? document.find(chosen->piece) : nullptr; piece && piece->outline.find(identifier))
      return edgeNameSaid(document, *piece, identifier);
    return identifierSaid(document, identifier);
  });
}

bool MainWindow::isOn(Command command) const {
  const ViewCut& cut = session_->viewCut();
  switch (command) {
    case Command::BodyLines:
      return session_->linesShown();
    case Command::HideArms:
      return cut.arms;
    case Command::HideHands:
      return cut.hands;
    case Command::HideHead:
      return cut.head;
    case Command::Section:
      return cut.section.has_value();
    default:
      return session_->tool() == command;
  }
}

// Where the processor draws, it draws at the cost of the drape: ten pictures of one a second are enough there.
int MainWindow::pause() const {
  constexpr qint64 kApart = 100;  // milliseconds
  const Busy busy = session_->busy();
  if (!space_->drawnByProcessor() || !(busy.settling || busy.posing) || !sinceRefresh_.isValid()) return 0;
  return static_cast<int>(std::max<qint64>(0, kApart - sinceRefresh_.elapsed()));
}

void MainWindow::refresh() {
  sinceRefresh_.start();
  session_->update();
  const SessionChanges now = session_->changes();
  if (now.history != seen_.history) {
    std::uint64_t last = 0;  // a changed step is a new one; drapes come by themselves
    for (const Step& step : session_->steps())
      if (!std::holds_alternative<DrapePieces>(step.operation)) last = std::max(last, step.seq);
    notices_->done(last);
  }
  bool refusal = false;
  for (const Notice& notice : session_->takeNotices()) {
    refusal |= notice.kind == Notice::Kind::Refused;
    tell(notice);
  }
  const auto* entered = qobject_cast<LengthBox*>(focusWidget());
  if (refusal && !(entered && entered->holdsFormula()))  // which is mended where it stands
    for (Panel* panel : panels_) panel->showAgain();
  if (const auto damaged = session_->takeDamaged()) offerRescue(*damaged);
  if (const auto open = session_->takeOpenBody()) offerSkin(*open);
  if (const auto guessed = session_->takeGuessedUnit()) askUnit(*guessed);
  if (atStart() && (!session_->path().empty() || !session_->steps().empty())) leaveStart();
  if (auto asked = session_->takeAsked()) askNumbers(*std::move(asked));
  if (const auto view = session_->takeView()) {
    const std::map<Command, View> views{{Command::ViewFront, View::Front},
                                        {Command::ViewBack, View::Back},
                                        {Command::ViewLeft, View::Left},
                                        {Command::ViewRight, View::Right}};
    const auto at = views.find(*view);
    const View side = at == views.end() ? View::Oblique : at->second;
    // Whoever draws has gone near for it: another side of the same place is asked for.
    const bool drawing = session_->begun() || session_->tool() == Command::Draw;
    if (drawing && *view != Command::ViewAll)
      space_->turnTo(side);
    else
      space_->look(side);
    if (*view == Command::ViewAll) table_->showAll();
  }
  if (now.predicted != seen_.predicted) {
    latencyLog_.end("drag to preview");
    latencyLog_.end("release to first drape");
  }
  if (now.settled != seen_.settled) {
    latencyLog_.end("release to first drape");
    latencyLog_.end("release to settled");
  }
  if (now.garment != seen_.garment || now.overlay != seen_.overlay) {
    space_->refresh();
    table_->refresh();
  }
  if (now.history != seen_.history) {
    const QString path = QString::fromStdString(session_->path().string());
    setWindowTitle(atStart() ? QString("Karinui")
                             : (path.isEmpty() ? inWords(say("New garment")) : QFileInfo(path).completeBaseName()) +
                                   "  –  Karinui");
    if (!path.isEmpty()) remember(path);
    // A garment begins with its figure; one that was opened is gone on with.
    // A draft that is called after what it has become is the one that was shown, and the hand is at its measures.
    const QString was = std::exchange(shownPath_, path);
    const bool renamed = !was.isEmpty() && !QFileInfo::exists(was);
    if (was != path && !renamed && session_->steps().size() > 1 && boards_->currentIndex() == kBodyBoard &&
        session_->snapshot().body)
      boards_->setCurrentIndex(kGarmentBoard);
  }
  if (mend_->isVisible() && !session_->can(Command::Mend)) mend_->hide(), notices_->clearNewest();
  for (Panel* panel : panels_) panel->refresh();
  if (variables_ && variables_->isVisible()) variables_->refresh();
  for (const auto& [command, action] : actions_) {
    // A tool that cannot be used yet stays clickable: it then says why.
    if (atStart())
      action->setEnabled(false);
    else if (!isTool(command) && command != Command::Settle)
      action->setEnabled(session_->can(command));
    else
      action->setEnabled(true);
    if (action->isCheckable()) action->setChecked(isOn(command));
  }
  const Busy busy = session_->busy();
  notices_->hold(!session_->idle());
  progress_->setVisible(busy.any);
  progress_->setValue(static_cast<int>(1000 * busy.fraction));
  actions_[Command::Settle]->setIcon(Theme::here().icon(busy.settling || busy.posing ? "pause" : "settle"));
  const QString keys = inWords(session_->keyHint());
  hint_->setText(atStart() && !busy.any ? QString()
                 : busy.past            ? inWords(say("The garment as it was; the new one is on its way")) +
                                   (busy.doing.empty() ? QString() : ": " + inWords(busy.doing)) + "   –   " +
                                   inWords(say("Space stops"))
                 : busy.settling || busy.posing
                     ? (busy.doing.empty() ? QString() : inWords(busy.doing) + "   –   ") + inWords(say("Space stops"))
                 : busy.any && !busy.doing.empty() ? inWords(busy.doing)
                 : busy.loading                    ? inWords(say("The garment is being opened …"))
                 : keys.isEmpty()                  ? inWords(session_->hint())
                                                   : keys + "   –   " + inWords(session_->hint()));
  mirrorSeams_->setChecked(session_->toolOptions().mirrorSeams);
  showDropMenu();
  tellFingertip(keys);
  guide_->refresh();
  seen_ = now;
  emit refreshed();
}

void MainWindow::showDropMenu() {
  const auto menu = session_->dropMenu();
  const bool inSpace = menu && menu->where == PointerSample::Where::Space;
  spaceMenu_->show(inSpace ? menu : std::nullopt,
                   inSpace ? space_->onScreen(menu->space).value_or(QPointF(space_->rect().center())) : QPointF());
  tableMenu_->show(menu && !inSpace ? menu : std::nullopt, menu ? table_->onScreen(menu->table) : QPointF());
}

// What lies under it, what was answered, what keys and tool do there: of these, what has changed.
void MainWindow::tellFingertip(const QString& keys) {
  Heard now;
  if (!keys.isEmpty()) {
    const QString asked = spaceMenu_->heard() + tableMenu_->heard();
    const QString answer = !asked.isEmpty() ? asked : notices_->visible() ? notices_->newest() : QString();
    now = {inWords(session_->underFingertip()) + ".", answer, inWords(session_->hint()), keys + "."};
  }
  const Heard before = std::exchange(heard_, now);
  QStringList words;
  for (std::size_t k = 0; k < now.size(); ++k)
    if (now[k] != before[k] && !now[k].isEmpty()) words << now[k];
  if (!words.isEmpty() || (keys.isEmpty() && !before[0].isEmpty())) announce(focusWidget(), words.join(' '));
}

void MainWindow::tell(const Notice& notice) {
  const bool mends = notice.kind == Notice::Kind::Advice && session_->can(Command::Mend);
  notices_->tell(notice.kind, inWords(notice.what), mends);
  mend_->setVisible(mends);
  placeNotices();
  mend_->raise();
}

void MainWindow::goToNextPart() {
  if (atStart()) return start_->setFocus(Qt::TabFocusReason);
  QWidget* const parts[] = {space_, table_, boards_, tools_};
  const QWidget* now = focusWidget();
  std::size_t next = 0;
  for (std::size_t k = 0; k < std::size(parts); ++k)
    if (now && (parts[k] == now || parts[k]->isAncestorOf(now))) next = (k + 1) % std::size(parts);
  QWidget* to = parts[next];
  if (to == tools_) to = tools_->widgetForAction(actions_.at(session_->tool()));
  to->setFocus(Qt::TabFocusReason);
}

void MainWindow::placeNotices() {
  const int room = atStart() ? start_->width() : static_cast<int>(space_->freeWidth());
  mend_->adjustSize();
  const int below = notices_->place(room, mend_->isVisibleTo(mend_->parentWidget()) ? mend_->height() + 6 : 0);
  mend_->move((room - mend_->width()) / 2, below + 6);
}

QString MainWindow::said() const { return notices_->newest(); }

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  placeNotices();
}

void MainWindow::changeEvent(QEvent* event) {
  QMainWindow::changeEvent(event);
  if (event->type() == QEvent::ActivationChange && force_) force_->setFocus(isActiveWindow());
  if (event->type() == QEvent::WindowStateChange && fullScreen_) fullScreen_->setChecked(isFullScreen());
}

bool MainWindow::atStart() const { return start_ && parts_->currentWidget() == start_; }

bool MainWindow::still() const {
  if (!session_->idle()) return false;
  return atStart() ? start_->still() : space_->still() || space_->trouble();
}

void MainWindow::showStart() {
  if (!start_) {
    start_ = new StartPage;
    parts_->addWidget(start_);
    connect(start_, &StartPage::freshAsked, this, &MainWindow::askNew);
    connect(start_, &StartPage::blockAsked, this, &MainWindow::askBlock);
    connect(start_, &StartPage::openAsked, this, &MainWindow::askOpen);
    connect(start_, &StartPage::importAsked, this, &MainWindow::askImport);
    connect(start_, &StartPage::guideAsked, this, &MainWindow::startGuide);
    connect(start_, &StartPage::sampleAsked, this, [this] { openExample("first_tunic"); });
    connect(start_, &StartPage::documentAsked, this, &MainWindow::openPath);
    connect(start_, &StartPage::stillNow, this, &MainWindow::refreshed);
  }
  session_->close();
  session_->begin(DocumentFile::inMemory());
  session_->finish();
  guide_->hide();
  start_->fill();
  parts_->setCurrentWidget(start_);
  for (QToolBar* bar : {top_, tools_}) bar->hide();
  notices_->moveTo(start_, Notices::Drags::Stop);
  notices_->clear();
  start_->setFocus();
  seen_.history = ~0ull;
  refresh();
}

void MainWindow::leaveStart() {
  start_->leave();
  parts_->setCurrentIndex(0);
  for (QToolBar* bar : {top_, tools_}) bar->show();
  if (!session_->snapshot().body) boards_->setCurrentIndex(kBodyBoard);
  notices_->moveTo(space_, Notices::Drags::GoThrough);
  placeNotices();
  space_->setFocus();
  seen_.history = ~0ull;
}

void MainWindow::startGuide() {
  if (atStart()) leaveStart(), refresh();
  guide_->begin();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QSettings settings;
  settings.setValue("window", saveGeometry());
  setCursor(Qt::WaitCursor);
  session_->close();
  event->accept();
}

}  // namespace karinui::studio

// The menus, the bars and the keys of the window.
#include <QActionGroup>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>
#include <QToolBar>

#include "beside.h"
#include "blocks_menu.h"
#include "fit_study.h"
#include "force_feedback.h"
#include "guide.h"
#include "karinui/body/pose.h"
#include "lay_dialog.h"
#include "main_window.h"
#include "make_up_dialog.h"
#include "menu_letters.h"
#include "new_pieces.h"
#include "notices.h"
#include "pose_dialog.h"
#include "step_dialog.h"
#include "theme.h"
#include "variables_dialog.h"

namespace karinui::studio {

namespace {

// At once, so that a window that is opened beside this one looks like it; and nothing but what was chosen.
void keepChosen(const char* key, const QVariant& value) {
  QSettings settings;
  settings.setValue(key, value);
  settings.sync();
}

void titled(QMenu& menu, const Message& words) {
  menu.menuAction()->setProperty(kEnglish, QString::fromStdString(text(words)));
  Theme::here().keep(&menu, [&menu, words] { menu.setTitle(inWords(words)); });
}

}  // namespace

void MainWindow::makeActions() {
  const QSettings settings;
  for (const CommandInfo& about : commands()) {
    auto* action = new QAction(this);
    const QString name = QString::fromUtf8(about.name.data(), static_cast<int>(about.name.size()));
    action->setObjectName(name);
    const QString usual = QString::fromUtf8(about.key.data(), static_cast<int>(about.key.size()));
    action->setShortcutContext(Qt::WindowShortcut);
    action->setCheckable(isTool(about.command));
    Theme::here().keep(action, about.label, about.hint, about.icon);
    connect(action, &QAction::triggered, this, [this, c = about.command] { run(c); });
    addAction(action);
    actions_[about.command] = action;
    setKey(about.command, QKeySequence(settings.value("keys/" + name, usual).toString()));
  }
}

// The chosen key, and the command's second usual one.
void MainWindow::setKey(Command command, const QKeySequence& key) {
  QList<QKeySequence> keys;
  if (!key.isEmpty()) keys << key;
  const std::string_view other = info(command).otherKey;
  if (!other.empty()) keys << QKeySequence(QString::fromLatin1(other.data(), static_cast<int>(other.size())));
  actions_.at(command)->setShortcuts(keys);
}

// The choices of the board "Fit".
void MainWindow::makeStereoMenu() {
  QMenu* menu = viewMenu_->addMenu(QString());
  menu->setObjectName("stereo");
  auto* group = new QActionGroup(menu);
  for (std::size_t k = 0; k < stereoNames().size(); ++k) {
    QAction* one = menu->addAction(QString());
    one->setCheckable(true);
    group->addAction(one);
    connect(one, &QAction::triggered, this, [this, k] {
      space_->setStereo(static_cast<Stereo>(k));
      refresh();
    });
  }
  Theme::here().keep(menu, [menu] {
    menu->setTitle(inWords(say("Stereo")));
    for (std::size_t k = 0; k < stereoNames().size(); ++k)
      menu->actions()[static_cast<int>(k)]->setText(inWords(stereoNames()[k]));
  });
  connect(menu, &QMenu::aboutToShow, this,
          [this, menu] { menu->actions()[static_cast<int>(space_->stereo())]->setChecked(true); });
}

void MainWindow::setFullScreen(bool on) {
  setWindowState(windowState().setFlag(Qt::WindowFullScreen, on));  // maximized or not as before, when it ends
}

// Of the menu bar.
QMenu* MainWindow::newMenu(const Message& words) {
  QMenu* made = menuBar()->addMenu(QString());
  Theme::here().keep(made, [made, words] {  // Alt and the English word's first letter open it
    const QString title = inWords(words), letter = QString::fromStdString(text(words)).left(1);
    made->setTitle(title.startsWith(letter) ? "&" + title : title + "(&" + letter + ")");
  });
  return made;
}

QAction* MainWindow::add(QMenu* to, const Message& words, const char* icon, const char* key,
                         std::function<void()> what) {
  QAction* action = to->addAction(QString());
  if (*key) action->setShortcut(QKeySequence(QString::fromLatin1(key)));
  Theme::here().keep(action, words, words, icon);
  connect(action, &QAction::triggered, this, [what = std::move(what)] { what(); });
  return action;
}

void MainWindow::makeMenus() {
  const std::vector<QAction*> ofFile = makeFileMenu();
  makeEditMenu();
  makeWorkMenu();
  makeViewMenu();
  makeHelpMenu();
  for (QMenu* one : menuBar()->findChildren<QMenu*>()) keepLetters(*one);
  makeToolBars(ofFile);
}

// Returns what stands on the toolbar, too.
std::vector<QAction*> MainWindow::makeFileMenu() {
  QMenu* file = newMenu(say("File"));
  QAction* fresh = add(file, say("New garment…"), "new", "Ctrl+N", [this] { askNew(); });
  QAction* open = add(file, say("Open…"), "open", "Ctrl+O", [this] { askOpen(); });
  recent_ = file->addMenu(QString());
  titled(*recent_, say("Recent"));
  connect(recent_, &QMenu::aboutToShow, this, &MainWindow::fillRecent);
  QMenu* examples = file->addMenu(QString());
  titled(*examples, say("Examples"));
  const std::pair<const char*, Message> made[] = {{"first_tunic", say("A first tunic")},
                                                  {"six_operations", say("The six operations")},
                                                  {"kyoto_fitting", say("A fitting in Kyoto")},
                                                  {"shirt_fitting", say("A shirt")},
                                                  {"tailored_shirt", say("A tailored shirt")},
                                                  {"pleated_skirt", say("A pleated skirt")},
                                                  {"trousers", say("Trousers with a fly")},
                                                  {"gathered_dress", say("A gathered dress")},
                                                  {"hooded_coat", say("A hooded coat")},
                                                  {"lined_waistcoat", say("A lined waistcoat over a shirt")},
                                                  {"skirt_with_train", say("A skirt with a train on a dress form")}};
  for (const auto& [name, words] : made) {
    QAction* one = examples->addAction(QString());
    Theme::here().keep(one, words, words);
    connect(one, &QAction::triggered, this, [this, name = name] { openExample(name); });
  }
  file->addSeparator();
  add(file, say("Save"), "", "Ctrl+S", [this] { save(); });
  add(file, say("Save as…"), "", "Ctrl+Shift+S", [this] { askSaveAs(); });
  add(file, say("Import…"), "", "Ctrl+I", [this] { askImport(); });
  QAction* out = add(file, say("Export…"), "export", "Ctrl+E", [this] { askExport(); });
  QAction* share = add(file, say("Share the pattern…"), "", "", [this] { askShare(); });
  share->setObjectName("share");
  add(file, say("Lay plan…"), "", "Ctrl+L", [this] { (new LayDialog(*session_, this))->open(); });
  add(file, say("Picture of the fitting…"), "", "", [this] { picture(); });
  add(file, say("Print the pattern…"), "print", "Ctrl+P", [this] { print(); });
  file->addSeparator();
  add(file, say("Start page"), "", "Ctrl+W", [this] { showStart(); });
  add(file, say("Close"), "", "Ctrl+Q", [this] { close(); });
  return {fresh, open, out};
}

void MainWindow::makeEditMenu() {
  QMenu* edit = newMenu(say("Edit"));
  for (const Command c : {Command::Undo, Command::Redo}) edit->addAction(actions_[c]);
  edit->addSeparator();
  edit->addAction(actions_[Command::SelectAll]);
  for (const Command c : {Command::Remove, Command::Duplicate, Command::Mirror, Command::Freeze, Command::FlipSeam})
    edit->addAction(actions_[c]);
  edit->addAction(actions_[Command::Mend]);
  mirrorSeams_ = add(edit, say("Sew mirrored seams too"), "", "", [this] {
    ToolOptions options = session_->toolOptions();
    options.mirrorSeams = !options.mirrorSeams;
    session_->setToolOptions(options);
  });
  mirrorSeams_->setCheckable(true);
  mirrorSeams_->setObjectName("mirror_seams");
  edit->addSeparator();
  add(edit, say("Variables…"), "", "", [this] {
    if (!variables_) variables_ = new VariablesDialog(*session_, this);
    variables_->show();
    variables_->raise();
  });
  add(edit, say("Settings of the garment…"), "", "", [this] { askNumbers(settingsNow(*session_)); });
  add(edit, say("Keys…"), "", "", [this] { keysDialog(); });
}

void MainWindow::makeWorkMenu() {
  QMenu* work = newMenu(say("Work"));
  for (const CommandInfo& about : commands())
    if (isTool(about.command)) work->addAction(actions_[about.command]);
  work->addSeparator();
  QMenu* pieces = work->addMenu(QString());
  titled(*pieces, say("New piece"));
  QMenu* details = work->addMenu(QString());
  titled(*details, say("Pleats, trims and fastenings"));
  addNewPieces(*pieces, *details);
  makePoseMenu(work->addMenu(QString()));
  QMenu* blocks = work->addMenu(QString());
  titled(*blocks, say("Ready blocks"));
  fillBlocks(*blocks, *session_, [this] { askNumbers(DraftBlock{}); });
  makeScanMenu(work->addMenu(QString()));
  add(work, say("Make up the pattern…"), "", "", [this] {
    if (session_->snapshot().document.pattern.pieces.empty())
      return session_->refuse(refused(say("There is no piece yet; draw one on the body.")));
    (new MakeUpDialog(*session_, this))->open();
  })->setObjectName("make_up");
  work->addSeparator();
  makeSizeMenu(work->addMenu(QString()));
  work->addAction(actions_[Command::Settle]);
  work->addAction(actions_[Command::Confirm]);
  work->addAction(actions_[Command::Cancel]);
  work->addSeparator();
  QAction* off = add(work, say("Emergency off"), "", "", [this] { force_->emergencyOff(!force_->isOff()); });
  off->setObjectName("force_off");
  off->setShortcuts({QKeySequence(Qt::Key_F9), QKeySequence(Qt::Key_Pause)});
  off->setShortcutContext(Qt::ApplicationShortcut);  // also while a dialog is open
  off->setCheckable(true);
  connect(force_.get(), &ForceFeedback::changed, off, [this, off] { off->setChecked(force_->isOff()); });
}

void MainWindow::makePoseMenu(QMenu* poses) {
  poses->setObjectName("poses");
  titled(*poses, say("Pose"));
  for (const NamedPose& pose : namedPoses()) {
    QAction* one = poses->addAction(QString());
    Theme::here().keep(one, pose.said, pose.said);
    connect(one, &QAction::triggered, this, [this, name = std::string(pose.name)] {
      PoseBody take;
      take.name = name;
      session_->perform(take);
      refresh();
    });
  }
  poses->addSeparator();
  add(poses, say("Joint by joint…"), "", "", [this] {
    auto* dialog = new PoseDialog(*session_, this);
    connect(this, &MainWindow::refreshed, dialog, &PoseDialog::refresh);
    dialog->show();
  });
  connect(poses, &QMenu::aboutToShow, this, [this, poses] {
    for (QAction* one : poses->actions())
      one->setEnabled(!session_->readOnly() && session_->snapshot().document.body.chosen());
  });
}

void MainWindow::makeScanMenu(QMenu* scans) {
  scans->setObjectName("scans");
  titled(*scans, say("Scans to trace"));
  connect(scans, &QMenu::aboutToShow, this, [this, scans] {
    scans->clear();
    QAction* lay = scans->addAction(inWords(say("Lay a scan under the pattern…")));
    lay->setObjectName("lay_scan");
    lay->setEnabled(!session_->readOnly());
    connect(lay, &QAction::triggered, this, [this] { askScan(); });
    for (const auto& [name, underlay] : session_->snapshot().document.underlays)
      addScanOperations(*scans->addMenu(nameText(name)), name);
  });
}

void MainWindow::makeSizeMenu(QMenu* sizes) {
  sizes->setObjectName("sizes");
  titled(*sizes, say("Sizes"));
  connect(sizes, &QMenu::aboutToShow, this, [this, sizes] {
    sizes->clear();
    const Grading grading = session_->snapshot().document.grading;
    for (std::size_t i = 0; i < grading.sizes.size(); ++i) {
      QAction* one = sizes->addAction(QString::fromStdString(grading.sizes[i]));
      one->setCheckable(true);
      one->setChecked(i == grading.standing);
      connect(one, &QAction::triggered, this, [this, name = grading.sizes[i]] { session_->perform(ChooseSize{name}); });
    }
    if (grading.empty()) sizes->addAction(inWords(say("The garment is made in one size")))->setEnabled(false);
    sizes->addSeparator();
    offer(*sizes, say("Name the sizes…"), [this] { askNumbers(sizesOf(session_->snapshot().document)); });
    if (grading.empty()) return;
    GradePieces one;
    one.plain = true;
    offer(*sizes, say("One size only"), one);
    sizes->addAction(findChild<QAction*>("nest"));
  });
}

void MainWindow::makeViewMenu() {
  viewMenu_ = newMenu(say("View"));
  for (const Command c : {Command::ViewFront, Command::ViewBack, Command::ViewLeft, Command::ViewRight,
                          Command::ViewOblique, Command::ViewAll})
    viewMenu_->addAction(actions_[c]);
  viewMenu_->addSeparator();
  QAction* nest = add(viewMenu_, say("All sizes over one another"), "", "", [] {});
  nest->setObjectName("nest");
  nest->setCheckable(true);
  connect(nest, &QAction::toggled, this, [this](bool on) { table_->setNest(on); });
  actions_[Command::BodyLines]->setCheckable(true);
  viewMenu_->addAction(actions_[Command::BodyLines]);
  for (const Command c : {Command::HideArms, Command::HideHands, Command::HideHead, Command::Section})
    actions_[c]->setCheckable(true);
  for (const Command c : {Command::HideArms, Command::HideHands, Command::HideHead, Command::Section,
                          Command::SectionBack, Command::SectionOn})
    viewMenu_->addAction(actions_[c]);
  addFitMaps();
  viewMenu_->addSeparator();
  QMenu* beside = viewMenu_->addMenu(QString());
  beside->setObjectName("beside");
  titled(*beside, say("Beside it"));
  connect(beside, &QMenu::aboutToShow, this, [this, beside] { findChild<Beside*>()->fill(*beside, this); });
  makeStereoMenu();
  fullScreen_ = add(viewMenu_, say("Full screen"), "", "F11", [this] { setFullScreen(!isFullScreen()); });
  fullScreen_->setCheckable(true);
  add(viewMenu_, say("Next part of the window"), "", "F6", [this] { goToNextPart(); });
  addPreferences();
  addLanguages();
}

void MainWindow::addFitMaps() {
  viewMenu_->addSeparator();
  const auto map = [&](const char* name, const Message& words, const char* key, FitMap which) {
    QAction* one = add(viewMenu_, words, "", key, [this, which] {  // a picture would stand in place of the tick
      space_->setMap(space_->map() == which ? FitMap::None : which);
      refresh();
    });
    one->setObjectName(name);
    one->setCheckable(true);
    const auto tick = [this, one, which] { one->setChecked(space_->map() == which); };
    connect(viewMenu_, &QMenu::aboutToShow, one, tick);  // the board Fit chooses them too
    connect(this, &MainWindow::refreshed, one, tick);
  };
  map("map_strain", say("Strain map"), "Alt+7", FitMap::Strain);
  map("map_ease", say("Distance to the body"), "Alt+8", FitMap::Ease);
  map("map_pressure", say("Pressure on the body"), "Alt+9", FitMap::Pressure);
  QAction* motion =
      add(viewMenu_, say("Fit in motion…"), "", "", [this] { (new MotionStudy(*session_, this))->open(); });
  motion->setObjectName("motion");
  QAction* figures =
      add(viewMenu_, say("Fit over figures…"), "", "", [this] { (new FiguresStudy(*session_, this))->open(); });
  figures->setObjectName("figures");
  connect(viewMenu_, &QMenu::aboutToShow, this, [this, motion, figures] {
    const Document& document = session_->snapshot().document;
    for (QAction* one : {motion, figures})
      one->setEnabled(document.body.chosen() && !document.pattern.pieces.empty() && session_->idle());
  });
}

// What is kept for the next window.
void MainWindow::addPreferences() {
  viewMenu_->addSeparator();
  QAction* dark = add(viewMenu_, say("Dark"), "", "", [] {
    Theme::here().setDark(!Theme::here().dark());
    keepChosen("dark", Theme::here().dark());
  });
  dark->setObjectName("dark");
  dark->setCheckable(true);
  dark->setChecked(Theme::here().dark());
  QAction* inches = add(viewMenu_, say("Inches"), "", "", [] {
    Theme::here().setInches(!Theme::here().inches());
    keepChosen("inches", Theme::here().inches());
  });
  inches->setCheckable(true);
  inches->setChecked(Theme::here().inches());
  inches->setObjectName("inches");
  QAction* blender = add(viewMenu_, say("Mouse as in Blender"), "", "", [this] {
    const bool on = !QSettings().value("blender").toBool();
    QSettings().setValue("blender", on);
    space_->setBlenderKeys(on);
  });
  blender->setCheckable(true);
  blender->setChecked(QSettings().value("blender").toBool());
  space_->setBlenderKeys(blender->isChecked());
  QAction* fine = add(viewMenu_, say("Fine pictures when still"), "", "", [this] {
    const bool on = !QSettings().value("fine", true).toBool();
    QSettings().setValue("fine", on);
    space_->setFine(on);
  });
  fine->setObjectName("fine");
  fine->setCheckable(true);
  fine->setChecked(QSettings().value("fine", true).toBool());
  space_->setFine(fine->isChecked());
}

void MainWindow::addLanguages() {
  viewMenu_->addSeparator();
  QAction* english = viewMenu_->addAction("English");
  QAction* japanese = viewMenu_->addAction(QString::fromUtf8("日本語"));
  english->setObjectName("english");
  japanese->setObjectName("japanese");
  for (QAction* one : {english, japanese}) one->setCheckable(true);
  const auto tick = [english, japanese] {
    english->setChecked(Theme::here().language() == Language::English);
    japanese->setChecked(Theme::here().language() == Language::Japanese);
  };
  Theme::here().keep(english, tick);
  connect(english, &QAction::triggered, this, [] {
    Theme::here().setLanguage(Language::English);
    keepChosen("language", "en");
  });
  connect(japanese, &QAction::triggered, this, [this, tick] {
    if (const auto why = japaneseTrouble()) return tick(), session_->refuse(notFound(*why));
    Theme::here().setLanguage(Language::Japanese);
    keepChosen("language", "ja");
  });
}

void MainWindow::makeHelpMenu() {
  QMenu* help = newMenu(say("Help"));
  add(help, say("A first garment, step by step"), "", "F1", [this] { startGuide(); });
  add(help, say("What was said…"), "", "", [this] { notices_->showAll(this); })->setObjectName("what_was_said");
  add(help, say("About Karinui"), "", "", [this] {
    QMessageBox::about(
        this, "Karinui",
        inWords(say("Karinui: made-to-measure clothes designed on the body, draped, and cut to paper patterns. "
                    "Apache-2.0; built with Qt (LGPL). Nothing is ever sent over a network.")));
  });
}

void MainWindow::makeToolBars(const std::vector<QAction*>& ofFile) {
  top_ = addToolBar("top");
  top_->setMovable(false);
  top_->setIconSize(QSize(22, 22));
  for (QAction* a : ofFile) top_->addAction(a);
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
  for (QToolBar* bar : {top_, tools_})
    Theme::here().keep(bar, [bar] {  // to those who hear the screen without the tooltip's bold letters
      for (QAction* a : bar->actions())
        if (QWidget* button = bar->widgetForAction(a)) button->setAccessibleDescription(a->statusTip());
    });
}

}  // namespace karinui::studio

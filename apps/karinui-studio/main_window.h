#pragma once
// The window: fitting at the left, pattern beside it, boards at the right; menus, keys, files, words. GUI thread.
#include <QElapsedTimer>
#include <QMainWindow>
#include <QTimer>
#include <array>

#include "karinui/session/session.h"
#include "latency_log.h"
#include "panels.h"
#include "pattern_view.h"

class QLabel;
class QMenu;
class QPrinter;
class QProgressBar;
class QStackedWidget;
class QPushButton;
class QScrollArea;
class QTabWidget;
class QToolBar;

namespace karinui::studio {

class DropMenuFrame;
class ForceFeedback;
class Guide;
class Notices;
class PictureDialog;
class VariablesDialog;

// The window's size the first time, from what the screen has room for.
QSize firstSize(QSize available);

class Cap;
class StartPage;

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(SessionOptions options);  // `wake` is the window's own
  ~MainWindow() override;

  Session& session() { return *session_; }
  SpaceView& space() { return *space_; }
  PatternView& table() { return *table_; }
  ForceFeedback& force() { return *force_; }
  LatencyLog& latencyLog() { return latencyLog_; }
  QAction* action(Command command) const { return actions_.at(command); }
  QTabWidget& boards() { return *boards_; }
  void addPanel(Panel* panel, const Message& words);              // behind the other boards; the window owns it
  QString said() const;                                           // the last sentence shown
  void openPath(const QString& path);                             // a document, a pattern or a body, by its ending
  void newGarment(const std::string& size, const QString& path);  // without a path a draft
  void showStart();                                               // closes what is open
  bool atStart() const;
  bool still() const;  // nothing is under way and all pictures are drawn
  void startGuide();
  void printOn(QPrinter& printer, bool pairsOnce = false);  // the pattern, at true size

 signals:
  void refreshed();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QScrollArea* addBoard(const Message& words);  // where a panel that does not fit scrolls
  void put(Panel* panel, QScrollArea* board);
  void nameForScreenReaders();
  void makeActions();
  void makeMenus();
  QMenu* newMenu(const Message& words);
  QAction* add(QMenu* to, const Message& words, const char* icon, const char* key, std::function<void()> what);
  std::vector<QAction*> makeFileMenu();
  void makeEditMenu();
  void makeWorkMenu();
  void makePoseMenu(QMenu* poses);
  void makeScanMenu(QMenu* scans);
  void makeSizeMenu(QMenu* sizes);
  void makeViewMenu();
  void addFitMaps();
  void addPreferences();
  void addLanguages();
  void makeHelpMenu();
  void makeToolBars(const std::vector<QAction*>& ofFile);
  void refresh();
  void nameEdges();
  bool isOn(Command command) const;  // of an action with a check mark
  void tell(const Notice& notice);
  int pause() const;                        // milliseconds until what the session has done is shown
  void tellFingertip(const QString& keys);  // to those who hear the screen; no keys: there is none
  void goToNextPart();                      // of the window, with the keys
  void placeNotices();
  void showDropMenu();
  void run(Command command);
  void offerRescue(const std::filesystem::path& damaged);  // of a document that was not opened
  void askUnit(const GuessedUnit& guessed);                // of a pattern whose file does not tell it
  void offerSkin(const std::filesystem::path& body);       // for one whose surface has holes
  void askRescue(const std::filesystem::path& damaged);
  void askNew();
  void askOpen();
  void askImport();
  void askExport();
  void askShare();
  void leaveStart();
  void openExample(const QString& name);
  void save();  // says where the document is; a draft may be given a place
  void askSaveAs();
  void askReplay(const SetBody& body);
  void print();
  void picture();
  void turntable(const PictureDialog& dialog);
  void remember(const QString& path);
  void fillRecent();
  void keysDialog();
  void setKey(Command command, const QKeySequence& key);
  void makeStereoMenu();
  void setFullScreen(bool on);
  void menuAt(const PointerSample& sample, const QPoint& global);  // chooses what lies there first
  void menuOf(const Selection& chosen, std::optional<Hit> at, const QPoint& global,
              const std::optional<EdgeNear>& led = std::nullopt);
  void askScan();
  void addMatching(QMenu& menu, const Selection& chosen);
  void addScanOperations(QMenu& menu, const std::string& name);
  void askNumbers(Operation operation);  // before it is done
  std::optional<SewPatch> patch_;        // what the menu of the right button offers
  std::string scan_;                     // under it; empty: none
  void askBlock();                       // a new garment from a ready block
  void menuOfPlace(PlacePiece place, const QPoint& global);
  void offer(QMenu& menu, const Message& words, Operation operation);
  void offer(QMenu& menu, const Message& words, std::function<void()> what);
  // `led`: the edge that was chosen before, which may be led along this one.
  void addEdgeOperations(QMenu& menu, const EdgeNear& near, const std::optional<EdgeNear>& led);
  void addDartOperations(QMenu& menu, const EdgeNear& near, double share);
  void addSpreads(QMenu& menu, const EdgeNear& near, double share, const EdgeNear& led);
  void addPartnerOperations(QMenu& menu, const EdgeNear& near, const EdgeNear& led);
  void addFasteningOperations(QMenu& menu, const EdgeNear& near);
  void addRunOperations(QMenu& menu, const EdgeRef& ref, const std::vector<EdgeRef>& run);
  void addNewPieces(QMenu& pieces, QMenu& details);
  void addPieceOperations(QMenu& menu, const Selection& chosen);
  // In the folder of documents; of a file that is not there yet.
  QString called(const Message& what) const;
  QString proposed(const Message& what, const FileFormat& format) const;
  QString freshPath(const QString& name, const FileFormat& format = fileFormat("document")) const;

  LatencyLog latencyLog_;
  std::unique_ptr<Session> session_;
  QStackedWidget* parts_ = nullptr;
  StartPage* start_ = nullptr;  // null: not shown yet
  SpaceView* space_ = nullptr;
  PatternView* table_ = nullptr;
  QTabWidget* boards_ = nullptr;
  std::vector<Panel*> panels_;
  std::map<Command, QAction*> actions_;
  QMenu* recent_ = nullptr;
  QMenu* viewMenu_ = nullptr;
  QAction* fullScreen_ = nullptr;
  QToolBar* tools_ = nullptr;
  QToolBar* top_ = nullptr;
  QLabel *hint_, *place_;
  Notices* notices_;
  DropMenuFrame *spaceMenu_, *tableMenu_;  // where a drag was dropped
  QAction* mirrorSeams_ = nullptr;
  using Heard = std::array<QString, 4>;
  Heard heard_;  // last of the fingertip
  QProgressBar* progress_;
  QPushButton* mend_ = nullptr;  // under the toast: does what it advises
  QTimer wake_;
  QElapsedTimer sinceRefresh_;
  Guide* guide_ = nullptr;
  VariablesDialog* variables_ = nullptr;  // null: not asked for yet
  Cap* cap_ = nullptr;
  std::unique_ptr<ForceFeedback> force_;
  SessionChanges seen_;
  QString shownPath_;
};

}  // namespace karinui::studio

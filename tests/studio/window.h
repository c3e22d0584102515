#pragma once
// A real window on a display of its own (Xvfb, Mesa), worked with mouse and keys. Without Xvfb the tests are skipped
// and say so. Nothing here sleeps: comeToRest() handles events until nothing is under way and the picture is drawn.
#include <gtest/gtest.h>

#include <QApplication>
#include <QMouseEvent>
#include <QPushButton>
#include <QSettings>
#include <QSlider>
#include <QSurfaceFormat>
#include <QWheelEvent>
#include <filesystem>

#include "length_box.h"
#include "main_window.h"
#include "self_check.h"
#include "theme.h"

namespace karinui::studio {

namespace fs = std::filesystem;

// Empty: there is a display. Starts one if there is none; it ends with this process.
std::string displayTrouble();
QApplication& application();
QPointF knobOf(const QSlider& slider);

// A folder that goes with the test.
struct Folder {
  fs::path path;
  Folder() {
    static int count = 0;
    path = fs::temp_directory_path() / ("karinui_studio_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    fs::create_directories(path);
  }
  ~Folder() {
    std::error_code trouble;
    fs::remove_all(path, trouble);
  }
};

// Whether the window's pictures are looked at. Where they are not, much less is drawn than the processor would have to.
enum class Pictures { Rough, Whole };

class Window {
 public:
  explicit Window(Pictures pictures = Pictures::Rough);
  MainWindow& main() { return *main_; }
  Session& session() { return main_->session(); }
  SpaceView& space() { return main_->space(); }
  PatternView& table() { return main_->table(); }
  void rest() { comeToRest(*main_); }
  void open(const fs::path& path) {
    main_->openPath(QString::fromStdString(path.string()));
    rest();
  }
  void view(View side) {
    space().look(side);
    rest();
  }
  // The sewn tunic, draped once for all tests, in a file of this test's own.
  void openTunic();
  void openExample(const std::string& name);  // of examples/, played now

  QPointF inSpace(const char* piece, Flat paper);
  QPointF onTable(const char* piece, Flat paper);
  QPointF onSkin(const char* place);  // a BodyPoint as text
  // A drag with the left button: press, moves, release. `before` is called before the release.
  void drag(QWidget& widget, std::vector<QPointF> path, Qt::KeyboardModifiers keys = {},
            std::function<void()> before = {}, Qt::MouseButton button = Qt::LeftButton, bool release = true);
  void click(QWidget& widget, QPointF at) { drag(widget, {at}); }
  void hover(QWidget& widget, QPointF at);
  void key(Command command) { main_->action(command)->trigger(); }
  void type(QWidget& widget, int key, Qt::KeyboardModifiers keys = {});
  LengthBox& box(const char* name);                // by the name it says of itself
  void type(LengthBox& box, const QString& text);  // and Enter
  QPushButton& button(const char* text);
  std::string last() const;  // the last step, as text
  std::size_t count() const { return main_->session().steps().size(); }
  void keepDialog(QWidget& dialog, const std::string& name);
  void keep(const std::string& name);  // a picture for the manual, where KARINUI_PICTURES says

 private:
  std::unique_ptr<MainWindow> main_;
  Folder folder_;
};

#define KARINUI_NEEDS_DISPLAY() \
  if (const std::string why = displayTrouble(); !why.empty()) GTEST_SKIP() << why

}  // namespace karinui::studio

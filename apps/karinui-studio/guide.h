#pragma once
// The first garment, step by step, over the 3D view. It watches what is done and goes on by itself; it can be skipped
// at any time. GUI thread.
#include <QFrame>

class QLabel;

namespace karinui::studio {

class MainWindow;

class Guide : public QFrame {
  Q_OBJECT
 public:
  Guide(MainWindow& window, QWidget* over);
  void begin();
  void refresh();
  int step() const { return step_; }
  static int steps();

 private:
  void show(int step);
  MainWindow& window_;
  QLabel *count_, *title_, *words_;
  int step_ = -1;
};

}  // namespace karinui::studio

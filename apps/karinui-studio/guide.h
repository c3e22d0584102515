#pragma once
// The first garment, step by step, in a strip above the views: it covers nothing. It watches what is done, goes on by
// itself and goes back where a step is undone; it can be paged through and skipped. GUI thread.
#include <QFrame>
#include <vector>

#include "karinui/session/session.h"

class QLabel;
class QPushButton;

namespace karinui::studio {

class MainWindow;

// Which of the four seams a first garment needs are there: the shoulder and the side, left and right, each from a front
// piece to a back piece.
struct FirstSeams {
  bool shoulderLeft = false, shoulderRight = false, sideLeft = false, sideRight = false;
  int count() const { return shoulderLeft + shoulderRight + sideLeft + sideRight; }
};
FirstSeams firstSeams(const GarmentSnapshot& fitting);

class Guide : public QFrame {
  Q_OBJECT
 public:
  explicit Guide(MainWindow& window);
  void begin();
  void refresh();
  int step() const { return step_; }
  static int steps();

 private:
  void show(int step);
  std::vector<bool> done() const;  // by step
  MainWindow& window_;
  QLabel *count_, *title_, *words_;
  QPushButton *back_, *next_;
  std::vector<bool> seen_;  // done(), when last looked at
  int step_ = -1;
};

}  // namespace karinui::studio

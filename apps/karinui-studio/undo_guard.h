#pragma once
// An event filter for the whole program: undo and redo take back typing only in a box in which something is half typed.
// In any other box of the main window they are the garment's, although a box claims their keys. GUI thread.
#include <QObject>

namespace karinui::studio {

class UndoGuard : public QObject {
 public:
  static void install();  // once for the application that runs, however often it is called

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  using QObject::QObject;
};

}  // namespace karinui::studio

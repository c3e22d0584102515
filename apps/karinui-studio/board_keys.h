#pragma once
// An event filter for the whole program: whose the keys are while a box of the main window has the focus. Undo and redo
// take back typing only where something is half typed; in any other box they are the garment's, although a box claims
// them. A box that was clicked into leaves the keys to the fitting once Return was pressed, as a LengthBox does by
// itself. GUI thread.
#include <QObject>

namespace karinui::studio {

class BoardKeys : public QObject {
 public:
  static void install();  // once for the application that runs, however often it is called

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  using QObject::QObject;
};

}  // namespace karinui::studio

#pragma once
// An event filter for the whole program: a number box or slider reacts to the wheel only while it has the focus, a
// combo box or tab bar never. Else the wheel event goes on to the parent, so that what the box lies in scrolls. GUI
// thread.
#include <QObject>

namespace karinui::studio {

class WheelGuard : public QObject {
 public:
  static void install();  // once for the application that runs, however often it is called

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  using QObject::QObject;
};

}  // namespace karinui::studio

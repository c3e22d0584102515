#pragma once
// A frame round what has the focus, once a person works with keys: views, tabs, tools, lists and scrolled boards do not
// show it themselves. A press of the mouse takes it away. It never has the focus and never meets the mouse. Enter
// presses a button that has the focus, as it does in a dialog. GUI thread.
#include <QPointer>
#include <QWidget>

namespace karinui::studio {

class FocusFrame : public QWidget {
 public:
  explicit FocusFrame(QWidget* window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void place();
  QPointer<QWidget> around_;
  bool byKeys_ = false;
};

}  // namespace karinui::studio

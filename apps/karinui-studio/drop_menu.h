#pragma once
// The session's drop menu as buttons beside the place of the drop. The view keeps the keyboard: arrows and Enter reach
// the menu through the session. GUI thread.
#include <QFrame>
#include <utility>
#include <vector>

#include "karinui/session/session.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QToolButton;
class QVBoxLayout;

namespace karinui::studio {

class DropMenuFrame : public QFrame {
  Q_OBJECT
 public:
  DropMenuFrame(Session& session, QWidget* view);
  // Shows the menu with a corner beside `at`, within the view; nothing: hides it.
  void show(const std::optional<DropMenu>& menu, QPointF at);
  QString heard() const;  // what is asked and which item Enter takes, for those who hear the screen

 signals:
  void chosen();

 private:
  void place(QPointF at);
  void showNumber(const std::optional<DropMenu::Number>& number);
  void takeNumber();
  bool eventFilter(QObject* watched, QEvent* event) override;  // of the number

  Session& session_;
  QVBoxLayout* column_;
  QLabel* title_;
  std::vector<QPushButton*> buttons_;
  QWidget* numberRow_;
  QDoubleSpinBox* number_;
  QToolButton* take_;
  std::pair<double, double> range_;  // of the number that is shown
  std::size_t current_ = 0;
};

}  // namespace karinui::studio

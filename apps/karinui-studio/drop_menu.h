#pragma once
// The session's drop menu as buttons beside the place of the drop. The view keeps the keyboard: arrows and Enter reach
// the menu through the session. GUI thread.
#include <QFrame>
#include <array>
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
  std::array<double, 3> offered_{};  // least, most and value of the number, until the menu goes
  std::size_t current_ = 0;
};

}  // namespace karinui::studio

#pragma once
// The session's drop menu as buttons beside the place of the drop. The view keeps the keyboard: arrows and Enter reach
// the menu through the session. GUI thread.
#include <QDoubleSpinBox>
#include <QFrame>
#include <array>
#include <optional>
#include <vector>

#include "karinui/session/session.h"

class QLabel;
class QPushButton;
class QToolButton;
class QVBoxLayout;

namespace karinui::studio {

// A number, or a length that is typed in any unit. Its text stays as it was typed until it is taken.
class DropNumber : public QDoubleSpinBox {
 public:
  using QDoubleSpinBox::QDoubleSpinBox;
  double unit = 0;                         // metres, of a length; 0: a plain number
  std::optional<double> read() const;      // in that unit; nothing: what is typed is none
  std::optional<Message> trouble() const;  // of what is typed

 protected:
  QValidator::State validate(QString&, int&) const override { return QValidator::Acceptable; }
  double valueFromText(const QString& text) const override;
};

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
  bool eventFilter(QObject* watched, QEvent* event) override;  // of the number, and of the view before it
  bool typesNumber(const QEvent& event) const;                 // a key that begins one, while one is asked

  Session& session_;
  QVBoxLayout* column_;
  QLabel* title_;
  std::vector<QPushButton*> buttons_;
  QWidget* numberRow_;
  DropNumber* number_;
  QToolButton* take_;
  std::array<double, 3> offered_{};  // least, most and value of the number, until the menu goes
  std::size_t current_ = 0;
};

}  // namespace karinui::studio

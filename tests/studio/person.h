#pragma once
// A person before the window: every click, drag, key and typed value goes through the window system's queue to whatever
// lies there, and is counted. What is covered, hidden or out of reach is a failure, for a person could not do it
// either.
#include <QObject>
#include <QScrollArea>
#include <string>
#include <vector>

#include "studio/window.h"

class QComboBox;

namespace karinui::studio {

class Person {
 public:
  explicit Person(Window& window) : w_(window) {}
  ~Person();
  int inputs() const { return inputs_; }
  const std::vector<std::string>& done() const { return done_; }

  void click(QWidget& widget, QPointF at, Qt::MouseButton button = Qt::LeftButton);
  void click(QWidget& widget) { click(widget, QRectF(widget.rect()).center()); }
  void drag(QWidget& widget, const std::vector<QPointF>& path, Qt::MouseButton button = Qt::LeftButton);
  void key(int key, Qt::KeyboardModifiers with = {}, int times = 1);  // each counts
  void menuKey(QWidget& widget);
  void type(const QString& text, Qt::Key end);  // over what is in the focus; one input
  void board(int which);                        // its tab
  void choose(const Message& item);             // of the menu that is open
  void choose(QComboBox& box, int item);        // opened, and taken
  QPushButton& button(const Message& words);
  LengthBox& box(const Message& name);
  // Until a dialog that is open has answered: `then` is called once it is there. One that never comes is a failure.
  void inDialog(std::function<void(QWidget&)> then);

 private:
  void count(const std::string& what);
  void scrollTo(QWidget& widget);
  Window& w_;
  int inputs_ = 0;
  std::vector<std::string> done_;
  QObject waiting_;  // whose children wait for dialogs
};

}  // namespace karinui::studio

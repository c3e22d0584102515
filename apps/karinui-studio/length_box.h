#pragma once
// A box in which a length is read and typed: in metres inside, shown in centimetres or inches as the person chose, and
// understanding either ("12", "3.5in", "40 mm"), or a formula where it takes formulas. What cannot be is refused with
// what can, and the number that holds is shown again. It bears its name for those who hear the screen. GUI thread.
#include <QDoubleSpinBox>
#include <functional>
#include <optional>
#include <utility>

#include "karinui/base/result.h"

class QLineEdit;

namespace karinui::studio {

// Somebody is at it: it has the keys, and its text is not what was shown last.
bool beingTyped(const QLineEdit& line);
// Metres in what was typed: a bare number is in the person's own unit. Nothing: no length.
std::optional<double> metresIn(QString text);

class LengthBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  LengthBox(const Message& name, double low, double high);  // metres
  void setMetres(double metres);                            // tells nobody
  void setLongest(double metres);                           // nor does this
  // From now on formulas are understood too; `value` works one out. What it comes to is shown below while one types.
  void takeFormulas(std::function<Result<double>(const std::string& formula)> value);
  bool holdsFormula() const;                  // typed, and not entered yet
  void suggest(const QString& followed);      // what it is while nothing is typed, seen where the box is empty
  void letBeEmpty();                          // nothing is typed: the least
  void setSensible(double low, double high);  // what may be typed, told of what may not

 signals:
  void typed(double metres);
  void formulaTyped(const QString& formula, double metres);
  void refused(const karinui::Error& why);  // of what was entered; a formula's text stays
  void left();                              // Return was struck in a box that was clicked into

 protected:
  QString textFromValue(double metres) const override;
  double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& at) const override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  bool enterFormula();                                  // false: refused
  std::optional<Error> trouble() const;                 // of a number that is typed
  bool putBack();                                       // such a one; the one that holds is shown
  void keepTyped(const std::function<void()>& change);  // what is being typed stays while the value changes
  bool saysNothing(const QString& text) const;
  Message name_;
  std::optional<std::pair<double, double>> sensible_;
  bool mayBeEmpty_ = false;
  std::function<Result<double>(const std::string&)> formulaValue_;
  bool clickedInto_ = false;  // by the click that is under way
  bool byMouse_ = false;      // it has the focus by a click
};

}  // namespace karinui::studio

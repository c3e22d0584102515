#pragma once
// A box in which a length is read and typed: in metres inside, shown in centimetres or inches as the person chose, and
// understanding either ("12", "3.5in", "40 mm"), or a formula where it takes formulas. It bears its name for those who
// hear the screen. GUI thread.
#include <QDoubleSpinBox>
#include <functional>
#include <optional>

#include "karinui/base/result.h"

namespace karinui::studio {

// Metres in what was typed: a bare number is in the person's own unit. Nothing: no length.
std::optional<double> metresIn(QString text);

class LengthBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  LengthBox(const Message& name, double low, double high);  // metres
  void setMetres(double metres);                            // tells nobody
  // From now on formulas are understood too; `value` works one out. What it comes to is shown below while one types.
  void takeFormulas(std::function<Result<double>(const std::string& formula)> value);

 signals:
  void typed(double metres);
  void formulaTyped(const QString& formula, double metres);
  void refused(const karinui::Error& why);  // of a formula that was entered; its text stays
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
  bool holdsFormula() const;
  bool enterFormula();  // false: refused
  std::function<Result<double>(const std::string&)> formulaValue_;
  bool clickedInto_ = false;  // by the click that is under way
  bool byMouse_ = false;      // it has the focus by a click
};

}  // namespace karinui::studio

#pragma once
// A box in which a length is read and typed: in metres inside, shown in centimetres or inches as the person chose, and
// understanding either ("12", "3.5in", "40 mm"). It bears its name for those who hear the screen. GUI thread.
#include <QDoubleSpinBox>
#include <optional>

#include "karinui/base/message.h"

namespace karinui::studio {

// Metres in what was typed: a bare number is in the person's own unit. Nothing: no length.
std::optional<double> metresIn(QString text);

class LengthBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  LengthBox(const Message& name, double low, double high);  // metres
  void setMetres(double metres);                            // tells nobody

 signals:
  void typed(double metres);

 protected:
  QString textFromValue(double metres) const override;
  double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& at) const override;
};

}  // namespace karinui::studio

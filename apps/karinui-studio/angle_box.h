#pragma once
// A box in which whole degrees are read and typed, full-width digits too. What cannot be is refused with what can, and
// the number that holds is shown again. GUI thread.
#include <QSpinBox>
#include <optional>

#include "karinui/base/message.h"

namespace karinui::studio {

class AngleBox : public QSpinBox {
  Q_OBJECT
 public:
  AngleBox();
  bool typing() const;  // something is typed, and not entered yet

 signals:
  void refused(const karinui::Message& why);

 protected:
  int valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& at) const override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  std::optional<int> typed() const;  // none: no number
  bool putBack();                    // what cannot be; the number that holds is shown
};

}  // namespace karinui::studio

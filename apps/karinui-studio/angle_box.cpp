#include "angle_box.h"

#include <QKeyEvent>
#include <QLineEdit>

#include "theme.h"

namespace karinui::studio {

namespace {

std::optional<int> degreesIn(QString text) {
  text = text.normalized(QString::NormalizationForm_KC);
  text.replace(QChar(0x2212), '-').remove(QChar(0x00b0));  // a minus sign, and the degrees themselves
  bool is = false;
  const int degrees = text.trimmed().toInt(&is);
  return is ? std::optional(degrees) : std::nullopt;
}

}  // namespace

AngleBox::AngleBox() {
  setSuffix(QString::fromUtf8("°"));
  setButtonSymbols(QAbstractSpinBox::NoButtons);
  setKeyboardTracking(false);
}

bool AngleBox::typing() const { return lineEdit()->text() != textFromValue(value()) + suffix(); }

std::optional<int> AngleBox::typed() const { return degreesIn(lineEdit()->text()); }

bool AngleBox::putBack() {
  const auto degrees = typed();
  if (!typing() || (degrees && *degrees >= minimum() && *degrees <= maximum())) return false;
  const QString text = lineEdit()->text().remove(suffix()).trimmed();
  setValue(value());
  const auto said = [this](int one) { return (textFromValue(one) + suffix()).toStdString(); };
  if (degrees)
    emit refused(say("{0}: it can be between {1} and {2}, not {3}.", accessibleName().toStdString(), said(minimum()),
                     said(maximum()), said(*degrees)));
  else
    emit refused(say("“{0}” is no angle; {1} can be between {2} and {3}.", text.toStdString(),
                     accessibleName().toStdString(), said(minimum()), said(maximum())));
  return true;
}

int AngleBox::valueFromText(const QString& text) const { return degreesIn(text).value_or(value()); }

// Anything may be typed; what is no good is told of when it is entered.
QValidator::State AngleBox::validate(QString& text, int&) const {
  const auto degrees = degreesIn(text);
  return degrees && *degrees >= minimum() && *degrees <= maximum() ? QValidator::Acceptable : QValidator::Intermediate;
}

void AngleBox::keyPressEvent(QKeyEvent* event) {
  if ((event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) && putBack()) return event->accept();
  QSpinBox::keyPressEvent(event);
}

void AngleBox::focusOutEvent(QFocusEvent* event) {
  putBack();
  QSpinBox::focusOutEvent(event);
}

}  // namespace karinui::studio

#include "length_box.h"

#include <QLineEdit>
#include <QSignalBlocker>
#include <optional>

#include "karinui/base/number.h"
#include "theme.h"

namespace karinui::studio {

std::optional<double> metresIn(QString text) {
  const std::string said = text.replace(',', '.').replace('"', "in").remove(' ').toStdString();
  if (const auto bare = parseNumber(said)) return *bare * (Theme::here().inches() ? 0.0254 : 0.01);
  const auto length = parseLength(said);
  return length ? std::optional(*length) : std::nullopt;
}

LengthBox::LengthBox(const Message& name, double low, double high) {
  setDecimals(7);  // a tenth of a micron: no typed number is rounded
  setRange(low, high);
  setSingleStep(0.005);
  setKeyboardTracking(false);
  setButtonSymbols(QAbstractSpinBox::NoButtons);
  Theme::here().keep(this, [this, name] {
    setAccessibleName(inWords(name));
    setMetres(value());
  });
  connect(this, &QDoubleSpinBox::valueChanged, this, &LengthBox::typed);
}

void LengthBox::setMetres(double metres) {
  const QSignalBlocker quiet(this);
  setValue(metres);
  lineEdit()->setText(textFromValue(value()));  // the same number in another unit, too
}

QString LengthBox::textFromValue(double metres) const {
  return value() == minimum() && !specialValueText().isEmpty() ? specialValueText() : lengthText(metres, 2);
}
double LengthBox::valueFromText(const QString& text) const { return metresIn(text).value_or(value()); }
QValidator::State LengthBox::validate(QString& text, int&) const {
  return metresIn(text) || text == specialValueText() ? QValidator::Acceptable : QValidator::Intermediate;
}

}  // namespace karinui::studio

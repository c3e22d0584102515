#include "length_box.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "karinui/base/number.h"
#include "theme.h"

namespace karinui::studio {

std::optional<double> metresIn(QString text) {
  static const QRegularExpression fraction("[/⁄½¼¾⅛⅜⅝⅞'′]"), unitless("[\\d½¼¾⅛⅜⅝⅞]\\s*$");
  if (text.contains(fraction)) {
    if (Theme::here().inches() && text.contains(unitless)) text += "in";
    const auto length = parseLength(text.toStdString());
    return length ? std::optional(*length) : std::nullopt;
  }
  text = text.normalized(QString::NormalizationForm_KC);  // digits of full width
  const std::string said = text.replace(',', '.').replace('"', "in").remove(' ').toStdString();
  constexpr double kFinest = 1e9;  // to the metre: 94 cm are 0.94 m in the record, not 0.9400000000000001
  if (const auto bare = parseNumber(said))
    return std::round(*bare * (Theme::here().inches() ? 0.0254 : 0.01) * kFinest) / kFinest;
  const auto length = parseLength(said);
  return length ? std::optional(*length) : std::nullopt;
}

LengthBox::LengthBox(const Message& name, double low, double high) : name_(name) {
  setDecimals(7);  // a tenth of a micron: no typed number is rounded
  setRange(low, high);
  setSingleStep(0.005);
  setKeyboardTracking(false);
  setButtonSymbols(QAbstractSpinBox::NoButtons);
  lineEdit()->installEventFilter(this);
  Theme::here().keep(this, [this, name] {
    setAccessibleName(inWords(name));
    setMetres(value());
  });
  connect(this, &QDoubleSpinBox::valueChanged, this, &LengthBox::typed);
}

bool beingTyped(const QLineEdit& line) {
  const QWidget* focus = line.window()->focusWidget();
  return line.isModified() && focus && (focus == &line || focus == line.parentWidget());
}

void LengthBox::keepTyped(const std::function<void()>& change) {
  const QSignalBlocker quiet(this);
  const bool typing = beingTyped(*lineEdit());
  const QString text = lineEdit()->text();
  const int at = lineEdit()->cursorPosition();
  change();
  if (!typing) return;
  lineEdit()->setText(text);
  lineEdit()->setModified(true);
  lineEdit()->setCursorPosition(at);
}

void LengthBox::setMetres(double metres) {
  keepTyped([&] {
    setValue(metres);
    lineEdit()->setText(textFromValue(value()));  // the same number in another unit, too
  });
}

void LengthBox::setLongest(double metres) {
  keepTyped([&] { setMaximum(metres); });
}

void LengthBox::takeFormulas(std::function<Result<double>(const std::string& formula)> value) {
  formulaValue_ = std::move(value);
  connect(lineEdit(), &QLineEdit::textEdited, this, [this] {
    if (!holdsFormula()) return QToolTip::hideText();
    const auto now = formulaValue_(lineEdit()->text().trimmed().toStdString());
    QToolTip::showText(mapToGlobal(QPoint(0, height())), now ? "= " + lengthText(*now, 2) : inWords(now.error().what),
                       this);
  });
}

bool LengthBox::holdsFormula() const {
  const QString text = lineEdit()->text().trimmed();
  return formulaValue_ && !text.isEmpty() && text != specialValueText() && !metresIn(text);
}

void LengthBox::suggest(const QString& followed) { lineEdit()->setPlaceholderText(followed); }

void LengthBox::letBeEmpty() {
  mayBeEmpty_ = true;
  setMetres(minimum());
}
void LengthBox::setSensible(double low, double high) { sensible_ = {low, high}; }

bool LengthBox::saysNothing(const QString& text) const {
  return text.trimmed().isEmpty() ? mayBeEmpty_ || !specialValueText().isEmpty()
                                  : !specialValueText().isEmpty() && text == specialValueText();
}

std::optional<Error> LengthBox::trouble() const {
  constexpr double kRounding = 1e-9;  // metres
  const QString typed = lineEdit()->text().trimmed();
  if (typed.isEmpty() || typed == textFromValue(value()) || typed == specialValueText() || holdsFormula()) return {};
  const auto metres = metresIn(typed);
  if (!metres)
    return karinui::refused(
        say("“{0}” is no length; type a number, like {1}.", typed.toStdString(), lengthText(0.125).toStdString()));
  const auto [low, high] = sensible_.value_or(std::pair(minimum(), maximum()));
  if (*metres >= low - kRounding && *metres <= high + kRounding) return {};
  return karinui::refused(say("{0}: it can be between {1} and {2}, not {3}.", name_, lengthText(low, 2).toStdString(),
                              lengthText(high, 2).toStdString(), lengthText(*metres, 2).toStdString()));
}

bool LengthBox::putBack() {
  const auto why = trouble();
  if (!why) return false;
  lineEdit()->setModified(false);
  setMetres(value());
  QToolTip::showText(mapToGlobal(QPoint(0, height())), inWords(why->what).toHtmlEscaped(), this);
  emit refused(*why);
  return true;
}

bool LengthBox::enterFormula() {
  const QString formula = lineEdit()->text().trimmed();
  const auto metres = formulaValue_(formula.toStdString());
  if (!metres) return emit refused(metres.error()), false;
  QToolTip::hideText();
  lineEdit()->setModified(false);
  setMetres(*metres);
  emit formulaTyped(formula, *metres);
  return true;
}

void LengthBox::keyPressEvent(QKeyEvent* event) {
  const bool enter = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
  if (enter && putBack()) return event->accept();
  if (!enter || !holdsFormula())
    QDoubleSpinBox::keyPressEvent(event);
  else if (event->accept(); !enterFormula())
    return;
  if (enter) lineEdit()->setModified(false);
  if (enter && byMouse_) emit left();
}

// What is typed after a click into the box takes the place of what stood there, as it does after Tab.
void LengthBox::focusInEvent(QFocusEvent* event) {
  QDoubleSpinBox::focusInEvent(event);
  if (event->reason() == Qt::PopupFocusReason || event->reason() == Qt::ActiveWindowFocusReason) return;
  clickedInto_ = byMouse_ = event->reason() == Qt::MouseFocusReason;
}
bool LengthBox::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseButtonRelease) {
    const bool first = std::exchange(clickedInto_, false);
    if (!specialValueText().isEmpty() && lineEdit()->text() == specialValueText())
      QMetaObject::invokeMethod(lineEdit(), &QLineEdit::clear,
                                Qt::QueuedConnection);  // nothing to type before or behind
    else if (first && !lineEdit()->hasSelectedText())
      QMetaObject::invokeMethod(this, &LengthBox::selectAll, Qt::QueuedConnection);
  }
  return QDoubleSpinBox::eventFilter(watched, event);
}

// A formula that is no good goes when one leaves the box, as a number does that is none.
void LengthBox::focusOutEvent(QFocusEvent* event) {
  if (holdsFormula())
    enterFormula();
  else
    putBack();
  QDoubleSpinBox::focusOutEvent(event);
}

QString LengthBox::textFromValue(double metres) const {
  if (metres == minimum() && (mayBeEmpty_ || !specialValueText().isEmpty())) return specialValueText();
  return lengthText(metres, 2);
}
double LengthBox::valueFromText(const QString& text) const {
  return saysNothing(text) ? minimum() : metresIn(text).value_or(value());
}
QValidator::State LengthBox::validate(QString& text, int& at) const {
  const QString& none = specialValueText();
  if (!none.isEmpty() && text != none && text.contains(none)) {  // what is typed takes its place
    text.remove(none);
    at = std::min(at, static_cast<int>(text.size()));
  }
  return saysNothing(text) || metresIn(text) ? QValidator::Acceptable : QValidator::Intermediate;
}

}  // namespace karinui::studio

#include "drop_menu.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStyle>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "karinui/base/number.h"
#include "length_box.h"
#include "theme.h"

namespace karinui::studio {

std::optional<double> DropNumber::read() const {
  const QString typed = lineEdit()->text().trimmed();
  if (unit > 0) {
    const auto metres = metresIn(typed);
    return metres ? std::optional(*metres / unit) : std::nullopt;
  }
  const auto number = parseNumber(typed.normalized(QString::NormalizationForm_KC).replace(',', '.').toStdString());
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<Message> DropNumber::trouble() const {
  const std::string typed = lineEdit()->text().trimmed().toStdString();
  const auto number = read();
  if (!number)
    return unit > 0 ? say("“{0}” is no length; type a number, like {1}.", typed, lengthText(0.125).toStdString())
                    : say("“{0}” is no number.", typed);
  constexpr double kRounding = 1e-9;
  if (*number >= minimum() - kRounding && *number <= maximum() + kRounding) return {};
  const auto said = [this](double value) {
    return (unit > 0 ? lengthText(value * unit, 2) : textFromValue(value)).toStdString();
  };
  return say("{0}: it can be between {1} and {2}, not {3}.", accessibleName().toStdString(), said(minimum()),
             said(maximum()), said(*number));
}

double DropNumber::valueFromText(const QString&) const { return read().value_or(value()); }

DropMenuFrame::DropMenuFrame(Session& session, QWidget* view) : QFrame(view), session_(session) {
  setObjectName("drop_menu");
  column_ = new QVBoxLayout(this);
  column_->setContentsMargins(10, 10, 10, 10);
  column_->setSpacing(4);
  title_ = new QLabel;
  title_->setWordWrap(true);
  column_->addWidget(title_);
  number_ = new DropNumber;
  number_->setObjectName("drop_number");
  number_->setKeyboardTracking(false);
  number_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  number_->setFocusPolicy(Qt::ClickFocus);
  number_->installEventFilter(this);
  view->installEventFilter(this);
  take_ = new QToolButton;
  take_->setFocusPolicy(Qt::NoFocus);
  connect(take_, &QToolButton::clicked, this, [this] { takeNumber(); });
  auto* row = new QHBoxLayout;
  row->addWidget(number_);
  row->addWidget(take_, 1);
  numberRow_ = new QWidget;
  numberRow_->setLayout(row);
  row->setContentsMargins(0, 0, 0, 0);
  column_->addWidget(numberRow_);
  hide();
}

void DropMenuFrame::show(const std::optional<DropMenu>& menu, QPointF at) {
  if (!menu) return offered_ = {}, hide();
  QStringList title;
  for (const Message& words : menu->title) title << inWords(words);
  title_->setText(title.join('\n'));
  while (buttons_.size() < menu->items.size()) {
    auto* made = new QPushButton;
    made->setFocusPolicy(Qt::NoFocus);
    const std::size_t which = buttons_.size();
    connect(made, &QPushButton::clicked, this, [this, which] {
      session_.choose(which);
      emit chosen();
    });
    column_->insertWidget(column_->count() - 1, made);
    buttons_.push_back(made);
  }
  current_ = menu->current;
  for (std::size_t k = 0; k < buttons_.size(); ++k) {
    QPushButton& button = *buttons_[k];
    button.setVisible(k < menu->items.size());
    if (k >= menu->items.size()) continue;
    const DropMenu::Item& item = menu->items[k];
    const QString mark = !item.checked ? QString() : *item.checked ? QString("☑  ") : QString("☐  ");
    button.setText(mark + inWords(item.label));
    button.setAccessibleName(inWords(item.label));
  }
  showNumber(menu->number);
  const Palette& p = Theme::here().palette();
  setStyleSheet(QString("QFrame#drop_menu { background: %1; border: 1px solid %2; border-radius: 10px; }"
                        "QFrame#drop_menu QPushButton { text-align: left; padding: 5px 10px; border: 1px solid %1; }"
                        "QFrame#drop_menu QPushButton:hover { border: 1px solid %3; }"
                        "QFrame#drop_menu QPushButton[current=\"true\"] { background: %4; border: 1px solid %3; }")
                    .arg(p.raised.name(), p.line.name(), p.accent.name(), p.accentSoft.name()));
  for (std::size_t k = 0; k < buttons_.size(); ++k) {
    buttons_[k]->setProperty("current", k == current_);
    buttons_[k]->style()->unpolish(buttons_[k]), buttons_[k]->style()->polish(buttons_[k]);
  }
  place(at);
  QFrame::show();
  raise();
}

void DropMenuFrame::showNumber(const std::optional<DropMenu::Number>& number) {
  numberRow_->setVisible(number.has_value());
  if (!number) return;
  number_->setAccessibleName(inWords(number->label));
  take_->setText(inWords(number->label));
  if (window()->focusWidget() == number_) return;  // what is being typed stays
  number_->unit = number->unit;
  number_->setDecimals(number->decimals);
  if (const auto offered = std::array{number->least, number->most, number->value}; offered != offered_) {
    offered_ = offered;
    number_->setRange(number->least, number->most);
    number_->setValue(number->value);
  }
  if (number->asked) number_->setFocus(), number_->selectAll();
}

void DropMenuFrame::takeNumber() {
  if (const auto why = number_->trouble()) {
    session_.refuse(badInput(*why));
    number_->setFocus(), number_->selectAll();
    return;
  }
  const double typed = *number_->read();
  parentWidget()->setFocus();
  offered_ = {};
  session_.chooseNumber(typed);
  emit chosen();
}

bool DropMenuFrame::typesNumber(const QEvent& event) const {
  if (!isVisible() || numberRow_->isHidden()) return false;
  const auto& key = static_cast<const QKeyEvent&>(event);
  if (key.modifiers() & ~(Qt::KeypadModifier | Qt::ShiftModifier)) return false;
  const QString text = key.text();
  return text.size() == 1 && (text[0].isDigit() || text[0] == '.' || text[0] == ',');
}

bool DropMenuFrame::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress && event->type() != QEvent::ShortcutOverride) return false;
  if (watched != number_) {
    if (!typesNumber(*event)) return false;
    if (event->type() == QEvent::ShortcutOverride) return event->accept(), true;
    number_->setFocus();
    number_->selectAll();
    return QApplication::sendEvent(number_, event), true;
  }
  const int key = static_cast<QKeyEvent*>(event)->key();
  if (event->type() == QEvent::ShortcutOverride) return event->accept(), true;  // digits are typed, not views
  if (key == Qt::Key_Return || key == Qt::Key_Enter) return takeNumber(), true;
  if (key == Qt::Key_Escape) return parentWidget()->setFocus(), true;
  return false;
}

void DropMenuFrame::place(QPointF at) {
  constexpr int kWide = 290, kBeside = 24, kRim = 8;  // pixels
  int wide = 0;
  for (const QPushButton* button : buttons_)
    if (!button->isHidden()) wide = std::max(wide, button->sizeHint().width());
  const int room = parentWidget()->width() - 2 * kRim;
  setFixedWidth(std::min(std::max(wide + 24, kWide), room));
  setFixedHeight(column_->heightForWidth(width()) > 0 ? column_->heightForWidth(width()) : sizeHint().height());
  const int right = static_cast<int>(at.x()) + kBeside, left = static_cast<int>(at.x()) - kBeside - width();
  const int x = right + width() + kRim <= parentWidget()->width() ? right : left;
  move(std::clamp(x, kRim, std::max(kRim, parentWidget()->width() - width() - kRim)),
       std::clamp(static_cast<int>(at.y()) - height() / 2, kRim,
                  std::max(kRim, parentWidget()->height() - height() - kRim)));
}

QString DropMenuFrame::heard() const {
  return isVisible() && current_ < buttons_.size() ? title_->text() + " " + buttons_[current_]->text() : QString();
}

}  // namespace karinui::studio

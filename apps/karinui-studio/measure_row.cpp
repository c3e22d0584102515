#include "measure_row.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QSlider>
#include <QStyle>
#include <QStyleOptionSpinBox>
#include <algorithm>
#include <cmath>

#include "length_box.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr double kReach = 0.25;  // of what is measured, to either side
constexpr double kMost = 10;     // metres; what a body can have is said where it is asked for
constexpr auto kWidest = "188.88 cm", kWidestGrey = "188.8 cm";
constexpr int kMargins = 4, kCursor = 1;  // of a line of text
constexpr int kSliderDigits = 7;
// What the style takes of a box: its frame and the room to either side of its text.
int frameOf(const QWidget& box) {
  QStyleOptionSpinBox option;
  option.initFrom(&box);
  option.frame = true, option.buttonSymbols = QAbstractSpinBox::NoButtons;
  constexpr int kWide = 200;
  option.rect = QRect(0, 0, kWide, box.sizeHint().height());
  return kWide - box.style()->subControlRect(QStyle::CC_SpinBox, &option, QStyle::SC_SpinBoxEditField, &box).width();
}
int millimetres(double metres) { return static_cast<int>(std::lround(1000 * metres)); }

}  // namespace

MeasureRow::MeasureRow(const Message& name)
    : box_(new LengthBox(name, 0, kMost)), slider_(new QSlider(Qt::Horizontal)) {
  box_->letBeEmpty();
  box_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  Theme::here().keep(slider_, [this, name] {
    slider_->setAccessibleName(inWords(name));
    const QFontMetrics letters = box_->fontMetrics();
    box_->ensurePolished();
    // What is greyed is told beside where a letter may reach to the left.
    const int typed = letters.horizontalAdvance(kWidest) + kCursor,
              grey = letters.horizontalAdvance(kWidestGrey) + std::max(0, -letters.minLeftBearing());
    box_->setFixedWidth(std::max(typed, grey) + kMargins + frameOf(*box_));
    slider_->setMinimumWidth(kSliderDigits * letters.horizontalAdvance("0"));
  });
  slider_->setFocusPolicy(Qt::ClickFocus);  // Tab goes from box to box, and Up and Down turn the box
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(box_);
  row->addWidget(slider_, 1);
  connect(box_, &LengthBox::typed, this, [this] {
    formula_.clear();
    emit set();
  });
  connect(box_, &LengthBox::formulaTyped, this, [this](const QString& formula) {
    formula_ = formula.toStdString();
    emit set();
  });
  for (QWidget* part : {static_cast<QWidget*>(box_), static_cast<QWidget*>(slider_)}) part->installEventFilter(this);
  connect(slider_, &QSlider::valueChanged, this, [this](int now) {
    box_->setMetres(now / 1000.0);
    formula_.clear();
    if (slider_->isSliderDown())
      emit turned();
    else
      emit set();
  });
  connect(slider_, &QSlider::sliderReleased, this, &MeasureRow::set);
}

std::optional<double> MeasureRow::stated() const {
  return box_->value() > 0 ? std::optional(box_->value()) : std::nullopt;
}

bool MeasureRow::eventFilter(QObject* who, QEvent* event) {
  if (event->type() == QEvent::FocusIn || event->type() == QEvent::Enter) emit entered();
  return QWidget::eventFilter(who, event);
}

void MeasureRow::show(std::optional<double> stated, const std::string& formula, double measured) {
  if (slider_->isSliderDown() || box_->hasFocus()) return;
  formula_ = formula;
  box_->suggest(measured > 0 ? lengthText(measured) : QString::fromUtf8("–"));
  box_->setToolTip(formula.empty() ? QString() : "= " + QString::fromStdString(formula));
  const QSignalBlocker quiet(slider_);
  box_->setMetres(stated.value_or(0));
  const double now = stated.value_or(measured);
  box_->setEnabled(true);
  slider_->setEnabled(now > 0);
  slider_->setRange(millimetres((1 - kReach) * now), millimetres((1 + kReach) * now));
  slider_->setValue(millimetres(now));
}

void MeasureRow::showMeasured(double measured) {
  const QSignalBlocker quiet(slider_);
  box_->setMetres(measured);
  box_->setEnabled(false);
  slider_->setEnabled(false);
  slider_->setRange(0, 2 * millimetres(measured));
  slider_->setValue(millimetres(measured));
}

}  // namespace karinui::studio

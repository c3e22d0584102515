#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>

#include "karinui/base/number.h"
#include "length_box.h"
#include "look.h"
#include "panels.h"

namespace karinui::studio {

FitPanel::FitPanel(Session& session, SpaceView& view) : Panel(session), view_(view) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(10);
  auto* form = new QFormLayout;
  form->addRow(title(say("Fit")));
  map_ = new QComboBox;
  Look::here().keep(map_, [this] {
    const int was = map_->currentIndex();
    const QSignalBlocker quiet(map_);
    map_->clear();
    map_->addItems({inWords(say("cloth")), inWords(say("strain")), inWords(say("distance to body"))});
    map_->setCurrentIndex(std::max(0, was));
  });
  form->addRow(word(say("Show")), map_);
  tape_ = new QCheckBox;
  Look::here().keep(tape_, [this] {
    tape_->setText(inWords(say("tape measure at the pointer")));
    tape_->setToolTip(
        inWords(say("On cloth the tape goes round the garment, on skin round the body, at the pointer's height.")));
  });
  form->addRow(word(say("Tape")), tape_);
  column->addLayout(form);
  report_ = new QLabel;
  report_->setWordWrap(true);
  report_->setTextFormat(Qt::RichText);
  column->addWidget(report_);

  form = new QFormLayout;
  form->addRow(title(say("Stereo")));
  stereo_ = new QComboBox;
  Look::here().keep(stereo_, [this] {
    const int was = stereo_->currentIndex();
    const QSignalBlocker quiet(stereo_);
    stereo_->clear();
    stereo_->addItems({inWords(say("off")), inWords(say("side by side")), inWords(say("top and bottom")),
                       inWords(say("red-cyan glasses")), inWords(say("row by row"))});
    stereo_->setCurrentIndex(std::max(0, was));
  });
  eyes_ = new LengthBox(say("Eyes apart"), 0, 0.2);
  eyes_->setMetres(0.063);
  focus_ = new QDoubleSpinBox;
  focus_->setRange(0.3, 3);
  focus_->setSingleStep(0.05);
  focus_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  focus_->setValue(1);
  form->addRow(word(say("Screen")), stereo_);
  form->addRow(word(say("Eyes apart")), eyes_);
  form->addRow(word(say("Depth of the screen")), focus_);
  column->addLayout(form);
  column->addStretch(1);
  connect(map_, &QComboBox::currentIndexChanged, this, [this](int i) { view_.setMap(static_cast<FitMap>(i)); });
  connect(tape_, &QCheckBox::toggled, this, [this](bool on) { view_.setTape(on); });
  connect(stereo_, &QComboBox::currentIndexChanged, this, [this](int i) { view_.setStereo(static_cast<Stereo>(i)); });
  for (QDoubleSpinBox* box : {static_cast<QDoubleSpinBox*>(eyes_), focus_})
    connect(box, &QDoubleSpinBox::valueChanged, this, [this] { view_.setEyes(eyes_->value(), focus_->value()); });
}

void FitPanel::refresh() {
  if (map_->currentIndex() != static_cast<int>(view_.map())) {
    const QSignalBlocker quiet(map_);
    map_->setCurrentIndex(static_cast<int>(view_.map()));
  }
  if (historyShown_ == session_.news().history) return;
  historyShown_ = session_.news().history;
  const auto& last = session_.fitting().document.drape.last;
  if (!last) {
    report_->setText(inWords(say("Not draped yet. Space settles the cloth.")));
    return;
  }
  const auto row = [](const QString& a, const QString& b) {
    return "<tr><td>" + a + "&nbsp;&nbsp;&nbsp;</td><td align=right>" + b + "</td></tr>";
  };
  const auto percent = [](double x) { return QString::fromStdString(fixed(100 * x, 2)) + " %"; };
  QString table = row(inWords(say("at rest")), last->settled ? inWords(say("yes")) : inWords(say("no")));
  table += row(inWords(say("mean strain")), percent(last->strain.mean));
  table += row(inWords(say("strain, 99 of 100")), percent(last->strain.p99));
  table += row(inWords(say("widest seam gap")), lengthText(last->seamGap, 2));
  table += row(inWords(say("deepest in the body")), lengthText(last->penetration, 3));
  report_->setText("<table>" + table + "</table>");
}

}  // namespace karinui::studio

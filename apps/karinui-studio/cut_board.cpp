#include "cut_board.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QSpinBox>

#include "theme.h"

namespace karinui::studio {

CutBoard::CutBoard(Session& session) : session_(session) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  count_ = new QSpinBox;
  count_->setObjectName("cut_count");
  count_->setRange(1, kMostCut);
  count_->setKeyboardTracking(false);
  count_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  Theme::here().keep(count_, [this] { count_->setAccessibleName(inWords(say("Times cut"))); });
  pairs_ = new QCheckBox;
  Theme::here().keep(pairs_, [this] {
    pairs_->setText(inWords(say("in pairs")));
    pairs_->setToolTip(inWords(say("Half of them turned over, as for a left and a right one.")));
  });
  row->addWidget(count_);
  row->addWidget(pairs_, 1);
  connect(count_, &QSpinBox::valueChanged, this,
          [this](int count) { perform(count, pairs_->isChecked() && count % 2 == 0); });
  // Pairs are an even number.
  connect(pairs_, &QCheckBox::clicked, this,
          [this](bool on) { perform(count_->value() + (on && count_->value() % 2 != 0 ? 1 : 0), on); });
}

void CutBoard::perform(int count, bool pairs) {
  if (filling_ || session_.selection().pieces.empty()) return;
  SetQuantity op;
  for (const PieceId id : session_.selection().pieces) op.pieces.push_back(PieceRef(id));
  op.count = count, op.pairs = pairs;
  session_.perform(std::move(op));
}

void CutBoard::refresh() {
  if (session_.selection().pieces.empty()) return;
  const auto& all = session_.snapshot().document.cutting;
  const auto own = all.find(*session_.selection().pieces.begin());
  const Cutting cutting = own == all.end() ? Cutting() : own->second;
  filling_ = true;
  count_->setValue(cutting.count);
  pairs_->setChecked(cutting.pairs);
  filling_ = false;
}

}  // namespace karinui::studio

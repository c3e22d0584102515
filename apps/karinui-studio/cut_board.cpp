#include "cut_board.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <algorithm>

#include "theme.h"

namespace karinui::studio {

namespace {

constexpr int kLeastPairs = 2;

}  // namespace

CutBoard::CutBoard(Session& session) : session_(session) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  count_ = new MixedBox<QSpinBox>;
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
          [this](int count) { perform(count, pairs_->checkState() == Qt::Checked && count % 2 == 0); });
  // Pairs are an even number.
  connect(pairs_, &QCheckBox::clicked, this, [this](bool on) {
    const int count = count_->showsDash() ? kLeastPairs : count_->value();
    perform(count + (on && count % 2 != 0 ? 1 : 0), on);
  });
}

void CutBoard::perform(int count, bool pairs) {
  if (filling_ || session_.selection().pieces.empty() || count < 1) return;
  SetQuantity op;
  for (const PieceId id : session_.selection().pieces) op.pieces.push_back(PieceRef(id));
  op.count = count, op.pairs = pairs;
  session_.perform(std::move(op));
}

void CutBoard::refresh() {
  if (session_.selection().pieces.empty()) return;
  const auto& all = session_.snapshot().document.cutting;
  std::set<int> counts;
  std::set<bool> pairs;
  for (const PieceId id : session_.selection().pieces) {
    const auto own = all.find(id);
    const Cutting cutting = own == all.end() ? Cutting() : own->second;
    counts.insert(cutting.count), pairs.insert(cutting.pairs);
  }
  filling_ = true;
  count_->setMixed(counts.size() > 1);
  if (counts.size() == 1) count_->setValue(*counts.begin());
  showTicked(*pairs_, pairs);
  filling_ = false;
}

}  // namespace karinui::studio

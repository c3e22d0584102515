#include "longer_board.h"

#include <QCheckBox>
#include <QComboBox>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "karinui/design/step_words.h"
#include "step_dialog.h"
#include "theme.h"

namespace karinui::studio {

LongerBoard::LongerBoard(Session& session) : session_(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  whole_ = new QCheckBox;
  whole_->setObjectName("longer_whole");
  whole_->setChecked(true);
  partners_ = new QCheckBox;
  partners_->setObjectName("longer_partners");
  partners_->setChecked(true);
  beside_ = new QComboBox;
  beside_->setObjectName("longer_beside");
  beside_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  beside_->setMinimumContentsLength(12);
  Theme::here().keep(this, [this] {
    const int now = std::max(0, beside_->currentIndex());
    beside_->clear();
    for (const Message& words : {say("the ends go along the edges beside"), say("the edges beside keep their length"),
                                 say("the edges beside stretch")})
      beside_->addItem(inWords(words));
    beside_->setCurrentIndex(now);
    beside_->setAccessibleName(inWords(say("Edges beside the ends that move")));
    beside_->setToolTip(inWords(
        say("An armhole gets deeper where its ends go along the sides, which become shorter; it goes out to the "
            "side where these keep their length.")));
    partners_->setText(inWords(say("what it is sewn to gets as much")));
    partners_->setToolTip(inWords(
        say("The seam keeps its ease: a cap, a lining or a facing becomes longer with the armhole, in one step.")));
    refresh();
  });
  connect(beside_, &QComboBox::activated, this, [this] { picked_ = true; });
  column->addWidget(whole_);
  column->addWidget(beside_);
  column->addWidget(partners_);
}

std::vector<EdgeRef> LongerBoard::side() const {
  const auto edges = session_.selection().edges();
  std::vector<EdgeRef> all;
  if (edges.size() != 1) return all;
  for (const auto& [id, seam] : session_.snapshot().document.pattern.seams)
    for (const auto* side : {&seam.a, &seam.b}) {
      if (side->size() < 2 || std::none_of(side->begin(), side->end(), [&](const EdgeSpan& span) {
            return span.piece == edges.front().piece.id && span.edge == edges.front().edge;
          }))
        continue;
      for (const EdgeSpan& span : *side)
        if (const EdgeRef ref{PieceRef(span.piece), span.edge}; std::find(all.begin(), all.end(), ref) == all.end())
          all.push_back(ref);
      return all;
    }
  return all;
}

void LongerBoard::refresh() {
  const auto edges = session_.selection().edges();
  if (std::exchange(shown_, edges) != edges) {
    whole_->setChecked(true), partners_->setChecked(true);
    picked_ = false;
    beside_->setCurrentIndex(0);
  }
  const auto all = side();
  whole_->setVisible(all.size() > 1);
  if (all.size() < 2) return;
  QString names;
  for (const EdgeRef& one : all)
    names += (names.isEmpty() ? "" : " + ") + inWords(edgeSaid(session_.snapshot().document, one));
  whole_->setText(inWords(say("with all of that side of the seam")));
  whole_->setToolTip("<qt>" + names.toHtmlEscaped());
}

Lengthen LongerBoard::lengthen(double metres) {
  Lengthen made;
  made.edges = session_.selection().edges();
  if (const auto all = side(); all.size() > 1 && whole_->isChecked()) made.edges = all;
  made.by = {metres};
  made.beside = static_cast<Lengthen::Beside>(beside_->currentIndex());
  made.partners = partners_->isChecked();
  const auto can = [&](int how) {
    made.beside = static_cast<Lengthen::Beside>(how);
    return static_cast<bool>(tried(session_, made));
  };
  if (!picked_ && !can(beside_->currentIndex()))
    for (int how = 0; how < beside_->count(); ++how)
      if (can(how)) {
        beside_->setCurrentIndex(how);
        break;
      }
  made.beside = static_cast<Lengthen::Beside>(beside_->currentIndex());
  return made;
}

}  // namespace karinui::studio

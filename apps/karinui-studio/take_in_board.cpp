#include "take_in_board.h"

#include <QCheckBox>
#include <QComboBox>
#include <QVBoxLayout>
#include <algorithm>

#include "karinui/design/edge_run.h"
#include "karinui/design/step_words.h"
#include "length_box.h"
#include "theme.h"

namespace karinui::studio {

namespace {
enum TakenIn { kAllAlong, kAtStart, kAtEnd, kAtPlace };
enum SewnTo { kGoesAsFar, kStays, kGives };
}  // namespace

TakeInBoard::TakeInBoard(Session& session) : session_(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  where_ = new QComboBox;
  where_->setObjectName("take_in_where");
  where_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  where_->setMinimumContentsLength(12);
  place_ = new LengthBox(say("Taken in most, along the edge"), 0, 10);
  place_->setObjectName("take_in_place");
  partners_ = new QComboBox;
  partners_->setObjectName("take_in_partners");
  partners_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  partners_->setMinimumContentsLength(12);
  follow_ = new QCheckBox;
  follow_->setObjectName("take_in_follow");
  Theme::here().keep(this, [this] {
    follow_->setText(inWords(say("its ends go along the edges beside it")));
    follow_->setToolTip(inWords(
        say("A hem that is let down goes on along the side seams, which keep their flare, and stays parallel to where "
            "it was. Without the tick it goes straight down.")));
    where_->setAccessibleName(inWords(say("Where it is taken in")));
    where_->setToolTip(
        inWords(say("As far all along, or only at a place, as at the waist, and from there to nothing at the ends.")));
    place_->setToolTip(inWords(say("How far along the edge that place is; a click on the edge says it, too.")));
    const int now = std::max(0, partners_->currentIndex());
    partners_->clear();
    for (const Message& words : {say("what it is sewn to goes as far"), say("what it is sewn to stays"),
                                 say("what it is sewn to gives as much: the seam moves")})
      partners_->addItem(inWords(words));
    partners_->setCurrentIndex(now);
    partners_->setAccessibleName(inWords(say("What it is sewn to")));
    partners_->setToolTip(inWords(say(
        "A centimetre at the side is one off the front and one off the back. What it is sewn to stays where a sleeve "
        "is made longer at its cuff, or a neckline under its collar; it gives what this edge takes where a shoulder "
        "seam goes forward.")));
    refresh();
  });
  column->addWidget(where_);
  column->addWidget(place_);
  column->addWidget(partners_);
  column->addWidget(follow_);
  connect(partners_, &QComboBox::activated, this, &TakeInBoard::showPlace);
  connect(where_, &QComboBox::activated, this, &TakeInBoard::showPlace);
}

const Edge* TakeInBoard::edge() const {
  const auto& chosen = session_.selection().edge;
  const Piece* piece = chosen ? session_.snapshot().document.find(chosen->piece) : nullptr;
  const auto k = piece ? piece->outline.find(chosen->edge) : std::nullopt;
  return k ? &piece->outline.edges[*k] : nullptr;
}

void TakeInBoard::showPlace() {
  const int where = where_->currentData().toInt();
  place_->setVisible(where == kAtPlace);
  follow_->setVisible(where == kAllAlong && partners_->currentIndex() != kGives);
}

// Of one edge alone: several have no place in common.
void TakeInBoard::addPlaces() {
  const Document& document = session_.snapshot().document;
  const Piece& piece = *document.find(session_.selection().edge->piece);
  const auto& edges = piece.outline.edges;
  const std::size_t k = *piece.outline.find(edge()->name), n = edges.size();
  where_->addItem(inWords(say("most at {0}", edgeNameSaid(document, piece, edges[(k + n - 1) % n].name))), kAtStart);
  where_->addItem(inWords(say("most at {0}", edgeNameSaid(document, piece, edges[(k + 1) % n].name))), kAtEnd);
  where_->addItem(inWords(say("most at a place along it")), kAtPlace);
}

void TakeInBoard::refresh() {
  const Edge* own = edge();
  setVisible(own);
  if (!own) return;
  const EdgeNear& chosen = *session_.selection().edge;
  const bool another = !shown_ || shown_->piece != chosen.piece || shown_->edge != chosen.edge;
  const int was = another || where_->count() == 0 ? static_cast<int>(kAllAlong) : where_->currentData().toInt();
  where_->clear();
  where_->addItem(inWords(say("all along it")), kAllAlong);
  if (session_.selection().more.empty()) addPlaces();
  where_->setCurrentIndex(std::max(0, where_->findData(was)));
  place_->setLongest(own->curve.length());
  if (another) partners_->setCurrentIndex(kGoesAsFar);  // what was meant for the last edge is not meant for this one
  if (another) follow_->setChecked(areHems(session_.snapshot().document, session_.selection().edges()));
  if (another || shown_->fraction != chosen.fraction) place_->setMetres(chosen.fraction * own->curve.length());
  shown_ = chosen;
  showPlace();
}

TakeIn TakeInBoard::takeIn(double metres) const {
  TakeIn in;
  in.edges = session_.selection().edges();
  in.by = Length{metres};
  if (partners_->currentIndex() == kStays) in.partners = Choice::No;
  in.moves = partners_->currentIndex() == kGives;
  const Edge* own = edge();
  const int where = own ? where_->currentData().toInt() : static_cast<int>(kAllAlong);
  if (where == kAllAlong && !in.moves && follow_->isChecked() != areHems(session_.snapshot().document, in.edges))
    in.follow = follow_->isChecked() ? Choice::Yes : Choice::No;
  if (where == kAtStart) in.at = 0;
  if (where == kAtEnd) in.at = 1;
  if (where == kAtPlace) in.at = std::clamp(place_->value() / own->curve.length(), 0.0, 1.0);
  return in;
}

}  // namespace karinui::studio

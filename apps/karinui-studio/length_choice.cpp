#include "length_choice.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "karinui/design/step_words.h"
#include "karinui/pattern/likeness.h"
#include "theme.h"

namespace karinui::studio {

LengthChoice::LengthChoice(Session& session) : session_(session) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(4);
  keep_ = new QComboBox;
  keep_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  keep_->setMinimumContentsLength(12);
  neighbours_ = new QCheckBox;
  neighbours_->setChecked(true);
  partners_ = new QCheckBox;
  partners_->setObjectName("length_partners");
  both_ = new QLabel;
  both_->setWordWrap(true);
  both_->setProperty("role", "faint");
  given_ = new QLabel;
  given_->setWordWrap(true);
  given_->setProperty("role", "faint");
  given_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  Theme::here().keep(this, [this] {
    keep_->setAccessibleName(inWords(say("What stays when a length is typed")));
    keep_->setToolTip(inWords(say("The full dot stays, the ring moves.")));
    neighbours_->setText(inWords(say("neighbours keep their length")));
    neighbours_->setToolTip(inWords(say("Where they can: they turn a little, and so does the edge.")));
    partners_->setText(inWords(say("the edge it is sewn to, too")));
    partners_->setToolTip(
        inWords(say("It becomes longer or shorter by as much, at the same end, so that the seam still fits: both edges "
                    "of an underarm, front and back of a side.")));
    refresh();
  });
  column->addWidget(given_);
  column->addWidget(keep_);
  column->addWidget(neighbours_);
  column->addWidget(partners_);
  column->addWidget(both_);
  connect(partners_, &QCheckBox::toggled, this, &LengthChoice::refresh);
  connect(keep_, &QComboBox::activated, this,
          [this] { session_.setKeptEnd(static_cast<SetLength::Keep>(keep_->currentData().toInt())); });
}

const Piece* LengthChoice::piece() const {
  const auto& chosen = session_.selection().edge;
  const Piece* piece = chosen ? session_.snapshot().document.find(chosen->piece) : nullptr;
  return piece && piece->outline.find(chosen->edge) ? piece : nullptr;
}

void LengthChoice::refresh() {
  const Piece* own = piece();
  setVisible(own);
  if (!own) return;
  const auto& edges = own->outline.edges;
  const std::size_t k = *own->outline.find(session_.selection().edge->edge), n = edges.size();
  keep_->clear();
  const auto add = [&](const Message& words, SetLength::Keep keep) {
    keep_->addItem(inWords(words), static_cast<int>(keep));
  };
  add(say("the end at {0} stays", edgeNameSaid(session_.snapshot().document, *own, edges[(k + n - 1) % n].name)),
      SetLength::Keep::Start);
  add(say("the end at {0} stays", edgeNameSaid(session_.snapshot().document, *own, edges[(k + 1) % n].name)),
      SetLength::Keep::End);
  add(say("both ends move by half"), SetLength::Keep::Middle);
  keep_->setCurrentIndex(keep_->findData(static_cast<int>(session_.keptEnd())));
  const std::string from = formula();
  given_->setText("= " + QString::fromStdString(from));
  given_->setVisible(!from.empty());
  const auto alone = [](const std::vector<EdgeSpan>& side) {
    return side.size() == 1 && side.front().from == 0 && side.front().to == 1;
  };
  const EdgeNear& chosen = *session_.selection().edge;
  const std::pair shown(chosen.piece, chosen.edge);
  if (std::exchange(shown_, shown) != shown) {  // what was meant for the last edge is not meant for this one
    const QSignalBlocker quiet(partners_);
    partners_->setChecked(false);
  }
  const auto& seams = session_.snapshot().document.pattern.seams;
  partners_->setEnabled(std::any_of(seams.begin(), seams.end(), [&](const auto& held) {
    const Seam& seam = held.second;
    const auto here = [&](const std::vector<EdgeSpan>& side) {
      return side.front().piece == chosen.piece && side.front().edge == chosen.edge;
    };
    return alone(seam.a) && alone(seam.b) && (here(seam.a) || here(seam.b));
  }));
  const bool more = partners_->isEnabled() && partners_->isChecked();
  both_->setVisible(!more);
  const auto& pieces = session_.snapshot().document.pattern.pieces;
  const bool both = session_.bothHalves(),
             copy = std::any_of(pieces.begin(), pieces.end(), [&](const auto&held) {
               const Piece& other = *held.second;
               return (other.mirrorOf == own->id || own->mirrorOf == other.id) && edgeOnCopy(other, *own, chosen.edge);
             });
  both_->setText(
      inWords(both   ? copy ? say("Both halves change, here and on the symmetric copy.") : say("Both halves change.")
                : copy ? say("This edge changes, and that of the symmetric copy.")
                     : say("Only this edge changes.")));
}

// The formula by which the edge got the length it has now, if it was one.
std::string LengthChoice::formula() const {
  const auto& steps = session_.steps();
  const auto& chosen = *session_.selection().edge;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    if (const auto* set = std::get_if<SetLength>(&step->operation))
      if (set->edge.piece.id == chosen.piece && set->edge.edge == chosen.edge)
        return step->operation.formulas.empty() ? std::string() : step->operation.formulas.front().value;
  return {};
}

Operation LengthChoice::length(const std::string& formula, double metres) const {
  Operation given = length(metres);
  given.formulas = {{"to", formula}};
  return given;
}

SetLength LengthChoice::length(double metres) const {
  SetLength set;
  set.edge = {PieceRef(session_.selection().edge->piece), session_.selection().edge->edge};
  set.to = {metres};
  set.keep = session_.keptEnd();
  set.neighbours = neighbours_->isChecked() ? SetLength::Neighbours::Keep : SetLength::Neighbours::Follow;
  if (partners_->isEnabled() && partners_->isChecked()) set.partners = Choice::Yes;
  return set;
}

}  // namespace karinui::studio

#include "guide.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <functional>

#include "look.h"
#include "main_window.h"

namespace karinui::studio {

namespace {

struct Lesson {
  Message title, words;
  std::function<bool(const Session&)> done;
};

std::size_t piecesFacing(const Session& session, bool front) {
  std::size_t count = 0;
  for (const auto& [id, piece] : session.fitting().document.pattern.pieces) {
    double z = 0;
    if (piece->form)
      for (const Vec3 p : piece->form->space) z += piece->pose(p).z;
    count += piece->form && (z > 0) == front;
  }
  return count;
}
template <class Op>
bool did(const Session& session) {
  for (const Step& step : session.steps())
    if (std::holds_alternative<Op>(step.operation)) return true;
  return false;
}

const std::vector<Lesson>& lessons() {
  static const std::vector<Lesson> all{
      {say("A figure"),
       say("Choose a size in the board “Body” and press “Put the garment on this figure”, or begin with File, New "
           "garment."),
       [](const Session& s) { return s.fitting().body != nullptr; }},
      {say("The front"),
       say("Take Draw. From the hollow of the neck drag along the neckline to the shoulder, down the armhole, along "
           "the side "
           "seam to the hip and back to the middle: half a line, the other half follows."),
       [](const Session& s) { return piecesFacing(s, true) > 0; }},
      {say("The back"),
       say("Turn the figure with the right mouse button (or press 3) and draw the back in the same way."),
       [](const Session& s) { return piecesFacing(s, false) > 0; }},
      {say("Sewing"),
       say("Take Sew. Drag from a shoulder of the front to that of the back, then from side to side: four seams."),
       [](const Session& s) { return s.fitting().document.pattern.seams.size() >= 4; }},
      {say("Settling"), say("Press Space: the cloth comes to rest on the body."),
       [](const Session& s) { return did<DrapePieces>(s); }},
      {say("A slit"), say("Take Cut and drag from below the hem some way up the front."),
       [](const Session& s) { return did<CutPiece>(s); }},
      {say("The pattern"),
       say("The paper at the right is true to size: File, Export, or File, Print. That is a first garment!"),
       [](const Session&) { return false; }},
  };
  return all;
}

}  // namespace

Guide::Guide(MainWindow& window, QWidget* over) : QFrame(over), window_(window) {
  setObjectName("guide");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(18, 14, 18, 14);
  count_ = new QLabel;
  count_->setProperty("role", "faint");
  title_ = new QLabel;
  title_->setProperty("role", "title");
  words_ = new QLabel;
  words_->setWordWrap(true);
  auto* row = new QHBoxLayout;
  auto* skip = new QPushButton;
  auto* next = new QPushButton;
  Look::here().keep(skip, [this, skip, next] {
    skip->setText(inWords(say("Skip")));
    next->setText(inWords(say("Next")));
    if (step_ >= 0) show(step_);
    const Palette& p = Look::here().palette();
    setStyleSheet(QString("QFrame#guide { background: %1; border: 1px solid %2; border-radius: 12px; }")
                      .arg(p.raised.name(), p.line.name()));
  });
  row->addWidget(skip);
  row->addStretch(1);
  row->addWidget(next);
  column->addWidget(count_);
  column->addWidget(title_);
  column->addWidget(words_);
  column->addLayout(row);
  connect(skip, &QPushButton::clicked, this, [this] { hide(); });
  connect(next, &QPushButton::clicked, this, [this] { step_ + 1 < steps() ? show(step_ + 1) : hide(); });
  setFixedWidth(300);
  move(18, 18);
}

int Guide::steps() { return static_cast<int>(lessons().size()); }

void Guide::begin() {
  show(0);
  QFrame::show();
  raise();
  refresh();
}

void Guide::show(int step) {
  step_ = step;
  const Lesson& lesson = lessons()[static_cast<std::size_t>(step)];
  count_->setText(QString("%1 / %2").arg(step + 1).arg(steps()));
  title_->setText(inWords(lesson.title));
  words_->setText(inWords(lesson.words));
  adjustSize();
}

void Guide::refresh() {
  if (!isVisible() || step_ < 0) return;
  while (step_ + 1 < steps() && lessons()[static_cast<std::size_t>(step_)].done(window_.session())) show(step_ + 1);
}

}  // namespace karinui::studio

#include "guide.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "main_window.h"
#include "theme.h"

namespace karinui::studio {

namespace {

struct Lesson {
  Message title, words;
  std::function<bool(const Session&)> done;
};

bool faces(const Piece& piece, bool front) {
  double z = 0;
  if (piece.form)
    for (const Vec3 p : piece.form->space) z += piece.pose(p).z;
  return piece.form && (z > 0) == front;
}
std::size_t piecesFacing(const Session& session, bool front) {
  std::size_t count = 0;
  for (const auto& [id, piece] : session.snapshot().document.pattern.pieces) count += faces(*piece, front);
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
       [](const Session& s) { return s.snapshot().body != nullptr; }},
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
       [](const Session& s) { return firstSeams(s.snapshot()).count() == 4; }},
      {say("Settling"), say("Press Space: the cloth comes to rest on the body."),
       [](const Session& s) { return did<DrapePieces>(s); }},
      {say("Taking in"),
       say("The board “Fit” tells the ease round the body. On the board “Garment”, with Select (Q) and a click on a "
           "side "
           "of the front, type 1 into “Take in” and press Return: a centimetre off front and back, on both sides."),
       [](const Session& s) { return did<TakeIn>(s); }},
      {say("A collar"),
       say("Press the right mouse button on the neckline, choose “Band along it…” and press Return: a band as long as "
           "the "
           "neckline, sewn on."),
       [](const Session& s) { return did<DrawBand>(s); }},
      {say("A dart"),
       say("Click the side of the front again. Type a place into “Along the edge” and press “Dart there”."),
       [](const Session& s) { return did<AddDart>(s); }},
      {say("Colour and print"), say("On the board “Fabric” choose a colour, or stripes at “Print”."),
       [](const Session& s) { return did<SetLook>(s); }},
      {say("The pattern"),
       say("The paper at the right is true to size: File, Export, or File, Print. That is a first garment!"),
       [](const Session&) { return false; }},
  };
  return all;
}

// One side of a seam as it runs in space.
struct SideInSpace {
  Vec3 middle, across;  // from one end to the other
};
std::optional<SideInSpace> inSpace(const GarmentSnapshot& fitting, const std::vector<EdgeSpan>& side, bool front) {
  Box box;
  for (const EdgeSpan& span : side) {
    const Piece* piece = fitting.document.find(span.piece);
    if (!piece || !faces(*piece, front)) return std::nullopt;
    for (const Vec3 p : edgeInSpace(fitting, {PieceRef(span.piece), span.edge, span.from, span.to})) box.include(p);
  }
  if (box.empty()) return std::nullopt;
  return SideInSpace{box.centre(), box.high - box.low};
}

constexpr int kSewing = 3;  // the lesson

}  // namespace

FirstSeams firstSeams(const GarmentSnapshot& fitting) {
  FirstSeams found;
  if (!fitting.body) return found;
  const auto& landmarks = fitting.body->landmarks();
  const auto armpit = landmarks.find("armpit_left");
  if (armpit == landmarks.end()) return found;
  const double height = armpit->second.y;
  for (const auto& [id, seam] : fitting.document.pattern.seams) {
    auto front = inSpace(fitting, seam.a, true), back = inSpace(fitting, seam.b, false);
    if (!front || !back) front = inSpace(fitting, seam.b, true), back = inSpace(fitting, seam.a, false);
    if (!front || !back || (front->middle.x > 0) != (back->middle.x > 0)) continue;
    const auto shoulder = [&](const SideInSpace& s) { return s.middle.y > height && s.across.x > s.across.y; };
    const auto side = [&](const SideInSpace& s) { return s.middle.y < height && s.across.y > s.across.x; };
    const bool left = front->middle.x > 0;  // the body's own left
    if (shoulder(*front) && shoulder(*back)) (left ? found.shoulderLeft : found.shoulderRight) = true;
    if (side(*front) && side(*back)) (left ? found.sideLeft : found.sideRight) = true;
  }
  return found;
}

Guide::Guide(MainWindow& window) : window_(window) {
  setObjectName("guide");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(16, 7, 10, 7);
  row->setSpacing(10);
  auto* head = new QVBoxLayout;
  head->setSpacing(1);
  count_ = new QLabel;
  count_->setProperty("role", "faint");
  title_ = new QLabel;
  title_->setProperty("role", "title");
  head->addWidget(count_);
  head->addWidget(title_);
  words_ = new QLabel;
  words_->setWordWrap(true);
  row->addLayout(head);
  row->addWidget(words_, 1);
  auto* skip = new QPushButton;
  back_ = new QPushButton;
  next_ = new QPushButton;
  for (QPushButton* button : {back_, next_, skip}) row->addWidget(button);
  Theme::here().keep(skip, [this, skip] {
    back_->setText(inWords(say("Go back")));
    next_->setText(inWords(say("Next")));
    skip->setText(inWords(say("Skip")));
    if (step_ >= 0) show(step_);
    const Palette& p = Theme::here().palette();
    setStyleSheet(QString("QFrame#guide { background: %1; border: none; border-bottom: 1px solid %2; }")
                      .arg(p.accentSoft.name(), p.line.name()));
  });
  connect(skip, &QPushButton::clicked, this, [this] { hide(); });
  connect(back_, &QPushButton::clicked, this, [this] { show(std::max(0, step_ - 1)); });
  connect(next_, &QPushButton::clicked, this, [this] { step_ + 1 < steps() ? show(step_ + 1) : hide(); });
  hide();
}

int Guide::steps() { return static_cast<int>(lessons().size()); }

std::vector<bool> Guide::done() const {
  std::vector<bool> done;
  for (const Lesson& lesson : lessons()) done.push_back(lesson.done(window_.session()));
  return done;
}

void Guide::begin() {
  seen_ = done();
  const auto open = std::find(seen_.begin(), seen_.end(), false);
  show(static_cast<int>(std::min<std::ptrdiff_t>(open - seen_.begin(), steps() - 1)));
  QFrame::show();
}

void Guide::show(int step) {
  step_ = step;
  const Lesson& lesson = lessons()[static_cast<std::size_t>(step)];
  count_->setText(QString("%1 / %2").arg(step + 1).arg(steps()));
  title_->setText(inWords(lesson.title));
  QString words = inWords(lesson.words);
  if (step == kSewing)
    words += "  " + inWords(say("Sewn: {0} of 4.", firstSeams(window_.session().snapshot()).count()));
  words_->setText(words);
  back_->setEnabled(step > 0);
}

// On where the step at hand was done just now, back where an earlier one was undone; paged to, it stays.
void Guide::refresh() {
  if (!isVisible() || step_ < 0) return;
  const std::vector<bool> before = std::exchange(seen_, done());
  int to = step_;
  for (int k = 0; k < step_; ++k)
    if (before[static_cast<std::size_t>(k)] && !seen_[static_cast<std::size_t>(k)]) {
      to = k;
      break;
    }
  if (to == step_ && !before[static_cast<std::size_t>(to)])
    while (to + 1 < steps() && seen_[static_cast<std::size_t>(to)]) ++to;
  show(to);
}

}  // namespace karinui::studio

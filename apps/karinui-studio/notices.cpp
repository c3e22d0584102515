#include "notices.h"

#include <QApplication>
#include <QDialog>
#include <QEvent>
#include <QListWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "theme.h"

namespace karinui::studio {

namespace {

constexpr std::size_t kMostShown = 3;
constexpr qsizetype kMostKept = 200;
constexpr int kOnceMore = 4000;                        // milliseconds
constexpr int kPaddingAbove = 10, kPaddingAside = 18;  // of a sentence, points

// Milliseconds to find a sentence and read it: slow readers take some 60 ms a letter, of Japanese some 150.
int timeToRead(Notice::Kind kind, const QString& words, bool toBeDone) {
  const auto letters = std::count_if(words.begin(), words.end(), [](QChar c) { return c.unicode() >= 0x3000; });
  const int reading = static_cast<int>(60 * (words.size() - letters) + 150 * letters);
  const int least = kind == Notice::Kind::Said ? 3500 : toBeDone ? 30000 : 8000;
  return std::max(least, 2000 + reading);
}

}  // namespace

Notices::Notices(QWidget* over, Drags drags) : QObject(over), over_(over), drags_(drags) {
  over_->installEventFilter(this);
}

void Notices::tell(Notice::Kind kind, const QString& words, bool long_) {
  if (said_.isEmpty() || said_.last() != words) said_ << words;  // a key held down crowds out nothing
  if (said_.size() > kMostKept) said_.removeFirst();
  // What is said again, and what was only said in passing, makes room.
  const std::deque<QLabel*> before = shown_;
  for (QLabel* label : before)
    if (label->text() == words || label->property("passing").toBool()) take(label);
  while (shown_.size() >= kMostShown) take(shown_.back());
  auto* label = new QLabel(words, over_);
  label->setObjectName("toast");
  label->setProperty("passing", kind == Notice::Kind::Said);
  label->setProperty("refusal", kind == Notice::Kind::Refused);
  label->setWordWrap(true);
  label->setAlignment(Qt::AlignCenter);
  label->setCursor(Qt::ArrowCursor);
  const QColor back = kind == Notice::Kind::Refused  ? QColor("#8f2f1d")
                      : kind == Notice::Kind::Advice ? QColor("#7a5a12")
                                                     : QColor("#2f4a3c");
  label->setStyleSheet(
      QString(
          "QLabel#toast { background: %1; color: white; border-radius: 10px; padding: %2px %3px; font-size: 10.5pt; }")
          .arg(back.name())
          .arg(kPaddingAbove)
          .arg(kPaddingAside));
  label->installEventFilter(this);
  label->setAttribute(Qt::WA_TransparentForMouseEvents, drags_ == Drags::GoThrough);
  shown_.push_front(label);
  label->show();
  auto* time = new QTimer(label);
  time->setSingleShot(true);
  connect(time, &QTimer::timeout, this, [this, label, time] {
    if (held_ && !label->property("passing").toBool()) return time->start(kOnceMore);
    take(label);
  });
  time->start(timeToRead(kind, words, long_));
  place(room_, between_);
}

void Notices::take(QLabel* label) {
  const auto at = std::find(shown_.begin(), shown_.end(), label);
  if (at == shown_.end()) return;
  const bool first = at == shown_.begin();
  shown_.erase(at);
  label->hide();
  label->setObjectName(QString());
  label->deleteLater();
  if (first) between_ = 0, emit newestGone();
  place(room_, between_);
}

int Notices::place(int room, int between) {
  room_ = room, between_ = between;
  const int wide = std::max(60, std::min(room - 24, 620));
  int top = 12, ends = 12;
  for (QLabel* label : shown_) {
    // QLabel's own height for a width leaves the padding of its style sheet out of the breaking of lines.
    label->ensurePolished();
    const QRect lines(0, 0, wide - 2 * kPaddingAside, 10'000);
    const QRect text = label->fontMetrics().boundingRect(lines, Qt::AlignCenter | Qt::TextWordWrap, label->text());
    label->setFixedSize(wide, text.height() + 2 * kPaddingAbove);
    label->move((room - wide) / 2, top);
    label->raise();
    if (label == shown_.front()) ends = label->geometry().bottom();
    top = label->geometry().bottom() + 7 + (label == shown_.front() ? between : 0);
  }
  return ends;
}

void Notices::moveTo(QWidget* over, Drags drags) {
  over_->removeEventFilter(this);
  over_ = over, drags_ = drags;
  over_->installEventFilter(this);
  for (QLabel* label : shown_) {
    label->setParent(over);
    label->setAttribute(Qt::WA_TransparentForMouseEvents, drags_ == Drags::GoThrough);
    label->show();
  }
}

void Notices::clear() {
  while (!shown_.empty()) take(shown_.back());
}

void Notices::done(std::uint64_t last) {
  if (std::exchange(done_, last) >= last) return;
  const std::deque<QLabel*> before = shown_;
  for (QLabel* label : before)
    if (label->property("refusal").toBool()) take(label);
}

void Notices::clearNewest() {
  if (!shown_.empty()) take(shown_.front());
}

bool Notices::visible() const { return !shown_.empty(); }

// Who begins a line at the neck that a sentence hides means the neck.
bool Notices::overView(QEvent* event) {
  if (event->type() == QEvent::MouseButtonPress) {
    const auto* press = static_cast<QMouseEvent*>(event);
    const auto hit = std::find_if(shown_.begin(), shown_.end(), [&](const QLabel* label) {
      return label->geometry().contains(press->position().toPoint());
    });
    if (hit == shown_.end() || press->button() != Qt::LeftButton || firstPress_) return false;
    pressed_ = *hit;
    firstPress_.reset(press->clone());
    return true;
  }
  if (!firstPress_) return false;
  if (event->type() == QEvent::MouseMove) {
    const QPointF went =
        static_cast<QMouseEvent*>(event)->position() - static_cast<QMouseEvent*>(firstPress_.get())->position();
    if (went.manhattanLength() < QApplication::startDragDistance()) return true;
    if (pressed_) take(pressed_);
    QApplication::sendEvent(over_, firstPress_.get());
    firstPress_.reset();
    return false;
  }
  if (event->type() != QEvent::MouseButtonRelease) return false;
  firstPress_.reset();
  if (pressed_) take(pressed_);
  return true;
}

bool Notices::eventFilter(QObject* watched, QEvent* event) {
  if (watched == over_) return drags_ == Drags::GoThrough && overView(event);
  if (event->type() != QEvent::MouseButtonPress) return false;
  take(qobject_cast<QLabel*>(watched));
  return true;
}

void Notices::showAll(QWidget* parent) const {
  auto* dialog = new QDialog(parent);
  dialog->setObjectName("said");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(inWords(say("What was said")));
  dialog->resize(560, 380);
  auto* column = new QVBoxLayout(dialog);
  auto* list = new QListWidget;
  list->setWordWrap(true);
  list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list->setAccessibleName(dialog->windowTitle());
  for (auto words = said_.rbegin(); words != said_.rend(); ++words) list->addItem(*words);
  column->addWidget(list);
  dialog->open();
}

}  // namespace karinui::studio

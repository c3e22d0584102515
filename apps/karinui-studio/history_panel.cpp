// The steps that made the garment: seen, gone back to, changed.
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>

#include "karinui/design/step_words.h"
#include "panels.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr QSize kPicture(54, 72);
constexpr std::size_t kMostPictures = 64;    // kept, beside those in sight
enum Role { kNumber = Qt::UserRole, kEnd };  // how many steps are done there; or the end of a way that was left, by seq

QString nameOfStep(const Step& step) {
  const std::string_view name = nameOf(step.operation);
  return inWords(termSaid(Term::OperationName, name).value_or(say("{0}", std::string(name))));
}

const char* iconOf(const Step& step) {
  const std::string_view kind = nameOf(step.operation);
  return kind == "drape" ? "settle" : kind == "unpin" ? "pin" : kind == "remove" ? "trash" : kind.data();
}

}  // namespace

HistoryPanel::HistoryPanel(Session& session, SpaceView& view, QWidget* in) : Panel(session, in), view_(view) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(8);
  column->addWidget(title(say("Steps")));
  auto* note = word(say("Double-click (Enter) goes back to a step; the later ones stay. Choose one to change it."));
  note->setProperty("role", "faint");
  column->addWidget(note);
  list_ = new QListWidget;
  list_->setIconSize(kPicture);
  list_->setTextElideMode(Qt::ElideRight);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setUniformItemSizes(true);
  Theme::here().keep(list_, [this] { list_->setAccessibleName(inWords(say("Steps"))); });
  column->addWidget(list_, 3);

  board_ = new QWidget;
  auto* inner = new QVBoxLayout(board_);
  inner->setContentsMargins(0, 0, 0, 0);
  about_ = new QLabel;
  about_->setWordWrap(true);
  inner->addWidget(about_);
  auto* holder = new QWidget;
  fields_ = new QFormLayout(holder);
  fields_->setContentsMargins(0, 0, 0, 0);
  auto* scroll = new QScrollArea;
  scroll->setWidget(holder);
  scroll->setWidgetResizable(true);
  inner->addWidget(scroll, 1);
  again_ = new QPushButton;
  Theme::here().keep(again_, [this] {
    again_->setText(inWords(say("Play again with this")));
    again_->setToolTip(inWords(say("Changes this step and does all that followed again. One undo brings it back.")));
  });
  inner->addWidget(again_);
  column->addWidget(board_, 2);
  board_->hide();

  connect(list_, &QListWidget::itemActivated, this, [this](QListWidgetItem* item) {
    if (const auto end = item->data(kEnd).toULongLong()) {
      for (const Step& step : session_.otherBranches())
        if (step.seq == end) return session_.switchBranch(step);
    } else {
      session_.goTo(static_cast<std::size_t>(item->data(kNumber).toUInt()));
    }
  });
  connect(list_, &QListWidget::currentItemChanged, this, [this] {
    if (!filling_) fillFields();
  });
  connect(list_->verticalScrollBar(), &QScrollBar::valueChanged, this, &HistoryPanel::askPicture);
  connect(again_, &QPushButton::clicked, this, &HistoryPanel::playAgain);
}

const Step* HistoryPanel::stepIn(const QListWidgetItem& item) const {
  const std::size_t number = item.data(kNumber).toUInt();
  const auto& done = session_.steps();
  const auto& undone = session_.undone();
  if (item.data(kEnd).toULongLong() || number == 0 || number > done.size() + undone.size()) return nullptr;
  return number <= done.size() ? &done[number - 1] : &undone[number - 1 - done.size()];
}

const Step* HistoryPanel::chosen() const {
  const QListWidgetItem* item = list_->currentItem();
  return item && item->data(kNumber).toUInt() <= session_.steps().size() ? stepIn(*item) : nullptr;
}

std::vector<QListWidgetItem*> HistoryPanel::inSight() const {
  std::vector<QListWidgetItem*> items;
  for (int row = std::max(0, list_->indexAt(QPoint(4, 4)).row()); row < list_->count(); ++row) {
    QListWidgetItem* item = list_->item(row);
    if (list_->visualItemRect(item).top() >= list_->viewport()->height()) break;
    items.push_back(item);
  }
  return items;
}

QIcon HistoryPanel::pictureOf(const Step& step) const {
  const auto at = pictures_.find(step.chain);
  if (at == pictures_.end() || at->second.isNull()) return Theme::here().icon(iconOf(step));
  QIcon icon(at->second);
  icon.addPixmap(at->second, QIcon::Selected);  // as it is, not dyed
  return icon;
}

QListWidgetItem* HistoryPanel::addStep(std::size_t number, const Step* step, bool undone) {
  const Document& document = session_.snapshot().document;
  QString words = QString::number(number) + "   ";
  auto* item = new QListWidgetItem(list_);
  item->setSizeHint(QSize(0, kPicture.height() + 6));
  item->setData(kNumber, static_cast<unsigned>(number));
  if (step) {
    const QString rest = inWords(stepSaid(document, step->operation));
    words += nameOfStep(*step) + "\n" + rest.left(160);
    item->setIcon(pictureOf(*step));
    item->setToolTip("<b>" + inWords(Message{helpOf(step->operation).help, {}}).toHtmlEscaped() + "</b><br>" +
                     rest.left(600).toHtmlEscaped());
  } else {
    words += inWords(say("the empty beginning"));
  }
  item->setText(words);
  if (undone) item->setForeground(Theme::here().palette().faint);
  return item;
}

void HistoryPanel::refresh() {
  if (historyShown_ != session_.changes().history) {
    historyShown_ = session_.changes().history;
    asked_ = false;
    fillSteps();
  }
  askPicture();
}

void HistoryPanel::showEvent(QShowEvent* event) {
  Panel::showEvent(event);
  askPicture();
}

void HistoryPanel::fillSteps() {
  filling_ = true;
  list_->clear();
  QListWidgetItem* here = addStep(0, nullptr, false);
  std::size_t n = 0;
  for (const Step& step : session_.steps()) here = addStep(++n, &step, false);
  for (const Step& step : session_.undone()) addStep(++n, &step, true);
  for (const Step& end : session_.otherBranches()) {
    QListWidgetItem* item = addStep(end.serial, &end, true);
    item->setText(inWords(say("another way, {0} {0|step|steps}", static_cast<std::size_t>(end.serial))) + "\n… " +
                  nameOfStep(end) + "  " + inWords(stepSaid(session_.snapshot().document, end.operation)).left(120));
    item->setData(kEnd, static_cast<qulonglong>(end.seq));
  }
  if (const int stay = std::exchange(stay_, 0); stay > 0 && stay < list_->count()) here = list_->item(stay);
  list_->setCurrentItem(here);
  list_->scrollToItem(here);
  filling_ = false;
  fillFields();
}

void HistoryPanel::fillFields() {
  const Step* step = chosen();
  board_->setVisible(step && !session_.readOnly());
  while (fields_->rowCount() > 0) fields_->removeRow(0);
  typed_.clear();
  if (!step) return;
  const OperationHelp& help = helpOf(step->operation);
  about_->setText(inWords(Message{help.help, {}}));
  const std::vector<FieldText> known = fieldTexts(step->operation);
  for (const FieldHelp& field : help.fields) {
    const auto value = std::find_if(known.begin(), known.end(), [&](const auto& f) { return f.name == field.name; });
    typed_.push_back(stepField(session_.snapshot().document, help.name, field,
                               value == known.end() ? std::string() : value->value, [this] { playAgain(); }));
    auto* label = new QLabel(inWords(fieldSaid(help.name, field.name)));
    label->setWordWrap(true);
    label->setBuddy(typed_.back().box);
    fields_->addRow(label, typed_.back().box);
  }
}

void HistoryPanel::playAgain() {
  const Step* step = chosen();
  if (!step) return;
  std::vector<FieldText> fields;
  for (const StepField& field : typed_)
    if (std::string value = field.value(); !value.empty()) fields.push_back({field.name, std::move(value)});
  const auto operation = parseOperation(karinui::lineOf(nameOf(step->operation), fields));
  if (!operation) return session_.refuse(operation.error());
  if (*operation == step->operation) return;
  stay_ = static_cast<int>(step->serial);
  session_.amend(step->serial, *operation);
}

// Only of what is in sight: a long day has more steps than pictures are kept.
void HistoryPanel::askPicture() {
  if (asked_ || !isVisible() || !session_.idle()) return;
  const std::vector<QListWidgetItem*> seen = inSight();
  for (auto item = seen.rbegin(); item != seen.rend(); ++item) {  // the newest first: that is where one looks
    const Step* step = stepIn(**item);
    if (!step || pictures_.contains(step->chain)) continue;
    asked_ = true;
    session_.snapshotAfter(step->seq, [this, chain = step->chain](const SnapshotPtr& then) {
      asked_ = false;
      keepPicture(chain, then);
    });
    return;
  }
}

void HistoryPanel::keepPicture(const std::string& chain, const SnapshotPtr& then) {
  const std::vector<QListWidgetItem*> seen = inSight();
  if (pictures_.size() >= kMostPictures) {
    std::map<std::string, QPixmap> kept;
    for (const QListWidgetItem* item : seen)
      if (const Step* step = stepIn(*item))
        if (const auto at = pictures_.find(step->chain); at != pictures_.end()) kept.insert(*at);
    pictures_ = std::move(kept);
  }
  const double ratio = devicePixelRatioF();
  QPixmap picture;
  if (then) picture = QPixmap::fromImage(view_.portrait(then->frame, (QSizeF(kPicture) * ratio).toSize()));
  picture.setDevicePixelRatio(ratio);
  pictures_[chain] = picture;
  for (int row = 0; row < list_->count(); ++row)  // its row may have been scrolled out of sight meanwhile
    if (const Step* step = stepIn(*list_->item(row)); step && step->chain == chain)
      list_->item(row)->setIcon(pictureOf(*step));
}

}  // namespace karinui::studio

#include "start_page.h"

#include <QAction>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QLocale>
#include <QMessageBox>
#include <QPainter>
#include <QPainterPath>
#include <QPushButton>
#include <QSettings>
#include <QStyledItemDelegate>
#include <QVBoxLayout>

#include "drafts.h"
#include "file_filter.h"
#include "theme.h"
#include "thumbnails.h"

namespace karinui::studio {

namespace {

constexpr QSize kPicture(168, 210);
constexpr int kRim = 10, kWords = 46;  // around a picture and below it, pixels
constexpr int kMostDocuments = 48;
enum Role { kPath = Qt::UserRole, kWhen, kIsDraft };

QString whenText(const QDateTime& when) {
  const QLocale locale(Theme::here().language() == Language::Japanese ? QLocale::Japanese : QLocale::English);
  const QString time = when.toString("HH:mm");
  if (when.date() == QDate::currentDate()) return inWords(say("today {0}", time.toStdString()));
  return locale.toString(when.date(), QLocale::LongFormat);
}

// A document as a card: its picture, below it its name and when it was changed.
class CardDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override {
    return kPicture + QSize(2 * kRim, 2 * kRim + kWords);
  }
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Palette& p = Theme::here().palette();
    const bool chosen = option.state & QStyle::State_Selected, over = option.state & QStyle::State_MouseOver;
    const QRectF card = QRectF(option.rect).adjusted(4, 4, -4, -4);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    const bool keyed = option.state & QStyle::State_HasFocus;
    painter->setPen(QPen(keyed ? p.ink : chosen || over ? p.accent : p.line, chosen || keyed ? 2 : 1));
    painter->setBrush(chosen ? p.accentSoft : p.raised);
    painter->drawRoundedRect(card, 10, 10);
    const QRect place(option.rect.topLeft() + QPoint(kRim, kRim), kPicture);
    const auto picture = index.data(Qt::DecorationRole).value<QPixmap>();
    if (picture.isNull()) {
      drawIcon(*painter, "body", QRectF(place.center() - QPoint(20, 20), QSizeF(40, 40)), p.line);
    } else {
      QPainterPath rounded;
      rounded.addRoundedRect(place, 6, 6);
      painter->setClipPath(rounded);
      painter->drawPixmap(place, picture);
      painter->setClipping(false);
    }
    const QFontMetrics metrics(option.font);
    const int line = metrics.height();
    const QRect words(place.left() + 2, place.bottom() + 8, place.width() - 4, line);
    QFont bold = option.font;
    bold.setWeight(QFont::DemiBold);
    painter->setFont(bold);
    painter->setPen(p.ink);
    painter->drawText(
        words, Qt::AlignLeft | Qt::AlignVCenter,
        QFontMetrics(bold).elidedText(index.data(Qt::DisplayRole).toString(), Qt::ElideMiddle, words.width()));
    painter->setFont(option.font);
    painter->setPen(p.faint);
    painter->drawText(words.translated(0, line + 1), Qt::AlignLeft | Qt::AlignVCenter,
                      metrics.elidedText(index.data(kWhen).toString(), Qt::ElideRight, words.width()));
    painter->restore();
  }
};

// Recent documents and all drafts that are there, the last changed first.
QFileInfoList documentsThere() {
  QFileInfoList all;
  const auto add = [&](const QFileInfo& file) {
    if (!file.exists()) return;
    for (const QFileInfo& other : all)
      if (other.canonicalFilePath() == file.canonicalFilePath()) return;
    all << file;
  };
  for (const QString& path : QSettings().value("recent").toStringList()) add(QFileInfo(path));
  const QDir drafts(QString::fromStdString(draftsFolder().string()));
  for (const QFileInfo& file : drafts.entryInfoList({filterWriting(fileFormat("document"))}, QDir::Files, QDir::Time))
    add(file);
  std::stable_sort(all.begin(), all.end(),
                   [](const QFileInfo& a, const QFileInfo& b) { return a.lastModified() > b.lastModified(); });
  return all.mid(0, kMostDocuments);
}

}  // namespace

StartPage::StartPage() : thumbnails_(new Thumbnails(kPicture * 2)) {
  thumbnails_->setParent(this);
  setObjectName("start");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  auto* side = new QWidget;
  side->ensurePolished();
  side->setFixedWidth(std::max(330, 22 * side->fontMetrics().height()));
  ways_ = new QVBoxLayout(side);
  ways_->setContentsMargins(36, 40, 36, 24);
  ways_->setSpacing(8);
  name_ = new QLabel(QString::fromUtf8("Karinui 仮縫い"));
  about_ = new QLabel;
  about_->setWordWrap(true);
  about_->setProperty("role", "faint");
  ways_->addWidget(name_);
  ways_->addWidget(about_);
  ways_->addSpacing(18);
  fresh_ = way(say("New garment…"), say("Begins a garment on a figure."), "new", &StartPage::freshAsked);
  fresh_->setDefault(true);
  way(say("Start from a block…"),
      say("Begins with a shirt, a bodice, a skirt, trousers or leggings drafted from a figure's measures."),
      "rectangle", &StartPage::blockAsked);
  way(say("Open…"), say("Opens a Karinui document."), "open", &StartPage::openAsked);
  way(say("Import…"), say("Begins with a body or a pattern from a file."), "body", &StartPage::importAsked);
  ways_->addSpacing(18);
  way(say("A first garment, step by step"), say("Shows how a garment is made, from the figure to the paper."), "draw",
      &StartPage::guideAsked);
  way(say("A sample garment"), say("Makes a tunic that is sewn and draped already, to try things on."), "fit",
      &StartPage::sampleAsked);
  ways_->addStretch(1);
  row->addWidget(side);

  auto* right = new QWidget;
  right->setObjectName("documents");
  auto* column = new QVBoxLayout(right);
  column->setContentsMargins(28, 42, 20, 16);
  column->setSpacing(10);
  title_ = new QLabel;
  title_->setProperty("role", "title");
  none_ = new QLabel;
  none_->setWordWrap(true);
  none_->setProperty("role", "faint");
  list_ = new QListWidget;
  list_->setViewMode(QListView::IconMode);
  list_->setResizeMode(QListView::Adjust);
  list_->setMovement(QListView::Static);
  list_->setUniformItemSizes(true);
  list_->setSpacing(4);
  list_->setMouseTracking(true);
  list_->setItemDelegate(new CardDelegate(list_));
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  title_->setBuddy(list_);
  column->addWidget(title_);
  column->addWidget(none_);
  column->addWidget(list_, 1);
  column->addStretch(0);  // what is above stays above where there is no list
  row->addWidget(right, 1);

  auto* trash = new QAction(list_);
  trash->setShortcut(QKeySequence::Delete);
  trash->setShortcutContext(Qt::WidgetShortcut);
  Theme::here().keep(trash, say("Put this draft into the trash…"), say("Put this draft into the trash…"), "trash");
  list_->addAction(trash);
  list_->setContextMenuPolicy(Qt::ActionsContextMenu);
  connect(trash, &QAction::triggered, this, &StartPage::discard);
  connect(list_, &QListWidget::itemSelectionChanged, this, [this, trash] {
    const QListWidgetItem* item = list_->currentItem();
    trash->setEnabled(item && item->data(kIsDraft).toBool());
  });
  const auto open = [this](QListWidgetItem* item) { emit documentAsked(item->data(kPath).toString()); };
  connect(list_, &QListWidget::itemClicked, this, open);
  connect(list_, &QListWidget::itemActivated, this, [this, open](QListWidgetItem* item) {
    if (isVisible()) open(item);  // a click has opened it already where one click activates
  });
  connect(thumbnails_, &Thumbnails::made, this, &StartPage::drawn);
  Theme::here().keep(this, [this] { showWords(); });
}

StartPage::~StartPage() = default;

QPushButton* StartPage::way(const Message& words, const Message& hint, const char* icon, void (StartPage::*asked)()) {
  auto* button = new QPushButton;
  button->setIconSize(QSize(22, 22));
  button->setCursor(Qt::PointingHandCursor);
  Theme::here().keep(button, [button, words, hint, icon = std::string(icon)] {
    button->setText(inWords(words));
    button->setToolTip(inWords(hint));
    button->setAccessibleDescription(inWords(hint));
    button->setIcon(Theme::here().icon(icon));
  });
  connect(button, &QPushButton::clicked, this, asked);
  ways_->addWidget(button);
  return button;
}

void StartPage::showWords() {
  const Palette& p = Theme::here().palette();
  setStyleSheet(QString("QWidget#documents { background: %1; border-left: 1px solid %2; }"
                        "QPushButton { text-align: left; padding: 10px 14px; }"
                        "QPushButton:focus, QPushButton:default:focus { padding: 9px 13px; }")
                    .arg(p.panel.name(), p.line.name()));
  name_->setStyleSheet("font-size: 20pt; font-weight: 600;");
  about_->setText(inWords(say("Made-to-measure clothes, designed on the body and cut to paper patterns.")));
  title_->setText(inWords(say("Your garments")));
  none_->setText(inWords(
      say("There is no garment yet. Each one is kept as a file from its first step on, and is found here again.")));
  QPixmap bright(44, 44);
  bright.fill(Qt::transparent);
  {
    QPainter painter(&bright);
    drawIcon(painter, "new", QRectF(0, 0, 44, 44), Qt::white);
  }
  fresh_->setIcon(bright);  // on the colour of what is done first
  list_->setAccessibleName(inWords(say("Your garments")));
  fill();
}

void StartPage::fill() {
  const QString chosen = list_->currentItem() ? list_->currentItem()->data(kPath).toString() : QString();
  list_->clear();
  QStringList paths;
  const QString drafts = QFileInfo(QString::fromStdString(draftsFolder().string())).canonicalFilePath();
  for (const QFileInfo& file : documentsThere()) {
    const bool draft = !drafts.isEmpty() && QFileInfo(file.absolutePath()).canonicalFilePath() == drafts;
    const QString when = whenText(file.lastModified());
    auto* item = new QListWidgetItem(file.completeBaseName());
    item->setData(kPath, file.absoluteFilePath());
    item->setData(kIsDraft, draft);
    item->setData(kWhen, draft ? inWords(say("Draft, {0}", when.toStdString())) : when);
    item->setData(Qt::AccessibleTextRole, item->text() + ", " + item->data(kWhen).toString());
    item->setToolTip(QDir::toNativeSeparators(file.absoluteFilePath()));
    list_->addItem(item);
    if (file.absoluteFilePath() == chosen) list_->setCurrentItem(item);
    paths << file.absoluteFilePath();
  }
  if (!list_->currentItem() && list_->count() > 0) list_->setCurrentRow(0, QItemSelectionModel::NoUpdate);
  none_->setVisible(paths.isEmpty());
  list_->setVisible(!paths.isEmpty());
  setFocusProxy(paths.isEmpty() ? static_cast<QWidget*>(fresh_) : list_);  // Enter goes on where one left
  thumbnails_->want(paths);
}

void StartPage::leave() { thumbnails_->stop(); }
bool StartPage::still() const { return !thumbnails_->busy(); }

QListWidgetItem* StartPage::itemOf(const QString& path) const {
  for (int row = 0; row < list_->count(); ++row)
    if (list_->item(row)->data(kPath).toString() == path) return list_->item(row);
  return nullptr;
}

void StartPage::drawn(const QString& path, const QImage& picture, int steps) {
  if (QListWidgetItem* item = itemOf(path)) {
    // A draft in which nothing was ever done is no garment: left by a program that ended between file and step.
    if (steps == 0 && item->data(kIsDraft).toBool())
      delete item;
    else if (!picture.isNull())
      item->setData(Qt::DecorationRole, QPixmap::fromImage(picture));
  }
  none_->setVisible(list_->count() == 0);
  list_->setVisible(list_->count() > 0);
  if (still()) emit stillNow();
}

void StartPage::discard() {
  const QListWidgetItem* item = list_->currentItem();
  if (!item || !item->data(kIsDraft).toBool()) return;
  auto* box = new QMessageBox(QMessageBox::Question, "Karinui",
                              inWords(say("Put the draft “{0}” into the trash?", item->text().toStdString())),
                              QMessageBox::NoButton, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* put = box->addButton(inWords(say("Into the trash")), QMessageBox::AcceptRole);
  box->setDefaultButton(box->addButton(inWords(say("Cancel")), QMessageBox::RejectRole));
  connect(put, &QPushButton::clicked, this, [this, path = item->data(kPath).toString()] {
    thumbnails_->stop();
    const bool gone = QFile::moveToTrash(path);
    fill();
    if (gone) return;
    auto* told = new QMessageBox(QMessageBox::Warning, "Karinui",
                                 inWords(say("“{0}” could not be put into the trash.", path.toStdString())),
                                 QMessageBox::Ok, this);
    told->setAttribute(Qt::WA_DeleteOnClose);
    told->open();
  });
  box->open();
}

}  // namespace karinui::studio

#include "fit_study.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>
#include <QThread>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "accessibility.h"
#include "file_filter.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/view/strain_scale.h"
#include "pixels.h"
#include "theme.h"

namespace karinui::studio {

namespace {

constexpr std::array kStudyViews{View::Front, View::Back, View::Left, View::Right, View::Oblique};
constexpr int kStudyWide = 300, kStudyHigh = 500;  // pixels of one figure
constexpr std::size_t kMostStudied = 60;
enum StudyMap { kStudyCloth, kStudyStrain, kStudyPressure };

// All side by side, on one floor and at one scale.
Result<Image> lineUpOf(const std::vector<StudyItem>& items, View view, int map, Language language) {
  std::vector<LineUp::Figure> figures;
  std::vector<SceneFrame> frames;
  std::vector<float> pressed;
  for (const StudyItem& item : items) {
    LineUp::Figure figure{text(item.name, language)};
    for (const Message& words : item.below) figure.below.push_back(text(words, language));
    figure.marked = item.marked;
    figures.push_back(std::move(figure));
    const bool pressure = map == kStudyPressure && item.garment && item.garment->body && !item.pressure.empty();
    frames.push_back(!item.garment ? SceneFrame()
                     : pressure    ? pressureFrame(*item.garment, item.pressure)
                                   : item.garment->frame);
    pressed.insert(pressed.end(), item.pressure.begin(), item.pressure.end());
  }
  PictureOptions each;
  each.view = view, each.width = kStudyWide, each.height = kStudyHigh, each.language = language;
  each.map = map == kStudyCloth ? Map::None : map == kStudyPressure ? Map::Pressure : Map::Strain;
  if (map == kStudyPressure) each.mapTop = roundTop(pressed, kPressureLeast);
  LineUp lineUp(std::move(figures), frames, each);
  constexpr std::size_t kInRow = 5;
  return lineUp.draw(0, items.size() <= kInRow ? 0 : static_cast<int>(kInRow));
}

}  // namespace

FitStudy::FitStudy(Session& session, QWidget* parent, const Message& title, const Message& about)
    : QDialog(parent), session_(session) {
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowModality(Qt::WindowModal);
  setWindowTitle(inWords(title));
  thread_.setMaxThreadCount(1), painter_.setMaxThreadCount(1);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(20, 18, 20, 16);
  row->setSpacing(18);
  auto* left = new QVBoxLayout;
  auto* words = new QLabel(inWords(about));
  words->setWordWrap(true);
  words->setProperty("role", "faint");
  words->setMinimumHeight(4 * words->fontMetrics().lineSpacing());
  words->setAlignment(Qt::AlignTop);
  left->addWidget(words);
  choices_ = new QListWidget;
  choices_->setObjectName("study_choices");
  choices_->setAccessibleName(inWords(title));
  choices_->setMinimumWidth(260);
  left->addWidget(choices_, 1);
  below_ = new QVBoxLayout;
  left->addLayout(below_);
  go_ = new QPushButton;
  go_->setObjectName("study_go");
  go_->setDefault(true);
  left->addWidget(go_);
  progress_ = new QProgressBar;
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  progress_->setAccessibleName(inWords(say("Progress")));
  left->addWidget(progress_);
  said_ = new QLabel;
  said_->setObjectName("study_said");
  said_->setWordWrap(true);
  said_->setMinimumHeight(3 * said_->fontMetrics().lineSpacing());
  said_->setAlignment(Qt::AlignTop);
  left->addWidget(said_);
  saveTable_ = new QPushButton(inWords(say("Save the table…")));
  savePicture_ = new QPushButton(inWords(say("Save the picture…")));
  auto* close = new QPushButton(inWords(say("Close")));
  saves_ = new QVBoxLayout;
  left->addLayout(saves_);
  for (QPushButton* one : {saveTable_, savePicture_}) one->setAutoDefault(false), saves_->addWidget(one);
  close->setAutoDefault(false);
  left->addWidget(close);
  row->addLayout(left, 0);

  auto* right = new QVBoxLayout;
  table_ = new QTableWidget;
  table_->setObjectName("study_table");
  table_->setAccessibleName(inWords(title));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->verticalHeader()->hide();
  table_->setWordWrap(true);
  table_->setSelectionMode(QAbstractItemView::NoSelection);  // what does not fit is to be seen in its colour
  right->addWidget(table_, 1);
  auto* looks = new QHBoxLayout;
  from_ = new QComboBox;
  from_->addItems({inWords(say("Front")), inWords(say("Back")), inWords(say("Left side")), inWords(say("Right side")),
                   inWords(say("Oblique"))});
  from_->setAccessibleName(inWords(say("From")));
  map_ = new QComboBox;
  map_->setObjectName("study_map");
  map_->addItems({inWords(say("cloth")), inWords(say("strain")), inWords(say("pressure on the body"))});
  map_->setCurrentIndex(kStudyStrain);
  map_->setAccessibleName(inWords(say("Show")));
  looks->addWidget(from_), looks->addWidget(map_), looks->addStretch(1);
  right->addLayout(looks);
  picture_ = new QLabel;
  picture_->setObjectName("study_picture");
  picture_->setAlignment(Qt::AlignCenter);
  picture_->setAccessibleName(inWords(say("All side by side")));
  picture_->setMinimumSize(320, 160);
  picture_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
  right->addWidget(picture_, 3);
  row->addLayout(right, 1);

  connect(go_, &QPushButton::clicked, this, [this] { token_ ? token_->cancel() : go(); });
  connect(saveTable_, &QPushButton::clicked, this, &FitStudy::saveTable);
  connect(savePicture_, &QPushButton::clicked, this, &FitStudy::savePicture);
  connect(close, &QPushButton::clicked, this, &QDialog::close);
  connect(choices_, &QListWidget::itemChanged, this, &FitStudy::enable);
  for (QComboBox* box : {from_, map_}) connect(box, &QComboBox::currentIndexChanged, this, &FitStudy::draw);
  resizeOnScreen(*this, {1180, 760});
  enable();
}

FitStudy::~FitStudy() {
  if (token_) token_->cancel();
  thread_.waitForDone();
  painter_.waitForDone();
}

void FitStudy::choice(const Message& words, bool ticked) {
  auto* item = new QListWidgetItem(inWords(words));
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
  item->setCheckState(ticked ? Qt::Checked : Qt::Unchecked);
  choices_->addItem(item);
  if (choices_->count() == 1) choices_->setCurrentRow(0);
  enable();  // no signal tells of a tick that the item came with
}

std::vector<std::size_t> FitStudy::ticked() const {
  std::vector<std::size_t> all;
  for (int k = 0; k < choices_->count(); ++k)
    if (choices_->item(k)->checkState() == Qt::Checked) all.push_back(static_cast<std::size_t>(k));
  return all;
}

void FitStudy::tell(const Message& words) { said_->setText(inWords(words)); }

void FitStudy::enable() {
  const std::size_t many = ticked().size();
  go_->setText(inWords(busy() ? say("Stop") : say("Begin")));
  const bool some = many > 0 && many <= kMostStudied;
  go_->setEnabled(busy() || some);
  choices_->setEnabled(!busy());
  progress_->setVisible(busy());
  saveTable_->setEnabled(!busy() && !csv_.empty());
  savePicture_->setEnabled(!busy() && image_.width > 0);
  emit ready(!busy() && some);
}

void FitStudy::begin(std::size_t count, const std::vector<Message>& columns, Work work) {
  items_.clear(), csv_.clear(), image_ = Image();
  ++drawing_;
  picture_->clear();
  table_->clear();
  table_->setRowCount(0);
  table_->setColumnCount(static_cast<int>(columns.size()));
  QStringList heads;
  for (const Message& column : columns) heads << inWords(column);
  table_->setHorizontalHeaderLabels(heads);
  for (int k = 0; k < table_->columnCount(); ++k)
    table_->horizontalHeader()->setSectionResizeMode(
        k, k == sentences_ ? QHeaderView::Stretch : QHeaderView::ResizeToContents);
  auto done = std::make_shared<std::atomic<std::size_t>>(0);
  start(
      [done, count](double share) { return (static_cast<double>(done->load()) + share) / static_cast<double>(count); });
  thread_.start([this, token = token_, done, work = std::move(work)] {
    Workers workers(std::max(1, QThread::idealThreadCount() - 1));
    const Tell told = [&](StudyItem item) {
      ++*done;
      onWindow(token, [this, item = std::move(item)] { add(item); });
    };
    const auto table = std::make_shared<Result<std::string>>(work(workers, *token, told));
    onWindow(token, [this, table] { take(*table); });
  });
}

void FitStudy::beginBeside(SideWork work) {
  start([](double share) { return share; });
  thread_.start([this, token = token_, work = std::move(work)] {
    Workers workers(std::max(1, QThread::idealThreadCount() - 1));
    const auto done = std::make_shared<Result<Message>>(work(workers, *token));
    onWindow(token, [this, done] { takeBeside(*done); });
  });
}

// The watcher runs on the working thread, and the dialog waits for that before it goes.
void FitStudy::start(std::function<double(double share)> ofAll) {
  progress_->setValue(0);
  token_ = std::make_shared<Token>([this, ofAll = std::move(ofAll)](double share, const Message& doing) {
    QMetaObject::invokeMethod(
        this,
        [this, all = ofAll(share), doing] {
          progress_->setValue(static_cast<int>(std::clamp(all, 0.0, 1.0) * 1000));
          if (busy() && !doing.empty()) tell(doing);
        },
        Qt::QueuedConnection);
  });
  enable();
}

void FitStudy::onWindow(const std::shared_ptr<Token>& token, std::function<void()> work) {
  QMetaObject::invokeMethod(
      this,
      [this, token, work = std::move(work)] {
        if (token_ == token) work();
      },
      Qt::QueuedConnection);
}

void FitStudy::add(StudyItem item) {
  const int at = table_->rowCount();
  table_->setRowCount(at + 1);
  const auto cell = [&](int column, const Message& words) {
    auto* one = new QTableWidgetItem(inWords(words));
    if (column > 0 && column != sentences_) one->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    if (item.marked) one->setForeground(QColor(0xb0, 0x10, 0x18));
    table_->setItem(at, column, one);
  };
  cell(0, item.name);
  for (std::size_t k = 0; k < item.cells.size(); ++k) cell(static_cast<int>(k) + 1, item.cells[k]);
  table_->resizeRowsToContents();
  items_.push_back(std::move(item));
}

void FitStudy::take(const Result<std::string>& table) {
  const bool stopped = token_->cancelled();
  token_.reset();
  if (table) {
    csv_ = *table;
    const auto misfits = static_cast<std::size_t>(
        std::count_if(items_.begin(), items_.end(), [](const StudyItem& item) { return item.marked; }));
    tell(misfits == 0 ? say("Done.") : faulty(misfits));
    announce(table_, said_->text());
    if (table_->rowCount() > 0) table_->setCurrentCell(0, 0);
    draw();
  } else {
    tell(stopped ? say("Stopped; the table has what was ready.") : table.error().what);
    draw();
  }
  enable();
  emit finished();
}

void FitStudy::takeBeside(const Result<Message>& done) {
  const bool stopped = token_->cancelled();
  token_.reset();
  tell(done ? *done : stopped ? say("Stopped.") : done.error().what);
  announce(said_, said_->text());
  enable();
  emit finished();
}

void FitStudy::draw() {
  if (items_.empty() || busy()) return;
  const std::uint64_t mine = ++drawing_;
  painter_.start([this, mine, items = items_, view = kStudyViews[static_cast<std::size_t>(from_->currentIndex())],
                  map = map_->currentIndex(), language = Theme::here().language()] {
    const auto image = std::make_shared<Result<Image>>(lineUpOf(items, view, map, language));
    QMetaObject::invokeMethod(
        this,
        [this, mine, image] {
          if (mine != drawing_) return;
          if (*image)
            image_ = **image, showPicture();
          else
            tell(image->error().what);
          enable();
          emit drawn();
        },
        Qt::QueuedConnection);
  });
}

void FitStudy::showPicture() {
  if (image_.width == 0) return;
  const QImage whole = pixelsOf(image_);
  const QSize room = picture_->size().boundedTo(whole.size());
  picture_->setPixmap(QPixmap::fromImage(whole.scaled(room, Qt::KeepAspectRatio, Qt::SmoothTransformation)));
}

void FitStudy::resizeEvent(QResizeEvent* event) {
  QDialog::resizeEvent(event);
  showPicture();
}

void FitStudy::saveTable() {
  const QString name = QString::fromStdString(session_.path().stem().string());
  const QString path = askToWrite(this, windowTitle(), name + ".csv", "CSV (*.csv)", {"csv"});
  if (path.isEmpty()) return;
  const Done done = writeFile(path.toStdString(), csv_);
  tell(done ? say("“{0}” was written.", path.toStdString()) : done.error().what);
}

void FitStudy::savePicture() {
  const QString name = QString::fromStdString(session_.path().stem().string());
  const QString path = askToWrite(this, windowTitle(), name + ".png", "PNG (*.png)", {"png"});
  if (path.isEmpty()) return;
  const Done done = writePng(path.toStdString(), image_);
  tell(done ? say("“{0}” was written.", path.toStdString()) : done.error().what);
}

}  // namespace karinui::studio

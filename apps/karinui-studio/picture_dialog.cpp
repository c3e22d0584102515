#include "picture_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <numbers>
#include <thread>

#include "beside.h"
#include "karinui/view/line_up.h"
#include "pixels.h"
#include "theme.h"

namespace karinui::studio {

namespace {
constexpr std::array kSizes{std::array{900, 1200}, std::array{1800, 2400}, std::array{3600, 4800},
                            std::array{1920, 1080}};
constexpr std::array kViews{View::Front, View::Back, View::Left, View::Right, View::Oblique};
// After them in the list: several sides of the fitting.
enum Round { kFourSides = 6, kStrip, kTurntable };
constexpr int kStripSides = 8, kFewestFrames = 8, kUsualFrames = 120, kMostFrames = 720;
constexpr std::array kEyes{Eyes::Mono, Eyes::SideBySide, Eyes::TopBottom, Eyes::Anaglyph};

// What stands beside the fitting at the left, as in the window; the sheet as large as one picture would be.
Result<Image> pair(const Beside& beside, const SceneFrame& then, const SceneFrame& now, PictureOptions how, int sides) {
  const std::vector<SceneFrame> frames{then, now};
  const bool allRound = sides > 1;
  const int count = 2 * sides, columns = allRound ? sides : 2;
  const SheetLayout sheet{.columns = columns, .joined = true, .width = how.width, .height = how.height};
  const SheetCell cell = sheetCell(count, sheet);
  how.width = cell.width, how.height = cell.height;
  LineUp lineUp({{text(beside.words(), how.language)}, {text(say("now"), how.language)}}, frames, how);
  lineUp.fill(sheet.width, sheet.height);
  return allRound ? lineUp.turns(sides) : lineUp.draw();
}

// So many sides of a whole turn, in two rows; the sheet as large as one picture would be.
Result<Image> strip(const SceneFrame& frame, PictureOptions how) {
  const SheetLayout sheet{.columns = kStripSides / 2, .joined = true, .width = how.width, .height = how.height};
  const SheetCell cell = sheetCell(kStripSides, sheet);
  how.width = cell.width, how.height = cell.height;
  LineUp lineUp({{}}, {&frame, 1}, how);
  lineUp.fill(sheet.width, sheet.height);
  return lineUp.turns(kStripSides);
}

// On one sheet as large as one picture would be.
Result<Image> fourSides(Picture& picture, const SceneFrame& frame, PictureOptions how) {
  const SheetLayout sheet{.columns = 2, .width = how.width, .height = how.height};
  const SheetCell cell = sheetCell(4, sheet);
  how.width = cell.width, how.height = cell.height;
  std::vector<SheetItem> items;
  const std::pair<View, Message> sides[] = {{View::Front, say("Front")},
                                            {View::Left, say("Left side")},
                                            {View::Back, say("Back")},
                                            {View::Right, say("Right side")}};
  for (const auto& [side, words] : sides) {
    how.view = side;
    auto image = picture.draw(frame, how);
    if (!image) return image.error();
    items.push_back({*std::move(image), text(words, how.language)});
  }
  return contactSheet(items, sheet);
}

}  // namespace

PictureDialog::PictureDialog(Session& session, SpaceView& view, QWidget* parent)
    : QDialog(parent), session_(session), view_(view) {
  setWindowTitle(inWords(say("Picture of the fitting")));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(24, 24, 24, 20);
  row->setSpacing(22);
  auto* left = new QVBoxLayout;
  auto* form = new QFormLayout;
  form->setSpacing(12);
  from_ = new QComboBox;
  from_->addItems({inWords(say("as it is seen now")), inWords(say("Front")), inWords(say("Back")),
                   inWords(say("Left side")), inWords(say("Right side")), inWords(say("Oblique")),
                   inWords(say("all round, on one sheet")), inWords(say("eight sides of a turn, on one sheet")),
                   inWords(say("turntable: numbered pictures of a whole turn"))});
  size_ = new QComboBox;
  for (const auto& [wide, high] : kSizes) size_->addItem(QString("%1 × %2").arg(wide).arg(high));
  size_->setCurrentIndex(1);
  eyes_ = new QComboBox;
  eyes_->addItems({inWords(say("off")), inWords(say("side by side")), inWords(say("top and bottom")),
                   inWords(say("red-cyan glasses"))});
  const std::pair<Message, QComboBox*> rows[] = {{say("From"), from_}, {say("Pixels"), size_}, {say("Stereo"), eyes_}};
  for (const auto& [words, box] : rows) {
    form->addRow(inWords(words), box);
    box->setAccessibleName(inWords(words));
    connect(box, &QComboBox::currentIndexChanged, this, &PictureDialog::refresh);
  }
  count_ = new QSpinBox;
  count_->setRange(kFewestFrames, kMostFrames);
  count_->setValue(kUsualFrames);
  count_->setObjectName("picture_count");
  count_->setAccessibleName(inWords(say("Pictures")));
  count_->setToolTip(inWords(say("Any program makes a film of them; 120 are 5 seconds at 24 a second.")));
  form->addRow(inWords(say("Pictures")), count_);
  rows_ = form;
  left->addLayout(form);
  left->addStretch(1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Save)->setText(inWords(say("Save…")));
  buttons->button(QDialogButtonBox::Cancel)->setText(inWords(say("Cancel")));
  left->addWidget(buttons);
  row->addLayout(left);
  picture_ = new QLabel;
  picture_->setAlignment(Qt::AlignCenter);
  picture_->setFixedSize(420, 420);
  picture_->setAccessibleName(inWords(say("Preview")));
  row->addWidget(picture_);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  refresh();
}

PictureOptions PictureDialog::options(double scale) const {
  const auto size = kSizes[static_cast<std::size_t>(size_->currentIndex())];
  PictureOptions how;
  how.width = static_cast<int>(size[0] * scale), how.height = static_cast<int>(size[1] * scale);
  how.eyes = kEyes[static_cast<std::size_t>(eyes_->currentIndex())];
  how.map = view_.map() == FitMap::Strain ? Map::Strain : view_.map() == FitMap::Pressure ? Map::Pressure : Map::None;
  how.language = Theme::here().language();
  how.lettering = how.map != Map::None;
  if (from_->currentIndex() > kFourSides) how.eyes = Eyes::Mono;
  return how;
}

Result<Image> PictureDialog::draw(double scale) const {
  PictureOptions how = options(scale);
  const int from = from_->currentIndex();
  if (from == 0) how.camera = view_.camera();
  if (from > 0 && from <= static_cast<int>(kViews.size())) how.view = kViews[static_cast<std::size_t>(from - 1)];
  // On a thread of its own: this one's is the window's context, and some drivers allow no second.
  std::optional<Result<Image>> image;
  std::thread([&] {
    const Beside* beside = parent()->findChild<Beside*>();
    const bool two = beside && beside->fitting();
    const auto now = framed(session_.snapshot(), how);
    const auto then = two ? framed(*beside->fitting(), how) : Result<const SceneFrame*>(nullptr);
    if (!now || !then) {
      image = !now ? now.error() : then.error();
      return;
    }
    if (two) {
      image = pair(*beside, **then, **now, how, from == kFourSides ? 4 : from == kStrip ? kStripSides : 1);
      return;
    }
    if (from == kStrip) {
      image = strip(**now, how);
      return;
    }
    auto picture = Picture::open();
    image = !picture             ? picture.error()
            : from == kFourSides ? fourSides(**picture, **now, how)
                                 : (*picture)->draw(**now, how);
  }).join();
  return *std::move(image);
}

// With what the map tells, whose scale goes up as far as that of any fitting on the picture. Pressure takes tenths of a
// second and is the same for every view.
Result<const SceneFrame*> PictureDialog::framed(const GarmentSnapshot& fitting, PictureOptions& how) const {
  if (how.map != Map::Pressure) return &fitting.frame;
  auto known = pressed_.find(&fitting);
  if (known == pressed_.end()) {
    Workers alone(1);
    auto pressed = pressedFrame(fitting, alone);
    if (!pressed) return pressed.error();
    known = pressed_.emplace(&fitting, *std::move(pressed)).first;
  }
  how.mapTop = std::max(how.mapTop, known->second.top);
  return &known->second.frame;
}

Done PictureDialog::write(const std::string& path) const {
  const auto image = draw();
  return image ? writePng(path, *image) : Done(image.error());
}

int PictureDialog::frames() const { return from_->currentIndex() == kTurntable ? count_->value() : 0; }

Result<int> PictureDialog::writeTurn(const std::string& folder, const std::function<bool(int)>& goesOn,
                                     double scale) const {
  namespace fs = std::filesystem;
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return refused(say("The folder “{0}” cannot be made: {1}", folder, failed.message()));
  PictureOptions how = options(scale);
  how.eyes = Eyes::Mono;
  const Beside* beside = parent()->findChild<Beside*>();
  const bool two = beside && beside->fitting();
  const auto now = framed(session_.snapshot(), how);
  const auto then = two ? framed(*beside->fitting(), how) : Result<const SceneFrame*>(nullptr);
  if (!now || !then) return !now ? now.error() : then.error();
  const SheetLayout sheet{.columns = 2, .joined = true, .width = how.width, .height = how.height};
  std::vector<SceneFrame> all{**now};
  std::vector<LineUp::Figure> figures{{}};
  if (two) {
    all.insert(all.begin(), **then);
    figures = {{text(beside->words(), how.language)}, {text(say("now"), how.language)}};
    const SheetCell cell = sheetCell(2, sheet);
    how.width = cell.width, how.height = cell.height;
  }
  std::atomic<int> drawn = 0;
  std::atomic<bool> stop = false, over = false;
  Done done;
  std::thread worker([&] {
    LineUp lineUp(figures, all, how);
    lineUp.keepAll();
    if (two) lineUp.fill(sheet.width, sheet.height);
    for (int k = 0, count = frames(); k < count && !stop && done; ++k) {
      const auto image = lineUp.draw(2 * std::numbers::pi * k / count, static_cast<int>(all.size()));
      const std::string number = std::to_string(k + 1);
      const std::string name = "frame_" + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number;
      done = image ? writePng((fs::path(folder) / (name + ".png")).string(), *image) : Done(image.error());
      if (done) ++drawn;
    }
    over = true;
  });
  while (!over) {
    if (!goesOn(drawn)) stop = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  worker.join();
  if (!done) return done.error();
  return drawn.load();
}

void PictureDialog::refresh() {
  rows_->setRowVisible(count_, from_->currentIndex() == kTurntable);
  // Two garments, and those that turn, are drawn for one eye.
  eyes_->setEnabled(!view_.beside() && from_->currentIndex() <= kFourSides);
  const auto size = kSizes[static_cast<std::size_t>(size_->currentIndex())];
  const auto image = draw(400.0 / std::max(size[0], size[1]));
  if (!image) return picture_->setText(inWords(image.error().what));
  picture_->setPixmap(
      QPixmap::fromImage(pixelsOf(*image).scaled(picture_->size(), Qt::KeepAspectRatio, Qt::SmoothTransformation)));
}

}  // namespace karinui::studio

#include "picture_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
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
constexpr std::array kEyes{Eyes::Mono, Eyes::SideBySide, Eyes::TopBottom, Eyes::Anaglyph};

// What stands beside the fitting at the left, as in the window; the sheet as large as one picture would be.
Result<Image> pair(const Beside& beside, const SceneFrame& then, const SceneFrame& now, PictureOptions how,
                   bool allRound) {
  const std::vector<SceneFrame> frames{then, now};
  const int count = allRound ? 8 : 2, columns = allRound ? 4 : 2;
  const SheetLayout sheet{.columns = columns, .joined = true, .width = how.width, .height = how.height};
  const SheetCell cell = sheetCell(count, sheet);
  how.width = cell.width, how.height = cell.height;
  LineUp lineUp({{text(beside.words(), how.language)}, {text(say("now"), how.language)}}, frames, how);
  lineUp.fill(sheet.width, sheet.height);
  return allRound ? lineUp.turns(4) : lineUp.draw();
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
                   inWords(say("all round, on one sheet"))});
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
  eyes_->setEnabled(!view_.beside());  // two garments are drawn for one eye
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

Result<Image> PictureDialog::draw(double scale) const {
  const auto size = kSizes[static_cast<std::size_t>(size_->currentIndex())];
  PictureOptions how;
  how.width = static_cast<int>(size[0] * scale), how.height = static_cast<int>(size[1] * scale);
  how.eyes = kEyes[static_cast<std::size_t>(eyes_->currentIndex())];
  how.map = view_.map() == FitMap::Strain ? Map::Strain : view_.map() == FitMap::Pressure ? Map::Pressure : Map::None;
  how.language = Theme::here().language();
  how.lettering = how.map != Map::None;
  const int from = from_->currentIndex();
  if (from == 0) how.camera = view_.camera();
  if (from > 0 && from <= static_cast<int>(kViews.size())) how.view = kViews[static_cast<std::size_t>(from - 1)];
  const bool allRound = from > static_cast<int>(kViews.size());
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
      image = pair(*beside, **then, **now, how, allRound);
      return;
    }
    auto picture = Picture::open();
    image = !picture ? picture.error() : allRound ? fourSides(**picture, **now, how) : (*picture)->draw(**now, how);
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

void PictureDialog::refresh() {
  const auto size = kSizes[static_cast<std::size_t>(size_->currentIndex())];
  const auto image = draw(400.0 / std::max(size[0], size[1]));
  if (!image) return picture_->setText(inWords(image.error().what));
  picture_->setPixmap(
      QPixmap::fromImage(pixelsOf(*image).scaled(picture_->size(), Qt::KeepAspectRatio, Qt::SmoothTransformation)));
}

}  // namespace karinui::studio

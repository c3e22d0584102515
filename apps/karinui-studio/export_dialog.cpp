#include "export_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDate>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSettings>
#include <QSlider>
#include <QStackedWidget>

#include "karinui/base/number.h"
#include "length_box.h"
#include "paper.h"
#include "theme.h"

namespace karinui::studio {

namespace {
constexpr QSize kPreview(440, 480);
}

QCheckBox* pairsOnceBox() {
  const char* key = "print/pairs_once";
  auto* box = new QCheckBox(inWords(say("Left and right alike: drawn once, cut in pairs")));
  box->setObjectName("pairs_once");
  box->setChecked(QSettings().value(key, false).toBool());
  QObject::connect(box, &QCheckBox::toggled, [key](bool on) { QSettings().setValue(key, on); });
  return box;
}

ExportDialog::ExportDialog(Session& session, SpaceView& view, QWidget* parent)
    : QDialog(parent), session_(session), view_(view) {
  setWindowTitle(inWords(say("Export")));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(24, 24, 24, 20);
  row->setSpacing(22);
  auto* left = new QVBoxLayout;
  auto* form = new QFormLayout;
  form->setSpacing(12);
  kind_ = new QComboBox;
  for (const FileFormat* format : exportFormats()) kind_->addItem(inWords(format->label));
  kind_->setAccessibleName(inWords(say("What")));
  about_ = new QLabel;
  about_->setWordWrap(true);
  about_->setMinimumHeight(64);
  about_->setAlignment(Qt::AlignTop);
  about_->setProperty("role", "faint");
  allowance_ = new LengthBox(say("Seam allowance"), 0, 0.1);
  const Document& document = session_.snapshot().document;
  allowance_->setMetres(AllowancePlan(document.pattern, document.allowances).width(EdgeKind::Seam));
  pairs_ = pairsOnceBox();
  page_ = new QSlider(Qt::Horizontal);
  page_->setAccessibleName(inWords(say("Page")));
  page_->setPageStep(1);
  number_ = new QLabel;
  size_ = new QLabel;
  size_->setWordWrap(true);
  form->addRow(inWords(say("What")), kind_);
  form->addRow(about_);
  form->addRow(inWords(say("Seam allowance")), allowance_);
  form->addRow(QString(), pairs_);
  form->addRow(inWords(say("Page")), page_);
  form->addRow(QString(), number_);
  form->addRow(size_);
  left->addLayout(form);
  left->addStretch(1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel);
  save_ = buttons->button(QDialogButtonBox::Save);
  save_->setText(inWords(say("Save…")));
  buttons->button(QDialogButtonBox::Cancel)->setText(inWords(say("Cancel")));
  left->addWidget(buttons);
  row->addLayout(left, 0);
  shown_ = new QStackedWidget;
  shown_->setMinimumSize(kPreview);
  picture_ = new QLabel;
  picture_->setAlignment(Qt::AlignCenter);
  picture_->setMinimumSize(1, 1);
  picture_->setAccessibleName(inWords(say("Preview")));
  text_ = new QPlainTextEdit;
  text_->setReadOnly(true);
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setAccessibleName(inWords(say("Preview")));
  shown_->addWidget(picture_);
  shown_->addWidget(text_);
  row->addWidget(shown_, 1);
  connect(kind_, &QComboBox::currentIndexChanged, this, &ExportDialog::refresh);
  connect(allowance_, &LengthBox::typed, this, &ExportDialog::refresh);
  connect(pairs_, &QCheckBox::toggled, this, &ExportDialog::refresh);
  connect(page_, &QSlider::valueChanged, this, &ExportDialog::showPage);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  resize(860, 560);
  refresh();
}

ExportWish ExportDialog::wish() const {
  ExportWish wish;
  wish.format = exportFormats()[static_cast<std::size_t>(kind_->currentIndex())];
  wish.sheet.allowance = allowance_->value();
  wish.sheet.pairsOnce = pairs_->isChecked() && isPaper(*wish.format);
  wish.sheet.language = Theme::here().language();
  wish.sheet.date = QDate::currentDate().toString(Qt::ISODate).toStdString();
  if (const auto stem = session_.path().stem().string(); !stem.empty()) wish.sheet.title = stem;
  return wish;
}

void ExportDialog::refresh() {
  const ExportWish wanted = wish();
  const FileContent content = wanted.format->out;
  about_->setText(inWords(wanted.format->about));
  const bool paper = content == FileContent::Sheet;
  allowance_->setEnabled(paper);
  pairs_->setEnabled(isPaper(*wanted.format));
  paper_.reset();
  trouble_.reset();
  const Result<std::string> bytes = exported(session_.snapshot(), session_.steps(), wanted);
  save_->setEnabled(static_cast<bool>(bytes));
  if (!bytes) {
    trouble_ = bytes.error();
    size_->clear();
    page_->setRange(1, 1);
    picture_->setText(inWords(trouble_->what));
    return shown_->setCurrentWidget(picture_);
  }
  QString words = QString::fromStdString(fixed(static_cast<double>(bytes->size()) / 1024, 1)) + " kB";
  if (paper)
    if (auto pages = paperOf(session_.snapshot(), wanted)) {
      paper_ = *std::move(pages);
      const Flat size = paper_->size(0);
      words += "\n" + lengthText(size.u) + " × " + lengthText(size.v);
    }
  size_->setText(words);
  const int pages = paper_ ? static_cast<int>(paper_->count()) : 1;
  page_->setRange(1, pages);
  page_->setEnabled(pages > 1);
  if (content == FileContent::Pattern || content == FileContent::Script) {
    constexpr std::size_t kMost = 20000;
    text_->setPlainText(QString::fromStdString(bytes->substr(0, kMost)) + (bytes->size() > kMost ? "\n…" : ""));
    return shown_->setCurrentWidget(text_);
  }
  shown_->setCurrentWidget(picture_);
  showPage();
}

void ExportDialog::showPage() {
  if (trouble_) return;
  number_->setText(QString("%1 / %2").arg(page_->value()).arg(page_->maximum()));
  const double ratio = devicePixelRatioF();
  const QSize room = (QSizeF(shown_->size()) * ratio).toSize();
  QPixmap picture = QPixmap::fromImage(
      paper_ ? pagePicture(*paper_, static_cast<std::size_t>(page_->value() - 1), room)
             : view_.portrait(session_.snapshot().frame, QSize(room.height() * 3 / 4, room.height())));
  picture.setDevicePixelRatio(ratio);
  picture_->setPixmap(picture);
}

void ExportDialog::resizeEvent(QResizeEvent* event) {
  QDialog::resizeEvent(event);
  if (shown_->currentWidget() == picture_) showPage();
}

}  // namespace karinui::studio

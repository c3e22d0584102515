#include "lay_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSettings>
#include <QTabBar>
#include <QThread>
#include <QVBoxLayout>
#include <cmath>

#include "accessibility.h"
#include "file_filter.h"
#include "karinui/base/file.h"
#include "karinui/base/number.h"
#include "karinui/exchange/lay_sheet.h"
#include "lay_view.h"
#include "length_box.h"
#include "theme.h"

namespace karinui::studio {

namespace {

// The formats of the pattern's own paper that a lay plan is written as, too, and what they are called here.
struct SheetFormat {
  std::string_view format;
  Message label;
};
const std::vector<SheetFormat>& sheetFormats() {
  static const std::vector<SheetFormat> all = {{"pdf", say("PDF on one sheet")},
                                               {"pdf-a4", say("PDF on A4 sheets")},
                                               {"pdf-letter", say("PDF on Letter sheets")},
                                               {"pdf-a3", say("PDF on A3 sheets")},
                                               {"pdf-a0", say("PDF on A0 sheets")},
                                               {"pdf-36in", say("PDF on 36-inch sheets")},
                                               {"svg", say("Drawing (SVG)")},
                                               {"dxf-aama", say("CAD (DXF)")},
                                               {"hpgl", say("Plotter (HPGL)")}};
  return all;
}

constexpr int kTries[] = {400, 4000, 40000};
constexpr double kWidest = 10, kWidestGap = 0.1, kLongestRepeat = 1;  // as layPlan() allows

// Never told too short: up to the next tenth of a centimetre or an inch.
QString clothText(double metres) {
  const double step = Theme::here().inches() ? 0.00254 : 0.001;
  return lengthText(std::ceil(metres / step - 1e-3) * step);
}

}  // namespace

LayDialog::LayDialog(Session& session, QWidget* parent)
    : QDialog(parent), session_(session), document_(session.snapshot().document) {
  setObjectName("lay_dialog");
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowModality(Qt::WindowModal);
  setWindowTitle(inWords(say("Lay plan")));
  thread_.setMaxThreadCount(1);
  const QSettings kept;
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(20, 18, 20, 16);
  row->setSpacing(18);
  auto* left = new QVBoxLayout;
  auto* form = new QFormLayout;
  form->setSpacing(10);
  const auto length = [&](const Message& name, const Message& hint, const char* key, double low, double high,
                          double usual) {
    auto* box = new LengthBox(name, low, high);
    box->setMetres(kept.value(QString("lay/") + key, usual).toDouble());
    box->setToolTip(inWords(hint));
    box->setAccessibleDescription(inWords(hint));
    form->addRow(inWords(name), box);
    return box;
  };
  const auto tick = [&](const Message& name, const Message& hint, const char* key) {
    auto* box = new QCheckBox(inWords(name));
    box->setChecked(kept.value(QString("lay/") + key, false).toBool());
    box->setToolTip(inWords(hint));
    box->setAccessibleDescription(inWords(hint));
    form->addRow(box);
    return box;
  };
  const LaySettings usual;
  width_ =
      length(say("Width of the cloth"), say("Between its selvedges, laid open."), "width", 0.1, kWidest, usual.width);
  fold_ = tick(say("Folded lengthwise"),
               say("The cloth is folded lengthwise: pairs are cut at once, halves lie on the fold"), "fold");
  gap_ = length(say("Gap"), say("Between the cut lines of two pieces."), "gap", 0, kWidestGap, usual.gap);
  nap_ = tick(say("One way only"), say("All pieces lie the same way up: nap, or a print with a direction"), "nap");
  stripes_ = length(say("Stripes"),
                    say("Repeat of stripes along the cloth, counted across it; they are centred on each piece"),
                    "stripes", 0, kLongestRepeat, 0);
  rows_ = length(say("Rows"), say("Repeat of stripes across the cloth, counted along it; they meet in the seams"),
                 "rows", 0, kLongestRepeat, 0);
  for (LengthBox* none : {stripes_, rows_}) {
    none->setSpecialValueText(inWords(say("none")));
    none->setMetres(none->value());
  }
  search_ = new QComboBox;
  for (const Message& words : {say("quick"), say("usual"), say("thorough")}) search_->addItem(inWords(words));
  search_->setCurrentIndex(std::clamp(kept.value("lay/search", 1).toInt(), 0, 2));
  search_->setAccessibleName(inWords(say("Search")));
  search_->setToolTip(inWords(say("How many orders of the pieces are tried; more take less cloth")));
  form->addRow(inWords(say("Search")), search_);
  left->addLayout(form);
  lay_ = new QPushButton;
  lay_->setDefault(true);
  left->addWidget(lay_);
  progress_ = new QProgressBar;
  progress_->setRange(0, 100);
  progress_->setTextVisible(false);
  progress_->setAccessibleName(inWords(say("Progress of the search")));
  left->addWidget(progress_);
  notes_ = new QLabel;
  notes_->setWordWrap(true);
  notes_->setProperty("role", "faint");
  left->addWidget(notes_);
  left->addStretch(1);
  kind_ = new QComboBox;
  for (const SheetFormat& kind : sheetFormats()) kind_->addItem(inWords(kind.label));
  kind_->setAccessibleName(inWords(say("What")));
  left->addWidget(kind_);
  auto* buttons = new QHBoxLayout;
  save_ = new QPushButton(inWords(say("Save…")));
  auto* close = new QPushButton(inWords(say("Close")));
  for (QPushButton* one : {save_, close}) one->setAutoDefault(false), buttons->addWidget(one);
  left->addLayout(buttons);
  row->addLayout(left, 0);

  auto* right = new QVBoxLayout;
  fabrics_ = new QTabBar;
  fabrics_->setAccessibleName(inWords(say("Fabric")));
  fabrics_->setExpanding(false);
  right->addWidget(fabrics_);
  use_ = new QLabel;
  use_->setProperty("role", "title");
  use_->setObjectName("lay_use");
  right->addWidget(use_);
  view_ = new LayView;
  right->addWidget(view_, 1);
  said_ = new QLabel;
  said_->setObjectName("lay_said");
  said_->setWordWrap(true);
  said_->setMinimumHeight(2 * said_->fontMetrics().lineSpacing());
  said_->setAlignment(Qt::AlignTop);
  right->addWidget(said_);
  row->addLayout(right, 1);

  connect(lay_, &QPushButton::clicked, this, [this] { token_ ? token_->cancel() : begin(); });
  connect(save_, &QPushButton::clicked, this, &LayDialog::save);
  connect(close, &QPushButton::clicked, this, &QDialog::close);
  connect(fabrics_, &QTabBar::currentChanged, this, &LayDialog::showFabric);
  connect(view_, &LayView::changed, this, &LayDialog::tellUse);
  connect(view_, &LayView::said, this, &LayDialog::tell);
  resizeOnScreen(*this, {1120, 640});
  begin();
}

LayDialog::~LayDialog() {
  if (token_) token_->cancel();
  thread_.waitForDone();
}

LaySettings LayDialog::settings() const {
  LaySettings settings;
  settings.width = width_->value();
  settings.folded = fold_->isChecked();
  settings.gap = gap_->value();
  settings.nap = nap_->isChecked();
  settings.stripes = stripes_->value();
  settings.rows = rows_->value();
  settings.tries = kTries[search_->currentIndex()];
  return settings;
}

void LayDialog::keepSettings() const {
  QSettings keep;
  for (const auto& [key, box] :
       {std::pair{"lay/width", width_}, {"lay/gap", gap_}, {"lay/stripes", stripes_}, {"lay/rows", rows_}})
    keep.setValue(key, box->value());
  keep.setValue("lay/fold", fold_->isChecked());
  keep.setValue("lay/nap", nap_->isChecked());
  keep.setValue("lay/search", search_->currentIndex());
}

void LayDialog::begin() {
  keepSettings();
  progress_->setValue(0);
  // The watcher runs on the working thread, and the dialog waits for that before it goes.
  token_ = std::make_shared<Token>([this](double share, const Message&) {
    QMetaObject::invokeMethod(
        progress_, [this, share] { progress_->setValue(static_cast<int>(share * 100)); }, Qt::QueuedConnection);
  });
  enable();
  tell(say("The pieces are being laid …"));
  thread_.start([this, token = token_, wanted = settings(), document = document_] {
    Workers workers(QThread::idealThreadCount());
    MemoryBlobs blobs;
    Bodies bodies;
    Context context{workers, *token, blobs, bodies, {}, {}};
    auto found = std::make_shared<Result<LayPlan>>(layPlan(document, wanted, context));
    QMetaObject::invokeMethod(
        this, [this, found] { take(*std::move(found)); }, Qt::QueuedConnection);
  });
}

void LayDialog::take(Result<LayPlan> found) {
  const bool stopped = token_->cancelled();
  token_.reset();
  if (found) {
    plan_ = *std::move(found);
    const QSignalBlocker quiet(fabrics_);
    const int was = fabrics_->currentIndex();
    while (fabrics_->count() > 0) fabrics_->removeTab(0);
    for (const FabricLay& lay : plan_->fabrics) fabrics_->addTab(nameText(lay.fabric));
    fabrics_->setCurrentIndex(std::clamp(was, 0, fabrics_->count() - 1));
    QStringList notes;
    for (const Message& note : plan_->notes) notes << inWords(note);
    notes_->setText(notes.join("\n"));
    showFabric();
    tell(
        say("Drag a piece to move it; a double click or T turns it half round. Tab goes from piece to piece, arrows "
            "carry, Enter lets go."));
  } else if (stopped) {
    tell(plan_ ? say("Stopped; the plan is as it was.") : say("Stopped; there is no plan yet."));
  } else {
    tell(found.error().what);
  }
  enable();
  emit finished();
}

// While it searches nothing is moved or written.
void LayDialog::enable() {
  const bool searching = busy();
  lay_->setText(searching ? inWords(say("Stop")) : plan_ ? inWords(say("Lay anew")) : inWords(say("Lay")));
  progress_->setVisible(searching);
  save_->setEnabled(plan_ && !searching);
  view_->setEnabled(plan_ && !searching);
  fabrics_->setEnabled(plan_ && !searching);
  for (QWidget* one : std::initializer_list<QWidget*>{width_, fold_, gap_, nap_, stripes_, rows_, search_})
    one->setEnabled(!searching);
}

void LayDialog::showFabric() {
  view_->setLay(plan_ ? &*plan_ : nullptr, static_cast<std::size_t>(std::max(0, fabrics_->currentIndex())));
  tellUse();
}

void LayDialog::tellUse() {
  if (!plan_) return use_->clear();
  const FabricLay& lay = plan_->fabrics[static_cast<std::size_t>(std::max(0, fabrics_->currentIndex()))];
  const std::string length = clothText(lay.length).toStdString(),
                    wide = lengthText(plan_->settings.width).toStdString(), use = fixed(lay.use * 100, 1);
  use_->setText(inWords(plan_->settings.folded ? say("{0} of cloth {1} wide, folded; {2} % used", length, wide, use)
                                               : say("{0} of cloth {1} wide; {2} % used", length, wide, use)));
}

void LayDialog::tell(const Message& words) {
  said_->setText(inWords(words));
  if (view_->hasFocus()) announce(view_, said_->text());
}

void LayDialog::save() {
  const SheetFormat& kind = sheetFormats()[static_cast<std::size_t>(kind_->currentIndex())];
  const FileFormat& format = fileFormat(kind.format);
  const QFileInfo own(QString::fromStdString(session_.path().string()));
  const QString name = own.completeBaseName().isEmpty() ? inWords(say("Lay plan")) : own.completeBaseName();
  const QString path = askToWrite(this, inWords(say("Lay plan")), QDir(own.path()).filePath(name),
                                  filterWriting(format), endingsOf(format));
  if (path.isEmpty()) return;
  LayPaper paper;
  paper.title = name.toStdString();
  paper.paper = format.paper;
  paper.language = Theme::here().language();
  const Result<std::string> bytes = writeLay(*plan_, format.endings.front(), paper);
  const Done done = bytes ? writeFile(path.toStdString(), *bytes) : Done(bytes.error());
  tell(done ? say("“{0}” was written.", path.toStdString()) : done.error().what);
}

}  // namespace karinui::studio

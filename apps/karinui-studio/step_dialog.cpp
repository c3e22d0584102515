#include "step_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include "karinui/base/number.h"
#include "karinui/design/block_numbers.h"
#include "karinui/design/variables.h"
#include "outline_drawing.h"
#include "theme.h"
#include "variables_dialog.h"

namespace karinui::studio {

namespace {

constexpr std::string_view kDrawnPleat = "a pleat whose lines say the rest",
                           kPleatTo = "a pleat that runs out at an edge", kZipThere = "a zip that is there",
                           kButtonsThere = "buttons that are there", kSizes = "the sizes of a garment",
                           kCorners = "corners that go from size to size";

// What is asked at once; everything else an operation can be told is under “More”.
constexpr std::pair<std::string_view, std::string_view> kFirst[] = {
    {"rectangle", "name width height fabric"},
    {"polygon", "name points symmetric fabric"},
    {"ring", "name inner radius depth angle fabric"},
    {"band", "name depth ratio extra sew turn"},
    {"attach", "edge to turn"},
    {"fasten", "kind a b count spacing first last size length stand closed closed_length"},
    {"block", "kind ease length fabric"},
    {"pleat", "edge kind depth count turned stitch hold"},
    {"elastic", "edges ratio length rows spacing"},
    {"pocket", "kind first inset length depth below fabric"},
    {"welt", "kind at turn length width below fabric"},
    {"strap", "name from to width length"},
    {kDrawnPleat, "lines stitch hold"},
    {kPleatTo, "edge to at to_at depth turned stitch hold"},
    {kZipThere, "closed_length"},
    {kButtonsThere, "closed"},
    {kSizes, "sizes base"},
    {kCorners, "corners by size symmetric"},
    {"underlay", "width at turn strength rectangle"},
};

// What of an operation is asked.
struct Asked {
  std::string_view what;  // of kFirst, or the operation's name
  bool only = false;      // the rest stays as it is
};

Asked askedOf(const Operation& operation) {
  if (const auto* pleat = std::get_if<AddPleat>(&operation); pleat && !pleat->lines.empty()) return {kDrawnPleat};
  if (const auto* pleat = std::get_if<AddPleat>(&operation); pleat && pleat->to) return {kPleatTo};
  if (const auto* grade = std::get_if<GradePieces>(&operation))
    return {grade->corners.empty() ? kSizes : kCorners, true};
  const auto* there = std::get_if<Fasten>(&operation);
  if (there && !there->name.empty() && there->a.empty())
    return {there->closedLength ? kZipThere : there->closed ? kButtonsThere : Fasten::kName, true};
  return {nameOf(operation)};
}

bool isFirst(std::string_view operation, std::string_view field) {
  for (const auto& [name, fields] : kFirst)
    if (name == operation)
      return (" " + std::string(fields) + " ").find(" " + std::string(field) + " ") != std::string::npos;
  return true;
}

// What an operation does where it is not told otherwise, of the numbers that are asked at once.
std::string usualOf(std::string_view operation, const FieldHelp& field) {
  const bool number = field.kind == "length" || field.kind == "angle" || field.kind == "number";
  return number && isFirst(operation, field.name) && parseNumber(field.usual).value_or(1) != 0 ? field.usual
                                                                                               : std::string();
}

// A field that shows all it holds, or the beginning of it where that is very long.
void giveRoom(QWidget& box) {
  constexpr int kFrame = 30, kWidest = 420;  // pixels
  if (auto* line = qobject_cast<QLineEdit*>(&box))
    line->setMinimumWidth(std::min(kWidest, line->fontMetrics().horizontalAdvance(line->text()) + kFrame));
  if (auto* list = qobject_cast<QComboBox*>(&box)) {
    list->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    list->setMinimumContentsLength(0);
    list->setMinimumWidth(std::min(kWidest, list->sizeHint().width()));
  }
}

// As high as what it holds, and scrolled where the screen has no room for that.
class FieldsArea : public QScrollArea {
 public:
  QSize sizeHint() const override { return roomed(widget()->sizeHint()); }
  QSize minimumSizeHint() const override { return {roomed(widget()->minimumSizeHint()).width(), 80}; }

 private:
  QSize roomed(QSize size) const { return {size.width() + verticalScrollBar()->sizeHint().width(), size.height()}; }
};

bool drawnOnPaper(std::string_view operation) {
  return operation == DrawRectangle::kName || operation == DrawPolygon::kName || operation == DrawRing::kName ||
         operation == DrawBand::kName || operation == DrawStrap::kName;
}

}  // namespace

Result<std::shared_ptr<const Piece>> tried(const Session& session, Operation operation) {
  if (auto* band = std::get_if<DrawBand>(&operation)) band->sew = false;
  // Formulas are worked out for the figure that is there, which need not be built once more.
  std::vector<FieldText> fields = fieldTexts(operation);
  DocumentNames names = formulaNames(session);
  for (const FieldText& formula : operation.formulas) {
    const auto field =
        std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.name == formula.name; });
    const auto value = workedOut(formula.value, names);
    if (!value) return value.error();
    const std::string unit = value->dimension == kLength ? "m" : value->dimension == kAngle ? "rad" : "";
    if (field != fields.end()) field->value = shortest(value->value) + unit;
  }
  auto plain = parseOperation(lineOf(nameOf(operation), fields));
  if (!plain) return plain.error();
  Workers workers;
  MemoryBlobs blobs;
  Bodies bodies;  // the figure is not built once more
  if (const BodyPtr& body = session.snapshot().body) bodies.keep(body);
  const Token token;
  Context context{workers, token, blobs, bodies, {}, {}};
  const Document& before = session.snapshot().document;
  const auto* scan = std::get_if<LayUnderlay>(&*plain);
  if (scan && !scan->corners.empty()) return std::shared_ptr<const Piece>();
  if (const auto* block = std::get_if<DraftBlock>(&*plain)) {
    if (const Done can = checkNumbers(*block); !can) return can.error();
    if (const std::string taken = takenBy(before, *block); !taken.empty())
      return refused(say("There is a piece called “{0}” already; put another word before the names.", nameSaid(taken)));
    return std::shared_ptr<const Piece>();
  }
  if (std::holds_alternative<AttachPiece>(*plain)) {  // no piece is new
    const auto meant = resolved(before, *std::move(plain), context);
    return meant ? Result(std::shared_ptr<const Piece>()) : meant.error();
  }
  const auto after = apply(before, *plain, context);
  if (!after) return after.error();
  std::shared_ptr<const Piece> fresh;
  for (const auto& [id, piece] : after->pattern.pieces) {
    if (before.find(id)) continue;
    if (fresh) return std::shared_ptr<const Piece>();  // of several none is drawn
    fresh = piece;
  }
  return fresh;
}

ChangeSettings settingsNow(const Session& session) {
  const Settings& now = session.snapshot().document.settings;
  ChangeSettings set;
  set.spacing = Length{now.spacing};
  set.ease = Length{now.ease};
  set.collider = now.collider;
  return set;
}

StepDialog::StepDialog(Session& session, Operation operation, QWidget* parent)
    : QDialog(parent),
      session_(session),
      document_(session.snapshot().document),
      name_(nameOf(operation)),
      opened_(operation) {
  setObjectName("step_dialog");
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowModality(Qt::WindowModal);
  setWindowTitle(inWords(*termSaid(Term::OperationName, name_)));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(20, 18, 20, 16);
  auto* about = new QLabel(inWords(Message{helpOf(operation).help, {}}));
  about->setWordWrap(true);
  about->setProperty("role", "faint");
  column->addWidget(about);
  drawing_ = new OutlineDrawing;
  column->addWidget(drawing_, 1);
  auto* fields = new QWidget;
  auto* rows = new QVBoxLayout(fields);
  rows->setContentsMargins(0, 0, 0, 0);
  main_ = new QFormLayout;
  main_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  rows->addLayout(main_);
  auto* more = new QCheckBox(inWords(say("More")));
  more->setObjectName("more");
  rows->addWidget(more);
  rest_ = new QWidget;
  more_ = new QFormLayout(rest_);
  more_->setContentsMargins(0, 0, 0, 0);
  more_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  rest_->hide();
  rows->addWidget(rest_);
  rows->addStretch(1);
  auto* area = new FieldsArea;
  area->setWidget(fields);
  area->setWidgetResizable(true);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  column->addWidget(area, 4);
  connect(more, &QCheckBox::toggled, this, [this, area](bool shown) {
    rest_->setVisible(shown);
    area->updateGeometry();
    QTimer::singleShot(0, this, [this] { takeRoom(); });
  });
  said_ = new QLabel;
  said_->setObjectName("said");
  said_->setWordWrap(true);
  said_->setMinimumHeight(2 * said_->fontMetrics().lineSpacing());
  column->addWidget(said_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  make_ = buttons->button(QDialogButtonBox::Ok);
  make_->setText(inWords(std::holds_alternative<ChangeSettings>(operation) ? say("Keep") : say("Make it")));
  make_->setObjectName("make");
  buttons->button(QDialogButtonBox::Cancel)->setText(inWords(say("Cancel")));
  column->addWidget(buttons);
  connect(make_, &QPushButton::clicked, this, &StepDialog::perform);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  fill(operation);
  more->setVisible(more_->rowCount() > (std::holds_alternative<Fasten>(operation) ? 1 : 0));  // its name is known
  show(wished());
  ensurePolished();
  for (QWidget* child : findChildren<QWidget*>())
    child->ensurePolished();  // only then are they as high as they will be
  takeRoom();
  open();
  takeRoom();
  standAside();
}

// Over the boards, so that the garment and its paper are seen while the numbers are typed.
void StepDialog::standAside() {
  constexpr int kBelow = 60;  // pixels: the menus and the toolbar
  const QWidget* over = parentWidget() ? parentWidget()->window() : nullptr;
  if (!over) return;
  const QRect all = over->geometry();
  move(all.right() - frameGeometry().width(), all.top() + kBelow);
  keepOnScreen();
}

void StepDialog::takeRoom() {
  constexpr int kFrame = 48;  // pixels that a window's frame takes
  layout()->activate();
  QSize wish = sizeHint().expandedTo(isVisible() ? size() : QSize());
  wish.setHeight(std::max(wish.height(), layout()->totalHeightForWidth(wish.width())));  // sentences are wrapped
  resize(wish.width(), std::min(wish.height(), screen()->availableGeometry().height() - kFrame));
  if (isVisible()) keepOnScreen();
}

// It stands at the window's right: what is wider once all is shown would go out of the screen with its buttons.
void StepDialog::keepOnScreen() {
  const QRect there = screen()->availableGeometry(), mine = frameGeometry();
  move(std::clamp(mine.left(), there.left(), std::max(there.left(), there.right() - mine.width())),
       std::clamp(mine.top(), there.top(), std::max(there.top(), there.bottom() - mine.height())));
}

void StepDialog::fill(const Operation& operation) {
  const OperationHelp& help = helpOf(operation);
  const std::vector<FieldText> known = fieldTexts(operation);
  const auto [asks, only] = askedOf(operation);
  QLineEdit *first = nullptr, *empty = nullptr;  // of the numbers that are asked at once
  QLineEdit* missing = nullptr;                  // the other side of what has one already
  const FieldHelp* last = nullptr;               // the field before
  for (const FieldHelp& field : help.fields) {
    if (only && field.name != "name" && !isFirst(asks, field.name)) continue;
    const auto value = std::find_if(known.begin(), known.end(), [&](const auto& f) { return f.name == field.name; });
    typed_.push_back(stepField(document_, help.name, field, value == known.end() ? usualOf(asks, field) : value->value,
                               [this] { perform(); }));
    QWidget* box = typed_.back().box;
    giveRoom(*box);
    auto* label = new QLabel(asLabel(fieldSaid(help.name, field.name)));
    label->setBuddy(box);
    (isFirst(asks, field.name) ? main_ : more_)->addRow(label, box);
    if (auto* line = qobject_cast<QLineEdit*>(box)) {
      if (help.name == DraftBlock::kName && field.kind == "length")
        line->setPlaceholderText(inWords(say("by the block's own rule")));
      if (help.name == SewWelt::kName && field.kind == "length" && line->placeholderText().isEmpty())
        line->setPlaceholderText(inWords(say("by the kind of pocket")));
      connect(line, &QLineEdit::textChanged, this, [this] { show(wished()); });
      const bool place = field.kind == "number" && field.name.ends_with("at");
      const bool number = field.kind == "length" || field.kind == "u,v" || field.kind == "number";
      if (number && !place && isFirst(asks, field.name))
        if (QLineEdit*& asked = line->text().isEmpty() ? empty : first; !asked) asked = line;
      const bool otherSide =
          last && last->kind == field.kind && field.kind.ends_with("piece.edge") && isFirst(asks, field.name);
      const auto* before = otherSide ? qobject_cast<QLineEdit*>(typed_[typed_.size() - 2].box) : nullptr;
      if (before && !before->text().isEmpty() && line->text().isEmpty() && !missing) missing = line;
    }
    if (auto* list = qobject_cast<QComboBox*>(box))
      connect(list, &QComboBox::currentIndexChanged, this, [this] {
        fitToKind();
        show(wished());
      });
    last = &field;
  }
  fitToKind();
  if (QLineEdit* line = missing ? missing : first ? first : empty) line->setFocus(), line->selectAll();
}

std::string StepDialog::typed(std::string_view name) const {
  for (const StepField& field : typed_)
    if (field.name == name && field.box->isEnabled()) return field.value();
  return {};
}

void StepDialog::fitToKind() {
  const OperationHelp& help = helpOf(opened_);
  if (help.kindField.empty()) return;
  std::string kind = typed(help.kindField);
  for (const FieldHelp& field : help.fields)
    if (field.name == help.kindField && kind.empty()) kind = field.usual;
  for (const FieldHelp& field : help.fields) {
    if (field.kinds.empty()) continue;
    const bool has = kind.empty() || std::find(field.kinds.begin(), field.kinds.end(), kind) != field.kinds.end();
    for (const StepField& own : typed_)
      if (own.name == field.name) {
        own.box->setEnabled(has);
        for (QFormLayout* rows : {main_, more_})
          if (rows->indexOf(own.box) >= 0) rows->setRowVisible(own.box, has);
      }
  }
}

// Whether a number that the dialog opened with gives way to what was typed since.
bool StepDialog::givesWay(std::string_view name) const {
  const std::vector<FieldText> known = fieldTexts(opened_);
  const auto own = std::find_if(known.begin(), known.end(), [&](const auto& field) { return field.name == name; });
  if (own == known.end() || typed(name) != own->value) return false;
  // As many as there is room for, where it is said how far they are apart.
  if (std::holds_alternative<Fasten>(opened_)) return name == "count" && !typed("spacing").empty();
  // The place is that of a single slash; several are spread over the edges.
  const auto count = parseNumber(typed("count"));
  return std::holds_alternative<SlashAndSpread>(opened_) && (name == "at" || name == "to_at") && count && *count > 1;
}

Result<Operation> StepDialog::wished() const {
  std::vector<FieldText> fields;
  for (const StepField& field : typed_)
    if (std::string value = typed(field.name); !value.empty() && !givesWay(field.name))
      fields.push_back({field.name, std::move(value)});
  for (const FieldHelp& field : helpOf(opened_).fields) {
    const bool here =
        std::any_of(typed_.begin(), typed_.end(), [&](const auto& own) { return own.name == field.name; });
    if (field.needed && here && typed(field.name).empty())
      return badInput(say("“{0}” has to be filled in.", asLabel(fieldSaid(name_, field.name)).toStdString()));
  }
  auto wish = parseOperation(lineOf(name_, fields));
  if (auto* block = wish ? std::get_if<DraftBlock>(&*wish) : nullptr) *block = wornOver(document_, *block);
  return wish;
}

void StepDialog::show(const Result<Operation>& wish) {
  const Result<std::shared_ptr<const Piece>> piece =
      wish ? tried(session_, *wish) : Result<std::shared_ptr<const Piece>>(wish.error());
  make_->setEnabled(static_cast<bool>(piece));
  const auto* block = piece ? std::get_if<DraftBlock>(&*wish) : nullptr;
  const bool over = block && typed("prefix").empty() && !block->prefix.empty();
  said_->setText(!piece ? inWords(piece.error().what) : over ? inWords(wornOverSaid(*block)) : QString());
  drawing_->show(piece ? *piece : nullptr);
  drawing_->setVisible(drawnOnPaper(name_) || (piece && *piece));
  if (!said_->text().isEmpty() && isVisible())
    QTimer::singleShot(0, this, [this] { takeRoom(); });  // what is told hides no field
}

void StepDialog::perform() {
  const auto wish = wished();
  show(wish);
  if (!make_->isEnabled()) return;
  if (*wish != opened_ || !std::holds_alternative<ChangeSettings>(opened_)) session_.perform(*wish);
  emit performed();
  accept();
}

}  // namespace karinui::studio

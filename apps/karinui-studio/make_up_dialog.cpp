#include "make_up_dialog.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTabBar>
#include <QTableWidget>
#include <QThread>
#include <cmath>

#include "karinui/design/step_words.h"
#include "karinui/view/picture.h"
#include "make_up_view.h"
#include "pixels.h"
#include "theme.h"
#include "worn_figure.h"

namespace karinui::studio {

namespace {

constexpr PieceRole kRoles[] = {
    PieceRole::Front,  PieceRole::Back,        PieceRole::Yoke,      PieceRole::Sleeve,     PieceRole::Cuff,
    PieceRole::Collar, PieceRole::CollarStand, PieceRole::Waistband, PieceRole::SkirtFront, PieceRole::SkirtBack,
    PieceRole::Leg,    PieceRole::LegFront,    PieceRole::LegBack,   PieceRole::Aside,      PieceRole::Unknown};

QString sideText(const std::vector<EdgeRef>& side, const Document& document) {
  QStringList all;
  for (const EdgeRef& edge : side) all << inWords(edgeSaid(document, edge));
  return all.join(" + ");
}

QTableWidget* list(const Message& name, const std::vector<Message>& columns) {
  auto* table = new QTableWidget(0, static_cast<int>(columns.size()));
  QStringList heads;
  for (const Message& column : columns) heads << inWords(column);
  table->setHorizontalHeaderLabels(heads);
  table->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  table->horizontalHeader()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  table->verticalHeader()->hide();
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setTabKeyNavigation(false);
  table->setAccessibleName(inWords(name));
  return table;
}

}  // namespace

struct MakeUpDialog::Proposed {
  Result<MakingUp> making;
  SnapshotPtr garment;
  QImage picture;
};

MakeUpDialog::MakeUpDialog(Session& session, QWidget* parent)
    : QDialog(parent), session_(session), document_(session.snapshot().document), body_(session.snapshot().body) {
  setObjectName("make_up_dialog");
  setAttribute(Qt::WA_DeleteOnClose);
  setWindowModality(Qt::WindowModal);
  setWindowTitle(inWords(say("Make up the pattern")));
  thread_.setMaxThreadCount(1);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(20, 18, 20, 16);
  row->setSpacing(18);
  auto* left = new QVBoxLayout;
  const auto heading = [&](const Message& words) {
    auto* label = new QLabel(inWords(words));
    label->setProperty("role", "title");
    left->addWidget(label);
  };
  heading(say("What the pieces are"));
  pieces_ = list(say("What the pieces are"), {say("Piece"), say("Is")});
  pieces_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
  left->addWidget(pieces_, 2);
  heading(say("Seams"));
  seams_ = list(say("Seams"), {say("Sewn together"), say("Sure")});
  left->addWidget(seams_, 3);
  said_ = new QLabel;
  said_->setObjectName("make_up_said");
  said_->setWordWrap(true);
  said_->setMinimumHeight(3 * said_->fontMetrics().lineSpacing());
  said_->setAlignment(Qt::AlignTop);
  left->addWidget(said_);
  auto* buttons = new QHBoxLayout;
  accept_ = new QPushButton(inWords(say("Make up")));
  accept_->setDefault(true);
  auto* cancel = new QPushButton(inWords(say("Cancel")));
  cancel->setAutoDefault(false);
  buttons->addWidget(accept_), buttons->addWidget(cancel);
  left->addLayout(buttons);
  row->addLayout(left, 1);
  auto* right = new QVBoxLayout;
  views_ = new QTabBar;
  views_->setExpanding(false);
  views_->setAccessibleName(inWords(say("How it is made up")));
  views_->addTab(inWords(say("On the body")));
  views_->addTab(inWords(say("Pattern")));
  right->addWidget(views_);
  view_ = new MakeUpView;
  right->addWidget(view_, 1);
  row->addLayout(right, 1);

  connect(views_, &QTabBar::currentChanged, this, [this](int k) { view_->setFlat(k == 1); });
  connect(seams_, &QTableWidget::itemSelectionChanged, this, &MakeUpDialog::tellSeam);
  connect(seams_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    const auto all = seams();
    if (item->column() != 0 || static_cast<std::size_t>(item->row()) >= all.size()) return;
    choices_.sewn[seamKey(*all[static_cast<std::size_t>(item->row())], making_->document)] =
        item->checkState() == Qt::Checked;
    begin();
  });
  connect(accept_, &QPushButton::clicked, this, &QDialog::accept);
  connect(cancel, &QPushButton::clicked, this, &QDialog::close);
  resizeOnScreen(*this, {1120, 680});
  begin();
}

MakeUpDialog::~MakeUpDialog() {
  if (token_) token_->cancel();
  thread_.waitForDone();
}

void MakeUpDialog::begin() {
  if (token_) token_->cancel();
  token_ = std::make_shared<Token>();
  accept_->setEnabled(false);
  said_->setText(inWords(say("Seams and places are being worked out …")));
  thread_.start([this, token = token_, choices = choices_, document = document_, body = body_] {
    Workers workers(QThread::idealThreadCount());
    WornFigure figure(body);
    Bodies bodies;
    Context context{workers, *token, figure, bodies, {}, {}};
    auto found = std::make_shared<Proposed>(Proposed{makeUp(document, context, choices), {}, {}});
    if (found->making && !token->cancelled()) {
      found->garment = snapshotOf(found->making->document, body);
      if (auto picture = Picture::open(); picture && body) {
        PictureOptions options;
        options.view = View::Oblique, options.width = 800, options.height = 900, options.samples = 1;
        options.lettering = false;
        if (const auto image = (*picture)->draw(found->garment->frame, options))
          found->picture = pixelsOf(*image).copy();
      }
    }
    QMetaObject::invokeMethod(
        this,
        [this, token, found] {
          if (token == token_) take(found);  // else it is being worked out anew
        },
        Qt::QueuedConnection);
  });
}

void MakeUpDialog::take(const std::shared_ptr<Proposed>& proposed) {
  token_.reset();
  if (!proposed->making) {
    said_->setText(inWords(proposed->making.error().what));
    emit finished();
    return;
  }
  const int chosen = seams_->currentRow();
  const std::string key = making_ && chosen >= 0 && static_cast<std::size_t>(chosen) < seams().size()
                              ? seamKey(*seams()[static_cast<std::size_t>(chosen)], making_->document)
                              : "";
  making_ = *std::move(proposed->making);
  view_->show(proposed->garment, proposed->picture);
  showPieces();
  showSeams();
  const auto all = seams();
  for (std::size_t k = 0; k < all.size(); ++k)
    if (seamKey(*all[k], making_->document) == key) seams_->selectRow(static_cast<int>(k));
  accept_->setEnabled(!making_->steps.empty());
  tellSeam();
  emit finished();
}

// The document's own pieces; copies follow what they are copies of.
void MakeUpDialog::showPieces() {
  if (pieces_->rowCount() > 0) {  // the hand may be in one of the boxes
    for (int k = 0; k < pieces_->rowCount(); ++k) {
      auto* box = qobject_cast<QComboBox*>(pieces_->cellWidget(k, 1));
      const auto id = std::next(document_.pattern.pieces.begin(), k)->first;
      const auto* now = std::find(std::begin(kRoles), std::end(kRoles), making_->readings.at(id).role);
      const QSignalBlocker quiet(box);
      box->setCurrentIndex(static_cast<int>(now - std::begin(kRoles)));
    }
    return;
  }
  for (const auto& [id, piece] : document_.pattern.pieces) {
    const int row = pieces_->rowCount();
    pieces_->insertRow(row);
    pieces_->setItem(row, 0, new QTableWidgetItem(nameLabel(piece->name)));
    auto* box = new QComboBox;
    for (const PieceRole role : kRoles) box->addItem(inWords(roleSaid(role)));
    const auto* now = std::find(std::begin(kRoles), std::end(kRoles), making_->readings.at(id).role);
    box->setCurrentIndex(static_cast<int>(now - std::begin(kRoles)));
    box->setAccessibleName(inWords(say("What “{0}” is", piece->name)));
    const PieceId own = id;
    connect(box, &QComboBox::currentIndexChanged, this, [this, own](int k) {
      choices_.roles[own] = kRoles[k];
      begin();
    });
    pieces_->setCellWidget(row, 1, box);
  }
}

std::vector<const SeamProposal*> MakeUpDialog::seams() const {
  std::vector<const SeamProposal*> all;
  if (!making_) return all;
  for (const auto* from : {&making_->sewn, &making_->unsure})
    for (const SeamProposal& one : *from) all.push_back(&one);
  // A seam keeps its row when it is ticked.
  std::sort(all.begin(), all.end(), [&](const SeamProposal* a, const SeamProposal* b) {
    return a->sure != b->sure ? a->sure > b->sure : seamKey(*a, making_->document) < seamKey(*b, making_->document);
  });
  return all;
}

void MakeUpDialog::showSeams() {
  const QSignalBlocker quiet(seams_);
  const auto all = seams();
  seams_->setRowCount(static_cast<int>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const SeamProposal& one = *all[k];
    const bool sewn = std::any_of(making_->sewn.begin(), making_->sewn.end(),
                                  [&](const SeamProposal& other) { return &other == &one; });
    auto* item =
        new QTableWidgetItem(sideText(one.sew.a, making_->document) + " — " + sideText(one.sew.b, making_->document));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setCheckState(sewn ? Qt::Checked : Qt::Unchecked);
    item->setToolTip(inWords(one.reason));
    seams_->setItem(static_cast<int>(k), 0, item);
    seams_->setItem(static_cast<int>(k), 1,
                    new QTableWidgetItem(QString("%1 %").arg(static_cast<int>(std::lround(one.sure * 100)))));
  }
}

void MakeUpDialog::tellSeam() {
  if (!making_ || token_) return;
  const auto all = seams();
  const int row = seams_->selectionModel()->hasSelection() ? seams_->currentRow() : -1;
  if (row < 0 || static_cast<std::size_t>(row) >= all.size()) {
    view_->choose({});
    QStringList lines{inWords(say("A tick sews a seam. Choose one to see it in the pattern."))};
    for (const PieceId id : making_->unknown)
      lines << inWords(say("“{0}” was not recognised; it stands beside the figure.", making_->document.find(id)->name));
    for (const Message& note : making_->notes) lines << inWords(note);
    said_->setText(lines.join("\n"));
    return;
  }
  const SeamProposal& one = *all[static_cast<std::size_t>(row)];
  std::vector<EdgeRef> edges = one.sew.a;
  edges.insert(edges.end(), one.sew.b.begin(), one.sew.b.end());
  view_->choose(std::move(edges));
  said_->setText(inWords(one.reason));
}

void MakeUpDialog::accept() {
  if (!making_ || token_) return;
  for (Operation& step : making_->steps) session_.perform(std::move(step));
  making_.reset();
  QDialog::accept();
}

}  // namespace karinui::studio

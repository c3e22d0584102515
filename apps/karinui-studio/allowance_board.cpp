#include "allowance_board.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <algorithm>

#include "karinui/base/number.h"
#include "karinui/design/truing_said.h"
#include "karinui/session/fit.h"
#include "length_box.h"
#include "theme.h"

namespace karinui::studio {

namespace {

std::array<std::pair<CornerKind, Message>, 6> cornerWords() {
  return {{{CornerKind::Mitre, say("Mitre")},
           {CornerKind::Points, say("Cut off between the seam lines")},
           {CornerKind::MirrorBefore, say("Mirrored on the edge before")},
           {CornerKind::MirrorAfter, say("Mirrored on the edge after")},
           {CornerKind::SquareBefore, say("Square to the edge before")},
           {CornerKind::SquareAfter, say("Square to the edge after")}}};
}

// Why the edge has its width, where none was said for it alone.
Message kindSaid(EdgeKind kind) {
  switch (kind) {
    case EdgeKind::Hem:
      return say("as usual for a hem");
    case EdgeKind::Neckline:
      return say("as usual for a neckline");
    case EdgeKind::Fold:
      return say("none on a fold");
    default:
      return say("as usual for a seam");
  }
}

}  // namespace

AllowanceBoard::AllowanceBoard(Session& session) : session_(session) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  const auto row = [form](const Message& words, QWidget* box) {
    auto* label = new QLabel;
    label->setWordWrap(true);
    Theme::here().keep(label, [label, words] { label->setText(inWords(words)); });
    form->addRow(label, box);
  };
  width_ = new LengthBox(say("Seam allowance"), 0, kWidestAllowance);
  width_->setObjectName("edge_allowance");
  row(say("Seam allowance"), width_);
  why_ = new QLabel;
  why_->setProperty("role", "faint");
  why_->setWordWrap(true);
  form->addRow(QString(), why_);
  const Message ends[] = {say("Corner at the start"), say("Corner at the end")};
  for (std::size_t k = 0; k < 2; ++k) {
    auto* box = corners_[k] = new QComboBox;
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(8);
    box->setObjectName(k == 0 ? "corner_start" : "corner_end");
    Theme::here().keep(box, [this, box, words = ends[k]] {
      filling_ = true;
      const int now = box->currentIndex();
      box->clear();
      for (const auto& [kind, said] : cornerWords()) box->addItem(inWords(said));
      box->setCurrentIndex(now);
      box->setAccessibleName(inWords(words));
      filling_ = false;
    });
    row(ends[k], box);
    connect(box, &QComboBox::activated, this, [this, k](int at) {
      if (filling_ || !session_.selection().edge) return;
      SetAllowance op = operation();
      (k == 0 ? op.start : op.end) = cornerWords()[static_cast<std::size_t>(at)].first;
      perform(std::move(op));
    });
  }
  auto* plain = new QPushButton;
  Theme::here().keep(plain, [plain] {
    plain->setText(inWords(say("As usual")));
    plain->setToolTip(inWords(say("The allowance and the corners that edges of its kind have.")));
  });
  form->addRow(QString(), plain);
  connect(plain, &QPushButton::clicked, this, [this] {
    if (!session_.selection().edge) return;
    SetAllowance op = operation();
    op.plain = true;
    perform(std::move(op));
  });
  hem_ = new LengthBox(say("Hem, turned up"), 0, kWidestAllowance);
  hem_->setObjectName("edge_hem");
  Theme::here().keep(hem_, [this] {
    hem_->setToolTip(
        inWords(say("How deep the edge is turned up and sewn down; 0: it is not. A third of it, 1 cm at "
                    "most, is turned in once more.")));
  });
  row(say("Hem, turned up"), hem_);
  connect(hem_, &LengthBox::typed, this, [this](double metres) {
    if (filling_ || !session_.selection().edge) return;
    TurnHem op;
    op.edges = operation().edges;
    op.none = metres < kNarrowestHem;
    if (!op.none) op.width = Length{metres}, op.under = Length{std::min({0.01, metres / 3, kWidestAllowance - metres})};
    session_.perform(std::move(op));
  });
  elastic_ = new LengthBox(say("Elastic, cut length"), 0, 10);
  elastic_->setObjectName("edge_elastic");
  Theme::here().keep(elastic_, [this] {
    elastic_->setToolTip(inWords(say("How long the elastic along this edge is cut; 0: there is none.")));
  });
  row(say("Elastic, cut length"), elastic_);
  pull_ = new QLabel;
  pull_->setProperty("role", "faint");
  pull_->setWordWrap(true);
  form->addRow(QString(), pull_);
  fastened_ = new QLabel;
  fastened_->setObjectName("edge_fastened");
  fastened_->setProperty("role", "faint");
  fastened_->setWordWrap(true);
  form->addRow(fastened_);
  connect(elastic_, &LengthBox::typed, this, [this](double metres) {
    if (filling_ || !session_.selection().edge) return;
    SewElastic op;
    op.edges = operation().edges;
    const double whole = wholeLength();
    // The edge's own share: its image and copies are gathered as much.
    if (metres > 0)
      op.ratio = metres / whole;
    else
      op.none = true;
    session_.perform(std::move(op));
  });
  ease_ = new LengthBox(say("Ease in the seam"), 0, 10);
  ease_->setObjectName("seam_ease");
  Theme::here().keep(ease_, [this] {
    ease_->setToolTip(
        inWords(say("By how much one side of the seam is longer on purpose; another difference is told.")));
  });
  row(say("Ease in the seam"), ease_);
  faults_ = new QLabel;
  faults_->setProperty("role", "faint");
  faults_->setWordWrap(true);
  form->addRow(faults_);
  connect(ease_, &LengthBox::typed, this, [this](double metres) {
    if (!filling_ && seam()) session_.perform(DeclareEase{SeamRef(seam()), Length{metres}});
  });
  connect(width_, &LengthBox::typed, this, [this](double metres) {
    if (filling_ || !session_.selection().edge) return;
    SetAllowance op = operation();
    op.width = Length{metres};
    perform(std::move(op));
  });
}

SetAllowance AllowanceBoard::operation() const {
  SetAllowance op;
  op.edges = session_.selection().edges();
  return op;
}

double AllowanceBoard::wholeLength() const {
  double whole = 0;
  for (const EdgeRef& edge : session_.selection().edges())
    whole += findCurve(*session_.snapshot().document.find(edge.piece.id), edge.edge)->length();
  return whole;
}

SeamId AllowanceBoard::seam() const {
  const auto& chosen = session_.selection().edge;
  if (!chosen) return {};
  for (const auto& [id, seam] : session_.snapshot().document.pattern.seams)
    for (const auto* side : {&seam.a, &seam.b})
      for (const EdgeSpan& span : *side)
        if (span.piece == chosen->piece && span.edge == chosen->edge) return id;
  return {};
}

void AllowanceBoard::perform(SetAllowance operation) { session_.perform(std::move(operation)); }

void AllowanceBoard::refresh() {
  const Document& document = session_.snapshot().document;
  const auto& chosen = session_.selection().edge;
  const Piece* piece = chosen ? document.find(chosen->piece) : nullptr;
  const auto edge = piece ? piece->outline.find(chosen->edge) : std::nullopt;
  setVisible(edge.has_value());
  if (!edge) return;
  filling_ = true;
  const AllowancePlan plan(document.pattern, document.allowances);
  width_->setMetres(plan.width(piece->id, chosen->edge));
  const bool own = document.allowances.edges.contains({piece->id, chosen->edge});
  why_->setText(own ? QString() : inWords(kindSaid(plan.kind(piece->id, chosen->edge))));
  const auto& edges = piece->outline.edges;
  const std::size_t n = edges.size();
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t after = (*edge + k) % n;
    const CornerKind kind = plan.corner(piece->id, edges[(after + n - 1) % n].name, edges[after].name);
    corners_[k]->setCurrentIndex(static_cast<int>(kind));
  }
  const Allowances& finish = document.allowances;
  const Allowances::At at{piece->id, chosen->edge};
  hem_->setMetres(finish.hems.contains(at) ? finish.hems.at(at).width : 0);
  elastic_->setLongest(kLoosestElastic * wholeLength());
  elastic_->setMetres(finish.elastics.contains(at) ? finish.elastics.at(at).ratio * wholeLength() : 0);
  pull_->clear();
  for (const ElasticPull& pull : elasticsOf(session_.snapshot()))
    if (pull.piece == at.first && pull.edge == at.second && !document.drape.dirty.contains(at.first))
      pull_->setText(
          inWords(say("pulls with {0} N, drawn out to {1} cm", fixed(pull.pull, 1), fixed(100 * pull.now, 1))));
  const auto holds = [&](const std::vector<EdgeSpan>& side) {
    return std::any_of(side.begin(), side.end(),
                       [&](const EdgeSpan& s) { return s.piece == at.first && s.edge == at.second; });
  };
  QString closed;
  for (const auto& [name, fastening] : finish.fastenings) {
    const bool over = holds(fastening.a);
    if (over || holds(fastening.b))
      closed += (closed.isEmpty() ? "" : "\n") + inWords(fastenedSaid(document.pattern, fastening, over));
  }
  if (!closed.isEmpty() && !document.drape.dirty.contains(at.first))
    for (const FasteningPull& pull : fasteningsOf(session_.snapshot())) {
      const Fastening& fastening = finish.fastenings.at(pull.name);
      if (!holds(fastening.a) && !holds(fastening.b)) continue;
      const Message drawn = say("drawn open with {0} N", fixed(pull.force, 1));
      closed += "\n" + inWords(pull.number > 0 ? say("{0}: {1}", pull.number, drawn) : drawn);
      if (!pull.holds()) closed += "  ⚠ " + inWords(say("does not close"));
    }
  fastened_->setText(closed);
  fastened_->setVisible(!closed.isEmpty());
  const SeamId sewn = seam();
  const auto eased = document.eases.find(sewn);
  ease_->setEnabled(static_cast<bool>(sewn) && session_.selection().more.empty());
  QString faults;
  if (sewn)
    for (const Message& fault : faultsSaid(document, truing(document.pattern, document.eases), sewn))
      faults += (faults.isEmpty() ? "" : "\n") + inWords(fault);
  faults_->setText(faults);
  ease_->setMetres(eased == document.eases.end() ? 0 : eased->second);
  filling_ = false;
}

}  // namespace karinui::studio

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSpinBox>
#include <QTreeWidget>
#include <cmath>
#include <numbers>

#include "allowance_board.h"
#include "blocks_menu.h"
#include "cut_board.h"
#include "edge_numbers.h"
#include "karinui/base/number.h"
#include "karinui/design/print_match.h"
#include "karinui/design/step_words.h"
#include "karinui/design/truing_said.h"
#include "karinui/design/variant.h"
#include "karinui/pattern/edit.h"
#include "karinui/pattern/symmetry.h"
#include "length_box.h"
#include "length_choice.h"
#include "look_board.h"
#include "panels.h"
#include "take_in_board.h"
#include "theme.h"
#include "variables_dialog.h"

namespace karinui::studio {

Panel::Panel(Session& session, QWidget* in) : QWidget(in), session_(session) {
  connect(&Theme::here(), &Theme::changed, this, [this] {  // all of it in the other language or unit
    historyShown_ = ~0ull;
    refresh();
  });
}

QLabel* Panel::title(const Message& words) {
  auto* label = new QLabel;
  label->setProperty("role", "title");
  Theme::here().keep(label, [label, words] { label->setText(inWords(words)); });
  return label;
}
QLabel* Panel::word(const Message& words) {
  auto* label = new QLabel;
  label->setWordWrap(true);
  Theme::here().keep(label, [label, words] { label->setText(asLabel(words)); });
  return label;
}

namespace {

enum Kind { kPiece = 1, kEdge, kSeam, kMark, kLine };

QString seamName(const Document& document, const Seam& seam) {
  const Message said = seamSaid(document, seam);
  return seam.name.empty() || identifierSaid(seam.name) ? asLabel(said) : inWords(said);
}

// A name is shown as people say it, and kept as scripts write it.
void showName(QLineEdit& box, const std::string& name, const QString& said) {
  if (!beingTyped(box)) box.setText(said);
  box.setToolTip(scriptHint(name));
}
std::optional<std::string> newName(const QLineEdit& box, const std::string& now, const QString& said) {
  const std::string typed = box.text().trimmed().toStdString();
  if (typed == said.toStdString() || typed == now) return std::nullopt;
  return nameTyped(typed);
}

QDoubleSpinBox* number(double low, double high, int decimals, const char* unit) {
  auto* box = new QDoubleSpinBox;
  box->setRange(low, high);
  box->setDecimals(decimals);
  box->setSuffix(QString::fromUtf8(unit));
  box->setKeyboardTracking(false);
  box->setButtonSymbols(QAbstractSpinBox::NoButtons);
  return box;
}

}  // namespace

GarmentPanel::GarmentPanel(Session& session, QWidget* in) : Panel(session, in) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(14, 14, 14, 14);
  column->setSpacing(10);
  tree_ = new QTreeWidget;
  tree_->setHeaderHidden(true);
  tree_->setIndentation(14);
  tree_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  Theme::here().keep(tree_, [this] { tree_->setAccessibleName(inWords(say("Pieces and seams"))); });
  column->addWidget(tree_, 2);
  auto* blocks = new QPushButton;
  blocks->setObjectName("blocks_button");
  Theme::here().keep(blocks, [blocks] {
    blocks->setText(inWords(say("Ready blocks")));
    blocks->setToolTip(
        inWords(say("Pieces drafted from the figure's measures: shirt, bodice, skirt, trousers, leggings.")));
  });
  auto* kinds = new QMenu(blocks);
  fillBlocks(*kinds, session_, [this] { emit blockAsked(); });
  blocks->setMenu(kinds);
  column->addWidget(blocks);
  // The properties take what is left, and scroll: the list keeps its rows.
  auto* boards = new QWidget;
  auto* below = new QVBoxLayout(boards);
  below->setContentsMargins(0, 0, 6, 0);
  scroll_ = new QScrollArea;
  scroll_->setObjectName("garment_numbers");
  scroll_->setWidget(boards);
  scroll_->setWidgetResizable(true);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  column->addWidget(scroll_, 3);

  pieceBoard_ = new QWidget;
  auto* form = new QFormLayout(pieceBoard_);
  form->setContentsMargins(0, 0, 0, 0);
  form->addRow(title(say("Piece")));
  name_ = new QLineEdit;
  fabric_ = new QComboBox;
  letShrink(*fabric_);
  layer_ = new QSpinBox;
  layer_->setObjectName("piece_layer");
  layer_->setRange(0, 20);
  layer_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  frozen_ = new QCheckBox;
  Theme::here().keep(frozen_, [this] { frozen_->setText(inWords(say("stays as it is"))); });
  grain_ = number(-180, 180, 1, " °");
  area_ = new QLabel;
  area_->setProperty("role", "faint");
  form->addRow(word(say("Name")), name_);
  form->addRow(word(say("Fabric")), fabric_);
  form->addRow(word(say("Grain")), grain_);
  form->addRow(word(say("Layer")), layer_);
  form->addRow(word(say("Frozen")), frozen_);
  cut_ = new CutBoard(session);
  form->addRow(word(say("Times cut")), cut_);
  form->addRow(word(say("Area")), area_);
  look_ = new LookBoard(session, [this]() -> std::optional<SetLook> {
    SetLook look;
    for (const PieceId id : session_.selection().pieces) look.pieces.push_back(PieceRef(id));
    return look.pieces.empty() ? std::nullopt : std::optional(look);
  });
  form->addRow(look_);

  edgeBoard_ = new QWidget;
  form = new QFormLayout(edgeBoard_);
  form->setContentsMargins(0, 6, 0, 0);
  form->addRow(title(say("Edge")));
  edgeName_ = new QLineEdit;
  length_ = new LengthBox(say("Length"), 0.001, 10);
  takeIn_ = new LengthBox(say("Take in"), -0.5, 0.5);
  Theme::here().keep(takeIn_, [this] {
    takeIn_->setToolTip(
        inWords(say("Carries the edge in by so much, square to it, on both halves; less than nothing lets it out.")));
  });
  u_ = new LengthBox(say("From, across"), -5, 5);
  v_ = new LengthBox(say("From, up"), -5, 5);
  sewn_ = new QLabel;
  sewn_->setWordWrap(true);
  sewn_->setProperty("role", "faint");
  form->addRow(word(say("Name")), edgeName_);
  stays_ = new LengthChoice(session);
  form->addRow(word(say("Take in")), takeIn_);
  takenIn_ = new TakeInBoard(session);
  form->addRow(takenIn_);
  form->addRow(word(say("Length")), length_);
  form->addRow(stays_);
  form->addRow(word(say("From, across")), u_);
  form->addRow(word(say("From, up")), v_);
  form->addRow(word(say("Sewn to")), sewn_);
  allowance_ = new AllowanceBoard(session);
  form->addRow(new EdgeNumbers(session));
  form->addRow(allowance_);
  below->addWidget(edgeBoard_);  // who chose an edge asks for its numbers first
  below->addWidget(pieceBoard_);
  below->addStretch(1);

  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(tree_, &QTreeWidget::customContextMenuRequested, this,
          [this](QPoint at) { emit menuAsked(tree_->viewport()->mapToGlobal(at)); });
  connect(tree_, &QTreeWidget::itemSelectionChanged, this, [this] {
    if (filling_) return;
    Selection selection;
    for (const QTreeWidgetItem* item : tree_->selectedItems()) {
      const PieceId piece{item->data(0, Qt::UserRole + 1).toULongLong()};
      switch (item->data(0, Qt::UserRole).toInt()) {
        case kPiece:
          selection.pieces.insert(piece);
          break;
        case kEdge:
          selection.pieces.insert(piece);
          selection.edge = EdgeNear{piece, item->data(0, Qt::UserRole + 2).toString().toStdString(), 0.5, 0};
          break;
        case kMark:
          selection.pieces.insert(piece);
          selection.mark = Flat{item->data(0, Qt::UserRole + 3).toDouble(), item->data(0, Qt::UserRole + 4).toDouble()};
          break;
        case kLine:
          selection.pieces.insert(piece);
          selection.line = item->data(0, Qt::UserRole + 2).toString().toStdString();
          break;
        case kSeam:
          selection.seam = SeamId{item->data(0, Qt::UserRole + 1).toULongLong()};
          break;
        default:
          break;
      }
    }
    session_.select(selection);
  });
  const auto pieceChosen = [this]() -> const Piece* {
    if (filling_ || session_.selection().pieces.empty()) return nullptr;
    return session_.snapshot().document.find(*session_.selection().pieces.begin());
  };
  connect(name_, &QLineEdit::editingFinished, this, [this, pieceChosen] {
    name_->setModified(false);
    const Piece* piece = pieceChosen();
    const auto wanted = piece ? newName(*name_, piece->name, nameText(piece->name)) : std::nullopt;
    if (!wanted) return;
    Rename rename;
    rename.piece = piece->id;
    rename.to = *wanted;
    session_.perform(rename);
  });
  connect(fabric_, &QComboBox::activated, this, [this, pieceChosen] {
    const Piece* piece = pieceChosen();
    SetFabric set;
    set.name = fabric_->currentData().toString().toStdString();
    if (!piece || set.name == piece->fabric) return;
    for (const PieceId id : session_.selection().pieces) set.pieces.push_back(PieceRef(id));
    session_.perform(set);
  });
  connect(layer_, &QSpinBox::editingFinished, this, [this, pieceChosen] {
    const Piece* piece = pieceChosen();
    if (!piece || layer_->value() == piece->layer) return;
    session_.perform(SetLayer{{PieceRef(piece->id)}, layer_->value()});
  });
  connect(frozen_, &QCheckBox::clicked, this, [this, pieceChosen](bool on) {
    if (const Piece* piece = pieceChosen()) session_.perform(FreezePieces{{PieceRef(piece->id)}, on});
  });
  connect(grain_, &QDoubleSpinBox::valueChanged, this, [this, pieceChosen](double degrees) {
    const Piece* piece = pieceChosen();
    if (!piece) return;
    const double a = degrees * std::numbers::pi / 180;
    session_.perform(SetGrain{PieceRef(piece->id), {std::sin(a), std::cos(a)}});
  });
  connect(edgeName_, &QLineEdit::editingFinished, this, [this, pieceChosen] {
    edgeName_->setModified(false);
    const Piece* piece = pieceChosen();
    if (!piece || !session_.selection().edge) return;
    const auto wanted =
        newName(*edgeName_, session_.selection().edge->edge,
                inWords(edgeNameSaid(session_.snapshot().document, *piece, session_.selection().edge->edge)));
    if (!wanted) return;
    Rename rename;
    rename.edge = EdgeRef{PieceRef(piece->id), session_.selection().edge->edge, 0, 1};
    rename.to = *wanted;
    session_.perform(rename);
  });
  connect(length_, &LengthBox::typed, this, [this](double wanted) {
    if (!filling_ && session_.selection().edge) session_.perform(stays_->length(wanted));
  });
  for (LengthBox* box : {length_, takeIn_})
    box->takeFormulas([this](const std::string& formula) -> Result<double> {
      DocumentNames names = formulaNames(session_);
      const auto value = workedOut(formula, names, kLength);
      if (!value) return value.error();
      return value->value;
    });
  connect(length_, &LengthBox::formulaTyped, this, [this](const QString& formula, double metres) {
    if (!filling_ && session_.selection().edge) session_.perform(stays_->length(formula.toStdString(), metres));
  });
  connect(takeIn_, &LengthBox::typed, this, [this](double metres) { takeIn({}, metres); });
  connect(takeIn_, &LengthBox::formulaTyped, this,
          [this](const QString& formula, double metres) { takeIn(formula.toStdString(), metres); });
  for (LengthBox* box : {u_, v_})
    connect(box, &LengthBox::typed, this, [this] {
      edgeTyped([this](const Piece& piece) -> Result<Outline> {
        auto moved = moveCorner(piece, session_.selection().edge->edge, {u_->value(), v_->value()});
        if (!moved) return moved.error();
        return moved->outline;
      });
    });
}

void GarmentPanel::takeIn(const std::string& formula, double metres) {
  if (filling_ || !session_.selection().edge || metres == 0) return;
  Operation step = takenIn_->takeIn(metres);
  if (!formula.empty()) step.formulas = {{"by", formula}};
  session_.perform(std::move(step));
}

// The list keeps its rows; on a low screen the numbers of what is chosen need the room more.
void GarmentPanel::resizeEvent(QResizeEvent* event) {
  Panel::resizeEvent(event);
  const int letters = fontMetrics().height(), row = letters * 3 / 2;
  tree_->setMinimumHeight((height() < 26 * letters ? 3 : 7) * row);
}

void GarmentPanel::edgeTyped(const std::function<Result<Outline>(const Piece&)>& change) {
  if (filling_ || !session_.selection().edge) return;
  const Piece* piece = session_.snapshot().document.find(session_.selection().edge->piece);
  if (!piece) return;
  const auto k = piece->outline.find(session_.selection().edge->edge);
  if (!k) return;
  auto outline = change(*piece);
  if (outline)
    if (const auto symmetry = symmetryOf(piece->outline)) {
      if (!symmetry->corner[*k])
        session_.advise(
            say("Only this half was changed: the other half has no such place, because of a slit or dart."));
      outline = checked(onBothHalves(piece->outline, *std::move(outline), *symmetry));
    }
  if (!outline) return session_.refuse(outline.error());
  ReshapePiece op;
  op.piece = piece->id;
  op.outline = *std::move(outline);
  session_.perform(op);
}

void GarmentPanel::refresh() {
  if (!(selectionShown_ == session_.selection()))  // what was half typed was meant for another piece or edge
    for (QLineEdit* line : findChildren<QLineEdit*>()) line->setModified(false);
  if (historyShown_ != session_.changes().history) {
    historyShown_ = session_.changes().history;
    fillTree();
    fillProperties();
  } else if (!(selectionShown_ == session_.selection())) {
    // Of another thing of its kind one goes on with the same number; of anything else the first numbers are asked.
    const bool sameKind = selectionShown_.edge.has_value() == session_.selection().edge.has_value() &&
                          selectionShown_.pieces.empty() == session_.selection().pieces.empty();
    fillTree();
    fillProperties();
    if (!sameKind) scroll_->verticalScrollBar()->setValue(0);
  }
  selectionShown_ = session_.selection();
}

void GarmentPanel::showAgain() { fillProperties(); }

void GarmentPanel::fillTree() {
  filling_ = true;
  std::set<std::uint64_t> open;
  for (int i = 0; i < tree_->topLevelItemCount(); ++i)
    if (tree_->topLevelItem(i)->isExpanded())
      open.insert(tree_->topLevelItem(i)->data(0, Qt::UserRole + 1).toULongLong());
  tree_->clear();
  const Document& document = session_.snapshot().document;
  const Selection& selection = session_.selection();
  QTreeWidgetItem* current = nullptr;
  for (const auto& [id, piece] : document.pattern.pieces) {
    auto* item = new QTreeWidgetItem(tree_);
    QString words = nameLabel(piece->name);
    if (piece->frozen) words += "  ❄";
    if (document.drape.dirty.contains(id)) words += "  •";
    item->setText(0, words);
    item->setData(0, Qt::UserRole, kPiece);
    item->setData(0, Qt::UserRole + 1, static_cast<qulonglong>(id.value));
    const bool chosen = selection.pieces.contains(id);
    for (const Edge& edge : piece->outline.edges) {
      auto* child = new QTreeWidgetItem(item);
      child->setText(0, (identifierSaid(edge.name) ? asLabel(edgeWithPartnerSaid(document, *piece, edge.name))
                                                   : nameText(edge.name)) +
                            "   " + lengthText(edge.curve.length()));
      child->setData(0, Qt::UserRole, kEdge);
      child->setData(0, Qt::UserRole + 1, static_cast<qulonglong>(id.value));
      child->setData(0, Qt::UserRole + 2, QString::fromStdString(edge.name));
      if (selection.edge && selection.edge->piece == id && selection.edge->edge == edge.name) {
        item->setExpanded(true);
        child->setSelected(true);
        current = child;
      }
    }
    const auto add = [&, own = id.value](int kind, const QString& line, const char* icon, bool isChosen) {
      auto* child = new QTreeWidgetItem(item);
      child->setText(0, line);
      child->setIcon(0, Theme::here().icon(icon));
      child->setData(0, Qt::UserRole, kind);
      child->setData(0, Qt::UserRole + 1, static_cast<qulonglong>(own));
      if (chosen && isChosen) {
        item->setExpanded(true);
        child->setSelected(true);
        current = child;
      }
      return child;
    };
    for (const Mark& m : piece->marks) {
      const Edge* edge = m.edge.empty() ? nullptr : findEdge(*piece, m.edge);
      const Flat place = edge ? edge->curve.atFraction(m.fraction) : m.place;
      const QString name = m.name.empty() ? inWords(edge ? say("Notch") : say("Drill hole")) : nameLabel(m.name);
      QTreeWidgetItem* child = add(kMark,
                                   name + "   " +
                                       (edge ? inWords(edgeNameSaid(document, *piece, m.edge)) + "  " +
                                                   lengthText(m.fraction * edge->curve.length())
                                             : lengthText(place.u) + "  " + lengthText(place.v)),
                                   "notch", selection.mark == place);
      child->setData(0, Qt::UserRole + 3, place.u);
      child->setData(0, Qt::UserRole + 4, place.v);
    }
    for (const InternalLine& line : piece->lines) {
      double whole = 0;
      for (const Curve& curve : line.curves) whole += curve.length();
      add(kLine, nameLabel(line.name) + "   " + lengthText(whole), "line", selection.line == line.name)
          ->setData(0, Qt::UserRole + 2, QString::fromStdString(line.name));
    }
    item->setExpanded(item->isExpanded() || open.contains(id.value));
    if (chosen && !selection.mark && selection.line.empty() && !(selection.edge && selection.edge->piece == id))
      item->setSelected(true), current = item;
  }
  const TruingReport trued = truing(document.pattern, document.eases);
  const PhotoTall tall = photosOf(session_.snapshot());
  for (const auto& [id, seam] : document.pattern.seams) {
    auto* item = new QTreeWidgetItem(tree_);
    item->setText(0, seamName(document, seam) + (seam.tie == Seam::Tie::TwoToOne ? "   2:1" : ""));
    item->setToolTip(0, item->text(0));
    item->setIcon(0, Theme::here().icon("sew"));
    std::vector<Message> faults = faultsSaid(document, trued, id);
    for (Message& miss : unmatchedSaid(document, tall, id)) faults.push_back(std::move(miss));
    if (!faults.empty()) {
      item->setText(0, item->text(0) + "   ⚠");
      QString said = item->toolTip(0);
      for (const Message& fault : faults) said += "\n" + inWords(fault);
      item->setToolTip(0, said);
    }
    item->setData(0, Qt::UserRole, kSeam);
    item->setData(0, Qt::UserRole + 1, static_cast<qulonglong>(id.value));
    if (selection.seam == id && !selection.edge) item->setSelected(true), current = item;
  }
  if (current) tree_->scrollToItem(current);
  filling_ = false;
}

void GarmentPanel::fillProperties() {
  filling_ = true;
  const Document& document = session_.snapshot().document;
  const Selection& selection = session_.selection();
  const Piece* piece = selection.pieces.empty() ? nullptr : document.find(*selection.pieces.begin());
  const bool hasEdge = piece && selection.edge.has_value();
  // What is typed on would go into the next box.
  if (const QWidget* typed = window()->focusWidget();
      typed && ((!piece && pieceBoard_->isAncestorOf(typed)) || (!hasEdge && edgeBoard_->isAncestorOf(typed))))
    tree_->setFocus();
  pieceBoard_->setVisible(piece);
  edgeBoard_->setVisible(hasEdge);
  if (piece) {
    showName(*name_, piece->name, nameText(piece->name));
    fabric_->clear();
    const auto add = [this](const std::string& name) {
      const QString word = QString::fromStdString(name);
      if (fabric_->findData(word) < 0) fabric_->addItem(nameText(name), word);
    };
    for (const std::string& name : fabricNames(document)) add(name);
    fabric_->setCurrentIndex(fabric_->findData(QString::fromStdString(piece->fabric)));
    if (!beingTyped(*layer_->findChild<QLineEdit*>())) layer_->setValue(piece->layer);
    frozen_->setChecked(piece->frozen);
    if (!beingTyped(*grain_->findChild<QLineEdit*>()))
      grain_->setValue(std::atan2(piece->grain.u, piece->grain.v) * 180 / std::numbers::pi);
    cut_->refresh();
    const auto shift = document.looks.shifts.find(piece->id);
    look_->show(lookOf(document, *piece), shift == document.looks.shifts.end() ? Flat() : shift->second);
    area_->setText(areaText(piece->outline.area()));
  }
  if (piece && selection.edge) {
    if (const Edge* edge = findEdge(*piece, selection.edge->edge)) {
      showName(*edgeName_, edge->name, inWords(edgeNameSaid(document, *piece, edge->name)));
      length_->setMetres(edge->curve.length());
      takeIn_->setMetres(0);
      takenIn_->refresh();
      stays_->refresh();
      allowance_->refresh();
      u_->setMetres(edge->curve.start.u);
      v_->setMetres(edge->curve.start.v);
      QString sewn = "–";
      for (const auto& [id, seam] : document.pattern.seams)
        for (const auto* side : {&seam.a, &seam.b})
          for (const EdgeSpan& s : *side)
            if (s.piece == piece->id && s.edge == edge->name) sewn = seamName(document, seam);
      sewn_->setText(sewn);
      sewn_->setMinimumHeight(0);  // else it is as high as the last one
      sewn_->setMinimumHeight(sewn_->heightForWidth(std::max(sewn_->width(), 150)));  // a form does not ask for it
    }
  }
  filling_ = false;
}

}  // namespace karinui::studio

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTreeWidget>
#include <algorithm>
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
#include "karinui/pattern/likeness.h"
#include "karinui/pattern/symmetry.h"
#include "length_box.h"
#include "length_choice.h"
#include "longer_board.h"
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

MixedBox<QDoubleSpinBox>* number(double low, double high, int decimals, const char* unit) {
  auto* box = new MixedBox<QDoubleSpinBox>;
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

  makePieceBoard();
  makeEdgeBoard();
  below->addWidget(edgeBoard_);  // who chose an edge asks for its numbers first
  below->addWidget(pieceBoard_);
  below->addStretch(1);
  connectTree();
  connectPieceBoard();
  connectEdgeBoard();
}

void GarmentPanel::makePieceBoard() {
  pieceBoard_ = new QWidget;
  auto* form = new QFormLayout(pieceBoard_);
  form->setContentsMargins(0, 0, 0, 0);
  pieceTitle_ = new QLabel;
  pieceTitle_->setObjectName("piece_title");
  pieceTitle_->setProperty("role", "title");
  form->addRow(pieceTitle_);
  name_ = new QLineEdit;
  name_->setObjectName("piece_name");
  fabric_ = new QComboBox;
  fabric_->setObjectName("piece_fabric");
  letShrink(*fabric_);
  layer_ = new MixedBox<QSpinBox>;
  layer_->setObjectName("piece_layer");
  layer_->setRange(0, 20);
  layer_->setButtonSymbols(QAbstractSpinBox::NoButtons);
  frozen_ = new QCheckBox;
  frozen_->setObjectName("piece_frozen");
  Theme::here().keep(frozen_, [this] { frozen_->setText(inWords(say("stays as it is"))); });
  grain_ = number(-180, 180, 1, " °");
  grain_->setObjectName("piece_grain");
  area_ = new QLabel;
  area_->setProperty("role", "faint");
  form->addRow(word(say("Name")), name_);
  form->addRow(word(say("Fabric")), fabric_);
  form->addRow(word(say("Grain")), grain_);
  form->addRow(word(say("Layer")), layer_);
  form->addRow(word(say("Frozen")), frozen_);
  cut_ = new CutBoard(session_);
  form->addRow(word(say("Times cut")), cut_);
  form->addRow(word(say("Area")), area_);
  look_ = new LookBoard(session_, [this]() -> std::optional<SetLook> {
    SetLook look;
    for (const PieceId id : session_.selection().pieces) look.pieces.push_back(PieceRef(id));
    return look.pieces.empty() ? std::nullopt : std::optional(look);
  });
  form->addRow(look_);
}

void GarmentPanel::makeEdgeBoard() {
  edgeBoard_ = new QWidget;
  auto* form = new QFormLayout(edgeBoard_);
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
  several_ = new QLabel;
  several_->setObjectName("several_edges");
  several_->setWordWrap(true);
  several_->setProperty("role", "faint");
  form->addRow(several_);
  form->addRow(word(say("Name")), edgeName_);
  stays_ = new LengthChoice(session_);
  form->addRow(word(say("Take in")), takeIn_);
  takenIn_ = new TakeInBoard(session_);
  form->addRow(takenIn_);
  form->addRow(word(say("Length")), length_);
  form->addRow(stays_);
  longer_ = new LengthBox(say("Longer by"), -1, 1);
  longer_->setObjectName("edge_longer");
  Theme::here().keep(longer_, [this] {
    longer_->setToolTip(inWords(
        say("Makes the chosen edges so much longer together, and what they are sewn to; less than nothing: shorter.")));
  });
  longerHow_ = new LongerBoard(session_);
  form->addRow(word(say("Longer by")), longer_);
  form->addRow(longerHow_);
  form->addRow(word(say("From, across")), u_);
  form->addRow(word(say("From, up")), v_);
  form->addRow(word(say("Sewn to")), sewn_);
  allowance_ = new AllowanceBoard(session_);
  numbers_ = new EdgeNumbers(session_);
  form->addRow(numbers_);
  form->addRow(allowance_);
}

void GarmentPanel::connectTree() {
  tree_->setContextMenuPolicy(Qt::CustomContextMenu);
  connect(tree_, &QTreeWidget::customContextMenuRequested, this,
          [this](QPoint at) { emit menuAsked(tree_->viewport()->mapToGlobal(at)); });
  connect(tree_, &QTreeWidget::itemSelectionChanged, this, [this] {
    if (!filling_) session_.select(chosenInTree());
  });
}

Selection GarmentPanel::chosenInTree() const {
  Selection selection;
  QList<QTreeWidgetItem*> items = tree_->selectedItems();
  // Several pieces can be chosen, or several edges; of anything else one: that which was clicked last.
  QTreeWidgetItem* last = tree_->currentItem();
  if (items.size() > 1 && last && last->isSelected()) {
    const auto kind = [](const QTreeWidgetItem* item) { return item->data(0, Qt::UserRole).toInt(); };
    const bool several = kind(last) == kPiece || kind(last) == kEdge;
    items.removeIf([&](const QTreeWidgetItem* item) { return item != last && !(several && kind(item) == kind(last)); });
    if (kind(last) == kEdge) items.removeOne(last), items.push_back(last);
  }
  for (const QTreeWidgetItem* item : items) {
    const PieceId piece{item->data(0, Qt::UserRole + 1).toULongLong()};
    switch (item->data(0, Qt::UserRole).toInt()) {
      case kPiece:
        selection.pieces.insert(piece);
        break;
      case kEdge:
        selection.pieces.insert(piece);
        if (selection.edge) selection.more.push_back(*selection.edge);
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
  return selection;
}

// The chosen piece, if it is one alone.
const Piece* GarmentPanel::pieceChosen() const {
  const auto pieces = chosenPieces();
  return filling_ || pieces.size() != 1 ? nullptr : pieces.front();
}

void GarmentPanel::connectPieceBoard() {
  connect(name_, &QLineEdit::editingFinished, this, [this] {
    name_->setModified(false);
    const Piece* piece = pieceChosen();
    const auto wanted = piece ? newName(*name_, piece->name, nameText(piece->name)) : std::nullopt;
    if (!wanted) return;
    Rename rename;
    rename.piece = piece->id;
    rename.to = *wanted;
    session_.perform(rename);
  });
  const auto allAre = [this](const auto& so) {  // or none is chosen
    const auto pieces = chosenPieces();
    return filling_ || std::all_of(pieces.begin(), pieces.end(), [&](const Piece* piece) { return so(*piece); });
  };
  connect(fabric_, &QComboBox::activated, this, [this, allAre] {
    SetFabric set;
    set.name = fabric_->currentData().toString().toStdString();
    if (allAre([&](const Piece& piece) { return piece.fabric == set.name; })) return;
    set.pieces = chosenRefs();
    session_.perform(set);
  });
  connect(layer_, &QSpinBox::editingFinished, this, [this, allAre] {
    const int layer = layer_->value();
    if (layer_->showsDash() || allAre([&](const Piece& piece) { return piece.layer == layer; })) return;
    session_.perform(SetLayer{chosenRefs(), layer});
  });
  connect(frozen_, &QCheckBox::clicked, this, [this, allAre](bool on) {
    if (!allAre([&](const Piece& piece) { return piece.frozen == on; }))
      session_.perform(FreezePieces{chosenRefs(), on});
  });
  connect(grain_, &QDoubleSpinBox::valueChanged, this, [this](double degrees) {
    if (filling_ || grain_->showsDash() || chosenPieces().empty()) return;
    const double a = degrees * std::numbers::pi / 180;
    session_.perform(SetGrain{chosenRefs(), {std::sin(a), std::cos(a)}});
  });
}

void GarmentPanel::connectEdgeBoard() {
  connect(edgeName_, &QLineEdit::editingFinished, this, [this] {
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
  for (LengthBox* box : {length_, takeIn_, longer_})
    box->takeFormulas([this](const std::string& formula) -> Result<double> {
      DocumentNames names = formulaNames(session_);
      const auto value = workedOut(formula, names, kLength);
      if (!value) return value.error();
      return value->value;
    });
  connect(length_, &LengthBox::formulaTyped, this, [this](const QString& formula, double metres) {
    if (!filling_ && session_.selection().edge) session_.perform(stays_->length(formula.toStdString(), metres));
  });
  connect(longer_, &LengthBox::typed, this, [this](double metres) { lengthen({}, metres); });
  connect(longer_, &LengthBox::formulaTyped, this,
          [this](const QString& formula, double metres) { lengthen(formula.toStdString(), metres); });
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

void GarmentPanel::lengthen(const std::string& formula, double metres) {
  if (filling_ || !session_.selection().edge || metres == 0) return;
  Operation step = longerHow_->lengthen(metres);
  if (!formula.empty()) step.formulas = {{"by", formula}};
  session_.perform(std::move(step));
}

// What one edge alone can have is grey while several are chosen, and says so.
void GarmentPanel::showSeveral() {
  const auto edges = session_.selection().edges();
  const bool one = edges.size() < 2;
  QString names;
  for (const EdgeRef& edge : edges)
    names += (names.isEmpty() ? "" : ", ") + inWords(edgeSaid(session_.snapshot().document, edge));
  several_->setVisible(!one);
  several_->setText(inWords(say(
      "Several edges are chosen: {0}. Take in, longer by, seam allowance, hem and elastic are done to all of them, in "
      "one step; what is grey takes one edge.",
      names.toStdString())));
  for (QWidget* own : std::initializer_list<QWidget*>{edgeName_, length_, stays_, u_, v_, numbers_}) {
    own->setEnabled(one);
    if (own == length_ || own == edgeName_)
      own->setToolTip(one ? QString() : inWords(say("This takes one edge: choose it alone.")));
  }
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
  // Keys go on from where they were.
  const auto identity = [](const QTreeWidgetItem* item) {
    QVariantList all;
    for (int role = Qt::UserRole; item && role <= Qt::UserRole + 4; ++role) all << item->data(0, role);
    return all;
  };
  const QVariantList was = tree_->hasFocus() ? identity(tree_->currentItem()) : QVariantList();
  tree_->clear();
  const Document& document = session_.snapshot().document;
  const Selection& selection = session_.selection();
  const auto edges = selection.edges();
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
      if (const EdgeRef own{PieceRef(id), edge.name}; std::find(edges.begin(), edges.end(), own) != edges.end()) {
        item->setExpanded(true);
        child->setSelected(true);
        if (own == edges.back()) current = child;
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
    if (chosen && !selection.mark && selection.line.empty() && !selection.edge) item->setSelected(true), current = item;
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
  for (QTreeWidgetItemIterator it(tree_); !was.isEmpty() && *it; ++it)
    if (identity(*it) == was) current = *it;
  if (current) {
    tree_->setCurrentItem(current, 0, QItemSelectionModel::NoUpdate);
    tree_->scrollToItem(current);
  }
  filling_ = false;
}

std::vector<const Piece*> GarmentPanel::chosenPieces() const {
  std::vector<const Piece*> pieces;
  for (const PieceId id : session_.selection().pieces)
    if (const Piece* piece = session_.snapshot().document.find(id)) pieces.push_back(piece);
  return pieces;
}
std::vector<PieceRef> GarmentPanel::chosenRefs() const {
  std::vector<PieceRef> refs;
  for (const Piece* piece : chosenPieces()) refs.push_back(PieceRef(piece->id));
  return refs;
}

// What all have is shown, and a dash where they differ.
void GarmentPanel::fillPieces(const std::vector<const Piece*>& pieces) {
  const Document& document = session_.snapshot().document;
  const Piece& first = *pieces.front();
  const bool alone = pieces.size() == 1;
  const auto differ = [&](const auto& of) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const Piece* piece) { return !(of(*piece) == of(first)); });
  };
  pieceTitle_->setText(inWords(alone ? say("Piece") : say("{0} {0|piece|pieces}", pieces.size())));
  showName(*name_, first.name, alone ? nameText(first.name) : QString());
  name_->setEnabled(alone);
  name_->setPlaceholderText(alone ? QString() : mixedWord());
  if (!alone) name_->setToolTip(inWords(say("Each piece has a name of its own; choose one alone.")));
  fabric_->clear();
  fabric_->setPlaceholderText(mixedWord());
  const auto add = [this](const std::string& name) {
    const QString word = QString::fromStdString(name);
    if (fabric_->findData(word) < 0) fabric_->addItem(nameText(name), word);
  };
  for (const std::string& name : fabricNames(document)) add(name);
  const bool fabrics = differ([](const Piece& one) { return one.fabric; });
  fabric_->setCurrentIndex(fabrics ? -1 : fabric_->findData(QString::fromStdString(first.fabric)));
  const auto show = [&](auto& box, bool differs, auto value) {
    if (beingTyped(*box.template findChild<QLineEdit*>())) return;
    box.setMixed(differs);
    if (!differs) box.setValue(value);
  };
  show(*layer_, differ([](const Piece& one) { return one.layer; }), first.layer);
  std::set<bool> frozen;
  for (const Piece* piece : pieces) frozen.insert(piece->frozen);
  showTicked(*frozen_, frozen);
  // Symmetric copies have the mirror image of the grain.
  const auto degrees = [&](const Piece& one) {
    const auto like = std::find_if(pieces.begin(), pieces.end(), [&](const Piece* of) {
      return of->id == one.mirrorOf && edgeOnCopy(one, *of, of->outline.edges.front().name);
    });
    const double across = like == pieces.end() ? one.grain.u : -one.grain.u;
    return std::atan2(across, one.grain.v) * 180 / std::numbers::pi;
  };
  constexpr double kSame = 0.05;  // degrees, as they are shown
  show(*grain_,
       std::any_of(pieces.begin(), pieces.end(),
                   [&](const Piece* one) { return std::fabs(degrees(*one) - degrees(first)) > kSame; }),
       degrees(first));
  cut_->refresh();
  std::vector<Look> looks;
  std::vector<Flat> shifts;
  double area = 0;
  for (const Piece* piece : pieces) {
    looks.push_back(lookOf(document, *piece));
    const auto shift = document.looks.shifts.find(piece->id);
    shifts.push_back(shift == document.looks.shifts.end() ? Flat() : shift->second);
    area += piece->outline.area();
  }
  look_->show(std::move(looks), std::move(shifts));
  area_->setText(alone ? areaText(area) : inWords(say("{0} together", areaText(area).toStdString())));
}

void GarmentPanel::fillProperties() {
  filling_ = true;
  const Document& document = session_.snapshot().document;
  const Selection& selection = session_.selection();
  const auto pieces = chosenPieces();
  const Piece* piece = selection.edge   ? document.find(selection.edge->piece)
                       : pieces.empty() ? nullptr
                                        : pieces.front();
  const bool hasEdge = piece && selection.edge.has_value();
  // What is typed on would go into the next box.
  if (const QWidget* typed = window()->focusWidget();
      typed && ((!piece && pieceBoard_->isAncestorOf(typed)) || (!hasEdge && edgeBoard_->isAncestorOf(typed))))
    tree_->setFocus();
  pieceBoard_->setVisible(!pieces.empty());
  edgeBoard_->setVisible(hasEdge);
  if (!pieces.empty()) fillPieces(pieces);
  if (piece && selection.edge) {
    if (const Edge* edge = findEdge(*piece, selection.edge->edge)) {
      showName(*edgeName_, edge->name, inWords(edgeNameSaid(document, *piece, edge->name)));
      length_->setMetres(edge->curve.length());
      takeIn_->setMetres(0);
      longer_->setMetres(0);
      longerHow_->refresh();
      showSeveral();
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

#include "variables_dialog.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "karinui/design/step_words.h"
#include "theme.h"

namespace karinui::studio {

namespace {

std::string plainText(const QString& text) { return text.trimmed().toStdString(); }

// The step (from 1) at which a variable got its present formula; 0: there is none.
std::size_t stepGiving(const Session& session, const std::string& name) {
  for (std::size_t i = session.steps().size(); i > 0; --i)
    if (const auto* given = std::get_if<SetVariable>(&session.steps()[i - 1].operation))
      if (given->name == name) return given->remove ? 0 : i;
  return 0;
}

// Edges by the names of their pieces, as one types them.
QString asTyped(const Document& document, const std::string& text) {
  const auto formula = Formula::parse(text);
  const auto named = formula ? formula->changed([&](FormulaTerm& term) -> Done {
    const Piece* piece = term.kind == FormulaTerm::Kind::Edge ? document.find(term.edge.piece.id) : nullptr;
    if (piece) term.edge.piece = PieceRef(piece->name);
    return {};
  })
                             : formula;
  return QString::fromStdString(named ? named->text() : text);
}

}  // namespace

DocumentNames formulaNames(const Session& session) {
  return DocumentNames(session.snapshot().document, [&session]() -> Result<BodyPtr> {
    if (const BodyPtr& body = session.snapshot().body) return body;
    return refused(say("There is no body yet; choose one first, for example: body size=jis9ar."));
  });
}

VariablesDialog::VariablesDialog(Session& session, QWidget* parent) : QDialog(parent), session_(session) {
  auto* column = new QVBoxLayout(this);
  table_ = new QTableWidget(0, 3);
  table_->verticalHeader()->hide();
  table_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  column->addWidget(table_);
  auto* row = new QHBoxLayout;
  name_ = new QLineEdit;
  formula_ = new QLineEdit;
  add_ = new QPushButton;
  remove_ = new QPushButton;
  row->addWidget(name_, 1);
  row->addWidget(formula_, 3);
  row->addWidget(add_);
  row->addWidget(remove_);
  column->addLayout(row);
  auto* about = new QLabel;
  about->setWordWrap(true);
  about->setProperty("role", "faint");
  column->addWidget(about);
  Theme::here().keep(this, [this, about] {
    setWindowTitle(inWords(say("Variables")));
    table_->setAccessibleName(inWords(say("Variables")));
    table_->setHorizontalHeaderLabels({inWords(say("Name")), inWords(say("Formula")), inWords(say("Value now"))});
    name_->setPlaceholderText(inWords(say("Name")));
    name_->setAccessibleName(inWords(say("Name")));
    formula_->setPlaceholderText("bust_girth/4 + 1.5cm");
    formula_->setAccessibleName(inWords(say("Formula")));
    add_->setText(inWords(say("Add")));
    remove_->setText(inWords(say("Remove")));
    about->setText(inWords(say(
        "Formulas have numbers with units, measures (bust_girth), variables and the lengths of edges "
        "(front.side_left). A formula changed here plays all later steps again. An edge whose length is given by other "
        "edges is linked to them and stands here too; removed here, it keeps its length.")));
    refresh();
  });
  resize(560, 360);
  connect(add_, &QPushButton::clicked, this, [this] {
    give(plainText(name_->text()), plainText(formula_->text()));
    formula_->clear();
    name_->clear();
    name_->setFocus();
  });
  connect(formula_, &QLineEdit::returnPressed, add_, &QPushButton::click);
  connect(remove_, &QPushButton::clicked, this, &VariablesDialog::remove);
  connect(table_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (!filling_ && item->column() == 1) give(nameIn(item->row()), plainText(item->text()));
  });
}

void VariablesDialog::showEvent(QShowEvent* event) {
  refresh();
  QDialog::showEvent(event);
}

void VariablesDialog::give(const std::string& name, const std::string& formula) {
  SetVariable set;
  set.name = name;
  set.value = formula;
  const std::size_t step = stepGiving(session_, name);
  if (step == 0)
    session_.perform(set);
  else
    session_.amend(step, set);
}

// As scripts have it; a linked edge is shown by what it is called.
std::string VariablesDialog::nameIn(int row) const {
  return table_->item(row, 0)->data(Qt::UserRole).toString().toStdString();
}

void VariablesDialog::remove() {
  const int row = table_->currentRow();
  if (row < 0) return;
  SetVariable set;
  set.name = nameIn(row);
  set.remove = true;
  session_.perform(set);
}

void VariablesDialog::refresh() {
  if (table_->findChild<QLineEdit*>()) return;  // one types in it
  filling_ = true;
  DocumentNames names = formulaNames(session_);
  const auto rows = variablesOf(session_.snapshot().document, names);
  const int chosen = table_->currentRow();
  table_->setRowCount(static_cast<int>(rows.size()));
  for (int i = 0; i < table_->rowCount(); ++i) {
    const VariableRow& row = rows[static_cast<std::size_t>(i)];
    const auto put = [&](int at, const QString& text, bool typed) {
      auto* item = new QTableWidgetItem(text);
      if (!typed) item->setFlags(item->flags() & ~Qt::ItemIsEditable);
      item->setToolTip(text);
      table_->setItem(i, at, item);
    };
    const bool edge = row.name.find('.') != std::string::npos;
    const auto formula = edge ? Formula::parse(row.name) : Result<Formula>(Error{});
    const auto* of = formula && formula->terms().size() == 1 ? &formula->terms().front().edge : nullptr;
    put(0, of ? inWords(edgeSaid(session_.snapshot().document, *of)) : QString::fromStdString(row.name), false);
    table_->item(i, 0)->setData(Qt::UserRole, QString::fromStdString(row.name));
    put(1, asTyped(session_.snapshot().document, row.formula), true);
    put(2,
        row.value ? QString::fromStdString(quantitySaid(*row.value, Theme::here().inches()))
                  : inWords(row.value.error().what),
        false);
  }
  if (chosen >= 0 && chosen < table_->rowCount()) table_->setCurrentCell(chosen, 1);
  remove_->setEnabled(!rows.empty());
  filling_ = false;
}

}  // namespace karinui::studio

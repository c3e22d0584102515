#include "variables_dialog.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "theme.h"

namespace karinui::studio {

namespace {

std::string utf8(const QString& text) { return text.trimmed().toStdString(); }

// The step (from 1) at which a variable got its present formula; 0: there is none.
std::size_t stepGiving(const Session& session, const std::string& name) {
  for (std::size_t i = session.steps().size(); i > 0; --i)
    if (const auto* given = std::get_if<SetVariable>(&session.steps()[i - 1].operation))
      if (given->name == name) return given->remove ? 0 : i;
  return 0;
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
    about->setText(
        inWords(say("Formulas have numbers with units, measures (bust_girth), variables and the lengths of edges "
                    "(front.side_left). A formula changed here plays all later steps again.")));
    refresh();
  });
  resize(560, 360);
  connect(add_, &QPushButton::clicked, this, [this] {
    give(utf8(name_->text()), utf8(formula_->text()));
    formula_->clear();
    name_->clear();
    name_->setFocus();
  });
  connect(formula_, &QLineEdit::returnPressed, add_, &QPushButton::click);
  connect(remove_, &QPushButton::clicked, this, &VariablesDialog::remove);
  connect(table_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (!filling_ && item->column() == 1) give(utf8(table_->item(item->row(), 0)->text()), utf8(item->text()));
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

void VariablesDialog::remove() {
  const int row = table_->currentRow();
  if (row < 0) return;
  SetVariable set;
  set.name = utf8(table_->item(row, 0)->text());
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
    put(0, QString::fromStdString(row.name), false);
    put(1, QString::fromStdString(row.formula), true);
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

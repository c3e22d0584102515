#include "share_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "karinui/design/glossary.h"
#include "theme.h"

namespace karinui::studio {

ShareDialog::ShareDialog(const Document& document, QWidget* parent) : QDialog(parent) {
  setWindowTitle(inWords(say("Share the pattern")));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(24, 24, 24, 20);
  column->setSpacing(12);
  auto* out =
      new QLabel(inWords(say("A new document for others. Figure, measurements, formulas and history are left "
                             "out of it.")));
  out->setWordWrap(true);
  column->addWidget(out);
  neutral_ = new QCheckBox(inWords(say("Replace all names by neutral ones: piece1, seam2, edge3")));
  neutral_->setObjectName("neutral");
  column->addWidget(neutral_);
  told_ = new QLabel;
  told_->setProperty("role", "faint");
  column->addWidget(told_);
  QStringList names;
  for (const std::string& name : namesIn(document)) names << inWords(nameSaid(name));
  read_ = new QPlainTextEdit(names.join(", "));
  read_->setReadOnly(true);
  read_->setTabChangesFocus(true);
  read_->setObjectName("names");
  read_->setAccessibleName(inWords(say("The names that others will read")));
  read_->setFixedHeight(100);
  column->addWidget(read_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel);
  buttons->button(QDialogButtonBox::Save)->setText(inWords(say("Save…")));
  buttons->button(QDialogButtonBox::Cancel)->setText(inWords(say("Cancel")));
  column->addWidget(buttons);
  connect(neutral_, &QCheckBox::toggled, this, &ShareDialog::refresh);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  resize(520, sizeHint().height());
  refresh();
}

SharedNames ShareDialog::names() const { return neutral_->isChecked() ? SharedNames::Neutral : SharedNames::Kept; }

void ShareDialog::refresh() {
  const bool stay = names() == SharedNames::Kept;
  told_->setText(inWords(stay ? say("Others will read these names:") : say("None of these names is in it:")));
  read_->setEnabled(stay);
}

}  // namespace karinui::studio

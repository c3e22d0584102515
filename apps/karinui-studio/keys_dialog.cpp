// Which key does what, chosen by the person.
#include <QDialog>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QKeySequenceEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QVBoxLayout>

#include "main_window.h"
#include "theme.h"

namespace karinui::studio {

void MainWindow::keysDialog() {
  QDialog dialog(this);
  dialog.setWindowTitle(inWords(say("Keys")));
  dialog.resize(460, 560);
  auto* column = new QVBoxLayout(&dialog);
  auto* inner = new QWidget;
  auto* form = new QFormLayout(inner);
  std::map<Command, QKeySequenceEdit*> edits;
  for (const CommandInfo& about : commands()) {
    auto* edit = new QKeySequenceEdit(actions_[about.command]->shortcut());
    form->addRow(inWords(about.label), edit);
    edits[about.command] = edit;
  }
  auto* scroll = new QScrollArea;
  scroll->setWidget(inner);
  scroll->setWidgetResizable(true);
  column->addWidget(scroll);
  auto* buttons =
      new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel | QDialogButtonBox::RestoreDefaults);
  buttons->button(QDialogButtonBox::Ok)->setText(inWords(say("OK")));
  buttons->button(QDialogButtonBox::Cancel)->setText(inWords(say("Cancel")));
  buttons->button(QDialogButtonBox::RestoreDefaults)->setText(inWords(say("As they were at first")));
  column->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, &dialog, [&] {
    for (const CommandInfo& about : commands())
      edits[about.command]->setKeySequence(
          QKeySequence(QString::fromUtf8(about.key.data(), static_cast<int>(about.key.size()))));
  });
  if (dialog.exec() != QDialog::Accepted) return;
  QSettings settings;
  for (const auto& [command, edit] : edits) {
    setKey(command, edit->keySequence());
    const auto name = info(command).name;
    settings.setValue("keys/" + QString::fromUtf8(name.data(), static_cast<int>(name.size())),
                      edit->keySequence().toString());
  }
}

}  // namespace karinui::studio

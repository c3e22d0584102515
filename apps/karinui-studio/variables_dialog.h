#pragma once
// The table of variables: each with its formula and what it is now. A formula that is changed is changed where it was
// given, and every step that followed is played again. GUI thread.
#include <QDialog>

#include "karinui/design/variables.h"
#include "karinui/session/session.h"

class QLineEdit;
class QPushButton;
class QTableWidget;

namespace karinui::studio {

// What names in formulas mean in the garment as it is; the session's snapshot must stay.
DocumentNames formulaNames(const Session& session);

class VariablesDialog : public QDialog {
  Q_OBJECT
 public:
  VariablesDialog(Session& session, QWidget* parent);
  void refresh();  // the session has something new

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void give(const std::string& name, const std::string& formula);
  std::string nameIn(int row) const;
  void remove();
  Session& session_;
  QTableWidget* table_;
  QLineEdit *name_, *formula_;
  QPushButton *add_, *remove_;
  bool filling_ = false;
};

}  // namespace karinui::studio

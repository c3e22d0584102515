#pragma once
// The numbers of one operation, typed before it is done: a rectangle, a ring, a band, a block, the settings. What a
// piece on paper would be is drawn while one types, with the lengths of its edges, or the reason why it cannot be. GUI
// thread.
#include <QDialog>

#include "karinui/session/session.h"
#include "step_field.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace karinui::studio {

class OutlineDrawing;

class StepDialog : public QDialog {
  Q_OBJECT
 public:
  // Opens on `operation` as it is, and deletes itself when it is closed.
  StepDialog(Session& session, Operation operation, QWidget* parent);

 signals:
  void performed();

 private:
  void fill(const Operation& operation);
  std::string typed(std::string_view field) const;  // empty: nothing, or it is not of this kind
  void fitToKind();                                 // asks what the chosen kind has
  bool givesWay(std::string_view field) const;
  Result<Operation> wished() const;
  void show(const Result<Operation>& wish);
  void takeRoom();  // all it asks for, where the screen has that
  void keepOnScreen();
  void standAside();
  void perform();
  Session& session_;
  Document document_;  // as it was when the dialog opened: the fields know its pieces
  std::string name_;   // of the operation
  Operation opened_;   // as the dialog opened
  QFormLayout *main_, *more_;
  QWidget* rest_;  // holds more_
  OutlineDrawing* drawing_;
  QLabel* said_;
  QPushButton* make_;
  std::vector<StepField> typed_;
};

// The settings as they are: entered unchanged, nothing is done.
ChangeSettings settingsNow(const Session& session);

// The outline of the one piece that an operation would make, or why it is refused; nothing to show where it makes none
// or several. What needs the body or a photograph is looked at only as far as it can be without.
Result<std::shared_ptr<const Piece>> tried(const Session& session, Operation operation);

}  // namespace karinui::studio

#pragma once
// Making up a pattern that came without its sewing: what each piece was taken for, the seams that are proposed, and how
// the pieces will stand, all to be corrected before anything is done. What is chosen becomes steps of the document.
// The proposals are worked out on a thread of their own, from the garment as it was when the dialog opened. GUI thread.
#include <QDialog>
#include <QThreadPool>
#include <memory>
#include <optional>

#include "karinui/base/token.h"
#include "karinui/design/make_up.h"
#include "karinui/session/session.h"

class QLabel;
class QPushButton;
class QTableWidget;
class QTabBar;

namespace karinui::studio {

class MakeUpView;

class MakeUpDialog : public QDialog {
  Q_OBJECT
 public:
  MakeUpDialog(Session& session, QWidget* parent);  // it begins at once, and goes when it is closed
  ~MakeUpDialog() override;                         // stops what is being worked out and waits for it
  bool busy() const { return token_ != nullptr; }
  const std::optional<MakingUp>& making() const { return making_; }

 signals:
  void finished();  // proposals were worked out, or could not be

 private:
  struct Proposed;
  void begin();
  void take(const std::shared_ptr<Proposed>& proposed);
  void showPieces();
  void showSeams();
  void tellSeam();
  void accept() override;
  std::vector<const SeamProposal*> seams() const;  // in the order of the list

  Session& session_;
  const Document document_;
  const BodyPtr body_;
  MakeUpChoices choices_;
  QTableWidget *pieces_, *seams_;
  QTabBar* views_;
  MakeUpView* view_;
  QLabel* said_;
  QPushButton* accept_;
  std::optional<MakingUp> making_;
  std::shared_ptr<Token> token_;  // of what is being worked out
  QThreadPool thread_;
};

}  // namespace karinui::studio

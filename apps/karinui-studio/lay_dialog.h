#pragma once
// The lay plan: on what cloth the pieces are laid, the search for it on a thread of its own, and the plan, whose pieces
// are moved by hand and which is written at true size. It lays the garment as it was when the dialog opened. GUI
// thread.
#include <QDialog>
#include <QThreadPool>
#include <memory>
#include <optional>

#include "karinui/base/token.h"
#include "karinui/design/lay_plan.h"
#include "karinui/session/session.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QTabBar;

namespace karinui::studio {

class LayView;
class LengthBox;

class LayDialog : public QDialog {
  Q_OBJECT
 public:
  LayDialog(Session& session, QWidget* parent);  // it begins to search at once, and goes when it is closed
  ~LayDialog() override;                         // stops the search and waits for it
  bool busy() const { return token_ != nullptr; }
  const std::optional<LayPlan>& plan() const { return plan_; }

 signals:
  void finished();  // a search, in whatever way

 private:
  struct Search;
  LaySettings settings() const;
  void keepSettings() const;
  void begin();
  void take(Result<LayPlan> found);
  void showFabric();
  void tellUse();
  void tell(const Message& words);
  void enable();
  void save();

  Session& session_;
  const Document document_;
  LengthBox *width_, *gap_, *stripes_, *rows_;
  QCheckBox *fold_, *nap_;
  QComboBox *search_, *kind_;
  QPushButton *lay_, *save_;
  QProgressBar* progress_;
  QTabBar* fabrics_;
  LayView* view_;
  QLabel *use_, *notes_, *said_;
  std::optional<LayPlan> plan_;
  std::shared_ptr<Token> token_;  // of the search that is under way
  QThreadPool thread_;
};

}  // namespace karinui::studio

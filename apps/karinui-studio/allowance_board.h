#pragma once
// How the chosen edge is finished: how far beyond its seam line it is cut, how the cut line turns at its ends, its hem
// and its elastic, what closes it, and the ease that is meant in its seam. GUI thread.
#include <QWidget>
#include <array>

#include "karinui/session/session.h"

class QComboBox;
class QLabel;

namespace karinui::studio {

class LengthBox;

class AllowanceBoard : public QWidget {
  Q_OBJECT
 public:
  explicit AllowanceBoard(Session& session);
  void refresh();

 private:
  SetAllowance operation() const;  // of the chosen edge; there is one
  void perform(SetAllowance operation);
  double wholeLength() const;  // of the chosen edges together
  SeamId seam() const;         // that holds the chosen edge; none: it is not sewn

  Session& session_;
  LengthBox *width_, *hem_, *elastic_, *ease_;
  std::array<QComboBox*, 2> corners_;  // where the edge starts, where it ends
  QLabel *why_, *pull_, *fastened_, *faults_;
  bool filling_ = false;
};

}  // namespace karinui::studio

#pragma once
// The chosen edges made longer or shorter together, with what they are sewn to: an armhole with its cap. GUI thread.
#include <QWidget>

#include "karinui/session/session.h"

class QCheckBox;
class QComboBox;

namespace karinui::studio {

class LongerBoard : public QWidget {
  Q_OBJECT
 public:
  explicit LongerBoard(Session& session);
  void refresh();                    // the chosen edges, or the garment, are others
  Lengthen lengthen(double metres);  // of the chosen edges

 private:
  std::vector<EdgeRef> side() const;  // of the seam of the one edge that is chosen, where that is more than the edge
  Session& session_;
  QCheckBox *whole_, *partners_;
  QComboBox* beside_;
  std::vector<EdgeRef> shown_;
  bool picked_ = false;  // what the edges beside do; otherwise it is the first that can be done
};

}  // namespace karinui::studio

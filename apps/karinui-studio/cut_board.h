#pragma once
// How often the chosen pieces are cut from the cloth. GUI thread.
#include <QSpinBox>
#include <QWidget>

#include "karinui/session/session.h"
#include "mixed_box.h"

class QCheckBox;

namespace karinui::studio {

class CutBoard : public QWidget {
  Q_OBJECT
 public:
  explicit CutBoard(Session& session);
  void refresh();

 private:
  void perform(int count, bool pairs);

  Session& session_;
  MixedBox<QSpinBox>* count_;
  QCheckBox* pairs_;
  bool filling_ = false;
};

}  // namespace karinui::studio

#pragma once
// The board "Device": what is found, what is used and in which state, its force, laws and workspace; emergency off. GUI
// thread.
#include "force_feedback.h"
#include "panels.h"

class QProgressBar;

namespace karinui::studio {

class DevicePanel : public Panel {
  Q_OBJECT
 public:
  DevicePanel(Session& session, ForceFeedback& force, QWidget* in);
  void refresh() override {}  // nothing of it is the session's

 private:
  void set(const std::function<void(DeviceSettings&)>& change);
  void show();       // settings
  void showState();  // of the loop
  void record();     // asks where to, or ends it
  ForceFeedback& force_;
  QComboBox *kind_, *other_, *pull_, *hand_, *second_;
  QLabel *found_, *state_, *newtonsSaid_, *gainSaid_;
  QProgressBar* newtons_;
  QPushButton *look_, *off_, *test_, *record_, *calibrate_;
  QSlider* gain_;
  QDoubleSpinBox *limit_, *scale_;
  std::vector<std::pair<QCheckBox*, bool TouchLaws::*>> laws_;
};

}  // namespace karinui::studio

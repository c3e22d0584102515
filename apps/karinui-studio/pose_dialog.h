#pragma once
// How the figure stands, joint by joint: sliders and dragged limbs move a figure of the dialog's own; what is let go is
// one step of the document, and the garment follows then. GUI thread.
#include <QDialog>
#include <memory>
#include <optional>

#include "karinui/body/skeleton.h"
#include "karinui/session/session.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QSlider;

namespace karinui::studio {

class AngleBox;
class PoseView;

class PoseDialog : public QDialog {
  Q_OBJECT
 public:
  PoseDialog(Session& session, QWidget* parent);  // goes when it is closed
  void refresh();                                 // the session has something new

 private:
  struct Row {  // flex, abduct or turn of the chosen joint, whole degrees
    QLabel* name;
    QSlider* slider;
    AngleBox* box;
  };
  Joint joint() const;
  std::vector<Joint> joints() const;  // the chosen one, or both sides
  JointAngles anglesOf(Joint joint) const;
  bool inHand() const;
  void showRows();
  void turned();   // a slider or a box
  void perform();  // what is in hand becomes a step, as soon as the figure stands
  void tell();

  Session& session_;
  std::shared_ptr<const Skeleton> skeleton_;
  std::string shownOn_;  // Body::hash() of what the session's figure was when it was taken over
  BodyPose pose_;        // that is tried
  PoseView* view_;
  QComboBox *joint_, *named_;
  QCheckBox* both_;
  std::array<Row, 3> rows_;
  QLabel* said_;
  Message about_, refused_;
  bool filling_ = false;
  bool waits_ = false;  // for the figure to arrive
};

}  // namespace karinui::studio

#pragma once
// A picture of the fitting for a letter or a wall: from where, how large, with which map. GUI thread.
#include <QDialog>
#include <functional>
#include <map>

#include "karinui/session/fit.h"
#include "karinui/view/picture.h"
#include "space_view.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QSpinBox;

namespace karinui::studio {

class PictureDialog : public QDialog {
  Q_OBJECT
 public:
  PictureDialog(Session& session, SpaceView& view, QWidget* parent);
  Result<Image> draw(double scale = 1) const;  // of the size that was chosen
  Done write(const std::string& path) const;
  int frames() const;  // of a turntable; 0: one picture was chosen
  // Those, numbered, into a folder, which is made. `goesOn` is asked meanwhile, with how many there are; false stops
  // it. How many were written.
  Result<int> writeTurn(const std::string& folder, const std::function<bool(int)>& goesOn, double scale = 1) const;

 private:
  void refresh();
  PictureOptions options(double scale) const;
  Result<const SceneFrame*> framed(const GarmentSnapshot& fitting, PictureOptions& how) const;
  Session& session_;
  SpaceView& view_;
  QComboBox *from_, *size_, *eyes_;
  QSpinBox* count_;
  QFormLayout* rows_;
  QLabel* picture_;
  mutable std::map<const GarmentSnapshot*, PressedFrame> pressed_;  // those that were drawn with their pressure
};

}  // namespace karinui::studio

#pragma once
// How the chosen edge is taken in: all along it, or most at a place and to nothing at its ends, and what that does
// to which it is sewn. GUI thread.
#include <QWidget>

#include "karinui/session/session.h"

class QCheckBox;
class QComboBox;

namespace karinui::studio {

class LengthBox;

class TakeInBoard : public QWidget {
  Q_OBJECT
 public:
  explicit TakeInBoard(Session& session);
  void refresh();                      // the chosen edge, or the garment, is another
  TakeIn takeIn(double metres) const;  // of the chosen edges

 private:
  const Edge* edge() const;
  void showPlace();
  void addPlaces();
  Session& session_;
  QComboBox* where_;
  LengthBox* place_;
  QComboBox* partners_;
  QCheckBox* follow_;
  std::optional<EdgeNear> shown_;
};

}  // namespace karinui::studio

#pragma once
// The SpaceMouse of the window. Where none is there silently is none. GUI thread.
#include <QObject>

#include "karinui/devices/space_mouse.h"

class QSocketNotifier;

namespace karinui::studio {

class Cap : public QObject {
  Q_OBJECT
 public:
  explicit Cap(QObject* parent);
  bool there() const { return device_ != nullptr; }

 signals:
  void moved(const CapMotion& motion);
  void pressed(int button);  // from 0

 private:
  void listen();
  std::unique_ptr<SpaceMouse> device_;
  QSocketNotifier* notifier_ = nullptr;
};

}  // namespace karinui::studio

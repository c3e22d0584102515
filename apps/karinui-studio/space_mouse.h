#pragma once
// A cap that moves in all six ways (SpaceMouse), through spacenavd. Where no daemon runs there silently is none. One in
// a program: the connection is libspnav's own. GUI thread.
#include <QObject>

class QSocketNotifier;

namespace karinui::studio {

// How far the cap is from its rest, 1: as far as it goes; over how many seconds.
struct CapMotion {
  double right = 0, up = 0, away = 0;  // pushed
  double tilt = 0, turn = 0;           // its top towards the person; its front to the right
  double seconds = 0;
};

class SpaceMouse : public QObject {
  Q_OBJECT
 public:
  explicit SpaceMouse(QObject* parent);
  ~SpaceMouse() override;
  bool there() const { return notifier_ != nullptr; }

 signals:
  void moved(const CapMotion& motion);
  void pressed(int button);  // from 0

 private:
  void listen();
  void leave();
  QSocketNotifier* notifier_ = nullptr;
};

}  // namespace karinui::studio

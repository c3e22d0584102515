#include "space_mouse.h"

#include <QSocketNotifier>
#include <algorithm>

#ifdef KARINUI_SPNAV
#include <sys/socket.h>
#define SPNAV_CONFIG_H_  // libspnav's X11 half, and the names it brings, are not for us
#include <spnav.h>
#endif

namespace karinui::studio {

#ifdef KARINUI_SPNAV

namespace {
constexpr double kFull = 350;      // what a cap pushed to its end says
constexpr double kLongest = 0.05;  // seconds: after a pause the first motion counts no more
bool taken = false;
}  // namespace

SpaceMouse::SpaceMouse(QObject* parent) : QObject(parent) {
  if (taken || spnav_open() == -1) return;
  taken = true;
  notifier_ = new QSocketNotifier(spnav_fd(), QSocketNotifier::Read, this);
  connect(notifier_, &QSocketNotifier::activated, this, &SpaceMouse::listen);
}

SpaceMouse::~SpaceMouse() { leave(); }

void SpaceMouse::leave() {
  if (!notifier_) return;
  notifier_->setEnabled(false);
  notifier_->deleteLater();
  notifier_ = nullptr;
  spnav_close();
  taken = false;
}

void SpaceMouse::listen() {
  char byte = 0;
  if (recv(spnav_fd(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0) return leave();  // the daemon is gone
  spnav_event event;
  while (notifier_ && spnav_poll_event(&event) != 0) {
    if (event.type == SPNAV_EVENT_BUTTON && event.button.press) emit pressed(event.button.bnum);
    if (event.type != SPNAV_EVENT_MOTION) continue;
    const auto& m = event.motion;
    emit moved({m.x / kFull, m.y / kFull, m.z / kFull, m.rx / kFull, m.ry / kFull,
                std::clamp(static_cast<double>(m.period) / 1000, 0.001, kLongest)});
  }
}

#else

SpaceMouse::SpaceMouse(QObject* parent) : QObject(parent) {}
SpaceMouse::~SpaceMouse() = default;

#endif

}  // namespace karinui::studio

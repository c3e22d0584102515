#include "cap.h"

#include <QSocketNotifier>

namespace karinui::studio {

Cap::Cap(QObject* parent) : QObject(parent) {
  auto found = SpaceMouse::open();
  if (!found) return;
  device_ = *std::move(found);
  notifier_ = new QSocketNotifier(device_->descriptor(), QSocketNotifier::Read, this);
  connect(notifier_, &QSocketNotifier::activated, this, &Cap::listen);
}

void Cap::listen() {
  while (device_) {
    const auto event = device_->next();
    if (!device_->there()) {
      notifier_->setEnabled(false);
      notifier_->deleteLater();
      device_.reset();
      return;
    }
    if (!event) return;
    if (event->motion) emit moved(*event->motion);
    if (event->button >= 0 && event->pressed) emit pressed(event->button);
  }
}

}  // namespace karinui::studio

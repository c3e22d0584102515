#include "pressure_map.h"

#include <algorithm>

#include "karinui/session/fit.h"

namespace karinui::studio {

PressureMap::PressureMap(QObject* parent) : QObject(parent) { thread_.setMaxThreadCount(1); }

PressureMap::~PressureMap() {
  thread_.clear();
  thread_.waitForDone();
}

PressureMap::Values PressureMap::of(const SnapshotPtr& garment) {
  if (const auto known = known_.find(garment); known != known_.end()) return known->second;
  if (busy_) return nullptr;
  busy_ = true;
  thread_.start([this, garment] {
    Workers alone(1);
    auto values = std::make_shared<const std::vector<float>>(pressureOnBody(*garment, alone));
    const auto take = [this, garment, values = std::move(values)] {
      busy_ = false;
      known_[garment] = values;
      emit ready();
    };
    QMetaObject::invokeMethod(this, take, Qt::QueuedConnection);
  });
  return nullptr;
}

void PressureMap::keepOnly(const std::vector<SnapshotPtr>& garments) {
  std::erase_if(known_, [&](const auto& one) {
    return std::find(garments.begin(), garments.end(), one.first) == garments.end();
  });
}

}  // namespace karinui::studio

#pragma once
// The forces of one scene on the hand: every law that is chosen, each within the stiffness and damping of the device.
// Keeps the proxy from tick to tick. No allocation; one thread.
#include "karinui/touch/force_law.h"
#include "karinui/touch/haptic_device.h"
#include "karinui/touch/proxy.h"

namespace karinui {

inline constexpr double kCouplingShare = 0.7;  // of the device's stiffness, for cloth that is pulled

struct TouchForces {
  Vec3 contact, pull, cut, weight;
  double stored = 0;  // J that the elastic parts could give back now
  bool touching = false;
  bool known = true;  // the device is within the patch
  Vec3 proxy;
  Vec3 coupled() const { return contact + pull + cut; }  // all but the weight
};

class TouchEvaluator {
 public:
  void reset() { proxy_.reset(); }
  const Proxy& proxy() const { return proxy_; }
  void takeProxy(const TouchEvaluator& from) { proxy_ = from.proxy_; }
  TouchForces evaluate(const TouchScene& scene, const DeviceRecord& record, const TouchLaws& laws, Vec3 device,
                       Vec3 velocity);

 private:
  Proxy proxy_;
};

}  // namespace karinui

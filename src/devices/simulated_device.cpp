#include "karinui/devices/simulated_device.h"

namespace karinui {

DeviceRecord simulatedRecord() {
  DeviceRecord record;
  record.name = "simulated hand";
  record.freedomOut = 3;
  record.force = 3.3;
  record.stiffness = 400;
  record.damping = 4;
  record.workspace.include({-0.08, -0.06, -0.035});
  record.workspace.include({0.08, 0.06, 0.035});
  return record;
}

}  // namespace karinui

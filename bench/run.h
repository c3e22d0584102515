#pragma once
// Settles a workload and examines what came of it.
#include "bench/workload.h"
#include "karinui/check/check.h"
#include "karinui/cloth/dynamics.h"

namespace karinui::bench {

struct Examined {
  ClothCheck check;      // with the penetration of an analytic body as well
  double clearance = 0;  // metres the cloth keeps from the body, at 15 places of each face; negative: penetration
};
Examined examine(const Workload& load);  // its finest state

struct Finding {
  SettleReport report;
  Examined found;
  DynamicsReport after;  // 300 frames of dynamics after rest
};
// The workload's finest state becomes the settled one. `continued`: whether rest itself is measured, too.
Result<Finding> run(Workload& load, const Token& token, Workers& workers, bool continued = false);

}  // namespace karinui::bench

#pragma once
// What settle and pull share: looking over what they are given, and telling what came of it.
#include <chrono>
#include <ctime>

#include "cloth/rest.h"
#include "karinui/cloth/settle.h"

namespace karinui {

class Spent {  // time and memory, for the report alone
 public:
  void tell(SettleReport& report) const;

 private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

Done checkLevel(const ClothLevel& level);
Done checkSettings(const SettleSettings& settings);
Error tornApart();

void addContactTimes(SettleReport& report, const LevelSolver& solver);

RestRule finestRule(const SettleSettings& settings);
// Lifts the resting cloth off the surface and fills the report from where it then stands.
std::vector<Vec3> finish(LevelSolver& solver, const ColliderList& colliders, const SettleSettings& settings,
                         const RestOutcome& end, SettleReport& report, Workers& workers);

}  // namespace karinui

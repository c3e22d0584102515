#pragma once
// The end of a drape: what settle and pull tell of it.
#include <chrono>
#include <ctime>

#include "cloth/penetration.h"
#include "cloth/stages.h"

namespace karinui {

class ResourceUse {  // time since it was made and memory, for the report alone
 public:
  void tell(SettleReport& report) const;
  double cpuSeconds() const { return static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC; }
  void leaveOut(const ResourceUse& later);  // the time since `later` was made

 private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

// What is said of the widest seam, `gap` metres open, and of a body that is between its sides.
Message openSeam(const Cloth& cloth, std::span<const Vec3> position, double gap, const ColliderList& colliders);
Message throughBody(const Penetration& most);
Error tornApart();
void addContactTimes(SettleReport& report, const LevelSolver& solver);
// `rested`: whether the cloth was at rest before it was changed here and there.
RestCriteria finestCriteria(const SettleSettings& settings, bool rested);
// Lifts the resting cloth off the surfaces and fills the report from where it then stands.
std::vector<Vec3> finish(LevelSolver& solver, const ColliderList& colliders, const SettleSettings& settings,
                         const StageResult& end, SettleReport& report, Workers& workers);

}  // namespace karinui
